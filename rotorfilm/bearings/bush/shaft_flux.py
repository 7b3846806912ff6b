"""Steady heat flow from a bush into an endless rotating shaft that the air cools outside the bush.

The mixed problem (2.7)-(2.8) of Evtushenko & Kovalenko (1993): temperature T_* on |z| < l of the shaft's
surface, dT/dr + (lambda/R_1) T = 0 outside. Without dimensions it has two numbers, `cooling` lambda =
kappa_1 R_1/lambda_1 (the Biot number of the shaft) and `stubbiness` mu = R_1/l. Both functions return the
mean flux under the bush, Q_1, in units of lambda_1 T_*/R_1.
"""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np
from scipy.special import i0e, i1e, jv

FUNCTIONS = 16
"""Chebyshev functions of the flux: Q_1 to 1e-8 for stubbiness .1 to 1."""

CUTOFF = 2000.0
"""Where the numerical part of the Galerkin integrals ends, in u/mu; the tail is added in closed form."""

PANEL_POINTS = 12
"""Gauss points on each half period of the Bessel functions."""

HALVINGS = 8
"""Halvings of the first panel towards zero."""

C1, C2, C3 = 38.37, 76.74, 11.45
"""Coefficients of the rational approximation of the kernel (2.11)."""


def exact_flux(cooling: float, stubbiness: float) -> float:
    """Return the mean flux into the shaft, from the mixed problem itself.

    The flux p(x) of (2.10) solves the integral equation (2.9), here with its true kernel
    K(u) = I_0(u)/(u I_1(u) + lambda I_0(u)); the source approximates the kernel. Galerkin's method with
    p = sum of a_n T_2n(x)/sqrt(1 - x^2) gives the matrix

        M_mn = (-1)^(m+n) int_0^inf K(mu v) mu J_2m(v) J_2n(v) dv

    because T_2n/sqrt(1 - x^2) has the cosine transform (-1)^n pi J_2n. The part 1/v of K(mu v) mu is
    integrated in closed form (zero for m != n, 1/(4 n), and ln 2 for the (0, 0) entry without exp(-v)/v), and
    so is the next part, (1/2 - lambda)/(mu v^2), beyond the cutoff.

    Parameters
    ----------
    cooling : float
        lambda = kappa_1 R_1/lambda_1, positive.
    stubbiness : float
        mu = R_1/l, positive.
    """
    nodes = _nodes()
    u = stubbiness * nodes.v
    kernel = stubbiness * i0e(u) / (u * i1e(u) + cooling * i0e(u))
    rest = (nodes.bessel * (nodes.weights * (kernel - 1.0 / nodes.v))) @ nodes.bessel.T
    rest[0, 0] += nodes.weights @ (np.exp(-nodes.v) / nodes.v) + math.log(2.0)
    rest += (0.5 - cooling) / (2.0 * math.pi * stubbiness * CUTOFF**2)
    index = np.arange(1, FUNCTIONS)
    rest[index, index] += 0.25 / index
    right = np.zeros(FUNCTIONS)
    right[0] = 1.0
    # p has the mean (pi/2) a_0, in units of lambda_1 T_*/l; the air would take kappa_1 T_* of it.
    return 0.5 * math.pi * stubbiness * float(np.linalg.solve(rest, right)[0]) - cooling


def approximate_flux(cooling: float, stubbiness: float) -> float:
    """Return the mean flux into the shaft by the closed form (2.12)-(2.13) of the source.

    It is .6 to 2.9 % high for lambda = .02 to .3 and mu = .1 to 1, because (2.11) replaces the kernel.

    Parameters
    ----------
    cooling, stubbiness : float
        As in `exact_flux`.
    """
    s = math.sqrt(C2 / C3)
    half = 0.5 * (C1 + cooling * C3)
    root = math.sqrt(half**2 - cooling * C2)
    zeta_1, zeta_2 = math.sqrt(half + root), math.sqrt(half - root)
    # cosh and sinh of s/mu, both divided by exp(s/mu): Lambda is divided by it too.
    decay = math.exp(-2.0 * s / stubbiness)
    cosh, sinh = 0.5 * (1.0 + decay), 0.5 * (1.0 - decay)
    scale = zeta_1 * zeta_2 * ((s**2 + zeta_1 * zeta_2) * cosh + (zeta_1 + zeta_2) * s * sinh)
    a_2 = -cooling * (zeta_1**2 - s**2) * (zeta_2**2 - s**2) / scale
    a_3 = cooling * (1.0 / zeta_1 - (zeta_2**2 - s**2) * (zeta_1 * cosh + s * sinh) / scale)
    return stubbiness * (a_2 * sinh / s + a_3)


class _Nodes(NamedTuple):
    """Gauss nodes v and weights on [0, CUTOFF], and (-1)^n J_2n(v), shape (FUNCTIONS, nodes)."""

    v: np.ndarray
    weights: np.ndarray
    bessel: np.ndarray


@cache
def _nodes() -> _Nodes:
    points, weights = np.polynomial.legendre.leggauss(PANEL_POINTS)
    # Halved towards zero: the kernel has poles at u = +-i sqrt(2 lambda), close to zero for little cooling.
    halves = math.pi * 0.5 ** np.arange(HALVINGS, 0, -1)
    edges = np.concatenate([[0.0], halves, np.linspace(math.pi, CUTOFF, round(CUTOFF / math.pi))])
    width = np.diff(edges)[:, None]
    v = (edges[:-1, None] + 0.5 * width * (1.0 + points)).ravel()
    orders = np.arange(FUNCTIONS)[:, None]
    bessel = (-1.0) ** orders * jv(2 * orders, v)
    return _Nodes(v, (0.5 * width * weights).ravel(), bessel)
