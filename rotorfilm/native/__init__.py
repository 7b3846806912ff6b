"""Thin view of the C library, whose kernels Python and the native FMUs share."""

from .film_kernels import (
    FilmKernel,
    GrooveMapKernel,
    JournalKernel,
    MapKernel,
    ShortKernel,
    Status,
)
from .library import NativeLibraryError
from .map_slice import slice_table
from .spec import HasKernel, NativeParameter, NativeSpec

__all__ = [
    "FilmKernel",
    "GrooveMapKernel",
    "HasKernel",
    "JournalKernel",
    "MapKernel",
    "NativeLibraryError",
    "NativeParameter",
    "NativeSpec",
    "ShortKernel",
    "Status",
    "slice_table",
]
