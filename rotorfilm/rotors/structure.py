"""The equations of a flexible rotor, and what every rotor with such equations has in common as a Model.

    M q'' + (C + w G) q' + (K + w H) q = T' f + weight + unbalance(t)

with the angular speed w. q has the coordinates of the x-z plane, as many of the y-z plane, and others, as
along the shaft and about it. G is the gyroscopic effect, H rotating damping. T gives the displacement of
journals from housings.

The torque that drives the shaft is assumed to follow the tilt of each cross section, as if the shaft
transmits it, and to accelerate each section with the speed. Then an angular acceleration only has a moment on
the unbalance.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import copy
from dataclasses import replace
from functools import cached_property
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..core.errors import InputError, keep_pair, require_finite, require_kind, require_number
from ..core.model import Array, Dynamic, Linearization, breakpoints
from ..core.signals import (
    PLANAR,
    Signal,
    force_names,
    force_outputs,
    indices,
    journal_inputs,
    names,
    place_names,
    signals_of,
)
from ..core.units import STANDARD_GRAVITY
from .profile import SpeedProfile, Turning

NOMINAL_LENGTH = 1e-4
"""Typical journal displacement [m], a radial clearance; the rotor does not know its bearing's."""

QUARTER_TURN = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""-i on x + i y: the plane pattern of gyroscopic and circulatory matrices."""


Coordinate = tuple[str, str, float]
"""A coordinate: its name, of one of a plane with {} for x or y, unit (m or rad) and nominal size."""


Readout = tuple[Signal, Array]
"""A further output: its signal and its row (2 N,) over coordinates and their rates."""


class Structure(NamedTuple):
    """Matrices of a flexible rotor with N coordinates: those of the x-z plane, of the y-z plane, and others.

    Attributes
    ----------
    mass, damping, gyroscopic, stiffness, circulation : ndarray or sparse array, shape (N, N)
        M, C, G, K, H of the module's equation, SI. A chain of elements is assembled sparse.
    stations : tuple of str, empty for one without a prefix
    journals : ndarray, shape (2 n_stations, N)
        T: displacement of each journal from its housing, x and y in turn.
    weight : ndarray, shape (N,) [N]
    unbalance : ndarray, shape (N, 2)
        Force per pair (w^2 cos p + a sin p, w^2 sin p - a cos p), angle p and its second derivative a.
    coordinates : tuple of Coordinate, length n
        Coordinates of one plane.
    readouts : tuple of Readout
    supports : tuple of int, places of the housings among the coordinates of a plane
    housings : ndarray, shape (2 n_stations, N), or None
        Displacement of each housing, x and y in turn; None if all are rigid.
    hysteresis : ndarray, shape (n, n), or None
        Loss factor times stiffness of the rotating shaft in one plane [N/m].
    tilts : ndarray, shape (2 n_stations, N), or None
        Tilts of the shaft about +x, +y, at stations that feel it.
    others : tuple of Coordinate, length N - 2 n
        Beyond both planes; their names have no {}.
    axial, twist : ndarray, shape (n_stations, N), or None
        Motion of the shaft along +z, and about it besides the rotation, at each station; None if it has none.
    """

    mass: Array
    damping: Array
    gyroscopic: Array
    stiffness: Array
    circulation: Array
    stations: tuple[str, ...]
    journals: Array
    weight: Array
    unbalance: Array
    coordinates: tuple[Coordinate, ...]
    readouts: tuple[Readout, ...]
    supports: tuple[int, ...] = ()
    housings: Array | None = None
    hysteresis: Array | None = None
    tilts: Array | None = None
    others: tuple[Coordinate, ...] = ()
    axial: Array | None = None
    twist: Array | None = None


def dense(structure: Structure) -> Structure:
    """Return a structure whose matrices are no longer sparse; it shares no array with the other."""
    return Structure(*(copy(dense_matrix(part)) for part in structure))


class Operators(NamedTuple):
    """x' = (steady + w spin) x + push u + weight + unbalance r(t);  y = (sense x, w), r as in `Structure`."""

    steady: Array
    by_speed: Array
    push: Array
    weight: Array
    unbalance: Array
    sense: Array


