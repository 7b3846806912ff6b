"""Factors of sparse matrices that are banded when their unknowns are in order, as those of a chain."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse
from scipy.linalg import cho_solve_banded, cholesky_banded, lu_factor, lu_solve
from scipy.linalg.lapack import zgbtrf, zgbtrs
from scipy.sparse.csgraph import reverse_cuthill_mckee

from ...model import Array
from .work import tally


class BandedCholesky:
    """The factor of a positive definite sparse matrix; LinAlgError for another."""

    def __init__(self, matrix: Any) -> None:
        tally("factorizations")
        self.order = band_order(matrix)
        rows, columns, values, _ = _in_order(matrix, self.order)
        upper = rows <= columns
        width = int((columns - rows).max())
        band = np.zeros((width + 1, len(self.order)))
        band[(width + rows - columns)[upper], columns[upper]] = values[upper]
        self.factor = cholesky_banded(band, check_finite=False)

    def solve(self, loads: np.ndarray) -> np.ndarray:
        """Return the matrix's inverse times loads, shape (N, ...), real or complex."""
        if np.iscomplexobj(loads):
            return np.asarray(self.solve(loads.real) + 1j * self.solve(loads.imag))
        found = np.empty(loads.shape)
        found[self.order] = cho_solve_banded((self.factor, False), loads[self.order], check_finite=False)
        return found


class BandedFactor:
    """The LU factor of a complex sparse matrix, with exchange of rows."""

    def __init__(self, matrix: Any) -> None:
        tally("factorizations")
        self.order = band_order(abs(matrix) + abs(matrix).T)
        rows, columns, values, self.width = _in_order(matrix, self.order)
        band = np.zeros((3 * self.width + 1, len(self.order)), dtype=complex)
        band[2 * self.width + rows - columns, columns] = values
        self.factor, self.pivots, _ = zgbtrf(band, self.width, self.width, overwrite_ab=True)

    def solve(self, load: np.ndarray, adjoint: bool = False) -> np.ndarray:
        """Return the inverse of the matrix, or of its conjugate transpose, times a load, shape (N,)."""
        found = np.empty_like(self.factor[0])
        found[self.order] = zgbtrs(
            self.factor, self.width, self.width, load[self.order], self.pivots, trans=2 if adjoint else 0
        )[0]
        return found


class DenseFactor:
    """The LU factor of a dense matrix."""

    def __init__(self, matrix: np.ndarray) -> None:
        tally("factorizations")
        self.factor = lu_factor(matrix, check_finite=False)

    def solve(self, load: np.ndarray, adjoint: bool = False) -> np.ndarray:
        """Return the inverse of the matrix, or of its conjugate transpose, times a load, shape (N,)."""
        return np.asarray(lu_solve(self.factor, load, trans=2 if adjoint else 0))


def band_order(matrix: Any) -> Array:
    """Return the order of the unknowns of a symmetric pattern in which its band is narrow."""
    return np.asarray(reverse_cuthill_mckee(sparse.csr_array(matrix), symmetric_mode=True))


def _in_order(matrix: Any, order: Array) -> tuple[Array, Array, np.ndarray, int]:
    """Return rows, columns and values of a matrix whose unknowns are put in order, and its band's width."""
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    entries = sparse.coo_array(matrix)
    rows, columns = place[entries.row], place[entries.col]
    return rows, columns, entries.data, int(np.abs(rows - columns).max(initial=0))
