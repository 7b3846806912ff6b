"""Bearings made of pads: maps against the two-dimensional film, times, and ROSS 3.1 beside.

    python benchmarks/pads.py

1 Force of a whole bearing from pad maps against grids of 288 x 24 cells a pad, extrapolated, on 400
  random states (100 each of elliptical, three-lobe, four-lobe and offset-halves bearings): error over
  max(|F|, 5 % of the largest force at that place). Goal: 1e-3 in 90 %, 5e-3 in 99 %.
2 K and C of tilting pads from maps against grids of 384 x 32 cells, of the largest entry. Goal: 1e-3. Beside
  it the grids of 192 x 16 cells.
3 CPU times: equilibrium with coefficients (goal 1 ms), force of a pad in a batch (goal .15 us). Making of a
  map.
4 Six bearings by maps, by grids and by ROSS 3.1, isoviscous with 40 x 20 elements, as `studies/ross_pads.py`
  found them.
"""

from __future__ import annotations

import json
import math
import os
import sys
import tempfile
import time
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from studies.ross_pads import CASES, CLEARANCE, RADIUS, SPEED, VISCOSITY

from rotorfilm import LobedBearing, TiltingPadBearing, coefficients, equilibrium, even_pivots
from rotorfilm.bearings import PadGridFilm
from rotorfilm.bearings.pads import Lobe, PadMapFilm
from rotorfilm.studies import bearing_types, pad_accuracy, pad_rungs
from rotorfilm.studies.pad_accuracy import compared_bearings, lobe_states

ROSS = Path(__file__).parent / "results" / "ross_pads.json"
SLENDERNESS = (0.25, 0.5, 1.0)
SOMMERFELD = (0.1, 0.2, 0.4, 0.7, 1.2, 2.0)
"""Over the pad clearance."""
GRID, FINE = PadGridFilm(cells=(192, 16)), PadGridFilm(cells=(384, 32))


def forces() -> None:
    """Print error and cost of the film of a pad."""
    sys.stdout.write("## Force of a bearing, 400 states\n\n")
    head = ("L/D", "film", "median", "90 %", "99 %", "reference 90 %", "99 %")
    table_head(head)
    kept = [rung for rung in pad_rungs() if rung.family == "map"][1:]
    for slenderness in SLENDERNESS:
        found = pad_accuracy(slenderness, states=100, rungs=kept, rounds=1)
        for rung in found.rungs:
            errors = (rung[f"{part} error [1]"] for part in ("median", "90 %", "99 %"))
            row(
                slenderness,
                rung.name,
                *(f"{error:.1e}" for error in errors),
                f"{found.conditions['reference error, 90 % [1]']:.1e}",
                f"{found.conditions['reference error, 99 % [1]']:.1e}",
            )


def tilting_coefficients() -> None:
    """Print how far K and C of tilting pads from maps are off."""
    sys.stdout.write(
        "\n## K and C of tilting pads at the frequency of the shaft, map against 384 x 32 cells\n\n"
    )
    table_head(("pads", *(f"S {S:g}: K, C" for S in SOMMERFELD), "grid 192 x 16: largest K, C"))
    for pads, extent, slenderness, preload, offset, between in (
        (4, 75.0, 0.7, 0.5, 0.5, True),
        (5, 60.0, 0.5, 0.3, 0.5, False),
        (5, 60.0, 0.5, 0.0, 0.6, True),
        (3, 95.0, 1.0, 0.4, 0.55, False),
    ):
        bearing = TiltingPadBearing(
            radius=RADIUS,
            length=2.0 * RADIUS * slenderness,
            viscosity=VISCOSITY,
            pad_clearance=CLEARANCE,
            preload=preload,
            pivot_offset=offset,
            extent=math.radians(extent),
            pivots=even_pivots(pads, between_pads=between),
        )
        found = np.array([gaps(bearing, S) for S in SOMMERFELD])
        where = f"{pads} x {extent:g} deg, L/D {slenderness:g}, m {preload:g}, off {offset:g}"
        last = found[:, 1].max(axis=0)
        cells = (f"{K:.1e}, {C:.1e}" for K, C in [*found[:, 0], last])
        row(where + (", between" if between else ""), *cells)


def gaps(bearing: TiltingPadBearing, sommerfeld: float) -> list[list[float]]:
    """Return the distances of K and C of map and grid from those of the finest grid."""
    load = (0.0, -bearing.force_scale * SPEED / (math.pi * sommerfeld))
    found = []
    for film in (bearing.film, GRID, FINE):
        one = replace(bearing, film=film)
        found.append(coefficients(one, equilibrium(one, load, SPEED).position, SPEED))
    pairs = [(one.stiffness, one.damping) for one in found]
    return [
        [float(np.abs(a - b).max() / np.abs(b).max()) for a, b in zip(pair, pairs[-1], strict=True)]
        for pair in pairs[:-1]
    ]


