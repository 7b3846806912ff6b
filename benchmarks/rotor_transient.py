"""Transient of a flexible rotor with 66 degrees of freedom on two maps: compiled integration beside scipy.

A blade is lost at t = 0: the rotor rests in its films and its unbalance begins to act. Error: largest
distance of a journal from the converged motion over 20 turns, in clearances; reference: `simulate_rotor` at
rtol 1e-12, which scipy's Radau at its tightest confirms. The right-hand side for scipy is what a competent
user writes: one matrix product, the unbalance, the C force of each film called with numbers; with the exact
Jacobian. Ratios are taken at equal error, by interpolation of the work-precision line of each method. ROSS's
Newmark method, where installed, has the same matrices and runs over 2 turns. Times are of the processor.

    python benchmarks/rotor_transient.py [CHART.png]
"""

from __future__ import annotations

import inspect
import math
import sys
from collections.abc import Callable
from pathlib import Path
from time import process_time
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure
from scipy.integrate import solve_ivp

from rotorfilm import (
    ClassicalBeam,
    Disk,
    ElasticMaterial,
    JournalBearing,
    RotorfilmError,
    ShaftElement,
    ShaftRotor,
    Station,
    Unbalance,
    mount,
    rotor_equilibrium,
    simulate_rotor,
)
from rotorfilm.rotors import MountedRotor, Support

SPEED, TURNS, SAMPLES = 1500.0 * math.pi / 30.0, 20, 401
TARGETS = (1e-3, 1e-4, 1e-5, 1e-6)
FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)


class Line(NamedTuple):
    """Error and time of a method over its tolerances."""

    name: str
    errors: list[float]
    times: list[float]


def rotor() -> ShaftRotor:
    """Return the shaft of Friswell et al., section 5.9, in 15 elements, one housing on an elastic support."""
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    support = Support(mass=10.0, stiffness=((5e8, 0.0), (0.0, 5e8)), damping=5e3)
    return ShaftRotor(
        elements=ShaftElement(length=1.5, outer_diameter=0.05, material=steel).split(15),
        disks=(Disk.solid(5, outer_diameter=0.28, **disk), Disk.solid(10, outer_diameter=0.35, **disk)),
        stations=(Station(node=0, name="left", support=support), Station(node=15, name="right")),
        unbalances=(Unbalance(node=5, unbalance=8e-3),),
        internal_damping=2e-6,
        beam=ClassicalBeam(),
        speed=SPEED,
    )


def journal_rows(mounted: MountedRotor) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return rows of the journals' motion, the rotor's own matrix and the push of the films' forces."""
    rotor = mounted.rotor
    A, push, sense, _ = rotor.linearization(0.0, rotor.initial_state, np.zeros(len(rotor.inputs)))
    return sense[: 4 * len(mounted.stations)], A, push


def scipy_problem(mounted: MountedRotor, speed: float) -> tuple[Callable, Callable]:
    """Return right-hand side and Jacobian as a competent user writes them."""
    motion, A, push = journal_rows(mounted)
    still, none = np.zeros(len(A)), np.zeros(push.shape[1])
    quarters = [mounted.rotor.derivative(k * math.pi / (2.0 * speed), still, none) for k in range(4)]
    weight = 0.5 * (quarters[0] + quarters[2])
    cosine, sine = quarters[0] - weight, quarters[1] - weight
    calls = [bearing.prepare() for bearing in mounted.bearings]
    tangents = [bearing.prepare_tangent() for bearing in mounted.bearings]

    def derivative(t: float, x: np.ndarray) -> np.ndarray:
        at = (motion @ x).tolist()
        force = [f for k, call in enumerate(calls) for f in call(*at[4 * k : 4 * k + 4], speed)]
        angle = speed * t
        return A @ x + push @ force + (weight + math.cos(angle) * cosine + math.sin(angle) * sine)

    def jacobian(t: float, x: np.ndarray) -> np.ndarray:
        at = (motion @ x).tolist()
        total = A.copy()
        for k, tangent in enumerate(tangents):
            slopes = np.reshape(tangent(*at[4 * k : 4 * k + 4], speed)[2], (2, 5))[:, :4]
            total += push[:, 2 * k : 2 * k + 2] @ (slopes @ motion[4 * k : 4 * k + 4])
        return total

    return derivative, jacobian


