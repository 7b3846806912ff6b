"""A report as a page: sections of verdicts, texts, tables and interactive figures, in one HTML file."""

from __future__ import annotations

import base64
import re
from collections.abc import Mapping, Sequence
from html import escape
from importlib import resources
from importlib.util import find_spec
from pathlib import Path
from string import Template
from typing import Any, NamedTuple

import numpy as np

from ..charts import CurveMark, Picture
from ..core.files import write_atomically
from ..core.frames import ResultTable, optional
from ..core.readable import Row, table_html

WIDTH = 700.0
"""Pixels of a figure, which fit on a printed page."""

ROWS = 200
"""Most rows of a table."""

SHOWN = 4000
"""Points of a curve beyond which only the largest and the smallest of each part are drawn."""


class Verdict(NamedTuple):
    """What was checked, and how it came out.

    Attributes
    ----------
    subject : str
        What was checked.
    fine : bool or None
        None of a note, which is no check.
    text : str
        How it came out.
    """

    subject: str
    fine: bool | None
    text: str


class Markup(str):
    """A block that is HTML already."""


Block = str | Verdict | list[Row] | ResultTable | Picture


class ReportSection(NamedTuple):
    """A heading and what stands below it.

    Attributes
    ----------
    heading : str
        In the page and in its list of sections.
    blocks : sequence
        Texts, verdicts, rows of names and values, tables, and pictures.
    """

    heading: str
    blocks: Sequence[Block]


class Report(NamedTuple):
    """A report, which is saved as one HTML page and printed from there.

    Attributes
    ----------
    title : str
    sections : tuple of ReportSection
        From the first to the last.
    files : mapping of str to str
        Texts that are attached, by the names of their files.
    """

    title: str
    sections: tuple[ReportSection, ...]
    files: Mapping[str, str] = {}

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """What was checked, in the order of the sections."""
        found = (one for part in self.sections for one in part.blocks if isinstance(one, Verdict))
        return tuple(dict.fromkeys(one for one in found if one.fine is not None))

    def to_html(self) -> str:
        """Return the page: figures are interactive where plotly is installed, else pictures."""
        names = [re.sub(r"\W+", "-", part.heading).lower() for part in self.sections]
        links = "".join(
            f'<a href="#{name}">{escape(part.heading)}</a>'
            for name, part in zip(names, self.sections, strict=True)
        )
        body = "\n".join(
            f'<section id="{name}"><h2>{escape(part.heading)}</h2>\n'
            f"{''.join(map(_block, part.blocks))}</section>"
            for name, part in zip(names, self.sections, strict=True)
        )
        attached = "".join(
            f'<a download="{escape(name)}" href="data:text/plain;base64,{encoded(text.encode())}">'
            f"{escape(name)}</a><pre>{escape(text)}</pre>"
            for name, text in self.files.items()
        )
        if attached:
            body += f'<section id="attached"><h2>Attached</h2>{attached}</section>'
        script = ""
        drawn = any(isinstance(one, Picture) for part in self.sections for one in part.blocks)
        if drawn and find_spec("plotly") is not None:
            script = f"<script>{optional('plotly.offline', 'plotly').get_plotlyjs()}</script>"
        template = Template(resources.files(__package__).joinpath("page.html").read_text("utf-8"))
        return template.substitute(title=escape(self.title), script=script, links=links, body=body)

    def save(self, path: Path | str) -> Path:
        """Write the page; return the path."""
        return write_atomically(path, self.to_html().encode())

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{escape(self.to_html())}" width="100%" height="800"></iframe>'


def _block(block: Block) -> str:
    """Return what stands below a heading as HTML."""
    match block:
        case Markup():
            return block
        case str():
            return f"<p>{escape(block)}</p>\n"
        case Verdict():
            kind = "" if block.fine is None else " fine" if block.fine else " bad"
            return f'<p class="verdict{kind}"><b>{escape(block.subject)}</b>: {escape(block.text)}</p>\n'
        case Picture():
            return f"<figure>{_figure(thinned(block))}</figure>\n"
        case ResultTable():
            return f"{table_html(block, ROWS)}\n"
    rows = "".join(f"<tr><th>{escape(label)}</th><td>{escape(text)}</td></tr>" for label, text in block)
    return f'<table class="rows">{rows}</table>\n'


def _figure(picture: Picture) -> str:
    if find_spec("plotly") is None:
        return f'<img width="{WIDTH:g}" src="data:image/png;base64,{encoded(picture._repr_png_())}">'
    figure = picture.to_plotly()
    height = max(320.0, figure.layout.height * min(1.0, 1.4 * WIDTH / figure.layout.width))
    figure.update_layout(width=WIDTH, height=height, font={"size": 11})
    figure.update_scenes(aspectmode="manual", aspectratio={"x": 1.6, "y": 1.0, "z": 1.0})
    if len(picture.panels) == 1:
        below = {"orientation": "h", "x": 0.0, "y": -0.15, "yanchor": "top"}
        figure.update_layout(legend=below)
    config = {"displaylogo": False, "plotlyServerURL": ""}
    return str(figure.to_html(full_html=False, include_plotlyjs=False, config=config))


def encoded(content: bytes) -> str:
    """Return the base64 text of a data link."""
    return base64.b64encode(content).decode()


def thinned(picture: Picture) -> Picture:
    """Return a picture whose long curves keep the extremes of each part alone."""
    panels = [
        panel._replace(marks=[_thinned(one) if isinstance(one, CurveMark) else one for one in panel.marks])
        for panel in picture.panels
    ]
    return picture._replace(panels=tuple(panels))


def _thinned(curve: CurveMark) -> CurveMark:
    size = np.size(curve.x)
    if size <= SHOWN or curve.values is not None:
        return curve
    kept: set[Any] = {0, size - 1}
    for part in np.array_split(np.arange(size), SHOWN // 4):
        for values in (curve.x, curve.y):
            among = np.asarray(values, dtype=float)[part]
            lost = np.isnan(among)  # where a line breaks
            kept |= {
                part[np.where(lost, np.inf, among).argmin()],
                part[np.where(lost, -np.inf, among).argmax()],
            }
            kept |= {part[lost.argmax()]} if lost.any() else set()
    places = np.array(sorted(kept))
    z = None if curve.z is None else np.asarray(curve.z)[places]
    return curve._replace(x=np.asarray(curve.x)[places], y=np.asarray(curve.y)[places], z=z)
