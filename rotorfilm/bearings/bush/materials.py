"""What a polymer bush is made of: geometry, liner, shaft, and friction that depends on temperature."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_each, require_number, require_positive
from ...inputs.si_arguments import quantities
from ...model import Array


@quantities
@dataclass(frozen=True, kw_only=True)
class BushGeometry:
    """Radii and length of a bush.

    Parameters
    ----------
    radius : float [m]
        Inner radius R of the unworn liner.
    outer_radius : float [m]
        Outer radius R_2 of the liner, where it is bonded to the housing.
    shaft_radius : float [m]
        Radius R_1 of the shaft; R - R_1 is the radial clearance Delta.
    length : float [m]
        Axial length 2 l.

    Raises
    ------
    InputError
        If a length is not finite and positive, or the radii do not rise from shaft to liner to housing.
    """

    radius: float
    outer_radius: float
    shaft_radius: float
    length: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "radius", "outer_radius", "shaft_radius", "length")
        if self.shaft_radius >= self.radius:
            raise InputError(
                f"shaft_radius must be below the radius {self.radius!r}, got {self.shaft_radius!r}"
            )
        if self.outer_radius <= self.radius:
            raise InputError(
                f"outer_radius must exceed the radius {self.radius!r}, got {self.outer_radius!r}"
            )


@quantities
@dataclass(frozen=True, kw_only=True)
class LinerMaterial:
    """The polymer of a bush.

    Parameters
    ----------
    shear_modulus : float [Pa]
        G.
    poisson_ratio : float [1]
        nu, at least 0 and below .5: an incompressible thin liner does not yield at all.
    expansion : float [1/K]
        Coefficient of linear thermal expansion alpha_T.
    conductivity : float [W/(m K)]
        lambda_2.
    melting_point : float [K]
        T_*, above the ambient temperature.

    Raises
    ------
    InputError
        If a value is not finite and positive, or Poisson's ratio is out of range.
    """

    shear_modulus: float
    poisson_ratio: float
    expansion: float
    conductivity: float
    melting_point: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "shear_modulus", "expansion", "conductivity", "melting_point")
        if not 0.0 <= require_number("poisson_ratio", self.poisson_ratio) < 0.5:
            raise InputError(f"poisson_ratio must be at least 0 and below 0.5, got {self.poisson_ratio!r}")


@quantities
@dataclass(frozen=True, kw_only=True)
class ShaftMaterial:
    """A shaft that conducts heat out of the bush and gives it to the air.

    Parameters
    ----------
    conductivity : float [W/(m K)]
        lambda_1.
    air_transfer : float [W/(m2 K)]
        Heat transfer kappa_1 from the shaft outside the bush to the air.

    Raises
    ------
    InputError
        If a value is not finite and positive.
    """

    conductivity: float
    air_transfer: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "conductivity", "air_transfer")


@quantities
@dataclass(frozen=True, kw_only=True)
class Friction:
    """Coefficient of dry friction f(T) = f0 + f1 T + f2 T^2, T [K] above the ambient temperature.

    Parameters
    ----------
    f0 : float [1]
        At the ambient temperature.
    f1 : float [1/K]
        Its part linear in the temperature.
    f2 : float [1/K2]
        Its part quadratic in the temperature.

    Raises
    ------
    InputError
        If a coefficient is not a finite number.
    """

    f0: float
    f1: float = 0.0
    f2: float = 0.0

    def __post_init__(self) -> None:
        require_each(self, require_number, "f0", "f1", "f2")

    def at(self, temperature: ArrayLike) -> Array:
        """Return f at a temperature [K]."""
        T = np.asarray(temperature, dtype=float)
        return self.f0 + T * (self.f1 + T * self.f2)

    def slope(self, temperature: ArrayLike) -> Array:
        """Return df/dT [1/K] at a temperature [K]."""
        return self.f1 + 2.0 * self.f2 * np.asarray(temperature, dtype=float)

    def least(self, hottest: float) -> float:
        """Return the smallest f between the ambient temperature and `hottest` [K]."""
        inner = -0.5 * self.f1 / self.f2 if self.f2 > 0.0 else 0.0
        return float(self.at([0.0, min(max(inner, 0.0), hottest), hottest]).min())
