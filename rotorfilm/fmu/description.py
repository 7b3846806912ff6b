"""modelDescription.xml of an FMI 2.0 Co-Simulation FMU."""

from __future__ import annotations

from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ..units import UNITS
from .structure import Dependencies
from .variables import Variable

CAPABILITIES = {
    # The binary is PythonFMU's: it runs the model in a Python interpreter that must be installed.
    "needsExecutionTool": "true",
    "canHandleVariableCommunicationStepSize": "true",
    "canInterpolateInputs": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canNotUseMemoryManagementFunctions": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
    "providesDirectionalDerivative": "false",
}

LOG_CATEGORIES = {
    "logStatusDiscard": "A step that could not be made, with its values.",
    "logAll": "All messages.",
}


class Description(NamedTuple):
    """What the XML says.

    Attributes
    ----------
    identifier : str
        C identifier; name of the binary.
    title : str
        One line on the model.
    tool : str
        Generation tool with versions.
    variables : tuple of Variable
    dependencies : Dependencies
    stop_time, step_size : float [s]
        Default experiment.
    """

    identifier: str
    title: str
    tool: str
    variables: tuple[Variable, ...]
    dependencies: Dependencies
    stop_time: float
    step_size: float


def to_xml(description: Description, guid: str) -> bytes:
    """Return modelDescription.xml; equal arguments give equal bytes."""
    root = Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=description.identifier,
        guid=guid,
        description=description.title,
        license="MIT, see documentation/licenses",
        generationTool=description.tool,
        variableNamingConvention="structured",
    )
    SubElement(root, "CoSimulation", {"modelIdentifier": description.identifier, **CAPABILITIES})
    _add_units(root, description.variables)
    categories = SubElement(root, "LogCategories")
    for name, text in LOG_CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=text)
    SubElement(
        root,
        "DefaultExperiment",
        startTime="0.0",
        stopTime=repr(description.stop_time),
        stepSize=repr(description.step_size),
    )
    _add_variables(root, description.variables)
    _add_structure(root, description.variables, description.dependencies)
    indent(root)
    return tostring(root, encoding="UTF-8", xml_declaration=True) + b"\n"


def _add_units(root: Element, variables: tuple[Variable, ...]) -> None:
    definitions = SubElement(root, "UnitDefinitions")
    for name in sorted({variable.signal.unit for variable in variables}):
        exponents = {base: str(power) for base, power in UNITS[name].exponents.items()}
        SubElement(SubElement(definitions, "Unit", name=name), "BaseUnit", exponents)


def _add_variables(root: Element, variables: tuple[Variable, ...]) -> None:
    parent = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(variables):
        scalar = {
            "name": variable.name,
            "valueReference": str(reference),
            "description": variable.signal.description,
            "causality": variable.causality,
            "variability": "continuous",
        }
        # FMI fixes the initial attribute of an input, so it must not be written.
        if variable.causality != "input":
            scalar["initial"] = "calculated" if variable.start is None else "exact"
        real = {"unit": variable.signal.unit, "nominal": repr(float(variable.signal.nominal))}
        if variable.start is not None:
            real["start"] = repr(variable.start)
        SubElement(SubElement(parent, "ScalarVariable", scalar), "Real", real)


def _add_structure(root: Element, variables: tuple[Variable, ...], dependencies: Dependencies) -> None:
    structure = SubElement(root, "ModelStructure")
    inputs, outputs, states = (
        [index for index, variable in enumerate(variables, start=1) if variable.causality == causality]
        for causality in ("input", "output", "local")
    )
    during = [
        [i for i, depends in zip(inputs, row, strict=True) if depends] for row in dependencies.on_inputs
    ]
    initially = [
        known + [i for i, depends in zip(states, row, strict=True) if depends]
        for known, row in zip(during, dependencies.on_states, strict=True)
    ]
    for name, knowns in (("Outputs", during), ("InitialUnknowns", initially)):
        parent = SubElement(structure, name)
        for index, known in zip(outputs, knowns, strict=True):
            SubElement(
                parent,
                "Unknown",
                index=str(index),
                dependencies=" ".join(map(str, known)),
                dependenciesKind=" ".join("dependent" for _ in known),
            )
