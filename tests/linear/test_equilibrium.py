import math
import re
import warnings
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from map_potential import potential

from rotorfilm import (
    EquilibriumError,
    FullFilm,
    InputError,
    Pad,
    ReynoldsFilm,
    SqueezeFilmDamper,
    ValidityWarning,
    as_reaction,
    with_springs,
)
from rotorfilm.analysis import coefficient_table, coefficients, equilibrium
from rotorfilm.bearings.journal import JournalBearing, MapFilm, RotatingArc, ShortFilm, SplittingFilm
from rotorfilm.bearings.oil import Cooling, Oil

pytestmark = pytest.mark.filterwarnings("ignore:load .* makes a mean pressure")
"""Closed forms near the wall, in SI units of a film that bears more than any oil."""

SPEED = 1500 * math.pi / 30
ECCENTRICITIES = [1e-6, 0.001, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.95, 0.99, 0.995]
angles = st.floats(-math.pi, math.pi)
sizes = st.floats(-3.0, 7.0).map(lambda power: 10.0**power)
few = settings(max_examples=25, deadline=None)


def along(angle):
    return np.array([math.cos(angle), math.sin(angle)])


def turned(angle):
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])


@pytest.mark.closed_form
@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_short_bearing_in_every_direction(bearing, ocvirk, eps, sense):
    attitude = ocvirk.attitude_angle(eps)
    for direction in np.arange(-3, 4) * 0.9:
        at = equilibrium(bearing, ocvirk.load(eps, SPEED) * along(direction), sense * SPEED)
        assert at.eccentricity_ratio == pytest.approx(eps, rel=1e-11)
        assert at.attitude_angle == pytest.approx(attitude, abs=1e-11)
        np.testing.assert_allclose(
            at.position,
            eps * bearing.clearance * along(direction + sense * attitude),
            atol=1e-11 * eps * 1e-4,
        )
        assert at.minimum_film == pytest.approx((1 - eps) * bearing.clearance, rel=1e-10)
        assert at.residual <= 1e-12
        assert at.iterations <= 8


@pytest.mark.closed_form
def test_attitude_angle_is_an_angle_of_the_short_bearing_formula(bearing, ocvirk):
    # 70.62 deg at the eccentricity .2663 of 525 N; operator precedence made 11.4 deg of it elsewhere
    at = equilibrium(bearing, [0.0, -525.0], SPEED)
    eps = at.eccentricity_ratio
    assert math.tan(at.attitude_angle) == pytest.approx(
        math.pi * math.sqrt(1 - eps**2) / (4 * eps), rel=1e-12
    )
    assert math.degrees(at.attitude_angle) == pytest.approx(70.62, abs=0.01)


@pytest.mark.parametrize(
    "film",
    [SplittingFilm(order=(1, 1)), SplittingFilm(order=(4, 2), rupture=RotatingArc())],
    ids=["first approximation", "rotating arc"],
)
@pytest.mark.parametrize("eps", [1e-6, 0.001, 0.5, 0.99, 0.995])
def test_other_films_are_found_where_their_force_is_the_load(with_film, film, eps):
    bearing = with_film(film)
    position = eps * bearing.clearance * along(0.4)
    for speed in (SPEED, -SPEED):
        at = equilibrium(bearing, -bearing.force(position, [0, 0], speed), speed)
        np.testing.assert_allclose(at.position, position, atol=1e-10 * eps * bearing.clearance)
        assert at.residual <= 1e-12


@pytest.mark.closed_form
@pytest.mark.parametrize("eps", [0.01, 0.3, 0.8, 0.99])
def test_film_that_depends_on_direction(skewed_film, bearing, eps):
    for direction in np.arange(6):
        load = -skewed_film.force(eps * bearing.clearance * along(direction), [0, 0], SPEED)
        at = equilibrium(skewed_film, load, SPEED)
        np.testing.assert_allclose(
            at.position, eps * bearing.clearance * along(direction), atol=1e-10 * eps * bearing.clearance
        )


def test_any_reaction_takes_the_same_way_as_one_that_speaks_numbers(bearing, skewed_film):
    # The skewed film has force and jacobian only.
    plain = replace(skewed_film, skew=np.eye(2))
    one, other = (equilibrium(film, [100.0, -525.0], SPEED) for film in (bearing, plain))
    np.testing.assert_allclose(one.position, other.position, rtol=1e-12)
    assert one.iterations == other.iterations


