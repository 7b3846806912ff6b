"""Seals at the ends of a squeeze film, by their leakage."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ....errors import InputError, require_non_negative, require_positive
from ....inputs.kinds import arguments
from ....inputs.si_arguments import quantities
from ....model import Array
from ..full_squeeze import SqueezeFilm


@quantities
@dataclass(frozen=True, kw_only=True)
class EndSeal:
    """Equal seals at both ends of a squeeze film: flow out of an end = leakage * pressure * circumference.

    Damping and added mass of a sealed damper are set by its seals, not by its film, and no seal is known to
    better than some tenths: its uncertainty belongs to every answer. An O-ring is tight (leakage 0), with a
    stiffness of its own that `Sprung` adds.

    Parameters
    ----------
    leakage : float [m2/(Pa.s)]
        G_s, volume per time, circumference and pressure; 0 for a tight seal.
    uncertainty : float [1]
        Of the leakage, relative: it may be that much larger or smaller. Below 1.

    Raises
    ------
    InputError
        If the leakage is negative or not finite, or the uncertainty not from 0 to below 1.
    """

    leakage: float
    uncertainty: float = 0.0

    def __post_init__(self) -> None:
        require_non_negative("leakage", self.leakage)
        require_non_negative("uncertainty", self.uncertainty)
        if self.uncertainty >= 1.0:
            raise InputError(f"uncertainty must be below 1, got {self.uncertainty!r}")

    @property
    def bounds(self) -> tuple[EndSeal, EndSeal]:
        """The tightest and the most leaking seal within the uncertainty."""
        low, high = (self.leakage * (1.0 + sign * self.uncertainty) for sign in (-1.0, 1.0))
        return EndSeal(leakage=low), EndSeal(leakage=high)


@arguments
def gap_seal(*, height: float, length: float, viscosity: float) -> EndSeal:
    """Return the seal that is a narrow gap: leakage height^3/(12 viscosity length).

    Parameters
    ----------
    height, length : float [m]
        Of the gap, along the radius and along the axis.
    viscosity : float [Pa s]

    Raises
    ------
    InputError
        If a value is not positive.
    """
    for name, value in (("height", height), ("length", length), ("viscosity", viscosity)):
        require_positive(name, value)
    return EndSeal(leakage=height**3 / (12.0 * viscosity * length))


@arguments
def leak_test_seal(*, flow: float, pressure: float, radius: float, uncertainty: float = 0.0) -> EndSeal:
    """Return the seal of a leak test: leakage flow/(2 pi radius pressure).

    A slit at the butt of one piston ring counts as spread over the circumference.

    Parameters
    ----------
    flow : float [m3/s]
        Out of one end.
    pressure : float [Pa]
        Inside, above that outside.
    radius : float [m]
        Of the film.
    uncertainty : float [1]
        As of an `EndSeal`.

    Raises
    ------
    InputError
        If a value breaks its rule.
    """
    require_non_negative("flow", flow)
    require_positive("pressure", pressure)
    require_positive("radius", radius)
    return EndSeal(leakage=flow / (2.0 * math.pi * radius * pressure), uncertainty=uncertainty)


@dataclass(frozen=True, eq=False)
class SealedShortFilm:
    """A short film with seals: what leaves it needs the pressure h_t L/(2 G_s) at the ends, a damping more.

    Parameters
    ----------
    film : SqueezeFilm
        The same with open ends.
    damping : float [1]
        Of the seals: pi c^3/(2 viscosity G_s L) in the film's units, half of that where the film ruptures,
        since the pressure at the ends has the sign of that in the film.
    """

    film: SqueezeFilm
    damping: float

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        return self.film.force(eccentricity, rate) - self.damping * rate

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`."""
        found = self.film.jacobian(eccentricity, rate)
        unit = np.eye(2).reshape(2, 2, *(1,) * (eccentricity.ndim - 1))
        found[:, 2:] -= self.damping * unit
        return found
