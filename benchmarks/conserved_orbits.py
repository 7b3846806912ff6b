"""Rotors on the film that conserves its oil, in time: orbits beside Reynolds rupture, order, cost.

    python benchmarks/conserved_orbits.py

1 Unbalance orbits of a rigid rotor, 72 x 8 cells, 384 steps a turn, the last of eight (and by how much it
  differs from the one before), nothing but the film changed: largest eccentricity ratio, half widths of the
  orbit along x and y, peak force; then Reynolds rupture less that.
2 A run of one turn in 96, 192, 384 steps against 768: position over clearance, and the order.
3 Schemes of co-simulation on the same rotor, in inner steps of a turn/768: largest error of the position over
  the clearance against 256 macro steps a turn.
4 Work: solutions a step, and CPU time over that of Reynolds rupture with the same steps.
"""

from __future__ import annotations

import time
import warnings
from dataclasses import replace

import numpy as np

from rotorfilm import (
    Groove,
    JFOFilm,
    JournalBearing,
    ReynoldsFilm,
    RigidRotor,
    SIExp3,
    Trajectory,
    cosimulate,
    equilibrium,
    simulate,
)
from rotorfilm.bearings.films import mass_conserving_steps as stepped_film
from rotorfilm.cosim import SIExp, SIMemory

RADIUS, CLEARANCE, VISCOSITY, SPEED = 0.05, 1e-4, 0.02, 314.0
TURN, TURNS, STEPS = 2.0 * np.pi / SPEED, 8, 384
SMALL = (72, 8)


def bearing(*centers: float) -> JournalBearing:
    """Return a bearing, L/D .5, fed at 2 bar by grooves of 20 deg and .8 of its length."""
    grooves = tuple(Groove(center=center, width=np.radians(20.0), length=0.04) for center in centers)
    return JournalBearing(
        radius=RADIUS,
        length=0.05,
        clearance=CLEARANCE,
        viscosity=VISCOSITY,
        film=ReynoldsFilm(cells=SMALL),
        grooves=grooves,
        supply_pressure=2e5,
    )


CASES = [
    ("two grooves, So .30", bearing(0.0, np.pi), 0.30, 0.12),
    ("two grooves, So .30", bearing(0.0, np.pi), 0.30, 0.25),
    ("groove on top, So .50", bearing(0.5 * np.pi), 0.50, 0.20),
]
"""Bearing, load, and unbalance over mass times clearance; the mass is load/(clearance speed^2)."""


def rotor_of(film: JFOFilm, So: float, unbalance: float) -> RigidRotor:
    """Return the rotor, at rest where the film carries its load."""
    load = 2.0 * So * SPEED * film.bearing.force_scale
    mass = load / (CLEARANCE * SPEED**2)
    place = equilibrium(film, [0.0, -load], SPEED).position
    return RigidRotor(
        mass=mass,
        speed=SPEED,
        unbalance=unbalance * mass * CLEARANCE,
        gravity=(0.0, 0.0),
        static_force=(0.0, -load),
        position=tuple(place),
    )


def measured(run: Trajectory) -> np.ndarray:
    """Return emax, both half widths and the peak force of the last turn, and of the one before."""
    rows = []
    for part in (slice(-STEPS - 1, None), slice(-2 * STEPS - 1, -STEPS)):
        x, y = run.position[:, part] / CLEARANCE
        force = np.hypot(run["force_x"][part], run["force_y"][part])
        rows.append([np.hypot(x, y).max(), 0.5 * np.ptp(x), 0.5 * np.ptp(y), force.max()])
    return np.array(rows)


def orbits() -> None:
    """Print orbits by both films."""
    print("| rotor | eps max | half widths x, y [c] | peak force [N] | last turn | CPU |")
    print("|---|---|---|---|---|---|")
    for name, own, So, unbalance in CASES:
        film = JFOFilm(bearing=own, cells=SMALL)
        rotor = rotor_of(film, So, unbalance)
        given = {"duration": TURNS * TURN, "samples": TURNS * STEPS + 1, "max_step": TURN / STEPS}
        begin = time.process_time()
        run = simulate(rotor, film, **given)
        middle = time.process_time()
        other = simulate(rotor, own, **given)
        end = time.process_time()
        rows, reynolds = measured(run), measured(other)[0]
        settled = np.abs(rows[0] / rows[1] - 1.0).max()
        off = 100.0 * (reynolds / rows[0] - 1.0)
        work = run.work
        print(
            f"| {name}, {unbalance} | {rows[0, 0]:.4f} | {rows[0, 1]:.4f}, {rows[0, 2]:.4f} "
            f"| {rows[0, 3]:.0f} | {settled:.0e} "
            f"| {work['film_solutions'] / work['steps']:.1f} solutions a step |"
        )
        print(
            f"| Reynolds less that | {off[0]:+.1f} % | {off[1]:+.1f}, {off[2]:+.1f} % | {off[3]:+.1f} % | "
            f"| time {(middle - begin) / (end - middle):.1f} of it |"
        )


def orders() -> None:
    """Print the error of one turn by its steps."""
    film = JFOFilm(bearing=bearing(0.5 * np.pi), cells=SMALL)
    rotor, times = rotor_of(film, 0.5, 0.2), np.linspace(0.0, TURN, 25)
    runs = [simulate(rotor, film, duration=TURN, times=times, max_step=TURN / n) for n in (96, 192, 384, 768)]
    errors = [np.abs(run.position - runs[-1].position).max() / CLEARANCE for run in runs[:-1]]
    # Against the fourth run errors of second order are as 64 - 1 to 16 - 1.
    first = np.log2(4.0 * errors[0] / errors[1] * 15.0 / 63.0)
    print("\nsteps 96, 192, 384 a turn: " + ", ".join(f"{e:.1e}" for e in errors) + f"; order {first:.2f}")


def schemes() -> None:
    """Print errors of schemes by macro step."""
    film = JFOFilm(bearing=bearing(0.5 * np.pi), cells=(36, 4))
    rotor = replace(rotor_of(film, 0.5, 0.15), mass=250.0)

    def run(scheme: object, n: int) -> np.ndarray:
        found = cosimulate(rotor, film, macro_step=TURN / n, duration=TURN, scheme=scheme).trajectory
        at = np.searchsorted(found.time, TURN * np.arange(9, 17) / 16 - 1e-9)
        return found.position[:, at]

    stepped_film.LARGEST_ANGLE, stepped_film.LARGEST_WAY = 2.0 * np.pi / 768 * (1.0 + 1e-9), 9.0
    reference = run(SIMemory(), 256)
    print("\nmacro steps a turn: 16, 32, 64, 128")
    for scheme in (SIMemory(), SIExp3(), SIExp()):
        errors = [np.abs(run(scheme, n) - reference).max() / CLEARANCE for n in (16, 32, 64, 128)]
        print(f"{scheme.label:10}: " + ", ".join(f"{e:.1e}" for e in errors))


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    orbits()
    orders()
    schemes()
