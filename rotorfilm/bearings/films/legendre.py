"""Integrated Legendre polynomials on [-1, 1]: trial functions of the Ritz solutions for the pressure."""

from __future__ import annotations

from functools import cache

import numpy as np

from ...model import Array


@cache
def trial_functions(degree: int, count: int) -> tuple[Array, Array]:
    """Return `degree` functions that vanish at both ends, and their slopes, at `count` Gauss nodes.

    Returns
    -------
    values, slopes : ndarray, shape (count, degree)
    """
    x, _ = np.polynomial.legendre.leggauss(count)
    legendre = np.polynomial.legendre.legvander(x, degree + 1)
    k = np.arange(1, degree + 1)
    norm = np.sqrt(k + 0.5)
    integrated = norm * (legendre[:, 2:] - legendre[:, :-2]) / (2.0 * k + 1.0)
    return integrated, norm * legendre[:, 1:-1]


@cache
def gauss_weights(count: int) -> Array:
    """Return the Gauss weights, shape (count,)."""
    return np.polynomial.legendre.leggauss(count)[1]
