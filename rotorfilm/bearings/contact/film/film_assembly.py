"""Sparse matrices L diag(a) R that are made anew for every a, of one pattern, by one product with a.

Newton's method needs sums of such products at every step. Their entries are linear in a, so the pattern and
the matrix from a to the entries are found once for a grid.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from scipy import sparse

from ....model import Array


class _Triples(NamedTuple):
    """Entries of L diag(a) R: keys of the place (row, column), index into a, factor."""

    key: np.ndarray
    source: np.ndarray
    factor: Array


class Assembly:
    """Sums of products L diag(a) R, and of given matrices, as data of one sparse pattern.

    Parameters
    ----------
    pairs : sequence of (sparse matrix, sparse matrix)
        The factors L (n, f) and R (f, m) of each product; f may differ from one to the next.
    fixed : sequence of sparse matrix, shape (n, m)
        Matrices that the pattern must hold too.

    Attributes
    ----------
    columns : ndarray of int, shape (nnz,)
        Column of each entry.
    fixed : list of ndarray, shape (nnz,)
        Entries of the given matrices.
    """

    def __init__(self, pairs: Sequence[tuple[Any, Any]], fixed: Sequence[Any] = ()) -> None:
        rows, width = pairs[0][0].shape[0], pairs[0][1].shape[1]
        parts = [_triples(left.tocoo(), right.tocsr()) for left, right in pairs]
        given = [matrix.tocoo() for matrix in fixed]
        keys = [matrix.row.astype(np.int64) * width + matrix.col for matrix in given]
        pattern = np.unique(np.concatenate([*(part.key for part in parts), *keys]))
        self.shape = (rows, width)
        self.columns = (pattern % width).astype(np.int32)
        self._starts = np.searchsorted(pattern, np.arange(rows + 1, dtype=np.int64) * width).astype(np.int32)
        maps = [
            sparse.csr_matrix(
                (part.factor, (np.searchsorted(pattern, part.key), part.source)),
                shape=(len(pattern), left.shape[1]),
            )
            for part, (left, _) in zip(parts, pairs, strict=True)
        ]
        self._map = sparse.hstack(maps).tocsr()
        self.fixed: list[Array] = [
            np.bincount(np.searchsorted(pattern, key), matrix.data, len(pattern)).astype(float)
            for key, matrix in zip(keys, given, strict=True)
        ]

    def entries(self, *scales: Array) -> Array:
        """Return the entries of the sum of L diag(a) R for the given a, one for each pair."""
        return np.asarray(self._map @ np.concatenate(scales))

    def matrix(self, entries: Array) -> Any:
        """Return the sparse matrix of the entries."""
        return sparse.csr_matrix((entries, self.columns, self._starts), shape=self.shape, copy=False)


def _triples(left: Any, right: Any) -> _Triples:
    """Return one triple for each pair of entries of L and R that share an index into a."""
    counts = np.diff(right.indptr)[left.col]
    first = np.cumsum(counts) - counts
    at = np.repeat(right.indptr[left.col] - first, counts) + np.arange(counts.sum())
    row = np.repeat(left.row.astype(np.int64), counts)
    return _Triples(
        row * right.shape[1] + right.indices[at],
        np.repeat(left.col, counts),
        np.repeat(left.data, counts) * right.data[at],
    )
