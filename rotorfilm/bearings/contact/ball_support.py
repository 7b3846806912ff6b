"""A journal on lubricated balls around it: a Reaction with states made of contact laws."""

from __future__ import annotations

import math
from collections.abc import Callable
from ctypes import byref
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    ConvergenceError,
    InputError,
    require_finite,
    require_kind,
    require_number,
    require_positive,
    require_vector,
    warn_user,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array, Linearization, breakpoints
from ...core.results import Trajectory
from ...core.signals import Signal, force_outputs, journal_inputs, signals_of
from ...core.time_steps import cubic
from ...native.library import loops
from ...native.spec import NativeSpec
from ...native.structs import structure
from ..reaction import Called
from .contact_law import MOST_CONTACTS, ContactLaw, contact_spec


@quantities
@dataclass(frozen=True, kw_only=True)
class BallSupport(Called):
    """A journal carried by equal balls at fixed angles, each through one lubricated contact.

    The ball at the angle theta is approached by z = gap - n . q, n = (cos theta, sin theta), q the position
    of the journal, and pushes it with -n F(z), F being the law. The balls roll at fixed angles, as in a
    bearing whose cage does not turn or turns slowly, against a rigid outer ring. Each law holds for one
    rolling speed: the angular speed of the journal has no influence. Use this class to study the dynamics of
    the lubricated contact. A bearing from a catalog, with grooves, contact angle, thrust or fast balls, is a
    `BallBearing`.

    Parameters
    ----------
    law : ContactLaw
        Law in SI, from `reduce_ball`.
    angles : tuple of float [rad]
        Angles where the balls are, from +x towards +y.
    gap : float [m]
        Approach of every ball where the journal is in the center; negative for a preload, as
        `law.approach(load)`.
    position : (float, float) [m]
        Position of the journal until t = 0, where the balls have rested.

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
                f"gap must keep the load of each ball below {self.law.load_range[1]:.6g} N, the largest to "
                f"which its law was fitted, got {self.gap!r}"
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
        balls, order = range(len(self.angles)), range(self.law.order)
        return signals_of(
            *((f"ball_{j}_{k}", "1", 1.0, f"dynamic stiffness of ball {j}") for j in balls for k in order)
        )

    @property
    def initial_state(self) -> Array:
        """The state of balls at rest at `position`."""
        return self.resting(self.position)

    def resting(self, position: ArrayLike) -> Array:
        """Return the steady state of the balls for a journal at rest at a position (2,) [m]."""
        approaches = self.gap + self._motion[:, :2] @ require_vector("position", position)
        return np.concatenate([self.law.resting(z / self.law.film_scale) for z in approaches])

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the force on the journal in slow motion [N], shape (2, ...).

        It is the sum of the static laws and, for each ball in contact, the damping of slow motion under the
        load f = 1. `output` has the whole dynamic stiffness, and `coefficients` its value at a frequency.
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
        """Return this support itself, because the films do not change the static laws at rest."""
        return self

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the states of `resting`; they do not depend on the speed."""
        return self.resting(position)

    def require_range(self, frequency: float) -> None:
        """Warn where motion at a frequency [rad/s] is faster than that to which the law was fitted."""
        if abs(frequency) > self.law.highest_frequency:
            warn_user(
                f"frequency should be at most {self.law.highest_frequency:.6g} rad/s, to which the law was "
                f"fitted, got {frequency!r}"
            )

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
        """Return functions that change sign when a ball leaves its film, or when its force vanishes."""
        return np.concatenate([self.law.events(t, part, [z]) for part, z in self._balls(x, u)])

    def native(self) -> NativeSpec | None:
        """Return the kernel `contact`; None for more balls than it takes."""
        if len(self.angles) > MOST_CONTACTS:
            return None
        return contact_spec(self.law, self._motion, self._push, self.gap)

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


# A ball on its reduced contact law, over time.


FINEST = 12
"""Halvings of the steps after which an integration is given up."""


_Part = tuple[Array, Array]
"""Times and rows of (delta, velocity, states) between two jumps of the load, in the units of the contact."""


