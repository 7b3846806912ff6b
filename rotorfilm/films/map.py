"""The impedance map as a film law: solver accuracy at the price of a table look-up."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import TYPE_CHECKING

import numpy as np

from ..errors import FilmContactError, InputError, RotorfilmError, require_inside, warn_user
from ..model import Array
from ..native import JournalKernel, MapKernel, Status
from ..native.kernels import Batch
from .geometry import FilmGeometry
from .law import vanishing_source
from .map_own import OWN_RANGE, bearing_table
from .map_table import MapTable

if TYPE_CHECKING:
    from .groove_map import GroovedMapFilm

TABLE = "journal_map.bin"
"""The universal table of the package, in `films/data`."""


class KernelFilm(ABC):
    """A film law over a compiled map: what `MapFilm` and `GroovedMapFilm` have in common."""

    @abstractmethod
    def _kernel(self, slenderness: float) -> MapKernel:
        """Return the compiled map of a bearing."""

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force on the journal, shape (2, ...); see `FilmLaw.force`.

        Raises
        ------
        InputError
            If the map is not for this slenderness, or a state is not finite.
        FilmContactError
            If an eccentricity ratio is not below 1.
        """
        e, w = eccentricity.reshape(2, -1), source.reshape(2, -1)
        batch = self._kernel(slenderness).force(e, w)
        _report_law(batch, e, w)
        return batch.values.reshape(eccentricity.shape)

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`.

        Raises
        ------
        InputError, FilmContactError
            As in `force`.
        UndefinedDerivativeError
            Where the source vanishes, in a plain bearing off the center only.
        """
        e, w = eccentricity.reshape(2, -1), source.reshape(2, -1)
        batch = self._kernel(slenderness).jacobian(e, w)
        _report_law(batch, e, w)
        return batch.values.reshape(2, 4, *eccentricity.shape[1:])

    def bind(self, *, slenderness: float, clearance: float, force_scale: float) -> BoundMap:
        """Return this film in one bearing, in SI units; see `law.BindableFilm`."""
        return BoundMap(JournalKernel(self._kernel(slenderness), clearance, force_scale), clearance)


@dataclass(frozen=True)
class MapFilm(KernelFilm):
    """Finite-length film with Reynolds rupture, from a table of its dissipation potential.

    The film minimizes a functional, so its force is F = dJ/dw of the minimum J(e, w): the damping matrix
    -dF/dw is symmetric, and the force is smooth through the center. Evaluated in C with exact derivatives
    (`native/map_kernel.h`).

    Beyond the last node of the table (eccentricity ratio .999 in the packaged one) J is continued as a
    power of X, without proof of its accuracy: a ValidityWarning says so.

    Parameters
    ----------
    table : MapTable, optional
        The potential of a plain bearing; by default the table of the package. It holds length/diameter .1
        to 4; a bearing outside gets a table of its own at its first force, in about ten seconds, kept in
        memory (`bearing_table`, which is also the way to save one). A bearing with openings gets a
        `GroovedMapFilm`, which takes up to a minute at the first force and is kept on disk.

    Raises
    ------
    InputError
        If the table is no MapTable.
    """

    table: MapTable | None = None

    def __post_init__(self) -> None:
        if self.table is not None and not isinstance(self.table, MapTable):
            raise InputError(f"table must be a MapTable, got {self.table!r}")

    @property
    def slenderness_range(self) -> tuple[float, float]:
        """Smallest and largest length/diameter that this film takes in a plain bearing."""
        return OWN_RANGE if self.table is None else self.table.slenderness_range

    def fitted(self, geometry: FilmGeometry) -> MapFilm | GroovedMapFilm:
        """Return this film in a plain bearing, and the `GroovedMapFilm` of one with openings.

        Raises
        ------
        InputError
            If there is a supply pressure, an opening wider than 60 deg, or the table of a plain bearing
            is given where there are openings.
        """
        if geometry.plain:
            return self
        if self.table is not None:
            raise InputError(
                "table must be that of the bearing, got a MapTable, which is for no openings; take MapFilm() "
                "or GroovedMapFilm(table=...)"
            )
        # Imported here because that film is a plain one where there is no opening.
        from .groove_map import GroovedMapFilm

        return GroovedMapFilm(geometry=geometry)

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]]:
        """Return the kernel and its tables; see `law.NativeFilm`."""
        table = self._table(slenderness)
        return "journal", {
            "coefficients": table.coefficients,
            "center": table.log_center,
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
            self._report(status, x, y, vx, vy, speed)
        return force_x, force_y

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float]]:
        """Return (force_x, force_y) [N] and the ten entries of the Jacobian, row by row, for numbers."""
        force_x, force_y, derivatives, status = self.kernel.tangent(x, y, vx, vy, speed)
        if status:
            self._report(status, x, y, vx, vy, speed)
        return force_x, force_y, derivatives

    def force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the force [N], shape (2, ...)."""
        if position.ndim == 1:
            x, y = position.tolist()
            vx, vy = velocity.tolist()
            return np.array(self.call(x, y, vx, vy, float(speed)))
        q, v, omega = position.reshape(2, -1), velocity.reshape(2, -1), speed.ravel()
        batch = self.kernel.force(q, v, omega)
        self._report_batch(batch, q, v, omega)
        return batch.values.reshape(position.shape)

    def jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5, ...)."""
        if position.ndim == 1:
            x, y = position.tolist()
            vx, vy = velocity.tolist()
            return np.array(self.tangent(x, y, vx, vy, float(speed))[2]).reshape(2, 5)
        q, v, omega = position.reshape(2, -1), velocity.reshape(2, -1), speed.ravel()
        batch = self.kernel.jacobian(q, v, omega)
        self._report_batch(batch, q, v, omega)
        return batch.values.reshape(2, 5, *position.shape[1:])

    def _report_batch(self, batch: Batch, q: Array, v: Array, omega: Array) -> None:
        if batch.status:
            at = np.argmax(np.hypot(*q)) if batch.status == Status.CONTACT else batch.first
            (x, y), (vx, vy) = q[:, at].tolist(), v[:, at].tolist()
            self._report(batch.status, x, y, vx, vy, float(np.broadcast_to(omega, q.shape[1:])[at]))

    def _report(self, status: int, x: float, y: float, vx: float, vy: float, speed: float) -> None:
        """Raise, or warn, about a state that has this status."""
        if status == Status.NOT_FINITE:
            raise InputError(
                "position, velocity and speed must be finite and not overflow, "
                f"got ({x!r}, {y!r}) m, ({vx!r}, {vy!r}) m/s and {speed!r} rad/s"
            )
        if status == Status.CONTACT:
            require_inside(np.array([x, y]), self.clearance)
        _report_film(status, float(np.hypot(x, y)) / self.clearance)


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


def _report_law(batch: Batch, e: Array, w: Array) -> None:
    """Raise, or warn, about the most severe status of a batch of eccentricities and sources (2, n)."""
    if not batch.status:
        return
    at = e[:, batch.first]
    if batch.status == Status.NOT_FINITE:
        raise InputError(
            "eccentricity and source must be finite and not overflow, "
            f"got {at.tolist()} and {w[:, batch.first].tolist()} 1/s"
        )
    _report_film(batch.status, float(np.hypot(*at)))


def _report_film(status: int, chi: float) -> None:
    if status == Status.CONTACT:
        raise FilmContactError(f"eccentricity ratio must be below 1, got {chi:.9g}")
    if status == Status.UNDEFINED:
        raise vanishing_source(chi)
    warn_user(f"eccentricity ratio {chi:.6g} is beyond the map of the film; its force is extrapolated there")
