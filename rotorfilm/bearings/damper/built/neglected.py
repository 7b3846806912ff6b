"""What the models of the inertia of a squeeze film leave out: its second order, and the edge that it moves.

A full film has the second order in the Reynolds number Re along its velocity,

    F2 = density radius length^3 Re frequency g(eps) velocity/clearance,

g from exact solutions of the Navier-Stokes equations of a short film on circular orbits, where the radial
part is of third order (benchmarks/squeeze_inertia.py); g(0) = -pi/8400 is the next term of the impedance. A
ruptured film is cut off where the pressures of viscosity and inertia together vanish, not where the viscous
one does.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....model import Array
from .film_inertia import CONVECTION

SECOND = (-3.74e-4, 4.7e-3, 1.3e-3)
"""Coefficients of g by powers of eps^2: within 1e-4 to eps = .9 and Re 10."""

NODES = 1440
"""Around a film that is cut off: within 1e-3 of its force to eps = .9."""


class Neglected(NamedTuple):
    """The numbers of a film that its left-out forces need; lengths in clearances.

    Attributes
    ----------
    viscous : float [N s]
        viscosity radius length^3/clearance^2, that of the length which counts.
    inertial : float [kg m]
        density radius length^3, the same.
    seal : float [1]
        What the seals of a short film add to h^-3: clearance^3/(2 viscosity G_s length).
    cavitated : bool
    """

    viscous: float
    inertial: float
    seal: float
    cavitated: bool

    def force(self, e: Array, w: Array, b: Array, frequency: float) -> Array:
        """Return the force that is left out, shape (2, n) [N].

        Parameters
        ----------
        e, w, b : ndarray, shape (2, n) [1], [1/s], [1/s2]
            Position, velocity and acceleration / clearance.
        frequency : float [rad/s]
            Of the motion.
        """
        if self.cavitated:
            film = _around(e, w, b)
            return _over(self._pressure(film) * self._moved(film))
        return self._second(frequency) * np.polynomial.polynomial.polyval(np.sum(e * e, axis=0), SECOND) * w

    def _second(self, frequency: float) -> float:
        """Return density radius length^3 Re frequency; Re is frequency inertial/viscous."""
        return self.inertial**2 / self.viscous * frequency**2

    def _pressure(self, film: _Around) -> Array:
        """Return the integral of the pressure along the axis, times radius, by angle [N]."""
        viscous = self.viscous * (film.h**-3 + self.seal) * film.s
        return -viscous - self.inertial * (0.1 * film.t / film.h - CONVECTION * (film.s / film.h) ** 2)

    def _moved(self, film: _Around) -> Array:
        """Return 1 where only the whole pressure presses, -1 where only the viscous one does."""
        return np.asarray((self._pressure(film) > 0.0) * 1.0 - (film.s < 0.0))


class _Around(NamedTuple):
    """Directions (2, M); film and its first and second derivative in time, each (M, n)."""

    m: Array
    h: Array
    s: Array
    t: Array


def _around(e: Array, w: Array, b: Array) -> _Around:
    theta = 2.0 * np.pi / NODES * (np.arange(NODES) + 0.5)
    m = np.stack([np.cos(theta), np.sin(theta)])
    return _Around(m, 1.0 + m.T @ e, m.T @ w, m.T @ b)


def _over(pressure: Array) -> Array:
    """Return the force of a pressure (M, n)."""
    theta = 2.0 * np.pi / NODES * (np.arange(NODES) + 0.5)
    return np.asarray(2.0 * np.pi / NODES * np.stack([np.cos(theta), np.sin(theta)]) @ pressure)
