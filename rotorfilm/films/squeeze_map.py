"""A cavitated squeeze film as an impedance map: its potential in a table of its own, evaluated in C.

Without feed the film is the gradient of a potential of degree two in the velocity (docs/map.md), leakage into
the layer included, because Darcy's law is linear and symmetric. So the journal's map and kernel serve a
damper too.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from ..errors import InputError
from ..model import Array
from .map import BoundMap, MapFilm
from .map_fit import fit_map_table, node_eccentricities, tabulate_film
from .map_table import MapTable
from .porous_layer import PorousLayer, layer_modes
from .squeeze import SqueezeFilm
from .squeeze_arc import CavitatedSqueezeFilm
from .squeeze_laws import SqueezeCase
from .squeeze_potential import CavitatedPotential

LARGEST_FINITE = 0.985

LARGEST = 0.99
"""Eccentricity ratio of the table's last node; beyond, the kernel extrapolates and a warning says so."""


@dataclass(frozen=True)
class MapSqueeze:
    """Cavitated short film from a table: within 1e-4 of `ShortSqueeze()`, some hundred times faster alone.

    The table is made at the first use of a damper and kept for dampers of the same layer.

    Parameters
    ----------
    cells : tuple of int
        Cells of the table over the eccentricity ratio and over the direction of the velocity.
    """

    slenderness_limit: ClassVar[float] = 0.25
    largest_eccentricity_ratio: ClassVar[float] = LARGEST

    cells: tuple[int, int] = (24, 48)

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for a full film or one with feed."""
        _require_potential(self, case)
        return MappedSqueezeFilm(MapFilm(_table(case.layer, self.cells)))


@dataclass(frozen=True)
class FiniteMapSqueeze:
    """Cavitated film of finite length from a table of its potential, flow around the circumference included.

    The table takes some seconds for a damper and is kept; L/D to 2, eccentricity ratio to 0.985.

    Parameters
    ----------
    cells : tuple of int
        Cells of the table over the eccentricity ratio and over the direction of the velocity.
    """

    largest_eccentricity_ratio: ClassVar[float] = LARGEST_FINITE

    cells: tuple[int, int] = (16, 32)

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for a full film or one with feed."""
        _require_potential(self, case)
        return MappedSqueezeFilm(MapFilm(_finite_table(case.slenderness, case.layer, self.cells)))


@dataclass(frozen=True)
class MappedSqueezeFilm:
    """A squeeze film on the journal's map: its source is the rate.

    Parameters
    ----------
    film : MapFilm
        With a table for one slenderness, `_RATIO`, in units of a squeeze film.
    """

    _RATIO: ClassVar[float] = 1.0

    film: MapFilm

    def bound(self, *, clearance: float, force_scale: float) -> BoundMap:
        """Return the film of one damper in SI units, in C.

        Its speed must be 0, since a damper has no wedge.
        """
        return self.film.bind(slenderness=self._RATIO, clearance=clearance, force_scale=force_scale)

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        return self.film.force(eccentricity, rate, self._RATIO)

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`.

        Raises
        ------
        UndefinedDerivativeError
            Where the rotor is at rest off the center.
        """
        return self.film.jacobian(eccentricity, rate, self._RATIO)


def _require_potential(law: MapSqueeze | FiniteMapSqueeze, case: SqueezeCase) -> None:
    name = f"{type(law).__name__}()"
    if not case.cavitated:
        raise InputError(f"extent must be HalfSommerfeld() for {name}, got a full film")
    if np.any(case.feed) or np.any(case.ends):
        raise InputError(f"feed must be None for {name}: a film with feed has no potential to tabulate")


@lru_cache(maxsize=16)
def _finite_table(slenderness: float, layer: PorousLayer | None, cells: tuple[int, int]) -> MapTable:
    potential = CavitatedPotential(slenderness, layer)
    headings = np.arccos(np.linspace(-1.0, 1.0, cells[1] + 1))
    nodes = node_eccentricities(LARGEST_FINITE, cells[0])
    logs = [[np.log(-potential(float(eps), float(turn))) for turn in headings] for eps in nodes[1:]]
    center = np.full(headings.size, np.log(-potential(0.0, 0.0)))
    ratio = MappedSqueezeFilm._RATIO
    return fit_map_table(
        np.array([[center, *logs]]),
        slenderness_range=(ratio, ratio),
        largest_eccentricity_ratio=LARGEST_FINITE,
    )


@lru_cache(maxsize=32)
def _table(layer: PorousLayer | None, cells: tuple[int, int]) -> MapTable:
    film = _AsJournalFilm(CavitatedSqueezeFilm(layer_modes(layer)))
    ratio = MappedSqueezeFilm._RATIO
    return tabulate_film(
        film, slenderness_range=(ratio, ratio), cells=(*cells, 0), largest_eccentricity_ratio=LARGEST
    )


@dataclass(frozen=True)
class _AsJournalFilm:
    """A squeeze film under the protocol of journal films, whatever the slenderness."""

    film: SqueezeFilm

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        return self.film.force(eccentricity, source)

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        return self.film.jacobian(eccentricity, source)
