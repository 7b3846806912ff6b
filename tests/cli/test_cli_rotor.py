"""`rotorfilm solve` of a shaft: its numbers, files, JSON, and one line for each mistake."""

import csv
import json
import math
from pathlib import Path

import pytest

from rotorfilm.scenes import Scene
from rotorfilm.scenes.solve_shaft import level_one_remarks, shaft_remarks, solve_rotor

SCENE = Path(__file__).parents[2] / "examples" / "flexible_rotor.toml"


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    """The example with fewer speeds."""
    path = tmp_path_factory.mktemp("scene") / "short.toml"
    path.write_text(SCENE.read_text().replace("count = 45", "count = 12"))
    return path


@pytest.mark.long
def test_numbers_are_those_of_the_library_and_files_come_along(run, short, tmp_path):
    code, out, _ = run("solve", short, "--json", "--out", tmp_path / "out")
    assert code == 0
    found, answer = json.loads(out), solve_rotor(Scene.load(short))
    assert found["threshold"]["speed"] == pytest.approx(answer.threshold.speed, rel=1e-9)
    # whip of example 5.9.6 on the map film, half the speed
    assert found["threshold"]["speed"] == pytest.approx(2084.9 * math.pi / 30, rel=1e-4)
    assert found["threshold"]["whirl_ratio"] == pytest.approx(0.5, abs=2e-3)
    assert [one["speed"] for one in found["critical_speeds"]] == pytest.approx(
        [one.speed for one in answer.critical_speeds]
    )
    assert json.loads((tmp_path / "out" / "answer.json").read_text()) == found
    names = {"campbell.png", "log_decrement.png", "unbalance_response.png", "answer.json"}
    assert {path.name for path in (tmp_path / "out").iterdir()} == names | {
        "campbell.csv",
        "unbalance_response.csv",
    }
    scene = Scene.load(short)
    fastest = scene.shaft.speeds.build()[-1]
    parts = scene.shaft.build(), scene.shaft.build_bearings()
    remarks = shaft_remarks(*parts, scene.lubricant.properties, fastest)
    assert found["remarks"] == list(remarks)
    assert [line.split(": ")[:2] for line in remarks] == [
        [f"{name}, at {fastest:.4g} rad/s", effect]
        for name in ("left", "right")
        for effect in ("heat", "tilt")
    ]
    with (tmp_path / "out" / "unbalance_response.csv").open() as file:
        heading, *rows = list(csv.reader(file))
    assert heading[0] == "speed [rad/s]"
    assert "small_x [m]" in heading
    column = heading.index("small_x [m]")
    assert [float(row[column]) for row in rows] == pytest.approx(found["amplitudes"]["small_x"], rel=1e-8)


@pytest.mark.long
def test_people_read_rpm(run, short):
    code, out, _ = run("solve", short)
    assert code == 0
    assert "107.117 kg, 104 states" in out
    assert "2084.8" in out
    assert "forward" in out
    assert "largest small_x" in out
    assert out.count("left out") == 4  # heat of which no oil survives, and tilt, in both bearings


def test_a_rotor_that_no_film_carries_is_a_failed_computation(run, short, tmp_path):
    path = tmp_path / "heavy.toml"
    path.write_text(short.read_text().replace("0.1 Pa s", "1e-9 Pa s"))
    code, _, err = run("solve", path)
    assert code == 1
    assert len(err.strip().splitlines()) >= 1


COMPRESSOR = SCENE.with_name("compressor.toml")
SEAL = """
[[shaft.bearings]]
name = "wear_ring"
node = 5
[shaft.bearings.seal]
radius = 0.06
length = 0.025
clearance = 6e-4
pressure_drop = 6e5
viscosity = 1e-3
density = 1e3
"""


FEW = ["--set", "shaft.speeds.count=5"]


@pytest.mark.long
def test_stability_of_a_compressor(run, tmp_path):
    code, out, _ = run("solve", COMPRESSOR, *FEW, "--json", "--out", tmp_path / "out")
    assert code == 0
    whole, widths = json.loads(out), (15.0, 14.0, 13.0, 12.0, 11.0)
    found = whole["level_one"]
    gases = zip((5.0, 6.0, 7.2, 8.6, 10.3), (6.0, 7.2, 8.6, 10.3, 12.4), strict=True)
    wanted = [
        3.0 * 60e3 * 9.5493 / (400.0 * width * 4000.0) * after / before * 1e6
        for width, (before, after) in zip(widths, gases, strict=True)
    ]
    assert found["stage_cross_coupling"] == pytest.approx(wanted, rel=1e-5)
    assert found["margin"] == pytest.approx(found["zero_cross_coupling"] / sum(wanted), rel=1e-5)
    assert found["critical_speed_ratio"] < 1.0
    assert found["verdict"] == "acceptable: no analysis of level II is required"
    assert [curve["name"] for curve in found["curves"]] == ["smallest clearance", "largest clearance"]
    files = {f"stability_level_one.{ending}" for ending in ("png", "csv")} | {"answer.json", "campbell.png"}
    assert files < {path.name for path in (tmp_path / "out").iterdir()}
    assert json.loads((tmp_path / "out" / "answer.json").read_text()) == whole
    with (tmp_path / "out" / "stability_level_one.csv").open() as file:
        heading, *rows = list(csv.reader(file))
    assert heading[1] == "smallest clearance log decrement [1]"
    assert [float(row[1]) for row in rows] == pytest.approx(found["curves"][0]["log_decrement"], rel=1e-8)


