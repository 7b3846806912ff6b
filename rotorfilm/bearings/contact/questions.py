"""What rolling balls bring to scenes and questions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...core.answers import DISAGREEMENT, ISOTHERMAL, ErrorEstimate, Ladder, RungResult, Work, WorkUnit
from ...core.errors import ConvergenceError, InputError
from ...core.model import Array
from ...questions.variants import FunctionRung
from .. import contact as contacts
from .table import (
    INLETS,
    OUTLET,
    QUANTITIES,
    SPACINGS,
    DrivenBall,
    StaticContactFilms,
    contact_motion,
    contact_remarks,
    natural_frequency,
    unknowns,
)

if TYPE_CHECKING:
    from ...scenes.scene import Scene

# Film and approach of a rolling ball at rest: a formula, ever finer grids, and the rectangle around them.


CELLS = (32, 48, 64)
"""Cells along each side of the plain rungs."""

COARSER = {32: 24, 48: 32, 64: 48}
"""Cells of the companion that an order increment takes."""

FORMULA_RANGE = ((0.008, 0.4), (2.0, 18.0))
"""V and Q0 in which the bounds of the formulas were measured, on random balls (docs/contact.md)."""

HARD = (0.08, 12.0)
"""V and Q0 above both of which Newton's method needs continuation on fine grids: the longest is left out."""

DENSE = (96, 64)
"""Cells along each side of the shortest rectangle from which an unbounded film is extrapolated."""

FORMULAS = WorkUnit("formulas")

LEFT = 0.3
"""Share of an extrapolation that may be wrong."""


def contact_rung(
    films: StaticContactFilms,
    name: str,
    answer: Callable[[dict[WorkUnit, int]], tuple[float, Any]],
    judge: Callable[[Any, dict[WorkUnit, int]], ErrorEstimate],
    expected: Callable[[], Work],
    *,
    companion: str = "order increments",
    failures: tuple[type[Exception], ...] = (ConvergenceError,),
) -> FunctionRung:
    """Return a rung of a quantity [m].

    Parameters
    ----------
    films : StaticContactFilms
    name : str
    answer : callable
        Adds to the work, and returns the quantity [1] and what its estimate starts from.
    judge : callable
        Takes that and the work, and returns the error.
    expected : callable
        Returns the work of an answer.
    companion : str
        What the error is told by.
    failures : tuple of type
        Errors of the companion, after which nothing tells the error.
    """

    def answered(before: RungResult | None) -> RungResult:
        work: dict[WorkUnit, int] = {}
        value, solution = answer(work)
        return RungResult(value * films.ball.film_scale, work, solution)

    def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        work: dict[WorkUnit, int] = {}
        try:
            return judge(found.solution, work)
        except failures as error:
            return ErrorEstimate(1.0, companion, work, doubt=f"no companion: {error}")

    return FunctionRung(name=name, answer=answered, estimate=estimate, expected=lambda _: expected())


def formula_rung(films: StaticContactFilms, bound: float) -> FunctionRung:
    """Return the film of Nijenbanning, Venner and Moes (1994); the dry contact's approach with it between.

    The dry contact has the approach -2, in Hertzian units. The bound was measured in `FORMULA_RANGE`.
    """
    ball = films.ball

    def answer(before: RungResult | None) -> RungResult:
        film, dry = ball.published_films.nijenbanning_venner_moes, 2.0 * ball.film_scale
        return RungResult(film if films.quantity == "central_film" else film - dry, {FORMULAS: 1})

    def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        inside = all(
            low <= x <= high for (low, high), x in zip(FORMULA_RANGE, (ball.V, ball.Q0), strict=True)
        )
        doubt = "" if inside else f"V = {ball.V:.3g}, Q0 = {ball.Q0:.3g} are outside of its measured range"
        return ErrorEstimate(bound, "measured bound of the formula", bound=True, doubt=doubt)

    name = "formula of Nijenbanning et al."
    return FunctionRung(name=name, answer=answer, estimate=estimate, expected=lambda _: {FORMULAS: 1})


