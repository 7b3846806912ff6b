"""The published cases of a ball on a lubricated plane, by the published scheme and converged.

Panovko (2011), section 4, V = 0.1 and Q0 = 5: implicit Euler with a step of 0.2 on 40 x 40 cells, staggered,
whose rectangle the paper does not give; the same grid and scheme with short steps of second order, which
tells what the published step alone does; and steps that follow their error on upwind cells. What the text
says of its figures is asked of all three.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import NamedTuple

import numpy as np

from ...bearings.contact import (
    AdaptiveSteps,
    ContactGrid,
    ContactRun,
    ContactScheme,
    FixedSteps,
    PointContact,
    SineLoad,
    StaggeredScheme,
    StepLoad,
    UpwindScheme,
    perturbed,
)
from ...errors import ConvergenceError, ValidityWarning
from ...progress import Report, silent
from .contact_statements import STEP, SWEEP, CaseSection, CaseSolution, SolutionKind, Statement, statements

SPEED_PARAMETER, PRESSURE_COEFFICIENT = 0.1, 5.0
PUBLISHED_CELLS, PUBLISHED_STEP = 40, 0.2

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


@contextmanager
def as_published() -> Iterator[None]:
    """Silence what the published scheme is warned of: that its pressure alternates."""
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        yield


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


def published_contact(cells: int, scheme: ContactScheme) -> PointContact:
    """Return the contact of the published cases on cells x cells."""
    grid = ContactGrid(cells=(cells, cells))
    return PointContact(V=SPEED_PARAMETER, Q0=PRESSURE_COEFFICIENT, grid=grid, scheme=scheme)


def _solution(
    kind: SolutionKind, cells: int, scheme: ContactScheme, control: AdaptiveSteps | FixedSteps
) -> CaseSolution:
    contact = published_contact(cells, scheme)
    rest = contact.stationary()
    return CaseSolution(kind, contact, rest, contact.stationary(1.0 + STEP["amplitude"], near=rest), control)
