"""Questions of scenes: estimates beside true errors, tolerances, honest refusals."""

import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import scene_battery
from families import FAMILIES

from rotorfilm import InputError, ValidityWarning
from rotorfilm.analysis import equilibrium
from rotorfilm.analysis.driven_rotor import rest_on_film, rest_position, rotor_answers
from rotorfilm.analysis.equal_steps import ORDER, linear_march, march, peak
from rotorfilm.analysis.harmonic_balance import basis, constant, solve
from rotorfilm.bearings.damper.table import DamperTable
from rotorfilm.bearings.journal import ShortFilm
from rotorfilm.questions import ladder_of, ladders_of
from rotorfilm.questions.walk import NoAnswerError
from rotorfilm.scenes import QuestionTable, Scene, bundled_scene, families, parse_scene
from rotorfilm.scenes.film_rungs import extrapolated
from rotorfilm.scenes.scene import QUANTITIES
from rotorfilm.scenes.shared_tables import BladeLossTable, UnbalanceTable

ROOT = Path(__file__).parents[2]

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

SUBSET = [
    ("named film", 3),
    ("named film", 11),
    ("named film", 17),
    ("named film", 23),
    ("slim", 7),
    ("grooved", 2),
    ("whirl", 6),
    ("orbit", 1),
    pytest.param("orbit", 7, marks=pytest.mark.long),
    ("orbit", 9),
    ("blade loss", 2),
    ("damper", 5),
    ("damper", 13),
    ("damper", 17),
]
"""Families and seeds of the battery's scenes that run here; benchmarks/scene_battery.py runs hundreds."""


def asked(quantity, tolerance, scene=None):
    return replace(scene or bundled_scene(), question=QuestionTable(quantity=quantity, tolerance=tolerance))


SLIM = """
schema = 1
[journal]
radius = 0.05
length = 0.005
clearance = 1e-4
viscosity = 0.02
[operation]
speed = 200.0
load = 750.0
[question]
quantity = "stiffness"
tolerance = 0.01
"""


def test_stiffness_of_a_slim_bearing_is_estimated_near_the_wall():
    # The estimate must not be that of its own differences: a cheap film is close enough, and known to be.
    scene = parse_scene(SLIM, "slim.toml")
    answer = scene.solve()
    best = extrapolated(scene.bearing, (384, 32))
    moved = [
        equilibrium(best, load, scene.speed).position
        for load in np.array([0.0, -750.0]) + 15.0 * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
    ]
    exact = np.linalg.inv(np.stack([moved[0] - moved[1], moved[2] - moved[3]], axis=1) / 30.0)
    error = np.abs(answer.value - exact).max() / np.abs(exact).max()
    assert answer.met
    assert error < 0.004
    assert answer.error_estimate == pytest.approx(error, rel=0.5)


@pytest.mark.parametrize(("family", "seed"), SUBSET)
def test_estimate_is_within_a_factor_of_two_and_the_tolerance_is_met(family, seed):
    drawn = FAMILIES[family][1](np.random.default_rng(seed))
    first, *_ = scene_battery.judge(seed, drawn)
    if first.doubtful:
        assert first.verdict == "closest"
        return
    assert first.right, first
    if first.verdict == "chosen":
        assert first.met, first


@pytest.mark.parametrize("quantity", ["eccentricity_ratio", "stiffness", "unbalance_amplitude"])
def test_tighter_tolerance_never_selects_a_less_accurate_rung(quantity):
    names = [rung.name for rung in ladder_of(asked(quantity, 1.0)).rungs]
    answers = [asked(quantity, tolerance).ask() for tolerance in (0.3, 0.03, 0.003)]
    estimates = [answer.error_estimate for answer in answers]
    assert all(tight <= loose * (1.0 + 1e-9) for loose, tight in pairwise(estimates))
    places = [names.index(answer.model) for answer in answers]
    assert places == sorted(places)


