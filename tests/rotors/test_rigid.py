import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import Dynamic, InputError
from rotorfilm.core import names
from rotorfilm.rotors import RigidRotor, SpeedProfile

RAMP = SpeedProfile(times=(0.0, 2.0), speeds=(30.0, -90.0))
ROTOR = RigidRotor(
    mass=4.0,
    speed=RAMP,
    unbalance=0.02,
    unbalance_angle=0.7,
    gravity=(0.3, -9.0),
    static_force=(1.0, 2.0),
    position=(1e-4, -2e-4),
    velocity=(0.01, 0.02),
)


def test_it_is_a_dynamic_model_with_the_signals_of_a_journal():
    assert isinstance(ROTOR, Dynamic)
    assert names(ROTOR.inputs) == ["force_x", "force_y"]
    assert names(ROTOR.outputs) == ["x", "y", "vx", "vy", "speed"]
    assert names(ROTOR.states) == ["x", "y", "vx", "vy"]
    assert ROTOR.initial_state.tolist() == [1e-4, -2e-4, 0.01, 0.02]


def test_output_is_the_state_and_the_present_speed():
    x = np.array([1.0, 2.0, 3.0, 4.0])
    assert ROTOR.output(0.5, x, np.zeros(2)).tolist() == [1.0, 2.0, 3.0, 4.0, 0.0]


def test_static_load_is_weight_plus_static_force():
    assert_allclose(ROTOR.static_load, [4.0 * 0.3 + 1.0, -4.0 * 9.0 + 2.0])
    assert_allclose(RigidRotor(mass=2.0, speed=0.0).static_load, [0.0, -2.0 * 9.80665])


@pytest.mark.closed_form
def test_static_forces_give_newtons_second_law():
    rotor = dataclasses.replace(ROTOR, unbalance=0.0)
    rate = rotor.derivative(0.3, [0.0, 0.0, 5.0, 6.0], [7.0, 8.0])
    assert_allclose(rate, [5.0, 6.0, (7.0 + 2.2) / 4.0, (8.0 - 34.0) / 4.0])


@pytest.mark.closed_form
def test_unbalance_at_constant_speed_is_the_centrifugal_force():
    rotor = RigidRotor(mass=1.0, speed=-20.0, unbalance=0.03, unbalance_angle=np.pi / 2)
    assert_allclose(rotor.unbalance_force(0.0), [0.0, 0.03 * 400.0], atol=1e-14)
    quarter = np.pi / 2 / 20.0
    assert_allclose(rotor.unbalance_force(quarter), [0.03 * 400.0, 0.0], atol=1e-13)


@pytest.mark.parametrize("t", [0.1, 0.5, 1.3, 2.5])
def test_unbalance_force_is_minus_the_acceleration_of_the_mass_center_about_the_journal(t):
    """The second derivative of the mass center, by sixth-order differences, angular acceleration included."""

    def center(time):
        phi = RAMP.angle(time) + 0.7
        return 0.02 * np.array([np.cos(phi), np.sin(phi)])

    h = 2e-4
    weights = np.array([2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0]) / (180.0 * h * h)
    acceleration = sum(w * center(t + k * h) for w, k in zip(weights, range(-3, 4), strict=True))
    assert_allclose(ROTOR.unbalance_force(t), -acceleration, atol=1e-6 * np.abs(acceleration).max())


def test_linearization_reproduces_the_differences_of_the_model():
    x, u, t = np.array([1.0, 2.0, 3.0, 4.0]), np.array([5.0, 6.0]), 0.4
    linear = ROTOR.linearization(t, x, u)
    dx, du = np.array([0.1, -0.2, 0.3, 0.4]), np.array([-0.5, 0.6])
    change = ROTOR.derivative(t, x + dx, u + du) - ROTOR.derivative(t, x, u)
    assert_allclose(change, linear.A @ dx + linear.B @ du, atol=1e-12)
    change = ROTOR.output(t, x + dx, u + du) - ROTOR.output(t, x, u)
    assert_allclose(change, linear.C @ dx + linear.D @ du, atol=1e-12)


def test_breakpoints_are_the_kinks_of_the_profile():
    assert ROTOR.breakpoints == (0.0, 2.0)
    assert RigidRotor(mass=1.0, speed=3.0).breakpoints == ()


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"mass": 0.0}, "mass must be finite and positive, got 0.0"),
        ({"mass": np.nan}, "mass must be finite and positive, got nan"),
        ({"unbalance": -1.0}, "unbalance must be finite and not negative, got -1.0"),
        ({"unbalance_angle": np.inf}, "unbalance_angle must be a single finite number, got inf"),
        ({"speed": np.nan}, "speed must be a single finite number, got nan"),
        ({"speed": (1.0, 2.0)}, r"speed must be a single finite number, got \(1.0, 2.0\)"),
        ({"speed": "fast"}, "speed: quantity must be a number with a unit such as '1 rad/s', got 'fast'"),
        ({"gravity": 9.81}, "gravity must be a pair of numbers, got 9.81"),
        ({"static_force": (0.0, np.nan)}, "static_force must be finite"),
        ({"position": (0.0, 0.0, 0.0)}, "position must be a pair of numbers"),
        ({"velocity": (np.inf, 0.0)}, "velocity must be finite"),
    ],
)
def test_bad_parameters_are_named(change, match):
    with pytest.raises(InputError, match=match):
        dataclasses.replace(ROTOR, **change)
