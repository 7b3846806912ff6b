"""Where the eigenvalues of a matrix that changes with a parameter may go: bounds on all of them, and proofs.

The matrix T(d) = diag(s) + d E + (d / h)^2 Q, |d| <= h, is that of small motion in the eigenvectors of the
middle speed. A column w of small numbers that F maps into its inside,

    F_k(w) = (|T_kj| + sum |T_kl| w_l) / (distance of T_kk and the eigenvalue),

bounds what the eigenvector that is e_j in the middle has of the others (Brouwer), and there is one such
vector only (Earle and Hamilton 1970: F stands for a holomorphic map). What is left after these vectors are
split off lies in the circles of Gershgorin.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model import Array

Places = NDArray[np.intp]

ROUNDS = 25
"""Steps of the fixed point."""

INFLATED = 1.02
"""By how much the box is larger than its fixed point, so that it is mapped into its inside."""

ROUNDOFF = 1e-11
"""Coupling / eigenvalue that is roundoff: equal eigenvalues of planes that do not feel each other."""

_MOST = 4


class Changing(NamedTuple):
    """T(d).

    Attributes
    ----------
    values : ndarray of complex, shape (n,)
        s.
    rates, bends : ndarray of complex, shape (n, n)
        E, and Q as the largest sizes that it may have.
    half : float
        h.
    """

    values: np.ndarray
    rates: np.ndarray
    bends: Array
    half: float

    @property
    def coupling(self) -> Array:
        """Largest sizes of what is beside the diagonal, shape (n, n)."""
        size = self.half * np.abs(self.rates) + self.bends
        np.fill_diagonal(size, 0.0)
        return np.asarray(size)

    @property
    def wander(self) -> Array:
        """Largest sizes of what bends the diagonal, shape (n,)."""
        return np.diag(self.bends).copy()


class Branches(NamedTuple):
    """Eigenvalues whose way is known.

    Attributes
    ----------
    places : ndarray of int, shape (m,)
        Which of the eigenvalues.
    drifts : ndarray, shape (m,)
        How far each may be from s + d E at most, at any d.
    slopes : ndarray, shape (m,)
        How far ds/dd may be from E.
    """

    places: Places
    drifts: Array
    slopes: Array


def branches_on_line(T: Changing, heights: Array, reach: float = np.inf) -> Branches | None:
    """Return the ways of all eigenvalues that may have the imaginary part height + d; None if not proven.

    Parameters
    ----------
    T : Changing
    heights : ndarray, shape (2,)
        Of the line at d = -h and h.
    reach : float
        Real part to which the line goes to both sides.
    """
    coupling = T.coupling
    clear = np.maximum(_clearance(T, heights), _beside(T, reach))
    near = clear <= coupling.sum(axis=1)
    for _ in range(_MOST):
        places = np.flatnonzero(near)
        right = _box(T, coupling, places)
        left = _box(T, coupling.T, places)
        if right is None or left is None:
            return None
        touched = ~near & (clear <= _left_over(coupling, places, right))
        if not touched.any():
            return _branches(T, coupling, places, right, left)
        near |= touched
    return None


def _clearance(T: Changing, heights: Array) -> Array:
    """Return how far each diagonal entry stays from the line, shape (n,)."""
    imag = T.values.imag[:, None] + np.array([-T.half, T.half]) * np.diag(T.rates).imag[:, None]
    away = imag - heights
    same = away[:, 0] * away[:, 1] > 0.0
    return np.asarray(np.where(same, np.abs(away).min(axis=1), 0.0) - T.wander)


def _beside(T: Changing, reach: float) -> Array:
    """Return how far each diagonal entry stays beside the ends of the line, shape (n,)."""
    moved = T.half * np.abs(np.diag(T.rates).real)
    return np.asarray(np.abs(T.values.real) - moved - T.wander - reach)


def _gaps(T: Changing, places: Places) -> Array:
    """Return how near each diagonal entry comes to those at some places at least, shape (n, m)."""
    rates = np.diag(T.rates)
    apart = T.values[:, None] - T.values[places]
    turn = rates[:, None] - rates[places]
    size = np.abs(turn) ** 2
    nearest = -(apart * turn.conj()).real / np.where(size > 0.0, size, 1.0)
    least = np.abs(apart + np.clip(nearest, -T.half, T.half) * turn)
    return np.asarray(least - T.wander[:, None] - T.wander[places])


def _box(T: Changing, coupling: Array, places: Places) -> Array | None:
    """Return bounds on what the vectors at some places have of all others, shape (n, m); None for none."""
    columns = np.arange(len(places))
    gaps, start = _gaps(T, places), coupling[:, places]
    floor = ROUNDOFF * np.abs(T.values[places])
    gaps[places, columns] = np.inf

    def mapped(w: Array) -> Array | None:
        felt = start + coupling @ w
        free = np.where(felt > floor, gaps - (coupling[places] * w.T).sum(axis=1), np.inf)
        return None if np.any(free <= 0.0) else np.asarray(felt / free)

    w: Array = np.zeros(gaps.shape)
    for _ in range(ROUNDS):
        last, found = w, mapped(w)
        if found is None or found.max(initial=0.0) >= 1.0:
            return None
        w = found
        if np.all(w <= last * (1.0 + 1e-3)):
            break
    tried: Array = np.asarray(INFLATED * w)
    found = mapped(tried)
    return tried if found is not None and np.all((found < tried) | (tried == 0.0)) else None


def _left_over(coupling: Array, places: Places, right: Array) -> Array:
    """Return the radii of Gershgorin's circles of what is left without the vectors at some places."""
    own = right[places]
    rows = own.sum(axis=1).max(initial=0.0)
    if rows >= 1.0:
        return np.full(len(coupling), np.inf)
    rest = np.setdiff1d(np.arange(len(coupling)), places)
    share = np.linalg.inv(np.eye(len(places)) - own)
    radii = np.zeros(len(coupling))
    across = right[rest] @ share @ coupling[np.ix_(places, rest)].sum(axis=1)
    radii[rest] = coupling[np.ix_(rest, rest)].sum(axis=1) + across
    return radii


def _branches(T: Changing, coupling: Array, places: Places, right: Array, left: Array) -> Branches:
    """Return how far eigenvalues and their rates may be from those of the diagonal."""
    rates = np.abs(T.rates) + 2.0 * T.bends / T.half
    own = np.diag(rates)[places].copy()
    both = (left * right).sum(axis=0)
    beside = (rates[places] * right.T).sum(axis=1) + (rates[:, places] * left).sum(axis=0)
    beside += (left * (rates @ right)).sum(axis=0)
    bend = 2.0 * T.wander[places] / T.half
    with np.errstate(divide="ignore", invalid="ignore"):
        slopes = np.where(both < 1.0, (beside + bend + both * own) / (1.0 - both), np.inf)
    drifts = (coupling[places] * right.T).sum(axis=1) + T.wander[places]
    return Branches(places, drifts, slopes)
