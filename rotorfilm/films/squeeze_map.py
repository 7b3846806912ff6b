"""Squeeze films as impedance maps: the potential in a table of its own, evaluated in C.

Without feed the film is the gradient of a potential of degree two in the velocity (docs/map.md), leakage into
the layer included, because Darcy's law is linear and symmetric. So the journal's map and kernel serve a
damper too.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from ..errors import InputError
from ..model import Array
from .kernel_film import BoundKernel
from .map import MapFilm
from .squeeze import SqueezeFilm
from .squeeze_laws import SqueezeCase
from .squeeze_table import LARGEST, LARGEST_FINITE, RATIO, SqueezeTable, finite_table, short_table


@runtime_checkable
class TabulatedSqueeze(Protocol):
    """A squeeze law that makes a table on first use."""

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; see `SqueezeLaw`."""

    def tabulated(self, case: SqueezeCase) -> TabulatedSqueeze:
        """Return the same law with the table that it would make in this damper."""


@dataclass(frozen=True)
class MapSqueeze:
    """Short film from a table: within 1e-4 of `ShortSqueeze()`, some hundred times faster alone.

    The table is made at the first use of a damper and kept in memory for dampers of the same layer.

    Parameters
    ----------
    cells : tuple of int
        Cells of the table over the eccentricity ratio and over the direction of the velocity; a full film
        takes three times as many of the latter.
    table : SqueezeTable, optional
        Of this damper, as `tabulated` gives it; made by default.
    """

    slenderness_limit: ClassVar[float] = 0.25
    largest_eccentricity_ratio: ClassVar[float] = LARGEST

    cells: tuple[int, int] = (24, 48)
    table: SqueezeTable | None = None

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for one with feed."""
        _require_potential(self, case)
        return MappedSqueezeFilm(MapFilm(self._table(case).table), one_slenderness=False)

    def tabulated(self, case: SqueezeCase) -> MapSqueeze:
        """Return this law with the table of one damper; see `TabulatedSqueeze`."""
        return replace(self, table=self._table(case))

    def _table(self, case: SqueezeCase) -> SqueezeTable:
        if self.table is None:
            return short_table(case.layer, case.cavitated, self.cells)
        return self.table.required(None, case.layer, case.cavitated)


@dataclass(frozen=True)
class FiniteMapSqueeze:
    """Film of finite length from a table of its potential, flow around the circumference included.

    The table takes some seconds for a damper and is kept on disk; L/D to 2, eccentricity ratio to 0.985.

    Parameters
    ----------
    cells : tuple of int
        Cells of the table over the eccentricity ratio and over the direction of the velocity; a full film
        takes three times as many of the latter.
    table : SqueezeTable, optional
        Of this damper, as `tabulated` gives it; made, or found on disk, by default.
    """

    largest_eccentricity_ratio: ClassVar[float] = LARGEST_FINITE

    cells: tuple[int, int] = (16, 32)
    table: SqueezeTable | None = None

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for one with feed."""
        _require_potential(self, case)
        return MappedSqueezeFilm(MapFilm(self._table(case).table), one_slenderness=True)

    def tabulated(self, case: SqueezeCase) -> FiniteMapSqueeze:
        """Return this law with the table of one damper; see `TabulatedSqueeze`."""
        return replace(self, table=self._table(case))

    def _table(self, case: SqueezeCase) -> SqueezeTable:
        if self.table is None:
            return finite_table(case.slenderness, case.layer, case.cavitated, self.cells)
        return self.table.required(case.slenderness, case.layer, case.cavitated)


@dataclass(frozen=True)
class MappedSqueezeFilm:
    """A squeeze film on the journal's map: its source is the rate.

    Parameters
    ----------
    film : MapFilm
        With a table for one slenderness, `RATIO`, in units of a squeeze film.
    one_slenderness : bool
        Whether the table is that of one length / diameter only, as that of a film of finite length.
    """

    film: MapFilm
    one_slenderness: bool

    def bound(self, *, clearance: float, force_scale: float) -> BoundKernel:
        """Return the film of one damper in SI units, in C.

        Its speed must be 0, since a damper has no wedge.
        """
        return self.film.bind(slenderness=RATIO, clearance=clearance, force_scale=force_scale)

    def native_tables(self) -> Mapping[str, Array]:
        """Return the tables of the kernel "damper"."""
        tables = dict(self.film.native(RATIO)[1])
        return {name: tables[name] for name in ("center", "reach")} | {
            "coefficients": tables["coefficients"][0]
        }

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        return self.film.force(eccentricity, rate, RATIO)

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`.

        Raises
        ------
        UndefinedDerivativeError
            Where the rotor is at rest off the center.
        """
        return self.film.jacobian(eccentricity, rate, RATIO)


def _require_potential(law: MapSqueeze | FiniteMapSqueeze, case: SqueezeCase) -> None:
    if np.any(case.feed) or (case.cavitated and np.any(case.ends)):
        raise InputError(
            f"feed must be None for {type(law).__name__}(): a film with feed has no potential to tabulate"
        )
