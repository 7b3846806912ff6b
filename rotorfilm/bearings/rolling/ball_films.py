"""The oil films in the contacts of a ball bearing."""

from __future__ import annotations

import math

from ...errors import require_number, require_positive
from ...inputs.kinds import arguments
from ..hamrock_dowson import HamrockDowson
from .ball_bearing import BallBearing


@arguments
def ball_films(
    bearing: BallBearing, *, load: float, speed: float, viscosity: float, pressure_coefficient: float
) -> tuple[float, float]:
    """Return the central films of the inner and the outer contact [m], by Hamrock & Dowson (1977).

    As `films` of the bearing they shift the static law: the oil hardly changes its slope. Both races roll at
    the mean speed of their surfaces, speed * pitch_diameter (1 - (D cos(alpha)/pitch_diameter)^2)/4.

    Parameters
    ----------
    bearing : BallBearing
    load : float [N]
        Of a ball; the films change little with it.
    speed : float [rad/s]
        Angular speed of the inner ring.
    viscosity : float [Pa s]
        At ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
        Of the viscosity, d ln mu/dp at ambient pressure.

    Raises
    ------
    InputError
        If the speed is not finite, or another argument is not finite and positive.
    """
    require_positive("load", load)
    require_positive("viscosity", viscosity)
    require_positive("pressure_coefficient", pressure_coefficient)
    pitch = bearing.pitch_diameter
    share = bearing.ball_diameter * math.cos(bearing.free_contact_angle) / pitch
    rolling = 0.25 * abs(require_number("speed", speed)) * pitch * (1.0 - share**2)
    films = []
    for contact in bearing.contacts:
        radius, modulus = contact.rolling_radius, contact.combined_modulus
        numbers = HamrockDowson(
            viscosity * rolling / (modulus * radius),
            pressure_coefficient * modulus,
            load / (modulus * radius**2),
            contact.ellipticity,
        )
        films.append(numbers.central_film * radius)
    return films[0], films[1]
