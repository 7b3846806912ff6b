"""The inertia of the oil in a full squeeze film: the mass that it adds and the force of its convection.

The first order in the Reynolds number: with the acceleration a of the rotor the film answers

    F = F_viscous(x, v) - M(x) a + q(x, v, v)

M without q would be wrong by half at eccentricity ratio 0.5. In units: x = clearance e, v = clearance w; M in
density radius length^3 / clearance, q in density radius length^3 per 1/s^2.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from ....model import Array

CONVECTION = 17.0 / 70.0
"""Force of convection in a short film per integral of (w.m)^2 m/h^2: (102/35)/12 of its pressure."""


class FilmInertia(Protocol):
    """The inertia of a film in its units."""

    @property
    def reach(self) -> float:
        """Eccentricity ratio to which it is meant; 1 where that is the wall."""

    def mass(self, eccentricity: Array, rate: Array) -> Array:
        """Return the added mass, shape (2, 2, ...), symmetric.

        Parameters
        ----------
        eccentricity : ndarray, shape (2, ...) [1]
            Position / clearance.
        rate : ndarray, shape (2, ...) [1/s]
            Velocity / clearance; of a ruptured film only its direction matters, of a full one nothing.
        """

    def mass_slopes(self, eccentricity: Array, rate: Array) -> Array:
        """Return d mass / d (eccentricity, rate), shape (2, 2, 4, ...)."""

    def convection(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force of convection on the rotor, shape (2, ...)."""

    def convection_slopes(self, eccentricity: Array, rate: Array) -> Array:
        """Return d convection / d (eccentricity, rate), shape (2, 4, ...)."""


class InertiaFunctions(NamedTuple):
    """Mass m I + n e e and convection a |w|^2 e + b (e.w) w + c (e.w)^2 e of a full film, each (...).

    Attributes
    ----------
    m, n, a, b, c : ndarray
        Functions of the squared eccentricity ratio.
    """

    m: Array
    n: Array
    a: Array
    b: Array
    c: Array


Radial = Callable[[Array], tuple[InertiaFunctions, InertiaFunctions]]
"""Values and slopes of the functions at squared eccentricity ratios."""


@dataclass(frozen=True, eq=False)
class FullInertia:
    """Inertia of a film all round, which does not depend on direction: five functions of the radius.

    Parameters
    ----------
    radial : callable
        Returns the `InertiaFunctions` and their slopes at squared eccentricity ratios (...).
    reach : float [1]
        Eccentricity ratio to which they are meant.
    """

    radial: Radial
    reach: float = 1.0

    def mass(self, eccentricity: Array, rate: Array) -> Array:
        """Return the added mass, shape (2, 2, ...); see `FilmInertia.mass`."""
        e, at = eccentricity, self.radial(_squared(eccentricity))[0]
        return at.m * _unit(e) + at.n * e[:, None] * e

    def mass_slopes(self, eccentricity: Array, rate: Array) -> Array:
        """Return its derivatives, shape (2, 2, 4, ...); see `FilmInertia.mass_slopes`."""
        e, unit = eccentricity, _unit(eccentricity)
        at, slope = self.radial(_squared(e))
        by_e = 2.0 * (slope.m * unit + slope.n * e[:, None] * e)[:, :, None] * e
        by_e += at.n * (unit[:, None] * e[:, None] + e[:, None, None] * unit)
        return np.concatenate([by_e, np.zeros_like(by_e)], axis=2)

    def convection(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force of convection, shape (2, ...); see `FilmInertia.convection`."""
        e, w, at = eccentricity, rate, self.radial(_squared(eccentricity))[0]
        ew = np.sum(e * w, axis=0)
        return (at.a * _squared(w) + at.c * ew**2) * e + at.b * ew * w

    def convection_slopes(self, eccentricity: Array, rate: Array) -> Array:
        """Return its derivatives, shape (2, 4, ...); see `FilmInertia.convection_slopes`."""
        e, w, unit = eccentricity, rate, _unit(eccentricity)
        at, slope = self.radial(_squared(e))
        ew, ww = np.sum(e * w, axis=0), _squared(w)
        grown = (slope.a * ww + slope.c * ew**2) * e + slope.b * ew * w
        by_e = 2.0 * grown[:, None] * e + (at.a * ww + at.c * ew**2) * unit
        by_e += (2.0 * at.c * ew * e + at.b * w)[:, None] * w
        by_w = 2.0 * at.a * e[:, None] * w + (2.0 * at.c * ew * e + at.b * w)[:, None] * e
        return np.concatenate([by_e, by_w + at.b * ew * unit], axis=1)


def short_inertia(E: Array) -> tuple[InertiaFunctions, InertiaFunctions]:
    """Return the functions of a short film, open or sealed, and their slopes; exact for 0 <= E < 1.

    Parameters
    ----------
    E : ndarray, shape (...) [1]
        Squared eccentricity ratio.

    Notes
    -----
    The inertia of the film's mean flow z h_t/h (first order, parabolic profile) gives the pressure

        integral of p dz = -(density L^3/12) [(6/5) h_tt/h - (102/35) h_t^2/h^2],

    M = (1/10) integral of m m/h, q = (17/70) integral of (w.m)^2 m/h^2 over the circumference, here in closed
    form with s = sqrt(1 - E). Seals change the viscous pressure only: what leaves a short film is its volume.
    """
    s = np.sqrt(1.0 - E)
    near, tenth, share = 1.0 + s, 0.1 * np.pi, 2.0 * np.pi * CONVECTION
    n = 2.0 * tenth / (s * near**2)
    t = -share / (s * near**2)
    c = -share * (3.0 * s + 1.0) / (s * near) ** 3
    by_s = -0.5 / s  # ds/dE
    n_log = -(1.0 / s + 2.0 / near) * by_s
    c_log = (3.0 / (3.0 * s + 1.0) - 3.0 / s - 3.0 / near) * by_s
    values = InertiaFunctions(2.0 * tenth / near, n, t, 2.0 * t, c)
    slopes = InertiaFunctions(-2.0 * tenth / near**2 * by_s, n * n_log, t * n_log, 2.0 * t * n_log, c * c_log)
    return values, slopes


def _squared(vector: Array) -> Array:
    return np.asarray(np.sum(vector * vector, axis=0))


def _unit(vector: Array) -> Array:
    return np.eye(2).reshape(2, 2, *(1,) * (vector.ndim - 1))
