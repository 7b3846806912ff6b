"""Making the tables of squeeze films: potentials at the nodes of a map, kept in memory and on disk."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...model import Array
from ...sources import source_digest
from ..films.map_fit import fit_map_table, node_eccentricities, tabulate_film
from ..films.map_table import VERSION, MapTable
from ..films.table_cache import cached_table, table_path
from .cavitated_squeeze import CavitatedSqueezeFilm
from .finite_squeeze import FiniteSqueezeFilm
from .full_squeeze import FullSqueezeFilm, SqueezeFilm
from .porous_layer import PorousLayer, layer_modes
from .squeeze_potential import CavitatedPotential

LARGEST_FINITE = 0.985

LARGEST = 0.99
"""Eccentricity ratio of the table's last node; beyond, the kernel goes on to the wall, with a warning."""

FULL = 3
"""Times as many cells over the direction for a full film, whose tension narrows the peak over it."""

RATIO = 1.0
"""The slenderness that a table of a damper says it is for: the damper's own is in its numbers."""


@dataclass(frozen=True)
class SqueezeTable:
    """A table and the damper it is for.

    Parameters
    ----------
    slenderness : float or None [1]
        L/D; None for a short film, whose table holds for any.
    layer : tuple or None
        The numbers of the PorousLayer; None for a solid cage.
    cavitated : bool
        Whether the film ruptures.
    table : MapTable
        In units of viscosity * radius * length^3 / clearance^2 per 1/s.
    """

    slenderness: float | None
    layer: tuple[float, ...] | None
    cavitated: bool
    table: MapTable

    def required(self, slenderness: float | None, layer: PorousLayer | None, cavitated: bool) -> SqueezeTable:
        """Return this table; raise InputError if it is that of another damper."""
        own, other = (self.slenderness, self.layer, self.cavitated), (slenderness, layer, cavitated)
        if own != other:
            raise InputError(f"table must be that of the damper, {other}, got that of {own}")
        return self


@lru_cache(maxsize=32)
def short_table(layer: PorousLayer | None, cavitated: bool, cells: tuple[int, int]) -> SqueezeTable:
    """Return the table of a short film on a layer, in some hundredths of a second.

    Parameters
    ----------
    layer : PorousLayer or None
        None for a solid cage.
    cavitated : bool
    cells : (int, int)
        Over the eccentricity ratio and the direction of the velocity.
    """
    modes = layer_modes(layer)
    if cavitated:
        table = tabulate_film(
            _AsJournalFilm(CavitatedSqueezeFilm(modes)),
            slenderness_range=(RATIO, RATIO),
            cells=(*cells, 0),
            largest_eccentricity_ratio=LARGEST,
        )
    else:
        table = _full_table(FullSqueezeFilm(modes, np.zeros_like(modes.weight)), cells, LARGEST)
    return SqueezeTable(None, layer and tuple(layer), cavitated, table)


@lru_cache(maxsize=16)
def finite_table(
    slenderness: float, layer: PorousLayer | None, cavitated: bool, cells: tuple[int, int]
) -> SqueezeTable:
    """Return the table of a film of finite length, from disk if it was made before; see `short_table`."""
    path = squeeze_path(slenderness, layer, cavitated, cells)

    def build() -> MapTable:
        if cavitated:
            return _cavitated_table(slenderness, layer, cells)
        modes = layer_modes(layer)
        film = FiniteSqueezeFilm(slenderness, layer, modes, np.zeros_like(modes.weight))
        return _full_table(film, cells, LARGEST_FINITE)

    table = cached_table(MapTable, path, build)
    return SqueezeTable(slenderness, layer and tuple(layer), cavitated, table)


def squeeze_path(
    slenderness: float, layer: PorousLayer | None, cavitated: bool, cells: tuple[int, int]
) -> Path:
    """Return where a table lies; the name is a digest of all that decides its content."""
    return table_path("damper", (VERSION, source_digest(__name__), slenderness, layer, cavitated, cells))


def _cavitated_table(slenderness: float, layer: PorousLayer | None, cells: tuple[int, int]) -> MapTable:
    potential = CavitatedPotential(slenderness, layer)
    headings = np.arccos(np.linspace(-1.0, 1.0, cells[1] + 1))
    nodes = node_eccentricities(LARGEST_FINITE, cells[0])
    logs = [[np.log(-potential(float(eps), float(turn))) for turn in headings] for eps in nodes[1:]]
    center = np.full(headings.size, np.log(-potential(0.0, 0.0)))
    return fit_map_table(
        np.array([[center, *logs]]),
        slenderness_range=(RATIO, RATIO),
        largest_eccentricity_ratio=LARGEST_FINITE,
    )


def _full_table(film: SqueezeFilm, cells: tuple[int, int], largest: float) -> MapTable:
    """Return the table of a full film: -J = (C_t + (C_r - C_t) cos^2)/2, linear in the velocity."""
    eps = node_eccentricities(largest, cells[0])
    none = np.zeros_like(eps)
    damping = -film.jacobian(np.stack([eps, none]), np.stack([none, none]))[:, 2:]
    cos2 = np.linspace(-1.0, 1.0, FULL * cells[1] + 1) ** 2
    radial, tangential = damping[0, 0][:, None], damping[1, 1][:, None]
    return fit_map_table(
        np.log(0.5 * (tangential + (radial - tangential) * cos2))[None],
        slenderness_range=(RATIO, RATIO),
        largest_eccentricity_ratio=largest,
        slope=np.zeros(1),
    )


@dataclass(frozen=True)
class _AsJournalFilm:
    """A squeeze film under the protocol of journal films, whatever the slenderness."""

    film: SqueezeFilm

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        return self.film.force(eccentricity, source)
