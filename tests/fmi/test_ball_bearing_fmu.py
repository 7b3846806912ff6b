"""Native FMUs of ball bearings and pairs: forces and derivatives of Python, parameters, refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from rotorfilm import BallBearing, InputError, RunningBalls, back_to_back, export_fmu
from rotorfilm.bearings import RaceControl
from rotorfilm.fmu import check_fmu
from rotorfilm.fmu.export import start_values

from .journals import version_and_kind

ONE = BallBearing(
    balls=11,
    ball_diameter=7.938e-3,
    pitch_diameter=33.5e-3,
    contact_angle=math.radians(20.0),
    axial_load=350.0,
    tilt=(1e-5, -2e-5),
    damping=120.0,
)
DEEP = BallBearing(
    balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, internal_clearance=8e-6, cage_angle=0.3
)
PAIR = back_to_back(replace(ONE, axial_load=None), distance=0.02, preload=200.0)
INPUTS, FORCES = ("x", "y", "vx", "vy", "speed"), ("force_x", "force_y")
versions = pytest.mark.parametrize("version", ["2.0", "3.0"])


def motions(count):
    rng = np.random.default_rng(3)
    return rng.uniform(-1.0, 1.0, (count, 5)) * [8e-6, 8e-6, 1e-2, 1e-2, 1500.0]


@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
@version_and_kind
@pytest.mark.parametrize("model", [ONE, DEEP, PAIR], ids=["thrust", "deep groove", "pair"])
def test_forces_and_derivatives_are_those_of_python(version, model, exchange, opened):
    instance, reference = opened(model, version, exchange)
    inputs, outputs = [reference[name] for name in INPUTS], [reference[name] for name in FORCES]
    states = motions(5)
    instance.initialize(inputs, states[0].tolist())
    for number, state in enumerate(states):
        if not exchange:
            instance.step(1e-3 * number, 1e-3)
        instance.set(inputs, state.tolist())
        expected = model.force(state[:2], state[2:4], state[4])
        np.testing.assert_allclose(instance.get(outputs), expected, rtol=1e-12, atol=1e-9)
        columns = [instance.directional(outputs, [one], [1.0]) for one in inputs]
        expected = model.jacobian(state[:2], state[2:4], state[4])
        np.testing.assert_allclose(np.array(columns).T, expected, rtol=1e-11, atol=1e-9)


@versions
def test_a_ball_bearing_is_native_by_default_and_passes_all_checks(version, tmp_path):
    path = export_fmu(DEEP, tmp_path / "b.fmu", version, start={"x": "2 um", "y": -7e-6, "speed": 300.0})
    assert [item.check for item in check_fmu(path) if item.passed is False] == []


def test_start_values_take_units():
    assert start_values(DEEP, {"x": "2 um"})["x"] == 2e-6
    with pytest.raises(InputError, match=r"start\['x'\].*measured in m"):
        start_values(DEEP, {"x": "2 N"})


@versions
def test_parameters_are_those_of_the_bearing(version, opened):
    instance, reference = opened(DEEP, version, False)
    state = [2e-6, -7e-6, 1e-3, 0.0, 300.0]
    instance.initialize([reference[one] for one in INPUTS], state)
    names = ("growth", "axial_displacement", "tilt_x", "tilt_y", "cage_turn", "damping")
    values = [3e-6, 2e-6, 1e-4, -2e-4, 0.5, 40.0]
    instance.set([reference[one] for one in names], values)
    other = replace(
        DEEP, growth=3e-6, axial_displacement=2e-6, tilt=(1e-4, -2e-4), cage_angle=0.8, damping=40.0
    )
    found = instance.get([reference[one] for one in FORCES])
    np.testing.assert_allclose(found, other.force(state[:2], state[2:4], 300.0), rtol=1e-11)


def test_the_friction_of_the_balls_is_a_parameter(opened):
    instance, reference = opened(ONE, "3.0", False)
    state = [2e-6, -7e-6, 1e-3, 0.0, 1500.0]
    instance.initialize([reference[one] for one in INPUTS], state)
    found = [instance.get([reference[one] for one in FORCES])]
    names = "traction_coefficient", "slide_to_roll_ratio"
    instance.set([reference[one] for one in names], [0.03, 0.02])
    found.append(instance.get([reference[one] for one in FORCES]))
    other = replace(ONE, law=RunningBalls(traction_coefficient=0.03, slide_to_roll_ratio=0.02))
    expected = [model.force(state[:2], state[2:4], 1500.0) for model in (ONE, other)]
    assert abs(expected[1][0] / expected[0][0] - 1.0) > 1e-4
    np.testing.assert_allclose(found, expected, rtol=1e-11)
    instance.set([reference[names[0]]], [0.0])
    with pytest.raises(FMICallException):
        instance.get([reference[one] for one in FORCES])
    assert any("traction_coefficient must be 0.001 to 0.5, got 0" in line for line in instance.log)


@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
def test_race_control_is_native_and_has_no_friction(opened):
    model = replace(ONE, law=RaceControl(outer_control=False))
    instance, reference = opened(model, "2.0", False)
    state = [2e-6, -7e-6, 1e-3, 0.0, 1000.0]
    instance.initialize([reference[one] for one in INPUTS], state)
    found = instance.get([reference[one] for one in FORCES])
    np.testing.assert_allclose(found, model.force(state[:2], state[2:4], 1000.0), rtol=1e-11)
    assert "traction_coefficient" not in reference


def test_negative_damping_is_refused(opened):
    instance, reference = opened(DEEP, "2.0", False)
    with pytest.raises(FMICallException):
        instance.initialize([reference["damping"]], [-1.0])
    assert any("damping must not be negative, got -1" in line for line in instance.log)


def test_an_overload_is_told(opened):
    instance, reference = opened(DEEP, "2.0", False)
    instance.initialize([reference[one] for one in INPUTS], [0.0, -2e-4, 0.0, 0.0, 300.0])
    assert instance.get([reference["force_y"]])[0] > 1e4
    assert any("pressed to 4200 MPa at most" in line for line in instance.log)
