"""The units of the film force of a journal, which dimensions and viscosity of its bearing make."""

from __future__ import annotations

from typing import Protocol

from ..errors import InputError, require_each, require_positive
from .reaction import NOMINAL_SPEED


class Size(Protocol):
    """Dimensions of a bearing."""

    @property
    def radius(self) -> float:
        """Of the bearing [m]."""

    @property
    def length(self) -> float:
        """Full axial length [m]."""

    @property
    def clearance(self) -> float:
        """Radial clearance [m], the unit of eccentricity ratios."""


def require_size(bearing: Size, *further: str) -> None:
    """Raise InputError unless sizes and further fields are positive, and the clearance below the radius."""
    require_each(bearing, require_positive, "radius", "length", "clearance", *further)
    if bearing.clearance >= bearing.radius:
        raise InputError(f"clearance must be below the radius {bearing.radius!r}, got {bearing.clearance!r}")


class Dimensions(Size, Protocol):
    """Dimensions of a bearing, and the viscosity of its film."""

    @property
    def film_length(self) -> float:
        """Axial length that is film [m]."""

    @property
    def film_viscosity(self) -> float:
        """Dynamic viscosity of the film [Pa s]."""


class _Scaled(Protocol):
    @property
    def slenderness(self) -> float: ...

    @property
    def force_scale(self) -> float: ...


class FilmUnits:
    """What is the same of all bearings with `Dimensions`."""

    @property
    def film_length(self: Dimensions) -> float:
        """Axial length that is film [m]: all of it."""
        return self.length

    @property
    def slenderness(self: Dimensions) -> float:
        """Length / diameter of the film [1]."""
        return self.film_length / (2.0 * self.radius)

    @property
    def force_scale(self: Dimensions) -> float:
        """Viscosity * film_length * radius^3 / clearance^2 [N s], the film's unit of force per 1/s."""
        return self.film_viscosity * self.film_length * self.radius**3 / self.clearance**2

    @property
    def nominal_force(self: _Scaled) -> float:
        """Force of a middling motion at NOMINAL_SPEED [N]."""
        return self.force_scale * NOMINAL_SPEED * min(1.0, self.slenderness**2)
