"""How far a flexible rotor goes: run-ups, lost blades and ground that shakes, beside independent runs."""

import math
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lsim

from rotorfilm import (
    AnnularSeal,
    ContactError,
    InputError,
    coefficients,
    mount,
    rotor_equilibrium,
    simulate_rotor,
)
from rotorfilm.questions import ladder_of, shaft_orbits as shaft_peaks
from rotorfilm.rotors.shaft_rotor import split
from rotorfilm.scenes import read_scene
from rotorfilm.scenes.rotor_runs import largest_distance
from rotorfilm.scenes.shaft_table import BearingTable

EXAMPLES = Path(__file__).parents[2] / "examples"
SPRING = {"stiffness": 2e7, "damping": 4e3}
SEAL = AnnularSeal(radius=0.1, length=0.05, clearance=9e-4, pressure_drop=6e5, viscosity=1e-3, density=1000.0)
PULSE = [[0.0, 0.0], [0.01, 6.0], [0.025, -9.0], [0.04, 2.0], [0.06, 0.0]]
RUN_UP = {
    "kind": "run_up",
    "unbalance": 1e-3,
    "node": 4,
    "end_speed": "1400 rpm",
    "duration": 0.12,
}

pytestmark = pytest.mark.filterwarnings("ignore:left out")


def asked(tolerance, excitation, *, springs=False, at="disk", quantity="peak_displacement", **shaft):
    data = tomllib.loads((EXAMPLES / "earthquake.toml").read_text(encoding="utf-8"))
    data["shaft"] |= shaft
    if springs:
        data["shaft"]["bearings"] = [
            {"name": one["name"], "node": one["node"], **SPRING} for one in data["shaft"]["bearings"]
        ]
    question = {"quantity": quantity, "tolerance": tolerance} | ({"at": at} if at else {})
    return read_scene(data | {"excitation": excitation, "question": question}, str(EXAMPLES / "scene.toml"))


@pytest.mark.closed_form
def test_the_top_between_samples():
    """A circle off the origin in 24 samples a turn: its top lies between two."""
    time = np.linspace(0.0, 2.0, 49)
    angle = 2.0 * np.pi * time + 0.41
    x, y = 0.3 + np.cos(angle), np.sin(angle)
    assert np.hypot(x, y).max() < 1.3 * (1.0 - 5e-4)
    assert largest_distance(time, x, y) == pytest.approx(1.3, rel=1e-4)


