"""The point contact: cost against dense Newton, limits of grid and rectangle, decay, reduced law, failures.

    python benchmarks/contact.py [cost] [growth] [grid] [decay] [law] [hard]

`cost`: time of a step of case 4.1 (W = 1, BDF2, dt = 0.1, t = 1 to 2) by the product, and by the best that
numpy and scipy offer without its structure: the same Newton steps with a dense matrix, the elastic kernel
tabulated beforehand, y-symmetry used, LAPACK. Both in one run, to the same tolerance. `growth`: work and time
of a stationary contact and of such a step from 64 to 256 cells a side, and beside them what they were when
sparse factors alone were the preconditioner and the film's end moved by a ring of cells a step. `grid`:
stationary solution on ever finer grids and larger rectangles. `decay`: decay time of case 4.1 in three
independent ways. `law`: the reduced law beside the full model. `hard`: thin
films and a load step. All of it takes some ten minutes on one core.
"""

from __future__ import annotations

import sys
from itertools import pairwise
from time import perf_counter, process_time

import numpy as np
from scipy import linalg

from rotorfilm import ContactGrid, ConvergenceError, PointContact, reduce_contact
from rotorfilm.bearings import (
    HERTZ_LOAD,
    AdaptiveSteps,
    FixedSteps,
    SineLoad,
    SmallMotion,
    StaggeredScheme,
    StepLoad,
    UpwindScheme,
    ball_transient,
    perturbed,
)
from rotorfilm.bearings.contact import contact_steps
from rotorfilm.bearings.contact.film_newton import NewtonKrylov
from rotorfilm.bearings.contact.stationary import stationary
from rotorfilm.studies import decay_time


class DenseNewton(NewtonKrylov):
    """The same Newton's method with a dense matrix."""

    def _step(self, linear, residual, miss, forcing):
        if not hasattr(self, "columns"):
            cells = residual.size
            self.columns = np.stack(
                [self.equations.sampling.deflection(row) for row in np.eye(cells)], axis=1
            )
        wet, closure = np.flatnonzero(linear.place.wet), linear.place.closure
        by_pressure, by_film = linear.derivatives
        size = len(wet)
        matrix = np.empty((size + 1, size + 1), order="F")
        matrix[:size, :size] = by_film[wet] @ self.columns[:, wet] + by_pressure[wet][:, wet].toarray()
        matrix[:size, size] = linear.by_delta[wet]
        matrix[size, :size] = closure.load * self.equations.area
        matrix[size, size] = closure.approach
        answer = linalg.solve(matrix, np.append(residual[wet], miss), overwrite_a=True, check_finite=False)
        change = np.zeros_like(residual)
        change[wet] = answer[:size]
        return change, float(answer[size]), 1


def contact(cells, scheme=None, **rectangle):
    grid = ContactGrid(cells=(cells, cells) if isinstance(cells, int) else cells, **rectangle)
    return PointContact(V=0.1, Q0=5.0, grid=grid, scheme=UpwindScheme() if scheme is None else scheme)


def print_cost():
    print("cost of a step of case 4.1, ms; ratio of dense Newton (extrapolated by n^3 where it is not run)")
    print(
        f"{'cells':>7s}{'product':>10s}{'Newton':>8s}{'GMRES':>7s}{'dense':>11s}{'ratio':>8s}{'difference':>12s}"
    )
    dense, product = {}, {}
    for cells in (40, 64, 128, 256):
        c = contact(cells)
        start = c.simulate(
            perturbed(c, c.stationary(), -0.2), duration=1.0, W=1.0, control=FixedSteps(step=0.1)
        ).final
        times, ends, works = {}, {}, {}
        for solver in (NewtonKrylov, DenseNewton) if cells <= 64 else (NewtonKrylov,):
            contact_steps.NewtonKrylov = solver
            c.simulate(start, duration=0.1, W=1.0, control=FixedSteps(step=0.1))
            begin = process_time()
            run = c.simulate(start, duration=1.0, W=1.0, control=FixedSteps(step=0.1))
            times[solver], ends[solver] = (process_time() - begin) / run.work["steps"], run.delta[-1]
            works[solver] = run.work
        contact_steps.NewtonKrylov = NewtonKrylov
        work = works[NewtonKrylov]
        product[cells] = times[NewtonKrylov]
        dense[cells] = times.get(DenseNewton, dense.get(64, 0.0) * (cells / 64) ** 6)
        gap = abs(ends[NewtonKrylov] - ends[DenseNewton]) if DenseNewton in ends else np.nan
        print(
            f"{cells:7d}{1e3 * product[cells]:10.0f}{work['newton'] / 10:8.1f}{work['gmres'] / 10:7.0f}"
            f"{1e3 * dense[cells]:11.0f}{dense[cells] / product[cells]:8.0f}{gap:12.1e}"
        )
    print("growth: " + ", ".join(f"{a} to {b}: {product[b] / product[a]:.1f}" for a, b in pairwise(product)))


