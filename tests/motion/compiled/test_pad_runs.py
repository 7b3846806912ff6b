"""Tilting pads in the compiled integration: scipy's motion, linear theory, pads that lose their film."""

import math
import sys
from ctypes import CFUNCTYPE, c_int, c_void_p
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import DOP853, Radau

import rotorfilm as rf
from rotorfilm.analysis.compiled_rotor import takes_forces
from rotorfilm.analysis.force_calls import film_samples
from rotorfilm.rotors import MotorDrivenRotor

from .beside_scipy import HEAVY_OIL, MOTOR, SEAL, cracked, long_shaft, require_same_motion

PADS = rf.TiltingPadBearing(
    radius=0.05,
    length=0.05,
    viscosity=0.02,
    pivots=rf.even_pivots(4, between_pads=True),
    extent=math.radians(75.0),
    preload=0.3,
    assembled_clearance=7e-5,
)
SPRUNG = replace(PADS, pivot_stiffness=3e8)
HEAVY = replace(PADS, pad_inertia=2e-4, pivot_distance=0.02)
HEAVY_ON_SPRINGS = replace(PADS, pivot_stiffness=3e8, pad_inertia=2e-4, pad_mass=0.4)
PLAIN = rf.JournalBearing(radius=0.04, length=0.04, clearance=8e-5, viscosity=0.02, film=rf.ShortFilm())
WARM = replace(PLAIN, viscosity=None, oil=rf.Oil.iso_vg(32), cooling=rf.Cooling(supply_temperature=313.15))
PROFILE = rf.SpeedProfile(times=(0.0, 0.01), speeds=(300.0, 420.0))
RIGID = rf.RigidRotor(mass=60.0, speed=PROFILE, unbalance=5e-4)
SHAFT = rf.RigidShaft(
    mass=80.0,
    diametral_inertia=1.2,
    polar_inertia=0.9,
    stations=(("left", -0.3), ("right", 0.4)),
    unbalances=((0.1, 1e-3, 0.0),),
    speed=PROFILE,
)
THREE = replace(SHAFT, stations=(*SHAFT.stations, ("mid", 0.1), ("seal", 0.2)))

