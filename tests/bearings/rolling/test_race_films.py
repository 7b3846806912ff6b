"""Films between balls and races: damping of slow motions, dynamics in five degrees."""

import math
from dataclasses import replace

import fmpy
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rotorfilm import (
    BallBearing,
    ContactGrid,
    Dynamic,
    InputError,
    RunningBalls,
    StaticBalls,
    ValidityWarning,
    back_to_back,
    export_fmu,
    linearize,
    lubricated_balls,
)
from rotorfilm.analysis import OperatingPoint
from rotorfilm.bearings import (
    BarusViscosity,
    EllipticContact,
    RaceFilm,
    RoelandsViscosity,
    SmallMotion,
    film_damping,
    race_films,
)
from rotorfilm.core import Switched

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
FAST = 10000.0 * math.pi / 30.0
GRID = ContactGrid(cells=(28, 28), half_width=1.5)


@pytest.fixture(autouse=True, scope="module")
def _cache(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROTORFILM_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="module")
def pressed():
    """Return a bearing under pure thrust, all balls alike, its rest and the model of its films."""
    rest = ANGULAR.rest((0.0, 0.0, 300.0, 0.0, 0.0), FAST)
    return rest, lubricated_balls(ANGULAR, rest, **OIL, grid=GRID)


def relative_damping(V, Q0, cells, ellipticity=4.0):
    film = race_film(V, Q0)
    c = film.contact(ContactGrid(cells=(cells, cells), half_width=1.5), ellipticity=ellipticity)
    state = c.stationary()
    small = SmallMotion(c.equations, state.levels[0].pressure, state.delta)
    return small.stiffness(1e-6j).imag / 1e-6 / c.equations.ellipse.slope


def race_film(V, Q0):
    """Return a film of given numbers: the load makes the one, the speed the other."""
    touch = EllipticContact(rolling_radius=3.2e-3, groove_radius=60e-3, combined_modulus=2.27e11)
    bare = RaceFilm(touch=touch, load=touch.load_at(Q0 / 2e-8), rolling_speed=1.0, **OIL)
    return replace(bare, rolling_speed=V / bare.V)


# One film


@pytest.mark.closed_form
def test_numbers_of_a_race_are_those_of_its_definition():
    film = race_film(0.07, 18.0)
    a, b = film.touch.half_axes(film.load)
    assert pytest.approx(0.07) == film.V
    assert pytest.approx(18.0) == film.Q0
    assert film.contact_pressure == pytest.approx(1.5 * film.load / (math.pi * a * b))
    assert film.time_scale == pytest.approx(b / film.rolling_speed)
    law = film.contact().piezoviscosity
    assert isinstance(law, RoelandsViscosity)
    # Roelands: ln(mu/mu0) = (ln mu0 + 9.67)((1 + p/196 MPa)^z - 1).
    p = np.array([0.7])
    exponent = film.pressure_coefficient * 1.96e8 / (math.log(0.02) + 9.67)
    exact = (math.log(0.02) + 9.67) * ((1.0 + p * film.contact_pressure / 1.96e8) ** exponent - 1.0)
    assert -np.log(law.mobility(p, film.Q0)) == pytest.approx(exact, rel=1e-9)


@pytest.mark.regression
@pytest.mark.parametrize(("V", "Q0"), [(0.07, 18.0), (0.9, 9.0)])
def test_formula_of_slow_damping_is_that_of_the_film_off_the_points_of_its_fit(V, Q0):
    film = race_film(V, Q0)
    share = film.slow_damping / (film.stiffness * film.time_scale)
    assert share == pytest.approx(relative_damping(V, Q0, 36), rel=0.08)


@pytest.mark.literature
def test_damping_of_a_ball_is_as_small_as_another_code_has_it():
    """About .7 us at 300 N, 10 000 rpm, 20 mPa s, and 1.5 us at 1500 rpm."""
    for speed, delay in ((FAST, 0.7e-6), (0.15 * FAST, 1.5e-6)):
        films = race_films(DEEP, load=300.0, speed=speed, **OIL)
        soft = np.array([1.0 / film.stiffness for film in films])
        slow = sum(film.slow_damping * c**2 for film, c in zip(films, soft, strict=True)) / soft.sum()
        assert slow == pytest.approx(delay, rel=0.2)


