"""How the answer to a question is printed: the value, and the ladder that led to it."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..core.answers import QuestionAnswer, RungReport
from ..core.readable import without_round_off
from .printing import filled, plain_console, plain_table

STYLES = {"chosen": "bold green", "refused": "yellow"}
"""How verdicts are shown; others are dim."""


WIDE = 160
"""Columns of a print-out that is not on a screen."""


def print_question(title: str, answer: QuestionAnswer, *, explain: bool) -> None:
    """Print the answer to a question, and with `explain` the whole ladder."""
    table = filled(plain_table(title, show_header=False), _summary(answer))
    # A file or a pipe has no width that tables must fit.
    screen = plain_console() if sys.stdout.isatty() else plain_console(width=WIDE)
    screen.print(table)
    if explain:
        screen.print("", _ladder(answer))
        _print_reasons(screen, answer)
    if answer.assumptions:
        rows = [("", line) for line in answer.assumptions]
        screen.print("", filled(plain_table("assumed, as nobody gave it", show_header=False), rows))


def _summary(answer: QuestionAnswer) -> list[tuple[str, str]]:
    verdict = "met" if answer.met else "NOT met by any rung"
    verdict += f" within {answer.within}" if answer.within else ""
    share = "at most about" if chosen_report(answer).bound else "about"
    price = "cost not known" if answer.next_cost is None else _seconds(answer.next_cost)
    above = "none" if answer.next_model is None else f"{answer.next_model}: {price}"
    return [
        (answer.quantity.replace("_", " "), f"{_value(answer.value)} {answer.unit.removeprefix('1')}"),
        ("error", f"{share} {_number(answer.error_estimate)}"),
        ("tolerance", f"{answer.tolerance:.3g}: {verdict}"),
        ("model", answer.model),
        ("cost", f"{_seconds(answer.cost)}, its error {_seconds(answer.estimate_cost)}"),
        ("all that was tried", _seconds(answer.total_cost)),
        ("next rung", above),
    ]


def chosen_report(answer: QuestionAnswer) -> RungReport:
    """Return the report of the rung that answered."""
    return next(report for report in answer.rungs if report.name == answer.model)


def _ladder(answer: QuestionAnswer) -> Table:
    table = plain_table("the ladder, the cheapest rung first")
    table.add_column("rung", overflow="fold")
    table.add_column("", no_wrap=True)
    for heading in ("value", "error", "cost", "of error"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("error known by", overflow="fold")
    for report in answer.rungs:
        error = "" if report.error_estimate is None else _number(report.error_estimate)
        table.add_row(
            report.name,
            Text(report.verdict, style=STYLES.get(report.verdict, "dim")),
            "" if report.value is None else _value(report.value, short=True),
            ("<~ " if report.bound else "") + error,
            _seconds(report.cost),
            _seconds(report.estimate_cost),
            report.method,
            style="" if report.verdict in ("chosen", "refused") else "dim",
        )
    return table


def _print_reasons(screen: Console, answer: QuestionAnswer) -> None:
    reasons = [(report.name, report.reason) for report in answer.rungs if report.reason]
    if not reasons:
        return
    table = plain_table("why not", show_header=False)
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    screen.print("", filled(table, reasons))


def _value(value: Any, *, short: bool = False) -> str:
    if np.ndim(value) == 0:
        return f"{float(value):.6g}"
    if short:
        return f"max {float(np.max(np.abs(value))):.5g}"
    return "; ".join(
        "  ".join(f"{entry:.6g}" for entry in row) for row in without_round_off(np.atleast_2d(value))
    )


def _number(value: float) -> str:
    return f"{value:.2g}"


def _seconds(value: float | None) -> str:
    """Return a time with its unit, in three digits at most."""
    if value is None:
        return ""
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if value >= size:
            return f"{value / size:.3g} {unit}"
    return f"{value / 1e-6:.3g} us"
