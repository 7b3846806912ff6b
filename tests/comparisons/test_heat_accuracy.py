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


@pytest.mark.long
@pytest.mark.literature
def test_all_models_of_a_bearing(result):
    """The demonstration's bearing of an independent code in numpy, on 120 x 8 cells and 12 layers."""
    rungs = {rung.family: rung.values for rung in result.rungs}
    for model, (eccentricity, attitude, power, warmest, stiffness) in TABLE.items():
        found = rungs[model]
        assert found["eccentricity ratio [1]"] == pytest.approx(eccentricity, rel=0.01), model
        assert np.degrees(found["attitude angle [rad]"]) == pytest.approx(attitude, abs=0.6), model
        assert found["power loss [W]"] == pytest.approx(power, rel=0.02), model
        assert found["temperature, or largest [K]"] - 273.15 == pytest.approx(warmest, abs=1.5), model
        assert 1e-6 * found["stiffness yy [N/m]"] == pytest.approx(stiffness, rel=0.05), model
    numbers = (found[name] for name in ("thinning x rise E [1]", "Peclet number [1]", "Nahme number [1]"))
    assert tuple(numbers) == pytest.approx((2.9, 20.0, 2.6), rel=0.03)


def test_richer_models_are_closer(result):
    off = {rung.family: rung["error of the position [1]"] for rung in result.rungs}
    cold, balance, bush, layers = (
        off[model] for model in (HeatModel.SUPPLY, HeatModel.BALANCE, HeatModel.BUSH, HeatModel.LAYERS)
    )
    assert cold > 5.0 * balance > 5.0 * bush > 25.0 * layers


def test_the_reference_has_a_row_of_the_table(result):
    table = result.columns()
    assert {len(column) for column in table.values()} == {len(HeatModel) + 1}
    assert table["model [-]"][-1] == "reference"
    assert table["CPU time [s]"][-1] is table["error of the power [1]"][-1] is None
    assert table["power loss [W]"][1] == pytest.approx(262.0, rel=0.02)
