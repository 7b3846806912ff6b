"""Figures of an oil and its cooling that a scene leaves to assumptions, and how much they move an answer."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from ...bearings.journal import BushRing, JournalBearing
from ...bearings.oil import Cooling, Oil
from ...bearings.oil.cooling import RING
from ...errors import RotorfilmError
from ...units import CELSIUS

SPREAD = 0.05
"""Relative uncertainty of an assumed viscosity at 100 degrees Celsius."""

CARRIED = (0.7, 0.9)
"""Shares of the oil arriving at an opening that go on, as they are found in use."""

WARM, HOT = 40.0 + CELSIUS, 100.0 + CELSIUS

HOUSING = "a steel one of twice the radius, cooled by 80 W/(m2 K)"


def assumed_figures(bearing: Any, moved: Callable[[Any], float], *, fields: bool) -> tuple[str, ...]:
    """Return which figures of a bearing on an oil are assumed, and how much each moves the answer.

    Parameters
    ----------
    bearing : JournalBearing, or one made of pads
    moved : callable
        How far the answer of another bearing is off, by T1, in the unit of the tolerance.
    fields : bool
        Whether a temperature field may answer, which assumes a bush.
    """
    lines = []
    for text, others in _varied(bearing):
        try:
            change = f"{max(moved(other) for other in others):.1%}"
        except RotorfilmError:
            change = "a change that is not known"
        lines.append(f"{text}: moves the answer by {change}")
    if fields:
        lines.append(
            f"bush of T2 and T3: steel to {RING:g} times the radius, that gives off what housing_conductance "
            "says; the shaft takes no heat in the mean"
        )
    return tuple(lines)


def assumed_names(bearing: Any) -> tuple[str, ...]:
    """Return which figures of a bearing on an oil are assumed."""
    return tuple(text for text, _ in _varied(bearing))


def _varied(bearing: Any) -> Iterator[tuple[str, list[Any]]]:
    """Yield each assumption, and the bearings that it might be as well."""
    oil, cooling = bearing.cooled
    default = Cooling(supply_temperature=cooling.supply_temperature)

    for text in oil.assumed:
        yield text, [replace(bearing, oil=thinner_when_hot(oil))]
    open_around = not isinstance(bearing, JournalBearing) or bearing.geometry.openings()
    if open_around and cooling.carry_over == default.carry_over:
        low, high = CARRIED
        text = f"carry_over of the grooves: {cooling.carry_over:g}, in use are {low:g} to {high:g}"
        yield text, [replace(bearing, cooling=replace(cooling, carry_over=one)) for one in CARRIED]
    if cooling.housing_conductance == 0.0:
        given = ring_conductance(bearing.radius, bearing.length)
        text = f"housing: takes no heat, {HOUSING}, would take {given:.3g} W/K"
        yield text, [replace(bearing, cooling=replace(cooling, housing_conductance=given))]
    if not cooling.full_gap:
        text = "oil where the film is ruptured: in streamers, not in the full gap"
        yield text, [replace(bearing, cooling=replace(cooling, full_gap=True))]


def thinner_when_hot(oil: Oil) -> Oil:
    """Return an oil as viscous at 40 degrees Celsius, and by `SPREAD` less at 100."""
    warm, hot = (float(oil.viscosity(T) / oil.density(T)) for T in (WARM, HOT))
    other = Oil.two_points((WARM, warm), (HOT, (1.0 - SPREAD) * hot), reference_density=oil.reference_density)
    return replace(oil, law=other.law)


def ring_conductance(radius: float, length: float) -> float:
    """Return the heat flow through `HOUSING` [W/K] of a bearing of these dimensions [m]."""
    ring = BushRing(outer_radius=2.0 * radius, conductivity=50.0, transfer=80.0)
    return 2.0 * math.pi * radius * length * ring.mean_transfer(radius)
