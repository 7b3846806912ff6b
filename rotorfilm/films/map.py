"""The impedance map as a film law: solver accuracy at the price of a table look-up."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files

import numpy as np

from ..errors import FilmContactError, InputError, RotorfilmError, UndefinedDerivativeError, ValidityWarning
from ..model import Array
from ..native import JournalKernel, MapKernel, Status
from ..native.kernels import Batch
from .map_own import OWN_RANGE, bearing_table
from .map_table import MapTable

TABLE = "journal_map.bin"
"""The universal table of the package, in `films/data`."""


@dataclass(frozen=True)
class MapFilm:
    """Finite-length film with Reynolds rupture, from a table of its dissipation potential.

    The film minimizes a functional, so its force is F = dJ/dw of the minimum J(e, w): the damping matrix
    -dF/dw is symmetric, and the force is smooth through the center. Evaluated in C with exact derivatives
    (`native/map_kernel.h`).

    Beyond the last node of the table (eccentricity ratio .999 in the packaged one) J is continued as a
    power of X, without proof of its accuracy: a ValidityWarning says so.

    Parameters
    ----------
    table : MapTable, optional
        The potential; by default the table of the package, for the full film without grooves. It holds
        length/diameter .1 to 4; a bearing outside gets a table of its own at its first force, in about ten
        seconds, kept in memory (`bearing_table`, which is also the way to save one).
    """

    table: MapTable | None = None

    @property
    def slenderness_range(self) -> tuple[float, float]:
        """Smallest and largest length/diameter that this film takes."""
        return OWN_RANGE if self.table is None else self.table.slenderness_range

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force on the journal, shape (2, ...); see `FilmLaw.force`.

        Raises
        ------
        InputError
            If the slenderness is outside the table, or a state is not finite.
        FilmContactError
            If an eccentricity ratio is not below 1.
        """
        batch = self._kernel(slenderness).force(eccentricity.reshape(2, -1), source.reshape(2, -1))
        report_batch(batch, np.hypot(*eccentricity.reshape(2, -1)))
        return batch.values.reshape(eccentricity.shape)

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`.

        Raises
        ------
        InputError, FilmContactError
            As in `force`.
        UndefinedDerivativeError
            Where the source vanishes off the center.
        """
        batch = self._kernel(slenderness).jacobian(eccentricity.reshape(2, -1), source.reshape(2, -1))
        report_batch(batch, np.hypot(*eccentricity.reshape(2, -1)))
        return batch.values.reshape(2, 4, *eccentricity.shape[1:])

    def bind(self, *, slenderness: float, clearance: float, force_scale: float) -> BoundMap:
        """Return this film in one bearing, in SI units; see `law.BindableFilm`."""
        return BoundMap(JournalKernel(self._kernel(slenderness), clearance, force_scale), clearance)

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]]:
        """Return the kernel and its tables; see `law.NativeFilm`."""
        table = self._table(slenderness)
        return "journal", {
            "coefficients": table.coefficients,
            "center": table.center,
            "range": np.array(table.slenderness_range),
            "reach": np.array([table.reach]),
        }

    def tabulated(self, slenderness: float) -> MapFilm:
        """Return this film with the table that it would make; see `law.TabulatedFilm`."""
        table = self._table(slenderness)
        return self if self.table is not None or table is packaged_table() else MapFilm(table)

    def _table(self, slenderness: float) -> MapTable:
        return _table_for(slenderness) if self.table is None else self.table

    def _kernel(self, slenderness: float) -> MapKernel:
        return _collapsed(self._table(slenderness), float(slenderness))


@dataclass(frozen=True, eq=False)
class BoundMap:
    """The map of one bearing in SI units: `law.BoundFilm` over the C kernel.

    Parameters
    ----------
    kernel : JournalKernel
        The compiled film of the bearing.
    clearance : float [m]
        Its radial clearance.
    """

    kernel: JournalKernel
    clearance: float

    def call(self, x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
        """Return (force_x, force_y) [N] for numbers, as fast as Python can ask."""
        force_x, force_y, status = self.kernel.call(x, y, vx, vy, speed)
        if status:
            _report_at(status, np.hypot(x, y) / self.clearance, self.clearance)
        return force_x, force_y

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float]]:
        """Return (force_x, force_y) [N] and the ten entries of the Jacobian, row by row, for numbers."""
        force_x, force_y, derivatives, status = self.kernel.tangent(x, y, vx, vy, speed)
        if status:
            _report_at(status, np.hypot(x, y) / self.clearance, self.clearance)
        return force_x, force_y, derivatives

    def force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the force [N], shape (2, ...)."""
        if position.ndim == 1:
            x, y = position.tolist()
            vx, vy = velocity.tolist()
            return np.array(self.call(x, y, vx, vy, float(speed)))
        rows = position.reshape(2, -1)
        batch = self.kernel.force(rows, velocity.reshape(2, -1), speed.ravel())
        self._report(batch, rows)
        return batch.values.reshape(position.shape)

    def jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5, ...)."""
        if position.ndim == 1:
            x, y = position.tolist()
            vx, vy = velocity.tolist()
            return np.array(self.tangent(x, y, vx, vy, float(speed))[2]).reshape(2, 5)
        rows = position.reshape(2, -1)
        batch = self.kernel.jacobian(rows, velocity.reshape(2, -1), speed.ravel())
        self._report(batch, rows)
        return batch.values.reshape(2, 5, *position.shape[1:])

    def _report(self, batch: Batch, rows: Array) -> None:
        if batch.status:
            chi = np.hypot(*rows) / self.clearance
            at = np.argmax(chi) if batch.status == Status.CONTACT else batch.first
            _report_at(batch.status, chi[at], self.clearance)


@lru_cache(maxsize=1)
def packaged_table() -> MapTable:
    """Return the universal table that comes with the package.

    Raises
    ------
    RotorfilmError
        If it is missing or damaged.
    """
    package = __package__ or ""
    try:
        content = files(package).joinpath("data", TABLE).read_bytes()
    except OSError as error:
        raise RotorfilmError(f"the map table {TABLE} of the package is missing: {error}") from error
    return MapTable.from_bytes(content)


def _table_for(slenderness: float) -> MapTable:
    table = packaged_table()
    return table if table.holds(slenderness) else bearing_table(float(slenderness))


@lru_cache(maxsize=64)
def _collapsed(table: MapTable, slenderness: float) -> MapKernel:
    return MapKernel(*table.at(slenderness))


def report_batch(batch: Batch, chi: Array) -> None:
    """Raise, or warn, about the most severe status of a batch with eccentricity ratios chi (n,)."""
    if batch.status:
        _report_at(batch.status, chi[batch.first])


def _report_at(status: int, chi: float, clearance: float = 1.0) -> None:
    """Raise, or warn, about the state at eccentricity ratio chi that has this status."""
    if status == Status.NOT_FINITE:
        raise InputError(f"position, velocity and speed must be finite and not overflow, got ratio {chi:.6g}")
    if status == Status.CONTACT:
        raise FilmContactError(
            f"position must keep the journal inside the clearance {clearance!r} m, "
            f"got an eccentricity of {chi * clearance:.6g} m"
        )
    if status == Status.UNDEFINED:
        raise UndefinedDerivativeError(
            "source w = velocity/clearance - (speed/2) z^ x eccentricity must not vanish where a "
            f"derivative is asked for, got w = 0 at eccentricity ratio {chi:.6g}"
        )
    warnings.warn(
        f"eccentricity ratio {chi:.6g} is beyond the map of the film; its force is extrapolated there",
        ValidityWarning,
        stacklevel=4,
    )
