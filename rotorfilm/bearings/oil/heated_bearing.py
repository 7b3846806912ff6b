"""A bearing as it runs: its film has one temperature, which follows its heat balance in time."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, Self, cast

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import ConvergenceError, InputError, require_finite, require_kind, require_positive
from ...core.inputs import quantities
from ...core.model import Array, Linearization
from ...core.results import BearingLosses
from ...core.signals import Signal, signals_of
from ...native.film_call import FilmCall
from ...native.loss_kernels import OilTable
from ...native.spec import NativeSpec, parameter
from ..films.mobility import Mobility
from ..films.turbulence import Turbulence
from ..reaction import input_vector
from .oil import (
    DENSITY,
    HOTTEST_OIL,
    Cooling,
    LaminarFilm,
    Oil,
    relative_density,
    require_absolute,
    viscosity_table,
)

NOMINAL_TEMPERATURE = 300.0
"""Typical temperature [K]."""


@quantities
@dataclass(frozen=True, kw_only=True)
class HeatedBearing:
    """A bearing whose film and bush warm and cool: a Reaction with one state, the temperature.

    With the power P into the oil, the effective flow Q_e of fresh oil, and the heat capacity of bush and
    film,

        capacity dT/dt = P(T) - C (T - T_s) Q_e - G (T - T_a),

    whose steady state is the heat balance of the film (`balance`). During vibration the state hardly changes,
    so the film keeps its temperature, as in a real bearing. `force` and `jacobian` are those at
    `start_temperature`.

    Parameters
    ----------
    bearing : JournalBearing or LobedBearing
        Bearing with oil and cooling, whose temperature the heat balance determines.
    start_temperature : float or None [K]
        Temperature at t = 0; None for that of the fresh oil.

    Raises
    ------
    InputError
        If the bearing has no oil or no cooling, or the temperature is not positive.
    """

    bearing: WarmBearing
    start_temperature: float | None = None

    def __post_init__(self) -> None:
        _ = self.bearing.cooled
        if self.start_temperature is not None:
            require_absolute("start_temperature", self.start_temperature)

    @property
    def clearance(self) -> float:
        """Radial clearance [m]."""
        return float(self.bearing.clearance)

    @cached_property
    def capacity(self) -> float:
        """Heat capacity of the bush and of the oil in the concentric film, together [J/K]."""
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
        """Signal temperature, the common temperature of film and bush."""
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

    @property
    def temperature_range(self) -> tuple[float, float]:
        """Lowest and highest temperature [K] at which loops in C know the oil."""
        table = viscosity_table(self.bearing.cooled[0])
        return table.coldest, table.hottest

    def call_with_states(self) -> FilmCall | None:
        """Return force and rate of the temperature for loops in C (`rf_warming_at`); None without one."""
        return None if self._in_balance is None else self._in_balance.warming_call(self.capacity)

    def outputs_over_time(self, states: Array, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the outputs at many states and motions of a film that has a `call_with_states`.

        Parameters
        ----------
        states : ndarray, shape (1, n) [K]
        position, velocity : ndarray, shape (2, n) [m], [m/s]
        speed : ndarray, shape (n,) [rad/s]

        Returns
        -------
        ndarray, shape (5, n)
        """
        film, oil = self._at_start, self.bearing.cooled[0]
        thinner = oil.law.viscosity(states[0]) / film.film_viscosity
        losses = film.losses(position, velocity, speed)
        force = thinner * film.force(position, velocity, speed)
        return np.array([*force, states[0], thinner * losses.power_loss, losses.side_flow])

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
        if self._in_balance is not None and (unit := self._in_balance.heat(values.tolist())) is not None:
            heat, viscosity = self._warmed(unit, temperature)
            return np.array(
                [
                    viscosity * unit.force[0],
                    viscosity * unit.force[1],
                    temperature,
                    heat.power,
                    heat.side_flow,
                ]
            )
        film = self.bearing.at_temperature(temperature)
        heat = film.film_heat(values[:2], values[2:4], values[4])
        force = film.force(values[:2], values[2:4], values[4])
        return np.array([*force, temperature, heat.power, heat.side_flow])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rate of the temperature [K/s], shape (1,)."""
        temperature, values = self._point(x, u)
        if self._in_balance is not None and (unit := self._in_balance.heat(values.tolist())) is not None:
            heat, _ = self._warmed(unit, temperature)
        else:
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
        found = None if self._in_balance is None else self._in_balance.heat_and_slopes(values.tolist())
        if found is not None:
            unit, by = found
            heat, viscosity = self._warmed(unit, temperature)
            force = viscosity * np.array(unit.force)
            force_slopes = viscosity * np.array(by.force).reshape(2, 5)
            slopes = np.array([by.drag, by.flow, by.leak]) * [[viscosity], [1.0], [1.0]]
        else:
            film = self.bearing.at_temperature(temperature)
            state = values[:2], values[2:4], float(values[4])
            heat, slopes = film.film_heat(*state), film.heat_jacobian(*state)
            force, force_slopes = film.force(*state), film.jacobian(*state)
        _, cools = heat_surplus(heat, oil, cooling, temperature)
        warmer = temperature - cooling.supply_temperature
        by_state = slopes[0] - float(oil.volumetric_heat(cooling.supply_temperature)) * warmer * slopes[1]
        thins = -float(oil.law.thinning(temperature))
        by_temperature = np.array([*(thins * force), 1.0, thins * heat.power, 0.0])
        by_input = np.vstack([force_slopes, np.zeros(5), slopes[0], slopes[2]])
        return Linearization(
            np.array([[cools / self.capacity]]),
            by_state[None] / self.capacity,
            by_temperature[:, None],
            by_input,
        )

    @cached_property
    def _in_balance(self) -> Any:
        """The bearing at every state in the balance of its heat, with its film in C; None without one."""
        return self.bearing.balanced() if type(self) is HeatedBearing else None

    def _warmed(self, unit: Any, temperature: float) -> tuple[FilmHeat, float]:
        """Return the heat of a film with an rf_heat at 1 Pa s, at a temperature [K], and its viscosity."""
        viscosity = float(self.bearing.cooled[0].law.viscosity(temperature))
        return FilmHeat(viscosity * unit.drag, viscosity, unit.flow, unit.leak), viscosity

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
        Values of its parameters, in SI; `carry_over` where there are openings.
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


class SelfHeatedFilm:
    """A film that has one temperature, that of its own heat: where it balances at one state."""

    if TYPE_CHECKING:
        at_temperature: Any
        coldest: Any
        film_heat: Any

        @property
        def cooled(self) -> tuple[Oil, Cooling]:
            """Its oil and how that is cooled."""

        @property
        def reshapes(self) -> bool:
            """Whether the shape of the film depends on its viscosity."""

    @cached_property
    def fresh(self) -> Self:
        """The film at the temperature below which it never gets."""
        return self.at_temperature(self.coldest())

    def balanced_temperature(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature at which the heat of the film balances at one state [K].

        Parameters and errors are those of `film_heat`.
        """

        def heat(temperature: float) -> FilmHeat:
            film = self.fresh if temperature == self.coldest() else self.at_temperature(temperature)
            return film.film_heat(position, velocity, speed)

        return film_temperature(heat, *self.cooled, reshapes=self.reshapes)

    def next_temperature(self, position: ArrayLike, speed: float) -> float:
        """Return where the heat of this film at its own temperature would balance, its flow held [K]."""
        return balance_temperature(self.film_heat(position, np.zeros(2), speed), *self.cooled)


