"""The published cases of a ball on a lubricated plane, by the published scheme and converged: ten minutes.

    python benchmarks/studies/contact_cases.py [--cells 40] [--tolerance 1e-4] [--settle 60] [--out FOLDER]

It writes figures 2 to 7 (chart_contact_cases.png), the statements of the text with their verdicts and the
curves (CSV), and prints the statements.

Panovko (2011), section 4, V = 0.1 and Q0 = 5: implicit Euler with a step of 0.2 on 40 x 40 cells, staggered,
whose rectangle the paper does not give; the same grid and scheme with short steps of second order, which
tells what the published step alone does; and steps that follow their error on upwind cells. What the text
says of its figures is asked of all three.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from enum import StrEnum
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from scipy.interpolate import CubicSpline
from scipy.signal import find_peaks

from rotorfilm import ConvergenceError
from rotorfilm.bearings.contact import (
    AdaptiveSteps,
    ContactRun,
    ContactScheme,
    ContactState,
    FixedSteps,
    PointContact,
    SineLoad,
    StaggeredScheme,
    StepLoad,
    UpwindScheme,
    perturbed,
)
from rotorfilm.charts import new_figure, save
from rotorfilm.charts.canvas import legend_beside
from rotorfilm.core import write_csv
from rotorfilm.core.model import Array
from rotorfilm.core.progress import Report, silent
from rotorfilm.studies import decay_time
from rotorfilm.studies.contact_precision import (
    PUBLISHED_CELLS,
    PUBLISHED_STEP,
    as_published,
    published_contact,
)

# What the text of Panovko (2011), section 4, says of its figures, asked of a solution of the cases.


STEP = {"amplitude": 0.7, "start": 1.0, "end": 20.0}
"""Load of case 4.2."""

SWEEP = (1.0, 2.0, 5.0)
"""Frequencies of case 4.3."""

PUBLISHED_REST = (0.1761, -1.793)
"""H0 and delta of the stationary contact, with the sign of delta that the paper lost."""

PERIOD = 2.0 * np.pi


class CaseSection(StrEnum):
    """Sections of the paper whose figures are redrawn, case 4.3 by its two amplitudes."""

    FREE = "4.1"
    STEPPED = "4.2"
    SLOW = "4.3, A = 0.2"
    FAST = "4.3, A = 0.5"


class Claim(NamedTuple):
    """A sentence of the text, what to measure, the numbers of one solution, and whether they bear it out."""

    section: str
    text: str
    measure: str
    numbers: tuple[float, ...]
    holds: bool


class Statement(NamedTuple):
    """A sentence, what was measured, by the three solutions, and the verdict."""

    section: str
    text: str
    measure: str
    published: str
    same_grid: str
    converged: str
    verdict: str

    @classmethod
    def judged(cls, published: Claim, same_grid: Claim, converged: Claim) -> Statement:
        """Return the row of a table from the three answers to one sentence."""
        if converged.holds:
            verdict = "confirmed"
        elif not published.holds:
            verdict = "not confirmed"
        elif same_grid.holds:
            verdict = "artefact of the grid"
        else:
            verdict = "artefact of numerical damping"
        answers = (published, same_grid, converged)
        first, second, third = (_written(answer.numbers) for answer in answers)
        return cls(published.section, published.text, published.measure, first, second, third, verdict)


class SolutionKind(StrEnum):
    """The ways to solve the cases."""

    PUBLISHED = "published"
    SAME_GRID = "same grid"
    CONVERGED = "converged"


class CaseSolution(NamedTuple):
    """One way to solve the cases: which, contact, its rest under f = 1 and under f = 1.7, and its steps."""

    kind: SolutionKind
    contact: PointContact
    rest: ContactState
    pressed: ContactState
    control: AdaptiveSteps | FixedSteps


def statements(runs: Mapping[CaseSection, list[ContactRun]], solution: CaseSolution) -> list[Claim]:
    """Return what a solution has to say on every sentence, from its runs by section."""
    return [
        *_at_rest(solution),
        *_free(runs[CaseSection.FREE], solution),
        *_stepped(runs[CaseSection.STEPPED], solution),
        *_driven(runs[CaseSection.SLOW], runs[CaseSection.FAST]),
    ]


def _claim(
    section: str,
    text: str,
    measure: str,
    numbers: Sequence[float],
    holds: Callable[[Sequence[float]], bool],
) -> Claim:
    return Claim(section, text, measure, tuple(numbers), bool(holds(numbers)))


def _at_rest(solution: CaseSolution) -> list[Claim]:
    found = (solution.rest.central_film, solution.rest.delta)

    def near(row: Sequence[float]) -> bool:
        return all(abs(a / b - 1.0) < 0.03 for a, b in zip(row, PUBLISHED_REST, strict=True))

    return [_claim("4", "H0 = 0.1761 and delta = -1.793 at rest, to 3 %", "H0, delta", found, near)]


def _free(runs: list[ContactRun], solution: CaseSolution) -> list[Claim]:
    rest, x = solution.rest, solution.contact.grid.x
    swing = [overshoot(run, rest.delta) for run in runs]
    decay = [decay_time(run, rest.delta) for run in runs[1:]]
    waves = runs[2].snapshots
    heights = [wave_height(state, rest, x) for state in waves[1:3]]
    return [
        _claim("4.1", "without inertia delta goes back to rest without oscillation", "overshoot, W = 0",
               swing[:1], lambda row: row[0] < 0.02),
        _claim("4.1", "with inertia it oscillates about rest and decays", "overshoot, W = 0.5, 1",
               swing[1:], lambda row: min(row) > 0.1),
        _claim("4.1", "the decay takes longer with larger W", "decay times, W = 0.5, 1",
               decay, lambda row: row[1] > 1.05 * row[0]),
        _claim("4.1", "almost twice as long for W = 1 as for W = 0.5", "ratio of decay times",
               [decay[1] / decay[0]], lambda row: 1.7 < row[0] < 2.3),
        _claim("4.1", "a modulation of the film moves along the contact at the rolling speed, to 10 %",
               "speed of its crest; range at t = 0.6, 0.8", [wave_speed(waves, rest, x), *heights],
               lambda row: abs(row[0] - 1.0) < 0.1),
    ]  # fmt: skip


def _stepped(runs: list[ContactRun], solution: CaseSolution) -> list[Claim]:
    pressed, start, end = solution.pressed, STEP["start"], STEP["end"]
    swing = [overshoot(run, pressed.delta, start, end) for run in runs]
    decay = [decay_time(run, pressed.delta, start + 0.5, end) for run in runs]
    left = [amplitude(run, end - 4.0, end) / amplitude(run, start, start + 4.0) for run in runs]
    peaks = [float(np.max(solution.rest.delta - run.delta)) for run in runs]
    films = [amplitude(run, start, end, "central_film") for run in runs]
    return [
        _claim("4.2", "a load step causes decaying oscillations about the new rest",
               "overshoot, W = 0.3, 1, 3", swing, lambda row: min(row) > 0.1),
        _claim("4.2", "their decay time grows with W", "decay times, W = 0.3, 1, 3", decay, _rising),
        _claim("4.2", "for W = 0.3 they have decayed wholly before the load falls, for W = 3 not",
               "amplitude left, W = 0.3, 3", [left[0], left[2]], lambda row: row[0] < 0.05 < row[1]),
        _claim("4.2", "amplitudes of delta fall markedly with W", "largest change of delta", peaks, _falling),
        _claim("4.2", "amplitudes of H0 fall markedly with W", "half the range of H0", films, _falling),
    ]  # fmt: skip


def _driven(slow: list[ContactRun], fast: list[ContactRun]) -> list[Claim]:
    early = [unrest(run, PERIOD, 30.0) for run in slow]
    late = [unrest(run, PERIOD / w, run.time[-1]) for run, w in zip(fast, SWEEP, strict=True)]
    rows = {
        name: [[amplitude(run, run.time[-1] - 2.0 * PERIOD, name=name) for run in part]
               for part in (slow, fast)]
        for name in ("delta", "central_film")
    }  # fmt: skip
    (delta_W, delta_w), (film_W, film_w) = rows["delta"], rows["central_film"]
    return [
        _claim("4.3", "the oscillations become steady and periodic, A = 0.2: by t = 30",
               "change over a period, W = 0.01, 0.1, 1", early, lambda row: max(row) < 0.05),
        _claim("4.3", "the same for A = 0.5, W = 1: at last", "change over a period, omega = 1, 2, 5",
               late, lambda row: max(row) < 0.1),
        _claim("4.3", "the amplitude of delta falls with W", "amplitude, W = 0.01, 0.1, 1",
               delta_W, _falling),
        _claim("4.3", "the amplitude of H0 falls with W", "amplitude, W = 0.01, 0.1, 1", film_W, _falling),
        _claim("4.3", "omega = 2 has the largest amplitude of delta", "amplitude, omega = 1, 2, 5",
               delta_w, _second_largest),
        _claim("4.3", "omega = 2 has the largest amplitude of H0", "amplitude, omega = 1, 2, 5",
               film_w, _second_largest),
        _claim("4.3", "the amplitude does not depend on omega monotonically", "of H0, omega = 1, 2, 5",
               film_w, lambda row: not (_falling(row) or _rising(row))),
    ]  # fmt: skip


def _written(numbers: Sequence[float]) -> str:
    return ", ".join(f"{value:.3g}" if abs(value) < 1.0 else f"{value:.4g}" for value in numbers)


def _falling(row: Sequence[float]) -> bool:
    """Whether numbers fall, by more than the errors of the solution."""
    return all(later < 0.98 * earlier for earlier, later in pairwise(row))


def _rising(row: Sequence[float]) -> bool:
    return all(later > 1.02 * earlier for earlier, later in pairwise(row))


def _second_largest(row: Sequence[float]) -> bool:
    """Whether the second number is the largest."""
    return row[1] == max(row)


# The published cases of a ball on a lubricated plane, by the published scheme and converged.


SAME_GRID_STEP = 0.05
"""Of second order; the staggered scheme is blind to what alternates, the more so the shorter the steps."""

WAVE_TIMES = (0.4, 0.6, 0.8, 1.0)
"""Of the paper's figure 4."""

