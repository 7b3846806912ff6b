"""The commands `rotorfilm chart ...`: studies computed, drawn and written as PNG and CSV."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Annotated, Literal

from .. import charts, studies
from ..core.errors import visible
from ..core.frames import write_csv
from ..core.limits import CHART_STATES, CONTACT_CELLS
from ..core.progress import Report, part_of
from ..core.units import parse_quantity
from . import printing as console
from .command import Argument, CommandOutput, Option, Settings, load_scene

DPI = 110
OUT = Path("rotorfilm-charts")
RPM = 30.0 / math.pi
POINTS = 25
"""Speeds of a curve of ball bearings."""

MEDIAN, HIGH = "median error [1]", "99 % error [1]"
FORCES = ("force in a batch [s]", "force alone, prepare() [s]")
PADS = ("force of a pad in a batch [s]", "force of a pad alone, prepare() [s]")
HEAT = ("eccentricity ratio [1]", "power loss [W]", "temperature, or largest [K]", "stiffness yy [N/m]")
HEAT_ERRORS = ("error of the position [1]", "error of the power [1]", "CPU time [s]")

COLUMNS: dict[str, Sequence[str]] = {
    "journal": (MEDIAN, HIGH, *FORCES),
    "pads": (MEDIAN, "90 % error [1]", HIGH, *PADS),
    "damper": (MEDIAN, HIGH, "99 % error against the short film [1]", *FORCES),
    "heat": (*HEAT, *HEAT_ERRORS),
    "rolling_ladder": ("median error of K [1]", "90 % error of K [1]", "force and derivatives [s]"),
    "bush": ("angle error [1]", "time of the run [s]"),
    "contact": ("rms error of delta", "cost [s]"),
    "cosim_cost": ("orbit_error [1]", "film_calls [1/turn]"),
}
"""Columns of the table of a study that are printed."""

Files = list[tuple[str, str]]
Folder = Annotated[Path, Option("--out", help="Folder for PNG and CSV; made if absent.")]
Slenderness = Annotated[float, Option("--ld", help="Bearing length / diameter, 0.1 to 4.")]
States = Annotated[int, Option(help="Random states, of each bearing.", min=1, max=CHART_STATES)]
Seed = Annotated[int, Option(help="Seed of the random states.", min=0)]
Motion = Annotated[Literal["large", "small"], Option(help="Range of the states' velocities.")]


def show_table(
    headings: Sequence[str], rows: Iterable[Sequence[str]], remarks: Sequence[tuple[str, str]] = ()
) -> None:
    """Print a table, without headings if there are none, and files and remarks below it."""
    if headings:
        console.print_columns(headings, rows)
    else:
        console.print_rows("", rows)
    console.print_rows("", remarks)


def write_chart(
    out: Path,
    stem: str,
    columns: Mapping[str, Iterable[object]],
    picture: charts.Picture,
    data: object = None,
) -> Files:
    """Write chart and table, and data as JSON if there are any; return the rows that name them."""
    out.mkdir(parents=True, exist_ok=True)
    files = [
        *write_picture(out, stem, picture),
        ("table", str(write_csv(out / f"chart_{stem}.csv", columns))),
    ]
    if data is not None:
        files.append(("data", str(console.write_json(out / f"chart_{stem}.json", data))))
    return files


def write_picture(out: Path, stem: str, picture: charts.Picture, kind: str = "chart") -> Files:
    """Write a picture; return the row that names it."""
    return [(kind, str(picture.save(out / f"chart_{stem}.png", dpi=DPI)))]


def number(entry: object) -> str:
    """Return an entry of a table as text."""
    return f"{entry:.4g}" if isinstance(entry, float) else "" if entry is None else str(entry)


def write_study(out: Path, result: studies.StudyResult, data: object = None) -> Files:
    """Write chart and table of a study, and data as JSON if there are any; return the rows that name them."""
    return write_chart(out, result.study, result.columns(), charts.plot_study(result), data)


def shown_study(result: studies.StudyResult, files: Files) -> Callable[[], None]:
    """Return what prints a study: a row for each rung, below the name of its case if it has one."""
    headings, rows = COLUMNS[result.study], []
    for case, rungs in groupby(result.rungs, key=lambda rung: rung.case):
        if case:
            rows.append((case, *("" for _ in headings)))
        indent = "  " if case else ""
        rows += [(f"{indent}{rung.name}", *(number(rung[one]) for one in headings)) for rung in rungs]
    floor = result.conditions.get("reference error, 99 % [1]")
    remarks = [
        ("reference", result.reference),
        *([] if floor is None else [("its error, 99 %", f"{floor:.1e}")]),
    ]
    return partial(show_table, ("model", *headings), rows, [*remarks, *files])


def said_study(out: Path, result: studies.StudyResult) -> CommandOutput:
    """Write a study, and return what is said of it."""
    return CommandOutput(result, shown_study(result, write_study(out, result)))


# Studies of error against cost.


def journal(
    report: Report,
    ld: Slenderness = 0.5,
    states: States = 300,
    seed: Seed = 1978,
    motion: Motion = "large",
    out: Folder = OUT,
) -> CommandOutput:
    """Error of the force against its cost, for every journal film: chart_journal.png and .csv.

    Example: rotorfilm chart journal --ld 0.5 --json
    """
    ranges = studies.LARGE if motion == "large" else studies.SMALL
    found = studies.journal_accuracy(ld, states=states, ranges=ranges, seed=seed, report=report)
    return said_study(out, found)


def pads(
    report: Report, ld: Slenderness = 0.5, states: States = 100, seed: Seed = 1978, out: Folder = OUT
) -> CommandOutput:
    """Error of the force against its cost, for maps and grids of pads: chart_pads.png and .csv.

    Example: rotorfilm chart pads --ld 0.5 --json
    """
    return said_study(out, studies.pad_accuracy(ld, states=states, seed=seed, report=report))


def damper(
    report: Report,
    ld: Slenderness = 0.25,
    permeability: Annotated[float, Option(help="Phi = A H/C^3 of the cage.")] = 1e-3,
    states: States = 200,
    out: Folder = OUT,
) -> CommandOutput:
    """Error of the force against its cost, for every squeeze film: chart_damper.png, .csv and .json.

    Example: rotorfilm chart damper --ld 0.25 --permeability 0.001
    """
    result = studies.damper_accuracy(ld, permeability, states=states, report=report)
    return CommandOutput(result, shown_study(result, write_study(out, result, result)))


def contact(
    report: Report,
    cells: Annotated[
        int, Option(help="Cells along each side of the reference.", min=24, max=CONTACT_CELLS)
    ] = 64,
    out: Folder = OUT,
) -> CommandOutput:
    """Error of a rolling ball's motion against its cost: time scheme, step, grid, reduced laws. Minutes.

    Example: rotorfilm chart contact --cells 48 --json
    """
    return said_study(out, studies.contact_precision(cells, report=report))


def bush(report: Report, out: Folder = OUT) -> CommandOutput:
    """Tiers of the polymer bush: error against cost, as published too, and the closed form of its shaft.

    Example: rotorfilm chart bush --json
    """
    result = studies.bush_tiers(report=report)
    files, shaft = write_study(out, result), result.notes["shaft"]
    *_, errors = shaft.values()
    files += [
        ("closed form of the shaft", f"{100.0 * min(errors):.2f} to {100.0 * max(errors):.2f} % high"),
        ("its table", str(write_csv(out / "chart_bush_shaft.csv", shaft))),
    ]
    return CommandOutput(result, shown_study(result, files))


def heat(report: Report, out: Folder = OUT) -> CommandOutput:
    """Films that warm: error against cost of the models of heat, where they fail, pictures. A minute.

    Example: rotorfilm chart heat --out rotorfilm-charts
    """
    from ..studies.heat_accuracy import heated_film

    result = studies.heat_accuracy(report=part_of(report, 0.0, 0.7))
    limits = studies.limits_atlas(["heat"], report=part_of(report, 0.7, 0.95))
    files = write_study(out, result)
    files += write_chart(out, "heat_limits", limits.columns(), charts.plot_limits(limits)["heat"])
    case = studies.HEAT_CASES[1]
    pictures = charts.plot_heated_film(heated_film(case), title=f"Film that warms: {case.name}")
    files += write_picture(out, "heat_film", pictures, "film")
    return CommandOutput(result, shown_study(result, files))


def rolling(
    report: Report,
    speed: Annotated[str, Option(help="Highest speed of a usual hybrid bearing of a spindle.")] = "30000 rpm",
    states: States = 40,
    seed: Seed = 1907,
    out: Folder = OUT,
) -> CommandOutput:
    """Ball bearings: loads, contact angles, stiffness over speed and preload, swing; error against cost.

    Example: rotorfilm chart rolling --speed '30000 rpm'
    """
    top = parse_quantity(speed, "rad/s")
    speeds = [k * top / (POINTS - 1) for k in range(POINTS)]
    curves = studies.ball_curves(studies.usual_bearing(), speeds, report=part_of(report, 0.0, 0.5))
    ladder = studies.ball_accuracy(states, seed=seed, report=part_of(report, 0.5, 1.0))
    files = write_chart(out, "rolling", curves.columns(), charts.plot_ball_curves(curves))
    headings = ("preload [N]", f"running at {RPM * top:.5g} rpm [N]", "radial [N/um]", "axial [N/um]")
    last = (curves.running_preload, 1e-6 * curves.radial_stiffness, 1e-6 * curves.axial_stiffness)
    rows = [
        (number(preload), *(number(one[k, -1].item()) for one in last))
        for k, preload in enumerate(curves.preloads)
    ]
    below = shown_study(ladder, [*files, *write_study(out, ladder)])

    def show() -> None:
        show_table(headings, rows)
        below()

    return CommandOutput({"curves": curves, "ladder": ladder}, show)


def cosim(report: Report, out: Folder = OUT) -> CommandOutput:
    """Stability limits of the coupling schemes, and their error against film calls: takes minutes.

    Example: rotorfilm chart cosim --json
    """
    limits = studies.coupling_limits(report=part_of(report, 0.0, 0.6))
    cost = studies.coupling_cost(report=part_of(report, 0.6, 1.0))
    files = write_chart(out, "cosim_limits", limits.columns(), charts.plot_coupling_limits(limits))
    return CommandOutput(
        {"limits": limits, "cost": cost}, shown_study(cost, [*files, *write_study(out, cost)])
    )


# Where models fail, and bearings side by side.


def stability(report: Report, ld: Slenderness = 0.5, out: Folder = OUT) -> CommandOutput:
    """Whirl threshold by every journal film, and where each fails: chart_stability.png and .csv.

    Example: rotorfilm chart stability --ld 0.5 --json
    """
    result = studies.journal_stability(ld, report=report)
    files = write_chart(out, "stability", result.columns(), charts.plot_journal_stability(result))
    columns = charts.verdict_table(result).columns
    headings, rows = [one.name for one in columns], zip(*(one.values for one in columns), strict=True)
    return CommandOutput(
        result, partial(show_table, headings, list(rows), [("reference", result.reference), *files])
    )


def limits(
    report: Report,
    physics: Annotated[
        list[str] | None,
        Option(help="journal, supply, heat, rotor, damper, contact or bush; all unless given."),
    ] = None,
    out: Folder = OUT,
) -> CommandOutput:
    """Atlas of where methods fail, a picture for each physics and a summary of all. Ten seconds.

    Example: rotorfilm chart limits --physics journal --physics damper
    """
    atlas = studies.limits_atlas(physics, report=report)
    table = atlas.columns()
    files = write_chart(out, "limits", table, charts.plot_limit_summary(atlas), table)
    for name, picture in charts.plot_limits(atlas).items():
        files += write_picture(out, f"limits_{name}", picture, name)
    rows: list[tuple[str, str]] = []
    for panel, found in studies.failures(atlas).items():
        rows += [("", ""), (f"{panel.physics}: {panel.title}", ""), (f"fails from {panel.x_label}", "")]
        rows += [(f"  {name}", "nowhere" if at is None else f"{at:.3g}") for name, at in found.items()]
    return CommandOutput(table, partial(show_table, (), rows, files))


def bearings(
    report: Report,
    ld: Slenderness = 0.5,
    mass: Annotated[str, Option(help="Mass of the rigid rotor that a bearing carries.")] = "250 kg",
    out: Folder = OUT,
) -> CommandOutput:
    """Types of bearings side by side: K and C over the Sommerfeld number, whirl threshold over the load.

    Example: rotorfilm chart bearings --ld 0.5 --mass '250 kg'
    """
    film = studies.bearing_coefficients(ld, report=part_of(report, 0.0, 0.3))
    carried = parse_quantity(mass, "kg")
    whirl = studies.bearing_thresholds(ld, mass=carried, report=part_of(report, 0.3, 1.0))
    files = write_study(out, film)
    files += write_chart(out, "whirl", whirl.columns(), charts.plot_bearing_thresholds(whirl))
    types = {name: list(rungs) for name, rungs in groupby(whirl.rungs, key=lambda rung: rung.family)}
    count = len(whirl.rungs) // len(types)
    shown = (0, count // 2, count - 1)
    headings = ("threshold [rpm] on", *(f"at {whirl.rungs[k]['load [N]']:.4g} N" for k in shown))
    rows = [(name, *(_speed(rungs[k].values) for k in shown)) for name, rungs in types.items()]
    met = dict.fromkeys(rung["whirl [-]"] for rung in whirl.rungs if rung["threshold [rad/s]"] is None)
    remarks = [(outcome, studies.WHIRL_OUTCOMES[outcome]) for outcome in met]
    show = partial(show_table, headings, rows, [("convention", film.reference), *remarks, *files])
    return CommandOutput({"coefficients": film, "thresholds": whirl}, show)


def _speed(row: Mapping[str, object]) -> str:
    speed = row["threshold [rad/s]"]
    return f"{RPM * speed:.4g}" if isinstance(speed, float) else str(row["whirl [-]"])


# The models of a scene, and the page of a folder.


def scene(
    file: Annotated[Path, Argument(metavar="SCENE.toml", help="Scene file with a question.")],
    report: Report,
    changes: Settings = None,
    out: Folder = OUT,
) -> CommandOutput:
    """Estimated error against cost of all models that could answer a scene, and the one that does.

    Example: rotorfilm chart scene examples/question.toml
    """
    from ..questions.walk import all_models

    loaded = load_scene(file, changes)
    report(0.1, "every model of the ladder")
    result = all_models(loaded)
    title = visible(f"{loaded.title}: {result.quantity}").replace("$", r"\$")  # no mathematics
    points = [
        (r.name, r.error_estimate, r.cost, r.chosen)
        for r in result.rungs
        if r.error_estimate is not None and r.cost is not None and r.error_estimate > 0.0
    ]
    picture = charts.plot_scene_ladder(points, title=title, tolerance=result.tolerance)
    files = write_chart(out, file.stem, result.columns(), picture)
    rows = [
        (("* " if r.chosen else "  ") + r.name, number(r.error_estimate), number(r.cost), r.reason)
        for r in result.rungs
    ]
    headings = ("model", "estimated error", "cost [s]", "why not")
    return CommandOutput(result, partial(show_table, headings, rows, files))


def page(out: Folder = OUT) -> CommandOutput:
    """Gather all charts of a folder, and the tables behind them, in one HTML page that needs nothing else.

    Example: rotorfilm chart page --out rotorfilm-charts
    """
    from ..reports import write_page

    path = str(write_page(out))
    return CommandOutput({"page": path}, partial(console.print_rows, "", [("page", path)]))
