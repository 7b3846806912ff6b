"""What the command line prints: tables for people on stdout, progress and complaints on stderr."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from ..files import write_whole
from ..printable import visible
from ..results import Coefficients, Equilibrium, WhirlThreshold, to_plain

if TYPE_CHECKING:
    from ..progress import Report
    from ..scenes.bush.solve_bush import BushAnswer
    from ..scenes.coupling_study import CoupledRun
    from ..scenes.demo import DemoResult
    from ..scenes.journal.echo import BearingData
    from ..scenes.journal.solve_journal import Answer


def plain_console(**options: Any) -> Console:
    """Return a console that takes no text for markup: what is shown may be what a user typed."""
    return Console(highlight=False, markup=False, emoji=False, **options)


def complain(kind: str, message: object) -> None:
    """Print one line `kind: message` on stderr."""
    line = " ".join(str(message).split())
    plain_console(stderr=True, soft_wrap=True).print(f"{kind}: {visible(line)}")


def print_json(value: Any) -> None:
    """Print a result as JSON, alone on stdout."""
    plain_console(soft_wrap=True).out(json.dumps(to_plain(value), indent=2, allow_nan=False))


def write_json(path: Path, value: Any) -> Path:
    """Write a result as JSON; return where it is."""
    text = json.dumps(to_plain(value), indent=2, allow_nan=False)
    return write_whole(path, f"{text}\n".encode())


def print_rows(title: str, rows: list[tuple[str, str]]) -> None:
    """Print names and values in two columns."""
    table = Table(title=visible(title), title_justify="left", show_header=False, box=None, pad_edge=False)
    for row in rows:
        table.add_row(*map(visible, row))
    plain_console().print(table)


def print_columns(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Print a table with headings; all columns but the first are aligned to the right."""
    table = Table(title_justify="left", box=None, pad_edge=False)
    for number, heading in enumerate(headings):
        table.add_column(heading, justify="right" if number else "left", no_wrap=not number)
    for row in rows:
        table.add_row(*map(visible, row))
    plain_console().print(table)


def print_table(title: str, rows: list[dict[str, Any]]) -> None:
    """Print rows with the same keys as a table."""
    table = Table(title=visible(title), title_justify="left", box=None, pad_edge=False)
    for key in rows[0] if rows else ():
        table.add_column(key, overflow="fold")
    for row in rows:
        table.add_row(*("" if value is None else visible(str(value)) for value in row.values()))
    plain_console().print(table)


def check_row(check: str, passed: bool | None, figure: float | None, remark: str) -> tuple[str, str]:
    """Return the row of one check of an FMU."""
    verdict = {True: "passed", False: "FAILED", None: "not applicable"}[passed]
    measured = "" if figure is None else f" {figure:.2g}"
    return check, f"{verdict}:{measured} {remark}"


@contextmanager
def progress_display() -> Iterator[Report]:
    """Yield a function (fraction, text) that moves a progress bar on stderr; it shows from the first call."""
    columns = (BarColumn(bar_width=30), TimeElapsedColumn(), TextColumn("{task.description}", markup=False))
    bar = Progress(*columns, console=Console(stderr=True))
    task = bar.add_task("", total=1.0, start=False)

    def report(fraction: float, text: str) -> None:
        if not bar.live.is_started:
            bar.start()
            bar.start_task(task)
        bar.update(task, completed=fraction, description=text)

    try:
        yield report
    finally:
        if bar.live.is_started:
            bar.stop()


def bearing_rows(bearing: BearingData) -> list[tuple[str, str]]:
    """Return the rows that repeat a bearing."""
    size = f"R {bearing.radius * 1e3:.6g} mm, L {bearing.length * 1e3:.6g} mm, L/D {bearing.slenderness:.6g}"
    rows = [
        ("bearing", f"{size}, c {bearing.clearance * 1e6:.6g} um"),
        ("viscosity", f"{bearing.viscosity:.6g} Pa s"),
    ]
    rows += [("groove", f"{_degrees(one.center)}, {_degrees(one.width)} wide") for one in bearing.grooves]
    rows += [("pad", f"from {_degrees(one.start)} over {_degrees(one.extent)}") for one in bearing.pads]
    if bearing.supply_pressure:
        rows.append(("supply pressure", f"{bearing.supply_pressure:.6g} Pa"))
    return rows


def equilibrium_rows(at: Equilibrium) -> list[tuple[str, str]]:
    """Return the rows that describe an equilibrium."""
    return [
        ("load", f"{_pair(at.load)} N"),
        ("speed", f"{at.speed:.6g} rad/s = {at.speed * 30.0 / math.pi:.6g} rpm"),
        ("position", f"{_pair(at.position * 1e6)} um"),
        ("eccentricity ratio", f"{at.eccentricity_ratio:.6g}"),
        ("attitude angle", f"{math.degrees(at.attitude_angle):.6g} deg"),
        ("minimum film", f"{at.minimum_film * 1e6:.6g} um"),
    ]


