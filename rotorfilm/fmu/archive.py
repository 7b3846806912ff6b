"""The zip that an FMU is, byte for byte determined by its content, and what comes from installed packages."""

from __future__ import annotations

import io
from collections.abc import Iterable, Mapping
from importlib.metadata import distribution, version
from importlib.resources import files
from pathlib import PurePosixPath
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from ..errors import FmuError

EPOCH = (1980, 1, 1, 0, 0, 0)
"""The earliest time that a zip entry can have; the build time would make each build different."""

BINARIES = ("linux64/libpythonfmu-export.so", "win64/pythonfmu-export.dll")
"""PythonFMU's libraries for the FMI 2.0 platforms that it supports."""

COMPILED = {".so", ".dll", ".dylib"}
"""Files that run on one platform."""

VERIFIED = "0.7.0"
"""The version of pythonfmu for which `pythonfmu_api` counts references."""


def require_verified_version() -> None:
    """Raise FmuError unless the installed pythonfmu is the one that `pythonfmu_api` was verified for.

    With libraries that count differently, the references it takes would leak instances, or crash the host.
    """
    installed = version("pythonfmu")
    if installed != VERIFIED:
        raise FmuError(f"pythonfmu must be {VERIFIED} to export an FMU, got {installed}")


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
