"""A saved FMU state holds everything: time, inputs and states, to the last bit."""

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from rotorfilm import JournalBearing, RigidRotor
from rotorfilm.fmu import export_fmu

ROTOR = RigidRotor(mass=50.0, speed=157.0, unbalance=8e-4)
FORCE = {"rotor.force_x": 1.0 / 3.0, "rotor.force_y": -np.pi}


@pytest.fixture
def path(tmp_path):
    return export_fmu(ROTOR, tmp_path / "rotor.fmu", backend="python", component="rotor")


@pytest.fixture
def rotor(load, path):
    instance = load(path)
    instance.initialize(FORCE)
    instance.fmu.doStep(0.0, 0.013)
    return instance


def everything(instance):
    return instance.get(*instance.references)


def advanced(instance):
    """Return all variables after some steps from t = 0.013 s."""
    for k in range(3):
        instance.fmu.doStep(0.013 + 0.01 * k, 0.01)
    return everything(instance)


def test_a_restored_state_goes_on_identically(rotor):
    saved = rotor.fmu.getFMUstate()
    before, after = everything(rotor), advanced(rotor)
    rotor.set({"rotor.force_x": 99.0})
    rotor.fmu.setFMUstate(saved)
    assert everything(rotor) == before
    assert advanced(rotor) == after
    rotor.fmu.freeFMUstate(saved)


def test_a_state_can_be_restored_twice(rotor):
    saved = rotor.fmu.getFMUstate()
    before = everything(rotor)
    for _ in range(2):
        advanced(rotor)
        rotor.fmu.setFMUstate(saved)
        assert everything(rotor) == before
    rotor.fmu.freeFMUstate(saved)


def test_a_serialized_state_moves_to_another_instance(rotor, load, path):
    saved = rotor.fmu.getFMUstate()
    data = rotor.fmu.serializeFMUstate(saved)
    rotor.fmu.freeFMUstate(saved)
    other = load(path)
    other.initialize()
    restored = other.fmu.deSerializeFMUstate(data)
    other.fmu.setFMUstate(restored)
    other.fmu.freeFMUstate(restored)
    assert everything(other) == everything(rotor)
    assert advanced(other) == advanced(rotor)


def test_a_state_saved_before_the_start_lets_states_be_set(load, path):
    rotor = load(path)
    saved = rotor.fmu.getFMUstate()
    rotor.initialize(FORCE)
    rotor.fmu.setFMUstate(saved)
    rotor.initialize({"rotor.state_x": 1e-5})
    assert rotor.get("rotor.x", "rotor.force_x") == [1e-5, 0.0]
    rotor.fmu.freeFMUstate(saved)


@pytest.mark.parametrize("data", [b"\xff\xfe", b"{", bytes(4), b'{"tag": "another"}'])
def test_the_state_of_something_else_is_refused(rotor, data):
    state = rotor.fmu.deSerializeFMUstate(data)
    with pytest.raises(FMICallException):
        rotor.fmu.setFMUstate(state)
    assert "the FMU state must come from this FMU" in rotor.log[-1][1]
    rotor.fmu.freeFMUstate(state)


def test_no_damage_of_a_serialized_state_is_accepted(rotor):
    saved = rotor.fmu.getFMUstate()
    before, content = everything(rotor), rotor.fmu.serializeFMUstate(saved)
    for place in range(len(content)):
        wrong = content[:place] + bytes([content[place] ^ 1 << place % 7]) + content[place + 1 :]
        state = rotor.fmu.deSerializeFMUstate(wrong)
        with pytest.raises(FMICallException):
            rotor.fmu.setFMUstate(state)
        rotor.fmu.freeFMUstate(state)
    rotor.fmu.setFMUstate(saved)
    assert everything(rotor) == before
    rotor.fmu.setFMUstate(rotor.fmu.deSerializeFMUstate(content))
    assert everything(rotor) == before


def test_the_state_of_a_film_is_its_input(load, tmp_path):
    bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    film = load(export_fmu(bearing, tmp_path / "film.fmu", backend="python", component="bearing"))
    film.initialize({"bearing.x": 3e-5, "bearing.speed": 157.0})
    saved, force = film.fmu.getFMUstate(), film.get("bearing.force_x")
    film.set({"bearing.x": 5e-5})
    assert film.get("bearing.force_x") != force
    film.fmu.setFMUstate(saved)
    assert film.get("bearing.force_x") == force
    film.fmu.freeFMUstate(saved)
