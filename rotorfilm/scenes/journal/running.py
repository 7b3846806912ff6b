"""A bearing as it runs: its oil warms until its heat balances, whatever viscosity a textbook gives it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ...bearings.journal import JournalBearing
from ...bearings.oil import GRADES, Cooling, Oil
from ...linear import equilibrium
from ...units import CELSIUS

COLDEST, HOTTEST = CELSIUS, 120.0 + CELSIUS
"""Where fresh oil may be [K]."""


@dataclass(frozen=True, kw_only=True)
class RunningBearing:
    """Where a journal runs once its oil is warm.

    Attributes
    ----------
    oil : str
        What was taken for the oil.
    supply_temperature : float [K]
        Of the fresh oil, which is as viscous as the bearing was said to be.
    temperature : float [K]
        Of the film, at which its heat balances.
    eccentricity_ratio : float [1]
    power_loss : float [W]
    """

    oil: str
    supply_temperature: float
    temperature: float
    eccentricity_ratio: float
    power_loss: float


def running_bearing(
    bearing: JournalBearing, load: tuple[float, float], speed: float
) -> RunningBearing | None:
    """Return a bearing of one viscosity as it runs; None if there is no such oil, or it is warm already.

    Its viscosity is taken for that of fresh oil, of the ISO grade that has it next to 40 degrees Celsius; all
    heat leaves with the oil that leaks.

    Parameters
    ----------
    bearing : JournalBearing
    load : (float, float) [N]
        On the journal.
    speed : float [rad/s]
    """
    if bearing.viscosity is None:
        return None
    wanted = math.log(bearing.viscosity)
    oils = {grade: Oil.iso_vg(grade) for grade in GRADES}
    at_40 = {grade: float(np.log(oil.viscosity(CELSIUS + 40.0))) for grade, oil in oils.items()}
    grade = min(GRADES, key=lambda one: abs(at_40[one] - wanted))
    grid = np.linspace(COLDEST, HOTTEST, 200)
    thinner = -np.log(oils[grade].law.viscosity(grid))
    if not thinner[0] < -wanted < thinner[-1]:
        return None
    supply = float(np.interp(-wanted, thinner, grid))
    cooling = Cooling(supply_temperature=supply)
    running = replace(bearing, viscosity=None, oil=oils[grade], cooling=cooling)
    at = equilibrium(running, load, speed)
    if at.temperature is None or at.losses is None:
        return None
    return RunningBearing(
        oil=f"ISO VG {grade}",
        supply_temperature=supply,
        temperature=at.temperature,
        eccentricity_ratio=at.eccentricity_ratio,
        power_loss=float(at.losses.power_loss),
    )
