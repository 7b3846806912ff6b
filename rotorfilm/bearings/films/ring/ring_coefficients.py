"""Finite-volume coefficients of the Reynolds equation on a ring, and their derivatives in the eccentricity.

The film is (H^3 P_theta)_theta + (L/D)^-2 H^3 P_zz = -w.n with H = 1 - e.n, n = (cos theta, sin theta), z
from the middle, 0, to the end, 1, of the bearing, and p = 12 viscosity (R/c)^2 P. Integrated over the cells
of line i it needs one number per line or face of the ring: `around` = H^3/(distance) at a face, `along` =
(L/D)^-2 H^3 (width) at a line, and `normal` = integral of n over the cell, exactly.

The lines follow e, the derivatives hold them: the error of the grid repeats with every line that passes the
film, so a derivative along with the lines has that error divided by their distance, which is more than the
derivative itself where a journal leaves the wall.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....model import Array
from ..compiled import compiled
from .ring_grids import Grid, Spans

CROWDING = 0.35
"""The distance of lines at the minimum film falls as its thickness to this power; measured to be the best."""


class CellCoefficients(NamedTuple):
    """Coefficients on N lines; the face i lies between the lines i and i + 1.

    Attributes
    ----------
    around, along : ndarray, shape (N,)
        H^3 / distance at the faces, and (L/D)^-2 H^3 width on the lines.
    normal : ndarray, shape (N, 2)
        Integral of the unit vector n over the cell.
    around_slope, along_slope : ndarray, shape (N, 2)
        Derivatives with respect to the two components of e, the lines staying where they are.
    theta : ndarray, shape (N,) [rad]
        Angles of the lines, bearing frame.
    """

    around: Array
    along: Array
    normal: Array
    around_slope: Array
    along_slope: Array
    theta: Array


@compiled
def ring_angles(e: Array, spans: Spans, span: np.ndarray, place: Array) -> Array:
    """Return the angles at places on spans, (N,)."""
    depth = 1.0 - e[0] * e[0] - e[1] * e[1]
    a = complex(e[0], e[1]) / (1.0 + depth**CROWDING)
    starts, sizes = _span_ends(a, spans)
    theta = np.empty(len(span))
    for i in range(len(span)):
        k = span[i]
        s = starts[k] + sizes[k] * place[i]
        t = complex(np.cos(s), np.sin(s))
        below = 1.0 + np.conj(a) * t
        # t + a = t conj(below), so the angle is s - 2 arg(below): continuous, and never wrapped.
        theta[i] = s - 2.0 * np.arctan2(below.imag, below.real)
    return theta


@compiled
def _span_ends(a: complex, spans: Spans) -> tuple[Array, Array]:
    """Return start and size of the spans in s, (K,)."""
    start, size = spans.start.copy(), spans.extent.copy()
    if spans.pinned:
        for k in range(len(start)):
            start[k] = _preimage(spans.start[k], a)
            size[k] = _preimage(spans.start[k] + spans.extent[k], a) - start[k]
    return start, size


@compiled
def _preimage(theta: float, a: complex) -> float:
    """Return the s that maps to theta."""
    z = complex(np.cos(theta), np.sin(theta))
    below = 1.0 - np.conj(a) * z
    return theta - 2.0 * float(np.arctan2(below.imag, below.real))


@compiled
def ring_coefficients(e: Array, slenderness: float, spans: Spans, grid: Grid) -> CellCoefficients:
    """Return the coefficients of a grid at the eccentricity e."""
    theta = ring_angles(e, spans, grid.span, grid.line)
    face = ring_angles(e, spans, grid.span, grid.face)
    n = len(theta)
    around, along, normal = np.empty(n), np.empty(n), np.empty((n, 2))
    around_slope, along_slope = np.empty((n, 2)), np.empty((n, 2))
    across = 1.0 / slenderness**2
    for i in range(n):
        after, before = (i + 1) % n, (i - 1) % n
        film, film_slope = _film(e, face[i])
        conductance = 1.0 / ((theta[after] - theta[i]) % (2.0 * np.pi))
        around[i] = conductance * film**3
        for k in range(2):
            around_slope[i, k] = 3.0 * conductance * film**2 * film_slope[k]
        film, film_slope = _film(e, theta[i])
        conductance = across * ((face[i] - face[before]) % (2.0 * np.pi))
        along[i] = conductance * film**3
        for k in range(2):
            along_slope[i, k] = 3.0 * conductance * film**2 * film_slope[k]
        normal[i, 0] = np.sin(face[i]) - np.sin(face[before])
        normal[i, 1] = np.cos(face[before]) - np.cos(face[i])
    return CellCoefficients(around, along, normal, around_slope, along_slope, theta)


@compiled
def _film(e: Array, theta: float) -> tuple[float, tuple[float, float]]:
    """Return H at an angle, and its derivative with respect to e."""
    cos, sin = np.cos(theta), np.sin(theta)
    return 1.0 - e[0] * cos - e[1] * sin, (-cos, -sin)
