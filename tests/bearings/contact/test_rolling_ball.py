"""The rolling ball in SI: units, parameters, formulas."""

import math

import pytest

from rotorfilm import ContactGrid, InputError, RollingBall
from rotorfilm.bearings import moes_parameters
from rotorfilm.bearings.contact.point_contact import Moes, hamrock_dowson

BALL = RollingBall(
    radius=0.01,
    mass=0.033,
    modulus=206e9,
    poisson_ratio=0.3,
    viscosity=0.04,
    pressure_coefficient=1.2e-8,
    speed=0.9,
    load=60.0,
)


@pytest.mark.closed_form
def test_dry_contact_is_hertz():
    a, p = BALL.contact_radius, BALL.contact_pressure
    assert BALL.load == pytest.approx(2.0 / 3.0 * math.pi * a**2 * p)
    # E_H = E' / 2 is the modulus of Hertz' formulas: a = pi p R/(2 E_H), approach a^2/R
    assert a == pytest.approx(math.pi * p * BALL.radius / BALL.combined_modulus)
    assert BALL.combined_modulus == pytest.approx(2.0 * 206e9 / (1.0 - 0.09))
    assert 2.0 * BALL.film_scale == pytest.approx(a**2 / BALL.radius)


@pytest.mark.closed_form
def test_velocity_scale_is_the_sum_of_the_surface_speeds():
    # Reynolds' equation in SI, (h^3 p_x/(12 mu))_x = (u1 + u2)/2 h_x + h_t with u1 = u2 = speed: V is the
    # ratio of wedge to pressure flow in Hertzian units, and squeeze counts as much as the wedge in a/speed.
    a, p, h, t = BALL.contact_radius, BALL.contact_pressure, BALL.film_scale, BALL.time_scale
    pressure_flow = h**3 * p / (12.0 * BALL.viscosity * a**2)
    assert pytest.approx(BALL.speed * h / a / pressure_flow) == BALL.V
    assert pytest.approx(h / t / pressure_flow) == BALL.V
    # m z'' = load, in the same units
    assert pytest.approx(BALL.mass * h / t**2 / (p * a**2)) == BALL.W


@pytest.mark.closed_form
def test_parameters_of_moes_agree_with_their_definition():
    E, R = BALL.combined_modulus, BALL.radius
    speed = 2.0 * BALL.viscosity * BALL.speed / (E * R)
    assert pytest.approx(BALL.load / (E * R**2) * speed**-0.75) == BALL.moes.M
    assert pytest.approx(BALL.pressure_coefficient * E * speed**0.25) == BALL.moes.L
    assert hamrock_dowson(BALL.moes, BALL.hamrock_dowson.U) == pytest.approx(BALL.hamrock_dowson)


@pytest.mark.literature
def test_parameters_of_the_published_case():
    moes = moes_parameters(0.1, 5.0)
    assert pytest.approx(95.92, abs=0.01) == moes.M
    assert pytest.approx(2.998, abs=1e-3) == moes.L


@pytest.mark.literature
@pytest.mark.parametrize("roelands", [False, True])
def test_film_thickness_beside_hamrock_and_dowson(roelands):
    # Their formula is a fit to a compressible film on coarse grids; fifteen per cent is what it is worth.
    state = BALL.contact(ContactGrid(cells=(64, 64)), roelands=roelands, compressible=True).stationary()
    film = state.central_film * BALL.film_scale
    assert film == pytest.approx(BALL.hamrock_dowson.central_film * BALL.radius, rel=0.15)
    lowest = state.minimum_film * BALL.film_scale
    assert lowest == pytest.approx(BALL.hamrock_dowson.minimum_film * BALL.radius, rel=0.3)


@pytest.mark.closed_form
def test_formula_of_nijenbanning_tends_to_its_four_limits():
    soft, hard = Moes(1e12, 1e-9), Moes(1e9, 1e4)
    assert soft.central_film == pytest.approx(soft.asymptotes.elastic_isoviscous, rel=1e-3)
    assert hard.central_film == pytest.approx(hard.asymptotes.elastic_piezoviscous, rel=1e-3)
    # A rigid ball in oil of constant viscosity, with the largest film of an elastic one beside it.
    light = Moes(0.01, 1e-9)
    rigid = light.asymptotes.rigid_isoviscous
    assert light.central_film == pytest.approx((rigid**1.5 + 1.8**1.5) ** (2.0 / 3.0), rel=0.02)
    # Rigid in oil that thickens: the two rigid limits together, neither less than the other alone.
    thick = Moes(10.0, 1e4)
    assert thick.central_film == pytest.approx(thick.asymptotes.rigid_piezoviscous, rel=0.1)


@pytest.mark.literature
def test_formula_of_nijenbanning_at_the_published_case():
    # With that of Hamrock and Dowson at speeds U of 1e-12 to 1e-10: .152 to .162 in units of a^2/(2R).
    moes = moes_parameters(0.1, 5.0)
    unit = 2.0 / (1.5 * moes.M) ** (2.0 / 3.0)
    assert moes.central_film * unit == pytest.approx(0.1527, abs=2e-4)
    others = [hamrock_dowson(moes, U).central_film / math.sqrt(2.0 * U) * unit for U in (1e-12, 1e-11, 1e-10)]
    assert 0.152 < min(others) < max(others) < 0.162


@pytest.mark.literature
def test_film_thickness_beside_nijenbanning_venner_and_moes():
    # Like for like is Roelands' viscosity; this rectangle and these cells take two per cent.
    state = BALL.contact(ContactGrid(cells=(64, 64)), roelands=True).stationary()
    film = state.central_film * BALL.film_scale
    assert film == pytest.approx(BALL.published_films.nijenbanning_venner_moes, rel=0.06)
    assert BALL.published_films.hamrock_dowson == BALL.hamrock_dowson.central_film * BALL.radius


def test_compression_thins_the_film():
    grid = ContactGrid(cells=(48, 48))
    dense, light = (BALL.contact(grid, compressible=c).stationary() for c in (True, False))
    assert 0.7 < dense.central_film / light.central_film < 0.97
    assert dense.carried_load == pytest.approx(1.0, rel=1e-6)


def test_elastic_plane_widens_the_contact():
    from dataclasses import replace

    steel = replace(BALL, plane_modulus=206e9)
    assert steel.contact_radius / BALL.contact_radius == pytest.approx(2.0 ** (1.0 / 3.0))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"radius": -0.01}, r"radius must be finite and positive, got -0\.01"),
        ({"speed": 0.0}, r"speed must be finite and positive, got 0\.0"),
        ({"mass": -1.0}, r"mass must be finite and not negative, got -1\.0"),
        ({"poisson_ratio": 0.6}, r"poisson_ratio must be above -1 and at most 0\.5, got 0\.6"),
    ],
)
def test_ball_names_the_broken_rule(change, message):
    from dataclasses import replace

    with pytest.raises(InputError, match=message):
        replace(BALL, **change)


def test_roelands_refuses_a_lubricant_that_thickens_too_fast():
    from dataclasses import replace

    with pytest.raises(
        InputError, match=r"pressure_coefficient must give Roelands' law an exponent of at most 1"
    ):
        replace(BALL, pressure_coefficient=6e-8).contact(roelands=True)
