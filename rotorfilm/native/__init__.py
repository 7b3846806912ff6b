"""Thin view of the C library, whose kernels Python and the native FMUs share."""

from .kernels import JournalKernel, MapKernel, Status, slice_table
from .library import NativeLibraryError
from .spec import HasKernel, NativeParameter, NativeSpec

__all__ = [
    "HasKernel",
    "JournalKernel",
    "MapKernel",
    "NativeLibraryError",
    "NativeParameter",
    "NativeSpec",
    "Status",
    "slice_table",
]