class _Rider(NamedTuple):
    """The law, the inertia of the ball in the units of the contact, its highest frequency and its load."""

    law: ContactLaw
    W: float
    fastest: float
    load: Callable[[float], float]

    def force(self, y: Array) -> Array:
        """Return the force of the film [N], which does not pull, for rows of (delta, velocity, states)."""
        law, delta = self.law, y[:, 0]
        static = (np.maximum(law.offset - delta, 0.0) / law.span) ** law.exponent
        drive = np.minimum(delta, law.offset) - law.operating
        force = np.maximum(static + float(law.D[0, 0]) * drive + y[:, 2:] @ law.C[0], 0.0)
        return np.asarray(force * law.force_scale)

    def part(self, begin: float, end: float, start: Array, tolerance: float) -> _Part:
        """Return the motion by halving the steps until the answer settles."""
        n = max(4, math.ceil((end - begin) * self.fastest))
        pushes = self._pushes(begin, end, 2 * n)
        rough = self._steps(begin, end, start, pushes)
        for _ in range(FINEST):
            between = self._pushes(begin, end, 2 * len(pushes) - 2, odd=True)
            pushes = np.insert(pushes, np.arange(1, len(pushes)), between)
            fine = self._steps(begin, end, start, pushes)
            # Of order four, so the finer answer is some fifteen times better than this.
            miss = float(np.max(np.abs(fine[1][::2, 0] - rough[1][:, 0])))
            if miss <= 15.0 * tolerance:
                return fine
            rough = fine
        raise ConvergenceError(
            f"halving the steps must settle the motion to {tolerance:.1e}, got changes of {miss:.1e} "
            f"with {len(pushes) // 2} steps"
        )

    def _pushes(self, begin: float, end: float, intervals: int, *, odd: bool = False) -> Array:
        """Return the loads at the ends of equal intervals, or at every second of them."""
        times = np.linspace(begin, end, intervals + 1)
        times[0] = np.nextafter(begin, end)  # the load after a jump
        chosen = times[1::2] if odd else times
        values = [self.load(t) for t in (self.law.time_scale * chosen).tolist()]
        return np.array(values, dtype=float) / self.law.force_scale

    def _steps(self, begin: float, end: float, start: Array, pushes: Array) -> _Part:
        """Return equal steps of order four, compiled (`native/loops/ride.h`).

        `pushes`, (2 n + 1,), are the loads at the ends and middles of the steps.
        """
        law, n = self.law, len(pushes) // 2
        parts = law.A, law.B[:, 0], law.C[0]
        matrices = [np.ascontiguousarray(matrix, dtype=float) for matrix in parts]
        static = float(law.D[0, 0]), law.offset, law.span, law.exponent, law.operating
        numbers = structure("rf_ride_law")(
            law.order, *(matrix.ctypes.data for matrix in matrices), *static, self.W
        )
        first, loads = np.ascontiguousarray(start, dtype=float), np.ascontiguousarray(pushes, dtype=float)
        y = np.empty((n + 1, len(first)))
        arguments = first.ctypes.data, (end - begin) / n, n, loads.ctypes.data, y.ctypes.data
        if loops()["rf_ride"](byref(numbers), *arguments):
            raise MemoryError("no memory for the steps of a ball")
        return np.linspace(begin, end, n + 1), y


