"""Ball bearings by their dimensions: closed facts, printed deflections, symmetries, the planar reaction."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.optimize import brentq

from rotorfilm import (
    BallBearing,
    ConvergenceError,
    EquilibriumError,
    InputError,
    Reaction,
    RigidRotor,
    RollingMaterial,
    StaticBalls,
    coefficients,
    equilibrium,
    face_to_face,
    simulate,
)
from rotorfilm.bearings import palmgren_stiffness

DEEP = BallBearing(
    balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, internal_clearance=10e-6, law=StaticBalls()
)
TIGHT = replace(DEEP, internal_clearance=0.0)
ANGULAR = BallBearing(
    balls=10, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, contact_angle=math.radians(25.0)
)
LOW = replace(ANGULAR, law=StaticBalls(), cage_angle=-math.pi / 2.0)
STEEL = RollingMaterial(young_modulus=210e9, poisson_ratio=0.3, density=7800.0)
PUBLISHED = BallBearing(
    balls=7,
    ball_diameter=11.5e-3,
    pitch_diameter=43.5e-3,
    internal_clearance=0.0,
    outer_conformity=0.53,
    ball_material=STEEL,
    ring_material=STEEL,
    law=StaticBalls(),
    cage_angle=-math.pi / 2.0,
)
DOWN = np.array([0.0, -1.0, 0.0, 0.0, 0.0])


@pytest.mark.literature
def test_deflections_printed_by_another_program():
    """MASTA, as the public repository minzhun/ISO16281 quotes it, under 1000 N."""
    assert PUBLISHED.rest(1000.0 * DOWN).displacement[1] * 1e6 == pytest.approx(-15.1101, abs=2e-4)
    loose = replace(PUBLISHED, internal_clearance=10e-6)
    assert loose.rest(1000.0 * DOWN).displacement[1] * 1e6 == pytest.approx(-21.223, abs=1.5e-3)
    axial = PUBLISHED.rest((0.0, 0.0, 1000.0, 0.0, 0.0)).displacement[2]
    assert axial * 1e6 == pytest.approx(133.5381, abs=2e-4)


@pytest.mark.closed_form
def test_loads_of_balls_are_those_of_an_independent_code():
    loads = [77.25, 54.1, 311.8, 267.0, 1150.6, 1018.0]
    found = []
    for load in (100.0, 500.0, 2000.0):
        for angle in (0.0, math.pi / 8.0):
            found.append(replace(DEEP, cage_angle=angle).rest(load * DOWN).balls.inner_load.max())
    assert found == pytest.approx(loads, rel=1.5e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize("balls", [7, 8, 12])
def test_without_clearance_the_stiffness_across_is_two_thirds_of_that_along(balls):
    """At a given displacement, averaged over its angles from the first ball: the force goes with r^1.5."""
    bearing = BallBearing(
        balls=balls, ball_diameter=5e-3, pitch_diameter=33.5e-3, internal_clearance=0.0, law=StaticBalls()
    )
    along = across = 0.0
    for angle in np.linspace(0.0, 2.0 * np.pi / balls, 600, endpoint=False):
        n = np.array([np.cos(angle), np.sin(angle)])
        K = bearing.stiffness((*(5e-6 * n), 0.0, 0.0, 0.0))[:2, :2]
        along += n @ K @ n
        across += K.trace() - n @ K @ n
    assert across / along == pytest.approx(2.0 / 3.0, rel=5e-5)


@pytest.mark.closed_form
def test_many_balls_share_a_load_as_stribeck_says():
    many = BallBearing(
        balls=200, ball_diameter=1e-3, pitch_diameter=80e-3, internal_clearance=0.0, law=StaticBalls()
    )
    assert many.rest(500.0 * DOWN).balls.inner_load.max() * 200 / 500.0 == pytest.approx(4.3701, abs=2e-4)


@pytest.mark.closed_form
def test_pure_thrust_is_the_root_of_one_equation():
    thrust, balls = 400.0, replace(ANGULAR, law=StaticBalls()).rest((0.0, 0.0, 400.0, 0.0, 0.0)).balls
    assert balls.inner_load * np.sin(balls.inner_angle) * 10 == pytest.approx(thrust, rel=1e-12)
    inner, outer = ANGULAR.contacts
    approach = inner.approach(balls.inner_load[0]) + outer.approach(balls.inner_load[0])
    # The radial distance of the centers stays: cos(alpha) = cos(alpha_0)/(1 + approach/A).
    A = ANGULAR.groove_distance
    wanted = math.acos(math.cos(ANGULAR.contact_angle) / (1.0 + approach / A))
    assert balls.inner_angle == pytest.approx(wanted, rel=1e-12)
    assert balls.inner_pressure == pytest.approx(inner.pressure(balls.inner_load[0]), rel=1e-14)


@pytest.mark.closed_form
def test_palmgren_is_within_ten_percent():
    K = [
        replace(TIGHT, cage_angle=angle).rest(500.0 * DOWN).stiffness[1, 1]
        for angle in np.linspace(0.0, np.pi / 4.0, 8, endpoint=False)
    ]
    estimate = palmgren_stiffness(load=500.0, balls=8, ball_diameter=7.938e-3)
    assert estimate / np.mean(K) == pytest.approx(1.0, abs=0.08)


@pytest.mark.closed_form
def test_growth_is_less_clearance():
    grown = replace(DEEP, growth=3e-6)
    tighter = replace(DEEP, internal_clearance=4e-6)
    # The Hertz constants of the latter are those of another free angle: it is 0 at z = 0 in both.
    at = (0.0, -6e-6, 0.0, 0.0, 0.0)
    assert grown.wrench(at)[1] == pytest.approx(tighter.wrench(at)[1], rel=2e-3)
    assert grown.rows[0, 3] + 3e-6 == pytest.approx(tighter.rows[0, 3], rel=1e-12)


angles = st.floats(-3.0, 3.0)
ways = st.floats(-1e-5, 1e-5)
tilts = st.floats(-5e-4, 5e-4)


@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
@pytest.mark.closed_form
@settings(max_examples=25, deadline=None)
@given(x=ways, y=ways, z=st.floats(5e-6, 3e-5), tx=tilts, ty=tilts, turn=angles)
def test_the_wrench_turns_with_bearing_and_shaft(x, y, z, tx, ty, turn):
    c, s = math.cos(turn), math.sin(turn)
    R = np.zeros((5, 5))
    R[:2, :2] = R[3:, 3:] = [[c, -s], [s, c]]
    R[2, 2] = 1.0
    u = np.array([x, y, z, tx, ty])
    wrench = ANGULAR.wrench(u, 800.0)
    turned = replace(ANGULAR, cage_angle=turn).wrench(R @ u, 800.0)
    scale = np.abs(wrench).max()
    assert turned == pytest.approx(R @ wrench, abs=1e-9 * scale + 1e-12)
    one_further = replace(ANGULAR, cage_angle=2.0 * math.pi / 10).wrench(u, 800.0)
    assert one_further == pytest.approx(wrench, abs=1e-9 * scale + 1e-12)
    mirror = np.array([-1.0, 1.0, 1.0, 1.0, -1.0])  # x -> -x; tilts are axial vectors; ball 0 on the x axis
    assert ANGULAR.wrench(mirror * u, -800.0) == pytest.approx(mirror * wrench, abs=1e-9 * scale + 1e-12)


@pytest.mark.closed_form
def test_static_work_around_a_loop_is_zero():
    bearing = replace(ANGULAR, law=StaticBalls())
    size = np.array([8e-6, 8e-6, 8e-6, 4e-4, 4e-4])
    t = np.linspace(0.0, 2.0 * np.pi, 128, endpoint=False)[:, None]
    phase = np.arange(5.0)
    u = np.array([0.0, 0.0, 6e-5, 0.0, 0.0]) + size * np.cos(t + phase)
    du = -size * np.sin(t + phase) * 2.0 * np.pi / 128
    work = np.array([bearing.wrench(one) @ way for one, way in zip(u, du, strict=True)])
    assert abs(work.sum()) < 1e-11 * np.abs(work).sum()


def test_is_a_reaction_whose_equilibrium_and_coefficients_are_those_of_five_degrees():
    assert isinstance(DEEP, Reaction)
    load = np.array([300.0, -400.0])
    at = equilibrium(DEEP, load, 200.0)
    five = DEEP.rest((*load, 0.0, 0.0, 0.0), 200.0)
    assert at.position == pytest.approx(five.displacement[:2], rel=1e-9)
    found = coefficients(DEEP, at.position, 200.0)
    assert found.stiffness == pytest.approx(five.stiffness[:2, :2], rel=1e-9)
    assert not found.damping.any()


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [0.0, 1500.0])
def test_a_shaft_under_thrust_gives_way_along_its_axis(speed):
    held = replace(ANGULAR, axial_load=400.0)
    position = np.array([3e-6, -5e-6])
    z = held.axial_place(position, speed)
    u = np.array([*position, z, 0.0, 0.0])
    assert ANGULAR.wrench(u, speed)[2] == pytest.approx(-400.0, rel=1e-11)
    assert held.force(position, [0.0, 0.0], speed) == pytest.approx(ANGULAR.wrench(u, speed)[:2], rel=1e-10)
    by = ANGULAR.kernel.at(u, speed).slopes
    condensed = by[:2] - np.outer(by[:2, 2], by[2]) / by[2, 2]
    slopes = held.jacobian(position, [0.0, 0.0], speed)
    assert slopes[:, :2] == pytest.approx(condensed[:, :2], rel=1e-9)
    assert slopes[:, 4] == pytest.approx(condensed[:, 5], rel=1e-9, abs=1e-12)
    step = 1e-9
    moved = [held.force(position + np.array([h, 0.0]), [0.0, 0.0], speed) for h in (step, -step)]
    assert (moved[0] - moved[1]) / (2.0 * step) == pytest.approx(slopes[:, 0], rel=1e-6)


@pytest.mark.filterwarnings("ignore:the load of a ball should be", "ignore:the gyroscopic moment")
def test_a_shaft_under_thrust_finds_its_place_across_the_whole_way():
    # Newton's method may end from one side, while the other bound of the search is still infinite.
    held = BallBearing(
        balls=9, ball_diameter=8e-3, pitch_diameter=33e-3, contact_angle=0.35, axial_load=100.0
    )
    radii = np.linspace(5e-7, 1.5e-4, 300)
    force = held.force([radii, 0.0 * radii], [0.0, 0.0], 157.0)
    assert np.all(np.diff(force[0]) < 0.0)
    for r in radii[::20]:
        u = [r, 0.0, held.axial_place([r, 0.0], 157.0), 0.0, 0.0]
        thrust = lambda z, r=r: held.wrench([r, 0.0, z, 0.0, 0.0], 157.0)[2] + 100.0  # noqa: E731
        root = brentq(thrust, -3e-4, 3e-4, xtol=1e-15)
        assert u[2] == pytest.approx(root, abs=1e-14)


def test_batches_and_damping():
    bearing = replace(DEEP, damping=250.0)
    q, v = np.array([[0.0, 3e-6, 9e-6], [-8e-6, -9e-6, 1e-6]]), np.array([[0.1, 0.0, 0.2], [0.0, 0.1, 0.0]])
    force = bearing.force(q, v, 100.0)
    assert force.shape == (2, 3)
    assert force == pytest.approx(DEEP.force(q, np.zeros((2, 3)), 100.0) - 250.0 * v, rel=1e-12)
    assert bearing.jacobian(q, v, 100.0)[:, 2:4, 1] == pytest.approx(-250.0 * np.eye(2))


def test_a_free_shaft_feels_nothing():
    assert not DEEP.wrench(np.zeros(5)).any()
    assert not DEEP.force([2e-6, -1e-6], [0.0, 0.0], 10.0).any()
    with pytest.raises(
        ConvergenceError, match=r"axial_load must be one that the balls can carry, got 5\.0 N"
    ):
        replace(DEEP, balls=3, pitch_diameter=400e-3, axial_load=5.0, growth=-1e-3).force(
            [0.0, 0.0], [0.0, 0.0]
        )


def test_a_load_that_is_roundoff_of_the_balls_is_refused():
    turning = BallBearing(balls=9, ball_diameter=8e-3, pitch_diameter=33e-3, contact_angle=0.35)
    assert turning.rest([0.0, -0.1, 1.0, 0.0, 0.0], 500.0).residual < 1e-12
    with pytest.raises(EquilibriumError, match="load must exceed the round-off of the ball forces"):
        turning.rest([0.0, -1e-10, 1e-9, 0.0, 0.0], 500.0)


@pytest.mark.closed_form
def test_a_rigid_rotor_swings_at_the_frequency_of_the_stiffness():
    preloaded = replace(DEEP, internal_clearance=-8e-6)
    K = -preloaded.jacobian([0.0, 0.0], [0.0, 0.0], 0.0)
    assert K[:, :2] == pytest.approx(K[0, 0] * np.eye(2), rel=1e-12, abs=1e-6)
    mass = 3.0
    rotor = RigidRotor(mass=mass, speed=100.0, gravity=(0.0, 0.0), position=(1e-9, 0.0))
    period = 2.0 * np.pi / math.sqrt(K[0, 0] / mass)
    moved = simulate(rotor, preloaded, duration=period, samples=3, rtol=1e-8)
    assert moved["x"] == pytest.approx([1e-9, -1e-9, 1e-9], rel=1e-4)


@pytest.mark.closed_form
@pytest.mark.parametrize(
    "bearing",
    [
        replace(TIGHT, cage_angle=-math.pi / 2.0),
        replace(LOW, axial_displacement=1e-5, growth=2e-6),
        replace(face_to_face(LOW, distance=0.02, preload=50.0), axial_load=90.0),
    ],
    ids=["deep groove", "angular contact", "loaded pair"],
)
def test_the_clearance_is_where_a_ball_is_pressed_to_4200_mpa(bearing):
    balls = bearing.loads((0.0, -bearing.clearance * (1.0 - 1e-9), bearing.axial_place(), 0.0, 0.0))
    assert max(balls.inner_pressure.max(), balls.outer_pressure.max()) == pytest.approx(4.2e9, rel=1e-6)


@pytest.mark.closed_form
def test_stiffness_across_a_load_depends_on_where_the_balls_are():
    """Of an independent code, 8 balls and 100 N: a ball under the load, and two beside it."""
    for angle, ratio in ((0.0, 0.457), (math.pi / 8.0, 0.734)):
        K = replace(TIGHT, cage_angle=angle).rest(100.0 * DOWN).stiffness
        assert K[0, 0] / K[1, 1] == pytest.approx(ratio, abs=1e-3)


def test_errors_name_argument_rule_and_value():
    with pytest.raises(InputError, match="internal_clearance or contact_angle must be given, and not both"):
        BallBearing(balls=8, ball_diameter=8e-3, pitch_diameter=33.5e-3)
    with pytest.raises(InputError, match="balls must fit on the pitch circle"):
        replace(DEEP, balls=20)
    with pytest.raises(InputError, match=r"on the pitch circle, which has 0\.02901 m for each"):
        replace(DEEP, balls=3, ball_diameter=32e-3)
    with pytest.raises(InputError, match="axial_load must be a single finite number, got nan"):
        replace(DEEP, axial_load=math.nan)
    with pytest.raises(
        InputError, match=r"law must be RunningBalls\(\), RaceControl\(\) or StaticBalls\(\), got"
    ):
        replace(DEEP, law=7)
    with pytest.raises(InputError, match=r"position must have shape \(2,\), got shape \(2, 3\)"):
        DEEP.axial_place(np.zeros((2, 3)))
    with pytest.raises(InputError, match=r"inner_conformity must be above 0\.5 and below 0\.75, got 0\.5"):
        replace(DEEP, inner_conformity=0.5)
    with pytest.raises(InputError, match=r"contact_angle must be 0 to 75 deg, got 1\.5 rad"):
        replace(ANGULAR, contact_angle=1.5)
    with pytest.raises(InputError, match=r"axial_load must press the balls .* got -5\.0"):
        replace(ANGULAR, axial_load=-5.0)
    with pytest.raises(InputError, match=r"displacement must have shape \(5,\)"):
        DEEP.wrench((0.0, 0.0))
    with pytest.raises(InputError, match="displacement must be finite"):
        DEEP.wrench((0.0, np.nan, 0.0, 0.0, 0.0))
    with pytest.raises(EquilibriumError, match="load must"):
        ANGULAR.rest((0.0, 0.0, -300.0, 0.0, 0.0))
    with pytest.raises(EquilibriumError, match="load must be within the film's capacity"):
        equilibrium(DEEP, [0.0, -1e6], 0.0)


@pytest.mark.closed_form
def test_quantities_with_units():
    same = BallBearing(
        balls=8,
        ball_diameter="7.938 mm",
        pitch_diameter="33.5 mm",
        internal_clearance="10 um",
        law=StaticBalls(),
    )
    assert same.wrench((0.0, -9e-6, 0.0, 0.0, 0.0)) == pytest.approx(DEEP.wrench((0.0, -9e-6, 0.0, 0.0, 0.0)))


def test_the_speed_of_a_rest_takes_its_unit():
    as_number = PUBLISHED.rest((0.0, 0.0, 500.0, 0.0, 0.0), 1500.0 * math.pi / 30.0).displacement
    np.testing.assert_allclose(
        PUBLISHED.rest((0.0, 0.0, 500.0, 0.0, 0.0), "1500 rpm").displacement, as_number
    )
