"""Wear of a bush by one and two moments: quadratures, the model with one state, slopes, the end."""

from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.integrate import quad, solve_ivp

from rotorfilm.bearings import (
    ApproximateShaft,
    GlobalBalance,
    Stage,
    Wearing,
    end_of_wear,
    wear_by_one_moment,
    wear_by_two_moments,
)
from rotorfilm.bearings.bush import BushWear, f4k20_bush

BUSH = f4k20_bush()
HEAT = 1e8
LOAD = 3750.0
RATIO = float(BUSH.load_ratio(LOAD))
ONSET = float(BUSH.critical_speed(LOAD))
# Accuracy that the questions of scenes take the steps for.
STEPS = 1e-6


def wearing(speed, bush=BUSH):
    return Wearing(bush.law, speed, HEAT * bush.geometry.radius)


def time_to(bush, moment):
    """Return how long W takes to a moment: V by its own equation over W, then the integral of dW/W'."""
    law = bush.law

    def total(w, first):
        alpha = bush.angle(w, RATIO)
        return (2.0 * bush.gap * (np.tan(alpha) - alpha) - first) / law.compliance

    run = solve_ivp(
        lambda w, v: total(w, v) / RATIO, (0.0, moment), [0.0], method="DOP853", rtol=1e-12, atol=1e-20,
        dense_output=True,
    )  # fmt: skip

    def rate(w):
        pressed = total(w, run.sol(w)[0])
        alpha = float(bush.angle(w, RATIO))
        return RATIO * (bush.work - 2.0 * alpha * law.losses(alpha) / pressed) / bush.heat

    edges = moment * np.linspace(0.0, 1.0, 9) ** 2
    return sum(quad(lambda w: 1.0 / rate(w), *ends, epsrel=1e-11)[0] for ends in pairwise(edges))


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("ratio", "duration"), [(1.0005, 0.5), (1.05, 0.1), (2.0, 0.05), (2.0, 1.0), (4.0, 0.2)]
)
def test_two_moments_take_the_time_of_their_quadrature(ratio, duration):
    bush = wearing(ratio * ONSET)
    path = wear_by_two_moments(bush, (Stage(duration, RATIO),))
    moment = float(path.moment[-1])
    late = time_to(bush, moment)
    # the moment at the time asked for: one step along the rate at the end
    rate = RATIO * float(
        bush.surplus(bush.angle(moment, RATIO), bush.total(bush.angle(moment, RATIO), path.first[-1]))
    )
    assert abs(late - duration) * rate < STEPS * moment


@pytest.mark.closed_form
def test_one_moment_is_the_model_with_one_state():
    model = BushWear(bush=BUSH, melting_heat=HEAT)
    run = solve_ivp(
        lambda t, x: model.derivative(t, x, [LOAD, 2.0 * ONSET]), (0.0, 0.5), [0.0], method="Radau",
        rtol=1e-11, atol=1e-16,
    )  # fmt: skip
    path = wear_by_one_moment(wearing(2.0 * ONSET), (Stage(0.5, RATIO),))
    assert path.moment[-1] == pytest.approx(run.y[0, -1], rel=STEPS)
    settled = model.output(0.0, run.y[:, -1], [LOAD, 8.0])[1] - BUSH.settlement(BUSH.contact_angle(LOAD))
    assert BUSH.geometry.radius * wearing(8.0).settlement(path.moment[-1], RATIO) == pytest.approx(
        float(settled), rel=1e-6
    )


@pytest.mark.closed_form
def test_a_stage_cut_in_two_is_the_same_run():
    bush = wearing(2.5 * ONSET)
    for march in (wear_by_one_moment, wear_by_two_moments):
        whole = march(bush, (Stage(0.3, RATIO),))
        parts = march(bush, (Stage(0.1, RATIO), Stage(0.2, RATIO)))
        assert parts.moment[-1] == pytest.approx(whole.moment[-1], rel=1e-7)


