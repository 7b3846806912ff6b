import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

from rotorfilm import InputError
from rotorfilm.rotors import SpeedProfile

RUN = SpeedProfile(times=(0.5, 1.5, 2.0, 4.0), speeds=(-10.0, 40.0, 40.0, 5.0))


def test_constant_speed_turns_in_proportion_to_time():
    profile = SpeedProfile.constant(12.5)
    assert profile.speed(-3.0) == profile.speed(7.0) == 12.5
    assert profile.acceleration(1.0) == 0.0
    assert profile.angle(4.0) == 50.0
    assert profile.angle(-2.0) == -25.0


@pytest.mark.closed_form
def test_spin_up_from_rest_turns_by_half_the_acceleration_times_time_squared():
    spin_up = SpeedProfile(times=(0.0, 2.0), speeds=(0.0, 100.0))
    assert_allclose(spin_up.angle(1.2), 0.5 * 50.0 * 1.2**2, rtol=1e-15)
    assert_allclose(spin_up.angle(5.0), 100.0 + 3.0 * 100.0, rtol=1e-15)
    assert spin_up.acceleration(0.0) == 50.0
    assert spin_up.acceleration(2.0) == 0.0


def test_speed_is_linear_between_points_and_held_outside():
    t = np.linspace(-1.0, 6.0, 57)
    assert_allclose([RUN.speed(s) for s in t], np.interp(t, RUN.times, RUN.speeds), atol=1e-13)


def test_angle_is_the_integral_of_the_speed_from_zero():
    assert RUN.angle(0.0) == 0.0
    for t in (-1.0, 0.2, 0.5, 1.1, 1.9, 2.0, 3.3, 4.0, 6.0):
        inside = [s for s in RUN.times if min(t, 0.0) < s < max(t, 0.0)]
        expected = quad(RUN.speed, 0.0, t, points=inside or None, epsabs=1e-12)[0]
        assert_allclose(RUN.angle(t), expected, atol=1e-11)


def test_acceleration_is_the_slope_just_after():
    h = 1e-6
    for t in (-1.0, 0.5, 0.7, 1.5, 1.7, 2.0, 3.0, 4.0, 5.0):
        assert_allclose(RUN.acceleration(t), (RUN.speed(t + h) - RUN.speed(t)) / h, atol=1e-6)


@pytest.mark.parametrize("tolerance", [1.0, 1e-2])
@pytest.mark.parametrize(
    "function", [lambda t: 100.0 * np.sin(t) ** 2, lambda t: 300.0 * (1.0 - np.exp(-4.0 * t)), lambda t: t**3]
)
def test_a_sampled_function_is_followed_within_the_tolerance(function, tolerance):
    profile = SpeedProfile.from_function(function, 3.0, tolerance)
    t = np.linspace(0.0, 3.0, 20_001)
    assert np.abs([profile.speed(s) - function(s) for s in t]).max() <= tolerance
    assert profile.times[0] == 0.0
    assert profile.times[-1] == 3.0


@pytest.mark.convergence
def test_sampling_needs_points_in_inverse_proportion_to_the_root_of_the_tolerance():
    counts = [len(SpeedProfile.from_function(np.exp, 3.0, tol).times) for tol in (1e-2, 1e-4, 1e-6)]
    assert_allclose(np.divide(counts[1:], counts[:-1]), 10.0, rtol=0.2)


def test_a_straight_function_needs_no_refinement():
    assert len(SpeedProfile.from_function(lambda t: 3.0 * t, 2.0, 1e-9).times) == 9


def test_values_are_kept_as_tuples_of_float_and_compared():
    profile = SpeedProfile([0, 1], np.array([2, 3]))
    assert profile == SpeedProfile((0.0, 1.0), (2.0, 3.0))
    assert eval(repr(profile)) == profile
    with pytest.raises(dataclasses.FrozenInstanceError):
        profile.times = (0.0,)


@pytest.mark.parametrize(
    ("times", "speeds", "match"),
    [
        ((), (), "times must be a sequence of at least one"),
        ((0.0, 1.0), (1.0,), "speeds must be as many as times"),
        ((0.0, 0.0), (1.0, 2.0), r"times must increase strictly, got \(0.0, 0.0\)"),
        ((0.0, np.inf), (1.0, 2.0), "times must be finite"),
        ((0.0, 1.0), (1.0, np.nan), "speeds must be finite"),
    ],
)
def test_bad_points_are_named(times, speeds, match):
    with pytest.raises(InputError, match=match):
        SpeedProfile(times, speeds)


def test_bad_functions_are_named():
    with pytest.raises(InputError, match=r"function must be continuous, got 0 and 1 rad/s"):
        SpeedProfile.from_function(lambda t: float(t > 0.3), 1.0, 0.1)
    with pytest.raises(InputError, match=r"function\(0.0\) must be finite, got inf"):
        SpeedProfile.from_function(lambda t: np.inf, 1.0, 0.1)
    with pytest.raises(InputError, match=r"tolerance must be finite and positive, got 0.0"):
        SpeedProfile.from_function(np.sin, 1.0, 0.0)
    with pytest.raises(InputError, match=r"duration must be finite and positive, got -1.0"):
        SpeedProfile.from_function(np.sin, -1.0, 0.1)
