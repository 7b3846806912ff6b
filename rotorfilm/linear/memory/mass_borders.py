"""The rigid masses at which a film that remembers lets a whirl neither grow nor decay."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from ...bearings.at_frequency import MemoryCoefficients

RATIOS = np.concatenate([np.geomspace(0.01, 0.1, 6, endpoint=False), np.linspace(0.1, 3.0, 59)])
"""Whirl ratios between which a border is looked for; oil crosses the cavity in half a turn or more."""


class Border(NamedTuple):
    """A mass [kg] and the frequency [rad/s] at which it whirls for ever."""

    mass: float
    frequency: float


def mass_borders(film: MemoryCoefficients) -> list[Border]:
    """Return all masses with det(K(i nu) - mass nu^2) = 0 for a frequency nu, the lightest first.

    With K = A + i B the imaginary part gives k = mass nu^2 = (Axx Byy + Ayy Bxx - Axy Byx - Ayx Bxy) /
    (Bxx + Byy), the real part a function of nu alone, (Axx - k)(Ayy - k) - Axy Ayx - det B.
    """
    grid = RATIOS * abs(film.speed)
    values = [_residue(film, float(nu)) for nu in grid]
    found = []
    for low, high, one, other in zip(grid, grid[1:], values, values[1:], strict=False):
        if (one > 0.0) != (other > 0.0):
            nu = float(brentq(lambda nu: _residue(film, nu), low, high, xtol=1e-13 * high))
            mixed, trace = _stiffness(film.dynamic_stiffness.stiffness(1j * nu))
            if mixed * trace > 0.0:
                found.append(Border(mixed / trace / nu**2, nu))
    return sorted(found)


def _stiffness(K: np.ndarray) -> tuple[float, float]:
    """Return numerator and denominator of k."""
    A, B = K.real, K.imag
    mixed = A[0, 0] * B[1, 1] + A[1, 1] * B[0, 0] - A[0, 1] * B[1, 0] - A[1, 0] * B[0, 1]
    return float(mixed), float(np.trace(B))


def _residue(film: MemoryCoefficients, nu: float) -> float:
    """Return the real part of the determinant where the imaginary part is 0, times trace(B)^2, scaled."""
    K = film.dynamic_stiffness.stiffness(1j * nu)
    K = K / np.abs(K).max()
    mixed, trace = _stiffness(K)
    off = K.real[0, 1] * K.real[1, 0] + float(np.linalg.det(K.imag))
    return float((trace * K.real[0, 0] - mixed) * (trace * K.real[1, 1] - mixed) - trace**2 * off)
