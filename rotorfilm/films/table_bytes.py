"""How tables lie in files: a mark, a version, a checksum and sizes, then little-endian numbers."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable, Iterable

import numpy as np

from ..errors import RotorfilmError
from ..model import Array

_HEADER = struct.Struct("<8sIIiiii")
_NUMBER = "<f8"

Sizes = tuple[int, int, int, int]


def seal(mark: bytes, version: int, sizes: Sizes, numbers: Iterable[float]) -> bytes:
    """Return the bytes of a table; the mark has eight of them."""
    body = np.asarray(list(numbers), dtype=_NUMBER).tobytes()
    return _HEADER.pack(mark, version, zlib.crc32(body), *sizes) + body


def unseal(
    kind: str, mark: bytes, version: int, count: Callable[[Sizes], int], content: bytes
) -> tuple[Sizes, Array]:
    """Return the sizes and the numbers that `seal` wrote.

    Parameters
    ----------
    kind : str
        What messages call the table.
    mark, version
        As given to `seal`.
    count : callable
        Number of numbers for given sizes; negative where sizes cannot be.
    content : bytes

    Raises
    ------
    RotorfilmError
        If the content is not such a table, of another version, truncated or damaged.
    """
    if len(content) < _HEADER.size or not content.startswith(mark):
        raise RotorfilmError(f"{kind}: the content does not begin with the mark of a {kind}")
    _, found, checksum, *entries = _HEADER.unpack_from(content)
    sizes: Sizes = (entries[0], entries[1], entries[2], entries[3])
    if found != version:
        raise RotorfilmError(f"{kind}: version must be {version}, got {found}")
    expected = _HEADER.size + 8 * count(sizes)
    if count(sizes) < 0 or len(content) != expected:
        raise RotorfilmError(f"{kind}: size must be {expected} bytes for {sizes}, got {len(content)}")
    if zlib.crc32(content[_HEADER.size :]) != checksum:
        raise RotorfilmError(f"{kind}: the checksum does not fit, the content is damaged")
    return sizes, np.frombuffer(content, dtype=_NUMBER, offset=_HEADER.size).astype(float)
