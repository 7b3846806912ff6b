"""A journal on lubricated balls around it: a Reaction with states made of contact laws."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...errors import (
    InputError,
    require_finite,
    require_kind,
    require_number,
    require_pair,
    require_vector,
    warn_user,
)
from ...inputs.kinds import arguments
from ...inputs.si_arguments import quantities
from ...model import Array, Linearization
from ...native.spec import NativeSpec
from ...signals import Signal, force_outputs, journal_inputs
from ..at_frequency import Complex, ReducedCoefficients, StatesStiffness, coefficients_of
from ..reaction import Called
from .contact_kernel import MOST_CONTACTS, contact_spec
from .contact_law import ContactLaw


@quantities
@dataclass(frozen=True, kw_only=True)
class BallSupport(Called):
    """A journal carried by equal balls at fixed angles, each through one lubricated contact.

    The ball at the angle theta is approached by z = gap - n . q, n = (cos theta, sin theta), q the position
    of the journal, and pushes it with -n F(z), F being the law. The balls roll in fixed places, as in a
    bearing whose cage stands still or turns slowly; what presses them from behind is rigid. Each law holds
    for one rolling speed: the angular speed of the journal does not enter. Take it where the dynamics of the
    lubricated contact is the question; a bearing from a catalog, with grooves, contact angle, thrust or fast
    balls, is a `BallBearing`.

    Parameters
    ----------
    law : ContactLaw
        In SI, from `reduce_ball`.
    angles : tuple of float [rad]
        Where the balls are, from +x towards +y.
    gap : float [m]
        Approach of every ball where the journal is in the center; negative for a preload, as
        `law.approach(load)`.
    position : (float, float) [m]
        Of the journal until t = 0, where the balls have rested.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    law: ContactLaw
    angles: tuple[float, ...]
    gap: float = 0.0
    position: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        require_kind("law", self.law, ContactLaw, "a ContactLaw")
        angles = require_finite("angles", self.angles)
        if angles.ndim != 1 or not angles.size:
            raise InputError(f"angles must be a list of at least one angle, got {self.angles!r}")
        object.__setattr__(self, "angles", tuple(angles.tolist()))
        require_number("gap", self.gap)
        if require_finite("position", self.position).shape != (2,):
            raise InputError(f"position must be two numbers, got {self.position!r}")
        if not self.clearance > 0.0:
            raise InputError(
                f"gap must leave the balls below {self.law.load_range[1]:.6g} N, to which their law was "
                f"fitted, got {self.gap!r}"
            )

    @property
    def clearance(self) -> float:
        """Distance from the center [m] within which no ball carries more than its law was fitted to."""
        return self.gap - float(self.law.approach(self.law.load_range[1]))

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed; the last three are not used by the force with its states."""
        return journal_inputs(2.0 * self.law.film_scale, 1.0 / self.law.time_scale)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal."""
        return force_outputs(self.law.force_scale)

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """States of the dynamic stiffness of each ball, without dimension."""
        return tuple(
            Signal(
                name=f"ball_{ball}_{k}",
                unit="1",
                nominal=1.0,
                description=f"dynamic stiffness of ball {ball}",
            )
            for ball in range(len(self.angles))
            for k in range(self.law.order)
        )

    @property
    def initial_state(self) -> Array:
        """Balls that have rested at `position`."""
        return self.resting(self.position)

    def resting(self, position: ArrayLike) -> Array:
        """Return the state in which the balls have long rested with the journal at a position (2,) [m]."""
        approaches = self.gap + self._motion[:, :2] @ require_vector("position", position)
        return np.concatenate([self.law.resting(z / self.law.film_scale) for z in approaches])

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the force on the journal in slow motion [N], shape (2, ...).

        The static laws and the damping of slow motions under the load f = 1, where a ball is in contact;
        `output` has the whole dynamic stiffness, and `coefficients` its value at a frequency.
        """
        z, rate = self._approaches(position, velocity)
        carried = self.law.static_force(z)
        return np.tensordot(self._push, np.maximum(carried - self._damping(z) * rate, 0.0), 1)

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the derivatives of `force`, shape (2, 5, ...)."""
        z, rate = self._approaches(position, velocity)
        damping = self._damping(z)
        pressed = (self.law.static_force(z) - damping * rate >= 0.0).astype(float)
        by_position, by_velocity = pressed * self.law.static_slope(z), -damping * pressed
        n = self._motion[:, :2]
        blocks = [np.einsum("ai,i...,ib->ab...", self._push, by, n) for by in (by_position, by_velocity)]
        return np.concatenate([*blocks, np.zeros((2, 1, *z.shape[1:]))], axis=1)

    def at_rest(self) -> BallSupport:
        """Return this support: at rest its films add nothing to the static laws."""
        return self

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return `resting`; the speed does not enter."""
        return self.resting(position)

    def settled(self, found: Any) -> Any:
        """Return an equilibrium as it is."""
        return found

    def complex_stiffness(self, position: ArrayLike, speed: float, s: complex) -> Complex:
        """Return K(s) of small motion about a rest, shape (2, 2) [N/m].

        Parameters
        ----------
        position, speed : array_like, shape (2,) [m], and float [rad/s]
            Of the journal; the speed does not enter.
        s : complex [1/s]
            Growth rate + i frequency.
        """
        return self._in_motion(require_pair("position", position)).stiffness(s)

    @arguments
    def coefficients(
        self, position: ArrayLike, speed: float, frequency: float | None = None
    ) -> ReducedCoefficients:
        """Return Re K(i frequency) and Im K(i frequency)/frequency; see `linear.coefficients`.

        Without a frequency they are `MemoryCoefficients`, at that of the shaft: modes, thresholds and
        responses of rotors go by K(s).

        Parameters
        ----------
        position, speed : array_like, shape (2,) [m], and float [rad/s]
            Of the journal at rest.
        frequency : float, optional [rad/s]

        Warns
        -----
        ValidityWarning
            If the frequency is above that to which the law was fitted.
        """
        if frequency is not None and abs(require_number("frequency", frequency)) > self.law.highest_frequency:
            warn_user(
                f"frequency should be at most {self.law.highest_frequency:.6g} rad/s, to which the law was "
                f"fitted, got {frequency!r}"
            )
        q = require_pair("position", position)
        return coefficients_of(self._in_motion(q), q, require_number("speed", speed), frequency)

    def modes(self, position: ArrayLike, speed: float, rotor_mass: float) -> Complex:
        """Return the exponents of a rigid mass [kg] with the films [1/s], the least damped first."""
        return self._in_motion(require_pair("position", position)).exponents(rotor_mass)

    def _in_motion(self, position: Array) -> StatesStiffness:
        """Return the dynamic stiffness about a rest."""
        return StatesStiffness(self.linearization(0.0, self.resting(position), [*position, 0.0, 0.0, 0.0]))

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return (force_x, force_y) [N] for u = (x, y, vx, vy, speed); t and the last three are not used."""
        forces = [self.law.output(t, part, [z])[0] for part, z in self._balls(x, u)]
        return np.asarray(self._push @ forces, dtype=float)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt [1/s]."""
        return np.concatenate([self.law.derivative(t, part, [z]) for part, z in self._balls(x, u)])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives."""
        n, count = self.law.order, len(self.angles)
        A, B, C = np.zeros((n * count, n * count)), np.zeros((n * count, 5)), np.zeros((2, n * count))
        D = np.zeros((2, 5))
        for k, (part, z) in enumerate(self._balls(x, u)):
            own, at = self.law.linearization(t, part, [z]), slice(n * k, n * k + n)
            A[at, at] = own.A
            B[at] = own.B @ self._motion[k : k + 1]
            C[:, at] = self._push[:, k : k + 1] @ own.C
            D += self._push[:, k : k + 1] @ own.D @ self._motion[k : k + 1]
        return Linearization(A, B, C, D)

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return what changes sign where a ball leaves its film, and where its force vanishes."""
        return np.concatenate([self.law.events(t, part, [z]) for part, z in self._balls(x, u)])

    def native(self) -> NativeSpec | None:
        """Return the kernel `contact`; None for more balls than it takes."""
        if len(self.angles) > MOST_CONTACTS:
            return None
        return contact_spec(self.law.in_si, self._motion, self._push, self.gap)

    @cached_property
    def _motion(self) -> Array:
        """Approach of each ball per input, shape (n_balls, 5)."""
        motion = np.zeros((len(self.angles), 5))
        motion[:, 0], motion[:, 1] = -np.cos(self.angles), -np.sin(self.angles)
        return motion

    @cached_property
    def _push(self) -> Array:
        """Force on the journal per force of each ball, shape (2, n_balls)."""
        return np.ascontiguousarray(self._motion[:, :2].T)

    def _approaches(self, position: ArrayLike, velocity: ArrayLike) -> tuple[Array, Array]:
        n = self._motion[:, :2]
        z = self.gap + np.tensordot(n, require_vector("position", position), 1)
        rate = np.tensordot(n, require_vector("velocity", velocity), 1)
        shape = np.broadcast_shapes(z.shape, rate.shape)
        return np.broadcast_to(z, shape), np.broadcast_to(rate, shape)

    def _damping(self, z: Array) -> Array:
        return np.where(z <= self.law.offset * self.law.film_scale, self.law.damping, 0.0)

    def _balls(self, x: ArrayLike, u: ArrayLike) -> list[tuple[Array, float]]:
        states = np.reshape(np.asarray(x, dtype=float), (len(self.angles), self.law.order))
        approaches = self.gap + self._motion @ np.asarray(u, dtype=float)
        return list(zip(states, approaches.tolist(), strict=True))
