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
    FiniteMapSqueeze,
    FiniteSqueeze,
    MapSqueeze,
    PorousDamper,
    ShortSqueeze,
    SqueezeLaw,
)
from ...bearings.films.cavitation import FullFilm
from ...bearings.sprung import Sprung
from ...errors import RotorfilmError, ValidityWarning
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
    """

    name: str
    shape: PorousDamper
    law: SqueezeLaw
    rich_shape: PorousDamper
    rich_law: SqueezeLaw | None
    prior: float

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
        return TOP_BOUNDS.get(type(self.law), math.inf)

    def prepare(self) -> dict[WorkUnit, int]:
        """Return the work of making the damper, which its first use makes."""
        return {MAP_MADE: 1} if self.makes_map else {}

    @property
    def rich_work(self) -> dict[WorkUnit, int]:
        """Work of making the richer one."""
        return {RICH_MADE: 1} if isinstance(self.rich_law, FiniteMapSqueeze) else {}

    @cached_property
    def reaction(self) -> PorousDamper:
        """The damper with its film."""
        return with_changes(self.shape, film=self.law)

    @cached_property
    def rich(self) -> PorousDamper | None:
        """The damper with the richer film."""
        return None if self.rich_law is None else with_changes(self.rich_shape, film=self.rich_law)

    @cached_property
    def moving(self) -> PorousDamper:
        """The damper on the map of its film, where it has one: a motion takes thousands of forces."""
        return with_changes(self.shape, film=_mapped(self.law, self.shape))

    @cached_property
    def rich_moving(self) -> PorousDamper | None:
        """The richer damper on its map."""
        if self.rich_law is None:
            return None
        return with_changes(self.rich_shape, film=_mapped(self.rich_law, self.rich_shape))


def damper_films(table: DamperTable) -> tuple[DamperFilm, ...]:
    """Return the films that can answer for a damper, the cheapest first; one that a scene names alone.

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
    """Return the damper with the short film, on its map where it has one."""
    shape = _short(table)
    return with_changes(shape, film=_mapped(ShortSqueeze(), shape))


def with_changes(damper: PorousDamper, **changes: object) -> PorousDamper:
    """Return the damper with other fields, without the warning of a short film: its error is estimated."""
    with quiet():
        return replace(damper, **changes)  # type: ignore[arg-type]


@contextmanager
def quiet() -> Iterator[None]:
    """Leave out what a film warns of when it is made: a ladder estimates its error."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        yield


def sprung(damper: PorousDamper, stiffness: float) -> Reaction:
    """Return the damper with springs of the stiffness [N/m], if there are some."""
    return Sprung(reaction=damper, stiffness=stiffness) if stiffness else damper
