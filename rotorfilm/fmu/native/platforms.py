"""The compiled library for each platform: that of this machine, or all of them compiled by zig."""

from __future__ import annotations

import hashlib
import platform
import struct
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from ...bearings.films.map_table import cache_folder, cached
from ...core.errors import FmuError
from ...native.library import library_path

NATIVE = f"{__name__.partition('.')[0]}.native"


class Target(NamedTuple):
    """A platform on which an FMU may run.

    Attributes
    ----------
    folder : str
        Folder below `binaries/` in FMI 3.0.
    folder2 : str
        The same in FMI 2.0; equal for the two halves of a universal file.
    suffix : str
        Of the library.
    triple : str
        What zig calls it.
    """

    folder: str
    folder2: str
    suffix: str
    triple: str


TARGETS = (
    Target("x86_64-linux", "linux64", "so", "x86_64-linux-gnu.2.17"),
    # FMI 2.0 has no name for it; its tools that know it use the one of FMI 3.0.
    Target("aarch64-linux", "aarch64-linux", "so", "aarch64-linux-gnu.2.17"),
    Target("x86_64-windows", "win64", "dll", "x86_64-windows-gnu"),
    Target("x86_64-darwin", "darwin64", "dylib", "x86_64-macos"),
    Target("aarch64-darwin", "darwin64", "dylib", "aarch64-macos"),
)

SYSTEMS = {"linux": "linux", "win32": "windows", "darwin": "darwin"}
MACHINES = {"x86_64": "x86_64", "amd64": "x86_64", "aarch64": "aarch64", "arm64": "aarch64"}

# As in CMakeLists.txt: the same digits on every machine.
OPTIONS = (
    *("-std=c99", "-O2", "-ffp-contract=off", "-fno-math-errno", "-fvisibility=hidden", "-shared", "-s"),
    *("-ffunction-sections", "-fdata-sections"),
)
UNSHIPPED = ("loops", "master")
"""Folders of what only Python calls."""

_TRIMMED = {"dylib": ("-Wl,-dead_strip",), "so": ("-Wl,--gc-sections",), "dll": ("-Wl,--gc-sections",)}
"""What the linker leaves out: kernels of other libraries."""


def native_sources() -> dict[str, bytes]:
    """Return the C files of the libraries of FMUs, and their headers, by path.

    Raises
    ------
    FmuError
        If the installation lacks them.
    """
    root = Path(str(files(NATIVE)))
    paths = sorted(path for path in root.rglob("*.[ch]") if path.parent.name not in UNSHIPPED)
    found = {path.relative_to(root).as_posix(): path.read_bytes() for path in paths}
    if not any(name.endswith(".c") for name in found):
        raise FmuError(f"the C sources of the library must lie in {root}, got none; install rotorfilm again")
    return found


def foreign_licenses() -> dict[str, bytes]:
    """Return the licenses of what the sources hold of others, by path in the FMU."""
    root = Path(str(files(NATIVE)))
    found = sorted(root.rglob("LICENSE*.txt"))
    return {f"documentation/licenses/{path.parent.name}.txt": path.read_bytes() for path in found}


def host_binary(identifier: str, fmi_version: str, library: str) -> dict[str, bytes]:
    """Return a library (`native.resource.libraries`) of this machine by its path in the FMU.

    Raises
    ------
    FmuError
        If the machine is none for which FMI has a name.
    NativeLibraryError
        If the library is missing.
    """
    machine = MACHINES.get(platform.machine().lower())
    folder = f"{machine}-{SYSTEMS.get(sys.platform)}"
    target = next((target for target in TARGETS if target.folder == folder), None)
    if target is None:
        raise FmuError(f"machine must be one of {[t.folder for t in TARGETS]}, got {folder}")
    return {_path(target, identifier, fmi_version): library_path(library).read_bytes()}


def all_binaries(identifier: str, fmi_version: str, library: str) -> dict[str, bytes]:
    """Return a library for all `TARGETS` by their paths in the FMU, compiled where not in the cache.

    FMI 2.0 has one folder for both kinds of Macs: they share a universal file there.

    Raises
    ------
    FmuError
        If zig is not installed or cannot compile the library.
    """
    sources = native_sources()
    slices: dict[str, list[bytes]] = {}
    for target in TARGETS:
        slices.setdefault(_path(target, identifier, fmi_version), []).append(
            compiled(target, sources, library)
        )
    return {path: parts[0] if len(parts) == 1 else universal(parts) for path, parts in slices.items()}


