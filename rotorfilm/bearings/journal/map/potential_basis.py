"""Trial functions of a film on a mapped rectangle: circumferential xi in [-1, 1], axial zeta in [0, 1].

zeta = 2 |z|/length runs from the middle plane to the end of the bearing, where the pressure vanishes; the
film is even in z. Both directions use integrated Legendre polynomials, which vanish at the edges.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np

from ....model import Array

EXTRA_AROUND = 16
"""Circumferential quadrature nodes beyond the trial functions: the coefficients are not polynomials."""

EXTRA_ALONG = 6
"""Axial quadrature nodes beyond the number of trial functions."""


class Line(NamedTuple):
    """Trial functions of one direction at its Gauss nodes.

    Attributes
    ----------
    node, weight : ndarray, shape (Q,)
    value, slope : ndarray, shape (Q, N)
    """

    node: Array
    weight: Array
    value: Array
    slope: Array


@cache
def around(count: int) -> Line:
    """Return `count` functions of xi that vanish at xi = -1 and 1."""
    x, weight = np.polynomial.legendre.leggauss(count + EXTRA_AROUND)
    return Line(x, weight, *_integrated_legendre(x, count))


@cache
def along(count: int) -> Line:
    """Return `count` even functions of zeta that vanish at zeta = 1, on [0, 1]."""
    x, weight = np.polynomial.legendre.leggauss(2 * (count + EXTRA_ALONG))
    upper = x > 0.0
    value, slope = _integrated_legendre(x[upper], 2 * count - 1)
    return Line(x[upper], weight[upper], value[:, ::2], slope[:, ::2])


@cache
def end_slopes(count: int) -> Array:
    """Return the inward slopes of the functions of xi at xi = -1 and 1, shape (2, N)."""
    _, slope = _integrated_legendre(np.array([-1.0, 1.0]), count)
    return slope * np.array([[1.0], [-1.0]])


@cache
def end_shapes(along_count: int, shapes: int) -> tuple[Array, Array]:
    """Return even Legendre polynomials of zeta and their slopes at the axial nodes, each (Q, S)."""
    x = along(along_count).node
    polynomial = np.polynomial.legendre
    slopes = [polynomial.legval(x, polynomial.legder(row)) for row in np.eye(2 * shapes - 1)[::2]]
    values = polynomial.legvander(x, 2 * shapes - 2)[:, ::2]
    return np.asarray(values, dtype=float), np.asarray(np.stack(slopes, -1), dtype=float)


def _integrated_legendre(x: Array, count: int) -> tuple[Array, Array]:
    legendre = np.polynomial.legendre.legvander(x, count + 1)
    k = np.arange(1.0, count + 1.0)
    norm = np.asarray(np.sqrt(k + 0.5))
    value = np.asarray(norm * (legendre[:, 2:] - legendre[:, :-2]) / (2.0 * k + 1.0), dtype=float)
    return value, np.asarray(norm * legendre[:, 1:-1], dtype=float)
