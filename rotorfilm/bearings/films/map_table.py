"""The impedance map of every plain journal bearing as one table: collapsing, saving, loading.

With J(e, w) = min over films of the dissipation potential (`native/films/map_kernel.h`),

    ln(-J/|w|^2) = L0(S) + chi M(X, T, S),   X = chi/(1 - chi^2)^(1/4),   T = (1 + cos)/2,   S = ln(L/D),

on a uniform grid of X in [0, reach], T in [0, 1] and S, by quintic B-splines in all three.
"""

from __future__ import annotations

import hashlib
import logging
import os
import struct
import zlib
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from ...core.errors import FileWarning, InputError, RotorfilmError, warn_user
from ...core.files import read_sealed, write_atomically, write_sealed
from ...core.inputs import quantities
from ...core.model import Array
from ...core.progress import Report, silent
from ...native import slice_table

# How tables lie in files: a mark, a version, a checksum and sizes, then little-endian numbers.


_HEADER = struct.Struct("<8sIIiiii")

Sizes = tuple[int, int, int, int]

Layout = tuple[tuple[str, int], ...]
"""Little-endian dtype and count of each array of a table."""


class StoredTable(ABC):
    """A table that is its bytes: saved, loaded, compared and hashed by them."""

    @abstractmethod
    def to_bytes(self) -> bytes:
        """Return the table as little-endian bytes."""

    @classmethod
    @abstractmethod
    def from_bytes(cls, content: bytes) -> Self:
        """Return the table that `to_bytes` wrote."""

    def save(self, path: str | Path) -> None:
        """Write the table to a file."""
        write_atomically(path, self.to_bytes())

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


def seal(mark: bytes, version: int, sizes: Sizes, *arrays: Array | NDArray[np.int32]) -> bytes:
    """Return the bytes of a table; the mark has eight of them."""
    body = b"".join(array.astype(array.dtype.newbyteorder("<")).tobytes() for array in arrays)
    return _HEADER.pack(mark, version, zlib.crc32(body), *sizes) + body


def unseal(
    kind: str, mark: bytes, version: int, layout: Callable[[Sizes], Layout], content: bytes
) -> tuple[Any, ...]:
    """Return the sizes, and then as floats the arrays that `seal` wrote.

    Parameters
    ----------
    kind : str
        What messages call the table.
    mark, version
        As given to `seal`.
    layout : callable
        The arrays of a table of given sizes; empty where sizes cannot be.
    content : bytes

    Raises
    ------
    RotorfilmError
        If the content is not such a table, of another version, truncated or damaged.
    """
    if len(content) < _HEADER.size or not content.startswith(mark):
        raise RotorfilmError(f"{kind}: the content does not begin with the mark of a {kind}")
    _, found, checksum, *entries = _HEADER.unpack_from(content)
    sizes: Sizes = (entries[0], entries[1], entries[2], entries[3])
    if found != version:
        raise RotorfilmError(
            f"{kind}: version must be {version}, got {found}; make it again with this rotorfilm"
        )
    arrays = layout(sizes)
    expected = _HEADER.size + sum(np.dtype(dtype).itemsize * count for dtype, count in arrays)
    if not arrays or len(content) != expected:
        raise RotorfilmError(f"{kind}: size must be {expected} bytes for {sizes}, got {len(content)}")
    if zlib.crc32(content[_HEADER.size :]) != checksum:
        raise RotorfilmError(f"{kind}: the checksum does not fit, the content is damaged")
    return (sizes, *_arrays(arrays, content))


def _arrays(layout: Layout, content: bytes) -> Iterator[Array]:
    start = _HEADER.size
    for kind, count in layout:
        yield np.frombuffer(content, dtype=kind, offset=start, count=count).astype(float)
        start += np.dtype(kind).itemsize * count


# The impedance map of every plain journal bearing as one table: collapsing, saving, loading.


