"""Runs of rotors on springs and dampers, which take no steps: samples, states that are not shown."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

import rotorfilm as rf
from rotorfilm.analysis.compiled_rotor import take_apart
from rotorfilm.analysis.linear_runs import FEW_TIMES, exponentials, linear_states

from .beside_scipy import SEAL, long_shaft

SPRING = rf.LinearBearing(stiffness=2e7, damping=3e3)
VALUES = np.array([-3.0 + 4e4j, -30.0 + 0j, 5.0 + 30.0j, 300.0j])


@pytest.mark.parametrize("times", [np.linspace(0.0, 1.0, 10001), 0.3 + 1e-4 * np.arange(FEW_TIMES)])
def test_exponentials_of_even_times_are_those_of_each(times):
    found, phase = exponentials(VALUES, times), np.abs(VALUES) * times[-1]
    error = np.abs(found / np.exp(np.outer(times, VALUES)) - 1.0).max(axis=0)
    assert (error < 1e-15 * (4.0 + phase)).all()


@pytest.mark.parametrize("off", [0.0, 1e-7])
def test_times_that_are_nearly_even_are_taken_as_they_are(off):
    times = np.linspace(0.0, 1.0, 2000)
    times[700] += off
    expected = np.exp(np.outer(times, VALUES))
    assert np.abs(exponentials(VALUES, times) / expected - 1.0).max() < 1e-10


@pytest.mark.parametrize("mid", [SPRING, SEAL], ids=["springs", "states"])
@pytest.mark.parametrize("count", [6, 40])
def test_a_linear_run_is_the_exponential_of_its_matrix(count, mid):
    """In a turn-fixed plane the unbalance is a state, so that expm has all of the motion."""
    shaft = long_shaft(count, 300.0)
    shaft = replace(shaft, stations=(*shaft.stations, rf.Station(name="mid", node=count // 3)))
    mounted = rf.mount(shaft, {"left": SPRING, "mid": mid, "right": SPRING})
    run = rf.simulate_rotor(mounted, duration=0.05, samples=1001, condensation=0.0)
    assert run.work["steps"] == 0
    size, none = len(mounted.states), np.zeros(0)
    still, quarter = np.zeros(size), 0.5 * np.pi / 300.0
    first, second, third = (mounted.derivative(k * quarter, still, none) for k in range(3))
    held = 0.5 * (first + third)
    whole = np.zeros((size + 3, size + 3))
    whole[:size, :size] = mounted.linearization(0.0, still, none).A
    whole[:size, size:] = np.column_stack([held, first - held, second - held])
    whole[size + 1 :, size + 1 :] = [[0.0, -300.0], [300.0, 0.0]]
    scale = np.ones(size + 3)
    # Expm loses digits in a matrix of large and small entries, as those of rates and places.
    scale[len(shaft.states) // 2 : len(shaft.states)] = 1e5
    begun = np.array([*mounted.initial_state, 1.0, 1.0, 0.0]) / scale
    state = scale * (expm(0.05 * whole * scale / scale[:, None]) @ begun)
    outputs = mounted.output(0.05, state[:size], none)
    shown = dict(zip((one.name for one in mounted.outputs), outputs, strict=True))
    assert {"left_x", "right_vy", "mid_force_y", "speed"} < shown.keys() <= run.signals.keys()
    for name in shown:
        assert run[name][-1] == pytest.approx(shown[name], abs=3e-7 * np.abs(run[name]).max()), name
    parts = take_apart(mounted, over_time=True)
    every = linear_states(parts, mounted.initial_state, run.time)
    assert every is not None
    assert np.abs(every[-1] - state[:size]).max() < 3e-7 * np.abs(state[:size]).max()


def test_a_linear_run_may_be_asked_for_no_samples():
    run = rf.simulate(rf.RigidRotor(mass=10.0, speed=100.0), SPRING, duration=0.01, times=[])
    assert run.time.size == 0
    assert run["x"].size == 0
