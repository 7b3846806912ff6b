"""Thrust bearings under shafts: modes by hand, a run over time, and control systems."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

import rotorfilm as rf
from rotorfilm.bearings import ThrustBearing, TiltingThrustBearing, double_acting

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
