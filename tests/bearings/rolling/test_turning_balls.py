"""Bearings whose cage turns, and all five degrees as a model: derivatives, energy, events, a rotor."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import (
    BallBearing,
    Dynamic,
    InputError,
    Model,
    OperatingPoint,
    Reaction,
    RigidRotor,
    StaticBalls,
    VariableComplianceBalls,
    back_to_back,
    linearize,
    simulate,
    variable_compliance,
)
from rotorfilm.bearings import Waviness
from rotorfilm.bearings.rolling import BALL_FREEDOMS
from rotorfilm.core import Switched

WAVES = (
    Waviness(inner=True, lobes=9, radial_amplitude=0.3e-6, phase=0.4),
    Waviness(inner=False, lobes=7, radial_amplitude=-0.2e-6, axial_amplitude=0.1e-6),
)
THRUST = BallBearing(
    balls=9,
    ball_diameter=7.938e-3,
    pitch_diameter=33.5e-3,
    contact_angle=math.radians(20.0),
    axial_load=400.0,
    tilt=(2e-4, -1e-4),
    damping=50.0,
    waviness=WAVES,
)
DEEP = BallBearing(
    balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, internal_clearance=10e-6, law=StaticBalls()
)
PAIR = back_to_back(replace(THRUST, axial_load=None), distance=0.02, preload=200.0)
bearings = pytest.mark.parametrize("bearing", [THRUST, DEEP, PAIR], ids=["thrust", "deep groove", "pair"])


def five_degrees(bearing):
    """A bearing with all its freedoms, and the angles of its cage and of the shaft."""
    return VariableComplianceBalls(bearing=replace(bearing, axial_load=None), freedoms=BALL_FREEDOMS)


def motion(place, speed):
    return np.array([*place, *[0.0] * 5, speed])


def slopes(call, at, steps):
    columns = []
    for k, step in enumerate(steps):
        d = step * np.eye(len(at))[k]
        columns.append(
            (8.0 * (call(at + d) - call(at - d)) - call(at + 2.0 * d) + call(at - 2.0 * d)) / (12.0 * step)
        )
    return np.array(columns).T


@bearings
def test_derivatives_of_five_degrees_and_both_angles(bearing):
    model = five_degrees(bearing)
    u = np.array([2e-6, -7e-6, 5e-6, 1e-4, -2e-4, 1e-3, 2e-3, 1e-3, 1e-2, 1e-2, 900.0, 0.3, 1.1])
    steps = [1e-9, 1e-9, 1e-9, 1e-7, 1e-7, *[1e-5] * 5, 0.1, 1e-5, 1e-5]
    expected = slopes(lambda v: model.output(0.0, v[11:], v[:11]), u, steps)
    size = np.abs(expected).max(axis=0)
    at = model.linearization(0.0, u[11:], u[:11])
    found = np.hstack([at.D, at.C])
    np.testing.assert_array_less(np.abs(found - expected).max(axis=0), 2e-7 * size + 1e-6)
    assert isinstance(model, Model)


@bearings
def test_derivatives_of_a_turning_cage(bearing):
    model = VariableComplianceBalls(bearing=bearing)
    u, x = np.array([2e-6, -8e-6, 1e-3, 2e-3, 900.0]), np.array([0.3, 1.1])
    found = model.linearization(0.0, x, u)
    by_state = slopes(lambda v: model.output(0.0, v, u), x, [1e-5, 1e-5])
    by_input = slopes(lambda v: model.output(0.0, x, v), u, [1e-9, 1e-9, 1e-5, 1e-5, 0.1])
    np.testing.assert_allclose(found.C, by_state, rtol=2e-6, atol=1e-5)
    np.testing.assert_allclose(found.D, by_input, rtol=2e-6, atol=1e-5 * np.abs(by_input).max())
    np.testing.assert_array_equal(found.B[:, 4], model.derivative(0.0, x, [0.0, 0.0, 0.0, 0.0, 1.0]))
    for protocol in (Reaction, Dynamic, Switched):
        assert isinstance(model, protocol)


@pytest.mark.closed_form
def test_the_force_is_the_slope_of_a_potential():
    """Static balls, with waves, have a potential whose slopes are their force."""
    model = five_degrees(replace(DEEP, waviness=(Waviness(inner=False, lobes=8, radial_amplitude=1e-6),)))
    place, x = np.array([2e-6, -9e-6]), [0.2, 0.0]
    row = DEEP.rows[0]
    K = (row[9] ** (-2.0 / 3.0) + row[10] ** (-2.0 / 3.0)) ** -1.5

    def potential(v):
        psi = x[0] + 2.0 * math.pi / 8.0 * np.arange(8)
        way = row[3] + v[0] * np.cos(psi) + v[1] * np.sin(psi) + 1e-6 * np.cos(8.0 * psi)
        return 0.4 * K * np.sum(np.maximum(way - row[7] - row[8], 0.0) ** 2.5)

    h = 1e-9
    for k in range(2):
        d = h * np.eye(2)[k]
        force = -(potential(place + d) - potential(place - d)) / (2.0 * h)
        assert model.output(0.0, x, motion([*place, 0.0, 0.0, 0.0], 0.0))[k] == pytest.approx(
            force, rel=1e-5, abs=1e-4
        )


def test_a_full_turn_of_the_cage_by_a_pitch_changes_nothing():
    bearing = replace(THRUST, waviness=(), axial_load=None, axial_displacement=3e-6)
    u = motion([2e-6, -7e-6, 5e-6, -1e-4, 1e-4], 900.0)
    here, turned = (five_degrees(bearing).output(0.0, [angle, 0.0], u) for angle in (0.0, THRUST.pitch))
    np.testing.assert_allclose(turned, here, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(here, bearing.wrench([2e-6, -7e-6, 8e-6, 1e-4, 0.0], 900.0))


@pytest.mark.closed_form
def test_waves_of_the_inner_ring_turn_with_the_shaft():
    """Cage and shaft turned by the same angle: the whole bearing is turned."""
    model = five_degrees(replace(DEEP, waviness=WAVES[:1], internal_clearance=-4e-6))
    q, angle = np.array([2e-6, -3e-6]), 0.7
    R = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    there = model.output(0.0, [angle, angle], motion([*(R @ q), 0.0, 0.0, 0.0], 0.0))
    here = model.output(0.0, [0.0, 0.0], motion([*q, 0.0, 0.0, 0.0], 0.0))
    np.testing.assert_allclose(there[:2], R @ here[:2], rtol=1e-9)


def test_a_linear_system_of_five_degrees_at_rest():
    rest = PAIR.rest([0.0, -200.0, 100.0, 0.5, 0.0], 1500.0)
    model = five_degrees(replace(PAIR, tilt=(0.0, 0.0)))
    system = linearize(model, OperatingPoint(x=[0.0, 0.0], u=motion(rest.displacement, 1500.0)))
    np.testing.assert_allclose(system.D[:, :5], -rest.stiffness, rtol=1e-9, atol=1e-3)
    assert system.input_labels[:5] == ["x", "y", "z", "tilt_x", "tilt_y"]
    assert system.output_labels == ["force_x", "force_y", "force_z", "moment_x", "moment_y"]


def test_events_tell_where_a_ball_comes_under_load():
    model = VariableComplianceBalls(bearing=DEEP)
    u = np.array([0.0, -9e-6, 0.0, 0.0, 300.0])
    loads = [DEEP.turned(angle).loads([0.0, -9e-6, 0.0, 0.0, 0.0]).inner_load for angle in (0.1, 0.3)]
    for angle, load in zip((0.1, 0.3), loads, strict=True):
        np.testing.assert_array_equal(model.events(0.0, [angle, 0.0], u) > 0.0, load > 0.0)
    assert {int((load > 0.0).sum()) for load in loads} != {0}


@pytest.mark.closed_form
def test_a_slow_rotor_follows_the_places_of_rest():
    """Far below its resonance a damped rotor swings as the quasi-static places over a pitch do."""
    bearing = replace(DEEP, damping=4000.0)
    slow = 20.0
    balls = VariableComplianceBalls(bearing=bearing)
    still = variable_compliance(bearing, (0.0, -500.0), slow, samples=32)
    start = tuple(still.position[:, 0].tolist())
    rotor = RigidRotor(mass=1.0, speed=slow, gravity=(0.0, 0.0), static_force=(0.0, -500.0), position=start)
    period = 2.0 * math.pi / still.ball_pass_frequency
    run = simulate(rotor, balls, duration=period, times=np.linspace(0.0, period, 33))
    swing = np.ptp(run.position, axis=1)
    np.testing.assert_allclose(swing, still.swing, rtol=0.03)


def test_cage_ratio_is_that_of_the_balls():
    fast = replace(THRUST, waviness=(), tilt=(0.0, 0.0))
    rest = fast.rest([0.0, 0.0, 400.0, 0.0, 0.0], 300.0)
    assert fast.cage_ratio == pytest.approx(rest.balls.orbit_speed.mean() / 300.0, rel=1e-2)
    assert (
        VariableComplianceBalls(bearing=fast, cage_ratio=0.41).derivative(
            0.0, [0.0, 0.0], [0.0] * 4 + [100.0]
        )[0]
        == 41.0
    )


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: VariableComplianceBalls(bearing=DEEP, cage_ratio=1.5),
            "cage_ratio must be above 0 and below 1, got 1.5",
        ),
        (lambda: VariableComplianceBalls(bearing=3), "bearing must be a BallBearing or a BearingPair"),
        (lambda: five_degrees(DEEP).output(0.0, [0.0, 0.0], [0.0]), r"u must have shape \(11,\)"),
        (
            lambda: VariableComplianceBalls(bearing=DEEP, freedoms=("x", "z")),
            "freedoms must be x, y and others",
        ),
        (
            lambda: VariableComplianceBalls(bearing=DEEP).output(0.0, [0.0], [0.0] * 5),
            r"x must have shape \(2,\)",
        ),
        (lambda: Waviness(inner=True, lobes=0, radial_amplitude=1e-6), "lobes must be"),
        (lambda: replace(DEEP, waviness=(1.0,)), r"waviness\[0\] must be a Waviness"),
    ],
)
def test_bad_arguments_are_named(call, message):
    with pytest.raises(InputError, match=message):
        call()