def test_newton_stays_quadratic_where_the_film_depends_on_direction(skewed_film):
    rng = np.random.default_rng(0)
    for _ in range(30):
        film = replace(skewed_film, skew=np.eye(2) + 0.3 * rng.normal(size=(2, 2)))
        position = rng.uniform(0.05, 0.95) * film.clearance * along(rng.uniform(-3.0, 3.0))
        at = equilibrium(film, -film.force(position, [0, 0], SPEED), SPEED)
        assert at.iterations <= 8


def test_film_so_skewed_that_the_first_start_fails(skewed_film):
    film = replace(skewed_film, skew=np.array([[-2.86, -2.55], [0.77, 0.70]]))
    position = 0.045 * film.clearance * along(6.1)
    with pytest.warns(ValidityWarning, match="is statically unstable"):
        at = equilibrium(film, -film.force(position, [0, 0], SPEED), SPEED)
    np.testing.assert_allclose(at.position, position, rtol=1e-8)


@pytest.mark.closed_form
def test_spring_is_found_without_rotation(linear_film):
    film = linear_film([[3e6, 1e6], [-2e6, 1e6]], np.eye(2))
    load = np.array([100.0, -500.0])
    np.testing.assert_allclose(
        equilibrium(film, load, 0.0).position, np.linalg.solve(film.stiffness, load), rtol=1e-11
    )


@few
@given(size=sizes, direction=angles, turn=angles, speed=st.floats(1.0, 1e4))
def test_turning_the_load_turns_the_position(bearing, size, direction, turn, speed):
    one = equilibrium(bearing, size * along(direction), speed)
    other = equilibrium(bearing, size * along(direction + turn), speed)
    np.testing.assert_allclose(
        other.position, turned(turn) @ one.position, atol=1e-9 * math.hypot(*one.position)
    )
    assert other.attitude_angle == pytest.approx(one.attitude_angle, abs=1e-9)


@few
@given(size=sizes, direction=angles, splitting=st.booleans())
def test_mirror_image_rotates_the_other_way(with_film, size, direction, splitting):
    film = SplittingFilm(order=(2, None)) if splitting else ShortFilm()
    one = equilibrium(with_film(film), size * along(direction), SPEED)
    other = equilibrium(with_film(film), size * along(-direction), -SPEED)
    np.testing.assert_allclose(other.position, one.position * [1, -1], atol=1e-9 * math.hypot(*one.position))
    assert other.attitude_angle == pytest.approx(one.attitude_angle, abs=1e-9)
    assert 0 < one.attitude_angle < math.pi / 2


@few
@given(size=sizes, factor=st.floats(0.1, 10.0))
def test_load_and_speed_matter_by_their_ratio_only(bearing, size, factor):
    one = equilibrium(bearing, [size, 0.0], SPEED)
    other = equilibrium(bearing, [factor * size, 0.0], factor * SPEED)
    # Along a light load the position is of second order: its round-off is that of the whole.
    np.testing.assert_allclose(other.position, one.position, atol=1e-9 * math.hypot(*one.position))


def test_load_beyond_capacity_is_named_with_the_force_at_the_limit(bearing, ocvirk):
    limit = ocvirk.load(0.9999, SPEED)
    with pytest.raises(EquilibriumError, match=re.escape(f"0.9999 is {limit:.6g} N, got load [0.0, -1e+30]")):
        equilibrium(bearing, [0.0, -1e30], SPEED)
    with pytest.raises(EquilibriumError, match="capacity"):
        equilibrium(bearing, [1.001 * limit, 0.0], -SPEED)
    assert equilibrium(bearing, [0.999 * limit, 0.0], -SPEED).eccentricity_ratio < 0.9999


def test_a_load_far_beyond_capacity_is_refused_after_one_search(linear_film, monkeypatch):
    film, asked = linear_film(1e6 * np.eye(2), np.eye(2)), []
    own = type(film).jacobian
    monkeypatch.setattr(type(film), "jacobian", lambda *args: asked.append(1) or own(*args))
    with pytest.raises(EquilibriumError, match="must be within the film's capacity"):
        equilibrium(film, [0.0, -10.0 * 1e6 * film.clearance], SPEED)
    # 96 of them look for the directions in which the film pushes.
    assert len(asked) < 200


