"""Orbits of shafts in few of their shapes against those of all coordinates."""

import sys
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import JournalBearing, LinearBearing, Unbalance, mount, periodic_orbit
from rotorfilm.analysis.modal_reduction import counted, models
from rotorfilm.rotors import Station

from ...linear.test_big_rotors import long_rotor

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
SEARCH = "rotorfilm.analysis.periodic_orbit"


def mounted(count, speed=150.0, unbalance=3e-3):
    rotor = long_rotor(count, speed=speed, unbalances=(Unbalance(node=count // 3, unbalance=unbalance),))
    return mount(rotor, {"left": BEARING, "right": BEARING})


def test_an_orbit_in_few_shapes_is_that_of_the_whole_shaft(monkeypatch):
    few = periodic_orbit(mounted(6))
    monkeypatch.setattr(sys.modules[SEARCH], "_model", lambda rotor, level: None)
    whole = periodic_orbit(mounted(6))
    assert len(few.multipliers) < len(whole.multipliers) == len(few.state)
    assert few.amplitude > 0.03
    assert few.residual <= 1e-7
    assert few.series / 1e-4 == pytest.approx(whole.series / 1e-4, abs=1e-8)
    assert few.state == pytest.approx(whole.state, abs=1e-6 * np.abs(whole.state).max())
    assert len(few.multipliers) >= 8
    for one in few.multipliers:  # those of fast motion of the whole shaft are larger
        assert np.abs(whole.multipliers - one).min() < 1e-6


def test_more_shapes_are_taken_until_the_whole_shaft_is_in_balance(monkeypatch):
    wanted, asked = periodic_orbit(mounted(12)), []

    def poor(rotor, level):
        asked.append(level)
        return next(models(rotor, 10.0 if level == 0 else 1e4, 24))

    monkeypatch.setattr(sys.modules[SEARCH], "_model", poor)
    found = periodic_orbit(mounted(12), tolerance=1e-10)
    assert asked == [0, 1]
    assert found.residual <= 1e-10
    times = np.linspace(0.0, wanted.period, 16)
    assert found.position(times) / 1e-4 == pytest.approx(wanted.position(times) / 1e-4, abs=1e-7)


def test_a_bearing_that_drives_fast_motions_makes_the_orbit_of_the_whole_shaft_unstable():
    """The lower modes decay: damping that is negative drives those of high frequency first."""
    rotor = mounted(8).bare
    rotor = replace(rotor, stations=(*rotor.stations, Station(node=4, name="seal")))
    bearings = {"left": BEARING, "right": BEARING, "seal": LinearBearing(stiffness=0.0, damping=-100.0)}
    orbit = periodic_orbit(mount(rotor, bearings))
    assert not orbit.stable
    cross = LinearBearing(stiffness=((0.0, 5e4), (-5e4, 0.0)), damping=100.0)
    calm = periodic_orbit(mount(rotor, bearings | {"seal": cross}))
    assert len(calm.multipliers) < len(orbit.multipliers) == len(orbit.state)


def test_the_work_of_an_orbit_does_not_grow_with_the_coordinates():
    """Each harmonic is solved once in all coordinates for its balance, and once for the state."""
    periodic_orbit(mounted(24))
    with counted("factorizations") as work:
        orbit = periodic_orbit(mounted(24, speed=151.0))
    assert work["factorizations"] <= 2 * (orbit.harmonics + 1) + 3


def test_shafts_of_the_same_parts_share_their_matrices():
    slow, fast, other = (long_rotor(4, speed=w) for w in (1.0, 2.0, 1.0))
    assert slow.assembly is fast.assembly is other.assembly
    assert long_rotor(4, internal_damping=1e-6).assembly is not slow.assembly
    weight = fast.structure.weight.copy()
    slow.structure.weight[:] = 0.0
    assert (fast.structure.weight == weight).all()
