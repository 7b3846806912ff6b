"""The kernels of the C library on NumPy arrays; what the statuses mean is for the caller to say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import addressof, byref, c_double, c_size_t
from enum import Enum, IntEnum
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core.model import Array
from .film_call import MASSLESS, address_of
from .library import functions, loops
from .structs import constant, structure


class Status(IntEnum):
    """What of rf_status (status.h) the films answer, by severity."""

    OK = 0
    OUTSIDE = 1
    UNDEFINED = 2
    AT_WALL = 3
    NOT_FINITE = 4
    STUCK = 6
    NO_MEMORY = 7


class Batch(NamedTuple):
    """The answer for a batch.

    Attributes
    ----------
    values : ndarray
        Forces (2, n) or Jacobians (2, columns, n).
    status : int
        The most severe status.
    first : int
        The index of the first state that has it.
    """

    values: Array
    status: int
    first: int


class FilmKernel:
    """A dimensionless film force of the C library.

    Attributes
    ----------
    struct : ctypes.Structure
        What its rf_film reads.
    error : float [%]
        Largest error of a force beyond the film's table that was measured; 0 where none is known.
    openings : bool
        Whether that holds only where no opening is near.
    is_table : bool
        Whether it has a table, beyond which it goes on.
    sped : bool
        Whether the force changes with the speed by more than its source.
    """

    _function: str
    _arguments: tuple[Any, ...]
    struct: Any
    error: float = 0.0
    openings: bool = False
    sped: bool = False
    is_table: ClassVar[bool] = False

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    @property
    def tables(self) -> dict[str, Array] | None:
        """What the kernels of bearings whose oil warms read of this film; None if they take no such film."""
        return None

    @property
    def film(self) -> int:
        """The address of its rf_film."""
        return address_of(self._function)

    def force(self, eccentricity: Array, source: Array, rate: Array | None = None) -> Batch:
        """Return the forces (2, n) at the eccentricities and sources (2, n).

        A film that changes with the speed by more than its source asks for half of it, (n,) [1/s]; by default
        it is that of a journal at rest.
        """
        return self._batch(eccentricity, source, (), rate)

    def jacobian(self, eccentricity: Array, source: Array, rate: Array | None = None) -> Batch:
        """Return d force / d (eccentricity, source), shape (2, 4, n), at one speed; see `force`."""
        found = self._batch(eccentricity, source, (10,) if self.sped else (2, 4), rate)
        return found._replace(values=found.values[:8].reshape(2, 4, -1)) if self.sped else found

    def rate_slopes(self, eccentricity: Array, source: Array, rate: Array) -> Array:
        """Return d force / d rate, shape (2, n), of a film that changes with the speed; see `force`."""
        return self._batch(eccentricity, source, (10,), rate).values[8:]

    def _batch(self, e: Array, w: Array, shape: tuple[int, ...], rate: Array | None = None) -> Batch:
        e, w, film = as_rows(e), as_rows(w), [self.film, byref(self.struct)]
        if self.sped:
            along = np.ascontiguousarray(static_rate(e, w) if rate is None else rate, dtype=float)
        given = [*row_places(e), *row_places(w), along.ctypes.data if self.sped else None]
        return run_batch("rf_film_batch", film, e.shape[1], given, shape)


class ShortKernel(FilmKernel):
    """The short-bearing film of one length / diameter.

    Parameters
    ----------
    slenderness : float
        Length / diameter.
    """

    _function = "rf_short_film"

    def __init__(self, slenderness: float) -> None:
        self._arguments = (slenderness,)
        self.struct = structure("rf_short")(4.0 * slenderness**2)

    @property
    def tables(self) -> dict[str, Array]:
        """None are needed."""
        return {}


class SqueezeKernel(FilmKernel):
    """The short squeeze film of a damper on a porous layer.

    Parameters
    ----------
    tables : mapping of str to ndarray
        Tables `groups`, `arc` and `axial`, as the C library reads them (`native/films/squeeze_film.h`).
    ends : tuple of two floats [1/s]
        Pressures at the ends of a fed film that may rupture.

    Raises
    ------
    ValueError
        If the tables are not finite or do not fit each other.
    """

    _function = "rf_squeeze_film"

    def __init__(self, tables: Mapping[str, ArrayLike], ends: tuple[float, float]) -> None:
        self._arguments = tables, ends
        self._tables = as_floats(tables)
        self.struct = taken(structure("rf_squeeze")(), "rf_take_squeeze", self._tables)
        self.struct.ends[:] = ends

    @property
    def tables(self) -> dict[str, Array]:
        """Groups of modes and nodes; see `FilmKernel.tables`."""
        return self._tables


class MapKind(Enum):
    """The coordinates of an impedance map, by their function in `native/films/map_kernel.h`."""

    PLAIN = "rf_map_film"
    GROOVED = "rf_groove_film"
    PAD = "rf_pad_film"
    SPED = "rf_sped_film"


class MapKernel(FilmKernel):
    """The dimensionless film force of one impedance map.

    Parameters
    ----------
    kind : MapKind
        Its coordinates.
    tables : mapping of str to ndarray
        `coefficients`, `center` and `map`, as the C library reads them (`native/films/map_table.h`).

    Raises
    ------
    ValueError
        If the tables are not finite or do not fit each other.
    """

    is_table: ClassVar[bool] = True

    def __init__(self, kind: MapKind, tables: Mapping[str, ArrayLike]) -> None:
        self._arguments = kind, tables
        self._function, self.openings = kind.value, kind is MapKind.GROOVED
        self.sped = kind is MapKind.SPED or "growth" in tables
        self._tables = as_floats(tables)
        number = constant(f"RF_{kind.name}")
        self.struct = taken(structure("rf_map")(), "rf_take_map", self._tables, number, b"")
        if kind is MapKind.PLAIN:
            functions()["rf_map_to_wall"](byref(self.struct))
        self.error = functions()["rf_map_error"](byref(self.struct))

    @property
    def tables(self) -> dict[str, Array]:
        """The map; see `FilmKernel.tables`."""
        return self._tables


def static_rate(eccentricity: Array, source: Array) -> Array:
    """Return the rate at which the oil of a journal at rest runs, speed/2 [1/s]; 0 at the center."""
    squared = (eccentricity * eccentricity).sum(axis=0)
    turned = eccentricity[1] * source[0] - eccentricity[0] * source[1]
    return np.asarray(np.where(squared > 0.0, turned, 0.0) / np.where(squared > 0.0, squared, 1.0))


def as_floats(tables: Mapping[str, ArrayLike]) -> dict[str, Array]:
    """Return tables as the C library reads them; ValueError if a number is not finite."""
    found = {name: np.ascontiguousarray(table, dtype=float) for name, table in tables.items()}
    for name, table in found.items():
        if not np.isfinite(table).all():
            raise ValueError(f"{name} must be finite, got shape {table.shape}")
    return found


def taken(struct: Any, function: str, tables: Mapping[str, Array], *arguments: Any) -> Any:
    """Return a structure that a function of the C library takes from tables, which must live as long.

    Raises
    ------
    ValueError
        If the tables do not fit each other.
    """
    rows = (structure("rf_table") * len(tables))()
    for row, (name, table) in zip(rows, tables.items(), strict=True):
        row.name, row.axes, row.numbers = name.encode(), table.ndim, table.ctypes.data
        row.extent[: table.ndim] = table.shape
    why = structure("rf_message")()
    given = byref(structure("rf_tables")(addressof(rows), len(rows)))
    if {**functions(), **loops()}[function](byref(struct), *arguments, given, byref(why)):
        raise ValueError(why.text.decode())
    return struct


def periodic(coefficients: Array, axis: int, degree: int = 5) -> Array:
    """Return periodic coefficients as the kernel reads them: some nodes earlier, `degree` more."""
    count, back = coefficients.shape[axis], degree // 2
    return np.take(coefficients, np.arange(-back, count + degree - back) % count, axis)


def run_batch(name: str, of: list[Any], n: int, given: list[Any], shape: tuple[int, ...]) -> Batch:
    """Call a batch function; its answer is the forces, or with a shape the Jacobians."""
    force, first = np.empty((2, n)), c_size_t()
    jacobian = np.empty((*shape, n)) if shape else None
    place = (None, 0) if jacobian is None else (jacobian.ctypes.data, n)
    status = functions()[name](*of, n, *given, force.ctypes.data, n, *place, byref(first))
    return Batch(force if jacobian is None else jacobian, status, first.value)


def as_rows(array: Array) -> Array:
    """Return (2, n) floats whose two rows are contiguous, without a copy where they are already."""
    row, entry = array.strides
    if array.dtype == np.float64 and entry == 8 and row >= 0 and row % 8 == 0:
        return array
    return np.ascontiguousarray(array, dtype=float)


def row_places(rows: Array) -> tuple[int, int]:
    """Return the address of (2, n) rows, and their distance in numbers."""
    return rows.ctypes.data, rows.strides[0] // 8


# Forces in SI units of the C library: a state of five numbers in, a force and its derivatives out.


_Pair, _Five, _Ten = c_double * 2, c_double * 5, c_double * 10


class ResponseKernel:
    """A force [N] on a journal at (x, y, vx, vy, speed) [m, m/s, rad/s].

    Attributes
    ----------
    function : str
        Its rf_response (`native/films/film.h`).
    struct : ctypes.Structure
        What that reads.
    film : FilmKernel
        Its film, or that of its first pad.
    mass_call : tuple of two int
        Where its added mass is; see `FilmCall`.
    """

    function: ClassVar[str]
    film: FilmKernel
    mass_call: tuple[int, int] = MASSLESS
    _arguments: tuple[Any, ...]
    struct: Any

    def __init__(self) -> None:
        self._reference = byref(self.struct)
        self._tangent = {**functions(), **loops()}[self.function]
        self._address = address_of(self.function)
        self._call = functions()["rf_response_call"]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    def call(self, x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float, int]:
        """Return (force_x, force_y, status) for numbers."""
        pair = _Pair()
        status = self._call(self._address, self._reference, x, y, vx, vy, speed, pair)
        return pair[0], pair[1], status

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float], int]:
        """Return force_x, force_y, the ten entries of the Jacobian row by row, and a status."""
        pair, ten = _Pair(), _Ten()
        status = self._tangent(self._reference, _Five(x, y, vx, vy, speed), pair, ten)
        return pair[0], pair[1], ten[:], status

    def force(self, position: Array, velocity: Array, speed: Array) -> Batch:
        """Return the forces (2, n) at positions, velocities (2, n) and speeds (n,) or (1,)."""
        return self._batch(position, velocity, speed, ())

    def jacobian(self, position: Array, velocity: Array, speed: Array) -> Batch:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5, n)."""
        return self._batch(position, velocity, speed, (2, 5))

    def _batch(self, q: Array, v: Array, omega: Array, shape: tuple[int, ...]) -> Batch:
        q, v, omega = as_rows(q), as_rows(v), np.ascontiguousarray(omega, dtype=float)
        n = q.shape[1]
        step = 0 if omega.shape == (1,) else 1
        given = [*row_places(q), *row_places(v), omega.ctypes.data, step]
        if v.shape != (2, n):
            raise ValueError(f"velocity must have the shape of position, (2, {n}), got {v.shape}")
        if step and omega.shape != (n,):
            raise ValueError(f"speed must have shape ({n},) or (1,), got {omega.shape}")
        return run_batch("rf_response_batch", [self._address, self._reference], n, given, shape)


