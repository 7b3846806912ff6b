"""The impedance map of a bearing with axial grooves or several pads as a film law."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import Any

import numpy as np

from ...core.errors import InputError, require_kind, require_number, require_positive
from ...core.inputs import quantities
from ...core.model import Array
from ...core.progress import Report, silent
from ...native import MapKernel
from ...native.loss_kernels import LossKernel
from ..films.finite_volumes import are_counts, require_cells
from ..films.geometry import AlignedOpenings, FilmGeometry, aligned_openings, require_mappable
from ..films.law import FilmLosses, KernelFilm, gap_shear, kernel_losses, require_film, static_rate
from ..films.map_fit import MapPlan, nine_digits
from ..films.map_growth import SCALE, GrowthMap, require_map_law
from ..films.mobility import Mobility, law_of, of_unit_density, per_rate, require_same_mobility
from .groove_map import GrooveMap, GrooveMapTable, Resolution, nearest
from .map_film import MapFilm
from .reynolds_film import ReynoldsFilm

SAME = 2e-9
"""Angle [rad], and relative difference of length/diameter, below which a table is that of a bearing."""

GROOVED_RANGE = (0.05, 20.0)
"""Length/diameter for which a map can be made; a shorter film turns faster than the nodes can follow."""


GROWTH: dict[str, Any] = {"cells": (64, 8), "nodes": (12, 60, 36)}
"""Cells and nodes of what the Reynolds number adds to a map."""

BANDED: dict[str, Any] = {**GROWTH, "nodes": (12, 48, 28)}
"""The same with a band of transition, which takes twice as many cells over the Reynolds number."""


@quantities
@dataclass(frozen=True, kw_only=True)
class GroovedMapFilm(KernelFilm):
    """Finite-length film with Reynolds rupture in a bearing with axial grooves or several pads.

    The openings are at ambient pressure. As in `MapFilm` the force is F = dJ/dw of a tabulated potential
    J(e, w), here over two angles (`native/films/map_kernel.h`): the damping matrix is symmetric, and the
    derivatives are exact. `MapFilm()` becomes this film in a bearing with openings, and this one `MapFilm()`
    in a plain bearing: you need to name it only to change its parameters.

    A map belongs to one L/D (0.05 to 20) and to one set of openings, at any orientation. It is made
    from some 10^4 solutions of the two-dimensional film on first use, which takes some seconds on all cores,
    and then kept in the folder that the environment variable ROTORFILM_CACHE names, or the platform's cache.
    `build_groove_map` makes it beforehand and reports the progress.

    Beyond the largest eccentricity ratio J continues as the asymptotic film at the wall
    (`native/films/wall.h`), with a ValidityWarning. Its error is within 5 % where no opening is near; at the
    edge of an opening it may be wrong by a factor.

    Parameters
    ----------
    cells : (int, int)
        Cells of the two-dimensional film around it and along half the length: multiples of 4, at least 16
        and 4.
    nodes : (int, int, int)
        Nodes of the map over the eccentricity ratio (at least 6), and over the directions of the
        eccentricity and of the source (even, at least 12).
    largest_eccentricity_ratio : float [1]
        Largest eccentricity ratio of the last node.
    mobility : Mobility or None
        How easily the oil flows over the thickness of the film (`mobility_of`); None for laminar flow. The
        factor of its Couette flow is 1. Beyond the largest eccentricity ratio the error is then unknown. With
        a density the map is over the Reynolds number too, and shear and flow are those of the film on the
        grid.
    reynolds_cells : int
        Cells over the Reynolds number, where the mobility has a density. Without a band of transition the map
        has half as many.
    reynolds_scale : float [m3/kg s]
        Radius times clearance over viscosity, set by the bearing.
    table : GrooveMapTable, optional
        An existing map, which is then used without a search on disk.
    geometry : FilmGeometry
        Set by `fitted`, from the geometry of the bearing.

    Raises
    ------
    InputError
        If an argument breaks its rule, an opening is wider than 60 deg, there is a supply pressure,
        or the table is that of other openings.
    """

    cells: tuple[int, int] = (192, 12)
    nodes: tuple[int, int, int] = (12, 72, 48)
    largest_eccentricity_ratio: float = 0.97
    mobility: Mobility | None = None
    reynolds_cells: int = 32
    reynolds_scale: float = field(default=0.0, repr=False)
    table: GrooveMapTable | None = None
    geometry: FilmGeometry = field(default_factory=FilmGeometry)

    def __post_init__(self) -> None:
        require_cells(self.cells)
        if not are_counts(self.nodes, (6, 12, 12), (1, 2, 2)):
            raise InputError(f"nodes must be at least (6, 12, 12), the last two even, got {self.nodes!r}")
        if not 0.0 < require_number("largest_eccentricity_ratio", self.largest_eccentricity_ratio) < 1.0:
            raise InputError(
                f"largest_eccentricity_ratio must be in (0, 1), got {self.largest_eccentricity_ratio!r}"
            )
        require_kind("geometry", self.geometry, FilmGeometry, "a FilmGeometry")
        require_kind("table", self.table, GrooveMapTable | None, "a GrooveMapTable")
        require_map_law(self.mobility, self.reynolds_cells)
        if self.table is not None:
            require_same_mobility(self.table.mobility, law_of(self.mobility))
        if not self.geometry.plain:
            require_mappable(self.geometry)
            if self.table is not None:
                require_same_openings(self.table, aligned_openings(self.geometry))

    @property
    def slenderness_range(self) -> tuple[float, float]:
        """Smallest and largest length/diameter that this film takes."""
        if self.table is None:
            return GROOVED_RANGE
        return self.table.slenderness * (1.0 - SAME), self.table.slenderness * (1.0 + SAME)

    def fitted(self, geometry: FilmGeometry) -> GroovedMapFilm | MapFilm:
        """Return this film in a bearing of the given geometry; in a plain one that is `MapFilm()`."""
        if geometry.plain and self.mobility is not None:
            raise InputError("mobility of a plain bearing must be that of a ReynoldsFilm, got a map")
        if geometry.plain and self.table is None:
            return MapFilm()
        if geometry.plain:
            raise InputError("table must be that of the bearing, got one with openings; take MapFilm()")
        return dataclasses.replace(self, geometry=geometry)

    @property
    def is_grown(self) -> bool:
        """Whether the map has the Reynolds number as a further axis."""
        return self.mobility is not None and self.mobility.density > 0.0

    def at_scale(self, reynolds_scale: float) -> GroovedMapFilm | None:
        """Return this film in a bearing of these dimensions, if it changes with them; see `FilmOptions`."""
        return dataclasses.replace(self, reynolds_scale=reynolds_scale) if self.is_grown else None

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]]:
        """Return the kernel and its tables, made now if they are not there yet; see `FilmOptions`."""
        tables = _kernels(self, slenderness)[0].tables
        numbers = np.array([slenderness, *tables["map"][1:]])
        return "grooved_journal", {**tables, "map": numbers}

    def losses(self, e: Array, w: Array, slenderness: float, rate: Array | None = None) -> FilmLosses:
        """Return shear and flow from the maps, with slopes; see `FilmOptions`.

        The start of the film, the streamers and the flows of the openings are those of a journal at rest with
        the source w.
        """
        flat = e.reshape(2, -1), w.reshape(2, -1)
        require_film(flat[0])
        if self.is_grown:
            own = ReynoldsFilm(cells=self.cells, mobility=self.mobility, reynolds_scale=self.reynolds_scale)
            return own.fitted(self.geometry).losses(e, w, slenderness, rate)
        kernel = self.loss_kernel(slenderness)
        along = static_rate(e, w) if rate is None else np.broadcast_to(rate, e.shape[1:])
        openings, aligned = self.geometry.openings(), aligned_openings(self.geometry)
        middles = [opening.start + 0.5 * opening.extent - aligned.axis for opening in openings]
        places = [nearest(aligned.grooves, middle) for middle in middles]
        flows = kernel.flows(flat[0], along.ravel())[:, places].reshape(2, -1, *e.shape[1:])
        found = kernel_losses(kernel, e, w, self.geometry)
        gap = partial(gap_shear, e, self.geometry, self.mobility)
        return found._replace(gap=gap, inflow=flows[0], arriving=flows[1])

    def loss_kernel(self, slenderness: float) -> LossKernel:
        """Return shear and flow of the map in compiled code; see `FilmOptions`."""
        return _kernels(self, float(slenderness))[1]

    def tabulated(self, slenderness: float) -> GroovedMapFilm:
        """Return this film with its table; see `FilmOptions`."""
        return dataclasses.replace(self, table=self.built_table(slenderness)) if self.table is None else self

    def built_table(self, slenderness: float, report: Report = silent) -> GrooveMapTable:
        """Return the map of this film: the given one, the one on disk, or a new one, which is then kept.

        Parameters
        ----------
        slenderness : float [1]
            Length / diameter; of a new map rounded to nine digits.
        report : callable, optional
            Called with the fraction done, 0 to 1, and a text while a map is being made. Without it the log
            says that one is being made.

        Raises
        ------
        InputError
            If the film has no openings, or the slenderness is outside `slenderness_range`.
        """
        require_positive("length/diameter", slenderness)
        low, high = self.slenderness_range
        if not low <= slenderness <= high:
            raise InputError(
                f"length/diameter must be {low:.9g} to {high:.9g} for this map, got {slenderness!r}"
            )
        return self._plan(slenderness).kept(report) if self.table is None else self.table

    def making_time(self, slenderness: float) -> float:
        """Return the estimated time to make the map on this machine [s]; 0 if it exists already."""
        return 0.0 if self.table is not None else self._plan(slenderness).making_time()

    def _plan(self, slenderness: float) -> MapPlan[GrooveMapTable]:
        law = law_of(self.mobility)
        own = None if self.is_grown else self.mobility
        resolution = Resolution(self.cells, self.nodes, self.largest_eccentricity_ratio, own)
        laminar = GrooveMap(aligned_openings(self.geometry), nine_digits(slenderness), resolution)
        if law is None or not self.is_grown:
            return laminar
        smooth, cells = law.scale <= SCALE, self.reynolds_cells
        grown = resolution._replace(**GROWTH if smooth else BANDED)
        coarse = dataclasses.replace(laminar, resolution=grown)
        return GrowthMap(laminar, coarse, law, max(6, cells // 2) if smooth else cells)

    def _kernel(self, slenderness: float) -> MapKernel:
        if self.is_grown and self.mobility is not None:
            per_rate(self.mobility, self.reynolds_scale)
        return _kernels(self, float(slenderness))[0]


@lru_cache(maxsize=16)
def _table_of(film: GroovedMapFilm, slenderness: float) -> GrooveMapTable:
    return film.built_table(slenderness)


@lru_cache(maxsize=64)
def _kernels(film: GroovedMapFilm, slenderness: float) -> tuple[MapKernel, LossKernel]:
    """Return the compiled film of a bearing, and its losses; without one Re is the rate."""
    scale, axis = film.reynolds_scale, aligned_openings(film.geometry).axis
    table = _table_of(of_unit_density(film), slenderness)
    if film.mobility is None or not film.is_grown:
        return table.kernel(axis), table.loss_kernel(axis)
    grown = per_rate(film.mobility, scale) if scale else 1.0
    return table.kernel(axis, grown, film.mobility.density), table.loss_kernel(axis)


def require_same_openings(table: GrooveMapTable, openings: AlignedOpenings) -> None:
    """Raise InputError unless a table is that of these openings."""
    same = len(table.grooves) == len(openings.grooves) and all(
        abs(a.center - b.center) <= SAME and abs(a.width - b.width) <= SAME
        for a, b in zip(table.grooves, openings.grooves, strict=True)
    )
    if not same:
        raise InputError(f"openings must be those of the table, {table.grooves!r}, got {openings.grooves!r}")
