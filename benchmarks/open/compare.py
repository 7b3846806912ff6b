"""Errors and costs of all results of the open benchmark, as a table and a chart.

    python benchmarks/open/compare.py [PICTURE.png]    what is in benchmarks/open/results/
    python benchmarks/open/compare.py --add MINE.csv   check the results of another code and take them along

The chart is docs/chart_open.png, or the picture given. README.md says which columns a file of results has.
"""

from __future__ import annotations

import csv
import json
import math
import shutil
import sys
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np

from rotorfilm.charts import new_figure, save

HERE = Path(__file__).parent
RESULTS, REFERENCES, PUBLISHED = HERE / "results", HERE / "references.csv", HERE / "published.csv"
PICTURE = HERE.parents[1] / "docs" / "chart_open.png"
CASES: dict[str, dict[str, Any]] = json.loads((HERE / "cases.json").read_text(encoding="utf-8"))
COLUMNS = ("code", "version", "model", "case", "cost", "quantity", "value")

STIFFNESS, DAMPING = (tuple(f"{letter}{i}{j}" for i in "xy" for j in "xy") for letter in "kc")
QUANTITIES = ("x", "y", *STIFFNESS, *DAMPING, "power_loss", "maximum_temperature")
MEASURES = ("K", "C", "threshold", "power", "temperature")

Numbers = dict[str, float]
Solution = tuple[str, str, str]
"""Code with version, model, case."""


def read(path: Path) -> list[dict[str, str]]:
    """Return the rows of a table."""
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def problems(path: Path) -> list[str]:
    """Return what is wrong with a file of results."""
    rows = read(path)
    if not rows or tuple(rows[0]) != COLUMNS:
        return [f"the columns must be {', '.join(COLUMNS)}"]
    found, seen = [], set()
    for number, row in enumerate(rows, start=2):
        key = tuple(row[name] for name in ("code", "version", "model", "case", "quantity"))
        if row["case"] not in CASES:
            found.append(f"line {number}: case {row['case']!r} is not in cases.json")
        if row["quantity"] not in QUANTITIES:
            found.append(
                f"line {number}: quantity {row['quantity']!r} must be one of {', '.join(QUANTITIES)}"
            )
        if not _is_number(row["value"]) or not _is_number(row["cost"]) or not float(row["cost"]) > 0.0:
            found.append(f"line {number}: value and cost must be finite numbers, and the cost positive")
        if key in seen:
            found.append(f"line {number}: {' '.join(key)} stands twice")
        seen.add(key)
    return found


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def reference_values(path: Path = REFERENCES, column: str = "value") -> dict[str, Numbers]:
    """Return the values of a table by case and quantity."""
    found: dict[str, Numbers] = defaultdict(dict)
    for row in read(path):
        found[row["case"]][row["quantity"]] = float(row[column])
    return found


def critical_mass(values: Numbers) -> float:
    """Return the mass [kg] at which a rigid rotor on K and C loses stability (Lund 1987); NaN without one."""
    kxx, kxy, kyx, kyy = (values[name] for name in STIFFNESS)
    cxx, cxy, cyx, cyy = (values[name] for name in DAMPING)
    k = (kxx * cyy + kyy * cxx - kxy * cyx - kyx * cxy) / (cxx + cyy)
    squared = ((kxx - k) * (kyy - k) - kxy * kyx) / (cxx * cyy - cxy * cyx)
    return k / squared if k > 0.0 and squared > 0.0 else math.nan


def errors(case: str, values: Numbers, exact: Numbers) -> Numbers:
    """Return the error of each measure that a solution has.

    Errors of K and C are relative to the largest entry, that of a temperature to its rise above the supply.
    """
    found = {}
    for measure, entries in (("K", STIFFNESS), ("C", DAMPING)):
        if all(name in values and name in exact for name in entries):
            scale = max(abs(exact[name]) for name in entries)
            found[measure] = max(abs(values[name] - exact[name]) for name in entries) / scale
    if len(found) == 2 and CASES[case]["kind"] != "tilting pads":
        known = critical_mass(exact)
        if math.isfinite(known):
            found["threshold"] = abs(critical_mass(values) / known - 1.0)
    if "power_loss" in values and "power_loss" in exact:
        found["power"] = abs(values["power_loss"] / exact["power_loss"] - 1.0)
    if "maximum_temperature" in values:
        rise = exact["maximum_temperature"] - CASES[case]["supply_temperature"]
        found["temperature"] = abs(values["maximum_temperature"] - exact["maximum_temperature"]) / rise
    return found


