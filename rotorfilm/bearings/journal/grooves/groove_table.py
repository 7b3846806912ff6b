"""The impedance map of one bearing with axial openings as a table: saving, loading.

With J(e, w) = min over films of the dissipation potential (`native/films/groove_kernel.h`),

    ln(-J/|w|^2) = L0(phi) + chi M(X, theta, s),
    X = chi/(1 - chi^2)^(1/4),   tan s = crowding tan(phi - theta),

e at the angle theta and w at phi from the axis of the openings, on uniform grids by quintic B-splines.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Self

import numpy as np

from ....errors import InputError
from ....model import Array
from ...films.geometry import Groove
from ...films.map_table import unstretch
from ...films.table_bytes import Layout, Sizes, StoredTable, seal, unseal

MAGIC = b"RFGROOVE"
VERSION = 1

DIRECTIONS = 192
"""Nodes of L0 over the direction of the source."""


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

    def __post_init__(self) -> None:
        shape = np.shape(self.coefficients)
        if len(shape) != 3 or min(shape) < 6 or np.shape(self.log_center) != (DIRECTIONS,):
            raise InputError(
                f"coefficients must have shape (x, e, s) of 6 at least and log_center ({DIRECTIONS},), "
                f"got shapes {shape} and {np.shape(self.log_center)}"
            )
        if not (np.isfinite(self.coefficients).all() and np.isfinite(self.log_center).all()):
            raise InputError("coefficients and log_center must be finite")
        if not (0.0 < self.reach < np.inf and 0.0 < self.crowding <= 1.0 and 0.0 < self.slenderness < np.inf):
            raise InputError(
                "slenderness and reach must be positive and crowding in (0, 1], "
                f"got {self.slenderness!r}, {self.reach!r} and {self.crowding!r}"
            )

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio of the last node."""
        return float(unstretch(self.reach))

    def to_bytes(self) -> bytes:
        """Return the table as little-endian bytes: header with sizes and checksum, then the numbers."""
        openings = [angle for groove in self.grooves for angle in (groove.center, groove.width)]
        numbers = [self.slenderness, self.reach, self.crowding, *openings]
        cells_x, cells_e, cells_s = self.coefficients.shape
        sizes = (cells_x, cells_e, cells_s, len(self.grooves))
        return seal(MAGIC, VERSION, sizes, np.array(numbers), self.log_center, self.coefficients)

    @classmethod
    def from_bytes(cls, content: bytes) -> Self:
        """Return the table that `to_bytes` wrote.

        Raises
        ------
        RotorfilmError
            If the content is not such a table, of another version, truncated or damaged.
        """
        sizes, numbers, center, coefficients = unseal("groove table", MAGIC, VERSION, _layout, content)
        scalars, openings = np.split(numbers, [3])
        slenderness, reach, crowding = scalars.tolist()
        return cls(
            slenderness=slenderness,
            grooves=tuple(Groove(center=c, width=w) for c, w in openings.reshape(-1, 2).tolist()),
            reach=reach,
            crowding=crowding,
            log_center=center,
            coefficients=coefficients.reshape(sizes[:3]),
        )


def _layout(sizes: Sizes) -> Layout:
    """Return what a table of these sizes holds: numbers and openings, L0, the coefficients of M."""
    cells_x, cells_e, cells_s, grooves = sizes
    if min(sizes) < 1:
        return ()
    return (("<f8", 3 + 2 * grooves), ("<f8", DIRECTIONS), ("<f8", cells_x * cells_e * cells_s))
