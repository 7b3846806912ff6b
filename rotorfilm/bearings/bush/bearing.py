"""The polymer bush worn by melting: contact, heat and critical speed, in SI units.

A. A. Evtushenko and E. V. Kovalenko (1993), "Contact problem on the wear by melting of the liner of a plain
bearing" (in Russian); equation numbers are theirs. Errata and defects of the source: docs/bush.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    InputError,
    require_each,
    require_finite,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
)
from ...core.inputs import quantities
from ...core.model import Array
from ...core.readable import Readable
from ...native.spec import NativeParameter
from . import contact_arc as contact
from .melting import ContactBalance, ExactShaft, GlobalBalance, HeatBalance, MeltingLaw, ShaftHeat

# What a polymer bush is made of: geometry, liner, shaft, and friction that depends on temperature.


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
        nu, at least 0 and below 0.5: an incompressible thin bonded liner would be rigid.
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
        """Return the friction coefficient f at a temperature [K]."""
        T = np.asarray(temperature, dtype=float)
        return self.f0 + T * (self.f1 + T * self.f2)

    def slope(self, temperature: ArrayLike) -> Array:
        """Return the slope df/dT of the friction coefficient [1/K] at a temperature [K]."""
        return self.f1 + 2.0 * self.f2 * np.asarray(temperature, dtype=float)

    def least(self, hottest: float) -> float:
        """Return the smallest friction coefficient between the ambient temperature and `hottest` [K]."""
        inner = -0.5 * self.f1 / self.f2 if self.f2 > 0.0 else 0.0
        return float(self.at([0.0, min(max(inner, 0.0), hottest), hottest]).min())


# The polymer bush worn by melting: contact, heat and critical speed, in SI units.


SCAN = 257
"""Angles among which the largest critical speed is looked for."""


@dataclass(frozen=True, kw_only=True)
class BushContact(Readable):
    """A loaded bush at its melting point: what `MeltingBush.contact` answers.

    Attributes
    ----------
    load : float [N]
    contact_angle : float [rad]
        Half the angle over which the shaft touches the liner.
    settlement : float [m]
        Displacement of the shaft beyond the clearance; negative while thermal expansion lifts it.
    mean_pressure, maximum_pressure : float [Pa]
        Contact pressure, mean and on the load line.
    shaft_flux, liner_flux : float [W/m2]
        Heat into shaft and liner, per contact area, that keeps the contact at the melting point.
    critical_speed : float [rad/s]
        Speed at which the liner begins to melt.
    """

    load: float
    contact_angle: float
    settlement: float
    mean_pressure: float
    maximum_pressure: float
    shaft_flux: float
    liner_flux: float
    critical_speed: float


@quantities
@dataclass(frozen=True, kw_only=True)
class MeltingBush:
    """A rigid shaft that rubs in a thin polymer liner, in a rigid housing.

    Temperatures are above the ambient one. Loads are radial forces on the whole bush; angles, pressures and
    fluxes are those of a contact at the melting point unless a temperature is given.

    Parameters
    ----------
    geometry : BushGeometry
    liner : LinerMaterial
        Material of the liner.
    shaft : ShaftMaterial
    friction : Friction
    outer_mean : float [K]
        D_0 in the temperature D_0 + D_1 cos(phi) of the liner's outer surface, phi from the load line (2.3).
    outer_swing : float [K]
        D_1 in it, half the difference between the load line and the far side.
    shaft_heat : ShaftHeat
        `ExactShaft()` or, as published, `ApproximateShaft()`.
    balance : HeatBalance
        `ContactBalance()` as published, or `GlobalBalance()`.

    Raises
    ------
    InputError
        If a value is out of range, thermal expansion closes the clearance below the melting point,
        friction vanishes below it, or the outer surface is as hot as it.

    Examples
    --------
    >>> bush = f4k20_bush()
    >>> round(float(bush.contact_angle(3.75e3)), 6)
    0.200687
    """

    geometry: BushGeometry
    liner: LinerMaterial
    shaft: ShaftMaterial
    friction: Friction
    outer_mean: float
    outer_swing: float
    shaft_heat: ShaftHeat = field(default_factory=ExactShaft)
    balance: HeatBalance = field(default_factory=ContactBalance)

    def __post_init__(self) -> None:
        require_kind("shaft_heat", self.shaft_heat, ShaftHeat, "ExactShaft() or ApproximateShaft()")
        require_kind("balance", self.balance, HeatBalance, "ContactBalance() or GlobalBalance()")
        require_number("outer_mean", self.outer_mean)
        require_non_negative("outer_swing", self.outer_swing)
        hottest, melting = self.outer_mean + self.outer_swing, self.liner.melting_point
        if hottest >= melting:
            raise InputError(
                f"outer_mean + outer_swing must be below the melting point {melting!r}, got {hottest!r}"
            )
        expansion = self.closing * melting
        if self.clearance_ratio <= expansion:
            raise InputError(
                "radius - shaft_radius must exceed the part of the clearance that thermal expansion closes, "
                f"{expansion:.6g} radii, got {self.clearance_ratio:.6g} radii"
            )
        if self.friction.least(melting) <= 0.0:
            raise InputError(f"friction must be positive up to the melting point, got {self.friction!r}")

    @property
    def clearance_ratio(self) -> float:
        """Radial clearance of the cold, unworn bush divided by the liner radius, Delta/R [1]."""
        return 1.0 - self.geometry.shaft_radius / self.geometry.radius

    @property
    def thickness_ratio(self) -> float:
        """Logarithmic thickness of the liner, ln(R_2/R)."""
        return math.log(self.geometry.outer_radius / self.geometry.radius)

    @property
    def compliance(self) -> float:
        """Compliance a_1: surface displacement over radius at a pressure of one shear modulus."""
        nu = self.liner.poisson_ratio
        return self.thickness_ratio * (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))

    @property
    def closing(self) -> float:
        """Thermal displacement of the liner's surface over its radius, per kelvin: ln(R_2/R) B [1/K]."""
        nu = self.liner.poisson_ratio
        return self.thickness_ratio * self.liner.expansion * (1.0 + nu) / (1.0 - nu)

    @property
    def force_unit(self) -> float:
        """Unit of force, G R_1 times the length [N]; N is the load in this unit."""
        return self.liner.shear_modulus * self.geometry.shaft_radius * self.geometry.length

    @property
    def liner_conductance(self) -> float:
        """Thermal conductance of the liner for each contact area, lambda_2/(R ln(R_2/R)) [W/(m2 K)]."""
        return self.liner.conductivity / (self.thickness_ratio * self.geometry.radius)

    @cached_property
    def shaft_conductance(self) -> float:
        """Q_1/T_*: mean heat into the shaft per area under the bush and kelvin [W/(m2 K)]."""
        radius, conductivity = self.geometry.shaft_radius, self.shaft.conductivity
        cooling = self.shaft.air_transfer * radius / conductivity
        stubbiness = 2.0 * radius / self.geometry.length
        return self.shaft_heat.flux(cooling, stubbiness) * conductivity / radius

    @cached_property
    def law(self) -> MeltingLaw:
        """The numbers that the inner loops of the melting models need."""
        return MeltingLaw(
            clearance=self.clearance_ratio,
            closing=self.closing,
            compliance=self.compliance,
            pressure_work=self.liner.shear_modulus * self.geometry.shaft_radius,
            shaft=self.shaft_conductance,
            liner=self.liner_conductance,
            melting=self.liner.melting_point,
            friction=(self.friction.f0, self.friction.f1, self.friction.f2),
            outer=(self.outer_mean, self.outer_swing),
            balance=self.balance,
        )

    def gap(self, temperature: ArrayLike) -> Array:
        """Return the clearance c(T) that is left at a contact temperature [K], per liner radius."""
        return self.clearance_ratio - self.closing * np.asarray(temperature, dtype=float)

    def contact_angle(self, load: ArrayLike, temperature: ArrayLike | None = None) -> Array:
        """Return half the contact angle of an unworn bush (2.17).

        Parameters
        ----------
        load : array_like, shape (...) [N]
            Not negative.
        temperature : array_like, shape (...) [K], optional
            Temperature of the contact; the melting point by default.

        Returns
        -------
        ndarray, shape (...) [rad]

        Raises
        ------
        InputError
            If a load is negative or not finite, or the temperature closes the clearance.
        """
        gap = self.gap(self._temperature(temperature))
        if np.any(gap <= 0.0):
            raise InputError(f"temperature must leave a clearance, got {temperature!r} K")
        return contact.arc_angle(self.compliance * self.load_ratio(load) / gap)

    def load_ratio(self, load: ArrayLike) -> Array:
        """Return the dimensionless load N: the load [N] over length, shaft radius and shear modulus."""
        values = require_finite("load", load)
        if np.any(values < 0.0):
            raise InputError(f"load must not be negative, got {load!r}")
        return values / self.force_unit

    def settlement(self, angle: ArrayLike, temperature: ArrayLike | None = None) -> Array:
        """Return the settlement beta [m] at which half the contact angle is `angle` [rad] (2.17)."""
        gap = self.gap(self._temperature(temperature))
        return self.geometry.radius * (gap / np.cos(angle) - self.clearance_ratio)

    def angle_at(self, settlement: ArrayLike) -> Array:
        """Return half the contact angle [rad] at a settlement [m], worn or not: the inverse of `settlement`.

        Raises
        ------
        InputError
            If the shaft does not reach the liner at this settlement.
        """
        cosine = self.gap(self.liner.melting_point) / (
            require_finite("settlement", settlement) / self.geometry.radius + self.clearance_ratio
        )
        if np.any(cosine > 1.0) or np.any(cosine <= 0.0):
            least = self.settlement(0.0)
            raise InputError(
                f"settlement must be at least {least:.6g} m, where the shaft touches, got {settlement!r}"
            )
        return np.arccos(cosine)

    def mean_pressure(self, load: ArrayLike, angle: ArrayLike) -> Array:
        """Return the mean pressure over the contact [Pa] (2.15)."""
        return self.liner.shear_modulus * self.load_ratio(load) * contact.mean_weight(angle)

    def maximum_pressure(self, load: ArrayLike, angle: ArrayLike) -> Array:
        """Return the pressure on the load line [Pa] (2.14)."""
        return self.liner.shear_modulus * self.load_ratio(load) * contact.peak_weight(angle)

    def shaft_flux(self, angle: ArrayLike) -> Array:
        """Return the heat into the shaft per contact area at the melting point [W/m2] (2.13)."""
        return self.balance.share(angle) * self.shaft_conductance * self.liner.melting_point

    def liner_flux(self, angle: ArrayLike) -> Array:
        """Return the mean heat into the liner per contact area at the melting point [W/m2] (2.5)."""
        return self.liner_conductance * (self.liner.melting_point - self.outer_temperature(angle))

    def outer_temperature(self, angle: ArrayLike) -> Array:
        """Return the mean temperature of the liner's outer surface over the contact [K]."""
        return self.outer_mean + self.outer_swing * contact.sinc(angle)

    def critical_speed(self, load: ArrayLike, angle: ArrayLike | None = None) -> Array:
        """Return omega_c, the speed at which the liner begins to melt (2.16).

        Parameters
        ----------
        load : array_like, shape (...) [N]
            Positive.
        angle : array_like, shape (...) [rad], optional
            Half the contact angle; that of the unworn bush by default.

        Returns
        -------
        ndarray, shape (...) [rad/s]
        """
        if np.any(self.load_ratio(load) <= 0.0):
            raise InputError(f"load must be positive for a critical speed, got {load!r}")
        alpha = self.contact_angle(load) if angle is None else np.asarray(angle, dtype=float)
        friction = self.friction.at(self.liner.melting_point) * self.mean_pressure(load, alpha)
        return (self.shaft_flux(alpha) + self.liner_flux(alpha)) / (self.geometry.shaft_radius * friction)

    def onset_speed(self, load: float, settlement: float) -> float:
        """Return omega_* [rad/s], the largest critical speed on the way to a settlement [m].

        With `ContactBalance` the critical speed grows with the angle, and this is omega_c at the last angle;
        in general it is the largest of `SCAN` values.
        """
        angles = np.linspace(float(self.contact_angle(load)), float(self.angle_at(settlement)), SCAN)
        return float(self.critical_speed(load, angles).max())

    def contact(self, load: float) -> BushContact:
        """Return contact, heat and critical speed of the unworn bush under a load [N] > 0."""
        angle = self.contact_angle(load)
        return BushContact(
            load=float(load),
            contact_angle=float(angle),
            settlement=float(self.settlement(angle)),
            mean_pressure=float(self.mean_pressure(load, angle)),
            maximum_pressure=float(self.maximum_pressure(load, angle)),
            shaft_flux=float(self.shaft_flux(angle)),
            liner_flux=float(self.liner_flux(angle)),
            critical_speed=float(self.critical_speed(load, angle)),
        )

    def _temperature(self, temperature: ArrayLike | None) -> Array:
        return require_finite("temperature", self.liner.melting_point if temperature is None else temperature)


