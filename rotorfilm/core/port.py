"""What a bearing offers to its rotor, and everything that follows from it for all bearings alike.

A reaction is a `Model` whose inputs begin with the places of its freedoms, their rates and the speed, and its
outputs with the forces on the shaft. What else it may say of itself is asked for here and nowhere else, and
every analysis takes the functions of this module: no other asks a bearing what it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import (
    EquilibriumError,
    FilmContactError,
    InputError,
    brief,
    require_finite,
    require_kind,
    require_number,
)
from .model import Array, Dynamic, Linearization, Model, static_linearization
from .results import FrequencyDependentCoefficients, ReducedCoefficients
from .signals import PLANAR, Signal, checked_freedoms, force_names, names, place_names

Complex = NDArray[np.complex128]


@runtime_checkable
class Reaction(Model, Protocol):
    """A Model that exerts a force on a shaft: a film, a bearing, a seal, a rub ring.

    With the freedoms (x, y) its inputs begin with x, y, vx, vy, speed and its outputs with force_x, force_y;
    `core.signals.FREEDOMS` has the names of all others. With states it is a `Dynamic` too. Optional members
    are:

    - `freedoms`, which motions of the shaft it reacts to; ("x", "y") where it does not say;
    - `clearance`, the radius [m] of the circle within which the journal stays; without it there is no such
      circle;
    - `force(position, velocity, speed)` and `jacobian(...)`, the same as `output` and `linearization` for
      batches, shapes (n, ...) and (n, 2 n + 1, ...); a reaction with states holds them;
    - `prepare()` and `prepare_tangent()`, force and derivatives as functions of five numbers, for loops;
    - `compiled()`, the force in the C library with its added mass, a `native.film_call.FilmCall`, or None;
    - `is_constant`, whether it is springs and dampers, the same at any place, motion and speed;
    - `linear_system(*speeds)`, a `Linearization` of forces and rates of states over places and rates where
      these are linear, with the same coefficients at all of the speeds and any place, or None;
    - `minimum_film(position)`, if contact is not on the circle of the clearance;
    - `largest_eccentricity_ratio`, up to which its force is valid, 1 for up to the wall;
    - `force_noise(speed)`: the roundoff error of the force [N], for example of balls or pads;
    - `rest_place(load, speed)`, the equilibrium position under a load, None if not found;
    - `rest_state(position, speed)`, the equilibrium states there; without it Newton's method finds them;
    - `from_rest(position, speed, temperature)`, this reaction with the initial states of an equilibrium
      there;
    - `at_rest()`, a reaction without states: this one with its states at rest under a shaft at rest; by
      `completed(found)` that may return an `Equilibrium` with what it knows besides, as loads of pads;
    - `rest_linearization(position, speed)`, the exact derivatives about that rest;
    - `states_rest`, whether its states rest with the shaft, where having `force` does not tell;
    - `dynamic_stiffness(position, speed)`, K(s) of small motion where no states of its own tell it;
    - `require_range(frequency)`, which warns or raises where the model ends for motion that fast;
    - `has_inertia`, `mass(...)`, `mass_slopes(...)`: F = force - mass acceleration;
    - `force_along(position, velocity, acceleration, speed)`, that F where it is more than these tell;
    - `is_warming`, `at_temperature(T)`, `balanced_temperature(...)`, `coldest()`, `balanced()`, `in_time()`,
      where the temperature of the film follows from its heat;
    - `breakpoints`, the times [s] at which an integrator should stop, in rising order;
    - `warn_of_load(load)` and `warn_of_flow(speed, temperature, hottest)`, which warn where the model of its
      film ends; a film may have a `bearing` that warns;
    - `contact(position, velocity, speed)`, depth and normal force where a rotor is rubbed;
    - `carries_load`, False of a reaction that takes no share of the weight, as a seal;
    - `portable()`, an equal object that holds what it would make on first use, for an FMU.
    """


@runtime_checkable
class PlanarReaction(Reaction, Protocol):
    """A Reaction to x and y with its force for batches: the fast path of searches and orbits."""

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
            Velocity of the journal center.
        speed : array_like, shape (...) [rad/s]
            Angular speed about +z, either sign.
        """

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d(force_x, force_y)/d(x, y, vx, vy, speed), shape (2, 5, ...)."""


Bearings = Mapping[str, Reaction]
"""Reactions by the names of the stations in which they are."""


def freedoms_of(reaction: object) -> tuple[str, ...]:
    """Return the motions of the shaft that a reaction reacts to."""
    return tuple(getattr(reaction, "freedoms", PLANAR))


def clearance_of(reaction: object) -> float:
    """Return the radius of the circle in which the journal stays [m]; infinite where there is none."""
    return getattr(reaction, "clearance", np.inf)


def optional(reaction: object, method: str, *given: Any) -> Any:
    """Return what an optional method of a reaction returns; None where it has none."""
    own = getattr(reaction, method, None)
    return None if own is None else own(*given)


def require_reaction(
    name: str, value: Any, *, heavy: bool = False, planar: bool = False, over_time: bool = False
) -> None:
    """Raise InputError unless `value` is a Reaction.

    Parameters
    ----------
    name : str
        Name of the argument.
    value : object
    heavy : bool
        Whether it may add mass to the rotor.
    planar : bool
        Whether it must have the freedoms x, y and a clearance.
    over_time : bool
        Whether it must be a Model, not only a force under a journal at rest or in steps of its own.
    """
    moves = hasattr(value, "output") and hasattr(value, "linearization")
    rests = hasattr(value, "force") and hasattr(value, "jacobian") and not over_time
    if not (moves or rests) or isinstance(value, type):
        require_kind(name, value, Reaction, "a Reaction such as a JournalBearing, or what as_reaction makes")
        raise InputError(f"{name} must be a Reaction such as a JournalBearing, got {brief(value)}")
    if freedoms_of(value) != PLANAR:
        checked_freedoms(freedoms_of(value), f"freedoms of {name}")
    if moves and not (freedoms_of(value) == PLANAR and hasattr(value, "force")):
        require_terminals(name, value)
    if planar and freedoms_of(value) != PLANAR:
        raise InputError(
            f"{name} must react to x and y alone here, got one of {', '.join(freedoms_of(value))}: simulate, "
            "rotor_modes, unbalance_response and rotor_system take it on a rotor with such stations"
        )
    if not heavy:
        require_massless(name, value)


def require_reactions(name: str, values: object, *, heavy: bool = False, over_time: bool = False) -> None:
    """Raise InputError unless `values` is a mapping from names of stations to Reactions."""
    if not isinstance(values, Mapping):
        raise InputError(f"{name} must be a mapping such as {{'left': film}}, got {brief(values)}")
    for station, value in values.items():
        require_reaction(f"{name}[{station!r}]", value, heavy=heavy, over_time=over_time)


def require_terminals(name: str, reaction: Reaction) -> None:
    """Raise InputError unless a reaction takes the motion of its freedoms and the speed, and nothing else."""
    if reaction.states and not isinstance(reaction, Dynamic):
        raise InputError(f"{name} must have a derivative for its states, got {reaction!r}")
    freedoms = freedoms_of(reaction)
    taken, wanted = names(reaction.inputs), [*place_names(freedoms), "speed"]
    if taken != wanted:
        raise InputError(f"{name} must have no inputs but {wanted}, got {taken}")
    given, forces = names(reaction.outputs), force_names(freedoms)
    if given[: len(forces)] != forces:
        raise InputError(f"{name} must have outputs that begin with {forces}, got {given}")


def require_place(reaction: object, position: ArrayLike, name: str = "position") -> Array:
    """Return a place of the shaft as an array, shape (n,); raise InputError where it breaks a rule."""
    freedoms, place = freedoms_of(reaction), require_finite(name, position)
    if place.shape != (len(freedoms),):
        raise InputError(
            f"{name} must have shape ({len(freedoms)},) for {', '.join(freedoms)}, got shape {place.shape}"
        )
    return place


def input_of(position: ArrayLike, velocity: ArrayLike | None, speed: ArrayLike) -> Array:
    """Return the input of a reaction, shape (2 n + 1, ...), from places, rates or none, and the speed."""
    place = np.asarray(position, dtype=float)
    rate = np.zeros_like(place) if velocity is None else np.asarray(velocity, dtype=float)
    return np.concatenate([place, rate, np.broadcast_to(speed, (1, *place.shape[1:]))])


# The force for plain numbers, for loops that go state by state.


Force = Callable[[float, float, float, float, float], tuple[float, float]]
"""A force for plain numbers: (x, y, vx, vy, speed) give force_x, force_y [N]."""


Tangent = Callable[[float, float, float, float, float], tuple[float, float, Sequence[float]]]
"""Force and derivatives for plain numbers: the force [N] and its ten derivatives row by row."""


def prepared_force(reaction: Any) -> Force:
    """Return the force of a planar reaction without states as a function of five numbers."""
    prepare = getattr(reaction, "prepare", None)
    return force_of(reaction) if prepare is None else prepare()


def force_of(reaction: Any) -> Force:
    """Return the same by `static_force`."""

    def force(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
        force_x, force_y = np.asarray(static_force(reaction, (x, y), (vx, vy), speed)).tolist()
        return force_x, force_y

    return force


def prepared_tangent(reaction: Any) -> Tangent:
    """Return force and derivatives of a planar reaction without states as a function of five numbers."""
    prepare = getattr(reaction, "prepare_tangent", None)
    return tangent_of(reaction) if prepare is None else prepare()


def tangent_of(reaction: Any) -> Tangent:
    """Return the same by `static_force` and `static_slopes`."""

    def tangent(
        x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, Sequence[float]]:
        position, velocity = np.array((x, y)), np.array((vx, vy))
        force_x, force_y = np.asarray(static_force(reaction, position, velocity, speed)).tolist()
        return force_x, force_y, static_slopes(reaction, position, velocity, speed).ravel().tolist()

    return tangent


def compiled_force(reaction: Any) -> Any:
    """Return the force of a planar reaction in the C library, a `FilmCall`; None where it has none there."""
    return optional(reaction, "compiled")


def is_constant(reaction: object) -> bool:
    """Return whether a reaction is springs and dampers, the same at any place, motion and speed."""
    return bool(getattr(reaction, "is_constant", False))


def linear_system(reaction: Any, speeds: Sequence[float]) -> Linearization | None:
    """Return a planar reaction as linear equations over places and rates; None where they are not.

    Parameters
    ----------
    reaction : Reaction
    speeds : sequence of float [rad/s]
        Speeds at which its coefficients must be the same.
    """
    return None if freedoms_of(reaction) != PLANAR else optional(reaction, "linear_system", *speeds)


def static_force(reaction: Any, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
    """Return force and moment of a reaction on the shaft, its states held, shape (n, ...) [N], [N m]."""
    law = getattr(reaction, "force", None)
    if law is not None:
        return np.asarray(law(position, velocity, speed))
    n = len(freedoms_of(reaction))
    x = _first_state(reaction)
    return _each(lambda u: reaction.output(0.0, x, u)[:n], input_of(position, velocity, speed))


def static_slopes(reaction: Any, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
    """Return the derivatives of `static_force` by places, rates and speed, shape (n, 2 n + 1, ...)."""
    law = getattr(reaction, "jacobian", None)
    if law is not None:
        return np.asarray(law(position, velocity, speed))
    n = len(freedoms_of(reaction))
    at, x = input_of(position, velocity, speed), _first_state(reaction)
    return _each(lambda u: reaction.linearization(0.0, x, u).D[:n, : 2 * n + 1], at)


def _first_state(reaction: Any) -> Array:
    """Return the states that a reaction starts with, at which those of one that has some are held."""
    return np.asarray(getattr(reaction, "initial_state", np.zeros(0)), dtype=float)


def _each(law: Callable[[Array], Array], inputs: Array) -> Array:
    """Return what a law has for one input (2 n + 1,), or for each of a batch."""
    return np.asarray(law(inputs) if inputs.ndim == 1 else np.apply_along_axis(law, 0, inputs))


def largest_eccentricity_ratio(reaction: object) -> float:
    """Return the eccentricity ratio to which any reaction is meant; 1 where it does not say."""
    return getattr(reaction, "largest_eccentricity_ratio", 1.0)


# Where a journal touches: at a circle of the radial clearance, or where its bearing says.


def has_wall(reaction: object) -> bool:
    """Return whether a reaction says itself where its journal touches."""
    return hasattr(reaction, "minimum_film")


def minimum_film(reaction: Any, position: Array) -> Array:
    """Return the least film [m], shape (...), that any reaction has at positions (n, ...) [m]."""
    if has_wall(reaction):
        return np.asarray(reaction.minimum_film(position))
    return np.asarray(clearance_of(reaction) - np.hypot(*_planar(reaction, position)))


def amplitude_ratio(reaction: Any, positions: Array) -> float:
    """Return how far the way of journals (n, ...) [m] goes towards contact: 1 - least film / clearance."""
    clearance = clearance_of(reaction)
    if has_wall(reaction) and clearance < np.inf:
        return 1.0 - float(np.min(reaction.minimum_film(positions))) / clearance
    return float(np.hypot(*_planar(reaction, positions)).max()) / clearance


def relative_film(reaction: Any, position: Array) -> float:
    """Return the least film of a journal at a position (n,) [m], in clearances; 1 where nothing touches."""
    clearance = clearance_of(reaction)
    if not clearance < np.inf:
        return 1.0
    if has_wall(reaction):
        return float(reaction.minimum_film(position)) / clearance
    x, y = _planar(reaction, position)
    return 1.0 - float(np.hypot(x, y)) / clearance


def _planar(reaction: object, position: Array) -> tuple[Any, Any]:
    """Return x and y of a place, 0 for one that is no freedom."""
    freedoms = freedoms_of(reaction)
    if freedoms == PLANAR:
        return position[0], position[1]
    still = np.zeros(np.shape(position)[1:])
    x, y = (position[freedoms.index(axis)] if axis in freedoms else still for axis in PLANAR)
    return x, y


# Reactions whose film warms: its temperature follows from the balance of its heat.


def is_warming(reaction: object) -> bool:
    """Return whether a reaction leaves the temperature of its film to its heat; then it has no own force."""
    return getattr(reaction, "is_warming", False) is True


def in_time(reaction: Any) -> Any:
    """Return a model as it runs: a reaction that warms has its temperature as a state."""
    return reaction.in_time() if is_warming(reaction) else reaction


def from_rest(reaction: Any, position: Array, speed: float, temperature: float | None) -> Any:
    """Return a model as it runs from a rest: a film begins at its temperature, pads in their tilts.

    Parameters
    ----------
    reaction : Reaction
    position : ndarray, shape (n,) [m]
    speed : float [rad/s]
    temperature : float or None [K]
        That of a film that warms.
    """
    own = getattr(reaction, "from_rest", None)
    if own is not None:
        return own(position, speed, temperature)
    return reaction.in_time(temperature) if is_warming(reaction) else reaction


def at_balanced_temperature(reaction: Any, position: ArrayLike, speed: float) -> Any:
    """Return a reaction at the temperature that its film has with the journal at rest; any other as it is.

    Parameters
    ----------
    reaction : Reaction
    position : array_like, shape (n,) [m]
    speed : float [rad/s]
    """
    temperature = rest_temperature(reaction, position, speed)
    return reaction if temperature is None else reaction.at_temperature(temperature)


def rest_temperature(reaction: Any, position: ArrayLike, speed: float) -> float | None:
    """Return the temperature [K] of a film that warms, with the journal at rest; None of any other."""
    if not is_warming(reaction):
        return None
    place = np.asarray(position, dtype=float)
    return float(reaction.balanced_temperature(place, np.zeros_like(place), speed))


# Reactions whose oil moves along as a mass: F = force(...) - mass(...) acceleration.
#
# A rotor takes the mass into its own: an exchange of accelerations diverges as soon as the oil is heavier
# than the rotor.


def inertial(reaction: Any) -> Any:
    """Return a reaction with an added mass as it is; None for one without."""
    return reaction if getattr(reaction, "has_inertia", False) else None


def force_along(
    reaction: Any, position: Array, velocity: Array, acceleration: Array, speed: ArrayLike
) -> Array:
    """Return the force of any reaction in a motion with that of the added mass, shape (n, ...) [N].

    Parameters
    ----------
    reaction : Reaction
        Reaction without states.
    position, velocity, acceleration : ndarray, shape (n, ...) [m], [m/s], [m/s2]
    speed : array_like, shape (...) [rad/s]
    """
    own, heavy = getattr(reaction, "force_along", None), inertial(reaction)
    if own is not None:
        return np.asarray(own(position, velocity, acceleration, speed))
    force = static_force(reaction, position, velocity, speed)
    mass = None if heavy is None else heavy.mass(position, velocity, speed)
    return force if mass is None else force - np.einsum("ij...,j...->i...", mass, acceleration)


def mass_of(reaction: Any, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
    """Return the added mass of any reaction, shape (n, n) [kg]; zeros where it has none."""
    n = len(freedoms_of(reaction))
    heavy = inertial(reaction)
    return np.zeros((n, n)) if heavy is None else np.asarray(heavy.mass(position, velocity, speed))


def orbit_mass(reaction: Any, position: Array, velocity: Array, speed: float) -> tuple[Array, Array] | None:
    """Return mass (2, 2, ...) [kg] and its slopes times -speed^2 position (2, 4, ...); None without inertia.

    Parameters
    ----------
    reaction : Reaction
    position, velocity : ndarray, shape (2, ...) [m], [m/s]
        Position and velocity on circular orbits.
    speed : float [rad/s]
    """
    heavy = inertial(reaction)
    if heavy is None:
        return None
    by_motion = heavy.mass_slopes(position, velocity, speed)[:, :, :4]
    slopes = np.einsum("ijk...,j...->ik...", by_motion, -(speed**2) * position)
    return heavy.mass(position, velocity, speed), slopes


def warn_of_load(reaction: Any, load: Array) -> None:
    """Let the bearing of a film warn of a load [N], shape (n,), that is too much for its model."""
    optional(getattr(reaction, "bearing", reaction), "warn_of_load", load)


def warn_of_flow(reaction: Any, speed: float, *temperatures: float | None) -> None:
    """Let the bearing of a film warn where it is not laminar, or its oil beyond the law of its viscosity.

    Parameters
    ----------
    reaction : Reaction
    speed : float [rad/s]
    *temperatures : float or None [K]
        Of the oil in the mean, by default that of the bearing, and where it is hottest, by default the mean.
    """
    optional(getattr(reaction, "bearing", reaction), "warn_of_flow", speed, *temperatures)


def require_range(reaction: object, frequency: float) -> None:
    """Warn, or raise InputError, where the model of any reaction ends, for motion at a frequency [rad/s]."""
    optional(reaction, "require_range", abs(frequency))


def require_turning(reaction: Any, rotor: Any) -> None:
    """Warn, or raise InputError, where a rotor turns too fast for the inertia of its bearing.

    Parameters
    ----------
    reaction : Reaction
    rotor : Model
        Rotor whose output "speed" says by its nominal value how fast it turns.
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
        highest_signal = max(signal.nominal for signal in rotor.outputs if signal.name == "speed")
        highest = float(abs(signals["speed"]).max())
        if highest > highest_signal:
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


