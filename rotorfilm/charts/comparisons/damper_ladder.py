"""Chart of error against cost for the ladder of squeeze films."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes

from ...comparisons import DamperAccuracy, DamperRung, SqueezeFamily
from ..canvas import new_figure
from .rung_marks import RungMark, draw_marks, label_marks

COLORS = {
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
        _draw(axes, [_mark(rung, rung.high_error, rung.median_error) for rung in rungs if rung.high_error])
        axes.set_title(f"{title}, against the film of finite length")
    short = [rung for rung in result.rungs if rung.cavitated and rung.family in SHORT and rung.series_error]
    _draw(shown[2], [_mark(rung, rung.series_error, None) for rung in short])
    shown[2].set_title("cavitated, against the whole series (short film)")
    figure.suptitle(
        f"Squeeze films at L/D = {result.slenderness:g}, Phi = {result.permeability_number:g}: error of the "
        f"force against its cost\n{result.states} random states (seed {result.seed}), eccentricity ratio to "
        "0.9; filled 99 %, open median",
        fontsize=11,
    )
    return list(shown)


def _mark(rung: DamperRung, high: float, median: float | None) -> RungMark:
    return RungMark(1e6 * rung.cost.force_time, high, median, rung.name, COLORS[rung.family])


def _draw(axes: Axes, marks: Sequence[RungMark]) -> None:
    axes.set(xlabel="time of one force in a batch [us]", ylabel="relative error [1]")
    draw_marks(axes, marks, margins=(0.3, 6.0))
    label_marks(axes, marks)