def judged() -> dict[Solution, tuple[float, Numbers]]:
    """Return cost and errors of all solutions."""
    values: dict[Solution, Numbers] = defaultdict(dict)
    costs: dict[Solution, float] = {}
    for path in sorted(RESULTS.glob("*.csv")):
        for row in read(path):
            key = f"{row['code']} {row['version']}", row["model"], row["case"]
            values[key][row["quantity"]] = float(row["value"])
            costs[key] = float(row["cost"])
    exact = reference_values()
    return {key: (costs[key], errors(key[2], given, exact[key[2]])) for key, given in values.items()}


def summary(found: dict[Solution, tuple[float, Numbers]]) -> list[str]:
    """Return a line for each model and kind of case: cases, median cost, largest error of each measure."""
    groups: dict[tuple[str, str, str], list[tuple[float, Numbers]]] = defaultdict(list)
    for (code, model, case), judgment in found.items():
        groups[CASES[case]["kind"], code, model].append(judgment)
    lines = [
        "| Kind of case | Code | Model | Cases | Median cost | "
        + " | ".join(f"Error of {m}" for m in MEASURES)
        + " |"
    ]
    lines.append("|" + "---|" * (5 + len(MEASURES)))
    for (kind, code, model), judgments in sorted(groups.items()):
        cost = float(np.median([judgment[0] for judgment in judgments]))
        worst = [[e[m] for _, e in judgments if m in e] for m in MEASURES]
        cells = [f"{max(w):.1e}" if w and math.isfinite(max(w)) else "none" for w in worst]
        lines.append(
            f"| {kind} | {code} | {model} | {len(judgments)} | {cost:.2g} | " + " | ".join(cells) + " |"
        )
    return lines


def beside_published() -> list[str]:
    """Return a line for each published case: the largest distance of the references, and the last digit.

    Both are relative to the largest entry of K or of C.
    """
    exact, printed = reference_values(), reference_values(PUBLISHED)
    digits = reference_values(PUBLISHED, "error")
    lines = [
        "| Case | K and C of the reference beside the published values | Last digit of these |",
        "|---|---|---|",
    ]
    for case, values in printed.items():
        scale = {letter: max(abs(v) for q, v in exact[case].items() if q[0] == letter) for letter in "kc"}
        gaps = [abs(v - exact[case][q]) / scale[q[0]] for q, v in values.items()]
        allowed = [digits[case][q] / scale[q[0]] for q in values]
        lines.append(f"| {case} | {max(gaps):.1e} | {max(allowed):.1e} |")
    return lines


def draw(found: dict[Solution, tuple[float, Numbers]], picture: Path = PICTURE) -> None:
    """Write the chart of error over cost, a panel for each measure."""
    figure = new_figure(size=(11.0, 7.0))
    labels = sorted({(code, model) for code, model, _ in found})
    markers, colors = "osD^v<>Ph*X", ("#000000", "#17a0b8", "#d62728", "#2ca02c", "#9467bd", "#8c564b")
    panels = figure.subplots(2, 3).ravel()
    for axes, measure in zip(panels, MEASURES, strict=False):
        for k, (code, model) in enumerate(labels):
            mine = [
                (c, e[measure])
                for (a, b, _), (c, e) in found.items()
                if (a, b) == (code, model) and measure in e
            ]
            if mine:
                cost, error = np.array(mine).T
                look = {"color": colors[k % len(colors)], "label": f"{code}: {model}"}
                axes.plot(cost, np.maximum(error, 1e-7), markers[k % len(markers)], ms=5, alpha=0.8, **look)
        axes.set(
            xscale="log", yscale="log", title=f"{measure}", xlabel="cost [units]", ylabel="relative error [1]"
        )
        axes.grid(visible=True, alpha=0.3)
    handles = {
        label: h for axes in panels for h, label in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    panels[-1].axis("off")
    panels[-1].legend(handles.values(), handles.keys(), loc="center", fontsize=8)
    save(panels[0], picture)


def main(arguments: list[str]) -> int:
    """Take results along if asked to, print the table, and draw."""
    if arguments[:1] == ["--add"] and len(arguments) == 2:
        path = Path(arguments[1])
        wrong = problems(path)
        for line in wrong:
            print(line)
        if wrong:
            return 1
        shutil.copy(path, RESULTS / path.name)
    elif arguments[1:] or not all(word.endswith(".png") for word in arguments):
        print(__doc__)
        return 2
    found = judged()
    print("\n".join([*summary(found), "", *beside_published()]))
    draw(found, Path(arguments[0]) if arguments[:1] and arguments[0] != "--add" else PICTURE)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
