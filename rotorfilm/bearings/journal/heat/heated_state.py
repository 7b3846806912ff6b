"""What a film that warms says at one place of the journal: temperatures, pressure, force, and where heat goes."""

from __future__ import annotations

from dataclasses import dataclass

from ....model import Array
from .frozen_film import FrozenFilm


@dataclass(frozen=True, kw_only=True)
class HeatAccount:
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
class HeatedState:
    """A film with its temperature, for a journal at rest; N lines with M + 1 nodes on each.

    Attributes
    ----------
    position : ndarray, shape (2,) [m]
    speed : float [rad/s]
    force : ndarray, shape (2,) [N]
        On the journal.
    angle : ndarray, shape (N,) [rad]
        Lines, in the bearing frame from +x towards +y.
    axial : ndarray, shape (M + 1,) [m]
        Nodes from the middle of the bearing to its end; the film is symmetric.
    pressure : ndarray, shape (N, M + 1) [Pa]
        Gauge pressure.
    filled : ndarray, shape (N, M + 1) [1]
        Share of the gap that oil fills: 1 in the film, less in the ruptured zone, 0 in openings.
    oil_temperature : ndarray, shape (N, M + 1) or (N, M + 1, layers) [K]
        The mean across the film, or that of its layers from the bush to the journal.
    bush_temperature : ndarray, shape (N,), or None [K]
        At the bore; None for walls that take no heat.
    journal_temperature : float or None [K]
    maximum_temperature : float [K]
        Of the oil in the film.
    power_loss : float [W]
        Power of the shaft that becomes heat.
    friction_torque : float [N m]
        About +z, that keeps the journal turning.
    side_flow : float [m^3/s]
        Oil that leaves through both ends of the film.
    heat : HeatAccount
    film : FrozenFilm
        The film at frozen temperature: a Reaction with exact derivatives.
    film_temperature : ndarray, shape of oil_temperature [K]
        At which the film has its viscosity; that of the oil when the rounds have come to rest.
    rounds : int
        Solutions of film and heat in turn until here.
    """

    position: Array
    speed: float
    force: Array
    angle: Array
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
    film: FrozenFilm
    film_temperature: Array
    rounds: int
