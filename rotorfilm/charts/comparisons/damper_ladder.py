"""Chart of error against cost for the ladder of squeeze films."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes

from ...comparisons import DamperAccuracy, DamperRung
from ..canvas import new_figure
from ..labels import Label, place_labels

COLORS = {"series": "#2ca02c", "finite length": "#1f4fb4", "map": "#000000", "published": "#e377c2"}
OTHER = "#d62728"


def plot_damper_accuracy(result: DamperAccuracy) -> list[Axes]:
    """Draw the squeeze films over the cost of a force: against finite length, and against the series.

    A filled dot is the 99th percentile of the error, an open one the median.
    """
    figure = new_figure(size=(14.0, 7.0))
    shown = figure.subplots(1, 3)
    for axes, cavitated, title in zip(shown, (True, False), ("cavitated", "full film"), strict=False):
        rungs = [rung for rung in result.rungs if rung.cavitated is cavitated]
        _draw(axes, [(rung, rung.high_error, rung.median_error) for rung in rungs if rung.high_error > 0.0])
        axes.set_title(f"{title}, against the film of finite length")
    short = [rung for rung in result.rungs if rung.cavitated and rung.series_error > 0.0]
    kept = [rung for rung in short if rung.name.startswith(("series", "map", "Morgan", "solid"))]
    _draw(shown[2], [(rung, rung.series_error, None) for rung in kept])
    shown[2].set_title("cavitated, against the whole series (short film)")
    figure.suptitle(
        f"Squeeze films at L/D = {result.slenderness:g}, Phi = {result.permeability_number:g}: error of the "
        f"force against its cost\n{result.states} random states (seed {result.seed}), eccentricity ratio to "
        "0.9; filled 99 %, open median",
        fontsize=11,
    )
    return list(shown)


def _draw(axes: Axes, points: Sequence[tuple[DamperRung, float, float | None]]) -> None:
    axes.set(xscale="log", yscale="log")
    axes.grid(visible=True, which="major", alpha=0.3)
    axes.set(xlabel="time of one force in a batch [us]", ylabel="relative error [1]")
    labels, medians = [], []
    for rung, high, median in points:
        x, color = 1e6 * rung.cost.force_time, _color(rung.name)
        axes.plot(x, high, "o", color=color, markersize=7)
        if median is not None:
            axes.plot([x, x], [median, high], "-", color=color, linewidth=1.0, alpha=0.5)
            axes.plot(x, median, "o", color=color, markerfacecolor="white", markersize=4.5)
            medians.append((x, median))
        labels.append(Label(x, high, rung.name, color))
    times = [1e6 * rung.cost.force_time for rung, _, _ in points]
    axes.set_xlim(0.3 * min(times), 6.0 * max(times))
    place_labels(axes, labels, obstacles=medians)


def _color(name: str) -> str:
    return next((color for start, color in COLORS.items() if name.startswith(start)), OTHER)
