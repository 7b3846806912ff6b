"""The film of a damper without dimensions, and the units of what it says."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....model import Array
from ...films.conserved.conserved_cells import conserved_cells
from ...films.conserved.conserved_film import ConservedFilm
from .damper_supply import DamperSupply, supplied_film


class ScaledFilm(NamedTuple):
    """A film, and what its numbers are to be multiplied by.

    Attributes
    ----------
    film : ConservedFilm
    clearance : float [m]
    force : float [N s]
        Viscosity * film length * radius^3/clearance^2, per 1/s.
    oil : float [m3]
        Clearance * radius * film length, and per 1/s of flows.
    pressure : float [Pa s]
        12 viscosity (radius/clearance)^2, per 1/s.
    cavitation_pressure : float [Pa]
        From which pressures of the film count.
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the damper to its end, or from the groove at its end.
    """

    film: ConservedFilm
    clearance: float
    force: float
    oil: float
    pressure: float
    cavitation_pressure: float
    axial: Array

    def gauge(self, pressure: Array) -> Array:
        """Return pressures of the film as gauge pressures [Pa]."""
        return self.pressure * np.maximum(pressure, 0.0) + self.cavitation_pressure


def scaled_film(
    supply: DamperSupply,
    *,
    radius: float,
    length: float,
    clearance: float,
    viscosity: float,
    cells: tuple[int, int],
) -> ScaledFilm:
    """Return the film of a damper; arguments are those of `JFODamper`.

    Raises
    ------
    InputError
        If a groove or a hole is too wide.
    """
    pressure = 12.0 * viscosity * (radius / clearance) ** 2
    geometry, fed, whole, share = supplied_film(supply, radius, length, pressure)
    film = ConservedFilm(conserved_cells(geometry, *cells), whole / (2.0 * radius), fed)
    size = share * whole * radius
    beside = 0.5 * (supply.circumferential_groove or 0.0)
    return ScaledFilm(
        film=film,
        clearance=clearance,
        force=size * viscosity * (radius / clearance) ** 2,
        oil=size * clearance,
        pressure=pressure,
        cavitation_pressure=supply.cavitation_pressure,
        axial=beside + 0.5 * whole * film.cells.axial,
    )
