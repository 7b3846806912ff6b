"""Universal files of macOS: several libraries, one for each kind of processor, behind one header."""

from __future__ import annotations

import struct
from collections.abc import Sequence

from ...errors import FmuError

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
