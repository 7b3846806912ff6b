"""The commands `rotorfilm chart ...`: a table of studies, each computed, drawn and written as PNG and CSV."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from functools import partial
from inspect import Parameter, Signature
from itertools import groupby
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from ..core.errors import visible
from ..core.limits import CHART_STATES, CONTACT_CELLS, TRANSITS
from ..core.progress import Report, part_of
from ..core.results import write_csv
from ..core.units import CELSIUS, parse_quantity
from . import printing as console
from .command import Argument, Option, Said

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..studies import StudyResult

DPI = 110
OUT = Path("rotorfilm-charts")
Folder = Annotated[Path, Option("--out", help="Folder for PNG and CSV; made if absent.")]

RPM = 30.0 / math.pi
POINTS = 25
"""Speeds of a curve of ball bearings."""

Rows = list[tuple[str, ...]]
Files = list[tuple[str, str]]


class MotionOption(StrEnum):
    """Ranges of random states."""

    LARGE = "large"
    SMALL = "small"


def draw_study(charts: Any, result: StudyResult) -> Sequence[Axes]:
    """Draw error against cost."""
    drawn: Sequence[Axes] = charts.plot_study(result)
    return drawn


class Picture(NamedTuple):
    """One result of a command and its picture: both files are called `chart_STEM`."""

    stem: str
    result: Callable[[Any, SimpleNamespace, Report], Any]
    draw: Callable[[Any, Any], Sequence[Axes]] = draw_study


class Printed(NamedTuple):
    """What is printed: headings, rows, and remarks below them."""

    headings: Sequence[str]
    rows: Iterable[Sequence[str]]
    remarks: Sequence[tuple[str, str]] = ()


class Shown(NamedTuple):
    """How a column of a study is printed: its heading in the CSV file, a format, a factor and a zero."""

    heading: str
    form: str
    factor: float = 1.0
    zero: float = 0.0

    def text(self, entry: float | None) -> str:
        """Return an entry as text."""
        return "" if entry is None else format(self.factor * entry - self.zero, self.form)


@dataclass(frozen=True, kw_only=True)
class Chart:
    """One command.

    Attributes
    ----------
    text : str
        Its help.
    options : mapping
        Annotation and default of each option, by its name.
    pictures : sequence of Picture
    table : callable
        Returns what is printed of the results.
    data : callable
        Returns what `--json` prints; the result by default, or the results by the names of their files.
    more : callable
        Writes further files of the results into a folder.
    """

    text: str
    options: Mapping[str, tuple[Any, object]] = field(default_factory=dict)
    pictures: Sequence[Picture]
    table: Callable[..., Printed]
    data: Callable[..., object] | None = None
    more: Callable[..., Files] = lambda out, charts, *results: []

    def run(self, *, report: Report, out: Path, **given: object) -> Said:
        """Compute the results, write their files, and return what to print."""
        from .. import charts, studies

        results, files, count = [], [], len(self.pictures)
        for number, picture in enumerate(self.pictures):
            share = part_of(report, number / count, (number + 1) / count)
            result = picture.result(studies, SimpleNamespace(**given), share)
            files += write_chart(out, picture.stem, result.columns(), picture.draw(charts, result))
            results.append(result)
        files += self.more(out, charts, *results)
        stems = [picture.stem for picture in self.pictures]
        data: object = dict(zip(stems, results, strict=True)) if count > 1 else results[0]
        if self.data is not None:
            data = self.data(*results)
        table = self.table(*results)
        rows = [tuple(row) for row in table.rows]
        return Said(data, partial(print_chart, table.headings, rows, [*table.remarks, *files]))


def write_chart(out: Path, stem: str, columns: Mapping[str, Iterable[object]], axes: Sequence[Axes]) -> Files:
    """Write chart and table; return the rows that name them."""
    from ..charts import save

    out.mkdir(parents=True, exist_ok=True)
    path = out / f"chart_{stem}.png"
    return [
        ("chart", str(save(axes[0], path, dpi=DPI))),
        ("table", str(write_csv(path.with_suffix(".csv"), columns))),
    ]


def print_chart(headings: Sequence[str], rows: Rows, files: Files) -> None:
    """Print a table, without headings if there are none, and files and remarks below it."""
    if headings:
        console.print_columns(headings, rows)
    else:
        console.print_rows("", rows)
    console.print_rows("", files)


def number(entry: object) -> str:
    """Return an entry of a table as text."""
    return f"{entry:.4g}" if isinstance(entry, float) else "" if entry is None else str(entry)


def written_data(out: Path, stem: str, data: object) -> Files:
    """Write data as JSON; return the row that names the file."""
    return [("data", str(console.write_json(out / f"chart_{stem}.json", data)))]


# What is printed of the results.


def study_table(model: str, shown: Mapping[str, Shown], *, last: int = -1) -> Callable[..., Printed]:
    """Return what prints a row for each rung of a study, below the name of its case if it has one."""

    def table(*results: StudyResult) -> Printed:
        result, rows = results[last], []
        for case, rungs in groupby(result.rungs, key=lambda rung: rung.case):
            if case:
                rows.append((case, *("" for _ in shown)))
            for rung in rungs:
                entries = (one.text(rung[one.heading]) for one in shown.values())
                rows.append((f"{'  ' if case else ''}{rung.name}", *entries))
        remarks = [("reference", result.reference)]
        floor = result.conditions.get("reference error, 99 % [1]")
        if floor is not None:
            remarks.append(("its error, 99 %", f"{floor:.1e}"))
        return Printed((model, *shown), rows, remarks)

    return table


def _stability_table(result: Any) -> Printed:
    from ..charts.whirl_verdicts import verdicts

    headings = ("film", "off by at most", "wrong at eps", "tension, large motion", "|Cxy - Cyx| / max |C|")
    rows = [(rung.name, *(cell.text for cell in verdicts(result, rung))) for rung in result.rungs]
    return Printed(headings, rows, [("reference", result.reference)])


def _bearings_table(film: Any, whirl: Any) -> Printed:
    shown = [0, len(whirl.load) // 2, len(whirl.load) - 1]
    headings = ("threshold [rpm] on", *(f"at {whirl.load[k]:.4g} N" for k in shown))
    rows = [
        (
            one.name,
            *(
                one.outcomes[k] if (speed := one.threshold_speed[k]) is None else f"{RPM * speed:.4g}"
                for k in shown
            ),
        )
        for one in whirl.types
    ]
    met = dict.fromkeys(outcome for one in whirl.types for outcome in one.outcomes)
    said = [(outcome, outcome.meaning) for outcome in met if outcome is not outcome.ONSET]
    return Printed(headings, rows, [("convention", film.convention), *said])


def _rolling_table(curves: Any, ladder: StudyResult) -> Printed:
    headings = (
        "preload [N]",
        f"running at {RPM * curves.speeds[-1]:.5g} rpm [N]",
        "radial [N/um]",
        "axial [N/um]",
    )
    last = (curves.running_preload, 1e-6 * curves.radial_stiffness, 1e-6 * curves.axial_stiffness)
    rows = [
        (number(preload), *(number(one[k, -1].item()) for one in last))
        for k, preload in enumerate(curves.preloads)
    ]
    errors = ("median error of K [1]", "90 % error of K [1]")
    return Printed(
        headings,
        rows,
        [
            (rung.name, "error of K: median {:.2g}, 90 % {:.2g}".format(*(rung[one] for one in errors)))
            for rung in ladder.rungs
        ],
    )


def _limits_table(atlas: Any) -> Printed:
    from ..studies import failures

    rows: Rows = []
    for panel, curves in groupby(failures(atlas), key=lambda one: one[0].panel):
        rows += [("", ""), (f"{panel.physics}: {panel.title}", ""), (f"fails from {panel.x_label}", "")]
        rows += [(f"  {limit.name}", "nowhere" if at is None else f"{at:.3g}") for limit, at in curves]
    return Printed((), rows)


def _plain_table(result: Any) -> Printed:
    table = result.columns()
    return Printed(
        tuple(table), [[number(entry) for entry in row] for row in zip(*table.values(), strict=True)]
    )


def _cases_table(result: Any) -> Printed:
    headings = ("statement", "section", "published scheme", "same grid", "converged", "verdict")
    rows = [
        (row.text, row.section, row.published, row.same_grid, row.converged, row.verdict)
        for row in result.statements
    ]
    return Printed(headings, rows)


# Further files.


def _limit_pictures(out: Path, charts: Any, atlas: Any) -> Files:
    files = written_data(out, "limits", atlas.columns())
    for name, axes in charts.plot_limits(atlas).items():
        files.append((name, str(charts.save(axes[0], out / f"chart_limits_{name}.png", dpi=DPI))))
    return files


def _heated_film(out: Path, charts: Any, *_: object) -> Files:
    from ..studies import HEAT_CASES
    from ..studies.heat_accuracy import heated_film

    case = HEAT_CASES[1]
    pictures = charts.plot_heated_film(heated_film(case), title=f"Film that warms: {case.name}")
    return [("film", str(charts.save(pictures[0], out / "chart_heat_film.png", dpi=DPI)))]


def _shaft_table(out: Path, charts: ModuleType, result: StudyResult) -> Files:
    from ..studies.bush_tiers import shaft_columns

    shaft = result.notes["shaft"]
    errors = [100.0 * row.error for row in shaft]
    return [
        ("closed form of the shaft", f"{min(errors):.2f} to {max(errors):.2f} % high"),
        ("its table", str(write_csv(out / "chart_bush_shaft.csv", shaft_columns(shaft)))),
    ]


# The table of the commands.


LD = Annotated[float, Option("--ld", help="Bearing length / diameter, 0.1 to 4.")]
States = Annotated[int, Option(help="Random states, of each bearing.", min=1, max=CHART_STATES)]
SEED = Annotated[int, Option(help="Seed of the random states.", min=0)]
MICRO = 1e6

CHARTS = {
    "journal": Chart(
        text="Error of the force against its cost, for every journal film: chart_journal.png and .csv.",
        options={
            "ld": (LD, 0.5),
            "states": (States, 300),
            "seed": (SEED, 1978),
            "motion": (
                Annotated[MotionOption, Option(help="Range of the states' velocities.")],
                MotionOption.LARGE,
            ),
        },
        pictures=[
            Picture(
                "journal",
                lambda studies, given, report: studies.journal_accuracy(
                    given.ld,
                    states=given.states,
                    ranges=studies.LARGE if given.motion is MotionOption.LARGE else studies.SMALL,
                    seed=given.seed,
                    report=report,
                ),
            )
        ],
        table=study_table(
            "film",
            {
                "median error": Shown("median error [1]", ".2e"),
                "99 % error": Shown("99 % error [1]", ".2e"),
                "batch [us]": Shown("force in a batch [s]", ".3g", MICRO),
                "alone [us]": Shown("force alone, prepare() [s]", ".3g", MICRO),
            },
        ),
    ),
    "stability": Chart(
        text="Whirl threshold by every journal film, and where each fails: chart_stability.png and .csv.",
        options={"ld": (LD, 0.5)},
        pictures=[
            Picture(
                "stability",
                lambda studies, given, report: studies.journal_stability(given.ld, report=report),
                lambda charts, result: charts.plot_journal_stability(result),
            )
        ],
        table=_stability_table,
    ),
    "bearings": Chart(
        text="Types of bearings: K and C over the Sommerfeld number, whirl threshold over the load.",
        options={
            "ld": (LD, 0.5),
            "mass": (
                Annotated[str, Option(help="Mass of the rigid rotor that a bearing carries.")],
                "250 kg",
            ),
        },
        pictures=[
            Picture(
                "bearings",
                lambda studies, given, report: studies.bearing_coefficients(given.ld, report=report),
                lambda charts, result: charts.plot_bearing_coefficients(result),
            ),
            Picture(
                "whirl",
                lambda studies, given, report: studies.bearing_thresholds(
                    given.ld, mass=parse_quantity(given.mass, "kg"), report=report
                ),
                lambda charts, result: [charts.plot_bearing_thresholds(result)],
            ),
        ],
        table=_bearings_table,
        data=lambda film, whirl: {"coefficients": film, "thresholds": whirl},
    ),
    "pads": Chart(
        text="Error of the force against its cost, for maps and grids of pads: chart_pads.png and .csv.",
        options={"ld": (LD, 0.5), "states": (States, 100), "seed": (SEED, 1978)},
        pictures=[
            Picture(
                "pads",
                lambda studies, given, report: studies.pad_accuracy(
                    given.ld, states=given.states, seed=given.seed, report=report
                ),
            )
        ],
        table=study_table(
            "film",
            {
                "median error": Shown("median error [1]", ".2e"),
                "90 % error": Shown("90 % error [1]", ".2e"),
                "99 % error": Shown("99 % error [1]", ".2e"),
                "batch [us]": Shown("force of a pad in a batch [s]", ".3g", MICRO),
                "alone [us]": Shown("force of a pad alone, prepare() [s]", ".3g", MICRO),
            },
        ),
    ),
    "rolling": Chart(
        text="Ball bearings: loads, contact angles, stiffness over speed and preload; error against cost.",
        options={
            "speed": (
                Annotated[str, Option(help="Highest speed of a usual hybrid bearing of a spindle.")],
                "30000 rpm",
            ),
            "states": (States, 40),
            "seed": (SEED, 1907),
        },
        pictures=[
            Picture(
                "rolling",
                lambda studies, given, report: studies.ball_curves(
                    studies.usual_bearing(),
                    [k * parse_quantity(given.speed, "rad/s") / (POINTS - 1) for k in range(POINTS)],
                    report=report,
                ),
                lambda charts, result: charts.plot_ball_curves(result),
            ),
            Picture(
                "rolling_ladder",
                lambda studies, given, report: studies.ball_accuracy(
                    given.states, seed=given.seed, report=report
                ),
            ),
        ],
        table=_rolling_table,
        data=lambda curves, ladder: {"curves": curves, "ladder": ladder},
    ),
    "contact": Chart(
        text="Error of a rolling ball's motion against its cost: scheme, step, grid, reduced laws. Minutes.",
        options={
            "cells": (
                Annotated[
                    int, Option(help="Cells along each side of the reference.", min=24, max=CONTACT_CELLS)
                ],
                64,
            )
        },
        pictures=[
            Picture(
                "contact",
                lambda studies, given, report: studies.contact_precision(given.cells, report=report),
            )
        ],
        table=study_table(
            "model", {"rms error": Shown("rms error of delta", ".2e"), "cost [s]": Shown("cost [s]", ".3g")}
        ),
    ),
    "contact_cases": Chart(
        text="Published cases of a rolling ball, by the published scheme and converged. Some ten minutes.",
        options={
            "cells": (
                Annotated[
                    int, Option(help="Cells along each side, converged runs.", min=8, max=CONTACT_CELLS)
                ],
                40,
            ),
            "tolerance": (Annotated[float, Option(help="Of the steps of converged runs.")], 1e-4),
            "settle": (
                Annotated[
                    float, Option(help="Length of the runs of case 4.3 with W = 1.", min=30.0, max=TRANSITS)
                ],
                60.0,
            ),
        },
        pictures=[
            Picture(
                "contact_cases",
                lambda studies, given, report: studies.contact_cases(
                    given.cells, given.tolerance, given.settle, report=report
                ),
                lambda charts, result: charts.plot_contact_cases(result),
            )
        ],
        table=_cases_table,
        data=lambda result: [row._asdict() for row in result.statements],
        more=lambda out, charts, result: [
            ("curves", str(write_csv(out / "chart_contact_curves.csv", result.series())))
        ],
    ),
    "contact_limits": Chart(
        text="Where the published scheme of a rolling ball fails, and how it decays by itself. A minute.",
        pictures=[
            Picture(
                "contact_limits",
                lambda studies, given, report: studies.contact_limits(report=report),
                lambda charts, result: charts.plot_contact_limits(result),
            )
        ],
        table=_plain_table,
        data=lambda result: result.columns(),
    ),
    "limits": Chart(
        text="Atlas of where methods fail, a picture for each physics and a summary of all. Ten seconds.",
        options={
            "physics": (
                Annotated[
                    list[str] | None,
                    Option(help="journal, supply, heat, rotor, damper, contact or bush; all unless given."),
                ],
                None,
            )
        },
        pictures=[
            Picture(
                "limits",
                lambda studies, given, report: studies.limits_atlas(given.physics, report=report),
                lambda charts, result: charts.plot_limit_summary(result),
            )
        ],
        table=_limits_table,
        data=lambda atlas: atlas.columns(),
        more=_limit_pictures,
    ),
    "heat": Chart(
        text="Films that warm: error against cost of the models of heat, and where they fail. A minute.",
        pictures=[
            Picture(
                "heat",
                lambda studies, given, report: studies.heat_accuracy(report=report),
            ),
            Picture(
                "heat_limits",
                lambda studies, given, report: studies.limits_atlas(["heat"], report=report),
                lambda charts, result: charts.plot_limits(result)["heat"],
            ),
        ],
        table=study_table(
            "model",
            {
                "eps": Shown("eccentricity ratio [1]", ".4f"),
                "angle [deg]": Shown("attitude angle [rad]", ".1f", 180.0 / math.pi),
                "power [W]": Shown("power loss [W]", ".0f"),
                "T [degC]": Shown("temperature, or largest [K]", ".1f", 1.0, CELSIUS),
                "Kyy [MN/m]": Shown("stiffness yy [N/m]", ".4g", 1e-6),
                "place off [%]": Shown("error of the position [1]", ".1f", 100.0),
                "power off [%]": Shown("error of the power [1]", ".1f", 100.0),
                "time [ms]": Shown("CPU time [s]", ".4g", 1e3),
            },
            last=0,
        ),
        data=lambda result, limits: result.columns(),
        more=_heated_film,
    ),
    "bush": Chart(
        text="Tiers of the polymer bush: error against cost, and the closed form of its shaft.",
        pictures=[
            Picture(
                "bush",
                lambda studies, given, report: studies.bush_tiers(report=report),
            )
        ],
        table=study_table(
            "tier",
            {
                "error of the angle": Shown("angle error [1]", ".1e"),
                "time of the run [ms]": Shown("time of the run [s]", ".3g", 1e3),
            },
        ),
        more=_shaft_table,
    ),
    "damper": Chart(
        text="Error of the force against its cost, for every squeeze film: chart_damper.png, .csv and .json.",
        options={
            "ld": (LD, 0.25),
            "permeability": (Annotated[float, Option(help="Phi = A H/C^3 of the cage.")], 1e-3),
            "states": (States, 200),
        },
        pictures=[
            Picture(
                "damper",
                lambda studies, given, report: studies.damper_accuracy(
                    given.ld, given.permeability, states=given.states, report=report
                ),
            )
        ],
        table=study_table(
            "film",
            {
                "median error": Shown("median error [1]", ".2e"),
                "99 % error": Shown("99 % error [1]", ".2e"),
                "against the short film": Shown("99 % error against the short film [1]", ".2e"),
                "batch [us]": Shown("force in a batch [s]", ".3g", MICRO),
                "alone [us]": Shown("force alone, prepare() [s]", ".3g", MICRO),
            },
        ),
        more=lambda out, charts, result: written_data(out, "damper", result),
    ),
    "cosim": Chart(
        text="Stability limits of the coupling schemes, and their error against film calls: takes minutes.",
        pictures=[
            Picture(
                "cosim_limits",
                lambda studies, given, report: studies.coupling_limits(report=report),
                lambda charts, result: charts.plot_coupling_limits(result),
            ),
            Picture(
                "cosim_cost",
                lambda studies, given, report: studies.coupling_cost(report=report),
            ),
        ],
        table=study_table(
            "scheme",
            {
                "orbit error / clearance": Shown("orbit_error [1]", ".1e"),
                "film calls per turn": Shown("film_calls [1/turn]", ".4g"),
            },
        ),
        data=lambda limits, cost: {"limits": limits, "cost": cost},
    ),
}
"""The charts of studies, by their commands."""


def __getattr__(name: str) -> Callable[..., Said]:
    """Return the command of a chart, a function whose options are those of the table."""
    if name not in CHARTS:
        raise AttributeError(f"{__name__} has no {name!r}")
    chart = CHARTS[name]

    def command(*, report: Report, out: Path, **given: object) -> Said:
        return chart.run(report=report, out=out, **given)

    made = {"report": (Report, Parameter.empty), **chart.options, "out": (Folder, OUT)}
    command.__doc__ = chart.text
    command.__signature__ = Signature(  # type: ignore[attr-defined]
        [
            Parameter(option, Parameter.KEYWORD_ONLY, default=default, annotation=annotation)
            for option, (annotation, default) in made.items()
        ]
    )
    return command


# Charts that are no studies: the models of a scene, and the page of a folder.


def scene(
    file: Annotated[Path, Argument(metavar="SCENE.toml", help="Scene file with a question.")],
    report: Report,
    out: Folder = OUT,
) -> Said:
    """Estimated error against cost of all models that could answer a scene, and the one that does."""
    from ..charts import RungPoint, plot_scene_ladder
    from ..questions.walk import whole_ladder
    from ..scenes import Scene

    loaded = Scene.load(file)
    report(0.1, "every model of the ladder")
    result = whole_ladder(loaded)
    points = [
        RungPoint(name=r.name, error_estimate=r.error_estimate, cost=r.cost, chosen=r.chosen)
        for r in result.rungs
        if r.error_estimate is not None and r.cost is not None and r.error_estimate > 0.0
    ]
    title = visible(f"{loaded.title}: {result.quantity}").replace("$", r"\$")  # no mathematics
    axes = plot_scene_ladder(points, title=title, tolerance=result.tolerance)
    files = write_chart(out, file.stem, result.columns(), [axes])
    cost = Shown("", ".3g", 1e3)
    rows = [
        (
            ("* " if r.chosen else "  ") + r.name,
            number(r.error_estimate),
            "" if r.cost is None else f"{cost.text(r.cost)} ms",
            r.reason,
        )
        for r in result.rungs
    ]
    return Said(result, partial(print_chart, ("model", "estimated error", "cost", "why not"), rows, files))


def page(out: Folder = OUT) -> Said:
    """Gather all charts of a folder, and the tables behind them, in one HTML page that needs nothing else."""
    from ..charts import write_page

    path = str(write_page(out))
    return Said({"page": path}, partial(console.print_rows, "", [("page", path)]))
