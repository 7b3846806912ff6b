"""Where a damper answers one unbalance with two orbits: dimensionless maps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ...bearings.damper import PorousDamper
from ...errors import InputError, require_finite, require_number
from ...inputs.kinds import arguments
from ...model import Array
from ...readable.result import Drawable

_NODES = 2001
_LARGEST = 0.999
_STRONGEST = 20.0


@dataclass(frozen=True, kw_only=True)
class BistableMap(Drawable):
    """Unbalance ratios at the folds over squeeze number Bs and spring ratio, both per speed of the rotor.

    Attributes
    ----------
    squeeze_number : ndarray, shape (n,) [1]
        Bs/Omega.
    spring_ratio : ndarray, shape (m,) [1]
        Omega_s/Omega.
    jump_up, jump_down : ndarray, shape (n, m) [1]
        U at which the orbit jumps to the larger, and back to the smaller one; NaN where it does not jump.
    """

    squeeze_number: Array
    spring_ratio: Array
    jump_up: Array
    jump_down: Array


@arguments
def bistable_map(damper: PorousDamper, squeeze_numbers: ArrayLike, spring_ratios: ArrayLike) -> BistableMap:
    """Return where the response to an unbalance folds.

    Parameters
    ----------
    damper : PorousDamper
        Its cage and extent count, its size does not; without feed.
    squeeze_numbers : array_like, shape (n,) [1]
        Bs/Omega, positive.
    spring_ratios : array_like, shape (m,) [1]
        Omega_s/Omega, not negative.

    Raises
    ------
    InputError
        If a value breaks its rule or the damper has feed.
    """
    strengths = np.atleast_1d(require_finite("squeeze_numbers", squeeze_numbers))
    springs = np.atleast_1d(require_finite("spring_ratios", spring_ratios))
    if np.any(strengths <= 0.0) or np.any(springs < 0.0):
        raise InputError(
            "squeeze_numbers must be positive and spring_ratios not negative, "
            f"got {squeeze_numbers!r} and {spring_ratios!r}"
        )
    response = _Response(damper)
    folds = np.array([[response.folds(b, s) for s in springs] for b in strengths])
    return BistableMap(
        squeeze_number=strengths, spring_ratio=springs, jump_up=folds[..., 0], jump_down=folds[..., 1]
    )


@arguments
def bistability_limit(damper: PorousDamper, spring_ratio: float) -> float:
    """Return the squeeze number Bs/Omega above which the response to an unbalance has no fold."""
    require_number("spring_ratio", spring_ratio)
    response = _Response(damper)

    def least_slope(strength: float) -> float:
        return response.least_slope(strength, spring_ratio)

    if least_slope(_STRONGEST) <= 0.0 or least_slope(1e-4) >= 0.0:
        raise InputError(
            f"damper must have a squeeze number at which folds appear below {_STRONGEST}, got none"
        )
    return float(brentq(least_slope, 1e-4, _STRONGEST, xtol=1e-10))


class _Response:
    """U(eps)^2 = ((s^2 - 1) eps - Bs g_r)^2 + (Bs g_t)^2 of one damper, g its film on circular orbits."""

    def __init__(self, damper: PorousDamper) -> None:
        if damper.feed is not None or (damper.cage is not None and damper.cage.supply_pressure):
            raise InputError(f"damper must have no feed for a map over the squeeze number, got {damper!r}")
        self.eps = np.linspace(1e-4, min(_LARGEST, damper.largest_eccentricity_ratio), _NODES)
        none = np.zeros_like(self.eps)
        e, w = np.stack([self.eps, none]), np.stack([none, self.eps])
        self.film = damper.bound_film.force(e, w)
        slopes = damper.bound_film.jacobian(e, w)
        self.film_slope = slopes[:, 0] + slopes[:, 3]

    def parts(self, strength: float, spring: float) -> tuple[Array, Array]:
        """Return U^2 and d(U^2)/d eps at the nodes."""
        along = (spring**2 - 1.0) * self.eps - strength * self.film[0]
        along_slope = spring**2 - 1.0 - strength * self.film_slope[0]
        across, across_slope = strength * self.film[1], strength * self.film_slope[1]
        return along**2 + across**2, 2.0 * (along * along_slope + across * across_slope)

    def least_slope(self, strength: float, spring: float) -> float:
        """Return the least d(U^2)/d(eps^2) over the orbits, by a parabola through the least nodes."""
        slope = self.parts(strength, spring)[1] / (2.0 * self.eps)
        k = int(np.argmin(slope))
        if k in (0, slope.size - 1):
            return float(slope[k])
        a, b, c = slope[k - 1 : k + 2]
        return float(b - 0.125 * (a - c) ** 2 / (a - 2.0 * b + c))

    def folds(self, strength: float, spring: float) -> tuple[float, float]:
        """Return U where it stops rising and where it rises again, NaN where it never stops."""
        square, slope = self.parts(strength, spring)
        (turns,) = np.nonzero(np.diff(np.sign(slope)))
        if turns.size < 2:
            return np.nan, np.nan
        return self._turn(turns[0], square, slope), self._turn(turns[1], square, slope)

    def _turn(self, k: int, square: Array, slope: Array) -> float:
        """Return U at the zero of the slope between nodes k and k + 1, by the cubic of both ends."""
        step = self.eps[k + 1] - self.eps[k]
        part = slope[k] / (slope[k] - slope[k + 1])
        rise = part * slope[k] + 0.5 * part**2 * (slope[k + 1] - slope[k])
        return float(np.sqrt(square[k] + step * rise))
