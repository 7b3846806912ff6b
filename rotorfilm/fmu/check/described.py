"""What an FMU says of itself, by fmpy and by its modelDescription.xml."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import parse

import numpy as np

from ...model import Array
from .instance import extracted


def describe_fmu(path: str | PathLike[str]) -> dict[str, Any]:
    """Return what an FMU says of itself: version, interfaces, platforms, capabilities, variables.

    Raises
    ------
    FmuError
        If the file cannot be read.
    """
    with extracted(path) as (description, folder):
        binaries = Path(folder, "binaries")
        found = interfaces(folder)
        return {
            "fmi_version": description.fmiVersion,
            "model_name": description.modelName,
            "token": description.guid,
            "description": description.description,
            "generation_tool": description.generationTool,
            "interfaces": sorted(found),
            "capabilities": sorted(common_capabilities(folder)),
            "platforms": sorted(p.name for p in binaries.iterdir()) if binaries.is_dir() else [],
            "variables": [_row(variable) for variable in description.modelVariables],
        }


def interfaces(folder: str) -> dict[str, dict[str, str]]:
    """Return the attributes of each interface; fmpy 0.3 does not read all of them."""
    root = parse(Path(folder, "modelDescription.xml")).getroot()
    names = ("ModelExchange", "CoSimulation", "ScheduledExecution")
    found = {name: root.find(name) for name in names}
    return {name: dict(element.attrib) for name, element in found.items() if element is not None}


def common_capabilities(folder: str) -> set[str]:
    """Return the attributes that are true for every interface."""
    yes = [
        {name for name, value in attributes.items() if value in ("true", "1")}
        for attributes in interfaces(folder).values()
    ]
    return set.intersection(*yes) if yes else set()


DERIVATIVES = {"providesDirectionalDerivative", "providesDirectionalDerivatives"}
STATES = {"canGetAndSetFMUstate", "canGetAndSetFMUState"}
SERIAL_STATES = {"canSerializeFMUstate", "canSerializeFMUState"}
ADJOINT_DERIVATIVES = {"providesAdjointDerivatives"}
"""Capabilities, as FMI 2.0 and 3.0 spell them."""


def provides(folder: str, *capabilities: set[str]) -> bool:
    """Return whether every interface has all of these capabilities, spelled one way or the other."""
    common = common_capabilities(folder)
    return all(common & spellings for spellings in capabilities)


def _row(variable: Any) -> dict[str, Any]:
    keys = ("name", "causality", "variability", "unit", "start", "description")
    return {key: getattr(variable, key) for key in keys}


def variables_of(description: Any, causality: str) -> list[Any]:
    """Return the real variables of a causality; of "local" the continuous states in Model Exchange."""
    if causality == "local":
        slopes = [unknown.variable for unknown in description.derivatives]
        return [slope.derivative for slope in slopes] if description.modelExchange is not None else []
    return [v for v in reals_of(description) if v.causality == causality]


def reals_of(description: Any) -> list[Any]:
    """Return the real variables."""
    return [v for v in description.modelVariables if v.type in ("Real", "Float64")]


def references_of(description: Any, causality: str) -> list[int]:
    """Return their value references; see `variables_of`."""
    return [variable.valueReference for variable in variables_of(description, causality)]


def starts_of(description: Any, causality: str) -> Array:
    """Return their start values; see `variables_of`."""
    return np.array([float(variable.start or 0.0) for variable in variables_of(description, causality)])


def nominal_of(variable: Any) -> float:
    """Return the nominal value of a variable, 1 where it has none."""
    return abs(float(variable.nominal or 1.0)) or 1.0


def knowns_of(description: Any) -> list[int]:
    """Return the value references by which derivatives are taken: inputs and states."""
    return [*references_of(description, "input"), *references_of(description, "local")]


def known_nominals(description: Any) -> Array:
    """Return the nominal values of `knowns_of`."""
    known = [*variables_of(description, "input"), *variables_of(description, "local")]
    return np.array([nominal_of(variable) for variable in known])


def unknowns_of(description: Any) -> list[int]:
    """Return the value references of which derivatives are taken: outputs and derivatives of states."""
    slopes = description.derivatives if description.modelExchange is not None else []
    return [*references_of(description, "output"), *(u.variable.valueReference for u in slopes)]
