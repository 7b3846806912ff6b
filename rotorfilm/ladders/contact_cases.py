"""The published cases of a ball on a lubricated plane, by the published scheme and converged.

Panovko (2011), sections 4.1 to 4.3, V = 0.1 and Q0 = 5: implicit Euler with a step of 0.2 on 40 x 40 cells,
staggered, whose rectangle the paper does not give, beside steps that follow their error on upwind cells. What
the text says of its figures is asked of both.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from ..bearings.contact import PointContact, perturbed
from ..films.contact_grid import ContactGrid
from ..films.contact_loads import SineLoad, StepLoad
from ..films.contact_scheme import ContactScheme, StaggeredScheme, UpwindScheme
from ..films.contact_state import ContactRun, ContactState
from ..films.contact_steps import AdaptiveSteps, FixedSteps
from ..model import Array
from ..progress import Report, silent

SPEED_PARAMETER, PRESSURE_COEFFICIENT = 0.1, 5.0
PUBLISHED_CELLS, PUBLISHED_STEP = 40, 0.2
WAVE_TIMES = (0.8, 1.0)
"""Between which the film's modulation is followed, as in the paper's figure 4."""

DURATION = 30.0
"""Length of a run; the paper's figures end at 20 to 40."""


class CaseRun(NamedTuple):
    """One curve of a figure: the published scheme and the converged one."""

    name: str
    published: ContactRun
    converged: ContactRun


class Statement(NamedTuple):
    """What the text says, the number behind it in both runs, and the verdict."""

    section: str
    text: str
    published: str
    converged: str
    verdict: str


class ContactCases(NamedTuple):
    """Curves by section, and the statements of the text."""

    runs: dict[str, list[CaseRun]]
    statements: list[Statement]

    def columns(self) -> dict[str, list[object]]:
        """Return the statements as columns of a table."""
        return {name: [getattr(row, name) for row in self.statements] for name in Statement._fields}


class _Solver(NamedTuple):
    contact: PointContact
    rest: ContactState
    control: AdaptiveSteps | FixedSteps

    def free(self, W: float) -> ContactRun:
        """Return case 4.1: pressure and approach 20 % too small."""
        start = perturbed(self.contact, self.rest, -0.2)
        return self.contact.simulate(
            start, duration=DURATION, W=W, control=self.control, snapshots=WAVE_TIMES
        )

    def loaded(self, W: float, load: Callable[[float], float]) -> ContactRun:
        """Return the motion from rest under a load."""
        return self.contact.simulate(self.rest, duration=DURATION, W=W, load=load, control=self.control)


def contact_cases(cells: int = 48, tolerance: float = 1e-4, report: Report = silent) -> ContactCases:
    """Return the cases; minutes, for the most part for the converged runs.

    Parameters
    ----------
    cells : int
        Cells along each side of the converged solution.
    tolerance : float
        Of its steps.
    report : callable
        Told how far the work is.
    """
    solvers = _solvers(cells, tolerance)
    plan = [(section, *case) for section, cases in _plan().items() for case in cases]
    runs: dict[str, list[CaseRun]] = {}
    for number, (section, name, run) in enumerate(plan):
        report(number / len(plan), f"{section}, {name}")
        runs.setdefault(section, []).append(CaseRun(name, *(run(solver) for solver in solvers)))
    return ContactCases(runs, _statements(runs, solvers))


def _plan() -> dict[str, list[tuple[str, Callable[[_Solver], ContactRun]]]]:
    """Return the curves of each section: name and run."""

    def loaded(W: float, load: Callable[[float], float]) -> Callable[[_Solver], ContactRun]:
        return lambda solver: solver.loaded(W, load)

    step = StepLoad(amplitude=0.7, start=1.0, end=20.0)
    slow = SineLoad(amplitude=0.2, frequency=1.0)
    return {
        "4.1": [(f"W = {W:g}", partial(_Solver.free, W=W)) for W in (0.0, 0.5, 1.0)],
        "4.2": [(f"W = {W:g}", loaded(W, step)) for W in (0.3, 1.0, 3.0)],
        "4.3 A = 0.2": [(f"W = {W:g}", loaded(W, slow)) for W in (0.01, 0.1, 1.0)],
        "4.3 A = 0.5": [
            (f"omega = {w:g}", loaded(1.0, SineLoad(amplitude=0.5, frequency=w))) for w in (1.0, 2.0, 5.0)
        ],
    }


def _solvers(cells: int, tolerance: float) -> tuple[_Solver, _Solver]:
    return (
        _solver(PUBLISHED_CELLS, StaggeredScheme(), FixedSteps(step=PUBLISHED_STEP, order=1)),
        _solver(cells, UpwindScheme(), AdaptiveSteps(tolerance=tolerance)),
    )