class JournalKernel(ResponseKernel):
    """The film force of a journal bearing in SI units.

    Parameters
    ----------
    kernel : FilmKernel
        Its film.
    clearance : float [m]
        Radial clearance.
    force_scale : float [N s]
        viscosity * length * radius^3 / clearance^2.
    """

    function: ClassVar[str] = "rf_journal_at"

    def __init__(self, kernel: FilmKernel, clearance: float, force_scale: float) -> None:
        self._arguments = (kernel, clearance, force_scale)
        self.film = kernel
        self.struct = structure("rf_journal")(
            kernel.film, addressof(kernel.struct), clearance, force_scale, kernel.error, kernel.openings
        )
        super().__init__()


class LobesKernel(ResponseKernel):
    """The film force of fixed pads in SI units.

    Parameters
    ----------
    films : sequence of JournalKernel
        Films of each pad, in its own frame.
    places : sequence of (float, (float, float))
        As many: angle of the middle of its arc [rad], and center of its curvature [m].
    """

    function: ClassVar[str] = "rf_lobes_at"

    def __init__(
        self, films: Sequence[JournalKernel], places: Sequence[tuple[float, tuple[float, float]]]
    ) -> None:
        self._arguments = (films, places)
        self._kept: list[Any] = [films]
        self.film = films[0].film
        lobes = [
            structure("rf_lobe")(film.struct, np.cos(middle), np.sin(middle), *center)
            for film, (middle, center) in zip(films, places, strict=True)
        ]
        rows = (structure("rf_lobe") * len(lobes))(*lobes)
        self._kept.append(rows)
        self.struct = structure("rf_lobes")(len(lobes), addressof(rows))
        super().__init__()


