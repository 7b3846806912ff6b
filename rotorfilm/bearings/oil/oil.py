"""An oil: viscosity, density, heat capacity and conductivity over its temperature."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    InputError,
    brief,
    require_each,
    require_finite,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
    warn_user,
)
from ...core.inputs import arguments, quantities, quantity
from ...core.model import Array
from ...core.units import CELSIUS
from ...native.loss_kernels import OilTable
from ..films.turbulence import TAYLOR, TURBULENT, is_turbulent, onset, stiffening
from ..reaction import FilmUnits

# How the viscosity of an oil falls with its temperature: the laws that an `Oil` may have.


EXPANSION = 0.00064
"""Fall of an oil's density per kelvin, of its density at 15 degrees Celsius [1/K]."""

_OFFSET = 0.7
"""What ASTM D341 adds to a kinematic viscosity in mm2/s."""

WALTHER_END = 1e-6 * (1.0 - _OFFSET)
"""Kinematic viscosity [m2/s] at which the law's logarithm of a logarithm ends."""

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
        """Return the dynamic viscosity [Pa s] at temperatures [K], shape as given."""

    def thinning(self, temperature: ArrayLike) -> Array:
        """Return -d ln(viscosity)/d temperature [1/K] at temperatures [K], shape as given."""


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
        Density at 15 degrees Celsius.
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
        if thin <= WALTHER_END:
            raise InputError(
                f"kinematic viscosity must be above {WALTHER_END:g} m2/s, as of oil, got {thin:g}"
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
        """Return the kinematic viscosity [m^2/s] at temperatures [K], shape as given."""
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


# An oil: viscosity, density, heat capacity and conductivity over its temperature.


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
        Density at 15 degrees Celsius; it falls by 0.064 % of that per kelvin.
    fixed_heat_capacity : float [J/(kg K)], optional
        Heat capacity, the same at all temperatures; by default that of a mineral oil of this density,
        (1683 + 3.39 T)/sqrt(reference_density/999), T in degrees Celsius.
    conductivity : float [W/(m K)]
        Thermal conductivity, the same at all temperatures.
    assumed : tuple of str
        Names of the properties that were assumed, for notes in answers.

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
        """Return the dynamic viscosity [Pa s] at temperatures [K], shape as given.

        A `ValidityWarning` is given for temperatures beyond the range of the law.

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
        """Return the density [kg/m3] at temperatures [K], shape as given."""
        return self.reference_density * relative_density(self._liquid(temperature))

    def heat_capacity(self, temperature: ArrayLike) -> Array:
        """Return the heat capacity [J/(kg K)] at temperatures [K], shape as given."""
        T = self._liquid(temperature)
        if self.fixed_heat_capacity is not None:
            return np.full(T.shape, self.fixed_heat_capacity)
        return (1683.0 + 3.39 * (T - CELSIUS)) / np.sqrt(self.reference_density / _WATER)

    def volumetric_heat(self, temperature: ArrayLike) -> Array:
        """Return density times heat capacity [J/(m^3 K)] at temperatures [K], shape as given."""
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
            f"the viscosity of the oil is valid from {coldest - CELSIUS:.4g} to {hottest - CELSIUS:.4g} "
            f"degC, and is used at {worst - CELSIUS:.4g} degC"
        )


def _kelvin(temperature: ArrayLike) -> Array:
    T = require_finite("temperature", temperature)
    if not (T > 0.0).all():
        raise InputError(f"temperature must be finite and positive, in K, got {temperature!r}")
    return T


# What takes the heat of a journal's film away: fresh oil and the housing.


STEEL = 3.6e6
"""Heat capacity of steel per volume [J/(m^3 K)]."""

RING = 1.3
"""Outer radius of the bush, and of the part of its housing that warms with it, over that of the bearing, as
`Cooling` assumes them."""


COLDEST_OIL = 150.0
"""Temperature [K] below which there is no oil; degrees Celsius probably were meant."""


def require_absolute(name: str, temperature: float) -> None:
    """Raise InputError unless a temperature [K] is one that an oil may have."""
    if require_number(name, temperature) < COLDEST_OIL:
        raise InputError(
            f"{name} must be at least {COLDEST_OIL:g} K, got {temperature:g} K: a number is in K, and "
            f"'{temperature:g} degC' is in degC"
        )


@quantities
@dataclass(frozen=True, kw_only=True)
class Cooling:
    """How heat leaves a film: with the side flow, which fresh oil replaces, and through the housing.

    Parameters
    ----------
    supply_temperature : float [K]
        Supply temperature of the fresh oil.
    ambient_temperature : float or None [K]
        Around the housing; None for that of the fresh oil.
    housing_conductance : float [W/K]
        Heat flow through bush and housing per kelvin between film and ambient; 0 where all heat leaves with
        the oil.
    carry_over : float [1]
        Share of the oil arriving at an opening that enters the next film, 0 to 1; it is not used without
        openings.
    bush_heat_capacity : float or None [J/K]
        Heat capacity of the bush and of the parts of housing and shaft that warm with it. None takes a steel
        ring from the bore to `RING` times the radius.
    full_gap : bool
        Whether oil fills the whole gap also where the film is ruptured. By default it flows in streamers
        there, which need less power.

    Raises
    ------
    InputError
        If a temperature or the heat capacity is not positive, the conductance is negative, or the carry-over
        is not from 0 to 1.
    """

    supply_temperature: float
    ambient_temperature: float | None = None
    housing_conductance: float = 0.0
    carry_over: float = 0.8
    bush_heat_capacity: float | None = None
    full_gap: bool = False

    def __post_init__(self) -> None:
        require_absolute("supply_temperature", self.supply_temperature)
        if self.ambient_temperature is not None:
            require_absolute("ambient_temperature", self.ambient_temperature)
        if self.bush_heat_capacity is not None:
            require_positive("bush_heat_capacity", self.bush_heat_capacity)
        require_non_negative("housing_conductance", self.housing_conductance)
        if not 0.0 <= require_number("carry_over", self.carry_over) <= 1.0:
            raise InputError(f"carry_over must be from 0 to 1, got {self.carry_over!r}")

    @property
    def ambient(self) -> float:
        """Temperature around the housing [K]."""
        given = self.ambient_temperature
        return self.supply_temperature if given is None else given

    @property
    def coldest(self) -> float:
        """Lowest possible temperature of a film with this cooling [K]."""
        return (
            min(self.supply_temperature, self.ambient)
            if self.housing_conductance
            else self.supply_temperature
        )

    def capacity(self, radius: float, length: float) -> float:
        """Return the heat capacity [J/K] of bush and housing of a bearing with this radius and length [m]."""
        if self.bush_heat_capacity is not None:
            return self.bush_heat_capacity
        return STEEL * math.pi * (RING**2 - 1.0) * radius**2 * length


# ln viscosity of an oil as splines, for kernels of the C library.


RANGE = (CELSIUS - 20.0, CELSIUS + 200.0)
"""Temperatures [K] between which the tables hold."""

CELLS = 110
"""Cells of 2 K, with which the splines are within 1e-9 of Walther's law."""


@lru_cache(maxsize=64)
def viscosity_table(oil: Oil) -> OilTable:
    """Return ln viscosity of an oil over `RANGE`."""
    from ..films.map_fit import quintic_coefficients

    nodes = np.linspace(*RANGE, CELLS + 1)
    return OilTable(quintic_coefficients(np.log(oil.law.viscosity(nodes))), *RANGE)


# How much the load of a bearing compresses its oil, which films of one density and viscosity leave out.


BULK_MODULUS = 1.5e9
"""Of a mineral oil [Pa], pressure per relative change of volume."""

MOST = 0.5
"""Compression by the mean pressure from which a film without it is no answer, whatever the oil.

Bearings carry a hundredth of that. Scenes, which know their oil, tell of less.
"""


def compression(
    load: tuple[float, float] | Array, radius: float, length: float, bulk_modulus: float = BULK_MODULUS
) -> float:
    """Return the relative change of volume [1] of oil by the mean pressure |load|/(2 radius length).

    Parameters
    ----------
    load : array_like, shape (2,) [N]
    radius, length : float [m]
        Radius and length of the bearing.
    bulk_modulus : float [Pa]
    """
    return math.hypot(*load) / (2.0 * radius * length) / bulk_modulus


# Where the film of a bearing is no longer laminar, or its oil beyond the law of its viscosity.


class FilmNumbers(NamedTuple):
    """Reynolds number speed R c/nu, and that times sqrt(c/R), whose limit is `TAYLOR` [1]."""

    reynolds: float
    taylor: float

    @property
    def turbulence(self) -> float:
        """About how much stiffer than the laminar film this one is [1]; 0 where it is laminar.

        It is that of the fit to Ng and Pan (1965), `ng_pan`.
        """
        laminar = self.taylor <= TAYLOR and self.reynolds <= TURBULENT
        return 0.0 if laminar else stiffening(self.reynolds)


def film_reynolds(
    radius: float, clearance: float, viscosity: float, density: float, speed: float
) -> FilmNumbers:
    """Return the Reynolds and Taylor numbers of a film.

    Parameters
    ----------
    radius, clearance : float [m]
    viscosity : float [Pa s]
        Viscosity at the temperature of the film.
    density : float [kg/m3]
    speed : float [rad/s]
        Speed of the journal, of either sign.
    """
    reynolds = abs(speed) * radius * clearance * density / viscosity
    return FilmNumbers(reynolds, reynolds * math.sqrt(clearance / radius))


class LaminarFilm(FilmUnits):
    """A bearing that warns where its film of one density and viscosity ends; see `core.port`."""

    def warn_of_load(self: Any, load: Array) -> None:
        """Warn of a load [N] whose mean pressure is beyond films of one density and viscosity."""
        share = compression(load, self.radius, self.length)
        if share > MOST:
            warn_user(
                f"load {math.hypot(*load):.6g} N makes a mean pressure of {share * BULK_MODULUS:.3g} Pa over "
                f"length times diameter, {share:.0%} of the bulk modulus of a mineral oil: a film with "
                "constant density "
                "and viscosity is not valid there"
            )

    def warn_of_flow(
        self: Any, speed: float, temperature: float | None = None, hottest: float | None = None
    ) -> None:
        """Warn of a film that is not laminar at a speed [rad/s], or whose oil is beyond its viscosity law.

        Parameters
        ----------
        speed : float [rad/s]
        temperature : float, optional [K]
            Mean temperature of the oil; by default that of the bearing.
        hottest : float, optional [K]
            Highest temperature of the oil; by default it is the mean one.
        """
        oil, viscosity, density = self.oil, self.film_viscosity, DENSITY
        at = self.temperature if temperature is None else temperature
        if oil is not None and at is not None:
            warn_beyond_law(oil, at if hottest is None else hottest)
            within = float(np.clip(at, *oil.law.temperature_range))
            liquid = min(max(within, COLDEST_OIL), HOTTEST_OIL)
            viscosity, density = float(oil.law.viscosity(within)), float(oil.density(liquid))
        R, c = self.radius, getattr(self, "bore_clearance", self.clearance)
        found = film_reynolds(R, c, viscosity, density, speed)
        most = onset(R, c)
        if found.turbulence and not is_turbulent(self):
            begins = "Taylor vortices begin" if most < TURBULENT else "turbulence begins"
            warn_user(
                f"the film has Reynolds number {found.reynolds:.4g} and Taylor number {found.taylor:.3g} at "
                f"{speed:.6g} rad/s and {density:.4g} kg/m3, beyond the Reynolds number {most:.4g} at which "
                f"{begins}: a real film takes more power and gets warmer than this laminar one. "
                "The argument turbulence=rotorfilm.bearings.Turbulence(), or that key of a scene, models it",
                key=("laminar", R, c, speed),
            )