def test_an_impossible_tolerance_is_answered_honestly():
    answer = asked("eccentricity_ratio", 1e-9).ask()
    assert not answer.met
    assert answer.next_model is None
    assert answer.message.startswith("no model meets the tolerance 1e-09; the closest is map")
    assert 1e-9 < answer.error_estimate < 1e-5
    assert answer.value == pytest.approx(bundled_scene().describe().equilibrium.eccentricity_ratio)
    skipped = [report for report in answer.rungs if report.verdict == "skipped"]
    assert skipped
    assert all("map is closer and was refused" in report.reason for report in skipped)


def test_named_film_is_the_only_one_that_answers():
    scene = bundled_scene()
    named = scene.with_tables(journal=replace(scene.journal, film=ShortFilm()))
    answer = asked("eccentricity_ratio", 1e-3, named).ask()
    assert [report.name for report in answer.rungs] == ["ShortFilm()"]
    assert not answer.met
    # the short film rests at .26630, the map at .27504: tests/bearings/journal/test_map.py
    assert answer.error_estimate == pytest.approx(0.27504 / 0.2663 - 1.0, rel=0.05)


def test_cost_of_the_answer_is_its_work_and_the_next_rung_is_priced():
    answer = asked("eccentricity_ratio", 1e-2).ask()
    assert answer.model == "map"
    chosen = answer.rungs[0]
    assert 3 <= chosen.work["tangents of map"] <= 20
    assert answer.cost > 0.0
    assert answer.next_cost > 0.0
    assert answer.estimate_cost == 0.0  # a verified bound costs nothing
    assert chosen.bound


def test_every_quantity_that_a_scene_may_ask_for_has_a_meaning_and_every_ladder_a_quantity():
    asked_for = {quantity for name in families.FAMILIES for quantity in ladders_of(name)}
    assert asked_for == set(QUANTITIES)


def test_quantity_without_its_table_is_refused_by_name():
    with pytest.raises(InputError, match=r"question.quantity must be one .*, got 'jump_up', .* \[damper\]"):
        asked("jump_up", 0.1).ask()
    with pytest.raises(InputError, match=r"rigid_rotor is required for whirl_threshold"):
        replace(asked("whirl_threshold", 0.1), rigid_rotor=None).ask()
    with pytest.raises(InputError, match=r"question is required for a ladder"):
        bundled_scene().ask()


def test_solve_answers_the_question_and_otherwise_describes():
    assert asked("eccentricity_ratio", 0.1).solve().met
    assert bundled_scene().solve().whirl_threshold.exists


@pytest.mark.filterwarnings("error")
def test_what_the_physics_leaves_out_is_warned_of():
    hot = parse_scene(
        """schema = 1
        [journal]
        radius = 0.1
        length = 0.1
        clearance = 5e-5
        viscosity = 0.1
        [operation]
        speed = "6000 rpm"
        load = "1 kN"
        [question]
        quantity = "minimum_film"
        tolerance = "1 %"
        """,
        "hot.toml",
    )
    with pytest.warns(ValidityWarning, match=r"left out: heat: the oil warms by about .* K"):
        answer = hot.ask()
    assert (
        "meets the tolerance 0.01 within isothermal films; but heat (up to 100%) is left out: "
        in answer.message
    )


@pytest.mark.convergence
def test_march_is_of_the_declared_order_and_meets_the_closed_form():
    class Spring:
        clearance = 1.0

        def force(self, position, velocity, speed):
            return -4.0 * position - 0.4 * velocity

        def jacobian(self, position, velocity, speed):
            return np.array([[-4.0, 0.0, -0.4, 0.0, 0.0], [0.0, -4.0, 0.0, -0.4, 0.0]])

    def error(count):
        path, _ = march(Spring(), 1.0, 1.0, lambda t: (0.1, 0.0), np.zeros(2), 5.0 / count, count)
        decay, rate = 0.2, math.sqrt(4.0 - 0.04)
        t = path.time
        exact = 0.025 * (1.0 - np.exp(-decay * t) * (np.cos(rate * t) + decay / rate * np.sin(rate * t)))
        K, C = 4.0 * np.eye(2)[:, :, None].repeat(t.size, 2), 0.4 * np.eye(2)[:, :, None].repeat(t.size, 2)
        pull = np.zeros((2, t.size))
        pull[0] = 0.1
        np.testing.assert_allclose(
            linear_march(0.25 * K, K, C, pull, 5.0 / count).position,
            path.position,
            atol=1e-9,
        )
        return np.abs(path.position[0] - exact).max()

    assert math.log2(error(100) / error(200)) == pytest.approx(ORDER, abs=0.05)


