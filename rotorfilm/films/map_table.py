"""The impedance map of every plain journal bearing as one table: collapsing, saving, loading.

With J(e, w) = min over films of the dissipation potential (`native/map_kernel.h`),

    ln(-J/|w|^2) = L0(S) + chi M(X, T, S),   X = chi/(1 - chi^2)^(1/4),   T = (1 + cos)/2,   S = ln(L/D),

on a uniform grid of X in [0, reach], T in [0, 1] and S, by quintic B-splines in all three.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..errors import InputError, RotorfilmError
from ..model import Array
from ..native import slice_table

MAGIC = b"RFILMMAP"
VERSION = 1
_HEADER = struct.Struct("<8sIIiiii")
_NUMBER = "<f8"


class BearingMap(NamedTuple):
    """The map of one bearing.

    Attributes
    ----------
    coefficients : ndarray, shape (cells_x + 5, cells_t + 5)
    reach : float
        X of the last node.
    center : float
        L0.
    """

    coefficients: Array
    reach: float
    center: float


@dataclass(frozen=True, kw_only=True, eq=False)
class MapTable:
    """The potential J of a film over eccentricity, direction and slenderness.

    Parameters
    ----------
    slenderness_range : (float, float) [1]
        Smallest and largest length/diameter; equal for the table of a single bearing.
    reach : float [1]
        X of the last node; beyond it the kernel continues J as a power of X.
    center : ndarray, shape (s,)
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
    center: Array = field(repr=False)
    coefficients: Array = field(repr=False)

    def __post_init__(self) -> None:
        shape, count = np.shape(self.coefficients), np.size(self.center)
        low, high = self.slenderness_range
        if len(shape) != 3 or min(shape[1:]) < 6 or shape[0] != count or 1 < count < 10:
            raise InputError(
                "coefficients must have shape (s, x, t) with x, t >= 6 and center (s,), s = 1 or s >= 10, "
                f"got shapes {shape} and {np.shape(self.center)}"
            )
        if not (0.0 < low <= high < np.inf and (low < high) == (count > 1)):
            raise InputError(f"slenderness_range must be positive, ascending, got {self.slenderness_range!r}")
        if not (0.0 < self.reach < np.inf and np.isfinite(self.coefficients).all()):
            raise InputError(f"reach must be positive and coefficients finite, got reach {self.reach!r}")
        if not np.isfinite(self.center).all():
            raise InputError("center must be finite")

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio of the last node."""
        return float(unstretch(self.reach))

    def at(self, slenderness: float) -> BearingMap:
        """Return the map of one bearing.

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
        if not low * (1.0 - 1e-12) <= slenderness <= high * (1.0 + 1e-12):
            raise InputError(
                f"length/diameter must be within the table of the film, {low:g} to {high:g}, "
                f"got {slenderness!r}; give MapFilm a table of its own for this bearing"
            )
        collapsed, center = slice_table(self.coefficients, self.center, self.slenderness_range, slenderness)
        return BearingMap(collapsed, self.reach, center)

    def to_bytes(self) -> bytes:
        """Return the table as little-endian bytes: header with sizes and checksum, then the numbers."""
        numbers = [self.reach, *self.slenderness_range, *np.ravel(self.center), *np.ravel(self.coefficients)]
        body = np.asarray(numbers, dtype=_NUMBER).tobytes()
        return _HEADER.pack(MAGIC, VERSION, zlib.crc32(body), *self.coefficients.shape, 0) + body

    @classmethod
    def from_bytes(cls, content: bytes) -> MapTable:
        """Return the table that `to_bytes` wrote.

        Raises
        ------
        RotorfilmError
            If the content is not such a table, of another version, truncated or damaged.
        """
        shape = _checked_shape(content)
        numbers = np.frombuffer(content, dtype=_NUMBER, offset=_HEADER.size).astype(float)
        center, coefficients = np.split(numbers[3:], [shape[0]])
        return cls(
            slenderness_range=(float(numbers[1]), float(numbers[2])),
            reach=float(numbers[0]),
            center=center,
            coefficients=coefficients.reshape(shape),
        )

    def save(self, path: str | Path) -> None:
        """Write the table to a file."""
        Path(path).write_bytes(self.to_bytes())

    @classmethod
    def load(cls, path: str | Path) -> MapTable:
        """Return the table in a file; see `from_bytes` for the errors."""
        return cls.from_bytes(Path(path).read_bytes())

    @cached_property
    def _content(self) -> bytes:
        return self.to_bytes()

    def __eq__(self, other: object) -> bool:
        return self is other or (isinstance(other, MapTable) and self._content == other._content)

    def __hash__(self) -> int:
        return hash(self._content)


def stretch(eccentricity_ratio: Array | float) -> Array:
    """Return X = chi/(1 - chi^2)^(1/4), which spreads the states near the wall."""
    chi = np.asarray(eccentricity_ratio, dtype=float)
    return chi / ((1.0 - chi) * (1.0 + chi)) ** 0.25


def unstretch(X: Array | float) -> Array:
    """Return the eccentricity ratio of X: the root of chi^4 + X^4 chi^2 = X^4."""
    squared = np.asarray(X, dtype=float) ** 2
    return np.sqrt(2.0 * squared / (squared + np.sqrt(squared**2 + 4.0)))


def _checked_shape(content: bytes) -> tuple[int, int, int]:
    if len(content) < _HEADER.size or not content.startswith(MAGIC):
        raise RotorfilmError("map table: the content does not begin with the mark of a map table")
    _, version, checksum, *shape, _ = _HEADER.unpack_from(content)
    if version != VERSION:
        raise RotorfilmError(f"map table: version must be {VERSION}, got {version}")
    expected = _HEADER.size + 8 * (3 + shape[0] + shape[0] * shape[1] * shape[2])
    if min(shape) < 1 or len(content) != expected:
        raise RotorfilmError(f"map table: size must be {expected} bytes for {shape}, got {len(content)}")
    if zlib.crc32(content[_HEADER.size :]) != checksum:
        raise RotorfilmError("map table: the checksum does not fit, the content is damaged")
    return shape[0], shape[1], shape[2]
