"""The page that an FMU carries as documentation/index.html."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape

from ..core.signals import Variable

PYTHON = {
    "Conventions": (
        "All values are in SI units. x and y are Cartesian, rotation is positive about +z (from x to y). A "
        "film force acts on the journal. Outputs are valid from the end of initialization and always belong "
        "to the present inputs, states and time. Inputs are held constant over a step; states may be set "
        "before the simulation starts."
    ),
    "Requirements": (
        "The model runs in Python (3.11 or later, with numpy and scipy) through PythonFMU's libraries, on "
        "the 64-bit platforms that the folder binaries lists. A host that is not Python itself must make "
        "libpython available to the library, on Linux for instance by LD_PRELOAD."
    ),
    "Statuses": (
        "A value that is not finite, an attempt to set an output, or a state at which the model has no "
        "answer (a journal at the wall) ends in fmi2Fatal with the values in the log, because PythonFMU has "
        "no way to fmi2Error. Only this instance is affected. Its later calls fail too, until it is reset or "
        "a saved FMU state is restored. A step that a model with states cannot make is answered by "
        "fmi2Discard with fmi2Terminated true; the states then are those at the start of the step. The log "
        "needs loggingOn."
    ),
}
"""What holds for every FMU that runs in Python."""

PYTHON_STEPPED = {
    **PYTHON,
    "Conventions": (
        "All values are in SI units. The model integrates in time by itself. When initialization ends it "
        "goes to the state that is stationary under the start values of the inputs. Outputs belong to the "
        "end of the last step; inputs set after it act in the next one. The state of the model is no list of "
        "variables: it goes through FMI as one block of bytes, to the last bit."
    ),
    "Statuses": (
        "A value that is not finite, an attempt to set an output, or start values without a stationary state "
        "end in fmi2Fatal with the values in the log, because PythonFMU has no way to fmi2Error. A step that "
        "cannot be made is answered by fmi2Discard with fmi2Terminated true; state, time and outputs stay "
        "those at the start of the step, which may be tried again with other inputs or a shorter step. The "
        "log needs loggingOn."
    ),
}
"""What holds for an FMU of a model with its own integrator."""

NATIVE = {
    "Conventions": (
        "Values are in SI units where a unit is given. Outputs are valid from the end of initialization and "
        "always belong to the present inputs, states, parameters and time. In Co-Simulation inputs are held "
        "constant over a step. States may be set before and during initialization, tunable parameters also "
        "between steps. Directional derivatives (in FMI 3.0 adjoint ones too) are exact: of outputs and "
        "derivatives by inputs and states. The FMU state holds everything, to the last bit."
    ),
    "Requirements": (
        "None: the model is a C library. Its sources, one C99 library without dependencies, are in sources/. "
        "Tables and start values are in resources/rotorfilm.bin, which belongs to this FMU only."
    ),
    "Statuses": (
        "A value that is not finite or out of its bounds, an attempt to set an output, and a state at which "
        "the model has no answer (a journal at the wall) is an error, with the values in the log; the "
        "instance works again after a reset or with a saved FMU state. In Model Exchange such a state is "
        "discarded instead, so that the integrator can try a smaller step. A step of Co-Simulation that a "
        "model with states cannot make is discarded; the states then are those at its start. A state beyond "
        "the table of a film is a warning, once."
    ),
    "Reference": (
        "reference.csv beside this page was computed by the model in Python: time, inputs, outputs. The "
        "inputs of a row are held until the next one, the outputs belong to the row's time and inputs. "
        "'rotorfilm fmu check' replays it."
    ),
}
"""What holds for every native FMU."""

NATIVE_STEPPED = {
    **NATIVE,
    "Conventions": (
        "Values are in SI units where a unit is given. The model integrates in time by itself. When "
        "initialization ends it goes to the state that is stationary under the start values of the inputs. "
        "Outputs belong to the end of the last step; inputs set after it act in the next one. Parameters may "
        "be set between steps too. The state of the model is no list of variables: it goes through FMI as "
        "one block of bytes, to the last bit."
    ),
    "Statuses": (
        "A value that is not finite or out of its bounds, an attempt to set an output, and start values "
        "without a stationary state (a journal at the wall) are errors, with the values in the log; the "
        "instance works again after a reset or with a saved FMU state. A step that cannot be made, as one in "
        "which the journal gets to the wall, is discarded: state, time and outputs stay those at its start. "
        "With a state saved before it, it may be tried again, shorter or with other inputs."
    ),
}
"""What holds for a native FMU of a model with its own integrator."""

PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{title}</title></head>
<body>
<h1>{title}</h1>
{body}
</body>
</html>
"""


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
