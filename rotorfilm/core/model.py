"""The protocols that everything pluggable obeys: Model, Dynamic, Switched, Stepped, Reaction.

A model maps (t, x, u), that is time [s], state (n_states,) and input (n_inputs,), to its output
(n_outputs,), all in the SI units of its signals. Linearization, export, co-simulation and charts know
these protocols and never a particular bearing.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InputError, brief, require_kind
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
class Dynamic(Model, Protocol):
    """A model with states that an ODE solver integrates."""

    @property
    def initial_state(self) -> Array:
        """The state at t = 0, shape (n_states,)."""

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt, shape (n_states,), of the arguments of `output`."""


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
    """A model whose outputs begin with FORCE_OUTPUTS, on the journal, and its inputs with JOURNAL_INPUTS.

    What it may add; most have a function of this module that gives the same for every reaction:

    - `prepare()`, its force as a `Force`, for loops that go state by state: `prepared_force`;
    - `prepare_tangent()`, force and derivatives from one call, a `Tangent`: `prepared_tangent`;
    - `largest_eccentricity_ratio`, how far from the center its force is meant, 1 up to the wall;
    - `force_noise(speed)`, a method: the force [N] that roundoff may leave, as of balls or pads;
    - `rest_place(load, speed)`, x, y [m] where the journal rests under a load [N], None if not found;
    - `at_rest()`, the force with its own states at rest under a journal at rest;
    - `rest_state(position, speed)`, the state (n_states,) that rests there;
    - `breakpoints`, the times [s] at which an integrator should stop, in rising order;
    - `carries_load`, False of a reaction that takes no share of the weight, as a seal;
    - `portable()`, an equal object that holds what it would make on first use, for an FMU.
    """


Bearings = Mapping[str, Reaction]
"""Reactions by the names of the stations in which they are."""


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


Force = Callable[[float, float, float, float, float], tuple[float, float]]
"""A force for plain numbers: (x, y, vx, vy, speed) give force_x, force_y [N]."""


Tangent = Callable[[float, float, float, float, float], tuple[float, float, Sequence[float]]]
"""Force and derivatives for plain numbers: the force [N] and the ten of `Reaction.jacobian` row by row."""


def prepared_force(reaction: Reaction) -> Force:
    """Return the force of any reaction as a function of five numbers."""
    prepare = getattr(reaction, "prepare", None)
    return force_of(reaction) if prepare is None else prepare()


