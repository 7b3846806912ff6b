"""Questions about ball bearings: estimates beside a separate program, steps of the ladder, refusals."""

import math

import numpy as np
import pytest
import scene_battery
from families import FAMILIES

from rotorfilm import ConvergenceError, InputError, SceneError
from rotorfilm.bearings.rolling import RunningBalls, questions as ball_questions
from rotorfilm.questions import ladder_of
from rotorfilm.scenes import parse_scene, read_scene

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

SEEDS = [1, 9]
"""Seeds of the battery's scenes that run here; benchmarks/scene_battery.py runs thirty."""

ROW = 'ball_diameter = "7.938 mm"\npitch_diameter = "33.5 mm"\n'
DEEP = f'schema = 1\n[ball_bearing]\nballs = 8\n{ROW}internal_clearance = "10 um"\n'
ANGULAR = f'schema = 1\n[ball_bearing]\nballs = 10\n{ROW}contact_angle = "25 deg"\nouter_conformity = 0.53\n'


def ladder(table, quantity, load=500.0, speed="10000 rpm", tolerance=1e-6):
    run = f'[operation]\nspeed = "{speed}"\nload = {load}\n[question]\nquantity = "{quantity}"\n'
    return parse_scene(f"{table}{run}tolerance = {tolerance}\n", "case.toml")


def rungs(*args, **kwargs):
    return {report.name: report for report in ladder(*args, **kwargs).ask().rungs}


@pytest.mark.long
@pytest.mark.parametrize("seed", SEEDS)
def test_estimate_is_within_a_factor_of_two_and_the_tolerance_is_met(seed):
    drawn = FAMILIES["ball bearing"][1](np.random.default_rng(seed))
    first, *_ = scene_battery.judge(seed, drawn)
    assert not first.doubtful
    assert first.right, first
    if first.verdict == "chosen":
        assert first.met, first


@pytest.mark.closed_form
@pytest.mark.parametrize(("load", "low", "high"), [(100.0, 54.1, 77.2), (500.0, 267.0, 312.0)])
def test_the_closed_load_is_off_by_what_the_loaded_zone_makes_of_it(load, low, high):
    """Own code of the physics: largest load of a ball beside and under the load, 4.37 W/Z against it."""
    found = rungs(DEEP, "contact_load", load=load, speed="10 rpm")
    closed, static = found["closed form"], found["static balls"]
    assert closed.value == pytest.approx(4.3701 * load / 8.0, rel=1e-4)
    under = DEEP + "cage_angle = 0.39269908\n"
    beside = rungs(under, "contact_load", load=load, speed="10 rpm")["static balls"]
    assert {round(static.value), round(beside.value)} <= {
        round(x) + d for x in (low, high) for d in (-1, 0, 1)
    }
    assert closed.error_estimate == pytest.approx(abs(closed.value / static.value - 1.0), abs=2e-4)


@pytest.mark.closed_form
@pytest.mark.parametrize(("speed", "change"), [("10000 rpm", 0.020), ("30000 rpm", 0.652)])
def test_static_balls_are_too_stiff_along_the_shaft_by_their_inertia(speed, change):
    """Under 500 N of thrust; 6.190e7 and 2.204e7 N/m by an independent code of balls that friction holds."""
    found = rungs(ANGULAR + "axial_load = 500\n", "axial_stiffness", load=1.0, speed=speed)
    static, running = found["static balls"], found["running balls"]
    assert running.value / static.value - 1.0 == pytest.approx(-change, abs=0.004)
    if change < 0.1:
        assert static.error_estimate == pytest.approx(1.0 / (1.0 - change) - 1.0, rel=0.1)


def test_films_are_the_last_rung_and_only_on_oil():
    oil = "viscosity = 0.02\npressure_coefficient = 2e-8\nroughness = 2e-7\n"
    thrust = ANGULAR + "axial_load = 300\n"
    assert [rung.name for rung in ladder_of(ladder(thrust, "stiffness")).rungs][-1] == "running balls"
    found = rungs(thrust + oil, "stiffness")
    assert list(found)[-1] == "running balls on films"
    dry, wet = (found[name].value[1, 1] for name in ("running balls", "running balls on films"))
    assert found["running balls"].error_estimate == pytest.approx(abs(dry / wet - 1.0), rel=0.5)
    given = ladder_of(ladder(thrust + 'inertia = "static"\n', "stiffness")).rungs
    assert [rung.name for rung in given] == ["static balls"]


def test_a_film_parameter_needs_oil_and_roughness():
    with pytest.raises(InputError, match="ball_bearing must turn, with viscosity, pressure_coef"):
        ladder_of(ladder(DEEP, "film_parameter"))
    oil = "viscosity = 0.02\npressure_coefficient = 2e-8\n"
    thin, thick = (
        ladder(f"{DEEP}{oil}roughness = {rough}\n", "film_parameter", tolerance=0.05).ask().value
        for rough in (2e-7, 1e-7)
    )
    assert thick == pytest.approx(2.0 * thin, rel=1e-9)


def test_what_is_not_known_of_the_friction_of_balls_is_told():
    """Axial stiffness at half the traction coefficient, by an independent code: 2.511 in place of 2.204."""
    fast = ladder(ANGULAR + "axial_load = 500\n", "axial_stiffness", 1.0, "30000 rpm", 0.5)
    (line,) = fast.ask().assumptions
    assert line.startswith("friction of balls: half or double its numbers would change it by ")
    share = float(line.rpartition(" ")[2].rstrip("%")) / 100.0
    assert share == pytest.approx(1.0 - 2.204 / 2.511, abs=2e-3)


@pytest.mark.parametrize(
    ("fewest", "said"), [(0.06, "by 6.4%; with 1 of 4"), (9.0, "not known; with 4 of 4")]
)
def test_friction_is_told_of_too_where_some_of_it_has_no_rest(monkeypatch, fewest, said):
    """Half the traction coefficient, or all that is not the bearing's own, finds no rest."""
    own = RunningBalls()

    def rest_under(bearing, load, speed):
        law = bearing.law
        if isinstance(law, RunningBalls) and law != own and law.traction_coefficient < fewest:
            raise ConvergenceError("no rest")
        return find(bearing, load, speed)

    find = ball_questions.rolling_scene.rest_under
    fast = ladder(ANGULAR + "axial_load = 500\n", "axial_stiffness", 1.0, "30000 rpm", 0.5)
    assumed = ladder_of(fast).assumptions
    monkeypatch.setattr(ball_questions.rolling_scene, "rest_under", rest_under)
    (line,) = assumed()
    assert said in line
    assert line.endswith(" such changes there is no rest")


def test_control_by_the_other_race_is_an_assumption_that_is_told():
    controlled = ANGULAR + 'axial_load = 500\ninertia = "race_control"\n'
    fast = ladder(controlled, "contact_angle", 1.0, "30000 rpm", 0.5)
    (line,) = fast.ask().assumptions
    assert line.startswith("outer race control: control by the other race would change it by ")
    share = float(line.rpartition(" ")[2].rstrip("%")) / 100.0
    assert share == pytest.approx(math.radians(2.0), rel=0.5)  # some 2 deg


def test_life_is_not_among_the_quantities():
    with pytest.raises(SceneError, match="must be one of eccentricity_ratio, "):
        read_scene({"schema": 1, "question": {"quantity": "life", "tolerance": 0.1}}, "case.toml")
