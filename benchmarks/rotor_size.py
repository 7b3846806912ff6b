"""What the analyses of a flexible rotor cost over its number of elements, with ROSS beside if there.

    python benchmarks/rotor_size.py [CHART.png]

The rotor of Friswell et al. (2010), section 5.9, on springs of 1 MN/m and 50 N s/m, CPU seconds on one core,
the rotor made anew for each:

- modes to 1000 rad/s at 300 rad/s, and a Campbell diagram of them at 50 speeds from 50 to 400 rad/s;
- critical speeds up to 700 rad/s from 15 speeds; response to unbalance at 200 speeds from 50 to 400 rad/s;
- the threshold of stability on the films of example 5.9.6, from 15 speeds between 50 and 400 rad/s.

`error`: of the eigenvalues, as the Campbell diagram estimates it. `off`: that of the first eight whirls
against all coordinates, where these are solved. ROSS has six degrees of freedom a node; its critical speeds
are the first eight.
"""

from __future__ import annotations

import contextlib
import io
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from rotorfilm import LinearBearing
from rotorfilm.analysis import campbell, critical_speeds, rotor_modes, rotor_threshold, unbalance_response
from rotorfilm.analysis.rotor_equilibrium import rest
from rotorfilm.analysis.rotor_matrices import second_order
from rotorfilm.bearings.journal import JournalBearing, ShortFilm
from rotorfilm.rotors import Disk, ElasticMaterial, ShaftElement, ShaftRotor, Station, Unbalance

SIZES = (12, 48, 201, 999)
MOST_OF_ALL, MOST_OF_ROSS = 48, 48
STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
SPRING = LinearBearing(stiffness=1e6, damping=50.0)
SPRINGS, FILMS = ({"left": bearing, "right": bearing} for bearing in (SPRING, FILM))
CHART, RESPONSE = np.linspace(50.0, 400.0, 50), np.linspace(50.0, 400.0, 200)
SEARCH, THRESHOLD = np.linspace(20.0, 700.0, 15), np.linspace(50.0, 400.0, 15)
COLUMNS = ("modes", "campbell", "critical", "unbalance", "threshold")


def main() -> None:
    """Print the table."""
    solve(12)  # imports
    own: dict[int, list[float]] = {}
    print("CPU [s]       " + "".join(f"{name:>11}" for name in COLUMNS) + f"{'error':>10}{'off':>10}")
    for count in SIZES:
        times, error = solve(count)
        own[count] = times
        off = f"{all_coordinates(count):10.1e}" if count <= MOST_OF_ALL else f"{'':>10}"
        print(
            f"{count:5} elements" + "".join(f"{t:11.3f}" for t in times) + f"{error:10.1e}{off}", flush=True
        )
        beside = ross_times(count) if count <= MOST_OF_ROSS else None
        if beside:
            print("          ROSS" + "".join(f"{t:11.3f}" for t in beside), flush=True)
            ratios = [b / t for b, t in zip(beside, times, strict=False)]
            print("       / ours " + "".join(f"{r:11.1f}" for r in ratios), flush=True)
    if len(sys.argv) > 1:
        draw(own, sys.argv[1])


def draw(own: dict[int, list[float]], path: str) -> None:
    """Draw the times of the columns [s] over the number of elements."""
    from rotorfilm.charts import new_figure, save

    axes = new_figure(size=(8.4, 4.0)).subplots()
    names = ("modes", "Campbell, 50 speeds", "critical speeds", "unbalance, 200 speeds", "threshold on films")
    for name, times in zip(names, np.transpose(list(own.values())), strict=True):
        axes.loglog(list(own), times, marker="o", label=name)
    axes.set(xlabel="elements", ylabel="CPU time [s]", title="Cost of analyses over the size of a rotor")
    axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))
    save(axes, Path(path))


def shaft(count: int) -> ShaftRotor:
    """Return the rotor in so many elements."""
    disk: dict[str, Any] = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    small, large = count // 3, 2 * count // 3
    return ShaftRotor(
        elements=ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL).split(count),
        disks=(
            Disk.solid(small, outer_diameter=0.28, **disk),
            Disk.solid(large, outer_diameter=0.35, **disk),
        ),
        stations=(Station(node=0, name="left"), Station(node=count, name="right")),
        unbalances=(Unbalance(node=small, unbalance=1e-3),),
        speed=0.0,
    )


def timed(call: Callable[[], Any]) -> tuple[float, Any]:
    """Return the CPU time of a call [s], and what it returns."""
    start = time.process_time()
    found = call()
    return time.process_time() - start, found


def solve(count: int) -> tuple[list[float], float]:
    """Return the times of the columns [s], and the error that the Campbell diagram tells."""
    calls: list[Callable[[ShaftRotor], Any]] = [
        lambda rotor: rotor_modes(rotor, SPRINGS, 300.0, 1000.0),
        lambda rotor: campbell(rotor, SPRINGS, CHART, 1000.0),
        lambda rotor: critical_speeds(rotor, SPRINGS, SEARCH),
        lambda rotor: unbalance_response(rotor, SPRINGS, RESPONSE),
        lambda rotor: rotor_threshold(rotor, FILMS, THRESHOLD),
    ]
    done = [timed(lambda call=call: call(shaft(count))) for call in calls]  # type: ignore[misc]
    return [taken for taken, _ in done], done[1][1].error


def all_coordinates(count: int) -> float:
    """Return the largest relative error of the first eight whirls against all eigenvalues."""
    rotor = shaft(count)
    modes = rotor_modes(rotor, SPRINGS, 300.0, 3000.0)
    system = second_order(rotor.structure, rest(rotor.structure, SPRINGS, 300.0))
    exact = np.linalg.eigvals(system.state_matrix())
    return max(float(np.abs(exact - one).min() / abs(one)) for one in modes.eigenvalues[:8])


def ross_times(count: int) -> list[float] | None:
    """Return the times of ROSS in the order of the columns, no threshold [s]; None without it."""
    try:
        with contextlib.redirect_stdout(io.StringIO()):  # it tells of its own parts
            import ross
    except ImportError:
        return None
    steel = ross.Material(name="steel", rho=7810.0, E=211e9, G_s=81.2e9)
    pieces = [ross.ShaftElement(L=1.5 / count, idl=0.0, odl=0.05, material=steel) for _ in range(count)]
    disks = [
        ross.DiskElement.from_geometry(n=node, material=steel, width=0.07, i_d=0.05, o_d=outer)
        for node, outer in ((count // 3, 0.28), (2 * count // 3, 0.35))
    ]
    springs = [ross.BearingElement(n=node, kxx=1e6, cxx=50.0) for node in (0, count)]
    rotor = ross.Rotor(pieces, disks, springs)
    rotor.run_modal(speed=10.0)
    calls = [
        lambda: rotor.run_modal(speed=300.0, num_modes=24),
        lambda: rotor.run_campbell(CHART, frequencies=6),
        lambda: rotor.run_critical_speed(num_modes=16),
        lambda: rotor.run_unbalance_response([count // 3], [1e-3], [0.0], RESPONSE),
    ]
    return [timed(call)[0] for call in calls]


if __name__ == "__main__":
    main()
