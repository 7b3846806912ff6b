"""Shear and flow of every plain journal bearing as three tables beside that of the potential.

With X and S = ln(L/D) as in `films/map_table.py`, the tables hold

    ln(sqrt(1 - chi^2) Sigma_f),   ln(sqrt(1 - chi^2) (Sigma_f + Sigma_r)),   ln(flow/|w|),
    each as L0(S) + chi M(X, s, S),   tan s = CROWDING tan beta,

`Sigma_f` being the shear integral of the film, `Sigma_r` that of the streamers (`films/film_losses.py`), and
beta in [0, pi] the angle between eccentricity and source. The streamers follow the end at which the film is
torn, so that their table has kinks at the center and where beta is 0 or pi: it is fitted from one side. The
others are even in beta.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Self

import numpy as np

from ....errors import InputError, RotorfilmError
from ....native.loss_kernels import MapLossKernel
from ...films.map_table import MapTable
from ...films.table_bytes import StoredTable

TABLE = "journal_losses.bin"
"""The table of the package, in `data`."""

QUANTUM = 1e-7
"""Unit of the stored coefficients, far below the error of the nodes."""

CROWDING = 0.6
"""Ratio of tan s and tan beta: crowds the nodes where the source is across, as the film turns there."""


@dataclass(frozen=True, eq=False)
class LossTable(StoredTable):
    """Shear and flow of films over eccentricity, direction and slenderness.

    Parameters
    ----------
    shear_film, shear, flow : MapTable
        Of ln(s Sigma_f), ln(s (Sigma_f + Sigma_r)) and ln(flow/|w|), of equal sizes and ranges.

    Raises
    ------
    InputError
        If the three are not alike.
    """

    shear_film: MapTable
    shear: MapTable
    flow: MapTable

    def __post_init__(self) -> None:
        kinds = {(t.slenderness_range, t.reach, np.shape(t.coefficients)) for t in self.tables}
        if len(kinds) > 1:
            raise InputError(f"shear_film, shear and flow must have equal ranges and sizes, got {kinds!r}")

    @property
    def tables(self) -> tuple[MapTable, MapTable, MapTable]:
        """The three tables."""
        return self.shear_film, self.shear, self.flow

    def holds(self, slenderness: float) -> bool:
        """Return whether the table has a bearing of this length/diameter."""
        return self.flow.holds(slenderness)

    def at(self, slenderness: float) -> MapLossKernel:
        """Return the compiled losses of one bearing; InputError if the table does not hold it."""
        maps = [table.at(slenderness) for table in self.tables]
        coefficients, center = (np.array([m[k] for m in maps]) for k in (0, 2))
        return MapLossKernel(coefficients, maps[0].reach, center, CROWDING)

    def to_bytes(self) -> bytes:
        """Return the three tables as bytes, one after the other."""
        return b"".join(table.to_bytes(QUANTUM) for table in self.tables)

    @classmethod
    def from_bytes(cls, content: bytes) -> Self:
        """Return the table that `to_bytes` wrote; RotorfilmError where the content is damaged."""
        size = len(content) // 3
        return cls(*(MapTable.from_bytes(content[k * size : (k + 1) * size]) for k in range(3)))


@lru_cache(maxsize=1)
def packaged_losses() -> LossTable:
    """Return the table that comes with the package.

    Raises
    ------
    RotorfilmError
        If it is missing or damaged.
    """
    package = __package__ or ""
    try:
        content = files(package).joinpath("data", TABLE).read_bytes()
    except OSError as error:
        raise RotorfilmError(f"the loss table {TABLE} of the package is missing: {error}") from error
    return LossTable.from_bytes(content)


@lru_cache(maxsize=64)
def packaged_kernel(slenderness: float) -> MapLossKernel | None:
    """Return the losses of one plain bearing; None where the table of the package does not hold it."""
    table = packaged_losses()
    return table.at(slenderness) if table.holds(slenderness) else None
