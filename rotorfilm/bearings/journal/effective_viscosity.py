"""A journal bearing whose film has, at every state, the temperature at which its heat balances."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import InputError, brief, require_inside, warn_user
from ...core.inputs import arguments, quantities
from ...core.model import Array, Tangent
from ...core.results import BearingLosses
from ...native import JournalKernel, Status
from ...native.loss_kernels import BalancedBatch, BalancedKernel, LossKernel
from ..films.geometry import FilmGeometry
from ..films.kernel_film import BoundKernel
from ..films.law import FilmLaw, FilmOptions, options
from ..oil import Oil
from ..oil.heat_balance import Cooled, FilmHeat, balance_temperature, fed_temperature
from ..oil.heated_bearing import WarmBearing, Warmed
from ..oil.oil import viscosity_table
from ..reaction import Dimensions, StaticReaction, broadcast_state


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


# Power loss, torques on journal and bush, and oil flow of a bearing, from the losses of its film law.


class LossyBearing(Dimensions, Protocol):
    """What losses need to know of a bearing: see `JournalBearing`."""

    @property
    def supply_pressure(self) -> float:
        """Gauge pressure in the grooves [Pa]."""

    @property
    def slenderness(self) -> float:
        """Length / diameter [1]."""

    @property
    def geometry(self) -> FilmGeometry:
        """Pads, grooves and supply."""

    @property
    def fitted_film(self) -> FilmLaw:
        """The film law in this geometry."""

    def kinematics(self, position: Array, velocity: Array, speed: Array) -> tuple[Array, Array]:
        """Return eccentricity and source of the film laws."""

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal [N]."""


def bearing_losses(
    bearing: LossyBearing, position: Array, velocity: Array, speed: Array, *, full_gap: bool = False
) -> BearingLosses | None:
    """Return what the film takes from the shaft, and the oil that runs through it.

    Parameters
    ----------
    bearing : JournalBearing
    position, velocity : ndarray, shape (2, ...) [m], [m/s]
        Of the journal's center.
    speed : ndarray, shape (...) [rad/s]
        Angular speed about +z, of either sign.
    full_gap : bool, optional
        Whether oil fills the gap in the ruptured zone too, as Raimondi & Boyd (1958) have it, an upper bound.
        By default streamers run there, with the thickness at which the film ended: 5 to 22 % less shear.

    Returns
    -------
    BearingLosses or None
        None if the film law has no losses.

    Raises
    ------
    FilmContactError
        If a journal touches the wall.

    Notes
    -----
    With E = position, F the force on the journal and M = viscosity speed (R^3 L/c) Sigma the torque on the
    journal is M + (E x F)_z/2 and that on the bush M - (E x F)_z/2: the difference balances the moment of the
    force. The pressure flow dissipates -F . W, W = velocity - (speed/2) z^ x E, and what a supply pressure
    pushes through the film, so that the power is speed M - F . W + supply_pressure (inflow - arriving).
    """
    require_inside(position, bearing.clearance)
    e, w = bearing.kinematics(position, velocity, speed)
    law = options(bearing.fitted_film, FilmOptions)
    found = law.losses(e, w, bearing.slenderness, 0.5 * speed)
    if found is None:
        return None
    force = bearing.force(position, velocity, speed)
    shear = found.shear_gap if full_gap else found.shear
    per_shear = bearing.film_viscosity * bearing.radius**3 * bearing.film_length / bearing.clearance
    drag = per_shear * speed * shear
    half = 0.5 * (position[0] * force[1] - position[1] * force[0])
    flow = bearing.clearance * bearing.radius * bearing.film_length
    inflow, arriving = flow * found.inflow, flow * found.arriving
    supplied = bearing.supply_pressure * (_supplied(bearing, inflow - arriving)).sum(axis=0)
    power = (drag + half) * speed - (force * velocity).sum(axis=0) + supplied
    return BearingLosses(
        power_loss=_number(power),
        friction_torque=_number(drag + half),
        bush_torque=_number(drag - half),
        side_flow=_number(flow * found.side_flow),
        inflow=inflow,
        arriving=arriving,
    )


def has_losses(bearing: LossyBearing) -> bool:
    """Return whether the film law of a bearing has losses."""
    return type(options(bearing.fitted_film, FilmOptions)).losses is not FilmOptions.losses


def _supplied(bearing: LossyBearing, flow: Array) -> Array:
    """Return the flow of those openings that are supplied; one that touches another counts as that."""
    held = [opening.held for opening in bearing.geometry.openings()]
    return flow[np.array(held) > 0.0] if len(held) == len(flow) else flow


def _number(values: Array) -> float | Array:
    """Return a single number as such."""
    return float(values) if np.ndim(values) == 0 else values


# What a journal bearing says of its heat: power, flow, and the temperature at which they balance.


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


# The numbers that say which model of a film's heat is enough.


class HeatNumbers(NamedTuple):
    """Numbers of a film at rest with the viscosity of fresh oil.

    Attributes
    ----------
    thinning_rise : float [1]
        E = thinning P/(C Q): what the oil thins where all heat leaves with the oil that leaks. The error of a
        film at supply temperature.
    peclet : float [1]
        Pe = speed clearance^2 C/k: heat that flows along the film over heat that crosses it.
    nahme : float [1]
        Na = thinning viscosity (speed radius)^2/k: what heat from shear alone thins across the film.
    """

    thinning_rise: float
    peclet: float
    nahme: float


@arguments
def heat_numbers(bearing: Cooled, position: ArrayLike, speed: float) -> HeatNumbers:
    """Return the numbers of the heat of a bearing with oil and cooling.

    Parameters
    ----------
    bearing : JournalBearing
    position : array_like, shape (2,) [m]
        Of the journal, off the center: where the film at supply temperature carries the load.
    speed : float [rad/s]

    Raises
    ------
    InputError
        If the bearing has no oil or no cooling, its film law knows no losses, or no oil leaves its film.
    FilmContactError
        If the journal touches the wall.
    """
    oil, cooling = bearing.cooled
    supply = cooling.supply_temperature
    heat = bearing.at_temperature(supply).film_heat(position, np.zeros(2), speed)
    if not heat.side_flow > 0.0:
        raise InputError(f"position must be off the center, where oil leaves the film, got {brief(position)}")
    capacity, thinning = float(oil.volumetric_heat(supply)), float(oil.thinning(supply))
    return HeatNumbers(
        thinning * heat.power / (capacity * heat.side_flow),
        abs(speed) * bearing.clearance**2 * capacity / oil.conductivity,
        thinning * heat.viscosity * (speed * bearing.radius) ** 2 / oil.conductivity,
    )