def test_peak_is_found_between_samples():
    t = np.linspace(0.0, 1.0, 41)
    position = np.array([1.0 - (t - 0.5137) ** 2, np.zeros_like(t)])
    assert peak(position) == pytest.approx(1.0, abs=1e-12)


def test_samples_of_an_odd_number_differentiate_a_series_exactly():
    angle, series = 2.0 * np.pi * np.arange(15) / 15, basis(7, 15)
    rate = series.slopes @ series.back
    np.testing.assert_allclose(rate @ np.sin(3.0 * angle), 3.0 * np.cos(3.0 * angle), atol=1e-12)
    np.testing.assert_allclose(series.values @ series.back, np.eye(15), atol=1e-12)


def test_nonlinear_orbit_is_a_solution_of_the_time_integration():
    from rotorfilm.analysis import simulate

    scene = bundled_scene()
    bearing = scene.bearing
    rotor = replace(scene.rotor, unbalance=0.006)
    at = rest_on_film(replace(rotor, speed=scene.speed), bearing)
    answers = rotor_answers(rotor.structure, at, (), 65)
    found = solve(answers.on({"": bearing}), constant(rest_position(at, ("",)), 32), scene.speed)
    position = found.series @ basis(32, 65).values.T
    period = 2.0 * math.pi / scene.speed
    begun = [*position[:, 0], *(scene.speed * found.series @ basis(32, 65).slopes[0])]
    times = period * np.arange(65) / 65
    # short steps, because Radau's interpolation between them is of low order
    run = simulate(
        rotor,
        bearing,
        duration=period,
        times=times,
        initial_state=begun,
        rtol=1e-9,
        max_step=period / 195,
    )
    np.testing.assert_allclose(run.position, position, atol=1e-6 * bearing.clearance)


def test_blade_loss_needs_a_lost_blade():
    with pytest.raises(InputError, match="blade_loss"):
        asked("peak_displacement", 0.1).ask()


def test_scene_files_with_a_question_meet_it():
    scene = Scene.load(ROOT / "examples" / "question.toml")
    assert scene.ask().met


@pytest.mark.parametrize(("tolerance", "model"), [(0.5, "closed form of the flux"), (1e-3, "exact")])
def test_critical_speed_of_a_bush_takes_the_closed_form_only_where_it_is_good_enough(tolerance, model):
    scene = Scene.load(ROOT / "examples" / "bush.toml")
    answer = asked("critical_speed", tolerance, scene).ask()
    assert (answer.model, answer.met) == (model, True)
    exact = ladder_of(asked("critical_speed", tolerance, scene)).rungs[-1].answer(None).value
    first = answer.rungs[0]
    assert first.error_estimate == pytest.approx(abs(first.value / exact - 1.0), rel=1e-6)


def test_command_line_shows_the_ladder_and_fails_where_no_rung_will_do(tmp_path, capsys):
    from rotorfilm.cli.main import main

    def run(*arguments):
        with pytest.raises(SystemExit) as end:
            main(["solve", *arguments])
        return end.value.code, capsys.readouterr()

    path = ROOT / "examples" / "question.toml"
    code, shown = run(str(path), "--explain")
    assert code in (0, None)
    for word in ("the ladder, the cheapest model first", "short film", "refused", "chosen", "why not"):
        assert word in shown.out
    strict = tmp_path / "strict.toml"
    text = (ROOT / "examples" / "friswell.toml").read_text(encoding="utf-8")
    question = '[question]\nquantity = "eccentricity_ratio"\ntolerance = 1e-9\n'
    strict.write_text(f"{text}\n{question}", encoding="utf-8")
    code, shown = run(str(strict))
    assert code == 1
    assert "no model meets the tolerance 1e-09" in shown.err
    assert "NOT met by any model" in shown.out
    code, shown = run(str(ROOT / "examples" / "friswell.toml"), "--explain")
    assert code == 2
    assert "--explain needs a scene with a [question]" in shown.err


