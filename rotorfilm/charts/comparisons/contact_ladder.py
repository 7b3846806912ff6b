"""Charts of the ladder of contact models, and of the limits of the published scheme."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ...comparisons.contact.contact_limits import ContactLimits
from ...comparisons.contact.contact_precision import ContactPrecision
from ..canvas import new_axes, new_figure
from ..labels import Label, place_labels
from ..palette import BAD, DOUBTFUL, GOOD


def plot_contact_precision(result: ContactPrecision) -> list[Axes]:
    """Draw the error of the motion over its cost, one color for each family."""
    axes = new_axes("Rolling ball, W = 1, load 1 + 0.5 sin 2t: error against cost", size=(9.0, 6.4))
    axes.set(xscale="log", yscale="log", ylabel="rms error of delta / rms of its motion [1]")
    axes.set_xlabel(f"processor time of {result.duration:g} units of time [s]; reference: {result.reference}")
    families = list(dict.fromkeys(rung.family for rung in result.rungs))
    labels = []
    for number, family in enumerate(families):
        rungs, color = [rung for rung in result.rungs if rung.family == family], f"C{number}"
        axes.plot([r.cost for r in rungs], [r.error for r in rungs], "o-", color=color, label=family)
        labels += [Label(r.cost, r.error, r.label, color) for r in rungs]
    axes.legend(fontsize=8)
    place_labels(axes, labels)
    return [axes]


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
    axes: Axes, values: np.ndarray, rows: tuple[float, ...], columns: tuple[float, ...], describe: object
) -> None:
    assert callable(describe)
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
