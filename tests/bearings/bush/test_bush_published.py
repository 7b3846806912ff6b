"""The melting stage as published: what it solves, its order, and where it fails."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rotorfilm import ConvergenceError, InputError
from rotorfilm.bearings import ApproximateShaft
from rotorfilm.bearings.bush import f4k20_bush, published_stage

BUSH = replace(f4k20_bush(), shaft_heat=ApproximateShaft())
LOAD = 3750.0
FINE = published_stage(BUSH, LOAD, 9.0, np.linspace(0.0, 1e-4, 801))


def angle_by_quadrature(end):
    """Return alpha at a time, with J integrated to 1e-10: (a_1 + a_2 t) N = (c - m t + J) F(alpha)."""
    thickness = math.log(14.5 / 13.0)
    swing = 4.0 * 0.39
    rate = thickness * 13e-3 * 12.5e-3 * 0.1 * 3e8 * 9.0 / swing
    shaft = float(BUSH.shaft_flux(0.3))
    losses = thickness * 13e-3 * (shaft + 0.39 / (thickness * 13e-3) * (250.0 - 235.0)) / swing
    gap = 0.5 / 13.0 - thickness * 8e-5 * 1.4 / 0.6 * 250.0

    def alpha(t, mean):
        value = (thickness / 6.0 + rate * t) * 1e-2 / (gap - losses * t + mean)
        return brentq(lambda a: (a - 0.5 * math.sin(2.0 * a)) / math.cos(a) - value, 1e-6, 1.57, xtol=1e-15)

    def slope(t, mean):
        a = alpha(t, mean[0])
        return [math.sin(a) / a]

    run = solve_ivp(slope, (0.0, end), [0.0], rtol=1e-10, atol=1e-16)
    return alpha(end, run.y[0, -1])


@pytest.mark.convergence
def test_the_step_method_is_of_first_order():
    exact = angle_by_quadrature(1e-4)
    errors = [
        published_stage(BUSH, LOAD, 9.0, np.linspace(0.0, 1e-4, steps + 1)).contact_angle[-1] - exact
        for steps in (10, 20, 40)
    ]
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 1.0, atol=0.05)


@pytest.mark.closed_form
@pytest.mark.parametrize("k", [0, 80, 800])
def test_the_pressure_carries_the_load_and_ends_at_the_contact_angle(k):
    alpha = FINE.contact_angle[k]
    points, weights = np.polynomial.legendre.leggauss(200)
    pressure = FINE.pressure(alpha * points)[k]
    carried = alpha * (weights * pressure) @ np.cos(alpha * points) * 12.5e-3 * 0.1
    assert carried == pytest.approx(LOAD, rel=2e-3)
    assert FINE.pressure([1.0001 * alpha])[k, 0] == 0.0


@pytest.mark.closed_form
def test_the_first_pressure_is_the_assumed_one():
    alpha = BUSH.contact_angle(LOAD)
    assert FINE.contact_angle[0] == alpha
    assert FINE.pressure([0.0])[0, 0] == pytest.approx(BUSH.maximum_pressure(LOAD, alpha), rel=1e-12)
    assert FINE.settlement[0] == pytest.approx(float(BUSH.settlement(alpha)), rel=1e-9)


@pytest.mark.literature
def test_the_simple_pressure_is_good_to_15_percent_until_1e_5_only():
    """Section 4 says so for all three times; on the load line it is 14 % at 1e-5 and 31 % at 1e-4."""
    simple = BUSH.maximum_pressure(LOAD, FINE.contact_angle)
    error = FINE.pressure([0.0])[:, 0] / simple - 1.0
    assert abs(error[80]) < 0.15
    assert abs(error[800]) > 0.3


def test_points_enter_the_contact_with_negative_wear():
    alpha = FINE.contact_angle[400]
    assert FINE.wear([alpha])[400, 0] < -1e-6
    # What has not been touched cannot have lost anything; the count is the heat losses alone.
    assert FINE.wear([alpha])[400, 0] == pytest.approx(-FINE.removed[400] * 13e-3, rel=1e-9)


def test_the_contact_grows_without_rotation():
    still = published_stage(BUSH, LOAD, 0.0, np.linspace(0.0, 1e-4, 101))
    assert still.contact_angle[-1] > still.contact_angle[0] + 1e-3


def test_a_falling_load_has_no_solution():
    with pytest.raises(
        InputError, match=r"load must keep the contact growing, got .* rad after .* rad at t = "
    ):
        published_stage(BUSH, np.linspace(LOAD, 0.1 * LOAD, 101), 1.0, np.linspace(0.0, 1e-5, 101))


def test_the_clearance_is_used_up_by_the_losses_alone():
    with pytest.raises(ConvergenceError, match="times must end before the losses use up the clearance"):
        published_stage(BUSH, LOAD, 0.0, np.linspace(0.0, 1e-2, 101))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"times": [0.0]}, "times must increase strictly from 0, got"),
        ({"times": [0.0, 0.0]}, "times must increase strictly from 0, got"),
        ({"times": [1.0, 2.0]}, "times must increase strictly from 0, got"),
        ({"speed": -1.0}, "speed must not be negative, got -1.0"),
        ({"bush": replace(BUSH, outer_swing=0.0)}, "outer_swing must be finite and positive, got 0.0"),
    ],
)
def test_bad_arguments_are_named(change, message):
    with pytest.raises(InputError, match=message):
        published_stage(**{"bush": BUSH, "load": LOAD, "speed": 9.0, "times": [0.0, 1e-5], **change})
