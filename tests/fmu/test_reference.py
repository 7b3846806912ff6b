"""The reference trajectory in an FMU: the model's own outputs, and no row where it has none."""

import control
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rotorfilm import ElasticMaterial, FmuError, JournalBearing, LinearBearing, RigidShaft, mount
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.fmu import from_state_space
from rotorfilm.fmu.reference import reference_table, to_csv
from rotorfilm.rotors import Disk, RigidRotor, ShaftElement, ShaftRotor, Station, Unbalance

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())


def test_rows_of_a_film_are_its_forces():
    table = reference_table(BEARING, np.array([2e-5, -3e-5, 0.0, 0.0, 157.0]), 0.1)
    assert table.shape == (51, 8)
    for row in table:
        np.testing.assert_array_equal(row[6:], BEARING.output(0.0, (), row[1:6]))
    assert np.ptp(table[:, 1:], axis=0).min() > 0.0


def test_a_start_near_the_wall_swings_less():
    table = reference_table(BEARING, np.array([0.99e-4, 0.0, 0.0, 0.0, 157.0]), 0.1)
    assert len(table) == 51
    assert np.hypot(table[:, 1], table[:, 2]).max() < 1e-4


@pytest.mark.closed_form
def test_a_rotor_obeys_the_impulse_theorem():
    rotor = RigidRotor(mass=50.0, speed=157.0)
    table = reference_table(rotor, np.zeros(2), 0.1)
    impulse = np.sum((table[:-1, 1:3] + rotor.static_load) * np.diff(table[:, 0])[:, None], axis=0)
    np.testing.assert_allclose(50.0 * table[-1, 5:7], impulse, rtol=1e-11, atol=1e-9)


def test_an_unstable_system_ends_where_numbers_do():
    system = from_state_space(control.ss(1e5, 1.0, 1.0, 0.0))
    table = reference_table(system, np.zeros(1), 0.1)
    assert 2 <= len(table) < 51
    assert np.isfinite(table).all()


def test_a_model_that_overflows_at_once_is_refused():
    system = from_state_space(control.ss(1e7, 1.0, 1.0, 0.0))
    with pytest.raises(FmuError, match="model must have outputs over a step from its start values"):
        reference_table(system, np.ones(1), 0.1)


def test_csv_reads_back_exactly():
    table = reference_table(BEARING, np.array([2e-5, -3e-5, 0.0, 0.0, 157.0]), 0.1)
    names = ["time", *"abcde", "f,g", "h"]
    header, *lines = to_csv(names, table).decode().splitlines()
    assert header == 'time,a,b,c,d,e,"f,g",h'
    np.testing.assert_array_equal(np.loadtxt(lines, delimiter=","), table)


@pytest.mark.long
def test_the_table_of_a_rotor_on_films_is_that_of_a_plain_integration():
    steel = ElasticMaterial(young_modulus=2.1e11, shear_modulus=8.1e10, density=7800.0)
    rotor = ShaftRotor(
        elements=ShaftElement(length=0.6, outer_diameter=0.05, material=steel).split(2),
        disks=(Disk.solid(1, outer_diameter=0.3, width=0.06, inner_diameter=0.05, density=7800.0),),
        stations=(Station(node=0, name="left"), Station(node=2, name="right")),
        unbalances=(Unbalance(node=1, unbalance=1e-4),),
        speed=157.0,
    )
    model = mount(rotor, {"left": BEARING, "right": BEARING})
    table = reference_table(model, np.zeros(0), 5e-4)
    plain = solve_ivp(
        lambda t, x: model.derivative(t, x, np.zeros(0)),
        (0.0, 5e-4),
        model.initial_state,
        method="Radau",
        jac=lambda t, x: model.linearization(t, x, np.zeros(0)).A,
        t_eval=table[:, 0],
        rtol=1e-7,
        atol=1e-14,
    )
    expected = np.array([model.output(t, x, np.zeros(0)) for t, x in zip(plain.t, plain.y.T, strict=True)])
    largest = np.abs(expected).max(axis=0)
    assert np.abs(table[:, 1:] - expected).max(axis=0) / largest == pytest.approx(0.0, abs=1e-5)


def test_the_table_of_a_rotor_with_inputs_ends_after_a_fifth_of_a_turn():
    rotor = RigidShaft(
        mass=40.0,
        diametral_inertia=1.2,
        polar_inertia=0.9,
        stations=(("left", -0.3), ("right", 0.4)),
        speed=200.0,
    )
    model = mount(rotor, {"left": LinearBearing(stiffness=1e7, damping=1e4)})
    assert model.inputs
    table = reference_table(model, np.zeros(len(model.inputs)), 0.1)
    assert table[-1, 0] == pytest.approx(0.4 * np.pi / 200.0, rel=1e-12)
    assert len(table) == 11
    assert (np.ptp(table[:, 1 : 1 + len(model.inputs)], axis=0) > 0.0).all()


def test_the_table_of_a_large_rotor_ends_after_a_fifth_of_a_turn():
    steel = ElasticMaterial(young_modulus=2.1e11, shear_modulus=8.1e10, density=7800.0)
    rotor = ShaftRotor(
        elements=ShaftElement(length=0.6, outer_diameter=0.05, material=steel).split(26),
        stations=(Station(node=0, name="left"), Station(node=26, name="right")),
        unbalances=(Unbalance(node=13, unbalance=1e-4),),
        speed=157.0,
    )
    model = mount(rotor, {"left": BEARING, "right": BEARING})
    assert len(model.states) > 200
    table = reference_table(model, np.zeros(0), 0.1)
    assert table[-1, 0] == pytest.approx(0.4 * np.pi / 157.0, rel=1e-12)
    assert len(table) == 11
