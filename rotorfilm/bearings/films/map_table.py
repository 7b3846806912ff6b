"""The impedance map of every plain journal bearing as one table: collapsing, saving, loading.

With J(e, w) = min over films of the dissipation potential (`native/films/map_kernel.h`),

    ln(-J/|w|^2) = L0(S) + chi M(X, T, S),   X = chi/(1 - chi^2)^(1/4),   T = (1 + cos)/2,   S = ln(L/D),

on a uniform grid of X in [0, reach], T in [0, 1] and S, by quintic B-splines in all three.
"""

from __future__ import annotations

import hashlib
import json
import logging
import math
import os
import struct
import zlib
from collections.abc import Callable
from dataclasses import dataclass, field, fields
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar, Self, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from ...core.errors import FileWarning, InputError, RotorfilmError, warn_user
from ...core.files import read_sealed, write_atomically, write_sealed
from ...core.inputs import quantities
from ...core.model import Array
from ...core.progress import Report, silent
from ...native import MapKernel, MapKind, slice_table

# How tables lie in files: a mark, a version, a checksum, a line of text which names the class and tells the
# arrays, and their little-endian numbers.


MAGIC = b"RFTABLES"
VERSION = 1

_HEADER = struct.Struct("<8sII")

BASIS = "coefficients"
"""Field of which numbers may be stored as multiples of a quantum."""


class StoredTable:
    """A dataclass of numbers and arrays that is its bytes: saved, loaded, compared and hashed by them."""

    def to_bytes(self, quantum: float = 0.0) -> bytes:
        """Return the table as bytes.

        Parameters
        ----------
        quantum : float
            Where positive, coefficients are rounded to multiples of it, of 4 bytes each instead of 8.

        Raises
        ------
        InputError
            If a coefficient is beyond 2^31 quanta.
        """
        arrays = {name: np.asarray(value, dtype="<f8") for name, value in self._parts().items()}
        if quantum:
            arrays[BASIS] = _multiples(arrays[BASIS], quantum)
        rows = [(name, array.dtype.str, array.shape) for name, array in arrays.items()]
        line = json.dumps([type(self).__name__, quantum, rows]).encode() + b"\n"
        body = b"".join([line, *(array.tobytes() for array in arrays.values())])
        return _HEADER.pack(MAGIC, VERSION, zlib.crc32(body)) + body

    @classmethod
    def from_bytes(cls, content: bytes) -> Self:
        """Return the table that `to_bytes` wrote.

        Raises
        ------
        RotorfilmError
            If the content is not such a table, of another version, truncated or damaged.
        """
        name = cls.__name__
        if len(content) < _HEADER.size or not content.startswith(MAGIC):
            raise RotorfilmError(f"{name}: the content does not begin with the mark of a table")
        _, version, checksum = _HEADER.unpack_from(content)
        if version != VERSION:
            raise RotorfilmError(
                f"{name}: version must be {VERSION}, got {version}; make it again with this rotorfilm"
            )
        body = content[_HEADER.size :]
        if zlib.crc32(body) != checksum:
            raise RotorfilmError(f"{name}: the checksum does not fit, the content is damaged")
        line = body.partition(b"\n")[0]
        kind, quantum, rows = json.loads(line)
        if kind != name:
            raise RotorfilmError(f"{name}: the content must be that of such a table, got a {kind}")
        found, start = {}, len(line) + 1
        for part, dtype, shape in rows:
            count = math.prod(shape)
            array = np.frombuffer(body, dtype=dtype, offset=start, count=count).astype(float)
            found[part] = array.reshape(shape) * (quantum if "i" in dtype else 1.0)
            start += count * np.dtype(dtype).itemsize
        return cls(**{part: cls._restored(part, array) for part, array in found.items()})

    def _parts(self) -> dict[str, Any]:
        """Return the fields by name: numbers or arrays."""
        return {part.name: getattr(self, part.name) for part in fields(cast(Any, self))}

    @classmethod
    def _restored(cls, name: str, array: Array) -> Any:
        """Return a field from its array."""
        tuples = {part.name for part in fields(cast(Any, cls)) if str(part.type).startswith("tuple")}
        return float(array) if array.ndim == 0 else tuple(array.tolist()) if name in tuples else array

    def save(self, path: str | Path, quantum: float = 0.0) -> None:
        """Write the table to a file; see `to_bytes`."""
        write_atomically(path, self.to_bytes(quantum))

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """Return the table in a file; see `from_bytes` for the errors."""
        return cls.from_bytes(Path(path).read_bytes())

    @cached_property
    def _content(self) -> bytes:
        return self.to_bytes()

    def __eq__(self, other: object) -> bool:
        return self is other or (type(other) is type(self) and self._content == other._content)

    def __hash__(self) -> int:
        return hash(self._content)


