"""Related files in an FMU and their roles, as the layered standard FMI-LS-REF 1.0 describes them."""

from __future__ import annotations

import platform
import sys
from collections.abc import Sequence
from contextlib import closing
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, SubElement, parse
from zipfile import ZipFile

from ..core.errors import FmuError
from ..core.files import write_atomically
from . import instance as fmus
from .archive import to_zip
from .description import manifest_attributes, to_bytes
from .native.platforms import MACHINES, SYSTEMS, TARGETS
from .system_export import Format, parameter_set

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
MANIFEST = f"{FOLDER}/fmi-ls-manifest.xml"
TEXT = "Layered Standard providing information on related files included in an FMU."
VERSION = "1.0.0-alpha.1"
"""The version that the public text of the standard names in its latest edition, 1.0.0-beta.1."""

REFERENCE = "documentation/reference.csv"
STATE = "serialized-state"

SMOKE_ROWS = 4
"""Rows of the reference trajectory that a smoke test repeats."""

MOST_STEPS = 1000
"""Steps to the state that is saved."""


class Related(NamedTuple):
    """A file in the FMU, its content if it is new, and what the manifest says of it."""

    source: str
    content: bytes | None
    kind: str
    role: str
    description: str


def add_references(path: str | PathLike[str]) -> Path:
    """Add the files of FMI-LS-REF to a native FMU: `extra/org.fmi-standard.fmi-ls-ref/`.

    They are the values of all parameters (`parameters.ssv`, SSP) and a smoke test (`smoke_test.csv`, the
    first rows of the reference trajectory). A model with a state also has this state in Co-Simulation at the
    end of the default experiment, under the start values of the inputs (`warm_state.bin`, for this
    machine). The manifest names them, and the reference trajectory as the validation experiment.

    Parameters
    ----------
    path : path of the .fmu file
        It is replaced.

    Returns
    -------
    Path

    Raises
    ------
    FmuError
        If the file cannot be read, has no reference trajectory, or does not run.
    """
    with fmus.extracted(path) as (description, folder):
        reference = Path(folder, REFERENCE)
        if not reference.is_file():
            raise FmuError(f"fmu must have {REFERENCE}, as native FMUs of this package, got {str(path)!r}")
        rows = reference.read_bytes().splitlines(keepends=True)[: 1 + SMOKE_ROWS]
        related = [_parameters(description), *_warm_state(description, folder)]
        table = "text/csv", "time, inputs held until the next row, outputs"
        related += [
            Related("smoke_test.csv", b"".join(rows), table[0], "experiment/smoke-test", table[1]),
            Related(f"../../{REFERENCE}", None, table[0], "experiment/validation", table[1]),
        ]
    with ZipFile(path) as archive:
        contents = {name: archive.read(name) for name in archive.namelist() if not name.startswith(FOLDER)}
    contents |= {f"{FOLDER}/{one.source}": one.content for one in related if one.content is not None}
    return write_atomically(Path(path), to_zip({**contents, MANIFEST: manifest(related)}))


def manifest(related: Sequence[Related]) -> bytes:
    """Return fmi-ls-manifest.xml of FMI-LS-REF."""
    named = {"name": "org.fmi-standard.fmi-ls-ref", "version": VERSION, "description": TEXT}
    root = Element("fmiReferences", manifest_attributes(named))
    for one in related:
        told = {"type": one.kind, "source": one.source, "role": one.role, "description": one.description}
        SubElement(root, "Related", told)
    return to_bytes(root)


def missing_references(folder: str) -> list[str] | None:
    """Return the files that are not there but in the manifest of an extracted FMU; None without one."""
    path = Path(folder, MANIFEST)
    if not path.is_file():
        return None
    sources = [element.get("source", "") for element in parse(path).getroot().iter("Related")]
    return [source for source in sources if ":" not in source and not (path.parent / source).is_file()]


def _parameters(description: Any) -> Related:
    chosen = [v for v in fmus.reals_of(description) if v.causality == "parameter"]
    content = parameter_set(description.modelName, [(v.name, v) for v in chosen], Format())
    return Related(
        "parameters.ssv", content, "application/x-ssp-parameter-set", "parameter", "values of all parameters"
    )


def _warm_state(description: Any, folder: str) -> list[Related]:
    """Return the state at the end of the default experiment; nothing of a model that has none."""
    stateless = description.modelExchange is not None and not description.derivatives
    if stateless or description.coSimulation is None or not fmus.provides(folder, fmus.SERIAL_STATES):
        return []
    experiment = description.defaultExperiment
    step = float(experiment.stepSize)
    count = min(round(float(experiment.stopTime) / step), MOST_STEPS)
    with closing(fmus.instantiated(description, folder, False)) as instance:
        instance.initialize([], [])
        for k in range(count):
            instance.step(k * step, step)
        saved = instance.save()
        content = instance.serialize(saved)
        instance.release(saved)
    text = f"state in Co-Simulation at t = {count * step:.9g} s under the start values of the inputs"
    return [
        Related(
            "warm_state.bin",
            content,
            "application/octet-stream",
            f"{STATE}/{_host(description.fmiVersion)}",
            text,
        )
    ]


def _host(version: str) -> str:
    """Return what a version of FMI calls this machine."""
    folder = f"{MACHINES.get(platform.machine().lower())}-{SYSTEMS.get(sys.platform)}"
    named = {target.folder: target.folder2 for target in TARGETS} if version == "2.0" else {}
    return named.get(folder, folder)
