"""Full squeeze film of finite length between ends of any leakage: pressure, added mass and convection.

Laminar flow -grad p = 12 viscosity v/h^2, div(h v) = -h_t, flow out of either end G_s p. By Ritz's method:
harmonics around the circumference; along the axis Legendre polynomials that vanish at the ends, and a
constant, which the ends leave free. The inertia of that flow adds a pressure p1 of first order in the
Reynolds number, whose force needs no second solution: with the velocity field v_k of a unit velocity of the
rotor along k, and v that of its whole motion,

    F1_k = -density * integral of h v_k.[(6/5) dv/dt + (54/35) (v.grad) v - (6/35) (h_t/h) v] dA,

because leakage is linear and symmetric. (6/5, 54/35 and 6/35 belong to the parabolic profile.)
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from ....model import Array

AXIAL = 8
"""Functions along half the axis."""

MOST_HARMONICS = 90
TOLERANCE = 1e-9


class SqueezeMotions(NamedTuple):
    """Damping, mass and convection of a full film at one eccentricity ratio, the rotor on the x axis.

    Attributes
    ----------
    damping, mass : tuple of two floats
        Along the radius and across it; [viscosity radius length^3/clearance^3], [density radius
        length^3/clearance].
    convection : tuple of three floats
        Radial force of w_r^2, radial of w_t^2, tangential of w_r w_t; [density radius length^3].
    """

    damping: tuple[float, float]
    mass: tuple[float, float]
    convection: tuple[float, float, float]


class _Axis(NamedTuple):
    """Functions along the axis at Gauss nodes, (functions, nodes), and their values at an end."""

    weight: Array
    value: Array
    slope: Array
    bend: Array
    end: Array


class _Slopes(NamedTuple):
    """Derivatives of a pressure over the angle and over the axis in half lengths, each (theta, z)."""

    t: Array
    z: Array
    tt: Array
    tz: Array
    zz: Array


class _Flow(NamedTuple):
    """Mean velocity around and along, and its derivatives over both in radii, each (theta, z)."""

    around: Array
    along: Array
    around_t: Array
    around_z: Array
    along_t: Array
    along_z: Array


def squeeze_motions(eps: float, slenderness: float, end_leak: float) -> SqueezeMotions:
    """Return what a film does in unit motions.

    Parameters
    ----------
    eps : float [1]
        Eccentricity ratio, above 0.
    slenderness : float [1]
        Length / diameter.
    end_leak : float [1]
        12 viscosity radius G_s/clearance^3 of either end, infinite for an open one.
    """
    film = _Film(eps, slenderness, end_leak)
    pressures = [film.pressure(k) for k in range(2)]
    slopes = [film.slopes(k, P) for k, P in enumerate(pressures)]
    flows = [film.flow(p) for p in slopes]
    mass = [0.15 / slenderness**2 * film.over(film.h * (v.around**2 + v.along**2)) for v in flows]
    damping = [film.damping(k, P) for k, P in enumerate(pressures)]
    moved = [[film.moved(k, p, way) for way in range(2)] for k, p in enumerate(slopes)]
    pushes = [film.convection(k, rate, flows, moved) for k, rate in ((0, (1, 0)), (0, (0, 1)), (1, (1, 1)))]
    return SqueezeMotions((damping[0], damping[1]), (mass[0], mass[1]), (pushes[0], pushes[1], pushes[2]))


class _Film:
    """One film: its grid, and pressures even (0) and odd (1) in the angle."""

    def __init__(self, eps: float, slenderness: float, end_leak: float) -> None:
        count = _harmonics(eps)
        theta = 2.0 * np.pi / (4 * count) * np.arange(4 * count)
        self.s, self.leak, self.axis = slenderness, end_leak, _axis(free_ends=math.isfinite(end_leak))
        self.m = (np.cos(theta)[:, None], np.sin(theta)[:, None])
        self.h, self.h_t = 1.0 + eps * self.m[0], -eps * self.m[1]
        self.step = 2.0 * np.pi / theta.size
        n = np.arange(count + 1.0)[:, None]
        cos, sin = np.cos(n * theta), np.sin(n * theta)
        even, odd = (cos, -n * sin, -n * n * cos), (sin, n * cos, -n * n * sin)
        self.ring = (even, tuple(rows[1:] for rows in odd))
        self.factor = [cho_factor(self._matrix(parity)) for parity in range(2)]

    def over(self, values: Array) -> float:
        """Return the integral over the angle and over the axis in half lengths."""
        return float(self.step * np.sum(values @ self.axis.weight))

    def pressure(self, k: int) -> Array:
        """Return the pressure of a unit rate along x (0) or y (1): coefficients (harmonics, functions)."""
        source = (self.ring[k][0] * self.step) @ self.m[k] * (self.axis.value @ self.axis.weight)
        return self._solved(k, -self.s * source)

    def slopes(self, parity: int, P: Array) -> _Slopes:
        """Return the derivatives of a pressure on the grid."""
        (value, slope, bend), axis = self.ring[parity], self.axis
        pairs = ((slope, axis.value), (value, axis.slope), (bend, axis.value), (slope, axis.slope))
        return _Slopes(*(ring.T @ P @ line for ring, line in (*pairs, (value, axis.bend))))

    def damping(self, k: int, P: Array) -> float:
        """Return minus the force on the rotor along k."""
        return -1.5 / self.s**2 * self.over(self.m[k] * (self.ring[k][0].T @ P @ self.axis.value))

    def flow(self, p: _Slopes) -> _Flow:
        """Return the velocity -h^2 grad p and its derivatives."""
        h, s, grown = self.h**2, self.s, 2.0 * self.h * self.h_t
        return _Flow(
            -h * p.t,
            -h * p.z / s,
            -(grown * p.t + h * p.tt),
            -h * p.tz / s,
            -(grown * p.z + h * p.tz) / s,
            -h * p.zz / s**2,
        )

    def moved(self, k: int, p: _Slopes, way: int) -> tuple[Array, Array]:
        """Return how the velocity of a unit rate along k changes as the rotor moves along x (0) or y (1)."""
        parity, by_h = (k + way) % 2, 2.0 * self.h * self.m[way]
        bent = 3.0 * self.h**2 * self.m[way] * self.step
        value, slope = self.ring[parity][:2]
        axis, weight = self.axis, self.axis.weight
        load = self.s * (slope @ (bent * p.t)) @ (weight * axis.value).T
        load += (value @ (bent * p.z)) @ (weight * axis.slope).T / self.s
        change = self.slopes(parity, self._solved(parity, -load))
        h = self.h**2
        return -(by_h * p.t + h * change.t), -(by_h * p.z + h * change.z) / self.s

    def convection(
        self, k: int, rate: tuple[float, float], flows: list[_Flow], moved: list[list[tuple[Array, Array]]]
    ) -> float:
        """Return the force of convection along k for a rate of the rotor that stays the same."""
        v = _Flow(*(rate[0] * a + rate[1] * b for a, b in zip(*flows, strict=True)))
        squeezed = 6.0 / 35.0 * (rate[0] * self.m[0] + rate[1] * self.m[1]) / self.h
        carried = (v.around * v.around_t + v.along * v.around_z, v.around * v.along_t + v.along * v.along_z)
        power = np.zeros_like(v.around)
        for axis, (own, along) in enumerate(zip(flows[k][:2], carried, strict=True)):
            changing = sum(rate[i] * rate[j] * moved[i][j][axis] for i in range(2) for j in range(2))
            power += own * (1.2 * changing + 54.0 / 35.0 * along - squeezed * v[axis])
        return -0.125 / self.s**2 * self.over(self.h * power)

    def _matrix(self, parity: int) -> Array:
        """Return the quadratic form of the pressure: its flow in the film, and out of both ends."""
        value, slope, _ = self.ring[parity]
        axis, cube = self.axis, self.step * self.h[:, 0] ** 3
        lines = [(rows * axis.weight) @ rows.T for rows in (axis.value, axis.slope)]
        matrix = self.s * np.kron((slope * cube) @ slope.T, lines[0])
        matrix += np.kron((value * cube) @ value.T, lines[1]) / self.s
        if math.isfinite(self.leak):
            ends = 2.0 * self.leak * np.outer(axis.end, axis.end)
            matrix += np.kron(self.step * value @ value.T, ends)
            if parity == 0 and self.leak == 0.0:
                matrix[0, 0] = 1.0  # of a sealed film the mean pressure is free, and has no force
        return np.asarray(matrix)

    def _solved(self, parity: int, load: Array) -> Array:
        return np.asarray(cho_solve(self.factor[parity], load.ravel()).reshape(load.shape))


def _axis(*, free_ends: bool) -> _Axis:
    """Return differences of even Legendre polynomials, and the constant of ends with a pressure."""
    x, weight = np.polynomial.legendre.leggauss(2 * AXIAL + 4)
    rows = np.zeros((AXIAL, 2 * AXIAL + 1))
    for j in range(AXIAL):
        rows[j, [2 * j, 2 * j + 2]] = np.array([-1.0, 1.0]) / math.sqrt(4.0 * j + 3.0)
    if free_ends:
        rows = np.vstack([np.eye(1, rows.shape[1]), rows])
    value, slope, bend = (
        np.asarray(
            np.polynomial.legendre.legval(x, np.polynomial.legendre.legder(rows.T, order)), dtype=float
        )
        for order in range(3)
    )
    return _Axis(weight, value, slope, bend, np.sum(rows, axis=1))


def _harmonics(eps: float) -> int:
    """Return how many harmonics a pressure ~ 1/h^3 takes: they fall as (eps/(1 + sqrt(1 - eps^2)))^m."""
    ratio = eps / (1.0 + math.sqrt((1.0 - eps) * (1.0 + eps)))
    return int(min(MOST_HARMONICS, 10 + 1.3 * math.log(TOLERANCE) / math.log(max(ratio, 1e-3))))
