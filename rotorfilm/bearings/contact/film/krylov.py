"""GMRES without restarts, on few vectors at once: what a call of it costs beside its products is little."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.linalg import solve_triangular

from ....model import Array


class KrylovAnswer(NamedTuple):
    """An approximate solution, and the products taken."""

    x: Array
    products: int


def gmres(product: Callable[[Array], Array], right: Array, *, tolerance: float, most: int) -> KrylovAnswer:
    """Return x with |right - A x| <= tolerance |right|, or the best of `most` products.

    After Saad and Schultz (1986).

    Parameters
    ----------
    product : callable
        A x.
    right : ndarray, shape (n,)
    tolerance : float
    most : int
        Products allowed.
    """
    size = float(np.linalg.norm(right))
    if size == 0.0:
        return KrylovAnswer(np.zeros_like(right), 0)
    basis = np.empty((most + 1, len(right)))
    basis[0] = right / size
    upper = np.zeros((most + 1, most))
    turns = np.zeros((most, 2))
    missed = np.zeros(most + 1)
    missed[0], count = size, 0
    while count < most and abs(missed[count]) > tolerance * size:
        k, known = count, basis[: count + 1]
        fresh = product(basis[k])
        for _ in range(2):  # twice is enough to be orthogonal to roundoff
            share = known @ fresh
            fresh = fresh - share @ known
            upper[: k + 1, k] += share
        length = float(np.linalg.norm(fresh))
        column = upper[:, k]
        for i in range(k):
            c, s = turns[i]
            column[i], column[i + 1] = c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]
        radius = float(np.hypot(column[k], length))
        if radius == 0.0:
            break
        turns[k] = column[k] / radius, length / radius
        column[k] = radius
        missed[k + 1], missed[k] = -turns[k, 1] * missed[k], turns[k, 0] * missed[k]
        count += 1
        if length == 0.0:
            break
        basis[count] = fresh / length
    weights = solve_triangular(upper[:count, :count], missed[:count])
    return KrylovAnswer(weights @ basis[:count], count)
