"""Gram matrix of (1, 1 + cos gamma, sin gamma) over H^3, from the accurate one of two methods.

The closed form is exact and cheap; quadrature takes over where it cancels, so that integrals are right to
1e-10 and their slopes to 1e-9 up to chi = 0.9999.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....model import Array
from .elliptic import quadrature_gram
from .sommerfeld import closed_gram

CLOSED_FORM_LIMIT = 0.9
"""Eccentricity ratio above which the closed form cancels on an arc that misses the minimum film."""


class ArcGram(NamedTuple):
    """Gram matrix over an arc and its chi-derivative at a fixed arc, each of shape (B, 3, 3)."""

    gram: Array
    gram_chi: Array


def arc_gram(chi: Array, start: Array, end: Array) -> ArcGram:
    """Return the Gram matrix of (1, w, sin), w = 1 + cos gamma, over [start, end].

    Parameters
    ----------
    chi : ndarray, shape (B,) [1]
        Eccentricity ratio, 0 <= chi < 1.
    start, end : ndarray, shape (B,) [rad]
        Ends of the arc, measured from the line of maximum film.
    """
    gram, gram_chi = closed_gram(chi, start, end)
    to_minimum = np.mod(np.pi - start, 2.0 * np.pi)
    misses = (chi > CLOSED_FORM_LIMIT) & (to_minimum >= end - start)
    if np.any(misses):
        gram[misses], gram_chi[misses] = quadrature_gram(chi[misses], start[misses], end[misses])
    return ArcGram(gram, gram_chi)
