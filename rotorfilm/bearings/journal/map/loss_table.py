"""Shear and flow of every plain journal bearing as three tables beside that of the potential.

With s = sqrt(1 - chi^2) and X, T and S as in `films/map_table.py`, the tables hold

    ln(s Sigma_f),   ln(s (Sigma_f + Sigma_r)),   ln(flow/|w|),   each as L0(S) + chi M(X, T, S),

`Sigma_f` being the shear integral of the film and `Sigma_r` that of the streamers (`films/film_losses.py`). The
second has a kink at the center, since the streamers follow the end at which the film is torn: M is fitted from
one side.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Self

import numpy as np

from ....errors import InputError, RotorfilmError
from ....model import Array
from ....native.loss_kernels import MapLossKernel
from ...films.map_fit import node_eccentricities
from ...films.map_table import MapTable, stretch
from ...films.quintic import quintic_coefficients
from ...films.table_bytes import StoredTable

TABLE = "journal_losses.bin"
"""The table of the package, in `data`."""

QUANTUM = 1e-7
"""Unit of the stored coefficients, far below the error of the nodes."""

NEAR = 1e-3
"""Eccentricity ratio of the first nodes in M, whose limit at the center is 0/0."""


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
        """Return the compiled losses of one bearing; InputError if its length/diameter is outside the table."""
        maps = [table.at(slenderness) for table in self.tables]
        coefficients, center = (np.array([m[k] for m in maps]) for k in (0, 2))
        return MapLossKernel(coefficients, maps[0].reach, center)

    def to_bytes(self) -> bytes:
        """Return the three tables as bytes, one after the other."""
        return b"".join(table.to_bytes(QUANTUM) for table in self.tables)

    @classmethod
    def from_bytes(cls, content: bytes) -> Self:
        """Return the table that `to_bytes` wrote; RotorfilmError where the content is damaged."""
        size = len(content) // 3
        return cls(*(MapTable.from_bytes(content[k * size : (k + 1) * size]) for k in range(3)))


def fit_loss_table(
    losses: Array, *, slenderness_range: tuple[float, float], largest_eccentricity_ratio: float
) -> LossTable:
    """Return the table that interpolates losses on the nodes of `loss_node_eccentricities`.

    Parameters
    ----------
    losses : ndarray, shape (3, s, cells_x + 2, cells_t + 1)
        `node_losses` at s values of ln(L/D), uniform from the smallest to the largest (s = 1 or s >= 6); at
        the eccentricity ratios, the center among them; at T = 0, ..., 1, uniform.
    slenderness_range : (float, float) [1]
    largest_eccentricity_ratio : float [1]
    """
    chi = loss_node_eccentricities(largest_eccentricity_ratio, losses.shape[2] - 2)
    scale = np.sqrt((1.0 - chi) * (1.0 + chi))[:, None] ** np.array([1, 1, 0])[:, None, None, None]
    L = np.log(losses * scale)
    center = L[:, :, 0].mean(axis=-1)
    M = (L[:, :, 1:] - center[:, :, None, None]) / chi[1:, None]
    M = quintic_coefficients(quintic_coefficients(M, axis=2), axis=3)
    if M.shape[1] > 1:
        M, center = quintic_coefficients(M, axis=1), quintic_coefficients(center, axis=1)
    reach = float(stretch(largest_eccentricity_ratio))
    return LossTable(
        *(
            MapTable(
                slenderness_range=slenderness_range, reach=reach, log_center=center[k], coefficients=M[k]
            )
            for k in range(3)
        )
    )


def loss_node_eccentricities(largest_eccentricity_ratio: float, cells: int) -> Array:
    """Return the eccentricity ratios of the nodes, (cells + 2,): the center, one beside it, and the others."""
    chi = node_eccentricities(largest_eccentricity_ratio, cells)
    return np.concatenate([[0.0, NEAR], chi[1:]])


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
