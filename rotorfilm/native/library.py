"""Where the C library lies, and the types of its functions."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Sequence
from ctypes import c_double, c_int, c_int32, c_size_t, c_void_p
from functools import cache
from importlib.resources import as_file, files
from typing import Any, ClassVar

from ..errors import RotorfilmError

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
        ("map", c_void_p),
        ("clearance", c_double),
        ("force_scale", c_double),
        ("error", c_double),
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
    "rf_map_contact": [c_void_p, c_double, c_double],
    "rf_map_error": [c_void_p],
    "rf_groove_error": [],
}


@cache
def functions() -> dict[str, Any]:
    """Return the functions of the library by name, loaded on the first call.

    Batches release the interpreter lock; a scalar call is over before that would pay.

    Raises
    ------
    NativeLibraryError
        If the library is missing or cannot be loaded.
    """
    return {**_typed(ctypes.CDLL, _BATCH), **_typed(ctypes.PyDLL, _SCALAR)}


def _typed(loader: type[ctypes.CDLL], signatures: dict[str, list[Any]]) -> dict[str, Any]:
    library = _load(loader)
    try:
        found = {name: getattr(library, name) for name in signatures}
    except AttributeError as error:
        raise NativeLibraryError(
            f"the compiled library of rotorfilm is of another version ({error}); {REMEDY}"
        ) from error
    for name, function in found.items():
        function.argtypes, function.restype = signatures[name], c_int
    return found


def _load(loader: type[ctypes.CDLL]) -> ctypes.CDLL:
    name = "rotorfilm" + SUFFIXES.get(sys.platform, ".so")
    try:
        with as_file(files(__package__).joinpath(name)) as path:
            return loader(str(path))
    except OSError as error:
        raise NativeLibraryError(
            f"the compiled library {name} of rotorfilm is missing or unusable ({error}); {REMEDY}"
        ) from error