@arguments
def ball_transient(
    law: ContactLaw,
    *,
    mass: float,
    load: Callable[[float], float],
    start: float,
    duration: float,
    velocity: float = 0.0,
    samples: int = 2001,
    rtol: float = 1e-6,
) -> Trajectory:
    """Return the motion mass z'' = force - load(t) of a ball on a contact law.

    Compiled Runge-Kutta steps of order four, halved until the motion settles.

    Parameters
    ----------
    law : ContactLaw
        Law in SI, or dimensionless; then mass is W/(2 pi/3) and load is f.
    mass : float [kg]
    load : callable
        Force towards the plane over time [N]; integration stops at its `breakpoints`, if it has that
        attribute. At a jump it must return the value before the jump.
    start, velocity : float [m, m/s]
        Approach and its rate at t = 0; the contact has rested at the start until then.
    duration : float [s]
    samples : int
        Number of times at which the motion is returned.
    rtol : float
        Tolerance of the approach, in units of the film thickness.

    Returns
    -------
    Trajectory
        Signals `z`, `vz` and `force_z`.

    Raises
    ------
    ConvergenceError
        If the motion does not settle; `partial` is the motion until the jump before.

    Warns
    -----
    ValidityWarning
        If the force leaves the `load_range` of the law.
    """
    require_positive("mass", mass)
    require_positive("duration", duration)
    require_number("start", start)
    rider = _rider(law, mass, load)
    span = duration / law.time_scale
    jumps = sorted(t / law.time_scale for t in breakpoints(load) if 0.0 < t < duration)
    delta = start / law.film_scale
    y = np.array([delta, velocity * law.time_scale / law.film_scale, *law.resting(delta)])
    parts: list[_Part] = []
    for begin, end in zip([0.0, *jumps], [*jumps, span], strict=True):
        try:
            parts.append(rider.part(begin, end, y, rtol))
        except ConvergenceError as error:
            raise ConvergenceError(str(error), _motion(rider, parts, samples)) from error
        y = parts[-1][1][-1]
    _require_range(law, np.concatenate([rider.force(rows) for _, rows in parts]))
    return _motion(rider, parts, samples)


def _require_range(law: ContactLaw, force: Array) -> None:
    lowest, highest = law.load_range
    if force.min() < lowest or force.max() > highest:
        warn_user(
            f"force must stay within {lowest:.6g} and {highest:.6g}, the loads to which the law was fitted, "
            f"got {force.min():.3g} to {force.max():.3g}: fit the law at a load in the middle "
            "(argument load of reduce_contact and reduce_ball), or take the full film"
        )


def _rider(law: ContactLaw, mass: float, load: Callable[[float], float]) -> _Rider:
    W = mass * law.film_scale / (law.time_scale**2 * law.force_scale)
    poles = np.abs(np.linalg.eigvals(law.A)) if law.order else np.zeros(1)
    natural = math.sqrt(law.exponent / law.span / W)
    return _Rider(law, W, max(natural, float(poles.max())), load)


def _motion(rider: _Rider, parts: list[_Part], samples: int) -> Trajectory:
    """Return equally spaced samples of the parts, by interpolation of order four."""
    if not parts:
        return Trajectory(time=np.zeros(0), signals={}, work={"steps": 0})
    law, time = rider.law, np.linspace(0.0, parts[-1][0][-1], samples)
    rows = np.concatenate([_sampled(part, time, k == 0) for k, part in enumerate(parts)])
    signals = {
        "z": rows[:, 0] * law.film_scale,
        "vz": rows[:, 1] * law.film_scale / law.time_scale,
        "force_z": rider.force(rows),
    }
    steps = sum(len(times) - 1 for times, _ in parts)
    units = {"z": "m", "vz": "m/s", "force_z": "N"} if law.film_scale != 1.0 else {}
    return Trajectory(time=time * law.time_scale, signals=signals, work={"steps": steps}, units=units)


def _sampled(part: _Part, time: Array, first: bool) -> Array:
    """Return y at the times within a part."""
    times, y = part
    begin, end = times[0], times[-1]
    inside = time[((time > begin) | (first & (time == begin))) & (time <= end)]
    k = np.minimum(np.searchsorted(times, inside, side="right"), len(times) - 1) - 1
    step = times[1] - times[0]
    share = ((inside - times[k]) / step)[:, None]
    before, after = y[k], y[k + 1]
    rows = np.asarray(before + share * (after - before), dtype=float)
    # Hermite, where rates are known: of the approach, the velocity.
    rows[:, 0], _ = cubic(before[:, 0], after[:, 0], step * before[:, 1], step * after[:, 1], share[:, 0])
    return rows
