"""Nodes of the map of a pad: where they lie, and values between them from the slopes of the potential.

A film that is solved has the slopes of its potential by the place of the journal for next to nothing, as
its pressure minimizes it. They are worth a node more between every two.
"""

from __future__ import annotations

import numpy as np

from ...model import Array
from .pad_table import wall

NEAR = 4
"""Nodes whose values and slopes make a value between two: exact for polynomials of degree 7."""


def node_angles(extent: float, count: int) -> Array:
    """Return the angles of the source of the nodes, (count,) [rad]: the middles of equal parts."""
    return (np.arange(count) + 0.5 - 0.5 * count) * (np.pi + extent) / count


def node_places(extent: float, xi: Array, share: Array) -> Array:
    """Return the eccentricities, shape (2, n, m), at n xi, and m shares of the way to the wall."""
    return np.stack([np.repeat(xi[:, None], len(share), axis=1), wall(xi, extent)[:, None] * share])


def along_nodes(by_e: Array, extent: float, xi: Array, share: Array) -> Array:
    """Return derivatives by u and Y, (2, n, m, ...), of what has these by e, at places of `node_places`."""
    b, more = 0.5 * extent, (1,) * (by_e.ndim - 3)
    end = wall(xi, extent)
    bent = np.where(xi > np.cos(b), -xi / end, -1.0 / np.tan(b))
    by_xi, by_eta = by_e
    by_u = (1.0 - xi).reshape(-1, 1, *more) * (
        by_xi + np.outer(bent, share).reshape(*by_xi.shape[:2], *more) * by_eta
    )
    return np.stack([by_u, np.outer(end, 1.0 - share**2).reshape(*by_xi.shape[:2], *more) * by_eta])


def between_nodes(values: Array, slopes: Array, step: float) -> Array:
    """Return values at n equally spaced nodes and in the middle between them, (2 n - 1, ...).

    Parameters
    ----------
    values, slopes : ndarray, shape (n, ...)
        Slopes by what the nodes are `step` apart in; n at least `NEAR`.
    step : float
    """
    n = len(values)
    found = np.empty((2 * n - 1, *values.shape[1:]))
    found[::2] = values
    for k in range(n - 1):
        first = min(max(k - 1, 0), n - NEAR)
        near = slice(first, first + NEAR)
        of_values, of_slopes = _middle(k + 0.5 - first)
        found[2 * k + 1] = np.tensordot(of_values, values[near], 1)
        found[2 * k + 1] += step * np.tensordot(of_slopes, slopes[near], 1)
    return found


def _middle(at: float) -> tuple[Array, Array]:
    """Return the weights of values and slopes at the nodes 0, 1, ... for the value at a place among them."""
    center = 0.5 * (NEAR - 1)
    place, power = np.arange(NEAR) - center, np.arange(2 * NEAR)[:, None]
    slopes = power * place ** np.maximum(power - 1, 0)
    weights = np.linalg.solve(np.hstack([place**power, slopes]), (at - center) ** power[:, 0])
    return weights[:NEAR], weights[NEAR:]
