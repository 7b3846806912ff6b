"""What every squeeze film of a damper leaves out, judged by dimensionless numbers."""

from __future__ import annotations

import math

import numpy as np

from ...bearings.damper import PorousDamper, land_share, layer_modes
from ...bearings.films.cavitation import FullFilm
from ..journal.journal_remarks import ATMOSPHERE, NOTABLE
from ..lubricant_table import Lubricant
from ..remarks import Remark, said

NOTABLE_MASS = 0.05
"""Mass of the moving film / mass of the rotor that is worth a word."""


NOTABLE_INERTIA = 0.1
"""Pressure of the inertia / viscous pressure that is worth a word."""

ON_ORBIT = "cavitation: on an orbit of eccentricity ratio {eccentricity_ratio:.2g} the "

INERTIA = (
    Remark(
        "inertia",
        NOTABLE_INERTIA,
        "inertia of the film: {inertia:.2g} of the viscous pressure (squeeze Reynolds number {reynolds:.2g});"
        " [damper] density takes it in",
    ),
    Remark(
        "added_mass",
        NOTABLE_MASS,
        "inertia of the film: it moves along as {added_mass:.1%} of the rotor's mass; [damper] density takes "
        "it in",
    ),
)
"""What a film without inertia leaves out, by the numbers of `damper_numbers`."""

REMARKS = (
    Remark(
        "thinning",
        NOTABLE,
        "heat: on an orbit of eccentricity ratio {eccentricity_ratio:.2g} the oil warms by about "
        "{warming:.2g} K (Peclet number {peclet:.2g}), which takes {thinning:.0%} of its viscosity",
        moves="heat",
    ),
    Remark(
        "compression",
        0.01,
        "compressibility: {compression:.2%} by the largest pressure",
        moves="compressibility",
    ),
)
"""What the physics of a squeeze film leaves out, by the numbers of `damper_numbers`."""

FULL = (
    Remark(
        "pressure",
        1.0,
        ON_ORBIT
        + "full film carries a tension of {pressure:.2g} times the ambient pressure, where oil ruptures",
    ),
)
"""The same of one that never ruptures."""

RUPTURED = (
    Remark(
        "pressure",
        NOTABLE,
        ON_ORBIT + "pressure is {pressure:.2g} of the ambient one only, so that the oil may not rupture "
        "where this film does",
        below=True,
    ),
    Remark(
        "pressure",
        1.0 / NOTABLE,
        ON_ORBIT + "pressure is {pressure:.2g} times the ambient one, which does not fill the cavity again "
        "within a turn: [damper] supply takes a film that conserves its oil",
    ),
)
"""The same of one that does."""


def damper_numbers(
    damper: PorousDamper, oil: Lubricant, mass: float, speed: float, eccentricity_ratio: float
) -> dict[str, float]:
    """Return the dimensionless numbers of a film whose rotor [kg] whirls on a circle at a speed [rad/s].

    Returns
    -------
    dict of str to float
        eccentricity_ratio : of the circle.
        inertia : pressure of the film's inertia over the viscous one, a tenth of `reynolds`, the squeeze
        Reynolds number speed c^2/nu.
        added_mass : mass with which the film follows the rotor / mass of the rotor.
        peclet : speed c^2/diffusivity, heat carried along over heat conducted across the film.
        warming [K] : rise of temperature, of the oil squeezed out (Peclet number above 1) or between cold
        walls; thinning : relative loss of viscosity by that.
        pressure : largest pressure of the film over the ambient one: a full film carries as much tension; and
        the part of a cavity that ambient pressure fills again within a turn is the inverse of this.
        compression : largest pressure over the bulk modulus.

    Notes
    -----
    With a parabolic profile the momentum of the flow is 6/5 of that of its mean, so that the pressure
    gradient is 12 viscosity/h^2 (1 + i Re/10) times the mean velocity, Re = speed h^2/nu. The film's power
    heats what is squeezed out, 2 radius length e speed, or, if it stays, the middle of a slab between cold
    walls, by power/volume c^2/(8 conductivity). The pressure is that of the short film in its middle.
    """
    R, L, c, omega = damper.radius, damper.length, damper.clearance, abs(speed)
    e = eccentricity_ratio * c
    volumetric = oil.density * oil.heat_capacity
    tangential = float(damper.force([e, 0.0], [0.0, omega * e], omega)[1])
    inertia = omega * c**2 * oil.density / damper.viscosity / 10.0
    power = -tangential * omega * e
    peclet = omega * c**2 * volumetric / oil.conductivity
    adiabatic = power / (volumetric * 2.0 * R * L * e * omega)
    conducted = power * c / (2.0 * math.pi * R * L * 8.0 * oil.conductivity)
    warming = adiabatic if peclet > 1.0 else min(adiabatic, conducted)
    largest = largest_pressure(damper, omega, eccentricity_ratio)
    return {
        "eccentricity_ratio": eccentricity_ratio,
        "inertia": inertia,
        "reynolds": 10.0 * inertia,
        "added_mass": inertia * -tangential / (omega**2 * e * mass),
        "peclet": peclet,
        "warming": warming,
        "thinning": -math.expm1(-oil.thinning * warming),
        "pressure": largest / ATMOSPHERE,
        "compression": largest / oil.bulk_modulus,
    }


def largest_pressure(damper: PorousDamper, speed: float, eccentricity_ratio: float) -> float:
    """Return the largest pressure [Pa] of a short film on a circular orbit, in the middle of its length.

    (3/2) viscosity (L/c)^2 speed max of eps sin(theta) G(h): the parabola of a film without flow around.
    Seals raise it as they do the damping.
    """
    theta = np.linspace(0.0, math.pi, 721)
    h = 1.0 + eccentricity_ratio * np.cos(theta)
    modes = layer_modes(damper.layer)
    G = modes.weight @ (1.0 / (h**3 + modes.leak[:, None]))
    source = eccentricity_ratio * speed * np.sin(theta)
    scale = 1.5 * damper.viscosity * (damper.length / damper.clearance) ** 2
    if damper.seals is not None:
        leak = damper.squeeze_case.end_leak
        scale *= land_share(damper.slenderness, leak).real / land_share(damper.slenderness, math.inf).real
    return scale * float(np.max(source * G))


def damper_remarks(
    damper: PorousDamper, oil: Lubricant, mass: float, speed: float, eccentricity_ratio: float
) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, for an orbit of an eccentricity ratio."""
    numbers = damper_numbers(damper, oil, mass, speed, eccentricity_ratio)
    ruptures = FULL if isinstance(damper.extent, FullFilm) else RUPTURED
    return said((*(() if damper.has_inertia else INERTIA), *REMARKS, *ruptures), numbers)
