"""Export of a model as an FMU: checks, the choice of the backend, the archive."""

from __future__ import annotations

import uuid
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import require_positive
from ..files import write_whole
from ..inputs.kinds import arguments
from ..model import Array, Model, Stepped
from ..native.spec import HasKernel
from ..warming import in_time
from .archive import to_zip
from .description.dependencies import Dependencies, delayed_dependencies, dependencies
from .description.model_description import Description, to_xml
from .description.terminals import terminal_files
from .description.variables import fmi_variables
from .description.xml2 import Dialect2
from .description.xml3 import Dialect3
from .export_rules import (
    component_of,
    exported_subject,
    is_native,
    require_component,
    require_output,
    require_supported,
    sized,
    start_values,
    title_of,
)
from .narrow import as_exported
from .native.native_backend import (
    CATEGORIES,
    Export,
    copyright_line,
    interfaces_of,
    native_files,
    native_model_variables,
    native_tool,
    resource,
    source_names,
)
from .python.bundle import content_hash
from .python.python_backend import (
    CATEGORIES as PYTHON_CATEGORIES,
    INTERFACES as PYTHON_INTERFACES,
    python_files,
    python_tool,
)

if TYPE_CHECKING:
    import control

NAMESPACE = uuid.UUID("6f0f6a52-9c0e-5d6b-8a53-3f5f1d7b2c11")
"""Namespace of the guids, which are uuid5 of an FMU's content."""


@arguments
def export_fmu(
    model: Model | Stepped | control.StateSpace,
    path: str | Path,
    version: str = "2.0",
    backend: str | None = None,
    *,
    platforms: str = "host",
    component: str | None = None,
    start: Mapping[str, float] | None = None,
    stop_time: float = 0.1,
    step_size: float = 1e-4,
    author: str = "",
    flat_names: bool = False,
    fixed_size: bool = False,
) -> Path:
    """Write `model` as an FMU.

    A model with a kernel in the C library becomes a native FMU: Model Exchange and Co-Simulation in one,
    with exact directional derivatives, its own sources, tunable parameters and a reference trajectory, and
    without need of Python. Any other becomes an FMI 2.0 Co-Simulation FMU that carries its Python source;
    a Stepped model one whose outputs belong to the end of the last step; with a kernel it is native too, for
    Co-Simulation alone and without derivatives.

    Equal models give byte-identical files. Each signal is a structured variable `component.signal`, each
    state a local `component.state_signal`, settable before the simulation starts. A bearing and a rotor have
    a terminal for each journal, with position, velocity, speed and force. The time of the export is in
    the FMU where the environment variable SOURCE_DATE_EPOCH has it, in seconds since 1970.

    Parameters
    ----------
    model : Model, Stepped or control.StateSpace
        A continuous python-control system is a model whose signals are its labels. For the python backend
        a dataclass (of this package or from a module of the user) whose fields are numbers, bools, strings,
        None, tuples, lists, numpy arrays, functions from the top of such a module, or such dataclasses.
    path : str or Path
        File to write, ending in `.fmu`; its folder is made if need be.
    version : str
        FMI version, "2.0" or "3.0"; the python backend knows "2.0" only.
    backend : str, optional
        What runs the model inside the FMU: "native", the C library, or "python", PythonFMU. By default
        "native" for a model with a kernel, else "python".
    platforms : str
        "host", the platform of this machine, or "all": Linux on x86_64 and aarch64, Windows on x86_64,
        macOS on both, compiled by zig (`pip install 'rotorfilm[platforms]'`). For the native backend.
    component : str, optional
        Identifier in front of the dot of each variable's name, and name of the FMU; by default that of
        a bearing by `as_reaction`, or of the model's class in snake case.
    start : mapping of str to float, optional
        Start values of inputs by signal name, in SI units; 0 where none is given.
    stop_time, step_size : float [s]
        Default experiment that the FMU suggests.
    author : str
        Who made the model, for the description; empty to name nobody.
    flat_names : bool
        Whether variables are named `signal` and `state_signal`, without the component.
    fixed_size : bool
        Whether radius and length of a plain journal bearing stay as they are: the FMU then carries the map of
        their ratio in place of that over all, which makes it a fifth smaller.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    InputError
        If another argument breaks its rule; the message names it.
    FmuError
        If the model cannot be exported, has no kernel for the native backend, zig is needed and not
        installed, or the installed pythonfmu is not the verified version.
    """
    target = Path(path)
    for argument, value in (("stop_time", stop_time), ("step_size", step_size)):
        require_positive(argument, value)
    subject = in_time(exported_subject(model))
    spec = subject.native() if isinstance(subject, HasKernel) else None
    native = is_native(subject, spec, backend)
    spec = sized(spec) if fixed_size else spec
    require_supported(target, version, native, platforms)
    name = component_of(model) if component is None else component
    require_component(name)
    prefix = "" if flat_names else name
    title = title_of(subject)
    subject = as_exported(subject) if native and isinstance(subject, Model) else subject
    inputs = np.array(list(start_values(subject, start or {}).values()))
    require_output(subject, inputs)
    if native and spec is not None:
        export = Export(subject, spec, name, title, inputs, stop_time, version, platforms, prefix)
        contents = _native_contents(export, step_size, author)
    else:
        contents = _python_contents(subject, name, prefix, inputs, stop_time, step_size, author)
    target.parent.mkdir(parents=True, exist_ok=True)
    return write_whole(target, to_zip(contents))


