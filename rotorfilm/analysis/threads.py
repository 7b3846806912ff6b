"""One BLAS thread while an analysis runs, since matrices of rotors are too small to share out.

Two threads of OpenBLAS take five times as long as one for the eigenvalues of a hundred states: they wait for
each other. Jobs of many speeds, rotors or scenes gain by processes instead.
"""

from __future__ import annotations

from contextlib import ContextDecorator
from functools import cache
from threading import Lock
from typing import Any


class OneBlasThread(ContextDecorator):
    """Limits the linear algebra of NumPy and SciPy to one thread, until the last such block ends.

    The limit is one of the process, so it holds for other threads of it meanwhile. What was set before is
    set again.
    """

    def __init__(self) -> None:
        self._lock = Lock()
        self._blocks = 0
        self._before: list[int] = []

    def __enter__(self) -> None:
        with self._lock:
            self._blocks += 1
            if self._blocks == 1:
                self._before = [library.get_num_threads() for library in libraries()]
                for library in libraries():
                    library.set_num_threads(1)

    def __exit__(self, *error: object) -> None:
        with self._lock:
            self._blocks -= 1
            if self._blocks == 0:
                for library, threads in zip(libraries(), self._before, strict=True):
                    library.set_num_threads(threads)


one_blas_thread = OneBlasThread()


@cache
def libraries() -> list[Any]:
    """Return the controllers of the BLAS libraries of NumPy and SciPy, which may be one or two."""
    import scipy.linalg  # noqa: F401  (its library counts too)
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController().select(user_api="blas").lib_controllers
