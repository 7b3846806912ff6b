"""What a bearing offers to its rotor, and everything that follows from it for all bearings alike.

A reaction is a `Model` whose inputs begin with the places of its freedoms, their rates and the speed, and its
outputs with the forces on the shaft. What else it may say of itself is asked for here and nowhere else, and
every analysis takes the functions of this module: no other asks a bearing what it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InputError, brief, require_finite, require_kind
from .model import Array, Dynamic, Linearization, Model
from .signals import PLANAR, checked_freedoms, force_names, names, place_names

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
    - `at_rest()`, a reaction without states: this one with its states in equilibrium under a shaft at rest.
      Its `completed(found)` may add further results to an `Equilibrium`, such as the loads of pads;
    - `rest_linearization(position, speed)`, the exact derivatives about that rest;
    - `states_rest`, whether its states have an equilibrium when the shaft rests, if having a `force` does not
      show this;
    - `dynamic_stiffness(position, speed)`, K(s) of small motion, if it does not follow from its own states;
    - `require_range(frequency)`, which warns or raises if the model is not valid for such fast motion;
    - `has_inertia`, `mass(...)`, `mass_slopes(...)`: F = force - mass acceleration;
    - `force_along(position, velocity, acceleration, speed)`, this force F, if it does not follow from the
      others;
    - `is_warming`, `at_temperature(T)`, `balanced_temperature(...)`, `next_temperature(...)`, `coldest()`,
      `balanced()`, `in_time()`, where the temperature of the film follows from its heat, and
      `require_liquid(T)`, which refuses a balance at which there is no oil;
    - `call_with_states()`, force and rates of its states in the C library, a `FilmCall` or None, with
      `outputs_over_time(...)`, and `temperature_range` where a state is a temperature;
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


def has_film(reaction: object) -> bool:
    """Return whether a journal runs on a film of known thickness: not on balls, springs or a `Series`."""
    parts = reaction, getattr(reaction, "bearing", None)
    known = any(hasattr(one, name) for one in parts for name in ("viscosity", "film", "minimum_film"))
    return known and clearance_of(reaction) < np.inf


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
            f"{name} must not add the mass of its oil to the rotor in this analysis, got {reaction!r}. "
            "That mass is included by simulate, synchronous_orbits, orbit_system, closed_loop, "
            "transmissibility, mount and the analyses of "
            "flexible rotors. Set density=0 of a damper or added_mass=False of a seal to neglect it"
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
