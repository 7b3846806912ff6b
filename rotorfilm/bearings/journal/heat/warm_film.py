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
from ...oil.heat_balance import FilmHeat, balance_temperature, fed_temperature
from ...oil.warm_bearing import WarmBearing, Warmed
from ...reaction import broadcast_state
from ..bearing_losses import LossyBearing, bearing_losses
from .balanced_bearing import BalancedBearing


class _Bearing(Warmed, LossyBearing, Protocol):
    """What `WarmFilm` is mixed into."""

    @property
    def in_balance(self) -> BalancedBearing | None: ...


class WarmFilm(WarmBearing):
    """The heat of a `JournalBearing`."""

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
        state = broadcast_state(position, velocity, speed)
        return bearing_losses(self, *state, full_gap=self.full_gap(full_gap))

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
        scale = self.film_length * self.radius**3 / self.clearance**2
        film = law.bind(slenderness=self.slenderness, clearance=self.clearance, force_scale=scale)
        found = losses is not None and isinstance(film, BoundKernel) and self.supply_pressure == 0.0
        return (film, losses) if found else None  # type: ignore[return-value]

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