# Which reactions are bearings, which find their rest themselves, and what roundoff leaves of their force.


MOST_LEFT = 1e-6
"""Imbalance, over the load, beyond which no place counts as an equilibrium, whatever roundoff leaves."""


def carries_load(reaction: object) -> bool:
    """Return whether a reaction is a bearing, which carries its share of the weight.

    A class of which it is not so, as a seal, says `carries_load = False`.
    """
    return bool(getattr(reaction, "carries_load", True))


def force_noise(reaction: object, speed: float) -> float:
    """Return what roundoff may leave of the force of any reaction [N]; 0 where it does not say."""
    return optional(reaction, "force_noise", speed) or 0.0


def rest_place(reaction: object, load: Sequence[float], speed: float) -> Any:
    """Return where a reaction says that a journal rests, shape (n,) [m]; None where it does not say."""
    return optional(reaction, "rest_place", load, speed)


def takes_steps(reaction: object) -> bool:
    """Return whether a film has an integrator of its own, whose steps a rotor may try with their slope."""
    return hasattr(reaction, "attempt")


class StepTrial(NamedTuple):
    """A step of a film that may be taken, or tried again to another place.

    Attributes
    ----------
    state : object
        At its end.
    output : ndarray, shape (n_outputs,)
        There; force_x, force_y come first.
    stiffness : ndarray, shape (2, 2) [N/m]
        -d force / d position at the end of the step.
    solutions : int
        Linear systems that were solved.
    """

    state: Any
    output: Array
    stiffness: Array
    solutions: int


