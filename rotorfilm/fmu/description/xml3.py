"""modelDescription.xml, buildDescription.xml and terminalsAndIcons.xml of FMI 3.0."""

from __future__ import annotations

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

VERSION = "3.0"


def to_xml3(description: Description, token: str) -> bytes:
    """Return modelDescription.xml; equal arguments give equal bytes."""
    root = header(description, VERSION, token)
    for name, attributes in description.interfaces.items():
        SubElement(root, name, {"modelIdentifier": description.identifier, **attributes})
    add_units(root, description.variables)
    types = SubElement(root, "TypeDefinitions")
    for attributes in type_attributes(description.variables):
        SubElement(types, "Float64Type", {"name": attributes["quantity"], **attributes})
    add_categories(root, description.categories)
    add_experiment(root, description)
    parent = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(description.variables):
        _add_variable(parent, reference, variable)
    _add_structure(root, description)
    return to_bytes(root)


def build_description(identifier: str, sources: tuple[str, ...]) -> bytes:
    """Return buildDescription.xml: which files below `sources/` make the binary."""
    root = Element("fmiBuildDescription", fmiVersion=VERSION)
    configuration = SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    files = SubElement(configuration, "SourceFileSet", language="C99")
    for name in sources:
        SubElement(files, "SourceFile", name=name)
    return to_bytes(root)


def icon_description() -> bytes:
    """Return terminalsAndIcons.xml: the size of icon.png on a diagram."""
    root = Element("fmiTerminalsAndIcons", fmiVersion=VERSION)
    corners = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
    graphics = SubElement(root, "GraphicalRepresentation")
    SubElement(graphics, "CoordinateSystem", {**corners, "suggestedScalingFactorTo_mm": "0.1"})
    SubElement(graphics, "Icon", corners)
    return to_bytes(root)


def _add_variable(parent: Element, reference: int, variable: Variable) -> None:
    attributes = value_attributes(variable)
    if variable.state is not None:
        attributes["derivative"] = str(variable.state)
    SubElement(
        parent,
        "Float64",
        {
            "name": variable.name,
            "valueReference": str(reference),
            "description": variable.description,
            "causality": variable.causality,
            "variability": variable.variability,
            **initial(variable),
            **attributes,
        },
    )


def _add_structure(root: Element, description: Description) -> None:
    variables = description.variables
    slopes = set(derivative_references(variables))
    structure = SubElement(root, "ModelStructure")
    for unknown in running_unknowns(variables, description.dependencies, description.tunable):
        _add(structure, "ContinuousStateDerivative" if unknown.reference in slopes else "Output", unknown)
    for unknown in initial_unknowns(variables, description.dependencies):
        _add(structure, "InitialUnknown", unknown)
    for reference in switch_references(variables):
        SubElement(structure, "EventIndicator", valueReference=str(reference))


def _add(structure: Element, name: str, unknown: Unknown) -> None:
    SubElement(
        structure,
        name,
        valueReference=str(unknown.reference),
        dependencies=" ".join(map(str, unknown.knowns)),
        dependenciesKind=" ".join(unknown.kinds),
    )
