"""Charts of certified rotors draw the numbers that they are given."""

from dataclasses import replace

import numpy as np
import pytest

from rotorfilm.analysis import ResonancePeak, SeparationMargins, StabilityCurve, StabilityLevelOne

CURVE = StabilityCurve(
    name="minimum",
    cross_coupling=np.array([0.0, 1e6, 2e6]),
    log_decrement=np.array([0.4, 0.2, 0.0]),
    frequency=np.full(3, 400.0),
    zero_cross_coupling=2e6,
    anticipated_decrement=0.3,
)
RESULT = StabilityLevelOne(
    verdict="an analysis of level II is required",
    level_two_required=True,
    speed=1000.0,
    anticipated_cross_coupling=5e5,
    stage_cross_coupling=np.array([5e5]),
    zero_cross_coupling=2e6,
    margin=4.0,
    anticipated_decrement=0.3,
    critical_speed_ratio=2.6,
    average_density=70.0,
    nodes={"4": 1.0},
    curves=(CURVE,),
)


def lines(axes):
    return {line.get_label(): line for line in axes.get_lines() if not line.get_label().startswith("_")}


def test_level_one_in_meganewton_per_meter():
    beside, screening = RESULT.plot()
    drawn = lines(beside)
    assert set(drawn) == {"minimum", "QA", "delta_A", "Q0", "0.1"}
    np.testing.assert_allclose(drawn["minimum"].get_xdata(), [0.0, 1.0, 2.0])
    np.testing.assert_allclose(drawn["minimum"].get_ydata(), CURVE.log_decrement)
    assert drawn["Q0"].get_xdata()[0] == pytest.approx(2.0)
    assert beside.get_title() == "Level II is required"
    (machine,) = lines(screening)["this machine"].get_xydata()
    np.testing.assert_allclose(machine, [70.0, 2.6])
    assert screening.get_xlim()[1] > 70.0


@pytest.mark.parametrize("ratio", [0.5, 0.9, 1.5])
def test_the_letter_of_region_a_is_beside_the_machine(ratio):
    _, screening = replace(RESULT, average_density=8.7, critical_speed_ratio=ratio).plot()
    (letter,) = (text for text in screening.texts if text.get_text() == "A")
    assert abs(letter.get_position()[1] - ratio) > 0.3


def test_margins_in_rpm_and_micrometers():
    peak = ResonancePeak(
        output="mid_x",
        speed=200.0 * np.pi / 30.0,
        peak_amplitude=2e-6,
        amplification_factor=5.0,
        separation_margin=0.0,
        required_margin=0.1,
        acceptable=False,
    )
    result = SeparationMargins(
        verdict="not acceptable",
        acceptable=False,
        minimum_speed=150.0 * np.pi / 30.0,
        maximum_speed=250.0 * np.pi / 30.0,
        peaks=(peak,),
        speeds=np.array([100.0, 200.0, 300.0]) * np.pi / 30.0,
        amplitudes={"mid_x": np.array([1e-6, 2e-6, 1e-6])},
    )
    axes = result.plot()
    np.testing.assert_allclose(lines(axes)["mid_x"].get_xydata(), [[100.0, 1.0], [200.0, 2.0], [300.0, 1.0]])
    assert "not kept" in axes.get_title()
    assert [text.get_text() for text in axes.texts] == ["AF 5, SM 0% of 10%"]
