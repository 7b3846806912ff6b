"""Functions of the radius for full films of finite length, between ends of any leakage, in a short table."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ....errors import warn_user
from ....model import Array
from .film_inertia import InertiaFunctions
from .ritz_squeeze import squeeze_motions

LARGEST_TABULATED = 0.95
"""Eccentricity ratio to which the pressures are resolved; beyond, all goes on as powers of 1 - eps^2."""

NODES = 20
"""Of the table, over sqrt(1 - eps^2)."""

POWERS = np.array([1.0, 1.0, 1.0, 1.0, 3.0, 3.0, 5.0])
"""Of 1/sqrt(1 - eps^2) in the `InertiaFunctions` and the two of the damping: those of the short film."""


@dataclass(frozen=True, eq=False)
class RadialTable:
    """Seven functions of the squared eccentricity ratio, as polynomials in s = sqrt(1 - E).

    Parameters
    ----------
    table : ndarray, shape (NODES, 7)
        Chebyshev coefficients of the functions times s to the `POWERS`.
    """

    table: Array

    def inertia(self, E: Array) -> tuple[InertiaFunctions, InertiaFunctions]:
        """Return the functions of mass and convection, and their slopes; see `film_inertia.Radial`."""
        values, slopes = self._at(E)
        return InertiaFunctions(*values[:5]), InertiaFunctions(*slopes[:5])

    def damping(self, E: Array) -> tuple[Array, Array]:
        """Return the damping C w = c w + d (e.w) e as (c, d), shape (2, ...), and its slopes by E."""
        values, slopes = self._at(E)
        return values[5:], slopes[5:]

    def _at(self, E: Array) -> tuple[Array, Array]:
        s = np.sqrt(1.0 - E)
        least = least_root()
        if np.any(s < least * (1.0 - 1e-9)):
            warn_user(
                f"eccentricity ratio must not exceed {LARGEST_TABULATED} for a film of finite length with "
                f"seals or inertia, got {math.sqrt(float(np.max(E))):.6g}: it goes on as a power"
            )
        x = np.clip((2.0 * s - 1.0 - least) / (1.0 - least), -1.0, 1.0)
        powers = POWERS.reshape(-1, *(1,) * E.ndim)
        scale = s**-powers
        chebyshev = np.polynomial.chebyshev
        value = chebyshev.chebval(x, self.table)
        slope = chebyshev.chebval(x, chebyshev.chebder(self.table)) * np.where(s < least, 0.0, 2.0)
        by_s = slope / (1.0 - least) - powers * value / s
        return value * scale, by_s * scale * (-0.5 / s)


@lru_cache(maxsize=32)
def radial_table(slenderness: float, end_leak: float) -> RadialTable:
    """Return the functions of a film of one length / diameter and one leakage of its ends [1], in a second.

    See `squeeze_motions`.
    """
    chebyshev, least = np.polynomial.chebyshev, least_root()
    x = chebyshev.chebpts1(NODES)
    s = 0.5 * ((1.0 - least) * x + 1.0 + least)
    rows = [_functions(float(eps), slenderness, end_leak) for eps in np.sqrt((1.0 - s) * (1.0 + s))]
    return RadialTable(chebyshev.chebfit(x, np.array(rows) * s[:, None] ** POWERS, NODES - 1))


def least_root() -> float:
    """Return the smallest sqrt(1 - eps^2) of a table."""
    return math.sqrt(1.0 - LARGEST_TABULATED**2)


def _functions(eps: float, slenderness: float, end_leak: float) -> tuple[float, ...]:
    """Return m, n, a, b, c of the inertia and c, d of the damping at one eccentricity ratio."""
    (c_r, c_t), (m_r, m_t), (radial, across, along) = squeeze_motions(eps, slenderness, end_leak)
    a, b = across / eps, along / eps
    return m_t, (m_r - m_t) / eps**2, a, b, (radial / eps - a - b) / eps**2, c_t, (c_r - c_t) / eps**2


@dataclass(frozen=True, eq=False)
class TabulatedSqueezeFilm:
    """Full film of finite length between ends of any leakage: F = -c w - d (e.w) e.

    Parameters
    ----------
    table : RadialTable
    """

    table: RadialTable

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        (c, d), _ = self.table.damping(np.asarray(np.sum(eccentricity**2, axis=0)))
        return -c * rate - d * np.sum(eccentricity * rate, axis=0) * eccentricity

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`."""
        e, w = eccentricity, rate
        (c, d), (c_E, d_E) = self.table.damping(np.asarray(np.sum(e**2, axis=0)))
        ew = np.sum(e * w, axis=0)
        unit = np.eye(2).reshape(2, 2, *(1,) * ew.ndim)
        by_rate = -c * unit - d * e[:, None] * e
        grown = c_E * w + d_E * ew * e
        by_position = -2.0 * grown[:, None] * e - d * (ew * unit + e[:, None] * w)
        return np.concatenate([by_position, by_rate], axis=1)
