"""A bearing as it runs: its film has one temperature, which follows its heat balance in time."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_finite
from ...inputs.si_arguments import quantities
from ...model import Array, Linearization
from ...native.spec import NativeSpec
from ...signals import Signal, signals_of
from ..reaction import input_vector
from .cooled import Cooled
from .cooling import require_absolute
from .heat_balance import heat_surplus
from .heated_spec import heated_spec
from .viscosity_table import viscosity_table

NOMINAL_TEMPERATURE = 300.0
"""Typical temperature [K]."""


@quantities
@dataclass(frozen=True, kw_only=True)
class HeatedBearing:
    """A bearing whose film and bush warm and cool: a Reaction with one state, the temperature.

    With the power P into the oil, the effective flow Q_e of fresh oil, and the heat capacity of bush and
    film,

        capacity dT/dt = P(T) - C (T - T_s) Q_e - G (T - T_a),

    whose rest is the heat balance of the film (`balance`). In vibration the state hardly moves, so that the
    film keeps its temperature, as it does in a bearing. `force` and `jacobian` are those at
    `start_temperature`.

    Parameters
    ----------
    bearing : JournalBearing or LobedBearing
        With oil and cooling, its temperature left to the heat balance.
    start_temperature : float or None [K]
        Temperature at t = 0; None for that of the fresh oil.

    Raises
    ------
    InputError
        If the bearing has no oil or no cooling, or the temperature is not positive.
    """

    bearing: Cooled
    start_temperature: float | None = None

    def __post_init__(self) -> None:
        _ = self.bearing.cooled
        if self.start_temperature is not None:
            require_absolute("start_temperature", self.start_temperature)

    @property
    def clearance(self) -> float:
        """Radial clearance [m]."""
        return float(self.bearing.clearance)

    @property
    def capacity(self) -> float:
        """Heat capacity of the bush, and of the oil in the concentric film [J/K]."""
        oil, cooling = self.bearing.cooled
        R, L = self.bearing.radius, self.bearing.length
        film = 2.0 * math.pi * R * L * self.clearance
        return cooling.capacity(R, L) + film * float(oil.volumetric_heat(cooling.supply_temperature))

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return self.bearing.inputs

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y, film_temperature, power_loss, side_flow."""
        force_x, force_y = self.bearing.outputs
        speed = self.inputs[4].nominal
        power = force_x.nominal * speed * self.clearance
        flow = self.clearance * self.bearing.radius * self.bearing.length * speed
        further = signals_of(
            ("film_temperature", "K", NOMINAL_TEMPERATURE, "temperature of the film"),
            ("power_loss", "W", power, "power that goes into the oil"),
            ("side_flow", "m3/s", flow, "oil that leaves at the ends"),
        )
        return (force_x, force_y, *further)

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signal temperature: of film and bush."""
        text = "temperature of film and bush"
        return signals_of(("temperature", "K", NOMINAL_TEMPERATURE, text))

    @property
    def initial_state(self) -> Array:
        """Temperature at t = 0, shape (1,) [K]."""
        start = self.start_temperature
        return np.array([self.bearing.cooled[1].supply_temperature if start is None else start])

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its film has none."""
        found = self.bearing.film_at_unit_viscosity() if type(self) is HeatedBearing else None
        if found is None or found[0].kernel.film.tables is None:
            return None
        oil, cooling = self.bearing.cooled
        values = {name: float(getattr(self.bearing, name)) for name in ("radius", "length", "clearance")}
        values |= {
            "supply_temperature": cooling.supply_temperature,
            "ambient_temperature": cooling.ambient,
            "housing_conductance": cooling.housing_conductance,
            "bush_heat_capacity": cooling.capacity(values["radius"], values["length"]),
            "volumetric_heat": float(oil.volumetric_heat(cooling.supply_temperature)),
        }
        if found[1].openings:
            values["carry_over"] = cooling.carry_over
        film = {**found[0].kernel.film.tables, **found[1].tables}
        return heated_spec(values, film, viscosity_table(oil), full_gap=cooling.full_gap)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal at the start temperature, shape (2, ...) [N]."""
        return np.asarray(self._at_start.force(position, velocity, speed))

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed) at the start temperature, shape (2, 5, ...)."""
        return np.asarray(self._at_start.jacobian(position, velocity, speed))

    def prepare(self) -> Callable[[float, float, float, float, float], tuple[float, float]]:
        """Return the force at the start temperature as a function of five numbers."""
        return self._at_start.prepare()

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs, shape (5,), at the temperature x [K] and u = (x, y, vx, vy, speed)."""
        temperature, values = self._point(x, u)
        film = self.bearing.at_temperature(temperature)
        heat = film.film_heat(values[:2], values[2:4], values[4])
        force = film.force(values[:2], values[2:4], values[4])
        return np.array([*force, temperature, heat.power, heat.side_flow])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rate of the temperature [K/s], shape (1,)."""
        temperature, values = self._point(x, u)
        heat = self.bearing.at_temperature(temperature).film_heat(values[:2], values[2:4], values[4])
        surplus, _ = heat_surplus(heat, *self.bearing.cooled, temperature)
        return np.array([surplus / self.capacity])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at the temperature x [K] and u = (x, y, vx, vy, speed).

        Raises
        ------
        InputError
            As `heat_jacobian` of the bearing, where the film law has no slopes of its losses.
        """
        temperature, values = self._point(x, u)
        oil, cooling = self.bearing.cooled
        film = self.bearing.at_temperature(temperature)
        state = values[:2], values[2:4], float(values[4])
        heat, slopes = film.film_heat(*state), film.heat_jacobian(*state)
        _, cools = heat_surplus(heat, oil, cooling, temperature)
        warmer = temperature - cooling.supply_temperature
        by_state = slopes[0] - float(oil.volumetric_heat(cooling.supply_temperature)) * warmer * slopes[1]
        thins = -float(oil.law.thinning(temperature))
        by_temperature = np.array([*(thins * film.force(*state)), 1.0, thins * heat.power, 0.0])
        by_input = np.vstack([film.jacobian(*state), np.zeros(5), slopes[0], slopes[2]])
        return Linearization(
            np.array([[cools / self.capacity]]),
            by_state[None] / self.capacity,
            by_temperature[:, None],
            by_input,
        )

    @cached_property
    def _at_start(self) -> Any:
        return self.bearing.at_temperature(float(self.initial_state[0]))

    def _point(self, x: ArrayLike, u: ArrayLike) -> tuple[float, Array]:
        state = require_finite("x", x)
        if state.shape != (1,):
            raise InputError(f"x must have shape (1,) for the temperature, got shape {state.shape}")
        return float(state[0]), input_vector(u)
