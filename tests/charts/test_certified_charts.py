"""Charts of certified rotors draw the numbers that they are given."""

import numpy as np
import pytest

from rotorfilm.linear import StabilityCurve, StabilityLevelOne

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
