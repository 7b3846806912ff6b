"""Wear by melting under a load, one state: threshold, long-time limit, energy, derivatives."""

import math
from dataclasses import replace
from itertools import pairwise

import control
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rotorfilm import (
    BushReaction,
    BushWear,
    ConvergenceError,
    Dynamic,
    FilmContactError,
    Friction,
    InputError,
    ValidityWarning,
)
from rotorfilm.analysis import OperatingPoint, linearize
from rotorfilm.bearings import (
    GlobalBalance,
    SharedMelting,
    Stage,
    Wearing,
    f4k20_bush,
    wear_at_nodes,
    wear_by_one_moment,
)
from rotorfilm.core import Switched, names
from rotorfilm.fmu import advance

pytestmark = pytest.mark.filterwarnings(
    "ignore:load and speed must keep a worn contact:rotorfilm.core.errors.ValidityWarning"
)

BUSH = f4k20_bush()
WEAR = BushWear(bush=BUSH, melting_heat=1e8)
LOAD = 3750.0
RATIO = float(BUSH.load_ratio(LOAD))
ONSET = float(BUSH.critical_speed(LOAD))
OUTPUTS = [
    "contact_angle",
    "settlement",
    "temperature",
    "maximum_pressure",
    "friction_torque",
    "melt_rate",
    "speed_ratio",
]


def outputs(model, wear, load, speed):
    return dict(zip(OUTPUTS, model.output(0.0, [wear], [load, speed]), strict=True))


def worn(model, speed, duration, load=LOAD, **options):
    """Return the solution of the wear equation under a constant load."""
    return solve_ivp(
        lambda t, x: model.derivative(t, x, [load, speed]),
        (0.0, duration),
        model.initial_state,
        method="Radau",
        jac=lambda t, x: model.linearization(t, x, [load, speed]).A,
        rtol=1e-11,
        atol=1e-16,
        **options,
    )


def test_it_is_a_dynamic_model_with_events():
    assert isinstance(WEAR, Dynamic)
    assert isinstance(WEAR, Switched)
    assert names(WEAR.inputs) == ["load", "speed"]
    assert names(WEAR.outputs) == OUTPUTS
    assert names(WEAR.states) == ["wear"]
    assert replace(WEAR, wear=2e-3).initial_state.tolist() == [2e-3]


def test_below_the_critical_speed_nothing_melts_and_the_contact_is_colder():
    for speed in (0.0, 0.5 * ONSET, 0.999999 * ONSET):
        y = outputs(WEAR, 0.0, LOAD, speed)
        assert WEAR.derivative(0.0, [0.0], [LOAD, speed]) == 0.0
        assert y["melt_rate"] == 0.0
        assert y["temperature"] < 250.0
        assert y["contact_angle"] < BUSH.contact_angle(LOAD)
        assert y["speed_ratio"] < 1.0


def test_at_the_critical_speed_the_melting_point_is_reached():
    y = outputs(WEAR, 0.0, LOAD, ONSET)
    assert y["temperature"] == pytest.approx(250.0, rel=1e-12)
    assert y["speed_ratio"] == pytest.approx(1.0, rel=1e-12)
    assert y["contact_angle"] == pytest.approx(BUSH.contact_angle(LOAD), rel=1e-12)
    assert y["settlement"] == pytest.approx(float(BUSH.settlement(BUSH.contact_angle(LOAD))), rel=1e-9)


def test_above_the_critical_speed_the_liner_melts_at_the_melting_point():
    y = outputs(WEAR, 0.0, LOAD, 1.001 * ONSET)
    assert y["temperature"] == 250.0
    assert y["melt_rate"] > 0.0
    assert y["speed_ratio"] == pytest.approx(1.001, rel=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [5.0, pytest.param(-9.0, marks=pytest.mark.long)])
def test_the_wear_ends_where_the_critical_speed_has_risen_to_the_speed(speed):
    end = brentq(
        lambda a: BUSH.critical_speed(LOAD, a) - abs(speed), BUSH.contact_angle(LOAD), 1.5, xtol=1e-15
    )
    solution = worn(WEAR, speed, 1e5)
    assert outputs(WEAR, solution.y[0, -1], LOAD, speed)["contact_angle"] == pytest.approx(end, rel=1e-8)
    assert np.all(np.diff(solution.y[0]) >= 0.0)


