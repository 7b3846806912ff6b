"""Oil films as preload: a shift of the contacts, and the preload of a pair that runs."""

import math
from dataclasses import replace

import pytest

from rotorfilm import BallBearing, InputError, StaticBalls, back_to_back
from rotorfilm.bearings import ball_films

DEEP = BallBearing(
    balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, internal_clearance=10e-6, law=StaticBalls()
)
ANGULAR = BallBearing(
    balls=10,
    ball_diameter=7.938e-3,
    pitch_diameter=33.5e-3,
    contact_angle=math.radians(25.0),
    outer_conformity=0.53,
    law=StaticBalls(),
)
OIL = {"viscosity": 0.02, "pressure_coefficient": 2e-8}


@pytest.mark.closed_form
def test_films_are_as_much_growth_where_the_contacts_are_radial():
    at = (2e-6, -7e-6, 0.0, 0.0, 0.0)
    wetted, grown = replace(DEEP, films=(2e-7, 3e-7)), replace(DEEP, growth=5e-7)
    assert wetted.wrench(at) == pytest.approx(grown.wrench(at), rel=1e-9, abs=1e-12)
    assert wetted.wrench(at)[1] > 1.1 * DEEP.wrench(at)[1]


@pytest.mark.closed_form
@pytest.mark.parametrize(("film", "preload"), [(0.2e-6, 187.0), (0.5e-6, 247.0)])
def test_films_raise_the_preload_of_a_pair(film, preload):
    """Of an independent code, for a pair that was preloaded dry with 150 N."""
    pair = back_to_back(replace(ANGULAR, films=(film, film)), distance=0.02, preload=150.0)
    assert pair.running_preload() == pytest.approx(preload, rel=4e-3)


@pytest.mark.closed_form
def test_films_are_those_of_the_formula_and_go_with_its_powers():
    inner, outer = ball_films(ANGULAR, load=50.0, speed=1000.0, **OIL)
    contact = ANGULAR.contacts[0]
    R, E = contact.rolling_radius, contact.combined_modulus
    rolling = 1000.0 * 33.5e-3 / 4.0 * (1.0 - (7.938 / 33.5 * math.cos(math.radians(25.0))) ** 2)
    shape = 1.0 - 0.61 * math.exp(-0.73 * contact.ellipticity)
    wanted = (
        2.69 * R * (0.02 * rolling / (E * R)) ** 0.67 * (2e-8 * E) ** 0.53 * (50.0 / (E * R**2)) ** -0.067
    )
    assert inner == pytest.approx(wanted * shape, rel=1e-12)
    assert 1e-7 < inner < outer < 1e-6
    twice = ball_films(ANGULAR, load=50.0, speed=-2000.0, **OIL)
    assert twice[0] == pytest.approx(2.0**0.67 * inner, rel=1e-12)


def test_errors_name_argument_rule_and_value():
    with pytest.raises(InputError, match=r"films must be two thicknesses .*, got \(-1e-07, 0\.0\)"):
        replace(DEEP, films=(-1e-7, 0.0))
    with pytest.raises(InputError, match=r"films must be two thicknesses .*, got \(1e-05, 0\.0\)"):
        replace(DEEP, inner_conformity=0.501, films=(1e-5, 0.0))
    with pytest.raises(InputError, match="load must be finite and positive, got 0"):
        ball_films(DEEP, load=0.0, speed=100.0, **OIL)
