"""The compiled library for each platform: that of this machine, or all of them compiled by zig."""

from __future__ import annotations

import hashlib
import platform
import re
import struct
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.metadata import version
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path
from posixpath import dirname, join, normpath
from typing import NamedTuple

import fmpy

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
        Suffix of the library.
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
    Target("x86_64-darwin", "darwin64", "dylib", "x86_64-macos.11.0"),
    Target("aarch64-darwin", "darwin64", "dylib", "aarch64-macos.11.0"),
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

KERNEL_LIST = "kernels/kernel_list.h"

_TRIMMED = {"dylib": ("-Wl,-dead_strip",), "so": ("-Wl,--gc-sections",), "dll": ("-Wl,--gc-sections",)}
"""What the linker leaves out: kernels of other libraries."""


def native_sources() -> dict[str, bytes]:
    """Return the C files of the libraries of FMUs, and their headers, by path.

    Raises
    ------
    FmuError
        If the installation lacks them.
    """
    return {path: source.content for path, source in _sources(Path(str(files(NATIVE)))).items()}


_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
_INCLUDED = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
_DEFINED = re.compile(r"^(?!static|extern)\w[\w *]*?\b(rf_\w+)(?:\(|\[| =)", re.MULTILINE)
_NAMED = re.compile(r"\brf_\w+")


class _Source(NamedTuple):
    """A file in C: what it holds, the files that it includes, the symbols that it defines and names."""

    content: bytes
    included: tuple[str, ...]
    defined: frozenset[str]
    named: frozenset[str]


@cache
def _sources(root: Path) -> Mapping[str, _Source]:
    """Return the files in C below a folder, read once."""
    paths = sorted(path for path in root.rglob("*.[ch]") if path.parent.name not in UNSHIPPED)
    found = {path.relative_to(root).as_posix(): path.read_bytes() for path in paths}
    if not any(name.endswith(".c") for name in found):
        raise FmuError(f"the C sources of the library must lie in {root}, got none; install rotorfilm again")
    return {path: _read(path, content) for path, content in found.items()}


def _read(path: str, content: bytes) -> _Source:
    text = _COMMENT.sub("", content.decode())
    included = tuple(normpath(join(dirname(path), name)) for name in _INCLUDED.findall(text))
    if path.endswith(".h"):
        return _Source(content, included, frozenset(), frozenset())
    return _Source(content, included, frozenset(_DEFINED.findall(text)), frozenset(_NAMED.findall(text)))


def model_sources(kernels: Sequence[str], fmi_version: str) -> dict[str, bytes]:
    """Return of `native_sources` what a library with these kernels and one version of FMI needs.

    These are the files that define what others of them name, and the headers that they include. The list of
    kernels names those in these files alone, as a ball contact has the kernel of its law in it.
    """
    sources = _sources(Path(str(files(NATIVE))))
    units = [path for path in sources if path.endswith(".c")]
    homes = {symbol: path for path in units for symbol in sources[path].defined}
    own = {f"kernel_{kernel}.c" for kernel in kernels} | {"kernels.c"}
    other = "fmi/fmi3" if fmi_version == "2.0" else "fmi/fmi2"
    ahead = [path for path in units if path.startswith("fmi/") and not path.startswith(other)]
    ahead += [path for path in units if path.rpartition("/")[2] in own]
    needed: set[str] = set()
    while ahead:
        path = ahead.pop()
        if path not in needed:
            needed.add(path)
            ahead += sources[path].included
            ahead += [homes[symbol] for symbol in sources[path].named & homes.keys()]
    found = {path: sources[path].content for path in sorted(needed)}
    rows = found[KERNEL_LIST].decode().splitlines(keepends=True)
    units = [path.rpartition("/")[2] for path in found]
    kept = tuple(f"RF_KERNEL({unit[7:-2]}," for unit in units if unit.startswith("kernel_"))
    found[KERNEL_LIST] = "".join(
        row for row in rows if row.startswith(kept) or not row.startswith("RF_KERNEL(")
    ).encode()
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