def test_roelands_law_reaches_contacts_of_some_gigapascal():
    film = race_film(0.05, 45.0)
    assert film.contact_pressure > 2.2e9
    contact = film.contact(ContactGrid(cells=(32, 32), half_width=1.5))
    assert contact.stationary().carried_load == pytest.approx(1.0, rel=1e-6)
    barus = film.contact(contact.grid, roelands=False)
    assert isinstance(barus.piezoviscosity, BarusViscosity)
    assert (barus.V, barus.Q0) == (contact.V, contact.Q0)


def test_law_of_a_race_has_the_stiffness_of_the_race():
    film = race_film(0.3, 9.0)
    law = film.law(grid=GRID)
    assert law.stiffness == pytest.approx(film.stiffness, rel=0.06)
    assert law.damping == pytest.approx(film.slow_damping, rel=0.1)
    assert law.damping_error < 2e-3
    assert law.order == 5


def test_formula_says_where_it_ends():
    with pytest.warns(ValidityWarning, match=r"the damping formula is for V from 0\.005 to 5, got 7"):
        _ = race_film(7.0, 10.0).slow_damping
    with pytest.warns(ValidityWarning, match=r"for Q0 from 6 to 40, got 50"):
        _ = race_film(0.1, 50.0).slow_damping


# Slow motions of a bearing


@pytest.mark.closed_form
def test_damping_of_static_balls_is_the_sum_over_contacts_in_series():
    rest = DEEP.rest((30.0, -500.0, 0.0, 0.0, 0.0), FAST)
    found = film_damping(DEEP, rest, **OIL)
    films = race_films(DEEP, load=rest.balls.inner_load.max(), speed=FAST, **OIL)
    soft = np.array([contact.stiffness ** (-2.0 / 3.0) for contact in DEEP.contacts])
    each = sum(film.slow_damping * share**2 for film, share in zip(films, soft / soft.sum(), strict=True))
    total = np.zeros((2, 2))
    for angle, load in zip(rest.balls.ball_angle, rest.balls.inner_load, strict=True):
        n = np.array([math.cos(angle), math.sin(angle)])
        total += each * (load > 0.0) * np.outer(n, n)
    assert found.planar == pytest.approx(total, rel=1e-9)
    assert found.ball_damping[rest.balls.inner_load > 0.0] == pytest.approx(each, rel=1e-9)
    assert 0 < rest.balls.carrying < 8
    assert found.damping_time[1] == pytest.approx(0.8e-6, rel=0.25)


@pytest.mark.closed_form
@pytest.mark.parametrize("law", [StaticBalls(), RunningBalls()])
def test_damping_is_the_imaginary_stiffness_of_viscous_contacts(law):
    """By a complex step through contacts in series, k_i (k_i + k_o)^-1 k_o, ball by ball."""
    bearing = replace(ANGULAR, law=law, axial_load=500.0)
    rest = bearing.rest((100.0, -200.0, 500.0, 0.2, 0.1), FAST)
    found = film_damping(bearing, rest, **OIL)
    tiny = 1e-12
    total = np.zeros((5, 5))
    arm = 0.5 * 33.5e-3 + 0.02 * 7.938e-3 * math.cos(math.radians(25.0))
    for k, psi in enumerate(rest.balls.ball_angle):
        blocks = []
        for side, name in enumerate(("inner", "outer")):
            load, angle = (getattr(rest.balls, f"{name}_{what}")[k] for what in ("load", "angle"))
            depth = bearing.contacts[side].approach(load)
            n, t = np.array([math.sin(angle), math.cos(angle)]), np.array([math.cos(angle), -math.sin(angle)])
            along = 1.5 * load / depth + 1j * tiny * found.films[side].slow_damping
            reach = bearing.reaches[side] + depth
            blocks.append(along * np.outer(n, n) + load / reach * np.outer(t, t))
        ball = blocks[0] @ np.linalg.solve(blocks[0] + blocks[1], blocks[1])
        c, s = math.cos(psi), math.sin(psi)
        move = np.array([[0.0, 0.0, 1.0, arm * s, -arm * c], [c, s, 0.0, 0.0, 0.0]])
        total += move.T @ (ball.imag / tiny) @ move
    assert found.damping == pytest.approx(total, rel=1e-6, abs=1e-9 * np.abs(total).max())
    assert np.linalg.eigvalsh(found.damping).min() > 0.0
    # z gives way: what is left is less than with z held.
    assert np.linalg.eigvalsh(found.damping[:2, :2] - found.planar).min() > -1e-2 * found.planar.max()


