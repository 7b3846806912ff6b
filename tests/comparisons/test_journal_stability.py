"""Whirl thresholds by every journal film: against the map, and marked where they are no answer."""

import csv
import math
from importlib import import_module

import numpy as np
import pytest
from scipy.integrate import quad

from rotorfilm import InputError
from rotorfilm.bearings.journal import ComplementarityArc, FixedArc, ReynoldsFilm, RotatingArc, SplittingFilm
from rotorfilm.bearings.journal.splitting_film import second_approximation
from rotorfilm.core import write_csv
from rotorfilm.studies import StudyModel, journal_rungs, journal_stability
from rotorfilm.studies.journal_stability import (
    AT_REST,
    DEVIATION,
    INVENTED,
    MISSING,
    MOVING,
    OWN_ERROR,
    PARAMETER,
    RANK_ONE,
    REFERENCE,
    UNSYMMETRIC,
    WRONG,
    AveragedFilm,
    by_film,
    is_judged,
)

journal_stability_module = import_module("rotorfilm.studies.journal_stability")

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


def columns_of(result):
    """Return the columns of each film, by its name."""
    return {
        name: {heading: [row[heading] for row in rows] for heading in rows[0].values}
        for name, rows in by_film(result).items()
    }


@pytest.fixture(scope="module")
def rung(result):
    return columns_of(result)


def threshold(force, eps):
    """Return speed sqrt(c m/W) at the onset of whirl, from a force (radial, tangential) of eps, g_s and g_c.

    Stiffness and damping by central differences in polar axes at speed 2, where a static film has g_s = -eps;
    the border by det(K - mass whirl^2 + i whirl C) = 0: its imaginary part gives mass whirl^2, the real one
    whirl^2 (Lund 1987).
    """
    h = 1e-5
    radial, tangential = F = force(eps, -eps, 0.0)
    along = (force(eps + h, -eps - h, 0.0) - force(eps - h, -eps + h, 0.0)) / (2.0 * h)
    K = -np.stack([along, np.array([-tangential, radial]) / eps], axis=1)
    by_s = (force(eps, -eps + h, 0.0) - force(eps, -eps - h, 0.0)) / (2.0 * h)
    by_c = (force(eps, -eps, h) - force(eps, -eps, -h)) / (2.0 * h)
    C = -np.stack([by_c, by_s], axis=1)
    mixed = K[0, 0] * C[1, 1] + K[1, 1] * C[0, 0] - K[0, 1] * C[1, 0] - K[1, 0] * C[0, 1]
    inertia = mixed / np.trace(C)
    whirl2 = np.linalg.det(K - inertia * np.eye(2)) / np.linalg.det(C)
    return 2.0 * np.sqrt(inertia / whirl2 / math.hypot(*F))


def short_force(eps, g_s, g_c):
    """Return Ocvirk's force by quadrature over the half circle where g_s sin + g_c cos is negative."""
    turn = np.arctan2(g_s, g_c)

    def moment(i, j):
        return quad(
            lambda x: np.sin(x) ** i * np.cos(x) ** j / (1.0 + eps * np.cos(x)) ** 3,
            turn + 0.5 * np.pi,
            turn + 1.5 * np.pi,
            epsabs=1e-13,
        )[0]

    return -np.array([moment(1, 1) * g_s + moment(0, 2) * g_c, moment(2, 0) * g_s + moment(1, 1) * g_c])


@pytest.mark.long
@pytest.mark.closed_form
def test_short_film_has_the_thresholds_of_ocvirks_force(rung):
    short = rung["short film"][PARAMETER][:3]
    np.testing.assert_allclose(short, [threshold(short_force, eps) for eps in RATIOS[:3]], rtol=1e-6)
    np.testing.assert_allclose(short, [2.741279, 2.605786, 2.541731], atol=1e-6)