def grid_rung(films: StaticContactFilms, cells: int) -> FunctionRung:
    """Return a stationary contact on cells x cells of the shortest rectangle.

    Its error is the order increment from less cells, and that from two rectangles on coarse grids. A film
    that jumps from cell to cell has the whole increment, which overestimates.
    """
    bound = films.row.jumps

    def judge(_: object, work: dict[WorkUnit, int]) -> ErrorEstimate:
        about = grid_error(films, cells, work) + rectangle_error(films, work)
        doubt = "the grids disagree on the film: it is too thin for them" if bound and about > 0.5 else ""
        how = "overestimated: whole increment of cells, order increment of rectangle"
        method = how if bound else "order increments of cells and rectangle"
        return ErrorEstimate(about, method, work, bound, doubt)

    return contact_rung(
        films,
        f"grid {cells} x {cells}",
        lambda work: (films.value(cells, work), None),
        judge,
        lambda: {unknowns(cells): cells**2},
    )


def unbounded_rung(films: StaticContactFilms, place: int, cells: int) -> FunctionRung:
    """Return a grid of the finest of `SPACINGS` on a longer rectangle, extrapolated to an infinite one.

    `place` is that of the rectangle in `INLETS`. The error is a share of both extrapolations, in the length
    of the rectangle and in the cells, chosen to overestimate what is wrong with them.
    """

    def answer(work: dict[WorkUnit, int]) -> tuple[float, Any]:
        short, longer = INLETS[place - 1 : place + 1]
        wide = films.value(cells, work, longer)
        before_it = films.value(round(SPACINGS[-1] * (short + OUTLET)), work, short)
        reach = (wide - before_it) / ((longer / short) ** films.row.reach - 1.0)
        fine, coarse = (films.value(count, work) for count in DENSE)
        spacing = (fine - coarse) / (1.0 - (DENSE[1] / DENSE[0]) ** 2)
        value = wide + reach + spacing
        return value, (abs(reach / value), abs(spacing / value))

    def judge(parts: tuple[float, float], work: dict[WorkUnit, int]) -> ErrorEstimate:
        error = max(LEFT * sum(parts), noise_of(films, DENSE[0]))
        return ErrorEstimate(error, f"overestimated: {LEFT:.0%} of the extrapolations", bound=True)

    return contact_rung(
        films,
        f"grid {cells} x {cells}, unbounded",
        answer,
        judge,
        lambda: {unknowns(cells): cells**2, unknowns(DENSE[0]): DENSE[0] ** 2},
    )


def grid_error(films: StaticContactFilms, cells: int, work: dict[WorkUnit, int]) -> float:
    """Return the relative error of a quantity by the cells, from less of them; more of the smallest film.

    Raises
    ------
    ConvergenceError
        If there is no solution on less cells.
    """
    coarse = COARSER[cells]
    fine, rough = (films.value(n, work) for n in (cells, coarse))
    gain = 1.0 if films.row.jumps else (cells / coarse) ** films.contact(cells).scheme.order - 1.0
    return max(abs(fine - rough) / gain / abs(fine), noise_of(films, cells))


def noise_of(films: StaticContactFilms, cells: int) -> float:
    """Return the relative error below which an increment says nothing."""
    return films.row.noise * (CELLS[0] / cells) ** (1.5 if films.row.jumps else 2)


def rectangle_error(films: StaticContactFilms, work: dict[WorkUnit, int]) -> float:
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
    table = scene.required("contact", quantity)
    films = StaticContactFilms(table=table, quantity=quantity)
    remarks = contact_remarks(
        films.ball, scene.lubricant.properties, roelands=table.roelands, compressible=table.compressible
    )
    if scene.excitation is not None:
        return Ladder(rungs=motion_rungs(scene, films), unit="m", remarks=remarks, within=ISOTHERMAL)
    rungs = [] if films.row.formula_bound is None else [formula_rung(films, films.row.formula_bound)]
    rungs += [grid_rung(films, cells) for cells in CELLS]
    hard = HARD[0] < films.ball.V and HARD[1] < films.ball.Q0
    rungs += [unbounded_rung(films, *wide) for wide in ((1, 96), (2, 160))[: 1 if hard else 2]]
    return Ladder(rungs=tuple(rungs), unit="m", remarks=remarks, within=ISOTHERMAL)


LADDERS = {**dict.fromkeys(QUANTITIES, contact_ladder)}


# The approach of a rolling ball on its reduced law, over time.


LAW_CELLS, LAW_FINE = 32, 64
"""Cells along each side of the film that the law is made of, and of a finer one that tells its error."""

RIDE, LAW = WorkUnit("motions on a reduced law"), WorkUnit("reduced laws")

