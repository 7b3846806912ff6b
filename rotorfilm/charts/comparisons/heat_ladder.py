"""Chart of error against cost of the models of a film's heat, a panel for each bearing."""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ...comparisons import HeatAccuracy, HeatLadder, HeatModel
from ..canvas import new_figure
from .rung_marks import RungMark, draw_marks, label_marks

COLORS = {
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
        _draw(axes, ladder)
    for axes, ladder in zip(shown, result.ladders, strict=True):
        label_marks(axes, _marks(ladder))
    return shown


def _draw(axes: Axes, ladder: HeatLadder) -> None:
    marks = _marks(ladder)
    draw_marks(axes, marks, margins=(0.4, 4.0))
    errors = [error for rung in ladder.rungs for error in (rung.position_error, rung.power_error)]
    axes.set_ylim(0.4 * min(errors), 3.0 * max(errors))
    axes.set(xlabel="CPU time of an equilibrium with its coefficients [ms]", ylabel="relative error [1]")
    E, Pe, Na = ladder.numbers
    axes.set_title(f"{ladder.case.name}: E = {E:.2g}, Pe = {Pe:.2g}, Na = {Na:.2g}", fontsize=10)


def _marks(ladder: HeatLadder) -> list[RungMark]:
    return [
        RungMark(1e3 * rung.cost, rung.position_error, rung.power_error, rung.model.said, COLORS[rung.model])
        for rung in ladder.rungs
    ]
