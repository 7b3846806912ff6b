"""What a dotted key of a scene file is read as."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .tables import Quantity, Table, TableList, TableType, keyed, twice_of


def quantity_of(table: TableType[Any], path: Sequence[str]) -> Quantity | None:
    """Return the reader of a key, given by its parts; None where it is none of a `Quantity`."""
    if not path:
        return None
    first, *rest = path
    readers = keyed(table).readers
    doubled = {twice_of(reader): reader for reader in readers.values()}
    reader = readers.get(first) or doubled.get(first)
    if isinstance(reader, Quantity):
        return None if rest else reader
    if isinstance(reader, Table):
        return quantity_of(reader.table, rest)
    return quantity_of(reader.table, rest[1:]) if isinstance(reader, TableList) else None
