"""A damper beside what its models of inertia and of seals leave out: what the estimates of a question ask."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import ArrayLike

from ...core.model import Array
from ...core.port import force_along
from ..assemblies import SharedReaction
from ..films.geometry import FullFilm
from .bearing import SqueezeFilmDamper
from .squeeze_laws import CONVECTION, FiniteSqueeze, ShortSqueeze, parabola_mean


@dataclass(frozen=True, kw_only=True)
class JudgedDamper(SharedReaction):
    """The forces of a damper on circular orbits, and further ones that its model leaves out.

    - full film: damping and mass in small motion, exact in the frequency, in place of the first order; beyond
      small motion the second order of a short film;
    - ruptured: the edge that the inertia moves, and of finite length a mass that grows with the radius;
    - a ruptured short film with seals: half of what oil that runs around changes in a full one.

    Parameters
    ----------
    damper : SqueezeFilmDamper
        A solid one without feed.
    frequency : float [rad/s]
        Frequency of the motion.
    """

    damper: SqueezeFilmDamper
    frequency: float

    @property
    def reactions(self) -> tuple[SqueezeFilmDamper]:
        """The damper."""
        return (self.damper,)

    def left_out(self, position: Array, velocity: Array, acceleration: Array) -> Array:
        """Return the force that the damper leaves out in a motion, shape (2, n) [N].

        Parameters
        ----------
        position, velocity, acceleration : ndarray, shape (2, n) [m], [m/s], [m/s2]
        """
        q, v, a = position, velocity, acceleration
        e, w, b = q / self.clearance, v / self.clearance, a / self.clearance
        found = self._short(e, w, b, self.frequency)
        if self._ruptured:
            pushed = self.damper.convection(q, v)
            if self.has_inertia:
                pushed = pushed - np.einsum("ij...,j...->i...", self.damper.mass(q, v), a)
            return found + self._growth * np.sum(e**2, axis=0) * pushed + self._around(q, v)
        more, added = self._small
        centered = self._short(np.zeros_like(e), w, b, self.frequency)
        return np.asarray(found - centered - more * v - added * a)

    def force_along(
        self, position: Array, velocity: Array, acceleration: Array, speed: ArrayLike = 0.0
    ) -> Array:
        """Return the force in a motion with all of the inertia, shape (2, n) [N]; see `core.port`."""
        own = force_along(self.damper, position, velocity, acceleration, speed)
        return own + self.left_out(position, velocity, acceleration)

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the force on circular orbits, without that of the added mass; see `StaticReaction`."""
        q, v = position.reshape(2, -1), velocity.reshape(2, -1)
        left = self.left_out(q, v, -(self.frequency**2) * q).reshape(position.shape)
        return self.damper.prepared_force(position, velocity, speed) + left

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the slopes of the damper: near enough for what is small beside it."""
        return self.damper.prepared_jacobian(position, velocity, speed)

    @property
    def _ruptured(self) -> bool:
        return self.damper.squeeze_case.cavitated

    @property
    def _is_short(self) -> bool:
        return math.isfinite(self.damper.slenderness_limit)

    @cached_property
    def _short(self) -> Callable[[Array, Array, Array, float], Array]:
        """What a short film leaves out, with what of its length counts."""
        damper = self.damper
        share = 1.0 if self._is_short else parabola_mean(damper.slenderness)
        leak = damper.squeeze_case.end_leak * damper.slenderness
        return partial(
            neglected_force,
            viscous=share * damper.force_scale,
            inertial=share * damper.inertia_scale,
            seal=3.0 / leak if self._ruptured else 0.0,
            cavitated=self._ruptured,
        )

    @cached_property
    def _small(self) -> tuple[float, float]:
        """Damping and mass in small motion at this frequency, less those of slow motion."""
        at, slow = self.damper.small_motion(self.frequency), self.damper.small_motion(0.0)
        return at.damping - slow.damping, at.added_mass - slow.added_mass

    @property
    def _growth(self) -> float:
        """How the mass of a ruptured film of finite length grows with eps^2 beside that of a short one."""
        return 0.0 if self._is_short else 2.0 * (1.0 - parabola_mean(self.damper.slenderness))

    def _around(self, position: Array, velocity: Array) -> Array:
        """Return half of the force that oil which runs around takes from a full film with these seals."""
        if self.damper.seals is None:
            return np.zeros_like(position)
        finite, short = self._full
        speed = np.zeros(position.shape[1])
        film = (one.prepared_force(position, velocity, speed) for one in (finite, short))
        return 0.5 * (next(film) - next(film))

    @cached_property
    def _full(self) -> tuple[SqueezeFilmDamper, SqueezeFilmDamper]:
        bare = replace(self.damper, density=0.0, extent=FullFilm(), film=ShortSqueeze())
        return replace(bare, film=FiniteSqueeze()), bare


# What the models of the inertia of a squeeze film leave out: its second order, and the edge that it
# moves.
#
# A full film has the second order in the Reynolds number Re along its velocity,
#
# F2 = density radius length^3 Re frequency g(eps) velocity/clearance,
#
# g from exact solutions of the Navier-Stokes equations of a short film on circular orbits, where the
# radial part is of third order (benchmarks/squeeze_inertia.py); g(0) = -pi/8400 is the next term of
# the impedance. A ruptured film is cut off where the pressures of viscosity and inertia together
# vanish, not where the viscous one does.


SECOND = (-3.74e-4, 4.7e-3, 1.3e-3)
"""Coefficients of g by powers of eps^2: within 1e-4 to eps = 0.9 and Re 10."""

NODES = 1440
"""Around a film that is cut off: within 1e-3 of its force to eps = 0.9."""


def neglected_force(
    e: Array,
    w: Array,
    b: Array,
    frequency: float,
    *,
    viscous: float,
    inertial: float,
    seal: float = 0.0,
    cavitated: bool = False,
) -> Array:
    """Return the force that a film leaves out, shape (2, n) [N].

    Parameters
    ----------
    e, w, b : ndarray, shape (2, n) [1], [1/s], [1/s2]
        Position, velocity and acceleration / clearance.
    frequency : float [rad/s]
        Frequency of the motion.
    viscous : float [N s]
        viscosity radius length^3/clearance^2, that of the length which counts.
    inertial : float [kg m]
        density radius length^3, the same.
    seal : float [1]
        What the seals of a short film add to h^-3: clearance^3/(2 viscosity G_s length).
    cavitated : bool
    """
    if cavitated:
        theta = 2.0 * np.pi / NODES * (np.arange(NODES) + 0.5)
        m = np.stack([np.cos(theta), np.sin(theta)])
        # Film thickness and its first and second derivative in time, each (NODES, n).
        h, s, t = 1.0 + m.T @ e, m.T @ w, m.T @ b
        pressure = -viscous * (h**-3 + seal) * s
        pressure -= inertial * (0.1 * t / h - CONVECTION * (s / h) ** 2)
        # 1 where only the whole pressure presses, -1 where only the viscous one does.
        moved = (pressure > 0.0) * 1.0 - (s < 0.0)
        return np.asarray(2.0 * np.pi / NODES * m @ (pressure * moved))
    # density radius length^3 Re frequency; Re is frequency inertial/viscous.
    second = inertial**2 / viscous * frequency**2
    return second * np.polynomial.polynomial.polyval(np.sum(e * e, axis=0), SECOND) * w
