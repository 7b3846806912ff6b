"""Whirl thresholds by every journal film: against the map, and marked where they are no answer."""

import csv
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm.ladders import journal_rungs, journal_stability
from rotorfilm.results import write_csv

RATIOS = (0.1, 0.3, 0.5, 0.7, 0.85)
WANTED = (
    "short film",
    "published (1, 1)",
    "published (2, 1)",
    "fixed arc converged",
    "rotating arc converged",
    "free arc (4+c, 8)",
    "free arc converged",
    "2-D 96 x 8",
    "map",
)


@pytest.fixture(scope="module")
def result():
    rungs = [rung for rung in journal_rungs() if rung.name in WANTED]
    return journal_stability(0.5, eccentricity_ratio=RATIOS, rungs=rungs, cells=(384, 16))


@pytest.fixture(scope="module")
def rung(result):
    return {rung.name: rung for rung in result.rungs}


@pytest.mark.literature
def test_thresholds_at_half_the_clearance(result, rung):
    # c M omega^2/W at L/D .5, eccentricity ratio .5, on the film extents of docs/journal.md
    expected = {
        "published (2, 1)": 3.81,
        "fixed arc converged": 3.56,
        "rotating arc converged": 6.06,
        # With both ends free in two dimensions, instead of in one axial mode, 6.58.
        "free arc converged": 6.57,
        "map": 6.58,
    }
    for name, value in expected.items():
        assert rung[name].speed_parameter[2] ** 2 == pytest.approx(value, abs=0.005)
    short = rung["short film"].speed_parameter  # Ocvirk film: a closed form
    np.testing.assert_allclose(short[:3], [2.741279, 2.605786, 2.541731], atol=1e-6)


@pytest.mark.closed_form
def test_short_film_ceases_to_whirl():
    # Ocvirk film: no threshold beyond e = .756
    short = [rung for rung in journal_rungs() if rung.name == "short film"]
    result = journal_stability(0.3, eccentricity_ratio=(0.74, 0.76), rungs=short, cells=(64, 16))
    below, beyond = result.rungs[0].speed_parameter
    assert below > 5.0
    assert beyond is None


@pytest.mark.parametrize("name", ["map", "2-D 96 x 8", "free arc (4+c, 8)"])
def test_films_with_reynolds_rupture_whirl_alike(result, rung, name):
    np.testing.assert_allclose(rung[name].speed_parameter[:3], result.speed_parameter[:3], rtol=0.01)


def test_map_agrees_with_the_two_dimensional_reference(result, rung):
    assert 0.0 < result.reference_error < 5e-3
    assert result.largest_deviation(rung["map"]) < result.reference_error + 1e-3
    assert result.speed_parameter[4] is None
    assert rung["map"].speed_parameter[4] is None


def test_one_circumferential_function_has_no_threshold(result, rung):
    first = rung["published (1, 1)"]
    assert not first.has_threshold
    assert all(first.rank_one)
    assert result.missing(first) == (True, True, True, True, False)
    assert result.largest_deviation(first) is None
    assert "rank 1" in first.reasons[0]


def test_wrong_thresholds_are_marked(result, rung):
    assert result.wrong(rung["fixed arc converged"]) == (True, True, True, True, False)
    assert result.wrong(rung["rotating arc converged"]) == (False, False, False, True, False)
    assert not any(result.wrong(rung["free arc converged"]))


def test_tension_and_asymmetry_are_marked(rung):
    for name in ("published (1, 1)", "published (2, 1)", "fixed arc converged"):
        assert rung[name].in_tension
        assert rung[name].tension_share > 0.4
        assert max(rung[name].static_tension) < 1e-9
    assert not rung["map"].in_tension
    assert {name for name, law in rung.items() if law.unsymmetric} == {
        "published (1, 1)",
        "rotating arc converged",
    }
    # A potential makes damping symmetric: exactly so for map and grid, for two functions on a fixed arc.
    for name in ("short film", "published (2, 1)", "2-D 96 x 8", "map"):
        assert max(rung[name].asymmetry) < 1e-9


def test_thresholds_above_the_highest_are_not_judged(result, rung):
    low = replace(result, highest=2.6)
    assert low.judged == tuple(value is not None and value <= 2.6 for value in result.speed_parameter)
    assert not low.wrong(rung["fixed arc converged"])[0]


def test_threshold_where_the_reference_has_none_is_marked(result, rung):
    claims = replace(rung["map"], speed_parameter=(*rung["map"].speed_parameter[:4], 3.0))
    assert result.invented(claims) == (False, False, False, False, True)


def test_csv_round_trip(result, tmp_path):
    path = write_csv(tmp_path / "table.csv", result.columns())
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    assert len(rows) == len(RATIOS) * len(WANTED)
    for row, (name, k) in zip(
        rows, ((r.name, k) for r in result.rungs for k in range(len(RATIOS))), strict=True
    ):
        assert f"{row['family [-]']} {row['label [-]']}".strip() == name
        assert float(row["eccentricity ratio [1]"]) == RATIOS[k]
    first = rows[len(RATIOS)]
    assert (first["speed sqrt(c m/W) [1]"], first["damping of rank one [-]"]) == ("", "1")
    assert float(rows[0]["speed sqrt(c m/W) [1]"]) == pytest.approx(2.741279, abs=1e-6)