def test_no_wedge_without_rotation(bearing):
    with pytest.raises(EquilibriumError, match=r"speed must let the film carry the load.* 0\.0 rad/s.*525"):
        equilibrium(bearing, [0.0, -525.0], 0.0)


def test_why_a_damper_in_springs_is_not_at_rest_is_said():
    """It has no damping matrix there, though its springs carry the load."""
    caged = with_springs(SqueezeFilmDamper(radius=0.06, length=0.03, clearance=1e-4, viscosity=0.01), 2e7)
    with pytest.raises(
        EquilibriumError, match=r"carries none.*must not vanish where a derivative is asked for"
    ):
        equilibrium(caged, [0.0, -525.0], 628.0)
    damper = SqueezeFilmDamper(radius=0.06, length=0.03, clearance=1e-4, viscosity=0.01, extent=FullFilm())
    at = equilibrium(with_springs(damper, 2e7), [0.0, -525.0], 628.0)
    assert at.position == pytest.approx([0.0, -525.0 / 2e7], abs=1e-12)


def test_force_that_cannot_point_against_the_load(linear_film):
    # K has rank one: the force has one direction only
    film = linear_film([[1e6, 0.0], [0.0, 0.0]], np.eye(2))
    with pytest.raises(EquilibriumError, match="no force in the opposite direction"):
        equilibrium(film, [1.0, -1.0], SPEED)


@pytest.mark.parametrize(
    ("sizes", "viscosity", "speed", "limit"),
    [
        # 41.2 sqrt(R/c) at c/R of 2e-3, and 1300 at 1e-4.
        ((0.25, 0.4, 0.5e-3), 0.0159, 314.159, 921.3),
        ((0.5, 0.5, 5e-5), 0.003, 300.0, 1300.0),
    ],
)
def test_a_film_that_is_not_laminar_is_warned_of(sizes, viscosity, speed, limit):
    radius, length, clearance = sizes
    bearing = JournalBearing(radius=radius, length=length, clearance=clearance, viscosity=viscosity)
    reynolds = speed * radius * clearance * 870.0 / viscosity
    told = f"Reynolds number {reynolds:.4g} and Taylor number {reynolds * math.sqrt(clearance / radius):.3g} "
    with pytest.warns(ValidityWarning, match=f"{told}.*beyond the Reynolds number {limit:.4g}"):
        at = equilibrium(bearing, (0.0, -3e5), speed)
    slow = 0.99 * speed * limit / reynolds
    equilibrium(bearing, (0.0, -3e5), slow)
    with pytest.warns(ValidityWarning, match=f"{told}.*beyond the Reynolds number {limit:.4g}"):
        coefficients(bearing, at.position, speed)
    coefficients(bearing, at.position, slow)
    # Analyses warn once, of the equilibrium whose place they take.
    with pytest.warns(ValidityWarning, match=told) as said:
        coefficient_table(bearing, (0.0, -3e5), [slow, speed])
    assert len(said) == 1


def test_a_balance_beyond_the_law_of_the_oil_is_warned_of():
    cooling = Cooling(supply_temperature="60 degC")
    oil = Oil.thinning_at("5 mPa s", "60 degC", "0.005 1/K")
    warm = JournalBearing(
        radius=0.05, length=0.03, clearance=5e-5, film=ShortFilm(), oil=oil, cooling=cooling
    )
    with pytest.warns(ValidityWarning, match="oil is valid from 10 to 110 degC, and is used at"):
        equilibrium(warm, (0.0, -60.0), 600.0)


def test_print_of_a_film_that_warms_says_degrees_and_power():
    cooling = Cooling(supply_temperature="45 degC")
    sizes = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "film": ShortFilm()}
    warm = equilibrium(JournalBearing(**sizes, oil=Oil.iso_vg(46), cooling=cooling), (0.0, -525.0), SPEED)
    rows = dict(warm.to_rows())
    assert rows["temperature"] == f"{warm.temperature:.6g} K = {warm.temperature - 273.15:.6g} degC"
    assert rows["power loss"] == f"{warm.losses.power_loss:.6g} W"
    with pytest.warns(
        ValidityWarning, match="where the oil is tabulated|oil is valid from .* and is used at"
    ):
        odd = equilibrium(JournalBearing(**sizes, oil=Oil.iso_vg(46), cooling=cooling), (0.0, -1e-6), SPEED)
    assert "power loss" in str(odd)  # which does not warn
    cold = equilibrium(JournalBearing(**sizes, viscosity=0.1), (0.0, -525.0), SPEED)
    assert not {"temperature", "power loss"} & dict(cold.to_rows()).keys()


