"""The table of a film whose law in polar axes depends on the eccentricity ratio alone, for the C library."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ...core.model import Array

NODES = 64
"""Of Chebyshev over atanh(chi): the functions then agree with those of an analytic law within 1e-11."""


def polar_tables(
    jacobian: Callable[[Array, Array], Array], largest: float, slenderness: float
) -> dict[str, Array]:
    """Return the tables of `native/films/polar_film.h`.

    F = -A(chi) w - lift(chi) e in the axes e_t and e_r. With the journal on the x axis and w = 0, A and
    lift are entries of the derivative. Times (1 - chi^2)^(3/2) they are smooth over atanh(chi), also near
    the wall.

    Parameters
    ----------
    jacobian : callable
        The derivatives d force / d (eccentricity, source), shape (2, 4, n), at eccentricities and sources
        (2, n).
    largest : float [1]
        Eccentricity ratio at which the table ends.
    slenderness : float [1]
        Length / diameter for which it holds.
    """
    nodes, last = np.polynomial.chebyshev.chebpts1(NODES), math.atanh(largest)
    chi = np.tanh(0.5 * last * (nodes + 1.0))
    slopes = jacobian(np.stack([chi, np.zeros(NODES)]), np.zeros((2, NODES)))
    functions = -np.stack([slopes[1, 3], slopes[1, 2], slopes[0, 3], slopes[0, 2], slopes[1, 1]], axis=1)
    smooth = functions * ((1.0 - chi) * (1.0 + chi))[:, None] ** 1.5
    table = np.polynomial.chebyshev.chebfit(nodes, smooth, NODES - 1)
    return {"polar": table, "reach": np.array([largest, slenderness])}
