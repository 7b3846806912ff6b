"""The films of a squeeze-film damper as rungs: which can answer a scene, and what is richer."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace

from ...bearings import PorousDamper, Sprung
from ...errors import RotorfilmError, ValidityWarning
from ...films import FiniteMapSqueeze, FiniteSqueeze, FullFilm, MapSqueeze, ShortSqueeze
from ...model import Reaction
from ..damper_table import DamperTable
from .films import MAP_MADE

DEFECT_CELLS = (10, 20)
"""Cells of the map of finite length that defects are sampled with: within 5e-4 of the force, in a second."""

TOP_BOUNDS = {FiniteSqueeze: 1e-6, FiniteMapSqueeze: 3e-4}
"""Verified errors of the force of the richest films: docs/accuracy.md."""

NO_RICHER = (
    "no film of finite length is there for a cavitated damper with feed, so that nobody knows how far the "
    "short one is off"
)


@dataclass(frozen=True, kw_only=True)
class DamperFilm:
    """A film of a damper that may answer.

    Attributes
    ----------
    name : str
    damper : PorousDamper
        With this film.
    rich : PorousDamper or None
        With the film that its defect is sampled with; None where there is none.
    prior : float [1]
        Order of magnitude of the error of its force; 0 if unknown.
    bound : float [1]
        Verified error of its force; infinite where there is none.
    """

    name: str
    damper: PorousDamper
    rich: PorousDamper | None
    prior: float
    bound: float


def damper_films(table: DamperTable) -> tuple[DamperFilm, ...]:
    """Return the films that can answer for a damper, the cheapest first; one that a scene names alone.

    Solid cage, thin layer, Darcy's layer with the short film, then the film of finite length. A film with
    feed keeps its cage, through which it is fed.
    """
    damper = table.build()
    top = richest(damper)
    named = [(type(damper.film).__name__, damper, 0.0)]
    found = _free(damper, top) if table.film is None else named
    rich = None if top is None else coarser(top)
    return tuple(
        DamperFilm(
            name=name,
            damper=film,
            rich=None if film == top else rich,
            prior=prior,
            bound=TOP_BOUNDS.get(type(film.film), math.inf),
        )
        for name, film, prior in found
    )


def _free(damper: PorousDamper, top: PorousDamper | None) -> list[tuple[str, PorousDamper, float]]:
    short = with_changes(damper, film=ShortSqueeze())
    slim = 0.02 * min(damper.slenderness**2, 1.0)
    rungs = []
    if damper.cage is not None and not damper.is_fed:
        rungs.append(("short film, solid cage", with_changes(short, cage=None), slim))
        if not damper.cage.thin:
            try:
                thin = with_changes(short, cage=replace(damper.cage, thin=True))
                rungs.append(("short film, thin layer", thin, slim))
            except RotorfilmError:
                pass
    own = "" if damper.cage is None else ", thin layer" if damper.cage.thin else ", Darcy's layer"
    rungs.append((f"short film{own}", short, slim))
    return rungs if top is None else [*rungs, (f"finite film{own}", top, 0.0)]


def richest(damper: PorousDamper) -> PorousDamper | None:
    """Return the damper with a film of finite length; None for a cavitated one with feed, which has none."""
    full = isinstance(damper.extent, FullFilm)
    if damper.is_fed and not full:
        return None
    return with_changes(damper, film=FiniteSqueeze() if full else FiniteMapSqueeze())


def coarser(damper: PorousDamper) -> PorousDamper:
    """Return a damper of finite length with a coarser map, if it has one: enough for a defect."""
    cavitated_map = isinstance(damper.film, FiniteMapSqueeze)
    return replace(damper, film=FiniteMapSqueeze(cells=DEFECT_CELLS)) if cavitated_map else damper


def mapped(damper: PorousDamper) -> PorousDamper:
    """Return the damper on the map of its film, where it has one: a motion takes thousands of forces."""
    laws = {ShortSqueeze: MapSqueeze(), FiniteSqueeze: FiniteMapSqueeze()}
    law = laws.get(type(damper.film))
    return damper if law is None or damper.is_fed else with_changes(damper, film=law)


def with_changes(damper: PorousDamper, **changes: object) -> PorousDamper:
    """Return the damper with other fields, without the warning of a short film: its error is estimated."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        return replace(damper, **changes)  # type: ignore[arg-type]


def sprung(damper: PorousDamper, stiffness: float) -> Reaction:
    """Return the damper with springs of the stiffness [N/m], if there are some."""
    return Sprung(reaction=damper, stiffness=stiffness) if stiffness else damper


def make_map(support: Reaction) -> dict[str, int]:
    """Make the map of a support that has one by its first force, and return the work of that."""
    film = getattr(getattr(support, "reaction", support), "film", None)
    if not isinstance(film, FiniteMapSqueeze):
        return {}
    support.force([0.5 * support.clearance, 0.0], [0.0, support.clearance], 1.0)
    return {MAP_MADE: 1}
