"""The impedance map of every plain journal bearing as one table: collapsing, saving, loading.

With J(e, w) = min over films of the dissipation potential (`native/films/map_kernel.h`),

    ln(-J/|w|^2) = L0(S) + chi M(X, T, S),   X = chi/(1 - chi^2)^(1/4),   T = (1 + cos)/2,   S = ln(L/D),

on a uniform grid of X in [0, reach], T in [0, 1] and S, by quintic B-splines in all three.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...files import write_whole
from ...inputs.si_arguments import quantities
from ...model import Array
from ...native import slice_table
from .table_bytes import Layout, Sizes, StoredTable, seal, unseal

MAGIC = b"RFILMMAP"
VERSION = 2


class BearingMap(NamedTuple):
    """The map of one bearing.

    Attributes
    ----------
    coefficients : ndarray, shape (cells_x + 5, cells_t + 5)
    reach : float
        X of the last node.
    log_center : float
        L0.
    """

    coefficients: Array
    reach: float
    log_center: float


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
        if not self.holds(slenderness):
            raise InputError(
                f"length/diameter must be within the table of the film, {low:g} to {high:g}, "
                f"got {slenderness!r}; MapFilm() without a table takes more"
            )
        collapsed, center = slice_table(
            self.coefficients, self.log_center, self.slenderness_range, slenderness
        )
        return BearingMap(collapsed, self.reach, center)

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
        write_whole(path, self.to_bytes(quantum))


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