def times() -> None:
    """Print times of equilibria with coefficients, and of maps that are made."""
    sys.stdout.write("\n## Equilibrium with coefficients, 6 loads of S .1 to 2, L/D .5\n\n")
    table_head(("bearing", "time [us]", "Newton steps"))
    for name, one in bearing_types(0.5).items():
        loads = [-one.force_scale * SPEED / (math.pi * S) for S in SOMMERFELD]

        def solve(bearing=one, loads=loads) -> list[int]:
            found = [equilibrium(bearing, (0.0, load), SPEED) for load in loads]
            for at in found:
                coefficients(bearing, at.position, SPEED)
            return [at.iterations for at in found]

        steps = np.mean(solve())
        row(name, f"{1e6 * cpu_time(solve, 9) / len(loads):.0f}", f"{steps:.1f}")
    batch_times()
    sys.stdout.write("\n## Making of a map\n\n")
    table_head(("extent [deg]", "L/D", "time [s]", "CPU time [s]"))
    for extent, slenderness in ((60.0, 0.5), (100.0, 1.0), (160.0, 0.5)):
        row(extent, slenderness, *(f"{value:.1f}" for value in making(math.radians(extent), slenderness)))


def batch_times() -> None:
    """Print the time of the force of one pad in a batch."""
    sys.stdout.write("\n## Force of one pad in a batch of 8192\n\n")
    table_head(("bearing", "pads", "time of a pad [us]"))
    for name, bearing in compared_bearings(0.5).items():
        states = lobe_states(bearing, 8192, 1)
        bearing.force(*states)
        spent = cpu_time(lambda of=bearing, at=states: of.force(*at), 25)
        row(name, len(bearing.lobes), f"{1e6 * spent / (8192 * len(bearing.lobes)):.3f}")


def making(extent: float, slenderness: float) -> tuple[float, float]:
    """Return time and CPU time of making a map [s], in a folder that has none."""
    before = os.environ.get("ROTORFILM_CACHE")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["ROTORFILM_CACHE"] = folder
        begin, spent = time.perf_counter(), time.process_time()
        PadMapFilm().table(extent, slenderness)
        found = time.perf_counter() - begin, time.process_time() - spent
    if before is None:
        del os.environ["ROTORFILM_CACHE"]
    else:
        os.environ["ROTORFILM_CACHE"] = before
    return found


def case_bearing(name: str) -> LobedBearing | TiltingPadBearing:
    """Return the bearing of a case of `studies/ross_pads.py`."""
    kind, angles, extent, slenderness, preload, offset, _ = CASES[name]
    arc, places = math.radians(extent), [math.radians(angle) for angle in angles]
    made = {
        "radius": RADIUS,
        "length": 2.0 * RADIUS * slenderness,
        "viscosity": VISCOSITY,
        "pad_clearance": CLEARANCE,
    }
    if kind == "fixed":
        lobes = [Lobe(start=at - offset * arc, extent=arc, preload=preload, offset=offset) for at in places]
        return LobedBearing(**made, lobes=tuple(lobes))
    return TiltingPadBearing(**made, pivots=tuple(places), extent=arc, preload=preload, pivot_offset=offset)


def beside_ross() -> None:
    """Print places, coefficients and the time of a point of six bearings."""
    stored = json.loads(ROSS.read_text(encoding="utf-8"))
    sys.stdout.write(f"\n## Six bearings by maps, by grids and by ROSS {stored['version']}\n\n")
    names = ("x / c_p", "y / c_p", "Kxx", "Kxy", "Kyx", "Kyy", "Cxx", "Cxy", "Cyy")
    table_head(("bearing", "by", *names, "point [ms]"))
    for name, case in CASES.items():
        bearing = case_bearing(name)
        unit = bearing.force_scale * SPEED
        load = (0.0, -case[-1] * unit)
        for by, one in (("map", bearing), ("grid 192 x 16", replace(bearing, film=GRID))):

            def point(one=one, load=load, unit=unit) -> list[float]:
                at = equilibrium(one, load, SPEED)
                film = coefficients(one, at.position, SPEED)
                K, C = film.stiffness * CLEARANCE / unit, film.damping * CLEARANCE * SPEED / unit
                return [*at.position / CLEARANCE, *K.ravel(), C[0, 0], C[0, 1], C[1, 1]]

            values = point()
            spent = cpu_time(point, 3)
            row(name, by, *(f"{value:.4f}" for value in values), f"{1e3 * spent:.3g}")
        ross = stored["cases"][name]
        C = ross["C"]
        values = [*ross["place"], *ross["K"], C[0], C[1], C[3]]
        row(name, "ROSS 40 x 20", *(f"{value:.4f}" for value in values), f"{1e3 * ross['time']:.3g}")


def cpu_time(call: Callable[[], object], repeats: int) -> float:
    """Return the shortest CPU time of a call [s]: other work on the machine is not in it."""
    times = []
    for _ in range(repeats):
        begin = time.process_time()
        call()
        times.append(time.process_time() - begin)
    return min(times)


def table_head(names: tuple[str, ...]) -> None:
    """Print the head of a table."""
    sys.stdout.write("| " + " | ".join(names) + " |\n" + len(names) * "|---" + "|\n")


def row(*cells: object) -> None:
    """Print a row of a table."""
    sys.stdout.write("| " + " | ".join(map(str, cells)) + " |\n")
    sys.stdout.flush()


def main() -> None:
    """Print all tables."""
    warnings.simplefilter("ignore")  # unloaded pads are said by the notes
    forces()
    tilting_coefficients()
    times()
    beside_ross()


if __name__ == "__main__":
    main()
