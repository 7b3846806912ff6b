"""The commands `rotorfilm chart ...`: ladders of models measured, drawn and written as tables."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from enum import StrEnum
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ..core.errors import visible
from ..core.limits import CHART_STATES, CONTACT_CELLS, TRANSITS
from ..core.progress import Report, part_of
from ..core.results import write_csv
from . import printing as console
from .command import Argument, Option, Said, Settings, load_scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..studies import BearingThresholds, TypeThresholds
    from ..studies.journal_accuracy import FilmCost

# What the commands of charts share: files that they write, and how they say it.


DPI = 110

Slenderness = Annotated[float, Option("--ld", help="Bearing length / diameter, 0.1 to 4.")]
Folder = Annotated[Path, Option("--out", help="Folder for PNG and CSV; made if absent.")]
OUT = Path("rotorfilm-charts")

Rows = Iterable[Sequence[str]]
Columns = Mapping[str, Iterable[object]]


def write_chart(
    out: Path, name: str, columns: Columns, axes: Sequence[Axes], *, data: object = None
) -> list[tuple[str, str]]:
    """Write chart and table, and data as JSON if there are any; return the rows that name them."""
    from ..charts import save

    out.mkdir(parents=True, exist_ok=True)
    files = {
        "chart": save(axes[0], out / f"{name}.png", dpi=DPI),
        "table": write_csv(out / f"{name}.csv", columns),
    }
    if data is not None:
        files["data"] = console.write_json(out / f"{name}.json", data)
    return [(kind, str(path)) for kind, path in files.items()]


def print_chart(headings: Sequence[str], rows: Rows, files: Rows) -> None:
    """Print a table, without headings if there are none, and files and remarks below it."""
    if headings:
        console.print_columns(headings, rows)
    else:
        console.print_rows("", rows)
    console.print_rows("", files)


def number(entry: object) -> str:
    """Return an entry of a table as text."""
    return f"{entry:.4g}" if isinstance(entry, float) else "" if entry is None else str(entry)


def costs(cost: FilmCost) -> tuple[str, str]:
    """Return the costs of a force in a batch and alone as text."""
    return f"{1e6 * cost.force_time:.3g} us", f"{1e6 * cost.call_time:.3g} us"


def milliseconds(cost: float | None) -> str:
    """Return a time [s] as text."""
    return "" if cost is None else f"{1e3 * cost:.3g} ms"


# The commands `rotorfilm chart ...`: ladders of models measured, drawn and written as tables.


States = Annotated[int, Option(help="Random states.", min=1, max=CHART_STATES)]


class MotionOption(StrEnum):
    """Ranges of random states."""

    LARGE = "large"
    SMALL = "small"


def journal(
    report: Report,
    ld: Slenderness = 0.5,
    states: States = 300,
    seed: Annotated[int, Option(help="Seed of the random states.", min=0)] = 1978,
    motion: Annotated[MotionOption, Option(help="Range of the states' velocities.")] = MotionOption.LARGE,
    out: Folder = OUT,
) -> Said:
    """Error of the force against its cost, for every journal film: chart_journal.png and .csv."""
    from .. import charts, studies

    ranges = studies.LARGE if motion is MotionOption.LARGE else studies.SMALL
    result = studies.journal_accuracy(ld, states=states, ranges=ranges, seed=seed, report=report)
    files = write_chart(out, "chart_journal", result.columns(), charts.plot_journal_accuracy(result))
    headings = ("film", "median error", "99 % error", "batch", "alone")
    rows = [
        (rung.name, f"{rung.median_error:.2e}", f"{rung.high_error:.2e}", *costs(rung.cost))
        for rung in result.rungs
    ]
    floor = ("its error, 99 %", f"{result.reference_high:.1e}")
    return Said(
        result, partial(print_chart, headings, rows, [("reference", result.reference), floor, *files])
    )


def stability(report: Report, ld: Slenderness = 0.5, out: Folder = OUT) -> Said:
    """Whirl threshold by every journal film, and where each fails: chart_stability.png and .csv."""
    from .. import charts, studies
    from ..charts.whirl_verdicts import verdicts

    result = studies.journal_stability(ld, report=report)
    files = write_chart(out, "chart_stability", result.columns(), charts.plot_journal_stability(result))
    headings = ("film", "off by at most", "wrong at eps", "tension, large motion", "|Cxy - Cyx| / max |C|")
    rows = [(rung.name, *(cell.text for cell in verdicts(result, rung))) for rung in result.rungs]
    return Said(result, partial(print_chart, headings, rows, [("reference", result.reference), *files]))


def contact(
    report: Report,
    cells: Annotated[
        int, Option(help="Cells along each side of the reference.", min=24, max=CONTACT_CELLS)
    ] = 64,
    out: Folder = OUT,
) -> Said:
    """Error of a rolling ball's motion against its cost: time scheme, step, grid, reduced laws. Minutes."""
    from .. import charts, studies

    result = studies.contact_precision(cells, report=report)
    files = write_chart(out, "chart_contact", result.columns(), charts.plot_contact_precision(result))
    rows = [(rung.family, rung.label, f"{rung.error:.2e}", f"{rung.cost:.3g} s") for rung in result.rungs]
    show = partial(
        print_chart, ("model", "", "rms error", "cost"), rows, [("reference", result.reference), *files]
    )
    return Said(result.columns(), show)


