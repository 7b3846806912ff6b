"""The impedance map as a film law: solver accuracy at the price of a table look-up."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from ....errors import RotorfilmError, require_kind
from ....inputs.si_arguments import quantities
from ....model import Array
from ....native import MapKernel
from ....native.loss_kernels import LossKernel
from ...films.film_losses import FilmLosses, plain_losses
from ...films.kernel_film import KernelFilm
from ...films.law import require_film
from ...films.map_table import MapTable
from .loss_table import packaged_kernel
from .own_tables import OWN_RANGE, bearing_table, reference_film

TABLE = "journal_map.bin"
"""The universal table of the package, in `films/data`."""


@quantities
@dataclass(frozen=True)
class MapFilm(KernelFilm):
    """Finite-length film with Reynolds rupture, from a table of its dissipation potential.

    The film minimizes a functional, so its force is F = dJ/dw of the minimum J(e, w): the damping matrix
    -dF/dw is symmetric, and the force is smooth through the center. Evaluated in C with exact derivatives
    (`native/films/map_kernel.h`).

    Error of a force with the packaged table, 99 % of random states to eccentricity ratio .999: 2e-4; 2e-3 for
    static journals at .999. Beyond the last node, .999, J goes on as the film at the wall
    (`native/films/wall.h`), with a ValidityWarning that states the error: 2 % at most, .2 % for
    static journals to .99999. The table of a film that has another limit goes on as a power of X, with an
    unknown error.

    Parameters
    ----------
    table : MapTable, optional
        The potential of a plain bearing; by default the table of the package. It holds length/diameter .1
        to 4; a bearing outside gets a table of its own at its first force, in about half a minute, kept
        in memory (`bearing_table`, which is also the way to save one). A bearing with openings gets a
        `GroovedMapFilm`, which takes up to a minute at the first force and is kept on disk.

    Raises
    ------
    InputError
        If the table is no MapTable.
    """

    table: MapTable | None = None

    def __post_init__(self) -> None:
        require_kind("table", self.table, MapTable | None, "a MapTable")

    @property
    def slenderness_range(self) -> tuple[float, float]:
        """Smallest and largest length/diameter that this film takes in a plain bearing."""
        return OWN_RANGE if self.table is None else self.table.slenderness_range

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]]:
        """Return the kernel and its tables; see `FilmOptions`."""
        table = self._table(slenderness)
        return "journal", {
            "coefficients": table.coefficients,
            "center": table.log_center,
            "range": np.array(table.slenderness_range),
            "reach": np.array([table.reach]),
        }

    def tabulated(self, slenderness: float) -> MapFilm:
        """Return this film with the table that it would make; see `FilmOptions`."""
        table = self._table(slenderness)
        return self if self.table is not None or table is packaged_table() else MapFilm(table)

    def losses(self, e: Array, w: Array, slenderness: float, rate: Array | None = None) -> FilmLosses:
        """Return shear and flow from the tables of the package, with slopes; see `FilmOptions`.

        A bearing of another length/diameter has those of the two-dimensional film that its own map is made
        of, without slopes.
        """
        require_film(e.reshape(2, -1))
        kernel = packaged_kernel(float(slenderness))
        if kernel is None:
            return reference_film(slenderness).losses(e, w, slenderness)
        return plain_losses(kernel, e, w)

    def loss_kernel(self, slenderness: float) -> LossKernel | None:
        """Return the losses of the tables of the package; None for a bearing beyond them."""
        return packaged_kernel(float(slenderness))

    def _table(self, slenderness: float) -> MapTable:
        return _table_for(slenderness) if self.table is None else self.table

    def _kernel(self, slenderness: float) -> MapKernel:
        return _collapsed(self._table(slenderness), float(slenderness))


@lru_cache(maxsize=1)
def packaged_table() -> MapTable:
    """Return the universal table that comes with the package.

    Raises
    ------
    RotorfilmError
        If it is missing or damaged.
    """
    try:
        content = Path(__file__).with_name("data").joinpath(TABLE).read_bytes()
    except OSError as error:
        raise RotorfilmError(f"the map table {TABLE} of the package is missing: {error}") from error
    return MapTable.from_bytes(content)


def _table_for(slenderness: float) -> MapTable:
    table = packaged_table()
    return table if table.holds(slenderness) else bearing_table(float(slenderness))


@lru_cache(maxsize=64)
def _collapsed(table: MapTable, slenderness: float) -> MapKernel:
    return MapKernel(*table.at(slenderness), slenderness)
