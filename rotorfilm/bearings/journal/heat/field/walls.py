"""What holds a warm film: walls without heat, of given temperature, or a bush that conducts it away."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np

from .....errors import InputError, require_each, require_non_negative, require_positive
from .....inputs.si_arguments import quantities
from .....model import Array

HARMONICS = 256
"""Waves around the bush that its temperature is made of."""


class WallResponse(NamedTuple):
    """How warm the walls of N cells get from the heat that they take.

    Bush: T = mean + spread q, with give (mean - ambient) = take x sum of q, q [W/m] in each cell per length
    of the bearing. Journal: of one temperature, shaft_give (T - shaft_ambient) = shaft_take x its heat [W].

    Attributes
    ----------
    spread : ndarray, shape (N, N) [K m/W]
    give : float [W/(m K)]
    take : float [1]
    ambient : float [K]
    shaft_give : float [W/K]
    shaft_take : float [1]
    shaft_ambient : float [K]
    """

    spread: Array
    give: float
    take: float
    ambient: float
    shaft_give: float
    shaft_take: float
    shaft_ambient: float


@runtime_checkable
class Walls(Protocol):
    """The bush around a film and the journal in it, as the heat of the film sees them."""

    @property
    def adiabatic(self) -> bool:
        """Whether the walls take no heat at all."""

    def response(self, radius: float, start: Array, extent: Array) -> WallResponse:
        """Return how warm the walls get.

        Parameters
        ----------
        radius : float [m]
            Of the bearing.
        start, extent : ndarray, shape (N,) [rad]
            Cells around the film.
        """


@dataclass(frozen=True)
class AdiabaticWalls:
    """Bush and journal that take no heat: all of it leaves with the oil."""

    @property
    def adiabatic(self) -> bool:
        """Whether the walls take no heat at all."""
        return True

    def response(self, radius: float, start: Array, extent: Array) -> WallResponse:
        """Return what no heat makes of the walls; see `Walls`."""
        return WallResponse(np.zeros((len(start), len(start))), 1.0, 0.0, 0.0, 1.0, 0.0, 0.0)


@quantities
@dataclass(frozen=True, kw_only=True)
class HeldWalls:
    """Bush and journal at given temperatures.

    Parameters
    ----------
    bush_temperature, journal_temperature : float [K]
        At the bore, all round, and of the journal.
    """

    bush_temperature: float
    journal_temperature: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "bush_temperature", "journal_temperature")

    @property
    def adiabatic(self) -> bool:
        """Whether the walls take no heat at all."""
        return False

    def response(self, radius: float, start: Array, extent: Array) -> WallResponse:
        """Return that heat changes nothing; see `Walls`."""
        spread = np.zeros((len(start), len(start)))
        return WallResponse(spread, 1.0, 0.0, self.bush_temperature, 1.0, 0.0, self.journal_temperature)


@quantities
@dataclass(frozen=True, kw_only=True)
class BushRing:
    """A bush that conducts heat around and outwards, and a journal of one temperature.

    The bush is a ring of the bearing's length in which heat flows around and along the radius. Of a
    temperature cos(n theta) at its bore it takes the flux D_n cos(n theta), exactly,

        1/D_0 = r ln(r_o/r)/k + r/(r_o h),   D_n = (k n/r) (1 - s q)/(1 + s q),
        s = (n - Bi)/(n + Bi),   Bi = h r_o/k,   q = (r/r_o)^(2n).

    Parameters
    ----------
    outer_radius : float [m]
        r_o, above the bearing's radius r.
    conductivity : float [W/(m K)]
        k of the bush; 50 of steel.
    transfer : float [W/(m2 K)]
        h from the outside of the bush to its surroundings; 0 insulates it.
    ambient_temperature : float [K]
        Of the surroundings.
    shaft_conductance : float [W/K]
        Heat that the shaft carries off from the bearing, per kelvin above the surroundings; 0 if nothing is
        known, so that the journal is as warm as makes its net heat zero.

    Raises
    ------
    InputError
        If a parameter breaks its rule.
    """

    outer_radius: float
    conductivity: float = 50.0
    transfer: float = 80.0
    ambient_temperature: float = 303.15
    shaft_conductance: float = 0.0

    def __post_init__(self) -> None:
        require_each(self, require_positive, "outer_radius", "conductivity", "ambient_temperature")
        require_each(self, require_non_negative, "transfer", "shaft_conductance")

    @property
    def adiabatic(self) -> bool:
        """Whether the walls take no heat at all."""
        return False

    def mean_transfer(self, radius: float) -> float:
        """Return D_0 [W/(m^2 K)], the heat per area of the bore and kelvin above the surroundings."""
        resistance = radius * np.log(self.outer_radius / radius) / self.conductivity
        outside = self.transfer * self.outer_radius / radius
        return float(outside / (1.0 + resistance * outside))

    def wave_transfer(self, radius: float, waves: Array) -> Array:
        """Return D_n [W/(m^2 K)] of n = 1, 2, ... waves around the bore, of their shape."""
        biot = self.transfer * self.outer_radius / self.conductivity
        sq = (waves - biot) / (waves + biot) * (radius / self.outer_radius) ** (2.0 * waves)
        return np.asarray(self.conductivity * waves / radius * (1.0 - sq) / (1.0 + sq))

    def response(self, radius: float, start: Array, extent: Array) -> WallResponse:
        """Return how warm the bush gets, by means over the cells; see `Walls`."""
        if self.outer_radius <= radius:
            raise InputError(
                f"outer_radius must be above the bearing's radius {radius!r}, got {self.outer_radius!r}"
            )
        n = np.arange(1.0, HARMONICS + 1.0)
        ends = np.exp(1j * np.outer(start + extent, n)) - np.exp(1j * np.outer(start, n))
        mean = ends / (1j * np.outer(extent, n))
        spread = np.real((mean / self.wave_transfer(radius, n)) @ mean.conj().T) / (np.pi * radius)
        give = 2.0 * np.pi * radius * self.mean_transfer(radius)
        shaft = self.shaft_conductance, 1.0, self.ambient_temperature
        return WallResponse(spread, give, 1.0, self.ambient_temperature, *shaft)
