"""Where the C library lies, and the types of its functions."""

from __future__ import annotations

import ctypes
import sys
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from ..core.errors import RotorfilmError
from .structs import FOLDER, prototypes

FILMS, LOOPS, MASTER = "rotorfilm", "rotorfilm_loops", "rotorfilm_master"
"""Libraries that Python calls: films one by one, loops over them, the loop of the co-simulation master."""

RECORD = "sources.sha256"
"""Of the C sources that an installed distribution was built from; CMakeLists.txt writes it."""

SUFFIXES = {"win32": ".dll", "darwin": ".dylib"}
REMEDY = (
    "install rotorfilm with a C compiler present, "
    "or run 'cmake -S . -B build && cmake --build build' in its source"
)


class NativeLibraryError(RotorfilmError, ImportError):
    """The compiled library is not there, or is not of this machine."""


@cache
def functions() -> dict[str, Any]:
    """Return the functions of the library of films by name, loaded on the first call.

    Batches release the interpreter lock; a scalar call is over before that would pay.

    Raises
    ------
    NativeLibraryError
        If the library is missing or cannot be loaded.
    """
    shown = prototypes("RF_EXPORT")
    batches = {name: types for name, types in shown.items() if name.endswith("_batch")}
    scalars = {name: types for name, types in shown.items() if name not in batches}
    return {**_typed(ctypes.CDLL, FILMS, batches), **_typed(ctypes.PyDLL, FILMS, scalars)}


@cache
def loops() -> dict[str, Any]:
    """Return the functions of the library of loops over films by name; all release the interpreter lock.

    Raises
    ------
    NativeLibraryError
        As `functions`.
    """
    return _typed(ctypes.CDLL, LOOPS, prototypes("RF_EXPORT_LOOP"))


@cache
def master() -> dict[str, Any]:
    """Return the functions of the co-simulation master by name; all release the interpreter lock.

    Raises
    ------
    NativeLibraryError
        As `functions`.
    """
    return _typed(ctypes.CDLL, MASTER, prototypes("RF_EXPORT_MASTER"))


def _typed(loader: type[ctypes.CDLL], name: str, types: dict[str, tuple[Any, list[Any]]]) -> dict[str, Any]:
    library = _load(loader, name)
    try:
        found = {name: getattr(library, name) for name in types}
    except AttributeError as error:
        raise NativeLibraryError(
            f"the compiled library of rotorfilm is of another version ({error}); {REMEDY}"
        ) from error
    for name, function in found.items():
        function.restype, function.argtypes = types[name]
    return found


def library_path(name: str) -> Path:
    """Return where one of `kernel_table.libraries` lies.

    That is beside this module; for a source tree without one, in the installed distribution, if its C
    sources are those of the tree.

    Raises
    ------
    NativeLibraryError
        If it is in neither, or the C sources differ.
    """
    file = name + SUFFIXES.get(sys.platform, ".so")
    if (FOLDER / file).is_file():
        return FOLDER / file
    installed = _installed_folder()
    if installed is None or not (installed / file).is_file():
        raise NativeLibraryError(f"the compiled library {file} of rotorfilm is missing in {FOLDER}; {REMEDY}")
    if (installed / RECORD).read_text(encoding="utf-8") != source_digests(FOLDER):
        raise NativeLibraryError(
            f"the compiled library {file} is missing in {FOLDER}, and the installed one is built from other "
            "C sources: run 'python -m pip install .' again in that source, or start Python in another folder"
        )
    return installed / file


def source_digests(folder: Path) -> str:
    """Return a line for each C source and header below a folder: its path and SHA-256."""
    found = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*.[ch]")}
    return "".join(f"{name} {sha256(found[name].read_bytes()).hexdigest()}\n" for name in sorted(found))


def _installed_folder() -> Path | None:
    """Return the folder of the installed distribution that holds the libraries and their record."""
    from importlib.metadata import PackageNotFoundError, distribution

    package = __name__.partition(".")[0]
    try:
        folder = Path(str(distribution(package).locate_file(f"{package}/native")))
    except PackageNotFoundError:
        return None
    return folder if (folder / RECORD).is_file() else None


def _load(loader: type[ctypes.CDLL], name: str) -> ctypes.CDLL:
    path = library_path(name)
    try:
        return loader(str(path))
    except OSError as error:
        raise NativeLibraryError(
            f"the compiled library {path} of rotorfilm is unusable ({error}); {REMEDY}"
        ) from error
