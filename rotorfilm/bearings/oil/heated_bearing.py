"""A bearing as it runs: its film has one temperature, which follows its heat balance in time."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import InputError, require_finite
from ...core.inputs import quantities
from ...core.model import Array, Linearization
from ...core.results import BearingLosses
from ...core.signals import Signal, signals_of
from ...native.loss_kernels import OilTable
from ...native.spec import NativeSpec, parameter
from ..reaction import FilmUnits, input_vector
from .heat_balance import Cooled, FilmHeat, balance_temperature, film_heat, film_viscosity, heat_surplus
from .oil import Cooling, Oil, require_absolute, viscosity_table

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


# The kernel of the C library that is a journal bearing whose oil warms.


_PARAMETERS = (
    ("radius", "m", "bearing radius; fixed, as the map of the film holds for this length / diameter"),
    ("length", "m", "axial length; fixed, as the map of the film holds for this length / diameter"),
    ("clearance", "m", "radial clearance"),
    ("supply_temperature", "K", "temperature of the fresh oil"),
    ("ambient_temperature", "K", "temperature around the housing"),
    ("housing_conductance", "W/K", "heat flow through bush and housing per kelvin between film and ambient"),
    ("bush_heat_capacity", "J/K", "heat capacity of bush and housing"),
    ("volumetric_heat", "J/(m3.K)", "density times heat capacity of the oil"),
    ("carry_over", "1", "share of the oil arriving at an opening that goes on, 0 to 1"),
)

_FIXED = {"radius", "length"}


def heated_spec(
    values: Mapping[str, float], film: Mapping[str, Array], oil: OilTable, *, full_gap: bool
) -> NativeSpec:
    """Return the kernel of a bearing whose oil warms.

    Parameters
    ----------
    values : mapping of str to float
        Of its parameters, in SI; `carry_over` where there are openings.
    film : mapping of str to ndarray
        Tables of the film and of its losses; empty for the short film.
    oil : OilTable
    full_gap : bool
        Whether oil fills the gap also where the film is ruptured.
    """
    parameters = tuple(
        parameter(name, unit, values[name], description, tunable=name not in _FIXED)
        for name, unit, description in _PARAMETERS
        if name in values
    )
    tables = {
        **film,
        "oil": oil.coefficients,
        "oil_range": np.array([oil.coldest, oil.hottest]),
        "full_gap": np.array([float(full_gap)]),
    }
    kernel = "heated_grooved_journal" if "carry_over" in values else "heated_journal"
    return NativeSpec(kernel=kernel, parameters=parameters, tables=tables)


# What bearings share whose film has a viscosity, or an oil and one temperature: stated, or in balance.


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
