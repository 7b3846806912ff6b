"""Cavitated squeeze film with feed: its pressure is clipped at zero, point by point."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...errors import UndefinedDerivativeError
from ...model import Array
from .porous_layer import LayerModes, axial_shapes

AXIAL_NODES = 16
CELLS = 32
NODES = 6
ROOT_STEPS = 12


class _Points(NamedTuple):
    """Points of the film: unit vectors (2, K) from the center to it, thickness and pressure parts (K,)."""

    u: Array
    h: Array
    slope: Array
    """Pressure per w.u."""
    offset: Array
    """Pressure at rest."""


@dataclass(frozen=True, eq=False)
class ClippedSqueezeFilm:
    """Film where its pressure is positive, with feed through the layer and pressures at the ends.

    In units of 3 viscosity length^2/clearance^2, with w.u the speed towards the point,

        p = ends(Z) + sum over the groups of shape(Z) (w.u + feed/weight)/(h^3 + leak),

    and F = -(3/2) times the integral of max(p, 0) u over theta and Z. Gauss-Legendre nodes along the axis;
    around it, cells cut where the pressure vanishes (the force is within 1e-3), so the derivative of the
    force is the integral of the derivative.

    Parameters
    ----------
    modes : LayerModes
    feed : ndarray, shape (N,) [1/s]
        Feed of each group of modes, weight included.
    ends : tuple of two floats [1/s]
        Pressure at Z = -1 and Z = 1.
    """

    modes: LayerModes
    feed: Array
    ends: tuple[float, float]

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        states = zip(eccentricity.reshape(2, -1).T, rate.reshape(2, -1).T, strict=True)
        forces = [self._force(e, w) for e, w in states]
        return np.array(forces).reshape(-1, 2).T.reshape(eccentricity.shape)

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`.

        Raises
        ------
        UndefinedDerivativeError
            At rest where nothing feeds the film: its half circle has no direction there.
        """
        states = zip(eccentricity.reshape(2, -1).T, rate.reshape(2, -1).T, strict=True)
        slopes = np.array([self._jacobian(e, w) for e, w in states]).reshape(-1, 2, 4)
        return np.moveaxis(slopes, 0, -1).reshape(2, 4, *eccentricity.shape[1:])

    def _force(self, e: Array, w: Array) -> Array:
        points, weight = self._film(e, w)
        return -points.u @ (weight * (points.slope * (w @ points.u) + points.offset))

    def _jacobian(self, e: Array, w: Array) -> Array:
        if not (np.any(w) or np.any(self.feed) or np.any(self.ends)):
            raise UndefinedDerivativeError(
                "velocity must not vanish where a derivative of a cavitated squeeze film without feed is "
                f"asked for, got rest at eccentricity ratio {np.hypot(*e):.6g}"
            )
        points, weight = self._film(e, w, slopes=True)
        u, towards = points.u, w @ points.u
        plain, weight = weight[0], weight[1:]
        by_rate = -(u * (plain * points.slope)) @ u.T
        # dh/de = -u
        by_position = (u * (weight[0] * towards + weight[1])) @ u.T
        return np.concatenate([by_position, by_rate], axis=1)

    def _film(self, e: Array, w: Array, *, slopes: bool = False) -> tuple[_Points, Array]:
        """Return the quadrature points in the film and their weights (K,).

        With `slopes` the weights are (3, K): plain, and times the slopes of both pressure parts by h.
        """
        axis = np.arctan2(e[1], e[0])
        eps = float(np.hypot(*e))
        edges = np.linspace(-np.pi, np.pi, CELLS + 1)
        row, first, last = self._cells(eps, axis, w, edges)
        x, weights = np.polynomial.legendre.leggauss(NODES)
        half = 0.5 * (last - first)[:, None]
        xi = 0.5 * (first + last)[:, None] + half * x
        rows = np.broadcast_to(row[:, None], xi.shape).ravel()
        points, stretch = self._points(eps, axis, xi.ravel(), rows)
        weight = 1.5 * self._axial[1][rows] * (half * weights).ravel() * stretch
        if not slopes:
            return points, weight
        inverse = 1.0 / (points.h**3 + self.modes.leak[:, None])
        thinner = -3.0 * points.h**2 * inverse**2 * self._axial[2][:, rows]
        ratio = self.feed / self.modes.weight
        return points, weight * np.stack([np.ones_like(weight), thinner.sum(axis=0), ratio @ thinner])

    def _cells(self, eps: float, axis: float, w: Array, edges: Array) -> tuple[np.ndarray, Array, Array]:
        """Return axial node, first and last angle of each piece of a cell where the pressure is positive."""
        rows = np.repeat(np.arange(AXIAL_NODES), edges.size)

        def pressure(xi: Array, row: np.ndarray) -> Array:
            points = self._points(eps, axis, xi, row)[0]
            return points.slope * (w @ points.u) + points.offset

        at_edges = pressure(np.tile(edges, AXIAL_NODES), rows).reshape(AXIAL_NODES, -1)
        low, high = at_edges[:, :-1], at_edges[:, 1:]
        first = np.broadcast_to(edges[:-1], low.shape).copy()
        last = np.broadcast_to(edges[1:], low.shape).copy()
        row, column = np.nonzero((low > 0.0) != (high > 0.0))
        root = _root(
            lambda xi: pressure(xi, row),
            edges[column],
            edges[column + 1],
            low[row, column],
            high[row, column],
        )
        rising = high[row, column] > 0.0
        first[row[rising], column[rising]] = root[rising]
        last[row[~rising], column[~rising]] = root[~rising]
        kept = np.nonzero((low > 0.0) | (high > 0.0))
        return kept[0], first[kept], last[kept]

    def _points(self, eps: float, axis: float, xi: Array, row: np.ndarray) -> tuple[_Points, Array]:
        """Return the points at the angles xi (K,) of the spread film, and dpsi/dxi."""
        rho = np.sqrt((1.0 - eps + self._depth) / (1.0 + eps + self._depth))
        b = (1.0 - rho) / (1.0 + rho)
        den = 1.0 + b * b + 2.0 * b * np.cos(xi)
        h = (1.0 - eps) + eps * 2.0 * ((1.0 - b) * np.sin(0.5 * xi)) ** 2 / den
        psi = axis + xi - 2.0 * np.arctan2(b * np.sin(xi), 1.0 + b * np.cos(xi))
        Z, _, shapes = self._axial
        parts = shapes[:, row] / (h**3 + self.modes.leak[:, None])
        ends = self.ends[0] + 0.5 * (1.0 + Z[row]) * (self.ends[1] - self.ends[0])
        offset = ends + (self.feed / self.modes.weight) @ parts
        u = np.stack([np.cos(psi), np.sin(psi)])
        return _Points(u, h, parts.sum(axis=0), offset), (1.0 - b * b) / den

    @cached_property
    def _axial(self) -> tuple[Array, Array, Array]:
        """Axial nodes and weights, shape (J,), and the groups' pressures there, (N, J)."""
        Z, weights = np.polynomial.legendre.leggauss(AXIAL_NODES)
        return Z, weights, axial_shapes(self.modes, Z)

    @cached_property
    def _depth(self) -> float:
        return 0.5 * float(np.cbrt(self.modes.weight @ self.modes.leak))


def _root(
    function: Callable[[Array], Array], low: Array, high: Array, at_low: Array, at_high: Array
) -> Array:
    """Return the zeros between low and high by the Illinois variant of the false position, all at once."""
    for _ in range(ROOT_STEPS):
        change = at_high - at_low
        middle = np.where(
            change == 0.0, 0.5 * (low + high), high - at_high * (high - low) / np.where(change, change, 1)
        )
        value = function(middle)
        crossed = (value > 0.0) != (at_high > 0.0)
        low, at_low = np.where(crossed, high, low), np.where(crossed, at_high, 0.5 * at_low)
        high, at_high = middle, value
    return high