@pytest.mark.closed_form
def test_temperature_without_rotation_is_conduction_alone():
    y = outputs(WEAR, 0.0, LOAD, 0.0)
    shaft, liner = BUSH.shaft_conductance, BUSH.liner_conductance
    expected = liner * (235.0 + 4.0 * math.sin(y["contact_angle"]) / y["contact_angle"]) / (shaft + liner)
    assert y["temperature"] == pytest.approx(expected, rel=1e-12)
    assert y["friction_torque"] == 0.0


@settings(max_examples=40, deadline=None)
@given(
    st.floats(1.0, 1e4),
    st.floats(-30.0, 30.0),
    st.floats(0.0, 5e-3),
    st.floats(-3e-4, 3e-4),
    st.floats(-5e-7, 5e-7),
    st.booleans(),
)
def test_contact_and_heat_are_balanced(load, speed, wear, f1, f2, whole):
    """The two equations of the contact, written out; friction and torque are those of the pressure (2.14)."""
    bush = replace(BUSH, friction=Friction(f0=0.15, f1=f1, f2=f2))
    model = BushWear(bush=replace(bush, balance=GlobalBalance()) if whole else bush, melting_heat=1e8)
    y = outputs(model, wear, load, speed)
    alpha, temperature = y["contact_angle"], y["temperature"]
    arc = (alpha - 0.5 * math.sin(2.0 * alpha)) / math.cos(alpha)
    lifted = bush.compliance * load / bush.force_unit + wear
    assert bush.gap(temperature) * arc == pytest.approx(lifted, rel=1e-9)
    made = abs(speed) * 12.5e-3 * bush.friction.at(temperature) * bush.mean_pressure(load, alpha)
    share = math.pi / alpha if whole else 1.0
    lost = bush.shaft_conductance * temperature * share
    lost += bush.liner_conductance * (temperature - bush.outer_temperature(alpha))
    melted = y["melt_rate"] * 1e8
    assert melted >= 0.0
    assert made == pytest.approx(lost + melted, rel=1e-9, abs=1e-6)
    assert melted == 0.0 or temperature == 250.0
    assert y["friction_torque"] * speed == pytest.approx(
        made * 2.0 * alpha * 12.5e-3 * 0.1, rel=1e-9, abs=1e-9
    )


@pytest.mark.long
def test_the_energy_of_a_run_is_conserved():
    """Friction work = heat into shaft and liner + melting heat of the lost volume, over two seconds."""
    speed = 12.0
    solution = worn(WEAR, speed, 2.0, dense_output=True)
    points, weights = np.polynomial.legendre.leggauss(40)
    # Panels towards t = 0, where melting is fastest.
    edges = 2.0 * np.concatenate([[0.0], 0.5 ** np.arange(8, -1, -1)])
    work = losses = melting = 0.0
    for left, right in pairwise(edges):
        for point, weight in zip(points, weights, strict=True):
            t = 0.5 * (left + right) + 0.5 * (right - left) * point
            y = outputs(WEAR, solution.sol(t)[0], LOAD, speed)
            part = 0.5 * (right - left) * weight
            area = 2.0 * y["contact_angle"] * 12.5e-3 * 0.1
            work += part * y["friction_torque"] * speed
            losses += part * area * float(BUSH.shaft_flux(0.3) + BUSH.liner_flux(y["contact_angle"]))
            melting += part * area * 1e8 * y["melt_rate"]
    assert melting > 0.05 * work
    assert work == pytest.approx(losses + melting, rel=1e-9)
    # The state itself is the same melting: dW = melt_rate N/(R qbar) dt.
    assert solution.y[0, -1] == pytest.approx(
        _wear_from_melt_rate(solution, speed, points, weights, edges), rel=1e-8
    )


