"""How viscosity and density of a lubricant grow with pressure, in units of the Hertzian contact.

The flow of a contact is driven by the gradient of a potential Phi with dPhi/dp = 1/mu(p), so a viscosity law
answers with a potential in closed form. It is chosen to vanish at infinite pressure, where differences of
it would drown in roundoff otherwise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from scipy.special import gamma, gammaincc

from ....errors import InputError, require_positive
from ....inputs.si_arguments import quantities
from ....model import Array

HIGGINSON_LIMIT = 1.34
HIGGINSON_PRESSURE = 0.59e9
"""Density of mineral oil after Dowson and Higginson: (P + limit p)/(P + p), P in Pa."""


ROELANDS_PRESSURE = 1.96e8
"""Reference pressure of Roelands' law [Pa]."""

ROELANDS_SHIFT = 9.67
"""Shift in ln(mu_0) + shift of that law, mu_0 in Pa s."""


@runtime_checkable
class Piezoviscosity(Protocol):
    """A law mu(p) with mu(0) = 1 and the initial slope Q0."""

    def mobility(self, pressure: Array, coefficient: float) -> Array:
        """Return 1/mu for pressures >= 0 and Q0 = `coefficient`."""

    def potential(self, pressure: Array, coefficient: float) -> Array:
        """Return minus the integral of 1/mu from the pressure to infinity."""


@dataclass(frozen=True, kw_only=True)
class BarusViscosity:
    """The exponential law mu = exp(Q0 p)."""

    def mobility(self, pressure: Array, coefficient: float) -> Array:
        """Return exp(-Q0 p)."""
        return np.exp(-coefficient * pressure)

    def potential(self, pressure: Array, coefficient: float) -> Array:
        """Return -exp(-Q0 p)/Q0."""
        return -np.exp(-coefficient * pressure) / coefficient


@quantities
@dataclass(frozen=True, kw_only=True)
class RoelandsViscosity:
    """Roelands' law mu = exp(Q0/(s z) ((1 + s p)^z - 1)).

    In SI, ln(mu/mu_0) = (ln mu_0 + 9.67)((1 + p/p_r)^z - 1) with p_r = 196 MPa: s = p_H/p_r, and the factor
    in front is fixed by the initial slope Q0. `roelands_viscosity` does this conversion. Negative
    pressures, which no solution has but a search may try, continue it by exp(Q0 p).

    Parameters
    ----------
    exponent : float [1]
        z, in (0, 1].
    pressure_ratio : float [1]
        s, Hertzian pressure / reference pressure.
    """

    exponent: float
    pressure_ratio: float

    def __post_init__(self) -> None:
        require_positive("exponent", self.exponent)
        require_positive("pressure_ratio", self.pressure_ratio)
        if self.exponent > 1.0:
            raise InputError(f"exponent must be at most 1, got {self.exponent!r}")

    def mobility(self, pressure: Array, coefficient: float) -> Array:
        """Return 1/mu."""
        factor = coefficient / (self.pressure_ratio * self.exponent)
        positive = 1.0 + self.pressure_ratio * np.maximum(pressure, 0.0)
        return np.exp(factor * (1.0 - positive**self.exponent) - coefficient * np.minimum(pressure, 0.0))

    def potential(self, pressure: Array, coefficient: float) -> Array:
        """Return the integral by the upper incomplete gamma function of u = A (1 + s p)^z, A = Q0/(s z)."""
        z, s = self.exponent, self.pressure_ratio
        factor = coefficient / (s * z)
        u = factor * (1.0 + s * np.maximum(pressure, 0.0)) ** z
        scale = np.exp(factor) * factor ** (-1.0 / z) * gamma(1.0 / z) / (s * z)
        below = np.expm1(-coefficient * np.minimum(pressure, 0.0)) / coefficient
        return -scale * gammaincc(1.0 / z, u) - below


def roelands_viscosity(
    *, viscosity: float, pressure_coefficient: float, pressure: float
) -> RoelandsViscosity:
    """Return Roelands' law of an oil by its slope at ambient pressure, in units of a Hertzian pressure.

    Parameters
    ----------
    viscosity : float [Pa s]
        At ambient pressure.
    pressure_coefficient : float [1/Pa]
        d ln mu/dp at ambient pressure.
    pressure : float [Pa]
        Largest of the dry contact.

    Raises
    ------
    InputError
        If the law would have an exponent above 1.
    """
    level = math.log(viscosity) + ROELANDS_SHIFT
    exponent = pressure_coefficient * ROELANDS_PRESSURE / level if level > 0.0 else math.inf
    if exponent > 1.0:
        raise InputError(
            "pressure_coefficient must give Roelands' law an exponent of at most 1, "
            f"got {pressure_coefficient!r} with {exponent:.3g}"
        )
    return RoelandsViscosity(exponent=exponent, pressure_ratio=pressure / ROELANDS_PRESSURE)


@quantities
@dataclass(frozen=True, kw_only=True)
class DowsonHigginsonDensity:
    """Density (P + 1.34 p)/(P + p) relative to that at ambient pressure.

    Parameters
    ----------
    pressure_ratio : float [1]
        Hertzian pressure / P, P = 0.59 GPa for mineral oils.
    """

    pressure_ratio: float

    def __post_init__(self) -> None:
        require_positive("pressure_ratio", self.pressure_ratio)

    def density(self, pressure: Array) -> Array:
        """Return the relative density."""
        s = self.pressure_ratio * pressure
        return (1.0 + HIGGINSON_LIMIT * s) / (1.0 + s)

    def slope(self, pressure: Array) -> Array:
        """Return d density / dp."""
        s = self.pressure_ratio * pressure
        return (HIGGINSON_LIMIT - 1.0) * self.pressure_ratio / (1.0 + s) ** 2
