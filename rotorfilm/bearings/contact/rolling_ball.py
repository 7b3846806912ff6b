"""A ball rolling on a lubricated plane, in SI."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from ...errors import InputError, require_each, require_non_negative, require_number, require_positive
from ...inputs.si_arguments import quantities
from .film.contact_grid import ContactGrid
from .film.contact_scheme import ContactScheme, UpwindScheme
from .film.pressure_fluid import (
    HIGGINSON_PRESSURE,
    BarusViscosity,
    DowsonHigginsonDensity,
    RoelandsViscosity,
    roelands_viscosity,
)
from .film_formulas import HamrockDowson, Moes, moes_parameters
from .point_contact import PointContact


class PublishedFilms(NamedTuple):
    """Film thicknesses of a ball by published formulas [m].

    Attributes
    ----------
    nijenbanning_venner_moes : float [m]
        Central film (1994).
    hamrock_dowson, hamrock_dowson_minimum : float [m]
        Central and smallest film (1977).
    """

    nijenbanning_venner_moes: float
    hamrock_dowson: float
    hamrock_dowson_minimum: float


@quantities
@dataclass(frozen=True, kw_only=True)
class RollingBall:
    """A ball that rolls without slip on a lubricated plane.

    The velocity scale: Reynolds' equation carries the film with the mean of the two surface speeds in the
    frame of the contact. In pure rolling at `speed` both surfaces move at `speed`, u1 + u2 = 2 speed, so

        V = 48 mu0 speed R^2/(p_H a^3),    t0 = a/speed,    W = pi m speed^2/(3 P R).

    The source (Panovko 2011) writes |v| for u1 + u2; taken for the rolling speed, its V would
    be half of this.

    Parameters
    ----------
    radius : float [m]
    mass : float [kg]
        Moving with the ball against the contact.
    modulus, poisson_ratio : float [Pa, 1]
        Of the ball.
    viscosity : float [Pa s]
        At ambient pressure.
    pressure_coefficient : float [1/Pa]
        Of the viscosity, d ln mu/dp at ambient pressure.
    speed : float [m/s]
        Of the ball's center along the plane, > 0.
    load : float [N]
        Static, its weight included.
    plane_modulus : float [Pa]
        Of the plane; infinite (rigid), as published, by default.
    plane_poisson_ratio : float [1]

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    radius: float
    mass: float
    modulus: float
    poisson_ratio: float
    viscosity: float
    pressure_coefficient: float
    speed: float
    load: float
    plane_modulus: float = math.inf
    plane_poisson_ratio: float = 0.3

    def __post_init__(self) -> None:
        require_each(
            self, require_positive, "radius", "modulus", "viscosity", "pressure_coefficient", "speed", "load"
        )
        require_non_negative("mass", self.mass)
        if self.plane_modulus != math.inf:
            require_positive("plane_modulus", self.plane_modulus)
        for name in ("poisson_ratio", "plane_poisson_ratio"):
            if not -1.0 < require_number(name, getattr(self, name)) <= 0.5:
                raise InputError(f"{name} must be above -1 and at most 0.5, got {getattr(self, name)!r}")

    @property
    def combined_modulus(self) -> float:
        """E' [Pa], 2/E' = (1 - nu^2)/E of the ball + that of the plane."""
        ball = (1.0 - self.poisson_ratio**2) / self.modulus
        return 2.0 / (ball + (1.0 - self.plane_poisson_ratio**2) / self.plane_modulus)

    @property
    def contact_radius(self) -> float:
        """A of the dry contact (Hertz) [m]."""
        return float((1.5 * self.load * self.radius / self.combined_modulus) ** (1.0 / 3.0))

    @property
    def contact_pressure(self) -> float:
        """p_H, largest pressure of the dry contact [Pa]."""
        return 1.5 * self.load / (math.pi * self.contact_radius**2)

    @property
    def film_scale(self) -> float:
        """a^2/(2 R) [m]: unit of film thickness and approach."""
        return self.contact_radius**2 / (2.0 * self.radius)

    @property
    def time_scale(self) -> float:
        """a/speed [s]: unit of time."""
        return self.contact_radius / self.speed

    @property
    def V(self) -> float:
        """Speed parameter [1]."""
        scale = self.contact_pressure * self.contact_radius**3
        return 48.0 * self.viscosity * self.speed * self.radius**2 / scale

    @property
    def Q0(self) -> float:
        """Pressure-viscosity coefficient times p_H [1]."""
        return self.pressure_coefficient * self.contact_pressure

    @property
    def W(self) -> float:
        """Inertia [1]."""
        return math.pi * self.mass * self.speed**2 / (3.0 * self.load * self.radius)

    @property
    def moes(self) -> Moes:
        """Parameters of Moes, from the dimensionless ones."""
        return moes_parameters(self.V, self.Q0)

    @property
    def hamrock_dowson(self) -> HamrockDowson:
        """Parameters of Hamrock and Dowson, with their film thicknesses / R."""
        return HamrockDowson(
            self.viscosity * self.speed / (self.combined_modulus * self.radius),
            self.pressure_coefficient * self.combined_modulus,
            self.load / (self.combined_modulus * self.radius**2),
        )

    @property
    def published_films(self) -> PublishedFilms:
        """Film thicknesses by published formulas [m]."""
        speed = 2.0 * self.hamrock_dowson.U
        return PublishedFilms(
            self.moes.central_film * math.sqrt(speed) * self.radius,
            self.hamrock_dowson.central_film * self.radius,
            self.hamrock_dowson.minimum_film * self.radius,
        )

    def contact(
        self,
        grid: ContactGrid | None = None,
        scheme: ContactScheme | None = None,
        *,
        roelands: bool = False,
        compressible: bool = False,
    ) -> PointContact:
        """Return the dimensionless contact.

        Parameters
        ----------
        grid, scheme : optional
            As in `PointContact`.
        roelands : bool
            Whether the viscosity follows Roelands' law, with the same slope at ambient pressure, rather than
            Barus' exponential.
        compressible : bool
            Whether the density follows Dowson and Higginson.
        """
        return PointContact(
            V=self.V,
            Q0=self.Q0,
            grid=ContactGrid() if grid is None else grid,
            scheme=UpwindScheme() if scheme is None else scheme,
            piezoviscosity=self._roelands() if roelands else BarusViscosity(),
            density=DowsonHigginsonDensity(pressure_ratio=self.contact_pressure / HIGGINSON_PRESSURE)
            if compressible
            else None,
        )

    def _roelands(self) -> RoelandsViscosity:
        return roelands_viscosity(
            viscosity=self.viscosity,
            pressure_coefficient=self.pressure_coefficient,
            pressure=self.contact_pressure,
        )
