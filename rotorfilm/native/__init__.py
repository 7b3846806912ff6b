"""Thin view of the C library: the kernels that Python and the native FMUs share."""

from .kernels import GroovedJournalKernel, GrooveMapKernel, JournalKernel, MapKernel, Status
from .library import NativeLibraryError

__all__ = [
    "GrooveMapKernel",
    "GroovedJournalKernel",
    "JournalKernel",
    "MapKernel",
    "NativeLibraryError",
    "Status",
]
