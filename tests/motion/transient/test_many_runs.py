"""Many runs over time: the same digits as alone, and what becomes of one that fails."""

import dataclasses

import numpy as np
import pytest

from rotorfilm import (
    ContactError,
    Groove,
    InputError,
    JeffcottRotor,
    JFOFilm,
    JournalBearing,
    RigidRotor,
    simulate,
)
from rotorfilm.analysis import simulate_many

FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.05)


def runs(unbalances):
    for unbalance in unbalances:
        rotor = JeffcottRotor(mass=90.0, journal_mass=5.0, stiffness=1e7, unbalance=unbalance, speed=200.0)
        yield {"rotor": rotor, "reaction": FILM, "duration": 0.1, "samples": 51}


@pytest.mark.parametrize("workers", [1, 3])
def test_each_run_has_the_digits_it_has_alone(workers):
    sizes = np.linspace(0.0, 3e-3, 7)
    found = simulate_many(runs(sizes), workers=workers)
    for one, given in zip(found, runs(sizes), strict=True):
        alone = simulate(**given)
        assert one.work == alone.work
        for name, row in alone.signals.items():
            np.testing.assert_array_equal(one[name], row)


def test_what_is_kept_comes_in_the_order_of_the_runs():
    sizes = np.linspace(3e-3, 0.0, 5)
    peaks = simulate_many(runs(sizes), keep=lambda run: np.ptp(run["x"][25:]))
    assert list(peaks) == sorted(peaks, reverse=True)


def test_a_run_that_fails_gives_its_error_and_the_others_go_on():
    thrown = RigidRotor(mass=250.0, speed=200.0, static_force=(0.0, -1e9))
    groove = Groove(center=np.pi / 2, width=0.35, length=0.02)
    bearing = dataclasses.replace(FILM, grooves=(groove,), supply_pressure=2e5)
    struck = {"rotor": thrown, "reaction": JFOFilm(bearing=bearing, cells=(24, 4)), "duration": 0.03}
    made = [*runs([0.0]), {**struck, "samples": 9999}, *runs([0.0])]
    found = simulate_many(made)
    assert isinstance(found[1], ContactError)
    assert 1 < len(found[1].partial.time) < 9999
    np.testing.assert_array_equal(found[0]["y"], found[2]["y"])
    with pytest.raises(InputError, match="rotor must"):
        simulate_many([{**made[0], "rotor": None}])
    with pytest.raises(InputError, match=r"runs must have reaction and duration each, got \['rotor'\]"):
        simulate_many([{"rotor": thrown}])
    with pytest.raises(InputError, match=r"runs must be mappings .* got \{1: 2\}"):
        simulate_many([{1: 2}])
    with pytest.raises(InputError, match="workers must be an integer, at least 1, got 0"):
        simulate_many(made, workers=0)