# States at rest under a shaft at rest, and the force that is left then: quasi-static elimination.


_STEPS, _HALVINGS, _SETTLED = 40, 30, 1e-13


def states_rest(reaction: Any) -> bool:
    """Return whether a reaction has states that rest with the shaft, or K(s) in another way.

    Those that drift, as the wear of a bush or the temperature of a film, are held where they are.
    """
    told = getattr(reaction, "states_rest", None)
    return (
        told
        if told is not None
        else hasattr(reaction, "at_rest")
        or (not hasattr(reaction, "force") and bool(getattr(reaction, "states", ())))
    )


def drifts(reaction: Any) -> bool:
    """Return whether a reaction has states that hardly move within a turn, as wear or a temperature.

    Coefficients hold them where they are, unless a frequency is named.
    """
    return is_warming(reaction) or bool(getattr(reaction, "states", ()))


def quasi_static(reaction: Any) -> Any:
    """Return a reaction with its states at rest under a shaft at rest; itself where it has none."""
    own = getattr(reaction, "at_rest", None)
    if own is not None:
        return own()
    return QuasiStatic(reaction) if states_rest(reaction) else reaction


def rest_state(reaction: Any, position: ArrayLike, speed: float) -> Array:
    """Return the states of a reaction that rest with the shaft at a place, shape (m,).

    Parameters
    ----------
    reaction : Reaction
    position : array_like, shape (n,) [m]
    speed : float [rad/s]

    Raises
    ------
    EquilibriumError
        If the reaction does not tell them and Newton's method finds none.
    """
    own = getattr(reaction, "rest_state", None)
    if own is not None:
        return np.asarray(own(position, speed))
    if not reaction.states:
        return np.zeros(0)
    u = input_of(position, None, speed)
    found = newton_root(
        lambda x: np.asarray(reaction.derivative(0.0, x, u)),
        lambda x: np.asarray(reaction.linearization(0.0, x, u).A),
        np.array(reaction.initial_state, dtype=float),
        np.array([signal.nominal for signal in reaction.states]),
    )
    if found is None:
        raise no_rest(reaction, position, speed)
    return found


