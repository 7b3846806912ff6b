"""The open benchmark of bearing models: its measures, its files, and the page that shows them."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from open import compare, models

from rotorfilm import coefficients, critical_mass, equilibrium

ROOT = Path(__file__).parents[2]
EXACT = compare.reference_values()


def test_errors_are_relative_to_the_largest_entry():
    exact = EXACT["three_lobes"]
    assert set(compare.errors("three_lobes", exact, exact).values()) == {0.0}
    largest = max(abs(exact[name]) for name in compare.STIFFNESS)
    found = compare.errors("three_lobes", {**exact, "kxy": exact["kxy"] + 0.01 * largest}, exact)
    assert found["K"] == pytest.approx(0.01)
    assert found["C"] == 0.0
    assert 0.0 < found["threshold"] < 0.1
    warm = EXACT["heated_vg32"]
    hotter = {**warm, "maximum_temperature": warm["maximum_temperature"] + 1.0}
    rise = warm["maximum_temperature"] - models.CASES["heated_vg32"]["supply_temperature"]
    assert compare.errors("heated_vg32", hotter, warm)["temperature"] == pytest.approx(1.0 / rise)


def test_the_threshold_is_that_of_the_package():
    case = models.CASES["plain_short_light"]
    bearing = models.plain(case, models.MapFilm())
    at = equilibrium(bearing, case["load"], case["speed"])
    film = coefficients(bearing, at.position, case["speed"])
    values = models.table(case)
    assert compare.critical_mass(values) == pytest.approx(critical_mass(film).mass, rel=1e-9)
    stable = {**values, **dict(zip(compare.STIFFNESS, (1e8, 0.0, 0.0, 1e8), strict=True))}
    assert math.isnan(compare.critical_mass(stable))


@pytest.mark.literature
def test_the_reference_has_the_printed_digits():
    printed = compare.reference_values(compare.PUBLISHED)["short_friswell"]
    for name, value in printed.items():
        assert EXACT["short_friswell"][name] == pytest.approx(value, abs=1.0)


@pytest.mark.regression
@pytest.mark.parametrize("name", ["plain_short_light", "two_grooves_S0.635"])
def test_stored_results_are_those_of_the_models(name):
    stored = {}
    for row in compare.read(compare.RESULTS / "rotorfilm.csv"):
        if (row["case"], row["model"]) == (name, "grid 48 x 4"):
            stored[row["quantity"]] = float(row["value"])
    found = models.grid((48, 4))(models.CASES[name])
    assert found.keys() == stored.keys()
    np.testing.assert_allclose([found[q] for q in stored], list(stored.values()), rtol=1e-6)


def test_references_have_an_error_and_a_source():
    rows = compare.read(compare.REFERENCES)
    assert {row["case"] for row in rows} == set(models.CASES)
    assert all(float(row["error"]) >= 0.0 and row["source"] for row in rows)
    for case in models.CASES:
        own = {
            row["quantity"]: row
            for row in rows
            if row["case"] == case and row["quantity"] in compare.STIFFNESS
        }
        scale = max((abs(float(row["value"])) for row in own.values()), default=1.0)
        assert all(float(row["error"]) < 5e-3 * scale for row in own.values())


def test_results_of_another_code_are_checked(tmp_path):
    row = ["Mine", "1", "grid", "three_lobes", "0.5", "kxx", "1e9"]
    wrong = {
        "case 'no_such' is not": [*row[:3], "no_such", *row[4:]],
        "quantity 'Kxx' must be": [*row[:5], "Kxx", row[6]],
        "value and cost must be": [*row[:5], "kxy", "nan"],
        "stands twice": row,
    }
    for message, second in wrong.items():
        path = tmp_path / "mine.csv"
        with path.open("w", newline="") as file:
            csv.writer(file).writerows([compare.COLUMNS, row, second])
        [problem] = compare.problems(path)
        assert problem.startswith("line 3: ")
        assert message in problem
    path.write_text("code,case\nMine,three_lobes\n")
    assert compare.problems(path) == [f"the columns must be {', '.join(compare.COLUMNS)}"]


def test_the_page_has_the_tables_of_the_results():
    page = (ROOT / "docs" / "open_benchmark.md").read_text(encoding="utf-8")
    for line in [*compare.summary(compare.judged()), *compare.beside_published()]:
        assert line in page
