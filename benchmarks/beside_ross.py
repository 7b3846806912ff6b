"""Lund & Thomsen's bearings by the map, by the two-dimensional film and by ROSS: error, and time of a point.

    python benchmarks/beside_ross.py [PYTHON_WITH_ROSS]

It writes docs/chart_ross.png and benchmarks/results/beside_ross.json. ROSS runs beside it in the Python
given, in the same minutes; without one its figures are those of the last run, whose times do not compare.
Errors of K and C are over the largest entry of each; times are of the processor.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from published_pads import ELLIPTICAL, GROOVES, dimensions, largest, rest
from studies.ross_pads import LUND_THOMSEN

from rotorfilm import LobedBearing, lobe_set
from rotorfilm.bearings import PadGridFilm
from rotorfilm.charts import new_figure, save

HERE = Path(__file__).parent
STORED = HERE / "results" / "beside_ross.json"
PICTURE = HERE.parent / "docs" / "chart_ross.png"
ROWS = dict(zip(LUND_THOMSEN, (*ELLIPTICAL, *GROOVES), strict=True))
COARSE, FINE = (192, 16), (384, 32)
FILMS = {"map": None, "film of 192 x 16 cells": PadGridFilm(cells=COARSE)}
LOOKS = {"map": ("o", "#000000"), "film of 192 x 16 cells": ("s", "#17a0b8"), "ROSS": ("^", "#d62728")}


def bearing_of(name: str, film: PadGridFilm | None) -> LobedBearing:
    """Return the bearing of a row, on a film or on the map."""
    preload, slenderness, *_ = ROWS[name]
    lobes = lobe_set("elliptical", preload=preload)
    more = {} if film is None else {"film": film}
    return LobedBearing(**dimensions(slenderness), lobes=lobes, **more)


def coefficients_of(name: str, film: PadGridFilm | None) -> tuple[np.ndarray, np.ndarray]:
    """Return K and C over load / pad clearance (C times the speed), x and y across and against the load."""
    load = 1.0 / (math.pi * ROWS[name][2])
    _, K, C = rest(bearing_of(name, film), load)
    return K.ravel() / load, C.ravel() / load


def timed(call: Callable[[], object]) -> float:
    """Return the least time of the processor [s] in five calls."""
    times = []
    for _ in range(5):
        begin = time.process_time()
        call()
        times.append(time.process_time() - begin)
    return min(times)


def ross(python: str) -> dict[str, dict]:
    """Return the figures of ROSS in another Python: K, C and time by row."""
    command = [python, str(HERE / "studies" / "ross_pads.py"), "lund_thomsen"]
    told = subprocess.run(command, check=True, capture_output=True, text=True, cwd=HERE).stdout
    found = json.loads(told[told.index('{\n "version"') :])
    found["rows"] = {}
    for name, case in found.pop("cases").items():
        load = LUND_THOMSEN[name][-1]
        K, C = (np.divide(case[key], load).tolist() for key in "KC")
        found["rows"][name] = {"K": K, "C": C, "time": case["time"]}
    return found


def ours(label: str, film: PadGridFilm | None) -> dict[str, dict]:
    """Return the figures of a film: K, C and time by row."""
    found = {}
    for name in ROWS:
        K, C = coefficients_of(name, film)
        taken = timed(lambda name=name: coefficients_of(name, film))
        found[name] = {"K": K.tolist(), "C": C.tolist(), "time": taken}
    return found


def reference(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Return K and C extrapolated from two grids, which are of second order."""
    coarse, fine = (coefficients_of(name, PadGridFilm(cells=cells)) for cells in (COARSE, FINE))
    K, C = (f + (f - c) / 3.0 for f, c in zip(fine, coarse, strict=True))
    return K, C


def printed_distance(name: str, K: np.ndarray, C: np.ndarray) -> float:
    """Return the largest distance from what is printed, over the largest entry of K or C."""
    (a, b, c, d), (e, f, _, h) = K, C
    _, _, _, _, _, printed_K, printed_C = ROWS[name]
    return max(
        largest((d, -c, -b, a), printed_K) / np.abs(printed_K).max(),
        largest((h, -f, e), printed_C) / np.abs(printed_C).max(),
    )


def judged(found: dict[str, dict[str, dict]]) -> list[dict]:
    """Return a row for each model and bearing: error, distance from the print, time."""
    rows = []
    for name in ROWS:
        exact = reference(name)
        for label, by_row in found.items():
            K, C = (np.array(by_row[name][key]) for key in "KC")
            errors = [np.abs(x - y).max() / np.abs(y).max() for x, y in zip((K, C), exact, strict=True)]
            printed = printed_distance(name, K, C)
            rows.append(
                {
                    "model": label,
                    "bearing": name,
                    "error": float(max(errors)),
                    "print": printed,
                    "time": by_row[name]["time"],
                }
            )
    return rows


def draw(rows: list[dict], version: str) -> None:
    """Write the picture."""
    figure = new_figure(size=(10.0, 4.4))
    cost, prints = figure.subplots(1, 2)
    for label, (marker, color) in LOOKS.items():
        mine = [row for row in rows if row["model"] == label]
        shown = f"ROSS {version}, 40 x 20 elements" if label == "ROSS" else f"rotorfilm: {label}"
        errors = [max(row["error"], 1e-6) for row in mine]
        cost.plot([1e3 * row["time"] for row in mine], errors, marker, color=color, label=shown)
        prints.plot(range(len(mine)), [row["print"] for row in mine], marker, color=color)
    cost.set(xscale="log", yscale="log", xlabel="equilibrium, K and C of one bearing [ms of the processor]")
    cost.set(
        ylabel="largest error of K, C / largest entry",
        title="Compared with a film of 384 x 32 cells, extrapolated",
    )
    cost.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), fontsize=8)
    prints.set(ylabel="largest distance of K, C / largest entry", title="Compared with Lund & Thomsen (1978)")
    labels = [name.replace(", S", "\nS") for name in ROWS]
    prints.set_xticks(range(len(labels)), labels, rotation=30, ha="right", fontsize=7)
    prints.set_ylim(bottom=0.0)
    for axes in (cost, prints):
        axes.grid(visible=True, alpha=0.3)
    save(cost, PICTURE)


def main() -> None:
    """Compute, draw and print."""
    stored = ross(sys.argv[1]) if sys.argv[1:] else json.loads(STORED.read_text())["ross"]
    found = {label: ours(label, film) for label, film in FILMS.items()} | {"ROSS": stored["rows"]}
    rows = judged(found)
    STORED.write_text(json.dumps({"ross": stored, "rows": rows}, indent=1) + "\n")
    draw(rows, stored["version"])
    print(f"{'bearing':32}{'model':26}{'error':>10}{'print':>10}{'time [ms]':>12}")
    for row in rows:
        figures = f"{row['error']:10.1e}{row['print']:10.1e}{1e3 * row['time']:12.3g}"
        print(f"{row['bearing']:32}{row['model']:26}{figures}")


if __name__ == "__main__":
    main()
