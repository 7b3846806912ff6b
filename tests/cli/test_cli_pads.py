"""Bearings made of pads at the command line: charts and coefficients."""

import json
import math
from dataclasses import replace
from functools import partial
from importlib import import_module

import numpy as np
import pytest

import rotorfilm.studies as ladders
from rotorfilm import PadGridFilm, TiltingPadBearing, coefficients, equilibrium, even_pivots
from rotorfilm.studies.pad_accuracy import compared_bearings


def test_chart_of_bearings_writes_pictures_and_tables(run, tmp_path, monkeypatch):
    few = ladders.bearing_types(0.5)[::7]
    monkeypatch.setattr(
        ladders,
        "bearing_coefficients",
        partial(ladders.bearing_coefficients, sommerfeld=[0.5, 1.0], types=few),
    )
    monkeypatch.setattr(
        ladders, "bearing_thresholds", partial(ladders.bearing_thresholds, loads=[500.0, 900.0], types=few)
    )
    code, out, err = run("chart", "bearings", "--mass", "100 kg", "--out", tmp_path, "--json")
    assert code == 0
    assert "done" in err
    result = json.loads(out)
    assert result["thresholds"]["mass"] == 100.0
    assert "assembled clearance" in result["coefficients"]["convention"]
    for name in ("chart_bearings", "chart_whirl"):
        assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")
        assert len((tmp_path / f"{name}.csv").read_text(encoding="utf-8").splitlines()) == 1 + 2 * len(few)
    code, out, _ = run("chart", "bearings", "--out", tmp_path)
    assert code == 0
    assert "never" in out
    assert "does not whirl at any speed searched" in " ".join(out.split())
    code, out, err = run("chart", "bearings", "--mass", "-1 kg", "--out", tmp_path)
    assert (code, out) == (2, "")
    assert "mass must be finite and positive, got -1.0" in err


def without_maps(slenderness):
    """Return the bearings that are compared with films that need no map."""
    film = PadGridFilm(cells=(32, 4))
    return {name: replace(one, film=film) for name, one in compared_bearings(slenderness).items()}


def test_chart_of_pads_writes_picture_and_table(run, tmp_path, monkeypatch):
    grids = [rung for rung in ladders.pad_rungs() if rung.family is ladders.PadFamily.GRID][:2]
    quick = partial(ladders.pad_accuracy, rungs=grids, cells=(64, 8), rounds=1)
    monkeypatch.setattr(ladders, "pad_accuracy", quick)
    module = import_module("rotorfilm.studies.pad_accuracy")  # its package shows a function of this name
    monkeypatch.setattr(module, "compared_bearings", without_maps)
    options = ("--ld", "0.7", "--states", "3", "--seed", "5", "--out", tmp_path)
    code, out, _ = run("chart", "pads", *options, "--json")
    assert code == 0
    result = json.loads(out)
    told = ("length/diameter [1]", "states of each bearing [1]", "seed [-]")
    assert [result["conditions"][name] for name in told] == [0.7, 3, 5]
    assert (tmp_path / "chart_pads.png").read_bytes().startswith(b"\x89PNG")
    table = (tmp_path / "chart_pads.csv").read_text(encoding="utf-8").splitlines()
    assert len(table) == 1 + len(grids)
    code, out, _ = run("chart", "pads", *options)
    assert code == 0
    assert grids[0].name in out


BORE = {
    "--diameter": "100 mm",
    "--length": "50 mm",
    "--assembled-clearance": "70 um",
    "--viscosity": "20 mPa s",
}
POINT = {"--load": "3 kN", "--speed": "3000 rpm"}
FIVE = {"--type": "tilting_pad", "--pads": "5", "--extent": "60 deg", "--preload": "0.3"}


def asked(*flags, **changes):
    options = {**BORE, **POINT, **{f"--{name.replace('_', '-')}": value for name, value in changes.items()}}
    return ["pad-coefficients", *(word for pair in options.items() for word in pair), *flags]


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")
def test_coefficients_of_tilting_pads_are_those_of_the_bearing_and_name_their_frequency(run):
    known = {"radius": 0.05, "length": 0.05, "assembled_clearance": 7e-5, "viscosity": 0.02}
    pivots = even_pivots(5, between_pads=True)
    bearing = TiltingPadBearing(**known, extent=math.pi / 3.0, preload=0.3, pivots=pivots)
    at = equilibrium(bearing, (0.0, -3000.0), 100.0 * math.pi)
    given = [word for pair in FIVE.items() for word in pair]
    for whirl in (None, 50.0):
        further = [] if whirl is None else ["--frequency", f"{whirl} rad/s"]
        code, out, _ = run(*asked("--load-between"), *given, *further, "--json")
        found = json.loads(out)["coefficients"]
        exact = coefficients(bearing, at.position, 100.0 * math.pi, whirl)
        assert code == 0
        assert found["frequency"] == exact.frequency
        np.testing.assert_allclose(found["stiffness"], exact.stiffness, rtol=1e-9, atol=1.0)
        np.testing.assert_allclose(found["damping"], exact.damping, rtol=1e-9, atol=1.0)
    assert "frequency            314.159 rad/s" in run(*asked(), *given)[1]


def test_coefficients_of_a_dam_on_an_oil_tell_its_temperature(run):
    words = asked(type="pressure_dam", depth="140 um", end="145 deg", share="0.75")
    at = words.index("--viscosity")
    code, out, _ = run(*words[:at], *words[at + 2 :], "--oil", "ISO VG 46", "--supply-temperature", "45 degC")
    assert code == 0
    assert "temperature          328." in out
    assert "side flow" in out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (asked(type="three_lobes"), "did you mean 'three_lobe'"),
        (asked(type="three_lobe", pads="5"), "--pads must not be given with --type three_lobe, got 5"),
        (asked("--load-between", type="three_lobe"), "--load-between must be given with tilting pads"),
        (asked(type="three_lobe", frequency="1 Hz"), "--frequency must be given with tilting pads"),
        (asked(type="tilting_pad", pads="5"), "extent is required"),
        (
            asked(type="tilting_pad", pads="5", extent="60 deg", offset="0.3"),
            "--offset must not be given with",
        ),
    ],
)
def test_options_that_do_not_fit_are_named(run, words, message):
    code, out, err = run(*words)
    assert (code, out) == (2, "")
    assert message in err