SHARE = -0.2
"""By which pressure and approach are off at the start of case 4.1."""


class CaseRun(NamedTuple):
    """One curve of a figure, by every solution."""

    name: str
    runs: tuple[ContactRun, ...]


class ContactCases(NamedTuple):
    """Solutions, curves by section of the paper, and the statements of its text."""

    solutions: tuple[CaseSolution, ...]
    curves: dict[CaseSection, list[CaseRun]]
    statements: list[Statement]

    def columns(self) -> dict[str, list[object]]:
        """Return the statements as columns of a table."""
        return {name: [getattr(row, name) for row in self.statements] for name in Statement._fields}

    def series(self) -> dict[str, list[object]]:
        """Return the curves as columns of a table."""
        rows = [
            (section, curve.name, solution.kind, *point)
            for section, curves in self.curves.items()
            for curve in curves
            for solution, run in zip(self.solutions, curve.runs, strict=True)
            for point in np.transpose([run.time, run.central_film, run.delta]).tolist()
        ]
        headings = ("section", "curve", "solution", "time", "H0", "delta")
        return dict(zip(headings, map(list, zip(*rows, strict=True)), strict=True))


def contact_cases(
    cells: int = 48, tolerance: float = 1e-4, settle: float = 150.0, report: Report = silent
) -> ContactCases:
    """Return the cases; some ten minutes, nearly all of it for the converged runs of case 4.3.

    Parameters
    ----------
    cells : int
        Cells along each side of the converged solution.
    tolerance : float
        Of its steps.
    settle : float [1]
        Length of the runs under a sinusoidal load with W = 1, whose transients last long.
    report : callable
        Told how far the work is.
    """
    report(0.0, "stationary contacts")
    solutions = (
        _solution(
            SolutionKind.PUBLISHED,
            PUBLISHED_CELLS,
            StaggeredScheme(),
            FixedSteps(step=PUBLISHED_STEP, order=1),
        ),
        _solution(
            SolutionKind.SAME_GRID, PUBLISHED_CELLS, StaggeredScheme(), FixedSteps(step=SAME_GRID_STEP)
        ),
        _solution(SolutionKind.CONVERGED, cells, UpwindScheme(), AdaptiveSteps(tolerance=tolerance)),
    )
    with as_published():
        curves = _curves(solutions, settle, report)
    found = [
        statements({section: [case.runs[k] for case in cases] for section, cases in curves.items()}, solution)
        for k, solution in enumerate(solutions)
    ]
    return ContactCases(solutions, curves, [Statement.judged(*row) for row in zip(*found, strict=True)])