HOT = """schema = 1
[journal]
radius = 0.05
length = 0.03
clearance = 1e-4
viscosity = 0.05
{openings}
[operation]
speed = {speed}
load = ["100 N", "-0.3 kN"]
[question]
quantity = "{quantity}"
tolerance = {tolerance}
"""


@pytest.mark.long
@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")
@pytest.mark.parametrize("family", ["fed", "pads"])
def test_bearings_with_openings_of_every_kind_are_answered(family):
    for seed in (1, 2):
        drawn = FAMILIES[family][1](np.random.default_rng(seed))
        first, *_ = scene_battery.judge(seed, drawn)
        assert first.doubtful or first.right, first
        assert first.verdict != "chosen" or first.met, first


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")
@pytest.mark.parametrize(
    ("openings", "quantity"),
    [
        ("grooves = [{ center = '10 deg', width = '30 deg' }]", "eccentricity_ratio"),
        ("grooves = [{ center = '10 deg', width = '30 deg' }]\nsupply_pressure = '1 bar'", "attitude_angle"),
        ("pads = [{ start = '200 deg', extent = '140 deg' }]", "minimum_film"),
        ("grooves = [{ center = '10 deg', width = '30 deg' }]", "power_loss"),
    ],
)
def test_openings_never_make_a_map_for_an_equilibrium_and_tighter_is_never_worse(
    openings, quantity, tmp_path, monkeypatch
):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path))
    errors = []
    for tolerance in (0.1, 1e-3, 1e-9):
        scene = HOT.format(openings=openings, speed=-200.0, quantity=quantity, tolerance=tolerance)
        answer = parse_scene(scene, "openings").ask()
        assert not any("map" in report.name for report in answer.rungs)
        assert list(tmp_path.iterdir()) == []
        errors.append(answer.error_estimate)
    assert not answer.met
    assert errors == sorted(errors, reverse=True)


def test_a_threshold_that_does_not_exist_is_not_looked_for_on_grids():
    # A journal this close to the wall is stable, even at 100 times the natural speed of so large a mass.
    scene = HOT.format(openings="", speed=100.0, quantity="whirl_threshold", tolerance=1e-3)
    heavy = scene.replace('["100 N", "-0.3 kN"]', '"900 kN"') + "[rigid_rotor]\nmass = 1e8\n"
    with pytest.raises(NoAnswerError, match=r"no threshold: .*, by map"):
        parse_scene(heavy, "heavy").ask()


def test_one_unbalance_and_one_table_answer():
    scene = bundled_scene()
    bare = replace(scene, rigid_rotor=replace(scene.rigid_rotor, unbalance=0.0))
    shaken = replace(scene, excitation=UnbalanceTable(unbalance=1e-4))
    with pytest.raises(InputError, match=r"rigid_rotor.unbalance must be 0 where \[excitation\] has"):
        asked("unbalance_amplitude", 1e-2, shaken).ask()
    lost = replace(bare, excitation=BladeLossTable(unbalance=1e-4))
    with pytest.raises(InputError, match=r'excitation must be of kind "unbalance" .* got BladeLossTable'):
        asked("unbalance_amplitude", 1e-2, lost).ask()
    both = bare.with_tables(damper=DamperTable(radius=0.05, length=0.02, clearance=1e-4, viscosity=0.01))
    with pytest.raises(
        InputError, match=r"one table, got 'unbalance_amplitude' of \[damper\] and \[journal\]"
    ):
        asked("unbalance_amplitude", 1e-2, both).ask()