# Dampers with seals and the inertia of their oil, in the C library.


class OilParts(NamedTuple):
    """What a damper with seals or inertia is made of; see native/films/oil_damper.h.

    Attributes
    ----------
    zone, closed, tabled : float [1]
        Shares of the inertia of a ruptured zone, of a short full film, of the table.
    sealed : float [1]
        Share of the circumference with pressure at leaking seals of a short film; 0 without.
    radial : ndarray, shape (terms, 7), or None
        Table of a full film of finite length.
    least : float [1]
        Of its sqrt(1 - eps^2).
    nodes, weights : ndarray
        Nodes and weights over the zone.
    """

    zone: float
    closed: float
    tabled: float
    sealed: float
    radial: Array | None
    least: float
    nodes: Array
    weights: Array

    def tables(self, mapped: Mapping[str, Array] | None, *, heavy: bool) -> dict[str, Array]:
        """Return the tables of the kernel "oil_damper"; those of the map, if it has one, among them."""
        parts = [mapped is not None, self.zone, self.closed, self.tabled, self.sealed, heavy]
        found = {"parts": np.array(parts, dtype=float), **(mapped or {})}
        if self.radial is not None:
            found |= {"radial": self.radial, "least": np.array([self.least])}
        if self.zone:
            found |= {"nodes": self.nodes, "weights": self.weights}
        return found


