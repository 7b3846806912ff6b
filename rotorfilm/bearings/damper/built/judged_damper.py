"""A damper beside what its models of inertia and of seals leave out: what the estimates of a question ask."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ....model import Array
from ...films.cavitation import FullFilm
from ...inertial_model import InertialModel
from ..bearing import SqueezeFilmDamper
from ..squeeze_laws import FiniteSqueeze, ShortSqueeze, parabola_mean
from .neglected import Neglected


@dataclass(frozen=True, kw_only=True)
class JudgedDamper(InertialModel):
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
        Of the motion.
    """

    damper: SqueezeFilmDamper
    frequency: float

    @property
    def clearance(self) -> float:
        """Radial clearance [m]."""
        return self.damper.clearance

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio to which the damper is meant."""
        return self.damper.largest_eccentricity_ratio

    @property
    def nominal_force(self) -> float:
        """Nominal force of the damper [N]."""
        return self.damper.nominal_force

    @property
    def has_inertia(self) -> bool:
        """Whether the inertia of the oil counts."""
        return self.damper.has_inertia

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the added mass of the damper [kg], shape (2, 2, ...)."""
        return self.damper.mass(position, velocity, speed)

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d mass / d (x, y, vx, vy, speed), shape (2, 2, 5, ...)."""
        return self.damper.mass_slopes(position, velocity, speed)

    def require_range(self, frequency: float) -> None:
        """Warn, or raise InputError, where the inertia of the damper ends; see `SqueezeFilmDamper`."""
        self.damper.require_range(frequency)

    def left_out(self, position: Array, velocity: Array, acceleration: Array) -> Array:
        """Return the force that the damper leaves out in a motion, shape (2, n) [N].

        Parameters
        ----------
        position, velocity, acceleration : ndarray, shape (2, n) [m], [m/s], [m/s2]
        """
        q, v, a = position, velocity, acceleration
        e, w, b = q / self.clearance, v / self.clearance, a / self.clearance
        found = self._short.force(e, w, b, self.frequency)
        if self._ruptured:
            pushed = self.damper.convection(q, v)
            if self.has_inertia:
                pushed = pushed - np.einsum("ij...,j...->i...", self.damper.mass(q, v), a)
            return found + self._growth * np.sum(e**2, axis=0) * pushed + self._around(q, v)
        more, added = self._small
        centered = self._short.force(np.zeros_like(e), w, b, self.frequency)
        return np.asarray(found - centered - more * v - added * a)

    def force_along(
        self, position: Array, velocity: Array, acceleration: Array, speed: ArrayLike = 0.0
    ) -> Array:
        """Return the force in a motion with all of the inertia, shape (2, n) [N]; see `InertialModel`."""
        own = self.damper.force_along(position, velocity, acceleration, speed)
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
    def _short(self) -> Neglected:
        """The short film, with what of its length counts."""
        damper = self.damper
        share = 1.0 if self._is_short else parabola_mean(damper.slenderness)
        leak = damper.squeeze_case.end_leak * damper.slenderness
        inertial = damper.density * damper.radius * damper.length**3
        seal = 3.0 / leak if self._ruptured else 0.0
        return Neglected(share * damper.force_scale, share * inertial, seal, self._ruptured)

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
