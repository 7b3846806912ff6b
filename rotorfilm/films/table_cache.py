"""Tables on disk: made once, found again, whole or not there."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar
from uuid import uuid4

from ..errors import RotorfilmError, warn_user
from .table_bytes import StoredTable

FOLDER_VARIABLE = "ROTORFILM_CACHE"
"""Environment variable that names the folder of the cache."""

T = TypeVar("T")
S = TypeVar("S", bound=StoredTable)


def cache_folder() -> Path:
    """Return the folder of the cache: $ROTORFILM_CACHE, or the platform's ($XDG_CACHE_HOME/rotorfilm)."""
    chosen = os.environ.get(FOLDER_VARIABLE)
    if chosen:
        return Path(chosen)
    # Imported here so that an FMU with another film needs no more than numpy and scipy.
    from platformdirs import user_cache_path

    return user_cache_path("rotorfilm", appauthor=False)


def cached(
    path: Path,
    *,
    read: Callable[[Path], T],
    build: Callable[[], T],
    to_bytes: Callable[[T], bytes],
    what: str,
) -> T:
    """Return what a file holds, built and written where it is missing or damaged.

    Parameters
    ----------
    path : Path
    read : callable
        Returns what the file holds; raises OSError, ValueError or RotorfilmError if it is not right.
    build : callable
        Returns it without a file.
    to_bytes : callable
        Returns the content of the file.
    what : str
        What it is, for the warning.

    Warns
    -----
    RuntimeWarning
        If the file cannot be written: it will be built again next time.
    """
    # A file that another process is replacing, or that is damaged, is no reason to fail.
    with contextlib.suppress(OSError, ValueError, RotorfilmError):
        return read(path)
    made = build()
    try:
        write_whole(path, to_bytes(made))
    except OSError as error:
        warn_user(
            f"{what} could not be kept in {path.parent} ({error}); {FOLDER_VARIABLE} names another folder",
            RuntimeWarning,
        )
    return made


def cached_table(kind: type[S], path: Path, build: Callable[[], S], require: Callable[[S], None]) -> S:
    """Return the table at a path, built and written where it is missing, damaged or not as required.

    Parameters
    ----------
    kind : type
        A `StoredTable`.
    path : Path
    build : callable
        Returns the table.
    require : callable
        Raises an InputError if a table is not the right one.

    Warns
    -----
    RuntimeWarning
        If the table cannot be written.
    """

    def read(path: Path) -> S:
        table = kind.load(path)
        require(table)
        return table

    return cached(path, read=read, build=build, to_bytes=kind.to_bytes, what="the map of the film")


def write_whole(path: Path, content: bytes) -> None:
    """Write a file that is either whole or not there, whoever else writes it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    # Not by tempfile, whose files are for one user alone: the mode of this one follows the umask.
    part = path.with_name(f"{path.stem}-{uuid4().hex}.part")
    try:
        part.write_bytes(content)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