def contact_cases(
    report: Report,
    cells: Annotated[
        int, Option(help="Cells along each side, converged runs.", min=8, max=CONTACT_CELLS)
    ] = 40,
    tolerance: Annotated[float, Option(help="Of the steps of converged runs.")] = 1e-4,
    settle: Annotated[
        float, Option(help="Length of the runs of case 4.3 with W = 1.", min=30.0, max=TRANSITS)
    ] = 60.0,
    out: Folder = OUT,
) -> Said:
    """Compare published cases of a rolling ball, by the published scheme and converged. Some ten minutes."""
    from .. import charts, studies

    result = studies.contact_cases(cells, tolerance, settle, report=report)
    files = write_chart(out, "chart_contact_cases", result.columns(), charts.plot_contact_cases(result))
    files.append(("curves", str(write_csv(out / "chart_contact_curves.csv", result.series()))))
    headings = ("statement", "section", "published scheme", "same grid", "converged", "verdict")
    rows = [
        (row.text, row.section, row.published, row.same_grid, row.converged, row.verdict)
        for row in result.statements
    ]
    return Said([row._asdict() for row in result.statements], partial(print_chart, headings, rows, files))


def contact_limits(report: Report, out: Folder = OUT) -> Said:
    """Where the published scheme of a rolling ball fails, and how it decays by itself. A minute."""
    from .. import charts, studies

    result = studies.contact_limits(report=report)
    files = write_chart(out, "chart_contact_limits", result.columns(), charts.plot_contact_limits(result))
    table = result.columns()
    rows = [[number(entry) for entry in row] for row in zip(*table.values(), strict=True)]
    return Said(table, partial(print_chart, tuple(table), rows, files))


def scene(
    file: Annotated[Path, Argument(metavar="SCENE.toml", help="Scene file with a question.")],
    report: Report,
    changes: Settings = None,
    out: Folder = OUT,
) -> Said:
    """Estimated error against cost of all models that could answer a scene, and the one that does."""
    from ..charts import RungPoint, plot_scene_ladder
    from ..questions.walk import whole_ladder

    loaded = load_scene(file, changes)
    report(0.1, "every model of the ladder")
    result = whole_ladder(loaded)
    points = [
        RungPoint(name=r.name, error_estimate=r.error_estimate, cost=r.cost, chosen=r.chosen)
        for r in result.rungs
        if r.error_estimate is not None and r.cost is not None and r.error_estimate > 0.0
    ]
    title = visible(f"{loaded.title}: {result.quantity}").replace("$", r"\$")  # no mathematics
    axes = plot_scene_ladder(points, title=title, tolerance=result.tolerance)
    files = write_chart(out, f"chart_{file.stem}", result.columns(), [axes])
    rows = [
        (("* " if r.chosen else "  ") + r.name, number(r.error_estimate), milliseconds(r.cost), r.reason)
        for r in result.rungs
    ]
    return Said(result, partial(print_chart, ("model", "estimated error", "cost", "why not"), rows, files))


def limits(
    report: Report,
    physics: Annotated[
        list[str] | None,
        Option(help="journal, supply, heat, rotor, damper, contact or bush; all unless given."),
    ] = None,
    out: Folder = OUT,
) -> Said:
    """Atlas of where methods fail, a picture for each physics and a summary of all. Ten seconds."""
    from .. import charts, studies

    result = studies.limits_atlas(physics, report=report)
    files = write_chart(out, "chart_limits", result.columns(), charts.plot_limit_summary(result), data=result)
    for name, axes in charts.plot_limits(result).items():
        files.append((name, str(charts.save(axes[0], out / f"chart_limits_{name}.png", dpi=DPI))))
    rows: list[tuple[str, str]] = []
    for panel, curves in groupby(studies.failures(result), key=lambda one: one.panel):
        rows += [("", ""), (f"{panel.physics}: {panel.title}", ""), (f"fails from {panel.x_label}", "")]
        rows += [(f"  {one.name}", "nowhere" if one.at is None else f"{one.at:.3g}") for one in curves]
    return Said(result, partial(print_chart, (), rows, files))


