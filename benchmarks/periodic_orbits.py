"""A periodic orbit by harmonic balance beside a transient run to steady state: cost at equal error.

Error: largest distance of a journal from the converged orbit, in clearances. The run starts from a straight
shaft at rest and lasts until what is left of its start is as large as the error allows, to 19 %: a user would
have to run longer, to know. Two runs: `simulate_rotor`, itself far cheaper than a general integrator, and
scipy's Radau or LSODA, whichever is cheaper, with the right-hand side and Jacobian of rotor_transient.py.
Times are of the processor, one thread; multipliers are not computed where only the orbit is asked for.

    python benchmarks/periodic_orbits.py [CHART.png]
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from time import process_time

import numpy as np
from matplotlib.figure import Figure
from rotor_transient import journal_rows, scipy_problem
from scipy.integrate import solve_ivp

from rotorfilm import (
    ClassicalBeam,
    Disk,
    ElasticMaterial,
    JournalBearing,
    RigidRotor,
    ShaftElement,
    ShaftRotor,
    Station,
    Unbalance,
    mount,
    periodic_orbit,
    simulate_rotor,
    whirl_threshold,
)
from rotorfilm.rotors import MountedRotor

FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
TARGETS = (1e-4, 1e-6)
MOST_TURNS = 4000


def rigid(part: float) -> MountedRotor:
    """Return a rigid rotor at a part of the speed at which it begins to whirl."""
    onset = whirl_threshold(FILM, [0.0, -53.5 * 9.80665], 53.5).speed
    return mount(RigidRotor(mass=53.5, speed=part * onset, unbalance=1.5e-3), {"": FILM})


def flexible() -> MountedRotor:
    """Return the shaft of Friswell et al., section 5.9, below its whip."""
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    rotor = ShaftRotor(
        elements=ShaftElement(length=1.5, outer_diameter=0.05, material=steel).split(6),
        disks=(Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
        stations=(Station(node=0, name="left"), Station(node=6, name="right")),
        unbalances=(Unbalance(node=2, unbalance=2e-3),),
        internal_damping=2e-6,
        beam=ClassicalBeam(),
        speed=1800.0 * math.pi / 30.0,
    )
    return mount(rotor, {"left": FILM, "right": FILM})


def positions(mounted: MountedRotor, run: object) -> np.ndarray:
    """Return x, y of each journal, shape (n_bearings, 2, n) [m]."""
    prefixes = [f"{name}_" if name else "" for name in mounted.stations]
    return np.stack([np.stack([run[p + "x"], run[p + "y"]]) for p in prefixes])


def run_until(mounted: MountedRotor, target: float) -> tuple[float, int, int]:
    """Return time [s], turns and film calls of a run whose last turn is as near to the orbit as asked for."""
    exact = periodic_orbit(mounted, tolerance=1e-11)
    state = np.zeros(len(mounted.states))
    turns = 16
    while True:
        duration = turns * exact.period
        last = duration - exact.period * np.linspace(1.0, 0.0, 33)
        begin = process_time()
        run = simulate_rotor(mounted, duration=duration, times=last, initial_state=state, rtol=0.3 * target)
        cost = process_time() - begin
        error = np.abs(positions(mounted, run) - exact.position(last)).max() / FILM.clearance
        if error <= target or turns >= MOST_TURNS:
            return cost, turns, run.work["film_evaluations"] * len(mounted.stations)
        turns = math.ceil(1.19 * turns)


def scipy_cost(mounted: MountedRotor, turns: int, target: float) -> float:
    """Return the time [s] of as many turns by scipy at an error of at most the target."""
    exact = periodic_orbit(mounted, tolerance=1e-11)
    duration = turns * exact.period
    last = duration - exact.period * np.linspace(1.0, 0.0, 33)
    derivative, jacobian = scipy_problem(mounted, exact.speed)
    rows = (
        journal_rows(mounted)[0].reshape(-1, 4, len(mounted.states))[:, :2].reshape(-1, len(mounted.states))
    )
    scale = np.array([signal.nominal for signal in mounted.states])
    best = math.inf
    for method in ("Radau", "LSODA"):
        for rtol in target * np.array([10.0, 1.0, 0.1, 0.01]):
            begin = process_time()
            run = solve_ivp(
                derivative,
                (0.0, duration),
                np.zeros(len(scale)),
                method=method,
                jac=jacobian,
                t_eval=last,
                rtol=rtol,
                atol=rtol * scale,
            )
            cost = process_time() - begin
            position = (rows @ run.y).reshape(exact.series.shape[0], 2, -1)
            if np.abs(position - exact.position(last)).max() <= 1.2 * target * FILM.clearance:
                best = min(best, cost)
                break
            if cost > 40.0:
                break
    return best


def orbit_cost(mounted: MountedRotor, target: float) -> tuple[float, int, float]:
    """Return time [s], film calls and error of the orbit alone."""
    exact = periodic_orbit(mounted, tolerance=1e-11)
    times = exact.period * np.linspace(0.0, 1.0, 33)
    best = math.inf
    for _ in range(5):
        begin = process_time()
        orbit = periodic_orbit(mounted, tolerance=target, stability=False)
        best = min(best, process_time() - begin)
    error = np.abs(orbit.position(times) - exact.position(times)).max() / FILM.clearance
    return best, orbit.work["film_evaluations"], float(error)


def main() -> None:
    rows, labels = [], []
    print(
        "| rotor | error | orbit [ms] | film calls | run [ms] | turns | film calls | run / orbit: time, "
        "calls | scipy [ms] | scipy / orbit |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name, mounted in (
        ("rigid, 0.7 of threshold", rigid(0.7)),
        ("rigid, 0.98 of threshold", rigid(0.98)),
        ("flexible, 28 dof", flexible()),
    ):
        orbit = periodic_orbit(mounted)
        for target in TARGETS:
            own, calls, error = orbit_cost(mounted, target)
            cost, turns, run_calls = run_until(mounted, target)
            users = scipy_cost(mounted, turns, target) if target == TARGETS[0] else math.nan
            print(
                f"| {name} | {target:g} ({error:.0e}) | {1e3 * own:.2f} | {calls} | {1e3 * cost:.1f} "
                f"| {turns} | {run_calls} | {cost / own:.0f}, {run_calls / calls:.0f} "
                f"| {1e3 * users:.0f} | {users / own:.0f} |"
            )
            rows.append((own, cost, users))
            labels.append(f"{name}\nerror {target:g}".replace(", ", "\n"))
        print(f"  largest multiplier {abs(orbit.multipliers[0]):.4f}, amplitude {orbit.amplitude:.3f}")
    if len(sys.argv) > 1:
        chart(rows, labels, Path(sys.argv[1]))


def chart(rows: list[tuple[float, float]], labels: list[str], path: Path) -> None:
    """Save the costs as bars."""
    figure = Figure(figsize=(9.0, 4.0), layout="constrained")
    axes = figure.subplots()
    at = np.arange(len(rows))
    for offset, k, label in (
        (-0.25, 0, "periodic_orbit"),
        (0.0, 1, "simulate_rotor to steady state"),
        (0.25, 2, "scipy to steady state"),
    ):
        axes.bar(at + offset, [1e3 * row[k] for row in rows], 0.25, label=label)
    axes.set_yscale("log")
    axes.set_xticks(at, labels, fontsize=8)
    axes.set_ylabel("processor time [ms]")
    axes.legend()
    figure.savefig(path, dpi=150)


if __name__ == "__main__":
    main()
