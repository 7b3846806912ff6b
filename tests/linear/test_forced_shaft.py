"""Forces at nodes of a shaft: over time on linear and nonlinear bearings, and harmonic ones."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

import rotorfilm as rf
from rotorfilm.analysis import harmonic_response, receptance, rotor_system, time_response
from rotorfilm.rotors import ForcedRotor

STEEL = rf.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
SPRING = rf.LinearBearing(stiffness=((2e7, 3e6), (-3e6, 4e7)), damping=((2e3, 0.0), (0.0, 1e3)))
SPRINGS = {"left": SPRING, "right": SPRING}
SPEED = 300.0
SHAFT = rf.ShaftRotor(
    elements=rf.ShaftElement(length=1.2, outer_diameter=0.05, material=STEEL).split(4), speed=SPEED,
    stations=(rf.Station(node=0, name="left"), rf.Station(node=4, name="right")),
    disks=(rf.Disk.solid(2, density=7810.0, width=0.06, outer_diameter=0.3),),
    probes=(rf.Probe(node=1, name="probe"),),
)  # fmt: skip
TIMES = np.linspace(0.0, 0.05, 26)
PULSE = np.stack([300.0 * np.sin(200.0 * TIMES), 100.0 * np.cos(90.0 * TIMES)])


def exact(forces):
    """Return the displacement of the probe, x and y, by matrix exponentials of forces linear in time."""
    seen = replace(
        SHAFT, stations=(*SHAFT.stations, rf.Station(node=1, name="one"), rf.Station(node=2, name="two"))
    )
    system = rotor_system(seen, rf.rotor_equilibrium(seen, SPRINGS, SPEED))
    columns = [system.input_labels.index(f"{name}_force_{axis}") for name in forces for axis in "xy"]
    rows = [system.output_labels.index(f"probe_{axis}") for axis in "xy"]
    pushed, size, m = np.vstack(list(forces.values())), len(system.A), len(columns)
    step = TIMES[1]
    whole = np.zeros((size + 2 * m, size + 2 * m))
    whole[:size, :size], whole[:size, size : size + m] = system.A, system.B[:, columns]
    whole[size : size + m, size + m :] = np.eye(m)
    moved, state, found = expm(whole * step), np.zeros(size), []
    for k in range(len(TIMES)):
        found.append(system.C[rows] @ state)
        slope = (pushed[:, min(k + 1, len(TIMES) - 1)] - pushed[:, k]) / step
        state = (moved @ np.concatenate([state, pushed[:, k], slope]))[:size]
    return np.array(found).T


@pytest.mark.closed_form
@pytest.mark.parametrize("nodes", [{"one": 1}, {"one": 1, "two": 2}])
def test_forces_over_time_move_a_linear_rotor_as_the_matrix_exponential(nodes):
    """Forces are linear between their times, at one node or at two."""
    forces = {name: PULSE * (1.0 if name == "one" else -0.5) for name in nodes}
    run = time_response(SHAFT, SPRINGS, {nodes[name]: one for name, one in forces.items()}, TIMES, rtol=1e-9)
    assert "rejected" in run.work  # integrated in C
    place = np.array([run["probe_x"], run["probe_y"]])
    wanted = exact(forces)
    np.testing.assert_allclose(place - place[:, :1], wanted, atol=1e-6 * np.abs(wanted).max())


@pytest.mark.closed_form
def test_a_slow_force_on_a_film_moves_the_journals_to_the_equilibrium_under_it():
    film = rf.JournalBearing(diameter="50 mm", length="25 mm", clearance="40 um", viscosity="10 mPa s")
    times = np.array([0.0, 0.4, 1.2])
    push = np.array([[0.0, 200.0, 200.0], [0.0, -300.0, -300.0]])
    run = time_response(SHAFT, {"left": film, "right": film}, {2: push}, times)
    load = 0.5 * np.array([200.0, -300.0 - SHAFT.mass * 9.80665])
    at = rf.equilibrium(film, load, SPEED)
    for name in ("left", "right"):
        place = [run[f"{name}_x"][-1], run[f"{name}_y"][-1]]
        np.testing.assert_allclose(place, at.position, atol=2e-3 * 4e-5)
    start = rf.equilibrium(film, [0.0, load[1] + 150.0], SPEED).position
    np.testing.assert_allclose([run["left_x"][0], run["left_y"][0]], start, atol=1e-6 * 4e-5)


@pytest.mark.closed_form
def test_harmonic_forces_are_answered_by_the_receptance():
    grid, pair = np.array([50.0, 120.0, 400.0]), np.array([3.0, 1.0 - 2.0j])
    over = np.outer(pair, grid)
    found = harmonic_response(SHAFT, SPRINGS, {1: pair, 3: over}, grid, SPEED)
    seen = receptance(SHAFT, SPRINGS, SPEED, grid, [1, 3]).frdata
    wanted = [seen[:2, :, k] @ np.concatenate([pair, over[:, k]]) for k in range(3)]
    rows = [found.output_labels.index(f"probe_{axis}") for axis in "xy"]
    np.testing.assert_allclose(found.frdata[rows, 0, :].T, wanted, rtol=1e-7)
    assert list(found.input_labels) == ["force"]


@pytest.mark.closed_form
def test_a_turning_force_is_an_unbalance():
    speeds = np.array([100.0, 250.0])
    turning = 1e-4 * np.outer([1.0, -1.0j], speeds**2)
    springs = dict.fromkeys(SPRINGS, rf.LinearBearing(stiffness=2e7, damping=2e3))
    found = harmonic_response(SHAFT, springs, {2: turning}, speeds)
    heavy = replace(SHAFT, unbalances=(rf.Unbalance(node=2, unbalance=1e-4),))
    other = rf.unbalance_response(heavy, springs, speeds)
    np.testing.assert_allclose(found.frdata, other.frdata, rtol=1e-9, atol=1e-20)
    assert list(found.output_labels) == list(other.output_labels)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: harmonic_response(SHAFT, SPRINGS, {7: [1.0, 0.0]}, [50.0]), "at nodes from 0 to 4, got"),
        (lambda: harmonic_response(SHAFT, SPRINGS, {1.0: [1.0, 0.0]}, [50.0]), "at nodes from 0 to 4, got"),
        (lambda: harmonic_response(SHAFT, SPRINGS, {}, [50.0]), "at nodes from 0 to 4, got"),
        (
            lambda: harmonic_response(SHAFT, SPRINGS, {1: [1.0, np.nan]}, [50.0]),
            r"forces\[1\] must be finite",
        ),
        (
            lambda: harmonic_response(SHAFT, SPRINGS, {1: [1.0, 0.0, 2.0]}, [50.0]),
            r"shape \(2,\) or \(2, 1\)",
        ),
        (
            lambda: ForcedRotor(rotor=SHAFT, times=TIMES, forces={1: PULSE[:, :5]}),
            r"must have shape \(2, 26\)",
        ),
        (lambda: ForcedRotor(rotor=SHAFT, times=TIMES[::-1], forces={1: PULSE}), "times must be two numbers"),
        (lambda: time_response(SHAFT, SPRINGS, {1: PULSE}, TIMES + 1.0), "times must begin at 0, got 1 s"),
        (lambda: time_response(rf.RigidRotor(mass=1.0, speed=0.0), {}, {1: PULSE}, TIMES), "a ShaftRotor"),
    ],
)
def test_forces_that_fit_no_shaft_are_refused(call, message):
    with pytest.raises(rf.InputError, match=message):
        call()