def page(out: Folder = OUT) -> Said:
    """Gather all charts of a folder, and the tables behind them, in one HTML page that needs nothing else."""
    from ..charts import write_page

    path = str(write_page(out))
    return Said({"page": path}, partial(console.print_rows, "", [("page", path)]))


def heat(report: Report, out: Folder = OUT) -> Said:
    """Films that warm: error against cost of the models of heat, where they fail, pictures. A minute."""
    from .. import charts, studies
    from ..studies.heat_accuracy import heated_film

    result = studies.heat_accuracy(report=part_of(report, 0.0, 0.7))
    report(0.7, "where each model fails")
    limits = studies.limits_atlas(["heat"], report=part_of(report, 0.7, 0.95))
    files = write_chart(out, "chart_heat", result.columns(), charts.plot_heat_accuracy(result))
    files += write_chart(out, "chart_heat_limits", limits.columns(), charts.plot_limits(limits)["heat"])
    case = studies.HEAT_CASES[1]
    pictures = charts.plot_heated_film(heated_film(case), title=f"Film that warms: {case.name}")
    files.append(("film", str(charts.save(pictures[0], out / "chart_heat_film.png", dpi=DPI))))
    table = result.summary()
    rows = list(zip(*table.values(), strict=True))
    show = partial(print_chart, tuple(table), rows, [("reference", result.reference), *files])
    return Said(result.columns(), show)


def bush(report: Report, out: Folder = OUT) -> Said:
    """Tiers of the polymer bush: error against cost, as published too, and the closed form of its shaft."""
    from .. import charts, studies

    result = studies.bush_tiers(report=report)
    files = write_chart(out, "chart_bush", result.columns(), charts.plot_bush_tiers(result))
    shaft = write_csv(out / "chart_bush_shaft.csv", result.shaft_columns())
    rows = [(tier.name, f"{tier.error:.1e}", milliseconds(tier.cost)) for tier in result.tiers]
    errors = [100.0 * row.error for row in result.shaft]
    closed = f"{min(errors):.2f} to {max(errors):.2f} % high"
    last = [("closed form of the shaft", closed), ("its table", str(shaft))]
    headings = ("tier", "error of the angle", "time of the run")
    return Said(
        result, partial(print_chart, headings, rows, [("reference", result.reference), *files, *last])
    )


def damper(
    report: Report,
    ld: Slenderness = 0.25,
    permeability: Annotated[float, Option(help="Phi = A H/C^3 of the cage.")] = 1e-3,
    states: States = 200,
    out: Folder = OUT,
) -> Said:
    """Error of the force against its cost, for every squeeze film: chart_damper.png, .csv and .json."""
    from .. import charts, studies

    result = studies.damper_accuracy(ld, permeability, states=states, report=report)
    files = write_chart(
        out, "chart_damper", result.columns(), charts.plot_damper_accuracy(result), data=result
    )
    rows = [
        (
            f"{rung.name}, {'cavitated' if rung.cavitated else 'full'}",
            f"{rung.median_error:.2e}",
            f"{rung.high_error:.2e}",
            f"{rung.series_error:.2e}",
            *costs(rung.cost),
        )
        for rung in result.rungs
    ]
    headings = ("film", "median error", "99 % error", "against the short film", "batch", "alone")
    return Said(result, partial(print_chart, headings, rows, files))


def cosim(report: Report, out: Folder = OUT) -> Said:
    """Stability limits of the coupling schemes, and their error against film calls: takes minutes."""
    from .. import charts, studies

    limits = studies.coupling_limits(report=part_of(report, 0.0, 0.6))
    cost = studies.coupling_cost(report=part_of(report, 0.6, 1.0))
    files = write_chart(out, "chart_cosim_limits", limits.columns(), charts.plot_coupling_limits(limits))
    files += write_chart(out, "chart_cosim_cost", cost.columns(), charts.plot_coupling_cost(cost))
    rows = [
        (row.scheme, f"{math.degrees(row.macro_angle):.3g} deg", f"{row.orbit_error:.1e}")
        for row in cost.rows
        if row.orbit_error is not None
    ]
    show = partial(print_chart, ("scheme", "macro step", "orbit error / clearance"), rows, files)
    return Said({"limits": limits, "cost": cost}, show)


# The commands `rotorfilm chart bearings` and `rotorfilm chart pads`: bearings made of pads, drawn.


