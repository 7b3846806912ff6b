"""Quantities of bearings with a film: rows of data, and one rung that answers them for every bearing."""

import pytest

from rotorfilm import InputError
from rotorfilm.questions import QUANTITIES, ladder_of
from rotorfilm.questions.film_statics import StaticRung, WhirlRung
from rotorfilm.questions.quantities import TEMPERATURES
from rotorfilm.scenes import read_scene

JOURNAL = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "viscosity": 0.02}
PADS = {"radius": 0.05, "length": 0.05, "assembled_clearance": 7e-5, "viscosity": 0.02}
BEARINGS = {
    "journal": JOURNAL,
    "lobed_journal": {**PADS, "preset": "three_lobe", "preload": 0.5},
    "pressure_dam": {**PADS, "depth": 1.4e-4, "end": 2.5, "share": 0.75},
    "tilting_pad": {**PADS, "preload": 0.3, "pad_count": 5, "loading": "on_pad", "extent": 1.0},
}


def rungs(bearing, quantity):
    data = {
        "schema": 1,
        bearing: BEARINGS[bearing],
        "operation": {"speed": 300.0, "load": 3000.0},
        "rigid_rotor": {"mass": 300.0},
        "question": {"quantity": quantity, "tolerance": 0.01},
    }
    return ladder_of(read_scene(data, "quantities")).rungs


@pytest.mark.parametrize("bearing", BEARINGS)
def test_one_rung_answers_each_quantity_of_every_bearing_with_a_film(bearing):
    unknown = set() if bearing in ("journal", "pressure_dam") else {"maximum_pressure"}
    for quantity in set(QUANTITIES) - set(TEMPERATURES) - unknown:
        asked = rungs(bearing, quantity)
        assert {type(rung) for rung in asked} == {StaticRung}
        assert all(rung.quantity is QUANTITIES[quantity] for rung in asked)
    assert {type(rung) for rung in rungs(bearing, "whirl_threshold")} == {WhirlRung}


@pytest.mark.parametrize("bearing", BEARINGS)
def test_a_temperature_needs_an_oil(bearing):
    with pytest.raises(InputError, match="lubricant must give the oil of the bearing for temperature"):
        rungs(bearing, "temperature")


def test_errors_are_relative_to_the_value_or_its_rise_and_those_of_angles_absolute():
    matrix = QUANTITIES["stiffness"].distance
    assert matrix([[1.0, 2.0], [3.0, 4.0]], [[1.0, 2.0], [3.5, 5.0]], 0.0) == pytest.approx(0.2)
    assert QUANTITIES["minimum_film"].distance(9.0, 10.0, 300.0) == pytest.approx(0.1)
    assert QUANTITIES["attitude_angle"].distance(-0.2, 0.1, 300.0) == pytest.approx(0.3)
    assert QUANTITIES["temperature"].distance(309.0, 310.0, 300.0) == pytest.approx(0.1)