@pytest.mark.parametrize(
    ("load", "speed", "message"),
    [
        ([0.0, 0.0], SPEED, "load must not be zero"),
        ([math.nan, 1.0], SPEED, "load must be finite"),
        ([1.0, 1.0, 1.0], SPEED, "load must have shape"),
        (5.0, SPEED, r"load must be the components .*, as load=\(0, -5\) .* downward, got 5$"),
        ("5 N", SPEED, r"load must be the components .*, as load=\(0, -5\) .* downward, got 5$"),
        ([1.0, 0.0], math.inf, "speed must be a single finite number, got inf"),
        ([1.0, 0.0], [1.0, 2.0], "speed must be a single finite number"),
    ],
)
def test_bad_arguments(bearing, load, speed, message):
    with pytest.raises(InputError, match=message):
        equilibrium(bearing, load, speed)


@pytest.mark.convergence
def test_capacity_on_a_map_is_that_of_the_converged_film(bearing):
    mapped = replace(bearing, length=2.0 * bearing.radius, film=MapFilm())
    film = potential(0.9999, 0.5, 1.0)
    scale = mapped.viscosity * mapped.length * mapped.radius**3 / mapped.clearance**2
    exact = scale * 0.5 * 0.9999 * SPEED * math.exp(film.log) * math.hypot(*film.force)
    with pytest.raises(EquilibriumError) as caught:
        equilibrium(mapped, [0.0, -1e20], SPEED)
    capacity = float(re.search(r"0\.9999 is (\S+) N", str(caught.value))[1])
    assert capacity == pytest.approx(exact, rel=5e-3)


def test_search_beyond_the_map_warns_of_the_answer_alone(bearing):
    mapped = replace(bearing, film=MapFilm())
    with pytest.raises(EquilibriumError, match="load must be within the film's capacity"):
        equilibrium(mapped, [0.0, -1e20], SPEED)
    load = -mapped.force([0.99e-4, 0.0], [0.0, 0.0], SPEED)
    assert equilibrium(mapped, load, SPEED).eccentricity_ratio == pytest.approx(0.99, rel=1e-9)
    with pytest.warns(ValidityWarning, match=r"eccentricity ratio 0\.999.* is beyond the map"):
        equilibrium(mapped, 100.0 * load, SPEED)


@pytest.mark.parametrize("angle", [90.0, 30.0, 180.0])
def test_a_load_that_a_pad_cannot_push_against_is_told_so(angle):
    """The pressure of one pad of 120 deg below the journal has an upward part, wherever the journal is."""
    pad = Pad(start=math.radians(210.0), extent=math.radians(120.0))
    bearing = JournalBearing(
        radius=0.05,
        length=0.05,
        clearance=1e-4,
        viscosity=0.02,
        pads=(pad,),
        film=ReynoldsFilm(cells=(48, 4)),
    )
    equilibrium(bearing, [0.0, -1000.0], SPEED)
    with pytest.raises(EquilibriumError, match="it has no force in the opposite direction"):
        equilibrium(bearing, 1000.0 * along(math.radians(angle)), SPEED)


@pytest.mark.closed_form
@pytest.mark.parametrize(("across", "falls"), [(1e6, False), (-1e6, True), (0.0, False)])
def test_a_journal_that_moves_away_from_its_place_is_warned_of(across, falls):
    """Springs, one of which pushes away: det K < 0."""
    springs = as_reaction(
        lambda x, y, vx, vy, speed: (-across * (x - 1e-6), -2e7 * y),
        jacobian=lambda x, y, vx, vy, speed: np.diag([-across, -2e7]) @ np.eye(2, 5),
        clearance=1e-4,
    )
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        at = equilibrium(springs, [0.0, -400.0], SPEED)
    assert at.position[1] == pytest.approx(-2e-5, rel=1e-9)
    assert any("statically unstable" in str(one.message) for one in caught) == falls
