"""Models of a film's heat: as cold as the supply, one temperature, a field, layers across the film."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from ...bearings.journal import (
    FilmProfile,
    HeatedFilm,
    HeatedState,
    JournalBearing,
    LayeredTemperature,
    MeanTemperature,
)
from ...linear import coefficients, equilibrium, heated_equilibrium
from ...model import Array, Reaction
from .heat_cases import HeatCase

CELLS, LAYERS = (80, 8), 12
REFERENCE_CELLS, REFERENCE_LAYERS = (160, 12), 20
"""Of the models with fields, and of the reference: cells around the film and along half of it."""


class HeatModel(StrEnum):
    """Models of a film's heat, from the cheapest to the richest."""

    SUPPLY = "T0"
    BALANCE = "T1"
    HOUSING = "T1 housing"
    ADIABATIC = "T2"
    BUSH = "T2 bush"
    LAYERS = "T3"

    @property
    def said(self) -> str:
        """Return the model in words."""
        return f"{self.value[:2]}, {_SAID[self]}"


_SAID = {
    HeatModel.SUPPLY: "as cold as the supply",
    HeatModel.BALANCE: "heat balance",
    HeatModel.HOUSING: "with housing",
    HeatModel.ADIABATIC: "over the film",
    HeatModel.BUSH: "with bush",
    HeatModel.LAYERS: "across the film",
}

ONE_TEMPERATURE = (HeatModel.SUPPLY, HeatModel.BALANCE, HeatModel.HOUSING)
"""Models in which a film has one temperature."""


@dataclass(frozen=True, kw_only=True)
class HeatAnswer:
    """What a model says of a bearing under its load.

    Attributes
    ----------
    position : ndarray, shape (2,) [m]
    eccentricity_ratio : float [1]
    attitude_angle : float [rad]
    power_loss : float [W]
    temperature : float [K]
        The one temperature of the film, or the largest of its field.
    load_stiffness : float [N/m]
        Entry yy of the stiffness, along the load.
    """

    position: Array
    eccentricity_ratio: float
    attitude_angle: float
    power_loss: float
    temperature: float
    load_stiffness: float


def answered(case: HeatCase, model: HeatModel, *, cells: tuple[int, int], layers: int) -> HeatAnswer:
    """Return what a model says of a case, those with fields on so many cells and layers."""
    if model in ONE_TEMPERATURE:
        return _with_one_temperature(bearing_of(case, model), case)
    profile: FilmProfile = LayeredTemperature(layers) if model is HeatModel.LAYERS else MeanTemperature()
    walls = {} if model is HeatModel.ADIABATIC else {"walls": case.ring}
    film = HeatedFilm(bearing=case.bearing, cells=cells, profile=profile, **walls)
    found = heated_equilibrium(film, case.load, case.speed)
    state = found.state
    at = found.rest
    return _answer(at.position, case, state.film, state.power_loss, state.maximum_temperature)


def heated_film(
    case: HeatCase, *, cells: tuple[int, int] = REFERENCE_CELLS, layers: int = REFERENCE_LAYERS
) -> HeatedState:
    """Return the film of a case under its load, with its bush, over so many cells and layers."""
    profile = LayeredTemperature(layers)
    film = HeatedFilm(bearing=case.bearing, walls=case.ring, cells=cells, profile=profile)
    found: HeatedState = heated_equilibrium(film, case.load, case.speed).state
    return found


def housing_of(case: HeatCase) -> float:
    """Return the heat [W/K] that the bush of a case takes per kelvin, as warm all round."""
    R, L = case.bearing.radius, case.bearing.length
    return 2.0 * math.pi * R * L * case.ring.mean_transfer(R)


def position_error(answer: HeatAnswer, reference: HeatAnswer) -> float:
    """Return how far a journal is from where a reference has it, in its eccentricity."""
    return float(np.hypot(*(answer.position - reference.position)) / np.hypot(*reference.position))


def bearing_of(case: HeatCase, model: HeatModel) -> JournalBearing:
    """Return the bearing of a model with one temperature."""
    bearing, (_, cooling) = case.bearing, case.bearing.cooled
    if model is HeatModel.SUPPLY:
        return bearing.at_temperature(cooling.supply_temperature)
    if model is HeatModel.BALANCE:
        return bearing
    ambient = case.ring.ambient_temperature
    housed = replace(cooling, housing_conductance=housing_of(case), ambient_temperature=ambient)
    return replace(bearing, cooling=housed)


def _with_one_temperature(bearing: JournalBearing, case: HeatCase) -> HeatAnswer:
    at = equilibrium(bearing, case.load, case.speed)
    temperature = bearing.temperature if at.temperature is None else at.temperature
    assert temperature is not None
    assert at.losses is not None
    film = bearing.at_temperature(temperature)
    return _answer(at.position, case, film, float(at.losses.power_loss), temperature)


def _answer(
    position: Array, case: HeatCase, film: Reaction, power_loss: float, temperature: float
) -> HeatAnswer:
    x, y = position
    return HeatAnswer(
        position=position,
        eccentricity_ratio=float(np.hypot(x, y)) / case.bearing.clearance,
        attitude_angle=math.atan2(x, -y) * math.copysign(1.0, case.speed),
        power_loss=power_loss,
        temperature=temperature,
        load_stiffness=float(coefficients(film, position, case.speed).stiffness[1, 1]),
    )
