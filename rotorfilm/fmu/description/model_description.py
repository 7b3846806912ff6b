"""What a modelDescription.xml says, and the parts of it that FMI 2.0 and 3.0 share."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import NamedTuple, Protocol
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ...errors import InputError
from ...signals import Variable
from ...units import DISPLAY_UNITS, UNITS
from .dependencies import Dependencies, Unknown

QUANTITIES = {
    "m": "Length",
    "s": "Time",
    "kg": "Mass",
    "rad": "Angle",
    "m/s": "Velocity",
    "m/s2": "Acceleration",
    "rad/s": "AngularVelocity",
    "rad/s2": "AngularAcceleration",
    "N": "Force",
    "N/m": "Stiffness",
    "N.s/m": "Damping",
    "Pa": "Pressure",
    "Pa.s": "DynamicViscosity",
    "kg.m": "Unbalance",
}
"""Names of the types, by unit; a unit that is not here has a type without a name."""

SHOWN = {"m": "um", "rad": "deg", "rad/s": "rpm", "N": "kN", "Pa.s": "mPa s", "kg.m": "g mm"}
"""The unit in which a tool should show values of a unit."""


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
    copyright : str
    interfaces : mapping of str to mapping
        Attributes of ModelExchange and CoSimulation, as the FMI version spells them.
    categories : mapping of str to str
        Log categories and what they log.
    variables : tuple of Variable
    dependencies : Dependencies
    stop_time, step_size : float [s]
        Default experiment.
    sources : tuple of str
        C files below `sources/` that make the binary.
    author : str
        Who made the model; empty where nobody is named.
    structured : bool
        Whether names are `component.signal`.
    """

    identifier: str
    title: str
    tool: str
    copyright: str
    interfaces: Mapping[str, Mapping[str, str]]
    categories: Mapping[str, str]
    variables: tuple[Variable, ...]
    dependencies: Dependencies
    stop_time: float
    step_size: float
    sources: tuple[str, ...] = ()
    author: str = ""
    structured: bool = True

    @property
    def tunable(self) -> bool:
        """Whether a parameter may change while the simulation runs."""
        return any(variable.variability == "tunable" for variable in self.variables)


class Dialect(Protocol):
    """How one FMI version writes what both say."""

    version: str
    token: str

    def add_interface(self, root: Element, name: str, description: Description) -> None:
        """Add ModelExchange or CoSimulation."""

    def add_type(self, parent: Element, attributes: Mapping[str, str]) -> None:
        """Add the type of a quantity."""

    def add_variable(self, parent: Element, reference: int, variable: Variable) -> None:
        """Add a variable."""

    def add_structure(self, structure: Element, description: Description) -> None:
        """Add what the unknowns depend on."""


def to_xml(description: Description, dialect: Dialect, token: str) -> bytes:
    """Return modelDescription.xml; equal arguments give equal bytes.

    Parameters
    ----------
    description : Description
    dialect : Dialect
    token : str
        What FMI 2.0 calls guid, FMI 3.0 instantiationToken.
    """
    root = Element(
        "fmiModelDescription",
        {
            "fmiVersion": dialect.version,
            "modelName": description.identifier,
            dialect.token: token,
            "description": description.title,
            **({"author": description.author} if description.author else {}),
            "copyright": description.copyright,
            "license": "MIT, see documentation/licenses",
            "generationTool": description.tool,
            **_generated(),
            "variableNamingConvention": "structured" if description.structured else "flat",
        },
    )
    for name in description.interfaces:
        dialect.add_interface(root, name, description)
    _add_units(root, description.variables)
    types = SubElement(root, "TypeDefinitions")
    for attributes in _type_attributes(description.variables):
        dialect.add_type(types, attributes)
    categories = SubElement(root, "LogCategories")
    for name, text in description.categories.items():
        SubElement(categories, "Category", name=name, description=text)
    experiment = {"stopTime": repr(description.stop_time), "stepSize": repr(description.step_size)}
    SubElement(root, "DefaultExperiment", {"startTime": "0.0", **experiment})
    variables = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(description.variables):
        dialect.add_variable(variables, reference, variable)
    dialect.add_structure(SubElement(root, "ModelStructure"), description)
    return to_bytes(root)


