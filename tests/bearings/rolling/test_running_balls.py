"""Balls with inertia against one solution of all unknowns by SciPy, written out from the physics."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import root

from rotorfilm import (
    BallBearing,
    ConvergenceError,
    RollingMaterial,
    RunningBalls,
    StaticBalls,
)
from rotorfilm.bearings import RaceControl

RPM = np.pi / 30.0
ANGULAR = BallBearing(
    balls=10,
    ball_diameter=7.938e-3,
    pitch_diameter=33.5e-3,
    contact_angle=np.radians(25.0),
    outer_conformity=0.53,
    cage_angle=0.2,
)
CONTROLLED = replace(ANGULAR, law=RaceControl())
DEEP = BallBearing(
    balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, internal_clearance=10e-6, cage_angle=0.3
)
LOADS = [(60.0, -90.0, 500.0, 0.3, -0.4), (0.0, -30.0, 300.0, 0.0, 0.5)]


def orbit_and_spin(bearing, ai, ao, speed, *, outer):
    """Return orbit and radial spin from no slip at both races and no spin at one, as linear equations."""
    g, (si, ci), (so, co) = bearing.ball_diameter / bearing.pitch_diameter, _sine(ai), _sine(ao)
    # Unknown: orbit, spin about the shaft and about the radius, in the frame of the cage.
    rows = [
        [1.0 - g * ci, -g * ci, g * si],
        [1.0 + g * co, g * co, -g * so],
        [so, so, co] if outer else [si, si, ci],
    ]
    right = [speed * (1.0 - g * ci), 0.0, 0.0 if outer else speed * si]
    orbit, _, spin = np.linalg.solve(rows, right)
    return orbit, spin


def _sine(angle):
    return np.sin(angle), np.cos(angle)


def equations(unknown, bearing, load, speed, outer):
    """Return residuals of the shaft and of all balls: forces, and friction that turns the spin."""
    inner, outer_contact = bearing.contacts
    u, centers = unknown[:5], unknown[5:].reshape(-1, 2)
    D, dm = bearing.ball_diameter, bearing.pitch_diameter
    ri, ro = (bearing.inner_conformity - 0.5) * D, (bearing.outer_conformity - 0.5) * D
    a0, A = bearing.free_contact_angle, ri + ro
    axial, radial = A * np.sin(a0), A * np.cos(a0)
    if bearing.contact_angle is None:
        axial, radial = 0.0, A - 0.5 * bearing.internal_clearance
    arm = 0.5 * dm + ri * np.cos(a0)
    mass = bearing.ball_mass
    total, rest = np.array(load, dtype=float), []
    for psi, (x1, x2) in zip(
        bearing.cage_angle + 2.0 * np.pi * np.arange(bearing.balls) / bearing.balls, centers, strict=True
    ):
        c, s = np.cos(psi), np.sin(psi)
        a1 = axial + u[2] + arm * (u[3] * s - u[4] * c) - x1
        a2 = radial + u[0] * c + u[1] * s + bearing.growth - x2
        ai, ao = np.arctan2(a1, a2), np.arctan2(x1, x2)
        qi = inner.stiffness * max(np.hypot(a1, a2) - ri, 0.0) ** 1.5
        qo = outer_contact.stiffness * max(np.hypot(x1, x2) - ro, 0.0) ** 1.5
        orbit, spin = orbit_and_spin(bearing, ai, ao, speed, outer=outer)
        turning = 0.1 * mass * D**2 * orbit * spin  # dL/dt about the tangent: (D/2)(fi - fo)
        fi, fo = (0.0, -2.0 * turning / D) if outer else (turning / D, -turning / D)
        on_ball = qi * np.array(_sine(ai)) + fi * np.array([np.cos(ai), -np.sin(ai)])
        from_outer = -qo * np.array(_sine(ao)) + fo * np.array([np.cos(ao), -np.sin(ao)])
        rest.append(on_ball + from_outer + [0.0, 0.5 * mass * dm * orbit**2])
        total -= [on_ball[1] * c, on_ball[1] * s, on_ball[0], arm * s * on_ball[0], -arm * c * on_ball[0]]
    return np.concatenate([total, np.ravel(rest)])


def unknowns(bearing, found):
    """Return the unknowns of `equations`: displacement, and centers of balls from their loads."""
    lo = (bearing.outer_conformity - 0.5) * bearing.ball_diameter
    lo = lo + (found.balls.outer_load / bearing.contacts[1].stiffness) ** (2.0 / 3.0)
    centers = lo[:, None] * np.stack(_sine(found.balls.outer_angle), axis=1)
    return np.concatenate([found.displacement, centers.ravel()])


@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
@pytest.mark.closed_form
@pytest.mark.parametrize("outer", [True, False])
@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("rpm", [10_000.0, 30_000.0])
def test_equilibrium_is_that_of_all_equations_at_once(load, rpm, outer):
    bearing, speed = replace(ANGULAR, law=RaceControl(outer_control=outer)), rpm * RPM
    found = bearing.rest(load, speed)
    # From a disturbed state, so that the solution is SciPy's own.
    start = unknowns(bearing, found) * 1.003
    scale = np.concatenate([[1e-5] * 3, [1e-3] * 2, [1e-5] * (start.size - 5)])
    wanted = root(
        lambda v: equations(v * scale, bearing, load, speed, outer), start / scale, tol=1e-14, method="hybr"
    )
    u = wanted.x * scale
    assert np.abs(equations(u, bearing, load, speed, outer)).max() < 1e-9
    assert found.displacement == pytest.approx(u[:5], rel=1e-9, abs=1e-15)


@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
@pytest.mark.closed_form
@pytest.mark.parametrize("outer", [True, False])
@pytest.mark.parametrize("degrees", [60.0, 74.0])
def test_steep_contacts_carry_as_the_equations_say(degrees, outer):
    """The center of curvature of the inner groove is then below that of the ball."""
    law = RaceControl(outer_control=outer)
    bearing, load = replace(ANGULAR, contact_angle=np.radians(degrees), law=law), (30.0, 0.0, 900.0, 0.0, 1.0)
    for speed in (1.0, 400.0):
        found = bearing.rest(load, speed)
        assert np.abs(equations(unknowns(bearing, found), bearing, load, speed, outer)).max() < 1e-6
    assert found.balls.carrying == bearing.balls


@pytest.mark.closed_form
def test_next_to_no_speed_is_none():
    """Of either sign, with balls that are open, on their way to the shoulder, or pressed."""
    still = replace(ANGULAR, law=StaticBalls())
    for u in ((0.0, 0.0, -2e-5, 0.0, 0.0), (1e-6, 0.0, 0.0, 0.0, 0.0), (5e-6, -1e-5, 1e-5, 2e-4, 1e-4)):
        for speed in (1e-200, -1e-12, 1e-9, 1e-6):
            assert ANGULAR.wrench(u, speed) == pytest.approx(still.wrench(u), rel=1e-9, abs=1e-12)


def test_a_ball_that_is_lost_and_absurd_speeds_are_told():
    with pytest.warns(match="the load of a ball should be at most"):
        lost = DEEP.loads((1e-3, 0.0, 0.0, 0.0, 0.0), 100.0)
    assert np.isfinite(lost.centrifugal_force).all()
    assert lost.outer_load[lost.inner_load == 0.0] == pytest.approx(lost.centrifugal_force.max())
    with pytest.raises(ConvergenceError, match="every ball must find a balance"):
        DEEP.wrench((1e-6, 0.0, 0.0, 0.0, 0.0), 1e6)


@pytest.mark.closed_form
@pytest.mark.parametrize("outer", [True, False])
def test_orbit_and_gyroscopic_moment_follow_from_rolling(outer):
    bearing, speed = replace(ANGULAR, law=RaceControl(outer_control=outer)), 2000.0
    balls = bearing.rest(LOADS[0], speed).balls
    for k in range(bearing.balls):
        orbit, spin = orbit_and_spin(bearing, balls.inner_angle[k], balls.outer_angle[k], speed, outer=outer)
        J = 0.1 * bearing.ball_mass * bearing.ball_diameter**2
        assert balls.orbit_speed[k] == pytest.approx(orbit, rel=1e-12)
        assert balls.gyroscopic_moment[k] == pytest.approx(-J * orbit * spin, rel=1e-10)
        fc = 0.5 * bearing.ball_mass * bearing.pitch_diameter * orbit**2
        assert balls.centrifugal_force[k] == pytest.approx(fc, rel=1e-12)
    assert (balls.gyroscopic_moment < 0.0).all()


def difference(function, x, h):
    """Return the derivative by central differences of sixth order."""
    return (
        45.0 * (function(x + h) - function(x - h))
        - 9.0 * (function(x + 2 * h) - function(x - 2 * h))
        + function(x + 3 * h)
        - function(x - 3 * h)
    ) / (60.0 * h)


@pytest.mark.closed_form
@pytest.mark.parametrize(
    "law", [StaticBalls(), RunningBalls(), RaceControl(), RaceControl(outer_control=False)]
)
@pytest.mark.parametrize("bearing", [ANGULAR, replace(ANGULAR, axial_displacement=1e-5, growth=2e-6)])
def test_stiffness_is_the_derivative_of_the_wrench(bearing, law):
    bearing, speed = replace(bearing, law=law), 1500.0
    u = bearing.rest(LOADS[0], speed).displacement
    K, at = bearing.stiffness(u, speed), bearing.kernel.at(u, speed)
    steps = [3e-8] * 3 + [2e-6] * 2
    sizes = np.array([1.0] * 3 + [0.0167] * 2)
    for j, step in enumerate(steps):
        unit = np.eye(5)[j]
        by = -difference(lambda h, unit=unit: bearing.wrench(u + h * unit, speed), 0.0, step)
        weight = sizes * sizes[j] * np.abs(K / np.outer(sizes, sizes)).max()
        assert np.abs((by - K[:, j]) / weight).max() < 1e-7
    by_speed = difference(lambda w: bearing.wrench(u, w), speed, 20.0)
    assert at.slopes[:, 5] == pytest.approx(by_speed, rel=1e-6, abs=1e-9)


@pytest.mark.closed_form
def test_static_balls_have_a_symmetric_stiffness_and_running_ones_at_rest_are_static():
    static = replace(ANGULAR, law=StaticBalls())
    u = static.rest(LOADS[0]).displacement
    K = static.stiffness(u, 1000.0)
    assert pytest.approx(K.T, rel=1e-12, abs=1e-9 * np.abs(K).max()) == K
    assert ANGULAR.stiffness(u, 0.0) == pytest.approx(K, rel=1e-12)
    assert ANGULAR.stiffness(u, 0.01) == pytest.approx(K, rel=1e-8)
    assert ANGULAR.wrench(u, 1000.0) == pytest.approx(ANGULAR.wrench(u, -1000.0), rel=1e-12)


@pytest.mark.closed_form
def test_a_ball_that_leaves_the_inner_race_rests_on_the_outer_one():
    balls = DEEP.rest((0.0, -20.0, 0.0, 0.0, 0.0), 20_000.0 * RPM).balls
    off = balls.inner_load == 0.0
    assert 0 < off.sum() < DEEP.balls
    assert balls.carrying == DEEP.balls - off.sum()
    assert balls.outer_load[off] == pytest.approx(balls.centrifugal_force[off], rel=1e-12)
    assert not balls.gyroscopic_moment[off].any()
    assert not balls.outer_angle[off].any()


@pytest.mark.long
@pytest.mark.closed_form
@pytest.mark.parametrize("outer", [True, False])
def test_the_force_is_continuous_where_a_ball_leaves_the_inner_race(outer):
    bearing, speed = replace(DEEP, law=RaceControl(outer_control=outer)), 3000.0
    ways = np.linspace(4e-6, 12e-6, 4001)
    force = np.array([bearing.wrench((0.0, -way, 0.0, 0.0, 0.0), speed)[1] for way in ways])
    stiff = np.array([bearing.stiffness((0.0, -way, 0.0, 0.0, 0.0), speed)[1, 1] for way in ways])
    assert force[0] == 0.0
    assert force[-1] > 100.0
    jump = np.abs(np.diff(force) - 0.5 * (stiff[1:] + stiff[:-1]) * np.diff(ways))
    assert jump.max() < 2e-3


@pytest.mark.closed_form
def test_the_steps_of_the_ladder_are_of_the_size_that_is_told():
    """Figures of an independent code: thrust of 500 and 100 N at 10 000 and 30 000 rpm."""

    def axial(thrust, rpm):
        return CONTROLLED.rest((0.0, 0.0, thrust, 0.0, 0.0), rpm * RPM)

    still, slow, fast = (axial(500.0, rpm) for rpm in (0.0, 10_000.0, 30_000.0))
    assert slow.stiffness[2, 2] / still.stiffness[2, 2] == pytest.approx(0.968, abs=1e-3)
    assert fast.stiffness[2, 2] / still.stiffness[2, 2] == pytest.approx(0.33, abs=5e-3)
    assert fast.balls.traction.max() == pytest.approx(0.053, abs=5e-4)
    inner_control = replace(CONTROLLED, law=RaceControl(outer_control=False))
    with pytest.warns(match=r"traction coefficient of 0\.114"):
        other = inner_control.rest((0.0, 0.0, 500.0, 0.0, 0.0), 30_000.0 * RPM).balls
    assert other.centrifugal_force / fast.balls.centrifugal_force == pytest.approx(0.85, abs=1e-3)
    assert np.degrees(fast.balls.inner_angle - other.inner_angle) == pytest.approx(2.1, abs=0.05)
    light = axial(100.0, 10_000.0).stiffness[2, 2] / axial(100.0, 0.0).stiffness[2, 2]
    assert light == pytest.approx(0.35, abs=5e-3)


def test_sliding_and_overload_are_told():
    with pytest.warns(match=r"traction coefficient of 0\.\d+; balls slide beyond about 0\.06"):
        CONTROLLED.rest(LOADS[0], 30_000.0 * RPM)
    with pytest.warns(match=r"the load of a ball should be at most .* N, at which the pressure is 4200 MPa"):
        DEEP.wrench((0.0, -2e-4, 0.0, 0.0, 0.0))


def test_ceramic_balls_press_less_on_the_outer_race():
    hybrid = replace(ANGULAR, ball_material=RollingMaterial.silicon_nitride())
    steel, ceramic = (b.rest((0.0, 0.0, 500.0, 0.0, 0.0), 20_000.0 * RPM).balls for b in (ANGULAR, hybrid))
    assert ceramic.centrifugal_force[0] == pytest.approx(
        steel.centrifugal_force[0] * 3200.0 / 7800.0, rel=0.05
    )
    assert ceramic.inner_angle[0] < steel.inner_angle[0]


@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
def test_the_work_of_an_equilibrium_is_small():
    rng = np.random.default_rng(5)
    most = 0
    for _ in range(30):
        load = rng.uniform([-200, -200, 150, -0.8, -0.8], [200, 200, 900, 0.8, 0.8])
        found = ANGULAR.rest(load, rng.uniform(0.0, 25_000.0) * RPM)
        assert found.residual < 1e-12
        most = max(most, found.evaluations)
    assert most <= 25


def test_a_ball_that_is_about_to_leave_the_inner_race_has_an_answer():
    """There a search from where the ball is not pressed at all fails."""
    bearing = BallBearing(
        balls=16,
        ball_diameter=7.938e-3,
        pitch_diameter=46.5e-3,
        contact_angle=np.radians(25.0),
        ball_material=RollingMaterial.silicon_nitride(),
    )
    u = [1.974382321516215e-05, -1.139910164810625e-05, -1.5e-5, 0.0, 0.0]
    for law in (RunningBalls(), RaceControl()):
        grazing = replace(bearing, law=law).loads(u, 261.8)
        neighbors = grazing.inner_load[[6, 8]]
        assert 0.0 < grazing.inner_load[7] < neighbors.min()
        assert grazing.gyroscopic_moment[7] < 0.0
    rng = np.random.default_rng(0)
    for law in (RunningBalls(), RaceControl(), RaceControl(outer_control=False)):
        one = replace(bearing, law=law)
        for _ in range(300):
            motion = rng.uniform(-1.0, 1.0, 5) * [3e-5, 3e-5, 6e-5, 5e-4, 5e-4]
            assert one.kernel.at(motion, 10.0 ** rng.uniform(1.0, 3.5)).status <= 1