def no_rest(reaction: Any, position: ArrayLike, speed: float) -> EquilibriumError:
    """Return what to raise where no states were found that rest with the shaft at a place."""
    return EquilibriumError(
        f"reaction must have states that rest with the shaft at {np.asarray(position).tolist()} and "
        f"{speed!r} rad/s, got {brief(reaction)} with {names(reaction.states)}, for which none was found"
    )


def newton_root(
    law: Callable[[Array], Array], slopes: Callable[[Array], Array], start: Array, nominal: Array
) -> Array | None:
    """Return where a law (m,) of x (m,) vanishes, by Newton's method with halved steps; None if nowhere.

    A trial at which the journal would touch its wall counts as one that is too far.

    Parameters
    ----------
    law, slopes : callable
        Its value and its derivatives (m, m).
    start, nominal : ndarray, shape (m,)
        Where to begin, and typical sizes of x and of its rates.
    """
    x, rate = start, law(start)
    for _ in range(_STEPS):
        A = slopes(x)
        if np.linalg.cond(A * nominal / nominal[:, None]) > 1e14:
            return None
        step = -np.linalg.solve(A, rate)
        if np.abs(step / nominal).max() <= _SETTLED * max(1.0, np.abs(x / nominal).max()):
            return np.asarray(x + step)
        for halving in range(_HALVINGS):
            trial = x + 0.5**halving * step
            try:
                moved = law(trial)
            except FilmContactError:
                continue
            if np.abs(moved / nominal).max() < np.abs(rate / nominal).max() or not moved.any():
                x, rate = trial, moved
                break
        else:
            return None
        if not rate.any():
            return x
    return None


