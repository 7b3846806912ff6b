"""The films that may answer for a bearing of pads with recesses: grids of ever more cells."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ...bearings.pads import PressureDamBearing
from ...model import Array
from ..journal.film_candidate import CELL_TIME, FilmCandidate
from .dam_table import dam_film_name

LEVELS = (((32, 8), 2e-4, 5e-3), ((64, 16), 5e-5, 1e-3), ((128, 32), 5e-6, 5e-4))
"""Cells, and orders of magnitude of the error of a position, and of K and C."""

FINE, FINEST = (128, 32), (256, 64)
"""Cells of richer films."""


@dataclass(frozen=True, kw_only=True)
class DamCandidate(FilmCandidate):
    """A film on so many cells that may answer for a bearing of pads with recesses.

    Attributes
    ----------
    reaction : PressureDamBearing
        With these cells.
    rich : PressureDamBearing
        With more.
    """

    reaction: PressureDamBearing
    rich: PressureDamBearing

    @property
    def call_time(self) -> float:
        """About what a force with derivatives takes [s]."""
        return len(self.reaction.pads) * CELL_TIME * math.prod(self.reaction.cells)

    def on_grid(self, bearing: PressureDamBearing) -> bool:
        """Return that the films of both bearings live on grids in two dimensions."""
        return True

    def wedge(self, position: Array) -> float:
        """Return the distance [m] from the farthest center of curvature."""
        c, pads = self.reaction.clearance, self.reaction.pads
        return float(max(np.hypot(*(position - c * np.array(pad.center))) for pad in pads))


def dam_candidates(
    bearing: PressureDamBearing, *, fixed: bool, turns: bool = False
) -> tuple[DamCandidate, ...]:
    """Return the cells that can answer for a bearing of pads with recesses, the fewest first.

    Parameters
    ----------
    bearing : PressureDamBearing
    fixed : bool
        Whether the scene names the cells.
    turns : bool
        Whether they are for states all round a turn, which are too many for the most cells.
    """
    if fixed:
        return (_candidate(bearing, FINEST, 0.0, 0.0),)
    levels = LEVELS[:-1] if turns else LEVELS
    return tuple(
        _candidate(replace(bearing, cells=cells), FINE if turns or not k else FINEST, *priors)
        for k, (cells, *priors) in enumerate(levels)
    )


def _candidate(
    bearing: PressureDamBearing, cells: tuple[int, int], position_prior: float, prior: float
) -> DamCandidate:
    rich = replace(bearing, cells=cells)
    return DamCandidate(
        name=dam_film_name(bearing),
        reaction=bearing,
        rich=rich,
        rich_name=dam_film_name(rich),
        position_prior=position_prior,
        prior=prior,
    )