@pytest.mark.closed_form
@pytest.mark.parametrize("sealed", [False, True], ids=["springs", "springs and a seal"])
def test_ground_under_springs_beside_an_exact_march(sealed):
    """Piecewise linear acceleration has an exact march of the dense matrices, assembled here."""
    scene = asked(3e-3, {"kind": "ground", "acceleration": PULSE}, springs=True, unbalances=[])
    if sealed:
        ring = BearingTable(name="ring", node=1, seal=SEAL)
        scene = scene.with_tables(shaft=replace(scene.shaft, bearings=(*scene.shaft.bearings, ring)))
    answer = scene.ask()
    rotor = split(scene.shaft.build(scene.speed), 2)
    s = rotor.structure
    n = len(s.mass)
    M, K, C = s.mass.copy(), s.stiffness.copy(), s.damping + scene.speed * s.gyroscopic
    gap = coefficients(SEAL, np.zeros(2), scene.speed)
    for station in rotor.stations:
        pair = np.ix_(*[(2 * station.node, 2 * station.node + n // 2)] * 2)
        held = station.name == "ring"
        K[pair] += gap.stiffness if held else SPRING["stiffness"] * np.eye(2)
        C[pair] += gap.damping if held else SPRING["damping"] * np.eye(2)
        M[pair] += gap.mass if held else 0.0
    push = np.roll(s.weight, n // 2) / -9.80665  # of a rotor that falls: along y
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, np.hstack([K, C]))]])
    B = np.concatenate([np.zeros(n), -np.linalg.solve(M, push)])[:, None]
    node = 2 * rotor.probes[0].node
    seen = np.zeros((2, 2 * n))
    seen[0, node] = seen[1, node + n // 2] = 1.0
    time = np.linspace(0.0, 0.06, 1201)
    pulse = np.interp(time, *np.transpose(PULSE))
    _, moved, _ = lsim((A, B, seen, np.zeros((2, 1))), pulse, time)
    sag = np.linalg.solve(K, s.weight)[[node, node + n // 2]]
    wanted = np.hypot(*(moved + sag).T).max()
    assert answer.value == pytest.approx(wanted, rel=3e-3)
    error = abs(answer.value - wanted) / wanted
    assert error < 2.0 * answer.error_estimate + 1e-5


@pytest.mark.long
@pytest.mark.regression
def test_a_run_up_on_films_beside_the_whole_rotor():
    scene = asked(1e-3, RUN_UP, unbalances=[])
    answer = scene.ask()
    films = scene.shaft.build_bearings()
    whole = scene.shaft.build(scene.speed, (scene.excitation,))
    still = rotor_equilibrium(whole, films, scene.speed).displacement
    moving = replace(whole, speed=scene.excitation.profile(scene.speed), initial=(*still, *0.0 * still))
    time = np.linspace(0.0, 0.12, 4001)
    run = simulate_rotor(mount(moving, films), duration=0.12, times=time, rtol=1e-9)
    wanted = np.hypot(run["disk_x"], run["disk_y"]).max()
    error = abs(answer.value - wanted) / wanted
    assert error < 2.0 * answer.error_estimate + 1e-5
    assert answer.error_estimate < 1e-3


@pytest.mark.closed_form
def test_a_lost_blade_is_a_sudden_unbalance():
    """It begins where the loss has it: a quarter of a turn later is a quarter of a turn farther."""
    lost = {"kind": "blade_loss", "unbalance": 1e-3, "node": 4, "revolutions": 2}
    quarter = {**lost, "start": 0.25 / 25.0, "unbalance_angle": -0.5 * math.pi}  # at 1500 rpm
    first, later = (asked(0.01, one, unbalances=[]).ask().value for one in (lost, quarter))
    assert first == pytest.approx(later, rel=1e-9)
    turned = asked(0.01, {**lost, "unbalance_angle": math.pi}, unbalances=[]).ask().value
    assert abs(turned - first) > 1e-3 * first


def test_the_place_that_goes_farthest_is_asked_about():
    pulse = {"kind": "ground", "acceleration": PULSE}
    left, disk, all_of = (asked(0.05, pulse, springs=True, at=at).ask().value for at in ("left", "disk", ""))
    assert left < disk == pytest.approx(all_of, rel=1e-12)


def test_what_is_no_run_of_a_shaft():
    motor = {"kind": "motor", "unbalance": 0.0, "inertia": 1.0, "stall_torque": 1.0, "idle_speed": 200.0}
    with pytest.raises(
        InputError, match=r"excitation\.kind must be unbalance, blade_loss, run_up or ground here"
    ):
        asked(0.1, motor).ask()
    lost = {"kind": "blade_loss", "unbalance": 1e-3, "node": 4}
    with pytest.raises(InputError, match=r"shaft\.unbalances must be none where a blade is lost at rest"):
        asked(0.1, lost).ask()


def test_a_run_that_touches_judges_nothing(monkeypatch):
    rung = ladder_of(asked(0.1, RUN_UP, springs=True, unbalances=[])).rungs[0]
    found = rung.answer(None)
    assert rung.estimate(found, None, 0.1).error < 0.1

    def touching(*given, **options):
        raise ContactError("journal must stay within the clearance")

    monkeypatch.setattr(shaft_peaks, "simulate_rotor", touching)
    told = rung.estimate(found, None, 0.1)
    assert told.error == math.inf
    assert "touches" in told.doubt
