"""Undamped modes of a shaft in one plane."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.linalg import eigh
from scipy.sparse.linalg import LinearOperator, eigsh

from ...model import Array
from ...rotors.sparse_chain import dense_matrix
from ..large.banded import BandedCholesky

WHOLE = 400
"""Coordinates up to which matrices are solved dense."""

_SHIFT = 1e-9
"""Part of the largest stiffness / mass at which a free shaft is solved."""


def lowest_modes(stiffness: Any, mass: Any, count: int) -> tuple[Array, Array]:
    """Return the lowest squared frequencies [rad2/s2], rising, and shapes of unit mass, shape (n, count).

    Parameters
    ----------
    stiffness, mass : sparse array, shape (n, n)
        Symmetric; the stiffness may leave the shaft free.
    count : int
        At most n; fewer come back where n is less.
    """
    n = stiffness.shape[0]
    if n <= WHOLE:
        few = min(count, n)
        squares, shapes = eigh(dense_matrix(stiffness), dense_matrix(mass), subset_by_index=[0, few - 1])
        return squares, shapes
    shift = _SHIFT * abs(stiffness).max() / abs(mass).max()
    solid = BandedCholesky(stiffness + shift * mass)
    inverse = LinearOperator((n, n), matvec=solid.solve, dtype=float)
    start = np.random.default_rng(0).normal(size=n)
    squares, shapes = eigsh(stiffness, count, mass, sigma=-shift, which="LM", OPinv=inverse, v0=start)
    order = np.argsort(squares)
    return squares[order], shapes[:, order]