def _curves(
    solutions: tuple[CaseSolution, ...], settle: float, report: Report
) -> dict[CaseSection, list[CaseRun]]:
    plan = [(section, *case) for section, cases in case_plan(settle).items() for case in cases]
    curves: dict[CaseSection, list[CaseRun]] = {}
    count = len(plan) * len(solutions)
    for number, (section, name, run) in enumerate(plan):
        runs = []
        for k, solution in enumerate(solutions):
            report((number * len(solutions) + k) / count, f"{section}, {name}, {solution.kind}")
            runs.append(_as_far_as_it_goes(run, solution))
        curves.setdefault(section, []).append(CaseRun(name, tuple(runs)))
    return curves


def _as_far_as_it_goes(run: Callable[[CaseSolution], ContactRun], solution: CaseSolution) -> ContactRun:
    """Return a run, or what there is of it where its steps fail."""
    try:
        return run(solution)
    except ConvergenceError as error:
        partial: ContactRun = error.partial
        return partial


def free_motion(solution: CaseSolution, W: float, duration: float = 30.0) -> ContactRun:
    """Return case 4.1: pressure and approach 20 % too small."""
    start = perturbed(solution.contact, solution.rest, SHARE)
    return solution.contact.simulate(
        start, duration=duration, W=W, control=solution.control, snapshots=WAVE_TIMES
    )


