"""Thin view of the C library, whose kernels Python and the native FMUs share."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from .film_kernels import (
        FilmKernel as FilmKernel,
        JournalKernel as JournalKernel,
        LobesKernel as LobesKernel,
        MapKernel as MapKernel,
        MapKind as MapKind,
        ShortKernel as ShortKernel,
        SqueezeKernel as SqueezeKernel,
        Status as Status,
    )
    from .library import FOLDER, NativeLibraryError as NativeLibraryError, loops
    from .spec import (
        HasKernel as HasKernel,
        NativeParameter as NativeParameter,
        NativeSpec as NativeSpec,
        slice_table as slice_table,
    )
else:
    show(__name__)
