"""Reactions that make one: side by side, one behind the other with a body between, or beside springs."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from typing import Any, ClassVar, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import (
    EquilibriumError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    require_finite,
    require_kind,
    require_positive,
    require_tuple,
    require_vector,
)
from ..core.inputs import quantities
from ..core.model import Array, Linearization, static_linearization
from ..core.port import (
    Force,
    PlanarReaction,
    QuasiStatic,
    Reaction,
    Tangent,
    carries_load,
    clearance_of,
    compiled_force,
    force_along,
    force_noise,
    freedoms_of,
    has_states,
    has_wall,
    inertial,
    is_warming,
    largest_eccentricity_ratio,
    mass_of,
    minimum_film,
    newton_root,
    no_rest,
    prepared_force,
    prepared_tangent,
    quasi_static,
    require_range,
    require_reaction,
    require_terminals,
    rest_linearization,
    rest_place,
    rest_state,
    static_force,
    static_slopes,
)
from ..core.results import Equilibrium
from ..core.signals import FREEDOMS, PLANAR, Signal, force_names, place_names
from ..native.film_call import FilmCall
from ..native.spec import HasKernel, NativeSpec
from .linear_system import HoldingStiffness
from .reaction import InertialModel, broadcast_state, input_vector, mass_entries, mass_outputs


def _require_part(name: str, part: Any) -> None:
    """Raise InputError unless a reaction can be part of one that also runs over time."""
    require_reaction(name, part, heavy=True, over_time=True)
    require_terminals(name, part)
    if is_warming(part):
        raise InputError(
            f"{name} must have a temperature, or have it as a state as by its in_time(), got {part!r}"
        )


def _at_rest(part: Any, position: Array, speed: float, follows: bool) -> Linearization:
    """Return the derivatives of a part whose states rest, and follow the shaft or are held."""
    n = len(position)
    if not follows:
        return static_linearization(static_slopes(part, position, np.zeros(n), speed))
    A, B, C, D = rest_linearization(part, position, speed)
    if D.shape[1] > 2 * n:
        return Linearization(A, B, C, D)
    by_speed = quasi_static(part).jacobian(position, np.zeros(n), speed)[:, -1:]  # exact in slow motion
    return Linearization(A, np.hstack([B, np.zeros((len(A), 1))]), C, np.hstack([D, by_speed]))


_CREEP = 1e-6
"""Rates, in nominal ones, at which a part has slopes that has none at rest."""


def _slopes_near_rest(part: Any, position: Array, speed: float) -> Array:
    """Return the derivatives of a force at rest by places; of one that has none, in very slow motion."""
    n, still = len(position), quasi_static(part)
    try:
        return static_slopes(still, position, np.zeros(n), speed)[:, :n]
    except UndefinedDerivativeError:
        creep = _CREEP * np.array([signal.nominal for signal in part.inputs[n : 2 * n]])
        return static_slopes(still, position, creep, speed)[:, :n]


def _moved(part: Any, t: float, x: Array, u: Array) -> Array:
    """Return the rates of the states of a part; none of one without."""
    return np.asarray(part.derivative(t, x, u)) if part.states else np.zeros(0)


def _named(prefix: str, part: Any) -> list[Signal]:
    """Return the states of a part with a prefix."""
    return [replace(signal, name=f"{prefix}_{signal.name}") for signal in part.states]


def _leaking(part: Any) -> Any:
    """Return a part with a small decay of those of its states that integrate, so that they have a rest."""
    return getattr(part, "leaking", part)


def _reached(reaction: Any, place: Array, speed: float) -> Array | None:
    """Return a place from which a search for the rest of a reaction may begin; None where it has no force."""
    with suppress(EquilibriumError, FilmContactError, UndefinedDerivativeError):
        static_force(quasi_static(reaction), place, np.zeros_like(place), speed)
        return place
    return None


def _told_place(part: Any, load: Array, speed: float) -> Array | None:
    """Return where a part says that it rests under a load; None where it does not say or cannot carry it."""
    with suppress(EquilibriumError):
        told = rest_place(part, load.tolist(), speed)
        return None if told is None else np.asarray(told, dtype=float)
    return None


class PartAtRest(NamedTuple):
    """One of the reactions of another one, where a shaft at rest holds it: place (n,), and speed [rad/s]."""

    reaction: Any
    place: Array
    speed: float

    def settled(self, found: Equilibrium) -> Equilibrium:
        """Return an equilibrium of the whole with the place, eccentricity ratio and film of this part."""
        still = quasi_static(self.reaction)
        x, y = (dict(zip(freedoms_of(still), self.place, strict=True)).get(axis, 0.0) for axis in PLANAR)
        alone = replace(
            found,
            position=self.place,
            speed=self.speed,
            eccentricity_ratio=float(np.hypot(x, y)) / clearance_of(still),
            minimum_film=float(minimum_film(still, self.place)),
            reaction=still,
        )
        tell = getattr(still, "settled", None)
        return alone if tell is None else cast(Equilibrium, tell(alone))


class AssemblyAtRest(QuasiStatic):
    """An assembly with its states at rest, which tells the films of its parts."""

    def rest_place(self, load: Sequence[float], speed: float) -> Array | None:
        """Return about where the shaft rests; see `core.port`."""
        return cast("Array | None", rest_place(self.reaction, load, speed))

    def settled(self, found: Equilibrium) -> Equilibrium:
        """Return an equilibrium with the least film and the largest eccentricity ratio of all parts."""
        parts = [part.settled(found) for part in self.reaction.parts_at_rest(found.position, found.speed)]
        return replace(
            found,
            eccentricity_ratio=max(one.eccentricity_ratio for one in parts),
            minimum_film=min(one.minimum_film for one in parts),
            reaction=self,
        )


class _Place(NamedTuple):
    """Where a reaction is among the motions and states of the one that it is part of."""

    reaction: Any
    rows: list[int]
    columns: list[int]
    inner: slice


class SharedReaction(InertialModel):
    """What a reaction made of `reactions` at one place takes from them: wall, size and added mass."""

    @cached_property
    def freedoms(self: Any) -> tuple[str, ...]:
        """Motions of the shaft to which one of them reacts."""
        own = {name for one in self.reactions for name in freedoms_of(one)}
        return PLANAR if own == {*PLANAR} else tuple(name for name in FREEDOMS if name in own)

    @cached_property
    def _places(self: Any) -> list[_Place]:
        n, first, found = len(self.freedoms), 0, []
        for one in self.reactions:
            rows = [self.freedoms.index(name) for name in freedoms_of(one)]
            end = first + len(getattr(one, "states", ()))
            found.append(_Place(one, rows, [*rows, *(n + row for row in rows), 2 * n], slice(first, end)))
            first = end
        return found

    @property
    def clearance(self: Any) -> float:
        """The smallest radial clearance [m]."""
        return min(map(clearance_of, self.reactions))

    @property
    def largest_eccentricity_ratio(self: Any) -> float:
        """Eccentricity ratio, of the smallest clearance, to which all are meant."""
        if not np.isfinite(self.clearance):
            return 1.0
        return min(
            largest_eccentricity_ratio(one) * (clearance_of(one) / self.clearance) for one in self.reactions
        )

    @property
    def nominal_force(self: Any) -> float:
        """The largest nominal force [N]."""
        return max(reaction.outputs[0].nominal for reaction in self.reactions)

    def force_noise(self: Any, speed: float) -> float:
        """Return what roundoff may leave of the forces of all [N]."""
        return sum(force_noise(one, speed) for one in self.reactions)

    @property
    def has_inertia(self) -> bool:
        """Whether one of them adds a mass to the rotor."""
        return bool(self._heavy)

    @property
    def _heavy(self) -> list[_Place]:
        return [place for place in self._places if inertial(place.reaction)]

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the added mass of all [kg], shape (n, n, ...)."""
        n = len(self.freedoms)
        q, v, omega = broadcast_state(position, velocity, speed, n)
        total = np.zeros((n, n, *omega.shape))
        for one, rows, _, _ in self._heavy:
            total[np.ix_(rows, rows)] += one.mass(q[rows], v[rows], omega)
        return total

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d mass / d (places, rates, speed), shape (n, n, 2 n + 1, ...)."""
        n = len(self.freedoms)
        q, v, omega = broadcast_state(position, velocity, speed, n)
        total = np.zeros((n, n, 2 * n + 1, *omega.shape))
        for one, rows, columns, _ in self._heavy:
            total[np.ix_(rows, rows, columns)] += one.mass_slopes(q[rows], v[rows], omega)
        return total

    def require_range(self: Any, frequency: float) -> None:
        """Warn, or raise InputError, where the model of one ends, for motion at [rad/s].

        Parameters
        ----------
        frequency : float [rad/s]
            Of the motion.
        """
        for one in self.reactions:
            require_range(one, frequency)


@quantities
@dataclass(frozen=True)
class Parallel(SharedReaction):
    """Reactions side by side on one shaft: forces and added masses add up, states stand one after the other.

    It reacts to all motions to which one of them does, as a journal bearing beside a thrust bearing. States
    have the number of their reaction in front, as part0_tilt_1.

    Parameters
    ----------
    reactions : tuple of Reaction
        Two at least, all about the same center.

    Raises
    ------
    InputError
        If there are fewer, or one is no Reaction or leaves its temperature to the balance of its heat.

    Examples
    --------
    >>> from rotorfilm import LinearBearing, RubRing
    >>> ring = RubRing(gap=2e-4, stiffness=1e7, radius=0.05)
    >>> both = Parallel((LinearBearing(stiffness=1e6), ring))
    >>> both.force([2.1e-4, 0.0], [0.0, 0.0], 0.0)
    array([-310.,    0.])
    """

    reactions: tuple[Reaction, ...]

    def __post_init__(self) -> None:
        require_tuple("reactions", self.reactions, object)
        if len(self.reactions) < 2:
            raise InputError(f"reactions must be two at least, got {len(self.reactions)}")
        for number, reaction in enumerate(self.reactions):
            _require_part(f"reactions[{number}]", reaction)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals of places, rates and speed, as of the reactions with the smallest nominal displacements."""
        ordered = sorted((one.inputs for one in self.reactions), key=lambda signals: signals[0].nominal)
        first = {signal.name: signal for signals in reversed(ordered) for signal in signals}
        return tuple(first[name] for name in (*place_names(self.freedoms), "speed"))

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals of the forces on the shaft, with the largest nominal values; the added mass."""
        every = sorted((s for one in self.reactions for s in one.outputs), key=lambda signal: signal.nominal)
        largest = {signal.name: signal for signal in every}
        return (*(largest[name] for name in force_names(self.freedoms)), *mass_outputs(self))

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """The states of each reaction."""
        return tuple(s for k, one in enumerate(self.reactions) for s in _named(f"part{k}", one))

    @property
    def has_states(self) -> bool:
        """Whether one of them has states that rest with the shaft."""
        return any(map(has_states, self.reactions))

    @property
    def initial_state(self) -> Array:
        """The states of all at t = 0."""
        moving: Any = [one for one in self.reactions if one.states]
        return np.concatenate([np.zeros(0), *(one.initial_state for one in moving)])

    @property
    def carries_load(self) -> bool:
        """Whether one of them is a bearing, not a seal."""
        return any(map(carries_load, self.reactions))

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film of all [m], shape (...), of journals at positions (n, ...) [m]."""
        q = require_vector("position", position, len(self.freedoms))
        return np.min([minimum_film(one, q[rows]) for one, rows, _, _ in self._places], axis=0)

    def require_film(self, position: Array) -> None:
        """Do nothing: each reaction says itself where it is touched."""

    def compiled(self) -> FilmCall | None:
        """Return the sum of the forces in the C library; None where one has none, or for a subclass."""
        calls = [compiled_force(one) for one in self.reactions]
        return reduce(FilmCall.plus, calls) if type(self) is Parallel and all(calls) else None

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops; states are held where they begin."""
        total = np.zeros(position.shape)
        for one, rows, _, _ in self._places:
            total[rows] += static_force(one, position[rows], velocity[rows], speed)
        return total

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops."""
        total = np.zeros((len(position), 2 * len(position) + 1, *speed.shape))
        for one, rows, columns, _ in self._places:
            total[np.ix_(rows, columns)] += static_slopes(one, position[rows], velocity[rows], speed)
        return total

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the forces on the shaft, and with inertia the mass [kg], at u = (places, rates, speed)."""
        state, values, n = self._checked(x), input_vector(u, self.freedoms), len(self.freedoms)
        total = np.zeros(n)
        for one, rows, columns, inner in self._places:
            total[rows] += one.output(t, state[inner], values[columns])[: len(rows)]
        mass = self.mass(values[:n], values[n : 2 * n], values[-1]) if self.has_inertia else np.zeros((n, n))
        return np.concatenate([total, mass_entries(self, mass)])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of all states."""
        state, values = self._checked(x), input_vector(u, self.freedoms)
        rates = [_moved(one, t, state[inner], values[columns]) for one, _, columns, inner in self._places]
        return np.concatenate(rates)

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives."""
        state, values, n = self._checked(x), input_vector(u, self.freedoms), len(self.freedoms)
        A, B, C, D = self._joined(
            [one.linearization(t, state[inner], values[columns]) for one, _, columns, inner in self._places]
        )
        if not self.has_inertia:
            return Linearization(A, B, C, D)
        slopes = mass_entries(self, self.mass_slopes(values[:n], values[n : 2 * n], values[-1]))
        return Linearization(A, B, np.vstack([C, np.zeros((len(slopes), len(A)))]), np.vstack([D, slopes]))

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the states of all that rest with the shaft at a place (n,)."""
        q = require_finite("position", position)
        return np.concatenate([rest_state(one, q[rows], speed) for one, rows, _, _ in self._places])

    @cached_property
    def leaking(self) -> Parallel:
        """The same with a small decay of states where some integrate."""
        parts = tuple(map(_leaking, self.reactions))
        held = all(a is b for a, b in zip(parts, self.reactions, strict=True))
        return self if held else replace(self, reactions=parts)

    def at_rest(self) -> Any:
        """Return the reaction without states: with those that rest at rest; itself where it has none."""
        return AssemblyAtRest(self.leaking) if self.has_states else self

    def parts_at_rest(self, position: Array, speed: float) -> list[PartAtRest]:
        """Return its reactions under a shaft at rest at a place (n,)."""
        return [PartAtRest(one, position[rows], speed) for one, rows, _, _ in self._places]

    def rest_place(self, load: Sequence[float], speed: float) -> Array | None:
        """Return about where the shaft rests: where the first journal or ball bearing says that it does."""
        push, place = np.array(load), np.zeros(len(self.freedoms))
        for one, rows, _, _ in self._places:
            told = _told_place(one, push[rows], speed) if {*PLANAR} <= {*freedoms_of(one)} else None
            if told is not None:
                place[rows] = told
                return _reached(self, place, speed)
        return None

    def dynamic_stiffness(self, position: ArrayLike, speed: float) -> HoldingStiffness:
        """Return K(s) of small motion; see `core.port`."""
        return HoldingStiffness(self.rest_linearization(position, speed))

    def rest_linearization(self, position: ArrayLike, speed: float) -> Linearization:
        """Return the derivatives with all states at rest; see `core.port`.

        States that drift, as wear, are held beside those that rest.
        """
        q, held = require_finite("position", position), self.has_states
        follow = [has_states(one) if held else bool(one.states) for one in self.reactions]
        places = zip(self._places, follow, strict=True)
        return self._joined([_at_rest(one, q[rows], speed, moves) for (one, rows, _, _), moves in places])

    def _joined(self, parts: Sequence[Linearization]) -> Linearization:
        """Return the derivatives of the sum from those of the reactions."""
        n = len(self.freedoms)
        size, first, D = sum(len(part.A) for part in parts), 0, np.zeros((n, 2 * n + 1))
        A, B, C = np.zeros((size, size)), np.zeros((size, 2 * n + 1)), np.zeros((n, size))
        for part, (_, rows, columns, _) in zip(parts, self._places, strict=True):
            inner = slice(first, first + len(part.A))
            A[inner, inner], B[inner, columns], C[rows, inner] = part.A, part.B, part.C[: len(rows)]
            D[np.ix_(rows, columns)] += part.D[: len(rows)]
            first = inner.stop
        return Linearization(A, B, C, D)

    def _checked(self, x: ArrayLike) -> Array:
        state = require_finite("x", x)
        if state.shape != (len(self.states),):
            raise InputError(f"x must have shape ({len(self.states)},), got shape {state.shape}")
        return state


