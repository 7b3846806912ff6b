"""The rows of a sweep on disk while it runs: one line each, so that nothing done is lost."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import IO

from ..errors import FileWarning, InputError, warn_user
from ..files import failures_named, sealed_line, unsealed_line, write_whole
from .point import Row

HEAD = "rows of a sweep, version 1"
"""What the first line of a file belongs to."""


class Store:
    """A file of rows, to be added to and read again.

    Parameters
    ----------
    path : Path
        Its first line names the sweep, each other one holds a point and its row, behind its checksum.
    name : str
        Of the sweep: another one in the file is refused.

    Raises
    ------
    InputError
        If the file holds another sweep, or none.

    Warns
    -----
    FileWarning
        Of damaged rows, which are left out.
    """

    def __init__(self, path: Path, name: str) -> None:
        self.path, self.name = path, name
        self.rows: dict[int, Row] = {}
        head = sealed_line(json.dumps({"sweep": name}), HEAD)
        content = path.read_bytes() if path.is_file() else b""
        # What was cut off when the sweep was killed is computed again.
        whole = content[: content.rfind(b"\n") + 1].splitlines(keepends=True)
        if not head.startswith(content):
            self._require_same(whole[0] if whole else content)
        kept = [line for line in whole[1:] if self._read(line)]
        if lost := len(whole[1:]) - len(kept):
            warn_user(f"{lost} damaged rows of {str(path)!r} are computed again", FileWarning)
        if (found := head + b"".join(kept)) != content:
            write_whole(path, found)
        self._file: IO[bytes] = path.open("ab")

    def _read(self, line: bytes) -> bool:
        """Take the row of a line; return whether it is one."""
        text = unsealed_line(line, self.name)
        if text is not None:
            entry = json.loads(text)
            self.rows[entry["point"]] = entry["row"]
        return text is not None

    def _require_same(self, line: bytes) -> None:
        text = unsealed_line(line, HEAD)
        if text is None:
            raise InputError(
                f"path must leave {str(self.path)!r} to the rows of a sweep, got another file there, or a "
                "damaged one"
            )
        if json.loads(text)["sweep"] != self.name:
            raise InputError(
                f"path must be that of the same sweep, or of none, got {str(self.path)!r} with the rows of "
                "another scene or of other values; delete the file or choose another path"
            )

    def add(self, point: int, row: Row) -> None:
        """Keep a row; it is on disk when this returns."""
        self.rows[point] = row
        with failures_named(self.path):
            self._file.write(sealed_line(json.dumps({"point": point, "row": row}), self.name))
            self._file.flush()
            os.fsync(self._file.fileno())

    def close(self) -> None:
        """Close the file."""
        with failures_named(self.path):
            self._file.close()
