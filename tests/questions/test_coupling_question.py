"""Which coupling keeps a journal within a tolerance: estimates beside true errors, predictions, refusals."""

import math
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import scene_battery
from families import FAMILIES
from scipy.integrate import solve_ivp

from rotorfilm import Groove, InputError
from rotorfilm.analysis import simulate
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.cosim import GaussSeidel, Jacobi, SIExp, SIExp3, critical_macro_step
from rotorfilm.cosim.coupling_error import SCHEMES, CouplingCase, inner_motion, law_forces, propagated
from rotorfilm.questions import ladder_of
from rotorfilm.rotors import ForceLaw, RigidRotor
from rotorfilm.scenes import QuestionTable, Scene, bundled_scene
from rotorfilm.scenes.shared_tables import StepLoadTable
from rotorfilm.studies.coupling_cost import cost_case

ROOT = Path(__file__).parents[2]

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")


def asked(tolerance, revolutions=0.5, scene=None):
    scene = scene or bundled_scene()
    return replace(
        scene,
        question=QuestionTable(quantity="cosimulation_error", tolerance=tolerance),
        cosimulation=replace(scene.cosimulation, revolutions=revolutions),
    )


@cache
def case():
    """Half a turn to eccentricity ratio .8 with strong unbalance."""
    rotor, bearing = cost_case()
    return CouplingCase(rotor=rotor, reaction=bearing, revolutions=0.5)


@cache
def whole():
    """Return times and positions of the same motion as one system."""
    duration = math.pi / case().rotor.profile.speeds[0]
    times = np.linspace(0.0, duration, 721)
    return times, simulate(case().rotor, case().reaction, duration=duration, times=times, rtol=1e-10).position


def true_error(run):
    times, position = whole()
    own = run.outcome.trajectory
    at = np.round(own.time / times[1]).astype(int)
    met = np.abs(own.time - times[at]) < 1e-6 * times[1]
    return np.hypot(*(own.position[:, met] - position[:, at[met]])).max() / case().reaction.clearance


def law_of(random, start):
    """Return a force law as a stiff film has it."""
    return ForceLaw(
        start,
        random.normal(size=2),
        random.normal(size=2) * 10.0,
        random.normal(size=2) * 100.0,
        random.normal(size=(2, 2)) * 30.0 + 100.0 * np.eye(2),
        random.normal(size=(2, 2)) * 3.0 + 20.0 * np.eye(2),
        random.normal(size=2) * 0.01,
        random.normal(size=2) * 0.1,
    )


def test_motion_within_a_macro_step_is_that_of_an_integrator():
    random = np.random.default_rng(7)
    rotor = RigidRotor(
        mass=0.7,
        speed=-3.0,
        unbalance=0.02,
        unbalance_angle=0.4,
        gravity=(0.1, -0.2),
        static_force=(0.3, 0.0),
    )
    law, start, end = law_of(random, 0.2), random.normal(size=4) * 0.01, 0.5
    motion = inner_motion(rotor, [law], start[:2, None], start[2:, None], np.array([0.2, end]))
    run = solve_ivp(
        lambda t, x: rotor.derivative(t, x, law.at(t, x[:2], x[2:])),
        (0.2, end),
        start,
        rtol=1e-12,
        atol=1e-14,
    )
    last = [*motion.position[:, -1, -1], *motion.velocity[:, -1, -1]]
    np.testing.assert_allclose(last, run.y[:, -1], rtol=1e-9, atol=1e-12)
    assert motion.parts > 1
    force = law_forces([law], motion)[:, -1, -1]
    np.testing.assert_allclose(force, law.at(end, run.y[:2, -1], run.y[2:, -1]), rtol=1e-8)


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.label)
def test_motion_within_macro_steps_ends_where_the_coupled_run_does(scheme):
    run = case().run(scheme, math.radians(1.0))
    own = run.outcome.trajectory
    motion = inner_motion(case().rotor, run.laws, own.position[:, :-1], own.velocity[:, :-1], own.time)
    ends = motion.position[:, motion.parts - 1 :: motion.parts, -1]
    np.testing.assert_allclose(ends, own.position[:, 1:], atol=1e-9 * case().reaction.clearance)


