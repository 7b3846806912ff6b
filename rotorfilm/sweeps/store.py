"""The rows of a sweep on disk while it runs: one line each, so that nothing done is lost."""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

from ..errors import InputError
from .point import Row


class Store:
    """A file of rows, to be added to and read again.

    Parameters
    ----------
    path : Path
        Its first line names the sweep, each other one holds a point and its row.
    name : str
        Of the sweep: another one in the file is refused.

    Raises
    ------
    InputError
        If the file holds another sweep.
    """

    def __init__(self, path: Path, name: str) -> None:
        self.path, self.name = path, name
        self.rows: dict[int, Row] = dict(self._read())
        self._file: IO[bytes] = path.open("ab")
        if self._file.tell() == 0:
            self._write({"sweep": name})

    def _read(self) -> Iterator[tuple[int, Row]]:
        if not self.path.is_file():
            return
        content = self.path.read_bytes()
        whole = content.rpartition(b"\n")[0]
        # A line that was cut off when the sweep was killed is computed again.
        kept = len(whole) + 1 if whole else 0
        if kept < len(content):
            os.truncate(self.path, kept)
        for number, line in enumerate(whole.splitlines()):
            entry = self._entry(line)
            if number == 0:
                self._require_same(entry)
            else:
                yield entry["point"], entry["row"]

    def _entry(self, line: bytes) -> dict[str, Any]:
        with contextlib.suppress(ValueError):
            entry = json.loads(line)
            if isinstance(entry, dict):
                return entry
        raise InputError(f"path must leave {str(self.path)!r} to the rows of a sweep, got another file there")

    def _require_same(self, entry: dict[str, Any]) -> None:
        if entry.get("sweep") != self.name:
            raise InputError(
                f"path must be that of the same sweep, or of none, got {str(self.path)!r} with the rows of "
                "another scene or of other values; delete the file or choose another path"
            )

    def add(self, point: int, row: Row) -> None:
        """Keep a row; it is on disk when this returns."""
        self.rows[point] = row
        self._write({"point": point, "row": row})

    def _write(self, entry: dict[str, Any]) -> None:
        self._file.write(json.dumps(entry).encode() + b"\n")
        self._file.flush()
        os.fsync(self._file.fileno())

    def close(self) -> None:
        """Close the file."""
        self._file.close()
