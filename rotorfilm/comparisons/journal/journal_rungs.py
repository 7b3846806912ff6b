"""The rungs of the journal film: every law, every place where its film may end, several orders."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from ...bearings.films.law import FilmLaw
from ...bearings.journal import (
    ComplementarityArc,
    ExtrapolatedFilm,
    FixedArc,
    JournalBearing,
    MapFilm,
    ReynoldsArc,
    ReynoldsFilm,
    RotatingArc,
    Rupture,
    ShortFilm,
    SpectralArcFilm,
    SplittingFilm,
)
from ...errors import InputError, require_positive

SLENDERNESS = (0.1, 4.0)
"""Smallest and largest length / diameter at which all rungs exist."""

CONVERGED = 24
"""Degree of the converged films: 4e-8 at eccentricity ratios to 0.99."""

ROTATING_ORDERS = ((1, 1), (2, 1), (2, None), (4, 2), (6, None))
"""Orders on the rotating arc, from the published first approximation to all but converged."""


class FilmFamily(StrEnum):
    """What films of the ladder have in common: where they end, or how they are solved."""

    SHORT = "short film"
    PUBLISHED = "published"
    FIXED = "fixed arc"
    ROTATING = "rotating arc"
    REYNOLDS = "Reynolds arc"
    FREE = "free arc"
    GRID = "2-D"
    EXTRAPOLATED = "2-D extrapolated"
    MAP = "map"


@dataclass(frozen=True, kw_only=True)
class RungName:
    """What a rung is called.

    Attributes
    ----------
    family : FilmFamily
        What it has in common with its neighbors.
    label : str
        What tells it from them; empty if nothing has to.
    """

    family: FilmFamily
    label: str

    @property
    def name(self) -> str:
        """Family and label, unique in the ladder."""
        return f"{self.family} {self.label}".strip()


@dataclass(frozen=True, kw_only=True)
class ComparedFilm(RungName):
    """One film law of the ladder.

    Attributes
    ----------
    film : FilmLaw
    """

    film: FilmLaw


def journal_rungs() -> tuple[ComparedFilm, ...]:
    """Return the ladder, families from the cheapest to the closest."""
    fixed, rotating, free = FixedArc(), RotatingArc(), ComplementarityArc()
    return (
        ComparedFilm(family=FilmFamily.SHORT, label="", film=ShortFilm()),
        *(_splitting(FilmFamily.PUBLISHED, fixed, n, 1) for n in (1, 2)),
        *(_splitting(FilmFamily.FIXED, fixed, n, None) for n in (2, 6)),
        _converged(FilmFamily.FIXED, fixed),
        *(_splitting(FilmFamily.ROTATING, rotating, n, m) for n, m in ROTATING_ORDERS),
        _converged(FilmFamily.ROTATING, rotating),
        *(_splitting(FilmFamily.REYNOLDS, ReynoldsArc(), n, None, constant=True) for n in (4, 6)),
        *(_splitting(FilmFamily.FREE, free, n, m, constant=True) for n, m in ((4, 8), (6, None))),
        _converged(FilmFamily.FREE, free),
        *(_grid(FilmFamily.GRID, *cells) for cells in ((48, 4), (96, 8), (192, 16))),
        *(_grid(FilmFamily.EXTRAPOLATED, *cells) for cells in ((48, 8), (96, 8), (192, 8), (384, 16))),
        ComparedFilm(family=FilmFamily.MAP, label="", film=MapFilm()),
    )


def chosen_rungs(rungs: Sequence[ComparedFilm] | None) -> tuple[ComparedFilm, ...]:
    """Return the rungs to compare, the whole ladder for None.

    Raises
    ------
    InputError
        If there is none, one is not a `Rung`, or two have the same name.
    """
    if rungs is None:
        return journal_rungs()
    chosen = tuple(rungs)
    if not chosen or not all(isinstance(rung, ComparedFilm) for rung in chosen):
        raise InputError(f"rungs must hold at least one Rung and nothing else, got {rungs!r}")
    names = [rung.name for rung in chosen]
    if len(set(names)) < len(names):
        raise InputError(f"rungs must have different names, got {names!r}")
    return chosen


def comparison_bearing(slenderness: float) -> JournalBearing:
    """Return the bearing of the comparisons; dimensionless results depend on length / diameter alone.

    Raises
    ------
    InputError
        If length / diameter is outside the range of the ladder.
    """
    require_positive("slenderness", slenderness)
    lowest, highest = SLENDERNESS
    if not lowest <= slenderness <= highest:
        raise InputError(f"slenderness (L/D) must be from {lowest} to {highest}, got {slenderness!r}")
    return JournalBearing(
        radius=0.05, length=0.1 * slenderness, clearance=1e-4, viscosity=0.1, film=MapFilm()
    )


def _splitting(
    family: FilmFamily, arc: Rupture, n: int, m: int | None, constant: bool = False
) -> ComparedFilm:
    label = f"({n}{'+c' if constant else ''}, {'all' if m is None else m})"
    return ComparedFilm(
        family=family, label=label, film=SplittingFilm(order=(n, m), constant=constant, rupture=arc)
    )


def _converged(family: FilmFamily, arc: Rupture) -> ComparedFilm:
    return ComparedFilm(family=family, label="converged", film=SpectralArcFilm(rupture=arc, degree=CONVERGED))


def _grid(family: FilmFamily, around: int, along: int) -> ComparedFilm:
    plain = ReynoldsFilm(cells=(around, along))
    film = plain if family is FilmFamily.GRID else ExtrapolatedFilm(film=plain)
    return ComparedFilm(family=family, label=f"{around} x {along}", film=film)
