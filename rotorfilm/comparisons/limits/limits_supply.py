"""Limits of Reynolds rupture in a bearing with its supply: a groove on top, against oil that is conserved.

Stiffness is that at a whirl of half the speed. With a given flow the groove starves, and Reynolds rupture can
only have it full at ambient pressure.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from ...bearings.films.geometry import Groove
from ...bearings.journal import JFOFilm, JournalBearing, ReynoldsFilm
from ...linear import coefficients, equilibrium
from .limit_panels import Curve, panel

RADIUS, CLEARANCE, VISCOSITY, SPEED = 0.05, 1e-4, 0.02, 100.0 * math.pi
CELLS = (96, 8)

LOADS = (0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2)
PRESSURES = (0.001, 0.003, 0.01, 0.03, 0.1, 0.2)
MISSING = (0.0, 0.15, 0.3, 0.45, 0.6, 0.8)
AT_LOAD, AT_PRESSURE = 0.3, 0.01
QUANTITIES = ("place", "side flow", "friction torque", "stiffness")


@panel(
    "supply", f"Reynolds rupture, supply {AT_PRESSURE:g}", "Sommerfeld number So", "error", logarithmic=True
)
def supply_load() -> Iterator[Curve]:
    """Yield what Reynolds rupture errs by as the load rises, at one supply pressure."""
    yield from _curves(LOADS, lambda load: _errors(load, AT_PRESSURE))


@panel(
    "supply",
    f"Reynolds rupture, So {AT_LOAD:g}",
    "supply pressure c^2/(12 viscosity R^2 speed)",
    "error",
    logarithmic=True,
)
def supply_pressure() -> Iterator[Curve]:
    """Yield what Reynolds rupture errs by as the supply pressure rises, at one load."""
    yield from _curves(PRESSURES, lambda pressure: _errors(AT_LOAD, pressure))


@panel(
    "supply",
    f"Reynolds rupture, given flow, So {AT_LOAD:g}",
    "share missing of the flow at ambient pressure",
    "error",
)
def supply_starvation() -> Iterator[Curve]:
    """Yield what Reynolds rupture errs by as the groove gets less oil than it would take, at one load."""
    yield from _curves(MISSING, lambda missing: _errors(AT_LOAD, 0.0, 1.0 - missing))


def _curves(abscissa: tuple[float, ...], errors: Callable[[float], dict[str, float]]) -> Iterator[Curve]:
    found = [errors(at) for at in abscissa]
    for quantity in QUANTITIES:
        yield quantity, abscissa, [one[quantity] for one in found]


def _bearing(pressure: float) -> JournalBearing:
    """Return the bearing at a supply pressure over 12 viscosity R^2 speed/c^2."""
    top = Groove(center=0.5 * math.pi, width=math.radians(20.0), length=0.8 * RADIUS)
    bearing = JournalBearing(
        radius=RADIUS,
        length=RADIUS,
        clearance=CLEARANCE,
        viscosity=VISCOSITY,
        grooves=(top,),
        film=ReynoldsFilm(cells=CELLS),
    )
    return replace(bearing, supply_pressure=pressure * SPEED * bearing.pressure_scale)


def _load(bearing: JournalBearing, sommerfeld: float) -> list[float]:
    return [0.0, -2.0 * sommerfeld * SPEED * bearing.force_scale]


@cache
def _full_flow() -> float:
    """Return what the groove takes at `AT_LOAD` and ambient pressure [m3/s]."""
    film: Any = JFOFilm(bearing=_bearing(0.0), cells=CELLS)
    at = equilibrium(film, _load(film.bearing, AT_LOAD), SPEED)
    return float(film.solve(at.position, SPEED).side_flow)


def _errors(sommerfeld: float, pressure: float, share: float | None = None) -> dict[str, float]:
    bearing = _bearing(pressure)
    flow = None if share is None else share * _full_flow()
    film: Any = JFOFilm(bearing=bearing, cells=CELLS, supply_flow=flow)
    load = _load(bearing, sommerfeld)
    own, better = equilibrium(bearing, load, SPEED), equilibrium(film, load, SPEED)
    assert own.losses is not None
    assert better.losses is not None
    K = coefficients(bearing, own.position, SPEED).stiffness
    other = coefficients(film, better.position, SPEED, frequency=0.5 * SPEED).stiffness
    flows = float(own.losses.side_flow) / float(better.losses.side_flow)
    torques = float(own.losses.friction_torque) / float(better.losses.friction_torque)
    place = float(np.hypot(*(own.position - better.position)) / np.hypot(*better.position))
    stiffness = float(np.abs(K - other).max() / np.abs(other).max())
    return dict(zip(QUANTITIES, (place, abs(flows - 1.0), abs(torques - 1.0), stiffness), strict=True))


PANELS = (supply_load, supply_pressure, supply_starvation)
"""Panels of a bearing's supply, in the order in which they are drawn."""
