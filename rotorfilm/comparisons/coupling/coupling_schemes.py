"""The coupling schemes that are compared, by kind."""

from __future__ import annotations

from ...cosim import GaussSeidel, Jacobi, Newton, Scheme, SIExp, SIExp3

EXPLICIT: tuple[Scheme, ...] = (
    *(GaussSeidel(degree=degree) for degree in range(3)),
    *(Jacobi(degree=degree) for degree in range(3)),
)
"""Schemes with a longest stable macro step."""

IMPLICIT: tuple[Scheme, ...] = (SIExp(), SIExp3(), Newton())
"""Schemes that are stable where explicit ones are not."""
