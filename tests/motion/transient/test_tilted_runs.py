"""Compiled runs of shafts in journals that feel their tilt: scipy, planar journals, contact of an end."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import Radau

import rotorfilm as rf
from rotorfilm import ContactError
from rotorfilm.analysis import simulate, simulate_rotor
from rotorfilm.bearings.journal import MomentCarryingJournal, TiltLevel

STEEL = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8e10, density=7850.0)
PIECE = rf.ShaftElement(length=0.5, outer_diameter=0.05, material=STEEL)
ROTOR = rf.ShaftRotor(
    elements=(PIECE, PIECE),
    disks=(rf.Disk(node=1, mass=40.0, diametral_inertia=0.2, polar_inertia=0.4),),
    stations=tuple(rf.Station(node=2 * k, name=name, feels_tilt=True) for k, name in enumerate(("a", "b"))),
    unbalances=(rf.Unbalance(node=1, unbalance=2e-3),),
    speed=300.0,
)
PLAIN = rf.JournalBearing(radius=0.025, length=0.03, clearance=1e-4, viscosity=0.05)
CLOSED = MomentCarryingJournal(bearing=PLAIN, level=TiltLevel.CLOSED_FORM)


@pytest.mark.parametrize(
    "bearings",
    [
        {"a": CLOSED, "b": replace(CLOSED, level=TiltLevel.NONE)},
        {"a": replace(CLOSED, bush_offset=(1e-5, 0.0), bush_tilt=(2e-4, 0.0)), "b": CLOSED},
    ],
    ids=["levels", "misaligned"],
)
def test_a_compiled_run_is_that_of_scipy(bearings):
    found, other = (
        simulate(ROTOR, bearings, duration=2e-4, samples=5, rtol=rtol, method=method)
        for rtol, method in ((1e-9, None), (1e-7, Radau))
    )
    assert "rejected" in found.work  # counted by the compiled run alone
    assert list(found.signals) == list(other.signals)
    for name, size in {"a_x": 1e-4, "b_tilt_y": 1e-3, "a_moment_x": 1.0, "b_force_y": 200.0}.items():
        np.testing.assert_allclose(found[name], other[name], rtol=0.0, atol=1e-4 * size)
    assert np.ptp(found["a_tilt_x"]) > 1e-9


def test_a_bearing_without_tilt_stands_beside_one_with_it():
    """A journal that leaves its tilt out is a planar one, in a rotor whose other journal tilts."""
    stations = (ROTOR.stations[0], replace(ROTOR.stations[1], feels_tilt=False))
    planar = simulate(replace(ROTOR, stations=stations), {"a": CLOSED, "b": PLAIN}, duration=0.02, samples=21)
    both = {"a": CLOSED, "b": replace(CLOSED, level=TiltLevel.NONE)}
    tilted = simulate(ROTOR, both, duration=0.02, samples=21)
    for name in ("a_x", "a_tilt_x", "b_y"):
        np.testing.assert_allclose(planar[name], tilted[name], rtol=1e-5, atol=1e-9)


def test_an_aligned_run_does_not_change():
    """With no moment the motion is that of planar journals, by the code of planar ones."""
    flat = replace(ROTOR, stations=tuple(replace(one, feels_tilt=False) for one in ROTOR.stations))
    planar = simulate(flat, {"a": PLAIN, "b": PLAIN}, duration=0.05, samples=21)
    none = replace(CLOSED, level=TiltLevel.NONE)
    tilted = simulate(ROTOR, {"a": none, "b": none}, duration=0.05, samples=21)
    np.testing.assert_allclose(planar["b_x"], tilted["b_x"], rtol=0.0, atol=1e-10)


def test_an_end_that_touches_ends_the_run():
    wide = replace(ROTOR, unbalances=(rf.Unbalance(node=1, unbalance=0.1),))
    bearings = {"a": CLOSED, "b": CLOSED}
    with pytest.raises(ContactError) as failure:
        simulate_rotor(rf.mount(wide, bearings), duration=0.1, samples=2001)
    run = failure.value.partial
    place = [run[f"a_{name}"][-1] for name in CLOSED.freedoms]
    middle = 1e-4 - np.hypot(*place[:2])
    assert 0.0 < CLOSED.minimum_film(place) < 0.3 * middle
