"""Film and approach of a rolling ball under its static load: ever finer grids."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ...bearings.contact import PointContact
from ...errors import InputError
from ...films.contact_grid import ContactGrid
from ..ladder import ErrorEstimate, Found, Ladder, Work

if TYPE_CHECKING:
    from ..scene import Scene

QUANTITIES = ("central_film", "minimum_film", "approach")
"""Quantities of a stationary contact, all of them lengths [m]."""

CELLS = (16, 32, 64)
"""Cells along each side of the rungs."""

DOUBLED = 2.0


@dataclass(frozen=True, kw_only=True)
class ContactRung:
    """A stationary contact on one grid.

    Attributes
    ----------
    contact : PointContact
    film_scale : float [m]
    quantity : str
    """

    contact: PointContact
    film_scale: float
    quantity: str

    @property
    def name(self) -> str:
        """Cells of the grid."""
        return f"grid {self.cells} x {self.cells}"

    @property
    def cells(self) -> int:
        """Cells along a side."""
        return self.contact.grid.cells[0]

    @property
    def prior(self) -> float:
        """Nothing is known beforehand."""
        return 0.0

    @property
    def unit(self) -> str:
        """Name of one unknown solved for."""
        return f"unknowns on {self.name}"

    def answer(self, before: Found | None) -> Found:
        """Return the quantity [m]."""
        return Found(self._value(self.contact), {self.unit: self.cells**2}, None)

    def _value(self, contact: PointContact) -> float:
        state = contact.stationary()
        name = "delta" if self.quantity == "approach" else self.quantity
        return self.film_scale * float(getattr(state, name))

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the order increment from the grid with half the cells, the rung below or a new one."""
        coarse = self.cells // 2
        if before is not None and sum(before.work.values()) == coarse**2:
            other, work = before.value, {}
        else:
            half = ContactGrid(cells=(coarse, coarse))
            other = self._value(self._on(half))
            work = {f"unknowns on grid {coarse} x {coarse}": coarse**2}
        order = self.contact.scheme.order
        error = abs(found.value - other) / (DOUBLED**order - 1.0) / abs(found.value)
        return ErrorEstimate(error, f"order increment, order {order}", work)

    def _on(self, grid: ContactGrid) -> PointContact:
        return replace(self.contact, grid=grid)

    def expected(self, done: Work) -> Work:
        """Return the number of unknowns."""
        return {self.unit: self.cells**2}


def contact_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of grids of a stationary contact.

    Raises
    ------
    InputError
        If the scene has no contact, or its load changes.
    """
    if scene.contact is None:
        raise InputError(f"contact is required for {quantity}, got no such table")
    if scene.excitation is not None:
        raise InputError(f"excitation must be none for {quantity}: only a static load has a ladder, got one")
    table = scene.contact
    ball = table.build()
    rungs = tuple(
        ContactRung(
            contact=ball.contact(
                ContactGrid(cells=(cells, cells)), roelands=table.roelands, compressible=table.compressible
            ),
            film_scale=ball.film_scale,
            quantity=quantity,
        )
        for cells in CELLS
    )
    return Ladder(rungs=rungs, unit="m")
