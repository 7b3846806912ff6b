"""The commands `rotorfilm chart ...`: ladders of models measured, drawn and written as tables."""

from __future__ import annotations

import math
from enum import StrEnum
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Annotated

from ...errors import visible
from ...limits import CHART_STATES, CONTACT_CELLS, TRANSITS
from ...progress import Report, part_of
from ...results import write_csv
from .. import printing as console
from ..command import Argument, Option, Said
from .chart_files import (
    DPI,
    OUT,
    Folder,
    Slenderness,
    costs,
    milliseconds,
    number,
    print_chart,
    write_chart,
)

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
    from ... import charts, comparisons

    ranges = comparisons.LARGE if motion is MotionOption.LARGE else comparisons.SMALL
    result = comparisons.journal_accuracy(ld, states=states, ranges=ranges, seed=seed, report=report)
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
    from ... import charts, comparisons
    from ...charts.comparisons.whirl_verdicts import verdicts

    result = comparisons.journal_stability(ld, report=report)
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
    from ... import charts, comparisons

    result = comparisons.contact_precision(cells, report=report)
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
    from ... import charts, comparisons

    result = comparisons.contact_cases(cells, tolerance, settle, report=report)
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
    from ... import charts, comparisons

    result = comparisons.contact_limits(report=report)
    files = write_chart(out, "chart_contact_limits", result.columns(), charts.plot_contact_limits(result))
    table = result.columns()
    rows = [[number(entry) for entry in row] for row in zip(*table.values(), strict=True)]
    return Said(table, partial(print_chart, tuple(table), rows, files))


def scene(
    file: Annotated[Path, Argument(metavar="SCENE.toml", help="Scene file with a question.")],
    report: Report,
    out: Folder = OUT,
) -> Said:
    """Estimated error against cost of all models that could answer a scene, and the one that does."""
    from ...charts import RungPoint, plot_scene_ladder
    from ...questions.whole import whole_ladder
    from ...scenes import Scene

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
    from ... import charts, comparisons

    result = comparisons.limits_atlas(physics, report=report)
    files = write_chart(out, "chart_limits", result.columns(), charts.plot_limit_summary(result), data=result)
    for name, axes in charts.plot_limits(result).items():
        files.append((name, str(charts.save(axes[0], out / f"chart_limits_{name}.png", dpi=DPI))))
    rows: list[tuple[str, str]] = []
    for panel, curves in groupby(comparisons.failures(result), key=lambda one: one.panel):
        rows += [("", ""), (f"{panel.physics}: {panel.title}", ""), (f"fails from {panel.x_label}", "")]
        rows += [(f"  {one.name}", "nowhere" if one.at is None else f"{one.at:.3g}") for one in curves]
    return Said(result, partial(print_chart, (), rows, files))


def page(out: Folder = OUT) -> Said:
    """Gather all charts of a folder, and the tables behind them, in one HTML page that needs nothing else."""
    from ...charts import write_page

    path = str(write_page(out))
    return Said({"page": path}, partial(console.print_rows, "", [("page", path)]))


def heat(report: Report, out: Folder = OUT) -> Said:
    """Films that warm: error against cost of the models of heat, where they fail, pictures. A minute."""
    from ... import charts, comparisons
    from ...comparisons.journal.heat_models import heated_film

    result = comparisons.heat_accuracy(report=part_of(report, 0.0, 0.7))
    report(0.7, "where each model fails")
    limits = comparisons.limits_atlas(["heat"], report=part_of(report, 0.7, 0.95))
    files = write_chart(out, "chart_heat", result.columns(), charts.plot_heat_accuracy(result))
    files += write_chart(out, "chart_heat_limits", limits.columns(), charts.plot_limits(limits)["heat"])
    case = comparisons.HEAT_CASES[1]
    pictures = charts.plot_heated_film(heated_film(case), title=f"Film that warms: {case.name}")
    files.append(("film", str(charts.save(pictures[0], out / "chart_heat_film.png", dpi=DPI))))
    table = result.summary()
    rows = list(zip(*table.values(), strict=True))
    show = partial(print_chart, tuple(table), rows, [("reference", result.reference), *files])
    return Said(result.columns(), show)


def bush(report: Report, out: Folder = OUT) -> Said:
    """Tiers of the polymer bush: error against cost, as published too, and the closed form of its shaft."""
    from ... import charts, comparisons

    result = comparisons.bush_tiers(report=report)
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
    from ... import charts, comparisons

    result = comparisons.damper_accuracy(ld, permeability, states=states, report=report)
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
    from ... import charts, comparisons

    limits = comparisons.coupling_limits(report=part_of(report, 0.0, 0.6))
    cost = comparisons.coupling_cost(report=part_of(report, 0.6, 1.0))
    files = write_chart(out, "chart_cosim_limits", limits.columns(), charts.plot_coupling_limits(limits))
    files += write_chart(out, "chart_cosim_cost", cost.columns(), charts.plot_coupling_cost(cost))
    rows = [
        (row.scheme, f"{math.degrees(row.macro_angle):.3g} deg", f"{row.orbit_error:.1e}")
        for row in cost.rows
        if row.orbit_error is not None
    ]
    show = partial(print_chart, ("scheme", "macro step", "orbit error / clearance"), rows, files)
    return Said({"limits": limits, "cost": cost}, show)
