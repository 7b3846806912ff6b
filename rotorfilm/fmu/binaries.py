"""Whether a compiled library is whole: loading one that is cut off ends the process."""

from __future__ import annotations

import struct
from pathlib import Path

import fmpy

from ..core.errors import FmuError
from .native.platforms import FAT_MAGIC, MAGIC_64

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


def require_whole(path: Path) -> None:
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
