"""The solution of one state of the two-dimensional film: pressure, force and its error, flow, shear."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from ....model import Array
from ..cavitation import Cavitation
from ..film_field import FilmField
from .ring_coefficients import CellCoefficients, ring_angles
from .ring_forces import film_force, film_source, finest
from .ring_grids import Grid, Spans, axial_nodes


class GridFilm(Protocol):
    """A film on rings of cells, as `ReynoldsFilm`."""

    @property
    def cells(self) -> tuple[int, int]:
        """Cells around, and along half the bearing."""

    @property
    def cavitation(self) -> Cavitation:
        """Where the film ends."""

    def grids(self, slenderness: float) -> tuple[Spans, tuple[Grid, ...]]:
        """Return the edges and the grids, finest first."""

    def extrapolated(self, e: Array, w: Array, slenderness: float) -> tuple[Array, Array]:
        """Return the extrapolated force and the error of the force."""


def film_field(film: GridFilm, eccentricity: Array, source: Array, slenderness: float) -> FilmField:
    """Return the solution of one state; see `ReynoldsFilm.solve`."""
    e, w = np.asarray(eccentricity, dtype=float), np.asarray(source, dtype=float)
    extrapolated, error = film.extrapolated(e, w, slenderness)
    spans, grids = film.grids(slenderness)
    coefficients, pressure, _ = finest(e, w, slenderness, spans, grids, film.cavitation.searched)
    if film.cavitation.clipped:
        pressure = np.maximum(pressure, 0.0)
    axial = axial_nodes(film.cells[1], slenderness)
    face = ring_angles(e, spans, grids[0].span, grids[0].face)
    return FilmField(
        force=film_force(coefficients.normal, grids[0], pressure, False),
        force_extrapolated=extrapolated,
        force_error=float(error),
        angle=coefficients.theta,
        axial=axial,
        thickness=_thickness(e, coefficients.theta),
        pressure=np.pad(pressure, ((0, 0), (0, 1))),
        side_flow=_side_flow(coefficients, grids[0], w, pressure),
        shear=_shear(e, coefficients.theta, face, grids[0].film),
    )


def _thickness(e: Array, theta: Array) -> Array:
    return 1.0 - e[0] * np.cos(theta) - e[1] * np.sin(theta)


def _shear(e: Array, theta: Array, face: Array, film: np.ndarray) -> float:
    width = (np.roll(theta, -1) - theta) % (2.0 * np.pi)
    return float(np.sum(film * width / _thickness(e, face)))


def _side_flow(coefficients: CellCoefficients, grid: Grid, w: Array, pressure: Array) -> float:
    """Return the flow out of the ends of the film, by the balance of the half cells that end there.

    Openings are left out, and so is what a film in tension draws in.
    """
    last_cell = 1.0 - np.sum(grid.width)
    inward = coefficients.along * grid.conductance[-1] * pressure[:, -1]
    made = film_source(coefficients.normal, grid, w)[:, -1] / grid.width[-1] * last_cell
    outward = np.where((pressure[:, -1] > 0.0) & ~grid.held, inward + made, 0.0)
    return float(np.sum(np.maximum(outward, 0.0)))
