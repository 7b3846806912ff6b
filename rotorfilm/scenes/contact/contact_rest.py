"""Stationary films of a rolling ball on several grids, each solved once for all rungs of a question."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from ...answers import WorkUnit
from ...bearings.contact import ContactGrid, PointContact, RollingBall
from ...errors import ConvergenceError
from .contact_table import ContactTable

INLETS = (2.5, 4.5, 8.5)
"""Lengths of the inlet of the rectangles, in Hertzian radii; half as wide as long (`ContactGrid`)."""

OUTLET = 1.5
"""Length of their outlet."""

REACH = {"approach": 1.0, "central_film": 3.0, "minimum_film": 3.0}
"""Power of its length with which the rectangle changes a quantity.

Far from the contact the pressure is V (-x)/(5 r^4): it falls with r^-3, and its integral, the load beyond the
rectangle, with 1/r.
"""

SPACINGS = (8, 12, 16)
"""Cells per Hertzian radius of the two rectangles compared; thin films have no solution on coarse grids."""

Grid = tuple[float, int, float]
"""Length of the inlet, cells along a side, load f."""


@dataclass(frozen=True, kw_only=True)
class RestingFilms:
    """A quantity of a ball at rest by grid and load.

    Attributes
    ----------
    table : ContactTable
    quantity : str
        One of `REACH`.
    known : dict
        Values [1] found so far; an entry is nan where there is no solution.
    """

    table: ContactTable
    quantity: str
    known: dict[Grid, float] = field(default_factory=dict, compare=False)

    @property
    def ball(self) -> RollingBall:
        """The ball in SI."""
        return self.table.build()

    @property
    def field(self) -> str:
        """Name of the quantity in a `ContactState` and a `ContactRun`."""
        return "delta" if self.quantity == "approach" else self.quantity

    def contact(self, cells: int, inlet: float = INLETS[0]) -> PointContact:
        """Return the contact on cells x cells of a rectangle."""
        grid = ContactGrid(
            cells=(cells, cells), inlet=-inlet, outlet=OUTLET, half_width=0.5 * (inlet + OUTLET)
        )
        return self.ball.contact(grid, roelands=self.table.roelands, compressible=self.table.compressible)

    def value(
        self, cells: int, work: dict[WorkUnit, int], inlet: float = INLETS[0], load: float = 1.0
    ) -> float:
        """Return the quantity [1]; what had to be solved for it is added to `work`.

        Raises
        ------
        ConvergenceError
            If the film is too thin for the grid.
        """
        key = (inlet, cells, round(load, 12))
        if key not in self.known:
            unit = unknowns(cells)
            work[unit] = work.get(unit, 0) + cells**2
            self.known[key] = math.nan
            state = self.contact(cells, inlet).stationary(load)
            self.known[key] = float(getattr(state, self.field))
        if math.isnan(self.known[key]):
            raise ConvergenceError(f"a contact must be solvable on {cells} x {cells} cells, got none before")
        return self.known[key]

    def lacking(self, cells: int, fine: int, work: dict[WorkUnit, int], load: float) -> float:
        """Return the relative error by cells, from finer ones, and by the end of the rectangle.

        Raises
        ------
        ConvergenceError
            If there is no solution on one of the grids.
        """
        rest, better = (self.value(n, work, load=load) for n in (cells, fine))
        by_cells = abs(better - rest) / (1.0 - (cells / fine) ** 2)
        return (by_cells + abs(self.beyond(work, load))) / abs(rest)

    def beyond(self, work: dict[WorkUnit, int], load: float = 1.0) -> float:
        """Return the change of the quantity [1] from the shortest to an infinite rectangle.

        Two rectangles with cells of one size, as coarse as there is a solution on.

        Raises
        ------
        ConvergenceError
            If there is none.
        """
        near, wide = INLETS[:2]
        for spacing in SPACINGS:
            try:
                short = self.value(round(spacing * (near + OUTLET)), work, near, load)
                longer = self.value(round(spacing * (wide + OUTLET)), work, wide, load)
            except ConvergenceError:
                if spacing == SPACINGS[-1]:
                    raise
                continue
            break
        return (longer - short) / (1.0 - (near / wide) ** REACH[self.quantity])


def unknowns(cells: int) -> WorkUnit:
    """Return the unit of one unknown of a film at rest."""
    return WorkUnit(f"unknowns on grid {cells} x {cells}", ("unknowns", cells))
