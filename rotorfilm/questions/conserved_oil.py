"""What the conservation of oil changes, in the estimate of Reynolds rupture.

Reynolds rupture makes the oil with which its film starts. How much that matters is the change from it to the
film that conserves its oil, both on a coarse grid under the same load; it is added to what richer grids
change, with its sign where both are known.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

from ..analysis import equilibrium
from ..bearings.journal import RUPTURE_CELLS, JFOFilm, JournalBearing, both_films, extrapolated_value
from ..core.answers import (
    HEATED,
    ISOTHERMAL,
    BaseRung,
    ErrorEstimate,
    Found,
    Ladder,
    Rung,
    WorkUnit,
    relative_change,
)
from ..core.errors import InputError, RotorfilmError
from ..core.model import settled
from ..core.results import Equilibrium
from ..scenes.film_rungs import Corrected, FilmCandidate, RestedJournal, tangent

if TYPE_CHECKING:
    from ..scenes.journal_tables import JournalTable
    from ..scenes.scene import Scene

CANCELED = 0.5
"""Of the sum of two parts of an error, what they leave together where they are taken as not canceling."""


@dataclass(frozen=True, eq=False)
class RestedFilm(RestedJournal):
    """A journal at rest, and the film at its temperature there.

    Attributes
    ----------
    at : Equilibrium
    film : JournalBearing or JFOFilm
    """

    at: Equilibrium
    film: Any

    @property
    def frozen(self) -> FilmCandidate:
        """The film as a candidate, for rungs of motions; there is no richer one."""
        return candidate("", self.film)

    @property
    def coefficients(self) -> Any:
        """K and C: smooth ones of Reynolds rupture, else at the frequency of the shaft."""
        film, at = self.film, self.at
        if isinstance(film, JFOFilm):
            return film.coefficients(at.position, at.speed)
        slopes = tangent(film, at.position, at.speed, smooth=True)[1]
        return Corrected(position=at.position, slopes=slopes, doubt="")

    @property
    def losses(self) -> Any:
        """Power loss and flow of oil."""
        return self.at.losses

    @property
    def temperature(self) -> Any:
        """Of the film [K]; None of one that does not warm."""
        return self.at.temperature


def candidate(name: str, film: Any) -> FilmCandidate:
    """Return a film as a candidate of which nothing is known beforehand."""
    return FilmCandidate(name=name, reaction=film, rich=film, rich_name=name, position_prior=0.0, prior=0.0)


@dataclass(frozen=True, eq=False)
class RuptureChange:
    """Both films of a bearing on coarse grids, at rest under a load; found once.

    Attributes
    ----------
    bearing : JournalBearing
        At one temperature, or on an oil.
    load : (float, float) [N]
    speed : float [rad/s]
    """

    bearing: JournalBearing
    load: tuple[float, float]
    speed: float

    @property
    def films(self) -> tuple[tuple[JournalBearing, JFOFilm], ...]:
        """Reynolds rupture, and the film that conserves its oil, on each of the cells, the coarser first."""
        return tuple(both_films(self.bearing, cells) for cells in RUPTURE_CELLS)

    @cached_property
    def rests(self) -> tuple[tuple[RestedFilm, RestedFilm], ...]:
        """By Reynolds rupture, and by the film that conserves its oil, on each of the cells."""
        return tuple(
            (rest_on(one, self.load, self.speed), rest_on(other, self.load, self.speed))
            for one, other in self.films
        )

    def change(self, value: Callable[[RestedFilm], Any], *, relative: bool) -> Change:
        """Return what the conservation of oil changes in a quantity of a rest."""
        reynolds, conserved = (tuple(map(value, pair)) for pair in zip(*self.rests, strict=True))
        finer = Change(reynolds[-1], conserved[-1], relative)
        return Change(extrapolated_value(*reynolds), extrapolated_value(*conserved), relative, finer)


def rest_on(film: Any, load: tuple[float, float], speed: float) -> RestedFilm:
    """Return where a journal rests on a film, which may be on an oil."""
    at = equilibrium(film, load, speed)
    return RestedFilm(at, settled(film, at.position, speed))


class Change(NamedTuple):
    """A quantity by Reynolds rupture, and by the film that conserves its oil, on one coarse grid.

    Attributes
    ----------
    own, better : float or ndarray
    relative : bool
        Whether the one over the other counts, or their difference.
    finer : Change or None
        What is not extrapolated, on the finer of two grids; None of one grid.
    """

    own: Any
    better: Any
    relative: bool = False
    finer: Change | None = None

    def on(self, value: Any) -> Any:
        """Return a value by Reynolds rupture as changed."""
        return value * self.better / self.own if self.relative else value + (self.better - self.own)


@dataclass(frozen=True, kw_only=True)
class RupturedRung(BaseRung):
    """An answer by Reynolds rupture, whose estimate has what the conservation of its oil would change.

    Attributes
    ----------
    inner : Rung
        Its error is that of the film and, of an oil, of the heat.
    change : callable
        Takes the answer and returns what the conservation of the oil changes, a Change.
    distance : callable
        Takes a value and a better one, and returns how far it is off in the unit of the tolerance.
    token : object
        What rungs of one question share.
    """

    inner: Any
    change: Callable[[Found], Change]
    distance: Callable[[Any, Any], float]
    token: object

    @property
    def name(self) -> str:
        """That of the rung."""
        return str(self.inner.name)

    @property
    def film(self) -> Any:
        """That of the rung."""
        return self.inner.film

    @property
    def prior(self) -> float:
        """That of the rung."""
        return float(self.inner.prior)

    @property
    def refines(self) -> tuple[object, ...]:
        """What the rung refines."""
        return tuple(self.inner.refines)

    @property
    def shares(self) -> object:
        """The error of the rung's kind, or else that of all by Reynolds rupture."""
        return self.inner.shares or self.token

    def answer(self, before: Found | None) -> Found:
        """Return the answer of the rung."""
        found: Found = self.inner.answer(before)
        return found

    def expected(self, done: Any) -> Any:
        """Return the work of the rung."""
        return self.inner.expected(done)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the rung with what the conservation of its oil would change.

        Where both cancel, or are less than what the extrapolation of the latter changes, at most their sum.
        """
        about: ErrorEstimate = self.inner.estimate(found, before, tolerance)
        try:
            change = self.change(found)
        except RotorfilmError as error:
            doubt = f"what the conservation of its oil would change is not known: {error}"
            return about._replace(doubt=about.doubt or doubt)
        share = self.distance(found.value, change.on(found.value))
        total, bound = about.error + share, about.bound and about.error > share
        if about.better is not None:
            better = change.on(about.better)
            known = self.distance(found.value, better)
            unsure = 0.0 if change.finer is None else self.distance(change.finer.on(about.better), better)
            if known > max(CANCELED * total, unsure):
                total, bound = known, False
            else:
                total, bound = total + unsure, True
        method = f"{about.method}; conservation of oil, {share:.2g}"
        return about._replace(error=total, method=method, bound=bound, shared=about.shared + share)


def supply_of(table: JournalTable, bearing: JournalBearing) -> str | None:
    """Return why the oil of a bearing cannot be conserved, empty if it can; None without an opening."""
    if bearing.geometry.plain:
        return None
    try:
        table.conserved(bearing)
    except InputError as error:
        return str(error)
    return ""


NOT_JUDGED = "conservation of oil: not judged, {reason}"

NO_RUNG = (
    "conservation of oil: in the estimate, by small motion; no rung of this question follows the oil of a "
    "cavity in time"
)

UNFED = (
    "supply: the bearing has none, and its film starts with oil that is made there; with the grooves or "
    "holes that feed it this is another number"
)


def with_rupture(
    scene: Scene,
    ladder: Ladder,
    change: Callable[[Found], Change],
    distance: Callable[[Any, Any], float],
    above: Callable[[], tuple[Rung, ...]] | None = None,
) -> Ladder:
    """Return a ladder by Reynolds rupture whose estimates count the conservation of the oil.

    Parameters
    ----------
    scene : Scene
    ladder : Ladder
    change, distance : callable
        See `RupturedRung`.
    above : callable, optional
        Returns the rungs that conserve their oil; None where there is none.
    """
    table = scene.journal
    assert table is not None  # whose question it is
    reason = supply_of(table, scene.journal_bearing)
    if reason is None:
        return ladder
    if reason:
        return replace(ladder, remarks=(*ladder.remarks, NOT_JUDGED.format(reason=reason)))
    token = object()
    rungs: tuple[Rung, ...] = tuple(
        RupturedRung(inner=rung, change=change, distance=distance, token=token) for rung in ladder.rungs
    )
    if above is not None and not scene.film_is_given:
        return replace(ladder, rungs=(*rungs, *above()))
    remarks = ladder.remarks if above is not None else (*ladder.remarks, NO_RUNG)
    return replace(ladder, rungs=rungs, remarks=remarks)


def with_moved_rupture(
    scene: Scene,
    ladder: Ladder,
    linear: Callable[[Any], float],
    distance: Callable[[float, float], float],
    *,
    scaled: bool,
) -> Ladder:
    """Return the ladder of a motion with what the conservation of oil changes in the linear one.

    Parameters
    ----------
    scene : Scene
    ladder : Ladder
    linear : callable
        Takes a film as a candidate, and returns the quantity in linear motion about its rest.
    distance : callable
        As of `RupturedRung`.
    scaled : bool
        Whether the share counts, rather than the difference.
    """
    rupture = RuptureChange(scene.journal_bearing, scene.static_load, scene.speed)

    def change(found: Found) -> Change:
        return rupture.change(lambda rest: linear(rest.frozen), relative=scaled)

    return with_rupture(scene, ladder, change, distance)


def conserved_ladder(
    scene: Scene, rungs: tuple[Rung, ...], unit: str, distance: Callable[[Any, Any], float] = relative_change
) -> Ladder:
    """Return the ladder of a scene whose film conserves its oil."""
    within = HEATED if scene.journal_bearing.is_warming else ISOTHERMAL
    return Ladder(rungs=rungs, unit=unit, remarks=scene.film_remarks, within=within, distance=distance)


# Rungs above Reynolds rupture: films that conserve their oil, each judged by coarser cells.


CELLS = (72, 8), (144, 12), (288, 24)
"""Cells of the rungs, around and along half of the film."""

SECONDS = {CELLS[0]: 0.01, CELLS[1]: 0.03, CELLS[2]: 0.15}
"""About what an equilibrium on them takes [s]."""


@dataclass(frozen=True, kw_only=True)
class ConservedRung(BaseRung):
    """An answer on the film that conserves its oil, of an oil in the balance of its heat.

    Attributes
    ----------
    film : JFOFilm
    value : callable
        Takes a film and an answer from below, and returns the quantity on it.
    distance : callable
        As of `RupturedRung`.
    heat : callable
        Takes the tolerance and returns the error by heat of one temperature; None of a film of one.
    """

    film: JFOFilm
    value: Callable[[JFOFilm, Found | None], Any]
    distance: Callable[[Any, Any], float]
    heat: Callable[[float], ErrorEstimate] | None = None

    @property
    def name(self) -> str:
        """Cells, and of an oil the level of its heat."""
        level = "T1, " if self.heat is not None else ""
        return f"{level}JFO {self.film.cells[0]} x {self.film.cells[1]}"

    @property
    def shares(self) -> object:
        """The error of its heat."""
        return self.heat

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        seconds = SECONDS.get(self.film.cells, SECONDS[CELLS[1]])
        return WorkUnit(f"answers of {self.name}", ("answers", self.name), nominal=seconds)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity."""
        return Found(self.value(self.film, before), {self.unit: 1})

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change since half the lines, and since half the cells along: mostly thrice the error.

        Each by itself, as they may cancel, and that by both where it is more.
        """
        around, along = self.film.cells
        fewer = _other(around, 16), _other(along, 4)
        lines, cells, both = (
            self.distance(self.value(replace(self.film, cells=other), found), found.value)
            for other in ((fewer[0], along), (around, fewer[1]), fewer)
        )
        error = max(lines + cells, both)
        work = {WorkUnit(f"estimates of {self.name}"): 1}
        about = ErrorEstimate(error, "half the lines, half the cells along", work, bound=True)
        if self.heat is None:
            return about
        heat = self.heat(tolerance)
        method = f"{about.method}; heat: {heat.method}, {heat.error:.2g}"
        return about._replace(error=error + heat.error, method=method, doubt=heat.doubt, shared=heat.error)


def _other(cells: int, least: int) -> int:
    """Return an even number of about half the cells, or of twice as many where that is too few."""
    half = 2 * round(0.25 * cells)
    return half if half >= least else 2 * cells


def conserved_films(scene: Scene) -> tuple[JFOFilm, ...]:
    """Return the films of a scene that conserve their oil, the coarsest first; one if the scene names it."""
    table = scene.journal
    assert table is not None  # whose question it is
    bearing = scene.journal_bearing
    if table.film is not None and table.conserves:
        return (table.conserved(bearing),)
    return tuple(table.conserved(bearing, cells) for cells in CELLS)
