"""Pictures of studies: one function describes all, from a record of each."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import cycle, islice, pairwise
from typing import Any, NamedTuple

import numpy as np

from ..studies import FilmFamily, HeatModel, StudyResult, StudyRow, pareto_front
from .canvas import FAMILY_COLORS, FRONT
from .picture import CurveMark, LevelMark, Mark, NoteMark, Picture, PicturePanel

Line = tuple[str, str, str]
"""Color, line and mark."""

IN_TURN = tuple((f"C{number}", "-", mark) for number, mark in enumerate("osD^vx*"))
"""Lines of families that have none of their own."""


ROUND_OFF = 1e-9
"""Share of the largest entry below which one that may have either sign is not drawn."""


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
        Scale of the second axis, "log" or "linear", or "sizes", logarithmic with negative values dotted;
        that of the first is logarithmic.
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
    reference : str
        What the title calls the reference of the result.
    joined : bool
        Whether the rungs of a family are joined by a line, over all cases.
    band : str
        Condition with the error of the reference, below which errors mean nothing.
    champion : str
        Family whose gain over the others is shown.
    further : sequence of callable
        Describe further panels of the result.
    columns : int
        Panels in a row.
    size : (float, float) [inch]
        Size of a panel.
    """

    title: str
    panels: Sequence[StudyPanel]
    lines: Mapping[Any, str | Line] = field(default_factory=dict)
    in_turn: Sequence[Line] = IN_TURN
    reference: str = "reference"
    joined: bool = False
    band: str = ""
    champion: str = ""
    further: Sequence[Callable[[StudyResult], PicturePanel]] = ()
    columns: int = 2
    size: tuple[float, float] = (6.6, 6.2)

    def line(self, family: str, rungs: Sequence[StudyRow]) -> Line:
        """Return color, line and mark of a family among those of a study."""
        number = list(dict.fromkeys(rung.family for rung in rungs)).index(family)
        color, line, mark = next(islice(cycle(self.in_turn), number, None))
        found = self.lines.get(family, color)
        return (found, line, mark) if isinstance(found, str) else found


def plot_study(result: StudyResult) -> Picture:
    """Describe errors over costs of the models of a study.

    A filled dot is a high percentile of the error of a model, an open one its median. A gray band is the
    error of the reference, below which no error can be told.

    Parameters
    ----------
    result : StudyResult
    """
    style = STYLES[result.study]
    cases = [""] if style.joined else list(dict.fromkeys(rung.case for rung in result.rungs))
    panels = [_panel(result, style, panel, case) for panel in style.panels for case in cases]
    panels += [describe(result) for describe in style.further]
    last = min(style.columns, len(panels)) - 1
    panels[last] = panels[last]._replace(legend="beside")
    numbers = {name: value for name, value in result.notes.items() if isinstance(value, float)}
    told = {style.reference: result.reference, **result.conditions, **numbers}
    text = "; ".join(f"{name.partition(' [')[0]}: {_text(value)}" for name, value in told.items())
    rows = math.ceil(len(text) / int(11.0 * style.size[0] * (last + 1)))  # of about equal length
    lines = [style.title, *textwrap.wrap(text, math.ceil(1.1 * len(text) / rows))]
    return Picture(tuple(panels), style.columns, style.size, "\n".join(lines))


def _text(value: object) -> str:
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def _panel(result: StudyResult, style: StudyStyle, panel: StudyPanel, case: str) -> PicturePanel:
    rungs = [one for one in result.rungs if case in ("", one.case)]
    rungs = [one for one in rungs if one.family in (panel.families or (one.family,))]
    least = 0.0 if panel.scale == "log" else -math.inf
    shown = [one for one in rungs if one[panel.x] and one[panel.y] is not None and one[panel.y] > least]
    log = "x" if panel.scale == "linear" else "xy"
    y = f"{panel.y}, negative dotted" if panel.scale == "sizes" else panel.y
    found = PicturePanel((), panel.x, y, case, log=log, legend="none")
    families = {one.family: style.line(one.family, rungs) for one in rungs}
    if style.joined:
        return found._replace(marks=list(_joined(panel, families, rungs, shown)))
    y = f"{panel.y} filled, {panel.median} open" if panel.median else y
    band = result.conditions.get(style.band, 0.0)
    marks: list[Mark] = [LevelMark(1e-12, "error of the reference", "0.5", to=band)] if band else []
    if style.champion:
        marks += _fronts(panel, shown, style.champion)
    for family, (color, *_) in families.items():
        marks += _dots(panel, [one for one in shown if one.family == family], family, color)
    for one in shown:
        text, color = one.label or one.name, families[one.family][0]
        marks.append(NoteMark(one[panel.x], one[panel.y], text, color, clear=True))
    costs, errors = columns_of(shown, panel.x, panel.y)
    lowest = min(filter(None, (*errors, *(one[panel.median or panel.y] for one in shown), band)))
    bottom = 10.0 ** math.floor(math.log10(0.5 * lowest))
    ends = (0.4 * min(costs), 4.0 * max(costs)), (bottom, 6.0 * max(errors))
    return found._replace(marks=marks, y=y, x_limits=ends[0], y_limits=ends[1])


def columns_of(rungs: Sequence[StudyRow], x: str, y: str) -> tuple[list[float], list[float]]:
    """Return two columns of some rows."""
    return [rung[x] for rung in rungs], [rung[y] for rung in rungs]


