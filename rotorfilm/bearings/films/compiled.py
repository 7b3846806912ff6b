"""Compilation of the two-dimensional film's kernels, with a cache on disk that knows when it is stale.

numba compiles a kernel anew when the file that holds it changes, but not when a kernel that it calls
changes in another file. The names under which kernels are cached therefore carry a digest of all kernels'
sources.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

try:
    from numba import njit
except ImportError:  # An FMU carries this module, and asks no more of a machine than numpy and scipy.
    njit = None


Kernel = TypeVar("Kernel", bound=Callable[..., Any])


_KERNELS = sorted((Path(__file__).parent / "ring").glob("*.py"))
_STAMP = hashlib.sha256(b"".join(path.read_bytes() for path in _KERNELS)).hexdigest()[:12]


def compiled(function: Kernel) -> Kernel:
    """Return the function compiled by numba, cached on disk; as it is where there is no numba."""
    if njit is None:
        return function
    function.__qualname__ += f"_{_STAMP}"
    return cast(Kernel, njit(cache=True)(function))


def compiled_sums(function: Kernel) -> Kernel:
    """Return the function compiled with sums in any order, so that they vectorize; else as `compiled`."""
    if njit is None:
        return function
    function.__qualname__ += f"_{_STAMP}"
    return cast(Kernel, njit(cache=True, fastmath={"reassoc", "contract"})(function))
