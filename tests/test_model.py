"""Model: the protocols tell models from other things, and the signals of a Reaction are fixed."""

import numpy as np
import pytest

from rotorfilm import Dynamic, InputError, Model, Reaction, Stepped
from rotorfilm.bearings.journal import JournalBearing
from rotorfilm.core import (
    FORCE_OUTPUTS,
    JOURNAL_INPUTS,
    force_outputs,
    indices,
    journal_inputs,
    names,
    static_linearization,
    stops,
)
from rotorfilm.core.port import require_reaction
from rotorfilm.rotors import RigidRotor, SpeedProfile

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
ROTOR = RigidRotor(mass=50.0, speed=100.0)


def test_bearing_is_a_reaction_without_states():
    assert isinstance(BEARING, Reaction)
    assert isinstance(BEARING, Model)
    assert not isinstance(BEARING, Dynamic)
    assert not isinstance(BEARING, Stepped)
    assert BEARING.states == ()


def test_rotor_is_dynamic_and_no_reaction():
    assert isinstance(ROTOR, Dynamic)
    with pytest.raises(InputError, match=r"reaction must have no inputs but .*speed.*, got .*force_x"):
        require_reaction("reaction", ROTOR)
    assert len(ROTOR.states) == len(ROTOR.initial_state)


def test_rotor_and_bearing_fit_together():
    assert names(ROTOR.outputs) == names(BEARING.inputs) == list(JOURNAL_INPUTS)
    assert names(BEARING.outputs) == names(ROTOR.inputs) == list(FORCE_OUTPUTS)
    assert [s.unit for s in ROTOR.outputs] == [s.unit for s in BEARING.inputs]
    assert [s.unit for s in BEARING.outputs] == [s.unit for s in ROTOR.inputs]


def test_signals_of_a_reaction():
    inputs = journal_inputs(clearance=1e-4, nominal_speed=200.0)
    assert [(s.name, s.unit, s.nominal) for s in inputs] == [
        ("x", "m", 1e-4),
        ("y", "m", 1e-4),
        ("vx", "m/s", pytest.approx(0.02)),
        ("vy", "m/s", pytest.approx(0.02)),
        ("speed", "rad/s", 200.0),
    ]
    assert [(s.name, s.unit, s.nominal) for s in force_outputs(300.0)] == [
        ("force_x", "N", 300.0),
        ("force_y", "N", 300.0),
    ]


def test_negative_clearance_gives_no_signals():
    with pytest.raises(InputError, match=r"nominal must be finite and positive, got -0\.0001"):
        journal_inputs(clearance=-1e-4, nominal_speed=200.0)


def test_static_linearization_is_all_feedthrough():
    D = np.arange(10.0).reshape(2, 5)
    A, B, C, feedthrough = static_linearization(D)
    assert (A.shape, B.shape, C.shape) == ((0, 0), (0, 5), (2, 0))
    np.testing.assert_array_equal(feedthrough, D)


def test_signals_are_found_by_name_in_any_order():
    assert indices("rotor must have the outputs", ["b", "c", "a"], ("a", "b")) == [2, 0]


def test_missing_signals_are_named():
    with pytest.raises(InputError) as caught:
        indices("rotor must have the outputs", ["x", "vx"], ("x", "y", "vx", "vy"))
    assert str(caught.value) == (
        "rotor must have the outputs ['x', 'y', 'vx', 'vy'], got ['x', 'vx'] without ['y', 'vy']"
    )


def test_integration_stops_at_the_kinks_inside_and_at_the_end():
    ramp = RigidRotor(mass=1.0, speed=SpeedProfile(times=(0.5, 1.0, 2.0), speeds=(0.0, 10.0, 0.0)))
    assert ramp.breakpoints == (0.5, 1.0, 2.0)
    assert stops(ramp, 0.5, 2.0) == [1.0, 2.0]
    assert stops(ramp, 0.0, 3.0) == [0.5, 1.0, 2.0, 3.0]
    assert stops(ramp, 0.6, 0.9) == [0.9]


def test_a_model_without_kinks_stops_at_the_end_only():
    assert not hasattr(BEARING, "breakpoints")
    assert stops(BEARING, 0.0, 3.0) == [3.0]
