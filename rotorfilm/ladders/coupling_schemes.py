"""The coupling schemes that are compared, by kind."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager

from ..cosim import GaussSeidel, Jacobi, Newton, Scheme, SIExp, SIExp3
from ..errors import CouplingWarning


@contextmanager
def quietly() -> Iterator[None]:
    """Silence the warnings of couplings that go to their limit on purpose."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", CouplingWarning)
        yield


EXPLICIT: tuple[Scheme, ...] = (
    *(GaussSeidel(degree=degree) for degree in range(3)),
    *(Jacobi(degree=degree) for degree in range(3)),
)
"""Schemes with a longest stable macro step."""

IMPLICIT: tuple[Scheme, ...] = (SIExp(), SIExp3(), Newton())
"""Schemes that are stable where explicit ones are not."""
