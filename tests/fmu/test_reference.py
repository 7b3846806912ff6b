"""The reference trajectory in an FMU: the model's own outputs, and no row where it has none."""

import control
import numpy as np
import pytest

from rotorfilm import FmuError, JournalBearing
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.fmu import from_state_space
from rotorfilm.fmu.reference import reference_table, to_csv
from rotorfilm.rotors import RigidRotor

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
