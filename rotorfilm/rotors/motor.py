"""A rotor whose speed follows from the torque that drives it: whirl takes power, and may hold it back."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import InputError, require_kind, require_non_negative, require_number, require_positive
from ..core.inputs import quantities
from ..core.model import Array, Linearization, breakpoints
from ..core.signals import Signal
from .profile import SpeedProfile, require_constant_speed
from .rigid import RigidRotor
from .structure import AroundStructure, FlexibleRotor, beside, force_rows

# The torque of a motor over its speed.


@runtime_checkable
class DriveTorque(Protocol):
    """What drives a shaft, all resistances of machine and bearings taken off: a motor of one's own.

    It may tell its `breakpoints`, the times of kinks [s], and a `nominal_speed` [rad/s], the largest speed
    that it leads to. Compiled runs relate errors of velocities to this speed. Without it they take the speed
    at t = 0, and a run from standstill then needs several times as many steps.
    """

    def torque(self, t: float, speed: float) -> float:
        """Return the torque about +z [N m] at a time [s] and an angular speed [rad/s]."""

    def slope(self, t: float, speed: float) -> float:
        """Return d torque / d speed [N m s]."""


@quantities
@dataclass(frozen=True, kw_only=True)
class LinearMotor:
    """A motor whose torque falls linearly to zero at its idle speed, with a resisting torque.

        torque = stall_torque (1 - speed / idle_speed) - resistance speed

    Parameters
    ----------
    stall_torque : float [N m]
        Torque at rest, in the direction of the idle speed; positive.
    idle_speed : float or SpeedProfile [rad/s]
        Speed without load. A profile describes a frequency converter: the torque line is shifted with it,
        with the slope stall_torque / |idle_speed| of the largest idle speed.
    resistance : float [N m s/rad]
        Resisting torque of bearings, windage and load, per rad/s.

    Raises
    ------
    InputError
        If the torque is not positive, the resistance negative, or the idle speed 0 at all times.
    """

    stall_torque: float
    idle_speed: float | SpeedProfile
    resistance: float = 0.0

    def __post_init__(self) -> None:
        require_positive("stall_torque", self.stall_torque)
        require_non_negative("resistance", self.resistance)
        if not isinstance(self.idle_speed, SpeedProfile):
            require_number("idle_speed", self.idle_speed)
        if not self._largest > 0.0:
            raise InputError(f"idle_speed must not be 0 at all times, got {self.idle_speed!r}")

    def torque(self, t: float, speed: float) -> float:
        """Return the torque about +z [N m] at a time [s] and an angular speed [rad/s]."""
        return self.stall_torque / self._largest * (self._profile.speed(t) - speed) - self.resistance * speed

    def slope(self, t: float, speed: float) -> float:
        """Return d torque / d speed [N m s], the same at all times and speeds."""
        return -self.stall_torque / self._largest - self.resistance

    @property
    def nominal_speed(self) -> float:
        """Largest idle speed [rad/s], without its sign."""
        return self._largest

    @property
    def line(self) -> Array:
        """The torque as the C library reads it (`rf_line_torque_at` of native/loops/motor.h)."""
        profile = self._profile
        slope = self.stall_torque / self._largest
        return np.array([slope, self.resistance, len(profile.times), *profile.times, *profile.speeds])

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times [s] at which the idle speed has kinks."""
        return self._profile.times if len(self._profile.times) > 1 else ()

    # Asked in each evaluation of a run.
    @cached_property
    def _profile(self) -> SpeedProfile:
        given = self.idle_speed
        return given if isinstance(given, SpeedProfile) else SpeedProfile.constant(given)

    @cached_property
    def _largest(self) -> float:
        return max(abs(speed) for speed in self._profile.speeds)


# A rotor whose speed follows from the torque that drives it: whirl takes power, and may hold it back.


ANGLE = Signal(name="angle", unit="rad", nominal=1.0, description="angle turned since t = 0")


class _Turn(NamedTuple):
    """An instant: q, q', speed; forces of the unbalance per angular acceleration and per square of speed."""

    q: Array
    v: Array
    speed: float
    across: Array
    outward: Array


