"""`[sleeve]` of a scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from ..reading import Quantity
from .sleeve_bearing import ViscousSleeve


@dataclass(frozen=True, kw_only=True)
class SleeveTable:
    """`[sleeve]`: a viscous sleeve.

    Parameters
    ----------
    radius : float [m]
        A file may give `diameter` instead.
    length : float [m]
    clearance : float [m]
    viscosity : float [Pa s]
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    length: Annotated[float, Quantity("m")]
    clearance: Annotated[float, Quantity("m")]
    viscosity: Annotated[float, Quantity("Pa.s")]

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> ViscousSleeve:
        """Return the bearing; raise InputError where a value breaks its rule."""
        return ViscousSleeve(
            radius=self.radius, length=self.length, clearance=self.clearance, viscosity=self.viscosity
        )
