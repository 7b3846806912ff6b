"""Ball bearings over speed and preload, their models beside each other, and what the charts draw of it."""

import math

import numpy as np
import pytest

from rotorfilm import BallBearing, InputError, back_to_back, variable_compliance
from rotorfilm.charts import plot_ball_curves, plot_compliance, plot_study
from rotorfilm.studies import ball_accuracy, ball_curves, usual_bearing

CURVES = ball_curves(usual_bearing(), [0.0, 1500.0, 3000.0], thrust=500.0, load=300.0)


@pytest.mark.closed_form
def test_curves_balance_their_loads():
    angle = CURVES.ball_angle
    # At rest both contacts are in line: the loads along the common angle carry thrust and load.
    assert CURVES.inner_load[0] == pytest.approx(CURVES.outer_load[0], rel=1e-9)
    share = np.sum(CURVES.inner_load[0] * np.sin(angle))
    assert share * math.cos(math.radians(25.0)) == pytest.approx(-300.0, rel=0.02)
    assert CURVES.inner_angle[0] == pytest.approx(CURVES.outer_angle[0], abs=1e-9)
    # Fast balls: the inner angle opens, the outer one closes.
    assert np.all(np.diff(CURVES.inner_angle) > 0.0)
    assert np.all(np.diff(CURVES.outer_angle) < 0.0)
    pair = back_to_back(usual_bearing(), distance=2.5 * 7.938e-3, preload=150.0)
    assert CURVES.radial_stiffness[1, 2] == pytest.approx(pair.stiffness(np.zeros(5), 3000.0)[1, 1])
    assert CURVES.running_preload[1] == pytest.approx([pair.running_preload(s) for s in CURVES.speeds])


def test_curves_are_drawn_and_tabulated():
    loads, angles, stiffness, swing = plot_ball_curves(CURVES).draw()
    assert len(loads.get_lines()) == 6
    assert angles.get_lines()[0].get_ydata() == pytest.approx(np.degrees(CURVES.inner_angle))
    assert len(stiffness.get_lines()) == 2 * len(CURVES.preloads)
    passing = CURVES.swing.ball_pass_frequency / (2.0 * math.pi)
    assert f"{passing:.4g} Hz" in swing.get_title()
    columns = CURVES.columns()
    assert {len(column) for column in columns.values()} == {9}
    assert columns["radial stiffness of the pair [N/m]"][5] == CURVES.radial_stiffness[1, 2]


def test_the_spectrum_of_a_swing_is_its_picture():
    bearing = BallBearing(balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, internal_clearance=10e-6)
    found = variable_compliance(bearing, (0.0, -500.0), 300.0, samples=16)
    tops = [bar.get_height() for bar in found.plot().patches]
    assert tops == pytest.approx(1e9 * found.swing_amplitude.ravel())
    still = variable_compliance(bearing, (0.0, -500.0), samples=8)
    assert "multiple of the ball-pass frequency" in plot_compliance(still).panels[0].x


def test_models_beside_each_other():
    found = ball_accuracy(3, seed=4)
    by_name = {rung.name: rung for rung in found.rungs}
    states = {name: rung["states [1]"] for name, rung in by_name.items()}
    assert states == {"closed form": 3, "static balls": 6, "running balls": 6}
    errors = {name: rung["median error of K [1]"] for name, rung in by_name.items()}
    assert errors["closed form"] > errors["running balls"]
    assert 1e-4 < errors["static balls"] < 0.5
    (axes,) = plot_study(found).draw()
    assert {text.get_text() for text in axes.texts} == set(by_name)
    assert {len(column) for column in found.columns().values()} == {3}


def test_curves_want_a_contact_angle():
    deep = BallBearing(balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, internal_clearance=10e-6)
    with pytest.raises(InputError, match="bearing must have a contact angle, got None"):
        ball_curves(deep, [0.0])
