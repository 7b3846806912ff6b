"""Tables on disk: made once, found again, whole or not there."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from ...errors import FileWarning, RotorfilmError, warn_user
from ...files import read_sealed, write_sealed
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