def force_of(reaction: Reaction) -> Force:
    """Return the force of a reaction as a function of five numbers, by its `force`."""

    def force(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
        force_x, force_y = np.asarray(reaction.force((x, y), (vx, vy), speed)).tolist()
        return force_x, force_y

    return force


def prepared_tangent(reaction: Reaction) -> Tangent:
    """Return force and derivatives of any reaction as a function of five numbers."""
    prepare = getattr(reaction, "prepare_tangent", None)
    return tangent_of(reaction) if prepare is None else prepare()


def largest_eccentricity_ratio(reaction: Reaction) -> float:
    """Return the eccentricity ratio to which any reaction is meant; 1 where it does not say."""
    return getattr(reaction, "largest_eccentricity_ratio", 1.0)


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
    return tuple(getattr(of, "breakpoints", ()))


# Reactions that leave something of theirs to settle: the temperature of the film, or states of their own.


@runtime_checkable
class Warming(Protocol):
    """A Reaction that may leave the temperature of its film to the balance of its heat."""

    @property
    def is_warming(self) -> bool:
        """Whether it does; then it has no force of its own."""

    def coldest(self) -> float:
        """Return the temperature [K] below which the balance is never found."""

    def at_temperature(self, temperature: float) -> Any:
        """Return the reaction at one temperature of the film [K]."""

    def in_time(self) -> Any:
        """Return the Reaction with states that it is over time."""

    def balanced(self) -> Any:
        """Return the static Reaction that has the temperature of the balance at every state; None without."""

    def balanced_temperature(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature [K] at which the heat of the film balances at one state.

        Parameters
        ----------
        position, velocity : array_like, shape (2,) [m], [m/s]
        speed : float [rad/s]
        """


def in_time(model: Any) -> Any:
    """Return a model as it runs: a reaction that warms has its temperature as a state."""
    return model.in_time() if isinstance(model, Warming) and model.is_warming else model


def settled(reaction: Reaction, position: ArrayLike, speed: float) -> Any:
    """Return a reaction at the temperature that its film has with the journal at rest; any other as it is.

    Parameters
    ----------
    reaction : Reaction
    position : array_like, shape (2,) [m]
    speed : float [rad/s]
    """
    if not (isinstance(reaction, Warming) and reaction.is_warming):
        return reaction
    return reaction.at_temperature(reaction.balanced_temperature(position, np.zeros(2), speed))


def at_rest(reaction: object) -> Any:
    """Return the force of a reaction, as tilting pads, with its states at rest; None without such states.

    That force is a `JournalForce` with `coefficients(position, speed, frequency)`, what the journal feels
    where the states follow; `modes(position, speed, rotor_mass)`, the exponents of a rigid rotor with them
    [1/s], the least damped first; and `settled(found)`, an Equilibrium with what it says of the states.
    """
    force = getattr(reaction, "at_rest", None)
    return None if force is None else force()


@runtime_checkable
class FrequencyDependent(JournalForce, Protocol):
    """A force on a journal at rest of what remembers its motion: its stiffness is K(s) at every exponent."""

    def complex_stiffness(self, position: ArrayLike, speed: float, s: complex) -> NDArray[np.complex128]:
        """Return K(s), shape (2, 2) [N/m]: the force changes by -K(s) q e^(s t) as the journal moves so.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        speed : float [rad/s]
        s : complex [1/s]
        """

    def coefficients(self, position: ArrayLike, speed: float, frequency: float | None = None) -> Any:
        """Return `FrequencyDependentCoefficients` without a frequency, or those at a frequency.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        speed : float [rad/s]
        frequency : float or None [rad/s]
        """


# Reactions whose oil moves along as a mass: what they say of it, and who takes it.


@runtime_checkable
class InertialReaction(Protocol):
    """What a Reaction may add: F = force(...) - mass(...) acceleration, both of position, velocity, speed.

    Its outputs then go on with MASS_OUTPUTS. A rotor takes the mass into its own: an exchange of
    accelerations diverges as soon as the oil is heavier than the rotor.
    """

    @property
    def has_inertia(self) -> bool:
        """Whether there is a mass at all."""

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> NDArray[np.float64]:
        """Return the added mass [kg], shape (2, 2, ...), symmetric.

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
            Journal center from the bearing center.
        velocity : array_like, shape (2, ...) [m/s]
            Of the journal center.
        speed : array_like, shape (...) [rad/s]
            Angular speed about +z.
        """

    def mass_slopes(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Return d mass / d (x, y, vx, vy, speed), shape (2, 2, 5, ...)."""

    def require_range(self, frequency: float) -> None:
        """Warn, or raise InputError, where the model of the inertia ends, for whirl at a frequency [rad/s].

        Parameters
        ----------
        frequency : float [rad/s]
            Of the motion.
        """


def inertial(reaction: Any) -> InertialReaction | None:
    """Return a reaction with an added mass as such; None for one without."""
    heavy = isinstance(reaction, InertialReaction) and reaction.has_inertia
    return reaction if heavy else None


def orbit_mass(
    reaction: Any, position: NDArray[np.float64], velocity: NDArray[np.float64], speed: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Return mass (2, 2, ...) [kg] and its slopes times -speed^2 position (2, 4, ...); None without inertia.

    Parameters
    ----------
    reaction : Reaction
    position, velocity : ndarray, shape (2, ...) [m], [m/s]
        On circular orbits.
    speed : float [rad/s]
    """
    heavy = inertial(reaction)
    if heavy is None:
        return None
    by_motion = heavy.mass_slopes(position, velocity, speed)[:, :, :4]
    slopes = np.einsum("ijk...,j...->ik...", by_motion, -(speed**2) * position)
    return heavy.mass(position, velocity, speed), slopes


def require_turning(reaction: Any, rotor: Any) -> None:
    """Warn, or raise InputError, where a rotor turns too fast for the inertia of its bearing.

    Parameters
    ----------
    reaction : Reaction
    rotor : Model
        Whose output "speed" says by its nominal value how fast it turns.
    """
    heavy = inertial(reaction)
    if heavy is not None:
        for signal in rotor.outputs:
            if signal.name == "speed":
                heavy.require_range(signal.nominal)


def require_turned(reaction: Any, rotor: Any, signals: Mapping[str, Any]) -> None:
    """Warn, or raise InputError, where a run became faster than its rotor said beforehand, as by a motor."""
    heavy = inertial(reaction)
    if heavy is not None and "speed" in signals and len(signals["speed"]):
        said = max(signal.nominal for signal in rotor.outputs if signal.name == "speed")
        highest = float(abs(signals["speed"]).max())
        if highest > said:
            heavy.require_range(highest)


def require_massless(name: str, reaction: Any) -> None:
    """Raise InputError for a reaction with an added mass."""
    if inertial(reaction) is not None:
        raise InputError(
            f"{name} must not add its oil's mass to the rotor here, got {reaction!r}: simulate, "
            "synchronous_orbits, orbit_system, closed_loop, transmissibility, mount and the analyses of "
            "flexible rotors take that mass; "
            "density 0 of a damper, added_mass=False of a seal leave it out"
        )


# Which reactions are bearings, and which are seals.


def carries_load(reaction: object) -> bool:
    """Return whether a reaction is a bearing, which carries its share of the weight.

    A class of which it is not so, as a seal, says `carries_load = False`.
    """
    return bool(getattr(reaction, "carries_load", True))


# Reactions whose force is the small difference of large ones: what roundoff leaves of it.


MOST_LEFT = 1e-6
"""Imbalance, over the load, beyond which no place counts as an equilibrium, whatever roundoff leaves."""


def force_noise(reaction: object, speed: float) -> float:
    """Return what roundoff may leave of the force of any reaction [N]; 0 where it does not say."""
    noise = getattr(reaction, "force_noise", None)
    return 0.0 if noise is None else noise(speed)


# Reactions that find by themselves where a journal rests in them.


def rest_place(reaction: object, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
    """Return where a reaction says that a journal rests [m]; None where it does not say."""
    place = getattr(reaction, "rest_place", None)
    return None if place is None else place(load, speed)
