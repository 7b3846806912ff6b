"""Free arc of the first axial mode: where the film ends, to start the two-dimensional solution.

Finite volumes in the elliptic variable over one turn, cut where the source is largest, with u >= 0 imposed by
an active set (Hintermueller, Ito and Kunisch 2002), finite for the M-matrix at hand.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.linalg import solve_banded

from ....errors import ConvergenceError
from ....model import Array
from .potential_domain import Source, local_film

CELLS = 400
"""Cells over the full turn: the ends only start an iteration."""

SWEEPS = 100
"""Active sets tried before giving up; about ten are needed."""


def free_arc(source: Source) -> tuple[float, float]:
    """Return the ends of the first axial mode's film in the elliptic variable.

    Raises
    ------
    ConvergenceError
        If the active set does not settle.
    """
    cut = source.elliptic(source.turn + np.array([0.0, 2.0 * math.pi]))
    step = (cut[1] - cut[0]) / CELLS
    node = cut[0] + step * np.arange(1, CELLS)
    film, face = local_film(source, node), local_film(source, cut[0] + step * (np.arange(CELLS) + 0.5))
    link = face.around / step**2
    decay = (0.5 * math.pi) ** 2 * film.along
    drive = source.at(film.gamma) * film.rate
    u = _complementary(link, decay, drive)
    return _ends(node, u, drive / film.around, step)


def _complementary(link: Array, decay: Array, drive: Array) -> Array:
    """Return u >= 0 with A u + drive >= 0 and u (A u + drive) = 0."""
    diagonal = link[:-1] + link[1:] + decay
    off = link[1:-1]
    active = drive < 0.0
    for _ in range(SWEEPS):
        coupled = off * (active[:-1] & active[1:])
        bands = np.zeros((3, drive.size))
        bands[0, 1:], bands[1], bands[2, :-1] = -coupled, diagonal, -coupled
        u = solve_banded((1, 1), bands, np.where(active, -drive, 0.0), check_finite=False)
        excess = diagonal * u + drive
        excess[1:] -= off * u[:-1]
        excess[:-1] -= off * u[1:]
        updated = np.where(active, u > 0.0, excess < 0.0)
        if np.array_equal(updated, active):
            return np.asarray(u)
        active = updated
    raise ConvergenceError(f"the free arc's active set must settle within {SWEEPS} sweeps, got none")


def _ends(node: Array, u: Array, curvature: Array, step: float) -> tuple[float, float]:
    """Return the ends; there u grows as curvature distance^2/2."""
    film = np.flatnonzero(u > 0.0)
    reach = np.sqrt(2.0 * u[film[[0, -1]]] / np.maximum(curvature[film[[0, -1]]], 1e-300))
    reach = np.minimum(reach, step)
    return float(node[film[0]] - reach[0]), float(node[film[-1]] + reach[1])
