"""Where the C library lies, and the types of its functions."""

from __future__ import annotations

import ctypes
import sys
from ctypes import c_char_p, c_double, c_int, c_int64, c_size_t, c_void_p
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from ..core.errors import RotorfilmError

FOLDER = Path(__file__).parent
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


_ROWS = [c_void_p, c_size_t]
_BATCH: dict[str, list[Any]] = {
    "rf_film_batch": [c_void_p, c_void_p, c_size_t, *_ROWS * 4, c_void_p],
    "rf_response_batch": [c_void_p, c_void_p, c_size_t, *_ROWS * 5, c_void_p],
    "rf_loss_batch": [c_void_p, c_void_p, c_size_t, *[c_void_p] * 5],
}
_SCALAR: dict[str, list[Any]] = {
    "rf_map_film": [c_void_p] * 5,
    "rf_groove_film": [c_void_p] * 5,
    "rf_short_film": [c_void_p] * 5,
    "rf_map_losses": [c_void_p] * 5,
    "rf_short_losses": [c_void_p] * 5,
    "rf_response_call": [c_void_p, c_void_p, *[c_double] * 5, c_void_p],
    "rf_journal_at": [c_void_p] * 4,
    "rf_map_slice": [c_void_p, c_double, c_void_p, c_void_p],
    "rf_map_to_wall": [c_void_p, c_double, c_double],
    "rf_map_error": [c_void_p],
    "rf_groove_error": [c_void_p],
}
_LOOPS: dict[str, list[Any]] = {
    "rf_pad_film": [c_void_p] * 5,
    "rf_shape_pad": [c_void_p, c_double],
    "rf_ring_film": [c_void_p] * 5,
    "rf_ring_pair": [c_void_p, c_size_t, *[c_void_p] * 6],
    "rf_ring_field": [c_void_p] * 7,
    "rf_ring_losses": [c_void_p, c_size_t, *[c_void_p] * 5],
    "rf_ring_potential": [c_void_p, c_void_p, c_size_t, *[c_void_p] * 5],
    "rf_set_tilting_pad": [c_void_p, c_void_p, c_void_p, c_double, c_double],
    "rf_tilting_at": [c_void_p] * 7,
    "rf_tilting_at_rest": [c_void_p, c_void_p, c_double, *[c_void_p] * 4],
    "rf_tilting_forces": [c_void_p, c_size_t, *[c_void_p] * 5],
    "rf_stencil_film": [c_void_p, c_void_p, c_void_p, c_size_t, c_void_p],
    "rf_ball_journal_at": [c_void_p] * 5,
    "rf_balls_at": [c_void_p, c_void_p, c_double, *[c_void_p] * 3],
    "rf_balls_rest": [c_void_p, c_void_p, c_double, *[c_void_p] * 4],
    "rf_oil_outflow": [c_void_p] * 4,
    "rf_oil_film": [c_void_p, c_int, c_int, *[c_void_p] * 4],
    "rf_oil_response": [*[c_void_p] * 4, c_size_t, c_void_p, c_void_p],
    "rf_oil_sums": [c_void_p] * 6,
    "rf_sharpen_oil": [c_void_p, c_void_p, c_double, c_void_p, c_void_p],
    "rf_oil_step": [c_void_p, c_void_p, c_double, c_void_p, c_double, c_void_p],
    "rf_oil_rest": [c_void_p, c_void_p, c_double, c_void_p],
    "rf_oil_begin": [c_void_p] * 4,
    "rf_oil_travel": [c_void_p, c_double, c_void_p, c_double, *[c_void_p] * 3],
    "rf_recess_at": [c_void_p] * 4,
    "rf_recess_batch": [c_void_p, c_size_t, *[c_void_p] * 4],
    "rf_recess_field": [c_void_p, c_size_t, c_void_p, c_void_p],
    "rf_recess_least": [c_void_p] * 3,
    "rf_recess_losses": [c_void_p] * 3,
    "rf_balanced_at": [c_void_p] * 5,
    "rf_heat_at": [c_void_p] * 4,
    "rf_groove_flows": [c_void_p, c_size_t, *[c_void_p] * 3],
    "rf_groove_losses": [c_void_p] * 5,
    "rf_balanced_batch": [c_void_p, c_size_t, *[c_void_p] * 5],
    "rf_ride": [c_void_p, c_void_p, c_double, c_int64, c_void_p, c_void_p],
    "rf_lobes_at": [c_void_p] * 4,
    "rf_springs_at": [c_void_p] * 4,
    "rf_sprung_at": [c_void_p] * 4,
    "rf_rub_at": [c_void_p] * 4,
    "rf_both_at": [c_void_p] * 4,
    "rf_oil_damper_at": [c_void_p] * 4,
    "rf_oil_damper_mass": [c_void_p] * 4,
    "rf_follow_shaken": [c_void_p, c_int64, c_void_p, c_void_p],
    "rf_set_step_table": [c_void_p, c_void_p, c_double, c_void_p],
    "rf_march_to": [c_void_p, c_double, c_int64, c_void_p, c_int64, c_void_p, c_void_p],
    "rf_journal_forces": [c_void_p, c_int64, c_void_p, c_double, c_void_p, c_void_p],
}
_MASTER: dict[str, list[Any]] = {
    "rf_couple": [c_void_p, c_int64],
    "rf_open_kernel": [c_char_p, c_void_p, c_void_p, c_void_p],
    "rf_close_kernel": [c_void_p],
    "rf_coupling_work": [c_void_p, c_size_t],
    "rf_rotor_work": [c_size_t, c_size_t],
}


@cache
def functions() -> dict[str, Any]:
    """Return the functions of the library of films by name, loaded on the first call.

    Batches release the interpreter lock; a scalar call is over before that would pay.

    Raises
    ------
    NativeLibraryError
        If the library is missing or cannot be loaded.
    """
    return {**_typed(ctypes.CDLL, FILMS, _BATCH), **_typed(ctypes.PyDLL, FILMS, _SCALAR)}


@cache
def loops() -> dict[str, Any]:
    """Return the functions of the library of loops over films by name; all release the interpreter lock.

    Raises
    ------
    NativeLibraryError
        As `functions`.
    """
    found = _typed(ctypes.CDLL, LOOPS, _LOOPS)
    found["rf_recess_least"].restype = c_double
    found["rf_oil_outflow"].restype = found["rf_sharpen_oil"].restype = None
    return found


@cache
def master() -> dict[str, Any]:
    """Return the functions of the co-simulation master by name; all release the interpreter lock.

    Raises
    ------
    NativeLibraryError
        As `functions`.
    """
    found = _typed(ctypes.CDLL, MASTER, _MASTER)
    found["rf_open_kernel"].restype = c_void_p
    found["rf_coupling_work"].restype = found["rf_rotor_work"].restype = c_size_t
    found["rf_close_kernel"].restype = None
    return found


def _typed(loader: type[ctypes.CDLL], name: str, signatures: dict[str, list[Any]]) -> dict[str, Any]:
    library = _load(loader, name)
    try:
        found = {name: getattr(library, name) for name in signatures}
    except AttributeError as error:
        raise NativeLibraryError(
            f"the compiled library of rotorfilm is of another version ({error}); {REMEDY}"
        ) from error
    for name, function in found.items():
        function.argtypes, function.restype = signatures[name], c_int
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
