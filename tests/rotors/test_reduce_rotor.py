"""Reduced rotors against the whole ones."""

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import Dynamic, InputError, LinearBearing
from rotorfilm.core import names
from rotorfilm.rotors import (
    Disk,
    ElasticMaterial,
    JeffcottRotor,
    Probe,
    ReducedRotor,
    ShaftElement,
    ShaftRotor,
    Station,
    Support,
    Unbalance,
    mount,
    reduce_rotor,
)
from rotorfilm.rotors.reduced_rotor import POINTS, _felt

STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
FREQUENCY = 800.0


def shaft(**changes):
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    support = Support(mass=7.0, stiffness=((3e7, 1e6), (2e6, 4e7)), damping=500.0)
    parts = {
        "elements": ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL).split(6),
        "disks": (Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
        "stations": (Station(node=0, name="left", support=support), Station(node=6)),
        "unbalances": (
            Unbalance(node=2, unbalance=1e-3),
            Unbalance(node=4, unbalance=2e-3, unbalance_angle=1),
        ),
        "probes": (Probe(node=2, name="small"),),
        "internal_damping": 1e-5,
        "speed": 400.0,
    }
    return ShaftRotor(**(parts | changes))


def on_bearings(rotor):
    film = LinearBearing(stiffness=((1.3e7, 1.6e7), (-2.5e7, 9e6)), damping=((2e5, 1e4), (1e4, 3e5)))
    return mount(rotor, dict.fromkeys(rotor.structure.stations, film))


def whirls(rotor):
    model = on_bearings(rotor)
    roots = np.linalg.eigvals(model.linearization(0.0, model.initial_state, []).A)
    slow = roots[(roots.imag > 1.0) & (np.abs(roots) < FREQUENCY)]
    return slow[np.argsort(slow.imag)]


@pytest.fixture(scope="module")
def reduced():
    return reduce_rotor(shaft(), frequency=FREQUENCY, tolerance=1e-3)


def test_it_is_the_same_rotor_to_its_surroundings(reduced):
    small, full = reduced.rotor, shaft()
    assert isinstance(small, Dynamic)
    assert names(small.inputs) == names(full.inputs)
    assert names(small.outputs) == names(full.outputs)
    assert len(small.states) <= len(full.states) / 2
    assert len(set(names(small.states))) == len(small.states)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_eigenvalues_on_bearings_are_within_the_tolerance(tolerance):
    reduction = reduce_rotor(shaft(), frequency=FREQUENCY, tolerance=tolerance)
    assert 0.0 < reduction.error <= tolerance
    one, other = whirls(shaft()), whirls(reduction.rotor)
    assert len(one) >= 6
    assert_allclose(other, one, rtol=tolerance)


def test_more_modes_make_less_error(reduced):
    errors = [reduce_rotor(shaft(), frequency=FREQUENCY, tolerance=t).error for t in (1e-1, 1e-3, 1e-5)]
    assert errors[0] > errors[1] > errors[2]


@pytest.mark.closed_form
def test_it_counts_its_work(reduced, monkeypatch):
    """Beside the calls themselves: the whole rotor is solved once at each frequency."""
    calls = []
    own = _felt
    monkeypatch.setattr("rotorfilm.rotors.reduced_rotor._felt", lambda *a: calls.append(a[0]) or own(*a))
    found = reduce_rotor(shaft(), frequency=FREQUENCY)
    assert found.work == {"eigenproblems": found.rotor.modes + 1, "solutions": len(calls)}
    assert sum(len(one.weight) == len(shaft().structure.weight) for one in calls) == 2 * POINTS


def test_static_deflection_is_exact():
    """Also with no modes at all: the shapes under the weight and under slow motion are in the basis."""
    full = shaft(speed=0.0)
    small = ReducedRotor(rotor=full, modes=0, speed=0.0, gravity=full.gravity)
    rest = []
    for rotor in (full, small):
        model = on_bearings(rotor)
        zero = np.zeros(len(model.states))
        state = -np.linalg.solve(model.linearization(0.0, zero, []).A, model.derivative(0.0, zero, []))
        rest.append(model.output(0.0, state, []))
    scale = np.array([signal.nominal for signal in on_bearings(full).outputs])
    assert_allclose(rest[1] / scale, rest[0] / scale, atol=1e-7)


@pytest.mark.closed_form
def test_with_all_modes_nothing_is_lost():
    """The whole space in other coordinates."""
    support = Support(mass=7.0, stiffness=3e7)
    full = shaft(
        elements=ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL).split(4),
        disks=(Disk(node=2, mass=20.0, diametral_inertia=0.3, polar_inertia=0.5),),
        stations=(Station(node=0, name="left", support=support), Station(node=4)),
        unbalances=(Unbalance(node=2, unbalance=1e-3),),
    )
    most = len(full.structure.coordinates) - 3
    small = ReducedRotor(rotor=full, modes=most, speed=400.0, gravity=full.gravity)
    assert len(small.states) == len(full.states)
    assert_allclose(whirls(small), whirls(full), rtol=1e-6)


@pytest.mark.closed_form
def test_round_off_does_not_turn_the_shapes():
    """As much more mass as stiffness: the same shapes, from numbers rounded otherwise.

    The shape under the weight is all but 5e-5 in the lowest five modes, so it multiplies their round-off by
    2e4; that of modes whose own error grows with the highest frequency would reach 1e-9.
    """

    def basis(factor):
        material = ElasticMaterial(
            young_modulus=factor * 211e9, shear_modulus=factor * 81.2e9, density=factor * 7810.0
        )
        disk = {"density": factor * 7810.0, "width": 0.07, "inner_diameter": 0.05}
        rotor = shaft(
            elements=ShaftElement(length=1.5, outer_diameter=0.05, material=material).split(6),
            disks=(Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
            stations=(Station(node=0, name="left"), Station(node=6)),
            unbalances=(Unbalance(node=2, unbalance=1e-3),),
        )
        shapes = ReducedRotor(rotor=rotor, modes=5, speed=0.0, gravity=rotor.gravity).basis
        return shapes * np.sign(shapes[np.abs(shapes).argmax(axis=0), range(shapes.shape[1])])

    for factor in (3.0, 5.0, 7.0, 11.0):
        assert_allclose(basis(factor), basis(1.0), atol=3e-11)


def test_speed_is_its_own(reduced):
    other = dataclasses.replace(reduced.rotor, speed=100.0)
    assert_allclose(whirls(other), whirls(shaft(speed=100.0)), rtol=1e-3)


def test_rotor_that_is_not_held_is_refused():
    jeffcott = JeffcottRotor(mass=1.0, journal_mass=0.1, stiffness=1e5, speed=0.0)
    assert reduce_rotor(jeffcott, frequency=100.0, tolerance=1e-3).rotor.modes <= 1
    with pytest.raises(InputError, match="stations must hold the rotor, got 1"):
        reduce_rotor(shaft(stations=(Station(node=0),)), frequency=100.0)


def test_bad_arguments_are_named():
    with pytest.raises(InputError, match="tolerance must be finite and positive, got 0"):
        reduce_rotor(shaft(), frequency=1.0, tolerance=0)
    with pytest.raises(InputError, match="modes must be an integer from 0 to"):
        ReducedRotor(rotor=shaft(), modes=-1, speed=0.0, gravity=shaft().gravity)
    with pytest.raises(InputError, match="gravity must be that of the rotor"):
        ReducedRotor(rotor=shaft(), modes=1, speed=0.0, gravity=(0.0, 0.0))
