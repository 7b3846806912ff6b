"""`[contact]`: a ball that rolls on a lubricated plane, or balls that carry a journal."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any

from ..bearings.contact import BallSupport, ContactGrid, PointContact, RollingBall, reduce_ball
from ..core.errors import InputError, SceneError, brief, require_non_negative
from ..core.limits import CONTACT_CELLS, LAW_STATES
from .reading import Count, Quantity, flag, made_from, takes


@takes([Quantity("rad"), ...])
def read_angles(where: str, value: Any) -> tuple[float, ...]:
    """Read a list of angles [rad]."""
    if not isinstance(value, list):
        raise SceneError(f"{where} must be a list of angles, got {brief(value)}")
    return tuple(Quantity("rad")(f"{where}[{index}]", entry) for index, entry in enumerate(value))


@dataclass(frozen=True, kw_only=True)
class ContactTable:
    """`[contact]`: a rolling ball, its lubricant, and where such balls carry a journal.

    Parameters
    ----------
    radius : float [m]
        Of the ball; a file may give `diameter` instead.
    modulus, poisson_ratio : float [Pa, 1]
        Of the ball.
    viscosity : float [Pa s]
        At ambient pressure.
    pressure_coefficient : float [1/Pa]
        Of the viscosity.
    speed : float [m/s]
        Rolling speed.
    load : float [N]
        Of one ball, about which its law is made.
    mass : float [kg]
        Moving with the ball against the contact.
    plane_modulus, plane_poisson_ratio : float [Pa, 1]
        Of what it rolls on; rigid if the file does not say.
    cells : int
        Cells along each side of the film's rectangle.
    order : int
        States of the reduced law.
    roelands, compressible : bool
        Laws of viscosity and density, as in `RollingBall.contact`.
    angles : tuple of float [rad]
        Of the balls that carry a journal, from +x towards +y; empty for a ball on a plane.
    preload : float [N]
        Of each of these balls while the journal is in the center.
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    modulus: Annotated[float, Quantity("Pa")]
    poisson_ratio: Annotated[float, Quantity("1")]
    viscosity: Annotated[float, Quantity("Pa.s")]
    pressure_coefficient: Annotated[float, Quantity("1/Pa")]
    speed: Annotated[float, Quantity("m/s")]
    load: Annotated[float, Quantity("N")]
    mass: Annotated[float, Quantity("kg")] = 0.0
    plane_modulus: Annotated[float, Quantity("Pa")] = math.inf
    plane_poisson_ratio: Annotated[float, Quantity("1")] = 0.3
    cells: Annotated[int, Count(CONTACT_CELLS)] = 40
    order: Annotated[int, Count(LAW_STATES)] = 5
    roelands: Annotated[bool, flag] = False
    compressible: Annotated[bool, flag] = False
    angles: Annotated[tuple[float, ...], read_angles] = ()
    preload: Annotated[float, Quantity("N")] = 0.0

    def __post_init__(self) -> None:
        self.contact()
        require_non_negative("preload", self.preload)

    def build(self) -> RollingBall:
        """Return the ball; raise InputError where a value breaks its rule."""
        return made_from(RollingBall, self)

    def contact(self) -> PointContact:
        """Return its dimensionless contact."""
        grid = ContactGrid(cells=(self.cells, self.cells))
        return self.build().contact(grid, roelands=self.roelands, compressible=self.compressible)

    def support(self) -> BallSupport:
        """Return the balls around a journal; raises InputError if there are no angles."""
        if not self.angles:
            raise InputError("contact.angles is required for a support of a rotor, got none")
        law = reduce_ball(self.build(), self.contact(), self.order)
        return BallSupport(law=law, angles=self.angles, gap=float(law.approach(self.preload)))
