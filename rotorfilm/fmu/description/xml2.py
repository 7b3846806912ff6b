"""modelDescription.xml of FMI 2.0."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement

from ...signals import Variable
from .dependencies import Unknown, initial_unknowns, running_unknowns
from .model_description import (
    Description,
    add_categories,
    add_experiment,
    add_units,
    header,
    initial,
    to_bytes,
    type_attributes,
    value_attributes,
)
from .variables import derivative_references, switch_references


def to_xml2(description: Description, guid: str) -> bytes:
    """Return modelDescription.xml; equal arguments give equal bytes."""
    root = header(description, "2.0", guid)
    switches = switch_references(description.variables)
    if switches:
        root.set("numberOfEventIndicators", str(len(switches)))
    for name, attributes in description.interfaces.items():
        interface = SubElement(root, name, {"modelIdentifier": description.identifier, **attributes})
        _add_sources(interface, description.sources)
    add_units(root, description.variables)
    types = SubElement(root, "TypeDefinitions")
    for attributes in type_attributes(description.variables):
        SubElement(SubElement(types, "SimpleType", name=attributes["quantity"]), "Real", attributes)
    add_categories(root, description.categories)
    add_experiment(root, description)
    parent = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(description.variables):
        _add_variable(parent, reference, variable)
    _add_structure(root, description)
    return to_bytes(root)


def _add_sources(interface: Element, sources: tuple[str, ...]) -> None:
    if sources:
        files = SubElement(interface, "SourceFiles")
        for name in sources:
            SubElement(files, "File", name=name)


def _add_variable(parent: Element, reference: int, variable: Variable) -> None:
    scalar = SubElement(
        parent,
        "ScalarVariable",
        {
            "name": variable.name,
            "valueReference": str(reference),
            "description": variable.description,
            "causality": variable.causality,
            "variability": variable.variability,
            **initial(variable),
        },
    )
    attributes = value_attributes(variable)
    if variable.state is not None:
        attributes["derivative"] = str(variable.state + 1)
    SubElement(scalar, "Real", attributes)


def _add_structure(root: Element, description: Description) -> None:
    variables = description.variables
    slopes = set(derivative_references(variables))
    running = running_unknowns(variables, description.dependencies, description.tunable)
    structure = SubElement(root, "ModelStructure")
    _add_unknowns(structure, "Outputs", [u for u in running if u.reference not in slopes])
    if slopes:
        _add_unknowns(structure, "Derivatives", [u for u in running if u.reference in slopes])
    _add_unknowns(structure, "InitialUnknowns", initial_unknowns(variables, description.dependencies))


def _add_unknowns(structure: Element, name: str, unknowns: Sequence[Unknown]) -> None:
    parent = SubElement(structure, name)
    for unknown in unknowns:
        SubElement(
            parent,
            "Unknown",
            index=str(unknown.reference + 1),
            dependencies=" ".join(str(known + 1) for known in unknown.knowns),
            dependenciesKind=" ".join(unknown.kinds),
        )
