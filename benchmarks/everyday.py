"""What everyday jobs cost over the size of a rotor, for four kinds of bearings, with default threads.

    python benchmarks/everyday.py [--only JOB ...] [--kinds KIND ...] [--json]

Each cell is the CPU time [s] of one job on a rotor made anew: two disks on a steel shaft of 1.5 m, two equal
bearings, 6 to 1000 elements. The rows below a table tell the growth of the time from 50 to 1000 elements as
a power of their number, and the largest memory [MB]. A job that takes more than its limit is stopped, and
neither is it tried with more elements.
"""

from __future__ import annotations

import argparse
import json
import math
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

SIZES = (6, 50, 200, 1000)
LIMIT = 20.0
"""CPU seconds after which a job is stopped."""


def rotor(count: int, speed: Any = 0.0, unbalance: float = 2e-4) -> Any:
    """Return the shaft in so many elements."""
    import rotorfilm as rf

    steel = rf.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    first, second = count // 3, 2 * count // 3
    return rf.ShaftRotor(
        elements=rf.ShaftElement(length=1.5, outer_diameter=0.05, material=steel).split(count),
        disks=(
            rf.Disk.solid(first, outer_diameter=0.28, **disk),
            rf.Disk.solid(second, outer_diameter=0.35, **disk),
        ),
        stations=(rf.Station(node=0, name="left"), rf.Station(node=count, name="right")),
        unbalances=(rf.Unbalance(node=first, unbalance=unbalance),),
        speed=speed,
    )


def bearing(kind: str) -> Any:
    """Return the bearing of a kind."""
    import rotorfilm as rf

    size = {"radius": 0.05, "length": 0.03}
    if kind == "pads":
        pads = rf.even_pivots(4, between_pads=True)
        return rf.TiltingPadBearing(
            **size,
            assembled_clearance=1e-4,
            viscosity=0.05,
            pivots=pads,
            extent=math.radians(72),
            preload=0.3,
        )
    if kind == "heated":
        cooling = rf.Cooling(supply_temperature=318.15)
        return rf.JournalBearing(**size, clearance=1e-4, oil=rf.Oil.iso_vg(46), cooling=cooling)
    groove = (rf.Groove(center=math.pi / 2.0, width=0.3),) if kind == "JFO" else ()
    plain = rf.JournalBearing(**size, clearance=1e-4, viscosity=0.05, grooves=groove)
    return rf.JFOFilm(bearing=plain, cells=(72, 8)) if kind == "JFO" else plain


KINDS = ("plain", "pads", "heated", "JFO")


def jobs(kind: str) -> dict[str, Callable[[int], Any]]:
    """Return each job as a function of the number of elements."""
    import numpy as np

    import rotorfilm as rf

    one = bearing(kind)
    films = {"left": one, "right": one}
    speeds = np.linspace(50.0, 400.0, 50)
    rise = rf.SpeedProfile(times=(0.0, 3.0), speeds=(50.0, 400.0))

    def orbit(count: int) -> Any:
        return rf.periodic_orbit(rf.mount(rotor(count, 200.0), films))

    return {
        "rest": lambda count: rf.rotor_equilibrium(rotor(count), films, 200.0),
        "modes": lambda count: rf.rotor_modes(rotor(count), films, 200.0, 2000.0),
        "Campbell": lambda count: rf.campbell(rotor(count), films, speeds, 2000.0),
        "critical": lambda count: rf.critical_speeds(rotor(count), films, np.linspace(20.0, 700.0, 15)),
        "threshold": lambda count: rf.rotor_threshold(rotor(count), films, np.linspace(50.0, 400.0, 15)),
        "unbalance": lambda count: rf.unbalance_response(rotor(count), films, np.linspace(50.0, 400.0, 200)),
        "20 turns": lambda count: rf.simulate(rotor(count, 200.0), films, duration=40.0 * math.pi / 200.0),
        "run-up": lambda count: rf.simulate(rotor(count, rise), films, duration=3.0, rtol=1e-6),
        "orbit": orbit,
        "curve": lambda count: rf.continue_orbits(
            lambda speed: rf.mount(rotor(count, speed), films),
            orbit(count),
            bounds=(150.0, 250.0),
            parameter=200.0,
        ),
        "export": lambda count: exported(rf.mount(rotor(count, 200.0), films)),
    }


def exported(model: Any) -> None:
    """Export an FMU of the whole machine."""
    import rotorfilm as rf

    with tempfile.TemporaryDirectory() as folder:
        rf.export_fmu(model, Path(folder) / "machine.fmu")


def run_cell(kind: str, job: str) -> None:
    """Print one line of JSON for each size."""
    import warnings

    warnings.simplefilter("ignore")
    call = jobs(kind)[job]
    call(3)  # imports, and maps that are made once
    for count in SIZES:
        start = time.process_time()
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(start + LIMIT), resource.RLIM_INFINITY))
        call(count)
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
        print(json.dumps([count, time.process_time() - start, memory]), flush=True)


def cells(
    kinds: list[str], wanted: list[str]
) -> Iterator[tuple[str, str, dict[int, tuple[float, float]], str]]:
    """Give kind, job, time and memory by the number of elements, and why it ended early."""
    for kind in kinds:
        for job in wanted:
            command = [sys.executable, __file__, "--cell", kind, job]
            done = subprocess.run(command, capture_output=True, text=True)
            rows = [json.loads(line) for line in done.stdout.splitlines()]
            why = "" if done.returncode == 0 else (done.stderr.strip().splitlines() or ["over the limit"])[-1]
            yield kind, job, {count: (taken, memory) for count, taken, memory in rows}, why


def line_of(job: str, found: dict[int, tuple[float, float]], why: str) -> str:
    """Return a row of the table."""
    times = [f"{found[count][0]:10.3f}" if count in found else f"{'-':>10}" for count in SIZES]
    last = max(found, default=0)
    growth = math.log(found[last][0] / found[50][0]) / math.log(last / 50) if last > 50 else math.nan
    memory = max((memory for _, memory in found.values()), default=math.nan)
    return f"{job:12}" + "".join(times) + f"{growth:9.2f}{memory:9.0f}  {why[:60]}"


def main() -> None:
    """Print the tables."""
    names = [
        "rest",
        "modes",
        "Campbell",
        "critical",
        "threshold",
        "unbalance",
        "20 turns",
        "run-up",
        "orbit",
        "curve",
    ]
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--only", nargs="+", default=[*names, "export"], metavar="JOB")
    parser.add_argument("--kinds", nargs="+", default=KINDS, choices=KINDS)
    parser.add_argument("--json", action="store_true", help="print one JSON line for each cell")
    parser.add_argument("--cell", nargs=2, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.cell:
        return run_cell(*options.cell)
    before = ""
    for kind, job, found, why in cells(options.kinds, options.only):
        if options.json:
            print(json.dumps({"kind": kind, "job": job, "cells": found, "why": why}), flush=True)
            continue
        if kind != before:
            sizes = "".join(f"{count:>10}" for count in SIZES)
            print(f"\n{kind:12}{sizes}   growth   memory", flush=True)
            before = kind
        print(line_of(job, found, why), flush=True)
    return None


if __name__ == "__main__":
    main()