def loaded_motion(
    solution: CaseSolution, W: float, load: Callable[[float], float], duration: float = 30.0
) -> ContactRun:
    """Return the motion from rest under a load."""
    return solution.contact.simulate(
        solution.rest, duration=duration, W=W, load=load, control=solution.control
    )


def case_plan(settle: float) -> dict[CaseSection, list[tuple[str, Callable[[CaseSolution], ContactRun]]]]:
    """Return the curves of each section: name and run."""
    slow = SineLoad(amplitude=0.2, frequency=1.0)
    return {
        CaseSection.FREE: [(f"W = {W:g}", partial(free_motion, W=W)) for W in (0.0, 0.5, 1.0)],
        CaseSection.STEPPED: [
            (f"W = {W:g}", partial(loaded_motion, W=W, load=StepLoad(**STEP))) for W in (0.3, 1.0, 3.0)
        ],
        CaseSection.SLOW: [
            (f"W = {W:g}", partial(loaded_motion, W=W, load=slow, duration=settle if W == 1.0 else 30.0))
            for W in (0.01, 0.1, 1.0)
        ],
        CaseSection.FAST: [
            (
                f"omega = {w:g}",
                partial(loaded_motion, W=1.0, load=SineLoad(amplitude=0.5, frequency=w), duration=settle),
            )
            for w in SWEEP
        ],
    }


