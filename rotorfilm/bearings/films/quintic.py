"""Interpolation by quintic B-splines on a uniform grid: sixth order, four derivatives continuous."""

from __future__ import annotations

import numpy as np

from ...model import Array

DEGREE = 5

_AT_NODE = np.array([1.0, 26.0, 66.0, 26.0, 1.0]) / 120.0
_POWERS = np.arange(6.0)[:, None]
_BASIS = (
    np.array(
        [
            [1.0, -5.0, 10.0, -10.0, 5.0, -1.0],
            [26.0, -50.0, 20.0, 20.0, -20.0, 5.0],
            [66.0, 0.0, -60.0, 0.0, 30.0, -10.0],
            [26.0, 50.0, 20.0, -20.0, -20.0, 10.0],
            [1.0, 5.0, 10.0, 10.0, 5.0, -5.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        ]
    )
    / 120.0
)
"""Polynomials of the fraction of a cell that its six B-splines are."""

_SIXTH_DIFFERENCE = np.array([1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0])


def quintic_coefficients(values: Array, axis: int = 0) -> Array:
    """Return the B-spline coefficients that interpolate `values` on a uniform grid along one axis.

    Parameters
    ----------
    values : ndarray
        Values at `cells + 1` nodes along `axis`, at least 6.
    axis : int
        The axis of the nodes.

    Returns
    -------
    ndarray
        `cells + 5` coefficients along `axis`; cell i is covered by i, ..., i + 5. The two knots nearest
        to each end are no knots (the fifth derivative is continuous there), which keeps the sixth order
        up to the ends.
    """
    nodes = np.moveaxis(values, axis, 0)
    right = np.concatenate([nodes, np.zeros((4, *nodes.shape[1:]))])
    matrix = _collocation(len(nodes) - 1)
    solved = np.linalg.solve(matrix, right.reshape(len(right), -1))
    return np.moveaxis(solved.reshape(right.shape), 0, axis)


def periodic_quintic_coefficients(values: Array, axis: int = 0) -> Array:
    """Return the coefficients that interpolate `values` on a uniform turn, each centered on its node."""
    count = values.shape[axis]
    turn = 2.0 * np.pi * np.arange(count // 2 + 1) / count
    at_node = (66.0 + 52.0 * np.cos(turn) + 2.0 * np.cos(2.0 * turn)) / 120.0
    spectrum = np.moveaxis(np.fft.rfft(values, axis=axis), axis, -1) / at_node
    return np.fft.irfft(np.moveaxis(spectrum, -1, axis), count, axis)


def periodic_quintic(coefficients: Array, turns: Array) -> Array:
    """Return the periodic spline of `periodic_quintic_coefficients` (axis 0) at fractions of a turn, (n,)."""
    count = len(coefficients)
    cell, inside = np.divmod(turns % 1.0 * count, 1.0)
    near = (cell.astype(int) + np.arange(-2, 4)[:, None]) % count
    return np.einsum("jn,jn...->n...", spline_weights(inside), coefficients[near])


def spline_weights(inside: Array) -> Array:
    """Return the six B-splines of a cell at fractions of it, shape (6, n)."""
    return _BASIS @ inside**_POWERS


def spline_slopes(inside: Array) -> Array:
    """Return the derivatives of the six B-splines of a cell by the fraction, shape (6, n)."""
    return _BASIS[:, 1:] @ (_POWERS[1:] * inside ** _POWERS[:-1])


def _collocation(cells: int) -> Array:
    matrix = np.zeros((cells + 5, cells + 5))
    for node in range(cells + 1):
        matrix[node, node : node + 5] = _AT_NODE
    for row, knot in enumerate((1, 2, cells - 2, cells - 1)):
        matrix[cells + 1 + row, knot - 1 : knot + 6] = _SIXTH_DIFFERENCE
    return matrix
