"""Air in the oil of a squeeze-film damper: when it is drawn in, and a quasi-static correction."""

from __future__ import annotations

import math
from dataclasses import replace

from ....errors import InputError, require_kind, require_non_negative, require_positive
from ....inputs.kinds import arguments
from ..bearing import SqueezeFilmDamper


@arguments
def feed_squeeze_number(
    damper: SqueezeFilmDamper, *, flow: float, amplitude: float, frequency: float
) -> float:
    """Return flow/(pi diameter length amplitude frequency) [1]: below 1 the ends may draw in air.

    Diaz & San Andres' number, their definition not seen in print.

    Parameters
    ----------
    damper : SqueezeFilmDamper
    flow : float [m3/s]
        Of oil fed to the film.
    amplitude : float [m]
        Radius of the orbit.
    frequency : float [rad/s]
        Of the motion.

    Raises
    ------
    InputError
        If a value breaks its rule.
    """
    require_kind("damper", damper, SqueezeFilmDamper, "a SqueezeFilmDamper")
    require_non_negative("flow", flow)
    require_positive("amplitude", amplitude)
    require_positive("frequency", frequency)
    return flow / (2.0 * math.pi * damper.radius * damper.length * amplitude * frequency)


@arguments
def aerated_damper(damper: SqueezeFilmDamper, air_fraction: float) -> SqueezeFilmDamper:
    """Return a damper whose oil is a homogeneous mixture with air: the least damping and mass of that.

    Viscosity and density of the oil times (1 - air_fraction); the viscosity of the mixture lies between that
    and the oil's own, and pressure takes the air back, so that the truth lies between both dampers. Without a
    measured fraction this is a guess.

    Parameters
    ----------
    damper : SqueezeFilmDamper
    air_fraction : float [1]
        Volume of air per volume of mixture at ambient pressure, measured; from 0 to below 1.

    Raises
    ------
    InputError
        If the fraction is not from 0 to below 1.
    """
    require_kind("damper", damper, SqueezeFilmDamper, "a SqueezeFilmDamper")
    require_non_negative("air_fraction", air_fraction)
    if air_fraction >= 1.0:
        raise InputError(f"air_fraction must be below 1, got {air_fraction!r}")
    left = 1.0 - air_fraction
    return replace(damper, viscosity=left * damper.viscosity, density=left * damper.density)