def journals(run: dict[str, np.ndarray]) -> np.ndarray:
    """Return x, y of both journals, shape (4, n) [m]."""
    return np.stack([run[f"{name}_{axis}"] for name in ("left", "right") for axis in "xy"])


def own_line(mounted: MountedRotor, start: np.ndarray, times: np.ndarray, exact: np.ndarray) -> Line:
    """Return the line of `simulate_rotor`."""
    errors, costs = [], []
    for rtol in 10.0 ** np.arange(-2.0, -9.0, -1.0):
        best = math.inf
        for _ in range(3):
            begin = process_time()
            run = simulate_rotor(
                mounted,
                duration=times[-1],
                times=times,
                initial_state=start,
                rtol=float(rtol),
                condensation=0.0,
            )
            best = min(best, process_time() - begin)
        errors.append(float(np.abs(journals(run.signals) - exact).max()) / FILM.clearance)
        costs.append(best)
        print(f"  simulate_rotor rtol {rtol:7.0e}: error {errors[-1]:.1e}, {best:8.4f} s, {run.work}")
    return Line("simulate_rotor", errors, costs)


def scipy_line(
    name: str, mounted: MountedRotor, start: np.ndarray, times: np.ndarray, exact: np.ndarray
) -> Line:
    """Return the line of one of scipy's methods."""
    derivative, jacobian = scipy_problem(mounted, SPEED)
    sense = journal_rows(mounted)[0][[0, 1, 4, 5]]
    scale = np.array([signal.nominal for signal in mounted.states])
    errors, costs = [], []
    for rtol in 10.0 ** np.arange(-2.0, -7.0, -1.0):
        begin = process_time()
        run = solve_ivp(
            derivative,
            (0.0, times[-1]),
            start,
            method=name,
            jac=jacobian,
            t_eval=times,
            rtol=float(rtol),
            atol=rtol * scale,
        )
        costs.append(process_time() - begin)
        if not run.success:
            costs.pop()
            continue
        errors.append(float(np.abs(sense @ run.y - exact).max()) / FILM.clearance)
        print(f"  {name:6s} rtol {rtol:7.0e}: error {errors[-1]:.1e}, {costs[-1]:8.3f} s, {run.nfev} calls")
        if costs[-1] > 15.0:
            break
    return Line(f"scipy {name}", errors, costs)