class FlexibleRotor(Turning):
    """Base of the rotors that are a `Structure`: a Dynamic model with signals for each bearing station.

    A subclass is a frozen dataclass with the fields `speed`, `gravity` and `initial` and gives `assembled`.

    Attributes
    ----------
    gravity : tuple of two floats [m/s2]
    initial : tuple of float
        State at t = 0; empty for a straight shaft at rest.
    """

    gravity: tuple[float, float]
    initial: tuple[float, ...]

    def assembled(self) -> Structure:
        """Return the matrices of the rotor."""
        raise NotImplementedError

    @cached_property
    def assembly(self) -> Structure:
        """The matrices of the rotor, sparse where it is a chain of elements."""
        return self.assembled()

    @cached_property
    def structure(self) -> Structure:
        """The matrices of the rotor, dense."""
        return dense(self.assembly)

    @cached_property
    def cache(self) -> dict[Any, Any]:
        """What analyses have worked out of the rotor, by their own keys."""
        return {}

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y of each station: on the journal, and the opposite on its housing.

        Forces and moments of further freedoms follow, station by station.
        """
        s = self.assembly
        weight = float(np.abs(s.weight).sum()) or STANDARD_GRAVITY
        return tuple(
            prefixed(name, signal)
            for name, freedoms in in_order(s)
            for signal in force_outputs(weight, freedoms, _arm(s))
        )

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy of each station, journal less housing; further readouts; speed.

        Places and rates of further freedoms come before the readouts, station by station.
        """
        s = self.assembly
        places = [
            prefixed(name, signal)
            for name, freedoms in in_order(s)
            for signal in journal_inputs(NOMINAL_LENGTH, self.nominal_speed, freedoms, _arm(s))[:-1]
        ]
        speed = journal_inputs(NOMINAL_LENGTH, self.nominal_speed)[-1]
        return (*places, *(signal for signal, _ in s.readouts), speed)

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """The coordinates of the x-z plane, those of the y-z plane, others, and their rates in this order."""
        s = self.assembly
        kinds: tuple[tuple[str, str, float, str], ...] = (
            ("", "", 1.0, "displacement"),
            ("v", "/s", self.nominal_speed, "rate of the displacement"),
        )
        return signals_of(
            *(
                (head + name.format(axis), unit + per, nominal * scale, text)
                for head, per, scale, text in kinds
                for axis, coordinates in (("x", s.coordinates), ("y", s.coordinates), ("", s.others))
                for name, unit, nominal in coordinates
            )
        )

    @property
    def initial_state(self) -> Array:
        """The state at t = 0, shape (2 N,)."""
        return np.array(self.initial) if self.initial else np.zeros(2 * len(self.assembly.weight))

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt at the time t [s] for the forces u [N] at the stations."""
        state, force, model = np.asarray(x, dtype=float), np.asarray(u, dtype=float), self.operators
        rate = model.steady @ state + self.profile.speed(t) * (model.by_speed @ state) + model.push @ force
        return rate + model.weight + model.unbalance @ self.rotating(t)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs; the input u is not used."""
        return np.append(self.operators.sense @ np.asarray(x, dtype=float), self.profile.speed(t))

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives, which depend on the speed only."""
        model = self.operators
        sense = np.vstack([model.sense, np.zeros(model.sense.shape[1])])
        A = model.steady + self.profile.speed(t) * model.by_speed
        return Linearization(A, model.push.copy(), sense, np.zeros((len(sense), model.push.shape[1])))

    @cached_property
    def operators(self) -> Operators:
        """The equations solved for the rates; InputError if the rotor has a loss factor."""
        s = self.structure
        if s.hysteresis is not None:
            raise InputError(
                "loss_factor must be 0 over time, where hysteresis is not a force: use internal_damping, "
                "the loss factor / the frequency of the bending in the rotating shaft"
            )
        return solved_equations(s)


class MatrixRotor(FlexibleRotor):
    """A rotor of given matrices, with speed and gravity of another.

    Parameters
    ----------
    rotor : FlexibleRotor
    structure : Structure
    """

    def __init__(self, rotor: FlexibleRotor, structure: Structure) -> None:
        self.speed, self.gravity, self.initial = rotor.speed, rotor.gravity, ()
        self._structure = structure

    def assembled(self) -> Structure:
        """Return the matrices."""
        return self._structure


def require_flexible(rotor: object) -> None:
    """Raise InputError unless `rotor` has the matrices of a flexible rotor."""
    require_kind("rotor", rotor, FlexibleRotor, "a flexible rotor such as a ShaftRotor or a RigidShaft")


def solved_equations(s: Structure) -> Operators:
    """Return the equations of a structure without hysteresis, solved for the rates."""
    from scipy.linalg import cho_factor, cho_solve  # heavy, and a rotor that only stands needs none

    n = len(s.weight)
    factor = cho_factor(s.mass)

    def accelerations(forces: Array) -> Array:
        return np.concatenate([np.zeros_like(forces), cho_solve(factor, forces)])

    steady = -accelerations(np.hstack([s.stiffness, s.damping]))
    steady[:n, n:] = np.eye(n)
    return Operators(
        steady=steady,
        by_speed=-accelerations(np.hstack([s.circulation, s.gyroscopic])),
        push=accelerations(force_rows(s).T),
        weight=accelerations(s.weight),
        unbalance=accelerations(s.unbalance),
        sense=output_rows(s),
    )


def output_rows(structure: Structure) -> Array:
    """Return the rows that make the outputs but the speed out of (q, q'), shape (n_outputs - 1, 2 N)."""
    places = [both_planes(freedom_rows(structure, *one)) for one in in_order(structure)]
    readouts = [row[None] for _, row in structure.readouts]
    return np.concatenate([np.zeros((0, 2 * len(structure.weight))), *places, *readouts])


def force_rows(structure: Structure) -> Array:
    """Return the displacements that the inputs of a rotor act on, in their order, shape (n_inputs, N)."""
    rows = [freedom_rows(structure, *one) for one in in_order(structure)]
    return np.concatenate([np.zeros((0, len(structure.weight))), *rows])


def check_motion(rotor: FlexibleRotor) -> None:
    """Check speed, gravity and initial state of a rotor; raise InputError where they break a rule."""
    keep_pair(rotor, "gravity")
    if not isinstance(rotor.speed, SpeedProfile):
        require_number("speed", rotor.speed)
    size = 2 * len(rotor.assembly.weight)
    state = require_finite("initial", rotor.initial)
    if len(rotor.initial) and state.shape != (size,):
        raise InputError(f"initial must be empty or {size} numbers, got shape {state.shape}")
    object.__setattr__(rotor, "initial", tuple(state.tolist()))


def both_planes(matrix: Array) -> Array:
    """Return the matrix of one plane for both of them, shape (2 n, 2 n)."""
    return planes(np.eye(2), matrix)


def across_planes(matrix: Array) -> Array:
    """Return -i times the matrix of one plane acting on x + i y, shape (2 n, 2 n)."""
    return planes(QUARTER_TURN, matrix)


def unbalance_columns(unbalance: float, angle: float) -> Array:
    """Return the force (x, y) of an unbalance per pair of `Structure.unbalance`, shape (2, 2)."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([[unbalance * cos, -unbalance * sin], [unbalance * sin, unbalance * cos]])


def displacements(name: str, places: tuple[int, int], size: int, angle: float = 0.0) -> tuple[Readout, ...]:
    """Return the readouts name_x, name_y of the coordinates at two places among `size`, on turned axes."""
    rows = np.zeros((len(places), 2 * size))
    cos, sin = math.cos(angle), math.sin(angle)
    rows[:, places] = [[cos, sin], [-sin, cos]]
    text = f"displacement of {name} along "
    signals = signals_of(*((f"{name}_{axis}", "m", NOMINAL_LENGTH, text + axis) for axis in "xy"))
    return tuple(zip(signals, rows, strict=True))


# The freedoms of the stations of a rotor.


class _Rows(NamedTuple):
    """Where the rows of a freedom are: field of a `Structure`, first row and how many there are a station.

    `given_by` is what gives a rotor this freedom.
    """

    field: str
    first: int
    each: int
    given_by: str


_TILTING = "Station(feels_tilt=True) or RigidShaft(feels_tilt=True)"

_ROWS = {
    "x": _Rows("journals", 0, 2, ""),
    "y": _Rows("journals", 1, 2, ""),
    "z": _Rows("axial", 0, 1, "ShaftRotor(axial=True) or RigidShaft(axial=True)"),
    "tilt_x": _Rows("tilts", 0, 2, _TILTING),
    "tilt_y": _Rows("tilts", 1, 2, _TILTING),
    "twist": _Rows("twist", 0, 1, "ShaftRotor(torsional=True)"),
}


def _row(structure: Structure, station: str, freedom: str) -> Array | None:
    """Return the row of a freedom of a station, shape (N,); None if it has none."""
    at = _ROWS[freedom]
    rows = getattr(structure, at.field)
    found = None if rows is None else rows[at.each * structure.stations.index(station) + at.first]
    return found if found is not None and (freedom in PLANAR or found.any()) else None


def station_freedoms(structure: Structure, station: str) -> tuple[str, ...]:
    """Return the freedoms of a station of a rotor, x and y first."""
    return tuple(freedom for freedom in _ROWS if _row(structure, station, freedom) is not None)


def freedom_rows(structure: Structure, station: str, freedoms: Sequence[str] = PLANAR) -> Array:
    """Return the displacements of freedoms of a station in the order given, shape (n, N).

    Those along x and y are of the journal from its housing; all others are of the shaft.

    Raises
    ------
    InputError
        If there is no such station, or it has not all of these freedoms.
    """
    if station not in structure.stations:
        raise InputError(f"station must be one of the rotor's {list(structure.stations)}, got {station!r}")
    rows = [_row(structure, station, freedom) for freedom in freedoms]
    for freedom, row in zip(freedoms, rows, strict=True):
        if row is None:
            raise InputError(
                f"station {station!r} must have the freedom {freedom}, got a rotor without it: "
                f"{_ROWS[freedom].given_by} adds it"
            )
    return np.array(rows, dtype=float).reshape(len(rows), len(structure.weight))


def in_order(structure: Structure) -> list[tuple[str, tuple[str, ...]]]:
    """Return stations and freedoms as signals have them: x, y of all stations, then the others of each."""
    every = [(name, station_freedoms(structure, name)) for name in structure.stations]
    return [(name, own[part]) for part in (slice(2), slice(2, None)) for name, own in every if own[part]]


def _arm(structure: Structure) -> float:
    """Return the length [m] that makes nominal tilts of nominal displacements."""
    return next((NOMINAL_LENGTH / size for _, unit, size in structure.coordinates if unit == "rad"), 1.0)


# Coordinates beyond both planes: beside those of the planes, and held.


def beside(first: Any, *further: Any) -> Any:
    """Return matrices as the blocks of a diagonal, sparse if the first is; those without rows add nothing."""
    blocks = [block for block in further if block.shape[0]]
    if not blocks:
        return first
    # Imported when asked for: rotors are light.
    from scipy import linalg, sparse

    if is_sparse(first):
        return sparse.csr_array(sparse.block_diag([first, *blocks]))
    return np.asarray(linalg.block_diag(first, *blocks))


def extended(
    full: Structure,
    others: Iterable[Coordinate],
    *,
    mass: Any,
    damping: Any,
    stiffness: Any,
    rows: Mapping[str, Array],
) -> Structure:
    """Return a structure with further coordinates beside those that it has.

    Parameters
    ----------
    full : Structure
    others : iterable of Coordinate, m of them
    mass, damping, stiffness : ndarray or sparse array, shape (m, m)
    rows : mapping of str to ndarray, shape (n_stations, m)
        By the freedom, "z" or "twist", its place at each station.
    """
    m, before = mass.shape[0], len(full.weight)
    none = np.zeros((m, m))

    def wide(part: Array) -> Array:
        return np.concatenate([part, np.zeros((*part.shape[:-1], m))], axis=-1)

    added = {_ROWS[name].field: np.pad(part, ((0, 0), (before, 0))) for name, part in rows.items()}
    return _mapped(
        full,
        lambda matrix: beside(matrix, none),
        wide,
        mass=beside(full.mass, mass),
        damping=beside(full.damping, damping),
        stiffness=beside(full.stiffness, stiffness),
        others=(*full.others, *others),
        **added,
    )


def _mapped(
    full: Structure, square: Callable[[Any], Any], row: Callable[[Any], Array], **fields: Any
) -> Structure:
    """Return a structure in other coordinates.

    Parameters
    ----------
    full : Structure
    square : callable
        Function that returns a matrix (N, N) in the other coordinates.
    row : callable
        Function that returns rows (..., N) over the other coordinates.
    fields : object
        Fields of the result, in place of what these make.
    """
    squares = ("mass", "damping", "gyroscopic", "stiffness", "circulation")
    stations = ("journals", "housings", "tilts", "axial", "twist")
    made: dict[str, Any] = {name: square(getattr(full, name)) for name in squares}
    made |= {name: row(rows) for name in stations if (rows := getattr(full, name)) is not None}
    made["weight"], made["unbalance"] = row(full.weight), row(full.unbalance.T).T
    made["readouts"] = tuple((s, row(np.reshape(both, (2, -1))).ravel()) for s, both in full.readouts)
    return full._replace(**made | fields)


def without(full: Structure, aside: ArrayLike) -> Structure:
    """Return a structure some of whose further coordinates do not move; `aside` tells which, shape (m,)."""
    stays = ~np.asarray(aside, dtype=bool)
    if stays.all():
        return full
    kept = np.append(np.ones(2 * len(full.coordinates), dtype=bool), stays)
    others = tuple(full.others[k] for k in np.flatnonzero(stays))
    return _mapped(full, lambda part: part[kept][:, kept], lambda rows: rows[..., kept], others=others)


def hysteresis_matrices(full: Structure) -> tuple[Any, Any]:
    """Return what is -i times the hysteresis on x + i y, and the hysteresis itself, of all coordinates."""
    assert full.hysteresis is not None
    none = np.zeros((len(full.others), len(full.others)))
    return beside(across_planes(full.hysteresis), none), beside(both_planes(full.hysteresis), none)


def in_planes(full: Structure) -> Structure:
    """Return a structure that moves in its planes only."""
    return without(full, np.ones(len(full.others)))


def untouched(full: Structure, rows: Array) -> NDArray[np.bool_]:
    """Return which further coordinates neither planes, weight nor bearings move, shape (m,).

    Parameters
    ----------
    full : Structure
    rows : ndarray, shape (n, N)
        What the bearings feel, as `freedom_rows` returns it.
    """
    m = len(full.others)
    if not m:
        return np.zeros(0, dtype=bool)
    # Imported when asked for: rotors are light.
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components

    matrices = full.mass, full.damping, full.gyroscopic, full.stiffness, full.circulation
    joined: Any = sum(abs(csr_array(part[-m:])) for part in matrices)
    _, labels = connected_components(joined[:, -m:], directed=False)
    moved = joined[:, :-m].sum(axis=1) + np.abs(rows[:, -m:]).sum(axis=0) + np.abs(full.weight[-m:])
    return ~np.isin(labels, labels[moved > 0.0])


# The equations of a rotor that moves in some of its shapes only.


DEPENDENT = 1e-6
"""Part of a shape, as the root of its kinetic energy, below which it adds nothing to those before it."""


def projected(full: Structure, shapes: Array) -> Structure:
    """Return the matrices of a structure that moves in shapes of one plane, the same in both (Galerkin).

    Further coordinates are kept as they are.

    Parameters
    ----------
    full : Structure
    shapes : ndarray, shape (n, n_shapes)
        Shapes over the n coordinates of a plane.
    """
    basis = whole_basis(shapes, len(full.others))
    return _mapped(
        full,
        lambda matrix: np.asarray(basis.T @ dense_matrix(matrix @ basis)),
        lambda rows: np.asarray(rows @ basis),
        coordinates=tuple((f"shape_{{}}_{k}", "m", NOMINAL_LENGTH) for k in range(shapes.shape[1])),
        hysteresis=None if full.hysteresis is None else shapes.T @ (full.hysteresis @ shapes),
        supports=(),
    )


def whole_basis(shapes: Array, others: int) -> Array:
    """Return shapes of one plane for both, and further coordinates as they are, shape (N, 2 n + others)."""
    return np.asarray(beside(both_planes(shapes), np.eye(others)))


def mean_plane(matrix: Any) -> Any:
    """Return the mean of what a matrix of both planes (N, N) is in each, shape (N / 2, N / 2)."""
    n = matrix.shape[0] // 2
    return 0.5 * (matrix[:n, :n] + matrix[n:, n:])


def new_shapes(shapes: Array, known: Array, mass: Any, least: float = DEPENDENT) -> Array:
    """Return what each shape adds, if anything, to known ones of unit mass and to the shapes before it.

    Parameters
    ----------
    shapes : ndarray, shape (N / 2, m)
    known : ndarray, shape (N / 2, n)
        Of unit mass, and without mass in common.
    mass : ndarray or sparse array, shape (N / 2, N / 2)
    least : float [1]
        Part of a shape that must be new.
    """
    count = known.shape[1]
    for shape in shapes.T:
        size = np.sqrt(shape @ (mass @ shape))
        if size == 0.0:
            continue
        rest = shape / size
        for _ in range(2):  # twice is enough (Kahan and Parlett)
            rest = rest - known @ (known.T @ (mass @ rest))
        left = np.sqrt(rest @ (mass @ rest))
        if left > least:
            known = np.column_stack([known, rest / left])
    return known[:, count:]


# Sparse matrices of a chain of elements: how they are summed, and how they become dense.


def summed(size: int, parts: Iterable[tuple[Sequence[int], Array]]) -> Any:
    """Return the sparse matrix that small matrices at the given places add up to, shape (size, size)."""
    from scipy import sparse

    rows, columns, values = [], [], []
    for places, part in parts:
        rows.append(np.repeat(places, len(places)))
        columns.append(np.tile(places, len(places)))
        values.append(np.ravel(part))
    if not values:
        return sparse.csr_array((size, size))
    where = (np.concatenate(rows), np.concatenate(columns))
    found = sparse.coo_array((np.concatenate(values), where), shape=(size, size)).tocsr()
    found.eliminate_zeros()
    return found


def planes(pattern: Array, matrix: Any) -> Any:
    """Return the Kronecker product of a pattern of two planes and the matrix of one, sparse if that is."""
    if is_sparse(matrix):
        from scipy import sparse

        return sparse.csr_array(sparse.kron(sparse.csr_array(pattern), matrix))
    return np.asarray(np.kron(pattern, matrix), dtype=float)


def dense_matrix(part: Any) -> Any:
    """Return a part of a structure, as an ndarray where it is a sparse array."""
    return part.toarray() if is_sparse(part) else part


def is_sparse(part: Any) -> bool:
    """Return whether a part of a structure is a sparse array."""
    return hasattr(part, "tocsr")  # asks no sparse package, which a rigid rotor does not need


# The signals of a bearing station: their names begin with that of the station, if it has one.


AnySignal = TypeVar("AnySignal", bound=Signal)


def prefixed(station: str, signal: AnySignal) -> AnySignal:
    """Return a signal of a station: its name begins with that of the station, if it has one."""
    place = f" of {station}" if station else ""
    return replace(signal, name=station_name(station, signal.name), description=signal.description + place)


def station_name(station: str, name: str) -> str:
    """Return the name of a signal of a station: `left_x`, or `x` where the station has no name."""
    return f"{station}_{name}" if station else name


def station_names(station: str, freedoms: Sequence[str] = PLANAR) -> tuple[list[str], list[str]]:
    """Return the names of places and rates, and of the forces, of some freedoms of a station."""
    motion = [station_name(station, name) for name in place_names(freedoms)]
    return motion, [station_name(station, name) for name in force_names(freedoms)]


def checked_stations(names: Sequence[str]) -> tuple[str, ...]:
    """Return the names of stations; raise InputError where two are equal."""
    if len(set(names)) < len(names):
        raise InputError(f"stations must have different names, got {list(names)}")
    return tuple(names)


class AroundRotor:
    """What models share that are a rotor and something at its stations: the signals, unless they say others.

    Attributes
    ----------
    rotor : Dynamic
        Rotor with inputs force_x, force_y and outputs x, y, vx, vy of each station.
    stations : tuple of str
        The empty name is that of a rotor with one journal.
    """

    rotor: Dynamic
    stations: tuple[str, ...]

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
        """The states of the rotor."""
        return self.rotor.states

    @property
    def initial_state(self) -> Array:
        """The state of the rotor at t = 0."""
        return self.rotor.initial_state

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times [s] at which the rotor has kinks."""
        return breakpoints(self.rotor)

    @cached_property
    def force_places(self) -> list[list[int]]:
        """Where the forces of each station are among the inputs of the rotor; InputError if it lacks one."""
        available = names(self.rotor.inputs)
        return [indices("rotor must have the inputs", available, station_names(s)[1]) for s in self.stations]

    @cached_property
    def motion_places(self) -> list[list[int]]:
        """Where the motion of each station is among the outputs of the rotor; InputError if it lacks one."""
        available = names(self.rotor.outputs)
        return [indices("rotor must have the outputs", available, station_names(s)[0]) for s in self.stations]


class AroundStructure(AroundRotor):
    """What models share that change a rigid or flexible rotor: its stations and its equations."""

    rotor: Any

    @property
    def stations(self) -> tuple[str, ...]:  # type: ignore[override]
        """The stations of the rotor."""
        return self.rotor.structure.stations

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt of the rotor at the time t [s] for the forces u [N] at the stations."""
        return self.rotor.derivative(t, x, u)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs of the rotor."""
        return self.rotor.output(t, x, u)

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the derivatives of the rotor."""
        return self.rotor.linearization(t, x, u)


# A rigid rotor on an isotropic film as seen in axes that turn with its orbit.


def rotating_linearization(
    mass: float, speed: float, film: Array, added: tuple[Array, Array] | None = None
) -> Linearization:
    """Return the motion near a synchronous circular orbit, in radial and tangential axes.

    With q = R(speed t) r the film and the unbalance see a state at rest, and

        m (r'' + 2 w J r' - w^2 r) = F(r, r' + w J r) + unbalance force,    J = z^ x .,

    so the linearization does not depend on time and its eigenvalues are the Floquet exponents of the orbit.

    Parameters
    ----------
    mass : float [kg]
    speed : float [rad/s]
    film : ndarray, shape (2, 5, ...)
        Jacobian of the force at (e, 0), (0, speed e): radial and tangential axes.
    added : tuple of two ndarrays, optional
        Mass that the film adds, shape (2, 2, ...) [kg], and its slopes by position and velocity times the
        acceleration -speed^2 (e, 0), shape (2, 4, ...).

    Returns
    -------
    Linearization
        States: small r (radial, tangential) and r'. Inputs: force on the rotor along both. Outputs: the
        states, and the change of the force on the housing along both, -dF. Trailing batch axes of `film`
        become leading ones of A and C.
    """
    slopes = np.moveaxis(film, (0, 1), (-2, -1))
    J = np.array([[0.0, -1.0], [1.0, 0.0]])
    heavy = np.zeros((*slopes.shape[:-2], 2, 2))
    if added is not None:
        heavy = np.moveaxis(added[0], (0, 1), (-2, -1))
        slopes = slopes[..., :4] - np.moveaxis(added[1], (0, 1), (-2, -1))
    by_velocity = slopes[..., 2:4]
    by_position = slopes[..., :2] + speed * by_velocity @ J
    share = np.linalg.inv(mass * np.eye(2) + heavy)
    A = np.zeros((*slopes.shape[:-2], 4, 4))
    A[..., :2, 2:] = np.eye(2)
    A[..., 2:, :2] = share @ by_position + speed**2 * np.eye(2)
    A[..., 2:, 2:] = share @ by_velocity - 2.0 * speed * J
    B = np.zeros((*(A.shape[:-2] if added is not None else ()), 4, 2))
    B[..., 2:, :] = share if added is not None else np.eye(2) / mass
    C = np.zeros((*slopes.shape[:-2], 6, 4))
    C[..., :4, :] = np.eye(4)
    # The film gives the housing -dF + M da, and m da = dF - M da + the force on the rotor.
    C[..., 4:, :2] = -mass * share @ by_position
    C[..., 4:, 2:] = -mass * share @ by_velocity
    D = np.zeros((*B.shape[:-2], 6, 2))
    D[..., 4:, :] = heavy @ share if added is not None else 0.0
    return Linearization(A, B, C, D)
