"""FMI names: one for each signal, and back."""

from dataclasses import dataclass
from operator import attrgetter

import pytest

from rotorfilm import FmuError, JournalBearing, RigidRotor
from rotorfilm.core import Signal, from_fmi_name, names
from rotorfilm.fmu import fmi_variables
from rotorfilm.fmu.description import labelled, structured_name, value_attributes

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
ROTOR = RigidRotor(mass=50.0, speed=157.0, position=(1e-5, -2e-5), velocity=(3e-4, 4e-4))


@dataclass(frozen=True)
class Clashing:
    inputs = (Signal(name="x", unit="m", nominal=1.0, description=""),)
    outputs = (Signal(name="x", unit="m", nominal=1.0, description=""),)
    states = ()


@pytest.mark.parametrize("model", [BEARING, ROTOR])
def test_fmi_names_and_signals_are_a_bijection(model):
    variables = fmi_variables(model, "part", {})
    assert len({v.name for v in variables}) == len(variables)
    expected = [*names(model.inputs), *names(model.outputs), *("state_" + n for n in names(model.states))]
    assert [from_fmi_name(v.name) for v in variables] == [("part", name) for name in expected]
    signals = [*model.inputs, *model.outputs, *model.states]
    said = attrgetter("unit", "nominal", "description", "minimum", "maximum")
    assert [said(v) for v in variables] == [said(s) for s in signals]


def test_states_start_where_the_model_starts():
    variables = fmi_variables(ROTOR, "rotor", {"force_x": 7.0})
    start = {v.name: v.start for v in variables if v.causality != "output"}
    assert start == {
        "rotor.force_x": 7.0,
        "rotor.force_y": 0.0,
        "rotor.state_x": 1e-5,
        "rotor.state_y": -2e-5,
        "rotor.state_vx": 3e-4,
        "rotor.state_vy": 4e-4,
    }


def test_outputs_have_no_start_value():
    assert {v.start for v in fmi_variables(ROTOR, "rotor", {}) if v.causality == "output"} == {None}


def test_bounds_of_a_signal_are_told():
    load = Signal(name="load", unit="N", nominal=1.0, description="", minimum=0.0)
    attributes = value_attributes(labelled("part", "input", load, 2.0))
    assert (attributes["min"], attributes["start"]) == ("0.0", "2.0")
    assert "max" not in attributes


def test_signals_of_equal_name_are_refused():
    with pytest.raises(FmuError, match=r"different names.*'part\.x'"):
        fmi_variables(Clashing(), "part", {})


@pytest.mark.parametrize(
    ("label", "name"),
    [("x", "part.x"), ("u[0]", "part.u[0]"), ("x.1", "part.'x.1'"), ("rotor speed", "part.'rotor speed'")],
)
def test_labels_that_are_no_identifiers_are_spelled_as_fmi_wants(label, name):
    assert structured_name("part", label) == name


@pytest.mark.parametrize("label", ["\u03c9", "it's", 'a"b', "a\nb", ""])
def test_labels_that_fmi_has_no_letters_for_are_refused(label):
    with pytest.raises(FmuError, match="signal names must be of ASCII letters"):
        structured_name("part", label)
