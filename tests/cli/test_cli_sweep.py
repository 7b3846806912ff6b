"""The command `rotorfilm sweep`."""

import json
import sys
from pathlib import Path

import pytest

from rotorfilm import InputError
from rotorfilm.cli.sweep_command import read_variation
from rotorfilm.scenes import Scene
from rotorfilm.scenes.rotor_runs import run_rotor

xarray = pytest.importorskip("xarray")
pytest.importorskip("h5netcdf")
SHORT = Path(__file__).parents[2] / "examples" / "short.toml"


@pytest.mark.long
def test_a_sweep_becomes_netcdf(run, tmp_path):
    out = tmp_path / "out.nc"
    vary = [
        "--vary",
        "journal.clearance = 90 um, 100 um",
        "--vary",
        "operation.speed = 1000 rpm : 2000 rpm : 3",
    ]
    arguments = ["sweep", str(SHORT), *vary, "--out", str(out), "--workers", "1", "--json"]
    code, out_text, _ = run(*arguments, "--set", "operation.load=400 N")
    assert code == 0
    assert json.loads(out_text)["points"] == 6
    assert json.loads(out_text)["remarks"] == 6  # all of them hot
    with xarray.open_dataset(out, engine="h5netcdf") as found:
        assert found["eccentricity_ratio"].shape == (2, 3)
        changes = {"journal.clearance": "90 um", "operation.speed": "2000 rpm", "operation.load": "400 N"}
        alone = Scene.load(SHORT, changes).solve()
        assert float(found["eccentricity_ratio"][0, 2]) == alone.equilibrium.eccentricity_ratio


def test_runs_over_time_become_netcdf(run, tmp_path):
    scene, out = tmp_path / "scene.toml", tmp_path / "out.nc"
    further = "\n[cosimulation]\nrevolutions = 2\n"
    scene.write_text(SHORT.read_text(encoding="utf-8") + further, encoding="utf-8")
    arguments = ["sweep", str(scene), "--runs", "--vary", "journal.clearance = 90 um, 100 um"]
    assert run(*arguments, "--out", str(out), "--json")[0] == 0
    with xarray.open_dataset(out, engine="h5netcdf") as found:
        alone = run_rotor(Scene.load(scene, {"journal.clearance": "100 um"}))
        assert float(found["journal_peak"][1]) == alone.peaks["journal"]


def test_help_has_an_example(run):
    assert "Example" in run("sweep", "--help")[1]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a.b = 1 mm, 2 mm", ("a.b", ["1 mm", "2 mm"])),
        ("a.b=1,2.5", ("a.b", [1.0, 2.5])),
        ("a = 0 rpm : 1 rpm : 3", ("a", ["0.0 rpm", "0.5 rpm", "1.0 rpm"])),
        ("film.name = short, map", ("film.name", ["short", "map"])),
    ],
)
def test_variations_are_read(text, expected):
    assert read_variation(text) == expected


@pytest.mark.parametrize(
    "text", ["a", "a =", "= 1", "a = 1 : 2", "a = 1 : 2 : 1", "a = 1 mm : 2 m : 3", "a = x : y : 3"]
)
def test_other_texts_are_named(text):
    with pytest.raises(InputError, match="--vary must"):
        read_variation(text)


def test_the_message_names_both_forms_of_values(run):
    with pytest.raises(InputError, match='"KEY = VALUE, VALUE" or "KEY = first : last : count"'):
        read_variation("journal.clearance = 80 um : 100 um")
    assert "80 um, 100 um" in " ".join(run("sweep", "--help")[1].split())


@pytest.mark.parametrize(
    ("change", "code", "key"),
    [
        ("operation.load=1e12 N", 1, "operation.load must be within"),
        ("operation.speed=0", 1, "operation.speed must let"),
    ],
)
def test_a_load_that_no_film_carries_is_named_with_file_and_key(run, change, code, key):
    found, _, said = run("solve", str(SHORT), "--set", change)
    assert (found, f"error: {SHORT}: {key}" in said) == (code, True)


def test_points_with_remarks_are_counted(run, tmp_path):
    arguments = ["sweep", str(SHORT), "--vary", "journal.clearance = 90 um, 100 um"]
    arguments += ["--out", str(tmp_path / "out.nc"), "--workers", "1"]
    _, printed, _ = run(*arguments)
    assert "2 points: physics left out" in " ".join(printed.split())


SPRINGS = """
schema = 1

[shaft]
material = { young_modulus = "211 GPa", shear_modulus = "81.2 GPa", density = 7810 }
elements = [{ length = "1 m", outer_diameter = "50 mm", pieces = 2 }]
disks = [{ node = 1, mass = "60 kg", polar_inertia = 0.1, diametral_inertia = 0.1 }]
speeds = { first = "200 rpm", last = "4600 rpm", count = 5 }

[[shaft.bearings]]
name = "left"
node = 0
stiffness = [["1e7 N/m", 0], [0, "1e7 N/m"]]
"""


def test_a_shaft_without_a_question_is_refused_before_the_work(run, tmp_path):
    scene, out = tmp_path / "plain.toml", tmp_path / "out.nc"
    scene.write_text(SPRINGS, encoding="utf-8")
    arguments = ["sweep", str(scene), "--vary", "shaft.disks.0.mass = 50 kg : 70 kg : 2", "--out", str(out)]
    code, _, said = run(*arguments)
    assert code == 2
    assert "a sweep of a [shaft] needs a [question]" in said
    assert not any(tmp_path.glob("out*"))


@pytest.mark.filterwarnings("ignore:.*have no answer")
def test_a_sweep_of_which_every_point_fails_has_failed(run, tmp_path):
    arguments = ["sweep", str(SHORT), "--workers", "1", "--json", "--out", str(tmp_path / "out.nc")]
    code, printed, said = run(*arguments, "--vary", "operation.load = 1e12 N, 2e12 N")
    assert code == 1
    assert json.loads(printed)["failed"] == 2
    assert "every point failed, the first with EquilibriumError" in said
    assert run(*arguments[:-1], str(tmp_path / "b.nc"), "--vary", "operation.load = 525 N, 1e12 N")[0] == 0


@pytest.mark.parametrize("key", ["shaft.disks.0.node", "shaft.disks[0].node"])
def test_keys_of_lists_are_written_as_messages_have_them(run, tmp_path, key):
    scene = tmp_path / "plain.toml"
    scene.write_text(SPRINGS, encoding="utf-8")
    code, _, said = run("solve", str(scene), "--set", f"{key}=7")
    assert (code, "shaft.disks[0].node must be a node of the shaft, 0 to 2, got 7" in said) == (2, True)
    assert read_variation(f"{key} = 0, 1") == ("shaft.disks.0.node", [0, 1])


def test_two_forms_of_a_key_are_the_same_key(run):
    twice = ["--set", "shaft.disks[0].node=1", "--set", "shaft.disks.0.node=1"]
    code, _, said = run("solve", str(SHORT), *twice)
    assert (code, "once for each key" in said) == (2, True)


def test_a_missing_package_is_named(run, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "h5py", None)
    arguments = ["--vary", "journal.clearance = 90 um, 100 um", "--out", str(tmp_path / "out.nc")]
    code, _, said = run("sweep", str(SHORT), *arguments)
    assert (code, "a sweep needs h5py of the extra `sweep`" in said) == (2, True)
