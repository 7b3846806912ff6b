"""Rotors with a prescribed speed: as an input, which whoever runs it may vary, or constant, with a kernel."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import require_kind
from ..core.inputs import quantities
from ..core.model import Array, Linearization
from ..core.signals import Signal
from ..native.spec import NativeSpec
from .motor import ANGLE
from .profile import require_constant_speed
from .rigid import RigidRotor
from .structure import AroundRotor, AroundStructure, FlexibleRotor

ACCELERATION = Signal(
    name="prescribed_acceleration",
    unit="rad/s2",
    nominal=1.0,
    description="angular acceleration, the rate of the speed",
)


@quantities
@dataclass(frozen=True, kw_only=True)
class SpeedInputRotor(AroundStructure):
    """A rotor with the speed and its rate as inputs: a Dynamic model, for `mount` and FMUs.

    Gyroscopic effect, rotating damping, bearings and unbalance follow the input `prescribed_speed`. The angle
    turned is its integral, a state. The input `prescribed_acceleration` is the rate of the speed. Only the
    unbalance feels it, by a tangential force: the share acceleration / speed^2 of its radial force, which is
    left out where the input stays 0.

    Parameters
    ----------
    rotor : RigidRotor or FlexibleRotor
        Rotor without a loss factor; its speed, a number, does not matter.

    Raises
    ------
    InputError
        If the speed is a profile, or the rotor has a loss factor.
    """

    rotor: RigidRotor | FlexibleRotor

    def __post_init__(self) -> None:
        require_kind("rotor", self.rotor, RigidRotor | FlexibleRotor, "a rotor such as a ShaftRotor")
        require_constant_speed(self.rotor, "rotor.speed must be a number, as the speed is an input")

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """The inputs of the rotor, the speed, and the angular acceleration."""
        speed = replace(self.rotor.outputs[-1], name="prescribed_speed")
        return (*self.rotor.inputs, speed, ACCELERATION)

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """The states of the rotor, and the angle turned."""
        return (*self.rotor.states, ANGLE)

    @property
    def initial_state(self) -> Array:
        """The state of the rotor at t = 0, and the angle 0."""
        return np.append(self.rotor.initial_state, 0.0)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt for the forces u [N] at the stations, the speed [rad/s] and its rate [rad/s2]."""
        state, angle, force, (speed, rate) = self._parts(x, u)
        model, cos, sin = self.rotor.operators, math.cos(angle), math.sin(angle)
        turned = np.array([speed**2 * cos + rate * sin, speed**2 * sin - rate * cos])
        rates = model.steady @ state + speed * (model.by_speed @ state) + model.push @ force
        return np.append(rates + model.weight + model.unbalance @ turned, speed)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs of the rotor, the speed among them."""
        state, _, _, (speed, _) = self._parts(x, u)
        return np.append(self.rotor.operators.sense @ state, speed)

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives by states, forces, speed and angular acceleration."""
        state, angle, force, (speed, rate) = self._parts(x, u)
        model, cos, sin = self.rotor.operators, math.cos(angle), math.sin(angle)
        n, m, outputs = len(state), len(force), len(model.sense) + 1
        A, B = np.zeros((n + 1, n + 1)), np.zeros((n + 1, m + 2))
        A[:n, :n] = model.steady + speed * model.by_speed
        A[:n, n] = model.unbalance @ [rate * cos - speed**2 * sin, rate * sin + speed**2 * cos]
        B[:n, :m] = model.push
        B[:n, m] = model.by_speed @ state + model.unbalance @ [2.0 * speed * cos, 2.0 * speed * sin]
        B[:n, m + 1] = model.unbalance @ [sin, -cos]
        B[n, m] = 1.0
        C, D = np.zeros((outputs, n + 1)), np.zeros((outputs, m + 2))
        C[:-1, :n] = model.sense
        D[-1, m] = 1.0
        return Linearization(A, B, C, D)

    def _parts(self, x: ArrayLike, u: ArrayLike) -> tuple[Array, float, Array, tuple[float, float]]:
        """Return the state of the rotor, the angle, the forces, and speed and acceleration."""
        state, given = np.asarray(x, dtype=float), np.asarray(u, dtype=float)
        return state[:-1], float(state[-1]), given[:-2], (float(given[-2]), float(given[-1]))


TURNING = (
    Signal(name="unbalance_cos", unit="1", nominal=1.0, description="cosine of the angle turned"),
    Signal(name="unbalance_sin", unit="1", nominal=1.0, description="sine of the angle turned"),
    Signal(name="steady", unit="1", nominal=1.0, description="1: what weight and speed are multiples of"),
)
"""States that carry what does not depend on the rotor: they begin at (1, 0, 1)."""


@quantities
@dataclass(frozen=True, kw_only=True)
class SteadyRotor(AroundRotor):
    """A rotor at constant speed: a Dynamic model with a kernel in the C library.

    x' = A x + B u, y = C x with the states of the rotor, the direction of its unbalance and a state that
    stays at 1. The kernel uses the exact solution under held forces, however stiff the shaft is. Its cost
    grows with the square of the number of states, so give it a `ReducedRotor`.

    Parameters
    ----------
    rotor : FlexibleRotor or RigidRotor
        Rotor with a constant speed; inputs, outputs and initial state are its own.

    Raises
    ------
    InputError
        If the speed is a profile, or the rotor has a loss factor.
    """

    rotor: FlexibleRotor | RigidRotor

    def __post_init__(self) -> None:
        require_constant_speed(self.rotor, "rotor must have a constant speed")

    @property
    def states(self) -> tuple[Signal, ...]:
        """The states of the rotor, the direction of the unbalance and a constant."""
        return (*self.rotor.states, *TURNING)

    @property
    def initial_state(self) -> Array:
        """The state at t = 0."""
        return np.concatenate([self.rotor.initial_state, [1.0, 0.0, 1.0]])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of the states, A x + B u; the time t is not used."""
        A, B, _, _ = self._matrices
        return A @ np.asarray(x, dtype=float) + B @ np.asarray(u, dtype=float)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs, C x; the time t and the forces u are not used."""
        return self._matrices.C @ np.asarray(x, dtype=float)

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the matrices."""
        return Linearization(*(matrix.copy() for matrix in self._matrices))

    def native(self) -> NativeSpec:
        """Return the kernel `linear` with the matrices."""
        return NativeSpec(kernel="linear", tables=self._matrices._asdict())

    @cached_property
    def _matrices(self) -> Linearization:
        """The matrices, with columns for the direction of the unbalance and for weight and speed."""
        rotor, speed = self.rotor, float(self.rotor.speed)  # type: ignore[arg-type]
        n, m, p = len(rotor.states), len(rotor.inputs), len(rotor.outputs)
        push = rotor.operators
        A = np.zeros((n + 3, n + 3))
        inner, B, C, D = rotor.linearization(0.0, rotor.initial_state, np.zeros(m))
        A[:n, :n] = inner
        A[:n, n : n + 2] = speed**2 * push.unbalance
        A[:n, n + 2] = push.weight
        A[n, n + 1], A[n + 1, n] = -speed, speed
        whole = np.zeros((p, n + 3))
        whole[:, :n] = C
        whole[-1, -1] = speed
        return Linearization(A, np.vstack([B, np.zeros((3, m))]), whole, D)
