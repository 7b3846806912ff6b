"""Bearings made of pads at the command line: charts."""

import json
from dataclasses import replace
from functools import partial
from importlib import import_module

import pytest

import rotorfilm.studies as ladders
from rotorfilm.bearings import PadGridFilm
from rotorfilm.studies.pad_accuracy import compared_bearings


@pytest.mark.long
def test_chart_of_bearings_writes_pictures_and_tables(run, tmp_path, monkeypatch):
    few = dict(list(ladders.bearing_types(0.5).items())[::7])
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
    assert result["thresholds"]["conditions"]["mass [kg]"] == 100.0
    assert "assembled clearance" in result["coefficients"]["reference"]
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


@pytest.mark.long
def test_chart_of_pads_writes_picture_and_table(run, tmp_path, monkeypatch):
    grids = [rung for rung in ladders.pad_rungs() if rung.family == "grid"][:2]
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
