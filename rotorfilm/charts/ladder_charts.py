"""Error over cost of the models of a study: one function draws all, from a record of each."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..studies import FilmFamily, HeatModel, PadFamily, SqueezeFamily, StudyResult, StudyRung, pareto_front
from .canvas import FAMILY_COLORS, FRONT, Label, new_figure, place_labels
from .study_charts import SCHEME_LINES, draw_bush_angles, plot_shaft_flux_error

LINES = ("o-", "s-", "D-", "^-", "v-", "<-", ">-")
"""Marks of families that have no line of their own, in turn."""


def every(rung: StudyRung) -> bool:
    """Return that a rung is drawn."""
    return True


@dataclass(frozen=True, kw_only=True)
class StudyPanel:
    """One picture of a study: the columns that it draws, and of which rungs.

    Attributes
    ----------
    x, y : str
        Headings of the columns.
    factor : float
        Units of the label per unit of the column x.
    x_label, y_label, title : str
    median : str
        Heading of a second error, drawn as an open dot.
    chosen : callable
        Whether a rung is drawn.
    crossed : bool
        Whether runs without an error are drawn as crosses at the top.
    """

    x: str
    y: str
    factor: float = 1.0
    x_label: str
    y_label: str = "relative error [1]"
    title: str = ""
    median: str = ""
    chosen: Callable[[StudyRung], bool] = every
    crossed: bool = False


@dataclass(frozen=True, kw_only=True)
class StudyStyle:
    """How a study is drawn.

    Attributes
    ----------
    title : str
    panels : sequence of StudyPanel
    lines : mapping
        Color, or color, line and mark, by the family of a rung.
    dots : (str, str)
        What a filled and an open dot mean.
    joined : bool
        Whether the rungs of a family are joined by a line.
    labels : bool
        Whether marks have labels.
    band : float
        Error of the reference, below which errors mean nothing.
    champion : str
        Family whose gain over the others is shown.
    further : sequence of callable
        Draw the result into further panels.
    columns : int
        Panels in a row.
    size : (float, float) [inch]
        Of a panel.
    """

    title: str
    panels: Sequence[StudyPanel]
    lines: Mapping[str, str | tuple[str, str, str]] = field(default_factory=dict)
    dots: tuple[str, str] = ("99 % of the states", "median")
    joined: bool = False
    labels: bool = True
    band: float = 0.0
    champion: str = ""
    further: Sequence[Callable[[Axes, StudyResult], object]] = ()
    columns: int = 3
    size: tuple[float, float] = (6.6, 6.6)


def plot_study(result: StudyResult, *, axes: Axes | None = None) -> list[Axes]:
    """Draw errors over costs of the models of a study.

    A filled dot is a high percentile of the error of a model, an open one its median. A gray band is the
    error of the reference, below which no error can be told.

    Parameters
    ----------
    result : StudyResult
    axes : Axes, optional
        Where to draw the first panel alone, in a figure of its final size; a new figure with all by default.

    Returns
    -------
    list of Axes
    """
    style = STYLES[result.study](result)
    panels = list(style.panels) if axes is None else list(style.panels[:1])
    shown = _new_axes(style) if axes is None else [axes]
    for one, panel in zip(shown, panels, strict=False):
        _draw_panel(one, panel, style, result.rungs)
    for one, draw in zip(shown[len(panels) :], style.further, strict=False):
        draw(one, result)
    handles = _legend(result, style)
    if style.joined:
        shown[0].legend(fontsize=8)
    elif axes is None:
        figure = shown[0].get_figure()
        assert isinstance(figure, Figure)
        figure.legend(handles=handles, loc="outside lower center", ncols=6, fontsize=8.5, frameon=False)
    else:
        axes.legend(handles=handles, fontsize=7.5, loc="upper right", framealpha=1.0)
    for one, panel in zip(shown, panels, strict=False):
        _write_labels(one, panel, style, result.rungs)
    return shown


def _new_axes(style: StudyStyle) -> list[Axes]:
    count = len(style.panels) + len(style.further)
    columns = min(style.columns, count)
    rows = math.ceil(count / columns)
    figure = new_figure(size=(columns * style.size[0], rows * style.size[1] + 0.8))
    figure.suptitle(style.title, fontsize=11)
    return [figure.add_subplot(rows, columns, k + 1) for k in range(count)]


def _drawn(panel: StudyPanel, rungs: Sequence[StudyRung]) -> list[StudyRung]:
    """Return the rungs of a panel that have an error and a cost."""
    return [rung for rung in rungs if panel.chosen(rung) and rung[panel.y] and rung[panel.x]]


def _cost(panel: StudyPanel, rung: StudyRung) -> float:
    return float(panel.factor * rung[panel.x])


def _line(style: StudyStyle, family: str, number: int = 0) -> tuple[str, str, str]:
    """Return color, line and mark of a family."""
    found = style.lines.get(family, f"C{number}")
    mark, line = LINES[number % len(LINES)]
    return (found, line, mark) if isinstance(found, str) else found


def _draw_panel(axes: Axes, panel: StudyPanel, style: StudyStyle, rungs: Sequence[StudyRung]) -> None:
    drawn = _drawn(panel, rungs)
    errors = [rung[panel.y] for rung in drawn]
    medians = [rung[panel.median] for rung in drawn if panel.median and rung[panel.median]]
    axes.set(xscale="log", yscale="log", xlabel=panel.x_label, ylabel=panel.y_label)
    if panel.title:
        axes.set_title(panel.title, fontsize=10)
    axes.grid(visible=True, which="major", alpha=0.3)
    if style.band:
        axes.axhspan(1e-12, style.band, color="0.85", zorder=0)
    if style.joined:
        _draw_families(axes, panel, style, [rung for rung in rungs if panel.chosen(rung)])
    else:
        for rung in drawn:
            _draw_rung(axes, panel, rung, _line(style, rung.family)[0])
        costs = [_cost(panel, rung) for rung in drawn]
        axes.set_xlim(0.4 * min(costs), 4.0 * max(costs))
        lowest = min(filter(None, (*errors, *medians, style.band)))
        axes.set_ylim(10.0 ** np.floor(np.log10(0.5 * lowest)), 6.0 * max((*errors, *medians)))
    if style.champion:
        _draw_front(axes, panel, drawn, "-")
        _draw_front(axes, panel, [rung for rung in drawn if rung.family != style.champion], ":")


def _draw_rung(axes: Axes, panel: StudyPanel, rung: StudyRung, color: str) -> None:
    x, high = _cost(panel, rung), rung[panel.y]
    if panel.median:
        axes.plot([x, x], [rung[panel.median], high], "-", color=color, linewidth=1.0, alpha=0.5)
        axes.plot(x, rung[panel.median], "o", color=color, markerfacecolor="white", markersize=4.5)
    axes.plot(x, high, "o", color=color, markersize=7)


def _draw_families(axes: Axes, panel: StudyPanel, style: StudyStyle, rungs: Sequence[StudyRung]) -> None:
    top = 3.0 * max(rung[panel.y] for rung in _drawn(panel, rungs))
    for number, family in enumerate(dict.fromkeys(rung.family for rung in rungs)):
        own = [rung for rung in rungs if rung.family == family]
        good = _drawn(panel, own)
        color, line, mark = _line(style, family, number)
        points = [_cost(panel, rung) for rung in good], [rung[panel.y] for rung in good]
        axes.plot(*points, line, marker=mark, color=color, label=family)
        if panel.crossed:
            bad = [_cost(panel, rung) for rung in own if rung[panel.y] is None]
            axes.plot(bad, [top] * len(bad), "x", color=color)


def _draw_front(axes: Axes, panel: StudyPanel, rungs: Sequence[StudyRung], style: str) -> None:
    """Draw the staircase below which no rung lies, by cost and error."""
    if not rungs:
        return
    costs, errors = [_cost(panel, rung) for rung in rungs], [rung[panel.y] for rung in rungs]
    corners = [(costs[i], errors[i]) for i in pareto_front(costs, errors)]
    x, y = [corners[0][0]], [1e6]
    for (_, high), (x_next, y_next) in pairwise([(0.0, 1e6), *corners]):
        x += [x_next, x_next]
        y += [high, y_next]
    axes.plot([*x, 1e9], [*y, y[-1]], style, color=FRONT, linewidth=1.3, zorder=0.5)


def _write_labels(axes: Axes, panel: StudyPanel, style: StudyStyle, rungs: Sequence[StudyRung]) -> None:
    """Write the labels, once limits and size are final."""
    drawn = _drawn(panel, rungs)
    if not style.labels:
        return
    families = list(dict.fromkeys(rung.family for rung in drawn))
    numbers = {family: number for number, family in enumerate(families)} if style.joined else {}
    labels = [
        Label(
            _cost(panel, rung),
            rung[panel.y],
            rung.label or rung.name,
            _line(style, rung.family, numbers.get(rung.family, 0))[0],
        )
        for rung in drawn
    ]
    medians = [(_cost(panel, rung), rung[panel.median]) for rung in drawn if panel.median]
    place_labels(axes, labels, obstacles=medians)
    if style.champion:
        _draw_gain(axes, panel, style, drawn)
    if style.band:
        axes.text(
            0.99,
            style.band,
            "error of the reference ",
            transform=axes.get_yaxis_transform(),
            ha="right",
            va="top",
            fontsize=8,
            color="0.35",
        )


def _draw_gain(axes: Axes, panel: StudyPanel, style: StudyStyle, rungs: Sequence[StudyRung]) -> None:
    """Draw how much cheaper the champion is than the closest of the other rungs."""
    first = [rung for rung in rungs if rung.family == style.champion]
    others = [rung for rung in rungs if rung.family != style.champion]
    if not first or not others:
        return
    best = min(others, key=lambda rung: float(rung[panel.y]))
    ends, level = (_cost(panel, first[0]), _cost(panel, best)), best[panel.y]
    arrow = {"arrowstyle": "<|-|>", "color": FRONT, "linewidth": 1.0, "shrinkA": 0.0, "shrinkB": 4.0}
    axes.annotate("", (ends[1], level), (ends[0], level), arrowprops=arrow)
    axes.text(
        (ends[0] * ends[1]) ** 0.5,
        1.15 * level,
        f"{style.champion} {_rounded(ends[1] / ends[0])} times cheaper",
        ha="center",
        va="bottom",
        fontsize=8.5,
        color=FRONT,
    )


def _rounded(ratio: float) -> str:
    """Return a ratio with two digits, thousands apart."""
    digits = max(0, math.floor(math.log10(ratio)) - 1)
    return f"{round(ratio, -digits):,.0f}".replace(",", " ")


def _legend(result: StudyResult, style: StudyStyle) -> list[Line2D]:
    families = list(dict.fromkeys(rung.family for rung in result.rungs if rung.family in style.lines))
    dot = partial(Line2D, [], [], marker="o", linestyle="")
    front = [
        Line2D([], [], color=FRONT, label="best at its cost (99 %)"),
        Line2D([], [], color=FRONT, linestyle=":", label=f"the same without the {style.champion}"),
    ]
    return [
        *(dot(color=_line(style, family)[0], label=family) for family in families),
        dot(color="0.3", label=style.dots[0]),
        dot(color="0.3", markerfacecolor="w", label=style.dots[1]),
        *(front if style.champion else []),
    ]


# The record of each study.


HIGH, MEDIAN = "99 % error [1]", "median error [1]"
BATCH, ALONE = "force in a batch [s]", "force alone, prepare() [s]"


def _journal(result: StudyResult) -> StudyStyle:
    told, panel = result.conditions, partial(StudyPanel, y=HIGH, median=MEDIAN, factor=1e6)
    return StudyStyle(
        title=f"Journal films at L/D = {told['length/diameter [1]']:g}: error of the force against its cost\n"
        f"{told['states [1]']} random states (seed {told['seed [-]']}), {result.notes['ranges']}; "
        f"squeeze above wedge in {100.0 * told['squeeze above wedge [1]']:.0f} %\n"
        f"reference: {result.reference}; its own error {told['reference error, median [1]']:.1e} median, "
        f"{told['reference error, 99 % [1]']:.1e} at 99 %",
        panels=(
            panel(
                x=BATCH,
                x_label="time of one force in a batch [us]",
                y_label="relative error of the force [1]",
            ),
            panel(
                x=ALONE, x_label="time of one force, called state by state from Python through prepare() [us]"
            ),
        ),
        lines=FAMILY_COLORS,
        band=told["reference error, 99 % [1]"],
        champion=FilmFamily.MAP,
    )


def _pads(result: StudyResult) -> StudyStyle:
    told, panel = result.conditions, partial(StudyPanel, y=HIGH, median=MEDIAN, factor=1e6)
    high = told["reference error, 99 % [1]"]
    return StudyStyle(
        title=f"Films of pads at L/D = {told['length/diameter [1]']:g}: error of the force of a bearing "
        f"against its cost\n{told['bearings [-]']}\n"
        f"{told['states of each bearing [1]']} random states of each (seed {told['seed [-]']})\n"
        f"reference: {result.reference}; 99 % within {high:.1e} of half its cells",
        panels=(
            panel(
                x="force of a pad in a batch [s]",
                x_label="time of the force of one pad in a batch [us]",
                y_label="relative error of the force [1]",
            ),
            panel(
                x="force of a pad alone, prepare() [s]",
                x_label="time of the force of one pad, state by state through prepare() [us]",
            ),
        ),
        lines={PadFamily.MAP: "#000000", PadFamily.GRID: "#1f4fb4"},
        band=high,
    )


DAMPER_COLORS = {
    SqueezeFamily.SERIES: "#2ca02c",
    SqueezeFamily.FINITE: "#1f4fb4",
    SqueezeFamily.MAP: "#000000",
    SqueezeFamily.PUBLISHED: "#e377c2",
    SqueezeFamily.REDUCED: "#d62728",
}
SHORT = (SqueezeFamily.SERIES, SqueezeFamily.MAP, SqueezeFamily.REDUCED)
"""Families of short films."""


def _damper(result: StudyResult) -> StudyStyle:
    told = result.conditions
    panel = partial(StudyPanel, x=BATCH, factor=1e6, x_label="time of one force in a batch [us]")
    cavitated, full = dict.fromkeys(rung.case for rung in result.rungs)
    return StudyStyle(
        title=f"Squeeze films at L/D = {told['length/diameter [1]']:g}, "
        f"Phi = {told['permeability number [1]']:g}: error of the force against its cost\n"
        f"{told['states [1]']} random states (seed {told['seed [-]']}), eccentricity ratio to 0.9",
        panels=(
            *(
                panel(
                    y=HIGH,
                    median=MEDIAN,
                    chosen=lambda rung, case=case: rung.case == case,
                    title=f"{case}, against the film of finite length",
                )
                for case in (cavitated, full)
            ),
            panel(
                y="99 % error against the short film [1]",
                chosen=lambda rung: rung.case == cavitated and rung.family in SHORT,
                title=f"{cavitated}, against the whole series (short film)",
            ),
        ),
        lines=DAMPER_COLORS,
        size=(4.8, 6.6),
    )


HEAT_COLORS = {
    HeatModel.SUPPLY: "#d62728",
    HeatModel.BALANCE: "#000000",
    HeatModel.HOUSING: "#7f7f7f",
    HeatModel.ADIABATIC: "#17becf",
    HeatModel.BUSH: "#1f4fb4",
    HeatModel.LAYERS: "#2ca02c",
}


def _heat(result: StudyResult) -> StudyStyle:
    firsts = {rung.case: rung for rung in reversed(result.rungs)}
    return StudyStyle(
        title="Films that warm: error of an equilibrium against its cost\n"
        f"reference: {result.reference}, its walls a steel bush and an insulated journal",
        panels=tuple(
            StudyPanel(
                x="CPU time [s]",
                y="error of the position [1]",
                factor=1e3,
                median="error of the power [1]",
                x_label="CPU time of an equilibrium with its coefficients [ms]",
                chosen=lambda rung, case=case: rung.case == case,
                title=f"{case}: E = {rung['thinning x rise E [1]']:.2g}, "
                f"Pe = {rung['Peclet number [1]']:.2g}, Na = {rung['Nahme number [1]']:.2g}",
            )
            for case, rung in reversed(firsts.items())
        ),
        lines=HEAT_COLORS,
        dots=("position of the journal", "power loss"),
        columns=2,
        size=(7.0, 4.6),
    )


def _balls(result: StudyResult) -> StudyStyle:
    told = result.conditions
    return StudyStyle(
        title=f"Models of ball bearings, {told['states of each bearing [1]']} loads and speeds of two each",
        panels=(
            StudyPanel(
                x="force and derivatives [s]",
                y="90 % error of K [1]",
                median="median error of K [1]",
                factor=1e6,
                x_label="time of force and derivatives at one place [us]",
                y_label=f"error of K against {result.reference.partition(',')[0]} [1]",
            ),
        ),
        lines={"balls": "#1f4fb4"},
        dots=("90 % of the states", "median"),
        size=(7.6, 4.8),
    )


def _bush(result: StudyResult) -> StudyStyle:
    return StudyStyle(
        title="Models of the polymer bush under a growing load",
        panels=(
            StudyPanel(
                x="time of the run [s]",
                y="angle error [1]",
                factor=1e3,
                x_label="time of the run [ms]",
                y_label="largest error of the angle [1]",
                title="Error against cost",
            ),
        ),
        joined=True,
        labels=False,
        further=(
            draw_bush_angles,
            lambda axes, result: plot_shaft_flux_error(result.notes["shaft"], axes=axes),
        ),
        size=(5.0, 4.6),
    )


def _contact(result: StudyResult) -> StudyStyle:
    return StudyStyle(
        title="Rolling ball, W = 1, load 1 + 0.5 sin 2t: error against cost",
        panels=(
            StudyPanel(
                x="cost [s]",
                y="rms error of delta",
                x_label=f"processor time of {result.notes['duration']:g} units of time [s]; "
                f"reference: {result.reference}",
                y_label="rms error of delta / rms of its motion [1]",
            ),
        ),
        joined=True,
        size=(9.0, 5.8),
    )


def _coupling(result: StudyResult) -> StudyStyle:
    panel = partial(StudyPanel, y="orbit_error [1]", y_label="orbit error / clearance")
    return StudyStyle(
        title=f"Coupling schemes, orbit to eccentricity ratio {result.notes['eccentricity ratio']:.2f}",
        panels=(
            panel(x="film_calls [1/turn]", x_label="film evaluations and derivatives per turn"),
            panel(x="macro_angle [deg]", x_label="macro step [deg]; x: refused", crossed=True),
        ),
        lines=SCHEME_LINES,
        joined=True,
        labels=False,
        size=(5.5, 4.6),
    )


STYLES: dict[str, Callable[[StudyResult], StudyStyle]] = {
    "journal": _journal,
    "pads": _pads,
    "damper": _damper,
    "heat": _heat,
    "rolling_ladder": _balls,
    "bush": _bush,
    "contact": _contact,
    "cosim_cost": _coupling,
}
"""How each study is drawn, by its name."""
