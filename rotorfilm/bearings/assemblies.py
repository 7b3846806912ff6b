"""Reactions side by side on one shaft, and a film beside springs; what all assemblies share."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike

from ..core.dynamic_stiffness import QuasiStatic, quasi_static, rest_linearization, rest_state, states_rest
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
from ..core.inputs import arguments, quantities
from ..core.model import Array, Linearization, static_linearization
from ..core.port import (
    Force,
    PlanarReaction,
    Reaction,
    Tangent,
    carries_load,
    clearance_of,
    compiled_force,
    force_along,
    force_noise,
    freedoms_of,
    inertial,
    is_constant,
    is_warming,
    largest_eccentricity_ratio,
    minimum_film,
    prepared_force,
    prepared_tangent,
    require_range,
    require_reaction,
    require_terminals,
    rest_place,
    static_force,
    static_slopes,
)
from ..core.results import Equilibrium
from ..core.signals import FREEDOMS, PLANAR, Signal, force_names, place_names
from ..native.film_call import MASSLESS, FilmCall
from ..native.spec import HasKernel, NativeSpec
from .linear import LinearBearing
from .linear_system import HoldingStiffness
from .reaction import InertialModel, broadcast_state, input_vector, mass_entries, mass_outputs


def require_part(name: str, part: Any) -> None:
    """Raise InputError unless a reaction can be part of one that also runs over time."""
    require_reaction(name, part, heavy=True, over_time=True)
    require_terminals(name, part)
    if is_warming(part):
        raise InputError(
            f"{name} must have a given temperature, or the temperature as a state: {name}=bearing.in_time(), "
            f"got a {type(part).__name__} whose oil warms"
        )


def part_linearization(part: Any, position: Array, speed: float, follows: bool) -> Linearization:
    """Return the derivatives of a part whose states rest, and follow the shaft or are held."""
    n = len(position)
    if not follows:
        return static_linearization(static_slopes(part, position, np.zeros(n), speed))
    A, B, C, D = rest_linearization(part, position, speed)
    if D.shape[1] > 2 * n:
        return Linearization(A, B, C, D)
    by_speed = quasi_static(part).jacobian(position, np.zeros(n), speed)[:, -1:]  # exact in slow motion
    return Linearization(A, np.hstack([B, np.zeros((len(A), 1))]), C, np.hstack([D, by_speed]))


def state_rates(part: Any, t: float, x: Array, u: Array) -> Array:
    """Return the rates of the states of a part; none of one without."""
    return np.asarray(part.derivative(t, x, u)) if part.states else np.zeros(0)


def named_states(prefix: str, part: Any) -> list[Signal]:
    """Return the states of a part with a prefix."""
    return [replace(signal, name=f"{prefix}_{signal.name}") for signal in part.states]


def leaking_part(part: Any) -> Any:
    """Return a part with a small decay of those of its states that integrate, so that they have a rest."""
    return getattr(part, "leaking", part)


def reached_place(reaction: Any, place: Array, speed: float) -> Array | None:
    """Return a place from which a search for the rest of a reaction may begin; None where it has no force."""
    with suppress(EquilibriumError, FilmContactError, UndefinedDerivativeError):
        static_force(quasi_static(reaction), place, np.zeros_like(place), speed)
        return place
    return None


def told_place(part: Any, load: Array, speed: float) -> Array | None:
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

    def completed(self, found: Equilibrium) -> Equilibrium:
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
        tell = getattr(still, "completed", None)
        return alone if tell is None else cast(Equilibrium, tell(alone))


class AssemblyAtRest(QuasiStatic):
    """An assembly with its states at rest, which tells the films of its parts."""

    def completed(self, found: Equilibrium) -> Equilibrium:
        """Return an equilibrium with the least film and the largest eccentricity ratio of all parts."""
        parts = [part.completed(found) for part in self.reaction.parts_at_rest(found.position, found.speed)]
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
            Frequency of the motion.
        """
        for one in self.reactions:
            require_range(one, frequency)


