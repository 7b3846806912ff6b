"""The command `rotor`: its numbers, files, JSON, and one line for each mistake."""

import csv
import json
import math
from pathlib import Path

import pytest

from rotorfilm.scenes import Scene
from rotorfilm.scenes.shaft.shaft_remarks import shaft_remarks
from rotorfilm.scenes.shaft.solve_shaft import solve_rotor

SCENE = Path(__file__).parents[2] / "examples" / "flexible_rotor.toml"


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    """The example with fewer speeds."""
    path = tmp_path_factory.mktemp("scene") / "short.toml"
    path.write_text(SCENE.read_text().replace("count = 45", "count = 12"))
    return path


def test_numbers_are_those_of_the_library_and_files_come_along(run, short, tmp_path):
    code, out, _ = run("rotor", short, "--json", "--out", tmp_path / "out")
    assert code == 0
    found, answer = json.loads(out), solve_rotor(Scene.load(short))
    assert found["threshold"]["speed"] == pytest.approx(answer.threshold.speed, rel=1e-9)
    # whip of example 5.9.6 on the map film, half the speed
    assert found["threshold"]["speed"] == pytest.approx(2084.9 * math.pi / 30, rel=1e-4)
    assert found["threshold"]["whirl_ratio"] == pytest.approx(0.5, abs=2e-3)
    assert [one["speed"] for one in found["critical_speeds"]] == pytest.approx(
        [one.speed for one in answer.critical_speeds]
    )
    assert json.loads((tmp_path / "out" / "rotor.json").read_text()) == found
    names = {"campbell.png", "log_decrement.png", "unbalance_response.png", "rotor.json"}
    assert {path.name for path in (tmp_path / "out").iterdir()} == names | {
        "campbell.csv",
        "unbalance_response.csv",
    }
    with (tmp_path / "out" / "unbalance_response.csv").open() as file:
        heading, *rows = list(csv.reader(file))
    assert heading[0] == "speed [rad/s]"
    assert "small_x [m]" in heading
    column = heading.index("small_x [m]")
    assert [float(row[column]) for row in rows] == pytest.approx(found["amplitudes"]["small_x"], rel=1e-8)


def test_people_read_rpm(run, short):
    code, out, _ = run("rotor", short)
    assert code == 0
    assert "107.117 kg, 104 states" in out
    assert "2084.8" in out
    assert "forward" in out
    assert "largest small_x" in out


def test_help_has_an_example(run):
    code, out, _ = run("rotor", "--help")
    assert code == 0
    assert "rotorfilm rotor examples/flexible_rotor.toml" in " ".join(out.split())


def test_a_scene_without_a_shaft_is_bad_input(run):
    code, _, err = run("rotor", SCENE.with_name("friswell.toml"))
    assert code == 2
    assert "shaft is required" in " ".join(err.split())
    assert run("rotor", "missing.toml")[0] == 2


def test_a_rotor_that_no_film_carries_is_a_failed_computation(run, short, tmp_path):
    path = tmp_path / "heavy.toml"
    path.write_text(short.read_text().replace("0.1 Pa s", "1e-9 Pa s"))
    code, _, err = run("rotor", path)
    assert code == 1
    assert len(err.strip().splitlines()) >= 1


def test_what_shaft_and_films_leave_out_is_said(run, short):
    remarks = json.loads(run("rotor", short, "--json")[1])["remarks"]
    scene = Scene.load(short)
    rotor, bearings = scene.shaft.build(), scene.shaft.build_bearings()
    fastest = scene.shaft.speeds.build()[-1]
    assert remarks == list(shaft_remarks(rotor, bearings, scene.lubricant.properties, fastest))
    assert [line.split(": ")[:2] for line in remarks] == [
        [f"{name}, at {fastest:.4g} rad/s", "heat"] for name in ("left", "right")
    ]
    assert run("rotor", short)[1].count("left out") == 2


def test_a_run_over_time_is_followed_and_written(run, tmp_path):
    quake = (SCENE.parent / "earthquake.toml").read_text(encoding="utf-8")
    scene = tmp_path / "quake.toml"
    rows = "[[0.0, 0.0], [0.02, 3.0], [0.04, 0.0]]"
    scene.write_text(quake.replace('"earthquake.csv"', rows), encoding="utf-8")
    code, out, _ = run("rotor-run", scene, "--json", "--out", tmp_path / "motion.csv")
    assert code == 0
    found = json.loads(out)
    assert found["end"] == pytest.approx(0.04)
    assert set(found["peaks"]) == {"left", "right", "disk"}
    assert found["work"]["steps"] > 0
    assert (tmp_path / "motion.csv").read_text(encoding="utf-8").startswith("time")
