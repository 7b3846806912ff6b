"""The protocols that everything pluggable obeys: Model, Dynamic, Switched, Stepped.

A model maps (t, x, u), that is time [s], state (n_states,) and input (n_inputs,), to its output
(n_outputs,), all in the SI units of its signals. Linearization, export, co-simulation and charts know
these protocols and never a particular bearing.
"""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .signals import Signal

Array = NDArray[np.float64]


class Linearization(NamedTuple):
    """The exact first derivatives of a model at a state: dx' = A dx + B du, dy = C dx + D du.

    Attributes
    ----------
    A : ndarray, shape (n_states, n_states)
    B : ndarray, shape (n_states, n_inputs)
    C : ndarray, shape (n_outputs, n_states)
    D : ndarray, shape (n_outputs, n_inputs)
    """

    A: Array
    B: Array
    C: Array
    D: Array


def static_linearization(feedthrough: Array) -> Linearization:
    """Return the linearization of a model without states from its matrix D (n_outputs, n_inputs)."""
    n_outputs, n_inputs = feedthrough.shape
    return Linearization(np.zeros((0, 0)), np.zeros((0, n_inputs)), np.zeros((n_outputs, 0)), feedthrough)


@runtime_checkable
class Model(Protocol):
    """A model with inputs and outputs; without states it is a static map."""

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The input signals, in the order of u."""

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The output signals, in the order of y."""

    @property
    def states(self) -> tuple[Signal, ...]:
        """The state signals, in the order of x."""

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the output, shape (n_outputs,).

        Parameters
        ----------
        t : float [s]
            Time.
        x : array_like, shape (n_states,)
            State, in the SI units of `states`.
        u : array_like, shape (n_inputs,)
            Input, in the SI units of `inputs`.
        """

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at (t, x, u)."""


@runtime_checkable
class Dynamic(Model, Protocol):
    """A model with states that an ODE solver integrates."""

    @property
    def initial_state(self) -> Array:
        """The state at t = 0, shape (n_states,)."""

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt, shape (n_states,); the arguments are those of `output`."""


@runtime_checkable
class Switched(Protocol):
    """Further method of a Dynamic model that is only piecewise smooth, because of clamps or contacts."""

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the switching functions, shape (n_events,): the model is smooth while none changes sign.

        The arguments are those of `Model.output`.
        """


@runtime_checkable
class Stepped(Protocol):
    """A model with a time integrator of its own; it exports to Co-Simulation only.

    Its outputs follow from its state, not from the present inputs, which act in the next step.
    """

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The input signals, in the order of u."""

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The output signals, in the order of y."""

    def start(self, u: ArrayLike) -> Any:
        """Return the steady state for the input u; copy.deepcopy must be able to copy it."""

    def step(self, state: Any, t: float, u: ArrayLike, dt: float) -> tuple[Any, Array, Any]:
        """Advance from t by dt under u; return the new state, the output and a report.

        If it raises an error, the old state is still valid.

        Parameters
        ----------
        state : object
            State as `start` or an earlier step returned it.
        t : float [s]
            Time at the start of the step.
        u : array_like, shape (n_inputs,)
            Input, in the SI units of `inputs`, held over the step.
        dt : float [s]
            Length of the step.
        """

    def answer(self, state: Any) -> Array:
        """Return the output of a state, shape (n_outputs,)."""

    def pack(self, state: Any) -> bytes:
        """Return a state as bytes, from which it is restored exactly."""

    def unpack(self, content: bytes) -> Any:
        """Return the state in bytes that `pack` made.

        Parameters
        ----------
        content : bytes
            A state, as `pack` made it.
        """


def stops(model: Model, start: float, end: float) -> list[float]:
    """Return the times [s] at which an integration stops: the model's kinks after start, then the end."""
    return [*(t for t in breakpoints(model) if start < t < end), end]


def breakpoints(of: object) -> tuple[float, ...]:
    """Return the `breakpoints` of a model, or of a load over time; none where it has none."""
    return tuple(getattr(of, "breakpoints", ()))
