"""A journal at rest on a film that warms: by one temperature, or by a field.

T0 is the viscosity of fresh oil, T1 one temperature in balance, T2 a temperature over the film, T3 one over
and across it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike

from ...bearings.journal import (
    BushRing,
    FilmProfile,
    HeatedFilm,
    HeatedJFOFilm,
    HeatedState,
    JFOFilm,
    JournalBearing,
    Walls,
)
from ...bearings.oil.cooling import RING
from ...linear import coefficients, equilibrium, heated_equilibrium
from ...model import Reaction
from ...results import Coefficients, Equilibrium

STEEL_CONDUCTIVITY = 50.0
"""Of the bush that a scene leaves open [W/(m K)]."""


@dataclass(frozen=True, kw_only=True)
class WarmRest:
    """A journal at rest on a film that warms, by one of the rungs.

    Attributes
    ----------
    rest : Equilibrium
    reaction : Reaction
        The film, frozen at its temperature.
    power_loss : float [W]
    side_flow : float [m^3/s]
    temperature : float [K]
        Of the oil that leaves at the ends, in the mean.
    maximum_temperature : float [K]
    supply_temperature : float [K]
    field : ndarray or None [K]
        Temperature of the oil, cell by cell; None of one temperature.
    """

    rest: Equilibrium
    reaction: Reaction
    power_loss: float
    side_flow: float
    temperature: float
    maximum_temperature: float
    supply_temperature: float
    field: ArrayLike | None = None

    @property
    def coefficients(self) -> Coefficients:
        """K and C at frozen temperature."""
        return coefficients(self.reaction, self.rest.position, self.rest.speed)


def bush_of(bearing: JournalBearing) -> Walls:
    """Return the bush that a temperature field is in: of steel, to `RING` times the radius.

    It carries as much heat to the ambient as the housing conductance of the bearing's cooling; where that is
    0 it conducts around the film only. One that would hold that heat up is thinner. The shaft is as warm as
    makes its net heat zero.
    """
    _, cooling = bearing.cooled
    R, outer = bearing.radius, RING * bearing.radius
    wanted = cooling.housing_conductance / (2.0 * math.pi * R * bearing.length)
    if wanted > 0.0:
        outer = min(outer, R * math.exp(0.5 * STEEL_CONDUCTIVITY / (R * wanted)))
    resistance = R * math.log(outer / R) / STEEL_CONDUCTIVITY
    return BushRing(
        outer_radius=outer,
        conductivity=STEEL_CONDUCTIVITY,
        transfer=wanted / (1.0 - resistance * wanted) * R / outer,
        ambient_temperature=cooling.ambient,
    )


def uniform_rest(
    bearing: JournalBearing | JFOFilm, load: ArrayLike, speed: float, temperature: float | None = None
) -> WarmRest:
    """Return the rest on a film of one temperature [K], that of its balance if none is given (T1)."""
    _, cooling = bearing.cooled
    warm: Any = bearing if temperature is None else bearing.at_temperature(temperature)
    at = equilibrium(warm, load, speed)
    film = at.temperature if temperature is None else temperature
    assert film is not None  # of a film that warms
    losses, frozen = at.losses, bearing.at_temperature(film)
    if losses is None:  # a JFOFilm at a stated temperature
        losses = frozen.losses(at.position, np.zeros(2), speed)
    assert losses is not None  # a balance has them
    return WarmRest(
        rest=at,
        reaction=cast(Reaction, frozen),
        power_loss=float(losses.power_loss),
        side_flow=float(losses.side_flow),
        temperature=film,
        maximum_temperature=film,
        supply_temperature=cooling.supply_temperature,
    )


def warm_field(
    bearing: JournalBearing | JFOFilm, cells: tuple[int, int], profile: FilmProfile
) -> HeatedFilm | HeatedJFOFilm:
    """Return a film with a temperature field; one that conserves its oil where openings end within it."""
    if ends_within(bearing):
        bearing = JFOFilm(bearing=bearing)  # type: ignore[arg-type]  # no JFOFilm
    if isinstance(bearing, JFOFilm):
        film = replace(bearing, cells=cells)
        return HeatedJFOFilm(film=film, walls=bush_of(film.bearing), profile=profile)
    return HeatedFilm(bearing=bearing, walls=bush_of(bearing), cells=cells, profile=profile)


def ends_within(bearing: JournalBearing | JFOFilm) -> bool:
    """Return whether a bearing has openings that end within it, beside which only conserved oil is known."""
    if isinstance(bearing, JFOFilm):
        return False
    return bool(bearing.geometry.pockets) or bearing.geometry.circumferential


def field_rest(film: HeatedFilm | HeatedJFOFilm, load: ArrayLike, speed: float) -> WarmRest:
    """Return the rest on a film with a temperature field (T2, T3)."""
    whole: Any = film  # a force at rest, of a film that conserves its oil, is what these take
    found = heated_equilibrium(whole, load, speed)
    return rest_of_state(film.bearing, found.rest, found.state.film, found.state)


def rest_of_state(
    bearing: JournalBearing | JFOFilm, at: Equilibrium, film: Reaction, state: HeatedState
) -> WarmRest:
    """Return a rest on a film whose temperature is that of a state."""
    (oil, cooling), flow = bearing.cooled, state.side_flow
    supply = cooling.supply_temperature
    carried = state.heat.leaked / (float(oil.volumetric_heat(supply)) * flow) if flow > 0.0 else math.nan
    return WarmRest(
        rest=at,
        reaction=film,
        power_loss=state.power_loss,
        side_flow=flow,
        temperature=supply + carried,
        maximum_temperature=state.maximum_temperature,
        supply_temperature=supply,
        field=state.oil_temperature,
    )