# A reaction behind another one, with a body between them.


@quantities
@dataclass(frozen=True)
class Body:
    """A rigid body between two reactions that does not turn, such as the outer ring of a bearing in a damper.

    Parameters
    ----------
    mass : float [kg]
    inertia : float or None [kg m2]
        About its diameters; None for a body that does not tilt.

    Raises
    ------
    InputError
        If one of them is not positive.
    """

    mass: float
    inertia: float | None = None

    def __post_init__(self) -> None:
        require_positive("mass", self.mass)
        if self.inertia is not None:
            require_positive("inertia", self.inertia)


@quantities
@dataclass(frozen=True)
class Series:
    """One reaction between ground and a body, and another one between the body and the shaft.

    The force on the shaft is that of the inner reaction at the place of the shaft in the body, with the speed
    of the shaft. The outer one feels the body alone, at speed 0. The body moves in what both react to; in all
    else it stands still. Its places and rates are states, as body_x and body_vx, before those of the inner
    and the outer reaction, as inner_tilt_1 and outer_state_0.

    Parameters
    ----------
    outer : Reaction
        Such as a damper on its springs; a mass that it adds is added to the body.
    body : Body
        Between both, such as the outer ring of a ball bearing.
    inner : Reaction
        Such as a ball bearing; it adds no mass.

    Raises
    ------
    InputError
        If a reaction is none or leaves its temperature to the balance of its heat, the inner one adds a mass,
        or they react to no motion in common.

    Examples
    --------
    >>> from rotorfilm import LinearBearing
    >>> spring = LinearBearing(stiffness=1e6)
    >>> [state.name for state in Series(spring, Body(2.0), spring).states]
    ['body_x', 'body_y', 'body_vx', 'body_vy']
    """

    outer: Reaction
    body: Body
    inner: Reaction

    def __post_init__(self) -> None:
        _require_part("outer", self.outer)
        _require_part("inner", self.inner)
        if inertial(self.inner) is not None:
            raise InputError(
                f"inner must not add a mass, which would feel shaft and body at once, got {self.inner!r}"
            )
        if not self._shared:
            both = " and ".join(", ".join(freedoms_of(part)) for part in (self.outer, self.inner))
            raise InputError(f"outer and inner must react to one motion that the body has, got {both}")

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Those of the inner reaction."""
        return freedoms_of(self.inner)

    @property
    def clearance(self) -> float:
        """How far the shaft may go [m]: the clearances of both."""
        return clearance_of(self.inner) + clearance_of(self.outer)

    @property
    def carries_load(self) -> bool:
        """Whether both are bearings."""
        return carries_load(self.inner) and carries_load(self.outer)

    def force_noise(self, speed: float) -> float:
        """Return what roundoff may leave of the forces of both [N]."""
        return force_noise(self.inner, speed) + force_noise(self.outer, 0.0)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Those of the inner reaction."""
        return self.inner.inputs

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The forces of the inner reaction."""
        return self.inner.outputs[: len(self.freedoms)]

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """Places and rates of the body, and the states of the inner and of the outer reaction."""
        felt = {signal.name: signal for signal in self.outer.inputs}
        moved = [
            replace(felt[name], name=f"body_{name}", description=f"{name} of the body between both reactions")
            for name in place_names(self._shared)
        ]
        return (*moved, *_named("inner", self.inner), *_named("outer", self.outer))

    @property
    def initial_state(self) -> Array:
        """The body at rest in the center, and both reactions as they begin."""
        parts: Any = [part for part in (self.inner, self.outer) if part.states]
        return np.concatenate([np.zeros(2 * len(self._shared)), *(part.initial_state for part in parts)])

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the forces on the shaft at u = (places, rates, speed)."""
        (state, felt), _ = self._felt(x, u)
        return np.asarray(self.inner.output(t, state, felt))[: len(self.freedoms)]

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of the states."""
        inner, outer = self._felt(x, u)
        k = len(self._shared)
        return np.concatenate(
            [
                np.asarray(x, dtype=float)[k : 2 * k],
                self._acceleration(t, inner, outer),
                _moved(self.inner, t, *inner),
                _moved(self.outer, t, *outer),
            ]
        )

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives."""
        inner, outer = self._felt(x, u)
        heavy, still = inertial(self.outer), np.zeros((len(self._shared), len(outer[1])))
        if heavy is not None:
            n, rows = len(outer[1]) // 2, self._rows[1]
            slopes = heavy.mass_slopes(outer[1][:n], outer[1][n : 2 * n], 0.0)[np.ix_(rows, rows)]
            still = np.einsum("ijk,j->ik", slopes, self._acceleration(t, inner, outer))
        return self._joined(
            self.inner.linearization(t, *inner), self.outer.linearization(t, *outer), outer[1], still
        )

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the states that rest with the shaft at a place (n,).

        Raises
        ------
        EquilibriumError
            If the body has no rest, as in a ruptured film without springs.
        """
        q = require_finite("position", position)
        b = self._resting_body(q, speed)
        inner, outer = self._apart(q, b)
        return np.concatenate(
            [b, np.zeros_like(b), rest_state(self.inner, inner, speed), rest_state(self.outer, outer, 0.0)]
        )

    @cached_property
    def leaking(self) -> Series:
        """The same with a small decay of states where some integrate."""
        outer, inner = _leaking(self.outer), _leaking(self.inner)
        held = outer is self.outer and inner is self.inner
        return self if held else replace(self, outer=outer, inner=inner)

    def at_rest(self) -> AssemblyAtRest:
        """Return the reaction without states: with those at rest under a shaft at rest."""
        return AssemblyAtRest(self.leaking)

    def parts_at_rest(self, position: Array, speed: float) -> list[PartAtRest]:
        """Return both reactions under a shaft at rest at a place (n,)."""
        inner, outer = self._apart(position, self._resting_body(position, speed))
        return [PartAtRest(self.inner, inner, speed), PartAtRest(self.outer, outer, 0.0)]

    def rest_place(self, load: Sequence[float], speed: float) -> Array | None:
        """Return about where the shaft rests: where the inner reaction says, on the outer one as springs."""
        push = np.array(load)
        place = _told_place(self.inner, push, speed)
        if place is None:
            return None
        (own, other), still = self._rows, np.zeros(len(freedoms_of(self.outer)))
        with suppress(EquilibriumError, UndefinedDerivativeError, np.linalg.LinAlgError):
            slopes = _slopes_near_rest(self.outer, still, 0.0)[np.ix_(other, other)]
            place[own] -= np.linalg.solve(slopes, push[own])
        return _reached(self, place, speed)

    def require_range(self, frequency: float) -> None:
        """Warn, or raise InputError, where the model of one of both ends, for motion at [rad/s].

        Parameters
        ----------
        frequency : float [rad/s]
            Of the motion.
        """
        require_range(self.inner, frequency)
        require_range(self.outer, frequency)

    def dynamic_stiffness(self, position: ArrayLike, speed: float) -> HoldingStiffness:
        """Return K(s) of small motion; see `core.port`."""
        return HoldingStiffness(self.rest_linearization(position, speed))

    def rest_linearization(self, position: ArrayLike, speed: float) -> Linearization:
        """Return the derivatives with all states at rest; see `core.port`."""
        q = require_finite("position", position)
        inner, outer = self._apart(q, self._resting_body(q, speed))
        felt = np.concatenate([outer, np.zeros(len(outer) + 1)])
        still = np.zeros((len(self._shared), len(felt)))
        return self._joined(
            _at_rest(self.inner, inner, speed, has_states(self.inner)),
            _at_rest(self.outer, outer, 0.0, has_states(self.outer)),
            felt,
            still,
        )

    @cached_property
    def _shared(self) -> tuple[str, ...]:
        """Motions of the body."""
        tilts = self.body.inertia is not None
        known = [name for name in FREEDOMS if not FREEDOMS[name].turns or (tilts and name != "twist")]
        return tuple(name for name in self.freedoms if name in freedoms_of(self.outer) and name in known)

    @cached_property
    def _rows(self) -> tuple[list[int], list[int]]:
        """Where the motions of the body are among those of the inner and of the outer reaction."""
        inner, outer = self.freedoms, freedoms_of(self.outer)
        return [inner.index(name) for name in self._shared], [outer.index(name) for name in self._shared]

    def _apart(self, q: Array, b: Array) -> tuple[Array, Array]:
        """Return the places that both feel with shaft and body at places q and b."""
        inner, outer = np.array(q), np.zeros(len(freedoms_of(self.outer)))
        inner[self._rows[0]] -= b
        outer[self._rows[1]] = b
        return inner, outer

    def _felt(self, x: ArrayLike, u: ArrayLike) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Return states and inputs of both."""
        state, values = require_finite("x", x), input_vector(u, self.freedoms)
        if state.shape != (len(self.states),):
            raise InputError(f"x must have shape ({len(self.states)},), got shape {state.shape}")
        n, k = len(self.freedoms), len(self._shared)
        place, moved = self._apart(values[:n], state[:k])
        rate, moving = self._apart(values[n : 2 * n], state[k : 2 * k])
        end = 2 * k + len(self.inner.states)
        inner = state[2 * k : end], np.concatenate([place, rate, values[-1:]])
        return inner, (state[end:], np.concatenate([moved, moving, [0.0]]))

    def _mass(self, felt: Array) -> Array:
        """Return the mass of the body, with what the outer reaction adds, shape (k, k)."""
        n, rows = len(felt) // 2, self._rows[1]
        tilt = self.body.inertia or 0.0
        own = [tilt if FREEDOMS[name].turns else self.body.mass for name in self._shared]
        return np.diag(own) + mass_of(self.outer, felt[:n], felt[n : 2 * n], 0.0)[np.ix_(rows, rows)]

    def _acceleration(self, t: float, inner: tuple[Array, Array], outer: tuple[Array, Array]) -> Array:
        pull, push = self.inner.output(t, *inner)[self._rows[0]], self.outer.output(t, *outer)[self._rows[1]]
        return np.asarray(np.linalg.solve(self._mass(outer[1]), push - pull))

    def _resting_body(self, q: Array, speed: float) -> Array:
        """Return where the body rests with the shaft at a place, shape (k,)."""
        inner, outer, (own, other) = quasi_static(self.inner), quasi_static(self.outer), self._rows
        n, m, k = len(self.freedoms), len(freedoms_of(self.outer)), len(self._shared)

        def pull(b: Array) -> Array:
            there, here = self._apart(q, b)
            push = static_force(outer, here, np.zeros(m), 0.0)[other]
            return np.asarray(push - static_force(inner, there, np.zeros(n), speed)[own])

        def slopes(b: Array) -> Array:
            there, here = self._apart(q, b)
            push = _slopes_near_rest(self.outer, here, 0.0)[np.ix_(other, other)]
            return np.asarray(push + _slopes_near_rest(self.inner, there, speed)[np.ix_(own, own)])

        gaps = np.array([clearance_of(self.inner), clearance_of(self.outer)])
        share = np.argmax(gaps) if np.isinf(gaps).any() else gaps[1] / gaps.sum()
        nominal = np.array([signal.nominal for signal in self.states[:k]])
        try:
            found = newton_root(pull, slopes, share * q[own], nominal)
        except UndefinedDerivativeError as error:
            raise no_rest(self, q, speed) from error
        if found is None:
            raise no_rest(self, q, speed)
        return found

    def _joined(
        self, inner: Linearization, outer: Linearization, felt: Array, slopes: Array
    ) -> Linearization:
        """Return the derivatives of both and of the body.

        Parameters
        ----------
        inner, outer : Linearization
        felt : ndarray, shape (2 m + 1,)
            Input of the outer reaction.
        slopes : ndarray, shape (k, 2 m + 1)
            Of the mass of the body times its acceleration by that, with the acceleration held.
        """
        n, m, k = len(self.freedoms), len(felt) // 2, len(self._shared)
        size, (own, other) = 2 * k + len(inner.A) + len(outer.A), self._rows
        there, here = np.zeros((2 * n + 1, size)), np.zeros((2 * m + 1, size))
        there[[*own, *(n + row for row in own)], range(2 * k)] = -1.0
        here[[*other, *(m + row for row in other)], range(2 * k)] = 1.0
        kept, held = np.eye(len(inner.A), size, 2 * k), np.eye(len(outer.A), size, 2 * k + len(inner.A))
        force = inner.C[:n] @ kept + inner.D[:n] @ there
        push = (outer.C[:m] @ held + outer.D[:m] @ here)[other] - slopes @ here
        moved = np.linalg.solve(self._mass(felt), np.hstack([push - force[own], -inner.D[own]]))
        A = [np.eye(k, size, k), moved[:, :size], inner.A @ kept + inner.B @ there]
        B = [np.zeros((k, 2 * n + 1)), moved[:, size:], inner.B, np.zeros((len(outer.A), 2 * n + 1))]
        return Linearization(
            np.vstack([*A, outer.A @ held + outer.B @ here]), np.vstack(B), force, inner.D[:n].copy()
        )