def _multiples(numbers: Array, quantum: float) -> NDArray[np.int32]:
    multiples = np.rint(numbers / quantum)
    if not np.abs(multiples).max() < 2.0**31:
        least = np.abs(numbers).max() / 2.0**31
        raise InputError(f"quantum must be above {least:.3g} for these coefficients, got {quantum!r}")
    return multiples.astype("<i4")


def require_shapes(table: object, **shapes: tuple[int | None, ...]) -> None:
    """Raise InputError unless fields are finite arrays of these shapes; None is any number from 6 on."""
    for name, shape in shapes.items():
        array = np.asarray(getattr(table, name))
        fits = array.ndim == len(shape) and all(
            n >= LEAST if want is None else n == want for n, want in zip(array.shape, shape, strict=True)
        )
        if not (fits and np.isfinite(array).all()):
            wanted = ", ".join(f"{LEAST} or more" if n is None else str(n) for n in shape)
            raise InputError(f"{name} must be finite, of shape ({wanted}), got shape {array.shape}")


LEAST = 6
"""Coefficients of a quintic spline."""


BANDS, ERRORS = 8, 5
"""Most rows of the bounds of a map, and their columns."""


class BoundedTable(StoredTable):
    """A map with the largest errors that were found when it was made, in bands of the room of the journal.

    Attributes
    ----------
    bounds : ndarray, shape (bands, 5)
        Each band has the last place of it, and errors of the force, of K and C, of shear and of flows.
    """

    bounds: Array
    _outward: ClassVar[bool] = True
    """Whether places grow to the wall, as eccentricity ratios, or fall to it, as the least film."""

    def bound(self, place: float, *, slopes: bool) -> float:
        """Return the largest error [1] of the force, or of K and C, at a place; infinite where unknown."""
        return self._bound(place, 2 if slopes else 1)

    def loss_bound(self, place: float) -> tuple[float, float]:
        """Return the largest errors [1] of shear and flows at a place; infinite where unknown."""
        return self._bound(place, 3), self._bound(place, 4)

    def _bound(self, place: float, column: int) -> float:
        ends = self.bounds[:, 0]
        errors = self.bounds[ends >= place if self._outward else ends <= place, column]
        return float(errors[0]) if len(errors) else math.inf

    def _require_bounds(self) -> None:
        shape = np.shape(self.bounds)
        if shape[1:] != (ERRORS,) or len(self.bounds) > BANDS or not np.all(self.bounds >= 0.0):
            raise InputError(
                f"bounds must have shape (bands, {ERRORS}), {BANDS} bands at most, and not be negative, "
                f"got {self.bounds!r}"
            )


