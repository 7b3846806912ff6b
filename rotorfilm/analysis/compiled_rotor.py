"""A rotor as the bearings see it: its linear part in modes, whatever its size, and the forces it feels.

With x = (q, q') and weak springs and dampers at the journals, which the films give back, the rotor is

    x' = A x + B u,    u = (film force + K0 p + C0 p' at each journal, r(t)),

r(t) being the unbalance's pair and x counted from the rest under weight on those springs. In the modes
A V = V Lambda everything linear is exact and costs as many operations as there are modes; without the springs
a rotor that is free to move would have no complete set of modes. Of each conjugate pair one is kept.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from ctypes import byref
from typing import Any, NamedTuple, cast

import numpy as np
from scipy.linalg import block_diag

from ..core import port
from ..core.errors import (
    ConvergenceError,
    InputError,
)
from ..core.model import Array, Dynamic, Linearization
from ..core.results import Trajectory
from ..core.signals import PLANAR
from ..native.film_call import MASSLESS, FilmCall
from ..native.library import loops
from ..native.structs import structure
from ..rotors import (
    CrackedRotor,
    FlexibleRotor,
    MotorDrivenRotor,
    MountedRotor,
    RigidRotor,
    SpeedProfile,
    TimeExcitedRotor,
    mount,
)
from ..rotors.structure import (
    NOMINAL_LENGTH,
    Operators,
    Structure,
    freedom_rows,
    solved_equations,
    station_name,
)
from .force_calls import CrackForce, call_over_time, feels_tilt, film_call, has_states_in_c

# A rotor as the bearings see it: its linear part in modes, whatever its size, and the forces it feels.


Complex = np.ndarray

SUPPORTS = ((1.0, 0.3), (3.0, 0.3), (0.3, 0.3), (1.0, 1.0), (10.0, 1.0), (0.1, 0.1))
"""Springs and dampers at the journals, relative to their natural size, tried until the modes are distinct."""

GOOD_CONDITION, GOOD_SIZE = 1e6, 200
"""Condition of the modes, in scaled coordinates, that is taken at once; of more than so many states, more.

