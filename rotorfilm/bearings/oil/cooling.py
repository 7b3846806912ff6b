"""What takes the heat of a journal's film away: fresh oil and the housing."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...errors import InputError, require_non_negative, require_number, require_positive
from ...inputs.si_arguments import quantities

STEEL = 3.6e6
"""Heat capacity of steel per volume [J/(m^3 K)]."""

RING = 1.3
"""Outer radius of the bush, and of the part of its housing that warms with it, over that of the bearing, as
`Cooling` assumes them."""


COLDEST_OIL = 150.0
"""Temperature [K] below which there is no oil; degrees Celsius probably were meant."""


def require_absolute(name: str, temperature: float) -> None:
    """Raise InputError unless a temperature [K] is one that an oil may have."""
    if require_number(name, temperature) < COLDEST_OIL:
        raise InputError(
            f"{name} must be at least {COLDEST_OIL:g} K, got {temperature!r}: '{temperature:g} degC'?"
        )


@quantities
@dataclass(frozen=True, kw_only=True)
class Cooling:
    """How the heat of a film leaves: with the oil that leaks and is replaced, and through the housing.

    Parameters
    ----------
    supply_temperature : float [K]
        Of the fresh oil.
    ambient_temperature : float or None [K]
        Around the housing; None for that of the fresh oil.
    housing_conductance : float [W/K]
        Heat flow through bush and housing per kelvin between film and ambient; 0 where all heat leaves with
        the oil.
    carry_over : float [1]
        Share of the oil arriving at an opening that goes on into the next film, 0 to 1; without openings it
        has no part.
    bush_heat_capacity : float or None [J/K]
        Of the bush, and of what of housing and shaft warms with it. None for a steel ring to `RING` times the
        radius.
    full_gap : bool
        Whether oil fills the whole gap also where the film is ruptured. By default it is in streamers there,
        which take less power.

    Raises
    ------
    InputError
        If a temperature or the heat capacity is not positive, the conductance is negative, or the carry-over
        is not from 0 to 1.
    """

    supply_temperature: float
    ambient_temperature: float | None = None
    housing_conductance: float = 0.0
    carry_over: float = 0.8
    bush_heat_capacity: float | None = None
    full_gap: bool = False

    def __post_init__(self) -> None:
        require_absolute("supply_temperature", self.supply_temperature)
        if self.ambient_temperature is not None:
            require_absolute("ambient_temperature", self.ambient_temperature)
        if self.bush_heat_capacity is not None:
            require_positive("bush_heat_capacity", self.bush_heat_capacity)
        require_non_negative("housing_conductance", self.housing_conductance)
        if not 0.0 <= require_number("carry_over", self.carry_over) <= 1.0:
            raise InputError(f"carry_over must be from 0 to 1, got {self.carry_over!r}")

    @property
    def ambient(self) -> float:
        """Temperature around the housing [K]."""
        given = self.ambient_temperature
        return self.supply_temperature if given is None else given

    @property
    def coldest(self) -> float:
        """Temperature below which no film of this cooling gets [K]."""
        return (
            min(self.supply_temperature, self.ambient)
            if self.housing_conductance
            else self.supply_temperature
        )

    def capacity(self, radius: float, length: float) -> float:
        """Return the heat capacity of bush and housing [J/K] of a bearing of these dimensions [m]."""
        if self.bush_heat_capacity is not None:
            return self.bush_heat_capacity
        return STEEL * math.pi * (RING**2 - 1.0) * radius**2 * length