@dataclass(frozen=True, kw_only=True, eq=False)
class GrownTable(BoundedTable):
    """A map with what the Reynolds number of turbulent oil adds to it, where that is known.

    Parameters
    ----------
    growth : ndarray, shape (cells_x + 3, cells_y + 3, cells_r + 3, cells_s + 5)
        Spline coefficients of what M grows by, over r = ln(1 + Re/scale) beside the coordinates of the map.
        They have nodes of their own, and are empty of a map for one mobility.
    growth_center : ndarray, shape (cells_r + 3, directions)
        Those of L0 of a map with openings, each direction centered on its node.
    growth_axis : ndarray, shape (2,)
        Scale in Reynolds numbers, and the last r; beyond it the force is that of this node.
    """

    growth: Array = field(default_factory=lambda: np.empty(0), repr=False)
    growth_center: Array = field(default_factory=lambda: np.empty(0), repr=False)
    growth_axis: Array = field(default_factory=lambda: np.empty(0))

    def _require_growth(self) -> None:
        if self.growth.size:
            require_shapes(self, growth=(None, None, None, None), growth_axis=(2,))
            if not np.all(self.growth_axis > 0.0):
                raise InputError(f"growth_axis must be positive, got {self.growth_axis!r}")

    def growth_tables(self, per_rate: float, density: float) -> dict[str, Array]:
        """Return what the C library reads of the growth, at a Reynolds number over half the speed [s]."""
        if not self.growth.size:
            return {}
        return {"growth": self.growth, "growth_map": np.array([*self.growth_axis, per_rate, density])}


# The impedance map of every plain journal bearing as one table: collapsing, saving, loading.


@quantities
@dataclass(frozen=True, kw_only=True, eq=False)
class MapTable(StoredTable):
    """The potential J of a film over eccentricity, direction and slenderness.

    Parameters
    ----------
    slenderness_range : (float, float) [1]
        Smallest and largest length/diameter; equal for the table of a single bearing.
    reach : float [1]
        X of the last node; beyond it the kernel continues J to the wall.
    log_center : ndarray, shape (s,)
        Spline coefficients of L0 over ln(L/D); s = 1 for a single bearing.
    coefficients : ndarray, shape (s, cells_x + 5, cells_t + 5)
        Spline coefficients of M over ln(L/D), X and T.

    Raises
    ------
    InputError
        If the sizes do not fit each other or an entry is not finite.
    """

    slenderness_range: tuple[float, float]
    reach: float
    log_center: Array = field(repr=False)
    coefficients: Array = field(repr=False)

    def __post_init__(self) -> None:
        count, (low, high) = len(self.log_center), self.slenderness_range
        self._require_shapes(count)
        if not (0.0 < low <= high < np.inf and (low < high) == (count > 1) and (count == 1 or count >= 10)):
            raise InputError(
                "slenderness_range must be positive, ascending, with 10 coefficients at least unless of one "
                f"bearing, got {self.slenderness_range!r} and {count}"
            )
        if not 0.0 < self.reach < np.inf:
            raise InputError(f"reach must be positive, got {self.reach!r}")

    def _require_shapes(self, count: int) -> None:
        require_shapes(self, log_center=(count,), coefficients=(count, None, None))

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio of the last node."""
        return float(unstretch(self.reach))

    def holds(self, slenderness: float) -> bool:
        """Return whether the table has a bearing of this length/diameter."""
        low, high = self.slenderness_range
        return low * (1.0 - 1e-12) <= slenderness <= high * (1.0 + 1e-12)

    def at(self, slenderness: float) -> tuple[Array, Array]:
        """Return the map of one bearing: coefficients (cells_x + 5, cells_t + 5), and L0.

        Parameters
        ----------
        slenderness : float [1]
            Bearing length / diameter.

        Raises
        ------
        InputError
            If the slenderness is outside the table.
        """
        low, high = self.slenderness_range
        if not self.holds(slenderness):
            raise InputError(
                f"length/diameter must be within the table of the film, {low:g} to {high:g}, "
                f"got {slenderness!r}; MapFilm() without a table takes more"
            )
        arrays = self.coefficients, self.log_center
        own, center = (slice_table(array, self.slenderness_range, slenderness) for array in arrays)
        return own, center

    def kernel(self, slenderness: float, wall: tuple[float, float]) -> MapKernel:
        """Return the compiled film of one bearing.

        Parameters
        ----------
        slenderness : float [1]
            Bearing length / diameter.
        wall : (float, float) [1]
            Length / diameter of the asymptotic film at the wall, which continues the table, and the share of
            that film in units of a journal. With 0, or where the last node is not asymptotic, J continues as
            a power of X.

        Raises
        ------
        InputError
            If the slenderness is outside the table.
        """
        own, center = self.at(slenderness)
        numbers = np.array([self.reach, *wall])
        tables = {"coefficients": own[None], "center": center[None], "map": numbers}
        return MapKernel(MapKind.PLAIN, tables)


def stretch(eccentricity_ratio: Array | float) -> Array:
    """Return X = chi/(1 - chi^2)^(1/4), which spreads the states near the wall."""
    chi = np.asarray(eccentricity_ratio, dtype=float)
    return chi / ((1.0 - chi) * (1.0 + chi)) ** 0.25


def unstretch(X: Array | float) -> Array:
    """Return the eccentricity ratio of X: the root of chi^4 + X^4 chi^2 = X^4."""
    squared = np.asarray(X, dtype=float) ** 2
    return np.sqrt(2.0 * squared / (squared + np.sqrt(squared**2 + 4.0)))


# Tables on disk: made once, found again, whole or not there.


FOLDER_VARIABLE = "ROTORFILM_CACHE"
"""Environment variable that names the folder of the cache."""

_logger = logging.getLogger(__name__)

T = TypeVar("T")
S = TypeVar("S", bound=StoredTable)


def cache_folder() -> Path:
    """Return the folder of the cache: $ROTORFILM_CACHE, or the platform's ($XDG_CACHE_HOME/rotorfilm)."""
    chosen = os.environ.get(FOLDER_VARIABLE)
    if chosen:
        return Path(chosen)
    # Imported here so that an FMU with another film needs no more than numpy and scipy.
    from platformdirs import user_cache_path

    return user_cache_path("rotorfilm", appauthor=False)


