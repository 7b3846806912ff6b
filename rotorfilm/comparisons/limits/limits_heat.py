"""Limits of the models of a film's heat: a plain bearing with oils that thin and conduct more and less.

All have the geometry, the viscosity of fresh oil and the load of one bearing, so that they differ in the
thinning times rise E, the Peclet number Pe and the Nahme number Na alone. Reference: temperature over and
across the film.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache

import numpy as np

from ...bearings.journal import JournalBearing, heat_numbers
from ...bearings.oil import Cooling, Oil
from ...linear import equilibrium
from ...units import CELSIUS
from ..journal.heat_cases import HeatCase
from ..journal.heat_models import HeatAnswer, HeatModel, answered, position_error
from .limit_panels import Curve, panel

SUPPLY, VISCOSITY, SPEED = 45.0 + CELSIUS, 0.03, 100.0 * np.pi
LOAD = 5e3
"""It takes the cold journal to an eccentricity ratio of .48 [N]."""

CELLS, LAYERS = (48, 4), 6

THINNING_RISES = (0.05, 0.2, 0.5, 1.0, 3.0, 10.0)
PECLETS = (2.0, 7.0, 20.0, 70.0, 200.0)
PROFILES = (2.0, 20.0, 200.0)
AT_PECLET, AT_RISE = 20.0, 1.0
COMPARED = (HeatModel.SUPPLY, HeatModel.HOUSING, HeatModel.BUSH)


@panel("heat", f"models, Pe = {AT_PECLET:g}", "thinning x rise E", "error of the position", logarithmic=True)
def heat_rise() -> Iterator[Curve]:
    """Yield what the models err by as oil thins more."""
    for model in COMPARED:
        yield model.said, THINNING_RISES, [_error(model, rise, AT_PECLET) for rise in THINNING_RISES]


@panel("heat", f"models, E = {AT_RISE:g}", "Peclet number Pe", "error of the position", logarithmic=True)
def heat_peclet() -> Iterator[Curve]:
    """Yield what the models err by as oil conducts less."""
    for model in COMPARED:
        yield model.said, PECLETS, [_error(model, AT_RISE, peclet) for peclet in PECLETS]


@panel(
    "heat", "no profile across the film (T2)", "Nahme number Na", "error of the position", logarithmic=True
)
def heat_profile() -> Iterator[Curve]:
    """Yield what a mean temperature across the film errs by."""
    for peclet in PROFILES:
        rises: Sequence[float] = THINNING_RISES[1:] if peclet == AT_PECLET else (0.2, AT_RISE, 3.0)
        nahmes = [rise * nahme_per_rise() * peclet / AT_PECLET for rise in rises]
        yield f"Pe = {peclet:g}", nahmes, [_error(HeatModel.BUSH, rise, peclet) for rise in rises]


def nahme_per_rise() -> float:
    """Return Na/E at the Peclet number `AT_PECLET`, which the geometry and the load decide."""
    case = heat_case(1.0, AT_PECLET)
    at = equilibrium(case.bearing.at_temperature(SUPPLY), case.load, case.speed)
    return heat_numbers(case.bearing, at.position, case.speed).nahme


@cache
def heat_case(thinning_rise: float, peclet: float) -> HeatCase:
    """Return the bearing with these numbers E and Pe."""
    unit = _case(1.0, 1.0)
    at = equilibrium(unit.bearing.at_temperature(SUPPLY), unit.load, unit.speed)
    numbers = heat_numbers(unit.bearing, at.position, unit.speed)
    return _case(thinning_rise / numbers.thinning_rise, numbers.peclet / peclet)


def _case(thinning: float, conductivity: float) -> HeatCase:
    bearing = JournalBearing(
        radius=0.05,
        length=0.05,
        clearance=75e-6,
        oil=Oil.thinning_at(VISCOSITY, SUPPLY, thinning, conductivity=conductivity),
        cooling=Cooling(supply_temperature=SUPPLY),
    )
    return HeatCase(name="plain bearing", bearing=bearing, force=LOAD, speed=SPEED)


def _error(model: HeatModel, thinning_rise: float, peclet: float) -> float:
    reference = _answered(HeatModel.LAYERS, thinning_rise, peclet)
    return position_error(_answered(model, thinning_rise, peclet), reference)


@cache
def _answered(model: HeatModel, thinning_rise: float, peclet: float) -> HeatAnswer:
    return answered(heat_case(thinning_rise, peclet), model, cells=CELLS, layers=LAYERS)


PANELS = (heat_rise, heat_peclet, heat_profile)
"""Panels of a film's heat, in the order in which they are drawn."""
