"""The commands `rotorfilm chart ...`: ladders of models measured, drawn and written as tables."""

# Packages that take long to import are imported inside the commands, so that --help answers at once.

from __future__ import annotations

import math
from collections.abc import Sequence
from enum import StrEnum
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Protocol

import typer

from ..limits import CHART_STATES, CONTACT_CELLS, TRANSITS
from ..printable import visible
from . import printing as console

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..comparisons.journal.timing import FilmCost

DPI = 110

chart_app = typer.Typer(
    help="Charts of a ladder of models, from the cheapest to the reference: PNG and CSV.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)

Slenderness = Annotated[float, typer.Option("--ld", help="Bearing length / diameter, 0.1 to 4.")]
Folder = Annotated[Path, typer.Option("--out", help="Folder for PNG and CSV; made if absent.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON on stdout instead of a table.")]
OUT = Path("rotorfilm-charts")


class MotionOption(StrEnum):
    """Ranges of random states."""

    LARGE = "large"
    SMALL = "small"


class Tabular(Protocol):
    """A result that is a table."""

    def columns(self) -> dict[str, list[object]]:
        """Return the columns by their headings, units included."""


@chart_app.command(epilog="Example: rotorfilm chart journal --ld 0.5 --json")
def journal(
    ld: Slenderness = 0.5,
    states: Annotated[int, typer.Option(help="Random states.", min=1, max=CHART_STATES)] = 300,
    seed: Annotated[int, typer.Option(help="Seed of the random states.", min=0)] = 1978,
    motion: Annotated[
        MotionOption, typer.Option(help="Range of the states' velocities.")
    ] = MotionOption.LARGE,
    out: Folder = OUT,
    json: Json = False,
) -> None:
    """Error of the force against its cost, for every journal film: chart_journal.png and .csv."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..charts import plot_journal_accuracy
        from ..comparisons import LARGE, SMALL, journal_accuracy

        ranges = LARGE if motion is MotionOption.LARGE else SMALL
        result = journal_accuracy(ld, states=states, ranges=ranges, seed=seed, report=report)
        files = _write(out, "chart_journal", result, plot_journal_accuracy(result))
        report(1.0, "done")
    if json:
        console.print_json(result)
        return
    rows = [
        (rung.name, f"{rung.median_error:.2e}", f"{rung.high_error:.2e}", *_costs(rung.cost))
        for rung in result.rungs
    ]
    console.print_columns(("film", "median error", "99 % error", "batch", "alone"), rows)
    floor = ("its error, 99 %", f"{result.reference_high:.1e}")
    console.print_rows("", [("reference", result.reference), floor, *files])


@chart_app.command(epilog="Example: rotorfilm chart stability --ld 0.5 --json")
def stability(ld: Slenderness = 0.5, out: Folder = OUT, json: Json = False) -> None:
    """Whirl threshold by every journal film, and where each fails: chart_stability.png and .csv."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..charts import plot_journal_stability
        from ..charts.comparisons.whirl_verdicts import verdicts
        from ..comparisons import journal_stability

        result = journal_stability(ld, report=report)
        files = _write(out, "chart_stability", result, plot_journal_stability(result))
        report(1.0, "done")
    if json:
        console.print_json(result)
        return
    rows = [(rung.name, *(cell.text for cell in verdicts(result, rung))) for rung in result.rungs]
    headings = ("film", "off by at most", "wrong at eps", "tension, large motion", "|Cxy - Cyx| / max |C|")
    console.print_columns(headings, rows)
    console.print_rows("", [("reference", result.reference), *files])


@chart_app.command(epilog="Example: rotorfilm chart contact --cells 48 --json")
def contact(
    cells: Annotated[
        int, typer.Option(help="Cells along each side of the reference.", min=24, max=CONTACT_CELLS)
    ] = 64,
    out: Folder = OUT,
    json: Json = False,
) -> None:
    """Error of a rolling ball's motion against its cost: time scheme, step, grid, reduced laws. Minutes."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..charts import plot_contact_precision
        from ..comparisons import contact_precision

        result = contact_precision(cells, report=report)
        files = _write(out, "chart_contact", result, plot_contact_precision(result))
        report(1.0, "done")
    if json:
        console.print_json(result.columns())
        return
    rows = [(rung.family, rung.label, f"{rung.error:.2e}", f"{rung.cost:.3g} s") for rung in result.rungs]
    console.print_columns(("model", "", "rms error", "cost"), rows)
    console.print_rows("", [("reference", result.reference), *files])


@chart_app.command(epilog="Example: rotorfilm chart contact-cases --cells 40")
def contact_cases(
    cells: Annotated[
        int, typer.Option(help="Cells along each side, converged runs.", min=8, max=CONTACT_CELLS)
    ] = 40,
    tolerance: Annotated[float, typer.Option(help="Of the steps of converged runs.")] = 1e-4,
    settle: Annotated[
        float, typer.Option(help="Length of the runs of case 4.3 with W = 1.", min=30.0, max=TRANSITS)
    ] = 60.0,
    out: Folder = OUT,
    json: Json = False,
) -> None:
    """Compare published cases of a rolling ball, by the published scheme and converged. Some ten minutes."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..charts import plot_contact_cases
        from ..comparisons import contact_cases as ladder
        from ..results import write_csv

        result = ladder(cells, tolerance, settle, report=report)
        files = _write(out, "chart_contact_cases", result, plot_contact_cases(result))
        curves = write_csv(out / "chart_contact_curves.csv", result.series())
        report(1.0, "done")
    if json:
        console.print_json([row._asdict() for row in result.statements])
        return
    headings = ("statement", "section", "published scheme", "same grid", "converged", "verdict")
    rows = [
        (row.text, row.section, row.published, row.same_grid, row.converged, row.verdict)
        for row in result.statements
    ]
    console.print_columns(headings, rows)
    console.print_rows("", [*files, ("curves", str(curves))])


@chart_app.command(epilog="Example: rotorfilm chart contact-limits --json")
def contact_limits(out: Folder = OUT, json: Json = False) -> None:
    """Where the published scheme of a rolling ball fails, and how it decays by itself. A minute."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..charts import plot_contact_limits
        from ..comparisons import contact_limits as ladder

        result = ladder(report=report)
        files = _write(out, "chart_contact_limits", result, plot_contact_limits(result))
        report(1.0, "done")
    table = result.columns()
    if json:
        console.print_json(table)
        return
    rows = [[_number(entry) for entry in row] for row in zip(*table.values(), strict=True)]
    console.print_columns(tuple(table), rows)
    console.print_rows("", files)


@chart_app.command(epilog="Example: rotorfilm chart scene examples/question.toml")
def scene(
    file: Annotated[Path, typer.Argument(metavar="SCENE.toml", help="Scene file with a question.")],
    out: Folder = OUT,
    json: Json = False,
) -> None:
    """Estimated error against cost of all models that could answer a scene, and the one that does."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..charts import RungPoint, plot_scene_ladder
        from ..questions.whole import whole_ladder
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
        files = _write(out, f"chart_{file.stem}", result, [axes])
        report(1.0, "done")
    if json:
        console.print_json(result)
        return
    rows = [
        (("* " if r.chosen else "  ") + r.name, _number(r.error_estimate), _milliseconds(r.cost), r.reason)
        for r in result.rungs
    ]
    console.print_columns(("model", "estimated error", "cost", "why not"), rows)
    console.print_rows("", files)


@chart_app.command(epilog="Example: rotorfilm chart limits --physics journal --physics damper")
def limits(
    physics: Annotated[
        list[str] | None, typer.Option(help="journal, rotor, damper, contact or bush; all unless given.")
    ] = None,
    out: Folder = OUT,
    json: Json = False,
) -> None:
    """Atlas of where methods fail: films, grids, steps, linearization, of all bearings. Ten seconds."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..charts import plot_limits
        from ..comparisons import failures, limits_atlas
        from ..comparisons.limits.limits_atlas import PHYSICS

        result = limits_atlas(physics or PHYSICS, report=report)
        files = _write(out, "chart_limits", result, plot_limits(result))
        files.append(("data", str(console.write_json(out / "chart_limits.json", result))))
        report(1.0, "done")
    if json:
        console.print_json(result)
        return
    rows: list[tuple[str, str]] = []
    for panel, curves in groupby(failures(result), key=lambda one: one.panel):
        rows += [("", ""), (f"{panel.physics}: {panel.title}", ""), (f"fails from {panel.x_label}", "")]
        rows += [(f"  {one.name}", "nowhere" if one.at is None else f"{one.at:.3g}") for one in curves]
    console.print_rows("", rows)
    console.print_rows("", files)


@chart_app.command(epilog="Example: rotorfilm chart page --out rotorfilm-charts")
def page(out: Folder = OUT, json: Json = False) -> None:
    """Gather all charts of a folder, and the tables behind them, in one HTML page that needs nothing else."""
    from ..charts import write_page

    path = write_page(out)
    if json:
        console.print_json({"page": str(path)})
        return
    console.print_rows("", [("page", str(path))])


@chart_app.command(epilog="Example: rotorfilm chart bush --json")
def bush(out: Folder = OUT, json: Json = False) -> None:
    """Tiers of the polymer bush: error against cost, as published too, and the closed form of its shaft."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..charts import plot_bush_tiers
        from ..comparisons import bush_tiers
        from ..results import write_csv

        result = bush_tiers(report=report)
        files = _write(out, "chart_bush", result, plot_bush_tiers(result))
        shaft = write_csv(out / "chart_bush_shaft.csv", result.shaft_columns())
        report(1.0, "done")
    if json:
        console.print_json(result)
        return
    rows = [(tier.name, f"{tier.error:.1e}", f"{1e3 * tier.cost:.3g} ms") for tier in result.tiers]
    console.print_columns(("tier", "error of the angle", "time of the run"), rows)
    errors = [100.0 * row.error for row in result.shaft]
    closed = f"{min(errors):.2f} to {max(errors):.2f} % high"
    last = [("closed form of the shaft", closed), ("its table", str(shaft))]
    console.print_rows("", [("reference", result.reference), *files, *last])


@chart_app.command(epilog="Example: rotorfilm chart damper --ld 0.25 --permeability 0.001")
def damper(
    ld: Slenderness = 0.25,
    permeability: Annotated[float, typer.Option(help="Phi = A H/C^3 of the cage.")] = 1e-3,
    states: Annotated[int, typer.Option(help="Random states.", min=1, max=CHART_STATES)] = 200,
    out: Folder = OUT,
    json: Json = False,
) -> None:
    """Error of the force against its cost, for every squeeze film: chart_damper.png, .csv and .json."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..charts import plot_damper_accuracy
        from ..comparisons import damper_accuracy

        result = damper_accuracy(ld, permeability, states=states, report=report)
        files = _write(out, "chart_damper", result, plot_damper_accuracy(result))
        files.append(("data", str(console.write_json(out / "chart_damper.json", result))))
        report(1.0, "done")
    if json:
        console.print_json(result)
        return
    rows = [
        (
            f"{rung.name}, {'cavitated' if rung.cavitated else 'full'}",
            f"{rung.median_error:.2e}",
            f"{rung.high_error:.2e}",
            f"{rung.series_error:.2e}",
            *_costs(rung.cost),
        )
        for rung in result.rungs
    ]
    headings = ("film", "median error", "99 % error", "against the short film", "batch", "alone")
    console.print_columns(headings, rows)
    console.print_rows("", files)


@chart_app.command(epilog="Example: rotorfilm chart cosim --json")
def cosim(out: Folder = OUT, json: Json = False) -> None:
    """Stability limits of the coupling schemes, and their error against film calls: takes minutes."""
    with console.progress_display() as report:
        report(0.0, "packages")
        from ..charts import plot_coupling_cost, plot_coupling_limits
        from ..comparisons import coupling_cost, coupling_limits
        from ..progress import part_of

        limits = coupling_limits(report=part_of(report, 0.0, 0.6))
        cost = coupling_cost(report=part_of(report, 0.6, 1.0))
        files = _write(out, "chart_cosim_limits", limits, plot_coupling_limits(limits))
        files += _write(out, "chart_cosim_cost", cost, plot_coupling_cost(cost))
        report(1.0, "done")
    if json:
        console.print_json({"limits": limits, "cost": cost})
        return
    best = [row for row in cost.rows if row.orbit_error is not None]
    rows = [
        (row.scheme, f"{math.degrees(row.macro_angle):.3g} deg", f"{row.orbit_error:.1e}") for row in best
    ]
    console.print_columns(("scheme", "macro step", "orbit error / clearance"), rows)
    console.print_rows("", files)


def _number(entry: object) -> str:
    return f"{entry:.4g}" if isinstance(entry, float) else "" if entry is None else str(entry)


def _write(out: Path, name: str, result: Tabular, axes: Sequence[Axes]) -> list[tuple[str, str]]:
    """Write chart and table; return the rows that name them."""
    from ..charts import save
    from ..results import write_csv

    out.mkdir(parents=True, exist_ok=True)
    chart = save(axes[0], out / f"{name}.png", dpi=DPI)
    table = write_csv(out / f"{name}.csv", result.columns())
    return [("chart", str(chart)), ("table", str(table))]


def _costs(cost: FilmCost) -> tuple[str, str]:
    return f"{1e6 * cost.force_time:.3g} us", f"{1e6 * cost.call_time:.3g} us"


def _milliseconds(cost: float | None) -> str:
    return "" if cost is None else f"{1e3 * cost:.3g} ms"
