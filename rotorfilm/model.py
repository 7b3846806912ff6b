"""The protocols that everything pluggable obeys: Model, Dynamic, Kinked, Switched, Stepped, Reaction.

A model maps (t, x, u), that is time [s], state (n_states,) and input (n_inputs,), to its output
(n_outputs,), all in the SI units of its signals. Linearization, export, co-simulation and charts know
these protocols and never a particular bearing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InputError, brief, require_kind
from .reactions.added_mass import require_massless
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
    """Anything that turns inputs into outputs; without states it is a static map."""

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
class Portable(Protocol):
    """What would make something large on first use, as a film its table."""

    def portable(self) -> Any:
        """Return an equal object that has it in its fields, for an FMU that must not make it again."""


@runtime_checkable
class Dynamic(Model, Protocol):
    """A model with states that an ODE solver integrates."""

    @property
    def initial_state(self) -> Array:
        """The state at t = 0, shape (n_states,)."""

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt, shape (n_states,), of the arguments of `output`."""


@runtime_checkable
class Kinked(Protocol):
    """What a Dynamic may add, if its derivative is smooth in time only piece by piece."""

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """The times [s] at which an integrator should stop, in rising order."""


@runtime_checkable
class Switched(Protocol):
    """What a Dynamic may add, if clamps or contacts make it smooth only piece by piece."""

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the switching functions, shape (n_events,): the model is smooth while none changes sign.

        The arguments are those of `Model.output`.
        """


@runtime_checkable
class Stepped(Protocol):
    """A model with a time integrator of its own; it exports to Co-Simulation only.

    Its outputs belong to its state, not to the present inputs: these act in the next step.
    """

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The input signals, in the order of u."""

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The output signals, in the order of y."""

    def start(self, u: ArrayLike) -> Any:
        """Return the state that is stationary under the input u; the state copies by copy.deepcopy."""

    def step(self, state: Any, t: float, u: ArrayLike, dt: float) -> tuple[Any, Array, Any]:
        """Advance from t by dt under u; return the new state, the output and a report.

        Where it raises, the old state is still good.

        Parameters
        ----------
        state : object
            As `start` or an earlier step returned it.
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
        """Return a state as bytes, to the last bit."""

    def unpack(self, content: bytes) -> Any:
        """Return the state in bytes that `pack` made.

        Parameters
        ----------
        content : bytes
            A state, as `pack` made it.
        """


class JournalForce(Protocol):
    """What a search for a position, or for an orbit, asks of a bearing."""

    @property
    def clearance(self) -> float:
        """Radial clearance [m]: the journal center stays within this distance of the origin."""

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal [N], shape (2, ...).

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
            Journal center from the bearing center.
        velocity : array_like, shape (2, ...) [m/s]
            Of the journal center.
        speed : array_like, shape (...) [rad/s]
            Angular speed about +z, either sign.
        """

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d(force_x, force_y)/d(x, y, vx, vy, speed), shape (2, 5, ...)."""


@runtime_checkable
class Reaction(JournalForce, Model, Protocol):
    """A model whose outputs begin with FORCE_OUTPUTS, on the journal, and its inputs with JOURNAL_INPUTS."""


def require_reaction(name: str, value: object, kind: Any = Reaction, *, heavy: bool = False) -> None:
    """Raise InputError unless `value` is a Reaction or of a lesser kind, with added mass only if `heavy`."""
    require_kind(name, value, kind, "a Reaction such as a JournalBearing, or what as_reaction makes")
    if not heavy:
        require_massless(name, value)


def require_reactions(name: str, values: object, kind: Any = Reaction, *, heavy: bool = False) -> None:
    """Raise InputError unless `values` is a mapping from names of stations to Reactions, or a lesser kind."""
    if not isinstance(values, Mapping):
        raise InputError(f"{name} must be a mapping such as {{'left': film}}, got {brief(values)}")
    for station, value in values.items():
        require_reaction(f"{name}[{station!r}]", value, kind, heavy=heavy)


class Force(Protocol):
    """A force for plain numbers."""

    def __call__(self, x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
        """Return force_x, force_y [N]."""


class Tangent(Protocol):
    """Force and derivatives for plain numbers."""

    def __call__(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, Sequence[float]]:
        """Return force_x, force_y [N] and the ten derivatives of `Reaction.jacobian`, row by row."""


@runtime_checkable
class TangentReaction(Protocol):
    """What a Reaction may add: force and derivatives from one call, for searches that go state by state."""

    def prepare_tangent(self) -> Tangent:
        """Return the function of (x, y, vx, vy, speed) [m, m/s, rad/s]; it raises what `jacobian` raises."""


@runtime_checkable
class PreparedReaction(Protocol):
    """What a Reaction may add: its force as a function of five numbers, for loops that go state by state."""

    def prepare(self) -> Force:
        """Return the function of (x, y, vx, vy, speed) [m, m/s, rad/s]; it raises what `force` raises."""


def prepared_force(reaction: Reaction) -> Force:
    """Return the force of any reaction as a function of five numbers."""
    return reaction.prepare() if isinstance(reaction, PreparedReaction) else force_of(reaction)


def force_of(reaction: Reaction) -> Force:
    """Return the force of a reaction as a function of five numbers, by its `force`."""

    def force(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
        force_x, force_y = np.asarray(reaction.force((x, y), (vx, vy), speed)).tolist()
        return force_x, force_y

    return force


def prepared_tangent(reaction: Reaction) -> Tangent:
    """Return force and derivatives of any reaction as a function of five numbers."""
    return reaction.prepare_tangent() if isinstance(reaction, TangentReaction) else tangent_of(reaction)


@runtime_checkable
class LimitedReaction(Protocol):
    """What a Reaction may add: how far from the center its force is meant."""

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio to which the force is meant; 1 where it is meant up to the wall."""


def largest_eccentricity_ratio(reaction: Reaction) -> float:
    """Return the eccentricity ratio to which any reaction is meant; 1 where it does not say."""
    return reaction.largest_eccentricity_ratio if isinstance(reaction, LimitedReaction) else 1.0


def tangent_of(reaction: Reaction) -> Tangent:
    """Return force and derivatives of a reaction by its `force` and `jacobian`."""

    def tangent(
        x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, Sequence[float]]:
        position, velocity = np.array((x, y)), np.array((vx, vy))
        force_x, force_y = np.asarray(reaction.force(position, velocity, speed)).tolist()
        return force_x, force_y, reaction.jacobian(position, velocity, speed).ravel().tolist()

    return tangent


def stops(model: Model, start: float, end: float) -> list[float]:
    """Return the times [s] at which an integration stops: the model's kinks after start, then the end."""
    return [*(t for t in breakpoints(model) if start < t < end), end]


def breakpoints(of: object) -> tuple[float, ...]:
    """Return the `breakpoints` of a model, or of a load over time; none where it has none."""
    return tuple(of.breakpoints) if isinstance(of, Kinked) else ()