It grows with the highest frequency of a shaft, which goes with the square of the number of elements.
"""

LARGEST_CONDITION = 1e10

DECAY = 1.0
"""Rate at which the states of films fall by themselves, which the films give back [1/s]."""

FARTHEST = 1e6
"""Largest displacement of a rest on springs, in clearances: roundoff of 1e-10 is left of motion about it."""


class StationEquations(NamedTuple):
    """A bearing with a part in the linear equations of its rotor, with its states behind those of the rotor.

    It is linear, or a film in C with states, of which only their decay is there.

    Attributes
    ----------
    station : str
    reaction : Any
    system : Linearization
        Rates of its states and forces over its states, and over x, y, vx, vy of its journal.
    rows : ndarray, shape (2, N)
        Displacement of its journal.
    mass : ndarray, shape (2, 2) [kg]
    """

    station: str
    reaction: Any
    system: Linearization
    rows: Array
    mass: Array


class Parts(NamedTuple):
    """A mounted rotor taken apart: matrices, speed, and bearings at some of the stations.

    Attributes
    ----------
    structure : Structure
    profile : SpeedProfile
    bearings : tuple of Any
    names : tuple of str
        Stations of the bearings.
    rows : ndarray, shape (2 n_bearings, N)
        Displacement of their journals; (4 n_bearings, N), of two points of each, where one feels its tilt.
    excited : ndarray, shape (1 + m, n), or None
        Times and excitation over them, as acceleration of the ground along x and y; None without.
    moved : ndarray, shape (N, m)
        Acceleration of the coordinates per excitation.
    linear : tuple of StationEquations
        Bearings with a part in the linear equations: in C those that are linear have no force.
    over_time : bool
        Whether it is taken apart for a run over time.
    motor : MotorDrivenRotor or None
        The rotor, where a motor drives it: its profile is then the speed at t = 0.
    """

    structure: Structure
    profile: SpeedProfile
    bearings: tuple[Any, ...]
    names: tuple[str, ...]
    rows: Array
    excited: Array | None = None
    moved: Array = np.zeros((0, 0))
    linear: tuple[StationEquations, ...] = ()
    over_time: bool = False
    motor: MotorDrivenRotor | None = None

    @property
    def points(self) -> int:
        """Points of each journal whose displacements its film needs: 2 where a journal feels its tilt."""
        return len(self.rows) // (2 * len(self.bearings))

    @property
    def lengths(self) -> Array:
        """Typical displacement of each point: the clearance, shape (points n_bearings,) [m]."""
        sizes = [bearing.clearance for bearing in self.bearings]
        return np.repeat([size if math.isfinite(size) else NOMINAL_LENGTH for size in sizes], self.points)

    @property
    def mass(self) -> Array:
        """Mass matrix of the rotor with the added masses of its linear bearings, shape (N, N)."""
        added = sum(one.rows.T @ one.mass @ one.rows for one in self.linear)
        return np.asarray(self.structure.mass + added)

    @property
    def alone(self) -> Parts:
        """The rotor by itself, on which all bearings act by their forces."""
        return self._replace(linear=())

    def is_linear(self, bearing: Any) -> bool:
        """Return whether a bearing is part of the linear equations."""
        return any(bearing is one.reaction for one in self.linear) and not has_states_in_c(bearing)

    @property
    def film_states(self) -> list[range]:
        """Places among all states of those of each film in C, in the order of the bearings."""
        found, first = [range(0)] * len(self.bearings), 2 * len(self.structure.weight)
        for one in self.linear:
            last = first + len(one.system.A)
            if has_states_in_c(one.reaction):
                found[self.names.index(one.station)] = range(first, last)
            first = last
        return found

    def call(self, bearing: Any) -> FilmCall:
        """Return the force of one of the bearings in C."""
        if isinstance(bearing, CrackForce):
            return bearing.call()
        if self.is_linear(bearing):
            return FilmCall.of_numbers("rf_springs_at", np.zeros(8))
        if self.over_time and has_states_in_c(bearing):
            return cast(FilmCall, bearing.call_with_states())
        return call_over_time(bearing) if self.over_time else film_call(bearing)

    def scale(self, rate: float) -> Array:
        """Return typical sizes of the states of rotor and bearings, for a displacement of 1 m."""
        inner = [signal.nominal / NOMINAL_LENGTH for one in self.linear for signal in one.reaction.states]
        return np.concatenate([np.repeat([1.0, rate], len(self.structure.weight)), inner])

    @property
    def nominal_speed(self) -> float:
        """Largest angular speed [rad/s] that is known before a run; 0 where it does not turn."""
        return self.motor.nominal_speed if self.motor else max(abs(value) for value in self.profile.speeds)

    @property
    def turns(self) -> bool:
        """Whether the matrices depend on the speed: a gyroscopic effect or rotating damping."""
        return bool(np.any(self.structure.gyroscopic) or np.any(self.structure.circulation))

    @property
    def speed(self) -> float:
        """The constant speed [rad/s]; raise InputError where it changes, or something excites the rotor."""
        if self.excited is not None:
            raise InputError("rotor must not be excited over time for a periodic motion, got one that is")
        speeds = set(self.profile.speeds)
        if len(speeds) != 1:
            raise InputError(f"speed must be constant, got a profile over {self.profile.times!r} s")
        return float(speeds.pop())


class ModalRotor(NamedTuple):
    """The linear part of a mounted rotor in modes, at one speed.

    Attributes
    ----------
    parts : Parts
    values : ndarray of complex, shape (n_modes,) [1/s]
    shapes : ndarray of complex, shape (2 N, n_modes)
        State per modal coordinate: the state is the real part of their sum.
    inverse : ndarray of complex, shape (n_modes, 2 N)
    push : ndarray of complex, shape (n_modes, 2 n_bearings + 2)
        Modal force per film force and per unbalance pair; two columns more where the ground shakes.
    sense : ndarray of complex, shape (4 n_bearings, n_modes)
        x, y, vx, vy of each journal per modal coordinate.
    rest : ndarray, shape (2 N,)
        State under weight on the springs.
    spring, damper : ndarray, shape (2 n_bearings,) [N/m], [N s/m]
        K0 and C0.
    calls : tuple of FilmCall
    condition : float [1]
    """

    parts: Parts
    values: Complex
    shapes: Complex
    inverse: Complex
    push: Complex
    sense: Complex
    rest: Array
    spring: Array
    damper: Array
    calls: tuple[FilmCall, ...]
    condition: float

    @property
    def is_heavy(self) -> bool:
        """Whether a bearing adds a mass that its force in C has."""
        return any(call.mass != MASSLESS for call in self.calls)

    @property
    def journal_rest(self) -> Array:
        """x, y, vx, vy of each journal at `rest`, shape (4 n_bearings,)."""
        return journal_rows(self.parts) @ self.rest

    def modal(self, state: Array) -> Complex:
        """Return the modal coordinates of a state (2 N,)."""
        return self.inverse @ (state - self.rest)

    def physical(self, modal: Complex) -> Array:
        """Return the states of modal coordinates (n_modes, ...)."""
        rest = self.rest.reshape(-1, *[1] * (modal.ndim - 1))
        return np.asarray((self.shapes @ modal).real + rest)


def point_rows(bearing: Any) -> Array:
    """Return x and y of two points of a journal, shape (4, 4), by x, y, tilt_x and tilt_y of its middle."""
    arm = bearing.arm if feels_tilt(bearing) else 0.0
    return np.array(
        [[1.0, 0.0, 0.0, arm], [0.0, 1.0, -arm, 0.0], [1.0, 0.0, 0.0, -arm], [0.0, 1.0, arm, 0.0]]
    )


def place_rows(structure: Structure, names: Sequence[str], bearings: Sequence[Any], *, tilted: bool) -> Array:
    """Return the displacements of journals, or of two points of each: of its ends where it feels its tilt."""
    each = []
    for name, bearing in zip(names, bearings, strict=True):
        if feels_tilt(bearing) and tilted:
            each.append(point_rows(bearing) @ freedom_rows(structure, name, bearing.freedoms))
        else:
            each += [freedom_rows(structure, name)] * (2 if tilted else 1)
    return np.concatenate(each)


def point_forces(parts: Parts, run: Trajectory) -> list[Array]:
    """Return the forces on the points of the journals in a run, along x and y of each, shape (n_times,) each.

    Those on two points of a journal have its force and its moments; half of its force is at each without.
    """
    forces: list[Array] = []
    for name, bearing in zip(parts.names, parts.bearings, strict=True):
        count = len(port.freedoms_of(bearing))
        found = [run[station_name(name, signal.name)] for signal in bearing.outputs[:count]]
        if feels_tilt(bearing) and parts.points > 1:
            forces.extend(np.linalg.solve(point_rows(bearing).T, np.stack(found)))
        else:
            forces.extend(row / parts.points for row in found * parts.points)
    return forces


def take_apart(mounted: MountedRotor, *, over_time: bool = False) -> Parts:
    """Return structure, speed and bearings of a rotor that rests in bearings without states.

    For a run over time they may be journals that feel their tilt, bearings that add mass, linear ones with
    states, and films in C with states, and the rotor may have a crack.

    Raises
    ------
    InputError
        If the rotor is none with matrices, rests in no bearing, or in one with states.
    """
    found = mounted.all_bearings
    bare: Any = mounted.bare
    around = (TimeExcitedRotor, CrackedRotor) if over_time else (TimeExcitedRotor,)
    motor = bare if over_time and type(bare) is MotorDrivenRotor else None
    structure, profile = _structure(bare.rotor if motor or isinstance(bare, around) else bare)
    names = [name for name in structure.stations if name in found]
    bearings = [found[name] for name in names]
    if not names:
        raise InputError("rotor must rest in at least one bearing: mount(rotor, {station: bearing})")
    linear = _linear_reactions(structure, _speeds(mounted), found) if over_time else ()
    known = {one.station for one in linear}
    moving = [name for name in names if found[name].states and name not in known]
    if moving:
        raise InputError(
            f"bearings must have no states of their own here, got some at the stations {moving}: "
            "simulate(rotor, bearings) takes them, and unbalance_response their small motion"
        )
    tilted = over_time and any(feels_tilt(bearing) for bearing in bearings)
    cracked = [CrackForce(bare)] if isinstance(bare, CrackedRotor) else []
    if tilted and (cracked or any(port.inertial(one) or has_states_in_c(one) for one in bearings)):
        raise InputError(
            "rotor must have no crack, no added mass and no film with states beside a journal that feels its "
            "tilt"
        )
    for name in names:
        planar = not (tilted and feels_tilt(found[name]))
        port.require_reaction(f"bearings[{name!r}]", found[name], heavy=True, planar=planar)
    rows = [
        place_rows(structure, names, bearings, tilted=tilted),
        *(one.rotor.weakness[0] for one in cracked),
    ]
    every = *bearings, *cracked
    parts = Parts(
        structure,
        profile,
        every,
        tuple(names),
        np.concatenate(rows),
        linear=linear,
        over_time=over_time,
        motor=motor,
    )
    if isinstance(bare, TimeExcitedRotor):
        moved: Array = np.linalg.solve(parts.mass, structure.mass @ bare.columns).astype(float)
        return parts._replace(excited=bare.rows, moved=moved)
    return parts


def _linear_reactions(
    structure: Structure, speeds: Sequence[float], bearings: Mapping[str, Any]
) -> tuple[StationEquations, ...]:
    """Return bearings with a part in the linear equations, in the order of their states."""
    every = []
    for name, bearing in bearings.items():
        system = _decay(bearing) if has_states_in_c(bearing) else port.linear_system(bearing, speeds)
        if system is not None:
            still = np.zeros(2)
            mass = port.mass_of(bearing, still, still, speeds[0])
            every.append(StationEquations(name, bearing, system, freedom_rows(structure, name), mass))
    return tuple(every)


def _decay(film: Any) -> Linearization:
    """Return the equations of the states of a film that fall by themselves."""
    n = len(film.states)
    return Linearization(-DECAY * np.eye(n), np.zeros((n, 4)), np.zeros((2, n)), np.zeros((2, 4)))


def _structure(rotor: Dynamic) -> tuple[Structure, SpeedProfile]:
    if not isinstance(rotor, RigidRotor | FlexibleRotor):
        raise InputError(f"rotor must be a RigidRotor or a FlexibleRotor in its bearings, got {rotor!r}")
    if rotor.structure.hysteresis is not None:
        raise InputError("loss_factor must be 0 in large motion, where hysteresis is not a force")
    if rotor.structure.others:
        raise InputError(
            "rotor must move in its planes only here, without axial and torsional motion, which "
            "simulate(rotor, bearings) takes"
        )
    return rotor.structure, rotor.profile


def journal_rows(parts: Parts) -> Array:
    """Return the rows that make x, y, vx, vy of each journal out of (q, q'), shape (4 n_bearings, 2 N)."""
    count, size = parts.rows.shape
    width = len(parts.scale(1.0))
    rows = np.zeros((count // 2, 4, width))
    rows[:, :2, :size] = rows[:, 2:, size : 2 * size] = parts.rows.reshape(-1, 2, size)
    return rows.reshape(2 * count, width)


def equations(parts: Parts) -> Operators:
    """Return the equations of a rotor with its linear bearings; `push` is that on the journals."""
    structure, mass, n = parts.structure, parts.mass, len(parts.structure.weight)
    model = solved_equations(structure._replace(mass=mass))
    if len(parts.rows) == 2 * len(parts.names):
        push = model.push[
            :, [2 * structure.stations.index(name) + axis for name in parts.names for axis in range(2)]
        ]
    else:
        push = np.vstack([np.zeros_like(parts.rows.T), np.linalg.solve(mass, parts.rows.T)])
    further = sum(len(one.system.A) for one in parts.linear)
    steady = np.pad(model.steady, (0, further))
    first = 2 * n
    for one in parts.linear:
        inner = slice(first, first := first + len(one.system.A))
        seen, lift = block_diag(one.rows, one.rows), np.linalg.solve(mass, one.rows.T)
        steady[n : 2 * n, : 2 * n] += lift @ one.system.D @ seen
        steady[n : 2 * n, inner] = lift @ one.system.C
        steady[inner, : 2 * n], steady[inner, inner] = one.system.B @ seen, one.system.A
    below = (0, further), (0, 0)
    return Operators(
        steady=steady,
        by_speed=np.pad(model.by_speed, (0, further)),
        push=np.pad(push, below),
        weight=np.pad(model.weight, (0, further)),
        unbalance=np.pad(model.unbalance, below),
        sense=model.sense,
    )


def state_matrices(parts: Parts, speed: float) -> tuple[Array, Array, Array]:
    """Return A (2 N, 2 N) without films, B (2 N, 2 n_bearings + 2), the weight's acceleration (2 N,)."""
    model = equations(parts)
    pushes = [model.push, model.unbalance]
    if parts.excited is not None:
        moved = np.vstack([np.zeros_like(parts.moved), parts.moved])
        pushes.append(np.pad(moved, ((0, len(model.weight) - len(moved)), (0, 0))))
    return (
        model.steady + speed * model.by_speed,
        np.hstack(pushes),
        model.weight,
    )


def turning_pairs(turn: Array) -> Array:
    """Return the pairs that an unbalance makes forces of, shape (n, 2), of angles, speeds, accelerations."""
    angle, speed, acceleration = turn
    cos, sin = np.cos(angle), np.sin(angle)
    return np.column_stack([speed**2 * cos + acceleration * sin, speed**2 * sin - acceleration * cos])


def unbalance_rates(modal: ModalRotor) -> Complex:
    """Return the velocity of the unbalance, U' q', per modal coordinate, shape (2, n_modes)."""
    unbalance = modal.parts.structure.unbalance
    return np.asarray(unbalance.T @ modal.shapes[len(unbalance) : 2 * len(unbalance)])


def rotating_damping_torque(modal: ModalRotor) -> Array | None:
    """Return the torque of rotating damping at standstill and its decrease per rad/s; see `motor.h`.

    Returns
    -------
    ndarray, shape (2, 2 n_modes + 1, 2 n_modes + 1), or None
        Quadratic forms of real and imaginary parts of the modal coordinates and 1; None without damping.
    """
    driven, n = modal.parts.motor, len(modal.parts.structure.weight)
    if driven is None or not np.any(modal.parts.structure.circulation):
        return None
    whole = np.column_stack([modal.shapes.real, -modal.shapes.imag, modal.rest])
    turned = driven.quarter_turn @ whole[:n]
    left = turned.T @ driven.rotating_damping
    return np.array([left @ whole[n : 2 * n], left @ turned])


def spin_rates(modal: ModalRotor) -> tuple[Array, Array]:
    """Return what a rad/s more than the speed of the modes adds to the rates of the modal coordinates.

    Returns
    -------
    matrix : ndarray, shape (2 n_modes, 2 n_modes)
        Matrix per real and imaginary part, of real and imaginary part.
    rest : ndarray, shape (2 n_modes,)
        At the rest.
    """
    by_speed = modal.inverse @ equations(modal.parts).by_speed
    seen, rest = by_speed @ np.hstack([modal.shapes.real, -modal.shapes.imag]), by_speed @ modal.rest
    return np.vstack([seen.real, seen.imag]), np.concatenate([rest.real, rest.imag])


def modal_rotor(parts: Parts, speed: float) -> ModalRotor:
    """Return the linear part of a rotor at one speed in modes.

    Raises
    ------
    ConvergenceError
        If no springs at the journals make its modes distinct.
    """
    A, B, weight = state_matrices(parts, speed)
    stiffness, rate = _natural_support(parts, speed)
    seen = journal_rows(parts).reshape(-1, 2, 2, len(A)).swapaxes(1, 2).reshape(-1, 2, len(A))
    best: tuple[tuple[Complex, Complex, Complex, float], Array, Array, Array] | None = None
    for spring, damper in SUPPORTS:
        K0 = spring * np.outer(stiffness, (1.0, 1.3)).ravel()
        C0 = damper / spring * K0 / rate
        shifted = A - B[:, : len(K0)] @ (K0[:, None] * seen[:, 0] + C0[:, None] * seen[:, 1])
        found = modes(shifted, parts.scale(rate))
        if best is None or found[3] < best[0][3]:
            best = found, K0, C0, shifted
        if found[3] < GOOD_CONDITION * max(1.0, len(A) / GOOD_SIZE) ** 2:
            break
    assert best is not None
    (values, shapes, inverse, condition), K0, C0, shifted = best
    if not condition < LARGEST_CONDITION:
        raise ConvergenceError(f"modes of the rotor must be distinct, got a condition of {condition:.3g}")
    try:
        rest = np.asarray(-np.linalg.solve(shifted, weight))
    except np.linalg.LinAlgError:
        rest = np.full(len(weight), np.inf)
    if not np.abs(rest).max() <= FARTHEST * parts.lengths.max():
        raise ConvergenceError("weight must leave the rotor on springs at its journals, got one that falls")
    return ModalRotor(
        parts=parts,
        values=values,
        shapes=shapes,
        inverse=inverse,
        push=inverse @ B,
        sense=journal_rows(parts) @ shapes,
        rest=rest,
        spring=K0,
        damper=C0,
        calls=tuple(map(parts.call, parts.bearings)),
        condition=condition,
    )


def _natural_support(parts: Parts, speed: float) -> tuple[Array, float]:
    """Return the size of the stiffness at each bearing [N/m], and a typical rate [1/s]."""
    count, s = len(parts.lengths), parts.structure
    load = float(np.linalg.norm(s.weight)) / count
    # A rigid translation is what the journals' rows see with a weight of one.
    mass = float(np.trace(s.mass)) / (2.0 * count)
    stiffness = load / parts.lengths + 0.01 * mass * speed**2
    if not np.all(stiffness > 0.0):
        stiffness = np.full(count, float(np.abs(s.stiffness).max()) or 1.0)
    for k, bearing in enumerate(parts.bearings):
        stiffness[k] *= not isinstance(bearing, CrackForce)
    return stiffness, abs(speed) or math.sqrt(float(stiffness.max()) / mass)


def modes(A: Array, scale: Array) -> tuple[Complex, Complex, Complex, float]:
    """Return eigenvalues, shapes, their inverse and condition; one of each pair, real parts to be added."""
    values, vectors = np.linalg.eig(A * scale / scale[:, None])
    try:
        inverse = np.linalg.inv(vectors)
    except np.linalg.LinAlgError:
        return values, vectors, vectors, np.inf
    condition = float(np.linalg.norm(vectors, 1) * np.linalg.norm(inverse, 1))
    inverse = inverse / scale
    kept = values.imag >= 0.0
    weight = np.where(values.imag > 0.0, 2.0, 1.0)
    return (
        values[kept].astype(complex),
        (scale[:, None] * vectors * weight)[:, kept],
        inverse[kept],
        condition,
    )


# The films at the journals of a rotor, with the springs that it rests on (`native/loops/march.h`).


CONTACT_GAP = 1e-9
"""Film thickness, in clearances, at which a journal counts as touching: below any surface roughness."""


def _wall(bearing: Any) -> float:
    """Return the eccentricity at which a journal's points touch [m]; infinite where its force says that."""
    if feels_tilt(bearing) and bearing.tilted_call() is None:
        return math.inf
    return float(getattr(bearing, "travel_limit", bearing.clearance))


class JournalFilms(NamedTuple):
    """The bearings of a rotor as the C library reads them.

    Attributes
    ----------
    films, of : ndarray of addresses, shape (n,)
        Of the functions, and of what they take first.
    rest : ndarray, shape (4 n + n_film_states,)
        x, y, vx, vy of each journal about which motion is counted, and behind them zeros.
    spring, damper : ndarray, shape (2 n,) [N/m], [N s/m]
        What the rotor rests on and the films give back.
    lengths : ndarray, shape (n,) [m]
        Clearances, or what stands for them.
    walls : ndarray, shape (n,) [m]
        Eccentricities at which a journal counts as touching; infinite without a wall.
    arms : ndarray, shape (n / points,) [m]
        Of each journal's points; 0 where it feels no tilt.
    masses, of_masses : ndarray of addresses, shape (n,), or None
        Of the functions of added masses, and of what they take first; None where no bearing adds any.
    first : ndarray of int, shape (n + 1,), or None
        Which of the states of all films those of each are; None where no film has any.
    """

    films: np.ndarray
    of: np.ndarray
    rest: Array
    spring: Array
    damper: Array
    lengths: Array
    walls: Array
    arms: Array
    masses: np.ndarray | None = None
    of_masses: np.ndarray | None = None
    first: np.ndarray | None = None

    @classmethod
    def of_rotor(cls, modal: ModalRotor, *, absolute: bool = False) -> JournalFilms:
        """Return those of a rotor, which has to live as long; motion is from its rest, or `absolute`."""
        addresses = np.array([(call.address, call.data) for call in modal.calls], dtype=np.uintp).T
        parts = modal.parts
        rest = np.zeros(4 * len(parts.lengths)) if absolute else modal.journal_rest
        first = np.append(0, np.cumsum(list(map(len, parts.film_states)))).astype(np.int32)
        rest = np.append(rest, np.zeros(first[-1]))
        sizes = [_wall(one) for one in parts.bearings]
        walls = (1.0 - CONTACT_GAP) * np.repeat(sizes, parts.points)
        arms = np.array([one.arm if feels_tilt(one) else 0.0 for one in parts.bearings])
        rows = rest, modal.spring, modal.damper, parts.lengths, walls, arms
        masses = np.array([call.mass for call in modal.calls], dtype=np.uintp).T
        heavy = map(np.ascontiguousarray, masses) if modal.is_heavy else (None, None)
        found = cls(*map(np.ascontiguousarray, (*addresses, *rows)), *heavy)
        return found._replace(first=first) if first[-1] else found

    def struct(self) -> Any:
        """Return them as the C library reads them, while this object lives."""
        sizes = len(self.lengths), len(self.lengths) // len(self.arms)
        places = (None if numbers is None else numbers.ctypes.data for numbers in self)
        most = 0 if self.first is None else int(np.diff(self.first).max())
        return structure("rf_journals")(*sizes, *places, most, DECAY)

    def forces(self, motion: Array, speed: float) -> tuple[int, Array, Array]:
        """Return a status, forces of films and springs (2 n, samples), and slopes (2 n, 4, samples).

        Parameters
        ----------
        motion : ndarray, shape (4 n, samples) [m, m/s]
            x, y, vx, vy of each journal.
        speed : float [rad/s]
        """
        rows, samples = motion.shape
        given = np.ascontiguousarray(motion, dtype=float)
        force, slope = np.empty((rows // 2, samples)), np.empty((rows // 2, 4, samples))
        places = force.ctypes.data, slope.ctypes.data
        status = loops()["rf_journal_forces"](
            byref(self.struct()), samples, given.ctypes.data, speed, *places
        )
        return status, force, slope


# What of the rotors and films that anybody may bring the compiled integration takes.


EQUATIONS = ("derivative", "output", "operators")
"""Of a rotor, which a subclass may change."""


def compiled_form(rotor: Dynamic, reaction: Any) -> MountedRotor | None:
    """Return a rotor in all its bearings for `simulate_rotor`; None where that does not take it, or slowly.

    It takes it where

    - each bearing is linear, also with states, or adds a mass, or has a force in the C library. The last is a
      journal bearing or a damper whose film has a kernel (map, short film, grooved map, two-dimensional
      film), or one of these beside springs, or a bearing of tilting pads with up to 48
      states. The oil of a journal bearing may
      warm, if its film has its losses in the C library too, as these have without supply pressure;
    - the rotor is a `RigidRotor` or a `FlexibleRotor`, mounted or not, whose equations no subclass has
      changed, without a loss factor; on ground that shakes, with a crack, or driven by a motor too.

    Parameters
    ----------
    rotor : Dynamic
        Rotor with one station left, the one without a name.
    reaction : Reaction
        The bearing of that.
    """
    if not is_linear(rotor, over_time=True) or not _is_compiled(reaction):
        return None
    mounted = mount(rotor, {"": reaction})
    if not all(map(_is_compiled, mounted.all_bearings.values())):
        return None
    try:
        take_apart(mounted, over_time=True)
    except InputError:
        return None
    return mounted


def takes_forces(rotor: Dynamic, bearings: Iterable[Any]) -> bool:
    """Return whether `simulate_rotor` takes a rotor on bearings by station, those in Python too.

    It takes the linear rotors of `compiled_form`, on linear bearings, films in C with states, and others
    without states.
    """
    every = (*bearings, *(rotor.all_bearings.values() if isinstance(rotor, MountedRotor) else ()))
    if not is_linear(rotor, over_time=True):
        return False
    cracked, speeds = type(_bare(rotor)) is CrackedRotor, _speeds(rotor)
    still = all(
        not one.states or has_states_in_c(one) or port.linear_system(one, speeds) is not None for one in every
    )
    planar = all(port.freedoms_of(film) == PLANAR or feels_tilt(film) for film in every)
    tilted = any(map(feels_tilt, every))
    heavy = any(port.inertial(film) is not None or has_states_in_c(film) for film in every)
    return still and planar and not (tilted and (cracked or heavy))


def _is_compiled(bearing: Any) -> bool:
    if port.freedoms_of(bearing) != PLANAR:
        return False
    fast = hasattr(bearing, "linear_system") or port.inertial(bearing) is not None
    return fast or has_states_in_c(bearing) or port.compiled_force(bearing) is not None


AROUND = CrackedRotor, MotorDrivenRotor
"""What changes the equations of a rotor in a run over time only."""


def _bare(rotor: Dynamic) -> Any:
    """Return a rotor without its bearings."""
    return rotor.bare if isinstance(rotor, MountedRotor) else rotor


def _inner(rotor: Dynamic) -> Any:
    """Return a rotor without its bearings, what excites or drives it, and its crack."""
    bare = _bare(rotor)
    return bare.rotor if type(bare) in AROUND or isinstance(bare, TimeExcitedRotor) else bare


def _speeds(rotor: Dynamic) -> tuple[float, ...]:
    """Return the speeds of a run; that of a motor has more than the one at t = 0."""
    known: tuple[float, ...] = _inner(rotor).profile.speeds
    return (*known, math.inf) if type(_bare(rotor)) is MotorDrivenRotor else known


def is_linear(rotor: Dynamic, *, over_time: bool = False) -> bool:
    """Return whether a rotor, in bearings or not, has the equations of its matrices.

    In a run over time it may have a crack, or a motor.
    """
    if type(_bare(rotor)) in AROUND and not over_time:
        return False
    bare = _inner(rotor)
    base = next((kind for kind in (RigidRotor, FlexibleRotor) if isinstance(bare, kind)), None)
    if isinstance(bare, FlexibleRotor) and bare.assembly.others:
        return False
    return base is not None and all(getattr(type(bare), name) is getattr(base, name) for name in EQUATIONS)
