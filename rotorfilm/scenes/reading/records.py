"""Records of a scene file: rows of numbers in a CSV file next to it, or in the scene itself."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ...errors import SceneError, brief
from ...files import read_text
from .readers import takes
from .tables import Quantity, Reader, text

Record = tuple[tuple[float, ...], ...]
"""Columns: the first rises, one or two more."""

ROWS = 1_000_000
"""Largest number of rows."""


def record_of(*headings: str) -> Reader:
    """Return the reader of a record: the name of a CSV file, from the folder of the scene on, or of its rows.

    Columns are separated by commas, in SI. A first line of a file that is no numbers must be the headings of
    its columns.
    """

    @takes(text, [[Quantity("1"), ...], ...])
    def read(where: str, value: Any) -> Record:
        rows = value if isinstance(value, list) else _rows_of(where, value, headings)
        return _columns(where, value, rows)

    return read


def _columns(where: str, value: Any, rows: list[Any]) -> Record:
    """Return the columns of rows; raise SceneError where they are no record."""
    columns = len(rows[0]) if rows and isinstance(rows[0], list) else 0
    if not 2 <= len(rows) <= ROWS or columns not in (2, 3):
        raise SceneError(f"{where} must be 2 to {ROWS} rows of 2 or 3 numbers, got {brief(value)}")
    for number, row in enumerate(rows):
        if not isinstance(row, list) or len(row) != columns or not all(map(_is_number, row)):
            raise SceneError(f"{where}: row {number} must be {columns} numbers, got {brief(row)}")
    table = tuple(zip(*(tuple(map(float, row)) for row in rows), strict=True))
    if any(b <= a for a, b in zip(table[0], table[0][1:], strict=False)):
        raise SceneError(f"{where}: the first column must increase strictly, and does not")
    return table


def _rows_of(where: str, value: Any, headings: Sequence[str]) -> list[Any]:
    """Return the rows of a CSV file, without its headings."""
    path = Path(where.partition(": ")[0]).parent / text(where, value)
    try:
        lines = read_text(path).splitlines()
    except (OSError, ValueError) as error:
        raise SceneError(f"{where} must be a file of rows of numbers, got {value!r}: {error}") from None
    cells = [line.split(",") for line in lines if line.strip()]
    rows = [[_number(cell) for cell in row] for row in cells]
    if not rows or any(_is_number(cell) for cell in rows[0]):
        return rows
    _require_headings(where, cells[0], headings)
    return rows[1:]


def _require_headings(where: str, cells: Sequence[str], headings: Sequence[str]) -> None:
    """Raise SceneError unless columns are those that are wanted, in their order and units."""
    if len(cells) > len(headings):
        raise SceneError(f"{where} must have at most {len(headings)} columns, got {brief(cells)}")
    for number, (cell, wanted) in enumerate(zip(cells, headings, strict=False), 1):
        found = " ".join(cell.strip(' "').split())
        if found != wanted:
            raise SceneError(f"{where}: column {number} must be {wanted}, got {brief(found)}")


def _number(cell: str) -> float | str:
    try:
        return float(cell)
    except ValueError:
        return cell.strip()


def _is_number(cell: Any) -> bool:
    return isinstance(cell, int | float) and not isinstance(cell, bool) and math.isfinite(cell)