def test_structural_damping_is_off_unless_given():
    rest = ANGULAR.rest((0.0, 0.0, 500.0, 0.0, 0.0), FAST)
    bare, more = (film_damping(ANGULAR, rest, **OIL, structural_time=time) for time in (0.0, 1e-5))
    assert more.damping - bare.damping == pytest.approx(1e-5 * rest.stiffness, rel=1e-9, abs=1e-9)
    assert more.damping_time == pytest.approx(bare.damping_time + 1e-5)
    assert bare.damping_time.max() < 1.5e-6


def test_a_pair_damps_like_its_rows():
    pair = back_to_back(ANGULAR, distance=0.02, preload=300.0)
    found = film_damping(pair, pair.rest((0.0, 0.0, 0.0, 0.0, 0.0), FAST), **OIL)
    one = ANGULAR.rest((0.0, 0.0, pair.running_preload(FAST), 0.0, 0.0), FAST)
    each = film_damping(ANGULAR, one, **OIL)
    assert found.damping[2, 2] == pytest.approx(2.0 * each.damping[2, 2], rel=1e-6)


# The dynamics of the films


@pytest.mark.long
@pytest.mark.closed_form
def test_bearing_in_harmonic_motion_has_its_contacts_in_series(pressed):
    """K + i omega C by 1/Z = 1/Z_i + 1/Z_o with the film's own stiffness at both races."""
    rest, model = pressed
    system = linearize(model, OperatingPoint(x=model.resting(rest.displacement), u=rest.displacement))
    films = race_films(ANGULAR, load=rest.balls.inner_load[0], speed=FAST, **OIL)
    at = []
    for film in films:
        c = film.contact(GRID, ellipticity=4.0)
        state = c.stationary()
        at.append(
            (film, SmallMotion(c.equations, state.levels[0].pressure, state.delta), c.equations.ellipse.slope)
        )
    angle = rest.balls.inner_angle[0]
    n = np.array([math.sin(angle), math.cos(angle)])
    still = 1.0 / sum(1.0 / film.stiffness for film in films)
    for omega in (1e3, 3e4, 2e5):
        soft = 0.0
        for film, small, slope in at:
            s = 1j * omega * film.time_scale
            change = (small.stiffness(s) - small.stiffness(1e-6j).real) / slope
            soft += 1.0 / (film.stiffness * (1.0 + change))
        Z = 1.0 / soft - still
        answer = -system(1j * omega) - rest.stiffness
        # Ten equal balls: half of the radial part along x, all of the axial one along z.
        assert answer[0, 0] == pytest.approx(5.0 * Z * n[1] ** 2, rel=0.02)
        assert answer[2, 2] == pytest.approx(10.0 * Z * n[0] ** 2, rel=0.02)
    slow = film_damping(ANGULAR, rest, **OIL)
    assert -system(1e2j).imag / 1e2 == pytest.approx(slow.damping, rel=0.12, abs=1e-3)


@pytest.mark.parametrize("law", [StaticBalls(), RunningBalls()])
def test_derivatives_are_exact_with_films_at_work_and_lost(law, pressed):
    bearing = replace(ANGULAR, law=law)
    rest = bearing.rest((100.0, -300.0, 500.0, 0.0, 0.0), FAST)
    model = replace(pressed[1], bearing=bearing, rest=rest, shares=np.linspace(0.5, 1.0, 10))
    assert isinstance(model, Dynamic)
    assert isinstance(model, Switched)
    rng = np.random.default_rng(3)
    u = rest.displacement + np.array([3e-7, 3e-7, 3e-7, 2e-5, 2e-5]) * rng.normal(size=5)
    weak = float(np.linalg.norm(model.C))
    for push in (0.02, 1.5):  # of the largest load: films that act, and some that would pull
        x = push * 250.0 / weak * rng.normal(size=len(model.states))
        exact = model.linearization(0.0, x, u)
        lost = (model.events(0.0, x, u)[10:] < 0.0).sum()
        assert (lost == 0) == (push < 1.0)
        for k, size in enumerate((1e-9, 1e-9, 1e-9, 1e-7, 1e-7)):
            step = size * np.eye(5)[k]
            by = [
                (model.output(0.0, x, u + m * step) - model.output(0.0, x, u - m * step)) / m for m in (1, 2)
            ]
            slope = (4.0 * by[0] - by[1]) / (6.0 * size)
            assert slope == pytest.approx(exact.D[:, k], rel=1e-6, abs=1e-7 * np.abs(exact.D[:, k]).max())
            rate = (model.derivative(0.0, x, u + step) - model.derivative(0.0, x, u - step)) / (2.0 * size)
            assert rate == pytest.approx(exact.B[:, k], rel=1e-5, abs=1e-6 * np.abs(exact.B[:, k]).max())
        move = 1e-3 * x * rng.normal(size=x.size)
        linear = model.output(0.0, x + move, u) - model.output(0.0, x - move, u)
        assert linear == pytest.approx(2.0 * exact.C @ move, rel=1e-6, abs=1e-7)


