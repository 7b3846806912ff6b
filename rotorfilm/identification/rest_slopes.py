"""How position and temperature of a journal at rest change with parameters of its bearing, exactly.

At rest the force F(q, T, p) balances the load and the heat B(q, T, p) is zero, so that with z = (q, T)

    dz/dp = -(d(F, B)/dz)^-1 d(F, B)/dp.

Where a parameter is the clearance c, at a held position q, since the film knows e = q/c alone,

    dF/dc = -(2 F + F_q q)/c,   dP/dc = -(P + P_q q)/c,   dQ/dc = (Q - Q_q q)/c

for the power P and the flow Q.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..bearings.journal import JournalBearing, heat_surplus
from ..errors import InputError
from ..model import Array
from ..results import Equilibrium

RELATIVE_STEP = 1e-3
"""Step of a central difference of the heat capacity over temperature, which is a parabola."""


class _Rest(NamedTuple):
    """Slopes of a film at rest: of the force by position, and for one that warms of power and flow too."""

    bearing: JournalBearing
    at: Equilibrium
    force: Array
    by_position: Array


def rest_slopes(bearing: JournalBearing, at: Equilibrium, name: str) -> Array | None:
    """Return d(x, y, temperature)/d(parameter), shape (3,); None where only differences tell.

    The parameter is one of `fit_parameters.NAMES` but the zeros of sensors.
    """
    if bearing.supply_pressure > 0.0:
        return None
    film = bearing if at.temperature is None else bearing.at_temperature(at.temperature)
    still = at.position, np.zeros(2), at.speed
    rest = _Rest(film, at, film.force(*still), film.jacobian(*still)[:, :2])
    by_name = _force_slope(rest, name)
    if at.temperature is None:
        return None if by_name is None else np.append(np.linalg.solve(rest.by_position, -by_name), 0.0)
    try:
        power, flow, _ = film.heat_jacobian(*still)[:, :2]
    except InputError:
        return None
    oil, cooling = bearing.cooled
    heat = film.film_heat(*still)
    supply, T, c = cooling.supply_temperature, at.temperature, bearing.clearance
    capacity = float(oil.volumetric_heat(supply))
    carried = capacity * (T - supply)
    heated = {
        "clearance": (-heat.power - power @ at.position - carried * (heat.flow - flow @ at.position)) / c,
        "supply_temperature": heat.flow * (capacity - (T - supply) * _capacity_slope(bearing, supply)),
        "ambient_temperature": cooling.housing_conductance,
        "housing_conductance": cooling.ambient - T,
        "carry_over": 0.0,
    }
    if name not in heated:
        return None
    if name == "supply_temperature" and cooling.ambient_temperature is None:
        heated[name] += cooling.housing_conductance
    _, cools = heat_surplus(heat, oil, cooling, T)
    by_temperature = -float(oil.law.thinning(T)) * rest.force
    slopes = np.block([[rest.by_position, by_temperature[:, None]], [power - carried * flow, cools]])
    known = np.append(np.zeros(2) if by_name is None else by_name, heated[name])
    return np.asarray(np.linalg.solve(slopes, -known))


def _force_slope(rest: _Rest, name: str) -> Array | None:
    """Return the derivative of the force by a parameter at held position and temperature; None for others."""
    film, force = rest.bearing, rest.force
    if name == "clearance":
        return np.asarray(-(2.0 * force + rest.by_position @ rest.at.position) / film.clearance)
    if name == "viscosity":
        return np.asarray(force / film.film_viscosity)
    if name == "temperature" and film.oil is not None and film.temperature is not None:
        return np.asarray(-float(film.oil.law.thinning(film.temperature)) * force)
    return None


def _capacity_slope(bearing: JournalBearing, temperature: float) -> float:
    oil, _ = bearing.cooled
    step = RELATIVE_STEP * temperature
    ends = oil.volumetric_heat(np.array([temperature - step, temperature + step]))
    return float(ends[1] - ends[0]) / (2.0 * step)
