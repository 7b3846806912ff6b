"""Film and approach of a rolling ball under a load that jumps or swings: at rest, reduced, in full."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...answers import ErrorEstimate, Found, Work, WorkUnit
from ...bearings.contact import FixedSteps
from ...errors import ConvergenceError, InputError
from ...ladders import BaseRung, Rung
from ...model import Array
from ...scenes.contact.contact_motions import ShakenBall, contact_motion
from ...scenes.contact.contact_rest import RestingFilms
from .contact_law_rung import LawRung
from .contact_slow import SlowRung

if TYPE_CHECKING:
    from ...scenes.scene import Scene

CELLS = (24, 32)
"""Cells along each side of the films that are followed; the smallest film takes the finer grid only."""

FINE = {24: 64, 32: 64}
"""Cells of the stationary film that tells what a motion's cells cost."""

STEPS, FINER = 36, 54
"""Steps over the shortest period on the coarsest grid, where their error is found, and on all others."""

SHORTEST, LONGEST_STEP = 0.02, 0.25
"""Range of the step of the coarsest grid [1]: the film smooths what is faster, and passes by in 2."""

STEP_ORDER = SPACE_ORDER = 2

MOST_STEPS = 4000
"""Steps beyond which no film is followed."""

NEWTON_TOLERANCE = 1e-5
"""To which the equations of a step are solved [1]."""

LARGEST_LOAD = 2.8
"""Load under which the dry contact nearly fills the rectangle, whose outlet is at 1.5 radii."""

LEFT = 0.5
"""Share of an extrapolation that may be wrong."""

RESOLVED = 0.03
"""Relative error of the film at rest by its cells from which a motion loses far more of it."""

SMALLEST_SUM = 0.35
"""Share of the errors' sizes below which their sum, with signs, is not trusted to fall."""


class Followed(NamedTuple):
    """The extreme of a motion and what it lacks by steps, cells and rectangle, relative to it.

    The last is the change of the smallest film from the coarser grid, more than its error; 0 for other
    quantities. Films are `resolved` if the cells matter little at rest, or can be told from two motions.
    """

    value: float
    steps: float
    cells: float
    rectangle: float
    jump: float
    resolved: bool

    @property
    def lacking(self) -> float:
        """All that it lacks."""
        return self.steps + self.cells + self.rectangle

    @property
    def error(self) -> float:
        """Relative error."""
        sizes = abs(self.steps) + abs(self.cells) + abs(self.rectangle)
        return max(abs(self.lacking), SMALLEST_SUM * sizes, self.jump)

    @property
    def left(self) -> float:
        """Relative error where what lacks is added, chosen to overestimate."""
        return LEFT * (abs(self.steps) + abs(self.cells) + abs(self.rectangle)) + 0.5 * self.jump


