"""The cases of the open benchmark by ROSS, as rows of results; it needs nothing of rotorfilm.

PYTHON_WITH_ROSS benchmarks/open/ross_results.py SECONDS_OF_THE_UNIT > rows.csv
"""

from __future__ import annotations

import csv
import json
import math
import sys
import warnings
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "studies"))

import ross_pads  # noqa: E402  # its folder is put on the path above


def told_case(case: dict) -> tuple:
    """Return a case as ross_pads has it; its sizes are those of ross_pads.py."""
    slenderness = case["length"] / (2.0 * case["radius"])
    unit = (
        ross_pads.VISCOSITY * case["length"] * ross_pads.RADIUS**3 * ross_pads.SPEED / ross_pads.CLEARANCE**2
    )
    kind = case["kind"].partition(" ")[0]
    shape = case["pivots_deg"], case["pad_extent_deg"], slenderness, case["preload"], case["offset"]
    return kind, *shape, -case["load"][1] / unit


def main() -> None:
    """Print the rows."""
    import ross

    warnings.simplefilter("ignore")
    out = csv.writer(sys.stdout, lineterminator="\n")
    around, along = ross_pads.ELEMENTS
    for name, case in json.loads((HERE / "cases.json").read_text(encoding="utf-8")).items():
        if "pads" not in case["kind"]:
            continue
        told = told_case(case)
        found, unit = ross_pads.solved(told), ross_pads.arguments(told)[1]
        scale = unit / ross_pads.CLEARANCE
        names = [f"{letter}{i}{j}" for letter in "kc" for i in "xy" for j in "xy"]
        values = [*found["K"], *(c / ross_pads.SPEED for c in found["C"])]
        numbers = [*(ross_pads.CLEARANCE * p for p in found["place"]), *(scale * value for value in values)]
        cost = found["time"] / float(sys.argv[1])
        for quantity, value in zip(["x", "y", *names], numbers, strict=True):
            if math.isfinite(value):
                model = f"{around} x {along} elements"
                out.writerow(
                    ["ROSS", ross.__version__, model, name, f"{cost:.3g}", quantity, f"{value:.10g}"]
                )


if __name__ == "__main__":
    main()
