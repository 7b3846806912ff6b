"""Thin view of the C library, whose kernels Python and the native FMUs share."""

from typing import TYPE_CHECKING

from ..sources import show

if TYPE_CHECKING:
    from .film_kernels import (
        FilmKernel as FilmKernel,
        GrooveMapKernel as GrooveMapKernel,
        MapKernel as MapKernel,
        ShortKernel as ShortKernel,
        Status as Status,
    )
    from .library import NativeLibraryError as NativeLibraryError
    from .map_slice import slice_table as slice_table
    from .response_kernels import JournalKernel as JournalKernel, LobesKernel as LobesKernel
    from .spec import HasKernel as HasKernel, NativeParameter as NativeParameter, NativeSpec as NativeSpec
else:
    show(__name__)