@quantities
@dataclass(frozen=True, kw_only=True)
class MotorDrivenRotor(AroundStructure):
    """A rotor that is driven by a torque, instead of a given speed: a Dynamic model.

    With the angle p turned, w = p', the coordinates q of the rotor and its unbalance U (docs of `Structure`),

        M q'' + U n p'' = T' f + weight + w^2 U e - (C + w G) q' - (K + w H) q,
        inertia p'' + (U n)' q'' = torque + (U n)' g + (J q)' C_i (q' - w J q),

    e = (cos p, sin p), n = e', g the acceleration of gravity and J q the displacement turned by +90 deg. C_i
    is the rotating damping, which acts on the whirl and on the torque consistently. Both equations follow
    from one kinetic energy (for a mass on springs: Dimentberg et al. 1997, Nonlinear Dynamics 13, 171-187),
    so the whirl and the losses consume the power of the torque. A weak motor may get stuck at a critical
    speed (Sommerfeld 1902).

    The shaft does not twist, and the torque follows its tilt. The friction of films does not brake the rotor:
    include it in the torque.

    Parameters
    ----------
    rotor : RigidRotor or FlexibleRotor
        The rotor; its speed, a number, is that at t = 0.
    inertia : float [kg m2]
        Polar moment of inertia of all rotating parts.
    torque : DriveTorque
        Driving torque, such as a `LinearMotor`.

    Raises
    ------
    InputError
        If the speed is a profile, the rotor has a loss factor or twists, or the inertia is not larger than
        that of the unbalance.
    """

    rotor: RigidRotor | FlexibleRotor
    inertia: float
    torque: DriveTorque

    def __post_init__(self) -> None:
        require_kind("rotor", self.rotor, RigidRotor | FlexibleRotor, "a rotor such as a JeffcottRotor")
        require_kind("torque", self.torque, DriveTorque, "a torque such as a LinearMotor")
        require_positive("inertia", self.inertia)
        require_constant_speed(
            self.rotor,
            "rotor.speed must be a number, the speed at t = 0",
            ": a profile of the idle speed of a LinearMotor drives it",
        )
        s = self.rotor.structure
        if s.twist is not None:
            raise InputError("rotor must not twist beside a motor, got one with torsional=True")
        taken = float(np.linalg.eigvalsh(s.unbalance.T @ np.linalg.solve(s.mass, s.unbalance)).max())
        if not self.inertia > taken:
            raise InputError(
                f"inertia must be larger than that of the unbalance, {taken:.6g} kg m2, got {self.inertia!r}"
            )

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """The outputs of the rotor, the last of them the speed, and the angle turned."""
        return (*self.rotor.outputs, ANGLE)

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """The states of the rotor, the angle turned and the speed."""
        return (*self.rotor.states, ANGLE, self.rotor.outputs[-1])

    @property
    def initial_state(self) -> Array:
        """The state at t = 0."""
        return np.concatenate([self.rotor.initial_state, [0.0, float(self.rotor.speed)]])  # type: ignore[arg-type]

    @property
    def nominal_speed(self) -> float:
        """Largest speed [rad/s] that is known before a run: that at t = 0, and what the torque says."""
        return max(abs(float(self.rotor.speed)), getattr(self.torque, "nominal_speed", 0.0))  # type: ignore[arg-type]

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times [s] at which the torque has kinks."""
        return breakpoints(self.torque)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt at the time t [s] for the forces u [N] at the stations."""
        turn = self._turn(x)
        rates = np.linalg.solve(self._inertias(turn), self._loads(t, turn, np.asarray(u, dtype=float)))
        return np.concatenate([turn.v, rates[:-1], [turn.speed, rates[-1]]])

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs; t and u are not used."""
        state = np.asarray(x, dtype=float)
        return np.concatenate([self.rotor.operators.sense @ state[:-2], [state[-1], state[-2]]])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives."""
        turn = self._turn(x)
        n, forces = len(turn.q), np.asarray(u, dtype=float)
        inertias = self._inertias(turn)
        rates = np.linalg.solve(inertias, self._loads(t, turn, forces))
        by_state = self._load_slopes(t, turn)
        # What the turning unbalance changes of the inertias, at these accelerations.
        by_state[:-1, -2] += turn.outward * rates[-1]
        by_state[-1, -2] += turn.outward @ rates[:-1]
        A, B = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, len(forces)))
        A[:n, n : 2 * n], A[-2, -1] = np.eye(n), 1.0
        rows = [*range(n, 2 * n), 2 * n + 1]
        A[rows] = np.linalg.solve(inertias, by_state)
        push = np.vstack([self._push, np.zeros(len(forces))])
        B[rows] = np.linalg.solve(inertias, push)
        sense = self.rotor.operators.sense
        C = np.zeros((len(sense) + 2, 2 * n + 2))
        C[:-2, :-2], C[-2, -1], C[-1, -2] = sense, 1.0, 1.0
        return Linearization(A, B, C, np.zeros((len(C), len(forces))))

    def energy(self, x: ArrayLike) -> float:
        """Return the energy of a state [J]: kinetic, elastic, and potential of weight and unbalance."""
        turn, s = self._turn(x), self.rotor.structure
        motion = np.append(turn.v, turn.speed)
        kinetic = 0.5 * motion @ self._inertias(turn) @ motion
        return float(
            kinetic + 0.5 * turn.q @ s.stiffness @ turn.q - s.weight @ turn.q - self.gravity @ turn.outward
        )

    def _turn(self, x: ArrayLike) -> _Turn:
        state = np.asarray(x, dtype=float)
        n = len(state) // 2 - 1
        q, v = state[:n], state[n:-2]
        cos, sin = math.cos(state[-2]), math.sin(state[-2])
        unbalance = self.rotor.structure.unbalance
        return _Turn(q, v, float(state[-1]), unbalance @ [-sin, cos], unbalance @ [cos, sin])

    def _inertias(self, turn: _Turn) -> Array:
        inertias = self._balanced_inertias.copy()
        inertias[:-1, -1] = inertias[-1, :-1] = turn.across
        return inertias

    def _loads(self, t: float, turn: _Turn, u: Array) -> Array:
        """Return what acts on the coordinates and on the angle."""
        s, w = self.rotor.structure, turn.speed
        held = (s.damping + w * s.gyroscopic) @ turn.v + (s.stiffness + w * s.circulation) @ turn.q
        turned = self.quarter_turn @ turn.q
        rubbed = turned @ self.rotating_damping @ (turn.v - w * turned)
        torque = self.torque.torque(t, w) + self.gravity @ turn.across + rubbed
        return np.append(self._push @ u + s.weight + w * w * turn.outward - held, torque)

    def _load_slopes(self, t: float, turn: _Turn) -> Array:
        """Return the derivatives of `_loads` by the state."""
        s, w = self.rotor.structure, turn.speed
        turned, inner = self.quarter_turn @ turn.q, self.rotating_damping
        by_turned = inner @ (turn.v - w * turned) - w * (inner.T @ turned)
        by_angle, by_speed = w * w * turn.across, 2.0 * w * turn.outward
        by_speed = by_speed - s.gyroscopic @ turn.v - s.circulation @ turn.q
        on_speed = self.torque.slope(t, w) - turned @ inner @ turned
        columns = [
            -(s.stiffness + w * s.circulation),
            -(s.damping + w * s.gyroscopic),
            by_angle[:, None],
            by_speed[:, None],
        ]
        by_fall = float(-self.gravity @ turn.outward)
        last = [self.quarter_turn.T @ by_turned, inner.T @ turned, np.array([by_fall, on_speed])]
        return np.vstack([np.hstack(columns), np.concatenate(last)])

    @cached_property
    def _balanced_inertias(self) -> Array:
        """The inertias of the coordinates and of the angle without unbalance, shape (N + 1, N + 1)."""
        return np.asarray(beside(self.rotor.structure.mass, np.array([[self.inertia]])))

    @cached_property
    def _push(self) -> Array:
        """What forces at the stations do to the coordinates, shape (N, n_forces)."""
        return force_rows(self.rotor.structure).T

    @cached_property
    def quarter_turn(self) -> Array:
        """What turns a displacement by +90 deg, shape (N, N)."""
        s = self.rotor.structure
        turn = np.kron(np.array([[0.0, -1.0], [1.0, 0.0]]), np.eye(len(s.coordinates)))
        return np.asarray(beside(turn, np.zeros((len(s.others),) * 2)))

    @cached_property
    def rotating_damping(self) -> Array:
        """The rotating damping C_i: H q is that of a displacement turned by -90 deg."""
        return self.rotor.structure.circulation @ self.quarter_turn

    @cached_property
    def gravity(self) -> Array:
        """The acceleration of gravity of each coordinate."""
        rotor = self.rotor
        if isinstance(rotor, RigidRotor):
            return np.array(rotor.gravity)
        return np.asarray(np.linalg.solve(rotor.structure.mass, rotor.structure.weight))
