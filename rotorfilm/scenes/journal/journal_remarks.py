"""What the physics of every rung leaves out, judged by dimensionless numbers."""

from __future__ import annotations

import math
from typing import NamedTuple

from ...bearings.journal import JournalBearing
from ..lubricant_table import LubricantTable

TAYLOR = 41.2
"""Reynolds number times sqrt(c/R) from which vortices grow between cylinders, the inner one turning.

The square root of half the critical Taylor number 3390 of a narrow gap (tests/scenes/test_validity.py).
"""

ATMOSPHERE = 1e5
"""Ambient pressure [Pa], as much tension as a cavity that opens at vapor pressure takes."""

NOTABLE = 0.25
"""Relative change of the film that is worth a word."""

TILT = 1e-4
"""Tilt of the journal [rad] that an ordinary machine has; a smaller margin is worth a word."""


class Numbers(NamedTuple):
    """Dimensionless numbers of a journal bearing at work.

    Attributes
    ----------
    taylor : float
        speed R c/nu sqrt(c/R); laminar Couette flow below `TAYLOR`.
    inertia : float
        speed c^2/nu: inertia of the film over its viscous stress.
    peclet : float
        speed c^2/diffusivity: heat carried along over heat conducted across the film.
    warming : float [K]
        Rise of temperature, of the oil that leaves (Peclet number above 1) or between cold walls.
    thinning : float
        Relative loss of viscosity by that.
    tension : float
        Ambient pressure over the mean pressure of the load: how much the rupture pressure matters.
    compression : float
        Mean pressure of the load over the bulk modulus.
    """

    taylor: float
    inertia: float
    peclet: float
    warming: float
    thinning: float
    tension: float
    compression: float


def journal_numbers(
    bearing: JournalBearing, oil: LubricantTable, speed: float, load: tuple[float, float]
) -> Numbers:
    """Return the numbers of a bearing at a speed [rad/s] and a load [N].

    The oil that leaves carries the friction of the concentric film, 2 pi viscosity speed^2 R^3 L/c, with a
    flow of half the wedge, speed R c L/2. Between cold walls the middle of the film is warmer by
    viscosity U^2/(8 conductivity).
    """
    R, c, mu, omega = bearing.radius, bearing.clearance, bearing.viscosity, abs(speed)
    kinematic = mu / oil.density
    volumetric = oil.density * oil.heat_capacity
    peclet = omega * c**2 * volumetric / oil.conductivity
    adiabatic = 4.0 * math.pi * mu * omega * (R / c) ** 2 / volumetric
    conducted = mu * (omega * R) ** 2 / (8.0 * oil.conductivity)
    warming = adiabatic if peclet > 1.0 else min(adiabatic, conducted)
    mean = math.hypot(*load) / (2.0 * R * bearing.length)
    return Numbers(
        taylor=omega * R * c / kinematic * math.sqrt(c / R),
        inertia=omega * c**2 / kinematic,
        peclet=peclet,
        warming=warming,
        thinning=-math.expm1(-oil.thinning * warming),
        tension=ATMOSPHERE / mean if mean else math.inf,
        compression=mean / oil.bulk_modulus,
    )


def film_remarks(
    bearing: JournalBearing, oil: LubricantTable, speed: float, load: tuple[float, float]
) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, at a speed [rad/s] and a load [N]."""
    n = journal_numbers(bearing, oil, speed, load)
    tilt = 2.0 * bearing.clearance / bearing.length
    lines = {
        f"heat: the oil warms by about {n.warming:.2g} K (Peclet number {n.peclet:.2g}), "
        f"which takes {n.thinning:.0%} of its viscosity": n.thinning > NOTABLE,
        f"turbulence: Taylor vortices above {TAYLOR}, the film has {n.taylor:.3g}": n.taylor > TAYLOR,
        f"inertia of the film: {n.inertia:.2g} of the viscous stress": n.inertia > 1.0,
        f"cavitation: the load makes {1.0 / n.tension:.2g} times the ambient pressure, so that the oil may "
        "hold tension and rupture elsewhere; no film conserves its mass": n.tension > 1.0,
        f"compressibility: {n.compression:.2%} by the mean pressure": n.compression > 0.01,
        f"misalignment: a tilt of {tilt * 1e3:.2g} mrad closes even a centered film": tilt < TILT,
    }
    return tuple(line for line, applies in lines.items() if applies)
