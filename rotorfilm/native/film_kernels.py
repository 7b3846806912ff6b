"""The kernels of the C library on NumPy arrays; what the statuses mean is for the caller to say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import addressof, byref, c_double, c_size_t, c_void_p, cast
from enum import IntEnum
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ..core.model import Array
from .film_call import MASSLESS, address_of
from .library import functions, loops
from .structs import structure


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
    """

    _function: ClassVar[str]
    _library: ClassVar[staticmethod[[], dict[str, Any]]] = staticmethod(functions)
    _arguments: tuple[Any, ...]
    struct: Any
    error: float = 0.0
    openings: ClassVar[bool] = False
    is_table: ClassVar[bool] = False

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    @property
    def tables(self) -> dict[str, Array] | None:
        """What the kernels of bearings whose oil warms read of this film; None if they take no such film."""
        return None

    @property
    def film(self) -> int | None:
        """The address of its rf_film."""
        return cast(self._library()[self._function], c_void_p).value

    def force(self, eccentricity: Array, source: Array) -> Batch:
        """Return the forces (2, n) at the eccentricities and sources (2, n)."""
        return self._batch(eccentricity, source, ())

    def jacobian(self, eccentricity: Array, source: Array) -> Batch:
        """Return d force / d (eccentricity, source), shape (2, 4, n)."""
        return self._batch(eccentricity, source, (2, 4))

    def _batch(self, e: Array, w: Array, shape: tuple[int, ...]) -> Batch:
        e, w = as_rows(e), as_rows(w)
        film = [self.film, byref(self.struct)]
        return run_batch("rf_film_batch", film, e.shape[1], [*row_places(e), *row_places(w)], shape)


class ShortKernel(FilmKernel):
    """The short-bearing film of one length / diameter.

    Parameters
    ----------
    slenderness : float
        Length / diameter.
    """

    _function: ClassVar[str] = "rf_short_film"

    def __init__(self, slenderness: float) -> None:
        self._arguments = (slenderness,)
        self.struct = structure("rf_short")(4.0 * slenderness**2)

    @property
    def tables(self) -> dict[str, Array]:
        """None are needed."""
        return {}


class MapKernel(FilmKernel):
    """The dimensionless film force of one bearing from its impedance map.

    Parameters
    ----------
    coefficients : ndarray, shape (cells_x + 5, cells_t + 5)
        Quintic B-spline coefficients of M(X, T).
    reach : float
        X of the last node.
    log_center : float
        L0, the logarithm of -J/|w|^2 at the center.
    slenderness : float
        Length / diameter for the film at the wall, as which J goes on beyond the last node; 0, or a map that
        is no such film at its last node, goes on as a power of X.
    share : float
        Of the film at the wall in units of a journal.
    """

    _function: ClassVar[str] = "rf_map_film"
    is_table: ClassVar[bool] = True

    def __init__(
        self,
        coefficients: Array,
        reach: float,
        log_center: float,
        slenderness: float = 0.0,
        share: float = 1.0,
    ) -> None:
        self._arguments = (coefficients, reach, log_center, slenderness, share)
        self.coefficients = np.ascontiguousarray(coefficients, dtype=float)
        cells_x, cells_t = (count - 5 for count in self.coefficients.shape)
        if min(cells_x, cells_t) < 1 or not np.isfinite(self.coefficients).all():
            raise ValueError(f"coefficients must be finite, 6 x 6 at least, got shape {coefficients.shape}")
        place = self.coefficients.ctypes.data
        self.struct = structure("rf_map")(cells_x, cells_t, reach, log_center, place)
        functions()["rf_map_to_wall"](byref(self.struct), slenderness, share)
        self.error = functions()["rf_map_error"](byref(self.struct))

    @property
    def tables(self) -> dict[str, Array] | None:
        """The map; see `FilmKernel.tables`."""
        center, reach = np.array([self.struct.center]), np.array([self.struct.x_end])
        return {"coefficients": self.coefficients[None], "center": center, "reach": reach}


class GrooveMapKernel(MapKernel):
    """The dimensionless film force of one bearing with axial openings from its impedance map.

    Parameters
    ----------
    coefficients : ndarray, shape (cells_x + 5, cells_e, cells_s)
        Quintic B-spline coefficients of M(X, theta, s), in the angles those centered on the nodes.
    reach : float
        X of the last node.
    log_center : ndarray, shape (cells_w,)
        Those of L0 over the direction of the source.
    crowding : float
        Ratio of tan s and the tangent of the angle from the eccentricity to the source.
    axis : float [rad]
        Angle of the axis of the openings in the bearing frame.
    slenderness : float
        Length / diameter.
    """

    _function: ClassVar[str] = "rf_groove_film"
    openings: ClassVar[bool] = True

    def __init__(
        self,
        coefficients: Array,
        reach: float,
        log_center: Array,
        crowding: float,
        axis: float,
        slenderness: float,
    ) -> None:
        self._arguments = (coefficients, reach, log_center, crowding, axis, slenderness)
        wide = periodic(periodic(coefficients, 1), 2)
        self.coefficients = np.ascontiguousarray(wide, dtype=float)
        self.log_center = np.ascontiguousarray(periodic(log_center, 0), dtype=float)
        cells_x, cells_e, cells_s = (count - 5 for count in self.coefficients.shape)
        places = self.log_center.ctypes.data, self.coefficients.ctypes.data
        counts = cells_x, cells_e, cells_s, len(log_center)
        self.struct = structure("rf_groove_map")(*counts, reach, crowding, axis, *places, slenderness)
        self.error = functions()["rf_groove_error"](byref(self.struct))

    @property
    def tables(self) -> dict[str, Array]:
        """The map as all kernels with openings read it."""
        numbers = (self.struct.slenderness, self.struct.x_end, self.struct.squeeze, self.struct.axis)
        return {
            "coefficients": self.coefficients,
            "center": self.log_center,
            "map": np.array(numbers),
        }


def periodic(coefficients: Array, axis: int) -> Array:
    """Return periodic coefficients as the kernel reads them: from the one two nodes back, five repeated."""
    count = coefficients.shape[axis]
    return np.take(coefficients, np.arange(-2, count + 3) % count, axis)


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
        Of each pad, in its own frame.
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
        Over the zone.
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

    def mass(self, x: float, y: float, vx: float, vy: float) -> tuple[Array, Array]:
        """Return the added mass xx, xy, yy, shape (3,) [kg], and its slopes by x, y, vx, vy, (3, 4)."""
        mass, slopes = np.empty(3), np.empty((3, 4))
        state = (c_double * 5)(x, y, vx, vy, 0.0)
        loops()["rf_oil_damper_mass"](self._reference, state, mass.ctypes.data, slopes.ctypes.data)
        return mass, slopes
