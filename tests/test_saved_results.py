"""Results in a file with a checksum, and back."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import rotorfilm as rf
from rotorfilm.core import load_result, save_result
from rotorfilm.core.files import write_sealed
from rotorfilm.core.saved_results import SETTINGS

BEARING = rf.JournalBearing(
    radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, grooves=(rf.Groove(center=1.5, width=0.2),)
)
STEEL = rf.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
ROTOR = rf.ShaftRotor(
    elements=rf.ShaftElement(length=1.2, outer_diameter=0.05, material=STEEL).split(4),
    stations=(rf.Station(node=0, name="left"), rf.Station(node=4, name="right")),
    disks=(rf.Disk.solid(2, density=7810.0, width=0.07, outer_diameter=0.28),),
    unbalances=(rf.Unbalance(node=2, unbalance=1e-4),),
    speed=100.0,
)
SPRINGS = dict.fromkeys(("left", "right"), rf.LinearBearing(stiffness=1e7, damping=1e4))


def test_results_and_inputs_come_back_as_they_were(tmp_path):
    film = rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    at = rf.equilibrium(film, load=(0.0, -525.0), speed=157.08)
    modes = rf.rotor_modes(ROTOR, SPRINGS, 100.0)
    chart = rf.campbell(ROTOR, SPRINGS, [100.0, 200.0], 600.0)
    for number, one in enumerate(
        (at, rf.coefficients(film, at.position, at.speed), modes, chart, BEARING, ROTOR)
    ):
        again = load_result(save_result(one, tmp_path / f"{number}.json"))
        assert type(again) is type(one)
        assert str(again) == str(one)
    again = load_result(tmp_path / "0.json")
    assert again.losses.power_loss == at.losses.power_loss
    assert_array_equal(load_result(tmp_path / "2.json").shapes, modes.shapes)
    assert load_result(tmp_path / "4.json") == BEARING


def test_a_run_and_a_response_come_back(tmp_path):
    time = np.linspace(0.0, 1.0, 5)
    run = rf.Trajectory(time=time, signals={"x": time**2, "y": -time}, work={"steps": 4}, units={"x": "m"})
    again = load_result(save_result(run, tmp_path / "run.json"))
    assert_array_equal(again["x"], run["x"])
    assert (again.work, again.units, again.step_error) == ({"steps": 4}, {"x": "m"}, None)
    response = rf.unbalance_response(ROTOR, SPRINGS, [100.0, 200.0])
    again = load_result(save_result(response, tmp_path / "response.json"))
    assert_array_equal(again.frdata, response.frdata)
    assert (list(again.output_labels), list(again.omega)) == (response.output_labels, [100.0, 200.0])


@pytest.mark.parametrize("kind", [">f8", "<f8", ">c16", "i4", "?"])
def test_arrays_of_any_byte_order_keep_their_numbers(kind, tmp_path):
    array = np.array([[1, 0], [3, 5]]).astype(kind)
    assert_array_equal(load_result(save_result(array, tmp_path / "a.json")), array)


def test_what_is_no_result_and_what_is_damaged_is_refused(tmp_path):
    with pytest.raises(rf.InputError, match=r"Trajectory.signals\['x'\] must be a number, an array"):
        save_result(rf.Trajectory(time=np.zeros(1), signals={"x": len}, work={}), tmp_path / "a.json")
    path = save_result(BEARING, tmp_path / "b.json")
    content = path.read_bytes()
    path.write_bytes(content.replace(b"0.05", b"0.06", 1))
    with pytest.raises(rf.InputError, match="must have the checksum"):
        load_result(path)
    foreign = b'{"=": "object", "module": "os", "name": "system", "of": {}}'
    with pytest.raises(rf.InputError, match=r"path must hold objects of rotorfilm, got os.system"):
        load_result(write_sealed(path, foreign, SETTINGS))
