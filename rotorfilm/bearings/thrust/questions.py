"""What thrust bearings bring to questions: grids from coarse to fine, T0 and T1, held and free pads."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

from ...core.answers import HEATED, ISOTHERMAL, ErrorEstimate, Ladder, RungResult
from ...core.errors import InputError
from ...questions.heat_levels import BALANCED, FRESH, HeatLevel
from ...questions.quantities import relative, relative_rise
from ...questions.variants import FunctionRung, counted_rung
from ...scenes.shared_tables import oil_remarks
from . import TiltingThrustBearing
from .table import ThrustRest, ThrustTable, film_name, rest_at_film, thrust_remarks, thrust_rest

if TYPE_CHECKING:
    from ...scenes.scene import Scene

GRIDS = ((32, 16), (64, 32), (128, 64))
"""Cells around a pad and across it."""

HELD_CELLS = (32, 16)
"""Cells of the film whose pads are held in their tilts."""

HALF = 0.5
"""Error of T1 over what it changes in T0: viscosity that falls along the pad tilts it more."""

THINNED = 0.05
"""Least error of T1, over the logarithm of the viscosity that the film loses: with it that of ROSS is met."""

REST, BALANCES = 3e-5, 10
"""About the time of a rest [s] for each cell of a pad, and how many rests a balance of heat takes."""

OTHER_CARRY_OVER = 0.0
"""Share of hot oil carried over, with which that of the scene is compared."""


class ThrustQuantity(NamedTuple):
    """What may be asked of a thrust bearing: unit, value at a rest, distance of it from a better one."""

    unit: str
    value: Callable[[ThrustRest], float]
    distance: Callable[[Any, Any, float], float] = relative
    entry: tuple[str, int] | None = None
    """Matrix and motion of the freedoms of which it is a diagonal entry; None for another quantity."""


def _entry(unit: str, matrix: str, motion: int) -> ThrustQuantity:
    """Return a diagonal entry of stiffness or damping, at the frequency of the speed."""

    def value(rest: ThrustRest) -> float:
        return float(getattr(rest.coefficients, matrix)[motion, motion])

    return ThrustQuantity(unit, value, entry=(matrix, motion))


QUANTITIES = {
    "minimum_film": ThrustQuantity("m", lambda rest: rest.losses.minimum_film),
    "thrust_load": ThrustQuantity("N", lambda rest: rest.load),
    "axial_stiffness": _entry("N/m", "stiffness", 0),
    "axial_damping": _entry("N s/m", "damping", 0),
    "tilt_stiffness": _entry("N m/rad", "stiffness", 1),
    "power_loss": ThrustQuantity("W", lambda rest: rest.losses.power_loss),
    "side_flow": ThrustQuantity("m^3/s", lambda rest: rest.losses.side_flow),
    "maximum_pressure": ThrustQuantity("Pa", lambda rest: rest.losses.highest_pressure),
    "temperature": ThrustQuantity("K", lambda rest: rest.leaving_temperature, relative_rise),
}
"""Quantities of a collar at rest, by their names."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ThrustQuestion:
    """A question to the film of a thrust bearing.

    Attributes
    ----------
    table : ThrustTable
    speed : float [rad/s]
    row : ThrustQuantity
        Of the quantity.
    by_film : bool
        Whether the least film is given, not the load.
    """

    table: ThrustTable
    speed: float
    row: ThrustQuantity
    by_film: bool

    @property
    def is_warming(self) -> bool:
        """Whether an oil has the temperature of the balance of its heat."""
        return bool(self.table.one_side().is_warming)

    @cached_property
    def rest(self) -> Callable[..., ThrustRest]:
        """The collar at rest, by cells, level and carry-over: rungs judge each other by the same ones."""
        return cache(self._rest)

    def _rest(
        self, cells: tuple[int, int], level: HeatLevel = BALANCED, carry_over: float = -1.0
    ) -> ThrustRest:
        table: Any = replace(self.table, cells=cells)
        if carry_over >= 0.0:
            table = replace(table, cooling=replace(table.cooling, carry_over=carry_over))
        bearing = table.build()
        if self.is_warming and level is FRESH:
            bearing = bearing.at_temperature(bearing.cooled[1].supply_temperature)
        if self.by_film:
            return rest_at_film(bearing, self.table.smallest_film or 0.0, self.speed)
        return thrust_rest(bearing, self.table.load, self.speed)

    def distance(self, value: float, better: float) -> float:
        """Return the error of a value in the unit of the tolerance."""
        supply = self.table.one_side().cooled[1].supply_temperature if self.is_warming else 0.0
        return self.row.distance(value, better, supply)

    def grid_error(self, cells: tuple[int, int], level: HeatLevel, value: float) -> float:
        """Return the error by the grid: at most about what half as many cells change."""
        half = tuple(max(8, n // 2) for n in cells)
        if half == cells:
            return math.inf
        return self.distance(self.row.value(self.rest(half, level)), value)

    def heat_error(self, cells: tuple[int, int], level: HeatLevel) -> float:
        """Return the error of T0, or of T1, by what the balance of the heat changes."""
        fresh, warm = self.rest(cells, FRESH), self.rest(cells)
        change = self.distance(self.row.value(fresh), self.row.value(warm))
        if level is FRESH:
            return change
        lost = abs(math.log(fresh.sides[0].film_viscosity / warm.sides[0].film_viscosity))
        if self.row.distance is relative_rise:  # the rise follows from the load, not from the viscosity
            return 2.0 * THINNED * lost
        return max(HALF * change, THINNED * lost)

    def held(self) -> tuple[float, ThrustRest]:
        """Return the entry with all pads held in their tilts, and the rest."""
        assert self.row.entry is not None  # or there is no such rung
        rest, (matrix, motion) = self.rest(HELD_CELLS), self.row.entry
        place = rest.position, self.speed
        pairs = [one.held_coefficients(*place) for one in rest.sides if isinstance(one, TiltingThrustBearing)]
        return sum(float(pair[matrix == "damping"][motion, motion]) for pair in pairs), rest

    def carried(self, cells: tuple[int, int]) -> tuple[str, ...]:
        """Return how much it moves the answer what hot oil the next pad takes."""
        if not self.is_warming:
            return ()
        given = self.table.one_side().cooled[1].carry_over
        known, other = (self.row.value(self.rest(cells, BALANCED, one)) for one in (-1.0, OTHER_CARRY_OVER))
        change = self.distance(other, known)
        said = f"hot oil: a share of {given:g} is carried to the next pad"
        return (f"{said}; none would change it by {change:.1%}",)


def grid_rung(asked: ThrustQuestion, cells: tuple[int, int], level: HeatLevel) -> FunctionRung:
    """Return the answer on a grid, on fresh oil or in the balance of its heat."""
    warming = asked.is_warming
    plain = film_name(replace(asked.table, cells=cells).one_side()).removesuffix(", T1")
    name = f"{level.name}, {plain}" if warming else plain

    def ask(before: RungResult | None) -> tuple[float, ThrustRest]:
        rest = asked.rest(cells, level)
        return asked.row.value(rest), rest

    def judge(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        grid = asked.grid_error(cells, level, found.value)
        if not warming:
            return ErrorEstimate(grid, "half the cells", bound=True)
        heat = asked.heat_error(cells, level)
        how = "its balance" if level is FRESH else "half of what its balance changes"
        method = f"half the cells; heat: {how}, {heat:.2g}"
        return ErrorEstimate(grid + heat, method, bound=True, shared=heat)

    seconds = REST * cells[0] * cells[1] * (BALANCES if warming and level is BALANCED else 1)
    shares = level if warming else None
    return counted_rung(name, (level, cells), seconds, ask, judge, refines=(asked, level), shares=shares)


def held_rung(asked: ThrustQuestion) -> FunctionRung:
    """Return a stiffness or damping with all pads held, which is too stiff by about a half."""

    def judge(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        error = asked.distance(found.value, asked.row.value(found.solution))
        return ErrorEstimate(error, "pads that follow at the frequency of the speed")

    return counted_rung("held pads", "held pads", REST, lambda before: asked.held(), judge, prior=0.1)


def thrust_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a quantity of a thrust bearing.

    Raises
    ------
    InputError
        If the load is asked for and no least film is given, or the other way round; or a temperature of a
        viscosity that is given.
    """
    table: ThrustTable = scene.table("thrust")
    by_film = quantity == "thrust_load"
    if by_film and table.smallest_film is None:
        raise InputError(f"thrust.smallest_film is required for {quantity}, got none")
    asked = ThrustQuestion(table=table, speed=scene.speed, row=QUANTITIES[quantity], by_film=by_film)
    warming = asked.is_warming
    if quantity == "temperature" and not warming:
        raise InputError(
            f"lubricant must give the oil of the bearing for {quantity}, as a grade, got a viscosity of "
            f"{table.viscosity!r} Pa s"
        )
    if not by_film:
        _ = table.load
    grids = GRIDS if table.cells is None else (table.cells,)
    fresh = (FRESH,) if warming and quantity != "temperature" else ()
    rungs = [grid_rung(asked, cells, level) for level in (*fresh, BALANCED) for cells in grids]
    if table.tilts and asked.row.entry is not None and table.cells is None:
        rungs.insert(0, held_rung(asked))
    return Ladder(
        rungs=tuple(rungs),
        unit=asked.row.unit,
        remarks=_remarks(scene, asked, grids[0]),
        within=HEATED if warming else ISOTHERMAL,
        distance=asked.distance,
        assumptions=partial(asked.carried, grids[0]),
    )


def _remarks(scene: Scene, asked: ThrustQuestion, cells: tuple[int, int]) -> tuple[str, ...]:
    rest = asked.rest(cells)
    return (*oil_remarks(scene.tables, scene.lubricant), *thrust_remarks(rest, scene.lubricant.properties))


LADDERS = dict.fromkeys(QUANTITIES, thrust_ladder)
