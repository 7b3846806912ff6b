"""The films that may answer for a bearing of fixed pads, the cheapest first, and what is richer."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...bearings.films.map_bounds import matrix_sizes
from ...bearings.pads import LobedBearing, PadFilm, PadGridFilm, PadMapFilm
from ...bearings.pads.lobe import Lobe
from ...bearings.pads.pad_bounds import DIRECTIONS, FLOOR
from ...bearings.pads.pad_build import PadResolution
from ...bearings.pads.pad_map import EXTENTS, SLENDERNESSES
from ...linear import coefficients
from ...model import Array
from ...results import Equilibrium
from ..journal.film_candidate import CALL_TIME, CELL_TIME, FilmCandidate
from .pad_films import pad_film_name

COARSE_MAP = PadMapFilm(resolution=PadResolution(cells=(48, 4), nodes=(12, 9, 40)))
"""Made in a tenth of the time of the map of a pad, with errors some ten times as large."""

GRIDS = (((48, 4), 1e-4, 2e-3), ((96, 8), 1e-5, 1e-3), ((192, 16), 2e-6, 5e-4))
"""Cells, and orders of magnitude of the error of a position, and of K and C."""

TURN_GRIDS = ((48, 4), (96, 8))
"""Those for states all round a turn."""

FINE, FINEST = (192, 16), (384, 32)
"""Cells of richer films."""


@dataclass(frozen=True, kw_only=True)
class LobedCandidate(FilmCandidate):
    """A film of pads that may answer for a bearing of fixed ones.

    Attributes
    ----------
    reaction : LobedBearing
        With this film.
    rich : LobedBearing
        With the richer one.
    """

    reaction: LobedBearing
    rich: LobedBearing

    @property
    def call_time(self) -> float:
        """About what a force with derivatives takes [s]."""
        film = self.reaction.film
        cells = math.prod(film.cells) if isinstance(film, PadGridFilm) else 0
        return len(self.reaction.lobes) * (CELL_TIME * cells or CALL_TIME)

    def on_grid(self, bearing: LobedBearing) -> bool:
        """Return whether the film of one of both bearings lives on a grid in two dimensions."""
        return isinstance(bearing.film, PadGridFilm)

    def wedge(self, position: Array) -> float:
        """Return the distance [m] from the center of curvature of the pad that has the least film."""
        c = self.reaction.clearance
        near = min(self.reaction.lobes, key=lambda lobe: float(lobe.least_film(position / c)))
        return float(np.hypot(*(position - c * np.array(near.center))))

    def rest_bound(self, at: Equilibrium, *, slopes: bool) -> float:
        """Return the bounds of the maps of all pads together in an equilibrium; infinite without maps."""
        film = self.reaction.film
        if not isinstance(film, PadMapFilm):
            return math.inf
        shares = [_PadShare(self.reaction, film, lobe, at) for lobe in self.reaction.lobes]
        if not slopes:
            return sum(share.force for share in shares) / math.hypot(*at.load)
        found = coefficients(self.reaction, at.position, at.speed)
        stiffness = sum(share.stiffness for share in shares) / np.abs(found.stiffness).max()
        return float(max(stiffness, sum(share.damping for share in shares) / np.abs(found.damping).max()))


class _PadShare:
    """What the bound of the map of one pad leaves open at rest: of its force [N], stiffness, damping.

    The bounds are relative to force and matrices, or to `FLOOR` of their largest values over all directions.
    """

    def __init__(self, bearing: LobedBearing, film: PadMapFilm, lobe: Lobe, at: Equilibrium) -> None:
        table = film.table(lobe.extent, bearing.slenderness)
        kernel, c, half = table.kernel(), bearing.clearance, 0.5 * at.speed
        cos, sin = math.cos(lobe.middle), math.sin(lobe.middle)
        e = np.array([[cos, sin], [-sin, cos]]) @ (at.position / c - np.array(lobe.center))
        w = half * np.array([e[1], -e[0]])
        speed = float(np.hypot(*w))
        angle = np.append(np.arctan2(w[1], w[0]), (np.arange(DIRECTIONS) + 0.5) * 2.0 * np.pi / DIRECTIONS)
        places = np.repeat(e[:, None], angle.size, axis=1)
        around = np.stack([np.cos(angle), np.sin(angle)])
        forces = speed * np.hypot(*kernel.force(places, around).values)
        # The slopes in the place are of degree one in the source, those in the source of degree zero.
        by_e, by_w = matrix_sizes(kernel.jacobian(places, around).values) * np.array([[speed], [1.0]])
        own, by_e, by_w = (max(each[0], FLOOR * each.max()) for each in (forces, by_e, by_w))
        least = float(lobe.least_film(at.position / c))
        open_force, open_slopes = (table.bound(least, slopes=each) for each in (False, True))
        scale = bearing.force_scale
        self.force = open_force * scale * own
        self.stiffness = open_slopes * scale / c * (by_e + abs(half) * by_w)
        self.damping = open_slopes * scale / c * by_w


def lobed_candidates(bearing: LobedBearing, *, fixed: bool) -> tuple[LobedCandidate, ...]:
    """Return the films that can answer for a bearing of fixed pads: maps that are there, grids, other maps.

    Parameters
    ----------
    bearing : LobedBearing
    fixed : bool
        Whether the scene names the film of the bearing, so that no other may answer.
    """
    if fixed:
        film = bearing.film
        fine = isinstance(film, PadGridFilm) and math.prod(film.cells) >= math.prod(FINE)
        return (_candidate(bearing, film, pad_film_name(film), FINEST if fine else FINE, 0.0, 0.0),)
    maps = _maps(bearing)
    ready = [film for film in maps if not film.makes_map]
    grids = [
        _candidate(
            bearing,
            PadGridFilm(cells=cells),
            f"2-D {cells[0]} x {cells[1]} extr.",
            FINEST if cells == FINE else FINE,
            *priors,
        )
        for cells, *priors in GRIDS
    ]
    return (*ready, *grids, *(film for film in maps if film.makes_map))


def few_forces(candidates: Sequence[LobedCandidate], *, fixed: bool) -> tuple[LobedCandidate, ...]:
    """Return the candidates for some equilibria: a map that must be made first costs more than any grid."""
    return tuple(film for film in candidates if fixed or not film.makes_map)


def many_forces(candidates: Sequence[LobedCandidate], *, fixed: bool) -> tuple[LobedCandidate, ...]:
    """Return the candidates for states all round a turn: the finest grid costs more than any map."""
    kept = [PadGridFilm(cells=cells) for cells in TURN_GRIDS]
    return tuple(
        film
        for film in candidates
        if fixed or isinstance(film.reaction.film, PadMapFilm) or film.reaction.film in kept
    )


def _maps(bearing: LobedBearing) -> list[LobedCandidate]:
    """Return the maps of the pads, a coarse one too where the fine one is to be made; or none."""
    extents = {lobe.extent for lobe in bearing.lobes}
    long_enough = SLENDERNESSES[0] <= bearing.slenderness <= SLENDERNESSES[1]
    if not long_enough or not EXTENTS[0] <= min(extents) <= max(extents) <= EXTENTS[1]:
        return []
    coarse = _candidate(bearing, COARSE_MAP, "coarse pad map", FINE, 1e-4, 1e-3)
    fine = _candidate(bearing, PadMapFilm(), "pad map", FINE, 1e-5, 5e-4)
    return [coarse, fine] if fine.makes_map else [fine]


def _candidate(
    bearing: LobedBearing,
    film: PadFilm,
    name: str,
    rich: tuple[int, int],
    position_prior: float,
    prior: float,
) -> LobedCandidate:
    making = 0.0
    if isinstance(film, PadMapFilm):
        extents = {lobe.extent for lobe in bearing.lobes}
        making = sum(film.making_time(extent, bearing.slenderness) for extent in extents)
    return LobedCandidate(
        name=name,
        reaction=replace(bearing, film=film),
        rich=replace(bearing, film=PadGridFilm(cells=rich)),
        rich_name=f"2-D {rich[0]} x {rich[1]} extr.",
        position_prior=position_prior,
        prior=prior,
        making=making,
    )
