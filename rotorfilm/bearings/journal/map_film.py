"""The impedance map as a film law: solver accuracy at the price of a table look-up."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from ...core.errors import InputError, RotorfilmError, require_kind
from ...core.inputs import quantities
from ...core.model import Array
from ...native import MapKernel
from ...native.loss_kernels import LossKernel
from ..films.law import FilmLosses, KernelFilm, kernel_losses, require_film
from ..films.map_table import MapTable, StoredTable, require_shapes

if TYPE_CHECKING:
    from .reynolds_film import ExtrapolatedFilm, ReynoldsFilm

TABLE = "journal_map.bin"
"""The universal table of the package, in `data`."""

Table = TypeVar("Table", bound=StoredTable)


@quantities
@dataclass(frozen=True)
class MapFilm(KernelFilm):
    """Finite-length film with Reynolds rupture, from a table of its dissipation potential.

    The film minimizes a functional, so its force is F = dJ/dw of the minimum J(e, w): the damping matrix
    -dF/dw is symmetric, and the force is smooth through the center. Evaluated in C with exact derivatives
    (`native/films/map_kernel.h`).

    The packaged table has a force error of 2e-4 (99 % of random states up to eccentricity ratio 0.999), and
    of 2e-3 for static journals at 0.999. Beyond the last node, 0.999, J continues as the asymptotic film at
    the wall (`native/films/wall.h`), with a ValidityWarning that states the error: 2 % at most, and 0.2 % for
    static journals up to 0.99999. A table with another limit continues as a power of X, with an unknown
    error.

    Parameters
    ----------
    table : MapTable, optional
        The potential of a plain bearing; by default the table of the package. It covers length/diameter from
        0.1 to 4. A bearing outside this range makes its own table at its first force, in about half a minute,
        and keeps it in memory; `bearing_table` makes a table that can be saved. A bearing with openings gets
        a `GroovedMapFilm`, which takes up to a minute at the first force and is kept on disk.

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
            "map": np.array([table.reach]),
        }

    def tabulated(self, slenderness: float) -> MapFilm:
        """Return this film with the table that it would make; see `FilmOptions`."""
        table = self._table(slenderness)
        return self if self.table is not None or table is packaged_table() else MapFilm(table)

    def losses(self, e: Array, w: Array, slenderness: float, rate: Array | None = None) -> FilmLosses:
        """Return shear and flow from the tables of the package, with slopes; see `FilmOptions`.

        A bearing with a length/diameter outside the table uses the two-dimensional film of its own map,
        without derivatives.
        """
        require_film(e.reshape(2, -1))
        kernel = packaged_kernel(float(slenderness))
        if kernel is None:
            return reference_film(slenderness).losses(e, w, slenderness)
        return kernel_losses(kernel, e, w)

    def loss_kernel(self, slenderness: float) -> LossKernel | None:
        """Return the losses of the tables of the package; None for a bearing beyond them."""
        return packaged_kernel(float(slenderness))

    def _table(self, slenderness: float) -> MapTable:
        return _table_for(slenderness) if self.table is None else self.table

    def _kernel(self, slenderness: float) -> MapKernel:
        return _collapsed(self._table(slenderness), float(slenderness))


def packaged(kind: type[Table], name: str) -> Table:
    """Return a table that comes with the package; RotorfilmError if it is missing or damaged."""
    try:
        content = Path(__file__).with_name("data").joinpath(name).read_bytes()
    except OSError as error:
        raise RotorfilmError(f"the table {name} of the package is missing: {error}") from error
    return kind.from_bytes(content)


@lru_cache(maxsize=1)
def packaged_table() -> MapTable:
    """Return the universal table of the package; see `packaged` for the errors."""
    return packaged(MapTable, TABLE)


def _table_for(slenderness: float) -> MapTable:
    table = packaged_table()
    return table if table.holds(slenderness) else bearing_table(float(slenderness))


@lru_cache(maxsize=64)
def _collapsed(table: MapTable, slenderness: float) -> MapKernel:
    return table.kernel(slenderness, (slenderness, 1.0))


# Tables of single bearings that the packaged table leaves out: very short ones and long ones.
#
# A short film near the wall has ends as wide as it is long, and a long one closes its dry gap and
# then carries pressure all round, where `potential` fails. The two-dimensional film meets both: its J
# = (F . w)/2, extrapolated from two grids, has a smaller error than its force.


OWN_RANGE = (0.001, 20.0)
"""Length/diameter for which a table can be made; beyond, the layers at the ends get too thin for the grid."""

TABLE_CELLS = (24, 96, 0)
REACH = 0.999
_SHORT, _LONG = (384, 16), (192, 24)