ELSEWHERE = 0.7
"""Where between rest and the extreme load a second law is made, of which the difference tells the error."""


def law_rung(films: StaticContactFilms, shaken: DrivenBall) -> FunctionRung:
    """Return the deepest approach of a motion on the reduced law of the contact under its static load.

    Its error is that of grid and rectangle at rest, of the fit, and of the law's one load.
    """
    order = films.table.order
    least, most = shaken.extremes
    far = most if most > 1.0 else least
    elsewhere = 1.0 + ELSEWHERE * (max(far, 0.3) - 1.0)

    def answer(work: dict[WorkUnit, int]) -> tuple[float, Any]:
        mass = films.table.mass
        if not mass > 0.0:
            raise InputError(f"contact.mass must be positive for a motion on a reduced law, got {mass!r} kg")
        law = contacts.reduce_contact(films.contact(LAW_CELLS), order)
        work |= {LAW: 1, RIDE: 1}
        deepest, carried = ridden(films, shaken, law)
        return deepest, (law, deepest, carried)

    def judge(solution: Any, work: dict[WorkUnit, int]) -> ErrorEstimate:
        law, deepest, carried = solution
        load = min(max((deepest / law.operating) ** 1.5, 1.0), law.load_range[1])
        lacking = films.lacking(LAW_CELLS, LAW_FINE, work, load)
        other = contacts.reduce_contact(films.contact(LAW_CELLS), order, load=elsewhere)
        moved = abs(ridden(films, shaken, other)[0] - deepest) / abs(deepest)
        fit = law.static_error / law.exponent
        work |= {LAW: 1, RIDE: 1}
        method = "order increments at rest; law about another load"
        doubt = doubt_of_law(films, shaken, law, carried)
        return ErrorEstimate(lacking + fit + moved, method, work, doubt=doubt)

    return contact_rung(
        films,
        "reduced law over time",
        answer,
        judge,
        lambda: {LAW: 1, RIDE: 1},
        companion="law about another load",
    )


def ridden(
    films: StaticContactFilms, shaken: DrivenBall, law: contacts.ContactLaw
) -> tuple[float, tuple[float, float]]:
    """Return the deepest approach on a law and the range of the force, in the units of the contact."""
    motion = contacts.ball_transient(
        law,
        mass=films.ball.W / contacts.HERTZ_LOAD,
        load=shaken.load,
        start=float(law.approach(1.0)),
        duration=shaken.duration,
    )
    force = motion["force_z"]
    return float(motion["z"].min()), (float(force.min()), float(force.max()))


def doubt_of_law(
    films: StaticContactFilms, shaken: DrivenBall, law: contacts.ContactLaw, carried: tuple[float, float]
) -> str:
    """Return why a law must not be trusted that has carried loads in this range; empty if it may."""
    low, high = law.load_range
    if carried[0] < low or carried[1] > high:
        return f"the force, {carried[0]:.2g} to {carried[1]:.2g} static loads, leaves the range of the law"
    fastest = natural_frequency(films.ball.W)
    if isinstance(shaken.load, contacts.SineLoad):
        fastest = max(fastest, shaken.load.frequency)
    if fastest > law.highest_frequency:
        return f"the law reaches to the frequency {law.highest_frequency:g}, not to {fastest:.3g}"
    return ""


# Film and approach of a rolling ball under a load that jumps or swings: at rest, reduced, in full.


MOTION_CELLS = (24, 32)
"""Cells along each side of the films that are followed; the smallest film takes the finer grid only."""

MOTION_FINE = {24: 64, 32: 64}
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

MOTION_LEFT = 0.5
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
        return MOTION_LEFT * (abs(self.steps) + abs(self.cells) + abs(self.rectangle)) + 0.5 * self.jump


