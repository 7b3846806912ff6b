"""Where the C library lies, and the types of its functions."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Sequence
from ctypes import c_double, c_int, c_int32, c_int64, c_size_t, c_void_p
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from typing import Any, ClassVar

from ..errors import RotorfilmError

FOLDER = Path(__file__).parent
FILMS, LOOPS = "rotorfilm", "rotorfilm_loops"
"""Libraries that Python calls: films one by one, and loops over them."""

RECORD = "sources.sha256"
"""Of the C sources that an installed distribution was built from; CMakeLists.txt writes it."""

SUFFIXES = {"win32": ".dll", "darwin": ".dylib"}
REMEDY = (
    "install rotorfilm with a C compiler present, "
    "or run 'cmake -S . -B build && cmake --build build' in its source"
)


class NativeLibraryError(RotorfilmError, ImportError):
    """The compiled library is not there, or is not of this machine."""


class MapStruct(ctypes.Structure):
    """rf_map of map_kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("cells_x", c_int32),
        ("cells_t", c_int32),
        ("x_end", c_double),
        ("center", c_double),
        ("coefficients", c_void_p),
        ("slenderness", c_double),
        ("share", c_double),
    ]


class ShortStruct(ctypes.Structure):
    """rf_short of short_kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [("factor", c_double)]


class JournalStruct(ctypes.Structure):
    """rf_journal of journal_kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("film", c_void_p),
        ("data", c_void_p),
        ("clearance", c_double),
        ("force_scale", c_double),
        ("error", c_double),
        ("openings", c_int),
    ]


class GrooveMapStruct(ctypes.Structure):
    """rf_groove_map of groove_kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("cells_x", c_int32),
        ("cells_e", c_int32),
        ("cells_s", c_int32),
        ("cells_w", c_int32),
        ("x_end", c_double),
        ("squeeze", c_double),
        ("axis", c_double),
        ("center", c_void_p),
        ("coefficients", c_void_p),
        ("slenderness", c_double),
    ]


class MapTableStruct(ctypes.Structure):
    """rf_map_table of map_table.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("cells_s", c_int32),
        ("cells_x", c_int32),
        ("cells_t", c_int32),
        ("low", c_double),
        ("high", c_double),
        ("center", c_void_p),
        ("coefficients", c_void_p),
    ]


class GridStruct(ctypes.Structure):
    """rf_grid of ring.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("lines", c_size_t),
        ("nodes", c_size_t),
        ("span", c_void_p),
        ("line", c_void_p),
        ("face", c_void_p),
        ("value", c_void_p),
        ("held", c_void_p),
        ("width", c_void_p),
        ("conductance", c_void_p),
    ]


class RingStruct(ctypes.Structure):
    """rf_ring of ring.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("grids", GridStruct * 3),
        ("start", c_void_p),
        ("extent", c_void_p),
        ("slenderness", c_double),
        ("spans", c_int32),
        ("pinned", c_int32),
        ("ruptured", c_int32),
        ("clipped", c_int32),
    ]


class RideStruct(ctypes.Structure):
    """rf_ride_law of ride.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("order", c_int32),
        ("A", c_void_p),
        ("B", c_void_p),
        ("C", c_void_p),
        ("D", c_double),
        ("offset", c_double),
        ("span", c_double),
        ("exponent", c_double),
        ("operating", c_double),
        ("W", c_double),
    ]


class ModesStruct(ctypes.Structure):
    """rf_modes of collocation.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("modes", c_int32),
        ("channels", c_int32),
        ("rows", c_int32),
        ("values", c_void_p),
        ("push", c_void_p),
        ("sense", c_void_p),
    ]


class SchemeStruct(ctypes.Structure):
    """rf_scheme of collocation.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("stages", c_int32),
        ("nodes", c_void_p),
        ("lagrange", c_void_p),
        ("remainder", c_void_p),
    ]


class StepTableStruct(ctypes.Structure):
    """rf_step_table of collocation.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("move", c_void_p),
        ("gain", c_void_p),
        ("defect", c_void_p),
        ("keep", c_void_p),
        ("forced", c_void_p),
    ]


class JournalsStruct(ctypes.Structure):
    """rf_journals of march.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("count", c_int32),
        ("films", c_void_p),
        ("of", c_void_p),
        ("rest", c_void_p),
        ("spring", c_void_p),
        ("damper", c_void_p),
        ("lengths", c_void_p),
    ]


class SpeedsStruct(ctypes.Structure):
    """rf_speeds of march.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("count", c_int32),
        ("times", c_void_p),
        ("speeds", c_void_p),
        ("slopes", c_void_p),
        ("angles", c_void_p),
    ]


SLOTS, STEPS = 24, 400
"""Of march.h: lengths of steps whose tables are kept, and lengths that there are."""


class MarchStruct(ctypes.Structure):
    """rf_march of march.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("rotor", ModesStruct),
        ("scheme", SchemeStruct),
        ("journals", JournalsStruct),
        ("profile", SpeedsStruct),
        ("scales", c_void_p),
        ("longest", c_double),
        ("shortest", c_double),
        ("rtol", c_double),
        ("newton", c_double),
        ("tables", ctypes.POINTER(StepTableStruct)),
        ("slot_of", c_int32 * STEPS),
        ("step_of", c_int32 * SLOTS),
        ("next_slot", c_int32),
        ("step", c_int32),
        ("left_map", c_int32),
        ("time", c_double),
        ("films", c_int64),
        ("jacobians", c_int64),
        ("steps", c_int64),
        ("rejected", c_int64),
        ("z", c_void_p),
    ]


_ROWS = [c_void_p, c_size_t]
_BATCH: dict[str, list[Any]] = {
    "rf_film_batch": [c_void_p, c_void_p, c_size_t, *_ROWS * 4, c_void_p],
    "rf_journal_batch": [c_void_p, c_size_t, *_ROWS * 5, c_void_p],
}
_SCALAR: dict[str, list[Any]] = {
    "rf_map_film": [c_void_p] * 5,
    "rf_groove_film": [c_void_p] * 5,
    "rf_short_film": [c_void_p] * 5,
    "rf_journal_call": [c_void_p, *[c_double] * 5, c_void_p],
    "rf_journal_at": [c_void_p] * 4,
    "rf_map_slice": [c_void_p, c_double, c_void_p, c_void_p],
    "rf_map_to_wall": [c_void_p, c_double, c_double],
    "rf_map_error": [c_void_p],
    "rf_groove_error": [c_void_p],
}
_LOOPS: dict[str, list[Any]] = {
    "rf_ring_film": [c_void_p] * 5,
    "rf_ring_pair": [c_void_p, c_size_t, *[c_void_p] * 5],
    "rf_ring_field": [c_void_p] * 7,
    "rf_ring_potential": [c_void_p, c_void_p, c_size_t, *[c_void_p] * 4],
    "rf_ride": [c_void_p, c_void_p, c_double, c_int64, c_void_p, c_void_p],
    "rf_springs_at": [c_void_p] * 4,
    "rf_set_step_table": [c_void_p, c_void_p, c_double, c_void_p],
    "rf_march_to": [c_void_p, c_double, c_int64, c_void_p, c_int64, c_void_p, c_void_p],
    "rf_journal_forces": [c_void_p, c_int64, c_void_p, c_double, c_void_p, c_void_p],
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
    return _typed(ctypes.CDLL, LOOPS, _LOOPS)


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
