"""Finite-volume coefficients of the Reynolds equation on a ring, and their derivatives in the eccentricity.

The film is (H^3 P_theta)_theta + (L/D)^-2 H^3 P_zz = -w.n with H = 1 - e.n, n = (cos theta, sin theta), z
from the middle, 0, to the end, 1, of the bearing, and p = 12 viscosity (R/c)^2 P. Integrated over the cells
of line i it needs one number per line or face of the ring: `around` = H^3/(distance) at a face, `along` =
(L/D)^-2 H^3 (width) at a line, and `normal` = integral of n over the cell, exactly.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..model import Array
from .compiled import compiled
from .ring import Grid, Spans

CROWDING = 0.35
"""The distance of lines at the minimum film falls as its thickness to this power; measured to be the best."""


class Coefficients(NamedTuple):
    """Coefficients on N lines; the face i lies between the lines i and i + 1.

    Attributes
    ----------
    around, along : ndarray, shape (N,)
    normal : ndarray, shape (N, 2)
    around_slope, along_slope : ndarray, shape (N, 2)
        Derivatives with respect to the two components of e, the lines moving with it.
    normal_slope : ndarray, shape (N, 2, 2)
        Derivative of component 1 with respect to e, component 2.
    theta : ndarray, shape (N,) [rad]
    """

    around: Array
    along: Array
    normal: Array
    around_slope: Array
    along_slope: Array
    normal_slope: Array
    theta: Array


@compiled
def ring_angles(e: Array, spans: Spans, span: np.ndarray, place: Array) -> tuple[Array, Array]:
    """Return the angles at places on spans, (N,), and their derivatives with respect to e, (N, 2)."""
    depth = 1.0 - e[0] * e[0] - e[1] * e[1]
    kappa = 1.0 / (1.0 + depth**CROWDING)
    a = kappa * complex(e[0], e[1])
    bend = 2.0 * CROWDING * kappa * kappa * depth ** (CROWDING - 1.0)
    a_slope = np.array([kappa, kappa * 1j]) + bend * complex(e[0], e[1]) * e
    starts, sizes, starts_slope, sizes_slope = _span_ends(a, a_slope, spans)
    theta, slope = np.empty(len(span)), np.empty((len(span), 2))
    for i in range(len(span)):
        k = span[i]
        s = starts[k] + sizes[k] * place[i]
        theta[i], by_s, by_a = _moebius(s, a, a_slope)
        slope[i] = by_a + by_s * (starts_slope[k] + sizes_slope[k] * place[i])
    return theta, slope


@compiled
def _moebius(s: float, a: complex, a_slope: Array) -> tuple[float, float, Array]:
    """Return theta(s), its derivative in s, and in e, (2,)."""
    t = complex(np.cos(s), np.sin(s))
    below = 1.0 + np.conj(a) * t
    # t + a = t conj(below), so the angle is s - 2 arg(below): continuous, and never wrapped.
    theta = s - 2.0 * np.arctan2(below.imag, below.real)
    by_s = (1.0 - abs(a) ** 2) / abs(below) ** 2
    by_a = -2.0 * (t * np.conj(a_slope) / below).imag
    return theta, by_s, by_a


@compiled
def _span_ends(a: complex, a_slope: Array, spans: Spans) -> tuple[Array, Array, Array, Array]:
    """Return start and size of the spans in s, (K,), and their derivatives with respect to e, (K, 2)."""
    count = len(spans.start)
    start, size = spans.start.copy(), spans.extent.copy()
    start_slope, size_slope = np.zeros((count, 2)), np.zeros((count, 2))
    if spans.pinned:
        for k in range(count):
            start[k], start_slope[k] = _preimage(spans.start[k], a, a_slope)
            end, end_slope = _preimage(spans.start[k] + spans.extent[k], a, a_slope)
            size[k], size_slope[k] = end - start[k], end_slope - start_slope[k]
    return start, size, start_slope, size_slope


@compiled
def _preimage(theta: float, a: complex, a_slope: Array) -> tuple[float, Array]:
    """Return the s that maps to theta, and how it must move with e to keep theta."""
    z = complex(np.cos(theta), np.sin(theta))
    below = 1.0 - np.conj(a) * z
    s = theta - 2.0 * np.arctan2(below.imag, below.real)
    _, by_s, by_a = _moebius(s, a, a_slope)
    return s, -by_a / by_s


@compiled
def ring_coefficients(e: Array, slenderness: float, spans: Spans, grid: Grid) -> Coefficients:
    """Return the coefficients of a grid at the eccentricity e."""
    theta, theta_slope = ring_angles(e, spans, grid.span, grid.line)
    face, face_slope = ring_angles(e, spans, grid.span, grid.face)
    n = len(theta)
    around, along, normal = np.empty(n), np.empty(n), np.empty((n, 2))
    around_slope, along_slope, normal_slope = np.empty((n, 2)), np.empty((n, 2)), np.empty((n, 2, 2))
    across = 1.0 / slenderness**2
    for i in range(n):
        after, before = (i + 1) % n, (i - 1) % n
        film, film_slope = _film(e, face[i], face_slope[i])
        distance = (theta[after] - theta[i]) % (2.0 * np.pi)
        around[i] = film**3 / distance
        change = (theta_slope[after] - theta_slope[i]) / distance
        around_slope[i] = around[i] * (3.0 * film_slope / film - change)
        film, film_slope = _film(e, theta[i], theta_slope[i])
        width = (face[i] - face[before]) % (2.0 * np.pi)
        along[i] = across * film**3 * width
        change = (face_slope[i] - face_slope[before]) / width
        along_slope[i] = along[i] * (3.0 * film_slope / film + change)
        normal[i, 0] = np.sin(face[i]) - np.sin(face[before])
        normal[i, 1] = np.cos(face[before]) - np.cos(face[i])
        normal_slope[i, 0] = np.cos(face[i]) * face_slope[i] - np.cos(face[before]) * face_slope[before]
        normal_slope[i, 1] = np.sin(face[i]) * face_slope[i] - np.sin(face[before]) * face_slope[before]
    return Coefficients(around, along, normal, around_slope, along_slope, normal_slope, theta)


@compiled
def _film(e: Array, theta: float, theta_slope: Array) -> tuple[float, Array]:
    """Return H at an angle that moves with e, and its derivative, (2,)."""
    cos, sin = np.cos(theta), np.sin(theta)
    slope = (e[0] * sin - e[1] * cos) * theta_slope
    slope[0] -= cos
    slope[1] -= sin
    return 1.0 - e[0] * cos - e[1] * sin, slope