def _dots(panel: StudyPanel, rungs: Sequence[StudyRow], family: str, color: str) -> Iterator[Mark]:
    x, high = columns_of(rungs, panel.x, panel.y)
    if panel.median:
        low = [one[panel.median] for one in rungs]
        pairs = np.array([low, high, np.full(len(low), np.nan)]).T.ravel()
        yield CurveMark(np.repeat(x, 3), pairs, "", color, width=0.6)
        yield CurveMark(x, low, "", color, "", marker="o", filled=False, size=4.5)
    yield CurveMark(x, high, family, color, "", marker="o", size=7.0)


def _joined(
    panel: StudyPanel, families: Mapping[str, Line], rungs: Sequence[StudyRow], shown: Sequence[StudyRow]
) -> Iterator[Mark]:
    for family, (color, line, mark) in families.items():
        x, values = columns_of([one for one in shown if one.family == family], panel.x, panel.y)
        y = np.array(values)
        if panel.scale == "sizes":
            largest = max(abs(one[panel.y]) for one in shown)
            y = np.where(np.abs(y) < ROUND_OFF * largest, np.nan, y)
            yield CurveMark(x, np.where(y < 0.0, -y, np.nan), "", color, ":", marker=mark)
            y = np.where(y < 0.0, np.nan, y)
        yield CurveMark(x, y, family, color, line, marker=mark)
        if panel.crossed:
            top = 3.0 * max(rung[panel.y] for rung in shown)
            bad = [one[panel.x] for one in rungs if one.family == family and one[panel.y] is None]
            yield CurveMark(bad, [top] * len(bad), "", color, "", marker="x")


def _fronts(panel: StudyPanel, rungs: Sequence[StudyRow], champion: str) -> Iterator[Mark]:
    """Yield the staircases below which no rung lies, with and without the champion, and what it gains."""
    others = [rung for rung in rungs if rung.family != champion]
    for shown, label, dash in (
        (rungs, "best at its cost", "-"),
        (others, f"the same without the {champion}", ":"),
    ):
        if shown:
            yield CurveMark(*_staircase(panel, shown), label, FRONT, dash, 1.3)
    first = [rung for rung in rungs if rung.family == champion]
    if not first or not others:
        return
    best = min(others, key=lambda rung: float(rung[panel.y]))
    ends, level = (first[0][panel.x], best[panel.x]), best[panel.y]
    yield CurveMark(ends, [level, level], "", FRONT, "--", 1.0)
    gain = f"{champion} {_rounded(ends[1] / ends[0])} times cheaper"
    yield NoteMark((ends[0] * ends[1]) ** 0.5, level, gain, FRONT)


def _staircase(panel: StudyPanel, rungs: Sequence[StudyRow]) -> tuple[list[float], list[float]]:
    costs, errors = columns_of(rungs, panel.x, panel.y)
    corners = [(costs[i], errors[i]) for i in pareto_front(costs, errors)]
    x, y = [corners[0][0]], [1e6]
    for (_, high), (x_next, y_next) in pairwise([(0.0, 1e6), *corners]):
        x += [x_next, x_next]
        y += [high, y_next]
    return [*x, 1e9], [*y, y[-1]]


def _rounded(ratio: float) -> str:
    """Return a ratio with two digits, thousands apart."""
    digits = max(0, math.floor(math.log10(ratio)) - 1)
    return f"{round(ratio, -digits):,.0f}".replace(",", " ")


# Further panels of the melting bush: the runs of its models, the closed form of the shaft.


def _bush_angles(result: StudyResult) -> PicturePanel:
    """Describe the contact angle by the last model of each family, and by the reference."""
    times, last = result.notes["times"], {rung.family: rung for rung in result.rungs}.values()
    marks = []
    for k, one in enumerate(last):
        assert one.answer is not None
        marks.append(CurveMark(times, one.answer, one.name, f"C{k}"))
    marks.append(CurveMark(times, result.notes["exact"], "reference", "k", ":"))
    return PicturePanel(marks, "time [s]", "half contact angle [rad]", "Growing load")


def _shaft_flux(result: StudyResult) -> PicturePanel:
    """Describe the error of the closed form (2.13) over the Biot number, by shaft radius / half length."""
    cooling, ratio, error = (np.array(column) for column in result.notes["shaft"].values())
    marks = [
        CurveMark(cooling[ratio == one], 100.0 * error[ratio == one], f"R_1/l = {one:g}", f"C{k}")
        for k, one in enumerate(dict.fromkeys(ratio.tolist()))
    ]
    text = "Biot number of the shaft", "error against the mixed problem [%]"
    return PicturePanel(marks, *text, "Closed form of the shaft heat (2.13)", y_limits=(0.0, None))


# The record of each study.


HIGH, MEDIAN = "99 % error [1]", "median error [1]"
BATCH, ALONE = "force in a batch [s]", "force alone, prepare() [s]"
PAD_BATCH, PAD_ALONE = "force of a pad in a batch [s]", "force of a pad alone, prepare() [s]"
SHORT = "99 % error against the short film [1]"
BAND = "reference error, 99 % [1]"
S = "S over the assembled clearance [1]"

ENTRIES = {"xx": "log", "xy": "sizes", "yx": "sizes", "yy": "log"}
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
        size=(7.0, 4.6),
    ),
    "rolling_ladder": StudyStyle(
        title="Models of ball bearings: error of the stiffness against its cost",
        panels=(StudyPanel("force and derivatives [s]", "90 % error of K [1]", "median error of K [1]"),),
        size=(7.6, 4.8),
    ),
    "bush": StudyStyle(
        title="Models of the polymer bush under a growing load",
        panels=(StudyPanel("time of the run [s]", "angle error [1]"),),
        joined=True,
        further=(_bush_angles, _shaft_flux),
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
        reference="definitions",
        joined=True,
        columns=4,
        size=(3.75, 3.6),
    ),
}
"""How each study is drawn, by its name."""
