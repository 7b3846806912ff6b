"""The files of an FMU whose model is a kernel of the C library: FMI 2.0 and 3.0, both interfaces in one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from importlib.metadata import version as installed_version
from importlib.resources import files
from typing import Any, NamedTuple

import numpy as np

from ...core.errors import FmuError
from ...core.model import Array, Dynamic, Model, Stepped, Switched
from ...core.signals import Variable
from ...core.sources import PACKAGE
from ...native.resource import FILE_NAME, carried_library, kernel_row, kernel_texts, pack
from ...native.spec import NativeSpec
from ..archive import guid_of, licenses
from ..description import (
    Description,
    build_description,
    dependencies,
    fmi_variables,
    in_arrays,
    in_maps,
    labelled,
    references,
    require_unique,
    structured_name,
    terminal_files,
    to_xml,
    with_token,
)
from ..documentation import capabilities, general_texts, table_of, to_html
from ..reference import reference_table, to_csv
from .platforms import all_binaries, foreign_licenses, host_binary, model_sources

ICON = "icon.png"
REFERENCE = "documentation/reference.csv"

RATES = {"1": "1/s", "m": "m/s", "m/s": "m/s2", "rad": "rad/s", "rad/s": "rad/s2"}
"""Units of derivatives in time, by the unit of the state."""


class Export(NamedTuple):
    """What is exported, and as what.

    Attributes
    ----------
    model : Model or Stepped
    spec : NativeSpec
        Its kernel.
    component : str
        Name of the FMU and of its component.
    title : str
        One line on the model.
    inputs : ndarray, shape (n_inputs,)
        Start values of the inputs.
    stop_time : float [s]
        Length of the reference trajectory.
    version : str
        "2.0" or "3.0".
    platforms : str
        "host" or "all".
    prefix : str
        What stands before the dot of each variable; empty where names are flat.
    arrays : bool
        Whether vectors are arrays.
    """

    model: Model | Stepped
    spec: NativeSpec
    component: str
    title: str
    inputs: Array
    stop_time: float
    version: str
    platforms: str
    prefix: str
    arrays: bool = False


def native_contents(export: Export, described: dict[str, Any]) -> dict[str, bytes]:
    """Return all files of a native FMU by path; `described` is what any description says.

    Raises
    ------
    FmuError
        If the library is missing or cannot be compiled, or the model has no reference trajectory.
    """
    variables, version = native_model_variables(export), export.version
    sources = model_sources((export.spec.kernel, *export.spec.parts), version)
    compiled = tuple(name for name in sources if name.endswith(".c"))
    times = np.linspace(0.0, export.stop_time, 7).tolist()
    description = Description(
        **described,
        tool=f"{PACKAGE} {installed_version(PACKAGE)}",
        interfaces=_interfaces(export.model, version),
        categories=table_of("interfaces")["native"]["categories"],
        variables=variables,
        dependencies=dependencies(export.model, export.inputs, times),
        sources=compiled,
    )
    contents = {f"sources/{name}": content for name, content in sources.items()}
    if version == "3.0":
        contents["sources/buildDescription.xml"] = build_description(export.component, compiled)
    contents |= _binaries(export, sources) | _files(export, variables)
    resource = f"resources/{FILE_NAME}"
    unnamed = {**contents, resource: pack(export.spec, "", variables)}
    xml = to_xml(description, version)
    token = guid_of(unnamed, xml)
    contents[resource] = pack(export.spec, token, variables)
    return {**contents, "modelDescription.xml": with_token(xml, version, token)}


def _interfaces(model: Model | Stepped, version: str) -> dict[str, dict[str, str]]:
    """Return what the C library can do with a model: one that steps by itself has Co-Simulation alone."""
    every = capabilities("native", version)
    if isinstance(model, Model) and model.states:
        every["CoSimulation"]["maxOutputDerivativeOrder"] = "1"
    if not isinstance(model, Stepped):
        return every
    own = {
        name: "false" if "Derivatives" in f"{name}s" else yes for name, yes in every["CoSimulation"].items()
    }
    return {"CoSimulation": own}


def native_model_variables(export: Export) -> tuple[Variable, ...]:
    """Return time, parameters, inputs, outputs, states, their derivatives, event indicators, in this order.

    Raises
    ------
    FmuError
        If two variables would have the same name.
    """
    model, component = export.model, export.prefix
    time = Variable(name="time", causality="independent", unit="s", description="time")
    parameters = [
        replace(labelled(component, "parameter", p, p.value), tunable=p.tunable)
        for p in export.spec.parameters
    ]
    start = {s.name: float(value) for s, value in zip(model.inputs, export.inputs, strict=True)}
    known = (time, *parameters, *fmi_variables(model, component, start))
    variables = (*known, *_slopes(known), *_switches(export))
    require_unique(variables)
    if export.arrays and export.spec.sampled:
        variables = in_maps(variables)
    return in_arrays(variables, component) if export.arrays else variables


def _slopes(known: tuple[Variable, ...]) -> list[Variable]:
    """Return the derivatives of the states among the variables so far."""
    return [
        Variable(
            name=f"der({known[k].name})",
            causality="local",
            unit=RATES.get(known[k].unit or ""),
            description=f"derivative of {known[k].name}",
            state=k,
        )
        for k in references(known, "local")
    ]


def _switches(export: Export) -> list[Variable]:
    """Return the event indicators of a model that has switching functions."""
    if not (isinstance(export.model, Switched) and isinstance(export.model, Dynamic)):
        return []
    count = len(export.model.events(0.0, export.model.initial_state, export.inputs))
    text = "event indicator: the model is smooth while it keeps its sign"
    labels = [structured_name(export.prefix, f"event_{k}") for k in range(count)]
    return [Variable(name=label, causality="local", description=text, switch=True) for label in labels]


def _binaries(export: Export, sources: Mapping[str, bytes]) -> dict[str, bytes]:
    if export.platforms == "all":
        return all_binaries(export.component, export.version, sources)
    return host_binary(export.component, export.version, carried_library(export.spec))


def _files(export: Export, variables: tuple[Variable, ...]) -> dict[str, bytes]:
    """Return all files but the sources, the libraries, the XML and the resource, by path."""
    return {
        **licenses((PACKAGE,)),
        **foreign_licenses(),
        **_pictures(export),
        **terminal_files(
            export.model,
            export.component,
            variables,
            export.prefix,
            export.version == "3.0",
            export.spec.sampled if export.arrays else None,
        ),
        "documentation/index.html": _page(export, variables),
        REFERENCE: _reference(export, variables),
    }


def _page(export: Export, variables: tuple[Variable, ...]) -> bytes:
    general = general_texts("native", stepped=isinstance(export.model, Stepped))
    texts = {**kernel_texts(export.spec.kernel), **general}
    rows = [f"{p.name} = {p.value!r} {p.unit}: {p.description}" for p in export.spec.parameters]
    tables = [f"{name}: table of shape {np.shape(table)}" for name, table in export.spec.tables.items()]
    return to_html(export.title, variables, texts, "\n".join([*rows, *tables]))


def _reference(export: Export, variables: tuple[Variable, ...]) -> bytes:
    chosen = [0, *references(variables, "input"), *references(variables, "output")]
    table = reference_table(export.model, export.inputs, export.stop_time)
    return to_csv([_column(variables, k) for k in chosen], table)


def _column(variables: tuple[Variable, ...], k: int) -> str:
    """Return the name of a number in a table; elements of arrays count from 1."""
    array = variables[k].array
    return f"{array}[{[v.array for v in variables[:k]].count(array) + 1}]" if array else variables[k].name


def _pictures(export: Export) -> dict[str, bytes]:
    name = f"{kernel_row(export.spec.kernel)[1]}.png"
    picture = files(__package__ or "").joinpath("data", name)
    if not picture.is_file():
        raise FmuError(f"the picture {name} of the package is missing; install {PACKAGE} again")
    content = picture.read_bytes()
    if export.version == "2.0":
        return {"model.png": content}
    return {f"terminalsAndIcons/{ICON}": content, f"documentation/{ICON}": content}
