"""Balls whose gyroscopic moment friction holds: figures of an independent code, smoothness, limits."""

from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import BallBearing, EquilibriumError, InputError, RollingMaterial, RunningBalls
from rotorfilm.bearings import RaceControl

RPM = np.pi / 30.0
STEEL = RollingMaterial(young_modulus=206e9, poisson_ratio=0.3, density=7800.0)
LADDER = BallBearing(
    balls=10,
    ball_diameter=7.938e-3,
    pitch_diameter=33.5e-3,
    contact_angle=np.radians(25.0),
    outer_conformity=0.53,
    ball_material=STEEL,
    ring_material=STEEL,
)
JUMP = BallBearing(
    balls=19,
    ball_diameter=29.744794703094636e-3,
    pitch_diameter=201.4219539338348e-3,
    contact_angle=0.20943951023931956,
    inner_conformity=0.5311871256479149,
    outer_conformity=0.5355916938149211,
)
JUMP_PLACE = np.array(
    [
        -2.364549337163339e-06,
        -7.196453255316442e-06,
        -0.0001284878233983793,
        0.0002206125177218271,
        -7.248697448649148e-05,
    ]
)
JUMP_SPEED = 167.61725132196037
AXIAL = np.eye(5)[2]


def kinematics(bearing, balls, speed):
    """Return orbit, radial spin and spin about the way, over the speed, of the first ball."""
    J = 0.1 * bearing.ball_mass * bearing.ball_diameter**2
    orbit = balls.orbit_speed[0]
    spin = -balls.gyroscopic_moment[0] / (J * orbit)
    return np.array([orbit, spin, 2.0 * balls.slip_speed[0] / bearing.ball_diameter]) / speed


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("rpm", "forces", "angles", "motion"),
    [
        (1e4, (54.85827, 60.04081, 5.813844), (27.60567, 24.98967), (0.3936248, 0.9683628, -0.003217354)),
        (3e4, (106.7776, 155.0444, 55.20199), (34.14580, 20.63342), (0.4043029, 0.7107665, -0.01595576)),
    ],
)
def test_a_ball_is_that_of_an_independent_code(rpm, forces, angles, motion):
    balls = LADDER.loads((0.0, 0.0, 8e-6, 0.0, 0.0), rpm * RPM)
    found = balls.inner_load[0], balls.outer_load[0], balls.centrifugal_force[0]
    assert found == pytest.approx(forces, rel=1e-6)
    assert np.degrees([balls.inner_angle[0], balls.outer_angle[0]]) == pytest.approx(angles, rel=1e-6)
    assert kinematics(LADDER, balls, rpm * RPM) == pytest.approx(motion, rel=1e-6)