def measured(cells, act):
    """Return what an act of a contact gives, and its CPU time without that of the grid's matrices."""
    c = contact(cells)
    c.equations.derivatives(np.ones(c.equations.grid.shape).ravel(), c.equations.sampling.gap + 1.0, 0.0)
    begin = process_time()
    answer = act(c)
    return answer, process_time() - begin


ALONE = {64: (5, 28, 25, 198), 128: (4, 27, 27, 268), 256: (5, 71, 40, 537)}
"""Newton and GMRES steps of a stationary contact and of ten steps in time by sparse factors alone."""


def print_growth():
    print("stationary contact, and ten steps of case 4.1 (t = 1 to 2): Newton, GMRES, CPU s")
    print(f"{'cells':>7s}{'stationary':>20s}{'factors alone':>15s}{'ten steps':>22s}{'factors alone':>15s}")
    rows = {}
    for cells in (64, 128, 256):
        c, control = contact(cells), FixedSteps(step=0.1)
        start = c.simulate(perturbed(c, c.stationary(), -0.2), duration=1.0, W=1.0, control=control).final
        still, rest = measured(cells, lambda c: stationary(c.equations, 1.0))
        work, moving = measured(
            cells,
            lambda c, start=start, control=control: (
                c.simulate(start, duration=1.0, W=1.0, control=control).work
            ),
        )
        rows[cells] = still.iterations, rest, work["gmres"], moving
        before = ALONE[cells]
        print(
            f"{cells:7d}{still.steps:8d}{still.iterations:5d}{rest:7.2f}{before[0]:10d}{before[1]:5d}"
            f"{work['newton']:10d}{work['gmres']:5d}{moving:7.2f}{before[2]:10d}{before[3]:5d}"
        )
    for a, b in pairwise(rows):
        shares = [new / old for old, new in zip(rows[a], rows[b], strict=True)]
        names = ("GMRES", "stationary time", "GMRES of ten steps", "time of ten steps")
        print(f"{a} to {b}: " + ", ".join(f"{n} {s:.2f}" for n, s in zip(names, shares, strict=True)))


def print_grid():
    print("stationary contact on [-2.5, 1.5] x [-2, 2]")
    print(f"{'scheme':>18s}{'cells':>7s}{'delta':>12s}{'H0':>12s}{'order':>8s}{'CPU s':>8s}")
    for scheme in (StaggeredScheme(), UpwindScheme()):
        past = []
        for cells in (32, 64, 128, 256):
            begin = process_time()
            state = contact(cells, scheme).stationary()
            past.append(state.delta)
            order = np.log2((past[-2] - past[-3]) / (past[-1] - past[-2])) if len(past) > 2 else np.nan
            name = type(scheme).__name__
            print(
                f"{name:>18s}{cells:7d}{state.delta:12.6f}{state.central_film:12.6f}{order:8.2f}"
                f"{process_time() - begin:8.1f}"
            )
    print("larger rectangles, upwind, 16 cells per unit; delta errs by some constant / length")
    found = []
    for inlet, outlet, half in ((-2.5, 1.5, 2.0), (-4.5, 1.5, 3.0), (-8.0, 2.0, 5.0), (-16.0, 2.0, 9.0)):
        cells = (round(16 * (outlet - inlet)), round(32 * half))
        state = contact(cells, inlet=inlet, outlet=outlet, half_width=half).stationary()
        found.append((-inlet, state.delta, state.central_film))
        print(f"[{inlet:g}, {outlet:g}] x {half:g}: delta {state.delta:.6f}, H0 {state.central_film:.6f}")
    (a, da, _), (b, db, hb) = found[-2:]
    print(f"delta extrapolated to infinity: {(b * db - a * da) / (b - a):.5f}, H0 {hb:.5f}")


