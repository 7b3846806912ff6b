"""What the physics of a rolling-ball contact leaves out, judged by dimensionless numbers."""

from __future__ import annotations

import math

import numpy as np

from ...bearings.contact import HIGGINSON_PRESSURE, DowsonHigginsonDensity, RollingBall
from ...errors import InputError
from ..journal.journal_remarks import NOTABLE
from ..lubricant_table import Lubricant
from ..remarks import Remark, said

FORMED = 2.0
"""Pressure times pressure coefficient at which a film is formed: flow by pressure is down to exp(-2)."""

DENSER = 0.1
"""Growth of the density under the contact that is worth a word."""

FLAT = 0.1
"""Contact radius / ball radius from which the ball is no paraboloid; the gap errs by its square / 4."""


REMARKS = (
    Remark(
        "inlet_thinning",
        NOTABLE,
        "heat: the oil that flows back before the contact warms by about {inlet_warming:.2g} K, which takes "
        "{inlet_thinning:.0%} of its viscosity",
        moves="heat",
    ),
    Remark(
        "piezoviscosity",
        NOTABLE,
        "viscosity: where the film is formed the exponential law gives {exaggeration:.2g} times that of "
        "Roelands; `roelands = true` takes that",
    ),
    Remark(
        "densification",
        DENSER,
        "compressibility: {densification:.0%} under the contact, which thins its film about as much; "
        "`compressible = true` takes it into account",
        moves="compressibility",
    ),
    Remark(
        "flatness",
        FLAT,
        "shape: the contact is {flatness:.2g} of the ball's radius, too wide for a paraboloid",
    ),
)
"""What the physics of a rolling contact leaves out, by the numbers of `contact_numbers`."""


def contact_numbers(
    ball: RollingBall, oil: Lubricant, *, roelands: bool, compressible: bool
) -> dict[str, float]:
    """Return the dimensionless numbers of a lubricated ball.

    Parameters
    ----------
    ball : RollingBall
        With its load and speed.
    oil : Lubricant
    roelands, compressible : bool
        What the film takes into account.

    Returns
    -------
    dict of str to float
        inlet_warming [K] : of the oil that flows back before the contact.
        inlet_thinning : relative loss of viscosity by that, and about two thirds of it of the film.
        piezoviscosity : by how much the exponential law exceeds Roelands' in ln(viscosity), where the film is
        formed; 0 where that law is used or does not exist; exaggeration : its exponential.
        densification : relative growth of the density at the largest pressure; 0 where the film takes it into
        account.
        flatness : contact radius / ball radius.

    Notes
    -----
    Far before the contact nothing flows through: what the surfaces carry in at the speed u returns as a
    parabolic flow of the mean velocity u. Its dissipation between cold walls warms the middle by
    (3/4) viscosity u^2/conductivity, whatever the gap.
    """
    warming = 0.75 * ball.viscosity * ball.speed**2 / oil.conductivity
    density = DowsonHigginsonDensity(pressure_ratio=ball.contact_pressure / HIGGINSON_PRESSURE)
    beyond = 0.0 if roelands else _beyond_roelands(ball)
    return {
        "inlet_warming": warming,
        "inlet_thinning": -math.expm1(-oil.thinning * warming),
        "piezoviscosity": beyond,
        "exaggeration": math.exp(beyond),
        "densification": 0.0 if compressible else float(density.density(np.ones(1))[0]) - 1.0,
        "flatness": ball.contact_radius / ball.radius,
    }


def _beyond_roelands(ball: RollingBall) -> float:
    try:
        law = ball.contact(roelands=True).piezoviscosity
    except InputError:
        return 0.0  # no such law for this oil
    pressure = np.array([min(FORMED / ball.Q0, 1.0)])
    return float(ball.Q0 * pressure[0] + np.log(law.mobility(pressure, ball.Q0)[0]))


def contact_remarks(
    ball: RollingBall, oil: Lubricant, *, roelands: bool, compressible: bool
) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, of a ball; see `contact_numbers`."""
    return said(REMARKS, contact_numbers(ball, oil, roelands=roelands, compressible=compressible))