def rest_linearization(reaction: Any, position: ArrayLike, speed: float) -> Linearization:
    """Return the exact derivatives of a reaction whose states rest with the shaft, without further signals.

    Inputs: places and rates, and the speed; outputs: the forces, shape (n,). A reaction that leaves out the
    speed, as tilting pads, tells its derivatives in slow motion by its `at_rest`.
    """
    n = len(freedoms_of(reaction))
    own = getattr(reaction, "rest_linearization", None)
    if own is not None:
        A, B, C, D = own(position, speed)
    elif hasattr(reaction, "linearization"):
        x = rest_state(reaction, position, speed)
        A, B, C, D = reaction.linearization(0.0, x, input_of(position, None, speed))
    else:
        still = np.zeros(n)
        A, B, C, D = static_linearization(static_slopes(reaction, position, still, speed))
    return Linearization(A, B[:, : 2 * n + 1], C[:n], D[:n, : 2 * n + 1])


@dataclass(frozen=True, eq=False)
class QuasiStatic:
    """A reaction without states: another one, whose states rest with a shaft at rest.

    Parameters
    ----------
    reaction : Reaction
        Reaction with states that rest.
    """

    reaction: Any

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Those of the reaction."""
        return freedoms_of(self.reaction)

    @property
    def clearance(self) -> float:
        """That of the reaction [m]."""
        return clearance_of(self.reaction)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Those of the reaction."""
        signals: tuple[Signal, ...] = self.reaction.inputs
        return signals

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Those of the reaction."""
        signals: tuple[Signal, ...] = self.reaction.outputs
        return signals

    def minimum_film(self, position: Array) -> Array:
        """Return the least film of the reaction [m]."""
        return minimum_film(self.reaction, position)

    def force_noise(self, speed: float) -> float:
        """Return what roundoff may leave of the force of the reaction [N]."""
        return force_noise(self.reaction, speed)

    def rest_place(self, load: Sequence[float], speed: float) -> Any:
        """Return where the reaction says that the shaft rests, shape (n,); None where it does not say."""
        return rest_place(self.reaction, load, speed)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return the force on a shaft at rest, shape (n,); the velocity is not used."""
        x = rest_state(self.reaction, position, speed)
        found = self.reaction.output(0.0, x, input_of(position, None, speed))
        return np.asarray(found)[: len(self.freedoms)]

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return the derivatives in slow motion, shape (n, 2 n + 1)."""
        A, B, C, D = rest_linearization(self.reaction, position, speed)
        if D.shape[1] == 2 * len(C):
            raise InputError(f"reaction must tell its derivatives by the speed, got {brief(self.reaction)}")
        K, slope = StatesStiffness(Linearization(A, B, C, D))(0j)
        by_speed = D[:, -1:] - C @ np.linalg.solve(A, B[:, -1:])
        return np.hstack([-K.real, -slope.real, by_speed])


# Stiffness over the exponent of the motion: K(s) = -dF/dq, states and added mass included.


class DynamicStiffness(Protocol):
    """The stiffness that a shaft feels in small motion, over the exponent of the motion.

    One of states that follow the shaft has them as `at`, as of `StatesStiffness`: a rotor may take them as
    states of its own.
    """

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) [N/m] and dK/ds [N s/m], shape (n, n) each: the force changes by -K(s) q e^(s t).

        Parameters
        ----------
        s : complex [1/s]
        """

    def stiffness(self, s: complex) -> Complex:
        """Return K(s) alone.

        Parameters
        ----------
        s : complex [1/s]
        """


