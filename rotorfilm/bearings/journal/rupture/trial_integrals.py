"""Coupling functions of the splitting method and their integrals over the film's arc.

For psi = sum b_i X_i with antiderivatives S_i (S_i' = X_i) and <.> = int . H^-3 dgamma over the arc

    M_ij = <X_i X_j>,   K_ij = <S_i S_j> - <S_i><S_j>/<1>.

Both are handed on in coordinates in which M = 1 (`whitened`), because there the derivatives with respect
to anything that changes the weight H^-3 or the arc are plain Gram matrices:
dM = <X X^T d>, dK = <S- S-^T d>, S- = S - <S>/<1>, d = d(log weight); an end that moves by dgamma adds its
boundary value +-X X^T H^-3 dgamma, and the same of S-.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....model import Array
from .elliptic import FilmNodes, film_nodes
from .gram import arc_gram
from .rupture import Basis, FilmArc

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
        Derivatives with respect to the eccentricity ratio, the ends moving with it.
    M_turn, K_turn : ndarray, shape (B, n, n)
        Derivatives with respect to the direction of the source, which moves the ends only.
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


def pair_integrals(chi: Array, arc: FilmArc) -> PairIntegrals:
    """Return M, K and their derivatives for X = (sin, cos), in closed form."""
    gram, gram_chi = arc_gram(chi, arc.start, arc.end)
    mean = gram[:, 0, :] / gram[:, :1, 0]
    # Rows of S- = S - <S>/<1> in terms of (1, w, sin).
    centered = np.broadcast_to(ANTIDERIVATIVES, (len(chi), 2, 3)).copy()
    centered[:, :, 0] -= mean @ ANTIDERIVATIVES.T
    transposed = centered.swapaxes(-1, -2)
    M_chi, K_chi = SIN_COS @ gram_chi @ SIN_COS.T, centered @ gram_chi @ transposed
    M_turn, K_turn = np.zeros((2, len(chi), 2, 2))
    for end in arc_ends(chi, arc):
        functions = np.stack([np.ones_like(chi), 1.0 + np.cos(end.gamma), np.sin(end.gamma)], -1)
        by_X = _outer(functions @ SIN_COS.T, end.weight)
        by_S = _outer(np.einsum("bij,bj->bi", centered, functions), end.weight)
        M_chi, K_chi = M_chi + end.by_chi * by_X, K_chi + end.by_chi * by_S
        M_turn, K_turn = M_turn + end.by_turn * by_X, K_turn + end.by_turn * by_S
    M, K = SIN_COS @ gram @ SIN_COS.T, centered @ gram @ transposed
    return PairIntegrals(M, K, M_chi, K_chi, M_turn, K_turn)


class ArcEnd(NamedTuple):
    """One end of an arc: angle, H^-3 with the sign of an outward motion, and rates of shape (B, 1, 1)."""

    gamma: Array
    weight: Array
    by_chi: Array
    by_turn: Array


def arc_ends(chi: Array, arc: FilmArc) -> tuple[ArcEnd, ArcEnd]:
    """Return the first and the last end of an arc."""
    ends = (
        (-1.0, arc.start, arc.start_chi, arc.start_turn),
        (1.0, arc.end, arc.end_chi, arc.end_turn),
    )
    first, last = (
        ArcEnd(
            gamma,
            sign * (1.0 + chi * np.cos(gamma)) ** -3.0,
            by_chi[:, None, None],
            by_turn[:, None, None],
        )
        for sign, gamma, by_chi, by_turn in ends
    )
    return first, last


def whitened(pair: PairIntegrals) -> CouplingIntegrals:
    """Return the integrals of a pair in coordinates in which M = 1."""
    lower = np.asarray(np.linalg.cholesky(pair.M), dtype=np.float64)
    inverse = np.linalg.inv(lower)
    K, M_chi, K_chi, M_turn, K_turn = (
        inverse @ matrix @ inverse.swapaxes(-1, -2)
        for matrix in (pair.K, pair.M_chi, pair.K_chi, pair.M_turn, pair.K_turn)
    )
    return CouplingIntegrals(K, M_chi, K_chi, M_turn, K_turn, lower.swapaxes(-1, -2))


class WhitenedFunctions(NamedTuple):
    """Coupling functions at the nodes of an arc, in coordinates with M = 1.

    Attributes
    ----------
    nodes : FilmNodes
    root : ndarray, shape (B, N, 1)
        Square root of the nodes' weight, H^-3 included.
    X, S : ndarray, shape (B, N, n)
        X_i and S_i - <S_i>/<1> times `root`.
    mean : ndarray, shape (B, n)
        <S_i>/<1> before the change of coordinates.
    coordinates, transform : ndarray, shape (B, n, n)
        R with M = R^T R, and the matrix that makes the coordinates; inverse to each other unless functions
        are dependent.
    """

    nodes: FilmNodes
    root: Array
    X: Array
    S: Array
    mean: Array
    coordinates: Array
    transform: Array

    @property
    def log_slope(self) -> Array:
        """Derivative of log(H^-3) by chi at the nodes, shape (B, N, 1)."""
        return (-3.0 * self.nodes.cosine / self.nodes.film)[..., None]

    def at(self, gamma: Array, basis: Basis) -> tuple[Array, Array]:
        """Return X_i and S_i - <S_i>/<1> at angles gamma (B,), each of shape (B, n)."""
        X, S = _functions(np.sin(0.5 * gamma), np.cos(0.5 * gamma), gamma, basis)
        return (
            np.einsum("bi,bij->bj", X, self.transform),
            np.einsum("bi,bij->bj", S - self.mean, self.transform),
        )


def whitened_functions(chi: Array, start: Array, end: Array, basis: Basis) -> WhitenedFunctions:
    """Return the coupling functions of a basis on the arcs [start, end], each of shape (B,)."""
    nodes = film_nodes(chi, start, end, count=64 + 4 * basis.functions)
    root = np.sqrt(nodes.weight)[..., None]
    X, S = _functions(nodes.half_sine, nodes.half_cosine, nodes.gamma, basis)
    mean = np.sum(S * root**2, axis=1) / np.sum(root**2, axis=1)
    Q, coordinates, transform = _orthonormalized(X * root)
    centered = ((S - mean[:, None, :]) * root) @ transform
    return WhitenedFunctions(nodes, root, Q, centered, mean, coordinates, transform)


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


def coupling_integrals(chi: Array, arc: FilmArc, basis: Basis) -> CouplingIntegrals:
    """Return the integrals of the functions of a basis by quadrature.

    Parameters
    ----------
    chi : ndarray, shape (B,)
        Eccentricity ratio.
    arc : FilmArc
        The ends of the film and their derivatives.
    basis : Basis
        n functions sin gamma, cos gamma, sin 2 gamma, ...; the constant adds X = 1 (S = gamma).
    """
    here = whitened_functions(chi, arc.start, arc.end, basis)
    X, S = here.X.swapaxes(-1, -2), here.S.swapaxes(-1, -2)
    K, M_chi, K_chi = S @ here.S, X @ (here.log_slope * here.X), S @ (here.log_slope * here.S)
    M_turn, K_turn = np.zeros((2, *K.shape))
    for end in arc_ends(chi, arc):
        X_end, S_end = here.at(end.gamma, basis)
        by_X, by_S = _outer(X_end, end.weight), _outer(S_end, end.weight)
        M_chi, K_chi = M_chi + end.by_chi * by_X, K_chi + end.by_chi * by_S
        M_turn, K_turn = M_turn + end.by_turn * by_X, K_turn + end.by_turn * by_S
    return CouplingIntegrals(K, M_chi, K_chi, M_turn, K_turn, here.coordinates[:, :, :2])


def _functions(half_sine: Array, half_cosine: Array, gamma: Array, basis: Basis) -> tuple[Array, Array]:
    """Return X and S, shape (..., n), spanning sin gamma, cos gamma, sin 2 gamma, ... in this order.

    With w = 1 + cos gamma the pairs are (sin w^(j-1), w^j - (2j-1)/j w^(j-1)) with antiderivatives
    (-w^j/j, sin w^(j-1)/j): the same spans as the harmonics, but every S vanishes at the minimum film, so
    the variances K lose no digits as chi -> 1.
    """
    w = 2.0 * half_cosine**2
    sine = 2.0 * half_sine * half_cosine
    X, S = [], []
    for j in range(1, (basis.functions + 1) // 2 + 1):
        lower = w ** (j - 1)
        X += [sine * lower, w**j - (2.0 * j - 1.0) / j * lower]
        S += [-(w**j) / j, sine * lower / j]
    X, S = X[: basis.functions], S[: basis.functions]
    if basis.constant:
        X.append(np.ones_like(gamma))
        S.append(gamma - np.pi)
    return np.stack(X, -1), np.stack(S, -1)


def _outer(vectors: Array, weight: Array) -> Array:
    return weight[:, None, None] * vectors[:, :, None] * vectors[:, None, :]
