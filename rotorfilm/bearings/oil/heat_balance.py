"""One temperature for a whole film: the heat that friction makes against what oil and housing take away.

With the power P = mu(T) A and the flow Q_e of a film at a state of the journal, the balance is

    A mu(T) = C (T - T_s) Q_e + G (T - T_a),                                                         (1)

C the heat capacity of the oil per volume, T_s the supply, T_a the ambient temperature and G the conductance
of the housing. The left side falls with T and the right side rises, so there is one root. Newton's method
from below climbs to it without a step beyond, since the difference is convex.

At an opening Q_1 leaves into the film and Q_2 arrives, of which the share lambda clings to the shaft and goes
on. A film takes no more than its intake, so that the share a of Q_1 is hot, a smooth minimum of
x = lambda Q_2/Q_1 and 1:

    a = x - w ln(1 + exp((x - 1)/w)),  w = 0.05,  above lambda = 0.8 w = max((1 - lambda)/4, 0.01).    (2)

The rest of what arrives leaves the opening. With a temperature that rises linearly from one opening to the
next, one for all arcs, the oil takes as much heat along as the effective flow

    Q_e = Q + sum 2 (Q_2 - a Q_1)/(1 + a)                                                            (3)

would at the film's temperature, where Q = sum(Q_1 - Q_2) leaks.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple, Protocol, cast, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import ConvergenceError, InputError, require_kind, require_positive
from ...core.model import Array
from ...core.results import BearingLosses
from ...core.signals import Signal
from ...native.loss_kernels import LossKernel
from ..films.kernel_film import BoundKernel
from ..reaction import Dimensions
from .oil import Cooling, Oil, require_absolute

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
        At which that is.
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
    share = carried_share(entering, coming, carry_over).share
    return side_flow + float((2.0 * (coming - share * entering) / (1.0 + share)).sum())


def flow_slopes(inflow: Array, arriving: Array, carry_over: float) -> tuple[Array, Array]:
    """Return the derivatives of the sum in (3) by Q_1 and by Q_2, (openings,) [1]; arguments as above."""
    entering, coming = inflow.clip(min=0.0), arriving.clip(min=0.0)
    share, by_inflow, by_arriving = carried_share(entering, coming, carry_over)
    pull, whole = 2.0 * (entering + coming) / (1.0 + share) ** 2, 1.0 + share
    by_1 = np.where(inflow > 0.0, -2.0 * share / whole - pull * by_inflow, 0.0)
    return by_1, np.where(arriving > 0.0, 2.0 / whole - pull * by_arriving, 0.0)


class CarriedShare(NamedTuple):
    """Share a of (2), of the oil that leaves openings, that arrived there, and its derivatives.

    Attributes
    ----------
    share : ndarray, shape (openings,) [1]
    by_inflow, by_arriving : ndarray, shape (openings,) [s/m3]
    """

    share: Array
    by_inflow: Array
    by_arriving: Array


def carried_share(inflow: Array, arriving: Array, carry_over: float) -> CarriedShare:
    """Return a of (2) for flows that are not negative; 1 of an opening that gives nothing."""
    width = max(_NARROWEST, min(_WIDEST, 0.25 * (1.0 - carry_over)))
    least = np.maximum(inflow, carry_over * arriving / _FULL)
    gives = least > 0.0
    x = np.where(gives & (inflow > 0.0), carry_over * arriving / np.where(gives, least, 1.0), _FULL)
    z = (x - 1.0) / width
    per_inflow = np.exp(-np.logaddexp(0.0, z)) / np.where(gives, least, 1.0)
    share = np.minimum(x, 1.0) - width * np.log1p(np.exp(-np.abs(z)))
    return CarriedShare(share, -x * per_inflow, carry_over * per_inflow)


def heat_surplus(heat: FilmHeat, oil: Oil, cooling: Cooling, temperature: float) -> tuple[float, float]:
    """Return heat made less heat taken away at a temperature [W], and its derivative [W/K]; (1)."""
    power = heat.power / heat.viscosity * float(oil.law.viscosity(temperature))
    with_oil = float(oil.volumetric_heat(cooling.supply_temperature)) * heat.flow
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
            "housing_conductance must be positive where no oil leaves the film, as of a centered journal, "
            "got 0"
        )
    T = cooling.coldest
    for _ in range(_STEPS):
        surplus, slope = heat_surplus(heat, oil, cooling, T)
        step = -surplus / slope
        T += step
        if abs(step) <= _ROUNDOFF * T:
            return T
    raise ConvergenceError(
        f"temperature must balance the heat, and did not within {_STEPS} steps at {T:.6g} K"
    )


def fed_temperature(heat: Callable[[float], FilmHeat], oil: Oil, cooling: Cooling) -> float:
    """Return the temperature at which the heat of a film under supply pressure balances [K].

    Its flow and its shape depend on its viscosity, so that it is solved anew at each temperature.

    Parameters
    ----------
    heat : callable
        Takes a temperature [K] and returns the heat of the film at it.
    oil : Oil
    cooling : Cooling
    """
    from scipy.optimize import brentq

    def surplus(temperature: float) -> float:
        return heat_surplus(heat(temperature), oil, cooling, temperature)[0]

    low = cooling.coldest
    if surplus(low) <= 0.0:
        return low
    high = balance_temperature(heat(low), oil, cooling)
    while surplus(high) > 0.0:
        high += high - low
    return float(brentq(surplus, low, high, xtol=_KELVIN))


def _unheated(heat: FilmHeat, oil: Oil, cooling: Cooling) -> float:
    """Return the temperature of a film that makes no heat, between those of fresh oil and ambient."""
    with_oil = float(oil.volumetric_heat(cooling.supply_temperature)) * max(heat.flow, 0.0)
    through_housing = cooling.housing_conductance
    if not with_oil + through_housing > 0.0:
        return cooling.supply_temperature
    share = through_housing / (with_oil + through_housing)
    return math.fsum((cooling.supply_temperature, share * (cooling.ambient - cooling.supply_temperature)))


# What of a bearing its heat follows from.


@runtime_checkable
class Cooled(Dimensions, Protocol):
    """What a bearing with an oil and cooling offers, as `JournalBearing` and `LobedBearing` do."""

    @property
    def cooled(self) -> tuple[Oil, Cooling]:
        """Its oil and what cools it."""

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y."""

    def at_temperature(self, temperature: float) -> Any:
        """Return the bearing with a film of one temperature [K]."""

    def film_heat(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> FilmHeat:
        """Return the heat that the film makes and takes along at one state."""

    def heat_jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return d(power, effective flow, side flow)/d(x, y, vx, vy, speed) at one temperature, (3, 5)."""

    def film_at_unit_viscosity(self) -> tuple[BoundKernel, LossKernel] | None:
        """Return its compiled film at 1 Pa s with its losses; None if there is none."""


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


def film_viscosity(
    viscosity: float | None, oil: Oil | None, temperature: float | None, cooling: Cooling | None
) -> float:
    """Return the viscosity of a lubricant [Pa s] that `require_lubricant` let pass.

    Of an oil without a temperature it is that of fresh oil.
    """
    if oil is None:
        return cast(float, viscosity)
    stated = cast(Cooling, cooling).supply_temperature if temperature is None else temperature
    return float(oil.law.viscosity(stated))
