"""What bearings share whose film has a viscosity, or an oil and one temperature: stated, or in balance."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Protocol, Self

from numpy.typing import ArrayLike

from ...errors import InputError
from ...results import BearingLosses
from ..film_units import FilmUnits
from .cooled import Cooled
from .cooling import Cooling
from .heat_balance import FilmHeat, balance_temperature, film_heat
from .heated_bearing import HeatedBearing
from .lubricant import film_viscosity
from .oil import Oil


class Lubricated(Protocol):
    """The fields of a dataclass that say what its lubricant is."""

    @property
    def viscosity(self) -> float | None:
        """Dynamic viscosity [Pa s]; None with an oil."""

    @property
    def oil(self) -> Oil | None:
        """The lubricant by its viscosity over temperature."""

    @property
    def temperature(self) -> float | None:
        """Of the film [K]; None where it is left to the heat balance."""

    @property
    def cooling(self) -> Cooling | None:
        """What takes the heat away."""

    @property
    def is_warming(self) -> bool:
        """Whether the temperature of the film is left to the heat balance."""


class Warmed(Cooled, Lubricated, Protocol):
    """What `WarmBearing` is mixed into: a bearing with a lubricant, a film and losses."""

    @property
    def film(self) -> Any:
        """The film law."""

    @property
    def film_viscosity(self) -> float:
        """Dynamic viscosity of the film [Pa s]."""

    def full_gap(self, choice: bool | None) -> bool:
        """Return whether oil fills the ruptured zone."""

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow; None if the film law has none."""


class WarmBearing(FilmUnits):
    """The lubricant of a bearing and the heat of its film."""

    @property
    def film_viscosity(self: Lubricated) -> float:
        """Dynamic viscosity of the film [Pa s]; that of fresh oil where its temperature is not stated."""
        return film_viscosity(self.viscosity, self.oil, self.temperature, self.cooling)

    @property
    def is_warming(self: Lubricated) -> bool:
        """Whether the temperature of the film is left to the heat balance."""
        return self.oil is not None and self.temperature is None

    def at_temperature(self, temperature: float) -> Self:
        """Return this bearing with a film of one temperature [K]; raises InputError if it has no oil."""
        return replace(self, temperature=temperature)  # type: ignore[type-var]

    def require_temperature(self: Lubricated) -> None:
        """Raise InputError where the temperature of the film is left to the heat balance."""
        if self.is_warming:
            raise InputError(
                "temperature must be stated for a force of a bearing with oil, got None: "
                "bearing.at_temperature(T) has one, and equilibrium(bearing, ...) tells T"
            )

    @property
    def cooled(self: Lubricated) -> tuple[Oil, Cooling]:
        """Oil and cooling; InputError if one of them is not given."""
        if self.oil is None or self.cooling is None:
            raise InputError(f"oil and cooling must be given for heat, got {self.oil!r} and {self.cooling!r}")
        return self.oil, self.cooling

    def coldest(self: Warmed) -> float:
        """Return the temperature below which the film never gets [K]; raises InputError without cooling."""
        return self.cooled[1].coldest

    def film_heat(self: Warmed, position: ArrayLike, velocity: ArrayLike, speed: float) -> FilmHeat:
        """Return the heat that the film makes and takes along at one state, at its temperature.

        Parameters
        ----------
        position, velocity : array_like, shape (2,) [m], [m/s]
        speed : float [rad/s]

        Raises
        ------
        InputError
            If the bearing has no cooling, or its film law knows no losses.
        FilmContactError
            If the journal touches the wall.
        """
        _, cooling = self.cooled
        losses = self.losses(position, velocity, speed)
        if losses is None:
            raise InputError(f"film must be one with losses for heat, by default a map, got {self.film!r}")
        return film_heat(losses, self.film_viscosity, cooling)

    def balanced(self) -> Any:
        """Return the bearing in balance at every state; None if nothing compiles it."""
        return None

    def balanced_temperature(self: Warmed, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature at which the heat of the film balances at one state [K].

        Parameters and errors are those of `film_heat`.
        """
        oil, cooling = self.cooled
        found = self.at_temperature(cooling.coldest).film_heat(position, velocity, speed)
        return balance_temperature(found, oil, cooling)

    def in_time(self: Warmed, start_temperature: float | None = None) -> HeatedBearing:
        """Return the bearing whose film warms and cools over time.

        Parameters
        ----------
        start_temperature : float or None [K]
            As that of an equilibrium; None for that of the fresh oil.
        """
        return HeatedBearing(bearing=self, start_temperature=start_temperature)

    def full_gap(self: Lubricated, choice: bool | None) -> bool:
        """Return whether oil fills the ruptured zone: a choice, or where that is None that of the cooling."""
        if choice is None:
            return self.cooling is not None and self.cooling.full_gap
        return choice
