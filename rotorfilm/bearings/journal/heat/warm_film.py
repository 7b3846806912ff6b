"""What a journal bearing says of its heat: power, flow, and the temperature at which they balance."""

from __future__ import annotations

from functools import cached_property
from typing import Protocol

from numpy.typing import ArrayLike

from ....errors import InputError
from ....model import Array
from ....native.loss_kernels import LossKernel
from ....results import BearingLosses
from ...films.kernel_film import BoundKernel
from ...films.law import FilmOptions, options
from ...oil import Cooling, Oil
from ...reaction import broadcast_state
from ..bearing_losses import bearing_losses
from .balanced_bearing import BalancedBearing
from .cooled import Cooled
from .heat_balance import FilmHeat, balance_temperature, fed_temperature, film_heat
from .heated_bearing import HeatedBearing


class _Bearing(Cooled, Protocol):
    """What `WarmFilm` is mixed into."""

    @property
    def oil(self) -> Oil | None: ...

    @property
    def cooling(self) -> Cooling | None: ...

    @property
    def in_balance(self) -> BalancedBearing | None: ...

    def heat_jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array: ...

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses | None: ...


class WarmFilm:
    """The heat of a `JournalBearing`."""

    @property
    def cooled(self: _Bearing) -> tuple[Oil, Cooling]:
        """Oil and cooling; InputError if one of them is not given."""
        if self.oil is None or self.cooling is None:
            raise InputError(f"oil and cooling must be given for heat, got {self.oil!r} and {self.cooling!r}")
        return self.oil, self.cooling

    def coldest(self: _Bearing) -> float:
        """Return the temperature below which the film never gets [K]; raises InputError without cooling."""
        return self.cooled[1].coldest

    def losses(
        self: _Bearing,
        position: ArrayLike,
        velocity: ArrayLike,
        speed: ArrayLike,
        *,
        full_gap: bool | None = None,
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow; see `bearing_losses`. None if the film law has none.

        Where `full_gap` is None, it is that of the cooling, or false.
        """
        if full_gap is None:
            full_gap = self.cooling is not None and self.cooling.full_gap
        return bearing_losses(self, *broadcast_state(position, velocity, speed), full_gap=full_gap)

    def film_heat(self: _Bearing, position: ArrayLike, velocity: ArrayLike, speed: float) -> FilmHeat:
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
            raise InputError(f"film must be one with losses for heat, as a MapFilm, got {self.fitted_film!r}")
        return film_heat(losses, self.film_viscosity, cooling)

    def heat_jacobian(self: _Bearing, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return d(power, effective flow, side flow)/d(x, y, vx, vy, speed) at one temperature, shape (3, 5).

        Parameters and errors are those of `film_heat`; InputError too if the film law has no slopes of its
        losses.
        """
        _ = self.cooled
        if self.in_balance is None:
            raise InputError(f"film must have slopes of its losses, as MapFilm, got {self.fitted_film!r}")
        return self.in_balance.heat_slopes(position, velocity, speed) * [[self.film_viscosity], [1.0], [1.0]]

    def film_at_unit_viscosity(self: _Bearing) -> tuple[BoundKernel, LossKernel] | None:
        """Return the compiled film at 1 Pa s and its losses; None if the film law has not both, or is fed."""
        law = options(self.fitted_film, FilmOptions)
        losses = law.loss_kernel(self.slenderness)
        scale = self.length * self.radius**3 / self.clearance**2
        film = law.bind(slenderness=self.slenderness, clearance=self.clearance, force_scale=scale)
        found = losses is not None and isinstance(film, BoundKernel) and self.supply_pressure == 0.0
        return (film, losses) if found else None  # type: ignore[return-value]

    def in_time(self: _Bearing, start_temperature: float | None = None) -> HeatedBearing:
        """Return the bearing whose film warms and cools over time.

        Parameters
        ----------
        start_temperature : float or None [K]
            As that of an equilibrium; None for that of the fresh oil.
        """
        return HeatedBearing(bearing=self, start_temperature=start_temperature)

    def balanced(self: _Bearing) -> BalancedBearing | None:
        """Return the bearing in balance at every state; None if nothing compiles its film."""
        return self.in_balance

    @cached_property
    def in_balance(self: _Bearing) -> BalancedBearing | None:
        """What `balanced` returns, made once."""
        _ = self.cooled
        return None if self.film_at_unit_viscosity() is None else BalancedBearing(bearing=self)

    def balanced_temperature(self: _Bearing, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature at which the heat of the film balances at one state [K].

        Parameters and errors are those of `film_heat`.
        """
        oil, cooling = self.cooled
        if self.in_balance is not None:
            return float(self.in_balance.temperature(position, velocity, speed))

        def heat(temperature: float) -> FilmHeat:
            found: FilmHeat = self.at_temperature(temperature).film_heat(position, velocity, speed)
            return found

        if self.supply_pressure == 0.0:
            return balance_temperature(heat(cooling.coldest), oil, cooling)
        return fed_temperature(heat, oil, cooling)