def _wear_from_melt_rate(solution, speed, points, weights, edges):
    total = 0.0
    for left, right in pairwise(edges):
        for point, weight in zip(points, weights, strict=True):
            t = 0.5 * (left + right) + 0.5 * (right - left) * point
            y = outputs(WEAR, solution.sol(t)[0], LOAD, speed)
            mean = y["friction_torque"] / (0.1 * 2.0 * y["contact_angle"] * 12.5e-3**2 * 0.1)
            ratio = LOAD / 0.1 / 12.5e-3 / mean
            total += 0.5 * (right - left) * weight * y["melt_rate"] * ratio / 13e-3
    return total


def difference(model, x, u, scale):
    """Return fourth-order differences of (derivative, output) by (wear, load, speed)."""

    def both(z):
        return np.concatenate([model.derivative(0.0, z[:1], z[1:]), model.output(0.0, z[:1], z[1:])])

    z = np.array([*x, *u])
    columns = []
    for j, h in enumerate(scale):
        e = h * np.eye(3)[j]
        columns.append(
            (8.0 * (both(z + e) - both(z - e)) - both(z + 2.0 * e) + both(z - 2.0 * e)) / (12.0 * h)
        )
    return np.array(columns).T


@pytest.mark.parametrize("balance", [BUSH.balance, GlobalBalance()])
@pytest.mark.parametrize("friction", [Friction(f0=0.1), Friction(f0=0.1, f1=2e-4, f2=-4e-7)])
@pytest.mark.parametrize("u", [(3000.0, 2.0), (3000.0, 15.0), (5000.0, -100.0), (5000.0, -1.0)])
def test_derivatives_are_exact(u, friction, balance):
    model = BushWear(bush=replace(BUSH, friction=friction, balance=balance), melting_heat=1e8)
    x, steps = np.array([2e-3]), np.array([2e-6, 3.0, 1e-3])
    linear = model.linearization(0.0, x, u)
    exact = np.block([[linear.A, linear.B], [linear.C, linear.D]])
    scale = np.array([1e-2, *(signal.nominal for signal in model.outputs)])
    error = (exact - difference(model, x, u, steps)) * 1e3 * steps / scale[:, None]
    assert np.abs(error).max() < 1e-9


@pytest.mark.convergence
@pytest.mark.parametrize(("share", "kelvin", "depth"), [(0.5, 5.0, 1.2e-6), (0.3, 8.0, 2.5e-6)])
@pytest.mark.parametrize("duration", [0.02, 0.2])
def test_a_worn_bush_under_a_smaller_load_is_somewhat_colder_than_its_profile_says(
    share, kelvin, depth, duration
):
    """The rung above: wear at nodes and steady heat."""
    speed = 9.0
    wearing, stages = Wearing(BUSH.law, speed, 1e8 * 13e-3), (Stage(duration, RATIO),)
    path = wear_by_one_moment(wearing, stages)
    reach = 1.15 * float(wearing.angle(path.moment[-1], RATIO))
    depths = 13e-3 * wear_at_nodes(wearing, SharedMelting(), stages, 96, reach).depth
    model = BushReaction(
        bush=BUSH, melting_heat=1e8, nodes=193, extent=2.0 * reach, center=-0.5 * math.pi - math.atan(0.1)
    )
    # Pressure carries the load beside friction, so that it is the load of the other model.
    at, temperature = model.rest([0.0, -share * LOAD * math.hypot(1.0, 0.1)], speed, depths)
    with pytest.warns(ValidityWarning, match="a worn contact at its melting point"):
        y = outputs(WEAR, float(path.moment[-1]), share * LOAD, speed)
    assert 0.0 < temperature - y["temperature"] < kelvin
    assert math.hypot(*at) - 0.5e-3 == pytest.approx(y["settlement"], abs=depth)


def test_events_are_where_the_derivative_has_its_kink():
    below, above = (
        WEAR.events(0.0, [0.0], [LOAD, ONSET * (1.0 - 1e-9)]),
        WEAR.events(0.0, [0.0], [LOAD, ONSET * (1.0 + 1e-9)]),
    )
    assert below[0] < 0.0 < above[0]
    assert below[1] > 0.0
    assert WEAR.events(0.0, [0.0], [LOAD, -1.0])[1] < 0.0