def propagation_error(count):
    """Return the error at the end of a linear motion with K, C and pull that vary in time."""
    mass, duration = 2.0, 3.0
    dt = np.full(count, duration / count)
    nodes = np.array([(4.0 - math.sqrt(6.0)) / 10.0, (4.0 + math.sqrt(6.0)) / 10.0, 1.0])
    t = (np.arange(count)[:, None] + nodes) * dt[0]

    def matrices(t):
        K = np.array([[5.0 + np.sin(t), 2.0 + 0.0 * t], [-2.0 + 0.0 * t, 7.0 + np.cos(2.0 * t)]])
        C = np.array([[3.0 + np.cos(t), 0.5 + 0.0 * t], [0.5 + 0.0 * t, 2.0 + np.sin(3.0 * t)]])
        return K, C, np.array([np.cos(2.0 * t), np.sin(t)])

    K, C, pull = matrices(t)
    slopes = np.concatenate([-K, -C, np.zeros((2, 1, count, 3))], axis=1)
    q, rates = propagated(mass, dt, slopes, pull)

    def derivative(t, x):
        K, C, pull = matrices(t)
        return [*x[2:], *(pull - K @ x[:2] - C @ x[2:]) / mass]

    run = solve_ivp(derivative, (0.0, duration), np.zeros(4), rtol=1e-12, atol=1e-14)
    return np.abs([*q[:, -1, -1], *rates[:, -1, -1]] - run.y[:, -1]).max()


def test_propagation_is_of_order_five():
    errors = [propagation_error(count) for count in (10, 20, 40)]
    orders = [math.log2(coarse / fine) for coarse, fine in pairwise(errors)]
    assert orders == pytest.approx([5.0, 5.0], abs=0.4)


@pytest.mark.parametrize(
    ("scheme", "degrees"),
    [
        (GaussSeidel(), 4.0),
        (GaussSeidel(), 1.0),
        (GaussSeidel(degree=1), 4.0),
        (GaussSeidel(degree=2), 1.0),
        (Jacobi(), 2.0),
        (Jacobi(degree=1), 1.0),
        (SIExp(), 15.0),
        (SIExp(), 1.0),
        (SIExp3(), 15.0),
        (SIExp3(), 1.0),
    ],
    ids=lambda value: getattr(value, "label", value),
)
def test_estimate_is_the_distance_from_the_monolithic_solution(scheme, degrees):
    run = case().run(scheme, math.radians(degrees))
    found = case().drift(run)
    assert not found.doubt
    assert found.error == pytest.approx(true_error(run), rel=0.03)


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.label)
def test_errors_of_all_schemes_are_predicted_from_one_run(scheme):
    angle = math.radians(1.0)
    assert case().predicted(scheme, angle) == pytest.approx(true_error(case().run(scheme, angle)), rel=0.3)


def test_instability_is_known_beforehand():
    long = replace(case(), revolutions=20.0)
    limit = critical_macro_step(long.rotor, long.reaction, state=long.rotor.initial_state).macro_step
    angle = limit * long.rotor.profile.speeds[0]
    assert long.instability(GaussSeidel(), 0.99 * angle) == ""
    assert "per step at rest" in long.instability(GaussSeidel(), 1.1 * angle)
    # a growth that the run is too short for is not refused
    assert replace(long, revolutions=0.05).instability(GaussSeidel(), 1.02 * angle) == ""
    assert long.instability(SIExp3(), math.radians(16.0)) == ""


def test_rungs_go_by_the_calls_of_the_film():
    rungs = ladder_of(asked(1e-3)).rungs
    calls = [rung.calls for rung in rungs]
    assert calls == sorted(calls)
    assert {rung.scheme for rung in rungs} == set(SCHEMES)
    answer = asked(1e-3).ask()
    work = next(report for report in answer.rungs if report.verdict == "chosen").work
    chosen = next(rung for rung in rungs if rung.name == answer.model)
    assert work == {unit.name: count for unit, count in chosen.expected({}).items()}


