"""A ring that a rotor rubs in where its motion is wider than the gap: contact, friction, impacts."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import keep_pair, require_each, require_non_negative, require_positive
from ..core.inputs import quantities
from ..core.model import Array
from ..core.signals import Signal, journal_inputs
from ..native.film_call import FilmCall
from .reaction import NOMINAL_SPEED, StaticReaction, broadcast_state, input_vector


class RubContact(NamedTuple):
    """Contact of a rotor with its rub ring.

    Attributes
    ----------
    depth : ndarray, shape (...) [m]
        Penetration into the ring; negative without contact.
    normal_force : ndarray, shape (...) [N]
        Normal force of the ring on the rotor, never negative.
    friction_force : ndarray, shape (...) [N]
        Friction force on the rotor, positive about +z.
    slip : ndarray, shape (...) [m/s]
        Velocity of the rotor surface along the ring, positive about +z.
    """

    depth: Array
    normal_force: Array
    friction_force: Array
    slip: Array


@quantities
@dataclass(frozen=True, kw_only=True)
class RubRing(StaticReaction):
    """A stator ring for rubs: a Reaction whose force is zero within the gap.

    With the depth d = |position - ring_center| - gap > 0 and the slip s of the surface along the ring

        normal force = stiffness d (1 + dissipation d'), not below 0,
        friction = -friction_coefficient normal force s / sqrt(s^2 + slip_velocity^2).

    Parameters
    ----------
    gap : float [m]
        Radial gap between rotor and ring.
    stiffness : float [N/m]
        Radial stiffness of the contact and of the support of the ring, in series.
    radius : float [m]
        Radius of the rotor where it touches.
    friction_coefficient : float [1]
        Coulomb's friction coefficient, at full slip.
    slip_velocity : float [m/s]
        Slip at which friction reaches 0.71 of its full value. Below it, sticking becomes a slow creep.
    dissipation : float [s/m]
        Damping of impacts: the rotor rebounds with the share 1 - (2/3) dissipation * velocity of its
        velocity, as long as that is near 1. The force starts from 0 at any velocity (Hunt & Crossley 1975, J.
        Appl. Mech. 42, 440-445).
    ring_center : tuple of two floats [m]
        Center of the ring.

    Raises
    ------
    InputError
        If an argument breaks its rule.

    Examples
    --------
    >>> ring = RubRing(gap=2e-4, stiffness=1e7, radius=0.05, friction_coefficient=0.1)
    >>> ring(position=[2.1e-4, 0.0], velocity=[0.0, 0.0], speed=100.0).round(3)
    array([-100.,  -10.])
    """

    gap: float
    stiffness: float
    radius: float
    friction_coefficient: float = 0.0
    slip_velocity: float = 0.01
    dissipation: float = 0.0
    ring_center: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        require_each(self, require_positive, "gap", "stiffness", "radius", "slip_velocity")
        require_each(self, require_non_negative, "friction_coefficient", "dissipation")
        keep_pair(self, "ring_center")

    clearance: ClassVar[float] = math.inf
    """Infinite: the rotor may go into the ring."""

    @property
    def nominal_force(self) -> float:
        """Normal force at a penetration of 1 % of the gap [N]."""
        return 0.01 * self.stiffness * self.gap

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(self.gap, NOMINAL_SPEED)

    @property
    def numbers(self) -> Array:
        """The parameters as the C library reads them (rf_rub of rub.h), shape (8,)."""
        contact = (self.friction_coefficient, self.slip_velocity, self.dissipation)
        return np.array([self.gap, self.stiffness, self.radius, *contact, *self.ring_center])

    def compiled(self) -> FilmCall | None:
        """Return the force in the C library; None for a subclass, which may differ."""
        return FilmCall.of_numbers("rf_rub_at", self.numbers) if type(self) is RubRing else None

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return penetration / gap, shape (1,); contact begins and ends where it changes sign."""
        values = input_vector(u)
        away = values[:2] - np.array(self.ring_center)
        return np.array([math.hypot(*away) / self.gap - 1.0])

    def contact(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> RubContact:
        """Return depth, forces and sliding velocity of a contact; the arguments are those of `force`."""
        q, v, omega = broadcast_state(position, velocity, speed)
        distance, _, _, sinking, sliding = self._frame(q, v)
        slip, normal = sliding + self.radius * omega, self._normal(distance, sinking)
        return RubContact(distance - self.gap, normal, -normal * self._rubbed(slip), slip)

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        distance, out, along, sinking, sliding = self._frame(position, velocity)
        rubbed = self._rubbed(sliding + self.radius * speed)
        return -self._normal(distance, sinking) * (out + rubbed * along)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        e, n, t, sinking, sliding = self._frame(position, velocity)
        slip, friction, v = sliding + self.radius * speed, self.friction_coefficient, self.slip_velocity
        # `rubbed` is friction per normal force, `sharper` its derivative by the slip.
        normal, rubbed = self._normal(e, sinking), self._rubbed(slip)
        sharper = friction * v**2 / np.hypot(slip, v) ** 3
        pressed = np.where(normal > 0.0, self.stiffness, 0.0)
        depth, lost = e - self.gap, self.dissipation
        by_place = pressed * ((1.0 + lost * sinking) * n + depth * lost * sliding / e * t)
        by_rate = pressed * depth * lost * n
        # The directions turn with the place: dn = t (t.dq)/e, dt = -n (t.dq)/e.
        turned = normal / e * (t - rubbed * n - sharper * sinking * t)
        slopes = np.zeros((2, 5, *e.shape))
        push = n + rubbed * t
        slopes[:, :2] = -push[:, None] * by_place - turned[:, None] * t
        slopes[:, 2:4] = -push[:, None] * by_rate - (normal * sharper * t)[:, None] * t
        slopes[:, 4] = -normal * sharper * self.radius * t
        return slopes

    def _frame(self, position: Array, velocity: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Return the distance from the center, the directions out and along, and the velocities in both."""
        away = position - np.reshape(self.ring_center, (2, *(1,) * (position.ndim - 1)))
        distance = np.maximum(np.hypot(away[0], away[1]), np.finfo(float).tiny)
        out = away / distance
        along = np.stack([-out[1], out[0]])
        return distance, out, along, np.sum(out * velocity, axis=0), np.sum(along * velocity, axis=0)

    def _normal(self, distance: Array, sinking: Array) -> Array:
        """Return the normal force, shape (...)."""
        pressed = self.stiffness * (distance - self.gap) * (1.0 + self.dissipation * sinking)
        return np.where(distance > self.gap, np.maximum(pressed, 0.0), 0.0)

    def _rubbed(self, slip: Array) -> Array:
        """Return the friction per normal force, of the sign of the slip."""
        return self.friction_coefficient * slip / np.hypot(slip, self.slip_velocity)