@dataclass(frozen=True)
class StatesStiffness:
    """K(s) of a reaction whose states follow the shaft, exactly, from its linearization about a rest.

    Parameters
    ----------
    at : Linearization
        Its inputs begin with places and rates, its outputs are the n forces.
    """

    at: Linearization

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) [N/m] and dK/ds [N s/m]; see `DynamicStiffness`."""
        A, B, C, D = self.at
        n = len(C)
        by_place, by_rate = slice(n), slice(n, 2 * n)
        follow = s * np.eye(len(A)) - A
        drive = B[:, by_place] + s * B[:, by_rate]
        try:
            moved = np.linalg.solve(follow, drive)
        except np.linalg.LinAlgError:
            raise InputError(
                f"s must not be an exponent of the states alone, as 0 is where one integrates, got {s!r}"
            ) from None
        slope = np.linalg.solve(follow, B[:, by_rate] - moved)
        K, damping = D[:, by_place] + s * D[:, by_rate] + C @ moved, D[:, by_rate] + C @ slope
        return -K.astype(complex), -damping.astype(complex)

    def stiffness(self, s: complex) -> Complex:
        """Return K(s) [N/m] alone."""
        return self(s)[0]

    def exponents(self, mass: ArrayLike) -> Complex:
        """Return all exponents of a rigid mass [kg], or (n, n), on it [1/s], the least damped first."""
        A, B, C, D = self.at
        n, size = len(C), len(A)
        push = np.hstack([D[:, : 2 * n], C])
        push = np.linalg.solve(np.asarray(mass, dtype=float), push) if np.ndim(mass) else push / mass
        whole = np.vstack([np.eye(n, 2 * n + size, n), push, np.hstack([B[:, : 2 * n], A])])
        values = np.linalg.eigvals(whole).astype(complex)
        return values[np.argsort(-values.real)]


@dataclass(frozen=True)
class InertialStiffness:
    """K(s) + s^2 mass of a reaction that adds a mass, as a `DynamicStiffness`.

    Parameters
    ----------
    motion : DynamicStiffness
        Motion without that mass.
    mass : ndarray, shape (n, n) [kg]
    """

    motion: Any
    mass: Array

    @property
    def at(self) -> Linearization:
        """The states of the reaction, if it tells them."""
        known: Linearization = self.motion.at
        return known

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) + s^2 mass [N/m] and its slope [N s/m]; see `DynamicStiffness`."""
        K, slope = self.motion(s)
        return K + s**2 * self.mass, slope + 2.0 * s * self.mass

    def stiffness(self, s: complex) -> Complex:
        """Return K(s) + s^2 mass [N/m] alone."""
        return np.asarray(self.motion.stiffness(s) + s**2 * self.mass)