# The numbers of a bush that kernels of the C library read (`native/bushes/bush.h`), and its typical signals.


NOT_NEGATIVE = {"outer_swing", "melting_heat", "retardation"}
"""Parameters that have a lower bound."""


def has_kernel(bush: MeltingBush) -> bool:
    """Return whether the C library knows the heat balance of a bush."""
    return type(bush.balance) in (ContactBalance, GlobalBalance)


def bush_table(bush: MeltingBush) -> Array:
    """Return the numbers that are fixed, in the order of `rf_bush_numbers`."""
    law, geometry = bush.law, bush.geometry
    return np.array(
        [
            law.clearance,
            law.closing,
            law.compliance,
            law.pressure_work,
            law.shaft,
            law.liner,
            law.melting,
            float(isinstance(bush.balance, GlobalBalance)),
            geometry.radius,
            geometry.shaft_radius,
            geometry.outer_radius - geometry.radius,
            bush.force_unit,
            bush.liner.shear_modulus,
        ]
    )


def bush_parameters(bush: MeltingBush, melting_heat: float) -> tuple[NativeParameter, ...]:
    """Return friction, outer temperature and melting heat [J/m3], all tunable, in the order of bush.h."""
    friction = bush.friction
    rows = (
        ("f0", "1", friction.f0, 0.1, "coefficient of friction f0 + f1 T + f2 T^2, at ambient temperature"),
        ("f1", "1/K", friction.f1, 1e-4, "its part linear in the temperature above ambient"),
        ("f2", "1/K2", friction.f2, 1e-7, "its part quadratic in the temperature"),
        ("outer_mean", "K", bush.outer_mean, 100.0, "mean temperature of the outer surface above ambient"),
        ("outer_swing", "K", bush.outer_swing, 1.0, "by how much it is warmer on the load line"),
        ("melting_heat", "J/m3", melting_heat, melting_heat, "heat that melts a unit of volume"),
    )
    return tunable(rows)


