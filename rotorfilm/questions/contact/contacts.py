"""Film and approach of a rolling ball at rest: a formula, ever finer grids, and the rectangle around them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...answers import ISOTHERMAL, ErrorEstimate, Found, Work, WorkUnit
from ...errors import ConvergenceError, InputError
from ...ladders import BaseRung, Ladder, Rung
from ...scenes.contact.contact_remarks import contact_remarks
from ...scenes.contact.contact_rest import INLETS, OUTLET, REACH, SPACINGS, RestingFilms, unknowns
from .contact_motion_rungs import motion_rungs

if TYPE_CHECKING:
    from ...scenes.scene import Scene

QUANTITIES = tuple(REACH)
"""Quantities of a contact, all of them lengths [m]."""

CELLS = (32, 48, 64)
"""Cells along each side of the plain rungs."""

COARSER = {32: 24, 48: 32, 64: 48}
"""Cells of the companion that an order increment takes."""

NOISE = 0.012
"""Error of a film on 32 x 32 cells below which an order increment says nothing: it may change its sign.

Falls with the square of the cells; that of the approach is ten times smaller. Measured on random balls.
"""

SMALLEST_NOISE = 0.03
"""The same of the smallest film, which jumps from cell to cell; falls with their power 3/2."""

FORMULA_BOUNDS = {"central_film": 0.16, "approach": 0.08}
"""Largest error of the formulas in `FORMULA_RANGE`, measured on random balls (docs/contact.md)."""

FORMULA_RANGE = ((0.008, 0.4), (2.0, 18.0))
"""V and Q0 in which that was measured."""

HARD = (0.08, 12.0)
"""V and Q0 above both of which Newton's method needs continuation on fine grids: the longest is left out."""

DENSE = (96, 64)
"""Cells along each side of the shortest rectangle from which an unbounded film is extrapolated."""

FORMULAS = WorkUnit("formulas")

LEFT = 0.3
"""Share of an extrapolation that may be wrong."""


@dataclass(frozen=True, kw_only=True)
class FormulaRung(BaseRung):
    """The film of Nijenbanning, Venner and Moes (1994); the dry contact's approach with it between.

    Attributes
    ----------
    films : RestingFilms
    """

    films: RestingFilms

    name = "formula of Nijenbanning et al."

    @property
    def unit(self) -> WorkUnit:
        """One formula."""
        return FORMULAS

    def answer(self, before: Found | None) -> Found:
        """Return the quantity [m]; the dry contact has the approach -2, in Hertzian units."""
        film = self.films.ball.published_films.nijenbanning_venner_moes
        dry = 2.0 * self.films.ball.film_scale
        return Found(film if self.films.quantity == "central_film" else film - dry, {self.unit: 1})

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the measured bound, where it was measured."""
        ball = self.films.ball
        inside = all(
            low <= x <= high for (low, high), x in zip(FORMULA_RANGE, (ball.V, ball.Q0), strict=True)
        )
        doubt = "" if inside else f"V = {ball.V:.3g}, Q0 = {ball.Q0:.3g} are outside of its measured range"
        bound = FORMULA_BOUNDS[self.films.quantity]
        return ErrorEstimate(bound, "measured bound of the formula", bound=True, doubt=doubt)


@dataclass(frozen=True, kw_only=True)
class GridRung(BaseRung):
    """A stationary contact on one grid of the shortest rectangle.

    Attributes
    ----------
    films : RestingFilms
    cells : int
        Along each side.
    """

    films: RestingFilms
    cells: int

    @property
    def name(self) -> str:
        """Cells of the grid."""
        return f"grid {self.cells} x {self.cells}"

    def answer(self, before: Found | None) -> Found:
        """Return the quantity [m]."""
        work: dict[WorkUnit, int] = {}
        value = self.films.value(self.cells, work)
        return Found(value * self.films.ball.film_scale, work)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the order increment from less cells, and that from two rectangles on coarse grids.

        The smallest film jumps from cell to cell, so that its increment is overestimated: the whole is taken.
        """
        work: dict[WorkUnit, int] = {}
        bound = self.films.quantity == "minimum_film"
        try:
            about = grid_error(self.films, self.cells, work) + rectangle_error(self.films, work)
        except ConvergenceError as error:
            return ErrorEstimate(1.0, "order increments", work, doubt=f"no companion: {error}")
        doubt = "the grids disagree on the film: it is too thin for them" if bound and about > 0.5 else ""
        how = "overestimated: whole increment of cells, order increment of rectangle"
        method = how if bound else "order increments of cells and rectangle"
        return ErrorEstimate(about, method, work, bound, doubt)

    def expected(self, done: Work) -> Work:
        """Return the number of unknowns."""
        return {unknowns(self.cells): self.cells**2}


