"""How far the map of a pad is off: bounds from a film on finer grids at states all over its range.

Errors of the force are relative to it, those of K and C to the largest entry of the matrix; where these are
below 5 % of their largest value over the directions of the source at that place, relative to those 5 %:
towards the edge beyond which a source drives no film all of them vanish. The states fill the coordinates of
the map evenly. Those of shear and flow are at rest and fill the places.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...model import Array
from ..films.geometry import TURN
from ..films.map_bounds import MARGIN, even_shares, matrix_sizes, state_errors
from .pad_losses import LARGEST, loss_reach
from .pad_table import PadMapTable, least_film, wall

LEAST_FILMS = (0.3, 0.1, 0.03, 0.0)
"""Least film / clearance from which a bound holds; the last one in the range of the map."""

STATES = 320

LOSS_STATES = 96
"""Of a journal at rest, for shear and flow."""

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


def loss_states(extent: float, count: int = LOSS_STATES) -> tuple[Array, Array]:
    """Return eccentricities (2, n), and rates of both senses (n,) [1/s], that fill the maps of losses."""
    shares = even_shares(count, 2)
    theta = TURN * shares[1]
    chi = LARGEST * np.sqrt(shares[0]) * loss_reach(theta, extent)[0]
    rate = np.where(np.arange(count) % 2, -1.0, 1.0)
    return np.stack([chi * np.cos(theta), chi * np.sin(theta)]), rate


def loss_errors_of_pad(table: PadMapTable, e: Array, rate: Array, exact: Array) -> Array:
    """Return the errors of shear and of flows of a map, (2, n), at states as of `loss_states`.

    Parameters
    ----------
    table : PadMapTable
    e, rate : ndarray
    exact : ndarray, shape (3, n)
        What `pad_losses.grid_losses` returns of them.
    """
    found = np.stack(table.loss_map().at(e, rate)[:3])
    shear, *flows = np.abs(found - exact)
    return np.stack([shear / exact[0], np.max(flows, axis=0)])


def pad_bounds(table: PadMapTable, states: PadStates, exact: Array, exact_losses: Array) -> Array:
    """Return the bounds of a map; see `PadMapTable` and, for the arguments, `pad_errors`."""
    e, rate = loss_states(table.extent)
    parts = (
        (states.e, np.stack(pad_errors(table, states, exact))),
        (e, loss_errors_of_pad(table, e, rate, exact_losses)),
    )
    return np.column_stack([LEAST_FILMS, *(_worst(least_film(at, table.extent), own) for at, own in parts)])


def _worst(film: Array, errors: Array) -> Array:
    """Return the bounds of errors (k, n) in each band of the least film, (BANDS, k)."""
    return np.array([MARGIN * errors[:, film >= limit].max(axis=1, initial=0.0) for limit in LEAST_FILMS])