class OilScales(NamedTuple):
    """Its dimensions.

    Attributes
    ----------
    clearance : float [m]
    viscous : float [N s]
        viscosity radius length^3/clearance^2.
    inertial : float [kg m]
        density radius length^3.
    seal : float [1]
        Damping of the seals of a short film per `viscous`.
    """

    clearance: float
    viscous: float
    inertial: float
    seal: float


class OilDamperKernel(ResponseKernel):
    """Force and added mass of a damper in SI units.

    Parameters
    ----------
    parts : OilParts
    viscous : FilmKernel or None
        Map of the viscous film; None for the table.
    scales : OilScales
    """

    function: ClassVar[str] = "rf_oil_damper_at"

    def __init__(self, parts: OilParts, viscous: FilmKernel | None, scales: OilScales) -> None:
        self._arguments = (parts, viscous, scales)
        self.film = viscous or FilmKernel()
        places = (None, None) if viscous is None else (viscous.film, addressof(viscous.struct))
        radial = np.zeros((0, 7)) if parts.radial is None else parts.radial
        self._kept = [np.ascontiguousarray(part) for part in (radial, parts.nodes, parts.weights)]
        table, nodes, weights = (part.ctypes.data for part in self._kept)
        self.struct = structure("rf_oil_damper")(
            structure("rf_journal")(*places, scales.clearance, scales.viscous, self.film.error, 0),
            viscous is not None,
            len(radial),
            table,
            parts.least,
            *scales[1:],
            parts.zone,
            parts.closed,
            parts.tabled,
            nodes,
            weights,
            len(parts.nodes),
            0,
        )
        super().__init__()
        if scales.inertial:
            self.mass_call = address_of("rf_oil_damper_mass"), addressof(self.struct)

    def masses(self, position: Array, velocity: Array) -> Batch:
        """Return the added mass xx, xy, yy [kg] and its slopes by x, y, vx, vy behind it, shape (3, 5, n)."""
        states = np.ascontiguousarray(np.concatenate([position, velocity]).T)
        found, mass = np.empty((len(states), 15)), loops()["rf_oil_damper_mass"]
        first, answer, size = states.ctypes.data, found.ctypes.data, found.itemsize
        places = ((first + 4 * size * k, answer + 15 * size * k) for k in range(len(states)))
        statuses = [mass(self._reference, state, row, row + 3 * size) for state, row in places]
        values = np.concatenate([found[:, :3, None], found[:, 3:].reshape(-1, 3, 4)], axis=2)
        worst = max(statuses, default=Status.OK)
        return Batch(np.moveaxis(values, 0, -1), worst, statuses.index(worst) if statuses else 0)
