"""modelDescription.xml and buildDescription.xml of FMI 3.0."""

from __future__ import annotations

from collections.abc import Mapping
from xml.etree.ElementTree import Element, SubElement

from ...signals import Variable
from .dependencies import initial_unknowns, running_unknowns
from .model_description import (
    Description,
    to_bytes,
    unknown_attributes,
    value_attributes,
    variable_attributes,
)
from .variables import derivative_references, switch_references

VERSION = "3.0"


class Dialect3:
    """How FMI 3.0 writes it; see `Dialect`."""

    version, token = VERSION, "instantiationToken"

    def add_interface(self, root: Element, name: str, description: Description) -> None:
        """Add an interface."""
        SubElement(root, name, {"modelIdentifier": description.identifier, **description.interfaces[name]})

    def add_type(self, parent: Element, attributes: Mapping[str, str]) -> None:
        """Add a type."""
        SubElement(parent, "Float64Type", {"name": attributes["quantity"], **attributes})

    def add_variable(self, parent: Element, reference: int, variable: Variable) -> None:
        """Add a variable."""
        slope = {} if variable.state is None else {"derivative": str(variable.state)}
        attributes = variable_attributes(variable, reference) | value_attributes(variable) | slope
        SubElement(parent, "Float64", attributes)

    def add_structure(self, structure: Element, description: Description) -> None:
        """Add outputs, derivatives, initial unknowns and event indicators."""
        variables = description.variables
        slopes = set(derivative_references(variables))
        running = running_unknowns(variables, description.dependencies, description.tunable)
        unknowns = [("ContinuousStateDerivative" if u.reference in slopes else "Output", u) for u in running]
        initial = initial_unknowns(variables, description.dependencies)
        for name, unknown in [*unknowns, *(("InitialUnknown", u) for u in initial)]:
            attributes = {"valueReference": str(unknown.reference), **unknown_attributes(unknown, 0)}
            SubElement(structure, name, attributes)
        for reference in switch_references(variables):
            SubElement(structure, "EventIndicator", valueReference=str(reference))


def build_description(identifier: str, sources: tuple[str, ...]) -> bytes:
    """Return buildDescription.xml: which files below `sources/` make the binary."""
    root = Element("fmiBuildDescription", fmiVersion=VERSION)
    configuration = SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    files = SubElement(configuration, "SourceFileSet", language="C99")
    for name in sources:
        SubElement(files, "SourceFile", name=name)
    return to_bytes(root)
