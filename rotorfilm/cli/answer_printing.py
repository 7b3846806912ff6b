"""How the answer of a scene is printed, and written with what pictures and tables it has."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.answers import QuestionAnswer
from ..core.frames import write_csv
from ..core.results import to_plain
from ..reports.answer_rows import answer_rows, number_text, question_rows, seconds_text, value_text
from . import printing as console

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from ..analysis import StabilityLevelOne
    from ..bearings.damper.answer import DamperAnswer
    from ..scenes.solve_shaft import RotorAnswer


def print_answer(title: str, answer: Any) -> None:
    """Print what a scene answers."""
    console.print_rows(title, answer_rows(answer))


def plain_answer(answer: Any) -> Any:
    """Return an answer as JSON has it."""
    return plain_rotor(answer) if type(answer).__name__ == "RotorAnswer" else to_plain(answer)


def write_answer(answer: Any, folder: Path) -> None:
    """Write an answer as JSON, its pictures and its tables into a folder, which is made if need be."""
    from ..core.files import written_together

    with written_together(folder) as part:
        console.write_json(part / "answer.json", plain_answer(answer))
        match type(answer).__name__:
            case "RotorAnswer":
                write_rotor(answer, part)
            case "DamperAnswer":
                write_damper(answer, part)


# A flexible rotor in its bearings.


def plain_rotor(answer: RotorAnswer) -> dict[str, Any]:
    """Return an answer as plain lists and numbers; nothing where a mode is overdamped."""
    chart = answer.campbell
    return {
        "title": answer.title,
        "mass": answer.mass,
        "states": answer.states,
        "loads": to_plain(dict(answer.loads)),
        "moments": to_plain(dict(answer.moments)),
        "axial_loads": dict(answer.axial_loads),
        "residual": answer.residual,
        "journals": to_plain(dict(answer.journals)),
        "critical_speeds": to_plain(list(answer.critical_speeds)),
        "threshold": to_plain(answer.threshold),
        "campbell": {
            "speeds": chart.speeds.tolist(),
            "frequency": _without_nan(chart.frequency),
            "log_decrement": _without_nan(chart.log_decrement),
            "direction": _without_nan(chart.direction),
        },
        "response_speeds": [] if answer.response is None else np.asarray(answer.response.frequency).tolist(),
        "amplitudes": to_plain(dict(answer.amplitudes)),
        "level_one": to_plain(answer.level_one),
        "remarks": list(answer.remarks),
    }


def _without_nan(table: np.ndarray) -> list[list[float | None]]:
    return [[None if math.isnan(entry) else entry for entry in row] for row in table.tolist()]


def write_rotor(answer: RotorAnswer, folder: Path) -> None:
    """Write the pictures and tables of a rotor."""
    from ..charts import picture_of, plot_campbell, plot_log_decrement, save
    from ..scenes.solve_shaft import campbell_columns, response_columns

    save(plot_campbell(answer.campbell, critical=answer.critical_speeds), folder / "campbell.png")
    save(plot_log_decrement(answer.campbell), folder / "log_decrement.png")
    write_csv(folder / "campbell.csv", campbell_columns(answer))
    if answer.response is not None:
        save(picture_of(answer, "response"), folder / "unbalance_response.png")
        write_csv(folder / "unbalance_response.csv", response_columns(answer))
    if answer.level_one is not None:
        write_level_one(answer.level_one, folder)


def write_level_one(found: StabilityLevelOne, folder: Path) -> None:
    """Write chart and curves of an analysis of level I."""
    from ..charts import plot_stability_level_one, save

    columns: dict[str, Any] = {}
    for curve in found.curves:
        columns[f"{curve.name} cross-coupling [N/m]"] = curve.cross_coupling.tolist()
        columns[f"{curve.name} log decrement [1]"] = curve.log_decrement.tolist()
        columns[f"{curve.name} frequency [rad/s]"] = curve.frequency.tolist()
    save(plot_stability_level_one(found), folder / "stability_level_one.png")
    write_csv(folder / "stability_level_one.csv", columns)


def write_damper(answer: DamperAnswer, folder: Path) -> None:
    """Write the picture of transmissibility over unbalance."""
    from ..charts import plot_transmissibility, save

    picture = plot_transmissibility({"damper": answer.response}, unit=answer.unbalance_scale)
    save(picture, folder / "transmissibility.png")


# The answer to a question: the value, and the ladder that led to it.


STYLES = {"chosen": "bold green", "refused": "yellow"}
"""How verdicts are shown; others are dim."""


WIDE = 160
"""Columns of a print-out that is not on a screen."""


def print_question(title: str, answer: QuestionAnswer, *, explain: bool) -> None:
    """Print the answer to a question, and with `explain` the whole ladder."""
    table = console.filled(console.plain_table(title, show_header=False), question_rows(answer))
    # A file or a pipe has no width that tables must fit.
    screen = console.plain_console() if sys.stdout.isatty() else console.plain_console(width=WIDE)
    screen.print(table)
    if explain:
        screen.print("", _ladder(answer))
        _print_reasons(screen, answer)
    if answer.assumptions:
        rows = [("", line) for line in answer.assumptions]
        screen.print(
            "", console.filled(console.plain_table("assumed, as nobody gave it", show_header=False), rows)
        )


def _ladder(answer: QuestionAnswer) -> Table:
    from rich.text import Text

    table = console.plain_table("the ladder, the cheapest model first")
    table.add_column("rung", overflow="fold")
    table.add_column("", no_wrap=True)
    for heading in ("value", "error", "cost", "of error"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("error known by", overflow="fold")
    for report in answer.rungs:
        error = "" if report.error_estimate is None else number_text(report.error_estimate)
        table.add_row(
            report.name,
            Text(report.verdict, style=STYLES.get(report.verdict, "dim")),
            "" if report.value is None else value_text(report.value, short=True),
            ("<~ " if report.bound else "") + error,
            seconds_text(report.cost),
            seconds_text(report.estimate_cost),
            report.method,
            style="" if report.verdict in ("chosen", "refused") else "dim",
        )
    return table


def _print_reasons(screen: Console, answer: QuestionAnswer) -> None:
    reasons = [(report.name, report.reason) for report in answer.rungs if report.reason]
    if not reasons:
        return
    table = console.plain_table("why not", show_header=False)
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    screen.print("", console.filled(table, reasons))