def ross_line(mounted: MountedRotor, rest: np.ndarray, times: np.ndarray, exact: np.ndarray) -> Line | None:
    """Return the line of ROSS's Newmark method on the same matrices; None where ROSS is not installed.

    It takes the film forces of the last step, as ROSS does with `add_to_RHS`, and starts from zero: so
    displacements are counted from the rest. Over 2 turns, for it needs very short steps.
    """
    try:
        from ross.utils import newmark
    except ImportError:
        print("  ROSS: not installed")
        return None
    if "rhs_func" in inspect.signature(newmark).parameters:
        print("  ROSS: from 3.1 on its Newmark method takes other functions than those below")
        return None
    s, size = mounted.rotor.structure, len(rest)
    damping = s.damping + SPEED * s.gyroscopic
    stiffness = s.stiffness + SPEED * s.circulation
    calls = [bearing.prepare() for bearing in mounted.bearings]
    held = s.journals @ rest
    errors, costs = [], []
    turns = 2
    kept = turns * (len(times) - 1) // TURNS + 1
    for parts in (20480, 40960, 81920, 163840):
        count = parts * turns
        grid = np.linspace(0.0, times[kept - 1], count + 1)
        balance = stiffness @ rest - s.weight

        def matrices(step, dt, y, ydot, y2dot, grid=grid, balance=balance):
            p, v = (held + s.journals @ y).tolist(), (s.journals @ ydot).tolist()
            force = [*calls[0](*p[:2], *v[:2], SPEED), *calls[1](*p[2:], *v[2:], SPEED)]
            angle = SPEED * grid[step]
            pull = SPEED**2 * np.array([math.cos(angle), math.sin(angle)])
            return s.mass, damping, stiffness, s.journals.T @ force - balance + s.unbalance @ pull

        begin = process_time()
        try:
            found = newmark(matrices, grid, size)
        except RotorfilmError as failure:
            print(f"  ROSS Newmark {parts} steps a turn: {failure}")
            continue
        costs.append(process_time() - begin)
        at = np.arange(kept) * (count // (kept - 1))
        motion = held[:, None] + s.journals @ found[at].T
        errors.append(float(np.abs(motion - exact[:, :kept]).max()) / FILM.clearance)
        print(f"  ROSS Newmark {parts} steps a turn: error {errors[-1]:.1e}, {costs[-1]:8.1f} s")
        if costs[-1] > 40.0:
            break
    return Line("ROSS Newmark", errors, costs) if errors else None


def time_at(line: Line, error: float) -> float:
    """Return the time of a method at an error, nan where its line does not reach it."""
    order = np.argsort(line.errors)
    errors, times = np.log(np.array(line.errors)[order]), np.log(np.array(line.times)[order])
    if math.log(error) < errors[0]:
        return math.nan
    # The cheapest that is at least as good.
    return float(
        min(np.exp(np.interp(math.log(error), errors, times)), np.exp(times[errors <= math.log(error)]).min())
    )


def chart(lines: list[Line], path: Path) -> None:
    """Save the work-precision lines."""
    figure = Figure(figsize=(8.6, 4.5), layout="constrained")
    axes = figure.subplots()
    for line, marker in zip(lines, "osv^D", strict=False):
        axes.loglog(line.times, line.errors, marker=marker, label=line.name)
    axes.set(
        xlabel="processor time [s]",
        ylabel="largest journal error / clearance",
        title="66 degrees of freedom on two maps, 20 turns after the loss of a blade",
    )
    axes.grid(True, alpha=0.3)
    axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))
    figure.savefig(path, dpi=150)


def main() -> None:
    shaft = rotor()
    films = {"left": FILM, "right": FILM}
    mounted = mount(shaft, films)
    size = len(shaft.structure.weight)
    print(f"{size} degrees of freedom, {len(mounted.states)} states, {TURNS} turns at 1500 rpm")
    rest = rotor_equilibrium(shaft, films, SPEED)
    start = np.concatenate([rest.displacement, np.zeros(size)])
    duration = TURNS * 2.0 * math.pi / SPEED
    times = np.linspace(0.0, duration, SAMPLES)
    begin = process_time()
    simulate_rotor(mounted, duration=0.01 * duration, initial_state=start)
    print(f"first call, compiled or read from the cache: {process_time() - begin:.1f} s")
    reference = simulate_rotor(
        mounted, duration=duration, times=times, initial_state=start, rtol=1e-12, condensation=0.0
    )
    exact = journals(reference.signals)
    print(f"orbit of {np.abs(exact - exact[:, :1]).max() / FILM.clearance:.2f} clearances")
    own = own_line(mounted, start, times, exact)
    others = [scipy_line(name, mounted, start, times, exact) for name in ("Radau", "BDF", "LSODA")]
    extra = ross_line(mounted, rest.displacement, times, exact)
    if extra is not None:
        short = times[: 2 * (SAMPLES - 1) // TURNS + 1]
        mine = own_line(mounted, start, short, exact[:, : len(short)])
        for error, cost in zip(extra.errors, extra.times, strict=True):
            print(f"  ROSS / own over 2 turns at error {error:.1e}: {cost / time_at(mine, error):.0f}")
    print(
        "\n| error / clearance | simulate_rotor [ms] | "
        + " | ".join(o.name for o in others)
        + " | best of scipy / own |"
    )
    print("|---|---|" + "---|" * (len(others) + 1))
    for target in TARGETS:
        mine, theirs = time_at(own, target), [time_at(other, target) for other in others]
        ratio = np.nanmin(theirs) / mine if np.any(np.isfinite(theirs)) else math.nan
        cells = " | ".join(f"{1e3 * t:.0f}" for t in theirs)
        print(f"| {target:g} | {1e3 * mine:.1f} | {cells} | {ratio:.0f} |")
    if len(sys.argv) > 1:
        chart([own, *others], Path(sys.argv[1]))


if __name__ == "__main__":
    main()
