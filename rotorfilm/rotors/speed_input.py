"""A rotor whose speed is an input, so that whoever runs it may vary the speed."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import InputError, require_kind
from ..core.inputs import quantities
from ..core.model import Array, Linearization
from ..core.signals import Signal
from .motor import ANGLE
from .profile import SpeedProfile
from .rigid import RigidRotor
from .structure import AroundRotor, FlexibleRotor

ACCELERATION = Signal(
    name="prescribed_acceleration",
    unit="rad/s2",
    nominal=1.0,
    description="angular acceleration, the rate of the speed",
)


@quantities
@dataclass(frozen=True, kw_only=True)
class SpeedInputRotor(AroundRotor):
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
        if isinstance(self.rotor.speed, SpeedProfile):
            raise InputError(
                f"rotor.speed must be a number, as the speed is an input, got {self.rotor.speed!r}"
            )
        _ = self.rotor.operators

    @property
    def stations(self) -> tuple[str, ...]:  # type: ignore[override]
        """The stations of the rotor."""
        return self.rotor.structure.stations

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
