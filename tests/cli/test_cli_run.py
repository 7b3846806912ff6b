"""The command `rotorfilm run`: what it shows and writes, and how it says contact."""

import csv
import json
from pathlib import Path

import pytest

from rotorfilm import ContactGrid, RollingBall
from rotorfilm.bearings import StepLoad
from rotorfilm.scenes import Scene, run_damper
from rotorfilm.scenes.new_scene import new_scene

EXAMPLES = Path(__file__).parents[2] / "examples"
SCENE = (EXAMPLES / "blade_loss.toml").read_text(encoding="utf-8")
SHORT = SCENE.replace("revolutions = 40", "revolutions = 2").replace('"0.25 deg"', '"2 deg"')


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "lost.toml"
    path.write_text(SHORT, encoding="utf-8")
    return path


def test_numbers_are_those_of_the_library(run, scene, tmp_path):
    code, out, err = run("run", scene, "--json", "--out", tmp_path / "motion.csv")
    assert (code, err) == (0, "")
    answer, expected = json.loads(out), run_damper(Scene.load(scene))
    assert answer["peak_eccentricity_ratio"] == pytest.approx(expected.peak_eccentricity_ratio, rel=1e-12)
    assert answer["peak_force"] == pytest.approx(expected.peak_force, rel=1e-12)
    assert answer["contact_time"] is None
    assert answer["start"] == 0.01
    with (tmp_path / "motion.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == expected.trajectory.time.size
    assert float(rows[-1]["x"]) == pytest.approx(expected.trajectory.position[0, -1], rel=1e-8)


def test_people_read_the_peak_and_get_a_chart(run, scene, tmp_path):
    code, out, _ = run("run", scene, "--chart", tmp_path / "motion.png")
    assert code == 0
    assert "largest eccentricity ratio" in out
    assert "none" in out
    assert (tmp_path / "motion.png").read_bytes().startswith(b"\x89PNG")


def test_two_fmus_do_what_one_system_does(run, scene):
    answers = [json.loads(run("run", scene, "--json", *more)[1]) for more in ((), ("--fmus",))]
    one, two = (answer["peak_eccentricity_ratio"] for answer in answers)
    assert one != two == pytest.approx(one, rel=2e-2)


def test_contact_keeps_what_there_is_and_fails(run, scene, tmp_path):
    hit = SHORT.replace("350 g mm", "1400 g mm").replace('film = { name = "map" }', "")
    scene.write_text(hit, encoding="utf-8")
    code, out, err = run("run", scene, "--json", "--out", tmp_path / "part.csv")
    assert code == 1
    assert "must stay inside the clearance and the film's range, got an eccentricity ratio of 0.99" in err
    answer = json.loads(out)
    assert 0.01 < answer["contact_time"] == answer["end"] < 0.03
    assert len((tmp_path / "part.csv").read_text(encoding="utf-8").splitlines()) > 10


def test_options_that_do_not_fit_are_refused(run):
    for option, table in (("--fmus", "damper"), ("--full", "contact")):
        code, _, err = run("run", EXAMPLES / "friswell.toml", option)
        assert code == 2
        assert f"friswell.toml: {option} must be given with a [{table}]" in err


def test_what_does_not_move_is_refused(run):
    code, _, err = run("run", EXAMPLES / "bush_wear.toml")
    assert code == 2
    assert "bush_wear.toml: " in err
    code, _, err = run("run", EXAMPLES / "compressor.toml")
    assert code == 2
    assert "operation is required for a run over time" in err


SWING = 'excitation={ kind = "sine", load = "0.4 N", frequency = "200 rad/s" }'


@pytest.mark.closed_form
def test_a_rolling_ball_swings_on_its_law_as_its_stiffness_says(run, tmp_path):
    path = tmp_path / "ball.toml"
    path.write_text(new_scene("contact"), encoding="utf-8")
    out, chart = tmp_path / "motion.csv", tmp_path / "motion.png"
    words = ["--set", SWING, "--set", 'operation={ speed = 0, duration = "32 ms" }']
    code, told, _ = run("run", path, *words, "--json", "--out", out, "--chart", chart)
    assert code == 0
    found, rest = json.loads(told), json.loads(run("solve", path, "--json")[1])
    assert found["model"] == "reduced law"
    assert found["time"][-1] == pytest.approx(0.032)
    # Slow swings are static: stiffness times swing of the approach is that of the load.
    swing = max(found["approach"]) - min(found["approach"])
    assert swing * rest["stiffness"] == pytest.approx(2.0 * 0.4, rel=0.05)
    assert out.read_text(encoding="utf-8").startswith("time,approach,force\n")
    assert chart.read_bytes().startswith(b"\x89PNG")
    code, _, err = run("run", path, *words, "--set", "contact.mass=0")
    assert code == 2
    assert "contact.mass must be positive" in err


def test_a_rolling_ball_is_followed_on_its_full_film(run, tmp_path):
    path = tmp_path / "ball.toml"
    path.write_text(new_scene("contact"), encoding="utf-8")
    step = ["--set", 'excitation={ kind = "step", load = "2 N" }', "--set", "contact.cells=20"]
    short = ["--set", 'operation={ speed = 0, duration = "0.02 ms" }']
    found = json.loads(run("run", path, *step, *short, "--full", "--json")[1])
    ball = RollingBall(
        radius=0.01, mass=0.033, modulus=206e9, poisson_ratio=0.3, viscosity=0.008,
        pressure_coefficient=5e-9, speed=0.9, load=10.0,
    )  # fmt: skip
    contact, load = ball.contact(ContactGrid(cells=(20, 20))), StepLoad(amplitude=0.2)
    own = contact.simulate(contact.stationary(), duration=2e-5 / ball.time_scale, W=ball.W, load=load)
    assert (found["model"], found["complete"]) == ("full film", True)
    assert found["approach"][-1] == pytest.approx(own.delta[-1] * ball.film_scale, rel=1e-9)


def test_a_blade_lost_above_a_film_is_the_unbalance_of_the_run_from_then_on(run, tmp_path):
    words = ["--set", "operation.duration=20 ms", "--set", "excitation.unbalance=500 g mm"]
    scene = EXAMPLES / "short.toml"
    lost = [*words, "--set", "excitation.kind=blade_loss", "--set", "excitation.revolutions=0.5"]
    from_rest = [*words, "--set", "excitation.kind=unbalance"]
    late = ["--set", "excitation.start=40 ms"]  # a turn
    answers = [
        json.loads(run("run", scene, *each, "--json")[1]) for each in (from_rest, lost, [*lost, *late])
    ]
    for answer in answers[1:]:
        assert answer["peaks"]["journal"] == pytest.approx(answers[0]["peaks"]["journal"], rel=1e-6)
    assert [answer["end"] for answer in answers] == pytest.approx([0.02, 0.02, 0.06])


def test_help_shows_an_example(run):
    code, out, _ = run("run", "--help")
    assert code == 0
    assert "Example: rotorfilm run" in out
    assert "--json" in out
