"""The command line: its numbers, its JSON, its exit codes, and one clear line for each mistake."""

import json
import math
import os
import subprocess
import sys
from dataclasses import replace
from functools import partial
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
from fmpy import read_model_description

import rotorfilm
from rotorfilm import studies as ladders
from rotorfilm.cli import main as cli
from rotorfilm.fmu import export_fmu
from rotorfilm.rotors import RigidRotor
from rotorfilm.scenes import Scene
from rotorfilm.studies.limits_atlas import PANELS, panel_points

SCENE = """
schema = 1
[journal]
diameter = "100 mm"
length = "30 mm"
clearance = "0.1 mm"
viscosity = "0.1 Pa s"
[operation]
speed = "1500 rpm"
load = "525 N"
[rigid_rotor]
mass = "53.535 kg"
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(SCENE, encoding="utf-8")
    return path


EXAMPLES = Path(__file__).parents[2] / "examples"


def changed(**values):
    """Return the options that set keys of tables, with underscores for their first dots."""
    return [word for key, value in values.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


SHORT = changed(journal__film='{ name = "short" }')


@pytest.mark.literature
def test_coefficients_are_those_of_the_book(run, scene):
    # Friswell et al. (2010), example 5.9.6
    code, out, err = run("solve", scene, *SHORT, "--json")
    assert (code, err) == (0, "")
    stiffness = json.loads(out)["coefficients"]["stiffness"]
    assert [int(k) for row in stiffness for k in row] == [12807959, 16393593, -25060393, 8815302]


def test_kilograms_are_told_their_weight(run, scene):
    code, _, err = run("solve", scene, "--set", "operation.load=53.535 kg")
    assert code == 2
    assert f"error: {scene}: operation.load: quantity must be measured in N" in err
    assert "9.80665 m/s2 times it, 524.999 N" in err


def test_the_schema_of_scenes(run, tmp_path):
    code, out, err = run("schema")
    assert (code, err) == (0, "")
    assert json.loads(out)["title"] == "Scene file of rotorfilm, schema 1"
    assert json.loads(run("schema", "--json")[1]) == json.loads(out)
    path = tmp_path / "scene.schema.json"
    assert run("schema", "--out", path)[0] == 0
    assert path.read_text(encoding="utf-8") == out


@pytest.mark.parametrize("name", ["short", "question"])
def test_solve_writes_its_answer(run, tmp_path, name):
    code, out, _ = run("solve", EXAMPLES / f"{name}.toml", "--json", "--out", tmp_path / "out")
    assert code == 0
    written = json.loads((tmp_path / "out" / "answer.json").read_text(encoding="utf-8"))
    assert written.keys() == json.loads(out).keys()
    assert written.get("model") == json.loads(out)["model"]


def test_solve_says_what_the_film_leaves_out(run, scene):
    (remark,) = json.loads(run("solve", scene, "--json")[1])["remarks"]
    assert remark.startswith("heat: the oil warms by about 48 K")
    assert "left out" in run("solve", scene)[1]


def test_values_of_keys_are_those_of_a_file_that_has_them(run, scene, tmp_path):
    other = tmp_path / "other.toml"
    other.write_text(
        SCENE.replace('"0.1 mm"', '"90 um"')
        .replace('"1500 rpm"', "200.0")
        .replace("[operation]", 'film = { name = "short" }\n[operation]'),
        encoding="utf-8",
    )
    words = changed(journal__clearance="90 um", operation__speed="200.0", journal__film='{ name = "short" }')
    told, written = (json.loads(run("solve", *words, "--json")[1]) for words in ((scene, *words), (other,)))
    assert told == written
    assert Scene.load(scene, {"journal.clearance": "90 um"}).journal.clearance == pytest.approx(9e-5)


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("journal.clearence=80 um", "journal.clearence is no known key"),
        ("journal.clearence=80 um", "did you mean 'clearance'?"),
        ("jurnal.clearance=80 um", "jurnal is no known key"),
        ("journal.clearance", '--set must be "KEY=VALUE"'),
        ("journal.clearance.more=1", "journal.clearance.more must be the dotted name of a key in a table"),
        ("journal.clearance=80 kg", "quantity must be measured in m"),
        ("journal.clearance=[1", "got '[1'"),
        ("journal.clearance=1\nx = 2", "journal.clearance: unit must be one of"),
        ("journal" + ".a" * 300 + "=1", "keys must not have more than 200 dots"),
    ],
)
@pytest.mark.parametrize("command", ["solve", "run", "cosim", "fmu build", "chart scene"])
def test_every_command_of_scenes_names_a_wrong_value_of_a_key(run, scene, command, setting, message):
    code, out, err = run(*command.split(), scene, "--set", setting)
    assert (code, out) == (2, "")
    assert message in err


def test_a_key_is_set_once(run, scene):
    code, _, err = run("solve", scene, *2 * ["--set", "title=x"])
    assert code == 2
    assert "once for each key, got 'title' twice" in err


def test_solve_prints_what_people_read(run, scene):
    code, out, _ = run("solve", scene, *SHORT)
    assert code == 0
    assert "0.266298" in out  # eccentricity ratio
    assert "70.62 deg" in out
    assert "1500 rpm" in out


def test_print_outs_repeat_the_bearing(run, scene):
    code, out, _ = run("solve", scene)
    assert code == 0
    shown = dict(line.strip().split("  ", 1) for line in out.splitlines() if "  " in line.strip())
    sizes = [shown[name].strip() for name in ("radius", "clearance", "slenderness")]
    assert sizes == ["50 mm", "100 um", "0.3"]
    assert "MapFilm()" in out
    told = json.loads(run("solve", scene, "--json")[1])
    assert told["bearing"]["slenderness"] == pytest.approx(0.3)
    assert told["model"] == "MapFilm()"


def test_load_vector_turns_the_answer(run, scene):
    down, aside = (
        json.loads(run("solve", scene, *words, "--json")[1])["equilibrium"]
        for words in ((), changed(operation__load='["525 N", "0 N"]'))
    )
    assert aside["position"][0] == pytest.approx(-down["position"][1], rel=1e-9)
    assert aside["position"][1] == pytest.approx(down["position"][0], rel=1e-9)


@pytest.mark.parametrize(
    ("changes", "code", "message"),
    [
        ({"journal__clearance": "-0.1 mm"}, 2, "journal.clearance must be finite and positive, got -0.0001"),
        ({"journal__clearance": '"nan"'}, 2, "journal.clearance: quantity must be finite, got 'nan'"),
        ({"journal__film": '{ name = "shirt" }'}, 2, "got 'shirt'; did you mean 'short'?"),
        ({"operation__load": "1e20 N"}, 1, ".toml: operation.load must be within the film's capacity"),
        ({"operation__speed": "0 rpm"}, 1, ".toml: operation.speed must let the film carry the load"),
    ],
)
def test_mistake_gives_one_line_and_its_exit_code(run, scene, changes, code, message):
    actual, out, err = run("solve", scene, *changed(**changes))
    assert (actual, out) == (code, "")
    assert message in err
    assert err.count("\n") == 1


@pytest.mark.parametrize("arguments", [["run"], ["solve"], ["frobnicate"], ["solve", "absent.toml"]])
def test_wrong_usage_exits_with_2(run, arguments):
    code, out, err = run(*arguments)
    assert (code, out) == (2, "")
    assert "usage" in err or "absent.toml: scene file cannot be read" in err


def test_unknown_key_in_a_scene_is_named(run, scene):
    scene.write_text(SCENE.replace("clearance", "clearence"), encoding="utf-8")
    code, _, err = run("solve", scene)
    assert code == 2
    assert "journal.clearence is no known key" in err
    assert "did you mean 'clearance'?" in err


@pytest.mark.parametrize(
    "command",
    [
        "solve",
        "run",
        "new",
        "fmu build",
        "fmu check",
        "fmu info",
        "demo",
        "chart damper",
        "chart journal",
        "chart stability",
    ],
)
def test_help_shows_an_example(run, command):
    code, out, _ = run(*command.split(), "--help")
    assert code == 0
    assert f"Example: rotorfilm {command}" in out
    assert "--json" in out


def test_every_command_shows_an_example_and_prints_json(run):
    groups = {(): cli.ALL, **{(name,): group for name, group in cli.GROUPS.items()}}
    every = [*groups, *((*path, name) for path, group in groups.items() for name in group.homes)]
    assert ("chart", "limits") in every
    for words in every:
        code, out, _ = run(*words, "--help")
        assert code == 0
        assert "Example: rotorfilm" in out, words
        assert ("--json" in out) is (words not in {(), ("chart",), ("fmu",)}), words


def test_installed_command_answers_without_heavy_imports(tmp_path):
    script = Path(sys.executable).with_name("rotorfilm")
    done = subprocess.run(
        [str(script), "--help"], capture_output=True, text=True, check=False, cwd=tmp_path, env=os.environ
    )
    assert done.returncode == 0
    assert "solve" in done.stdout
    check = (
        "import sys, rotorfilm.cli; print([m for m in ('control', 'matplotlib', 'fmpy') if m in sys.modules])"
    )
    loaded = subprocess.run(
        [sys.executable, "-c", check], capture_output=True, text=True, check=True, cwd=tmp_path
    )
    assert loaded.stdout.strip() == "[]"


def test_fmu_writes_two_fmus_that_fit_together(run, scene, tmp_path):
    code, out, err = run("fmu", "build", scene, "--out", tmp_path / "fmus", "--json")
    assert (code, err) == (0, "")
    files = json.loads(out)
    film, rotor = (read_model_description(files[name]) for name in ("film", "rotor"))
    assert (film.modelName, rotor.modelName) == ("film", "rotor")
    inputs = {v.name.removeprefix("film.") for v in film.modelVariables if v.causality == "input"}
    outputs = {v.name.removeprefix("rotor.") for v in rotor.modelVariables if v.causality == "output"}
    assert inputs == outputs == {"x", "y", "vx", "vy", "speed"}


def test_fmu_check_measures_and_fails_with_1(run, tmp_path):
    path = export_fmu(RigidRotor(mass=50.0, speed=157.0), tmp_path / "rotor.fmu", "3.0")
    code, out, err = run("fmu", "check", path, "--json")
    assert (code, err) == (0, "")
    items = {item["check"]: item for item in json.loads(out)}
    assert all(item["passed"] is not False for item in items.values())
    assert items["reference, Model Exchange"]["figure"] < 1e-10
    spoiled = tmp_path / "spoiled.fmu"
    with ZipFile(path) as before, ZipFile(spoiled, "w") as after:
        for name in before.namelist():
            content = before.read(name)
            after.writestr(name, content.replace(b"0.1", b"0.2") if name.endswith(".csv") else content)
    code, out, _ = run("fmu", "check", spoiled)
    assert code == 1
    assert "FAILED" in out


def test_fmu_info_lists_variables(run, tmp_path):
    path = export_fmu(RigidRotor(mass=50.0, speed=157.0), tmp_path / "rotor.fmu", component="rotor")
    code, out, _ = run("fmu", "info", path, "--json")
    found = json.loads(out)
    assert (code, found["fmi_version"], found["interfaces"]) == (0, "2.0", ["CoSimulation", "ModelExchange"])
    assert "providesDirectionalDerivative" in found["capabilities"]
    assert {"name": "rotor.mass", "start": "50.0"}.items() <= found["variables"][1].items()
    assert "rotor.mass" in run("fmu", "info", path)[1]


def test_fmu_info_writes_start_values_with_few_digits_on_one_line(run, tmp_path):
    rotor = RigidRotor(
        mass=50.0 + 1.0 / 3.0, speed=157.07963267948966, position=(0.0, -2.5903180240922623e-05)
    )
    path = export_fmu(rotor, tmp_path / "rotor.fmu", component="rotor")
    shown = run("fmu", "info", path)[1]
    assert all(text in shown.split() for text in ("50.3333", "157.08", "-2.59032e-05"))
    assert "33333333" not in shown


@pytest.mark.parametrize("command", ["check", "info"])
def test_a_file_that_is_no_fmu_is_bad_input(run, scene, command):
    code, out, err = run("fmu", command, scene)
    assert (code, out) == (2, "")
    assert "fmu must be a readable FMU" in err
    code, out, err = run("fmu", command, "absent.fmu")
    assert (code, out) == (2, "")
    assert err == "error: fmu must be a readable FMU, got 'absent.fmu': no such file\n"


def test_version_is_that_of_the_package(run):
    assert run("--version") == (0, f"rotorfilm {rotorfilm.__version__}\n", "")
    assert rotorfilm.__version__ == version("rotorfilm")


def test_fmu_of_a_scene_without_rotor_is_refused(run, scene):
    scene.write_text(SCENE.partition("[rigid_rotor]")[0], encoding="utf-8")
    code, _, err = run("fmu", "build", scene)
    assert code == 2
    assert "rigid_rotor is required" in err


def test_folder_that_cannot_be_made_is_named(run, scene, tmp_path):
    code, _, err = run("fmu", "build", scene, "--out", scene / "below-a-file")
    assert code == 2
    assert "below-a-file" in err
    assert err.count("\n") == 1


def test_warning_is_one_line_on_stderr_and_is_shown_once(scene):
    # In a process of its own, under the warning filters of a user.
    long = SCENE.replace('"30 mm"', '"60 mm"').replace(
        "[operation]", 'film = { name = "short" }\n[operation]'
    )
    scene.write_text(long, encoding="utf-8")
    command = [Path(sys.executable).with_name("rotorfilm"), "solve", scene, "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=scene.parent)
    assert done.stderr.startswith("warning: length / diameter must not exceed 0.5 for ShortFilm(), got 0.6")
    assert done.stderr.count("\n") == 1
    json.loads(done.stdout)
    # This one comes from several places.
    done = subprocess.run(
        [*command, "--set", "journal.clearance=8 mm"], capture_output=True, text=True, check=True
    )
    assert done.stderr.count("clearance / radius should be 1e-05 to 0.02, got 0.16") == 1


FEW = [rung for rung in ladders.journal_rungs() if rung.name in ("published (1, 1)", "2-D 48 x 4", "map")]


@pytest.mark.long
def test_chart_of_accuracy_writes_picture_and_table(run, tmp_path, monkeypatch):
    quick = partial(ladders.journal_accuracy, rungs=FEW, cells=(128, 16), rounds=1)
    monkeypatch.setattr(ladders, "journal_accuracy", quick)
    options = ("--ld", "0.25", "--states", "6", "--seed", "5", "--motion", "small", "--out", tmp_path)
    code, out, err = run("chart", "journal", *options, "--json")
    assert code == 0
    assert "done" in err
    result = json.loads(out)
    told = [result["conditions"][name] for name in ("length/diameter [1]", "states [1]", "seed [-]")]
    assert told == [0.25, 6, 5]
    assert result["conditions"]["largest squeeze rate/speed [1]"] == 0.05
    assert (tmp_path / "chart_journal.png").read_bytes().startswith(b"\x89PNG")
    table = (tmp_path / "chart_journal.csv").read_text(encoding="utf-8").splitlines()
    assert len(table) == 1 + len(FEW)
    assert "force in a batch [s]" in table[0]
    code, out, _ = run("chart", "journal", *options)
    assert code == 0
    assert "2-D 48 x 4" in out


@pytest.mark.long
def test_chart_of_dampers_writes_picture_and_tables(run, tmp_path, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path))
    module = import_module("rotorfilm.studies.damper_accuracy")  # its package shows a function of this name
    monkeypatch.setattr(module, "SERIES", (1, 3))
    monkeypatch.setattr(module.damper, "FiniteMapSqueeze", partial(rotorfilm.FiniteMapSqueeze, (6, 8)))
    monkeypatch.setattr(ladders, "damper_accuracy", partial(ladders.damper_accuracy, rounds=1))
    options = ("--ld", "0.2", "--permeability", "0.01", "--states", "5", "--out", tmp_path)
    code, out, _ = run("chart", "damper", *options, "--json")
    assert code == 0
    result = json.loads(out)
    assert result == json.loads((tmp_path / "chart_damper.json").read_text(encoding="utf-8"))
    told = ("length/diameter [1]", "permeability number [1]", "states [1]")
    assert [result["conditions"][name] for name in told] == [0.2, 0.01, 5]
    rungs = {(rung["name"], rung["case"]): rung["values"] for rung in result["rungs"]}
    short = "99 % error against the short film [1]"
    for case in ("cavitated", "full film"):
        one, three = (rungs[f"series, {count}", case][short] for count in (1, 3))
        assert one > 3.0 * three > 0.0
        assert rungs["series, whole", case][short] == 0.0
        assert rungs["map", case][short] < 1e-4
    assert rungs["finite length", "full film"]["99 % error [1]"] == 0.0
    assert (tmp_path / "chart_damper.png").read_bytes().startswith(b"\x89PNG")
    table = (tmp_path / "chart_damper.csv").read_text(encoding="utf-8").splitlines()
    assert len(table) == 1 + len(rungs)
    code, out, err = run("chart", "damper", "--permeability", "0", "--out", tmp_path)
    assert (code, out) == (2, "")
    assert "permeability_number must be finite and positive, got 0.0" in err


@pytest.mark.long
def test_chart_of_heat_writes_pictures_and_tables(run, tmp_path, monkeypatch):
    models = import_module("rotorfilm.studies.heat_accuracy")
    few = {"cases": ladders.HEAT_CASES[:1], "cells": (48, 4), "layers": 4}
    monkeypatch.setattr(ladders, "heat_accuracy", partial(ladders.heat_accuracy, **few))
    monkeypatch.setattr(models, "heated_film", partial(models.heated_film, cells=(32, 4), layers=4))
    panel = next(one for one in PANELS if one.physics == "heat")
    panel = replace(panel, curves=lambda: iter([("T0", np.ones(2), np.ones(2))]))
    points, notes = tuple(panel_points(panel)), {panel.title: panel}
    atlas = ladders.StudyResult(study="limits", reference="", notes=notes, rungs=points)
    monkeypatch.setattr(ladders, "limits_atlas", lambda physics, report: atlas)
    code, out, _ = run("chart", "heat", "--out", tmp_path)
    assert code == 0
    assert "T2 bush" in out
    for name in ("chart_heat", "chart_heat_limits", "chart_heat_film"):
        assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    table = (tmp_path / "chart_heat.csv").read_text(encoding="utf-8").splitlines()
    assert len(table) == 1 + 7
    assert "CPU time [s]" in table[0]


@pytest.mark.long
def test_chart_of_stability_writes_picture_and_table(run, tmp_path, monkeypatch):
    quick = partial(ladders.journal_stability, rungs=FEW, cells=(128, 16), eccentricity_ratio=(0.3, 0.6, 0.9))
    monkeypatch.setattr(ladders, "journal_stability", quick)
    code, out, _ = run("chart", "stability", "--out", tmp_path, "--json")
    assert code == 0
    published = json.loads(out)["rungs"][:3]
    assert [row["values"]["speed sqrt(c m/W) [1]"] for row in published] == [None, None, None]
    assert (tmp_path / "chart_stability.png").exists()
    assert len((tmp_path / "chart_stability.csv").read_text(encoding="utf-8").splitlines()) == 1 + 3 * len(
        FEW
    )
    code, out, _ = run("chart", "stability", "--out", tmp_path)
    assert code == 0
    assert "rank-1 damping" in out


def test_chart_of_a_bearing_beyond_the_ladder_is_refused(run, tmp_path):
    code, out, err = run("chart", "journal", "--ld", "9", "--out", tmp_path)
    assert (code, out) == (2, "")
    assert "slenderness (L/D) must be from 0.1 to 4.0, got 9.0" in err


COARSE_SCENE = SCENE.replace(
    "[operation]",
    """film = { name = "grooved_map", cells = [32, 4], nodes = [6, 12, 12], largest_eccentricity_ratio = 0.9 }
