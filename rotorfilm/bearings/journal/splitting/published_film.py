"""First and second approximation for the film [0, pi] in the closed form of Sussi & Fridman (1978).

The formulas are the paper's with its misprints corrected (docs/journal.md lists them); they equal
`SplittingFilm(order=(1, 1))` and `SplittingFilm(order=(2, m))` on `FixedArc()`. Forces are in units of
viscosity * length * radius^3 / clearance^2 with rates and speed in rad/s; alpha = pi R/b = (pi/2)/(L/D).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ....model import Array
from .axial_sums import axial_sum


def load_function(chi: ArrayLike, slenderness: float) -> Array:
    """Return f(chi), the static radial force of the first approximation per speed [1], negative.

    Sussi & Fridman (1978), last display before (38). The print multiplies by the bracket that divides.
    """
    chi = np.asarray(chi, dtype=float)
    alpha2 = (0.5 * math.pi / slenderness) ** 2
    s2 = (1.0 - chi) * (1.0 + chi)
    return -96.0 / math.pi**2 * chi**2 / (s2 * (2.0 + chi**2 + 2.0 * alpha2 * s2))


def first_approximation(
    chi: ArrayLike, chi_rate: ArrayLike, phi_rate: ArrayLike, speed: ArrayLike, slenderness: float
) -> tuple[Array, Array]:
    """Return the radial and tangential force P1*, P2* on the journal (order (1, 1), film [0, pi]).

    Parameters
    ----------
    chi : array_like, shape (...) [1]
        Eccentricity ratio, 0 < chi < 1.
    chi_rate, phi_rate : array_like, shape (...) [1/s]
        Rates of the eccentricity ratio and of the attitude angle.
    speed : array_like, shape (...) [rad/s]
        Angular speed of the journal.
    slenderness : float [1]
        Length / diameter.

    Returns
    -------
    radial, tangential : ndarray, shape (...) [viscosity length radius^3 / clearance^2]
        Outward along the line of centers, and 90 degrees ahead.
    """
    chi = np.asarray(chi, dtype=float)
    s = np.sqrt((1.0 - chi) * (1.0 + chi))
    drive = np.asarray(speed) - 2.0 * np.asarray(phi_rate) + 8.0 / math.pi * np.asarray(chi_rate) / s
    radial = load_function(chi, slenderness) * drive
    return radial, -0.5 * math.pi * s / chi * radial


def first_approximation_slopes(chi: ArrayLike, slenderness: float) -> tuple[Array, Array]:
    """Return c11* = dP1*/dchi and c21* = dP2*/dchi of the static first approximation, per speed [1].

    The printed c11* is too small by the factor 2 alpha^2; c21* lost the term d(s/chi)/dchi.
    """
    chi = np.asarray(chi, dtype=float)
    f = load_function(chi, slenderness)
    alpha2 = (0.5 * math.pi / slenderness) ** 2
    s = np.sqrt((1.0 - chi) * (1.0 + chi))
    c11 = -(math.pi**2) / 48.0 * f**2 / chi**3 * (2.0 * alpha2 * (1.0 - chi**4) + 2.0 + chi**4)
    c21 = -0.5 * math.pi * s / chi * c11 + 0.5 * math.pi * f / (chi**2 * s)
    return c11, c21


def second_approximation(chi: float, g_s: float, g_c: float, slenderness: float, modes: int | None) -> Array:
    """Return (radial, tangential) force of order (2, modes) for the film [0, pi], shape (2,).

    Parameters
    ----------
    chi : float [1]
        Eccentricity ratio, 0 <= chi < 1.
    g_s, g_c : float [1/s]
        chi (phi_rate - speed/2) and chi_rate.
    slenderness : float [1]
        Length / diameter.
    modes : int or None
        Number of odd axial modes; None sums all of them.

    Notes
    -----
    (F_t, F_r) = -sum_j 96/(pi j)^2 (K^-1 + (j alpha)^2 M^-1)^-1 (g_s, g_c): the harmonic sum of the long
    bearing (K) and the short bearing (M), exact in both limits.
    """
    K, M = _half_circle_matrices(chi)
    # Symmetric matrices, one definite: real, though numpy 2.5 says so by complex numbers.
    ratio, vectors = (part.real for part in np.linalg.eig(np.linalg.solve(M, K)))
    phi = axial_sum(modes, slenderness).value(ratio.real)
    tangential, radial = -M @ (vectors * phi) @ np.linalg.solve(vectors, np.array([g_s, g_c]))
    return np.array([radial, tangential])


def _half_circle_matrices(chi: float) -> tuple[Array, Array]:
    """Return K and M of (sin, cos) over [0, pi]."""
    s2 = (1.0 - chi) * (1.0 + chi)
    s, q = math.sqrt(s2), 2.0 + chi**2
    K_sc, M_sc = -2.0 * chi / (s2 * q), -2.0 * chi / s2**2
    K = np.array([[math.pi / (s * q), K_sc], [K_sc, (0.5 * math.pi - 8.0 / (math.pi * q)) / s**3]])
    M = np.array([[0.5 * math.pi / s**3, M_sc], [M_sc, 0.5 * math.pi * (1.0 + 2.0 * chi**2) / s**5]])
    return K, M
