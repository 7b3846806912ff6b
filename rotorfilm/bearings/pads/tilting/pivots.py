"""Where the pivots of tilting pads lie, and how much room they leave."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ....errors import require_count, require_number
from ....inputs.kinds import arguments
from ....model import Array

OPEN = 4.0
"""Assembled clearances that a journal is looked for within, where pads do not surround it."""


@arguments
def even_pivots(
    pads: int, *, between_pads: bool = False, load_direction: float = -0.5 * math.pi
) -> tuple[float, ...]:
    """Return the angles of evenly spaced pivots, the first the one that the load points to [rad].

    Parameters
    ----------
    pads : int
        Number of pads, at least 2.
    between_pads : bool
        Whether the load points between two pivots, and the first is the next in the positive sense.
    load_direction : float [rad]
        Angle of the load from +x towards +y; -pi/2 is down.
    """
    require_count("pads", pads, 2)
    first = require_number("load_direction", load_direction)
    pitch = 2.0 * math.pi / pads
    return tuple(first + (k + 0.5 * between_pads) * pitch for k in range(pads))


def reach(pivots: Sequence[float]) -> float:
    """Return how far a journal may go where each pivot lets it go to 1: the farthest corner, at most `OPEN`.

    Parameters
    ----------
    pivots : sequence of float [rad]
    """
    widest = float(np.max(gaps(pivots)))
    return min(OPEN, 1.0 / math.cos(0.5 * widest)) if widest < math.pi else OPEN


def gaps(pivots: ArrayLike) -> Array:
    """Return the angles between neighbors all around, shape (pads,) [rad]."""
    angles = np.sort(np.mod(pivots, 2.0 * math.pi))
    return np.diff(angles, append=angles[0] + 2.0 * math.pi)


def directions(pivots: Sequence[float]) -> Array:
    """Return n and t of each pivot as the columns of a matrix, shape (pads, 2, 2)."""
    c, s = np.cos(pivots), np.sin(pivots)
    return np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=1)