@dataclass(frozen=True)
class _TwoFilms:
    """A film, and a finer one where the journal leaves the wall: it is then opposite, where lines are few."""

    towards: ExtrapolatedFilm
    away: ExtrapolatedFilm

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        leaving = (eccentricity * source).sum(axis=0) < 0.0
        force = np.empty_like(source)
        for film, mine in ((self.towards, ~leaving), (self.away, leaving)):
            force[:, mine] = film.force(eccentricity[:, mine], source[:, mine], slenderness)
        return force


def _film(around: int, along: int) -> _TwoFilms:
    from .reynolds_film import ExtrapolatedFilm, ReynoldsFilm

    films = (ExtrapolatedFilm(film=ReynoldsFilm(cells=(k * around, along))) for k in (1, 2))
    return _TwoFilms(*films)


def reference_film(slenderness: float) -> ReynoldsFilm:
    """Return the two-dimensional film of a bearing that the packaged table leaves out."""
    from .reynolds_film import ReynoldsFilm

    return ReynoldsFilm(cells=_SHORT if slenderness < 1.0 else _LONG)


@lru_cache(maxsize=16)
def bearing_table(slenderness: float) -> MapTable:
    """Return the table of the full film with Reynolds rupture for one length/diameter, in half a minute.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter, 0.001 to 20.

    Returns
    -------
    MapTable
        Largest error of a force in nine directions, length/diameter 0.05 and 8: 3e-4 at eccentricity ratio
        0.95, 7e-4 at 0.985, 3e-3 at 0.995 and 0.999.

    Raises
    ------
    InputError
        If the slenderness is outside its range.
    """
    import logging

    from ..films.map_fit import tabulate_film

    low, high = OWN_RANGE
    if not low <= slenderness <= high:
        raise InputError(f"length/diameter must be {low:g} to {high:g} for a map, got {slenderness!r}")
    logging.getLogger(__name__).warning(
        "length/diameter %.6g is outside the table of the package: making one for it, in about half a minute",
        slenderness,
    )
    return tabulate_film(
        _film(*(_SHORT if slenderness < 1.0 else _LONG)),
        slenderness_range=(slenderness, slenderness),
        cells=TABLE_CELLS,
        largest_eccentricity_ratio=REACH,
    )


# Shear and flow of every plain journal bearing as three tables beside that of the potential.
#
# With X and S = ln(L/D) as in `films/map_table.py`, the tables hold
#
#     ln(sqrt(1 - chi^2) Sigma_f),   ln(sqrt(1 - chi^2) (Sigma_f + Sigma_r)),   ln(flow/|w|),
#     each as L0(S) + chi M(X, s, S),   tan s = CROWDING tan beta,
#
# `Sigma_f` being the shear integral of the film, `Sigma_r` that of the streamers
# (`films/law.py`), and beta in [0, pi] the angle between eccentricity and source. The
# streamers follow the end at which the film is torn, so that their table has kinks at the center and
# where beta is 0 or pi: it is fitted from one side. The others are even in beta.


LOSS_FILE = "journal_losses.bin"
"""The table of the package, in `data`."""

CROWDING = 0.6
"""Ratio of tan s and tan beta: crowds the nodes where the source is across, as the film turns there."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LossTable(MapTable):
    """Shear and flow of films over eccentricity, direction and slenderness, each as a map of its own.

    Parameters
    ----------
    slenderness_range : (float, float) [1]
        Smallest and largest length/diameter.
    reach : float [1]
        X of the last node; beyond it all are powers of X.
    log_center : ndarray, shape (s, 3)
        Log center of ln(g Sigma_f), ln(g (Sigma_f + Sigma_r)) and ln(flow/|w|).
    coefficients : ndarray, shape (s, 3, cells_x + 5, cells_s + 5)
        Spline coefficients of M over ln(L/D), of the three, over X and over s.

    Raises
    ------
    InputError
        If the sizes do not fit each other or an entry is not finite.
    """

    def _require_shapes(self, count: int) -> None:
        require_shapes(self, log_center=(count, 3), coefficients=(count, 3, None, None))

    def losses(self, slenderness: float) -> LossKernel:
        """Return the compiled losses of one bearing; InputError if the table does not hold it."""
        own, center = self.at(slenderness)
        return LossKernel({"loss_coefficients": own, "loss_map": [self.reach, CROWDING, *center]})


@lru_cache(maxsize=1)
def packaged_losses() -> LossTable:
    """Return the losses of the package; see `packaged` for the errors."""
    return packaged(LossTable, LOSS_FILE)


@lru_cache(maxsize=64)
def packaged_kernel(slenderness: float) -> LossKernel | None:
    """Return the losses of one plain bearing; None where the table of the package does not hold it."""
    table = packaged_losses()
    return table.losses(slenderness) if table.holds(slenderness) else None