@pytest.fixture(scope="module")
def sealed(tmp_path_factory):
    """The compressor with a seal next to its middle."""
    path = tmp_path_factory.mktemp("scene") / "sealed.toml"
    path.write_text(COMPRESSOR.read_text() + SEAL)
    return path


@pytest.mark.long
def test_stability_of_a_compressor_is_read_by_people(run, sealed, tmp_path):
    code, out, _ = run("solve", sealed, *FEW, "--out", tmp_path / "out")
    assert code == 0
    text = " ".join(out.split())
    whole = json.loads((tmp_path / "out" / "answer.json").read_text())
    found = whole["level_one"]
    loose = found["curves"][1]
    assert f"margin Q0/QA {found['margin']:.4g}" in text
    assert f"least log decrement with QA {loose['anticipated_decrement']:.4g} (largest clearance)" in text
    first, last = loose["log_decrement"][0], loose["log_decrement"][-1]
    assert first > last
    course = f"from {first:.4g} without to {last:.4g} at {loose['cross_coupling'][-1]:.4g} N/m (falling)"
    assert f"log decrement, largest clearance {course}" in text
    remarks = list(level_one_remarks(Scene.load(sealed)))
    assert set(remarks) <= set(whole["remarks"])
    assert all(f"left out {line}" in text for line in remarks)


def test_what_is_left_out_of_a_compressor_is_said(sealed):
    """Heat of the films of the tight bearings; nothing of a seal, whose mass is taken."""
    scene = Scene.load(sealed)
    rotor, speed = scene.shaft.build(), scene.shaft.compressor.speed
    wanted = {
        line
        for case in scene.shaft.compressor.cases(scene.shaft.bearings).values()
        for line in shaft_remarks(rotor, case, scene.lubricant.properties, speed)
    }
    remarks = level_one_remarks(scene)
    assert {line.split(" clearance: ")[-1] for line in remarks} == wanted
    assert not any("added mass" in line for line in remarks)
    assert any(line.startswith("smallest clearance: left, at ") and "heat: " in line for line in remarks)


def test_a_bad_compressor_names_its_key(run, tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text(COMPRESSOR.read_text().replace('width = "13 mm"', 'width = "-13 mm"'))
    code, _, err = run("solve", path)
    assert code == 2
    assert "shaft.compressor.impellers[2].width must be finite and positive" in err


def test_a_run_over_time_is_followed_and_written(run, tmp_path):
    quake = (SCENE.parent / "earthquake.toml").read_text(encoding="utf-8")
    scene = tmp_path / "quake.toml"
    rows = "[[0.0, 0.0], [0.02, 3.0], [0.04, 0.0]]"
    scene.write_text(quake.replace('"earthquake.csv"', rows), encoding="utf-8")
    code, out, _ = run("run", scene, "--json", "--out", tmp_path / "motion.csv")
    assert code == 0
    found = json.loads(out)
    assert found["end"] == pytest.approx(0.04)
    assert set(found["peaks"]) == {"left", "right", "disk"}
    assert found["work"]["steps"] > 0
    assert (tmp_path / "motion.csv").read_text(encoding="utf-8").startswith("time")


EXAMPLES = SCENE.parent


@pytest.mark.parametrize("command", ["run", "fmu build", "cosim"])
def test_messages_from_inside_begin_with_the_file(run, command):
    path = EXAMPLES / "spindle_bearing.toml"
    code, out, err = run(*command.split(), path)
    assert (code, out) == (2, "")
    assert f"error: {path}: " in err


def test_folders_of_signals_are_made_and_said(run, tmp_path):
    text = (EXAMPLES / "weak_motor.toml").read_text().replace('"0.3 s"', '"0.001 s"')
    scene, out = tmp_path / "short.toml", tmp_path / "no" / "such" / "x.csv"
    scene.write_text(text)
    code, shown, _ = run("run", scene, "--out", out)
    assert code == 0
    assert "x.csv" in "".join(shown.split())
    assert "at rest 0 um" in shown
    assert out.read_text(encoding="utf-8").startswith("time")


def test_a_folder_is_no_file_of_signals(run, tmp_path):
    code, out, err = run("run", EXAMPLES / "weak_motor.toml", "--out", tmp_path)
    assert (code != 0, out) == (True, "")
    assert str(tmp_path) in err


def test_the_speed_of_a_system_fmu_is_said(run, tmp_path):
    code, shown, _ = run("fmu", "build", EXAMPLES / "flexible_rotor.toml", "--out", tmp_path)
    assert code == 0
    assert "speed   200 rpm" in shown


def test_a_bearing_without_a_rotor_is_sent_to_python(run, tmp_path):
    scene = tmp_path / "contact.toml"
    scene.write_text(run("new", "contact")[1])
    code, _, err = run("fmu", "build", scene, "--out", tmp_path)
    assert code == 2
    assert "in Python `export_fmu` takes any bearing" in " ".join(err.split())
