"""What the command line prints: tables for people on stdout, progress and complaints on stderr."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.errors import visible

if TYPE_CHECKING:
    from rich.console import Console
    from rich.progress import Progress
    from rich.table import Table

    from ..core.progress import Report


def plain_console(**options: Any) -> Console:
    """Return a console that takes no text for markup: what is shown may be what a user typed."""
    from rich.console import Console

    return Console(highlight=False, markup=False, emoji=False, **options)


def complain(kind: str, message: object) -> None:
    """Print one line `kind: message` on stderr."""
    line = " ".join(str(message).split())
    sys.stderr.write(f"{kind}: {visible(line)}\n")


def print_json(value: Any) -> None:
    """Print a result as JSON, alone on stdout."""
    sys.stdout.write(json_text(value))


def json_text(value: Any) -> str:
    """Return a result as JSON, in which an infinite number, as an error without a bound, is null."""
    from ..core.results import to_plain

    return json.dumps(_bounded(to_plain(value)), indent=2, allow_nan=False) + "\n"


def _bounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _bounded(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [_bounded(entry) for entry in value]
    return None if isinstance(value, float) and math.isinf(value) else value


def write_json(path: Path, value: Any) -> Path:
    """Write a result as JSON; return where it is."""
    from ..core.files import write_atomically

    return write_atomically(path, json_text(value).encode())


def plain_table(title: str = "", **options: Any) -> Table:
    """Return an empty table without lines."""
    from rich.table import Table

    return Table(title=visible(title), title_justify="left", box=None, pad_edge=False, **options)


def filled(table: Table, rows: Iterable[Sequence[str]]) -> Table:
    """Return a table with more rows."""
    for row in rows:
        table.add_row(*map(visible, row))
    return table


def print_rows(title: str, rows: Iterable[Sequence[str]]) -> None:
    """Print names and values in two columns."""
    table = plain_table(title, show_header=False)
    table.add_column()
    table.add_column(overflow="fold")
    plain_console().print(filled(table, rows))


def print_columns(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Print a table with headings; all columns but the first are aligned to the right."""
    table = plain_table()
    for number, heading in enumerate(headings):
        table.add_column(heading, justify="right" if number else "left", no_wrap=not number)
    plain_console().print(filled(table, rows))


@contextmanager
def progress_display() -> Iterator[Report]:
    """Yield a function (fraction, text) that moves a progress bar on stderr; it shows from the first call."""
    bars: list[Progress] = []

    def report(fraction: float, text: str) -> None:
        if not bars:
            bars.append(_started_bar())
        bars[0].update(bars[0].task_ids[0], completed=fraction, description=text)

    try:
        yield report
    finally:
        for bar in bars:
            bar.stop()


def _started_bar() -> Progress:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (BarColumn(bar_width=30), TimeElapsedColumn(), TextColumn("{task.description}", markup=False))
    bar = Progress(*columns, console=Console(stderr=True))
    bar.add_task("", total=1.0)
    bar.start()
    return bar