def test_wear_that_ends_stays_there_for_ever():
    bush = wearing(2.0 * ONSET)
    for march in (wear_by_one_moment, wear_by_two_moments):
        late, ever = (march(bush, (Stage(t, RATIO),)).moment[-1] for t in (1e2, 1e9))
        assert ever == pytest.approx(late, rel=STEPS)


@pytest.mark.closed_form
@given(ratio=st.floats(1.01, 8.0), balance=st.booleans())
def test_wear_ends_where_the_critical_speed_has_grown_to_the_speed(ratio, balance):
    bush = replace(BUSH, balance=GlobalBalance()) if balance else BUSH
    speed = ratio * float(bush.critical_speed(LOAD))
    moment, _ = end_of_wear(wearing(speed, bush), RATIO)
    if np.isinf(moment):
        assert bush.critical_speed(LOAD, 1.55) < speed
        return
    angle = wearing(speed, bush).angle(moment, RATIO)
    assert float(bush.critical_speed(LOAD, angle)) == pytest.approx(speed, rel=1e-9)


def test_a_bush_below_its_critical_speed_does_not_wear():
    bush = wearing(0.999 * ONSET)
    assert end_of_wear(bush, RATIO)[0] == 0.0
    for march in (wear_by_one_moment, wear_by_two_moments):
        path = march(bush, (Stage(10.0, 0.5 * RATIO), Stage(10.0, RATIO)))
        assert path.moment[-1] == path.first[-1] == 0.0


def test_a_larger_load_begins_to_melt_in_its_stage():
    speed = 0.5 * (ONSET + float(BUSH.critical_speed(2.0 * LOAD)))
    path = wear_by_two_moments(wearing(speed), (Stage(1.0, RATIO), Stage(1.0, 2.0 * RATIO)))
    assert path.moment[path.time <= 1.0].max() == 0.0
    assert path.moment[-1] > 0.0


def difference(function, at, step):
    """Return the central difference, extrapolated."""
    coarse, fine = ((function(at + h) - function(at - h)) / (2.0 * h) for h in (step, 0.5 * step))
    return (4.0 * fine - coarse) / 3.0


@pytest.mark.closed_form
@pytest.mark.parametrize("bush", [BUSH, replace(BUSH, balance=GlobalBalance())], ids=["contact", "global"])
def test_slopes_are_those_of_the_rates(bush):
    worn = wearing(60.0, bush)
    moment, first = 1.5e-4, 8e-5
    alpha = worn.angle(moment, RATIO)

    def shaped(w):
        a = worn.angle(w, RATIO)
        return RATIO * worn.surplus(a, worn.shaped_total(a, RATIO))

    total = worn.total(alpha, first)

    def along(w):
        a = worn.angle(w, RATIO)
        return RATIO * worn.surplus(a, worn.total(a, first + total / RATIO * (w - moment)))

    assert worn.shaped_slope(alpha, RATIO) == pytest.approx(difference(shaped, moment, 1e-6), rel=1e-6)
    assert worn.slope(alpha, total, RATIO) == pytest.approx(difference(along, moment, 1e-6), rel=1e-6)
    settle = partial(worn.settlement, load_ratio=RATIO)
    assert worn.settlement_slope(moment, RATIO) == pytest.approx(difference(settle, moment, 1e-6), rel=1e-7)


@pytest.mark.convergence
def test_moment_along_a_way_is_of_second_order():
    bush = wearing(2.0 * ONSET)
    path = wear_by_two_moments(bush, (Stage(0.2, RATIO),))
    errors = []
    for count in (17, 33, 65):
        way = path.moment[-1] * np.linspace(0.0, 1.0, count) ** 2
        errors.append(bush.first_along(way, np.full(count, RATIO))[-1] / path.first[-1] - 1.0)
    orders = np.log2(np.abs(np.array(errors[:-1]) / errors[1:]))
    assert orders == pytest.approx(2.0, abs=0.1)


def test_the_closed_form_of_the_flux_melts_later():
    closed = replace(BUSH, shaft_heat=ApproximateShaft())
    ends = [end_of_wear(wearing(2.0 * ONSET, bush), RATIO)[0] for bush in (closed, BUSH)]
    assert ends[0] < ends[1]
