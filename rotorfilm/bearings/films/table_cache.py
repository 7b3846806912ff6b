"""Tables on disk: made once, found again, whole or not there."""

from __future__ import annotations

import hashlib
import logging
import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from ...errors import FileWarning, RotorfilmError, warn_user
from ...files import read_sealed, write_sealed
from ...progress import Report, silent
from .table_bytes import StoredTable

FOLDER_VARIABLE = "ROTORFILM_CACHE"
"""Environment variable that names the folder of the cache."""

_logger = logging.getLogger(__name__)

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


def table_path(kind: str, key: object) -> Path:
    """Return where a table of a kind lies: its name is a digest of all that decides its content."""
    return cache_folder() / f"{kind}-{hashlib.sha256(repr(key).encode()).hexdigest()[:24]}.bin"


def told(report: Report, of: str, folder: Path) -> Report:
    """Return the report; without one, one that says once in the log that a table is being made.

    Parameters
    ----------
    report : callable
    of : str
        What the table is of.
    folder : Path
        Where it will be kept.
    """
    said: list[str] = []

    def log(fraction: float, text: str) -> None:
        if not said:
            said.append(text)
            _logger.warning("making the %s, %s; it will be kept in %s", text, of, folder)

    return log if report is silent else report


def cached(
    path: Path,
    *,
    from_bytes: Callable[[bytes], T],
    build: Callable[[], T],
    to_bytes: Callable[[T], bytes],
    what: str,
) -> T:
    """Return what a sealed file holds, built and written where it is missing or damaged.

    Parameters
    ----------
    path : Path
        Its name tells all that decides what it holds: a file of another name is refused.
    from_bytes : callable
        Returns what content holds; raises RotorfilmError if it is not right.
    build : callable
        Returns it without a file.
    to_bytes : callable
        Returns the content of the file.
    what : str
        What it is, for the warnings.

    Warns
    -----
    FileWarning
        If the file is damaged or cannot be read, so that it is built again, or if it cannot be written.
    """
    try:
        return from_bytes(read_kept(path))
    except (FileNotFoundError, NotADirectoryError):
        pass
    except (OSError, RotorfilmError) as error:
        warn_user(f"{what} is made again: {error}", FileWarning)
    made = build()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_sealed(path, to_bytes(made), path.name)
    except OSError as error:
        warn_user(
            f"{what} could not be kept in {path.parent} ({error}); {FOLDER_VARIABLE} names another folder",
            FileWarning,
        )
    return made


def read_kept(path: Path) -> bytes:
    """Return what `cached` wrote; see `read_sealed` for the errors."""
    return read_sealed(path, path.name, "a file of the cache must be what its name says")


def cached_table(kind: type[S], path: Path, build: Callable[[], S]) -> S:
    """Return the table at a path, built and written where it is missing or damaged; see `cached`."""
    return cached(
        path,
        from_bytes=kind.from_bytes,
        build=build,
        to_bytes=kind.to_bytes,
        what="the map of the film",
    )
