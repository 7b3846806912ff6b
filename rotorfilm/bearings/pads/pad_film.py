"""The film laws of a pad, which bearings made of pads exchange."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from typing import Any, Protocol, runtime_checkable

import numpy as np

from ...core.errors import InputError, require_kind, require_number, warn_user
from ...core.inputs import quantities
from ...core.model import Array
from ...core.progress import Report, silent
from ...native import MapKernel
from ...native.film_kernels import FilmKernel
from ..films.finite_volumes import RingKernel, over_whole_length, require_cells
from ..films.law import beside_speed, continued
from ..films.map_fit import MapPlan, nine_digits
from ..films.map_growth import GrowthMap, require_map_law
from ..films.mobility import (
    Mobility,
    law_of,
    of_unit_density,
    per_rate,
    require_mobility,
    require_same_mobility,
    with_mobility,
)
from .pad_build import CELLS, FINE, NEAR, PadMap, PadResolution, pad_grid
from .pad_table import PadFlows, PadMapTable, grid_flows

SAME = 2e-9
"""Relative difference of extent and length/diameter below which a map is that of a pad."""

GROWTH: dict[str, Any] = {"cells": (48, 4), "nodes": (14, 14, 36)}
"""Cells and nodes of what the Reynolds number adds to a map."""

MUCH_PRELOAD = 0.5
"""Preload above which the default map goes on to thinner films."""


@runtime_checkable
class PadFilm(Protocol):
    """The film law of one pad with Reynolds rupture and ambient pressure at all its edges."""

    def kernel(self, extent: float, slenderness: float) -> FilmKernel:
        """Return the compiled film in the frame of a pad, whose middle is at the angle 0.

        Parameters
        ----------
        extent : float [rad]
            Angle that the pad covers.
        slenderness : float [1]
            Length / diameter.
        """


@quantities
@dataclass(frozen=True, kw_only=True)
class PadMapFilm:
    """The film of a pad from a map of a fine grid, about 500 times as fast as `PadGridFilm()`.

    Its force is within 1e-3 of that of the grid in 90 % of random states, and within 5e-3 in 99 %. These
    errors are relative to the force, or to 5 % of the largest force at that position where the force is
    smaller than that. Errors are largest where the journal nearly touches; `PadMapTable.bound` returns them.

    The force is the gradient of a tabulated potential (`native/films/map_kernel.h`), so that the damping
    matrix is symmetric and the derivatives are exact. All pads of one extent and length/diameter share a map,
    whatever their preload, offset and place. It is made in some seconds on first use, and kept in the folder
    that the environment variable ROTORFILM_CACHE names, or the platform's cache. Pads with a preload above
    0.5 get another default map, which covers minimum films down to 0.005 pad clearances instead of 0.03.

    Parameters
    ----------
    resolution : PadResolution
        Cells and nodes of the map.
    tables : tuple of PadMapTable
        Existing maps: pads of these shapes use them, without a search on disk.
    mobility : Mobility or None
        How easily the oil flows over the thickness of the film (`mobility_of`); None for laminar flow. The
        factor of its Couette flow is 1. With a density the map is over the Reynolds number too.
    reynolds_cells : int
        Cells over the Reynolds number of a turbulent film. With 0 a turbulent bearing takes `PadGridFilm()`.
        The map is then made in some 20 seconds; shear and flow are those of the film on the grid.
    reynolds_scale : float [m3/kg s]
        Radius times clearance over viscosity, set by the bearing where the mobility has a density.
    much_preload : bool
        Whether a pad has a preload above 0.5, which selects another default map. The bearing sets it.
    """

    resolution: PadResolution = FINE
    tables: tuple[PadMapTable, ...] = ()
    mobility: Mobility | None = None
    reynolds_cells: int = 0
    reynolds_scale: float = field(default=0.0, repr=False)
    much_preload: bool = field(default=False, repr=False)

    def __post_init__(self) -> None:
        require_map_law(self.mobility, self.reynolds_cells)

    def table(self, extent: float, slenderness: float, report: Report = silent) -> PadMapTable:
        """Return the map of a pad: a given one, the one on disk, or a new one, which is then kept.

        Parameters
        ----------
        extent : float [rad]
            Angle that the pad covers, 0.1 to 3.1.
        slenderness : float [1]
            Length / diameter, 0.05 to 20.
        report : callable, optional
            Called with the fraction done, 0 to 1, and a text while a map is being made.

        Raises
        ------
        InputError
            If an argument breaks its rule.
        """
        return self._given(extent, slenderness) or self._plan(extent, slenderness).kept(report)

    def at_scale(self, reynolds_scale: float) -> PadMapFilm:
        """Return this film in a bearing of this radius times clearance over viscosity [m3/kg s]."""
        return replace(self, reynolds_scale=reynolds_scale)

    @property
    def is_grown(self) -> bool:
        """Whether the map has the Reynolds number as a further axis."""
        return self.mobility is not None and self.mobility.density > 0.0

    def _plan(self, extent: float, slenderness: float) -> MapPlan[PadMapTable]:
        laminar = pad_map(extent, slenderness, self.own_resolution)
        law = law_of(self.mobility)
        if law is None or not self.is_grown:
            return laminar
        coarse = replace(laminar, resolution=replace(laminar.resolution, **GROWTH))
        return GrowthMap(laminar, coarse, law, self.reynolds_cells)

    def require_shape(self, extent: float, slenderness: float) -> None:
        """Raise InputError where there can be no map of pads of an extent [rad] and length/diameter."""
        if self._given(extent, slenderness, in_bearing=self.reynolds_cells > 0) is None:
            require_mappable(extent, slenderness)

    def _given(self, extent: float, slenderness: float, *, in_bearing: bool = False) -> PadMapTable | None:
        """Return the given map of a pad; one without a mobility may have that of the bearing it is in."""
        shape = np.array([extent, slenderness])
        for table in self.tables:
            if np.all(np.abs(np.array([table.extent, table.slenderness]) / shape - 1.0) < SAME):
                if self.mobility is not None or not in_bearing:
                    require_same_mobility(table.mobility, law_of(self.mobility))
                return table
        return None

    @property
    def own_resolution(self) -> PadResolution:
        """Cells and nodes of the map of these pads; the default depends on their preload."""
        near = self.much_preload and self.resolution == FINE
        mobility = None if self.is_grown else self.mobility
        return replace(NEAR if near else self.resolution, mobility=mobility)

    def losses(self, extent: float, slenderness: float) -> Callable[[Array, Array], PadFlows]:
        """Return shear and flow of a pad at rest from its maps; see `LossyPadFilm`."""
        if self.is_grown:
            own = PadGridFilm(mobility=self.mobility, reynolds_scale=self.reynolds_scale)
            return own.losses(extent, slenderness)
        return _table_of(self, float(extent), float(slenderness)).flows

    def making_time(self, extent: float, slenderness: float) -> float:
        """Return about how long making the map of a pad takes [s]; 0 where it is on disk."""
        return self._plan(extent, slenderness).making_time()

    def kernel(self, extent: float, slenderness: float) -> FilmKernel:
        """Return the compiled film of a pad; see `PadFilm`."""
        return _kernel_of(self, float(extent), float(slenderness))


@lru_cache(maxsize=64)
def _table_of(film: PadMapFilm, extent: float, slenderness: float) -> PadMapTable:
    return film.table(extent, slenderness)


@lru_cache(maxsize=64)
def _kernel_of(film: PadMapFilm, extent: float, slenderness: float) -> MapKernel:
    table = _table_of(of_unit_density(film), extent, slenderness)
    if not film.is_grown or film.mobility is None:
        return table.kernel()
    return table.kernel(per_rate(film.mobility, film.reynolds_scale), film.mobility.density)


@quantities
@dataclass(frozen=True, kw_only=True)
class PadGridFilm:
    """The two-dimensional film of a pad: Reynolds' equation by finite volumes, extrapolated from two grids.

    `PadMapFilm` explains how its errors are measured.

    Parameters
    ----------
    cells : (int, int)
        Cells along the pad and along half its length: multiples of 4, at least 16 and 4. The force is
        extrapolated from these cells and half as many. With 96 x 8 cells it is within 1e-3 in 99 % of random
        states.
    mobility : Mobility or None
        How easily the oil flows over the thickness of the film (`mobility_of`); None for laminar flow.
    reynolds_scale : float [m3/kg s]
        Radius times clearance over viscosity, set by the bearing where the mobility has a density.

    Raises
    ------
    InputError
        If the cells break their rule, or another argument is of the wrong kind.
    """

    cells: tuple[int, int] = CELLS
    mobility: Mobility | None = None
    reynolds_scale: float = field(default=0.0, repr=False)

    def __post_init__(self) -> None:
        require_cells(self.cells)
        require_mobility(self.mobility)

    def at_scale(self, reynolds_scale: float) -> PadGridFilm:
        """Return this film in a bearing of this radius times clearance over viscosity [m3/kg s]."""
        return replace(self, reynolds_scale=reynolds_scale)

    def kernel(self, extent: float, slenderness: float) -> FilmKernel:
        """Return the compiled film of a pad; see `PadFilm`."""
        return self._grid(extent, slenderness)

    def whole(self, extent: float, slenderness: float, profile: Callable[[Array], Array]) -> RingKernel:
        """Return the film of a pad over the whole length; see `over_whole_length` for the profile."""
        film = self._grid(extent, slenderness)
        return film.over(tuple(over_whole_length(grid, profile) for grid in film.grids))

    def losses(self, extent: float, slenderness: float) -> Callable[[Array, Array], PadFlows]:
        """Return shear and flow of a pad at rest; see `LossyPadFilm`."""
        return partial(grid_flows, self._grid(extent, slenderness))

    def _grid(self, extent: float, slenderness: float) -> RingKernel:
        own = (self.mobility, per_rate(self.mobility, self.reynolds_scale))
        return pad_grid(extent, slenderness, self.cells, *own)


def fitted_pad_film(
    film: PadFilm, preloads: Sequence[float], extents: Sequence[float], slenderness: float
) -> PadFilm:
    """Return a film law for pads of these preloads, extents [rad] and length/diameter.

    The range of a map is in clearances of a pad, of which the assembled clearance is a small part where a pad
    has much preload: there the default map goes on to thinner films. What is default stays so, that pads of
    another preload choose anew.

    Raises
    ------
    InputError
        If `film` is no film law of such pads.
    """
    require_kind("film", film, PadFilm, "a film law of pads, as PadMapFilm()")
    if not isinstance(film, PadMapFilm):
        return film
    for extent in extents:
        film.require_shape(extent, slenderness)
    return replace(film, much_preload=max(preloads) > MUCH_PRELOAD)


def with_pad_tables(bearing: Any) -> Any:
    """Return a bearing whose film carries the maps of its pads; see `core.port.Reaction`."""
    film = bearing.film
    if not isinstance(film, PadMapFilm):
        return bearing
    own: PadMapFilm = with_mobility(film, bearing.turbulent_mobility)
    tables = tuple(own.table(extent, bearing.slenderness) for extent in dict.fromkeys(bearing.extents))
    return replace(bearing, film=replace(film, tables=tables))


def least_films(films: Iterable[float]) -> str:
    """Return the words for the least film on each pad [m]."""
    return f"least films of {', '.join(f'{film:.3g}' for film in films)} m"


def warn_beyond_map(where: str, kernel: FilmKernel) -> None:
    """Warn that films, named by words in the plural, are beyond the map of a pad."""
    warn_user(f"{where}{beside_speed(kernel)} are beyond the map of a pad; its force is {continued(kernel)}")


# The film on one pad from its map: made in seconds, kept on disk, the same for all pads of one shape.
#
# Forces, frame and units are those of `pad_grid`: preload, offset, pivot and orientation of a pad are
# a place and a turn of its frame, so that pads of one extent and length/diameter share a map.


EXTENTS = (0.1, 3.1)
"""Angles that a pad with a map may cover [rad]."""

SLENDERNESSES = (0.05, 20.0)
"""Length/diameter for which a map can be made; a shorter film turns faster than the nodes can follow."""


def is_pad_mappable(extent: float, slenderness: float) -> bool:
    """Return whether there can be a map of pads of an extent [rad] and length/diameter."""
    return EXTENTS[0] <= extent <= EXTENTS[1] and SLENDERNESSES[0] <= slenderness <= SLENDERNESSES[1]


def require_mappable(extent: float, slenderness: float) -> None:
    """Raise InputError unless there can be a map of pads of an extent [rad] and length/diameter."""
    rows = ("extent", extent, EXTENTS), ("length/diameter", slenderness, SLENDERNESSES)
    for name, value, (low, high) in rows:
        if not low <= require_number(name, value) <= high:
            raise InputError(f"{name} must be {low} to {high} for a map of a pad, got {value!r}")


def pad_map(extent: float, slenderness: float, resolution: PadResolution = FINE) -> PadMap:
    """Return how the map of a pad is made and kept; its shape is rounded to nine digits.

    Parameters
    ----------
    extent : float [rad]
        Angle that the pad covers, 0.1 to 3.1.
    slenderness : float [1]
        Length / diameter, 0.05 to 20.
    resolution : PadResolution, optional
        A coarser one is made sooner.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """
    require_mappable(extent, slenderness)
    return PadMap(nine_digits(extent), nine_digits(slenderness), resolution.checked())
