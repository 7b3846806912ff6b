"""How many eigenvalues of a Hermitian matrix are negative, by Sylvester's law of inertia."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from ...errors import ConvergenceError
from ...rotors.sparse_chain import is_sparse
from .banded import band_order
from .work import tally

GROWTH = 1e7
"""Largest entry of a factor without exchange of rows at which its signs are trusted."""

ASIDE = 1e-9
"""By how much the place of the count is moved, as a part, where the factor grows further."""

_TRIES = 4


def negative_count(stiffness: Any, square: float, inertia: Any) -> int:
    """Return how many eigenvalues of stiffness - square inertia, both Hermitian, are negative.

    By Sylvester's law of inertia it is the number of negative pivots of the factor L D L*.

    Raises
    ------
    ConvergenceError
        If the factor grows near every place that was tried: an eigenvalue is there.
    """
    if not is_sparse(stiffness):
        tally("eigenproblems")
        return int(np.sum(np.linalg.eigvalsh(stiffness - square * inertia) < 0.0))
    order: Any = band_order(abs(stiffness) + abs(inertia))
    whole, heavy = (sparse.csc_array(part)[order][:, order] for part in (stiffness, inertia))
    scale = 1.0 / np.sqrt(np.maximum(abs(whole).max(axis=1).toarray().ravel(), np.finfo(float).tiny))
    scaling = sparse.diags_array(scale)
    for k in range(_TRIES):
        shifted = scaling @ (whole - square * (1.0 + k * ASIDE) * heavy) @ scaling
        options = {"SymmetricMode": True, "Equil": False}
        tally("factorizations")
        factor = splu(
            sparse.csc_matrix(shifted), permc_spec="NATURAL", diag_pivot_thresh=0.0, options=options
        )
        kept = np.array_equal(factor.perm_r, np.arange(len(order)))
        if kept and abs(factor.L).max() <= GROWTH:
            return int(np.sum(factor.U.diagonal().real < 0.0))
    raise ConvergenceError(f"eigenvalues below {square:.6g} must be counted, and one is too near")
