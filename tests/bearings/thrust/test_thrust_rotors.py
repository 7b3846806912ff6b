"""Thrust bearings under shafts: modes by hand, a run over time, and control systems."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

import rotorfilm as rf
from rotorfilm.analysis import collar_response
from rotorfilm.bearings import ThrustBearing, TiltingThrustBearing, double_acting
from rotorfilm.rotors import ReducedRotor, SkewedCollar
from rotorfilm.scenes.export_scene import at_rest, from_shaft_rest

SPEED = 300.0
SIZES = {"inner_radius": 0.025, "outer_radius": 0.05, "viscosity": 0.03, "cells": (16, 8)}
FIXED = double_acting(ThrustBearing(pads=6, pad_arc=math.radians(50.0), taper_depth=4e-5, **SIZES), 1.2e-4)
TILTING = double_acting(TiltingThrustBearing(pads=4, pad_arc=math.radians(60.0), **SIZES), 1.2e-4)
MASS = 12.0


def rigid(inertia=0.08):
    return rf.RigidShaft(
        mass=MASS,
        diametral_inertia=inertia,
        polar_inertia=0.14,
        stations=(("", 0.0),),
        speed=SPEED,
        gravity=(0.0, 0.0),
        axial=True,
        feels_tilt=True,
    )


def test_a_disk_between_fixed_pads_is_the_hand_calculation():
    """z swings alone; both tilts turn with k, its cross coupling, c and the gyroscopic moment."""
    at = rf.coefficients(FIXED, [0.0, 0.0, 0.0], SPEED)
    K, C = at.stiffness, at.damping
    collar = rf.Parallel((FIXED, rf.LinearBearing(stiffness=1e7, damping=100.0)))
    poles = np.linalg.eigvals(rf.mount(rigid(), {"": collar}).linearization(0.0, np.zeros(10), []).A)
    precession = C[1, 1] + 1j * 0.14 * SPEED, K[1, 1] + 1j * K[1, 2]
    wanted = [*np.roots([MASS, C[0, 0], K[0, 0]])]
    wanted += [*np.roots([0.08, *precession]), *np.roots([0.08, *np.conj(precession)])]
    other = [*np.roots([0.08, np.conj(precession[0]), precession[1]])]
    other += [*np.roots([0.08, precession[0], np.conj(precession[1])])]
    off = [max(np.abs(poles - one).min() / abs(one) for one in sums) for sums in (wanted, wanted[:2] + other)]
    assert min(off) < 1e-7
    assert off[0] != pytest.approx(off[1], rel=1e-3)


def test_modes_of_a_rotor_on_tilting_pads_have_their_states():
    collar = rf.Parallel((TILTING, rf.LinearBearing(stiffness=1e7, damping=100.0)))
    system = rf.mount(rigid(), {"": collar})
    x = np.asarray(system.initial_state)
    poles = np.linalg.eigvals(system.linearization(0.0, x, []).A)
    assert len(poles) == 10 + 16
    modes = rf.rotor_modes(rigid(), {"": collar}, SPEED)
    for value in modes.eigenvalues:
        assert np.abs(poles - value).min() < 1e-5 * abs(value)


@pytest.mark.parametrize("pads", [FIXED, TILTING], ids=["fixed", "tilting"])
def test_small_motion_over_time_is_that_of_the_matrix(pads):
    collar = rf.Parallel((pads, rf.LinearBearing(stiffness=1e7, damping=100.0)))
    system = rf.mount(rigid(), {"": collar})
    rest = np.asarray(system.initial_state)
    kick = np.zeros_like(rest)
    kick[[signal.name for signal in rigid().states].index("vcenter_z")] = 1e-5
    run = rf.simulate(rigid(), {"": collar}, duration=2e-3, samples=5, initial_state=rest + kick, rtol=1e-8)
    A, _, C, _ = system.linearization(0.0, rest, [])
    moved = np.array([expm(A * t) @ kick for t in run.time]).T
    wanted = (C @ moved)[[signal.name for signal in rigid().outputs].index("z")]
    assert_allclose(run["z"], wanted, atol=1e-5 * np.abs(wanted).max())


def test_it_is_a_control_system():
    system = rf.linearize(FIXED, rf.OperatingPoint(t=0.0, x=(), u=(0.0,) * 6 + (SPEED,)))
    assert system.input_labels == ["z", "tilt_x", "tilt_y", "vz", "tilt_rate_x", "tilt_rate_y", "speed"]
    assert system.output_labels == ["force_z", "moment_x", "moment_y"]
    pads = TILTING.linearization(0.0, TILTING.initial_state, [0.0] * 6 + [SPEED])
    # Massless pads are not stiff: their rates are a few times the speed.
    rates = np.linalg.eigvals(pads.A).real / SPEED
    assert rates.max() < -1.0
    assert rates.min() > -4.0


# A collar out of square.


def test_a_skewed_collar_shakes_the_moments_once_a_turn():
    """P (k + (I_p - I) w^2) = -k skew in the frame that turns, k = K_aa - i K_ab + i w C_aa."""
    collar = {"": rf.Parallel((FIXED, rf.LinearBearing(stiffness=1e7, damping=100.0)))}
    skew = 1e-6 * np.exp(0.3j)
    rotor = SkewedCollar(rotor=rigid(), station="", skew=1e-6, skew_angle=0.3)
    response = collar_response(rotor, collar, [SPEED])
    at = rf.coefficients(FIXED, [0.0, 0.0, 0.0], SPEED)
    k = at.stiffness[1, 1] - 1j * at.stiffness[1, 2] + 1j * SPEED * at.damping[1, 1]
    wanted = -k * skew / (k + (0.14 - 0.08) * SPEED**2)
    found = dict(zip(response.output_labels, response.complex[:, 0, 0], strict=True))
    assert found["tilt_x"] == pytest.approx(wanted, rel=1e-6)
    assert found["tilt_y"] == pytest.approx(-1j * wanted, rel=1e-6)
    # Over time: the outputs are the tilts of the face.
    turn = 2.0 * math.pi / SPEED
    run = rf.simulate(rotor, collar, duration=6.0 * turn, times=np.linspace(0.0, 6.0 * turn, 97), rtol=1e-6)
    last = slice(-32, None)
    phasor = 2.0 * np.mean(run["tilt_x"][last] * np.exp(-1j * SPEED * run.time[last]))
    assert phasor == pytest.approx(wanted + skew, rel=1e-3)


def test_a_skew_needs_a_station_that_feels_it():
    plain = rf.RigidShaft(
        mass=1.0, diametral_inertia=1.0, polar_inertia=1.0, stations=(("", 0.0),), speed=1.0
    )
    with pytest.raises(rf.InputError, match="station '' must have the freedom tilt_x"):
        SkewedCollar(rotor=plain, station="", skew=1e-4)
    collar = SkewedCollar(rotor=rigid(), station="", skew=1e-4)
    with pytest.raises(rf.InputError, match="bearings must have one that feels tilts"):
        collar_response(collar, {"": rf.LinearBearing(stiffness=1e7)}, [1.0])
    with pytest.raises(rf.InputError, match="rotor must be a flexible rotor"):
        rf.unbalance_response(collar, {}, [1.0])


# A flexible shaft with axial motion, its collar a disk, under an axial load.


STEEL = rf.ElasticMaterial(young_modulus=2.11e11, shear_modulus=8.12e10, density=7810.0)
SHAFT = rf.ShaftRotor(
    elements=rf.ShaftElement(length=1.2, outer_diameter=0.06, material=STEEL).split(6),
    speed=600.0,
    stations=(
        rf.Station(node=1, name="left"),
        rf.Station(node=5, name="right"),
        rf.Station(node=0, name="thrust", feels_tilt=True),
    ),
    disks=(
        rf.Disk(node=3, mass=30.0, polar_inertia=0.4, diametral_inertia=0.25),
        rf.Disk(node=0, mass=4.0, polar_inertia=0.012, diametral_inertia=0.006),
    ),
    unbalances=(rf.Unbalance(node=3, unbalance=3e-4),),
    axial=True,
)
JOURNAL = rf.JournalBearing(diameter=0.06, length=0.03, clearance=6e-5, viscosity=0.02)
PADS = ThrustBearing(
    inner_radius=0.04,
    outer_radius=0.08,
    pads=8,
    pad_arc=math.radians(38.0),
    viscosity=0.02,
    taper_depth=4e-5,
    gap=5e-5,
    cells=(16, 8),
    extrapolated=False,
    tabulated=True,
)
LOAD = 2e4
PUSH = rf.as_reaction(
    lambda z, vz, speed: (-LOAD,), freedoms=("z",), clearance=1e-2, nominal_force=LOAD, name="push"
)
MACHINE = {"left": JOURNAL, "right": JOURNAL, "thrust": rf.Parallel((PADS, PUSH))}


@pytest.mark.long
def test_a_flexible_shaft_rests_on_its_thrust_pads_and_swings_on_their_stiffness():
    at = rf.analysis.rotor_equilibrium(SHAFT, MACHINE, 600.0)
    place = at.coefficients["thrust"].position
    alone = rf.equilibrium(PADS, [-LOAD, 0.0, 0.0], 600.0)
    # The collar sits a little askew where the shaft sags, which changes the film by a part in a thousand.
    assert place[0] == pytest.approx(alone.position[0], abs=1e-3 * (alone.position[0] + PADS.gap))
    assert PADS.force(place, [0.0, 0.0, 0.0], 600.0)[0] == pytest.approx(LOAD, rel=1e-6)
    # With all its mass in one piece on K and C of the pads the shaft is a swing along its axis.
    film = rf.coefficients(PADS, place, 600.0)
    spring = rf.analysis.AxialSpring(node=0, stiffness=film.stiffness[0, 0], damping=film.damping[0, 0])
    axial = rf.analysis.axial_modes(SHAFT, [spring], 2).eigenvalues
    modes = rf.rotor_modes(SHAFT, MACHINE, 600.0, highest_frequency=2e4).eigenvalues
    for value in axial[axial.imag < 2e4]:
        assert np.abs(modes - value).min() < 0.02 * abs(value)


@pytest.mark.long
def test_a_reduced_shaft_runs_on_its_pads_in_time_as_in_small_motion():
    reduced = ReducedRotor(rotor=SHAFT, modes=2, speed=600.0, gravity=SHAFT.gravity)
    rotor, at = at_rest(reduced, MACHINE, 600.0)
    resting = from_shaft_rest(MACHINE, at)
    run = rf.simulate(rotor, resting, duration=2e-3, samples=3, rtol=1e-5)
    z = at.coefficients["thrust"].position[0]
    assert run["thrust_z"] == pytest.approx(z, abs=1e-9)
    assert rf.rotor_threshold(reduced, MACHINE, np.linspace(600.0, 900.0, 3)).speed == pytest.approx(
        rf.rotor_threshold(SHAFT, MACHINE, np.linspace(600.0, 900.0, 3)).speed, rel=0.05
    )


@pytest.mark.long
def test_a_machine_with_its_thrust_bearing_is_an_fmu(tmp_path):
    fmpy = pytest.importorskip("fmpy")
    reduced = ReducedRotor(rotor=SHAFT, modes=0, speed=600.0, gravity=SHAFT.gravity)
    bearings = {**MACHINE, "thrust": double_acting(PADS, 1e-4)}
    rotor, at = at_rest(reduced, bearings, 600.0)
    machine = rf.mount(rotor, from_shaft_rest(bearings, at))
    path = rf.export_fmu(machine, tmp_path / "machine.fmu")
    found = fmpy.simulate_fmu(str(path), stop_time=1e-4, output_interval=1e-4)
    names = [name.rpartition(".")[2] for name in found.dtype.names[1:]]
    own = dict(zip(names, list(found[0])[1:], strict=True))
    x = np.asarray(machine.initial_state)
    wanted = dict(
        zip(
            [s.name for s in machine.outputs],
            machine.output(0.0, x, np.zeros(len(machine.inputs))),
            strict=True,
        )
    )
    for name in ("thrust_z", "thrust_force_z", "thrust_moment_x", "left_x"):
        assert own[name] == pytest.approx(wanted[name], rel=1e-6, abs=1e-9)
