"""A flexible rotor at constant speed as a linear system, unbalance and weight included: it has a kernel."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import InputError
from ..core.inputs import quantities
from ..core.model import Array, Linearization
from ..core.signals import Signal
from ..native.spec import NativeSpec
from .profile import SpeedProfile
from .rigid import RigidRotor
from .structure import AroundRotor, FlexibleRotor

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
        if isinstance(self.rotor.speed, SpeedProfile):
            raise InputError(f"rotor must have a constant speed, got {self.rotor.speed!r}")
        _ = self.rotor.operators

    @property
    def states(self) -> tuple[Signal, ...]:
        """The states of the rotor, the direction of the unbalance and a constant."""
        return (*self.rotor.states, *TURNING)

    @property
    def initial_state(self) -> Array:
        """The state at t = 0."""
        return np.concatenate([self.rotor.initial_state, [1.0, 0.0, 1.0]])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return A x + B u; t is not used."""
        A, B, _, _ = self._matrices
        slope: Array = A @ np.asarray(x, dtype=float) + B @ np.asarray(u, dtype=float)
        return slope

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return C x; t and u are not used."""
        outputs: Array = self._matrices.C @ np.asarray(x, dtype=float)
        return outputs

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
