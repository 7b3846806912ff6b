"""Rational functions with common stable poles through a table over frequency: vector fitting."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import block_diag

from ..core.errors import ConvergenceError, InputError
from ..core.model import Array, Linearization
from ..core.port import Complex

MOST_POLES = 40
"""Poles that are tried at most where their number is left to a tolerance."""

_ROUNDS, _SETTLED, _PATIENCE = 40, 1e-14, 8
_REAL = 1e-3  # of a pole to start from, over its frequency
_LEAST_DECAY, _NOTHING = 1e-12, 1e-10


class RationalFit(NamedTuple):
    """Z(s) = sum over k of s^k polynomial_k + sum over j of residues_j / (s - poles_j).

    Attributes
    ----------
    poles : ndarray of complex, shape (p,) [1/s]
        All decay; both of each complex pair.
    residues : ndarray of complex, shape (p, n, n)
    polynomial : ndarray, shape (k, n, n)
    scale : ndarray, shape (n,)
        Entries of Z are counted over its outer product with itself.
    error : float [1]
        Largest error of an entry at the frequencies of the table, so counted.
    """

    poles: Complex
    residues: Complex
    polynomial: Array
    scale: Array
    error: float

    def realization(self) -> Linearization:
        """Return the fractions as states: A, B, C of real numbers, with as few states as residues have rank.

        D is the constant of the polynomial.
        """
        size = np.outer(self.scale, self.scale)
        n = self.polynomial.shape[1]
        A, B, C = [np.zeros((0, 0))], [np.zeros((0, n))], [np.zeros((n, 0))]
        for pole, residue in zip(self.poles, self.residues, strict=True):
            if pole.imag < 0.0:
                continue
            left, sizes, right = np.linalg.svd((residue if pole.imag else residue.real) / size)
            rank = int(np.sum(sizes > _NOTHING * abs(pole.real)))
            drive, seen = right[:rank] * self.scale, self.scale[:, None] * left[:, :rank] * sizes[:rank]
            turn = np.array([[pole.real, -pole.imag], [pole.imag, pole.real]])
            if pole.imag:
                drive, seen = np.vstack([drive.real, drive.imag]), 2.0 * np.hstack([seen.real, -seen.imag])
            A.append(np.kron(turn if pole.imag else turn[:1, :1], np.eye(rank)))
            B.append(drive.real)
            C.append(seen.real)
        return Linearization(block_diag(*A), np.vstack(B), np.hstack(C), self.polynomial[0])


def rational_fit(
    frequencies: Array,
    values: Complex,
    scale: Array,
    *,
    poles: int | None,
    tolerance: float,
    powers: int,
) -> RationalFit:
    """Return the fit with the fewest poles whose error is within a tolerance, or that with a given number.

    Every second frequency is fitted where there are enough of them; the error is that at all.

    Parameters
    ----------
    frequencies : ndarray, shape (m,) [rad/s]
    values : ndarray of complex, shape (m, n, n)
        Z(i frequency).
    scale : ndarray, shape (n,)
        Scale as in `RationalFit`.
    poles : int or None
    tolerance : float [1]
    powers : int
        Terms of the polynomial: 1 for a constant, 2 with damping, 3 with mass.

    Raises
    ------
    InputError
        If there are fewer frequencies than the poles need.
    ConvergenceError
        If more poles than `MOST_POLES`, or than half of what the frequencies allow, would be needed.
    """
    most = len(frequencies) - powers
    if (0 if poles is None else poles) > most:
        raise InputError(
            f"frequencies must be {(poles or 0) + powers} at least for {poles or 0} poles, got "
            f"{len(frequencies)}"
        )
    if poles is not None:
        return _fitted(frequencies, values, scale, poles, powers)
    least, tried = np.inf, min(MOST_POLES, max(most // 2, 1))
    for count in range(tried + 1):
        found = _fitted(frequencies, values, scale, count, powers)
        least = min(least, found.error)
        if found.error <= tolerance:
            return found
    raise ConvergenceError(
        f"tolerance must be within reach of {tried} poles for {len(frequencies)} frequencies, "
        f"got {tolerance!r}: the least error is {least:.3g}"
    )


def _fitted(frequencies: Array, values: Complex, scale: Array, count: int, powers: int) -> RationalFit:
    """Return the best of the fits on the way of the poles (Gustavsen and Semlyen 1999, Gustavsen 2006)."""
    unit, (m, n, _) = float(frequencies[-1]) or 1.0, values.shape
    s, size = 1j * frequencies / unit, np.outer(scale, scale)
    wanted = (values / size).reshape(m, n * n)
    half = np.unique([*range(0, m, 2), m - 1])
    rows = half if len(half) - powers >= count + 1 else np.arange(m)
    poles, waited, everywhere = _first_poles(s.imag, count), 0, np.inf
    best = np.inf, poles, np.zeros((count + powers, n * n))
    for _ in range(_ROUNDS if count else 1):
        terms = np.hstack([_fractions(s, poles), s[:, None] ** np.arange(powers)])
        found = _least_squares(_real(terms[rows]), _real(wanted[rows]))
        error = float(np.abs(terms[rows] @ found - wanted[rows]).max())
        waited = 0 if error < 0.9 * best[0] else waited + 1
        if error < best[0]:
            best, everywhere = (error, poles, found), float(np.abs(terms @ found - wanted).max())
        if error < _SETTLED or waited > _PATIENCE:
            break
        poles = _relocated(s[rows], wanted[rows], poles, powers)
    _, poles, found = best
    parts = found.reshape(-1, n, n) * size
    return RationalFit(
        poles=unit * poles,
        residues=unit * _residues(parts[:count], poles),
        polynomial=np.array([part / unit**k for k, part in enumerate(parts[count:])]),
        scale=scale,
        error=everywhere,
    )


def _first_poles(frequencies: Any, count: int) -> Complex:
    """Return weakly damped pairs over the band, and for an odd number a real pole in its middle."""
    pairs = np.linspace(frequencies[0], frequencies[-1], count // 2 + 2)[1:-1] if count > 1 else np.zeros(0)
    paired = np.ravel([[-_REAL * w + 1j * w, -_REAL * w - 1j * w] for w in pairs])
    middle = 0.5 * (frequencies[0] + frequencies[-1])
    return np.concatenate([paired, np.full(count % 2, -middle)]).astype(complex)


def _fractions(s: Any, poles: Complex) -> Complex:
    """Return the functions that real coefficients make Z of, shape (m, p)."""
    columns = []
    for pole in poles:
        one, other = 1.0 / (s - pole), 1.0 / (s - pole.conjugate())
        columns.append(one if pole.imag == 0.0 else one + other if pole.imag > 0.0 else 1j * (other - one))
    return np.array(columns).reshape(len(poles), len(s)).T


def _residues(coefficients: Array, poles: Complex) -> Complex:
    """Return the residues of the coefficients of `_fractions`."""
    found = coefficients.astype(complex)
    for k in np.flatnonzero(poles.imag > 0.0):
        found[k] = coefficients[k] + 1j * coefficients[k + 1]
        found[k + 1] = found[k].conj()
    return found


def _relocated(s: Any, wanted: Complex, poles: Complex, powers: int) -> Complex:
    """Return better poles: the zeros of sigma(s), with sigma Z and sigma fitted on the same poles.

    Of sigma = d + fractions the sum over the frequencies is fixed, which lets d find its size (relaxed
    vector fitting). Each entry of Z leaves an equation for sigma alone.
    """
    fractions, count = _fractions(s, poles), len(poles)
    own = _real(np.hstack([fractions, s[:, None] ** np.arange(powers)]))
    sigma = np.hstack([fractions, np.ones((len(s), 1))])
    left, right = [], []
    for entry in wanted.T:
        rest = np.asarray(np.linalg.qr(np.hstack([own, _real(-entry[:, None] * sigma)]), mode="r"))
        left.append(rest[own.shape[1] :, own.shape[1] :])
        right.append(np.zeros(len(left[-1])))
    weight = float(np.linalg.norm(wanted)) / len(s) or 1.0
    left.append(weight * sigma.sum(axis=0).real[None])
    right.append(np.array([weight * len(s)]))
    found = _least_squares(np.vstack(left), np.concatenate(right)[:, None])[:, 0]
    if found[-1] == 0.0:
        return poles
    states, drive = np.zeros((count, count)), np.ones(count)
    for k, pole in enumerate(poles):
        states[k, k] = pole.real
        if pole.imag > 0.0:
            states[k, k + 1], states[k + 1, k] = pole.imag, -pole.imag
            drive[k], drive[k + 1] = 2.0, 0.0
    return _stable(np.linalg.eigvals(states - np.outer(drive, found[:-1]) / found[-1]))


def _stable(poles: Complex) -> Complex:
    """Return poles with those that grow reflected, each complex one before its conjugate."""
    decay = np.maximum(np.abs(poles.real), _LEAST_DECAY * (1.0 + np.abs(poles)))
    upper = [complex(-d, p.imag) for d, p in zip(decay, poles, strict=True) if p.imag >= 0.0]
    pairs = [[p, p.conjugate()] if p.imag else [p] for p in upper]
    return np.array([pole for pair in pairs for pole in pair], dtype=complex)


def _least_squares(left: Array, right: Array) -> Array:
    """Return the least squares solution, with columns of equal size."""
    size = np.linalg.norm(left, axis=0)
    size[size == 0.0] = 1.0
    found, *_ = np.linalg.lstsq(left / size, right, rcond=None)
    return np.asarray(found / size[:, None])


def _real(rows: Any) -> Array:
    return np.concatenate([rows.real, rows.imag])