@quantities
@dataclass(frozen=True)
class Parallel(SharedReaction):
    """Reactions side by side on one shaft: forces and added masses add up, and states are joined.

    It reacts to all motions to which one of them does, as a journal bearing beside a thrust bearing. The name
    of a state begins with the number of its reaction, for example part0_tilt_1.

    Parameters
    ----------
    reactions : tuple of Reaction
        At least two reactions, all about the same center.

    Raises
    ------
    InputError
        If there are fewer, if one is no Reaction, or if its heat balance determines its temperature.

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
            require_part(f"reactions[{number}]", reaction)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals of positions, velocities and speed.

        Their nominal values are those of the reaction with the smallest nominal displacement. Reactions
        without a wall, such as springs, have no length of their own and come last.
        """
        ordered = sorted(self.reactions, key=lambda one: (_is_open(one), one.inputs[0].nominal))
        first = {signal.name: signal for one in reversed(ordered) for signal in one.inputs}
        return tuple(first[name] for name in (*place_names(self.freedoms), "speed"))

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals of the forces on the shaft, with the largest nominal values, and of the added mass."""
        every = ((not _is_open(one), s.nominal, s) for one in self.reactions for s in one.outputs)
        largest = {s.name: s for *_, s in sorted(every, key=lambda row: row[:2])}
        return (*(largest[name] for name in force_names(self.freedoms)), *mass_outputs(self))

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """The states of each reaction."""
        return tuple(s for k, one in enumerate(self.reactions) for s in named_states(f"part{k}", one))

    @property
    def states_rest(self) -> bool:
        """Whether one of the reactions has states that reach an equilibrium when the shaft rests."""
        return any(map(states_rest, self.reactions))

    @property
    def initial_state(self) -> Array:
        """The states of all reactions at t = 0."""
        moving: Any = [one for one in self.reactions if one.states]
        return np.concatenate([np.zeros(0), *(one.initial_state for one in moving)])

    @property
    def carries_load(self) -> bool:
        """Whether at least one of the reactions is a bearing and not a seal."""
        return any(map(carries_load, self.reactions))

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the minimum film of all reactions [m], shape (...), at journal positions (n, ...) [m]."""
        q = require_vector("position", position, len(self.freedoms))
        return np.array([minimum_film(one, q[rows]) for one, rows, _, _ in self._places]).min(axis=0)

    def require_film(self, position: Array) -> None:
        """Do nothing: each reaction raises its own error where the journal touches."""

    def compiled(self) -> FilmCall | None:
        """Return the sum of the forces in the C library; None for a subclass, or if a force is not in C.

        It includes the added mass, if a reaction has one.
        """
        calls = [compiled_force(one) for one in self.reactions]
        if type(self) is not Parallel or not all(calls):
            return None
        masses = [call.mass for call in calls if call.mass != MASSLESS]
        return reduce(FilmCall.plus, calls)._replace(mass=masses[0] if len(masses) == 1 else MASSLESS)

    def native(self) -> NativeSpec | None:
        """Return the kernel, if one reaction has one and all others are equal springs; else None."""
        others = [one for one in self.reactions if not _equal_springs(one)]
        if type(self) is not Parallel or len(others) != 1 or not isinstance(others[0], HasKernel):
            return None
        spec, springs = others[0].native(), [one for one in self.reactions if one is not others[0]]
        for one in springs:
            spec = None if spec is None else spec.stiffened(_equal_springs(one))
        return spec

    def prepare(self) -> Force:
        """Return the force as a function of five numbers; see `StaticReaction.prepare`."""
        calls = [prepared_force(one) for one in self.reactions]

        def force(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
            force_x = force_y = 0.0
            for call in calls:
                more_x, more_y = call(x, y, vx, vy, speed)
                force_x, force_y = force_x + more_x, force_y + more_y
            return force_x, force_y

        return force

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers; see `prepared_tangent`."""
        calls = [prepared_tangent(one) for one in self.reactions]

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, Sequence[float]]:
            parts = zip(*(call(x, y, vx, vy, speed) for call in calls), strict=True)
            force_x, force_y, slopes = (list(part) for part in parts)
            return sum(force_x), sum(force_y), [sum(entries) for entries in zip(*slopes, strict=True)]

        return tangent

    def force_along(
        self, position: Array, velocity: Array, acceleration: Array, speed: ArrayLike = 0.0
    ) -> Array:
        """Return the force during a motion, with the inertia of added masses, (n, ...); see `core.port`."""
        total = np.zeros(position.shape)
        for one, rows, _, _ in self._places:
            total[rows] += force_along(one, position[rows], velocity[rows], acceleration[rows], speed)
        return total

    @cached_property
    def _varying(self) -> list[_Place]:
        """The reactions besides springs and dampers."""
        return [place for place in self._places if not is_constant(place.reaction)]

    @cached_property
    def _springs(self) -> Array:
        """Derivatives of the forces of all springs and dampers together, shape (n, 2 n + 1)."""
        n = len(self.freedoms)
        total = np.zeros((n, 2 * n + 1))
        for one, rows, columns, _ in self._places:
            if is_constant(one):
                still = np.zeros(len(rows))
                total[np.ix_(rows, columns)] += static_slopes(one, still, still, 0.0)
        return total

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops; the states keep their initial values."""
        total = np.tensordot(self._springs[:, :-1], np.concatenate([position, velocity]), 1)
        for one, rows, _, _ in self._varying:
            if len(rows) == len(total):
                total += static_force(one, position, velocity, speed)
            else:
                total[rows] += static_force(one, position[rows], velocity[rows], speed)
        return total

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops."""
        total = self._springs.reshape(*self._springs.shape, *[1] * speed.ndim) + np.zeros(speed.shape)
        for one, rows, columns, _ in self._varying:
            if len(rows) == len(total):
                total += static_slopes(one, position, velocity, speed)
            else:
                total[np.ix_(rows, columns)] += static_slopes(one, position[rows], velocity[rows], speed)
        return total

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the forces on the shaft, and any added mass [kg], at u = (places, rates, speed)."""
        state, values, n = self._checked(x), input_vector(u, self.freedoms), len(self.freedoms)
        total = self._springs @ values
        for one, rows, columns, inner in self._varying:
            total[rows] += one.output(t, state[inner], values[columns])[: len(rows)]
        mass = self.mass(values[:n], values[n : 2 * n], values[-1]) if self.has_inertia else np.zeros((n, n))
        return np.concatenate([total, mass_entries(self, mass)])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of all states."""
        state, values = self._checked(x), input_vector(u, self.freedoms)
        rates = [
            state_rates(one, t, state[inner], values[columns]) for one, _, columns, inner in self._places
        ]
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
        """Return the equilibrium states of all reactions for a shaft at rest at a position (n,)."""
        q = require_finite("position", position)
        return np.concatenate([rest_state(one, q[rows], speed) for one, rows, _, _ in self._places])

    @cached_property
    def leaking(self) -> Parallel:
        """The same with a small decay of states where some integrate."""
        parts = tuple(map(leaking_part, self.reactions))
        held = all(a is b for a, b in zip(parts, self.reactions, strict=True))
        return self if held else replace(self, reactions=parts)

    def at_rest(self) -> Any:
        """Return the reaction with its states at their equilibrium, or itself if it has no such states."""
        return AssemblyAtRest(self.leaking) if self.states_rest else self

    def parts_at_rest(self, position: Array, speed: float) -> list[PartAtRest]:
        """Return its reactions for a shaft at rest at a position (n,)."""
        return [PartAtRest(one, position[rows], speed) for one, rows, _, _ in self._places]

    def rest_place(self, load: Sequence[float], speed: float) -> Array | None:
        """Return a first guess of the equilibrium, from the first journal or ball bearing."""
        push, place = np.array(load), np.zeros(len(self.freedoms))
        for one, rows, _, _ in self._places:
            told = told_place(one, push[rows], speed) if {*PLANAR} <= {*freedoms_of(one)} else None
            if told is not None:
                place[rows] = told
                return reached_place(self, place, speed)
        return None

    def dynamic_stiffness(self, position: ArrayLike, speed: float) -> HoldingStiffness:
        """Return K(s) of small motion; see `core.port`."""
        return HoldingStiffness(self.rest_linearization(position, speed))

    def rest_linearization(self, position: ArrayLike, speed: float) -> Linearization:
        """Return the derivatives with all states at rest; see `core.port`.

        States that drift, such as wear, are held; all others are in equilibrium.
        """
        q, held = require_finite("position", position), self.states_rest
        follow = [states_rest(one) if held else bool(one.states) for one in self.reactions]
        places = zip(self._places, follow, strict=True)
        return self._joined(
            [part_linearization(one, q[rows], speed, moves) for (one, rows, _, _), moves in places]
        )

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


def _is_open(reaction: Any) -> bool:
    """Return whether a reaction has no wall, whose clearance is a length."""
    return not clearance_of(reaction) < np.inf


def _equal_springs(reaction: Any) -> float:
    """Return the stiffness of springs that are equal along x and y [N/m]; 0 of any other reaction."""
    if not is_constant(reaction) or freedoms_of(reaction) != PLANAR or np.any(reaction.damping):
        return 0.0
    (k, _), _ = reaction.stiffness
    return float(k) if np.array_equal(reaction.stiffness, k * np.eye(2)) else 0.0


# A reaction beside springs to the housing, as the retainer springs of a squeeze-film damper.


@arguments
def with_springs(reaction: PlanarReaction, stiffness: ArrayLike) -> Parallel:
    """Return a film in parallel with springs to the housing, such as the retainer springs of a damper.

    It has a kernel, and an FMU that needs no Python, if the reaction has one and the springs are equal along
    x and y. The springs are preloaded so that they carry the static load where the rotor is centered: give
    the rotor no gravity. The spring force is part of the force on the housing.

    Parameters
    ----------
    reaction : PlanarReaction
        Film that reacts to x and y only, such as a `PorousDamper`.
    stiffness : float [N/m], or 2 or 2 x 2 numbers
        Total stiffness of the springs: one number for both axes, one for each axis, or a matrix with a row
        for each force.

    Raises
    ------
    InputError
        If the reaction is none, reacts to more than x and y, or the stiffness is not positive.
    """
    require_kind("reaction", reaction, PlanarReaction, "a Reaction such as a PorousDamper")
    require_reaction("reaction", reaction, heavy=True, planar=True)
    given = require_finite("stiffness", stiffness)
    if not given.ndim:
        require_positive("stiffness", float(given))
    springs = LinearBearing(stiffness=given.tolist())
    matrix = np.array(springs.stiffness)
    if np.linalg.eigvalsh(matrix + matrix.T)[0] <= 0.0:
        raise InputError(f"stiffness must be positive in every direction, got {stiffness!r}")
    return Parallel((reaction, springs))
