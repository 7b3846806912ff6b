"""One HTML page with the charts of a folder and the tables behind them, that needs no other file."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path

from ..core.errors import InputError
from .page import Markup, Report, ReportSection, encoded

NAME = "charts.html"

LINES = 400
"""Rows of a table that are shown; all are in the CSV file, which the page carries too."""

EXPLAINED = {
    "chart_bearings": "Stiffness, damping and onset of whirl of eight types of bearings side by side.",
    "chart_bush": "How far each model of the polymer bush is from the richest one, over what it costs.",
    "chart_contact": "How far each model of a rolling contact is from the finest grid, over what it costs.",
    "chart_contact_cases": "Published cases of a rolling ball as computed here; each statement is checked.",
    "chart_contact_limits": "For which load steps and time steps the published scheme of a contact fails.",
    "chart_cosim_cost": "Error of the coupled orbit over calls of the film; lower left is better.",
    "chart_cosim_limits": "Longest stable macro step of each coupling scheme over the eccentricity ratio.",
    "chart_damper": "Error of the force of every squeeze film over its cost; lower left is better.",
    "chart_heat": "How far each model of a film that warms is from the richest one, over what it costs.",
    "chart_heat_film": "Pressure and temperature over and across one film that warms.",
    "chart_journal": "Error of the force of every journal film over its cost; lower left is better.",
    "chart_limits": "Where each simplification stays within 10 %: blue with all variants, yellow with some.",
    "chart_pads": "Error of the films of pads over their cost; lower left is better.",
    "chart_rolling": "Ball bearings: loads, contact angles, stiffness over speed and preload, swing.",
    "chart_rolling_ladder": "Error of the models of ball bearings over their cost; lower left is better.",
    "chart_stability": "Speed at the onset of whirl by every journal film, over where the journal rests.",
    "chart_whirl": "Whether each film tells a whirling from a resting journal, beside the reference.",
}
"""What is seen, by the name of the file."""

ATLAS = "Error of each simplification against the next better model; above the dashed line it has failed."
QUESTION = "Estimated error of every model that may answer this question over its cost, and the one chosen."


def write_page(folder: Path) -> Path:
    """Write `charts.html` into a folder, from the PNG and CSV files that are in it.

    Parameters
    ----------
    folder : Path
        Folder where the `rotorfilm chart` commands wrote.

    Returns
    -------
    Path

    Raises
    ------
    InputError
        If there is no chart in the folder.
    """
    charts = sorted(folder.glob("*.png"))
    if not charts:
        raise InputError(f"out must be a folder with charts, got {str(folder)!r} without a PNG file")
    return Report("rotorfilm: charts", tuple(map(_section, charts))).save(folder / NAME)


def _explained(stem: str) -> str:
    """Return a sentence on what is seen; a chart with another name is that of a question."""
    if stem.startswith(("chart_limits_", "chart_heat_limits")):
        return ATLAS
    return EXPLAINED.get(stem, QUESTION if stem.startswith("chart_") else "")


def _section(chart: Path) -> ReportSection:
    name, table = chart.stem.removeprefix("chart_").replace("_", " "), chart.with_suffix(".csv")
    picture = f'<img src="data:image/png;base64,{encoded(chart.read_bytes())}" alt="{escape(name)}">\n'
    below = [Markup(_table(table))] if table.is_file() else []
    return ReportSection(name, [_explained(chart.stem), Markup(picture), *below])


def _table(path: Path) -> str:
    text = path.read_text(encoding="utf-8")
    rows = list(csv.reader(text.splitlines()))
    shown = "".join(_rows(rows[: LINES + 1]))
    more = f" (the first {LINES} of {len(rows) - 1} rows)" if len(rows) > LINES + 1 else ""
    data = encoded(text.encode())
    return (
        f"<details><summary>The table behind it{more}</summary>\n"
        f'<p><a download="{path.name}" href="data:text/csv;base64,{data}">{path.name}</a></p>\n'
        f'<div class="table"><table>{shown}</table></div></details>'
    )


def _rows(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    for number, row in enumerate(rows):
        tag = "td" if number else "th"
        yield "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in row) + "</tr>"