def _native_contents(export: Export, step_size: float, author: str) -> dict[str, bytes]:
    """Return all files of a native FMU by path."""
    variables, model = native_model_variables(export), export.model
    times = np.linspace(0.0, export.stop_time, 7).tolist()
    description = Description(
        identifier=export.component,
        title=export.title,
        tool=native_tool(),
        copyright=copyright_line(),
        interfaces=interfaces_of(model, export.version),
        categories=CATEGORIES,
        variables=variables,
        dependencies=_dependencies(model, export.inputs, times),
        stop_time=float(export.stop_time),
        step_size=float(step_size),
        sources=source_names(),
        author=author,
        structured=bool(export.prefix),
    )
    dialect = Dialect2() if export.version == "2.0" else Dialect3()
    contents = native_files(export, variables)
    token = _guid({**contents, **resource(export, variables, ""), "xml": to_xml(description, dialect, "")})
    contents |= resource(export, variables, token)
    return {**contents, "modelDescription.xml": to_xml(description, dialect, token)}


def _python_contents(
    model: Model | Stepped,
    component: str,
    prefix: str,
    inputs: Array,
    stop_time: float,
    step_size: float,
    author: str,
) -> dict[str, bytes]:
    """Return all files of an FMU of the python backend by path."""
    start = {signal.name: float(value) for signal, value in zip(model.inputs, inputs, strict=True)}
    variables = fmi_variables(model, prefix, start)
    contents = python_files(model, component, title_of(model), start, variables, prefix)
    contents |= terminal_files(model, component, prefix, icon=False)
    description = Description(
        identifier=component,
        title=title_of(model),
        tool=python_tool(),
        copyright=copyright_line(),
        interfaces=PYTHON_INTERFACES,
        categories=PYTHON_CATEGORIES,
        variables=variables,
        dependencies=_dependencies(model, inputs, (0.0,)),
        stop_time=float(stop_time),
        step_size=float(step_size),
        author=author,
        structured=bool(prefix),
    )
    guid = _guid({**contents, "xml": to_xml(description, Dialect2(), "")})
    return {**contents, "modelDescription.xml": to_xml(description, Dialect2(), guid)}


def _dependencies(model: Model | Stepped, inputs: Array, times: Sequence[float]) -> Dependencies:
    if isinstance(model, Stepped):
        return delayed_dependencies(model)
    return dependencies(model, inputs, times)


def _guid(contents: Mapping[str, bytes]) -> str:
    return str(uuid.uuid5(NAMESPACE, content_hash(contents)))