class WarmBearing(LaminarFilm, SelfHeatedFilm):
    """The lubricant of a bearing and the heat of its film; fields, force, losses are those of a subclass."""

    if TYPE_CHECKING:
        radius: float
        length: float
        viscosity: float | None
        oil: Oil | None
        temperature: float | None
        cooling: Cooling | None
        supply_pressure: float
        inputs: Any
        outputs: Any
        film: Any
        force: Any
        jacobian: Any
        losses: Any
        prepare: Any
        heat_jacobian: Any
        film_at_unit_viscosity: Any

        @property
        def clearance(self) -> float:
            """Radial clearance [m]."""

    turbulence: Turbulence | None = None

    @property
    def turbulent_mobility(self) -> Mobility | None:
        """Mobility of the oil at its temperature by the turbulence of the bearing; None of a laminar one."""
        if self.turbulence is None:
            return None
        return self.turbulence.mobility(self.radius, self.onset_clearance, self.film_density)

    @property
    def onset_clearance(self) -> float:
        """Clearance whose Taylor number decides where turbulence begins [m], of pads that of the bore."""
        return float(getattr(self, "bore_clearance", self.clearance))

    @property
    def film_density(self) -> float:
        """Density of the oil at the temperature of the film, or of fresh oil [kg/m3]."""
        if self.oil is None:
            return DENSITY
        return self.oil.reference_density * float(relative_density(self._stated_temperature))

    @property
    def _stated_temperature(self) -> float:
        return (
            cast(Cooling, self.cooling).supply_temperature if self.temperature is None else self.temperature
        )

    @property
    def film_viscosity(self) -> float:
        """Dynamic viscosity of the film [Pa s]; that of fresh oil where its temperature is not stated."""
        if self.oil is None:
            return cast(float, self.viscosity)
        return float(self.oil.law.viscosity(self._stated_temperature))

    def viscosity_slope(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return d force/d viscosity at one state, the density held [N/(Pa s)], shape (2,).

        At a Reynolds number the force is of degree one in viscosity times velocity and speed, so that its
        derivative by ln Re is that by velocity and speed along themselves, less the force.

        Raises
        ------
        InputError
            As `force`, and if openings are under a supply pressure, which the viscosity does not scale.
        """
        if getattr(self, "supply_pressure", 0.0):
            raise InputError(
                f"supply_pressure must be 0 for a slope by viscosity, got {self.supply_pressure!r}"
            )
        force, by = (np.asarray(of(position, velocity, speed)) for of in (self.force, self.jacobian))
        by_reynolds = by[:, 2:4] @ np.asarray(velocity, dtype=float) + by[:, 4] * speed - force
        return np.asarray((force - by_reynolds) / self.film_viscosity)

    @property
    def is_warming(self) -> bool:
        """Whether the temperature of the film is left to the heat balance."""
        return self.oil is not None and self.temperature is None

    def at_temperature(self, temperature: float) -> Self:
        """Return this bearing with a film of one temperature [K]; raises InputError if it has no oil."""
        return replace(self, temperature=temperature)  # type: ignore[type-var]

    def require_temperature(self) -> None:
        """Raise InputError where the temperature of the film is left to the heat balance."""
        if self.is_warming:
            raise InputError(
                "temperature must be stated for a force of a bearing with oil, got None: "
                "bearing.at_temperature(T) has one, and equilibrium(bearing, ...) tells T"
            )

    @property
    def cooled(self) -> tuple[Oil, Cooling]:
        """Oil and cooling; InputError if one of them is not given."""
        if self.oil is None or self.cooling is None:
            raise InputError(f"oil and cooling must be given for heat, got {self.oil!r} and {self.cooling!r}")
        return self.oil, self.cooling

    def require_liquid(self, temperature: float) -> None:
        """Raise InputError where a balance is at a temperature [K] at which there is no oil."""
        require_liquid(temperature)

    def coldest(self) -> float:
        """Return the temperature below which the film never gets [K]; raises InputError without cooling."""
        return self.cooled[1].coldest

    def film_heat(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> FilmHeat:
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

    @property
    def reshapes(self) -> bool:
        """Whether the shape of the film depends on its viscosity, so that each temperature has its own."""
        return self.turbulence is not None

    def in_time(self, start_temperature: float | None = None) -> HeatedBearing:
        """Return the bearing whose film warms and cools over time.

        Parameters
        ----------
        start_temperature : float or None [K]
            Start temperature as that of an equilibrium; None for that of the fresh oil.
        """
        return HeatedBearing(bearing=self, start_temperature=start_temperature)

    def full_gap(self, choice: bool | None) -> bool:
        """Return whether oil fills the ruptured zone: a choice, or where that is None that of the cooling."""
        if choice is None:
            return self.cooling is not None and self.cooling.full_gap
        return choice


# One temperature for a whole film: the heat that friction makes against what oil and housing take away.
#
# With the power P = mu(T) A and the flow Q_e of a film at a state of the journal, the balance is
#
#     A mu(T) = C (T - T_s) Q_e + G (T - T_a),                                                         (1)
#
# C the heat capacity of the oil per volume, T_s the supply, T_a the ambient temperature and G the conductance
# of the housing. The left side falls with T and the right side rises, so there is one root. Newton's method
# from below climbs to it without a step beyond, since the difference is convex.
#
# At an opening Q_1 leaves into the film and Q_2 arrives, of which the share lambda clings to the shaft and
# goes on. A film takes no more than its intake, so that the share a of Q_1 is hot, a smooth minimum of
# x = lambda Q_2/Q_1 and 1:
#
#     a = x - w ln(1 + exp((x - 1)/w)),  w = 0.05,  above lambda = 0.8 w = max((1 - lambda)/4, 0.01).    (2)
#
# The rest of what arrives leaves the opening. With a temperature that rises linearly from one opening to the
# next, one for all arcs, the oil takes as much heat along as the effective flow
#
#     Q_e = Q + sum 2 (Q_2 - a Q_1)/(1 + a)                                                            (3)
#
# would at the film's temperature, where Q = sum(Q_1 - Q_2) leaks.


_STEPS = 60
_ROUNDOFF = 1e-14
_KELVIN = 1e-9
_WIDEST, _NARROWEST = 0.05, 0.01
_FULL = 1e3
"""Share x of (2) beyond which an opening gives only oil that arrived, to the last digit."""


class FilmHeat(NamedTuple):
    """What a film makes and carries of heat at one state of the journal.

    Attributes
    ----------
    power : float [W]
        Power that goes into the oil.
    viscosity : float [Pa s]
        Viscosity at which that is.
    flow : float [m3/s]
        Effective flow Q_e of fresh oil.
    side_flow : float [m3/s]
        Oil that leaks at the ends.
    """

    power: float
    viscosity: float
    flow: float
    side_flow: float


def film_heat(losses: BearingLosses, viscosity: float, cooling: Cooling) -> FilmHeat:
    """Return the heat of a film by its losses at one state and one viscosity [Pa s]."""
    side_flow = float(losses.side_flow)
    flow = effective_flow(side_flow, losses.inflow, losses.arriving, cooling.carry_over)
    return FilmHeat(float(losses.power_loss), viscosity, flow, side_flow)


def effective_flow(side_flow: float, inflow: Array, arriving: Array, carry_over: float) -> float:
    """Return Q_e of (3) [m3/s].

    Parameters
    ----------
    side_flow : float [m3/s]
        Oil that leaks.
    inflow, arriving : ndarray, shape (openings,) [m3/s]
        Q_1 into the film and Q_2 that arrives from it, at each opening.
    carry_over : float [1]
        lambda, the share of Q_2 that goes on into the next film.
    """
    entering, coming = inflow.clip(min=0.0), arriving.clip(min=0.0)
    share, _, _ = carried_share(entering, coming, carry_over)
    return side_flow + float((2.0 * (coming - share * entering) / (1.0 + share)).sum())


def flow_slopes(inflow: Array, arriving: Array, carry_over: float) -> tuple[Array, Array]:
    """Return the derivatives of the sum in (3) by Q_1 and by Q_2, (openings,) [1]; arguments as above."""
    entering, coming = inflow.clip(min=0.0), arriving.clip(min=0.0)
    share, by_inflow, by_arriving = carried_share(entering, coming, carry_over)
    pull, whole = 2.0 * (entering + coming) / (1.0 + share) ** 2, 1.0 + share
    by_1 = np.where(inflow > 0.0, -2.0 * share / whole - pull * by_inflow, 0.0)
    return by_1, np.where(arriving > 0.0, 2.0 / whole - pull * by_arriving, 0.0)


def carried_share(inflow: Array, arriving: Array, carry_over: float) -> tuple[Array, Array, Array]:
    """Return a of (2) and its derivatives by both flows, which are not negative, (openings,) each.

    It is 1 of an opening that gives nothing.
    """
    width = max(_NARROWEST, min(_WIDEST, 0.25 * (1.0 - carry_over)))
    least = np.maximum(inflow, carry_over * arriving / _FULL)
    gives = least > 0.0
    x = np.where(gives & (inflow > 0.0), carry_over * arriving / np.where(gives, least, 1.0), _FULL)
    z = (x - 1.0) / width
    per_inflow = np.exp(-np.logaddexp(0.0, z)) / np.where(gives, least, 1.0)
    share = np.minimum(x, 1.0) - width * np.log1p(np.exp(-np.abs(z)))
    return share, -x * per_inflow, carry_over * per_inflow


def heat_surplus(heat: FilmHeat, oil: Oil, cooling: Cooling, temperature: float) -> tuple[float, float]:
    """Return heat made less heat taken away at a temperature [W], and its derivative [W/K]; (1)."""
    return _surplus(heat, oil, cooling, temperature, _carried(heat, oil, cooling))


def _carried(heat: FilmHeat, oil: Oil, cooling: Cooling) -> float:
    """Return the heat that the oil carries away [W/K]."""
    return float(oil.volumetric_heat(cooling.supply_temperature)) * heat.flow


def _surplus(
    heat: FilmHeat, oil: Oil, cooling: Cooling, temperature: float, with_oil: float
) -> tuple[float, float]:
    power = heat.power / heat.viscosity * float(oil.law.viscosity(temperature))
    housing = cooling.housing_conductance
    taken = with_oil * (temperature - cooling.supply_temperature) + housing * (temperature - cooling.ambient)
    return power - taken, -power * float(oil.law.thinning(temperature)) - with_oil - housing


def balance_temperature(heat: FilmHeat, oil: Oil, cooling: Cooling) -> float:
    """Return the temperature at which the heat of a film balances [K]: the root of (1).

    Raises
    ------
    InputError
        If nothing takes heat away: no oil leaves and the housing does not conduct.
    ConvergenceError
        If Newton's method does not end, which no thinning oil makes it do.
    """
    if not heat.power > 0.0:
        return _unheated(heat, oil, cooling)
    if not (heat.flow > 0.0 or cooling.housing_conductance > 0.0):
        raise InputError(
            "housing_conductance must be positive if no oil leaves the film, as in a centered bearing, got 0"
        )
    T, carried = cooling.coldest, _carried(heat, oil, cooling)
    for _ in range(_STEPS):
        surplus, slope = _surplus(heat, oil, cooling, T, carried)
        step = -surplus / slope
        T += step
        if abs(step) <= _ROUNDOFF * T:
            return T
    raise ConvergenceError(
        f"temperature must balance the heat, and did not within {_STEPS} steps at {T:.6g} K"
    )


def require_liquid(temperature: float) -> None:
    """Raise InputError where the heat of a film balances at a temperature [K] at which there is no oil."""
    if temperature >= HOTTEST_OIL:
        raise InputError(
            f"speed must leave the oil below {HOTTEST_OIL:g} K, got one at which it would be hotter "
            "in the balance of the heat of the film"
        )


def film_temperature(
    heat: Callable[[float], FilmHeat], oil: Oil, cooling: Cooling, *, reshapes: bool
) -> float:
    """Return the temperature at which the heat of a film balances [K].

    Parameters
    ----------
    heat : callable
        Takes a temperature [K] and returns the heat of the film at it.
    oil : Oil
    cooling : Cooling
    reshapes : bool
        Whether flow and shape of the film depend on its viscosity, as under supply pressure, so that it is
        solved anew at each temperature.

    Raises
    ------
    InputError
        If the film would be hotter than any oil is, at a speed that is too high.
    """
    if not reshapes:
        return balance_temperature(heat(cooling.coldest), oil, cooling)
    from scipy.optimize import brentq

    def surplus(temperature: float) -> float:
        return heat_surplus(heat(temperature), oil, cooling, temperature)[0]

    low = cooling.coldest
    if surplus(low) <= 0.0:
        return low
    high = balance_temperature(heat(low), oil, cooling)
    while high < HOTTEST_OIL and surplus(high) > 0.0:
        high += high - low
    if high >= HOTTEST_OIL and surplus(HOTTEST_OIL) > 0.0:
        require_liquid(high)
    return float(brentq(surplus, low, min(high, HOTTEST_OIL), xtol=_KELVIN))


def _unheated(heat: FilmHeat, oil: Oil, cooling: Cooling) -> float:
    """Return the temperature of a film that makes no heat, between those of fresh oil and ambient."""
    with_oil = float(oil.volumetric_heat(cooling.supply_temperature)) * max(heat.flow, 0.0)
    through_housing = cooling.housing_conductance
    if not with_oil + through_housing > 0.0:
        return cooling.supply_temperature
    share = through_housing / (with_oil + through_housing)
    return math.fsum((cooling.supply_temperature, share * (cooling.ambient - cooling.supply_temperature)))


# The lubricant of a bearing: one viscosity, or an oil and how warm it is.


def require_lubricant(
    viscosity: float | None, oil: Oil | None, temperature: float | None, cooling: Cooling | None
) -> None:
    """Raise InputError unless there is a viscosity [Pa s], or an oil with temperature [K] or cooling."""
    if oil is None:
        if viscosity is None:
            raise InputError("viscosity or oil must be given, got neither")
        require_positive("viscosity", viscosity)
        for name, value in (("temperature", temperature), ("cooling", cooling)):
            if value is not None:
                raise InputError(f"{name} must be None without oil, got {value!r}")
        return
    require_kind("oil", oil, Oil, "an Oil such as Oil.iso_vg(46)")
    if viscosity is not None:
        raise InputError(f"viscosity must be None where oil is given, got {viscosity!r}")
    require_kind("cooling", cooling, Cooling | None, "a Cooling")
    if temperature is not None:
        require_absolute("temperature", temperature)
    elif cooling is None:
        raise InputError("temperature or cooling must be given with oil, got neither")
