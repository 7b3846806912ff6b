"""The zip that an FMU is, byte for byte determined by its content, and what comes from installed packages."""

from __future__ import annotations

import hashlib
import io
import uuid
from collections.abc import Iterable, Mapping
from importlib.metadata import distribution, version
from importlib.resources import files
from pathlib import Path, PurePosixPath
from typing import Any
from xml.etree.ElementTree import parse
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import fmpy
from fmpy.model_description import ValidationError

from ..core.errors import FmuError, FmuFileError
from ..core.sources import PACKAGE

EPOCH = (1980, 1, 1, 0, 0, 0)
"""The earliest time that a zip entry can have; the build time would make each build different."""

NAMESPACE = uuid.UUID("6f0f6a52-9c0e-5d6b-8a53-3f5f1d7b2c11")
"""Namespace of the guids, which are uuid5 of an FMU's content."""

BINARIES = ("linux64/libpythonfmu-export.so", "win64/pythonfmu-export.dll")
"""PythonFMU's libraries for the FMI 2.0 platforms that it supports."""

COMPILED = {".so", ".dll", ".dylib"}
"""Files that run on one platform."""

VERIFIED = "0.7.0"
"""The version of pythonfmu for which `python/slave.py` counts references; up to 0.6.9 hosts crash."""

VERIFIED_LIBRARIES = "7ffef76339110ef4"
"""First digits of the SHA-256 of its libraries, which a later version may have too."""


def require_verified_version() -> None:
    """Raise FmuError unless pythonfmu has the libraries that `python/slave.py` was verified for.

    With libraries that count differently, the references it takes would leak instances, or crash the host.
    """
    installed, folder = version("pythonfmu"), files("pythonfmu").joinpath("resources", "binaries")
    if installed == VERIFIED:
        return
    libraries = [folder.joinpath(name) for name in BINARIES]
    content = b"".join(library.read_bytes() for library in libraries if library.is_file())
    if hashlib.sha256(content).hexdigest()[:16] != VERIFIED_LIBRARIES:
        raise FmuError(
            f"pythonfmu must be {VERIFIED}, or a version with the same libraries, to export an FMU, "
            f"got {installed}"
        )


def to_zip(contents: Mapping[str, bytes]) -> bytes:
    """Return a zip of `contents` (by path), with sorted entries and fixed times."""
    buffer = io.BytesIO()
    with ZipFile(buffer, "w", ZIP_DEFLATED) as archive:
        for path, content in sorted(contents.items()):
            entry = ZipInfo(path, EPOCH)
            entry.compress_type = ZIP_DEFLATED
            entry.create_system = 3
            entry.external_attr = 0o100644 << 16
            archive.writestr(entry, content)
    return buffer.getvalue()


def binaries(identifier: str, resources: Iterable[str] = ()) -> dict[str, bytes]:
    """Return PythonFMU's libraries by their path in the FMU.

    Parameters
    ----------
    identifier : str
        Name of the libraries.
    resources : iterable of str
        Files in the FMU. Where compiled ones are among them, the FMU is for their platforms alone.

    Raises
    ------
    FmuError
        If the installed pythonfmu lacks a library, or has none for the platform of the compiled files.
    """
    compiled = {PurePosixPath(name).suffix for name in resources} & COMPILED
    wanted = [name for name in BINARIES if not compiled or PurePosixPath(name).suffix in compiled]
    if not wanted:
        raise FmuError(
            "model must not need compiled code on a platform for which PythonFMU has no library, "
            f"got code in {sorted(compiled)}"
        )
    found = {}
    for name in wanted:
        source = files("pythonfmu").joinpath("resources", "binaries", name)
        if not source.is_file():
            raise FmuError(f"pythonfmu must contain resources/binaries/{name}, install pythonfmu {VERIFIED}")
        platform, _, library = name.partition("/")
        suffix = library.rpartition(".")[2]
        found[f"binaries/{platform}/{identifier}.{suffix}"] = source.read_bytes()
    return found


def licenses(packages: tuple[str, ...]) -> dict[str, bytes]:
    """Return the license of each installed package by its path in the FMU."""
    texts = {name: _license(name) for name in packages}
    return {f"documentation/licenses/{name}.txt": text.encode() for name, text in texts.items()}


def _license(package: str) -> str:
    text = distribution(package).read_text("licenses/LICENSE")
    return text if text is not None else f"{package} is distributed under the MIT license.\n"


def copyright_line() -> str:
    """Return the line of the license that names the holder."""
    text = _license(PACKAGE)
    return next((line.strip() for line in text.splitlines() if line.startswith("Copyright")), "")


def content_hash(contents: Mapping[str, bytes]) -> str:
    """Return 16 hexadecimal digits that change with any name or content."""
    digest = hashlib.sha256()
    for name, content in sorted(contents.items()):
        for part in (name.encode(), content):
            digest.update(len(part).to_bytes(8, "big") + part)
    return digest.hexdigest()[:16]


def guid_of(contents: Mapping[str, bytes], xml: bytes) -> str:
    """Return the guid that follows from all files of an FMU, and from its description without one."""
    return str(uuid.uuid5(NAMESPACE, content_hash({**contents, "xml": xml})))


# Reading the modelDescription.xml of an FMU; what is none is refused by the rule that it breaks.


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
        description = _described(path, validate=False)
    except Exception as error:
        # What fmpy stumbles over is for the schema to name.
        raise _unreadable(path, _first_problem(path) or str(error)) from error
    _require_essentials(path, description)
    return description


def _described(path: str, validate: bool) -> Any:
    with open(path, "rb") as file:  # fmpy leaves a path's own file open where it raises
        return fmpy.read_model_description(file, validate=validate)


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
        _described(path, validate=True)
    except ValidationError as error:
        return f"modelDescription.xml, {error.problems[0]}"
    except Exception:
        return None
    return None


def _unreadable(path: str, why: str) -> FmuFileError:
    return FmuFileError(f"fmu must be a readable FMU, got {path!r}: {why}")