def test_tighter_tolerance_takes_no_less_accurate_coupling_and_an_impossible_one_is_refused():
    answers = [asked(tolerance).ask() for tolerance in (3e-2, 1e-3, 1e-4, 1e-5, 1e-9, 1e-10)]
    estimates = [answer.error_estimate for answer in answers]
    assert all(tight <= loose * (1.0 + 1e-9) for loose, tight in pairwise(estimates))
    assert [answer.met for answer in answers[:-1]] == [True] * 5
    assert all(1.5 * answer.error_estimate < answer.tolerance for answer in answers[:-1])
    impossible = answers[-1]
    assert (impossible.model, impossible.met) == ("SI-exp3, 0.125 deg", False)
    twice = next(report for report in answers[-2].rungs if report.name == "SI-exp3, 0.25 deg")
    assert impossible.error_estimate == pytest.approx(twice.error_estimate / 8.0, rel=0.05)  # of third order
    reasons = [report.reason for report in impossible.rungs if report.verdict == "refused"]
    assert any("past the limit" in reason for reason in reasons)
    assert any("predicted error" in reason for reason in reasons)


@pytest.mark.parametrize(("family", "seed"), [("coupling", 7), ("coupling hard", 8), ("coupling other", 3)])
def test_scene_of_the_battery_is_answered_right(family, seed):
    drawn = FAMILIES[family][1](np.random.default_rng(seed))
    drawn.data["cosimulation"]["revolutions"] = 1.0
    first, *_ = scene_battery.judge(seed, drawn)
    assert first.right, first
    assert first.verdict != "chosen" or first.met


def test_damper_and_grooved_bearing_are_coupled_too():
    damper = next(
        data
        for seed in range(20)
        if "damper" in (data := FAMILIES["coupling other"][1](np.random.default_rng(seed)).data)
    )
    damper["cosimulation"]["revolutions"] = 0.5
    found = scene_battery.read_scene(damper, "damper").ask()
    assert found.met
    scene = bundled_scene()
    grooved = replace(scene.journal, grooves=(Groove(center=0.0, width=0.4),))
    rungs = ladder_of(asked(1e-2, 0.25, scene.with_tables(journal=grooved))).rungs
    assert rungs[0].name.endswith("2-D 48 x 4")
    assert not isinstance(rungs[0].case.reaction.film, MapFilm)


def test_run_shorter_than_a_macro_step_is_answered():
    answer = asked(1e-4, 0.005).ask()
    assert answer.met
    assert answer.next_model is not None


def test_estimates_hold_far_below_any_tolerance_of_use():
    coarse, fine = (case().run(SIExp3(), math.radians(angle)) for angle in (0.5, 0.25))
    gap = coarse.outcome.trajectory.position - fine.outcome.trajectory.position[:, ::2]
    # of third order: half the step leaves an eighth
    richardson = 8.0 / 7.0 * np.hypot(*gap).max() / case().reaction.clearance
    assert richardson < 3e-7
    assert case().drift(coarse).error == pytest.approx(richardson, rel=0.05)


def test_example_names_its_coupling():
    answer = Scene.load(ROOT / "examples" / "coupling.toml").ask()
    assert answer.met
    assert answer.model.startswith("SI-exp")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda scene: replace(scene, rigid_rotor=None), "rigid_rotor is required for cosimulation_error"),
        (
            lambda scene: replace(scene, rigid_rotor=replace(scene.rigid_rotor, unbalance=0.0)),
            "unbalance must be positive for cosimulation_error, got 0.0",
        ),
        (
            lambda scene: replace(scene, excitation=StepLoadTable(load=(1.0, 0.0))),
            "excitation must be left out for cosimulation_error, got StepLoadTable",
        ),
        (
            lambda scene: replace(scene, operation=replace(scene.operation, speed=0.0)),
            "operation.speed must not be zero for cosimulation_error",
        ),
        (
            lambda scene: replace(scene, cosimulation=replace(scene.cosimulation, revolutions=300.0)),
            "cosimulation.revolutions must be at most 177.8 for cosimulation_error, got 300",
        ),
    ],
)
def test_scene_that_cannot_be_coupled_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        ladder_of(change(asked(1e-3)))