def _solver(cells: int, scheme: ContactScheme, control: AdaptiveSteps | FixedSteps) -> _Solver:
    grid = ContactGrid(cells=(cells, cells))
    contact = PointContact(V=SPEED_PARAMETER, Q0=PRESSURE_COEFFICIENT, grid=grid, scheme=scheme)
    return _Solver(contact, contact.stationary(), control)


def decay_time(run: ContactRun, rest: float, begin: float = 1.0, end: float = np.inf) -> float:
    """Return the time in which the oscillation of delta about `rest` falls by e, from its peaks."""
    spline = CubicSpline(run.time, run.delta - rest)
    peaks = spline.derivative().roots(extrapolate=False)
    peaks = peaks[(peaks > begin) & (peaks < end)]
    height = np.abs(spline(peaks))
    peaks, height = peaks[height > 1e-4], height[height > 1e-4]
    return float(-1.0 / np.polyfit(peaks, np.log(height), 1)[0]) if len(peaks) > 1 else 0.0


def amplitude(run: ContactRun, begin: float, end: float = np.inf) -> float:
    """Return half the range of delta over a span of time."""
    inside = run.delta[(run.time >= begin) & (run.time <= end)]
    return 0.5 * float(np.ptp(inside))


def wave_speed(states: tuple[ContactState, ...], x: Array) -> float:
    """Return the speed at which the film along y = 0 has moved between two states, in u1 + u2 halved."""
    core = np.abs(x) < 0.5
    before, after = (CubicSpline(x, state.thickness[:, 0]) for state in states)
    elapsed = states[1].t - states[0].t
    shifts = np.linspace(0.0, 2.0 * elapsed, 401)
    misses = [np.sum((after(x[core]) - before(x[core] - shift)) ** 2) for shift in shifts]
    return float(shifts[int(np.argmin(misses))] / elapsed)


def _statement(
    section: str,
    text: str,
    numbers: Sequence[Sequence[float]],
    form: str,
    holds: Callable[[Sequence[float]], bool],
) -> Statement:
    """Return a statement with its numbers from the published scheme and converged, and the verdict."""
    published, converged = (", ".join(format(value, form) for value in row) for row in numbers)
    if holds(numbers[1]):
        verdict = "confirmed"
    else:
        verdict = "artefact of the published scheme" if holds(numbers[0]) else "not confirmed"
    return Statement(section, text, published, converged, verdict)


def _statements(runs: dict[str, list[CaseRun]], solvers: tuple[_Solver, _Solver]) -> list[Statement]:
    rests = [solver.rest.delta for solver in solvers]
    columns = {
        name: ([case.published for case in cases], [case.converged for case in cases])
        for name, cases in runs.items()
    }
    decay = [
        [decay_time(run, rest) for run in row[1:]] for row, rest in zip(columns["4.1"], rests, strict=True)
    ]
    waves = [
        [wave_speed(row[2].snapshots, solver.contact.grid.x)]
        for row, solver in zip(columns["4.1"], solvers, strict=True)
    ]
    left = [[amplitude(row[0], 17.0, 20.0) / amplitude(row[0], 1.0, 5.0)] for row in columns["4.2"]]
    heights = [
        [float(np.max(np.abs(run.delta - rest))) for run in row]
        for row, rest in zip(columns["4.2"], rests, strict=True)
    ]
    masses, frequencies = (
        [[amplitude(run, DURATION - 4.0 * np.pi) for run in row] for row in columns[name]]
        for name in ("4.3 A = 0.2", "4.3 A = 0.5")
    )
    return [
        _statement(
            "4.1", "oscillations decay (decay times, W = 0.5, 1)", decay, ".3g", lambda row: min(row) > 0.0
        ),
        _statement(
            "4.1", "W = 1 decays in almost twice the time of W = 0.5 (ratio)",
            [[row[1] / row[0]] for row in decay], ".3g", lambda row: row[0] > 1.7,
        ),
        _statement(
            "4.1", "the film's modulation moves at the rolling speed (its speed)", waves, ".3g",
            lambda row: abs(row[0] - 1.0) < 0.05,
        ),
        _statement(
            "4.2", "W = 0.3 has decayed before the load falls (amplitude left)", left, ".2%",
            lambda row: row[0] < 0.05,
        ),
        _statement("4.2", "amplitudes of delta fall with W (W = 0.3, 1, 3)", heights, ".3g", _falling),
        _statement("4.3", "amplitude of delta falls with W (W = 0.01, 0.1, 1)", masses, ".3g", _falling),
        _statement(
            "4.3", "omega = 2 has the largest amplitude of delta (omega = 1, 2, 5)", frequencies, ".3g",
            lambda row: row[1] == max(row),
        ),
    ]  # fmt: skip


def _falling(row: Sequence[float]) -> bool:
    """Whether numbers fall, by more than the errors of the solution."""
    return all(later < 0.98 * earlier for earlier, later in pairwise(row))