def compiled(target: Target, sources: Mapping[str, bytes], library: str) -> bytes:
    """Return a library for one platform, from the cache if it was compiled before.

    Raises
    ------
    FmuError
        If zig is not installed or cannot compile the sources.
    """
    if find_spec("ziglang") is None:
        raise FmuError(
            "platforms must be 'host' unless the zig compiler is installed: "
            "python -m pip install '.[platforms]' in the source of rotorfilm"
        )
    name = f"{library}-{_key(sources)}-{target.folder}.{target.suffix}"
    return cached(
        _cache_folder() / name,
        from_bytes=bytes,
        build=lambda: _compile(target, sources, library),
        to_bytes=bytes,
        what=f"the library for {target.folder}",
    )


def _compile(target: Target, sources: Mapping[str, bytes], library: str) -> bytes:
    with tempfile.TemporaryDirectory(prefix="rotorfilm-") as name:
        folder = Path(name)
        for path, content in sources.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_bytes(content)
        units = [path for path in sources if path.endswith(".c")]
        output = f"rotorfilm.{target.suffix}"
        command = [sys.executable, "-m", "ziglang", "cc", "-target", target.triple, *OPTIONS, "-I."]
        command += [f"-DRF_SUBSET=RF_{library.upper()}", *_TRIMMED.get(target.suffix, ())]
        command += ["-fPIC"] if target.suffix == "so" else []
        command += [*units, "-o", output, "-lm"]
        ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        if ran.returncode != 0:
            raise FmuError(f"zig must compile the library for {target.folder}, got: {ran.stderr.strip()}")
        return (folder / output).read_bytes()


def _cache_folder() -> Path:
    return cache_folder() / "platforms"


def _key(sources: Mapping[str, bytes]) -> str:
    digest = hashlib.sha256(repr((version("ziglang"), OPTIONS, TARGETS)).encode())
    for name, content in sorted(sources.items()):
        digest.update(f"\0{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()[:16]


def _path(target: Target, identifier: str, fmi_version: str) -> str:
    folder = target.folder2 if fmi_version == "2.0" else target.folder
    return f"binaries/{folder}/{identifier}.{target.suffix}"


# Universal files of macOS: several libraries, one for each kind of processor, behind one header.


FAT_MAGIC = 0xCAFEBABE
MAGIC_64 = 0xFEEDFACF
ALIGNMENT = 14
"""Binary logarithm of the alignment of each library: a page of an ARM processor."""

_FAT = struct.Struct(">II")  # magic, number of libraries
_ARCH = struct.Struct(">IIIII")  # processor, its subtype, offset, size, alignment
_MACHO = struct.Struct("<III")  # magic, processor, its subtype


def universal(slices: Sequence[bytes]) -> bytes:
    """Return one universal file of 64-bit Mach-O libraries.

    The header is that of Apple's <mach-o/fat.h>: big-endian, one record for each library, sorted as
    Apple's lipo sorts them, each library at a multiple of 2^`ALIGNMENT`.

    Parameters
    ----------
    slices : sequence of bytes
        Little-endian 64-bit Mach-O files for different processors.

    Raises
    ------
    FmuError
        If a slice is something else, or two are for the same processor.
    """
    processors = [_processor(content) for content in slices]
    if len(set(processors)) != len(processors):
        raise FmuError(f"slices must be for different processors, got {processors}")
    start = _aligned(_FAT.size + len(slices) * _ARCH.size)
    header, body = _FAT.pack(FAT_MAGIC, len(slices)), b""
    for (kind, subtype), content in sorted(zip(processors, slices, strict=True)):
        body = body.ljust(_aligned(len(body)), b"\0")
        header += _ARCH.pack(kind, subtype, start + len(body), len(content), ALIGNMENT)
        body += content
    return header.ljust(start, b"\0") + body


def _processor(content: bytes) -> tuple[int, int]:
    """Return processor and subtype of a library."""
    if len(content) < _MACHO.size or _MACHO.unpack_from(content)[0] != MAGIC_64:
        raise FmuError(f"slice must be a little-endian 64-bit Mach-O file, got {content[:4].hex()!r}...")
    _, kind, subtype = _MACHO.unpack_from(content)
    return kind, subtype


def _aligned(offset: int) -> int:
    return -(-offset >> ALIGNMENT) << ALIGNMENT
