"""A journal bearing whose film has, at every state, the temperature at which its heat balances."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ....errors import InputError, warn_user
from ....inputs.si_arguments import quantities
from ....model import Array, Tangent
from ....native import JournalKernel, Status
from ....native.heated_kernel import BalancedBatch, BalancedKernel
from ...films.kernel_film import BoundKernel
from ...oil import Oil
from ...oil.cooled import Cooled
from ...oil.viscosity_table import viscosity_table
from ...reaction import StaticReaction, broadcast_state


@quantities
@dataclass(frozen=True, kw_only=True)
class BalancedBearing(StaticReaction):
    """A journal bearing in the balance of its heat at every state: a static Reaction.

    Its derivatives are the relaxed ones, of changes so slow that the temperature follows:

        K_relaxed = K - F_T B_x/B_T,   C_relaxed = C - F_T B_v/B_T,

    with the heat B that is left over, its derivatives by position, velocity and temperature, and F_T the
    derivative of the force by temperature. That is right for equilibria and for slow changes of load and
    speed. Vibration leaves the temperature where it is: never judge stability by these matrices.

    Parameters
    ----------
    bearing : JournalBearing
        With oil and cooling; its film law has losses in the C library, as `MapFilm` has and `ShortFilm`.
    """

    bearing: Cooled

    @property
    def clearance(self) -> float:
        """Radial clearance [m]."""
        return float(self.bearing.clearance)

    @property
    def nominal_force(self) -> float:
        """Typical force [N]."""
        return self.bearing.outputs[0].nominal

    def temperature(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the temperature of the film [K], shape (...), at states as in `force`."""
        q, v, omega = broadcast_state(position, velocity, speed)
        return self._batch(q, v, omega, slopes=False).temperature.reshape(omega.shape)

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers; see `prepared_tangent`."""
        call, report = self._kernel.tangent, self._report

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            force_x, force_y, slopes, temperature, status = call(x, y, vx, vy, speed)
            if status:
                report(status, temperature, (x, y, vx, vy, speed))
            return force_x, force_y, slopes

        return tangent

    def heat_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return d(power, effective flow, side flow)/d(x, y, vx, vy, speed) at 1 Pa s, shape (3, 5)."""
        q, v, omega = broadcast_state(position, velocity, speed)
        state = [*q.tolist(), *v.tolist(), float(omega)]
        slopes, status = self._kernel.heat_slopes(state)
        if status:
            self._film.report(status, *state)
        return slopes

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return self._batch(position, velocity, speed, slopes=False).force.reshape(position.shape)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return self._batch(position, velocity, speed).jacobian.reshape(2, 5, *speed.shape)

    def _batch(self, q: Array, v: Array, omega: Array, *, slopes: bool = True) -> BalancedBatch:
        states = np.concatenate([q.reshape(2, -1), v.reshape(2, -1), omega.reshape(1, -1)])
        batch = self._kernel.batch(states, slopes=slopes)
        if batch.status:
            self._report(batch.status, float(batch.temperature[batch.first]), states[:, batch.first].tolist())
        return batch

    @cached_property
    def _film(self) -> BoundKernel:
        """The film at unit viscosity."""
        found = self.bearing.film_at_unit_viscosity()
        if found is None:
            raise InputError("film must have losses in the C library, as MapFilm")
        return found[0]

    @cached_property
    def _kernel(self) -> BalancedKernel:
        found = self.bearing.film_at_unit_viscosity()
        assert found is not None  # checked in `_film`
        journal, (oil, cooling) = self._film.kernel, self.bearing.cooled
        assert isinstance(journal, JournalKernel)  # of any bearing with losses in the C library
        numbers = {
            "radius": float(self.bearing.radius),
            "length": float(self.bearing.length),
            "clearance": self.clearance,
            "supply": cooling.supply_temperature,
            "ambient": cooling.ambient,
            "conductance": cooling.housing_conductance,
            "volumetric_heat": float(oil.volumetric_heat(cooling.supply_temperature)),
            "carry_over": cooling.carry_over,
            "full_gap": cooling.full_gap,
        }
        return BalancedKernel(journal, found[1], viscosity_table(oil), numbers)

    def _report(self, status: int, temperature: float, state: Any) -> None:
        """Raise, or warn, about a state that has this status."""
        table = viscosity_table(_oil(self.bearing))
        if status == Status.STUCK:
            raise InputError(
                "housing_conductance must be positive where no oil leaves the film, as of a centered one, "
                f"got 0 at position ({state[0]:g}, {state[1]:g}) m"
            )
        if status == Status.OUTSIDE and not table.coldest <= temperature <= table.hottest:
            warn_user(
                f"temperature should be from {table.coldest:g} to {table.hottest:g} K, where the oil is "
                f"tabulated, got {temperature:.6g} K"
            )
            return
        self._film.report(status, *state)


def _oil(bearing: Cooled) -> Oil:
    return bearing.cooled[0]