grooves = [{ center = "90 deg", width = "20 deg" }]
[operation]""",
)


def test_solve_makes_the_map_once_and_shows_how_far_it_is(run, scene, tmp_path, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path / "cache"))
    scene.write_text(COARSE_SCENE, encoding="utf-8")
    code, first, err = run("solve", scene, "--json")
    assert code == 0
    assert "map of the grooved bearing" in err
    (kept,) = (tmp_path / "cache").iterdir()
    code, out, err = run("solve", scene, "--json")
    assert (code, out, err) == (0, first, "")
    assert json.loads(out)["model"].startswith("GroovedMapFilm(cells=(32, 4), nodes=(6, 12, 12)")
    assert json.loads(out)["bearing"]["grooves"][0]["center"] == pytest.approx(math.pi / 2.0)
    assert "Groove(center: 90 deg, width: 20 deg)" in run("solve", scene)[1]
    assert list((tmp_path / "cache").iterdir()) == [kept]


def test_an_error_is_said_in_json_too_where_that_is_asked_for(run, tmp_path):
    missing = str(tmp_path / "none.toml")
    code, out, err = run("solve", missing, "--json")
    assert code == 2
    assert json.loads(out)["error"] == "SceneError"
    assert json.loads(out)["message"] in err.replace("\n", " ")
    assert run("solve", missing)[1] == ""


def test_a_question_that_a_scene_cannot_be_asked_names_the_file(run, tmp_path):
    text = (Path(__file__).parents[2] / "examples" / "question.toml").read_text(encoding="utf-8")
    path = tmp_path / "asked.toml"
    path.write_text(text.replace('"eccentricity_ratio"', '"whirl_threshold"'), encoding="utf-8")
    code, _, err = run("solve", str(path))
    assert code == 2
    assert "asked.toml: rigid_rotor is required for whirl_threshold" in err.replace("\n", "")


def test_small_matrices_take_one_thread_unless_the_environment_says_otherwise():
    """Before numpy is there, since its library looks once."""
    code = (
        "import sys; import rotorfilm.__main__ as own; assert 'numpy' not in sys.modules; "
        "sys.argv = ['rotorfilm', '--version']; own.main(); import os; "
        "print(os.environ['OPENBLAS_NUM_THREADS'], os.environ['OMP_NUM_THREADS'])"
    )
    others = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    ran = subprocess.run(
        [sys.executable, "-c", code],
        env={**others, "OMP_NUM_THREADS": "3"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert ran.stdout.split()[-2:] == ["1", "3"]