@pytest.mark.literature
def test_published_film_has_the_thresholds_of_the_published_formulas(rung):
    # Sussi & Fridman (1978), second approximation with the misprints of docs/journal.md corrected, one axial
    # mode. The paper prints no threshold: 3.81 = c M omega^2/W at .5 follows from its formulas.
    exact = [threshold(lambda *z: second_approximation(*z, 0.5, 1), eps) for eps in RATIOS[:3]]
    np.testing.assert_allclose(rung["published (2, 1)"][PARAMETER][:3], exact, rtol=1e-6)
    assert exact[2] ** 2 == pytest.approx(3.81, abs=0.005)


@pytest.mark.long
def test_converged_films_agree_with_another_method():
    # The rungs solve for the pressure by Ritz's method, the splitting method for the flux by Galerkin's.
    arcs = {"fixed": FixedArc(), "rotating": RotatingArc(), "free": ComplementarityArc()}
    rungs = [rung for rung in journal_rungs() if rung.label == "converged"]
    rungs += [
        StudyModel(
            name=f"{name} flux",
            family=name,
            label="flux",
            law=SplittingFilm(order=(12, None), constant=True, rupture=arc),
        )
        for name, arc in arcs.items()
    ]
    result = journal_stability(0.5, eccentricity_ratio=RATIOS[:3], rungs=rungs, cells=(64, 16))
    pressure, flux = np.reshape(result.columns()[PARAMETER], (2, 3, 3))
    np.testing.assert_allclose(pressure, flux, rtol=1e-3)


@pytest.mark.closed_form
def test_short_film_ceases_to_whirl():
    # Ocvirk film: no threshold beyond e = .756
    short = [rung for rung in journal_rungs() if rung.name == "short film"]
    result = journal_stability(0.3, eccentricity_ratio=(0.74, 0.76), rungs=short, cells=(64, 16))
    below, beyond = result.columns()[PARAMETER]
    assert below > 5.0
    assert beyond is None


@pytest.mark.parametrize("name", ["map", "2-D 96 x 8", "free arc (4+c, 8)"])
def test_films_with_reynolds_rupture_whirl_alike(rung, name):
    np.testing.assert_allclose(rung[name][PARAMETER][:3], rung[name][REFERENCE][:3], rtol=0.01)


@pytest.mark.parametrize("slenderness", [0.1, 0.5, 1.0, 4.0])
def test_map_and_reference_agree_within_the_estimated_error(slenderness):
    rungs = [rung for rung in journal_rungs() if rung.name == "map"]
    ratios = np.linspace(0.05, 0.95, 13)
    result = journal_stability(slenderness, eccentricity_ratio=ratios, rungs=rungs, cells=(384, 16))
    # .83 % at L/D .1, .56 % at .5, .24 % at 1, .28 % at 4
    error, gaps = result.conditions[OWN_ERROR], result.columns()[DEVIATION]
    assert 1e-4 < error < 1e-2
    judged = [gap for gap, row in zip(gaps, result.rungs, strict=True) if is_judged(row[REFERENCE])]
    assert max(map(abs, judged)) < error


@pytest.mark.convergence
def test_averaging_takes_out_most_of_the_jitter_of_the_jacobian():
    # Turning bearing and journal together leaves a film alone; what it changes is the grid's doing.
    film = ReynoldsFilm(cells=(192, 8))
    angle = np.linspace(0.0, 2.0 * np.pi / 192, 16, endpoint=False)
    e = 0.6 * np.stack([np.cos(angle), np.sin(angle)])
    w = 0.5 * np.stack([e[1], -e[0]])
    turns = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])

    def spread(law):
        J = law.jacobian(e, w, 0.1)
        damping = np.einsum("jib,jkb,klb->ilb", turns, J[:, 2:], turns)
        return np.ptp(damping, axis=2).max()

    assert spread(AveragedFilm(film=film)) < 0.5 * spread(film)


def test_reference_and_map_are_stable_at_the_same_ratios(rung):
    assert rung["map"][REFERENCE][4] is None
    assert rung["map"][PARAMETER][4] is None


def test_one_circumferential_function_has_no_threshold(rung):
    first = rung["published (1, 1)"]
    assert first[PARAMETER] == first[DEVIATION] == [None] * 5
    assert all(first[RANK_ONE])
    assert first[MISSING] == [1, 1, 1, 1, 0]
    assert "rank 1" in first["why none [-]"][0]


