"""The oil films in the contacts of a ball bearing."""

from __future__ import annotations

import math

from ...errors import InputError, require_number, require_positive
from ...inputs.kinds import arguments
from ..hamrock_dowson import HamrockDowson
from .ball_bearing import BallBearing
from .ball_results import BallLoads
from .elliptic_contact import EllipticContact


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
    angle, oil = bearing.free_contact_angle, (viscosity, pressure_coefficient)
    films = []
    for contact in bearing.contacts:
        numbers = _numbers(bearing, contact, angle, load, speed, oil)
        films.append(numbers.central_film * contact.rolling_radius)
    return films[0], films[1]


@arguments
def film_parameter(
    bearing: BallBearing,
    balls: BallLoads,
    *,
    speed: float,
    viscosity: float,
    pressure_coefficient: float,
    roughness: float,
) -> float:
    """Return lambda [1]: the smallest film thickness of all contacts under load over their roughness.

    The minimum film is that of Hamrock & Dowson (1977). Above 3 the surfaces are taken to be apart, below 1
    to touch.

    Parameters
    ----------
    bearing : BallBearing
    balls : BallLoads
        Its balls under load; of a pair those of both rows.
    speed, viscosity, pressure_coefficient
        As of `ball_films`.
    roughness : float [m]
        Of ball and race together, sqrt(Rq_1^2 + Rq_2^2).

    Raises
    ------
    InputError
        If the speed is not finite, another argument is not finite and positive, or no ball is under load.
    """
    require_positive("roughness", roughness)
    films = []
    places = (balls.inner_load, balls.inner_angle), (balls.outer_load, balls.outer_angle)
    for number, (loads, angles) in enumerate(places):
        most = int(loads.argmax())
        load, angle = float(loads[most]), float(angles[most])
        if load > 0.0:
            contact = bearing.contacts_at(angle, angle)[number]
            numbers = _numbers(bearing, contact, angle, load, speed, (viscosity, pressure_coefficient))
            films.append(numbers.minimum_film * contact.rolling_radius)
    if not films:
        raise InputError("balls must be under load for a film parameter, got loads of 0 N")
    return min(films) / roughness


def _numbers(
    bearing: BallBearing,
    contact: EllipticContact,
    angle: float,
    load: float,
    speed: float,
    oil: tuple[float, float],
) -> HamrockDowson:
    """Return the parameters of a contact [rad], [N] on an oil of a viscosity and its pressure coefficient."""
    viscosity, coefficient = oil
    require_positive("viscosity", viscosity)
    require_positive("pressure_coefficient", coefficient)
    pitch = bearing.pitch_diameter
    share = bearing.ball_diameter * math.cos(angle) / pitch
    rolling = 0.25 * abs(require_number("speed", speed)) * pitch * (1.0 - share**2)
    radius, modulus = contact.rolling_radius, contact.combined_modulus
    return HamrockDowson(
        viscosity * rolling / (modulus * radius),
        coefficient * modulus,
        load / (modulus * radius**2),
        contact.ellipticity,
    )