def has_own_stiffness(reaction: object) -> bool:
    """Return whether a reaction tells K(s) itself and has no states to tell it, as one that conserves oil.

    What grows on it is counted, by the argument principle: exponents can be followed, but not listed.
    """
    return hasattr(reaction, "dynamic_stiffness") and not hasattr(reaction, "derivative")


def small_motion(reaction: Any, position: ArrayLike, speed: float) -> DynamicStiffness:
    """Return K(s) and dK/ds of a reaction about a rest, without its added mass.

    Parameters
    ----------
    reaction : Reaction
    position : array_like, shape (n,) [m]
    speed : float [rad/s]
    """
    own = getattr(reaction, "dynamic_stiffness", None)
    if own is not None:
        found: DynamicStiffness = own(position, speed)
        return found
    return StatesStiffness(rest_linearization(reaction, position, speed))


GROWTH_ROUNDOFF = 1e-9
"""Growth rate / frequency that is roundoff."""


def rigid_exponents(reaction: Any, position: ArrayLike, speed: float, mass: float) -> Complex:
    """Return the exponents of a rigid mass [kg] on a reaction about a rest [1/s], the least damped first.

    A film that warms keeps the temperature of the rest.
    """
    film = at_balanced_temperature(reaction, position, speed)
    at, added = (
        rest_linearization(film, position, speed),
        mass_of(film, position, np.zeros_like(position), speed),
    )
    return StatesStiffness(at).exponents(mass * np.eye(len(added)) + added if added.any() else mass)


def coefficients_of(
    motion: DynamicStiffness,
    position: Array,
    speed: float,
    frequency: float | None = None,
    freedoms: tuple[str, ...] = PLANAR,
) -> ReducedCoefficients:
    """Return Re K(i nu) and Im K(i nu)/nu, with their limits at 0.

    Without a frequency they are `FrequencyDependentCoefficients`.

    Parameters
    ----------
    motion : DynamicStiffness
    position, speed : ndarray, shape (n,) [m], and float [rad/s]
        Where the journal rests.
    frequency : float, optional [rad/s]
        nu; by default that of the shaft.
    freedoms : tuple of str
    """
    nu = abs(speed) if frequency is None else require_number("frequency", frequency)
    K, slope = motion(1j * nu) if nu == 0.0 else (motion.stiffness(1j * nu), None)
    damping = K.imag / nu if slope is None else slope.real
    found = ReducedCoefficients(
        stiffness=K.real, damping=damping, position=position, speed=speed, frequency=nu, freedoms=freedoms
    )
    return found if frequency is not None else FrequencyDependentCoefficients(**vars(found), motion=motion)