def test_trial_states_with_negative_wear_count_as_unworn():
    unworn, below = WEAR.output(0.0, [0.0], [LOAD, 9.0]), WEAR.output(0.0, [-1e-3], [LOAD, 9.0])
    np.testing.assert_array_equal(unworn, below)
    assert not WEAR.linearization(0.0, [-1e-3], [LOAD, 9.0]).C.any()
    assert WEAR.linearization(0.0, [0.0], [LOAD, 9.0]).C.any()


@pytest.mark.long
@pytest.mark.parametrize("step", [1.0, 1e4])
def test_a_long_step_of_an_fmu_does_not_fail_on_its_trial_states(step):
    end = advance(WEAR, 0.0, np.zeros(1), np.array([LOAD, 4.5]), step)
    assert end[0] == pytest.approx(worn(WEAR, 4.5, step).y[0, -1], rel=1e-7)


def test_a_liner_that_is_worn_through_is_reported():
    """Above the largest critical speed the wear does not end."""
    assert WEAR.derivative(0.0, [30.0], [LOAD, 100.0]) > 0.0
    with pytest.raises(
        FilmContactError, match=r"settlement must be below the thickness of the liner 0\.0015 m"
    ):
        WEAR.output(0.0, [30.0], [LOAD, 100.0])


def test_without_load_and_wear_nothing_touches():
    y = outputs(WEAR, 0.0, 0.0, 50.0)
    assert y["contact_angle"] == y["maximum_pressure"] == y["friction_torque"] == y["melt_rate"] == 0.0
    assert y["settlement"] == pytest.approx(-BUSH.closing * y["temperature"] * 13e-3, rel=1e-9)
    assert WEAR.derivative(0.0, [0.0], [0.0, 50.0]) == 0.0
    with pytest.raises(InputError, match="load and wear must not both be zero for a derivative"):
        WEAR.linearization(0.0, [0.0], [0.0, 50.0])


def test_thermal_runaway_is_reported_not_iterated():
    """Friction that grows with the square of the temperature: no steady state between cold and molten."""
    bush = replace(BUSH, friction=Friction(f0=0.01, f2=1e-4), outer_mean=20.0, outer_swing=0.0)
    model = BushWear(bush=bush, melting_heat=1e8)

    def molten(speed):
        return outputs(model, 0.0, LOAD, speed)["temperature"] == 250.0

    assert not molten(0.5)
    assert molten(2.5)
    with pytest.raises(
        ConvergenceError, match="contact must be steady, got one at the brink of thermal runaway"
    ):
        # Bisection leads to the jump from cold to molten, around which no contact is steady.
        brentq(lambda speed: molten(speed) - 0.5, 0.5, 2.5)


def test_python_control_gets_the_exact_derivatives():
    point = OperatingPoint(x=[1e-3], u=[LOAD, 9.0])
    system = linearize(WEAR, point, name="bush")
    assert isinstance(system, control.StateSpace)
    assert system.state_labels == ["wear"]
    assert system.output_labels == OUTPUTS
    # Wear widens the contact and lifts the critical speed: a stable mode.
    assert system.poles()[0] < 0.0


@pytest.mark.parametrize(
    ("x", "u", "message"),
    [
        ([0.0], [-1.0, 1.0], r"load must be finite and not negative, got -1\.0"),
        ([math.nan], [1.0, 1.0], "x must be finite"),
        ([0.0], [1.0, math.inf], "u must be finite"),
        ([0.0, 1.0], [1.0, 1.0], r"x and u must have shapes \(1,\) for wear and \(2,\)"),
    ],
)
def test_bad_points_are_named(x, u, message):
    with pytest.raises(InputError, match=message):
        WEAR.output(0.0, x, u)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bush": 1.0}, "bush must be a MeltingBush, got 1.0"),
        ({"melting_heat": 0.0}, "melting_heat must be finite and positive, got 0.0"),
        ({"wear": -1.0}, "wear must be finite and not negative, got -1.0"),
    ],
)
def test_bad_parameters_are_named(change, message):
    with pytest.raises(InputError, match=message):
        replace(WEAR, **change)