def test_wrong_thresholds_are_marked(rung):
    assert rung["fixed arc converged"][WRONG] == [1, 1, 1, 1, 0]
    assert rung["rotating arc converged"][WRONG] == [0, 0, 0, 1, 0]
    assert not any(rung["free arc converged"][WRONG])


def test_tension_and_asymmetry_are_marked(rung):
    for name in ("published (1, 1)", "published (2, 1)", "fixed arc converged"):
        assert rung[name][MOVING][0] > 0.4
        assert max(rung[name][AT_REST]) < 1e-9
    assert rung["map"][MOVING][0] == 0.0
    assert max(rung["map"][AT_REST]) < 1e-2
    assert {name for name, law in rung.items() if max(law[UNSYMMETRIC]) > 0.01} == {
        "published (1, 1)",
        "rotating arc converged",
    }
    # A potential makes damping symmetric: exactly so for map and grid, for two functions on a fixed arc.
    for name in ("short film", "published (2, 1)", "2-D 96 x 8", "map"):
        assert max(rung[name][UNSYMMETRIC]) < 1e-9


def test_thresholds_above_the_highest_are_not_judged(monkeypatch):
    few = [rung for rung in journal_rungs() if rung.name == "fixed arc (2, all)"]
    given = {"eccentricity_ratio": (0.1, 0.5), "rungs": few, "cells": (64, 16)}
    assert journal_stability(0.5, **given).columns()[WRONG] == [1, 1]
    monkeypatch.setattr(journal_stability_module, "HIGHEST", 2.6)
    table = journal_stability(0.5, **given).columns()
    assert table[WRONG] == [0, 1]
    assert table[REFERENCE][0] > 2.6 > table[REFERENCE][1]


def test_threshold_where_the_reference_has_none_is_marked(monkeypatch):
    few = [rung for rung in journal_rungs() if rung.name == "rotating arc (2, 1)"]
    given = {"eccentricity_ratio": (0.5, 0.85), "rungs": few, "cells": (64, 16)}
    table = journal_stability(0.5, **given).columns()
    assert table[REFERENCE][1] is None
    assert table[PARAMETER][1] == pytest.approx(13.44, abs=0.01)
    assert table[INVENTED] == [0, 0]  # so high that nobody would meet it
    monkeypatch.setattr(journal_stability_module, "HIGHEST", 20.0)
    assert journal_stability(0.5, **given).columns()[INVENTED] == [0, 1]


def test_csv_round_trip(result, tmp_path):
    path = write_csv(tmp_path / "table.csv", result.columns())
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    assert len(rows) == len(RATIOS) * len(WANTED)
    for row, rung, ratio in zip(rows, result.rungs, RATIOS * len(WANTED), strict=True):
        assert f"{row['family [-]']} {row['label [-]']}".strip() == rung.name
        assert float(row["eccentricity ratio [1]"]) == ratio
    first = rows[len(RATIOS)]
    assert (first["speed sqrt(c m/W) [1]"], first["damping of rank one [-]"]) == ("", "1")
    assert float(rows[0]["speed sqrt(c m/W) [1]"]) == pytest.approx(2.741279, abs=1e-6)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"eccentricity_ratio": [0.0]}, r"eccentricity_ratio must hold numbers within \(0, 1\), got \[0.0\]"),
        ({"eccentricity_ratio": [-0.5]}, r"eccentricity_ratio must hold numbers within .* got \[-0.5\]"),
        ({"eccentricity_ratio": []}, r"eccentricity_ratio must hold numbers within .* got \[\]"),
        ({"rungs": []}, r"rungs must hold at least one StudyModel and nothing else, got \[\]"),
        (
            {"rungs": journal_rungs()[:1] * 2},
            "rungs must have different names, got .'short film', 'short film'",
        ),
        ({"cells": (100, 16)}, r"cells must be two multiples of 16, at least \(64, 16\), got \(100, 16\)"),
    ],
)
def test_mistakes_are_named(arguments, message):
    with pytest.raises(InputError, match=message):
        journal_stability(0.5, **arguments)
