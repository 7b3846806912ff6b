"""The effect of conserved oil on a question about a journal bearing.

Reynolds rupture makes the oil with which its film starts. How much that matters is the change from it to the
film that conserves its oil, both on a coarse grid under the same load; it is added to what richer grids
change, with its sign where both are known. Above Reynolds rupture stand films that conserve their oil.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..analysis import equilibrium
from ..analysis.coefficients import film_coefficients
from ..bearings.journal import (
    RUPTURE_CELLS,
    JFOFilm,
    JournalBearing,
    both_films,
    extrapolated_value,
    tilts,
)
from ..core.answers import HEATED, ISOTHERMAL, ErrorEstimate, Ladder, LeftOutRemark, Rung, RungResult
from ..core.errors import InputError, RotorfilmError
from ..core.port import at_balanced_temperature
from ..core.results import Equilibrium
from ..scenes.film_heat import HeatSteps, uniform_rest
from ..scenes.film_rungs import (
    Corrected,
    FilmCandidate,
    JournalEquilibrium,
    any_candidate,
    maximum_pressure,
    tangent,
)
from ..scenes.oil_film_tables import ConservingTable
from .heat_levels import field_rung
from .variants import FunctionRung, counted_rung, with_estimate

if TYPE_CHECKING:
    from ..scenes.scene import Scene

CANCELED = 0.5
"""Of the sum of two parts of an error, what they leave together where they are taken as not canceling."""


@dataclass(frozen=True, eq=False)
class FilmEquilibrium(JournalEquilibrium):
    """A journal at rest, and the film at its temperature there.

    Attributes
    ----------
    at : Equilibrium
    reaction : JournalBearing or JFOFilm
    """

    at: Equilibrium
    reaction: Any

    @property
    def coefficients(self) -> Any:
        """K and C: at the frequency of the shaft where they depend on it, else smooth ones."""
        film, at = self.reaction, self.at
        if hasattr(film, "at_rest"):
            return film_coefficients(film, at.position, at.speed)
        slopes = tangent(film, at.position, at.speed, smooth=True)[1]
        return Corrected(position=at.position, slopes=slopes, doubt="")

    @property
    def losses(self) -> Any:
        """Power loss and flow of oil."""
        return self.at.losses

    @property
    def temperature(self) -> Any:
        """Of the film [K], that of its balance; of a film held at one temperature, the balance there."""
        at = self.at
        if at.temperature is not None:
            return at.temperature
        return self.reaction.balanced_temperature(at.position, np.zeros(2), at.speed)

    maximum_temperature = temperature

    @property
    def maximum_pressure(self) -> float:
        """Largest pressure in the film [Pa]."""
        return maximum_pressure(self.reaction, self.at.position, self.at.speed)


def rest_on(film: Any, load: tuple[float, float], speed: float) -> FilmEquilibrium:
    """Return where a journal rests on a film, which may be on an oil."""
    at = equilibrium(film, load, speed)
    return FilmEquilibrium(at, at_balanced_temperature(film, at.position, speed))


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


def coarse_films(bearing: JournalBearing) -> tuple[tuple[JournalBearing, JFOFilm], ...]:
    """Return Reynolds rupture and the film that conserves its oil on each of the cells, the coarser first."""
    return tuple(both_films(bearing, cells) for cells in RUPTURE_CELLS)


def change_at_rest(question: Any, bearing: JournalBearing) -> Change:
    """Return what the conservation of oil changes in a quantity of a rest under the load of a question."""
    load, speed = question.load, question.speed
    rests = [[rest_on(film, load, speed) for film in pair] for pair in coarse_films(bearing)]
    reynolds, conserved = (tuple(map(question.value, one)) for one in zip(*rests, strict=True))
    finer = Change(reynolds[-1], conserved[-1], question.scaled)
    return Change(extrapolated_value(*reynolds), extrapolated_value(*conserved), question.scaled, finer)


def with_change(
    about: ErrorEstimate,
    found: RungResult,
    change: Callable[[RungResult], Change],
    distance: Callable[[Any, Any], float],
) -> ErrorEstimate:
    """Return the error of a rung by Reynolds rupture with what the conservation of its oil would change.

    Where both cancel, or are less than what the extrapolation of the latter changes, at most their sum.
    """
    try:
        changed = change(found)
    except RotorfilmError as error:
        doubt = f"what the conservation of its oil would change is not known: {error}"
        return about._replace(doubt=about.doubt or doubt)
    share = distance(found.value, changed.on(found.value))
    total, bound = about.error + share, about.bound and about.error > share
    if about.better is not None:
        better = changed.on(about.better)
        known = distance(found.value, better)
        unsure = 0.0 if changed.finer is None else distance(changed.finer.on(about.better), better)
        if known > max(CANCELED * total, unsure):
            total, bound = known, False
        else:
            total, bound = total + unsure, True
    method = f"{about.method}; conservation of oil, {share:.2g}"
    return about._replace(error=total, method=method, bound=bound, shared=about.shared + share)


NOT_JUDGED = "conservation of oil: not checked, {reason}"

NO_RUNG = (
    "conservation of oil: in the estimate, by small motion; no model of this question follows the oil of "
    "a cavity in time"
)


LEFT_OUT, SMALL = "conservation of oil", 0.01
"""Name of the effect, and the change of an answer below which a bearing of pads says nothing of it."""

OF_PADS = (
    'conservation of oil: with film = {{name = "jfo"}}, which conserves it where the films of the pads '
    "rupture, the answer is {share:.2g} away"
)


def supply_of(table: ConservingTable, bearing: Any) -> str | None:
    """Return why the oil of a bearing cannot be conserved, empty if it can; None where nothing depends on it.

    So it is without an opening. Tilting pads between full gaps converge to their outlet or rupture there
    once, where both kinds of rupture agree.
    """
    if bearing.geometry.plain or tilts(bearing):
        return None
    if getattr(table, "tilt", None) is not None:
        return "the journal keeps a tilt"
    try:
        table.conserved(bearing)
    except InputError as error:
        return str(error)
    return ""


def conserved_oil(scene: Scene, question: Any, films: Sequence[FilmCandidate], ladder: Ladder) -> Ladder:
    """Return a ladder by Reynolds rupture whose estimates count the conservation of the oil.

    On them stand the rungs that conserve it, unless the scene names the film, or the question has none. Of
    lobed and pressure-dam bearings a remark has what it changes.
    """
    table: Any = scene.film_table
    if not isinstance(table, ConservingTable):
        return ladder
    bearing = table.bearing()
    reason = supply_of(table, bearing)
    if reason is None:
        return ladder
    if reason:
        return replace(ladder, remarks=(*ladder.remarks, NOT_JUDGED.format(reason=reason)))
    if scene.journal is None:
        return replace(ladder, remarks=(*ladder.remarks, *_left_out(question, bearing)))
    token, change = object(), question.conservation(bearing)

    def ruptured(rung: Rung) -> FunctionRung:
        def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
            return with_change(rung.estimate(found, before, tolerance), found, change, question.distance)

        return with_estimate(rung, estimate, token)

    rungs = tuple(ruptured(rung) for rung in ladder.rungs)
    if not question.follows_oil:
        return replace(ladder, rungs=rungs, remarks=(*ladder.remarks, NO_RUNG))
    above = () if scene.film_is_given else conserved_rungs(scene, question)
    return replace(ladder, rungs=(*rungs, *above))


def _left_out(question: Any, bearing: Any) -> tuple[str, ...]:
    """Return what the conservation of oil changes in an answer about pads at rest; nothing of others."""
    if question.moves or not question.is_at_rest:
        return ()
    try:
        changed = change_at_rest(question, bearing)
    except RotorfilmError as error:
        return (NOT_JUDGED.format(reason=error),)
    share = question.distance(changed.own, changed.better)
    if share < SMALL:
        return ()
    return (LeftOutRemark(OF_PADS.format(share=share), LEFT_OUT, share),)


# Films that conserve their oil, each judged by coarser cells.


CELLS = (72, 8), (144, 12), (288, 24)
"""Cells of the rungs, around and along half of the film."""

SECONDS = {CELLS[0]: 0.01, CELLS[1]: 0.03, CELLS[2]: 0.15}
"""About what an equilibrium on them takes [s]."""


def conserved_ladder(scene: Scene, question: Any) -> Ladder:
    """Return the ladder of a scene whose film conserves its oil."""
    table: Any = scene.film_table
    return Ladder(
        rungs=conserved_rungs(scene, question),
        unit=question.unit,
        remarks=scene.film_remarks,
        within=HEATED if table.bearing().is_warming else ISOTHERMAL,
        distance=question.distance,
    )


def conserved_rungs(scene: Scene, question: Any) -> tuple[FunctionRung, ...]:
    """Return the rungs that conserve their oil, the coarsest first, on an oil with those of its heat.

    They have the cells of the scene, if it names such a film.
    """
    table: Any = scene.film_table
    bearing = table.bearing()
    own = table.film is not None and table.conserves
    films = [table.conserved(bearing, cells) for cells in ((None,) if own else CELLS)]
    if not (bearing.is_warming and question.follows_oil):
        return tuple(conserved_rung(question, film) for film in films)
    heat = partial(_heat_of_balance, question, films[0])
    levels = () if tilts(bearing) else question.levels
    uniform = tuple(conserved_rung(question, film, heat) for film in films)
    return (*uniform, *(field_rung(question, level, any_candidate(films[0])) for level in levels))


def conserved_rung(
    question: Any, film: JFOFilm, heat: Callable[[], ErrorEstimate] | None = None
) -> FunctionRung:
    """Return the rung of an answer on the film that conserves its oil, of an oil in the balance of its heat.

    Its error is the change since half the lines, and since half the cells along: mostly thrice the error.
    Each by itself, as they may cancel, and that by both where it is more. `heat` returns the error by heat
    of one temperature.
    """
    around, along = film.cells
    fewer = _other(around, 16), _other(along, 4)
    coarser = [replace(film, cells=cells) for cells in ((fewer[0], along), (around, fewer[1]), fewer)]

    def solve(before: RungResult | None) -> tuple[Any, None]:
        return question.conserved(film, before), None

    def judge(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        values = [question.conserved(other, found) for other in coarser]
        lines, cells, both = (question.distance(value, found.value) for value in values)
        error = max(lines + cells, both)
        about = ErrorEstimate(error, "half the lines, half the cells along", bound=True)
        if heat is None:
            return about
        more = heat()
        method = f"{about.method}; heat: {more.method}, {more.error:.2g}"
        return about._replace(error=error + more.error, method=method, doubt=more.doubt, shared=more.error)

    name = f"{'' if heat is None else 'T1, '}JFO {around} x {along}"
    seconds = SECONDS.get(film.cells, SECONDS[CELLS[1]])
    return counted_rung(name, ("answers", name), seconds, solve, judge, shares=heat)


def _other(cells: int, least: int) -> int:
    """Return an even number of about half the cells, or of twice as many where that is too few."""
    half = 2 * round(0.25 * cells)
    return half if half >= least else 2 * cells


def _heat_of_balance(question: Any, film: JFOFilm) -> ErrorEstimate:
    """Return the error by heat of a film of one temperature that conserves its oil.

    Of tilting pads it is that of their film with Reynolds rupture, with which it agrees.
    """
    bearing = film.bearing if tilts(film.bearing) else film
    try:
        own = uniform_rest(bearing, question.load, question.speed)
        steps = HeatSteps(bearing, own)
        found = question.judge.error(own, steps)
    except RotorfilmError as error:
        return ErrorEstimate(math.inf, "not known", doubt=f"its error by heat is not known: {error}")
    return ErrorEstimate(found.error, "steps towards T3", bound=found.bound, doubt=steps.doubt)
