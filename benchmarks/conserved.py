"""The film that conserves its oil: bearings with real supply, its two searches, and its cost.

    python benchmarks/conserved.py

1 Nine bearings at given load by JFOFilm on 144 x 10 cells: eccentricity ratio, attitude angle, side flow over
  clearance radius length speed, torque, stiffness and damping at half the speed over load/clearance. Below
  each, by how much Reynolds rupture with the same openings differs. Then their critical masses over
  load/(clearance speed^2) by K(s), with the whirl ratio and how many exponents grow below and above, beside
  that of the notes, from another code; by K(0) and its slope; and of Reynolds rupture.
2 200 random bearings on 144 x 10 cells by the active set and by Newton's method: largest difference of
  pressure over the largest, of the oil content, the balance of mass over the side flow, and the solutions.
3 CPU time of a state over that of ReynoldsFilm with the same openings on 144 x 12 cells, of stiffness and
  damping, and of an equilibrium.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rotorfilm import (
    FeedHole,
    Groove,
    JFOFilm,
    JournalBearing,
    ReynoldsFilm,
    coefficients,
    critical_mass,
    equilibrium,
)

RADIUS, CLEARANCE, VISCOSITY, SPEED = 0.05, 1e-4, 0.02, 314.0
BAR = 0.0053 * SPEED * 12.0 * VISCOSITY * (RADIUS / CLEARANCE) ** 2
UP = np.pi / 2.0


def grooves(length: float, *centers: float) -> tuple[Groove, ...]:
    """Return grooves of 20 deg and .8 of a length."""
    return tuple(Groove(center=center, width=np.radians(20.0), length=0.8 * length) for center in centers)


def case(slenderness: float, pressure: float, *centers: float, hole: bool = False) -> JournalBearing:
    """Return a bearing with grooves at some angles, or a hole of 15 deg x .2 of the length on top."""
    length = 2.0 * slenderness * RADIUS
    square = np.sqrt(np.radians(15.0) * RADIUS * 0.2 * length)
    given = (
        (FeedHole(center=UP, diameter=square / (0.5 * np.sqrt(np.pi))),)
        if hole
        else grooves(length, *centers)
    )
    return JournalBearing(
        radius=RADIUS,
        length=length,
        clearance=CLEARANCE,
        viscosity=VISCOSITY,
        film=ReynoldsFilm(cells=(144, 12)),
        grooves=given,
        supply_pressure=pressure * BAR,
    )


STARVED = 0.855 / 4.0
CASES: list[tuple[str, JournalBearing, float, float | None]] = [
    ("1 two grooves, L/D .5, So .30, 0 bar", case(0.5, 0.0, 0.0, np.pi), 0.30, None),
    ("2 two grooves, L/D .5, So .30, 2 bar", case(0.5, 2.0, 0.0, np.pi), 0.30, None),
    ("3 top groove, L/D .5, So .50, 2 bar", case(0.5, 2.0, UP), 0.50, None),
    ("4 top groove, L/D 1, So 3.5, 2 bar", case(1.0, 2.0, UP), 3.5, None),
    ("5 two grooves, L/D 1, So .20, 2 bar", case(1.0, 2.0, 0.0, np.pi), 0.20, None),
    ("6 hole on top, L/D .5, So .50, 2 bar", case(0.5, 2.0, hole=True), 0.50, None),
    ("7 top groove, a quarter of the flow of 3", case(0.5, 0.0, UP), 0.50, STARVED),
    ("8 top groove, L/D .5, So .50, 0 bar", case(0.5, 0.0, UP), 0.50, None),
    ("9 two grooves, L/D .5, So .30, 10 bar", case(0.5, 10.0, 0.0, np.pi), 0.30, None),
]


def film_of(bearing: JournalBearing, flow: float | None) -> JFOFilm:
    """Return the film of a bearing, with a flow over clearance radius length speed or its pressure."""
    unit = CLEARANCE * RADIUS * bearing.length * SPEED
    return JFOFilm(bearing=bearing, supply_flow=None if flow is None else flow * unit)


def table() -> None:
    """Print the nine bearings."""
    print("| bearing | eps | attitude [deg] | side flow | torque | K xx xy yx yy | C xx xy yx yy |")
    print("|---|---|---|---|---|---|---|")
    for name, bearing, So, flow in CASES:
        film, load = film_of(bearing, flow), 2.0 * So * SPEED * bearing.force_scale
        at = equilibrium(film, [0.0, -load], SPEED)
        state = film.solve(at.position, SPEED)
        side = state.side_flow / (CLEARANCE * RADIUS * bearing.length * SPEED)
        torque = state.friction_torque / (bearing.force_scale * CLEARANCE * SPEED)
        KC = coefficients(film, at.position, SPEED, frequency=0.5 * SPEED)
        K, C = KC.stiffness * CLEARANCE / load, KC.damping * CLEARANCE * SPEED / load
        print(
            f"| {name} | {at.eccentricity_ratio:.4f} | {np.degrees(at.attitude_angle):.2f} | {side:.4f} "
            f"| {torque:.3f} | {digits(K)} | {digits(C)} |"
        )
        other = equilibrium(bearing, [0.0, -load], SPEED)
        losses = other.losses
        assert losses is not None
        lund = coefficients(bearing, other.position, SPEED)
        off = [
            np.abs(one - two).max() / np.abs(two).max()
            for one, two in ((lund.stiffness, KC.stiffness), (lund.damping, KC.damping))
        ]
        print(
            f"| Reynolds less that | {100 * (other.eccentricity_ratio / at.eccentricity_ratio - 1):+.1f} % "
            f"| {np.degrees(other.attitude_angle - at.attitude_angle):+.1f} "
            f"| {100 * (float(losses.side_flow) / state.side_flow - 1):+.0f} % "
            f"| {100 * (float(losses.friction_torque) / state.friction_torque - 1):+.0f} % "
            f"| {100 * off[0]:.0f} % | {100 * off[1]:.0f} % |"
        )


NOTED = (5.28, 4.66, 7.91, None, 3.27, 5.53, 4.49, 6.08, 3.81, 2.31)
"""Critical masses of another code; in case 7 with the oil content of the groove held, not its flow."""

CROSSED = ("10 grooves at 45 and 225 deg, So .25, 2 bar", case(0.5, 2.0, UP / 2.0, 2.5 * UP), 0.25, None)


def masses() -> None:
    """Print the critical masses of the bearings."""
    print("\n| bearing | mass by K(s) | notes | error | whirl ratio | growing | slow motion | Reynolds |")
    print("|---|---|---|---|---|---|---|---|")
    for (name, bearing, So, flow), noted in zip([*CASES, CROSSED], NOTED, strict=True):
        film, load = film_of(bearing, flow), 2.0 * So * SPEED * bearing.force_scale
        unit = load / CLEARANCE / SPEED**2
        at, other = (equilibrium(one, [0.0, -load], SPEED) for one in (film, bearing))
        found = critical_mass(coefficients(film, at.position, SPEED))
        slow = critical_mass(film.slow_coefficients(at.position, SPEED))
        lund = critical_mass(coefficients(bearing, other.position, SPEED))
        own, still, reynolds = (None if one.mass is None else one.mass / unit for one in (found, slow, lund))
        error = "" if own is None or noted is None else f"{100.0 * (own / noted - 1.0):+.1f} %"
        print(
            f"| {name} | {mass_text(own)} | {mass_text(noted)} | {error} | {found.whirl_ratio or 0.0:.3f} "
            f"| {found.growing_below} to {found.growing_above} | {mass_text(still)} | {mass_text(reynolds)} |"
        )


def mass_text(mass: float | None) -> str:
    """Return a critical mass, or that there is none."""
    return "none" if mass is None else f"{mass:.2f}"


def digits(matrix: np.ndarray) -> str:
    """Return four numbers."""
    return " ".join(f"{number:.3f}" for number in matrix.ravel())


def random_film(seed: int) -> tuple[JFOFilm, np.ndarray]:
    """Return some bearing and a place in it."""
    rng = np.random.default_rng(seed)
    count, slenderness = int(rng.integers(1, 4)), 10.0 ** rng.uniform(-0.9, 0.3)
    length = 2.0 * slenderness * RADIUS
    middles = 2.0 * np.pi * (np.arange(count) + 0.4 * rng.random(count)) / count
    openings = tuple(
        Groove(center=angle, width=rng.uniform(0.0, 0.6), length=rng.uniform(0.1, 0.9) * length)
        for angle in middles.tolist()
    )
    bearing = replace(case(slenderness, 0.0), grooves=openings, supply_pressure=10.0 ** rng.uniform(3.5, 6.5))
    eps, angle = rng.uniform(0.0, 0.97), rng.uniform(0.0, 2.0 * np.pi)
    return JFOFilm(bearing=bearing), eps * np.array([np.cos(angle), np.sin(angle)])


def searches() -> None:
    """Compare the active set with Newton's method, and print how well oil is conserved."""
    worst, solutions = np.zeros(3), []
    for seed in range(200):
        film, e = random_film(seed)
        gap = film.film.gap(e)
        one, other = (film.film.solve(gap, 0.5 * SPEED, by_newton=newton) for newton in (False, True))
        flows = film.film.flows(one)
        P = one.solution.pressure
        found = (
            np.abs(P - other.solution.pressure).max() / P.max(),
            np.abs(one.solution.theta - other.solution.theta).max(),
            abs(flows.inflow.sum() + flows.drawn_in - flows.out) / flows.out,
        )
        worst = np.maximum(worst, found)
        solutions.append((one.solution.solutions, one.solution.newton, other.solution.newton))
    print("\n200 random bearings: largest difference of pressure, oil content; mass out of balance")
    print("  ".join(f"{value:.1e}" for value in worst))
    names = "sets, on the finest cells", "Newton where sets fail", "Newton"
    for name, counts in zip(names, np.array(solutions).T, strict=True):
        print(f"solutions by {name}: median {np.median(counts):.0f}, most {counts.max()}")