def print_decay():
    print("decay time of case 4.1: time integration, eigenvalue, energy of a given motion")
    for cells in (40, 64):
        c = contact(cells)
        rest = c.stationary()
        small = SmallMotion(c.equations, rest.levels[0].pressure, rest.delta)
        for W in (0.5, 1.0):
            s = small.natural_motion(W, 1j * np.sqrt(1.57 / W))
            pushed = c.state(rest.pressure, rest.delta, velocity=0.05)
            control = AdaptiveSteps(tolerance=5e-6, largest=0.05)
            run = c.simulate(pushed, duration=26.0, W=W, control=control)
            period = 2.0 * np.pi / s.imag
            given = c.drive(
                rest,
                duration=3.0 * period,
                approach=lambda t, s=s, rest=rest: rest.delta + 0.08 * np.sin(s.imag * t),
                control=FixedSteps(step=period / 120),
            )
            last = given.time > 2.0 * period - 1e-9
            lost = -np.trapezoid(HERTZ_LOAD * given.carried_load[last], given.delta[last])
            energy = 2.0 * W * np.pi * s.imag * 0.08**2 / lost
            print(
                f"{cells} cells, W = {W}: {decay_time(run, rest.delta, 6.0):.2f}, {-1.0 / s.real:.2f}, "
                f"{energy:.2f}; "
                f"Euler at dt = 0.2: {0.2 / np.log(abs(1.0 - 0.2 * s)):.2f}"
            )


def print_law():
    c = contact(40)
    rest = c.stationary()
    for order in (2, 3, 5, 8):
        law = reduce_contact(c, order)
        print(f"order {order}: static law {law.static_error:.2%}, damping {law.damping_error:.2%}")
    law = reduce_contact(c, 5)
    print(f"{'case':>36s}{'rms error':>11s}{'full s':>9s}{'law s':>9s}{'ratio':>8s}")
    cases = (
        ("W = 1, 1 + .2 sin t", 1.0, SineLoad(amplitude=0.2, frequency=1.0), rest),
        ("W = .1, 1 + .2 sin t", 0.1, SineLoad(amplitude=0.2, frequency=1.0), rest),
        ("W = 1, 1 + .5 sin 2t", 1.0, SineLoad(amplitude=0.5, frequency=2.0), rest),
        ("W = 1, 1 + .5 sin 5t", 1.0, SineLoad(amplitude=0.5, frequency=5.0), rest),
        ("W = 1, load step .7", 1.0, StepLoad(amplitude=0.7, start=1.0), rest),
        ("W = 1, load drop -.5", 1.0, StepLoad(amplitude=-0.5, start=1.0), rest),
        ("W = 1, free decay from -20 %", 1.0, StepLoad(amplitude=0.0, start=40.0), perturbed(c, rest, -0.2)),
    )
    for name, W, load, start in cases:
        begin = perf_counter()
        full = c.simulate(start, duration=20.0, W=W, load=load, control=FixedSteps(step=0.05))
        middle = perf_counter()
        options = {"mass": W / HERTZ_LOAD, "load": load, "start": start.delta, "duration": 20.0}
        motion = ball_transient(law, **options, samples=401, rtol=1e-4)
        middle_again = perf_counter()
        for _ in range(10):
            ball_transient(law, **options, samples=401, rtol=1e-4)
        after = middle + 0.1 * (perf_counter() - middle_again)
        error = np.interp(full.time, motion.time, motion["z"]) - full.delta
        rms = np.sqrt(np.mean(error**2) / np.mean((full.delta - rest.delta) ** 2))
        times = (middle - begin, after - middle)
        print(f"{name:>36s}{rms:11.1%}{times[0]:9.2f}{times[1]:9.4f}{times[0] / times[1]:8.0f}")


def print_hard():
    for V, cells in ((0.006, 64), (0.002, 64), (0.002, 128), (0.0005, 128), (0.0005, 256)):
        begin = process_time()
        try:
            state = PointContact(V=V, Q0=20.0, grid=ContactGrid(cells=(cells, cells))).stationary()
            told = f"delta {state.delta:.5f}, H0 {state.central_film:.5f}, thinnest {state.minimum_film:.5f}"
        except ConvergenceError as error:
            told = str(error)
        print(f"Q0 = 20, V = {V}, {cells} x {cells}: {told} ({process_time() - begin:.1f} CPU s)")
    c = contact((72, 56), inlet=-4.5, outlet=4.0, half_width=3.5)
    run = c.simulate(
        c.stationary(), duration=10.0, W=1.0, load=StepLoad(amplitude=8.0, start=1.0),
        control=AdaptiveSteps(tolerance=1e-3),
    )  # fmt: skip
    print(f"load step A = 8, W = 1: complete {run.complete}, {run.work}")
    print("where the published scheme fails: python benchmarks/studies/contact_limits.py")


PARTS = {
    "cost": print_cost,
    "growth": print_growth,
    "grid": print_grid,
    "decay": print_decay,
    "law": print_law,
    "hard": print_hard,
}

if __name__ == "__main__":
    for part in sys.argv[1:] or PARTS:
        PARTS[part]()
