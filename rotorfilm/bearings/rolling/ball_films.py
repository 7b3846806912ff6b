"""The oil films in the contacts of a ball bearing."""

from __future__ import annotations

import math

from ...errors import InputError, require_number, require_positive
from ...inputs.kinds import arguments
from .ball_bearing import BallBearing
from .ball_results import BallLoads
from .elliptic_contact import EllipticContact
from .race_film import RaceFilm


@arguments
def race_films(
    bearing: BallBearing, *, load: float, speed: float, viscosity: float, pressure_coefficient: float
) -> tuple[RaceFilm, RaceFilm]:
    """Return the films of a ball at the inner and the outer race.

    Both races roll at the mean speed of their surfaces, |speed| * pitch_diameter
    (1 - (D cos(alpha)/pitch_diameter)^2)/4.

    Parameters
    ----------
    bearing : BallBearing
    load : float [N]
        Of the ball.
    speed : float [rad/s]
        Angular speed of the inner ring, not 0.
    viscosity : float [Pa s]
        At ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
        Of the viscosity, d ln mu/dp at ambient pressure.

    Raises
    ------
    InputError
        If the speed is 0 or not finite, or another argument is not finite and positive.
    """
    angle = bearing.free_contact_angle
    inner, outer = (
        _race_film(bearing, contact, angle, load, speed, (viscosity, pressure_coefficient))
        for contact in bearing.contacts
    )
    return inner, outer


@arguments
def ball_films(
    bearing: BallBearing, *, load: float, speed: float, viscosity: float, pressure_coefficient: float
) -> tuple[float, float]:
    """Return the central films of the inner and the outer contact [m], by Hamrock & Dowson (1977).

    As `films` of the bearing they shift the static law: the oil hardly changes its slope.

    Parameters
    ----------
    bearing, load, viscosity, pressure_coefficient
        As of `race_films`; the films change little with the load.
    speed : float [rad/s]
        Angular speed of the inner ring.

    Raises
    ------
    InputError
        If the speed is not finite, or another argument is not finite and positive.
    """
    if require_number("speed", speed) == 0.0:
        for name, value in {
            "load": load, "viscosity": viscosity, "pressure_coefficient": pressure_coefficient
        }.items():  # fmt: skip
            require_positive(name, value)
        return 0.0, 0.0
    inner, outer = race_films(
        bearing, load=load, speed=speed, viscosity=viscosity, pressure_coefficient=pressure_coefficient
    )
    return inner.central_film, outer.central_film


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
    for name, value in {
        "roughness": roughness, "viscosity": viscosity, "pressure_coefficient": pressure_coefficient
    }.items():  # fmt: skip
        require_positive(name, value)
    oil = viscosity, pressure_coefficient
    places = (balls.inner_load, balls.inner_angle), (balls.outer_load, balls.outer_angle)
    loaded = [
        (number, float(angles[loads.argmax()]), float(loads.max()))
        for number, (loads, angles) in enumerate(places)
        if loads.max() > 0.0
    ]
    if not loaded:
        raise InputError("balls must be under load for a film parameter, got loads of 0 N")
    if require_number("speed", speed) == 0.0:
        return 0.0
    films = [
        _race_film(bearing, bearing.contacts_at(angle, angle)[number], angle, load, speed, oil).minimum_film
        for number, angle, load in loaded
    ]
    return min(films) / roughness


def _race_film(
    bearing: BallBearing,
    contact: EllipticContact,
    angle: float,
    load: float,
    speed: float,
    oil: tuple[float, float],
) -> RaceFilm:
    """Return the film of a contact [rad], [N] on an oil of a viscosity and its pressure coefficient."""
    pitch = bearing.pitch_diameter
    share = bearing.ball_diameter * math.cos(angle) / pitch
    return RaceFilm(
        touch=contact,
        load=load,
        rolling_speed=0.25 * abs(require_number("speed", speed)) * pitch * (1.0 - share**2),
        viscosity=oil[0],
        pressure_coefficient=oil[1],
    )
