"""Vector fitting: a stable state space of given order through samples of a transfer function.

After Gustavsen and Semlyen (1999), for functions that vanish at s = 0: f(s) = s sum of r_k/(s - p_k). The
poles are moved to the zeros of a fitted denominator, and those that land in the right half-plane are
mirrored, so the result is stable by construction; its static gain is exactly zero.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...errors import InputError
from ...model import Array, Linearization

ROUNDS = 40
"""Relocations of the poles."""


class RationalFit(NamedTuple):
    """A state space dx' = A x + B u, y = C x + D u with D = C A^-1 B, and its error.

    Attributes
    ----------
    system : Linearization
    error : float
        Largest weighted deviation from the samples.
    """

    system: Linearization
    error: float


def fit_transfer(frequency: Array, value: np.ndarray, order: int, weight: Array) -> RationalFit:
    """Return the fit of samples f(i omega).

    Parameters
    ----------
    frequency : ndarray, shape (n,) [1]
        omega > 0, rising.
    value : ndarray of complex, shape (n,)
    order : int
        Number of states, at least 1.
    weight : ndarray, shape (n,)
        By which deviations count.

    Raises
    ------
    InputError
        If there are fewer samples than the fit has unknowns.
    """
    if order < 1 or 2 * len(frequency) < 2 * order + 1:
        raise InputError(f"order must be from 1 to {len(frequency) - 1}, got {order!r}")
    s = 1j * frequency
    A, B = _start(frequency, order)
    best: RationalFit | None = None
    for _ in range(ROUNDS):
        A, B = _canonical(_relocated(A, B, s, value, weight))
        fit = _fitted(A, B, s, value, weight)
        best = fit if best is None or fit.error < best.error else best
    assert best is not None
    return best


def _start(frequency: Array, order: int) -> tuple[Array, Array]:
    """Return weakly damped pole pairs spread over the frequencies, and one real pole if the order is odd."""
    pairs = np.geomspace(max(frequency[0], 1e-2 * frequency[-1]), frequency[-1], max(order // 2, 1))[
        : order // 2
    ]
    poles = [-0.3 * w + 1j * w for w in pairs]
    return _canonical(np.array([*poles, *np.conj(poles), *([-frequency[-1] / 3.0] * (order % 2))]))


def _canonical(poles: np.ndarray) -> tuple[Array, Array]:
    """Return the real matrices A and B of stable poles: a 2 x 2 block for each pair."""
    stable = -abs(poles.real) + 1j * poles.imag
    size = len(stable)
    A, B, k = np.zeros((size, size)), np.zeros(size), 0
    for pole in stable[stable.imag > 0.0]:
        A[k : k + 2, k : k + 2] = [[pole.real, pole.imag], [-pole.imag, pole.real]]
        B[k] = 2.0
        k += 2
    for pole in stable[stable.imag == 0.0]:
        A[k, k], B[k] = pole.real, 1.0
        k += 1
    return A, B


def _basis(A: Array, B: Array, s: np.ndarray) -> np.ndarray:
    """Return (s - A)^-1 B at each s, shape (n, order)."""
    return np.stack([np.linalg.solve(value * np.eye(len(A)) - A, B.astype(complex)) for value in s])


def _relocated(A: Array, B: Array, s: np.ndarray, value: np.ndarray, weight: Array) -> np.ndarray:
    """Return the zeros of the denominator 1 + c (s - A)^-1 B fitted together with the numerator."""
    basis = _basis(A, B, s)
    rows = np.hstack([s[:, None] * basis, -value[:, None] * basis])
    solution = _least_squares(rows, value, weight)
    return np.linalg.eigvals(A - np.outer(B, solution[len(A) :]))


def _fitted(A: Array, B: Array, s: np.ndarray, value: np.ndarray, weight: Array) -> RationalFit:
    basis = s[:, None] * _basis(A, B, s)
    residues = _least_squares(basis, value, weight)
    error = float(np.max(weight * abs(basis @ residues - value)))
    # s (s - A)^-1 B = B + A (s - A)^-1 B
    system = Linearization(A, B[:, None], (residues @ A)[None], np.array([[residues @ B]]))
    return RationalFit(system, error)


def _least_squares(rows: np.ndarray, value: np.ndarray, weight: Array) -> Array:
    """Return the real solution; columns are scaled to one size first."""
    weighted = weight[:, None] * rows
    real = np.vstack([weighted.real, weighted.imag])
    scale = np.maximum(np.linalg.norm(real, axis=0), 1e-300)
    wanted = np.concatenate([(weight * value).real, (weight * value).imag])
    return np.linalg.lstsq(real / scale, wanted, rcond=None)[0] / scale