@dataclass(frozen=True, kw_only=True)
class FollowedFilm:
    """The full film over time, each run made once.

    Attributes
    ----------
    films : RestingFilms
    shaken : ShakenBall
    runs : dict
        Extremes of the quantity and the approach [1], by cells and steps over a period.
    """

    films: RestingFilms
    shaken: ShakenBall
    runs: dict[tuple[int, float], tuple[float, float]] = field(default_factory=dict, compare=False)

    def step(self, steps: int) -> float:
        """Return a step [1], so many over the shortest period."""
        period = np.clip(self.shaken.shortest_period, SHORTEST * STEPS, LONGEST_STEP * STEPS)
        return float(period / steps)

    def extreme(self, cells: int, steps: int, work: dict[WorkUnit, int]) -> tuple[float, float]:
        """Return the smallest value of the quantity and of the approach over the motion [1].

        Raises
        ------
        ConvergenceError
            If the film breaks down.
        """
        key = (cells, steps)
        if key not in self.runs:
            self.runs[key] = (math.nan, math.nan)
            contact = self.films.contact(cells)
            run = contact.simulate(
                contact.stationary(),
                duration=self.shaken.duration,
                W=self.films.ball.W,
                load=self.shaken.load,
                control=FixedSteps(step=self.step(steps), tolerance=NEWTON_TOLERANCE),
            )
            work[newton(cells)] = work.get(newton(cells), 0) + run.work["newton"]
            smallest = lowest(run.time, getattr(run, self.films.field))
            self.runs[key] = smallest, lowest(run.time, run.delta)
        if math.isnan(self.runs[key][0]):
            raise ConvergenceError(f"a motion must be solvable on {cells} x {cells} cells, got none before")
        return self.runs[key]

    def step_error(self, steps: int, work: dict[WorkUnit, int]) -> float:
        """Return what the value lacks by the steps, from longer ones on the coarsest grid that can."""
        for cells, (fine, rough) in product(CELLS, ((STEPS, STEPS // 2), (FINER, STEPS))):
            try:
                value, other = (self.extreme(cells, n, work)[0] for n in (fine, rough))
            except ConvergenceError:
                continue
            ratio = (self.step(steps) / self.step(fine)) ** STEP_ORDER
            longer = (self.step(rough) / self.step(fine)) ** STEP_ORDER
            return ratio * (value - other) / max(longer - 1.0, 1.0) / value
        raise ConvergenceError("longer steps must have a motion, got none on any grid")

    def parts(self, cells: int, work: dict[WorkUnit, int]) -> Followed:
        """Return the extreme on so many cells, and what it lacks; the cells and the rectangle cost at rest.

        Raises
        ------
        ConvergenceError
            If the film breaks down, or has no stationary companion.
        """
        steps = steps_on(cells)
        value, deepest = self.extreme(cells, steps, work)
        load = self.equivalent_load(cells, deepest, work)
        fine = FINE[cells]
        rest, better = (self.films.value(n, work, load=load) for n in (cells, fine))
        lacking = (better - rest) / (1.0 - (cells / fine) ** 2)
        far = load if self.films.quantity == "approach" else 0.5 * (1.0 + load)
        reach = self.films.beyond(work, far) / self.films.value(cells, work, load=far)
        by_steps, by_cells = self.step_error(steps, work), lacking / rest
        resolved, jump = abs(by_cells) < RESOLVED, 0.0
        change = self._change(cells, work)
        if change is not None:
            ratio = (cells / CELLS[0]) ** SPACE_ORDER - 1.0
            by_cells = max(by_cells, change / ratio, key=abs)
            resolved, jump = True, abs(change) if self.films.quantity == "minimum_film" else 0.0
        return Followed(value, by_steps, by_cells, reach, jump, resolved)

    def _change(self, cells: int, work: dict[WorkUnit, int]) -> float | None:
        """Return the relative change from the coarsest grid, without errors by steps, if it has a motion."""
        if cells == CELLS[0]:
            return None
        try:
            rough, fine = (
                self.extreme(n, steps_on(n), work)[0] * (1.0 + self.step_error(steps_on(n), work))
                for n in (CELLS[0], cells)
            )
        except ConvergenceError:
            return None
        return 1.0 - rough / fine

    def equivalent_load(self, cells: int, deepest: float, work: dict[WorkUnit, int]) -> float:
        """Return the load whose contact at rest is as deep, as of a dry contact."""
        rest = RestingFilms(table=self.films.table, quantity="approach").value(cells, work)
        return min(max((deepest / rest) ** 1.5, 1.0), LARGEST_LOAD)

    @cached_property
    def too_long(self) -> bool:
        """Whether the motion takes more than the film can be followed for."""
        return self.shaken.duration / self.step(FINER) > MOST_STEPS


@dataclass(frozen=True, kw_only=True)
class FilmMotionRung(BaseRung):
    """The full film over time on one grid.

    Attributes
    ----------
    followed : FollowedFilm
        The film over time.
    cells : int
        Along each side.
    extrapolated : bool
        Whether the errors that are known are taken off.
    """

    followed: FollowedFilm
    cells: int
    extrapolated: bool = False

    @property
    def name(self) -> str:
        """Cells of the grid."""
        return f"film {self.cells} x {self.cells} over time{', extr.' if self.extrapolated else ''}"

    def answer(self, before: Found | None) -> Found:
        """Return the smallest value over the motion [m]."""
        if self.followed.too_long:
            raise InputError(
                f"excitation must take at most {MOST_STEPS} steps of a film over time, got "
                f"{self.followed.shaken.duration / self.followed.step(FINER):.4g}"
            )
        work: dict[WorkUnit, int] = {}
        scale = self.followed.films.ball.film_scale
        if not self.extrapolated:
            value, _ = self.followed.extreme(self.cells, steps_on(self.cells), work)
            return Found(value * scale, work)
        parts = self.followed.parts(self.cells, work)
        value = parts.value * (1.0 + parts.lacking)
        return Found(value * scale, work, parts)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the increments of steps, cells and rectangle; of an extrapolation a share.

        That of the smallest film, which jumps from cell to cell, is overestimated.
        """
        work: dict[WorkUnit, int] = {}
        try:
            parts = self.followed.parts(self.cells, work)
        except ConvergenceError as error:
            return ErrorEstimate(1.0, "order increments", work, doubt=f"no companion: {error}")
        method = "order increments of steps; of cells and rectangle at rest"
        deep = self.followed.extreme(self.cells, steps_on(self.cells), work)[1] < -2.0 * LARGEST_LOAD ** (
            2.0 / 3.0
        )
        doubt = "the contact grows beyond the rectangle" if deep else ""
        if not parts.resolved:
            doubt = f"too thin a film for {self.cells} x {self.cells} cells, and no coarser motion beside it"
        if self.extrapolated:
            method = f"overestimated: {LEFT:.0%} of the {method}"
            return ErrorEstimate(parts.left, method, work, bound=True, doubt=doubt)
        bound = self.followed.films.quantity == "minimum_film"
        method = f"overestimated: {method}, whole change of cells" if bound else method
        return ErrorEstimate(parts.error, method, work, bound, doubt)

    def expected(self, done: Work) -> Work:
        """Return some Newton steps: about three for each step."""
        steps = self.followed.shaken.duration / self.followed.step(steps_on(self.cells))
        return {newton(self.cells): 3 * math.ceil(steps)}


def steps_on(cells: int) -> int:
    """Return the steps over a period on a grid."""
    return STEPS if cells == CELLS[0] else FINER


def lowest(time: Array, values: Array) -> float:
    """Return the smallest value of a series, by the parabola through three samples around it."""
    k = int(np.argmin(values))
    if k in (0, len(values) - 1):
        return float(values[k])
    (before, after), value = time[[k - 1, k + 1]] - time[k], values[k]
    slopes = (values[[k - 1, k + 1]] - value) / np.array([before, after])
    curvature = (slopes[1] - slopes[0]) / (after - before)
    slope = slopes[0] - curvature * before
    return float(value - 0.25 * slope**2 / curvature) if curvature > 0.0 else float(value)


def newton(cells: int) -> WorkUnit:
    """Return the unit of a Newton step."""
    return WorkUnit(f"Newton steps on {cells} x {cells} cells", ("Newton steps", cells))


def motion_rungs(scene: Scene, films: RestingFilms) -> tuple[Rung, ...]:
    """Return the rungs of a ball whose load jumps or swings."""
    shaken = contact_motion(scene)
    followed = FollowedFilm(films=films, shaken=shaken)
    slow = SlowRung(films=films, shaken=shaken)
    law = () if films.quantity != "approach" else (LawRung(films=films, shaken=shaken),)
    first = 1 if films.quantity == "minimum_film" else 0
    grids = tuple(FilmMotionRung(followed=followed, cells=cells) for cells in CELLS[first:])
    return (slow, *law, *grids, FilmMotionRung(followed=followed, cells=CELLS[-1], extrapolated=True))
