"""Closed arc integrals of the products of (1, 1 + cos gamma, sin gamma) over H^3.

The Sommerfeld substitution H = 1 + chi cos gamma = s^2/(1 - chi cos zeta), s = sqrt(1 - chi^2), turns

    <f_a f_b> = int f_a f_b H^-3 dgamma,   f = (1, w, sin gamma),   w = 1 + cos gamma

into polynomials of degree two in (cos zeta, sin zeta), and their derivatives with respect to chi into
polynomials of degree three. Nothing cancels as chi -> 0, nor as chi -> 1 on an arc through the minimum film.
(Sussi & Fridman 1978 give the same integrals as a table reference, I_n^{lm}.)
"""

from __future__ import annotations

import numpy as np

from ....model import Array


def sommerfeld_angle(chi: Array, gamma: Array) -> Array:
    """Return zeta of gamma, continuous over any number of turns [rad]."""
    beta = chi / (1.0 + np.sqrt((1.0 - chi) * (1.0 + chi)))
    return gamma - 2.0 * np.arctan2(beta * np.sin(gamma), 1.0 + beta * np.cos(gamma))


def closed_gram(chi: Array, start: Array, end: Array) -> tuple[Array, Array]:
    """Return the Gram matrix of (1, w, sin) with weight H^-3 over [start, end] and its chi-derivative.

    Parameters
    ----------
    chi : ndarray, shape (B,) [1]
        Eccentricity ratio, 0 <= chi < 1.
    start, end : ndarray, shape (B,) [rad]
        Ends of the arc, measured from the line of maximum film.

    Returns
    -------
    gram, gram_chi : ndarray, shape (B, 3, 3)
    """
    powers = _trigonometric_integrals(sommerfeld_angle(chi, start), sommerfeld_angle(chi, end))
    s2 = (1.0 - chi) * (1.0 + chi)
    functions = np.zeros((chi.size, 3, 3))
    functions[:, 0, 0], functions[:, 0, 1] = 1.0, -chi
    functions[:, 1, 0] = functions[:, 1, 1] = 1.0 - chi
    functions[:, 2, 2] = np.sqrt(s2)
    second = _products(powers, (0, 0))
    third = _products(powers, (1, 0)) - chi[:, None, None] * second
    gram = functions @ second @ functions.swapaxes(-1, -2) * (s2**-2.5)[:, None, None]
    slope = functions @ third @ functions.swapaxes(-1, -2) * (-3.0 * s2**-3.5)[:, None, None]
    return gram, slope


def _products(powers: dict[tuple[int, int], Array], extra: tuple[int, int]) -> Array:
    """Return int (1, c, s)^T (1, c, s) c^i s^j dzeta for (i, j) = extra, shape (B, 3, 3)."""
    basis = ((0, 0), (1, 0), (0, 1))
    products = np.empty((powers[0, 0].size, 3, 3))
    for row, a in enumerate(basis):
        for column, b in enumerate(basis):
            products[:, row, column] = powers[a[0] + b[0] + extra[0], a[1] + b[1] + extra[1]]
    return products


def _trigonometric_integrals(start: Array, end: Array) -> dict[tuple[int, int], Array]:
    """Return int cos^i sin^j dzeta for i + j <= 3 by their antiderivatives, keyed (i, j)."""
    width = end - start
    cos1, sin1, cos2, sin2 = np.cos(start), np.sin(start), np.cos(end), np.sin(end)
    d_cos, d_sin = cos2 - cos1, sin2 - sin1
    d_cos3, d_sin3 = cos2**3 - cos1**3, sin2**3 - sin1**3
    d_sincos = sin2 * cos2 - sin1 * cos1
    return {
        (0, 0): width,
        (1, 0): d_sin,
        (0, 1): -d_cos,
        (2, 0): 0.5 * (width + d_sincos),
        (0, 2): 0.5 * (width - d_sincos),
        (1, 1): 0.5 * (sin2**2 - sin1**2),
        (3, 0): d_sin - d_sin3 / 3.0,
        (2, 1): -d_cos3 / 3.0,
        (1, 2): d_sin3 / 3.0,
        (0, 3): d_cos3 / 3.0 - d_cos,
    }
