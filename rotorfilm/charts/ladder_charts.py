"""Charts of studies: one function draws all, from a record of each."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import cycle, islice, pairwise
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..studies import FilmFamily, HeatModel, StudyResult, StudyRow, pareto_front
from .canvas import FAMILY_COLORS, FRONT, Label, new_grid, place_labels

Line = tuple[str, str, str]
"""Color, line and mark."""

IN_TURN = tuple((f"C{number}", "-", mark) for number, mark in enumerate("osD^v<>"))
"""Lines of families that have none of their own."""


class StudyPanel(NamedTuple):
    """The columns that a panel draws, by their headings, and of which families of a case.

    Attributes
    ----------
    x, y : str
        Cost and error.
    median : str
        A second error, drawn as an open dot.
    families : sequence
        Those drawn; all if empty.
    crossed : bool
        Whether runs without an error are drawn as crosses at the top.
    scale : str
        Scale of the second axis; that of the first is logarithmic.
    """

    x: str
    y: str
    median: str = ""
    families: Sequence[str] = ()
    crossed: bool = False
    scale: str = "log"


@dataclass(frozen=True, kw_only=True)
class StudyStyle:
    """How a study is drawn.

    Attributes
    ----------
    title : str
    panels : sequence of StudyPanel
        Drawn for each case of the study.
    lines : mapping
        Color, or color, line and mark, by the family of a rung.
    in_turn : sequence of (str, str, str)
        Color, line and mark of families that are not among these.
    dots : (str, str)
        What a filled and an open dot mean.
    joined : bool
        Whether the rungs of a family are joined by a line, over all cases.
    legend_below : bool
        Whether the legend of joined rungs is below all panels.
    labels : bool
        Whether marks have labels.
    band : str
        Condition with the error of the reference, below which errors mean nothing.
    champion : str
        Family whose gain over the others is shown.
    further : sequence of callable
        Draw the result into further panels.
    columns : int
        Panels in a row.
    size : (float, float) [inch]
        Size of a panel.
    """

    title: str
    panels: Sequence[StudyPanel]
    lines: Mapping[Any, str | Line] = field(default_factory=dict)
    in_turn: Sequence[Line] = IN_TURN
    dots: tuple[str, str] = ("99 % of the states", "median")
    joined: bool = False
    legend_below: bool = False
    labels: bool = True
    band: str = ""
    champion: str = ""
    further: Sequence[Callable[[Axes, StudyResult], object]] = ()
    columns: int = 2
    size: tuple[float, float] = (6.6, 6.2)


class DrawnPanel(NamedTuple):
    """One panel of a result: where it is drawn, what, how, and of which rungs."""

    axes: Axes
    panel: StudyPanel
    style: StudyStyle
    rungs: Sequence[StudyRow]
    band: float

    @property
    def shown(self) -> list[StudyRow]:
        """Rungs that have an error and a cost."""
        x, y = self.panel.x, self.panel.y
        least = 0.0 if self.panel.scale == "log" else -math.inf
        return [rung for rung in self.rungs if rung[x] and rung[y] is not None and rung[y] > least]

    def line(self, family: str) -> Line:
        """Return color, line and mark of a family."""
        number = list(dict.fromkeys(rung.family for rung in self.rungs)).index(family)
        color, line, mark = next(islice(cycle(self.style.in_turn), number, None))
        found = self.style.lines.get(family, color)
        return (found, line, mark) if isinstance(found, str) else found


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
    style = STYLES[result.study]
    cases = [""] if style.joined else list(dict.fromkeys(rung.case for rung in result.rungs))
    wanted = [(case, panel) for panel in style.panels for case in cases][: None if axes is None else 1]
    shown = _new_axes(result, style, len(wanted)) if axes is None else [axes]
    drawn = []
    for one, (case, panel) in zip(shown, wanted, strict=False):
        rungs = [rung for rung in result.rungs if case in ("", rung.case)]
        rungs = [rung for rung in rungs if rung.family in (panel.families or (rung.family,))]
        drawn.append(DrawnPanel(one, panel, style, rungs, result.conditions.get(style.band, 0.0)))
        one.set_title(case, fontsize=10)
        _draw_panel(drawn[-1])
    for one, draw in zip(shown[len(wanted) :], style.further, strict=False):
        draw(one, result)
    _add_legend(drawn[0], result, alone=axes is not None)
    for each in drawn:
        _write_labels(each)
    return shown


def _new_axes(result: StudyResult, style: StudyStyle, panels: int) -> list[Axes]:
    count = panels + len(style.further)
    numbers = {name: value for name, value in result.notes.items() if isinstance(value, float)}
    told = {"reference [-]": result.reference, **result.conditions, **numbers}
    texts = (f"{name.partition(' [')[0]}: {_text(value)}" for name, value in told.items())
    width = style.size[0] * min(style.columns, count)
    lines = [style.title, *textwrap.wrap("; ".join(texts), int(11.0 * width))]
    return new_grid(count, columns=style.columns, size=style.size, title="\n".join(lines), more=1.2)


def _text(value: object) -> str:
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def _draw_panel(drawn: DrawnPanel) -> None:
    axes, panel, style, _, band = drawn
    axes.set(xscale="log", xlabel=panel.x, ylabel=panel.y)
    axes.set_yscale(panel.scale, **({"linthresh": 1.0} if panel.scale == "symlog" else {}))
    axes.grid(visible=True, which="major", alpha=0.3)
    if style.joined:
        _draw_families(drawn)
        return
    if band:
        axes.axhspan(1e-12, band, color="0.85", zorder=0)
    for rung in drawn.shown:
        _draw_rung(axes, panel, rung, drawn.line(rung.family)[0])
    costs, errors = ([rung[name] for rung in drawn.shown] for name in (panel.x, panel.y))
    errors += [rung[panel.median] for rung in drawn.shown if panel.median]
    axes.set_xlim(0.4 * min(costs), 4.0 * max(costs))
    lowest = min(filter(None, (*errors, band)))
    axes.set_ylim(10.0 ** np.floor(np.log10(0.5 * lowest)), 6.0 * max(errors))
    if style.champion:
        _draw_front(axes, panel, drawn.shown, "-")
        _draw_front(axes, panel, [rung for rung in drawn.shown if rung.family != style.champion], ":")


def _draw_rung(axes: Axes, panel: StudyPanel, rung: StudyRow, color: str) -> None:
    x, high = rung[panel.x], rung[panel.y]
    if panel.median:
        axes.plot([x, x], [rung[panel.median], high], "-", color=color, linewidth=1.0, alpha=0.5)
        axes.plot(x, rung[panel.median], "o", color=color, markerfacecolor="white", markersize=4.5)
    axes.plot(x, high, "o", color=color, markersize=7)


def _draw_families(drawn: DrawnPanel) -> None:
    axes, panel, _, rungs, _ = drawn
    for family in dict.fromkeys(rung.family for rung in rungs):
        good = [rung for rung in drawn.shown if rung.family == family]
        color, line, mark = drawn.line(family)
        points = ([rung[name] for rung in good] for name in (panel.x, panel.y))
        axes.plot(*points, line, marker=mark, color=color, label=family)
        if panel.crossed:
            top = 3.0 * max(rung[panel.y] for rung in drawn.shown)
            bad = [rung[panel.x] for rung in rungs if rung.family == family and rung[panel.y] is None]
            axes.plot(bad, [top] * len(bad), "x", color=color)


def _draw_front(axes: Axes, panel: StudyPanel, rungs: Sequence[StudyRow], style: str) -> None:
    """Draw the staircase below which no rung lies, by cost and error."""
    if not rungs:
        return
    costs, errors = ([rung[name] for rung in rungs] for name in (panel.x, panel.y))
    corners = [(costs[i], errors[i]) for i in pareto_front(costs, errors)]
    x, y = [corners[0][0]], [1e6]
    for (_, high), (x_next, y_next) in pairwise([(0.0, 1e6), *corners]):
        x += [x_next, x_next]
        y += [high, y_next]
    axes.plot([*x, 1e9], [*y, y[-1]], style, color=FRONT, linewidth=1.3, zorder=0.5)


def _write_labels(drawn: DrawnPanel) -> None:
    """Write the labels, once limits and size are final."""
    axes, panel, style, _, band = drawn
    if not style.labels:
        return
    labels = [
        Label(rung[panel.x], rung[panel.y], rung.label or rung.name, drawn.line(rung.family)[0])
        for rung in drawn.shown
    ]
    medians = [(rung[panel.x], rung[panel.median]) for rung in drawn.shown if panel.median]
    place_labels(axes, labels, obstacles=medians)
    if style.champion:
        _draw_gain(axes, panel, style, drawn.shown)
    if band:
        told = "gray: error of the reference "
        axes.text(0.99, 0.01, told, transform=axes.transAxes, ha="right", fontsize=8, color="0.35")


def _draw_gain(axes: Axes, panel: StudyPanel, style: StudyStyle, rungs: Sequence[StudyRow]) -> None:
    """Draw how much cheaper the champion is than the closest of the other rungs."""
    first = [rung for rung in rungs if rung.family == style.champion]
    others = [rung for rung in rungs if rung.family != style.champion]
    if not first or not others:
        return
    best = min(others, key=lambda rung: float(rung[panel.y]))
    ends, level = (first[0][panel.x], best[panel.x]), best[panel.y]
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


def _add_legend(drawn: DrawnPanel, result: StudyResult, *, alone: bool) -> None:
    axes, style = drawn.axes, drawn.style
    figure = axes.get_figure()
    assert isinstance(figure, Figure)
    below: dict[str, Any] = {"loc": "outside lower center", "fontsize": 8.5, "frameon": False}
    if style.joined:
        if style.legend_below:
            figure.legend(*axes.get_legend_handles_labels(), ncols=4, **below)
        else:
            axes.legend(fontsize=8)
        return
    dot = partial(Line2D, [], [], marker="o", linestyle="")
    families = dict.fromkeys(rung.family for rung in result.rungs if rung.family in style.lines)
    colors = {family: style.lines[family] for family in families}
    handles = [
        *(dot(color=color, label=family) for family, color in colors.items() if isinstance(color, str)),
        dot(color="0.3", label=style.dots[0]),
        dot(color="0.3", markerfacecolor="w", label=style.dots[1]),
    ]
    if style.champion:
        handles += [
            Line2D([], [], color=FRONT, label="best at its cost (99 %)"),
            Line2D([], [], color=FRONT, linestyle=":", label=f"the same without the {style.champion}"),
        ]
    if alone:
        axes.legend(handles=handles, fontsize=7.5, loc="upper right", framealpha=1.0)
    else:
        figure.legend(handles=handles, ncols=6, **below)


# Further panels of the melting bush: the runs of its models, the closed form of the shaft.


def _draw_bush_angles(axes: Axes, result: StudyResult) -> None:
    """Draw the contact angle by the last model of each family, and by the reference."""
    for rung in {rung.family: rung for rung in result.rungs}.values():
        assert rung.answer is not None
        axes.plot(result.notes["times"], rung.answer, label=rung.name)
    axes.plot(result.notes["times"], result.notes["exact"], "k:", label="reference")
    axes.set(xlabel="time [s]", ylabel="half contact angle [rad]", title="Growing load")
    axes.grid(visible=True, alpha=0.3)
    axes.legend(fontsize=7.5)


def _draw_shaft_flux(axes: Axes, result: StudyResult) -> None:
    """Draw the error of the closed form (2.13) over the Biot number, by shaft radius / half length."""
    cooling, ratio, error = (np.array(column) for column in result.notes["shaft"].values())
    for one in dict.fromkeys(ratio.tolist()):
        axes.plot(cooling[ratio == one], 100.0 * error[ratio == one], label=f"R_1/l = {one:g}")
    axes.set(
        title="Closed form of the shaft heat (2.13)",
        xlabel="Biot number of the shaft",
        ylabel="error against the mixed problem [%]",
        ylim=(0.0, None),
    )
    axes.grid(visible=True, alpha=0.3)
    axes.legend(fontsize=7.5)


# The record of each study.


HIGH, MEDIAN = "99 % error [1]", "median error [1]"
BATCH, ALONE = "force in a batch [s]", "force alone, prepare() [s]"
PAD_BATCH, PAD_ALONE = "force of a pad in a batch [s]", "force of a pad alone, prepare() [s]"
SHORT = "99 % error against the short film [1]"
BAND = "reference error, 99 % [1]"
S = "S over the assembled clearance [1]"

ENTRIES = {"xx": "log", "xy": "symlog", "yx": "symlog", "yy": "log"}
"""Scales of the entries of a matrix: some change their sign."""

TYPE_LINES = (
    *((color, "-", "") for color in ("C0", "C1", "C2", "C3", "C4", "C8")),
    *((color, "--", "") for color in ("k", "C5")),
)
"""Of the types of bearings in turn; those of tilting pads are dashed."""

SCHEME_LINES: dict[str, Line] = {
    "Gauss-Seidel 0": ("#1f4fb4", "-", "o"),
    "Gauss-Seidel 1": ("#1f4fb4", "--", "s"),
    "Gauss-Seidel 2": ("#1f4fb4", ":", "^"),
    "Jacobi 0": ("#d62728", "-", "o"),
    "Jacobi 1": ("#d62728", "--", "s"),
    "Jacobi 2": ("#d62728", ":", "^"),
    "SI-exp": ("#2ca02c", "-", "D"),
    "SI-exp3": ("#000000", "-", "D"),
    "Newton": ("#ff7f0e", "-", "D"),
}
"""Of the coupling schemes: kinds by color, degrees by line."""

STYLES = {
    "journal": StudyStyle(
        title="Journal films: relative error of the force against its cost",
        panels=(StudyPanel(BATCH, HIGH, MEDIAN), StudyPanel(ALONE, HIGH, MEDIAN)),
        lines=FAMILY_COLORS,
        band=BAND,
        champion=FilmFamily.MAP,
    ),
    "pads": StudyStyle(
        title="Films of pads: relative error of the force of a bearing against its cost",
        panels=(StudyPanel(PAD_BATCH, HIGH, MEDIAN), StudyPanel(PAD_ALONE, HIGH, MEDIAN)),
        lines={"map": "#000000", "grid": "#1f4fb4"},
        band=BAND,
    ),
    "damper": StudyStyle(
        title="Squeeze films: relative error of the force against its cost",
        panels=(
            StudyPanel(BATCH, HIGH, MEDIAN),
            StudyPanel(BATCH, SHORT, families=("series", "map", "reduced")),
        ),
        lines={
            "series": "#2ca02c",
            "finite length": "#1f4fb4",
            "map": "#000000",
            "published": "#e377c2",
            "reduced": "#d62728",
        },
    ),
    "heat": StudyStyle(
        title="Films that warm: error of an equilibrium with its coefficients against its cost",
        panels=(StudyPanel("CPU time [s]", "error of the position [1]", "error of the power [1]"),),
        lines={
            HeatModel.SUPPLY: "#d62728",
            HeatModel.BALANCE: "#000000",
            HeatModel.HOUSING: "#7f7f7f",
            HeatModel.ADIABATIC: "#17becf",
            HeatModel.BUSH: "#1f4fb4",
            HeatModel.LAYERS: "#2ca02c",
        },
        dots=("position of the journal", "power loss"),
        size=(7.0, 4.6),
    ),
    "rolling_ladder": StudyStyle(
        title="Models of ball bearings: error of the stiffness against its cost",
        panels=(StudyPanel("force and derivatives [s]", "90 % error of K [1]", "median error of K [1]"),),
        dots=("90 % of the states", "median"),
        size=(7.6, 4.8),
    ),
    "bush": StudyStyle(
        title="Models of the polymer bush under a growing load",
        panels=(StudyPanel("time of the run [s]", "angle error [1]"),),
        joined=True,
        labels=False,
        further=(_draw_bush_angles, _draw_shaft_flux),
        columns=3,
        size=(5.0, 4.4),
    ),
    "contact": StudyStyle(
        title="Rolling ball, W = 1, load 1 + 0.5 sin 2t: error of delta / its motion against processor time",
        panels=(StudyPanel("cost [s]", "rms error of delta"),),
        joined=True,
        size=(9.0, 5.6),
    ),
    "cosim_cost": StudyStyle(
        title="Coupling schemes: error of the orbit / clearance; x: refused",
        panels=(
            StudyPanel("film_calls [1/turn]", "orbit_error [1]"),
            StudyPanel("macro_angle [deg]", "orbit_error [1]", crossed=True),
        ),
        lines=SCHEME_LINES,
        joined=True,
        labels=False,
        size=(5.5, 4.4),
    ),
    "bearings": StudyStyle(
        title="Bearings of one bore, load along -y; tilting pads at the frequency of the shaft",
        panels=(
            *(StudyPanel(S, f"K{ij} c/W [1]", scale=scale) for ij, scale in ENTRIES.items()),
            *(StudyPanel(S, f"C{ij} c speed/W [1]", scale=ENTRIES[ij]) for ij in ("xx", "xy", "yy")),
            StudyPanel(S, "least film/c [1]", scale="linear"),
        ),
        in_turn=TYPE_LINES,
        joined=True,
        legend_below=True,
        labels=False,
        columns=4,
        size=(3.75, 3.6),
    ),
}
"""How each study is drawn, by its name."""