def all_binaries(identifier: str, fmi_version: str, sources: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the library of these sources for all `TARGETS`, by path in the FMU.

    It is compiled where it is not in the cache. FMI 2.0 has one folder for both kinds of Macs: they share a
    universal file there.

    Raises
    ------
    FmuError
        If zig is not installed or cannot compile the library.
    """
    slices: dict[str, list[bytes]] = {}
    for target in TARGETS:
        slices.setdefault(_path(target, identifier, fmi_version), []).append(compiled(target, sources))
    return {path: parts[0] if len(parts) == 1 else universal(parts) for path, parts in slices.items()}


def compiled(target: Target, sources: Mapping[str, bytes]) -> bytes:
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
    name = f"rotorfilm-{_key(sources)}-{target.folder}.{target.suffix}"
    return cached(
        cache_folder() / "platforms" / name,
        from_bytes=bytes,
        build=lambda: _compile(target, sources),
        to_bytes=bytes,
        what=f"the library for {target.folder}",
    )


def _compile(target: Target, sources: Mapping[str, bytes]) -> bytes:
    with tempfile.TemporaryDirectory(prefix="rotorfilm-") as name:
        folder = Path(name)
        for path, content in sources.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_bytes(content)
        units = [path for path in sources if path.endswith(".c")]
        output = f"rotorfilm.{target.suffix}"
        command = [sys.executable, "-m", "ziglang", "cc", "-target", target.triple, *OPTIONS, "-I."]
        command += _TRIMMED.get(target.suffix, ())
        command += ["-fPIC"] if target.suffix == "so" else []
        command += [*units, "-o", output, "-lm"]
        ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        if ran.returncode != 0:
            raise FmuError(f"zig must compile the library for {target.folder}, got: {ran.stderr.strip()}")
        return (folder / output).read_bytes()


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


# Whether a compiled library is whole: loading one that is cut off ends the process.


MAGIC_32 = 0xFEEDFACE
SEGMENTS = {0x1: "<32xII", 0x19: "<40xQQ"}
"""Commands of a Mach-O file, of 32 and of 64 bits, that name a part of it by offset and size."""

SUFFIXES = (".so", ".dll", ".dylib")


def libraries(folder: str) -> list[Path]:
    """Return the compiled libraries of an extracted FMU, for all platforms."""
    return sorted(path for path in Path(folder, "binaries").rglob("*") if path.suffix in SUFFIXES)


def host_libraries(folder: str, identifier: str) -> list[Path]:
    """Return those that fmpy may load on this machine."""
    names = (fmpy.platform, fmpy.platform_tuple)
    found = (Path(folder, "binaries", name, identifier + fmpy.sharedLibraryExtension) for name in names)
    return [path for path in found if path.is_file()]


def require_complete_file(path: Path) -> None:
    """Raise unless a library has all the bytes that its headers speak of.

    Raises
    ------
    FmuError
        If it is shorter, or neither an ELF, a PE nor a Mach-O file.
    """
    content = path.read_bytes()
    name = f"binaries/{path.parent.name}/{path.name}"
    try:
        end = _end(content)
    except (struct.error, IndexError):
        raise FmuError(f"{name} must be whole, got {len(content)} bytes, which end in its headers") from None
    if end is None:
        raise FmuError(f"{name} must be an ELF, PE or Mach-O file, got one that starts with {content[:8]!r}")
    if end > len(content):
        raise FmuError(f"{name} must be whole, got {len(content)} of {end} bytes")


def _end(content: bytes) -> int | None:
    """Return where the last part ends that the headers name; None for another kind of file."""
    if content[:4] == b"\x7fELF":
        return _elf(content)
    if content[:2] == b"MZ":
        return _pe(content)
    if len(content) < 4:
        return None
    if struct.unpack_from(">I", content)[0] == FAT_MAGIC:
        return _fat(content)
    magic = struct.unpack_from("<I", content)[0]
    return _macho(content, 32 if magic == MAGIC_64 else 28) if magic in (MAGIC_32, MAGIC_64) else None


def _elf(content: bytes) -> int:
    """Return the end of an ELF file: of its tables and of its segments."""
    wide, order = content[4] == 2, ">" if content[5] == 2 else "<"
    tables, segment = ("32xQQ6xHHHH", "8xQ16xQ") if wide else ("28xII6xHHHH", "4xI8xI")
    programs, sections, size, count, section_size, section_count = struct.unpack_from(order + tables, content)
    ends = [programs + size * count, sections + section_size * section_count]
    ends += [sum(struct.unpack_from(order + segment, content, programs + k * size)) for k in range(count)]
    return max(ends)


def _pe(content: bytes) -> int | None:
    """Return the end of a PE file: of its sections."""
    (start,) = struct.unpack_from("<60xI", content)
    if content[start : start + 4] != b"PE\0\0":
        return None if start + 4 <= len(content) else start + 4
    count, optional = struct.unpack_from("<6xH12xH", content, start)
    first = start + 24 + optional
    return max(
        (sum(struct.unpack_from("<16xII", content, first + 40 * k)) for k in range(count)), default=first
    )


def _macho(content: bytes, header: int) -> int:
    """Return the end of a Mach-O file: of its segments."""
    count, size = struct.unpack_from("<16xII", content)
    at, ends = header, [header + size]
    while count and at < ends[0]:
        command, length = struct.unpack_from("<II", content, at)
        if command in SEGMENTS:
            ends.append(sum(struct.unpack_from(SEGMENTS[command], content, at)))
        at, count = at + max(length, 8), count - 1
    return max(ends)


def _fat(content: bytes) -> int | None:
    """Return the end of a universal file: of its parts and of what these name.

    None where a part is universal again: such a file could hold itself.
    """
    (count,) = struct.unpack_from(">4xI", content)
    end = 8 + 20 * count
    for k in range(min(count, len(content) // 20)):
        start, size = struct.unpack_from(">8xII", content, 8 + 20 * k)
        part = content[start : start + size]
        if part[:4] == content[:4]:
            return None
        end = max(end, start + size, start + (_end(part) or 0))
    return end