def _solution(
    kind: SolutionKind, cells: int, scheme: ContactScheme, control: AdaptiveSteps | FixedSteps
) -> CaseSolution:
    contact = published_contact(cells, scheme)
    rest = contact.stationary()
    return CaseSolution(kind, contact, rest, contact.stationary(1.0 + STEP["amplitude"], near=rest), control)


# Numbers that describe a run of a point contact: amplitude, travelling film.


SAMPLES = 4001
"""Instants at which a span of time is searched for its extremes."""

PROMINENT = 0.02
"""Prominence of a crest / range of the film's change: less is noise."""

CORE = 0.6
"""Half the length along y = 0 on which the travelling film is followed."""


def amplitude(run: ContactRun, begin: float, end: float = np.inf, name: str = "delta") -> float:
    """Return half the range of a series over a span of time, between samples too."""
    return 0.5 * float(np.ptp(_between(run, begin, end, name)))


def overshoot(run: ContactRun, rest: float, begin: float = 0.0, end: float = np.inf) -> float:
    """Return how far delta goes beyond `rest`, per its distance from there at first."""
    past = _between(run, begin, end, "delta") - rest
    return max(0.0, float(np.max(-past / past[0])))


def unrest(run: ContactRun, period: float, end: float, name: str = "delta") -> float:
    """Return the change from the last period before `end` to the one before, / half the range."""
    span, end = np.linspace(0.0, period, SAMPLES), min(end, float(run.time[-1]))
    spline = CubicSpline(run.time, getattr(run, name))
    last, before = spline(end - period + span), spline(end - 2.0 * period + span)
    return float(np.max(np.abs(last - before)) / (0.5 * np.ptp(last)))


def wave_speed(states: Sequence[ContactState], rest: ContactState, x: Array) -> float:
    """Return the speed of the first crest of the film's change from rest along y = 0, in (u1 + u2)/2."""
    points = np.linspace(-CORE, CORE, SAMPLES)
    times, crests = [], []
    for state in states:
        change = CubicSpline(x, (state.thickness - rest.thickness)[:, 0])(points)
        found, _ = find_peaks(change, prominence=PROMINENT * float(np.ptp(change)))
        if len(found):
            times.append(state.t)
            crests.append(points[found[0]])
    return float(np.polyfit(times, crests, 1)[0]) if len(times) > 1 else 0.0


def wave_height(state: ContactState, rest: ContactState, x: Array) -> float:
    """Return the range of the change of the film along y = 0 from rest, within the core."""
    core = np.abs(x) < CORE
    return float(np.ptp((state.thickness - rest.thickness)[core, 0]))


def _between(run: ContactRun, begin: float, end: float, name: str) -> Array:
    begin, end = max(begin, float(run.time[0])), min(end, float(run.time[-1]))
    return np.asarray(CubicSpline(run.time, getattr(run, name))(np.linspace(begin, end, SAMPLES)))


# Figures 2 to 7 of the published cases of a ball on a lubricated plane, redrawn.


TITLES = {
    CaseSection.FREE: "figure 3: approach and pressure 20 % too small",
    CaseSection.STEPPED: "figure 5: load 1.7 from t = 1 to 20",
    CaseSection.SLOW: "figure 6: load 1 + 0.2 sin t",
    CaseSection.FAST: "figure 7: load 1 + 0.5 sin(omega t), W = 1",
}

SHOWN = {SolutionKind.PUBLISHED: ("--", 1.0), SolutionKind.CONVERGED: ("-", 1.6)}
"""Solutions drawn: line and its width."""

LATEST = 40.0
"""End of the time axes."""


def plot_contact_cases(cases: ContactCases) -> list[Axes]:
    """Draw figures 2 to 7: published scheme dashed, converged solid."""
    figure = new_figure(size=(11.5, 17.0))
    figure.suptitle("Panovko (2011), figures 2 to 7. Solid: converged; dashed: published scheme, dt = 0.2")
    rows = iter(figure.subplots(6, 2))
    axes = [*_draw_rest(next(rows), cases)]
    for section, curves in cases.curves.items():
        axes += _draw_series(next(rows), cases, section)
        if section == CaseSection.FREE:
            axes += _draw_waves(next(rows), cases, curves[-1])
    return axes


