"""The oil films in the contacts of a ball bearing."""

from __future__ import annotations

import math

from ...errors import require_number, require_positive
from ...inputs.kinds import arguments
from .ball_bearing import BallBearing
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
    pitch = bearing.pitch_diameter
    share = bearing.ball_diameter * math.cos(bearing.free_contact_angle) / pitch
    rolling = 0.25 * abs(require_number("speed", speed)) * pitch * (1.0 - share**2)
    inner, outer = (
        RaceFilm(
            touch=contact,
            load=load,
            rolling_speed=rolling,
            viscosity=viscosity,
            pressure_coefficient=pressure_coefficient,
        )
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
