"""The page that an FMU carries as documentation/index.html."""

from __future__ import annotations

import json
from html import escape
from typing import Any

from .variables import Variable

CONVENTIONS = (
    "All values are in SI units. x and y are Cartesian, rotation is positive about +z (from x to y). A film "
    "force acts on the journal. Outputs are valid from the end of initialization and always belong to the "
    "present inputs, states and time. Inputs are held constant over a step; states may be set before the "
    "simulation starts."
)

REQUIREMENTS = (
    "The model runs in Python (3.11 or later, with numpy and scipy) through PythonFMU's libraries, on the "
    "64-bit platforms that the folder binaries lists. A host that is not Python itself must make libpython "
    "available to the library, on Linux for instance by LD_PRELOAD."
)

STATUSES = (
    "A value that is not finite, an attempt to set an output, or a state at which the model has no answer "
    "(a journal at the wall) ends in fmi2Fatal with the values in the log, because PythonFMU has no way to "
    "fmi2Error. Only this instance is affected. Its later calls fail too, until it is reset or a saved FMU "
    "state is restored. A step that a model with states cannot make is answered by fmi2Discard with "
    "fmi2Terminated true; the states then are those at the start of the step. The log needs loggingOn."
)

PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{title}</title></head>
<body>
<h1>{title}</h1>
{body}
</body>
</html>
"""


def to_html(title: str, variables: tuple[Variable, ...], model: dict[str, Any]) -> bytes:
    """Return the page: variables, sign conventions, requirements, statuses and parameters.

    Parameters
    ----------
    title : str
        One line on the model.
    variables : tuple of Variable
    model : dict
        Encoded model, shown as the parameters.
    """
    parameters = json.dumps(model, indent=2)
    sections = {
        "Variables": _table(variables),
        "Conventions": f"<p>{CONVENTIONS}</p>",
        "Requirements": f"<p>{REQUIREMENTS}</p>",
        "Statuses": f"<p>{STATUSES}</p>",
        "Parameters": f"<pre>{escape(parameters)}</pre>",
    }
    body = "\n".join(f"<h2>{heading}</h2>\n{content}" for heading, content in sections.items())
    return PAGE.format(title=escape(title), body=body).encode()


def _table(variables: tuple[Variable, ...]) -> str:
    heading = ("Name", "Causality", "Unit", "Start", "Nominal", "Description")
    rows = [
        (
            variable.name,
            "state (local)" if variable.causality == "local" else variable.causality,
            variable.signal.unit,
            "calculated" if variable.start is None else f"{variable.start:g}",
            f"{variable.signal.nominal:.3g}",
            variable.signal.description,
        )
        for variable in variables
    ]
    lines = [_row("th", heading), *(_row("td", row) for row in rows)]
    return "<table>\n" + "\n".join(lines) + "\n</table>"


def _row(tag: str, cells: tuple[str, ...]) -> str:
    return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"
