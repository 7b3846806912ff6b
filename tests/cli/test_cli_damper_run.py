"""The command `rotorfilm damper-run`: what it shows and writes, and how it says contact."""

import csv
import json
from pathlib import Path

import pytest

from rotorfilm.scenes import Scene
from rotorfilm.scenes.solve_damper import run_damper

SCENE = (Path(__file__).parents[2] / "examples" / "blade_loss.toml").read_text(encoding="utf-8")
SHORT = SCENE.replace("revolutions = 40", "revolutions = 2").replace('"0.25 deg"', '"2 deg"')


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "lost.toml"
    path.write_text(SHORT, encoding="utf-8")
    return path


def test_numbers_are_those_of_the_library(run, scene, tmp_path):
    code, out, err = run("damper-run", scene, "--json", "--out", tmp_path / "motion.csv")
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
    code, out, _ = run("damper-run", scene, "--chart", tmp_path / "motion.png")
    assert code == 0
    assert "largest eccentricity ratio" in out
    assert "none" in out
    assert (tmp_path / "motion.png").read_bytes().startswith(b"\x89PNG")


def test_two_fmus_do_what_one_system_does(run, scene):
    answers = [json.loads(run("damper-run", scene, "--json", *more)[1]) for more in ((), ("--fmus",))]
    one, two = (answer["peak_eccentricity_ratio"] for answer in answers)
    assert one != two == pytest.approx(one, rel=2e-2)


def test_contact_keeps_what_there_is_and_fails(run, scene, tmp_path):
    hit = SHORT.replace("350 g mm", "1400 g mm").replace('film = { name = "map" }', "")
    scene.write_text(hit, encoding="utf-8")
    code, out, err = run("damper-run", scene, "--json", "--out", tmp_path / "part.csv")
    assert code == 1
    assert "must stay inside the clearance and the film's range, got an eccentricity ratio of 0.99" in err
    answer = json.loads(out)
    assert 0.01 < answer["contact_time"] == answer["end"] < 0.03
    assert len((tmp_path / "part.csv").read_text(encoding="utf-8").splitlines()) > 10


def test_scene_without_a_damper_is_refused(run, tmp_path):
    other = Path(__file__).parents[2] / "examples" / "friswell.toml"
    code, _, err = run("damper-run", other)
    assert code == 2
    assert "damper and rigid_rotor are required" in err


def test_solve_says_where_to_turn_with_a_damper(run, scene):
    code, _, err = run("solve", scene)
    assert code == 2
    assert "`rotorfilm damper-run` is for [damper]" in err


def test_help_shows_an_example(run):
    code, out, _ = run("damper-run", "--help")
    assert code == 0
    assert "Example: rotorfilm damper-run" in out
    assert "--json" in out
