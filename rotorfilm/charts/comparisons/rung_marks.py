"""Marks of the rungs of a ladder: error over cost, as filled and open dots with labels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from matplotlib.axes import Axes

from ..labels import Label, place_labels


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
