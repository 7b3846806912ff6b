"""Thin view of the C library, whose kernels Python and the native FMUs share."""

from .kernels import GrooveMapKernel, JournalKernel, MapKernel, Status, slice_table
from .library import NativeLibraryError
from .spec import HasKernel, NativeParameter, NativeSpec

__all__ = [
    "GrooveMapKernel",
    "HasKernel",
    "JournalKernel",
    "MapKernel",
    "NativeLibraryError",
    "NativeParameter",
    "NativeSpec",
    "Status",
    "slice_table",
]
