"""One HTML page with the charts of a folder and the tables behind them, that needs no other file."""

from __future__ import annotations

import base64
import csv
from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path

from ..core.errors import InputError
from ..core.files import write_atomically

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
    "chart_limits": "Where each simplification stays within 10 %: green with all variants, yellow with some.",
    "chart_pads": "Error of the films of pads over their cost; lower left is better.",
    "chart_rolling": "Ball bearings: loads, contact angles, stiffness over speed and preload, swing.",
    "chart_rolling_ladder": "Error of the models of ball bearings over their cost; lower left is better.",
    "chart_stability": "Speed at the onset of whirl by every journal film, over where the journal rests.",
    "chart_whirl": "Whether each film tells a whirling from a resting journal, beside the reference.",
}
"""What is seen, by the name of the file."""

ATLAS = "Error of each simplification against the next better model; above the dashed line it has failed."
QUESTION = "Estimated error of every model that may answer this question over its cost, and the one chosen."

STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 75rem; padding: 0 1rem }
img { max-width: 100%; height: auto; border: 1px solid #ddd }
nav a { margin-right: 1rem }
details { margin: 1rem 0 3rem }
div.table { overflow: auto; max-height: 30rem }
table { border-collapse: collapse; font-size: .85rem }
th, td { border: 1px solid #ddd; padding: .15rem .5rem; text-align: right }
th { position: sticky; top: 0; background: #f4f4f4 }
"""

PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>rotorfilm: charts</title><link rel="icon" href="data:,">
<style>{style}</style></head>
<body>
<h1>rotorfilm: charts</h1>
<nav>{links}</nav>
{sections}
</body>
</html>
"""


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
    names = [_title(chart) for chart in charts]
    links = "".join(
        f'<a href="#{chart.stem}">{escape(name)}</a>' for chart, name in zip(charts, names, strict=True)
    )
    sections = "\n".join(_section(chart, name) for chart, name in zip(charts, names, strict=True))
    text = PAGE.format(style=STYLE, links=links, sections=sections)
    return write_atomically(folder / NAME, text.encode())


def _title(chart: Path) -> str:
    return chart.stem.removeprefix("chart_").replace("_", " ")


def _explained(stem: str) -> str:
    """Return a sentence on what is seen; a chart with another name is that of a question."""
    if stem.startswith(("chart_limits_", "chart_heat_limits")):
        return ATLAS
    return EXPLAINED.get(stem, QUESTION if stem.startswith("chart_") else "")


def _section(chart: Path, name: str) -> str:
    picture = base64.b64encode(chart.read_bytes()).decode()
    table = chart.with_suffix(".csv")
    below = _table(table) if table.is_file() else ""
    return (
        f'<h2 id="{chart.stem}">{escape(name)}</h2>\n'
        f"<p>{escape(_explained(chart.stem))}</p>\n"
        f'<img src="data:image/png;base64,{picture}" alt="{escape(name)}">\n{below}'
    )


def _table(path: Path) -> str:
    text = path.read_text(encoding="utf-8")
    rows = list(csv.reader(text.splitlines()))
    shown = "".join(_rows(rows[: LINES + 1]))
    more = f" (the first {LINES} of {len(rows) - 1} rows)" if len(rows) > LINES + 1 else ""
    data = base64.b64encode(text.encode()).decode()
    return (
        f"<details><summary>The table behind it{more}</summary>\n"
        f'<p><a download="{path.name}" href="data:text/csv;base64,{data}">{path.name}</a></p>\n'
        f'<div class="table"><table>{shown}</table></div></details>'
    )


def _rows(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    for number, row in enumerate(rows):
        tag = "td" if number else "th"
        yield "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in row) + "</tr>"
