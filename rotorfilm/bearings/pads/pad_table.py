"""The impedance map of one pad as a table: coordinates, saving, loading.

With J(e, w) = min over films of the dissipation potential (`native/films/pad_kernel.h`), in the frame of the
pad,

    ln(-J/|w|^2) = 5 ln(cos phi + sin b) + M(u, Y, phi),   xi = 1 - exp(-u),   eta = tanh(Y) E(xi),

e = (xi, eta) and w at the angle phi from the middle of the pad, which covers 2 b, on uniform grids by quintic
B-splines. The logarithm takes out how J vanishes with the source at the edge of the pad: as a fifth power.
Beside it are shear and flow of the film (`pad_losses.py`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Self

import numpy as np

from ...errors import InputError
from ...model import Array
from ...native.pad_kernels import PadMapKernel
from ..films.table_bytes import Layout, Sizes, StoredTable, seal, unseal
from .pad_losses import LOSSES, PadLossMap

MAGIC = b"RFPADMAP"
VERSION = 2

BANDS = 4
"""Bands of the least film with bounds each."""

ERRORS = 5
"""Columns of the bounds."""


@dataclass(frozen=True, kw_only=True, eq=False)
class PadMapTable(StoredTable):
    """The potential J of the film on one pad.

    Parameters
    ----------
    extent : float [rad]
        Angle that the pad covers, below pi.
    slenderness : float [1]
        Length / diameter.
    u_range : (float, float) [1]
        u of the first and the last node.
    y_end : float [1]
        Y of the last node; the first is opposite.
    coefficients : ndarray, shape (cells_u + 5, cells_y + 5, cells_phi + 5)
        Spline coefficients of M over u, Y and phi.
    losses : ndarray, shape (3, cells over X + 5, cells over theta)
        Spline coefficients of shear and flow at rest (`pad_losses`).
    bounds : ndarray, shape (BANDS, ERRORS)
        Largest errors found when the map was made (`pad_bounds`): from which least film / clearance on, of
        the force, and of K and C, relative to what is said there, of the shear at rest, and of flows at rest
        relative to what enters a concentric pad.

    Raises
    ------
    InputError
        If the sizes do not fit each other or an entry is not finite or in its range.
    """

    extent: float
    slenderness: float
    u_range: tuple[float, float]
    y_end: float
    coefficients: Array = field(repr=False)
    losses: Array = field(repr=False)
    bounds: Array = field(default_factory=lambda: np.full((BANDS, ERRORS), np.inf), repr=False)

    def __post_init__(self) -> None:
        shape = np.shape(self.coefficients)
        if len(shape) != 3 or min(shape) < 6 or not np.isfinite(self.coefficients).all():
            raise InputError(
                f"coefficients must be finite, of shape (u, Y, phi) of 6 at least, got shape {shape}"
            )
        if np.shape(self.losses) != LOSSES or not np.isfinite(self.losses).all():
            raise InputError(f"losses must be finite, of shape {LOSSES}, got shape {np.shape(self.losses)}")
        if np.shape(self.bounds) != (BANDS, ERRORS) or not np.all(self.bounds >= 0.0):
            raise InputError(
                f"bounds must have shape ({BANDS}, {ERRORS}) and not be negative, got {self.bounds!r}"
            )
        numbers = self.extent, self.slenderness, self.y_end, self.u_range[1] - self.u_range[0]
        if not all(0.0 < number < np.inf for number in numbers) or self.extent >= np.pi:
            raise InputError(
                "extent, slenderness, y_end and the range of u must be positive and extent below pi, "
                f"got {self.extent!r}, {self.slenderness!r}, {self.y_end!r} and {self.u_range!r}"
            )

    def kernel(self) -> PadMapKernel:
        """Return the compiled film of the pad."""
        return PadMapKernel(self.coefficients, self.extent, self.u_range, self.y_end)

    def bound(self, least_film: float, *, slopes: bool) -> float:
        """Return the largest error [1] of the force, or of K and C, where the least film is at least this."""
        return self._bound(least_film, 2 if slopes else 1)

    def loss_bound(self, least_film: float) -> tuple[float, float]:
        """Return the largest errors [1] of shear and flows at rest where the least film is at least this.

        That of flows is relative to what enters a concentric pad, clearance radius length speed/2.
        """
        return self._bound(least_film, 3), self._bound(least_film, 4)

    def _bound(self, least_film: float, column: int) -> float:
        errors = self.bounds[self.bounds[:, 0] <= least_film, column]
        return float(errors[0]) if len(errors) else np.inf

    def loss_map(self) -> PadLossMap:
        """Return shear and flow of the pad under journals at rest."""
        return PadLossMap(self.losses, self.extent)

    def to_bytes(self) -> bytes:
        """Return the table as little-endian bytes: header with sizes and checksum, then the numbers."""
        numbers = np.array([self.extent, self.slenderness, *self.u_range, self.y_end])
        sizes = (*self.coefficients.shape, 0)
        return seal(MAGIC, VERSION, sizes, numbers, self.bounds, self.losses, self.coefficients)

    @classmethod
    def from_bytes(cls, content: bytes) -> Self:
        """Return the table that `to_bytes` wrote.

        Raises
        ------
        RotorfilmError
            If the content is not such a table, of another version, truncated or damaged.
        """
        sizes, numbers, bounds, losses, coefficients = unseal("pad table", MAGIC, VERSION, _layout, content)
        extent, slenderness, first, last, y_end = numbers.tolist()
        return cls(
            extent=extent,
            slenderness=slenderness,
            u_range=(first, last),
            y_end=y_end,
            coefficients=coefficients.reshape(sizes[:3]),
            losses=losses.reshape(LOSSES),
            bounds=bounds.reshape(BANDS, ERRORS),
        )


def _layout(sizes: Sizes) -> Layout:
    """Return what a table of these sizes holds: numbers, bounds, losses, coefficients of M."""
    if min(sizes[:3]) < 1:
        return ()
    counts = 5, ERRORS * BANDS, math.prod(LOSSES), math.prod(sizes[:3])
    return tuple(("<f8", count) for count in counts)


def wall(xi: Array | float, extent: float) -> Array:
    """Return E, the eta at which the journal touches the pad, for xi below 1."""
    b = 0.5 * extent
    straight = (1.0 - xi * np.cos(b)) / np.sin(b)
    return np.where(xi > np.cos(b), np.sqrt(np.maximum((1.0 - xi) * (1.0 + xi), 0.0)), straight)


def least_film(e: Array, extent: float) -> Array:
    """Return the least H = 1 - e.n on the arc of a pad, (...), at eccentricities (2, ...) in its frame."""
    angle, b = np.arctan2(e[1], e[0]), 0.5 * extent
    return 1.0 - np.hypot(*e) * np.cos(np.maximum(np.abs(angle) - b, 0.0))
