"""What a film that warms says at one place of the journal: temperatures, forces, and where its heat goes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from .....errors import InputError
from .....model import Array
from .....readable.result import Readable
from ....oil import Cooling, Oil
from ...bearing import JournalBearing
from ...film_at_rest import FilmAtRest
from .film_flow import FilmFlow
from .heat_equations import HeatSolution


@dataclass(frozen=True, kw_only=True)
class HeatAccount(Readable):
    """Where the heat of a bearing comes from and goes to.

    Attributes
    ----------
    made : float [W]
        By shear, and by the flow under pressure.
    leaked : float [W]
        Above the temperature of the supply, with the oil that leaves the film sideways.
    drained : float [W]
        With the oil that leaves through openings, less what they give to the film again.
    into_bush, into_journal : float [W]
        Conducted from the oil.
    """

    made: float
    leaked: float
    drained: float
    into_bush: float
    into_journal: float

    @property
    def missing(self) -> float:
        """What is not accounted for [W]."""
        return self.made - self.leaked - self.drained - self.into_bush - self.into_journal


@dataclass(frozen=True, eq=False, kw_only=True)
class HeatedState(FilmAtRest):
    """A film with its temperature, for a journal at rest; N lines with M nodes on each.

    Attributes
    ----------
    axial : ndarray, shape (M,) [m]
        Nodes from the middle of the bearing to its end; the film is symmetric.
    pressure : ndarray, shape (N, M) [Pa]
        Gauge pressure.
    filled : ndarray, shape (N, M) [1]
        Share of the gap that oil fills: 1 in the film, less in the ruptured zone, 0 in openings.
    oil_temperature : ndarray, shape (N, M) or (N, M, layers) [K]
        The mean across the film, or that of its layers from the bush to the journal.
    bush_temperature : ndarray, shape (N,), or None [K]
        At the bore; None for walls that take no heat.
    journal_temperature : float or None [K]
        Of the whole journal.
    maximum_temperature : float [K]
        Of the oil in the film.
    power_loss : float [W]
        Power of the shaft that becomes heat.
    friction_torque : float [N m]
        About +z, that keeps the journal turning.
    side_flow : float [m3/s]
        Oil that leaves through both ends of the film.
    heat : HeatAccount
    film : FrozenFilm or FrozenJFOFilm
        The film at frozen temperature: a Reaction with exact derivatives.
    film_temperature : ndarray, shape of oil_temperature [K]
        At which the film has its viscosity; that of the oil when the rounds have come to rest.
    rounds : int
        Solutions of film and heat in turn until here.
    """

    axial: Array
    pressure: Array
    filled: Array
    oil_temperature: Array
    bush_temperature: Array | None
    journal_temperature: float | None
    maximum_temperature: float
    power_loss: float
    friction_torque: float
    side_flow: float
    heat: HeatAccount
    film: Any
    film_temperature: Array
    rounds: int


class FoundFilm(NamedTuple):
    """What a film says without its heat, in units of `HeatedState`; `pumped` is the supply's power [W]."""

    force: Array
    angle: Array
    axial: Array
    pressure: Array
    pumped: float
    side_flow: float


class HeatRound(NamedTuple):
    """One round of film and heat: the journal, the temperature of its viscosity, and what it found."""

    position: Array
    speed: float
    rounds: int
    temperature: Array
    opening: np.ndarray
    film: Any
    found: FoundFilm
    flow: FilmFlow
    warm: HeatSolution


def oil_and_cooling(bearing: JournalBearing) -> tuple[Oil, Cooling]:
    """Return oil and cooling of a bearing; InputError if one of them is not given."""
    oil, cooling = bearing.oil, bearing.cooling
    if oil is None or cooling is None:
        raise InputError(f"oil and cooling must be given for a film that warms, got {oil!r} and {cooling!r}")
    return oil, cooling


def volumetric_heat(bearing: JournalBearing) -> float:
    """Return the heat capacity of fresh oil per volume [J/(m^3 K)]."""
    oil, cooling = oil_and_cooling(bearing)
    return float(oil.volumetric_heat(cooling.supply_temperature))


def heat_unit(bearing: JournalBearing) -> float:
    """Return the heat flow [W/K] of oil that flows at 1/s in the units of the film, in both its halves."""
    return volumetric_heat(bearing) * bearing.clearance * bearing.radius * bearing.film_length


def heated_state(bearing: JournalBearing, done: HeatRound) -> HeatedState:
    """Return what a round has found, in SI units."""
    return HeatedState(**state_fields(bearing, done))


def state_fields(bearing: JournalBearing, done: HeatRound) -> dict[str, Any]:
    """Return the fields of the state that a round has found."""
    found, warm = done.found, done.warm
    T_s, unit = oil_and_cooling(bearing)[1].supply_temperature, heat_unit(bearing)
    made = unit * warm.made
    power = made - found.pumped
    return {
        "position": done.position,
        "speed": done.speed,
        "force": found.force,
        "angle": found.angle,
        "axial": found.axial,
        "pressure": found.pressure,
        "filled": done.flow.filled,
        "oil_temperature": T_s + warm.oil,
        "bush_temperature": None if warm.walls is None else T_s + warm.walls.bush,
        "journal_temperature": None if warm.walls is None else T_s + warm.walls.journal,
        "maximum_temperature": T_s + float(warm.oil[done.opening < 0].max()),
        "power_loss": power,
        "friction_torque": power / done.speed,
        "side_flow": found.side_flow,
        "heat": HeatAccount(
            made=made,
            leaked=unit * warm.leaked,
            drained=unit * warm.drained,
            into_bush=unit * warm.to_bush,
            into_journal=unit * warm.to_journal,
        ),
        "film": done.film,
        "film_temperature": done.temperature,
        "rounds": done.rounds,
    }
