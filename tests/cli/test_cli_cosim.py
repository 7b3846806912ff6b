"""`rotorfilm cosim`: the FMUs of a scene coupled, from the command line."""

import json
from pathlib import Path

import pytest

from rotorfilm.cli.main import main

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")

SCENE = str(Path(__file__).parents[2] / "examples" / "friswell.toml")


@pytest.fixture(autouse=True)
def _exits(monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")


def run(*arguments):
    try:
        main(list(arguments))
    except SystemExit as end:
        return end.code or 0
    return 0


def test_a_scene_is_coupled_by_the_scheme_asked_for(capsys, tmp_path):
    out = tmp_path / "signals.csv"
    arguments = [
        "--scheme",
        "si-exp3",
        "--set",
        "cosimulation.macro_angle=5 deg",
        "--set",
        "cosimulation.revolutions=1",
        "--json",
    ]
    assert run("cosim", SCENE, *arguments, "--out", str(out)) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["scheme"] == "SI-exp3"
    assert found["critical_macro_angle"] is None
    assert found["orbit_error"] < 1e-4
    assert found["work"]["film_evaluations"] == 73
    assert out.read_text().startswith("time,x,y,vx,vy,speed,force_x,force_y\n")


def test_auto_says_why(capsys):
    assert (
        run(
            "cosim", SCENE, "--set", "cosimulation.macro_angle=5 deg", "--set", "cosimulation.revolutions=0.5"
        )
        == 0
    )
    text = capsys.readouterr().out
    assert "unstable: at t = 0 s the coupling grows by a factor of" in text
    assert "the cheapest that is good enough" in text
    assert "SI-exp3, order 3" in text


def test_a_coupling_past_its_limit_is_a_failure_and_keeps_what_it_had(capsys, tmp_path):
    out = tmp_path / "signals.csv"
    arguments = [
        "--scheme",
        "gauss-seidel-0",
        "--set",
        "cosimulation.macro_angle=3.5 deg",
        "--set",
        "cosimulation.revolutions=1",
    ]
    assert run("cosim", SCENE, *arguments, "--out", str(out)) == 1
    assert "macro_step must be below the stability limit" in capsys.readouterr().err
    assert len(out.read_text().splitlines()) > 10


def test_bad_input_is_named(capsys):
    assert run("cosim", SCENE, "--scheme", "best") == 2
    assert "--scheme must be one of auto, adaptive, gauss-seidel-0" in capsys.readouterr().err


@pytest.mark.parametrize("element", ["tilting_pad", "warm journal"])
def test_bearings_with_states_are_coupled_from_rest(element, capsys, tmp_path):
    """Without an excitation nothing moves, the oil as warm as at rest; stability is not known of states."""
    path = tmp_path / "scene.toml"
    assert run("new", element.removeprefix("warm ")) == 0
    text = capsys.readouterr().out
    if element == "warm journal":
        lines = [line for line in text.splitlines() if not line.startswith("viscosity")]
        oil = ["[lubricant]", 'grade = "ISO VG 32"', 'supply_temperature = "45 degC"']
        text = "\n".join([*lines, *oil])
    path.write_text(text)
    brief = ["--set", "cosimulation.macro_angle=10 deg", "--set", "cosimulation.revolutions=0.5"]
    assert run("cosim", str(path), "--scheme", "si-exp", *brief, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["is_stability_known"] is False
    assert found["orbit_error"] < 1e-6
    assert found["hold_defect"] < 1e-6