def tunable(rows: tuple[tuple[str, str, float, float, str], ...]) -> tuple[NativeParameter, ...]:
    """Return parameters of rows (name, unit, value, nominal value, description)."""
    return tuple(
        NativeParameter(
            name=name,
            unit=unit,
            value=float(value),
            tunable=True,
            minimum=0.0 if name in NOT_NEGATIVE else -np.inf,
            nominal=float(nominal),
            description=description,
        )
        for name, unit, value, nominal, description in rows
    )


# The signals of bushes that wear, and their typical magnitudes.


NOMINAL_LOAD = 1e-2
"""Typical load in units of `MeltingBush.force_unit`."""

NOMINAL_PRESSURE = 4e-2
"""Typical largest contact pressure in shear moduli."""

NOMINAL_SPEED = 10.0
"""Typical angular speed [rad/s]."""


def nominal_depth(bush: MeltingBush) -> float:
    """Return a typical depth of the shaft in the liner [m]."""
    return bush.geometry.radius * bush.compliance * NOMINAL_PRESSURE


def torque_row(bush: MeltingBush, friction: float) -> tuple[str, str, float, str]:
    """Return the row of the signal of the friction torque."""
    unit = NOMINAL_LOAD * bush.force_unit * bush.geometry.shaft_radius
    return "friction_torque", "N.m", friction * unit, "torque about +z that keeps the shaft turning"
