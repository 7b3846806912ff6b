"""How far the map of a pad is off: bounds from a film on finer grids at states all over its range.

Errors of the force are relative to it, those of K and C to the largest entry of the matrix; where these are
below 5 % of their largest value over the directions of the source at that place, relative to those 5 %:
towards the edge beyond which a source drives no film all of them vanish. The states fill the coordinates of
the map evenly.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...model import Array
from ..films.map_bounds import MARGIN, even_shares, matrix_sizes, state_errors
from .pad_table import PadMapTable, least_film, wall

LEAST_FILMS = (0.3, 0.1, 0.03, 0.0)
"""Least film / clearance from which a bound holds; the last one in the range of the map."""

STATES = 320

FLOOR = 0.05
"""Of the largest value over all directions of the source."""

DIRECTIONS = 32


class PadStates(NamedTuple):
    """States at which a map is compared with a finer film.

    Attributes
    ----------
    e, w : ndarray, shape (2, n)
    phi : ndarray, shape (n,) [rad]
        Angle of w.
    """

    e: Array
    w: Array
    phi: Array


def pad_states(extent: float, u_range: tuple[float, float], y_end: float, count: int = STATES) -> PadStates:
    """Return states that fill the range of a map evenly."""
    first, last = u_range
    shares = even_shares(count, 3)
    xi = -np.expm1(-(first + (last - first) * shares[0]))
    e = np.stack([xi, np.tanh((2.0 * shares[1] - 1.0) * y_end) * wall(xi, extent)])
    phi = (shares[2] - 0.5) * (np.pi + extent)
    return PadStates(e, np.stack([np.cos(phi), np.sin(phi)]), phi)


def pad_errors(table: PadMapTable, states: PadStates, exact: Array) -> tuple[Array, Array]:
    """Return the errors of the force, and of K and C, (n,) each, of a map.

    Parameters
    ----------
    table : PadMapTable
    states : PadStates
    exact : ndarray, shape (10, n)
        Force and derivatives at the states.
    """
    kernel, e = table.kernel(), states.e
    phi = (np.arange(DIRECTIONS) + 0.5 - 0.5 * DIRECTIONS) * (np.pi + table.extent) / DIRECTIONS
    around = np.tile([np.cos(phi), np.sin(phi)], e.shape[1])
    places = np.repeat(e, DIRECTIONS, axis=1)
    forces = np.hypot(*kernel.force(places, around).values).reshape(-1, DIRECTIONS)
    matrices = matrix_sizes(kernel.jacobian(places, around).values).reshape(2, -1, DIRECTIONS)
    least = FLOOR * forces.max(axis=1), FLOOR * matrices.max(axis=2)
    found = kernel.force(e, states.w).values, kernel.jacobian(e, states.w).values
    return state_errors(*found, exact[:2], exact[2:].reshape(2, 4, -1), least)


def pad_bounds(table: PadMapTable, states: PadStates, exact: Array) -> Array:
    """Return the bounds of a map; see `PadMapTable` and, for the arguments, `pad_errors`."""
    film = least_film(states.e, table.extent)
    errors = np.stack(pad_errors(table, states, exact))
    worst = [MARGIN * errors[:, film >= limit].max(axis=1, initial=0.0) for limit in LEAST_FILMS]
    return np.column_stack([LEAST_FILMS, worst])