MAGIC = b"RFILMMAP"
VERSION = 2


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
        shape, count = np.shape(self.coefficients), np.size(self.log_center)
        low, high = self.slenderness_range
        if len(shape) != 3 or min(shape[1:]) < 6 or shape[0] != count or 1 < count < 10:
            raise InputError(
                "coefficients must have shape (s, x, t) with x, t >= 6 and log_center (s,), s 1 or >= 10, "
                f"got shapes {shape} and {np.shape(self.log_center)}"
            )
        if not (0.0 < low <= high < np.inf and (low < high) == (count > 1)):
            raise InputError(f"slenderness_range must be positive, ascending, got {self.slenderness_range!r}")
        if not (0.0 < self.reach < np.inf and np.isfinite(self.coefficients).all()):
            raise InputError(f"reach must be positive and coefficients finite, got reach {self.reach!r}")
        if not np.isfinite(self.log_center).all():
            raise InputError("log_center must be finite")

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio of the last node."""
        return float(unstretch(self.reach))

    def holds(self, slenderness: float) -> bool:
        """Return whether the table has a bearing of this length/diameter."""
        low, high = self.slenderness_range
        return low * (1.0 - 1e-12) <= slenderness <= high * (1.0 + 1e-12)

    def at(self, slenderness: float) -> tuple[Array, float, float]:
        """Return the map of one bearing: coefficients (cells_x + 5, cells_t + 5), X of the last node, and L0.

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
        collapsed, center = slice_table(
            self.coefficients, self.log_center, self.slenderness_range, slenderness
        )
        return collapsed, self.reach, center

    def to_bytes(self, quantum: float = 0.0) -> bytes:
        """Return the table as little-endian bytes: header with sizes and checksum, then the numbers.

        Parameters
        ----------
        quantum : float
            Where positive, M's coefficients are rounded to multiples of it, of 4 bytes each instead of 8.

        Raises
        ------
        InputError
            If a coefficient is beyond 2^31 quanta.
        """
        numbers = np.array([self.reach, *self.slenderness_range, quantum, *np.ravel(self.log_center)])
        s, x, t = self.coefficients.shape
        return seal(MAGIC, VERSION, (s, x, t, 4 if quantum else 8), numbers, self._packed(quantum))

    def _packed(self, quantum: float) -> Array | NDArray[np.int32]:
        if not quantum:
            return self.coefficients
        multiples = np.rint(self.coefficients / quantum)
        if not np.abs(multiples).max() < 2.0**31:
            least = np.abs(self.coefficients).max() / 2.0**31
            raise InputError(f"quantum must be above {least:.3g} for these coefficients, got {quantum!r}")
        return multiples.astype(np.int32)

    @classmethod
    def from_bytes(cls, content: bytes) -> Self:
        """Return the table that `to_bytes` wrote.

        Raises
        ------
        RotorfilmError
            If the content is not such a table, of another version, truncated or damaged.
        """
        sizes, numbers, packed = unseal("map table", MAGIC, VERSION, _layout, content)
        return cls(
            slenderness_range=(float(numbers[1]), float(numbers[2])),
            reach=float(numbers[0]),
            log_center=numbers[4:],
            coefficients=packed.reshape(sizes[:3]) * (numbers[3] or 1.0),
        )

    def save(self, path: str | Path, quantum: float = 0.0) -> None:
        """Write the table to a file; see `to_bytes`."""
        write_atomically(path, self.to_bytes(quantum))


def stretch(eccentricity_ratio: Array | float) -> Array:
    """Return X = chi/(1 - chi^2)^(1/4), which spreads the states near the wall."""
    chi = np.asarray(eccentricity_ratio, dtype=float)
    return chi / ((1.0 - chi) * (1.0 + chi)) ** 0.25


def unstretch(X: Array | float) -> Array:
    """Return the eccentricity ratio of X: the root of chi^4 + X^4 chi^2 = X^4."""
    squared = np.asarray(X, dtype=float) ** 2
    return np.sqrt(2.0 * squared / (squared + np.sqrt(squared**2 + 4.0)))


def _layout(sizes: Sizes) -> Layout:
    """Return what a table of these sizes holds: its numbers, then the coefficients of M."""
    entries, cells_x, cells_t, width = sizes
    possible = min(entries, cells_x, cells_t) > 0 and width in (4, 8)
    return (
        (("<f8", 4 + entries), (f"<{'f' if width == 8 else 'i'}{width}", entries * cells_x * cells_t))
        if possible
        else ()
    )


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
        Where it will be kept.
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
