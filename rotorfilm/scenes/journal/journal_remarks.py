"""What the physics of every rung leaves out, judged by dimensionless numbers."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace
from typing import Any

from ...bearings.journal import JFOFilm, JournalBearing, MapFilm, ReynoldsFilm, ShortFilm
from ...bearings.oil.compression import compression
from ...bearings.oil.laminar import TAYLOR, TURBULENT, film_reynolds
from ...errors import RotorfilmError, ValidityWarning
from ...linear import equilibrium
from ..lubricant_table import Lubricant
from ..remarks import Remark, said
from .packaged_map import has_map

ATMOSPHERE = 1e5
"""Ambient pressure [Pa], as much tension as a cavity that opens at vapor pressure takes."""

NOTABLE = 0.25
"""Relative change of the film that is worth a word."""

TILT = 0.1
"""Tilt of the journal [mrad] that an ordinary machine has; a smaller margin is worth a word."""


COARSE = (48, 4)
"""Cells of a film whose loss and flow tell how far the oil warms where its own would take long."""


CONSERVED = (48, 4)
"""The same of a film that conserves its oil."""


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
        moves="heat",
    ),
    Remark(
        "unknown",
        0.0,
        "heat: not known, as the coarse film that would tell it has no answer under this load",
    ),
    Remark(
        "turbulence",
        0.0,
        f"turbulence: Taylor vortices above {TAYLOR}, the film has {{taylor:.3g}}; turbulent above Reynolds "
        f"number {TURBULENT:g}, it has {{reynolds:.4g}}",
        moves="turbulence",
    ),
    Remark("inertia", 1.0, "inertia of the film: {inertia:.2g} of the viscous stress"),
    Remark(
        "pressure",
        1.0,
        "cavitation: the load makes {pressure:.2g} times the ambient pressure, so that the oil may hold "
        "tension and rupture elsewhere",
        below=True,
    ),
    Remark(
        "compression",
        0.01,
        "compressibility: {compression:.2%} by the mean pressure",
        moves="compressibility",
    ),
    Remark(
        "tilt",
        TILT,
        "misalignment: a tilt of {tilt:.2g} mrad closes even a centered film",
        below=True,
    ),
)
"""What the physics of a journal's film leaves out, by the numbers of `journal_numbers`."""


def journal_numbers(
    bearing: JournalBearing,
    oil: Lubricant,
    speed: float,
    load: tuple[float, float],
    film: Any = None,
) -> dict[str, float]:
    """Return the dimensionless numbers of a bearing at a speed [rad/s] and a load [N].

    Loss and flow are those of a film, or if None is given of a quick one of the bearing.

    Returns
    -------
    dict of str to float
        reynolds : speed R c/nu; taylor : that times sqrt(c/R). Laminar below `TURBULENT` and `TAYLOR`.
        turbulence : how much stiffer it makes the film, about; 0 of a laminar one.
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
    volumetric = oil.density * oil.heat_capacity
    numbers = film_numbers((R, bearing.length, c, mu), oil, speed, load)
    peclet = numbers["peclet"]
    power, flow, eccentricity_ratio = film_loss(bearing, speed, load, film)
    conducted = mu * (omega * R) ** 2 / (8.0 * oil.conductivity)
    carried = power / (volumetric * flow) if flow else conducted
    share = min(eccentricity_ratio / SLIGHT, 1.0) ** 2
    warming = min(carried, conducted + share * (carried - conducted))
    if peclet <= 1.0:
        warming = min(warming, conducted)
    return {
        **numbers,
        "power": power,
        "side_flow": flow,
        "warming": warming,
        "unknown": float(math.isnan(warming)),
        # A bearing that is given its oil is answered as warm as it gets.
        "thinning": 0.0 if bearing.oil is not None else -math.expm1(-oil.thinning * warming),
    }


def film_numbers(
    dimensions: tuple[float, float, float, float], oil: Lubricant, speed: float, load: tuple[float, float]
) -> dict[str, float]:
    """Return the numbers of `journal_numbers` that need no film.

    Parameters
    ----------
    dimensions : (float, float, float, float) [m], [m], [m], [Pa s]
        Radius, length, clearance and viscosity.
    oil : Lubricant
    speed : float [rad/s]
    load : (float, float) [N]
    """
    (R, L, c, mu), omega = dimensions, abs(speed)
    kinematic = mu / oil.density
    compressed = compression(load, R, L, oil.bulk_modulus)
    flow = film_reynolds(R, c, mu, oil.density, omega)
    return {
        "reynolds": flow.reynolds,
        "taylor": flow.taylor,
        "turbulence": flow.turbulence,
        "inertia": omega * c**2 / kinematic,
        "peclet": omega * c**2 * oil.density * oil.heat_capacity / oil.conductivity,
        "pressure": compressed * oil.bulk_modulus / ATMOSPHERE,
        "compression": compressed,
        "tilt": 2e3 * c / L,
    }


def film_loss(
    bearing: JournalBearing, speed: float, load: tuple[float, float], film: Any = None
) -> tuple[float, float, float]:
    """Return power [W], side flow [m3/s] and eccentricity ratio of an isothermal film.

    If none is given it is the film of the bearing where that is quick: a map of the package, or the short
    film; else a coarse grid. Not-a-number, all three, where that film has no answer under the load.
    """
    R, L, c = bearing.radius, bearing.length, bearing.clearance
    concentric = 2.0 * math.pi * bearing.film_viscosity * speed**2 * R**3 * L / c, 0.0, 0.0
    if not speed or not any(load):
        return concentric
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        try:
            at = equilibrium(film or _quick(bearing), load, speed)
            losses = at.losses
        except RotorfilmError:
            return math.nan, math.nan, math.nan
    if at.eccentricity_ratio < CONCENTRIC or losses is None:
        return concentric
    return float(losses.power_loss), float(losses.side_flow), at.eccentricity_ratio


def _quick(bearing: JournalBearing) -> JournalBearing:
    """Return the bearing with its own film, or with one on a coarse grid."""
    film = bearing.fitted_film
    if isinstance(film, ShortFilm) or (isinstance(film, MapFilm) and has_map(bearing)):
        return bearing
    coarse = replace(film if isinstance(film, ReynoldsFilm) else ReynoldsFilm(), cells=COARSE)
    return replace(bearing, film=coarse)


def film_remarks(
    bearing: JournalBearing | JFOFilm, oil: Lubricant, speed: float, load: tuple[float, float]
) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, at a speed [rad/s] and a load [N].

    Of a bearing whose oil warms it is said of the film at its temperature, and heat is not left out.
    """
    remarks: tuple[Remark, ...] = REMARKS
    film: Any = None
    if isinstance(bearing, JFOFilm):
        film, bearing = replace(bearing, cells=CONSERVED), bearing.bearing
    if bearing.is_warming:
        remarks = tuple(remark for remark in REMARKS if remark.number not in ("thinning", "unknown"))
        bearing = _warmed(bearing, film or _quick(bearing), speed, load)
        film = film and film.at_temperature(bearing.temperature)
    return said(remarks, journal_numbers(bearing, oil, speed, load, film))


def _warmed(bearing: JournalBearing, quick: Any, speed: float, load: tuple[float, float]) -> JournalBearing:
    """Return a bearing at the temperature of its balance, or of fresh oil where it has no rest."""
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        try:
            temperature = equilibrium(quick, load, speed).temperature
        except RotorfilmError:
            temperature = None
    return bearing.at_temperature(bearing.coldest() if temperature is None else temperature)
