"""How tables lie in files: a mark, a version, a checksum and sizes, then little-endian numbers."""

from __future__ import annotations

import struct
import zlib
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from functools import cached_property
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from ...errors import RotorfilmError
from ...files import write_whole
from ...model import Array

_HEADER = struct.Struct("<8sIIiiii")

Sizes = tuple[int, int, int, int]

Layout = tuple[tuple[str, int], ...]
"""Little-endian dtype and count of each array of a table."""


class StoredTable(ABC):
    """A table that is its bytes: saved, loaded, compared and hashed by them."""

    @abstractmethod
    def to_bytes(self) -> bytes:
        """Return the table as little-endian bytes."""

    @classmethod
    @abstractmethod
    def from_bytes(cls, content: bytes) -> Self:
        """Return the table that `to_bytes` wrote."""

    def save(self, path: str | Path) -> None:
        """Write the table to a file."""
        write_whole(path, self.to_bytes())

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """Return the table in a file; see `from_bytes` for the errors."""
        return cls.from_bytes(Path(path).read_bytes())

    @cached_property
    def _content(self) -> bytes:
        return self.to_bytes()

    def __eq__(self, other: object) -> bool:
        return self is other or (type(other) is type(self) and self._content == other._content)

    def __hash__(self) -> int:
        return hash(self._content)


def seal(mark: bytes, version: int, sizes: Sizes, *arrays: Array | NDArray[np.int32]) -> bytes:
    """Return the bytes of a table; the mark has eight of them."""
    body = b"".join(array.astype(array.dtype.newbyteorder("<")).tobytes() for array in arrays)
    return _HEADER.pack(mark, version, zlib.crc32(body), *sizes) + body


def unseal(
    kind: str, mark: bytes, version: int, layout: Callable[[Sizes], Layout], content: bytes
) -> tuple[Any, ...]:
    """Return the sizes, and then as floats the arrays that `seal` wrote.

    Parameters
    ----------
    kind : str
        What messages call the table.
    mark, version
        As given to `seal`.
    layout : callable
        The arrays of a table of given sizes; empty where sizes cannot be.
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
        raise RotorfilmError(
            f"{kind}: version must be {version}, got {found}; make it again with this rotorfilm"
        )
    arrays = layout(sizes)
    expected = _HEADER.size + sum(np.dtype(dtype).itemsize * count for dtype, count in arrays)
    if not arrays or len(content) != expected:
        raise RotorfilmError(f"{kind}: size must be {expected} bytes for {sizes}, got {len(content)}")
    if zlib.crc32(content[_HEADER.size :]) != checksum:
        raise RotorfilmError(f"{kind}: the checksum does not fit, the content is damaged")
    return (sizes, *_arrays(arrays, content))


def _arrays(layout: Layout, content: bytes) -> Iterator[Array]:
    start = _HEADER.size
    for kind, count in layout:
        yield np.frombuffer(content, dtype=kind, offset=start, count=count).astype(float)
        start += np.dtype(kind).itemsize * count
