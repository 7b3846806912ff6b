"""The kernels of the C library on NumPy arrays; what the statuses mean is for the caller to say."""

from __future__ import annotations

from ctypes import byref, c_size_t, c_void_p, cast
from enum import IntEnum
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ..model import Array
from .library import functions
from .structs import GrooveMapStruct, MapStruct, ShortStruct


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
        self.struct = ShortStruct(4.0 * slenderness**2)

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
        self.struct = MapStruct(cells_x, cells_t, reach, log_center, place)
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
        self.struct = GrooveMapStruct(*counts, reach, crowding, axis, *places, slenderness)
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