def _generated() -> dict[str, str]:
    """Return when the FMU was made, as SOURCE_DATE_EPOCH says, so that equal builds are equal to the byte."""
    seconds = os.environ.get("SOURCE_DATE_EPOCH", "")
    if not seconds:
        return {}
    try:
        made = datetime.fromtimestamp(int(seconds), tz=UTC)
    except (ValueError, OverflowError, OSError):
        raise InputError(
            f"SOURCE_DATE_EPOCH must be a whole number of seconds since 1970, got {seconds!r}"
        ) from None
    return {"generationDateAndTime": made.strftime("%Y-%m-%dT%H:%M:%SZ")}


def _add_units(root: Element, variables: tuple[Variable, ...]) -> None:
    """Add the units in use, each with its SI base units and the unit to show it in."""
    definitions = SubElement(root, "UnitDefinitions")
    for name in sorted({variable.unit for variable in variables if variable.unit is not None}):
        unit = SubElement(definitions, "Unit", name=name)
        exponents = UNITS[name].exponents
        SubElement(unit, "BaseUnit", {base: str(power) for base, power in exponents.items()})
        if name in SHOWN:
            factor = UNITS[name].factor / DISPLAY_UNITS[SHOWN[name]].factor
            SubElement(unit, "DisplayUnit", name=SHOWN[name], factor=repr(factor))


def _type_attributes(variables: tuple[Variable, ...]) -> list[dict[str, str]]:
    """Return the attributes of the types in use: quantity, unit and display unit, sorted by name."""
    units = {v.unit for v in variables if v.unit in QUANTITIES}
    types = [{"quantity": QUANTITIES[unit], "unit": unit, **_shown(unit)} for unit in units if unit]
    return sorted(types, key=lambda attributes: attributes["quantity"])


def value_attributes(variable: Variable) -> dict[str, str]:
    """Return type, unit, bounds, nominal and start value of a variable."""
    attributes = {} if variable.unit not in QUANTITIES else {"declaredType": QUANTITIES[variable.unit]}
    if variable.unit is not None:
        attributes |= {"unit": variable.unit, **_shown(variable.unit)}
    bounds = {"min": variable.minimum, "max": variable.maximum}
    numbers = {name: bound for name, bound in bounds.items() if math.isfinite(bound)}
    rest = {"nominal": variable.nominal, "start": variable.start}
    numbers |= {name: value for name, value in rest.items() if value is not None}
    return attributes | {name: repr(float(value)) for name, value in numbers.items()}


def variable_attributes(variable: Variable, reference: int) -> dict[str, str]:
    """Return what is said of a variable besides its values."""
    attributes = {
        "name": variable.name,
        "valueReference": str(reference),
        "description": variable.description,
        "causality": variable.causality,
        "variability": variable.variability,
    }
    if variable.causality in ("input", "independent"):  # where FMI fixes `initial`
        return attributes
    return {**attributes, "initial": "calculated" if variable.start is None else "exact"}


def unknown_attributes(unknown: Unknown, first: int) -> dict[str, str]:
    """Return what an unknown depends on, by places among the variables that count from `first`."""
    return {
        "dependencies": " ".join(str(known + first) for known in unknown.knowns),
        "dependenciesKind": " ".join(unknown.kinds),
    }


def to_bytes(root: Element) -> bytes:
    """Return the document, indented."""
    indent(root)
    return tostring(root, encoding="UTF-8", xml_declaration=True) + b"\n"


def _shown(unit: str) -> dict[str, str]:
    return {"displayUnit": SHOWN[unit]} if unit in SHOWN else {}
