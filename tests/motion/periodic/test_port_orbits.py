"""Periodic orbits on bearings of any motions and states: they close, and multipliers are differences."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import rotorfilm as rf
from rotorfilm.analysis import continue_orbits, periodic_orbit
from rotorfilm.analysis.harmonic_balance import CONVERGED, Balance, lengthened, solve
from rotorfilm.analysis.periodic_orbit import _driven, finished, series_of
from rotorfilm.analysis.port_orbits import PortRotor
from rotorfilm.bearings import f4k20_bush
from rotorfilm.bearings.rolling import BALL_FREEDOMS, MomentCarryingBalls, back_to_back

STEEL = rf.ElasticMaterial(young_modulus=2.11e11, shear_modulus=8.12e10, density=7810.0)
FILM = rf.JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
PADS = rf.TiltingPadBearing(
    radius=0.05,
    length=0.05,
    assembled_clearance=7e-5,
    viscosity=0.02,
    pivots=rf.even_pivots(5, between_pads=True),
    extent=np.radians(60.0),
    preload=0.3,
)
SPEED = 300.0


@lru_cache
def on_pads(unbalance=5e-3):
    return rf.mount(rf.RigidRotor(mass=200.0, speed=SPEED, unbalance=unbalance), {"": PADS})


def shaft(**given):
    defaults = {
        "elements": rf.ShaftElement(length=1.0, outer_diameter=0.06, material=STEEL).split(4),
        "disks": (rf.Disk(node=2, mass=30.0, polar_inertia=0.2, diametral_inertia=0.1),),
        "stations": (rf.Station(node=0, name="left"), rf.Station(node=4, name="right")),
        "unbalances": (rf.Unbalance(node=2, unbalance=4e-3),),
        "speed": SPEED,
    }
    return rf.ShaftRotor(**{**defaults, **given})


def over_a_turn(mounted, state):
    turn = 2.0 * np.pi / SPEED
    rate = lambda t, x: mounted.derivative(t, x, [])  # noqa: E731
    return solve_ivp(rate, (0.0, turn), state, method="LSODA", rtol=1e-11, atol=1e-17).y[:, -1]


def test_without_states_it_is_the_orbit_in_compiled_loops():
    mounted = rf.mount(shaft(), {"left": FILM, "right": FILM})
    compiled = periodic_orbit(mounted)
    own = finished(lengthened(_driven(PortRotor.of(mounted), None, 1, CONVERGED), 1e-7))
    assert_allclose(own.series, compiled.series, atol=1e-10 * FILM.clearance)
    assert_allclose(own.state[:30], compiled.state[:30], atol=1e-10 * FILM.clearance)
    for value in compiled.multipliers[:6]:
        assert np.abs(own.multipliers - value).min() < 1e-8


def test_an_orbit_on_tilting_pads_comes_back_and_knows_its_multipliers():
    mounted = on_pads()
    orbit = periodic_orbit(mounted)
    assert orbit.stable
    assert [*orbit.further] == [f"tilt_{k}" for k in range(1, 6)]
    end = over_a_turn(mounted, orbit.state)
    assert_allclose(end[:2], orbit.state[:2], atol=1e-8 * PADS.assembled_clearance)
    monodromy = PortRotor.of(mounted).monodromy(series_of(PortRotor.of(mounted), orbit), orbit.frequency)
    for column, step in ((0, 1e-9), (3, 1e-7)):
        moved = orbit.state.copy()
        moved[column] += step
        change = (over_a_turn(mounted, moved) - end) / step
        assert_allclose(change, monodromy[:, column], atol=1e-3 * np.abs(monodromy[:, column]).max())


@pytest.mark.long
def test_a_curve_of_orbits_on_tilting_pads_meets_those_found_alone():
    start = periodic_orbit(on_pads(2e-3))
    curve = continue_orbits(
        lambda u: on_pads(float(u)), start, bounds=(1e-3, 8e-3), parameter=2e-3, largest_step=1.0
    )
    assert curve.parameters[-1] == pytest.approx(8e-3)
    alone = periodic_orbit(on_pads(8e-3))
    assert curve.orbits[-1].amplitude == pytest.approx(alone.amplitude, rel=1e-7)


@pytest.mark.long
def test_a_shaft_moves_axially_and_tilts_in_ball_bearings_on_its_orbit():
    single = rf.BallBearing(
        balls=10, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, contact_angle=0.4363, damping=200.0
    )
    held = MomentCarryingBalls(
        bearing=back_to_back(single, distance=0.02, preload=150.0), freedoms=BALL_FREEDOMS
    )
    rotor = shaft(
        elements=rf.ShaftElement(length=0.3, outer_diameter=0.02, material=STEEL).split(4),
        disks=(rf.Disk(node=1, mass=3.0, polar_inertia=0.01, diametral_inertia=0.005),),
        stations=(
            rf.Station(node=0, name="left", feels_tilt=True),
            rf.Station(node=4, name="right", feels_tilt=True),
        ),
        unbalances=(rf.Unbalance(node=1, unbalance=1e-3),),
        axial=True,
        stiffness_damping=2e-5,
    )
    bearings = {"left": held, "right": held}
    orbit = periodic_orbit(rf.mount(rotor, bearings))
    assert "left_tilt_x" in orbit.further
    assert "right_z" in orbit.further
    run = rf.simulate(
        rotor, bearings, duration=2.0 * np.pi / SPEED, samples=3, initial_state=orbit.state, rtol=1e-8
    )
    for name in ("left_x", "left_tilt_x", "right_z", "right_y"):
        assert abs(run[name][-1] - run[name][0]) < 1e-5 * np.abs(run[name]).max()


def test_slow_temperatures_and_fast_modes_are_no_drift():
    """Of 30 elements the modes turn at 1e7 rad/s, the oil warms in minutes."""
    cooling = rf.Cooling(supply_temperature=313.15, bush_heat_capacity=2e4)
    warm = rf.JournalBearing(radius=0.05, length=0.05, clearance=1e-4, oil=rf.Oil.iso_vg(32), cooling=cooling)
    pieces = rf.ShaftElement(length=1.0, outer_diameter=0.06, material=STEEL).split(30)
    stations = (rf.Station(node=0, name="left"), rf.Station(node=30, name="right"))
    PortRotor.of(rf.mount(shaft(elements=pieces, stations=stations), {"left": warm, "right": warm}))


@pytest.mark.long
def test_whirl_at_a_frequency_of_its_own_is_that_in_compiled_loops():
    """Whirl has no unbalance: its frequency is found with it, by the derivative of the responses."""
    film = rf.JournalBearing(radius=0.05, length=0.025, clearance=1e-4, viscosity=0.02)
    rotor = rf.RigidRotor(mass=20.0, speed=900.0, position=(2e-5, 0.0))
    mounted = rf.mount(rotor, {"": film})
    run = rf.simulate_rotor(mounted, duration=1.0, samples=20001)
    compiled = periodic_orbit(mounted, start=run)
    assert compiled.periods == 0
    own = PortRotor.of(mounted)
    balance = Balance(rotor=own, harmonics=compiled.harmonics, periods=0)
    start = 1.01 * series_of(own, compiled)
    found = finished(solve(balance, start, 1.001 * compiled.frequency))
    assert found.frequency == pytest.approx(compiled.frequency, rel=1e-8)
    assert found.amplitude == pytest.approx(compiled.amplitude, rel=1e-7)
    assert_allclose(np.abs(found.multipliers[:2]), np.abs(compiled.multipliers[:2]), rtol=1e-5)
    again = periodic_orbit(on_pads(), start=rf.simulate(*on_pads_parts(), duration=0.5, samples=5001))
    assert again.amplitude == pytest.approx(periodic_orbit(on_pads()).amplitude, rel=1e-6)


def on_pads_parts():
    mounted = on_pads()
    return mounted.rotor, PADS


def test_what_has_no_orbit_is_refused_by_name():
    rising = rf.SpeedProfile(times=(0.0, 1.0), speeds=(100.0, 200.0))
    mounted = on_pads()
    with pytest.raises(rf.InputError, match="speed must be constant"):
        periodic_orbit(replace(mounted, rotor=replace(mounted.rotor, speed=rising)))
    worn = rf.BushReaction(bush=f4k20_bush(), melting_heat=1e8, nodes=16, extent=1.4, retardation=2e-4)
    with pytest.raises(rf.ConvergenceError, match="a state of a bearing drifts: a bush wears"):
        periodic_orbit(rf.mount(replace(mounted.rotor, mass=10.0), {"": worn}))
    loose = rf.mount(shaft(axial=True), {"left": FILM, "right": FILM})
    with pytest.raises(rf.ConvergenceError, match="no thrust bearing holds the shaft"):
        periodic_orbit(loose)
    other = periodic_orbit(rf.mount(shaft(), {"left": FILM, "right": FILM}))
    with pytest.raises(rf.InputError, match="start must be an orbit of these bearings"):
        periodic_orbit(mounted, start=other)
