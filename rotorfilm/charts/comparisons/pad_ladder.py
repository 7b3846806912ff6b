"""Chart of error against cost for the films of pads."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes

from ...comparisons import PadAccuracy, PadFamily, PadRung
from ..canvas import new_figure
from .rung_marks import RungMark, draw_marks, label_marks

COLORS = {PadFamily.MAP: "#000000", PadFamily.GRID: "#1f4fb4"}


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
    return RungMark(1e6 * cost, rung.high_error, rung.median_error, rung.name, COLORS[rung.family])


def _lowest(rungs: Sequence[PadRung]) -> float:
    return min(rung.median_error for rung in rungs)


def _title(result: PadAccuracy) -> str:
    return (
        f"Films of pads at L/D = {result.slenderness:g}: error of the force of a bearing against its cost\n"
        f"{', '.join(result.bearings)}\n"
        f"{result.states} random states of each (seed {result.seed}), filled 99 %, open median\n"
        f"reference: {result.reference}; 99 % within {result.reference_high:.1e} of half its cells"
    )
