"""A linear rotor at constant speed as a state space that moves by itself, so that it becomes a native FMU."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError
from ..model import Array, Dynamic, Linearization
from ..native.spec import NativeSpec
from ..signals import Signal, names

TURNING = ("steady", "cosine", "sine")
"""States besides the rotor's: 1, and cosine and sine of the angle turned."""

AGREEMENT = 1e-9
"""Largest deviation of the rotor from the state space, relative to what acts on it."""


@dataclass(frozen=True, kw_only=True)
class SteadyRotor:
    """A linear rotor at constant speed, its weight and unbalance driven by three states that turn with it.

        x' = A x + B u + w0 + w1 cos(speed t) + w2 sin(speed t)

    is one autonomous state space in x, 1, cos and sin. It has a kernel in the C library, exact over any
    step, where the rotor itself has none.

    Parameters
    ----------
    rotor : Dynamic
        Linear, at constant speed, such as a `ShaftRotor` or `ReducedRotor`.

    Raises
    ------
    InputError
        If its speed changes or is not told, or it is no such rotor.
    """

    rotor: Dynamic

    def __post_init__(self) -> None:
        if "speed" not in names(self.rotor.outputs):
            raise InputError(f"rotor must have the output speed, got {names(self.rotor.outputs)}")
        if len(getattr(self.rotor, "breakpoints", ())):
            raise InputError(f"rotor must have a constant speed, got {self.rotor!r}")
        found = self.linearization(0.0, self.initial_state, self._no_input)
        probe = self.initial_state * 1.5
        probe[-2:] = np.cos(1.0), np.sin(1.0)
        probe[-3] = 1.0
        t = 1.0 / self._speed if self._speed else 1.0
        exact = self.rotor.derivative(t, probe[:-3], self._no_input)
        own = found.A[: len(exact)] @ probe
        size = np.abs(found.A[: len(exact)]) @ np.abs(probe)
        if np.any(np.abs(own - exact) > AGREEMENT * np.max(size)):
            raise InputError(f"rotor must be linear at constant speed, got {self.rotor!r}")

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The inputs of the rotor."""
        return self.rotor.inputs

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The outputs of the rotor."""
        return self.rotor.outputs

    @property
    def states(self) -> tuple[Signal, ...]:
        """The states of the rotor, 1, and cosine and sine of the angle turned."""
        turning = (Signal(name=n, unit="1", nominal=1.0, description=f"{n} of the drive") for n in TURNING)
        return (*self.rotor.states, *turning)

    @property
    def initial_state(self) -> Array:
        """The state at t = 0."""
        return np.concatenate([self.rotor.initial_state, [1.0, 1.0, 0.0]])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt."""
        A, B, _, _ = self._matrices
        slope: Array = A @ np.asarray(x, dtype=float) + B @ np.asarray(u, dtype=float)
        return slope

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs of the rotor."""
        _, _, C, D = self._matrices
        values: Array = C @ np.asarray(x, dtype=float) + D @ np.asarray(u, dtype=float)
        return values

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the matrices."""
        return self._matrices

    def native(self) -> NativeSpec:
        """Return the kernel `linear` with the matrices."""
        return NativeSpec(kernel="linear", tables=self._matrices._asdict())

    @cached_property
    def _no_input(self) -> Array:
        return np.zeros(len(self.rotor.inputs))

    @cached_property
    def _speed(self) -> float:
        at = self.rotor.output(0.0, self.rotor.initial_state, self._no_input)
        return float(at[names(self.rotor.outputs).index("speed")])

    @cached_property
    def _matrices(self) -> Linearization:
        rest, n = np.zeros(len(self.rotor.states)), len(self.rotor.states)
        A, B, C, D = self.rotor.linearization(0.0, rest, self._no_input)
        quarter = 0.5 * np.pi / self._speed if self._speed else 0.0
        start, side, back = (
            self.rotor.derivative(k * quarter, rest, self._no_input) for k in (0.0, 1.0, 2.0)
        )
        steady = 0.5 * (start + back)
        whole = np.zeros((n + 3, n + 3))
        whole[:n, :n] = A
        whole[:n, n:] = np.array([steady, start - steady, side - steady]).T
        whole[n + 1 :, n + 1 :] = self._speed * np.array([[0.0, -1.0], [1.0, 0.0]])
        constant = np.zeros((len(C), 3))
        constant[:, 0] = self.rotor.output(0.0, rest, self._no_input)
        return Linearization(
            whole, np.vstack([B, np.zeros((3, B.shape[1]))]), np.hstack([C, constant]), D.copy()
        )