def coefficient_rows(film: Coefficients) -> list[tuple[str, str]]:
    """Return the rows of a stiffness and a damping matrix."""
    (kxx, kxy), (kyx, kyy) = film.stiffness
    (cxx, cxy), (cyx, cyy) = film.damping
    return [
        ("stiffness K [N/m]", f"xx {kxx:14.7g}   xy {kxy:14.7g}"),
        ("", f"yx {kyx:14.7g}   yy {kyy:14.7g}"),
        ("damping C [N s/m]", f"xx {cxx:14.7g}   xy {cxy:14.7g}"),
        ("", f"yx {cyx:14.7g}   yy {cyy:14.7g}"),
    ]


def whirl_rows(threshold: WhirlThreshold | None) -> list[tuple[str, str]]:
    """Return the rows of a whirl threshold, or of the reason why there is none."""
    if threshold is None:
        return []
    if threshold.speed is None:
        return [("whirl threshold", f"none: {threshold.reason}")]
    speed = f"{threshold.speed:.6g} rad/s = {threshold.speed * 30.0 / math.pi:.6g} rpm"
    ratio = "" if threshold.whirl_ratio is None else f", whirl ratio {threshold.whirl_ratio:.4g}"
    return [("whirl threshold", speed + ratio)]


def remark_rows(remarks: tuple[str, ...]) -> list[tuple[str, str]]:
    """Return the rows of what the physics of a film leaves out."""
    return [("left out", remark) for remark in remarks]


def print_answer(title: str, answer: Answer) -> None:
    """Print equilibrium, coefficients and whirl threshold."""
    rows = [*bearing_rows(answer.bearing), ("film", answer.model), *equilibrium_rows(answer.equilibrium)]
    rows += coefficient_rows(answer.coefficients)
    rows += whirl_rows(answer.whirl_threshold)
    print_rows(title, rows + remark_rows(answer.remarks))


def print_bush(answer: BushAnswer) -> None:
    """Print contact and critical speeds of a melting bush."""
    at = answer.contact
    rows = [
        ("load", f"{at.load:.6g} N"),
        ("contact half angle", f"{at.contact_angle:.6g} rad = {math.degrees(at.contact_angle):.4g} deg"),
        ("settlement", f"{at.settlement * 1e6:.6g} um"),
        ("pressure", f"mean {at.mean_pressure * 1e-6:.5g} MPa, largest {at.maximum_pressure * 1e-6:.5g} MPa"),
        ("heat", f"shaft {at.shaft_flux:.6g} W/m2, liner {at.liner_flux:.6g} W/m2"),
        ("critical speed", _speed(at.critical_speed)),
        ("", f"{_speed(answer.onset_speed)} once worn to a settlement of {answer.settlement * 1e6:g} um"),
    ]
    operation = [(name.replace("_", " "), f"{value:.6g}") for name, value in answer.operation.items()]
    print_rows("melting bush", rows)
    if operation:
        print_rows("at the speed given, unworn (SI)", operation)


def print_demo(result: DemoResult) -> None:
    """Print the summary of the demonstration."""
    print_answer(result.scene.title, result.answer)
    table = Table(title="coupled FMUs beside the monolithic solution", title_justify="left", box=None)
    for heading in ("macro step", "spectral radius", "orbit error / clearance", "time"):
        table.add_column(heading, justify="right")
    table.add_column("")
    for run in result.coupling.runs:
        table.add_row(*_coupled_cells(run), "too long on purpose" if run is result.refusal_run else "")
    plain_console().print("", table)
    limit, order = result.critical_macro_angle, result.coupling.observed_order
    rows = [
        ("stability limit of the macro step", "none" if limit is None else f"{math.degrees(limit):.4g} deg"),
        *_purpose_rows(result),
        ("order of convergence", "not observed" if order is None else f"{order:.3f}"),
        ("refused", "; ".join(run.refused for run in result.coupling.runs if run.refused) or "no run"),
    ]
    print_rows("", rows)


def _purpose_rows(result: DemoResult) -> list[tuple[str, str]]:
    """Return the row that says why one macro step is too long."""
    run, limit = result.refusal_run, result.critical_macro_angle
    if run is None or limit is None:
        return []
    times = run.macro_angle / limit
    return [("too long on purpose", f"{times:.3g} x the limit: must be refused")]


def _coupled_cells(run: CoupledRun) -> tuple[str, str, str, str]:
    return (
        f"{math.degrees(run.macro_angle):.4g} deg",
        f"{run.spectral_radius:.5f}",
        f"{run.orbit_error:.3g}" + (" (refused)" if run.refused else ""),
        f"{run.wall_time:.2f} s",
    )


def _speed(value: float) -> str:
    return f"{value:.6g} rad/s = {value * 30.0 / math.pi:.6g} rpm"


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.6g} deg"


def _pair(values: np.ndarray) -> str:
    return f"({values[0]:.6g}, {values[1]:.6g})"
