"""The numbers that say which model of a film's heat is enough."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ....errors import InputError, brief
from ....inputs.kinds import arguments
from ...oil.cooled import Cooled


class HeatNumbers(NamedTuple):
    """Numbers of a film at rest with the viscosity of fresh oil.

    Attributes
    ----------
    thinning_rise : float [1]
        E = thinning P/(C Q): what the oil thins where all heat leaves with the oil that leaks. The error of a
        film at supply temperature.
    peclet : float [1]
        Pe = speed clearance^2 C/k: heat that flows along the film over heat that crosses it.
    nahme : float [1]
        Na = thinning viscosity (speed radius)^2/k: what heat from shear alone thins across the film.
    """

    thinning_rise: float
    peclet: float
    nahme: float


@arguments
def heat_numbers(bearing: Cooled, position: ArrayLike, speed: float) -> HeatNumbers:
    """Return the numbers of the heat of a bearing with oil and cooling.

    Parameters
    ----------
    bearing : JournalBearing
    position : array_like, shape (2,) [m]
        Of the journal, off the center: where the film at supply temperature carries the load.
    speed : float [rad/s]

    Raises
    ------
    InputError
        If the bearing has no oil or no cooling, its film law knows no losses, or no oil leaves its film.
    FilmContactError
        If the journal touches the wall.
    """
    oil, cooling = bearing.cooled
    supply = cooling.supply_temperature
    heat = bearing.at_temperature(supply).film_heat(position, np.zeros(2), speed)
    if not heat.side_flow > 0.0:
        raise InputError(f"position must be off the center, where oil leaves the film, got {brief(position)}")
    capacity, thinning = float(oil.volumetric_heat(supply)), float(oil.thinning(supply))
    return HeatNumbers(
        thinning * heat.power / (capacity * heat.side_flow),
        abs(speed) * bearing.clearance**2 * capacity / oil.conductivity,
        thinning * heat.viscosity * (speed * bearing.radius) ** 2 / oil.conductivity,
    )
