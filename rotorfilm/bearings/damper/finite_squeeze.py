"""Full squeeze film of finite length on a porous layer, with flow around the circumference in both."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...errors import warn_user
from ...model import Array
from ..films.law import CENTER, PolarResponse, cartesian_force, cartesian_jacobian, polar_frame
from .full_squeeze import FullSqueezeFilm
from .porous_layer import SINGLE_MODES, LayerModes, PorousLayer, axial_numbers, leakage

TWO_DIMENSIONAL_MODES = SINGLE_MODES - 2
"""Axial modes that are solved around the circumference; the rest hardly flow around it."""

TOLERANCE = 1e-13
"""Where the harmonics of the pressure are cut off."""

MOST_HARMONICS = 400

LARGEST = 0.99
"""Eccentricity ratio to which the harmonics resolve the pressure."""


class _Radial(NamedTuple):
    """Integrals of the pressures of unit sources cos, sin and 1; slopes by the eccentricity ratio."""

    cos: float
    sin: float
    lift: float
    cos_slope: float
    sin_slope: float
    lift_slope: float


class _Matrix(NamedTuple):
    """A matrix and its derivative by the eccentricity ratio."""

    value: Array
    slope: Array


@dataclass(frozen=True, eq=False)
class FiniteSqueezeFilm:
    """Full film of finite length: harmonics around the circumference, cosines along the axis, both spectral.

    With q G = -sum (6/a_n^2) X_n and D_n acting on each harmonic m with its own wave number,

        (L/D)^2 (h^3 X_n')' - a_n^2 h^3 X_n - leakage X_n = source.

    Ten axial modes are solved so; the others are taken as short. For eccentricity ratios up to 0.99.

    Parameters
    ----------
    slenderness : float [1]
        L/D.
    layer : PorousLayer or None
        None for a solid cage.
    modes : LayerModes
        Of that layer.
    feed : ndarray, shape (N,) [1/s]
        Feed of each group of modes, weight included.
    """

    slenderness: float
    layer: PorousLayer | None
    modes: LayerModes
    feed: Array

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
        frame = polar_frame(e, w, floor=CENTER)
        response, lift, _ = self._response(frame.chi)
        film = cartesian_force(frame, response.A) - lift * e
        return film.reshape(eccentricity.shape) + self._short.force(eccentricity, rate)

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`."""
        e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
        frame = polar_frame(e, w, floor=CENTER)
        response, lift, lift_slope = self._response(frame.chi)
        film = cartesian_jacobian(frame, response)
        film[:, :2] -= lift * np.eye(2)[:, :, None] + lift_slope / frame.chi * e[:, None] * e
        return film.reshape(2, 4, *eccentricity.shape[1:]) + self._short.jacobian(eccentricity, rate)

    @property
    def _short(self) -> FullSqueezeFilm:
        """The remaining axial modes."""
        rest = slice(TWO_DIMENSIONAL_MODES, None)
        if len(self.modes.weight) == 1:  # one group stands for all modes
            share = np.array([1.0 - np.sum(6.0 / axial_numbers()[:TWO_DIMENSIONAL_MODES] ** 4)])
            return FullSqueezeFilm(self.modes._replace(weight=share), share * self.feed)
        modes = self.modes._replace(weight=self.modes.weight[rest], leak=self.modes.leak[rest])
        return FullSqueezeFilm(modes, self.feed[rest])

    def _response(self, chi: Array) -> tuple[PolarResponse, Array, Array]:
        """Return the polar matrix, the lift per eccentricity and its slope at eccentricity ratios (B,)."""
        if np.any(chi > LARGEST * (1.0 + 1e-12)):
            warn_user(
                f"eccentricity ratio must not exceed {LARGEST} for a film of finite length, got "
                f"{chi.max():.6g}: its harmonics no longer resolve the pressure",
            )
        values = np.array([self._radial(float(eps)) for eps in chi]).reshape(-1, 6)
        A, A_chi = np.zeros((2, chi.size, 2, 2))
        A[:, 1, 1], A[:, 0, 0], A_chi[:, 1, 1], A_chi[:, 0, 0] = values[:, (0, 1, 3, 4)].T
        return PolarResponse(A, A_chi, np.zeros_like(A)), values[:, 2], values[:, 5]

    def _radial(self, eps: float) -> _Radial:
        """Return the integrals of cos, sin, -cos/eps times the pressures of the sources cos, sin, feed."""
        even, odd = _cubes(eps, _harmonics(eps))
        m = np.arange(float(len(even.value)))
        total = np.zeros(6)
        for n, a in enumerate(axial_numbers()[:TWO_DIMENSIONAL_MODES]):
            k2 = a * a + (self.slenderness * m) ** 2
            leak = np.zeros_like(k2) if self.layer is None else leakage(self.layer, k2)
            feed = (self.feed[0] if len(self.feed) == 1 else self.feed[n] / self.modes.weight[n]) / eps
            around = self._around(odd, m[1:])
            cosines = _Matrix(*(_bordered(block) for block in around))
            (by_cos, by_feed), (cos_slope, feed_slope) = _solve(cosines, even, leak, a, sources=2)
            sines = _Matrix(*(matrix[1:, 1:] for matrix in even))
            (by_sin,), (sin_slope,) = _solve(
                _Matrix(*self._around(sines, m[1:])), odd, leak[1:], a, sources=1
            )
            lift, lift_slope = -feed * by_feed, -feed * (feed_slope - by_feed / eps)
            total += 6.0 / a**2 * np.array([by_cos, by_sin, lift, cos_slope, sin_slope, lift_slope])
        return _Radial(*total.tolist())

    def _around(self, cube: _Matrix, m: Array) -> tuple[Array, Array]:
        """Return -(L/D)^2 (h^3 X')' for harmonics m >= 1; `cube` multiplies the other parity by h^3."""
        L2 = self.slenderness**2
        return L2 * m[:, None] * cube.value * m, L2 * m[:, None] * cube.slope * m


def _solve(around: _Matrix, cube: _Matrix, leak: Array, a: float, *, sources: int) -> tuple[Array, Array]:
    """Return pi times the first harmonic of -X, and its slope by eps.

    The sources are that harmonic and, as the second of two, a uniform one.
    """
    first = sources - 1
    matrix = around.value + a * a * cube.value + np.diag(leak)
    slope = around.slope + a * a * cube.slope
    source = np.zeros((len(matrix), sources))
    source[first, 0] = source[0, first] = 1.0
    X = np.linalg.solve(matrix, source)
    X_slope = -np.linalg.solve(matrix, slope @ X)
    return np.pi * X[first], np.pi * X_slope[first]


def _cubes(eps: float, size: int) -> tuple[_Matrix, _Matrix]:
    """Return the products by h^3 of cosines 0..size and of sines 1..size, with slopes by eps."""
    half = np.full(size, 0.5)
    even = np.diag(half, 1) + np.diag(half, -1)
    even[1, 0] = 1.0
    odd = np.diag(half[1:], 1) + np.diag(half[1:], -1)
    cubes = []
    for cos in (even, odd):
        h = np.eye(len(cos)) + eps * cos
        cubes.append(_Matrix(h @ h @ h, 3.0 * cos @ h @ h))
    return cubes[0], cubes[1]


def _bordered(block: Array) -> Array:
    return np.pad(block, ((1, 0), (1, 0)))


def _harmonics(eps: float) -> int:
    """Return how many harmonics a pressure ~ 1/h^3 needs: they fall as (eps/(1 + sqrt(1 - eps^2)))^m."""
    z = eps / (1.0 + np.sqrt((1.0 - eps) * (1.0 + eps)))
    return int(min(MOST_HARMONICS, 12 + 1.3 * np.log(TOLERANCE) / np.log(max(z, 1e-3))))
