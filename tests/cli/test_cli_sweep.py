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


def test_a_missing_package_is_named(run, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "h5py", None)
    arguments = ["--vary", "journal.clearance = 90 um, 100 um", "--out", str(tmp_path / "out.nc")]
    code, _, said = run("sweep", str(SHORT), *arguments)
    assert (code, "a sweep needs h5py of the extra `sweep`" in said) == (2, True)


def test_points_with_remarks_are_counted(run, tmp_path):
    arguments = ["sweep", str(SHORT), "--vary", "journal.clearance = 90 um, 100 um"]
    arguments += ["--out", str(tmp_path / "out.nc"), "--workers", "1"]
    _, printed, _ = run(*arguments)
    assert "2 points: physics left out" in " ".join(printed.split())
