"""Where the friction heat of a bush goes: into the shaft, into the liner, and how the two are balanced.

Small exchangeable rules with their derivatives; `bearings.bush.MeltingBush` takes one of each kind.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ...errors import warn_user
from ...model import Array
from .shaft_flux import approximate_flux, exact_flux

COOLING_LIMIT = 0.3
"""Largest kappa_1 R_1/lambda_1 that the source has its closed form in mind for."""


@runtime_checkable
class ShaftHeat(Protocol):
    """How the mean flux Q_1 into the shaft is computed."""

    def flux(self, cooling: float, stubbiness: float) -> float:
        """Return Q_1 in units of lambda_1 T_*/R_1; cooling = kappa_1 R_1/lambda_1, stubbiness = R_1/l."""


@dataclass(frozen=True)
class ExactShaft:
    """Q_1 from the mixed problem (2.7)-(2.8) itself, to 1e-7."""

    def flux(self, cooling: float, stubbiness: float) -> float:
        """Return Q_1 in units of lambda_1 T_*/R_1."""
        return exact_flux(cooling, stubbiness)


@dataclass(frozen=True)
class ApproximateShaft:
    """Q_1 as published, by the closed form (2.13): .6 to 2.9 % high for cooling .02 to .3."""

    def flux(self, cooling: float, stubbiness: float) -> float:
        """Return Q_1 in units of lambda_1 T_*/R_1; warn beyond the `COOLING_LIMIT` of the source."""
        if cooling > COOLING_LIMIT:
            warn_user(
                f"air_transfer shaft_radius / conductivity must not exceed {COOLING_LIMIT} for "
                f"ApproximateShaft, got {cooling:.6g}: the heat into the shaft is too high",
            )
        return approximate_flux(cooling, stubbiness)


@runtime_checkable
class HeatBalance(Protocol):
    """How much of Q_1 the heat made per unit of contact area has to supply."""

    def share(self, alpha: ArrayLike) -> Array:
        """Return the factor of Q_1 in the balance over the contact, half angle alpha [rad]."""

    def share_slope(self, alpha: ArrayLike) -> Array:
        """Return d(share)/d(alpha) [1/rad]."""


@dataclass(frozen=True)
class ContactBalance:
    """Heat per area of contact = Q_1 + Q_2 + melting, as published (1.2).

    Q_1 is a flux through the whole circumference of the shaft, but friction heats the arc 2 alpha only, so
    this balance lets the shaft take alpha/pi of the heat that its temperature problem says.
    """

    def share(self, alpha: ArrayLike) -> Array:
        """Return 1."""
        return np.ones_like(np.asarray(alpha, dtype=float))

    def share_slope(self, alpha: ArrayLike) -> Array:
        """Return 0."""
        return np.zeros_like(np.asarray(alpha, dtype=float))


@dataclass(frozen=True)
class GlobalBalance:
    """Heat made on the arc 2 alpha = Q_1 over the whole circumference + Q_2 and melting over the arc.

    Energy is then conserved over the whole shaft; critical speeds are several times higher than published.
    """

    def share(self, alpha: ArrayLike) -> Array:
        """Return pi/alpha."""
        return math.pi / np.asarray(alpha, dtype=float)

    def share_slope(self, alpha: ArrayLike) -> Array:
        """Return -pi/alpha^2."""
        return -math.pi / np.asarray(alpha, dtype=float) ** 2
