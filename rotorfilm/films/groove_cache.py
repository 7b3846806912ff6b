"""Maps of bearings with openings on disk: made once, found again by what they depend on."""

from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
import warnings
from collections.abc import Callable
from pathlib import Path

from ..errors import RotorfilmError
from .geometry import TURN
from .groove_axis import STEPS, AlignedOpenings
from .groove_build import Resolution
from .groove_table import VERSION, GrooveTable
from .solver_digest import solver_digest

FOLDER_VARIABLE = "ROTORFILM_CACHE"
"""Environment variable that names the folder of the cache."""


def cache_folder() -> Path:
    """Return the folder of the cache: $ROTORFILM_CACHE, or the platform's ($XDG_CACHE_HOME/rotorfilm)."""
    chosen = os.environ.get(FOLDER_VARIABLE)
    if chosen:
        return Path(chosen)
    # Imported here so that an FMU with another film needs no more than numpy and scipy.
    from platformdirs import user_cache_path

    return user_cache_path("rotorfilm", appauthor=False)


def cache_path(openings: AlignedOpenings, slenderness: float, resolution: Resolution) -> Path:
    """Return where the map of a bearing lies; the name is a digest of all that decides its content."""
    angles = [angle for groove in openings.grooves for angle in (groove.center, groove.width)]
    steps = [round(angle / TURN * STEPS) for angle in angles]
    solver = solver_digest("groove_build.py", "quintic.py")
    key = repr((VERSION, solver, steps, f"{slenderness:.12g}", resolution))
    return cache_folder() / f"groove-{hashlib.sha256(key.encode()).hexdigest()[:24]}.bin"


def cached_table(path: Path, build: Callable[[], GrooveTable]) -> GrooveTable:
    """Return the table at a path, built and written where it is missing or damaged.

    Warns
    -----
    RuntimeWarning
        If the table cannot be written: it will be built again next time.
    """
    # A file that another process is replacing, or that is damaged, is no reason to fail.
    with contextlib.suppress(OSError, RotorfilmError):
        return GrooveTable.load(path)
    table = build()
    try:
        _write(path, table.to_bytes())
    except OSError as error:
        warnings.warn(
            f"the map of the film could not be kept in {path.parent} ({error}); "
            f"{FOLDER_VARIABLE} names another folder",
            RuntimeWarning,
            stacklevel=2,
        )
    return table


def _write(path: Path, content: bytes) -> None:
    """Write a file that is either whole or not there, whoever else writes it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=path.stem, suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.replace(name, path)
    except OSError:
        Path(name).unlink(missing_ok=True)
        raise
