"""The impedance map of one bearing with axial openings as a table: saving, loading.

With J(e, w) = min over films of the dissipation potential (`native/films/groove_kernel.h`),

    ln(-J/|w|^2) = L0(phi) + chi M(X, theta, s),
    X = chi/(1 - chi^2)^(1/4),   tan s = crowding tan(phi - theta),

e at the angle theta and w at phi from the axis of the openings, on uniform grids by quintic B-splines.
Beside it are shear and flow of the film (`groove_losses.py`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Self

import numpy as np

from ....errors import InputError
from ....inputs.si_arguments import quantities
from ....model import Array
from ....native.loss_kernels import GrooveLossKernel
from ...films.geometry import Groove
from ...films.map_table import unstretch
from ...films.table_bytes import Layout, Sizes, StoredTable, seal, unseal
from .groove_losses import CELLS, land_edges

MAGIC = b"RFGROOVE"
VERSION = 3
"""Since 2 a table has bounds of its error, since 3 shear and flow."""

BANDS = 8
"""Most bands of eccentricity ratios with a bound each."""

ERRORS = 5
"""Columns of the bounds: an eccentricity ratio, and errors up to it."""

DIRECTIONS = 192
"""Nodes of L0 over the direction of the source."""


@quantities
@dataclass(frozen=True, kw_only=True, eq=False)
class GrooveMapTable(StoredTable):
    """The potential J of the film of one bearing with openings at ambient pressure.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter of the bearing.
    grooves : tuple of Groove
        Its openings, seen from the axis of `groove_axis.aligned_openings`.
    reach : float [1]
        X of the last node; beyond it the kernel continues J to the wall.
    crowding : float [1]
        In (0, 1]: how much closer the nodes lie where the source is across the eccentricity.
    log_center : ndarray, shape (DIRECTIONS,)
        Spline coefficients of L0, each centered on its node.
    coefficients : ndarray, shape (cells_x + 5, cells_e, cells_s)
        Spline coefficients of M over X, theta and s.
    shear : ndarray, shape (2, 3, cells_x + 5, cells_e, CELLS + 5)
        Spline coefficients of shear and side flow over X, theta and s, for both senses of the oil.
    flows : ndarray, shape (2, 2, openings, cells_x + 5, cells_e)
        Those of the flows out of the openings, and into them.
    bounds : ndarray, shape (bands, 5)
        Largest errors with the journal at rest, found when the map was made (`groove_bounds`): up to which
        eccentricity ratio, of the force relative to it, of K and C relative to their largest entry, of the
        shear and of the flow of fresh oil relative to them. None of them where nothing is known.

    Raises
    ------
    InputError
        If the sizes do not fit each other or an entry is not finite or in its range.
    """

    slenderness: float
    grooves: tuple[Groove, ...]
    reach: float
    crowding: float
    log_center: Array = field(repr=False)
    coefficients: Array = field(repr=False)
    shear: Array = field(repr=False)
    flows: Array = field(repr=False)
    bounds: Array = field(default_factory=lambda: np.empty((0, ERRORS)), repr=False)

    def __post_init__(self) -> None:
        shape = np.shape(self.coefficients)
        if len(shape) != 3 or min(shape) < 6 or np.shape(self.log_center) != (DIRECTIONS,):
            raise InputError(
                f"coefficients must have shape (x, e, s) of 6 at least and log_center ({DIRECTIONS},), "
                f"got shapes {shape} and {np.shape(self.log_center)}"
            )
        expected = _loss_shapes(shape[0], shape[1], len(self.grooves))
        if (np.shape(self.shear), np.shape(self.flows)) != expected:
            raise InputError(
                f"shear and flows must have shapes {expected[0]} and {expected[1]}, "
                f"got {np.shape(self.shear)} and {np.shape(self.flows)}"
            )
        splines = self.coefficients, self.log_center, self.shear, self.flows
        if not all(np.isfinite(each).all() for each in splines):
            raise InputError("coefficients, log_center, shear and flows must be finite")
        if (
            np.shape(self.bounds)[1:] != (ERRORS,)
            or len(self.bounds) > BANDS
            or not np.all(self.bounds >= 0.0)
        ):
            raise InputError(
                f"bounds must have shape (bands, {ERRORS}), {BANDS} bands at most, and not be negative, "
                f"got {self.bounds!r}"
            )
        if not (0.0 < self.reach < np.inf and 0.0 < self.crowding <= 1.0 and 0.0 < self.slenderness < np.inf):
            raise InputError(
                "slenderness and reach must be positive and crowding in (0, 1], "
                f"got {self.slenderness!r}, {self.reach!r} and {self.crowding!r}"
            )

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio of the last node."""
        return float(unstretch(self.reach))

    def bound(self, eccentricity_ratio: float, *, slopes: bool) -> float:
        """Return the largest error [1] of the force at rest, or of K and C; infinite where it is unknown."""
        return self._bound(eccentricity_ratio, 2 if slopes else 1)

    def loss_bound(self, eccentricity_ratio: float) -> tuple[float, float]:
        """Return the largest errors [1] of shear, most of the power, and flow; infinite where unknown."""
        return self._bound(eccentricity_ratio, 3), self._bound(eccentricity_ratio, 4)

    def _bound(self, eccentricity_ratio: float, column: int) -> float:
        errors = self.bounds[self.bounds[:, 0] >= eccentricity_ratio, column]
        return float(errors[0]) if len(errors) else math.inf

    def loss_kernel(self, axis: float) -> GrooveLossKernel:
        """Return shear and flow in compiled code, the axis of the openings being at this angle [rad]."""
        numbers = self.reach, self.crowding, axis
        return GrooveLossKernel(self.shear, self.flows, land_edges(self.grooves), numbers)

    def to_bytes(self) -> bytes:
        """Return the table as little-endian bytes: header with sizes and checksum, then the numbers."""
        openings = [angle for groove in self.grooves for angle in (groove.center, groove.width)]
        numbers = [self.slenderness, self.reach, self.crowding, len(self.bounds), *openings]
        cells_x, cells_e, cells_s = self.coefficients.shape
        sizes = (cells_x, cells_e, cells_s, len(self.grooves))
        bands = np.zeros((BANDS, ERRORS))
        bands[: len(self.bounds)] = self.bounds
        splines = self.log_center, self.coefficients, self.shear, self.flows
        return seal(MAGIC, VERSION, sizes, np.array(numbers), bands, *splines)

    @classmethod
    def from_bytes(cls, content: bytes) -> Self:
        """Return the table that `to_bytes` wrote.

        Raises
        ------
        RotorfilmError
            If the content is not such a table, of another version, truncated or damaged.
        """
        sizes, numbers, bands, center, *splines = unseal("groove table", MAGIC, VERSION, _layout, content)
        shapes = (sizes[:3], *_loss_shapes(sizes[0], sizes[1], sizes[3]))
        coefficients, shear, flows = (
            each.reshape(shape) for each, shape in zip(splines, shapes, strict=True)
        )
        scalars, openings = np.split(numbers, [4])
        slenderness, reach, crowding, known = scalars.tolist()
        return cls(
            slenderness=slenderness,
            grooves=tuple(Groove(center=c, width=w) for c, w in openings.reshape(-1, 2).tolist()),
            reach=reach,
            crowding=crowding,
            log_center=center,
            coefficients=coefficients,
            shear=shear,
            flows=flows,
            bounds=bands.reshape(BANDS, ERRORS)[: int(known)],
        )


def _loss_shapes(cells_x: int, cells_e: int, openings: int) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return the shapes of shear and flows beside M with so many coefficients over X and theta."""
    return (2, 3, cells_x, cells_e, CELLS + 5), (2, 2, openings, cells_x, cells_e)


def _layout(sizes: Sizes) -> Layout:
    """Return what a table of these sizes holds: numbers and openings, bounds, L0, M, shear and flows."""
    cells_x, cells_e, cells_s, grooves = sizes
    if min(sizes) < 1:
        return ()
    counts = 4 + 2 * grooves, ERRORS * BANDS, DIRECTIONS, cells_x * cells_e * cells_s
    losses = (math.prod(shape) for shape in _loss_shapes(cells_x, cells_e, grooves))
    return tuple(("<f8", count) for count in (*counts, *losses))
