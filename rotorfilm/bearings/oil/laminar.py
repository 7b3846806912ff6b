"""Where the film of a bearing is no longer laminar, or its oil beyond the law of its viscosity."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from ...core.errors import warn_user
from ..reaction import FilmUnits
from .oil import COLDEST_OIL, DENSITY, HOTTEST_OIL, warn_beyond_law

TAYLOR = 41.2
"""Reynolds number times sqrt(c/R) from which vortices grow between cylinders, the inner one turning.

The square root of half the critical Taylor number 3390 of a narrow gap (tests/scenes/test_validity.py).
"""

TURBULENT = 2000.0
"""Reynolds number speed R c/nu above which plane Couette flow does not stay laminar."""


class FilmNumbers(NamedTuple):
    """Reynolds number speed R c/nu, and that times sqrt(c/R), whose limit is `TAYLOR` [1]."""

    reynolds: float
    taylor: float

    @property
    def turbulence(self) -> float:
        """About how much stiffer than the laminar film this one is [1]; 0 where it is laminar.

        The 12 of the laminar film becomes 12 + 0.0136 Re^0.9 (Ng and Pan, 1965).
        """
        laminar = self.taylor <= TAYLOR and self.reynolds <= TURBULENT
        return 0.0 if laminar else 0.0136 * self.reynolds**0.9 / 12.0


def film_reynolds(
    radius: float, clearance: float, viscosity: float, density: float, speed: float
) -> FilmNumbers:
    """Return the Reynolds and Taylor numbers of a film.

    Parameters
    ----------
    radius, clearance : float [m]
    viscosity : float [Pa s]
        At the temperature of the film.
    density : float [kg/m3]
    speed : float [rad/s]
        Of the journal, of either sign.
    """
    reynolds = abs(speed) * radius * clearance * density / viscosity
    return FilmNumbers(reynolds, reynolds * math.sqrt(clearance / radius))


def warn_of_flow(
    reaction: object, speed: float, temperature: float | None = None, hottest: float | None = None
) -> None:
    """Warn of a film that is not laminar at a speed [rad/s], or whose oil is beyond its viscosity law.

    Parameters
    ----------
    reaction : object
        A bearing, or a film that has one as `bearing`; others are not judged.
    speed : float [rad/s]
    temperature : float, optional [K]
        Of the oil in the mean; by default that of the bearing.
    hottest : float, optional [K]
        Of the oil; by default as warm as the mean.
    """
    bearing: Any = getattr(reaction, "bearing", reaction)
    if not issubclass(type(bearing), FilmUnits):
        return
    oil = getattr(bearing, "oil", None)
    viscosity, density = bearing.film_viscosity, DENSITY
    if oil is not None:
        at = bearing.temperature if temperature is None else temperature
        if at is not None:
            warn_beyond_law(oil, at if hottest is None else hottest)
            within = float(np.clip(at, *oil.law.temperature_range))
            liquid = min(max(within, COLDEST_OIL), HOTTEST_OIL)
            viscosity, density = float(oil.law.viscosity(within)), float(oil.density(liquid))
    R, c = bearing.radius, bearing.clearance
    found = film_reynolds(R, c, viscosity, density, speed)
    most = min(TAYLOR * math.sqrt(R / c), TURBULENT)
    if found.turbulence:
        begins = "Taylor vortices begin" if most < TURBULENT else "turbulence begins"
        warn_user(
            f"the film has Reynolds number {found.reynolds:.4g} and Taylor number {found.taylor:.3g} at "
            f"{speed:.6g} rad/s and {density:.4g} kg/m3, beyond the Reynolds number {most:.4g} at which "
            f"{begins}: a real film takes more power and gets warmer than this laminar one"
        )
