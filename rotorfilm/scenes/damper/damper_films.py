"""The films of a squeeze-film damper as rungs: which can answer a scene, and what is richer."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property

from ...answers import WorkUnit
from ...bearings.damper import (
    ExtrapolatedDamper,
    FiniteMapSqueeze,
    FiniteSqueeze,
    JFODamper,
    JudgedDamper,
    MapSqueeze,
    PorousDamper,
    ShortSqueeze,
    SqueezeLaw,
)
from ...bearings.films.cavitation import FullFilm
from ...bearings.sprung import Sprung
from ...errors import InputError, RotorfilmError, ValidityWarning
from ...model import Reaction
from ..journal.film_rung import MAP_MADE
from .damper_table import DamperTable

DEFECT_CELLS = (10, 20)
"""Cells of the map of finite length that defects are sampled with: within 5e-4 of the force, in a second."""

TOP_BOUNDS = {FiniteSqueeze: 1e-6, FiniteMapSqueeze: 3e-4}
"""Verified errors of the force of the richest films: docs/accuracy.md."""

RICH_MADE = WorkUnit("maps of the film of finite length made for estimates")
"""WorkUnit of the work of making the map that defects are sampled with."""

NO_RICHER = (
    "no film of finite length is there for a cavitated damper with feed, so that nobody knows how far the "
    "short one is off"
)


@dataclass(frozen=True, kw_only=True)
class DamperFilm:
    """A film of a damper that may answer; the dampers are made when they are needed, for a map takes seconds.

    Attributes
    ----------
    name : str
    shape : PorousDamper
        The damper with a short film, and the cage that this rung knows.
    law : SqueezeLaw
        The film.
    rich_shape : PorousDamper
        The damper with a short film and its whole cage.
    rich_law : SqueezeLaw or None
        The film that the defect is sampled with; None where there is none.
    prior : float [1]
        Order of magnitude of the error of its force; 0 if unknown.
    conserved : JFODamper or None
        The damper that conserves its oil, where the scene has its supply: it is richer than all of these.
    """

    name: str
    shape: PorousDamper
    law: SqueezeLaw
    rich_shape: PorousDamper
    rich_law: SqueezeLaw | None
    prior: float
    conserved: JFODamper | None = None

    @property
    def is_fed(self) -> bool:
        """Whether the force has a part that comes from a feed."""
        return self.shape.is_fed

    @property
    def makes_map(self) -> bool:
        """Whether the damper is made with a map, which takes seconds."""
        return isinstance(self.law, FiniteMapSqueeze)

    def bound(self, eccentricity_ratio: float = 0.0, *, slopes: bool = False) -> float:
        """Return the verified error of its force [1], the same everywhere; infinite where there is none."""
        return math.inf if self.conserved is not None else TOP_BOUNDS.get(type(self.law), math.inf)

    def prepare(self) -> dict[WorkUnit, int]:
        """Return the work of making the damper, which its first use makes."""
        return {MAP_MADE: 1} if self.makes_map else {}

    @property
    def rich_work(self) -> dict[WorkUnit, int]:
        """Work of making the richer one."""
        if self.conserved is not None:
            return {}
        return {RICH_MADE: 1} if isinstance(self.rich_law, FiniteMapSqueeze) else {}

    @cached_property
    def reaction(self) -> PorousDamper:
        """The damper with its film."""
        return with_changes(self.shape, film=self.law)

    @cached_property
    def rich(self) -> PorousDamper | ExtrapolatedDamper | JudgedDamper | None:
        """The damper with the richer film."""
        if self.conserved is not None:
            return ExtrapolatedDamper(damper=self.conserved)
        return None if self.rich_law is None else with_changes(self.rich_shape, film=self.rich_law)

    @cached_property
    def moving(self) -> PorousDamper:
        """The damper on the map of its film, where it has one: a motion takes thousands of forces."""
        return with_changes(self.shape, film=_mapped(self.law, self.shape))

    @cached_property
    def rich_moving(self) -> PorousDamper | JudgedDamper | None:
        """The richer damper on its map."""
        if self.rich_law is None:
            return None
        return with_changes(self.rich_shape, film=_mapped(self.rich_law, self.rich_shape))


@dataclass(frozen=True, kw_only=True)
class ConservedDamperFilm:
    """The damper that conserves its oil as a film that may answer, judged by one on twice as fine a grid.

    Attributes
    ----------
    name : str
    damper : JFODamper
        Without springs.
    prior : float [1]
        0: nothing is known beforehand.
    """

    name: str
    damper: JFODamper
    prior: float = 0.0

    @property
    def law(self) -> None:
        """None: it is no film law of another damper."""

    def bound(self, eccentricity_ratio: float = 0.0, *, slopes: bool = False) -> float:
        """Return infinity: it has no verified error."""
        return math.inf

    def prepare(self) -> dict[WorkUnit, int]:
        """Return no work: there is nothing to make."""
        return {}

    @property
    def rich_work(self) -> dict[WorkUnit, int]:
        """No work either."""
        return {}

    @cached_property
    def reaction(self) -> ExtrapolatedDamper:
        """The damper on circular orbits."""
        return ExtrapolatedDamper(damper=self.damper)

    @cached_property
    def moving(self) -> ExtrapolatedDamper:
        """The same on half as many lines and cells, for searches through hundreds of orbits."""
        return ExtrapolatedDamper(damper=self.reaction.coarser)

    @cached_property
    def rich(self) -> ExtrapolatedDamper:
        """The damper on twice as many lines and cells."""
        around, along = self.damper.cells
        return ExtrapolatedDamper(damper=replace(self.damper, cells=(2 * around, 2 * along)))


AnyDamperFilm = DamperFilm | ConservedDamperFilm


def damper_films(table: DamperTable) -> tuple[AnyDamperFilm, ...]:
    """Return the films that can answer for an orbit, the cheapest first; one that a scene names alone.

    With a supply the short film, judged by the film that conserves its oil, and that film, which takes less
    time than the map of one of finite length.

    Raises
    ------
    InputError
        If the supply differs around the damper.
    """
    plain = plain_films(table)
    if table.supply is None:
        return plain
    if not table.supply.turns_alike:
        raise InputError(
            "supply.feed_holes must be left out for a question about jumps, as they make orbits unsteady: "
            f"ask for unbalance_amplitude, or run the scene, got {table.supply.feed_holes!r}"
        )
    damper = replace(table.conserved(table.supply), stiffness=0.0)
    judged = [replace(film, conserved=damper) for film in plain]
    if table.film is not None:
        return tuple(judged)
    quick = [film for film in judged if not film.makes_map]
    return (*quick, ConservedDamperFilm(name="conserved oil", damper=damper))


def plain_films(table: DamperTable) -> tuple[DamperFilm, ...]:
    """Return the films that know no supply, the cheapest first; one that a scene names alone.

    Solid cage, thin layer, Darcy's layer with the short film, then the film of finite length. A film with
    feed keeps its cage, through which it is fed.
    """
    shape, top = _short(table), richest_law(_short(table))
    named = table.film
    found = _free(shape, top) if named is None else [(type(named).__name__, shape, named, 0.0)]
    rich = FiniteMapSqueeze(cells=DEFECT_CELLS) if isinstance(top, FiniteMapSqueeze) else top
    return tuple(
        DamperFilm(
            name=name,
            shape=own,
            law=law,
            rich_shape=shape,
            rich_law=None if law == top else rich,
            prior=prior,
        )
        for name, own, law, prior in found
    )


def _short(table: DamperTable) -> PorousDamper:
    """Return the damper of a scene with the short film, which takes no time to make."""
    with quiet():
        return replace(table, film=None).build()


def _free(shape: PorousDamper, top: SqueezeLaw | None) -> list[tuple[str, PorousDamper, SqueezeLaw, float]]:
    short = ShortSqueeze()
    slim = 0.02 * min(shape.slenderness**2, 1.0)
    rungs: list[tuple[str, PorousDamper, SqueezeLaw, float]] = []
    if shape.cage is not None and not shape.is_fed:
        rungs.append(("short film, solid cage", with_changes(shape, cage=None), short, slim))
        if not shape.cage.thin:
            try:
                thin = with_changes(shape, cage=replace(shape.cage, thin=True))
                rungs.append(("short film, thin layer", thin, short, slim))
            except RotorfilmError:
                pass
    own = "" if shape.cage is None else ", thin layer" if shape.cage.thin else ", Darcy's layer"
    rungs.append((f"short film{own}", shape, short, slim))
    return rungs if top is None else [*rungs, (f"finite film{own}", shape, top, 0.0)]


def richest_law(damper: PorousDamper) -> SqueezeLaw | None:
    """Return the film of finite length of a damper; None for a cavitated one with feed, which has none."""
    full = isinstance(damper.extent, FullFilm)
    if damper.is_fed and not full:
        return None
    return FiniteSqueeze() if full else FiniteMapSqueeze()


def _mapped(law: SqueezeLaw, shape: PorousDamper) -> SqueezeLaw:
    maps: dict[type, SqueezeLaw] = {ShortSqueeze: MapSqueeze(), FiniteSqueeze: FiniteMapSqueeze()}
    return law if shape.is_fed else maps.get(type(law), law)


def mapped_short(table: DamperTable) -> PorousDamper:
    """Return one land of the damper with the short film, on its map where it has one; see `lands`."""
    shape = with_changes(_short(table), viscosity=(1.0 - table.air_fraction) * table.viscosity)
    return shape if table.needs_length else with_changes(shape, film=_mapped(ShortSqueeze(), shape))


def lands(table: DamperTable) -> int:
    """Return how many films the damper has side by side: two beside a groove in its middle."""
    return 2 if table.supply is not None and table.supply.circumferential_groove is not None else 1


def with_changes(damper: PorousDamper, **changes: object) -> PorousDamper:
    """Return the damper with other fields, without the warning of a short film: its error is estimated."""
    with quiet():
        return replace(damper, **changes)  # type: ignore[arg-type]


@contextmanager
def quiet() -> Iterator[None]:
    """Leave out what a film warns of when it is made: a ladder estimates its error."""
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        yield


def sprung(damper: PorousDamper | ExtrapolatedDamper | JudgedDamper, stiffness: float) -> Reaction:
    """Return the damper with springs of the stiffness [N/m], if there are some."""
    return Sprung(reaction=damper, stiffness=stiffness) if stiffness else damper
