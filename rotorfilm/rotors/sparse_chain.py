"""Sparse matrices of a chain of elements: how they are summed, and how they become dense."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from scipy import sparse

from ..model import Array


def summed(size: int, parts: Iterable[tuple[Sequence[int], Array]]) -> Any:
    """Return the sparse matrix that small matrices at the given places add up to, shape (size, size)."""
    rows, columns, values = [], [], []
    for places, part in parts:
        row, column = np.meshgrid(places, places, indexing="ij")
        rows.append(row.ravel())
        columns.append(column.ravel())
        values.append(np.ravel(part))
    if not values:
        return sparse.csr_array((size, size))
    where = (np.concatenate(rows), np.concatenate(columns))
    found = sparse.coo_array((np.concatenate(values), where), shape=(size, size)).tocsr()
    found.eliminate_zeros()
    return found


def planes(pattern: Array, matrix: Any) -> Any:
    """Return the Kronecker product of a pattern of two planes and the matrix of one, sparse if that is."""
    if is_sparse(matrix):
        return sparse.csr_array(sparse.kron(sparse.csr_array(pattern), matrix))
    return np.asarray(np.kron(pattern, matrix), dtype=float)


def dense_matrix(part: Any) -> Any:
    """Return a part of a structure, as an ndarray where it is a sparse array."""
    return part.toarray() if is_sparse(part) else part


def is_sparse(part: Any) -> bool:
    """Return whether a part of a structure is a sparse array."""
    return bool(sparse.issparse(part))
