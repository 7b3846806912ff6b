"""Chart of error against cost for the rungs of a ladder."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..studies import FilmFamily, JournalAccuracy, RungAccuracy, pareto_front
from .canvas import FAMILY_COLORS, FRONT, new_axes, new_figure
from .ladder_charts import RungMark, draw_marks, label_marks

Cost = Callable[[RungAccuracy], float]


def plot_journal_accuracy(result: JournalAccuracy) -> list[Axes]:
    """Draw the ladder of journal films twice: over the cost in a batch, and of a call for one state.

    A filled dot is the 99th percentile of the error of a rung, an open one its median. The gray band is
    the estimated error of the reference, 99 %, below which no error can be told.
    """
    figure = new_figure(size=(14.0, 7.6))
    batch, single = figure.subplots(1, 2, sharey=True)
    _draw(batch, result, _batch_time)
    _draw(single, result, _call_time)
    batch.set(xlabel="time of one force in a batch [us]", ylabel="relative error of the force [1]")
    single.set(xlabel="time of one force, called state by state from Python through prepare() [us]")
    figure.suptitle(_title(result), fontsize=11)
    figure.legend(handles=_legend(result), loc="outside lower center", ncols=6, fontsize=8.5, frameon=False)
    _limit_errors(batch, result)
    for axes, cost in ((batch, _batch_time), (single, _call_time)):
        _label(axes, result, cost)
    return [batch, single]


def plot_force_error(result: JournalAccuracy, *, axes: Axes | None = None) -> Axes:
    """Draw the ladder over the cost in a batch alone; the marks are those of `plot_journal_accuracy`.

    Parameters
    ----------
    result : JournalAccuracy
    axes : Axes, optional
        Where to draw, in a figure of its final size; a new figure by default.
    """
    axes = axes or new_axes("Error of the force against its cost", size=(8.0, 6.4))
    _draw(axes, result, _batch_time)
    axes.set(xlabel="time of one force in a batch [us]", ylabel="relative error of the force [1]")
    axes.legend(handles=_legend(result), fontsize=7.5, loc="upper right", framealpha=1.0)
    _limit_errors(axes, result)
    _label(axes, result, _batch_time)
    return axes


def _batch_time(rung: RungAccuracy) -> float:
    return 1e6 * rung.cost.force_time


def _call_time(rung: RungAccuracy) -> float:
    return 1e6 * rung.cost.call_time


def _marks(result: JournalAccuracy, cost: Cost) -> list[RungMark]:
    return [
        RungMark(
            cost(rung),
            rung.high_error,
            rung.median_error,
            rung.label or rung.family,
            FAMILY_COLORS[rung.family],
        )
        for rung in result.rungs
    ]


def _draw(axes: Axes, result: JournalAccuracy, cost: Cost) -> None:
    axes.axhspan(1e-12, result.reference_high, color="0.85", zorder=0)
    draw_marks(axes, _marks(result, cost), margins=(0.4, 4.0))
    maps, others = _maps_and_others(result)
    _draw_front(axes, result.rungs, cost, "-")
    if maps:
        _draw_front(axes, others, cost, ":")


def _maps_and_others(result: JournalAccuracy) -> tuple[list[RungAccuracy], list[RungAccuracy]]:
    maps = [rung for rung in result.rungs if rung.family == FilmFamily.MAP]
    return maps, [rung for rung in result.rungs if rung.family != FilmFamily.MAP]


def _draw_front(axes: Axes, rungs: Sequence[RungAccuracy], cost: Cost, style: str) -> None:
    """Draw the staircase below which no rung lies, by cost and 99 % error."""
    front = pareto_front([cost(rung) for rung in rungs], [rung.high_error for rung in rungs])
    corners = [(cost(rungs[i]), rungs[i].high_error) for i in front]
    x, y = [corners[0][0]], [1e6]
    for (_, high), (x_next, y_next) in pairwise([(0.0, 1e6), *corners]):
        x += [x_next, x_next]
        y += [high, y_next]
    axes.plot([*x, 1e9], [*y, y[-1]], style, color=FRONT, linewidth=1.3, zorder=0.5)


def _draw_gain(axes: Axes, result: JournalAccuracy, cost: Cost) -> None:
    """Draw how much cheaper the map is than the closest of the other rungs."""
    maps, others = _maps_and_others(result)
    if not maps or not others:
        return
    best = min(others, key=lambda rung: rung.high_error)
    ends, level = (cost(maps[0]), cost(best)), best.high_error
    arrow = {"arrowstyle": "<|-|>", "color": FRONT, "linewidth": 1.0, "shrinkA": 0.0, "shrinkB": 4.0}
    axes.annotate("", (ends[1], level), (ends[0], level), arrowprops=arrow)
    axes.text(
        (ends[0] * ends[1]) ** 0.5,
        1.15 * level,
        f"map {_rounded(ends[1] / ends[0])} times cheaper",
        ha="center",
        va="bottom",
        fontsize=8.5,
        color=FRONT,
    )


def _rounded(ratio: float) -> str:
    """Return a ratio with two digits, thousands apart."""
    digits = max(0, math.floor(math.log10(ratio)) - 1)
    return f"{round(ratio, -digits):,.0f}".replace(",", " ")


def _limit_errors(axes: Axes, result: JournalAccuracy) -> None:
    lowest = min(min(rung.median_error for rung in result.rungs), result.reference_high)
    highest = max(rung.high_error for rung in result.rungs)
    axes.set_ylim(10.0 ** np.floor(np.log10(0.5 * lowest)), 6.0 * highest)


def _label(axes: Axes, result: JournalAccuracy, cost: Cost) -> None:
    label_marks(axes, _marks(result, cost))
    _draw_gain(axes, result, cost)
    axes.text(
        0.99,
        result.reference_high,
        "error of the reference, 99 % ",
        transform=axes.get_yaxis_transform(),
        ha="right",
        va="top",
        fontsize=8,
        color="0.35",
    )


def _title(result: JournalAccuracy) -> str:
    return (
        f"Journal films at L/D = {result.slenderness:g}: error of the force against its cost\n"
        f"{result.states} random states (seed {result.seed}), {result.ranges.describe()}; "
        f"squeeze above wedge in {100.0 * result.squeeze_share:.0f} %\n"
        f"reference: {result.reference}; its own error {result.reference_median:.1e} median, "
        f"{result.reference_high:.1e} at 99 %"
    )


def _legend(result: JournalAccuracy) -> list[Line2D]:
    families = list(dict.fromkeys(rung.family for rung in result.rungs))
    dot = partial(Line2D, [], [], marker="o", linestyle="")
    return [
        *(dot(color=FAMILY_COLORS[family], label=family) for family in families),
        dot(color="0.3", label="99 % of the states"),
        dot(color="0.3", markerfacecolor="w", label="median"),
        Line2D([], [], color=FRONT, label="best at its cost (99 %)"),
        Line2D([], [], color=FRONT, linestyle=":", label="the same without the map"),
    ]
