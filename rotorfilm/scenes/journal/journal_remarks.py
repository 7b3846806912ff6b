"""What the physics of every rung leaves out, judged by dimensionless numbers."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace

import numpy as np

from ...bearings.journal import JournalBearing, ReynoldsFilm
from ...errors import RotorfilmError, ValidityWarning
from ...linear import equilibrium
from ..lubricant_table import LubricantTable
from ..remarks import Remark, said

TAYLOR = 41.2
"""Reynolds number times sqrt(c/R) from which vortices grow between cylinders, the inner one turning.

The square root of half the critical Taylor number 3390 of a narrow gap (tests/scenes/test_validity.py).
"""

ATMOSPHERE = 1e5
"""Ambient pressure [Pa], as much tension as a cavity that opens at vapor pressure takes."""

NOTABLE = 0.25
"""Relative change of the film that is worth a word."""

TILT = 0.1
"""Tilt of the journal [mrad] that an ordinary machine has; a smaller margin is worth a word."""


COARSE = (48, 4)
"""Cells of the film whose loss and flow tell how far the oil warms, within 2 % of a fine one."""


CONCENTRIC = 1e-3
"""Eccentricity ratio below which nothing to speak of flows out of a film."""

SLIGHT = 0.1
"""Eccentricity ratio below which the oil that leaves is too little to take all heat along."""


REMARKS = (
    Remark(
        "thinning",
        NOTABLE,
        "heat: the oil warms by about {warming:.2g} K ({power:.3g} W in the film, {side_flow:.3g} m3/s out "
        "of its ends, Peclet number {peclet:.2g}), which takes {thinning:.0%} of its viscosity",
    ),
    Remark(
        "unknown",
        0.0,
        "heat: not known, as the coarse film that would tell it has no answer under this load",
    ),
    Remark("taylor", TAYLOR, f"turbulence: Taylor vortices above {TAYLOR}, the film has {{taylor:.3g}}"),
    Remark("inertia", 1.0, "inertia of the film: {inertia:.2g} of the viscous stress"),
    Remark(
        "pressure",
        1.0,
        "cavitation: the load makes {pressure:.2g} times the ambient pressure, so that the oil may hold "
        "tension and rupture elsewhere; no film conserves its mass",
        below=True,
    ),
    Remark("compression", 0.01, "compressibility: {compression:.2%} by the mean pressure"),
    Remark(
        "tilt",
        TILT,
        "misalignment: a tilt of {tilt:.2g} mrad closes even a centered film",
        below=True,
    ),
)
"""What the physics of a journal's film leaves out, by the numbers of `journal_numbers`."""


def journal_numbers(
    bearing: JournalBearing, oil: LubricantTable, speed: float, load: tuple[float, float]
) -> dict[str, float]:
    """Return the dimensionless numbers of a bearing at a speed [rad/s] and a load [N].

    Returns
    -------
    dict of str to float
        taylor : speed R c/nu sqrt(c/R); laminar Couette flow below `TAYLOR`.
        inertia : speed c^2/nu, inertia of the film over its viscous stress.
        peclet : speed c^2/diffusivity, heat carried along over heat conducted across the film.
        power [W] : loss in the film, at rest and at the viscosity of the bearing; not-a-number, as side_flow,
        warming and thinning are, where the coarse film has no answer; `unknown` is 1 then, else 0.
        side_flow [m3/s] : oil that leaves at both ends.
        warming [K] : rise of temperature, of the oil that leaves (Peclet number above 1) or between cold
        walls; thinning : relative loss of viscosity by that.
        pressure : mean pressure of the load over the ambient one: how much the rupture pressure matters.
        compression : mean pressure of the load over the bulk modulus.
        tilt [mrad] : of the journal, that closes even a centered film.

    Notes
    -----
    The oil that leaves carries the power that the film takes, both of an isothermal film under the load.
    Between cold walls, and where nothing flows, the middle of the film is warmer by viscosity U^2/(8
    conductivity). Between an eccentricity ratio of `SLIGHT` and the center one passes into the other with the
    square of the ratio, since power/flow grows as its inverse.
    """
    R, c, mu, omega = bearing.radius, bearing.clearance, bearing.film_viscosity, abs(speed)
    kinematic = mu / oil.density
    volumetric = oil.density * oil.heat_capacity
    peclet = omega * c**2 * volumetric / oil.conductivity
    power, flow, eccentricity_ratio = film_loss(bearing, speed, load)
    conducted = mu * (omega * R) ** 2 / (8.0 * oil.conductivity)
    carried = power / (volumetric * flow) if flow else conducted
    share = min(eccentricity_ratio / SLIGHT, 1.0) ** 2
    warming = min(carried, conducted + share * (carried - conducted))
    if peclet <= 1.0:
        warming = min(warming, conducted)
    mean = math.hypot(*load) / (2.0 * R * bearing.length)
    return {
        "taylor": omega * R * c / kinematic * math.sqrt(c / R),
        "inertia": omega * c**2 / kinematic,
        "peclet": peclet,
        "power": power,
        "side_flow": flow,
        "warming": warming,
        "unknown": float(math.isnan(warming)),
        "thinning": -math.expm1(-oil.thinning * warming),
        "pressure": mean / ATMOSPHERE,
        "compression": mean / oil.bulk_modulus,
        "tilt": 2e3 * c / bearing.length,
    }


def film_loss(bearing: JournalBearing, speed: float, load: tuple[float, float]) -> tuple[float, float, float]:
    """Return power [W], side flow [m3/s] and eccentricity ratio of an isothermal film by a coarse grid.

    speed * torque on the journal, viscosity speed R^3 L/c * shear + (position x force)/2, with the whole gap
    full (streamers in the ruptured zone take 3 to 22 % less), and what the supply pressure puts in.
    Not-a-number, all three, where that film has no answer under the load.
    """
    R, L, c = bearing.radius, bearing.length, bearing.clearance
    drag = bearing.film_viscosity * speed * R**3 * L / c
    concentric = 2.0 * math.pi * drag * speed, 0.0, 0.0
    if not speed or not any(load):
        return concentric
    film = replace(bearing.film if isinstance(bearing.film, ReynoldsFilm) else ReynoldsFilm(), cells=COARSE)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        grid = replace(bearing, film=film)
        try:
            at = equilibrium(grid, load, speed)
            if at.eccentricity_ratio < CONCENTRIC:
                return concentric
            state = grid.kinematics(at.position, np.zeros(2), np.array(speed))
            field = film.fitted(grid.geometry).solve(*state, grid.slenderness)
        except RotorfilmError:
            return math.nan, math.nan, math.nan
    (x, y), (force_x, force_y) = at.position, (-load[0], -load[1])
    flow = c * R * L * field.side_flow
    torque = drag * field.shear + 0.5 * float(x * force_y - y * force_x)
    return speed * torque + bearing.supply_pressure * flow, flow, at.eccentricity_ratio


def film_remarks(
    bearing: JournalBearing, oil: LubricantTable, speed: float, load: tuple[float, float]
) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, at a speed [rad/s] and a load [N]."""
    return said(REMARKS, journal_numbers(bearing, oil, speed, load))
