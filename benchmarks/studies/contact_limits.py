"""Where the published scheme of a rolling ball fails, and how it decays by itself: a minute.

    python benchmarks/studies/contact_limits.py [FOLDER]

It writes the two maps (chart_contact_limits.png) and their table (CSV), and prints the table.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes

from rotorfilm import ConvergenceError
from rotorfilm.bearings.contact import ContactState, FixedSteps, PointContact, StaggeredScheme, StepLoad
from rotorfilm.charts import new_figure, save
from rotorfilm.charts.canvas import BAD, DOUBTFUL, GOOD
from rotorfilm.core import write_csv
from rotorfilm.core.progress import Report, part_of, silent
from rotorfilm.studies.contact_precision import (
    PUBLISHED_CELLS,
    as_published,
    natural_motions,
    published_contact,
)

STEPS = (0.05, 0.1, 0.2, 0.5, 1.0)
AMPLITUDES = (0.7, 1.5, 3.0, 5.0, 8.0)
INERTIAS = (0.1, 0.3, 0.5, 1.0, 3.0)
SPAN = 4.0
"""Time after a load step within which a run has to hold."""


class ContactLimits(NamedTuple):
    """Where implicit Euler with fixed steps on the published grid ends, and what it does to the decay.

    Attributes
    ----------
    steps, load_steps, inertias : tuple of float
        Lengths of the steps; load steps at W = 1; inertias W.
    reached : ndarray, shape (steps, load_steps)
        Time after the load step at which the run failed, infinite if it did not.
    physical : ndarray, shape (inertias,)
        Decay time of small oscillations by the linearized equations.
    shown : ndarray, shape (steps, inertias)
        Decay time that the scheme shows.
    """

    steps: tuple[float, ...]
    load_steps: tuple[float, ...]
    inertias: tuple[float, ...]
    reached: np.ndarray
    physical: np.ndarray
    shown: np.ndarray

    def columns(self) -> dict[str, list[object]]:
        """Return both maps as one table; no time of failure where a run holds, dt = 0 for the equations."""
        rows = [
            ("load step", step, a, float(self.reached[i, j]) if np.isfinite(self.reached[i, j]) else None)
            for i, step in enumerate(self.steps)
            for j, a in enumerate(self.load_steps)
        ]
        rows += [
            ("decay time", step, W, float(self.shown[i, j]))
            for i, step in enumerate(self.steps)
            for j, W in enumerate(self.inertias)
        ]
        rows += [
            ("decay time", 0.0, W, float(time)) for W, time in zip(self.inertias, self.physical, strict=True)
        ]
        headings = ("map", "dt", "amplitude or W", "time of failure or decay time")
        return dict(zip(headings, map(list, zip(*rows, strict=True)), strict=True))


def contact_limits(
    cells: int = PUBLISHED_CELLS,
    steps: Sequence[float] = STEPS,
    amplitudes: Sequence[float] = AMPLITUDES,
    inertias: Sequence[float] = INERTIAS,
    report: Report = silent,
) -> ContactLimits:
    """Return the limits of the published scheme on its grid, or one of `cells` x `cells`; a minute."""
    contact = published_contact(cells, StaggeredScheme())
    with as_published():
        rest = contact.stationary()
    s = natural_motions(contact, rest, inertias, part_of(report, 0.0, 0.3))
    reached = np.full((len(steps), len(amplitudes)), np.inf)
    for i, step in enumerate(steps):
        for j, amplitude in enumerate(amplitudes):
            report(0.3 + 0.7 * (i + j / len(amplitudes)) / len(steps), f"dt = {step:g}, A = {amplitude:g}")
            reached[i, j] = _reached(contact, rest, step, amplitude)
    shown = np.array([step / np.log(np.abs(1.0 - step * s)) for step in steps])
    return ContactLimits(tuple(steps), tuple(amplitudes), tuple(inertias), reached, -1.0 / s.real, shown)


def _reached(contact: PointContact, rest: ContactState, step: float, amplitude: float) -> float:
    load, control = StepLoad(amplitude=amplitude, start=step), FixedSteps(step=step, order=1)
    try:
        with as_published():
            contact.simulate(rest, duration=step + SPAN, W=1.0, load=load, control=control)
    except ConvergenceError as error:
        return float(error.partial.time[-1] - step)
    return np.inf


def plot_contact_limits(result: ContactLimits) -> list[Axes]:
    """Draw where the published scheme fails under load steps, and the decay times it shows."""
    steps, decay = new_figure(size=(12.0, 4.8)).subplots(1, 2)
    _cells(steps, result.reached, result.steps, result.load_steps, _failure)
    steps.set(title="load step at W = 1: time of failure", xlabel="amplitude A", ylabel="step dt")
    ratio = result.shown / result.physical
    _cells(decay, ratio, result.steps, result.inertias, _decay)
    decay.set(title="decay time shown / physical", xlabel="inertia W", ylabel="step dt")
    return [steps, decay]


def _cells(
    axes: Axes,
    values: np.ndarray,
    rows: tuple[float, ...],
    columns: tuple[float, ...],
    describe: Callable[[float], tuple[str, str]],
) -> None:
    for (i, j), value in np.ndenumerate(values):
        text, color = describe(float(value))
        axes.fill_between([j - 0.5, j + 0.5], i - 0.5, i + 0.5, color=color, edgecolor="white")
        axes.text(j, i, text, ha="center", va="center", fontsize=9)
    axes.set_xticks(range(len(columns)), [f"{value:g}" for value in columns])
    axes.set_yticks(range(len(rows)), [f"{value:g}" for value in rows])
    axes.set(xlim=(-0.5, len(columns) - 0.5), ylim=(-0.5, len(rows) - 0.5))


def _failure(time: float) -> tuple[str, str]:
    return ("runs", GOOD) if np.isinf(time) else (f"{time:.3g}", BAD)


def _decay(ratio: float) -> tuple[str, str]:
    color = GOOD if ratio > 0.9 else DOUBTFUL if ratio > 0.5 else BAD
    return f"{ratio:.2g}", color


def main() -> None:
    """Compute, draw and print the limits."""
    out = Path(*(sys.argv[1:] or ["rotorfilm-charts"]))
    out.mkdir(parents=True, exist_ok=True)
    result = contact_limits()
    table = result.columns()
    save(plot_contact_limits(result)[0], out / "chart_contact_limits.png", dpi=110)
    write_csv(out / "chart_contact_limits.csv", table)
    for row in zip(*table.values(), strict=True):
        print(
            *("" if entry is None else f"{entry:.4g}" if isinstance(entry, float) else entry for entry in row)
        )


if __name__ == "__main__":
    main()
