"""Gauss-Legendre nodes over a film's arc that resolve the minimum film at every eccentricity.

In the elliptic variable y, gamma = 2 am(y | m) with m = 2 chi/(1 + chi), the film thickness is
H = (1 + chi) dn^2(y | m). Its zeros sit a distance K' >= pi/2 from the real axis for every chi, so a fixed
number of nodes serves from chi = 0 to chi -> 1.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from scipy.special import ellipj, ellipkinc

from ....model import Array

GRAM_NODES = 72
"""Nodes for products of (1, w, sin), enough for 1e-10 up to chi = 0.9999."""


class FilmNodes(NamedTuple):
    """Quadrature nodes over an arc, each entry of shape (B, N); weight includes H^-3."""

    gamma: Array
    half_sine: Array
    half_cosine: Array
    cosine: Array
    film: Array
    weight: Array


def film_nodes(chi: Array, start: Array, end: Array, count: int) -> FilmNodes:
    """Return `count` nodes over [start, end], batch axis first.

    Parameters
    ----------
    chi, start, end : ndarray, shape (B,)
        Eccentricity ratio [1] and the ends of the arc [rad].
    count : int
        Number of nodes.
    """
    m = (2.0 * chi / (1.0 + chi))[:, None]
    y1, y2 = ellipkinc(0.5 * start, m[:, 0]), ellipkinc(0.5 * end, m[:, 0])
    abscissa, gauss = _gauss_legendre(count)
    half = 0.5 * (y2 - y1)[:, None]
    sn, cn, _, amplitude = ellipj(0.5 * (y1 + y2)[:, None] + half * abscissa, m)
    ratio = ((1.0 - chi) / (1.0 + chi))[:, None]
    dn2 = ratio + (1.0 - ratio) * cn**2
    film = (1.0 + chi)[:, None] * dn2
    weight = gauss * half * 2.0 * np.sqrt(dn2) / film**3
    return FilmNodes(2.0 * amplitude, sn, cn, 2.0 * cn**2 - 1.0, film, weight)


def quadrature_gram(chi: Array, start: Array, end: Array) -> tuple[Array, Array]:
    """Return the Gram matrix of (1, w, sin) and its chi-derivative by quadrature, each (B, 3, 3)."""
    nodes = film_nodes(chi, start, end, GRAM_NODES)
    w, sine = 2.0 * nodes.half_cosine**2, 2.0 * nodes.half_sine * nodes.half_cosine
    functions = np.stack([np.ones_like(w), w, sine], -1)
    weighted = functions * nodes.weight[..., None]
    sloped = weighted * (-3.0 * nodes.cosine / nodes.film)[..., None]
    transposed = functions.swapaxes(-1, -2)
    return transposed @ weighted, transposed @ sloped


@cache
def _gauss_legendre(count: int) -> tuple[Array, Array]:
    return np.polynomial.legendre.leggauss(count)
