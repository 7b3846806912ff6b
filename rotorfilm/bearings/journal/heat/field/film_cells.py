"""The cells of a film that warms: lines at one place of the journal, which then stay where they are."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .....model import Array
from ....films.ring.ring_grids import Grid, Spans

CROWDING = 0.35
"""The distance of lines at the minimum film falls as its thickness to this power, as in grids/cells.c."""

_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(3)


class FilmCells(NamedTuple):
    """A ring of N lines with M unknown pressures on each and M + 1 cells of oil, the last at the end.

    Attributes
    ----------
    theta, face : ndarray, shape (N,) [rad]
        Angles of the lines, and of the faces after them.
    start, extent : ndarray, shape (N,) [rad]
        Cell of a line, from the face before it to that after it; but all film up to the edge of an opening.
    gap : ndarray, shape (N,) [rad]
        Angle from a line to the next.
    width : ndarray, shape (M + 1,)
        Axial widths of the cells as fractions of half the length; their sum is 1.
    conductance : ndarray, shape (M,)
        1/distance to the next node towards the bearing's end.
    held : ndarray of bool, shape (N,)
        Lines in an opening or at its edge.
    value : ndarray, shape (N,) [1/s]
        The pressure held there.
    opening : ndarray of int, shape (N,)
        Opening of a line that is held, -1 of others.
    slenderness : float [1]
        Length / diameter.
    """

    theta: Array
    face: Array
    start: Array
    extent: Array
    gap: Array
    width: Array
    conductance: Array
    held: np.ndarray
    value: Array
    opening: np.ndarray
    slenderness: float

    @property
    def shape(self) -> tuple[int, int]:
        """Lines, and cells along half the length."""
        return len(self.theta), len(self.width)

    def normal(self) -> Array:
        """Return the integral of n = (cos theta, sin theta) over the cells of the lines, shape (2, N)."""
        before, after = np.roll(self.face, 1), self.face
        return np.stack([np.sin(after) - np.sin(before), np.cos(before) - np.cos(after)])

    def integral_of_inverse(self, eccentricity: Array) -> Array:
        """Return the integral of 1/H over the cells of the lines, shape (N,)."""
        angles = self.start[:, None] + 0.5 * self.extent[:, None] * (1.0 + _GAUSS_NODES)
        return 0.5 * self.extent * (_GAUSS_WEIGHTS / thickness(eccentricity, angles)).sum(axis=1)


def thickness(eccentricity: Array, angle: Array) -> Array:
    """Return H = 1 - e.n at angles [rad], of their shape."""
    return np.asarray(1.0 - eccentricity[0] * np.cos(angle) - eccentricity[1] * np.sin(angle))


def film_cells(spans: Spans, grid: Grid, slenderness: float, eccentricity: Array) -> FilmCells:
    """Return the cells of a grid whose lines crowd at the minimum film for an eccentricity (2,)."""
    distance = float(eccentricity @ eccentricity)
    a = complex(eccentricity[0], eccentricity[1]) / (1.0 + (1.0 - distance) ** CROWDING)
    theta, face = _angles(spans, grid.span, grid.line, a), _angles(spans, grid.span, grid.face, a)
    held = grid.held > 0
    after_held, before_held = held & ~np.roll(held, 1), np.roll(held, -1)
    start = np.where(np.roll(held, 1), np.roll(theta, 1), np.roll(face, 1))
    end = np.where(before_held, np.roll(theta, -1), face)
    opening = np.where(held, np.cumsum(after_held) - 1, -1)
    if held[0] and held[-1] and not held.all() and grid.film[-1] == 0.0:
        opening[opening == opening.max()] = opening[0]
    return FilmCells(
        theta=theta,
        face=face,
        start=start,
        extent=(end - start) % (2.0 * np.pi),
        gap=(np.roll(theta, -1) - theta) % (2.0 * np.pi),
        width=np.append(grid.width, 1.0 - grid.width.sum()),
        conductance=grid.conductance,
        held=held,
        value=grid.value,
        opening=opening,
        slenderness=slenderness,
    )


def _angles(spans: Spans, span: np.ndarray, place: Array, a: complex) -> Array:
    """Return the angles of places on spans: exp(i theta) = (t + a)/(1 + conj(a) t), t = exp(i s)."""
    start, end = spans.start, spans.start + spans.extent
    if spans.pinned:
        start, end = (angle - 2.0 * _bend(-a, angle) for angle in (start, end))
    s = start[span] + (end - start)[span] * place
    return np.asarray(s - 2.0 * _bend(a, s))


def _bend(a: complex, s: Array) -> Array:
    return np.angle(1.0 + a.conjugate() * np.exp(1j * s))
