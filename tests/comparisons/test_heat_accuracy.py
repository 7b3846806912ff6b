"""Models of heat side by side, against the table of an independent code."""

import numpy as np
import pytest

from rotorfilm.studies import HEAT_CASES, HeatModel, heat_accuracy

TEXTBOOK = HEAT_CASES[0]
# eccentricity ratio, attitude [deg], power [W], T or T_max [degC], K_yy [MN/m]
TABLE = {
    HeatModel.SUPPLY: (0.273, 70.5, 548.0, 37.1, 8.5),
    HeatModel.BALANCE: (0.440, 58.6, 262.0, 52.5, 12.3),
    HeatModel.HOUSING: (0.431, 59.3, 272.0, 51.7, 12.0),
    HeatModel.ADIABATIC: (0.441, 61.9, 236.0, 64.1, 12.5),
    HeatModel.BUSH: (0.439, 62.5, 254.0, 57.4, 12.2),
    HeatModel.LAYERS: (0.458, 61.2, 260.0, 58.3, 12.7),
}


@pytest.fixture(scope="module")
def result():
    return heat_accuracy((TEXTBOOK,), cells=(96, 8), layers=14)


@pytest.mark.literature
def test_all_models_of_a_bearing(result):
    """The demonstration's bearing of an independent code in numpy, on 120 x 8 cells and 12 layers."""
    (ladder,) = result.ladders
    for rung in ladder.rungs:
        eccentricity, attitude, power, warmest, stiffness = TABLE[rung.model]
        assert rung.answer.eccentricity_ratio == pytest.approx(eccentricity, rel=0.01), rung.model
        assert np.degrees(rung.answer.attitude_angle) == pytest.approx(attitude, abs=0.6), rung.model
        assert rung.answer.power_loss == pytest.approx(power, rel=0.02), rung.model
        assert rung.answer.temperature - 273.15 == pytest.approx(warmest, abs=1.5), rung.model
        assert 1e-6 * rung.answer.load_stiffness == pytest.approx(stiffness, rel=0.05), rung.model
    E, Pe, Na = ladder.numbers
    assert (E, Pe, Na) == pytest.approx((2.9, 20.0, 2.6), rel=0.03)


def test_richer_models_are_closer(result):
    (ladder,) = result.ladders
    off = {rung.model: rung.position_error for rung in ladder.rungs}
    cold, balance, bush, layers = (
        off[model] for model in (HeatModel.SUPPLY, HeatModel.BALANCE, HeatModel.BUSH, HeatModel.LAYERS)
    )
    assert cold > 5.0 * balance > 5.0 * bush > 25.0 * layers


def test_table_and_summary(result):
    table = result.columns()
    assert {len(column) for column in table.values()} == {len(HeatModel) + 1}
    assert table["model [-]"][-1] == "reference"
    assert table["CPU time [s]"][-1] is None
    summary = result.summary()
    assert summary["model"][0] == TEXTBOOK.name
    assert summary["model"][1] == "  T0"
    assert summary["T [degC]"][1] == "37.1"
    assert summary["power [W]"][0] == summary["time [ms]"][-1] == ""
    assert float(summary["power [W]"][2]) == pytest.approx(262.0, rel=0.02)