@dataclass(frozen=True, kw_only=True)
class FollowedFilm:
    """The full film over time, each run made once.

    Attributes
    ----------
    films : StaticContactFilms
    shaken : DrivenBall
        The load over time.
    runs : dict
        Extremes of the quantity and the approach [1], by cells and steps over a period.
    """

    films: StaticContactFilms
    shaken: DrivenBall
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
                control=contacts.FixedSteps(step=self.step(steps), tolerance=NEWTON_TOLERANCE),
            )
            work[newton(cells)] = work.get(newton(cells), 0) + run.work["newton"]
            smallest = lowest(run.time, getattr(run, self.films.row.field))
            self.runs[key] = smallest, lowest(run.time, run.delta)
        if math.isnan(self.runs[key][0]):
            raise ConvergenceError(f"no motion was found on {cells} x {cells} cells")
        return self.runs[key]

    def step_error(self, steps: int, work: dict[WorkUnit, int]) -> float:
        """Return what the value lacks by the steps, from longer ones on the coarsest grid that can."""
        for cells, (fine, rough) in product(MOTION_CELLS, ((STEPS, STEPS // 2), (FINER, STEPS))):
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
        fine = MOTION_FINE[cells]
        rest, better = (self.films.value(n, work, load=load) for n in (cells, fine))
        lacking = (better - rest) / (1.0 - (cells / fine) ** 2)
        far = load if self.films.quantity == "approach" else 0.5 * (1.0 + load)
        reach = self.films.beyond(work, far) / self.films.value(cells, work, load=far)
        by_steps, by_cells = self.step_error(steps, work), lacking / rest
        resolved, jump = abs(by_cells) < RESOLVED, 0.0
        change = self._change(cells, work)
        if change is not None:
            ratio = (cells / MOTION_CELLS[0]) ** SPACE_ORDER - 1.0
            by_cells = max(by_cells, change / ratio, key=abs)
            resolved, jump = True, abs(change) if self.films.row.jumps else 0.0
        return Followed(value, by_steps, by_cells, reach, jump, resolved)

    def _change(self, cells: int, work: dict[WorkUnit, int]) -> float | None:
        """Return the relative change from the coarsest grid, without errors by steps, if it has a motion."""
        if cells == MOTION_CELLS[0]:
            return None
        try:
            rough, fine = (
                self.extreme(n, steps_on(n), work)[0] * (1.0 + self.step_error(steps_on(n), work))
                for n in (MOTION_CELLS[0], cells)
            )
        except ConvergenceError:
            return None
        return 1.0 - rough / fine

    def equivalent_load(self, cells: int, deepest: float, work: dict[WorkUnit, int]) -> float:
        """Return the load whose contact at rest is as deep, as of a dry contact."""
        rest = StaticContactFilms(table=self.films.table, quantity="approach").value(cells, work)
        return min(max((deepest / rest) ** 1.5, 1.0), LARGEST_LOAD)


def film_rung(followed: FollowedFilm, cells: int, *, extrapolated: bool = False) -> FunctionRung:
    """Return the smallest value over the motion of the full film on one grid.

    Its error are the increments of steps, cells and rectangle; where it is `extrapolated`, without the errors
    that are known, a share of them. That of a film that jumps from cell to cell is overestimated.
    """
    films, steps = followed.films, steps_on(cells)

    def duration(count: int) -> float:
        return followed.shaken.duration / followed.step(count)

    def answer(work: dict[WorkUnit, int]) -> tuple[float, Any]:
        if duration(FINER) > MOST_STEPS:
            raise InputError(
                f"excitation must take at most {MOST_STEPS} steps of a film over time, got "
                f"{duration(FINER):.4g}"
            )
        if not extrapolated:
            return followed.extreme(cells, steps, work)[0], None
        parts = followed.parts(cells, work)
        return parts.value * (1.0 + parts.lacking), None

    def judge(_: object, work: dict[WorkUnit, int]) -> ErrorEstimate:
        parts = followed.parts(cells, work)
        method = "order increments of steps; of cells and rectangle at rest"
        deep = followed.extreme(cells, steps, work)[1] < -2.0 * LARGEST_LOAD ** (2.0 / 3.0)
        doubt = "the contact grows beyond the rectangle" if deep else ""
        if not parts.resolved:
            doubt = f"too thin a film for {cells} x {cells} cells, and no coarser motion beside it"
        if extrapolated:
            method = f"overestimated: {MOTION_LEFT:.0%} of the {method}"
            return ErrorEstimate(parts.left, method, work, bound=True, doubt=doubt)
        bound = films.row.jumps
        method = f"overestimated: {method}, whole change of cells" if bound else method
        return ErrorEstimate(parts.error, method, work, bound, doubt)

    return contact_rung(
        films,
        f"film {cells} x {cells} over time{', extr.' if extrapolated else ''}",
        answer,
        judge,
        lambda: {newton(cells): 3 * math.ceil(duration(steps))},  # about three for each step
    )


def steps_on(cells: int) -> int:
    """Return the steps over a period on a grid."""
    return STEPS if cells == MOTION_CELLS[0] else FINER


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


def motion_rungs(scene: Scene, films: StaticContactFilms) -> tuple[FunctionRung, ...]:
    """Return the rungs of a ball whose load jumps or swings."""
    shaken = contact_motion(scene)
    followed = FollowedFilm(films=films, shaken=shaken)
    law = (law_rung(films, shaken),) if films.quantity == "approach" else ()
    grids = (film_rung(followed, cells) for cells in MOTION_CELLS[1 if films.row.jumps else 0 :])
    extrapolated = film_rung(followed, MOTION_CELLS[-1], extrapolated=True)
    return (slow_rung(films, shaken), *law, *grids, extrapolated)


# A rolling ball under a load so slow that the film is at rest at each moment.


SLOW_CELLS, SLOW_FINE = 48, 64
"""Cells along each side of the film at rest, and of a finer one that tells its error."""

SMALL = 32
"""Cells of the linearized film."""

REST = 1e-6
"""Frequency that stands for rest."""

SLACKEST = 0.05
"""Load below which there is no contact at rest to speak of."""


def slow_rung(films: StaticContactFilms, shaken: DrivenBall) -> FunctionRung:
    """Return the extreme of a quantity over the loads, as if each had acted for long.

    Of the approach it is always that of the largest load. The error is that of grid and rectangle, and what
    the linearized film makes of the motion: overestimated for a small one, since amplitudes are added
    whatever their phases.
    """
    least, most = shaken.extremes

    def answer(work: dict[WorkUnit, int]) -> tuple[float, Any]:
        loads = [most] if films.quantity == "approach" else [max(least, SLACKEST), most]
        values = {load: films.value(SLOW_CELLS, work, load=load) for load in loads}
        load = min(values, key=lambda load: values[load])
        return values[load], load

    def judge(load: float, work: dict[WorkUnit, int]) -> ErrorEstimate:
        lacking = films.lacking(SLOW_CELLS, SLOW_FINE, work, load)
        moved = abs(small_motion(films, shaken) / films.value(SLOW_CELLS, work, load=load))
        work[unknowns(SMALL)] = SMALL**2
        doubt = "the ball swings: no small motion about rest" if moved > DISAGREEMENT else ""
        if least < SLACKEST:
            doubt = "the ball leaves the film"
        method = "overestimated: order increments; amplitudes of the linearized film, whatever their phases"
        return ErrorEstimate(lacking + moved, method, work, bound=True, doubt=doubt)

    return contact_rung(
        films,
        "at rest under the extreme load",
        answer,
        judge,
        lambda: {unknowns(SLOW_CELLS): 2 * SLOW_CELLS**2},
        companion="linearized film",
        failures=(ConvergenceError, InputError),
    )


def small_motion(films: StaticContactFilms, shaken: DrivenBall) -> float:
    """Return how far the quantity goes beyond that at rest, by the linearized film [1]."""
    contact = films.contact(SMALL)
    state = contact.stationary()
    small = contacts.SmallMotion(contact.equations, state.pressure.ravel(), state.delta)
    thinnest = int(np.argmin(contact.equations.film(state.pressure.ravel(), state.delta)))
    inertia = films.ball.W

    def per_load(w: float) -> tuple[complex, complex]:
        """Return the changes of quantity and approach per unit of a load as exp(i w t)."""
        approach = -contacts.HERTZ_LOAD / (small.stiffness(1j * w) - inertia * w**2)
        if films.quantity == "approach":
            return approach, approach
        central, samples = small.film(1j * w)
        return approach * (central if films.quantity == "central_film" else samples[thinnest]), approach

    amplitude, natural = abs(shaken.load.amplitude), natural_frequency(inertia)
    still, depth = per_load(REST)
    rings = 0.0
    if math.isfinite(natural):
        ringing, ring_depth = per_load(natural)
        rings = abs(ringing / ring_depth * depth)
    if not isinstance(shaken.load, contacts.SineLoad):
        return amplitude * rings
    w = shaken.load.frequency
    forced = abs(per_load(w)[0])
    ratio = w / natural
    started = rings * ratio / max(abs(1.0 - ratio**2), 0.1)
    return amplitude * abs(forced + started - abs(still))