@pytest.mark.closed_form
def test_a_bearing_is_that_of_an_independent_code():
    found = replace(LADDER, cage_angle=-np.pi / 2.0).rest((0.0, -200.0, 400.0, 0.0, 0.0), 2e4 * RPM)
    assert found.displacement[1:4] == pytest.approx([-26.70150e-6, 3.05762e-6, 3.017874e-3], rel=1e-6)
    K = found.stiffness
    assert [K[1, 1], K[1, 2], K[2, 1]] == pytest.approx([8.613601e7, -1.117191e7, -1.131144e7], rel=1e-6)


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("thrust", "rpm", "law", "stiffness"),
    [
        (500.0, 1e4, RaceControl(), 6.116e7),
        (500.0, 1e4, RaceControl(outer_control=False), 6.183e7),
        (500.0, 1e4, RunningBalls(), 6.190e7),
        (500.0, 3e4, RunningBalls(slide_to_roll_ratio=0.001), 2.119e7),
        (500.0, 3e4, RunningBalls(slide_to_roll_ratio=0.02), 2.466e7),
        (500.0, 3e4, RunningBalls(traction_coefficient=0.03), 2.511e7),
        (500.0, 3e4, RunningBalls(traction_coefficient=0.1), 2.085e7),
        (100.0, 3e4, RunningBalls(), 0.496e7),
    ],
)
@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
def test_axial_stiffness_is_that_of_an_independent_code(thrust, rpm, law, stiffness):
    found = replace(LADDER, law=law).rest((0.0, 0.0, thrust, 0.0, 0.0), rpm * RPM)
    assert found.stiffness[2, 2] == pytest.approx(stiffness, rel=1e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize("bearing", [LADDER, JUMP], ids=["ladder", "light"])
def test_moments_and_forces_of_each_ball_are_in_balance(bearing):
    """With friction written out anew from the angles, loads and spins that are told."""
    u, w = ((0.0, 5e-6, 8e-6, 1e-4, 0.0), 3000.0) if bearing is LADDER else (JUMP_PLACE, JUMP_SPEED)
    balls, law = bearing.loads(u, w), bearing.law
    g, D = bearing.ball_diameter / bearing.pitch_diameter, bearing.ball_diameter
    pressed = balls.inner_load > 0.0
    assert pressed.sum() > 5
    Q = np.stack([balls.inner_load, balls.outer_load])[:, pressed]
    (si, so), (ci, co) = (
        f([balls.inner_angle[pressed], balls.outer_angle[pressed]]) for f in (np.sin, np.cos)
    )
    orbit, slip = balls.orbit_speed[pressed] / w, balls.slip_speed[pressed] / w
    J = 0.1 * bearing.ball_mass * D**2
    spin = -balls.gyroscopic_moment[pressed] / (J * orbit * w**2)
    theta = balls.inner_angle[pressed] - balls.outer_angle[pressed]
    assert orbit == pytest.approx((co * (1.0 - g * ci) - g * spin * np.sin(theta)) / (ci + co), rel=1e-10)
    H = (1.0 + np.cos(theta)) / (ci + co)
    held = np.stack([si * (1.0 / g + co), so * (1.0 / g - ci)]) / (1.0 + np.cos(theta))
    axes = [contact.half_axes(1.0)[0] * contact.integrals.second for contact in bearing.contacts]
    rho = 0.375 * np.array(axes)[:, None] * np.cbrt(Q)
    still = 0.25 * law.slide_to_roll_ratio * bearing.pitch_diameter
    S = np.sqrt(still**2 + slip**2 + (rho * H * (spin - held)) ** 2)
    T = law.traction_coefficient * Q * slip / S
    size = Q.max(axis=0)
    twist = (law.traction_coefficient * Q * rho**2 * H**2 * (spin - held) / S).sum(axis=0)
    assert np.abs(twist - J * w**2 * orbit * 2.0 * slip / D).max() < 1e-9 * (size * D).max()
    assert np.abs(0.5 * D * T.sum(axis=0) + J * w**2 * orbit * spin).max() < 1e-9 * (size * D).max()
    axial = Q[0] * si - Q[1] * so - T[0] * ci + T[1] * co
    radial = Q[0] * ci - Q[1] * co + T[0] * si - T[1] * so + balls.centrifugal_force[pressed]
    assert np.abs([axial / size, radial / size]).max() < 1e-8
    assert balls.traction[pressed] == pytest.approx(np.abs(T / Q).max(axis=0), rel=1e-9)


@pytest.mark.closed_form
def test_a_light_fast_bearing_does_not_jump():
    """Race control dropped the moment of a ball at this place: 28 % of the force within 0.2 nm."""
    ways = np.linspace(-2e-10, 2e-10, 101)
    force = np.array([JUMP.wrench(JUMP_PLACE + d * AXIAL, JUMP_SPEED)[:3] for d in ways])
    assert np.linalg.norm(force[50]) == pytest.approx(0.747, abs=0.001)
    assert np.abs(np.diff(force, 2, axis=0)).max() < 1e-10
    balls = JUMP.loads(JUMP_PLACE, JUMP_SPEED)
    assert np.all(balls.traction[balls.inner_load > 0.0] > 0.0)
    controlled = replace(JUMP, law=RaceControl())
    jump = controlled.wrench(JUMP_PLACE, JUMP_SPEED) - controlled.wrench(
        JUMP_PLACE - 1.92e-10 * AXIAL, JUMP_SPEED
    )
    assert np.abs(jump[:3]).max() > 0.05


def drawn(rng):
    """Return a bearing, a displacement and a speed: loads of 0.001 to 300 times the centrifugal force."""
    D, Z = 10.0 ** rng.uniform(-2.7, -1.3), int(rng.integers(5, 25))
    pitch = D / np.sin(np.pi / Z) * rng.uniform(1.05, 1.5)
    bearing = BallBearing(
        balls=Z,
        ball_diameter=D,
        pitch_diameter=pitch,
        contact_angle=rng.uniform(0.0, 0.8),
        inner_conformity=rng.uniform(0.505, 0.56),
        outer_conformity=rng.uniform(0.505, 0.56),
        law=RunningBalls(
            traction_coefficient=rng.uniform(0.03, 0.1), slide_to_roll_ratio=10.0 ** rng.uniform(-3.0, -1.7)
        ),
    )
    speed = 10.0 ** rng.uniform(1.0, 3.3) * RPM / pitch
    centrifugal = 0.5 * bearing.ball_mass * pitch * (0.4 * speed) ** 2
    load = centrifugal * 10.0 ** rng.uniform(-3.0, 2.5)
    approach = sum(contact.approach(load) for contact in bearing.contacts)
    thrown = bearing.contacts[1].approach(centrifugal) * rng.uniform(0.0, 1.0)
    angle, A = bearing.contact_angle + rng.uniform(-0.3, 0.3), bearing.groove_distance
    way = (A + approach + thrown) * np.array([np.cos(angle), np.sin(angle)])
    way -= A * np.array([np.cos(bearing.contact_angle), np.sin(bearing.contact_angle)])
    tilts = rng.uniform(-1.0, 1.0, 2) * approach / pitch
    return bearing, np.array([way[0], 0.0, way[1], *tilts]), speed


def test_thousands_of_random_balls_neither_fail_nor_jump():
    rng, balls, traction = np.random.default_rng(3), 0, 0.0
    for _ in range(250):
        bearing, u, speed = drawn(rng)
        step = 1e-9 * bearing.groove_distance * np.array([0.3, 0.5, 1.0, 1.0, 0.4])
        step[3:] /= bearing.pitch_diameter
        found = [bearing.kernel.at(u + k * step, speed) for k in range(-2, 3)]
        assert max(at.status for at in found) <= 1
        force = np.array([at.wrench for at in found])
        assert np.abs(np.diff(force, 2, axis=0)).max() <= 1e-7 * np.abs(force).max() + bearing.force_noise(
            speed
        )
        balls += bearing.balls
        traction = max(traction, found[0].each["traction"].max() / bearing.law.traction_coefficient)
    assert balls > 3000
    assert 0.9 < traction < 1.0


@pytest.mark.closed_form
@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
def test_stiffness_is_the_derivative_where_friction_is_near_its_limit():
    """Central differences of two widths, extrapolated, where a ball nearly slides."""
    bearing = replace(LADDER, law=RunningBalls(traction_coefficient=0.03, slide_to_roll_ratio=0.001))
    u, speed = bearing.rest((20.0, 0.0, 900.0, 0.0, 0.0), 3e4 * RPM).displacement, 3e4 * RPM
    assert bearing.loads(u, speed).traction.max() > 0.9 * 0.03
    K = bearing.stiffness(u, speed)
    for j, size in enumerate([2e-9, 2e-9, 2e-9, 2e-7, 2e-7]):
        along = size * np.eye(5)[j]
        near, far = (
            (bearing.wrench(u - n * along, speed) - bearing.wrench(u + n * along, speed)) / (2.0 * n * size)
            for n in (1.0, 2.0)
        )
        assert np.abs((4.0 * near - far) / 3.0 - K[:, j]).max() < 1e-6 * np.abs(K[:, j]).max()
    by_speed = [bearing.wrench(u, speed + d) for d in (-1.0, 1.0)]
    expected = (by_speed[1] - by_speed[0]) / 2.0
    slopes = bearing.kernel.at(u, speed).slopes[:, 5]
    assert slopes == pytest.approx(expected, rel=1e-5, abs=1e-6 * np.abs(expected).max())


@pytest.mark.closed_form
def test_without_slide_a_race_controls():
    """A small slide-to-roll ratio under small moments: the contact that resists spin more does not spin."""
    u, speed = (0.0, 0.0, 8e-6, 0.0, 0.0), 500.0 * RPM
    outer_holds = replace(LADDER, inner_conformity=0.54, outer_conformity=0.51)
    inner_holds = replace(LADDER, inner_conformity=0.51, outer_conformity=0.54)
    for bearing, outer in ((outer_holds, True), (inner_holds, False)):
        wanted = replace(bearing, law=RaceControl(outer_control=outer)).loads(u, speed)
        other = replace(bearing, law=RaceControl(outer_control=not outer)).loads(u, speed)
        off = []
        for ratio in (1e-2, 1e-3, 1e-4):
            found = replace(bearing, law=RunningBalls(slide_to_roll_ratio=ratio)).loads(u, speed)
            off.append(abs(found.gyroscopic_moment[0] - wanted.gyroscopic_moment[0]))
        apart = abs(other.gyroscopic_moment[0] - wanted.gyroscopic_moment[0])
        assert off[0] > off[1] > off[2]
        assert off[2] < 0.01 * apart


@pytest.mark.closed_form
@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
def test_where_friction_does_not_hold_the_ball_slides_and_its_moment_falls():
    moments = []
    for mu in (0.1, 0.03, 0.01, 0.003, 0.001):
        law = RunningBalls(traction_coefficient=mu)
        balls = replace(LADDER, law=law).loads((0.0, 0.0, 8e-6, 0.0, 0.0), 3e4 * RPM)
        moments.append(-balls.gyroscopic_moment[0])
        most = 0.5 * LADDER.ball_diameter * mu * (balls.inner_load[0] + balls.outer_load[0])
        assert 0.0 < moments[-1] < most
    assert np.all(np.diff(moments) < 0.0)
    assert moments[-1] < 0.05 * moments[0]


def test_sliding_and_numbers_beyond_their_limits_are_told():
    slippery = replace(LADDER, law=RunningBalls(traction_coefficient=0.03, slide_to_roll_ratio=0.001))
    with pytest.warns(match=r"traction coefficient of 0\.0299; balls slide beyond about 0\.027"):
        slippery.rest((0.0, 0.0, 900.0, 0.0, 0.0), 3e4 * RPM)
    for name, value in (
        ("traction_coefficient", 0.0),
        ("traction_coefficient", 0.6),
        ("slide_to_roll_ratio", -0.1),
        ("slide_to_roll_ratio", np.nan),
    ):
        with pytest.raises(InputError, match=name):
            RunningBalls(**{name: value})
    with pytest.raises(InputError, match="outer_control must be True or False"):
        RaceControl(outer_control="inner")


def test_race_control_without_a_rest_is_blamed_itself():
    """The load is one that balls with friction carry."""
    bearing = BallBearing(
        balls=20,
        ball_diameter=0.037946093089211895,
        pitch_diameter=0.2618217060852971,
        contact_angle=0.6679905631667205,
        inner_conformity=0.5259998128981431,
        outer_conformity=0.5229050088855388,
    )
    load = (
        111.88310593736301,
        0.014696611970810736,
        72.619259024845,
        0.0014824177935554017,
        -8.693496722556475,
    )
    speed = 52.33036798359213
    assert bearing.rest(load, speed).residual < 1e-9
    controlled = replace(bearing, law=RaceControl(outer_control=False))
    with pytest.raises(EquilibriumError, match=r"law must be RunningBalls\(\) for load .* got RaceControl"):
        controlled.rest(load, speed)
