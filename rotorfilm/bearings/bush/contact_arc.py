"""Contact of a rigid shaft with a thin elastic liner: angle, settlement and pressure, without dimensions.

Evtushenko & Kovalenko (1993), section 2. Lengths are in units of the liner radius R, pressures in the shear
modulus G; alpha is half the contact angle [rad] and 0 <= alpha < pi/2. The liner thinner than its radius acts
as a Winkler foundation, a_1 q = u, with a_1 = ln(R_2/R) (1 - 2 nu)/(2 (1 - nu)) (1.13).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ...core.model import Array

SERIES_LIMIT = 0.5
"""Angle [rad] below which differences of nearly equal terms are summed as power series."""

SERIES_TERMS = 9
"""Terms of these series: the next one is below 1e-17 of the first at the limit."""

SEGMENT_SERIES = tuple((-4.0) ** k * 4.0 / math.factorial(2 * k + 3) for k in range(SERIES_TERMS))
"""Coefficients of (2 a - sin(2 a))/2 by odd powers of a, from the third."""

MOMENT_SERIES = tuple((-1.0) ** k * (2 * k + 2) / math.factorial(2 * k + 3) for k in range(SERIES_TERMS))
"""Coefficients of sin(a) - a cos(a) by odd powers of a, from the third."""

MAX_ITERATIONS = 60
"""Newton steps after which the inverse of F stops; it takes 5 to 10."""


def segment(alpha: ArrayLike) -> Array:
    """Return alpha - sin(2 alpha)/2, the area of a circular segment, without cancellation."""
    a = np.asarray(alpha, dtype=float)
    return np.where(a < SERIES_LIMIT, _series(a, SEGMENT_SERIES), a - 0.5 * np.sin(2.0 * a))


def moment(alpha: ArrayLike) -> Array:
    """Return sin(alpha) - alpha cos(alpha), without cancellation."""
    a = np.asarray(alpha, dtype=float)
    return np.where(a < SERIES_LIMIT, _series(a, MOMENT_SERIES), np.sin(a) - a * np.cos(a))


def arc_function(alpha: ArrayLike) -> Array:
    """Return F(alpha) = (alpha - sin(2 alpha)/2)/cos(alpha): load on an unworn liner per clearance (2.17)."""
    return segment(alpha) / np.cos(alpha)


def arc_slope(alpha: ArrayLike) -> Array:
    """Return dF/dalpha = (2 sin^2(alpha) + F sin(alpha))/cos(alpha)."""
    return np.sin(alpha) * (2.0 * np.sin(alpha) + arc_function(alpha)) / np.cos(alpha)


def arc_angle(value: ArrayLike) -> Array:
    """Return the angle alpha in [0, pi/2) at which F(alpha) = value >= 0.

    g(alpha) = segment - value cos(alpha) is convex and rising, and F exceeds (2/3) alpha^3, so Newton's
    iterates fall monotonically from the start (3/2 value)^(1/3) to the root.
    """
    y = np.asarray(value, dtype=float)
    alpha = np.minimum(np.cbrt(1.5 * y), 0.5 * math.pi)
    for _ in range(MAX_ITERATIONS):
        slope = np.sin(alpha) * (2.0 * np.sin(alpha) + y)
        step = (segment(alpha) - y * np.cos(alpha)) / np.where(slope > 0.0, slope, 1.0)
        alpha = alpha - step
        if np.all(np.abs(step) <= 4.0 * np.spacing(alpha)):
            break
    return alpha


def mean_weight(alpha: ArrayLike) -> Array:
    """Return w(alpha) > 0 of the mean pressure over the contact, qbar = N w (2.15).

    For the pressure (2.14), q proportional to cos(phi) - cos(alpha); N is the load per shaft radius and G.
    """
    return moment(alpha) / (np.asarray(alpha, dtype=float) * segment(alpha))


def mean_weight_slope(alpha: ArrayLike) -> Array:
    """Return dw/dalpha of `mean_weight`."""
    a = np.asarray(alpha, dtype=float)
    sin = np.sin(a)
    logarithmic = a * sin / moment(a) - 1.0 / a - 2.0 * sin**2 / segment(a)
    return mean_weight(a) * logarithmic


def peak_weight(alpha: ArrayLike) -> Array:
    """Return the factor p of the maximum pressure, q_max = N p, for the pressure (2.14)."""
    return 2.0 * np.sin(0.5 * np.asarray(alpha, dtype=float)) ** 2 / segment(alpha)


def peak_weight_slope(alpha: ArrayLike) -> Array:
    """Return dp/dalpha of `peak_weight`."""
    sin = np.sin(alpha)
    return (sin - 2.0 * sin**2 * peak_weight(alpha)) / segment(alpha)


def sinc(alpha: ArrayLike) -> Array:
    """Return sin(alpha)/alpha, the mean of cos(phi) over the contact."""
    return np.sinc(np.asarray(alpha, dtype=float) / math.pi)


def sinc_slope(alpha: ArrayLike) -> Array:
    """Return d(sin(alpha)/alpha)/dalpha = -(sin(alpha) - alpha cos(alpha))/alpha^2."""
    a = np.asarray(alpha, dtype=float)
    safe = np.where(a > 0.0, a, 1.0)
    return -moment(a) / safe**2


def _series(a: Array, coefficients: tuple[float, ...]) -> Array:
    """Return a^3 times the polynomial in a^2 with these coefficients."""
    # One number goes through the loop as a float, ten times faster than as an array.
    square = float(a) ** 2 if a.ndim == 0 else a * a
    total = 0.0 * square
    for coefficient in reversed(coefficients):
        total = total * square + coefficient
    return total * a**3
