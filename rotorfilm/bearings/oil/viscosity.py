"""How the viscosity of an oil falls with its temperature: the laws that an `Oil` may have."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_each, require_non_negative, require_positive
from ...model import Array
from ...units import CELSIUS

EXPANSION = 0.00064
"""Fall of an oil's density per kelvin, of its density at 15 degrees Celsius [1/K]."""

_OFFSET = 0.7
"""What ASTM D341 adds to a kinematic viscosity in mm2/s."""

LEAST_KINEMATIC, MOST_KINEMATIC = 2e-6, 20.0
"""Kinematic viscosities between which ASTM D341 has the offset as a constant [m^2/s]."""

EVEN = 50.0
"""Farthest from its point [K] that an even thinning holds: there it is a factor of 1.4 to 2.2 off Walther's
law."""


def relative_density(temperature: ArrayLike) -> Array:
    """Return density / density at 15 degrees Celsius of a mineral oil [1], over its temperature [K]."""
    return 1.0 - EXPANSION * (np.asarray(temperature, dtype=float) - CELSIUS - 15.0)


@runtime_checkable
class ViscosityLaw(Protocol):
    """A dynamic viscosity over temperature."""

    @property
    def temperature_range(self) -> tuple[float, float]:
        """Temperatures [K] between which the law holds."""

    def viscosity(self, temperature: ArrayLike) -> Array:
        """Return the dynamic viscosity [Pa s] at temperatures [K], of their shape."""

    def thinning(self, temperature: ArrayLike) -> Array:
        """Return -d ln(viscosity)/d temperature [1/K] at temperatures [K], of their shape."""


@dataclass(frozen=True, kw_only=True)
class Walther:
    """Walther's law as in ASTM D341: lg lg(nu + 0.7) = intercept - steepness lg T, nu in mm2/s, T in K.

    The dynamic viscosity is nu times the density of a mineral oil at the same temperature. The law is meant
    for kinematic viscosities from 2 to 2e7 mm2/s, which is its `temperature_range`; below, ASTM D341 has
    further terms.

    Parameters
    ----------
    intercept : float [1]
        lg lg(nu + 0.7) where lg T is 0.
    steepness : float [1]
        How steeply the viscosity falls, positive.
    density : float [kg/m3]
        At 15 degrees Celsius.
    """

    intercept: float
    steepness: float
    density: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "intercept", "steepness", "density")

    @classmethod
    def through(cls, first: tuple[float, float], second: tuple[float, float], density: float) -> Walther:
        """Return the law through two points (temperature [K], kinematic viscosity [m^2/s]).

        Raises
        ------
        InputError
            If the viscosity does not fall from the colder to the warmer point, or a number is not positive.
        """
        (cold, thick), (warm, thin) = sorted((first, second))
        for name, value in (("temperature", cold), ("kinematic viscosity", thin)):
            require_positive(name, value)
        if not (cold < warm and thick > thin):
            raise InputError(
                "kinematic viscosity must fall with temperature between two points, got "
                f"{thick:g} m2/s at {cold:g} K and {thin:g} m2/s at {warm:g} K"
            )
        high, low = (math.log10(math.log10(1e6 * nu + _OFFSET)) for nu in (thick, thin))
        steepness = (high - low) / math.log10(warm / cold)
        return cls(intercept=high + steepness * math.log10(cold), steepness=steepness, density=density)

    @property
    def temperature_range(self) -> tuple[float, float]:
        """Temperatures [K] between which the law holds."""
        lg = np.log10(np.log10(1e6 * np.array([MOST_KINEMATIC, LEAST_KINEMATIC]) + _OFFSET))
        coldest, hottest = 10.0 ** ((self.intercept - lg) / self.steepness)
        return float(coldest), float(hottest)

    def kinematic(self, temperature: ArrayLike) -> Array:
        """Return the kinematic viscosity [m^2/s] at temperatures [K], of their shape."""
        return 1e-6 * (10.0 ** self._lg(temperature) - _OFFSET)

    def viscosity(self, temperature: ArrayLike) -> Array:
        """Return the dynamic viscosity [Pa s]; see `ViscosityLaw`."""
        return self.kinematic(temperature) * self.density * relative_density(temperature)

    def thinning(self, temperature: ArrayLike) -> Array:
        """Return -d ln(viscosity)/d temperature [1/K]; see `ViscosityLaw`."""
        T = np.asarray(temperature, dtype=float)
        lg = self._lg(T)
        shifted = 10.0**lg
        falling = shifted / (shifted - _OFFSET) * math.log(10.0) * lg * self.steepness / T
        return np.asarray(falling + EXPANSION / relative_density(T))

    def _lg(self, temperature: ArrayLike) -> Array:
        """Return lg(nu + 0.7)."""
        T = np.asarray(temperature, dtype=float)
        return np.asarray(10.0 ** (self.intercept - self.steepness * np.log10(T)))


