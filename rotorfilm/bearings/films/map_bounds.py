"""How far a map is off: force and derivatives against a finer film, at states that fill its range evenly."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...model import Array

MARGIN = 2.0
"""A bound is so many times the largest error among the states: of 200 others 1.2 times at most."""

BATCH = 8
"""States in a piece of work."""


def even_shares(count: int, dimensions: int) -> Array:
    """Return points, (dimensions, count), that fill the unit cube evenly.

    Steps of a sequence (Roberts 2018): 1/g, 1/g^2, ... with g^(dimensions + 1) = g + 1.
    """
    g = 1.0
    for _ in range(64):
        g = (1.0 + g) ** (1.0 / (dimensions + 1.0))
    return np.outer(g ** -np.arange(1.0, dimensions + 1.0), np.arange(1, count + 1)) % 1.0


def batches(e: Array, w: Array) -> Iterator[tuple[Array, Array]]:
    """Yield eccentricities and sources (2, n), a piece of work at a time."""
    for first in range(0, e.shape[1], BATCH):
        yield e[:, first : first + BATCH], w[:, first : first + BATCH]


def state_errors(
    force: Array,
    slopes: Array,
    exact: Array,
    exact_slopes: Array,
    least: tuple[Array | float, Array | float] = (0.0, 0.0),
) -> tuple[Array, Array]:
    """Return the errors of forces (2, n), and of K and C in (2, 4, n), the larger one, each (n,).

    Relative to the force, and to the largest entry of the matrix; to `least` of them, (n,) and (2, n), where
    they are below it.
    """
    own = np.hypot(*(force - exact)) / np.maximum(np.hypot(*exact), least[0])
    gaps, sizes = matrix_sizes(slopes - exact_slopes), matrix_sizes(exact_slopes)
    return own, (gaps / np.maximum(sizes, least[1])).max(axis=0)


def matrix_sizes(slopes: Array) -> Array:
    """Return the largest entries, (2, n), of d force/de and d force/dw in (2, 4, n)."""
    return np.asarray(np.abs(slopes).reshape(2, 2, 2, -1).max(axis=(0, 2)))
