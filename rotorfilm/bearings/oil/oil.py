"""An oil: viscosity, density, heat capacity and conductivity over its temperature."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...errors import (
    InputError,
    brief,
    require_each,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
    warn_user,
)
from ...inputs.kinds import arguments
from ...inputs.si_arguments import quantities, quantity
from ...model import Array
from ...units import CELSIUS
from .cooling import COLDEST_OIL, require_absolute
from .viscosity import Exponential, ViscosityLaw, Walther, relative_density

GRADES = {22: 4.3, 32: 5.36, 46: 6.76, 68: 8.73, 100: 11.4, 150: 15.0, 220: 19.4, 320: 24.9}
"""Kinematic viscosity at 100 degrees Celsius [mm2/s] of paraffinic oils of viscosity index 95 to 100, by
their ISO 3448 grade, which is that at 40 degrees Celsius. Good to 5 %; the grade itself says nothing of
it."""

DENSITY = 870.0
"""Density of a mineral oil at 15 degrees Celsius [kg/m3]."""

HOTTEST_OIL = 1000.0
"""Temperature [K] above which there is no oil: it cracks from some 650 K on."""

_GRADE = re.compile(r"\s*(?:ISO\s*)?(?:VG\s*)?(\d{1,4})\s*", re.IGNORECASE)

_WATER = 999.0
"""Density of water at 15 degrees Celsius [kg/m3]."""


@quantities
@dataclass(frozen=True, kw_only=True)
class Oil:
    """A lubricant whose properties depend on its temperature.

    `Oil.iso_vg(46)`, `Oil.two_points(...)`, `Oil.thinning_at(...)` and `Oil.constant(...)` make one.

    Parameters
    ----------
    law : ViscosityLaw
        Dynamic viscosity over temperature.
    reference_density : float [kg/m3]
        Density at 15 degrees Celsius; it falls by .064 % of that per kelvin.
    fixed_heat_capacity : float [J/(kg K)], optional
        Heat capacity, the same at all temperatures; by default that of a mineral oil of this density,
        (1683 + 3.39 T)/sqrt(reference_density/999), T in degrees Celsius.
    conductivity : float [W/(m K)]
        Thermal conductivity, the same at all temperatures.
    assumed : tuple of str
        What of this oil was not given but assumed, for remarks.

    Raises
    ------
    InputError
        If a property is not finite and positive, or the law has no viscosity.

    Examples
    --------
    >>> oil = Oil.iso_vg(46)
    >>> round(1e3 * float(oil.viscosity(313.15)), 2)
    39.38
    """

    law: ViscosityLaw
    reference_density: float = DENSITY
    fixed_heat_capacity: float | None = None
    conductivity: float = 0.13
    assumed: tuple[str, ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        require_kind("law", self.law, ViscosityLaw, "a viscosity law with viscosity and thinning")
        require_each(self, require_positive, "reference_density", "conductivity")
        if self.fixed_heat_capacity is not None:
            require_positive("fixed_heat_capacity", self.fixed_heat_capacity)

    @classmethod
    def iso_vg(cls, grade: int | str, **further: float) -> Oil:
        """Return a mineral oil of an ISO viscosity grade, its viscosity at 100 degrees Celsius assumed.

        Parameters
        ----------
        grade : int or str
            Kinematic viscosity at 40 degrees Celsius [mm2/s], one of `GRADES`, or its name as "ISO VG 46".
        **further
            Further fields of the oil, such as `conductivity`.

        Raises
        ------
        InputError
            If there is no such grade in the table.
        """
        number = grade_number(grade)
        if number not in GRADES:
            known = ", ".join(str(name) for name in GRADES)
            raise InputError(
                f"grade must be one of {known}, got {brief(grade)}: give two points of viscosity"
            )
        oil = cls.two_points(
            (40.0 + CELSIUS, 1e-6 * number), (100.0 + CELSIUS, 1e-6 * GRADES[number]), **further
        )
        second = f"kinematic viscosity of ISO VG {number} at 100 degC: {GRADES[number]:g} mm2/s, +-5 %"
        return replace(oil, assumed=(second,))

    @classmethod
    def two_points(
        cls,
        first: tuple[float, float],
        second: tuple[float, float],
        *,
        reference_density: float = DENSITY,
        **further: float,
    ) -> Oil:
        """Return the oil of Walther's law (ASTM D341) through two points.

        Parameters
        ----------
        first, second : (float, float) [K], [m^2/s]
            Temperature and kinematic viscosity, also with their units, as ("40 degC", "46 cSt").
        reference_density : float [kg/m3]
        **further
            Further fields of the oil.

        Raises
        ------
        InputError
            If a point is none, or the viscosity does not fall from the colder to the warmer one.
        """
        reference_density = quantity("reference_density", reference_density, "kg/m3")
        law = Walther.through(_point("first", first), _point("second", second), reference_density)
        return cls(law=law, reference_density=reference_density, **further)  # type: ignore[arg-type]

    @classmethod
    @arguments
    def thinning_at(cls, viscosity: float, temperature: float, thinning: float, **further: float) -> Oil:
        """Return an oil of one measured viscosity that thins at the same rate everywhere.

        Parameters
        ----------
        viscosity : float [Pa s]
            Dynamic viscosity at the temperature.
        temperature : float [K]
        thinning : float [1/K]
            -d ln(viscosity)/d temperature.
        **further
            Further fields of the oil.

        Raises
        ------
        InputError
            If a number is not finite and positive, or the thinning is negative.
        """
        require_positive("viscosity", viscosity)
        require_non_negative("thinning", thinning)
        law = Exponential(value=viscosity, temperature=temperature, decay=thinning)
        return cls(law=law, **further)  # type: ignore[arg-type]

    @classmethod
    def constant(cls, viscosity: float, **further: float) -> Oil:
        """Return an oil of one dynamic viscosity at all temperatures.

        Parameters
        ----------
        viscosity : float [Pa s]
        **further
            Further fields of the oil.
        """
        return cls.thinning_at(viscosity, 40.0 + CELSIUS, 0.0, **further)

    def viscosity(self, temperature: ArrayLike) -> Array:
        """Return the dynamic viscosity [Pa s] at temperatures [K], of their shape.

        A `ValidityWarning` tells of temperatures beyond the range of the law.

        Raises
        ------
        InputError
            If a temperature is not finite, or not from 150 to 1000 K, between which there is oil.
        """
        T = self._liquid(temperature)
        warn_beyond_law(self, T)
        return self.law.viscosity(T)

    def thinning(self, temperature: ArrayLike) -> Array:
        """Return -d ln(viscosity)/d temperature [1/K] at temperatures [K], as `viscosity`."""
        T = self._liquid(temperature)
        warn_beyond_law(self, T)
        return self.law.thinning(T)

    def _liquid(self, temperature: ArrayLike) -> Array:
        T = _kelvin(temperature)
        for value in T[(T < COLDEST_OIL) | (T > HOTTEST_OIL)][:1].tolist():
            raise InputError(
                f"temperature must be from {COLDEST_OIL:g} to {HOTTEST_OIL:g} K, between which there is oil, "
                f"got {value:.6g} K"
            )
        return T

    def density(self, temperature: ArrayLike) -> Array:
        """Return the density [kg/m3] at temperatures [K], of their shape."""
        return self.reference_density * relative_density(self._liquid(temperature))

    def heat_capacity(self, temperature: ArrayLike) -> Array:
        """Return the heat capacity [J/(kg K)] at temperatures [K], of their shape."""
        T = self._liquid(temperature)
        if self.fixed_heat_capacity is not None:
            return np.full(T.shape, self.fixed_heat_capacity)
        return (1683.0 + 3.39 * (T - CELSIUS)) / np.sqrt(self.reference_density / _WATER)

    def volumetric_heat(self, temperature: ArrayLike) -> Array:
        """Return density times heat capacity [J/(m^3 K)] at temperatures [K], of their shape."""
        return self.density(temperature) * self.heat_capacity(temperature)


def grade_number(grade: Any) -> int | None:
    """Return the number of an ISO viscosity grade, as "ISO VG 46" or 46; None where it is none."""
    if isinstance(grade, float) and grade.is_integer():
        grade = int(grade)
    match = _GRADE.fullmatch(str(grade)) if isinstance(grade, str | int | np.integer) else None
    return None if match is None or isinstance(grade, bool) else int(match[1])


def _point(name: str, given: Any) -> tuple[float, float]:
    """Return a temperature [K] and a kinematic viscosity [m^2/s]; raise InputError where they are none."""
    if not isinstance(given, tuple | list) or len(given) != 2:
        raise InputError(
            f"{name} must be a temperature and the kinematic viscosity there, as ('40 degC', '46 cSt'), "
            f"got {brief(given)}"
        )
    temperature = quantity(f"{name}[0]", given[0], "K", absolute=True)
    viscosity = quantity(f"{name}[1]", given[1], "m2/s")
    require_absolute(f"{name}[0]", temperature)
    return temperature, require_number(f"{name}[1]", viscosity)


def warn_beyond_law(oil: Oil, temperature: ArrayLike) -> None:
    """Warn of temperatures [K] at which the viscosity law of an oil does not hold."""
    T, (coldest, hottest) = np.asarray(temperature, dtype=float), oil.law.temperature_range
    beyond = T[(coldest > T) | (hottest < T)]
    if beyond.size:
        worst = float(beyond[np.argmax(np.abs(beyond - 0.5 * (coldest + hottest)))])
        warn_user(
            f"the viscosity of the oil holds from {coldest - CELSIUS:.4g} to {hottest - CELSIUS:.4g} degC, "
            f"and is taken at {worst - CELSIUS:.4g} degC"
        )


def _kelvin(temperature: ArrayLike) -> Array:
    T = np.asarray(temperature, dtype=float)
    if not (np.isfinite(T).all() and (T > 0.0).all()):
        raise InputError(f"temperature must be finite and positive, in K, got {temperature!r}")
    return T