def table_path(kind: str, key: object) -> Path:
    """Return where a table of a kind lies: its name is a digest of all that decides its content."""
    return cache_folder() / f"{kind}-{hashlib.sha256(repr(key).encode()).hexdigest()[:24]}.bin"


def told(report: Report, of: str, folder: Path) -> Report:
    """Return the report; without one, one that says once in the log that a table is being made.

    Parameters
    ----------
    report : callable
    of : str
        What the table is of.
    folder : Path
        Folder where it will be kept.
    """
    said: list[str] = []

    def log(fraction: float, text: str) -> None:
        if not said:
            said.append(text)
            _logger.warning("making the %s, %s; it will be kept in %s", text, of, folder)

    return log if report is silent else report


def cached(
    path: Path,
    *,
    from_bytes: Callable[[bytes], T],
    build: Callable[[], T],
    to_bytes: Callable[[T], bytes],
    what: str,
) -> T:
    """Return what a sealed file holds, built and written where it is missing or damaged.

    Parameters
    ----------
    path : Path
        Its name tells all that decides what it holds: a file of another name is refused.
    from_bytes : callable
        Returns what content holds; raises RotorfilmError if it is not right.
    build : callable
        Returns it without a file.
    to_bytes : callable
        Returns the content of the file.
    what : str
        What it is, for the warnings.

    Warns
    -----
    FileWarning
        If the file is damaged or cannot be read, so that it is built again, or if it cannot be written.
    """
    try:
        return from_bytes(read_kept(path))
    except (FileNotFoundError, NotADirectoryError):
        pass
    except (OSError, RotorfilmError) as error:
        warn_user(f"{what} is made again: {error}", FileWarning)
    made = build()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_sealed(path, to_bytes(made), path.name)
    except OSError as error:
        warn_user(
            f"{what} could not be kept in {path.parent} ({error}); {FOLDER_VARIABLE} names another folder",
            FileWarning,
        )
    return made


def read_kept(path: Path) -> bytes:
    """Return what `cached` wrote; see `read_sealed` for the errors."""
    return read_sealed(path, path.name, "a file of the cache must be what its name says")


def cached_table(kind: type[S], path: Path, build: Callable[[], S]) -> S:
    """Return the table at a path, built and written where it is missing or damaged; see `cached`."""
    return cached(
        path,
        from_bytes=kind.from_bytes,
        build=build,
        to_bytes=kind.to_bytes,
        what="the map of the film",
    )
