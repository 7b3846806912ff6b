"""The page that an FMU carries as documentation/index.html."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from html import escape
from importlib.resources import files
from typing import Any

from ..core.signals import Variable

PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{title}</title></head>
<body>
<h1>{title}</h1>
{body}
</body>
</html>
"""


def table_of(name: str) -> dict[str, Any]:
    """Return one of the tables of data beside this module."""
    return tomllib.loads(
        files(__package__ or "").joinpath("data", f"{name}.toml").read_text(encoding="utf-8")
    )


def capabilities(backend: str, version: str) -> dict[str, dict[str, str]]:
    """Return the attributes of the interfaces of a backend, as a version of FMI spells them."""
    return {
        interface: {name: str(value).lower() for name, value in attributes.items()}
        for interface, attributes in table_of("interfaces")[backend][version].items()
    }


def general_texts(kind: str, *, stepped: bool) -> dict[str, str]:
    """Return what holds for all models of a kind, native or python, by headings; stepped ones integrate."""
    texts = table_of("documentation")
    return {**texts[kind], **(texts[f"{kind}_stepped"] if stepped else {})}


def to_html(title: str, variables: tuple[Variable, ...], texts: Mapping[str, str], parameters: str) -> bytes:
    """Return the page.

    Parameters
    ----------
    title : str
        One line on the model.
    variables : tuple of Variable
    texts : mapping of str to str
        Paragraphs by their headings; "Equations" keep their lines.
    parameters : str
        The numbers of the model, as text.
    """
    sections = {
        "Variables": _table(variables),
        **{name: _paragraph(name, text) for name, text in texts.items()},
        "Parameters": f"<pre>{escape(parameters)}</pre>",
    }
    body = "\n".join(f"<h2>{heading}</h2>\n{content}" for heading, content in sections.items())
    return PAGE.format(title=escape(title), body=body).encode()


def _paragraph(name: str, text: str) -> str:
    tag = "pre" if name == "Equations" else "p"
    return f"<{tag}>{escape(text)}</{tag}>"


def _table(variables: tuple[Variable, ...]) -> str:
    heading = ("Name", "Causality", "Unit", "Start", "Nominal", "Description")
    rows = [
        (
            variable.name,
            _kind(variable),
            variable.unit or "",
            "calculated" if variable.start is None else f"{variable.start:g}",
            "" if variable.nominal is None else f"{variable.nominal:.3g}",
            variable.description,
        )
        for variable in variables
    ]
    lines = [_row("th", heading), *(_row("td", row) for row in rows)]
    return "<table>\n" + "\n".join(lines) + "\n</table>"


def _kind(variable: Variable) -> str:
    if variable.switch:
        return "event indicator (local)"
    if variable.causality == "local":
        return "state (local)" if variable.state is None else "derivative (local)"
    return f"{variable.variability} parameter" if variable.causality == "parameter" else variable.causality


def _row(tag: str, cells: tuple[str, ...]) -> str:
    return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"
