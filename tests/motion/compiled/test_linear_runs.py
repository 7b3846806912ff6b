"""Runs on springs and dampers at constant speed: exact at any time, without a step."""

import numpy as np
import pytest
from scipy.linalg import expm

from rotorfilm import JournalBearing, LinearBearing, Unbalance, mount, simulate_rotor

from ...linear.test_big_rotors import long_rotor

SPEED = -180.0
SPRING = LinearBearing(stiffness=((2e7, 3e5), (-3e5, 1e7)), damping=2e3)


def mounted(count, bearing=SPRING):
    unbalances = (Unbalance(node=1, unbalance=1e-3, unbalance_angle=0.3),)
    rotor = long_rotor(count, speed=SPEED, unbalances=unbalances)
    return mount(rotor, {"left": bearing, "right": bearing})


@pytest.mark.closed_form
def test_a_run_on_springs_is_the_exponential_of_the_whole_system():
    """The unbalance and the weight are states too: x' = A x + B r + w, r' = a turn, w' = 0."""
    model = mounted(3)
    n = len(model.states)
    none, rotor = np.zeros(n), model.bare.operators
    system = np.zeros((n + 3, n + 3))
    system[:n, :n] = model.linearization(0.0, none, np.zeros(0)).A
    system[:n, n : n + 2] = SPEED**2 * rotor.unbalance
    system[:n, -1] = rotor.weight
    system[n : n + 2, n : n + 2] = [[0.0, -SPEED], [SPEED, 0.0]]
    start = 1e-5 * np.sin(np.arange(n))
    time = np.array([0.0, 1e-4, 0.013, 0.2])
    run = simulate_rotor(model, duration=0.2, times=time, initial_state=start)
    begun = np.concatenate([start, [1.0, 0.0, 1.0]])
    exact = np.array([expm(t * system) @ begun for t in time])[:, :n]
    left = np.flatnonzero([signal.name == "left_x" for signal in model.outputs])[0]
    wanted = exact @ model.linearization(0.0, none, np.zeros(0)).C[left]
    assert run["left_x"] == pytest.approx(wanted, rel=1e-9, abs=1e-9 * np.abs(wanted).max())
    assert run.work["steps"] == 0


def test_bearings_that_bend_are_integrated():
    """The same spring with a touch of a film takes steps."""
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.05)
    assert simulate_rotor(mounted(3, film), duration=0.01).work["steps"] > 0


def test_few_shapes_and_all_move_alike_without_a_step():
    runs = [simulate_rotor(mounted(12), duration=0.1, condensation=c) for c in (1e-5, 0.0)]
    assert [run.work["steps"] for run in runs] == [0, 0]
    size = np.abs(runs[1]["right_y"]).max()
    assert runs[0]["right_y"] == pytest.approx(runs[1]["right_y"], abs=1e-3 * size)
