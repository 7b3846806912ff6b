"""Reading the modelDescription.xml of an FMU; what is none is refused by the rule that it breaks."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree.ElementTree import parse
from zipfile import ZipFile

import fmpy
from fmpy.model_description import ValidationError

from ..errors import FmuFileError

ROOT = "fmiModelDescription"


def read_description(path: str) -> Any:
    """Return fmpy's description of an FMU; it need not follow the schema where that does no harm.

    Raises
    ------
    FmuFileError
        If the file is no FMU of FMI 2.0 or 3.0, or its description lacks what every use of it needs.
    """
    if not Path(path).is_file():
        raise _unreadable(path, "no such file")
    _require_version(path)
    try:
        description = fmpy.read_model_description(path, validate=False)
    except Exception as error:
        # What fmpy stumbles over is for the schema to name.
        raise _unreadable(path, _first_problem(path) or str(error)) from error
    _require_essentials(path, description)
    return description


def _require_version(path: str) -> None:
    try:
        with ZipFile(path) as archive, archive.open("modelDescription.xml") as file:
            root = parse(file).getroot()
    except Exception as error:
        # Damaged archives raise what their decompressors do, and an EOFError without a word.
        raise _unreadable(path, str(error) or type(error).__name__) from error
    if root.tag != ROOT:
        raise _unreadable(path, f"the root of modelDescription.xml is {root.tag}, not {ROOT}")
    version = root.get("fmiVersion", "no version")
    if not version.startswith(("2.0", "3.0")):
        raise FmuFileError(f"fmu must be of FMI 2.0 or 3.0, got {version} in {path!r}")


def _require_essentials(path: str, description: Any) -> None:
    interfaces = (description.coSimulation, description.modelExchange)
    for interface in interfaces:
        if interface is not None and not interface.modelIdentifier:
            raise _unreadable(path, "an interface has no modelIdentifier")
    if not description.guid:
        raise _unreadable(path, "it has no guid or instantiationToken")
    for unknown in description.derivatives:
        variable = unknown.variable
        if variable.derivative is None:
            raise _unreadable(path, f"{variable.name} is listed as a derivative, but says not of what")


def _first_problem(path: str) -> str | None:
    """Return the first deviation from the schema, if that says more than what went wrong."""
    try:
        fmpy.read_model_description(path, validate=True)
    except ValidationError as error:
        return f"modelDescription.xml, {error.problems[0]}"
    except Exception:
        return None
    return None


def _unreadable(path: str, why: str) -> FmuFileError:
    return FmuFileError(f"fmu must be a readable FMU, got {path!r}: {why}")
