"""Compute the open benchmark: results of rotorfilm and of ROSS, or the reference values.

    python benchmarks/open/run.py [PYTHON_WITH_ROSS]    results, in one run, then the comparison
    python benchmarks/open/run.py --references          reference values, in a minute

Without a Python with ROSS its last rows stay; their costs are ratios to the unit of their own run.
"""

from __future__ import annotations

import subprocess
import sys
import warnings
from importlib.metadata import version
from typing import Any

import compare
import models

HEADER = ("code", "version", "model", "case", "cost", "quantity", "value")


def references() -> list[dict[str, Any]]:
    """Return the rows of the reference values."""
    found = []
    for name, case in models.CASES.items():
        grids = models.FINEST[case["kind"]]
        source = "closed form (short bearing)"
        if grids is not None:
            cells = " to ".join(f"{a} x {b}" for a, b in grids)
            source = f"rotorfilm, extrapolated from grids of {cells} cells"
        for quantity, (value, error) in models.reference(case).items():
            numbers = {"value": f"{value:.10g}", "error": f"{error:.2g}"}
            found.append({"case": name, "quantity": quantity, **numbers, "source": source})
    return found


def ross(python: str, unit: float) -> list[dict[str, Any]]:
    """Return the rows of ROSS in another Python."""
    command = [python, str(models.HERE / "ross_results.py"), repr(unit)]
    told = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    lines = [line.split(",") for line in told.splitlines() if line.startswith("ROSS,")]
    return [dict(zip(HEADER, line, strict=True)) for line in lines]


def main() -> int:
    """Write the tables, then compare."""
    warnings.simplefilter("ignore")
    if sys.argv[1:] == ["--references"]:
        models.write_rows(compare.REFERENCES, references())
        return 0
    models.write_rows(compare.RESULTS / "rotorfilm.csv", models.rows("rotorfilm", version("rotorfilm")))
    if sys.argv[1:]:
        models.write_rows(compare.RESULTS / "ross.csv", ross(sys.argv[1], models.seconds(models.unit_job)))
    return compare.main([])


if __name__ == "__main__":
    sys.exit(main())