@dataclass(frozen=True, kw_only=True)
class UnboundedRung(BaseRung):
    """A grid of the finest of `SPACINGS` on a longer rectangle, extrapolated to an infinite one.

    Attributes
    ----------
    films : RestingFilms
    place : int
        Of the rectangle in `INLETS`.
    cells : int
        Along each side.
    """

    films: RestingFilms
    place: int
    cells: int

    @property
    def name(self) -> str:
        """Cells of the grid."""
        return f"grid {self.cells} x {self.cells}, unbounded"

    def answer(self, before: Found | None) -> Found:
        """Return the quantity [m], extrapolated in the length of the rectangle and in the cells."""
        work: dict[WorkUnit, int] = {}
        short, longer = INLETS[self.place - 1 : self.place + 1]
        wide = self.films.value(self.cells, work, longer)
        before_it = self.films.value(round(SPACINGS[-1] * (short + OUTLET)), work, short)
        reach = (wide - before_it) / ((longer / short) ** REACH[self.films.quantity] - 1.0)
        fine, coarse = (self.films.value(cells, work) for cells in DENSE)
        spacing = (fine - coarse) / (1.0 - (DENSE[1] / DENSE[0]) ** 2)
        value = wide + reach + spacing
        parts = abs(reach / value), abs(spacing / value)
        return Found(value * self.films.ball.film_scale, work, parts)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return a share of the two extrapolations, chosen to overestimate what is wrong with them."""
        error = max(LEFT * sum(found.solution), noise_of(self.films, DENSE[0]))
        return ErrorEstimate(error, f"overestimated: {LEFT:.0%} of the extrapolations", bound=True)

    def expected(self, done: Work) -> Work:
        """Return the number of unknowns."""
        return {unknowns(self.cells): self.cells**2, unknowns(DENSE[0]): DENSE[0] ** 2}


def grid_error(films: RestingFilms, cells: int, work: dict[WorkUnit, int]) -> float:
    """Return the relative error of a quantity by the cells, from less of them; more of the smallest film.

    Raises
    ------
    ConvergenceError
        If there is no solution on less cells.
    """
    coarse = COARSER[cells]
    fine, rough = (films.value(n, work) for n in (cells, coarse))
    order = films.contact(cells).scheme.order
    whole = films.quantity == "minimum_film"
    gain = 1.0 if whole else (cells / coarse) ** order - 1.0
    return max(abs(fine - rough) / gain / abs(fine), noise_of(films, cells))


def noise_of(films: RestingFilms, cells: int) -> float:
    """Return the relative error below which an increment says nothing."""
    if films.quantity == "minimum_film":
        return SMALLEST_NOISE * (CELLS[0] / cells) ** 1.5
    return NOISE * (CELLS[0] / cells) ** 2 * (0.1 if films.quantity == "approach" else 1.0)


def rectangle_error(films: RestingFilms, work: dict[WorkUnit, int]) -> float:
    """Return the relative error of a quantity by the end of the rectangle."""
    change = films.beyond(work)
    near = next(value for (inlet, _, at), value in films.known.items() if inlet == INLETS[0] and at == 1.0)
    return abs(change / (near + change))


def contact_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a contact at rest, or in motion where its load jumps or swings.

    Raises
    ------
    InputError
        If the scene has no contact, or an excitation that is no step or sine of the load.
    """
    if scene.contact is None:
        raise InputError(f"contact is required for {quantity}, got no such table")
    films = RestingFilms(table=scene.contact, quantity=quantity)
    table = scene.contact
    remarks = contact_remarks(
        films.ball, scene.lubricant.properties, roelands=table.roelands, compressible=table.compressible
    )
    if scene.excitation is not None:
        return Ladder(rungs=motion_rungs(scene, films), unit="m", remarks=remarks, within=ISOTHERMAL)
    formula = () if quantity == "minimum_film" else (FormulaRung(films=films),)
    grids = tuple(GridRung(films=films, cells=cells) for cells in CELLS)
    wide = (UnboundedRung(films=films, place=1, cells=96), UnboundedRung(films=films, place=2, cells=160))
    hard = HARD[0] < films.ball.V and HARD[1] < films.ball.Q0
    rungs: tuple[Rung, ...] = (*formula, *grids, *wide[: 1 if hard else 2])
    return Ladder(rungs=rungs, unit="m", remarks=remarks, within=ISOTHERMAL)