def _draw_rest(row: list[Axes], cases: ContactCases) -> list[Axes]:
    for solution in cases.solutions:
        _draw_along(row, solution, solution.rest, "C0", None)
    return _dressed(row, ("figure 2: at rest, y = 0", ""), ("pressure p", "film H"), "x")


def _draw_waves(row: list[Axes], cases: ContactCases, heaviest: CaseRun) -> list[Axes]:
    for solution, run in zip(cases.solutions, heaviest.runs, strict=True):
        for number, state in enumerate(run.snapshots):
            _draw_along(row, solution, state, f"C{number}", f"t = {state.t:g}")
    legend_beside(row[1])
    return _dressed(row, ("figure 4: case 4.1, W = 1, y = 0", ""), ("pressure p", "film H"), "x")


def _draw_along(
    row: list[Axes], solution: CaseSolution, state: ContactState, color: str, label: str | None
) -> None:
    """Draw pressure and film along y = 0."""
    x: Array = solution.contact.grid.x
    _draw_cases(row, solution, x, (state.pressure[:, 0], state.thickness[:, 0]), color, label)


def _draw_series(row: list[Axes], cases: ContactCases, section: CaseSection) -> list[Axes]:
    for number, curve in enumerate(cases.curves[section]):
        for solution, run in zip(cases.solutions, curve.runs, strict=True):
            early = run.time <= LATEST
            values = (run.central_film[early], -run.delta[early])
            _draw_cases(row, solution, run.time[early], values, f"C{number}", curve.name)
    legend_beside(row[1])
    return _dressed(row, (TITLES[section], ""), ("central film H0", "approach -delta"), "time")


def _draw_cases(
    row: list[Axes],
    solution: CaseSolution,
    abscissa: Array,
    pair: tuple[Array, Array],
    color: str,
    label: str | None,
) -> None:
    """Draw a curve of a solution into each of two Axes if it is shown; converged ones have labels."""
    if solution.kind not in SHOWN:
        return
    style, width = SHOWN[solution.kind]
    shown = label if solution.kind == SolutionKind.CONVERGED else None
    for axes, values in zip(row, pair, strict=True):
        axes.plot(abscissa, values, style, color=color, linewidth=width, label=shown)


def _dressed(row: list[Axes], titles: tuple[str, str], labels: tuple[str, str], abscissa: str) -> list[Axes]:
    for axes, title, label in zip(row, titles, labels, strict=True):
        axes.set(title=title, ylabel=label, xlabel=abscissa)
        axes.grid(visible=True, alpha=0.3)
    # Films behind the contact and balls in the air are off the scale of the figures.
    if abscissa == "x":
        row[1].set_ylim(0.0, 1.0)
    return list(row)


def main() -> None:
    """Compute, draw and print the cases."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cells", type=int, default=40, help="along each side, converged runs")
    parser.add_argument("--tolerance", type=float, default=1e-4, help="of the steps of converged runs")
    parser.add_argument("--settle", type=float, default=60.0, help="length of the runs of case 4.3, W = 1")
    parser.add_argument("--out", type=Path, default=Path("rotorfilm-charts"))
    given = parser.parse_args()
    result = contact_cases(given.cells, given.tolerance, given.settle)
    given.out.mkdir(parents=True, exist_ok=True)
    save(plot_contact_cases(result)[0], given.out / "chart_contact_cases.png", dpi=110)
    write_csv(given.out / "chart_contact_cases.csv", result.columns())
    write_csv(given.out / "chart_contact_curves.csv", result.series())
    for row in result.statements:
        print(" | ".join(row))


if __name__ == "__main__":
    main()