CASES = {
    "rigid pivots": (RIGID, {"": PADS}, DOP853),
    "pivots on springs": (RIGID, {"": SPRUNG}, DOP853),
    "inertia": (RIGID, {"": HEAVY}, Radau),
    "inertia on springs": (RIGID, {"": HEAVY_ON_SPRINGS}, Radau),
    "gyroscopic, beside a warm film": (SHAFT, {"left": PADS, "right": WARM}, DOP853),
    "beside a film without states": (SHAFT, {"left": PLAIN, "right": SPRUNG}, DOP853),
    "motor": (
        MotorDrivenRotor(rotor=replace(SHAFT, speed=300.0), inertia=0.05, torque=MOTOR),
        {"left": PADS, "right": PADS},
        DOP853,
    ),
    "crack": (cracked(PROFILE), {"": PADS}, DOP853),
    "stations in another order": (SHAFT, {"right": SPRUNG, "left": PADS}, DOP853),
    "added mass and linear states": (
        THREE,
        {"left": PADS, "mid": HEAVY_OIL, "seal": SEAL, "right": WARM},
        Radau,
    ),
    "turning backward": (replace(RIGID, speed=-400.0), {"": PADS}, DOP853),
    "through standstill": (
        replace(RIGID, speed=rf.SpeedProfile(times=(0.0, 0.01), speeds=(40.0, -40.0))),
        {"": SPRUNG},
        DOP853,
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_the_compiled_motion_is_that_of_scipy(case):
    # Displacements, forces, loads and tilts within 1e-6 of their changes over the run.
    rotor, bearings, method = CASES[case]
    settings = {"duration": 0.01, "samples": 21}
    run = rf.simulate(rotor, bearings, rtol=1e-10, **settings)
    reference = rf.simulate(
        rotor, bearings, rtol=1e-9 if method is Radau else 1e-12, method=method, **settings
    )
    require_same_motion(run, reference, 1e-6)


def test_a_shaft_of_many_elements_is_condensed_and_its_shapes_are_tried(monkeypatch):
    mounted = rf.mount(long_shaft(20, PROFILE), {"left": PADS, "right": SPRUNG})
    settings = {"duration": 0.01, "samples": 21, "rtol": 1e-6}
    few, whole = (rf.simulate_rotor(mounted, condensation=share, **settings) for share in (1e-5, 0.0))
    for name in ("left_x", "right_y", "left_tilt_1", "right_pivot_2"):
        assert np.abs(few[name] - whole[name]).max() < 2e-5 * PADS.clearance, name
    monkeypatch.setattr(sys.modules["rotorfilm.analysis.condensed_runs"], "TRIAL_SHARE", 1.0)
    tried = rf.simulate_rotor(mounted, condensation=1e-5, **settings)
    assert few.work["steps"] < 0.8 * tried.work["steps"]


@pytest.mark.parametrize("bearing", [PADS, SPRUNG], ids=["rigid pivots", "springs"])
def test_rates_near_the_solution_save_the_search_and_change_nothing(bearing):
    """One step of Newton's method from there: an error of the square of the distance."""
    n, call = len(bearing.states), bearing.call_with_states()
    state = bearing.initial_state - 1e-6 * np.array(
        [k * ("pivot" in s.name) for k, s in enumerate(bearing.states)]
    )
    film = CFUNCTYPE(c_int, c_void_p, c_void_p, c_void_p, c_void_p)(call.address)

    def asked(near):
        given = np.concatenate([[1e-5, -2e-5, 2e-3, -1e-3, 300.0], state, near])
        answer, slopes = np.empty(2 + n), np.empty((2 + n, 5 + n))
        assert film(call.data, *(one.ctypes.data for one in (given, answer, slopes))) == 0
        return answer, slopes

    exact, slopes = asked(np.full(n, np.nan))
    size = 300.0 * bearing.clearance
    for off in (0.0, 1e-9, 1e-6, 1e-3, 10.0):
        found, by = asked(exact[2:] + off * size)
        error = np.abs(found - exact)
        assert error[2:].max() < (1e-11 + 10.0 * min(off, 1e-4) ** 2) * size
        assert error[:2].max() < (1e-11 + 10.0 * min(off, 1e-4) ** 2) * np.abs(exact[:2]).max()
        assert np.abs(by - slopes).max() < (1e-9 + 10.0 * min(off, 1e-4)) * np.abs(slopes).max()


def test_pads_with_inertia_at_rest_have_no_slopes_and_can_start():
    at_rest = np.concatenate([np.zeros(4), HEAVY.initial_state])
    assert film_samples(HEAVY, at_rest[:, None], 0.0) is None
    floating = rf.RigidRotor(mass=60.0, speed=0.0, gravity=(0.0, 0.0))
    run = rf.simulate(floating, HEAVY, duration=1e-3, samples=3)
    assert "rejected" in run.work
    assert np.abs(run["x"]).max() < 1e-12


def test_the_error_falls_with_the_tolerance():
    exact = rf.simulate(RIGID, SPRUNG, duration=0.01, rtol=1e-12)
    for rtol in (1e-4, 1e-6, 1e-8, 1e-10):
        run = rf.simulate(RIGID, SPRUNG, duration=0.01, rtol=rtol)
        for name in ("x", "y", "tilt_1", "pivot_3"):
            assert np.abs(run[name] - exact[name]).max() < PADS.clearance * rtol, name


@pytest.mark.parametrize("bearing", [PADS, HEAVY_ON_SPRINGS], ids=["rigid pivots", "inertia on springs"])
def test_small_motion_decays_as_linear_theory_says(bearing):
    # About rest a small start along the slowest mode decays by its exponent.
    rotor = rf.RigidRotor(mass=200.0, speed=400.0)
    at = rf.equilibrium(bearing, (0.0, -200.0 * 9.80665), 400.0)
    rest = np.array([*at.position, 0.0, 0.0, *bearing.rest_state(at.position, 400.0)])
    mounted = rf.mount(rotor, {"": bearing})
    A = mounted.linearization(0.0, rest, np.zeros(0)).A
    values, shapes = np.linalg.eig(A)
    slow = int(np.argmax(values.real))
    shape = shapes[:, slow] / shapes[:2, slow][np.argmax(np.abs(shapes[:2, slow]))]
    size = 1e-5 * bearing.clearance
    start = rest + size * shape.real
    run = rf.simulate_rotor(mounted, duration=0.01, samples=11, initial_state=start, rtol=1e-12)
    waves = size * (np.exp(values[slow] * run.time)[:, None] * shape[:2]).real
    found = np.array([run["x"], run["y"]]).T - at.position
    assert np.abs(found - waves).max() < 1e-4 * size


def test_pads_that_lose_their_film_and_find_it_again_do_not_stop_a_run():
    rotor = rf.RigidRotor(mass=30.0, speed=400.0, unbalance=1.5e-2)
    run = rf.simulate(rotor, HEAVY_ON_SPRINGS, duration=0.05, rtol=1e-7)
    loads = np.array([run[f"load_{k}"] for k in range(1, 5)])
    assert (loads == 0.0).any()
    assert loads.min() >= 0.0
    assert loads.max() > 5.0 * 30.0 * 9.80665


@pytest.mark.filterwarnings("ignore::rotorfilm.ValidityWarning")
def test_a_shaft_that_hits_a_pad_ends_the_run_and_keeps_it():
    rotor = rf.RigidRotor(mass=30.0, speed=400.0, unbalance=0.2)
    with pytest.raises(rf.ContactError, match="journal reached the wall at t = ") as hit:
        rf.simulate(rotor, SPRUNG, duration=0.05)
    run = hit.value.partial
    assert 0.0 < run.time[-1] < 0.01
    gone = SPRUNG.clearance - SPRUNG.minimum_film(np.array([run["x"][-1], run["y"][-1]]))
    assert gone > SPRUNG.bore_clearance  # a pivot gives way before a pad is touched


GIVEN = "radius", "length", "viscosity", "pivots", "extent", "preload", "assembled_clearance"


class InPython(rf.TiltingPadBearing):
    """Pads whose equations a subclass may have changed."""


def test_a_subclass_is_left_to_scipy():
    own = InPython(**{name: getattr(PADS, name) for name in GIVEN})
    assert takes_forces(RIGID, [PADS])
    assert not takes_forces(RIGID, [own])
    assert "rejected" not in rf.simulate(RIGID, own, duration=1e-4, samples=2).work