@dataclass(frozen=True, kw_only=True)
class Exponential:
    """viscosity exp(-decay (T - temperature)): one measured point and how fast the oil thins.

    Real oils thin ever more slowly: the law holds within 50 K of its temperature, and everywhere where the
    oil does not thin.

    Parameters
    ----------
    value : float [Pa s]
        Dynamic viscosity at the temperature.
    temperature : float [K]
    decay : float [1/K]
        -d ln(viscosity)/d temperature, the same at all temperatures; 0 for an oil that does not thin.
    """

    value: float
    temperature: float
    decay: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "value", "temperature")
        require_non_negative("decay", self.decay)

    @property
    def temperature_range(self) -> tuple[float, float]:
        """Temperatures [K] between which the law holds."""
        within = EVEN if self.decay else math.inf
        return self.temperature - within, self.temperature + within

    def viscosity(self, temperature: ArrayLike) -> Array:
        """Return the dynamic viscosity [Pa s]; see `ViscosityLaw`."""
        warmer = np.asarray(temperature, dtype=float) - self.temperature
        return np.asarray(self.value * np.exp(-self.decay * warmer))

    def thinning(self, temperature: ArrayLike) -> Array:
        """Return -d ln(viscosity)/d temperature [1/K]; see `ViscosityLaw`."""
        return np.full(np.shape(temperature), self.decay)


@dataclass(frozen=True, kw_only=True)
class Vogel:
    """factor exp(activation/(T - origin)): a fit that costs one exponential.

    Between 20 and 200 degrees Celsius a fit through 40, 70 and 100 is within 4 % of Walther's law.

    Parameters
    ----------
    factor : float [Pa s]
        Viscosity at endless temperature.
    activation : float [K]
        How steeply the viscosity falls.
    origin : float [K]
        Temperature at which the viscosity of the law has no bound, below that of the oil.
    temperature_range : (float, float) [K]
        Temperatures between which it holds, 20 to 200 degrees Celsius by default.

    Raises
    ------
    InputError
        If factor or activation is not positive, or the temperature_range does not rise from above the origin.
    """

    factor: float
    activation: float
    origin: float
    temperature_range: tuple[float, float] = (20.0 + CELSIUS, 200.0 + CELSIUS)

    def __post_init__(self) -> None:
        require_each(self, require_positive, "factor", "activation")
        if not self.origin < self.temperature_range[0] < self.temperature_range[1]:
            raise InputError(
                f"temperature_range must rise from above the origin {self.origin!r} K, "
                f"got {self.temperature_range!r}"
            )

    @classmethod
    def fitted(cls, law: ViscosityLaw, at: tuple[float, float, float] = (313.15, 343.15, 373.15)) -> Vogel:
        """Return the law that has another one's viscosities at three temperatures [K].

        Within 0.1 % of an ISO grade between them; it holds from 20 K below the first to 100 K above the last.

        Raises
        ------
        InputError
            If ln(viscosity) does not fall ever more slowly, as it must under this law.
        """
        T = np.sort(np.asarray(at, dtype=float))
        ln = np.log(law.viscosity(T))
        falls = -np.diff(ln)
        if not (falls[1] > 0.0 and falls[0] / falls[1] > (T[1] - T[0]) / (T[2] - T[1])):
            raise InputError(f"viscosity must fall ever more slowly for a Vogel fit, got {law!r}")
        q = falls[0] / falls[1] * (T[2] - T[1]) / (T[1] - T[0])
        origin = float((q * T[0] - T[2]) / (q - 1.0))
        activation = float(falls[0] / (1.0 / (T[0] - origin) - 1.0 / (T[1] - origin)))
        factor = float(np.exp(ln[0] - activation / (T[0] - origin)))
        temperature_range = float(T[0]) - 20.0, float(T[2]) + 100.0
        return cls(factor=factor, activation=activation, origin=origin, temperature_range=temperature_range)

    def viscosity(self, temperature: ArrayLike) -> Array:
        """Return the dynamic viscosity [Pa s]; see `ViscosityLaw`."""
        T = np.asarray(temperature, dtype=float)
        return np.asarray(self.factor * np.exp(self.activation / (T - self.origin)))

    def thinning(self, temperature: ArrayLike) -> Array:
        """Return -d ln(viscosity)/d temperature [1/K]; see `ViscosityLaw`."""
        T = np.asarray(temperature, dtype=float)
        return np.asarray(self.activation / (T - self.origin) ** 2)
