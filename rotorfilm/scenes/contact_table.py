"""`[contact]`: a ball that rolls on a lubricated plane, or balls that carry a journal."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from ..bearings.contact import BallSupport, ContactGrid, PointContact, RollingBall, reduce_ball
from ..core.errors import InputError, require_non_negative
from ..core.limits import CONTACT_CELLS, LAW_STATES
from .reading import Count, Taking, fields_of, made_from


@dataclass(frozen=True, kw_only=True)
@fields_of(RollingBall)
class ContactTable(Taking):
    """`[contact]`: a rolling ball, its lubricant, and where such balls carry a journal.

    Parameters
    ----------
    mass : float [kg]
        Of the ball; 0 where it follows its load without inertia.
    load : float [N]
        Of one ball, about which its law is made.
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

    mass: float = 0.0
    cells: Annotated[int, Count(CONTACT_CELLS)] = 40
    order: Annotated[int, Count(LAW_STATES)] = 5
    roelands: bool = False
    compressible: bool = False
    angles: tuple[float, ...] = ()
    preload: float = 0.0

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