def cpu(call: Callable[[], object], repeats: int = 30) -> float:
    """Return the least CPU time of a call [ms]."""
    times = []
    for _ in range(repeats):
        start = time.process_time()
        call()
        times.append(time.process_time() - start)
    return 1e3 * min(times)


def costs() -> None:
    """Print CPU times, and their ratio to those of Reynolds rupture."""
    print("\nCPU times of a state, 144 x 12 cells")
    for name, bearing, So, flow in CASES:
        film = replace(film_of(bearing, flow), cells=(144, 12))
        load = [0.0, -2.0 * So * SPEED * bearing.force_scale]
        q = equilibrium(film, load, SPEED).position
        conserved = cpu(lambda q=q, film=film: film.force(q, [0.0, 0.0], SPEED))
        reynolds = cpu(lambda q=q, bearing=bearing: bearing.force(q, [0.0, 0.0], SPEED))
        motion = cpu(lambda q=q, film=film: film.complex_stiffness(q, SPEED, 0.5j * SPEED)) - conserved
        whole = cpu(lambda film=film, load=load: equilibrium(film, load, SPEED), 3)
        print(
            f"{name:42}: {conserved:.2f} ms, {conserved / reynolds:.2f} of Reynolds; "
            f"K(s) {motion:.2f} ms more; equilibrium {whole:.1f} ms"
        )


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    table()
    masses()
    searches()
    costs()
