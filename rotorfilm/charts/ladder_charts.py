"""Marks of the rungs of a ladder: error over cost, as filled and open dots with labels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..studies import (
    DamperAccuracy,
    DamperRung,
    HeatAccuracy,
    HeatLadder,
    HeatModel,
    PadAccuracy,
    PadFamily,
    PadRung,
    SqueezeFamily,
)
from ..studies.contact_precision import ContactLimits, ContactPrecision
from .canvas import BAD, DOUBTFUL, GOOD, Label, new_axes, new_figure, place_labels


class RungMark(NamedTuple):
    """One rung: its cost [us], 99 % of its errors and their median if that is drawn, its label and color."""

    cost: float
    high: float
    median: float | None
    label: str
    color: str


def draw_marks(axes: Axes, marks: Sequence[RungMark], *, margins: tuple[float, float]) -> None:
    """Draw a filled dot for 99 % of the errors, an open one for the median, and a line between them.

    Parameters
    ----------
    axes : Axes
    marks : sequence of RungMark
    margins : (float, float)
        Ends of the axis of the cost, in the smallest and in the largest one.
    """
    axes.set(xscale="log", yscale="log")
    axes.grid(visible=True, which="major", alpha=0.3)
    for x, high, median, _, color in marks:
        if median is not None:
            axes.plot([x, x], [median, high], "-", color=color, linewidth=1.0, alpha=0.5)
            axes.plot(x, median, "o", color=color, markerfacecolor="white", markersize=4.5)
        axes.plot(x, high, "o", color=color, markersize=7)
    costs = [mark.cost for mark in marks]
    axes.set_xlim(margins[0] * min(costs), margins[1] * max(costs))


def label_marks(axes: Axes, marks: Sequence[RungMark]) -> None:
    """Write the labels, once limits and size are final."""
    medians = [(mark.cost, mark.median) for mark in marks if mark.median is not None]
    labels = [Label(mark.cost, mark.high, mark.label, mark.color) for mark in marks]
    place_labels(axes, labels, obstacles=medians)


# Chart of error against cost for the ladder of squeeze films.


DAMPER_COLORS = {
    SqueezeFamily.SERIES: "#2ca02c",
    SqueezeFamily.FINITE: "#1f4fb4",
    SqueezeFamily.MAP: "#000000",
    SqueezeFamily.PUBLISHED: "#e377c2",
    SqueezeFamily.REDUCED: "#d62728",
}
SHORT = (SqueezeFamily.SERIES, SqueezeFamily.MAP, SqueezeFamily.REDUCED)
"""Families of short films."""


def plot_damper_accuracy(result: DamperAccuracy) -> list[Axes]:
    """Draw the squeeze films over the cost of a force: against finite length, and against the series.

    A filled dot is the 99th percentile of the error, an open one the median.
    """
    figure = new_figure(size=(14.0, 7.0))
    shown = figure.subplots(1, 3)
    for axes, cavitated, title in zip(shown, (True, False), ("cavitated", "full film"), strict=False):
        rungs = [rung for rung in result.rungs if rung.cavitated is cavitated]
        _draw_damper(
            axes,
            [_mark_damper(rung, rung.high_error, rung.median_error) for rung in rungs if rung.high_error],
        )
        axes.set_title(f"{title}, against the film of finite length")
    short = [rung for rung in result.rungs if rung.cavitated and rung.family in SHORT and rung.series_error]
    _draw_damper(shown[2], [_mark_damper(rung, rung.series_error, None) for rung in short])
    shown[2].set_title("cavitated, against the whole series (short film)")
    figure.suptitle(
        f"Squeeze films at L/D = {result.slenderness:g}, Phi = {result.permeability_number:g}: error of the "
        f"force against its cost\n{result.states} random states (seed {result.seed}), eccentricity ratio to "
        "0.9; filled 99 %, open median",
        fontsize=11,
    )
    return list(shown)


def _mark_damper(rung: DamperRung, high: float, median: float | None) -> RungMark:
    return RungMark(1e6 * rung.cost.force_time, high, median, rung.name, DAMPER_COLORS[rung.family])


def _draw_damper(axes: Axes, marks: Sequence[RungMark]) -> None:
    axes.set(xlabel="time of one force in a batch [us]", ylabel="relative error [1]")
    draw_marks(axes, marks, margins=(0.3, 6.0))
    label_marks(axes, marks)


# Chart of error against cost of the models of a film's heat, a panel for each bearing.


HEAT_COLORS = {
    HeatModel.SUPPLY: "#d62728",
    HeatModel.BALANCE: "#000000",
    HeatModel.HOUSING: "#7f7f7f",
    HeatModel.ADIABATIC: "#17becf",
    HeatModel.BUSH: "#1f4fb4",
    HeatModel.LAYERS: "#2ca02c",
}
PANEL = (7.0, 4.6)
"""Width and height of a panel [inch]."""


def plot_heat_accuracy(result: HeatAccuracy) -> list[Axes]:
    """Draw the models of heat over the cost of an equilibrium: error of the position, and of the power.

    Parameters
    ----------
    result : HeatAccuracy

    Returns
    -------
    list of Axes
        Of one figure, one for each bearing.
    """
    count = len(result.ladders)
    columns = min(2, count)
    rows = math.ceil(count / columns)
    figure = new_figure(size=(columns * PANEL[0], rows * PANEL[1] + 1.0))
    shown = [figure.add_subplot(rows, columns, k + 1) for k in range(count)]
    figure.suptitle(
        "Films that warm: error of an equilibrium against its cost\n"
        f"reference: {result.reference}, its walls a steel bush and an insulated journal",
        fontsize=11,
    )
    dots = [
        Line2D([], [], marker="o", linestyle="", color="0.3", label="position of the journal"),
        Line2D([], [], marker="o", linestyle="", color="0.3", markerfacecolor="w", label="power loss"),
    ]
    figure.legend(handles=dots, loc="outside lower center", ncols=2, fontsize=8.5, frameon=False)
    for axes, ladder in zip(shown, result.ladders, strict=True):
        _draw_heat(axes, ladder)
    for axes, ladder in zip(shown, result.ladders, strict=True):
        label_marks(axes, _marks(ladder))
    return shown


def _draw_heat(axes: Axes, ladder: HeatLadder) -> None:
    marks = _marks(ladder)
    draw_marks(axes, marks, margins=(0.4, 4.0))
    errors = [error for rung in ladder.rungs for error in (rung.position_error, rung.power_error)]
    axes.set_ylim(0.4 * min(errors), 3.0 * max(errors))
    axes.set(xlabel="CPU time of an equilibrium with its coefficients [ms]", ylabel="relative error [1]")
    E, Pe, Na = ladder.numbers
    axes.set_title(f"{ladder.case.name}: E = {E:.2g}, Pe = {Pe:.2g}, Na = {Na:.2g}", fontsize=10)


def _marks(ladder: HeatLadder) -> list[RungMark]:
    return [
        RungMark(
            1e3 * rung.cost, rung.position_error, rung.power_error, rung.model.said, HEAT_COLORS[rung.model]
        )
        for rung in ladder.rungs
    ]


# Chart of error against cost for the films of pads.


PAD_COLORS = {PadFamily.MAP: "#000000", PadFamily.GRID: "#1f4fb4"}


def plot_pad_accuracy(result: PadAccuracy) -> list[Axes]:
    """Draw the films of pads over the cost of a force, in a batch and alone.

    A filled dot is the 99th percentile of the error, an open one the median; the gray band is the distance of
    the reference from half its cells, 99 %.
    """
    figure = new_figure(size=(12.5, 6.9))
    shown = figure.subplots(1, 2, sharey=True)
    batch = [_mark(rung, rung.cost.force_time) for rung in result.rungs]
    alone = [_mark(rung, rung.cost.call_time) for rung in result.rungs]
    for axes, marks in zip(shown, (batch, alone), strict=True):
        axes.axhspan(1e-12, result.reference_high, color="0.85", zorder=0)
        draw_marks(axes, marks, margins=(0.4, 4.0))
    shown[0].set(
        xlabel="time of the force of one pad in a batch [us]", ylabel="relative error of the force [1]"
    )
    shown[1].set(xlabel="time of the force of one pad, state by state through prepare() [us]")
    shown[0].set_ylim(0.5 * _lowest(result.rungs), 3.0 * max(rung.high_error for rung in result.rungs))
    figure.suptitle(_title(result), fontsize=10.5)
    for axes, marks in zip(shown, (batch, alone), strict=True):
        label_marks(axes, marks)
    return list(shown)


def _mark(rung: PadRung, cost: float) -> RungMark:
    return RungMark(1e6 * cost, rung.high_error, rung.median_error, rung.name, PAD_COLORS[rung.family])


def _lowest(rungs: Sequence[PadRung]) -> float:
    return min(rung.median_error for rung in rungs)


def _title(result: PadAccuracy) -> str:
    return (
        f"Films of pads at L/D = {result.slenderness:g}: error of the force of a bearing against its cost\n"
        f"{', '.join(result.bearings)}\n"
        f"{result.states} random states of each (seed {result.seed}), filled 99 %, open median\n"
        f"reference: {result.reference}; 99 % within {result.reference_high:.1e} of half its cells"
    )


# Charts of the ladder of contact models, and of the limits of the published scheme.


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