def bearings(
    report: Report,
    ld: Slenderness = 0.5,
    mass: Annotated[str, Option(help="Mass of the rigid rotor that a bearing carries.")] = "250 kg",
    out: Folder = OUT,
) -> Said:
    """Types of bearings side by side: K and C over the Sommerfeld number, whirl threshold over the load."""
    from .. import charts, studies
    from ..core.units import parse_quantity

    film = studies.bearing_coefficients(ld, report=part_of(report, 0.0, 0.3))
    carried = parse_quantity(mass, "kg")
    whirl = studies.bearing_thresholds(ld, mass=carried, report=part_of(report, 0.3, 1.0))
    files = write_chart(out, "chart_bearings", film.columns(), charts.plot_bearing_coefficients(film))
    files += write_chart(out, "chart_whirl", whirl.columns(), [charts.plot_bearing_thresholds(whirl)])
    shown = [0, len(whirl.load) // 2, len(whirl.load) - 1]
    headings = ("threshold [rpm] on", *(f"at {whirl.load[k]:.4g} N" for k in shown))
    rows = [(one.name, *(_speed(one, k) for k in shown)) for one in whirl.types]
    show = partial(print_chart, headings, rows, [("convention", film.convention), *_said(whirl), *files])
    return Said({"coefficients": film, "thresholds": whirl}, show)


def pads(
    report: Report,
    ld: Slenderness = 0.5,
    states: Annotated[int, Option(help="Random states of each bearing.", min=1, max=CHART_STATES)] = 100,
    seed: Annotated[int, Option(help="Seed of the random states.", min=0)] = 1978,
    out: Folder = OUT,
) -> Said:
    """Error of the force against its cost, for maps and grids of pads: chart_pads.png and .csv."""
    from .. import charts, studies

    result = studies.pad_accuracy(ld, states=states, seed=seed, report=report)
    files = write_chart(out, "chart_pads", result.columns(), charts.plot_pad_accuracy(result))
    headings = ("film", "median error", "90 % error", "99 % error", "batch", "alone")
    rows = [
        (
            rung.name,
            *(f"{error:.2e}" for error in (rung.median_error, rung.usual_error, rung.high_error)),
            *costs(rung.cost),
        )
        for rung in result.rungs
    ]
    return Said(result, partial(print_chart, headings, rows, [("reference", result.reference), *files]))


def _said(whirl: BearingThresholds) -> list[tuple[str, str]]:
    """Return what the words mean that stand for a threshold."""
    met = dict.fromkeys(outcome for one in whirl.types for outcome in one.outcomes)
    return [(outcome, outcome.meaning) for outcome in met if outcome is not outcome.ONSET]


def _speed(one: TypeThresholds, k: int) -> str:
    speed = one.threshold_speed[k]
    return one.outcomes[k] if speed is None else f"{30.0 / math.pi * speed:.4g}"


# The command `rotorfilm chart rolling`: ball bearings over speed and preload, and their models, drawn.


POINTS = 25
"""Speeds of a curve."""


def rolling(
    report: Report,
    speed: Annotated[str, Option(help="Highest speed of a usual hybrid bearing of a spindle.")] = "30000 rpm",
    states: Annotated[int, Option(help="Random states of each bearing.", min=1, max=CHART_STATES)] = 40,
    seed: Annotated[int, Option(help="Seed of the random states.", min=0)] = 1907,
    out: Folder = OUT,
) -> Said:
    """Ball bearings: loads, contact angles, stiffness over speed and preload, swing; error against cost."""
    import numpy as np

    from .. import charts, studies
    from ..core.units import parse_quantity

    top = parse_quantity(speed, "rad/s")
    curves = studies.ball_curves(
        studies.usual_bearing(), np.linspace(0.0, top, POINTS), report=part_of(report, 0.0, 0.5)
    )
    ladder = studies.ball_accuracy(states, seed=seed, report=part_of(report, 0.5, 1.0))
    files = write_chart(out, "chart_rolling", curves.columns(), charts.plot_ball_curves(curves))
    files += write_chart(out, "chart_rolling_ladder", ladder.columns(), charts.plot_ball_accuracy(ladder))
    headings = (
        "preload [N]",
        f"running at {30.0 / math.pi * top:.5g} rpm [N]",
        "radial [N/um]",
        "axial [N/um]",
    )
    rows = [
        tuple(map(number, (preload, running[-1].item(), 1e-6 * radial[-1].item(), 1e-6 * axial[-1].item())))
        for preload, running, radial, axial in zip(
            curves.preloads,
            curves.running_preload,
            curves.radial_stiffness,
            curves.axial_stiffness,
            strict=True,
        )
    ]
    told = [(rung.name, f"K off by {rung.median_error:.2g}, {rung.usual_error:.2g}") for rung in ladder.rungs]
    return Said({"curves": curves, "ladder": ladder}, partial(print_chart, headings, rows, [*told, *files]))
