"""modelDescription.xml of FMI 2.0."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from xml.etree.ElementTree import Element, SubElement

from ...signals import Variable
from .dependencies import Unknown, initial_unknowns, running_unknowns
from .model_description import Description, unknown_attributes, value_attributes, variable_attributes
from .variables import derivative_references, switch_references


class Dialect2:
    """How FMI 2.0 writes it; see `Dialect`."""

    version, token = "2.0", "guid"

    def add_interface(self, root: Element, name: str, description: Description) -> None:
        """Add an interface with its sources; the number of event indicators is said at the root."""
        if switches := switch_references(description.variables):
            root.set("numberOfEventIndicators", str(len(switches)))
        attributes = {"modelIdentifier": description.identifier, **description.interfaces[name]}
        interface = SubElement(root, name, attributes)
        if description.sources:
            files = SubElement(interface, "SourceFiles")
            for source in description.sources:
                SubElement(files, "File", name=source)

    def add_type(self, parent: Element, attributes: Mapping[str, str]) -> None:
        """Add a type."""
        SubElement(SubElement(parent, "SimpleType", name=attributes["quantity"]), "Real", dict(attributes))

    def add_variable(self, parent: Element, reference: int, variable: Variable) -> None:
        """Add a variable."""
        scalar = SubElement(parent, "ScalarVariable", variable_attributes(variable, reference))
        slope = {} if variable.state is None else {"derivative": str(variable.state + 1)}
        SubElement(scalar, "Real", value_attributes(variable) | slope)

    def add_structure(self, structure: Element, description: Description) -> None:
        """Add outputs, derivatives and initial unknowns, by places that count from 1."""
        variables = description.variables
        slopes = set(derivative_references(variables))
        running = running_unknowns(variables, description.dependencies, description.tunable)
        _add_unknowns(structure, "Outputs", [u for u in running if u.reference not in slopes])
        if slopes:
            _add_unknowns(structure, "Derivatives", [u for u in running if u.reference in slopes])
        _add_unknowns(structure, "InitialUnknowns", initial_unknowns(variables, description.dependencies))


def _add_unknowns(structure: Element, name: str, unknowns: Sequence[Unknown]) -> None:
    parent = SubElement(structure, name)
    for unknown in unknowns:
        index = {"index": str(unknown.reference + 1)}
        SubElement(parent, "Unknown", {**index, **unknown_attributes(unknown, 1)})