# A reaction beside springs to the housing, as the retainer springs of a squeeze-film damper.


Stiffness = float | tuple[float, float] | tuple[tuple[float, float], tuple[float, float]]


@quantities
@dataclass(frozen=True, kw_only=True)
class Sprung(SharedReaction):
    """A film in parallel with springs to the housing, F = reaction - stiffness * position, in compiled loops.

    The same as `Parallel` with a `LinearBearing`, for a reaction to x and y without states. It has a kernel
    and an FMU without Python where the reaction has one, as a damper, and the springs are equal along x and
    y. The springs are preloaded so that they carry the static load where the rotor is centered: give the
    rotor no gravity. Their force is part of what reaches the housing.

    Parameters
    ----------
    reaction : PlanarReaction
        Such as a `PorousDamper`.
    stiffness : float [N/m], or 2 or 2 x 2 numbers
        Of the springs together: along either axis, along x and y, or rows for force x, y.

    Raises
    ------
    InputError
        If the reaction is none, reacts to more than x and y or has states, or the stiffness is not positive.
    """

    reaction: PlanarReaction
    stiffness: Stiffness

    def __post_init__(self) -> None:
        require_kind("reaction", self.reaction, PlanarReaction, "a Reaction such as a PorousDamper")
        require_reaction("reaction", self.reaction, heavy=True, planar=True)
        if getattr(self.reaction, "states", ()):
            raise InputError(
                f"reaction must have no states (Parallel with a LinearBearing has), got {self.reaction!r}"
            )
        given = require_finite("stiffness", self.stiffness)
        if not given.ndim:
            return require_positive("stiffness", self.stiffness)  # type: ignore[arg-type]
        if given.shape not in ((2,), (2, 2)):
            raise InputError(f"stiffness must be one, 2 or 2 x 2 numbers, got shape {given.shape}")
        matrix = np.diag(given) if given.ndim == 1 else given
        if np.linalg.eigvalsh(matrix + matrix.T)[0] <= 0.0:
            raise InputError(f"stiffness must be positive in every direction, got {self.stiffness!r}")
        object.__setattr__(self, "stiffness", tuple(map(tuple, matrix.tolist())))

    @property
    def is_isotropic(self) -> bool:
        """Whether one number says the stiffness along both axes."""
        return not isinstance(self.stiffness, tuple)

    @property
    def reactions(self) -> tuple[PlanarReaction]:
        """The reaction alone: its springs add no mass, and have no wall."""
        return (self.reaction,)

    carries_load: ClassVar[bool] = True
    """Whether it is a bearing: its springs carry the rotor, whatever is beside them."""

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film of the reaction [m], shape (...), of journals at positions (2, ...) [m]."""
        return minimum_film(self.reaction, require_vector("position", position))

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError where the journal touches; a reaction with a wall of its own does itself."""
        if not has_wall(self.reaction):
            super().require_film(position)

    def force_along(
        self, position: Array, velocity: Array, acceleration: Array, speed: ArrayLike = 0.0
    ) -> Array:
        """Return the force in a motion with that of the added mass, shape (2, n) [N]; see `core.port`."""
        return force_along(self.reaction, position, velocity, acceleration, speed) - self._pull(position)

    def compiled(self) -> FilmCall | None:
        """Return the force in the C library; None where the reaction has none, or for a subclass."""
        inner: FilmCall | None = compiled_force(self.reaction)
        if inner is None or type(self) is not Sprung:
            return None
        if self.is_isotropic:
            return inner.beside(cast(float, self.stiffness), still=False)
        springs = FilmCall.of_numbers("rf_springs_at", np.ravel([self.matrix, np.zeros((2, 2))]))
        return inner.plus(springs)._replace(mass=inner.mass)

    def native(self) -> NativeSpec | None:
        """Return the kernel of the reaction with these springs; None where it takes none."""
        if type(self) is not Sprung or not isinstance(self.reaction, HasKernel) or not self.is_isotropic:
            return None
        spec = self.reaction.native()
        return None if spec is None else spec.stiffened(cast(float, self.stiffness))

    def prepare(self) -> Force:
        """Return the force as a function of five numbers; see `StaticReaction.prepare`."""
        call, ((xx, xy), (yx, yy)) = prepared_force(self.reaction), self.matrix

        def force(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
            force_x, force_y = call(x, y, vx, vy, speed)
            return force_x - (xx * x + xy * y), force_y - (yx * x + yy * y)

        return force

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers; see `prepared_tangent`."""
        call, ((xx, xy), (yx, yy)) = prepared_tangent(self.reaction), self.matrix

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, Sequence[float]]:
            force_x, force_y, slopes = call(x, y, vx, vy, speed)
            total = [*slopes]
            for k, stiffness in ((0, xx), (1, xy), (5, yx), (6, yy)):
                total[k] -= stiffness
            return force_x - (xx * x + xy * y), force_y - (yx * x + yy * y), total

        return tangent

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return static_force(self.reaction, position, velocity, speed) - self._pull(position)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, inside the clearance."""
        jacobian = np.array(static_slopes(self.reaction, position, velocity, speed))
        for i, j in np.ndindex(2, 2):
            jacobian[i, j] -= self.matrix[i][j]
        return jacobian

    @cached_property
    def matrix(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """The stiffness, rows for force x, y [N/m]."""
        k: Any = self.stiffness
        return ((k, 0.0), (0.0, k)) if self.is_isotropic else k

    def _pull(self, position: Array) -> Array:
        """Return the stiffness times a position (2, ...)."""
        return np.asarray(np.tensordot(self.matrix, position, 1))
