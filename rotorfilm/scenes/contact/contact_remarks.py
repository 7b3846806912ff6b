"""What the physics of a rolling-ball contact leaves out, judged by dimensionless numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...bearings.contact import HIGGINSON_PRESSURE, DowsonHigginsonDensity, RollingBall
from ...errors import InputError
from ..journal.journal_remarks import NOTABLE
from ..lubricant_table import LubricantTable
from .contact_table import ContactTable

if TYPE_CHECKING:
    from ..scene import Scene

FORMED = 2.0
"""Pressure times pressure coefficient at which a film is formed: flow by pressure is down to exp(-2)."""

DENSER = 0.1
"""Growth of the density under the contact that is worth a word."""

FLAT = 0.1
"""Contact radius / ball radius from which the ball is no paraboloid; the gap errs by its square / 4."""


class ContactNumbers(NamedTuple):
    """Dimensionless numbers of a lubricated ball.

    Attributes
    ----------
    inlet_warming : float [K]
        Of the oil that flows back before the contact.
    inlet_thinning : float
        Relative loss of viscosity by that, and about two thirds of it of the film.
    piezoviscosity : float
        By how much the exponential law exceeds Roelands' in ln(viscosity), where the film is formed; 0 where
        that law is used or does not exist.
    densification : float
        Relative growth of the density at the largest pressure; 0 where the film takes it into account.
    flatness : float
        Contact radius / ball radius.
    """

    inlet_warming: float
    inlet_thinning: float
    piezoviscosity: float
    densification: float
    flatness: float


def contact_numbers(table: ContactTable, oil: LubricantTable) -> ContactNumbers:
    """Return the numbers of a ball and its oil.

    Far before the contact nothing flows through: what the surfaces carry in at the speed u returns as a
    parabolic flow of the mean velocity u. Its dissipation between cold walls warms the middle by
    (3/4) viscosity u^2/conductivity, whatever the gap.
    """
    ball = table.build()
    warming = 0.75 * ball.viscosity * ball.speed**2 / oil.conductivity
    density = DowsonHigginsonDensity(pressure_ratio=ball.contact_pressure / HIGGINSON_PRESSURE)
    return ContactNumbers(
        inlet_warming=warming,
        inlet_thinning=-math.expm1(-oil.thinning * warming),
        piezoviscosity=0.0 if table.roelands else _beyond_roelands(ball),
        densification=0.0 if table.compressible else float(density.density(np.ones(1))[0]) - 1.0,
        flatness=ball.contact_radius / ball.radius,
    )


def _beyond_roelands(ball: RollingBall) -> float:
    try:
        law = ball.contact(roelands=True).piezoviscosity
    except InputError:
        return 0.0  # no such law for this oil
    pressure = np.array([min(FORMED / ball.Q0, 1.0)])
    return float(ball.Q0 * pressure[0] + np.log(law.mobility(pressure, ball.Q0)[0]))


def contact_remarks(scene: Scene) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, for the ball of a scene."""
    assert scene.contact is not None  # checked by the ladder
    n = contact_numbers(scene.contact, scene.lubricant)
    lines = {
        f"heat: the oil that flows back before the contact warms by about {n.inlet_warming:.2g} K, which "
        f"takes {n.inlet_thinning:.0%} of its viscosity": n.inlet_thinning > NOTABLE,
        f"viscosity: where the film is formed the exponential law gives {math.exp(n.piezoviscosity):.2g} "
        "times that of Roelands; `roelands = true` takes that": n.piezoviscosity > NOTABLE,
        f"compressibility: {n.densification:.0%} under the contact, which thins its film about as much; "
        "`compressible = true` takes it into account": n.densification > DENSER,
        f"shape: the contact is {n.flatness:.2g} of the ball's radius, too wide for a paraboloid": (
            n.flatness > FLAT
        ),
    }
    return tuple(line for line, applies in lines.items() if applies)
