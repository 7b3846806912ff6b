"""Thin view of the C library: the kernels that Python and the native FMUs share."""

from .kernels import JournalKernel, MapKernel, Status
from .library import NativeLibraryError

__all__ = ["JournalKernel", "MapKernel", "NativeLibraryError", "Status"]
