"""Squeeze films as impedance maps: the potential in a table of its own, evaluated in C.

Without feed the film is the gradient of a potential of degree two in the velocity (docs/map.md), leakage into
the layer included, because Darcy's law is linear and symmetric. So the journal's map and kernel serve a
damper too.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import ClassVar

import numpy as np

from ...errors import InputError
from ...inputs.si_arguments import quantities
from ...model import Array
from ...native import MapKernel
from ..films.kernel_film import BoundKernel
from ..films.map_table import MapTable
from ..journal import MapFilm
from .built.film_inertia import FilmInertia
from .full_squeeze import SqueezeFilm
from .squeeze_laws import (
    SqueezeCase,
    SqueezeOptions,
    finite_film_inertia,
    sealed_short,
    short_film_inertia,
)
from .squeeze_table import LARGEST, LARGEST_FINITE, RATIO, SqueezeTable, finite_table, short_table

SHORT = 1e-6
"""Length / diameter of a short film, at the wall too."""


@quantities
@dataclass(frozen=True)
class MapSqueeze(SqueezeOptions):
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
    """Largest length / diameter for which the film is meant [1]."""
    largest_eccentricity_ratio: ClassVar[float] = LARGEST
    """Eccentricity ratio to which the film is meant [1]."""

    cells: tuple[int, int] = (24, 48)
    table: SqueezeTable | None = None

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for one with feed."""
        _require_potential(self, case)
        film = MappedSqueezeFilm(_squeeze_map(self._table(case), SHORT), one_slenderness=False)
        return sealed_short(film, case)

    def inertia(self, case: SqueezeCase) -> FilmInertia:
        """Return the inertia of the film of one damper; see `SqueezeOptions`."""
        return short_film_inertia(case)

    def tabulated(self, case: SqueezeCase) -> MapSqueeze:
        """Return this law with the table of one damper; see `SqueezeOptions`."""
        return replace(self, table=self._table(case))

    def _table(self, case: SqueezeCase) -> SqueezeTable:
        if self.table is None:
            return short_table(case.layer, case.cavitated, self.cells)
        return self.table.required(None, case.layer, case.cavitated)


@quantities
@dataclass(frozen=True)
class FiniteMapSqueeze(SqueezeOptions):
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
    """Eccentricity ratio to which the film is meant [1]."""

    cells: tuple[int, int] = (16, 32)
    table: SqueezeTable | None = None

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for one with feed or seals."""
        _require_potential(self, case)
        if case.is_sealed:
            raise InputError(
                "seals must be None for FiniteMapSqueeze(): FullFilm() with FiniteSqueeze() has them, and a "
                "short film"
            )
        return MappedSqueezeFilm(_squeeze_map(self._table(case), case.slenderness), one_slenderness=True)

    def inertia(self, case: SqueezeCase) -> FilmInertia:
        """Return the inertia of the film of one damper; see `SqueezeOptions`."""
        return finite_film_inertia(case)

    def tabulated(self, case: SqueezeCase) -> FiniteMapSqueeze:
        """Return this law with the table of one damper; see `SqueezeOptions`."""
        return replace(self, table=self._table(case))

    def _table(self, case: SqueezeCase) -> SqueezeTable:
        if self.table is None:
            return finite_table(case.slenderness, case.layer, case.cavitated, self.cells)
        return self.table.required(case.slenderness, case.layer, case.cavitated)


@dataclass(frozen=True)
class SqueezeMapFilm(MapFilm):
    """A map in units of a squeeze film.

    Parameters
    ----------
    wall : (float, float) [1]
        Length / diameter of the film at the wall, as which it goes on beyond the table, and that film's share
        in units of a journal; zeros where that is not its law.
    """

    wall: tuple[float, float] = (0.0, 0.0)

    def _kernel(self, slenderness: float) -> MapKernel:
        return _collapsed(self._table(slenderness), self.wall)


@lru_cache(maxsize=64)
def _collapsed(table: MapTable, wall: tuple[float, float]) -> MapKernel:
    return MapKernel(*table.at(RATIO), *wall)


@dataclass(frozen=True)
class MappedSqueezeFilm:
    """A squeeze film on the journal's map: its source is the rate.

    Parameters
    ----------
    film : SqueezeMapFilm
        With a table for one slenderness, `RATIO`, in units of a squeeze film.
    one_slenderness : bool
        Whether the table is that of one length / diameter only, as that of a film of finite length.
    """

    film: SqueezeMapFilm
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
            "coefficients": tables["coefficients"][0],
            "wall": np.array(self.film.wall),
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


def _squeeze_map(table: SqueezeTable, slenderness: float) -> SqueezeMapFilm:
    """Return the map of a table; a full film, or one on a porous layer, is another one at the wall."""
    journal = table.cavitated and table.layer is None
    return SqueezeMapFilm(table.table, (slenderness, 0.25 / slenderness**2) if journal else (0.0, 0.0))


def _require_potential(law: MapSqueeze | FiniteMapSqueeze, case: SqueezeCase) -> None:
    if np.any(case.feed) or (case.cavitated and np.any(case.ends)):
        raise InputError(
            f"feed must be None for {type(law).__name__}(): a film with feed has no potential to tabulate"
        )
