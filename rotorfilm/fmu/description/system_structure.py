"""SystemStructure.ssd and a parameter set of SSP 1.0: components, connections, parameters, units."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, SubElement

from ...units import UNITS
from .model_description import to_bytes

VERSION = "1.0"
NAMESPACES = {
    f"xmlns:{short}": f"http://ssp-standard.org/SSP1/SystemStructure{name}"
    for short, name in (("ssc", "Common"), ("ssd", "Description"), ("ssv", "ParameterValues"))
}
PARAMETERS = "resources/parameters.ssv"


class Component(NamedTuple):
    """An FMU of the system.

    Attributes
    ----------
    name : str
    source : str
        Path of the FMU in the archive.
    variables : tuple of fmpy variables
        Inputs and outputs that are connected, and all parameters.
    """

    name: str
    source: str
    variables: tuple[Any, ...]


class Connection(NamedTuple):
    """An output of a component that goes into an input of another one: names of components and variables."""

    start: str
    output: str
    end: str
    input: str


def system_structure(
    name: str, components: Sequence[Component], connections: Sequence[Connection], stop_time: float
) -> bytes:
    """Return SystemStructure.ssd.

    Parameters
    ----------
    name : str
        Of the system.
    components : sequence of Component
    connections : sequence of Connection
    stop_time : float [s]
        Of the default experiment.
    """
    root = Element("ssd:SystemStructureDescription", {**NAMESPACES, "version": VERSION, "name": name})
    system = SubElement(root, "ssd:System", name=name)
    bindings = SubElement(system, "ssd:ParameterBindings")
    SubElement(bindings, "ssd:ParameterBinding", source=PARAMETERS)
    elements = SubElement(system, "ssd:Elements")
    for component in components:
        _add_component(elements, component)
    parent = SubElement(system, "ssd:Connections")
    for link in connections:
        ends = {"startElement": link.start, "startConnector": link.output}
        SubElement(parent, "ssd:Connection", {**ends, "endElement": link.end, "endConnector": link.input})
    _add_units(SubElement(root, "ssd:Units"), components)
    SubElement(root, "ssd:DefaultExperiment", startTime="0.0", stopTime=repr(stop_time))
    return to_bytes(root)


def parameter_set(name: str, components: Sequence[Component]) -> bytes:
    """Return the values of all parameters, by `component.parameter`."""
    root = Element("ssv:ParameterSet", {**NAMESPACES, "version": VERSION, "name": name})
    parent = SubElement(root, "ssv:Parameters")
    for component in components:
        for variable in component.variables:
            if variable.causality == "parameter":
                parameter = SubElement(parent, "ssv:Parameter", name=f"{component.name}.{variable.name}")
                SubElement(parameter, "ssv:Real", {"value": variable.start, **_unit(variable)})
    _add_units(SubElement(root, "ssv:Units"), components)
    return to_bytes(root)


def _add_component(elements: Element, component: Component) -> None:
    kind = {"type": "application/x-fmu-sharedlibrary", "implementation": "CoSimulation"}
    said = {"name": component.name, "source": component.source, **kind}
    connectors = SubElement(SubElement(elements, "ssd:Component", said), "ssd:Connectors")
    for variable in component.variables:
        connector = SubElement(connectors, "ssd:Connector", name=variable.name, kind=variable.causality)
        SubElement(connector, "ssc:Real", _unit(variable))


def _add_units(parent: Element, components: Sequence[Component]) -> None:
    for name in sorted({v.unit for component in components for v in component.variables if v.unit}):
        unit = SubElement(parent, "ssc:Unit", name=name)
        powers = {base: str(power) for base, power in UNITS[name].exponents.items()}
        SubElement(unit, "ssc:BaseUnit", powers)


def _unit(variable: Any) -> dict[str, str]:
    return {"unit": variable.unit} if variable.unit else {}