def test_films_at_rest_add_nothing_and_damp_a_mass(pressed):
    rest, model = pressed
    assert model.output(0.0, model.initial_state, rest.displacement) == pytest.approx(
        -rest.external_load, abs=1e-6
    )
    other = rest.displacement + np.array([2e-7, 0.0, 0.0, 0.0, 0.0])
    assert model.derivative(0.0, model.resting(other), other) == pytest.approx(0.0, abs=1e-6)
    static = ANGULAR.wrench(other, FAST)
    assert model.output(0.0, model.resting(other), other) == pytest.approx(static, rel=1e-9, abs=1e-9)
    # A mass on the bearing along x decays by c/(2 m) at its natural frequency.
    k, mass = rest.stiffness[0, 0], 1.0
    omega = math.sqrt(k / mass)
    c = (-linearize(model, OperatingPoint(x=model.initial_state, u=rest.displacement))(1j * omega)).imag[
        0, 0
    ] / omega

    def rate(t, v):
        u = rest.displacement + v[0] * np.eye(5)[0]
        push = model.output(0.0, v[2:], u)[0]
        return np.concatenate([[v[1], push / mass], model.derivative(0.0, v[2:], u)])

    turns = 4
    run = solve_ivp(
        rate,
        (0.0, turns * 2.0 * math.pi / omega),
        np.concatenate([[1e-7, 0.0], model.initial_state]),
        method="BDF",
        rtol=1e-7,
        atol=1e-13,
    )
    energy = [0.5 * mass * v[1] ** 2 + 0.5 * k * v[0] ** 2 for v in run.y.T]
    assert energy[-1] / energy[0] == pytest.approx(math.exp(-c / mass * run.t[-1]), rel=0.02)


def test_films_go_out_as_an_fmu(pressed, tmp_path):
    rest, model = pressed
    path = tmp_path / "films.fmu"
    export_fmu(model, path, "2.0", backend="python")
    told = fmpy.read_model_description(str(path)).modelVariables
    inputs, outputs = ([v.name for v in told if v.causality == kind] for kind in ("input", "output"))
    signal = np.array([(0.0, *rest.displacement)], dtype=[(name, float) for name in ("time", *inputs)])
    found = fmpy.simulate_fmu(str(path), stop_time=2e-5, output_interval=1e-5, input=signal, output=outputs)
    assert found[outputs[2]] == pytest.approx(-300.0, rel=1e-9)


def test_errors_name_argument_rule_and_value(pressed):
    rest = ANGULAR.rest((0.0, 0.0, 500.0, 0.0, 0.0), 0.0)
    with pytest.raises(
        InputError, match=r"rest must be at a speed other than 0 and have loaded balls, .* at 0\.0 rad/s"
    ):
        film_damping(ANGULAR, rest, **OIL)
    with pytest.raises(InputError, match="rest must be that of this bearing, got one with 10 balls"):
        film_damping(DEEP, ANGULAR.rest((0.0, 0.0, 500.0, 0.0, 0.0), FAST), **OIL)
    with pytest.raises(InputError, match="structural_time must be finite and not negative, got -1"):
        film_damping(ANGULAR, rest, **OIL, structural_time=-1.0)
    with pytest.raises(InputError, match=r"shares must be one of each ball, got shape \(3,\)"):
        replace(pressed[1], shares=np.ones(3))
    with pytest.raises(InputError, match="touch must be an EllipticContact, got 3"):
        replace(race_film(0.1, 10.0), touch=3)
