"""Journal bearings whose oil warms in the compiled integration: scipy's motion, and the heat balance."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import DOP853, simpson

import rotorfilm as rf
from rotorfilm.analysis.compiled_rotor import takes_forces
from rotorfilm.bearings.oil.heated_bearing import HeatedBearing
from rotorfilm.rotors import MotorDrivenRotor

from .beside_scipy import HEAVY_OIL, MOTOR, SEAL, cracked, long_shaft, require_same_motion

COOLED = rf.Cooling(supply_temperature=313.15, housing_conductance=5.0, bush_heat_capacity=2.0)
WARM = rf.JournalBearing(
    radius=0.04, length=0.04, clearance=8e-5, oil=rf.Oil.iso_vg(32), cooling=COOLED, film=rf.ShortFilm()
)
GROOVED = replace(
    WARM,
    film=rf.GroovedMapFilm(cells=(32, 4), nodes=(6, 12, 12)),
    grooves=(rf.Groove(center=0.0, width=0.3), rf.Groove(center=np.pi, width=0.3)),
)
FULL = replace(WARM, film=rf.MapFilm(), cooling=replace(COOLED, full_gap=True))
WITHOUT_BUSH = replace(WARM, cooling=replace(COOLED, bush_heat_capacity=1e-3))
COLD = rf.JournalBearing(radius=0.04, length=0.04, clearance=8e-5, viscosity=0.02, film=rf.ShortFilm())
PROFILE = rf.SpeedProfile(times=(0.0, 0.004), speeds=(300.0, 420.0))
RIGID = rf.RigidRotor(mass=30.0, speed=PROFILE, unbalance=1.5e-4)
SHAFT = rf.RigidShaft(
    mass=40.0,
    diametral_inertia=1.2,
    polar_inertia=0.9,
    stations=(("left", -0.3), ("mid", 0.1), ("right", 0.4)),
    unbalances=((0.1, 1e-3, 0.0),),
    speed=PROFILE,
)

CASES = {
    "rigid": (RIGID, {"": WARM}),
    "map, full gap": (RIGID, {"": FULL}),
    "grooves": (RIGID, {"": GROOVED}),
    "oil alone": (RIGID, {"": WITHOUT_BUSH}),
    "gyroscopic run-up": (SHAFT, {"left": WARM, "right": FULL}),
    "one warm": (SHAFT, {"left": COLD, "right": WARM}),
    "linear states between": (SHAFT, {"left": WARM, "mid": SEAL, "right": WARM}),
    "added mass": (SHAFT, {"left": WARM, "mid": HEAVY_OIL, "right": WARM}),
    "motor": (
        MotorDrivenRotor(rotor=replace(SHAFT, speed=300.0), inertia=0.05, torque=MOTOR),
        {"left": WARM, "right": WARM},
    ),
    "crack": (cracked(PROFILE), {"": WARM}),
}


def moved(rotor, bearings):
    """Return a state with the journals away from the centers, and warm films."""
    mounted = rf.mount(rotor, bearings)
    state = np.array(mounted.initial_state)
    state[:2] = 1e-5, -3e-5
    state[[k for k, signal in enumerate(mounted.states) if signal.unit == "K"]] += 10.0
    return state


def motion(rotor, bearings, **settings):
    state = moved(rotor, bearings)
    return rf.simulate(rotor, bearings, duration=0.004, samples=21, initial_state=state, **settings)


@pytest.mark.parametrize("case", CASES)
def test_the_compiled_motion_is_that_of_scipy(case):
    # Displacements, forces and temperatures within 1e-8 of their changes over the run.
    rotor, bearings = CASES[case]
    run = motion(rotor, bearings, rtol=1e-10)
    reference = motion(rotor, bearings, rtol=1e-11, method=DOP853)
    require_same_motion(run, reference, 1e-8)


class InPython(HeatedBearing):
    """A film that warms, by the film law in Python."""


@pytest.mark.parametrize("bearing", [WARM, FULL, GROOVED], ids=["short", "map, full gap", "grooves"])
def test_the_film_in_c_is_that_in_python(bearing):
    state, motion = [335.0], [3e-5, -2e-5, 2e-3, -1e-3, 400.0]
    fast, slow = bearing.in_time(), InPython(bearing=bearing)
    assert fast.output(0.0, state, motion) == pytest.approx(slow.output(0.0, state, motion), rel=1e-12)
    assert fast.derivative(0.0, state, motion) == pytest.approx(
        slow.derivative(0.0, state, motion), rel=1e-11
    )
    matrices = (one.linearization(0.0, state, motion) for one in (fast, slow))
    for found, expected in zip(*matrices, strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-10 * np.abs(expected).max())


def test_the_error_falls_with_the_tolerance():
    exact = motion(RIGID, {"": WARM}, rtol=1e-12)
    for rtol in (1e-4, 1e-6, 1e-8, 1e-10):
        run = motion(RIGID, {"": WARM}, rtol=rtol)
        assert np.abs(run["temperature"] - exact["temperature"]).max() < 30.0 * 0.1 * rtol
        assert np.hypot(*(run[name] - exact[name] for name in "xy")).max() < WARM.clearance * 0.1 * rtol


@pytest.mark.parametrize("bearing", [WARM, WITHOUT_BUSH], ids=["bush", "oil alone"])
def test_the_heat_balances(bearing):
    # capacity (T - T0) is the integral of P - C (T - T_s) Q - G (T - T_a), here by Simpson's rule.
    state = [1e-5, -3e-5, 0.0, 0.0, 330.0]
    rotor = replace(RIGID, speed=400.0)
    run = rf.simulate(rotor, bearing, duration=0.05, samples=2001, initial_state=state, rtol=1e-10)
    T, warm = run["temperature"], bearing.in_time()
    carried = bearing.oil.volumetric_heat(COOLED.supply_temperature) * run["side_flow"]
    housing = COOLED.housing_conductance * (T - COOLED.ambient)
    heat = run["power_loss"] - carried * (T - COOLED.supply_temperature) - housing
    stored = warm.capacity * (T[-1] - T[0])
    assert simpson(heat, x=run.time) == pytest.approx(stored, rel=1e-6)
    assert abs(T[-1] - T[0]) > 1.0


def test_a_shaft_of_many_elements_is_condensed():
    shaft = long_shaft(20, 300.0)
    films = {"left": FULL, "right": FULL}
    at = rf.rotor_equilibrium(shaft, films, 300.0)
    resting = replace(shaft, initial=(*at.displacement.tolist(), *[0.0] * len(at.displacement)))
    mounted = rf.mount(resting, {name: FULL.in_time(at.temperatures[name] - 5.0) for name in films})
    few, whole = (
        rf.simulate_rotor(mounted, duration=0.02, samples=21, condensation=share) for share in (1e-5, 0.0)
    )
    assert np.abs(few["left_temperature"] - whole["left_temperature"]).max() < 1e-4
    assert np.abs(few["left_x"] - whole["left_x"]).max() < 1e-5 * FULL.clearance
    assert np.ptp(whole["left_temperature"]) > 0.1


def test_a_compiled_run_ends_where_the_oil_is_not_tabulated():
    rising = replace(RIGID, speed=rf.SpeedProfile(times=(0.0, 0.05), speeds=(300.0, 9000.0)))
    with pytest.raises(
        rf.ConvergenceError, match=r"temperature must be from 253.15 to 473.15 K.*473.15 K"
    ) as hot:
        rf.simulate_rotor(rf.mount(rising, {"": WARM}), duration=0.05, rtol=1e-6, samples=501)
    run = hot.value.partial
    assert 0.01 < run.time[-1] < 0.05
    assert 465.0 < run["temperature"][-1] < 473.15


def test_a_run_that_begins_where_the_oil_is_not_tabulated_is_that_of_scipy():
    hot = WARM.in_time(480.0)
    with pytest.raises(rf.ConvergenceError, match="got 480 K at t = 0 s"):
        rf.simulate_rotor(rf.mount(RIGID, {"": hot}), duration=1e-4)
    with warnings.catch_warnings(action="ignore", category=rf.ValidityWarning):
        run = rf.simulate(RIGID, hot, duration=1e-4, samples=3)
    assert run["temperature"][0] == 480.0
    assert 470.0 < run["temperature"][-1] < 490.0


def test_a_journal_that_feels_its_tilt_leaves_a_warm_film_to_scipy():
    tilting = rf.bearings.MomentCarryingJournal(bearing=COLD, level=rf.bearings.TiltLevel.CLOSED_FORM)
    assert takes_forces(SHAFT, [COLD, WARM.in_time()])
    assert not takes_forces(SHAFT, [tilting, WARM.in_time()])
