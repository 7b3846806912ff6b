"""What the physics of films on pads leaves out, judged by dimensionless numbers."""

from __future__ import annotations

import math

from ...bearings.pads import LobedBearing, PressureDamBearing, TiltingPadBearing
from ..journal.film_candidate import room
from ..journal.journal_remarks import NOTABLE, REMARKS, film_numbers
from ..lubricant_table import Lubricant
from ..remarks import Remark, said

PAD_REMARKS = (
    Remark(
        "thinning",
        NOTABLE,
        "heat: along one pad the oil warms by about {warming:.2g} K if it keeps its heat, which takes "
        "{thinning:.0%} of its viscosity; nor does hot oil go on from pad to pad",
    ),
    *(remark for remark in REMARKS if remark.number not in ("thinning", "unknown")),
)
"""What the physics of films on pads leaves out, by the numbers of `pad_numbers`."""

AnyPads = LobedBearing | PressureDamBearing | TiltingPadBearing


def pad_numbers(
    bearing: AnyPads, extent: float, oil: Lubricant, speed: float, load: tuple[float, float]
) -> dict[str, float]:
    """Return the dimensionless numbers of a bearing whose longest pad has an extent [rad].

    Returns
    -------
    dict of str to float
        Those of `film_numbers`, over the assembled clearance c, and
        warming [K] : of oil that goes along one pad and keeps its heat, 2 viscosity speed R^2 extent/(density
        heat capacity c^2), or between cold walls viscosity U^2/(8 conductivity), the lesser one.
        thinning : relative loss of viscosity by that.
    """
    R, c, mu, omega = bearing.radius, room(bearing), bearing.film_viscosity, abs(speed)
    carried = 2.0 * mu * omega * R**2 * extent / (oil.density * oil.heat_capacity * c**2)
    conducted = mu * (omega * R) ** 2 / (8.0 * oil.conductivity)
    warming = min(carried, conducted)
    dimensions = R, bearing.length, c, mu
    return {
        **film_numbers(dimensions, oil, speed, load),
        "warming": warming,
        "thinning": -math.expm1(-oil.thinning * warming),
    }


def pad_remarks(
    bearing: AnyPads, extent: float, oil: Lubricant, speed: float, load: tuple[float, float]
) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each; the arguments are of `pad_numbers`."""
    return said(PAD_REMARKS, pad_numbers(bearing, extent, oil, speed, load))

