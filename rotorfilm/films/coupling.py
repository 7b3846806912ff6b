"""Coupling functions of the splitting method and their integrals over the film's arc.

For psi = sum b_i X_i with antiderivatives S_i (S_i' = X_i) and <.> = int . H^-3 dgamma over the arc

    M_ij = <X_i X_j>,   K_ij = <S_i S_j> - <S_i><S_j>/<1>.

Both are handed on in coordinates in which M = 1 (`whitened`), because there the derivatives with respect
to anything that changes the weight H^-3 or the arc are plain Gram matrices:
dM = <X X^T d>, dK = <S- S-^T d>, S- = S - <S>/<1>, d = d(log weight).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..model import Array
from .elliptic import film_nodes
from .gram import arc_gram

SIN_COS = np.array([[0.0, 0.0, 1.0], [-1.0, 1.0, 0.0]])
"""X = (sin, cos) in terms of (1, w, sin), w = 1 + cos."""

ANTIDERIVATIVES = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
"""S = (-w, sin) in terms of (1, w, sin)."""


DEPENDENT = 1e-10
"""Singular value, relative to the largest, below which coupling functions count as dependent."""


class CouplingIntegrals(NamedTuple):
    """Integrals over one arc, batch axis first, in coordinates with M = 1.

    Attributes
    ----------
    K : ndarray, shape (B, n, n)
    M_chi, K_chi : ndarray, shape (B, n, n)
        Derivatives with respect to the eccentricity ratio at a fixed arc.
    M_turn, K_turn : ndarray, shape (B, n, n)
        Derivatives when both ends move by the same angle.
    source : ndarray, shape (B, n, 2)
        Coordinates of (sin gamma, cos gamma).
    """

    K: Array
    M_chi: Array
    K_chi: Array
    M_turn: Array
    K_turn: Array
    source: Array


class PairIntegrals(NamedTuple):
    """M and K of the pair (sin, cos) as they stand, with derivatives, each of shape (B, 2, 2)."""

    M: Array
    K: Array
    M_chi: Array
    K_chi: Array
    M_turn: Array
    K_turn: Array


def pair_integrals(chi: Array, start: Array, end: Array) -> PairIntegrals:
    """Return M, K and their derivatives for X = (sin, cos), in closed form."""
    gram, gram_chi = arc_gram(chi, start, end)
    mean = gram[:, 0, :] / gram[:, :1, 0]
    # Rows of S- = S - <S>/<1> in terms of (1, w, sin).
    centered = np.broadcast_to(ANTIDERIVATIVES, (len(chi), 2, 3)).copy()
    centered[:, :, 0] -= mean @ ANTIDERIVATIVES.T
    M_turn, K_turn = np.zeros((2, len(chi), 2, 2))
    for sign, gamma in ((1.0, end), (-1.0, start)):
        functions = np.stack([np.ones_like(gamma), 1.0 + np.cos(gamma), np.sin(gamma)], -1)
        weight = sign * (1.0 + chi * np.cos(gamma)) ** -3.0
        M_turn += _outer(functions @ SIN_COS.T, weight)
        K_turn += _outer(np.einsum("bij,bj->bi", centered, functions), weight)
    transposed = centered.swapaxes(-1, -2)
    return PairIntegrals(
        SIN_COS @ gram @ SIN_COS.T,
        centered @ gram @ transposed,
        SIN_COS @ gram_chi @ SIN_COS.T,
        centered @ gram_chi @ transposed,
        M_turn,
        K_turn,
    )


def whitened(pair: PairIntegrals) -> CouplingIntegrals:
    """Return the integrals of a pair in coordinates in which M = 1."""
    lower = np.asarray(np.linalg.cholesky(pair.M), dtype=np.float64)
    inverse = np.linalg.inv(lower)
    K, M_chi, K_chi, M_turn, K_turn = (
        inverse @ matrix @ inverse.swapaxes(-1, -2)
        for matrix in (pair.K, pair.M_chi, pair.K_chi, pair.M_turn, pair.K_turn)
    )
    return CouplingIntegrals(K, M_chi, K_chi, M_turn, K_turn, lower.swapaxes(-1, -2))


def coupling_integrals(
    chi: Array, start: Array, end: Array, functions: int, constant: bool
) -> CouplingIntegrals:
    """Return the integrals of the first `functions` circumferential functions by quadrature.

    Parameters
    ----------
    chi, start, end : ndarray, shape (B,)
        Eccentricity ratio and the ends of the arc [rad].
    functions : int
        Number of functions sin gamma, cos gamma, sin 2 gamma, ...
    constant : bool
        Whether X = 1 (S = gamma) is added.
    """
    nodes = film_nodes(chi, start, end, count=64 + 4 * functions)
    root = np.sqrt(nodes.weight)[..., None]
    X, S = _functions(nodes.half_sine, nodes.half_cosine, nodes.gamma, functions, constant)
    mean = np.sum(S * root**2, axis=1) / np.sum(root**2, axis=1)
    Q, coordinates, transform = _orthonormalized(X * root)
    Z = ((S - mean[:, None, :]) * root) @ transform
    log_slope = (-3.0 * nodes.cosine / nodes.film)[..., None]
    M_turn, K_turn = _end_derivatives(chi, start, end, mean, transform, functions, constant)
    return CouplingIntegrals(
        Z.swapaxes(-1, -2) @ Z,
        Q.swapaxes(-1, -2) @ (log_slope * Q),
        Z.swapaxes(-1, -2) @ (log_slope * Z),
        M_turn,
        K_turn,
        coordinates[:, :, :2],
    )


def _orthonormalized(X: Array) -> tuple[Array, Array, Array]:
    """Return orthonormal columns Q, coordinates R and T with X = Q R and Q = X T, batch axis first.

    Directions in which the columns of X are dependent to roundoff are dropped (columns of zeros): on a short
    arc harmonics are all but dependent, and such a direction would carry noise, not film.
    """
    scale = np.linalg.norm(X, axis=1)
    left, singular, right = np.linalg.svd(X / scale[:, None, :], full_matrices=False)
    keep = singular > DEPENDENT * singular[:, :1]
    inverse = np.where(keep, 1.0 / np.where(keep, singular, 1.0), 0.0)
    transform = right.swapaxes(-1, -2) * inverse[:, None, :] / scale[:, :, None]
    coordinates = (singular * keep)[:, :, None] * right * scale[:, None, :]
    return left * keep[:, None, :], coordinates, transform


def _functions(
    half_sine: Array, half_cosine: Array, gamma: Array, functions: int, constant: bool
) -> tuple[Array, Array]:
    """Return X and S, shape (..., n), spanning sin gamma, cos gamma, sin 2 gamma, ... in this order.

    With w = 1 + cos gamma the pairs are (sin w^(j-1), w^j - (2j-1)/j w^(j-1)) with antiderivatives
    (-w^j/j, sin w^(j-1)/j): the same spans as the harmonics, but every S vanishes at the minimum film, so
    the variances K lose no digits as chi -> 1.
    """
    w = 2.0 * half_cosine**2
    sine = 2.0 * half_sine * half_cosine
    X, S = [], []
    for j in range(1, (functions + 1) // 2 + 1):
        lower = w ** (j - 1)
        X += [sine * lower, w**j - (2.0 * j - 1.0) / j * lower]
        S += [-(w**j) / j, sine * lower / j]
    X, S = X[:functions], S[:functions]
    if constant:
        X.append(np.ones_like(gamma))
        S.append(gamma - np.pi)
    return np.stack(X, -1), np.stack(S, -1)


def _end_derivatives(
    chi: Array, start: Array, end: Array, mean: Array, transform: Array, functions: int, constant: bool
) -> tuple[Array, Array]:
    """Return dM and dK when both ends turn by the same angle."""
    shape = (len(chi), transform.shape[-1], transform.shape[-1])
    M_turn, K_turn = np.zeros(shape), np.zeros(shape)
    for sign, gamma in ((1.0, end), (-1.0, start)):
        X, S = _functions(np.sin(0.5 * gamma), np.cos(0.5 * gamma), gamma, functions, constant)
        weight = sign * (1.0 + chi * np.cos(gamma)) ** -3.0
        M_turn += _outer(np.einsum("bi,bij->bj", X, transform), weight)
        K_turn += _outer(np.einsum("bi,bij->bj", S - mean, transform), weight)
    return M_turn, K_turn


def _outer(vectors: Array, weight: Array) -> Array:
    return weight[:, None, None] * vectors[:, :, None] * vectors[:, None, :]
