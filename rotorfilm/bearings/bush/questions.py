"""What polymer bushes bring to scenes and questions: the speed at which they melt, and how they wear."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...analysis.equal_steps import scalar_drift
from ...core.answers import DISAGREEMENT, ErrorEstimate, Ladder, RungResult, Work, WorkUnit
from ...core.errors import ConvergenceError, FilmContactError, InputError, RotorfilmError
from ...core.model import Array
from ...questions.variants import FunctionRung
from ...scenes.families import messages, remarks_of
from ...scenes.shared_tables import StepLoadTable
from .. import bush as bushes

if TYPE_CHECKING:
    from ...scenes.scene import Scene

# At which speed a polymer bush melts: the heat into the shaft in closed form, then exact.


EXACT_ERROR = 2e-7
"""Verified error of the exact flux: docs/accuracy.md."""

CLOSED_ERROR = 1e-3
"""Order of magnitude of the error of its closed form."""


def speed_rung(bush: bushes.MeltingBush, load: float) -> FunctionRung:
    """Return the critical speed [rad/s] of the unworn bush under a load [N], by its heat into the shaft."""
    is_exact = isinstance(bush.shaft_heat, bushes.ExactShaft)
    unit, exact = (
        WorkUnit(f"fluxes into the shaft, {name}", ("fluxes", name))
        for name in ("exact" if is_exact else FLUX, "exact")
    )

    def answer(before: RungResult | None) -> RungResult:
        at = bush.contact(load)
        return RungResult(at.critical_speed, {unit: 1}, at)

    def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return what the exact flux would change: the speed goes with the heat into shaft and liner."""
        if is_exact:
            return ErrorEstimate(EXACT_ERROR, "verified bound of the flux", bound=True)
        at = found.solution
        change = (
            float(replace(bush, shaft_heat=bushes.ExactShaft()).shaft_flux(at.contact_angle)) - at.shaft_flux
        )
        error = abs(change) / (at.shaft_flux + change + at.liner_flux)
        return ErrorEstimate(error, "defect of the exact flux", {exact: 1})

    return FunctionRung(
        name="exact" if is_exact else FLUX,
        answer=answer,
        estimate=estimate,
        expected=lambda _: {unit: 1},
        prior=0.0 if is_exact else CLOSED_ERROR,
    )


FLUX = "closed form of the flux"


def bush_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the speed at which a bush melts.

    Raises
    ------
    InputError
        If the scene has no bush.
    """
    bush, load = scene.required("bush", quantity).build(), math.hypot(*scene.static_load)
    shafts = (bushes.ApproximateShaft(), bushes.ExactShaft())
    rungs = tuple(speed_rung(replace(bush, shaft_heat=shaft), load) for shaft in shafts)
    return Ladder(rungs=rungs, unit="rad/s")


# The run that a bush wears in: what all rungs of its wear start from.


PARALLEL = 1e-12
"""Largest sine of the angle between a step of load and the static load."""


@dataclass(frozen=True, kw_only=True)
class BushRun:
    """A bush, its speed, and the stages of its load.

    Attributes
    ----------
    bush : MeltingBush
        Liner and shaft, unworn.
    rule : MeltingRule
        How melting spreads over the contact.
    melting_heat : float [J/m3]
    speed : float [rad/s]
    stages : tuple of Stage
        Times of constant load.
    """

    bush: bushes.MeltingBush
    rule: bushes.MeltingRule
    melting_heat: float
    speed: float
    stages: tuple[bushes.Stage, ...]

    @property
    def radius(self) -> float:
        """Radius of the liner [m]."""
        return self.bush.geometry.radius

    @property
    def grows(self) -> bool:
        """Whether the load never falls."""
        return all(
            later.load_ratio >= sooner.load_ratio
            for sooner, later in zip(self.stages, self.stages[1:], strict=False)
        )

    @property
    def local(self) -> bool:
        """Whether each point melts by its own balance."""
        return isinstance(self.rule, bushes.LocalMelting)

    @cached_property
    def exact(self) -> bushes.Wearing:
        """With the exact heat into the shaft."""
        return self._wearing(bushes.ExactShaft())

    @cached_property
    def closed(self) -> bushes.Wearing:
        """With the closed form of the heat into the shaft."""
        return self._wearing(bushes.ApproximateShaft())

    def _wearing(self, shaft_heat: bushes.ShaftHeat) -> bushes.Wearing:
        bush = replace(self.bush, shaft_heat=shaft_heat)
        return bushes.Wearing(bush.law, self.speed, self.melting_heat * self.radius)

    def margin(self, bush: bushes.Wearing) -> float:
        """Return speed / critical speed - 1 of the unworn bush, the largest of all stages.

        Where each point melts by itself the largest pressure decides, otherwise the mean.
        """
        margins = []
        for stage in self.stages:
            alpha = bush.angle(0.0, stage.load_ratio)
            weight = bushes.peak_weight(alpha) if self.local else bushes.mean_weight(alpha)
            margins.append(bush.work * stage.load_ratio * float(weight) / float(bush.losses(alpha)) - 1.0)
        return max(margins)

    @property
    def stays_cold(self) -> bool:
        """Whether an unworn contact that would melt may also rest below the melting point."""
        law, load = self.exact.law, self.stages[0].load_ratio
        alpha = float(self.exact.angle(0.0, load))
        melts = float(self.exact.surplus(np.asarray(alpha), self.exact.shaped_total(np.asarray(alpha), load)))
        return melts > 0.0 and law.steady_temperature(alpha, load, self.speed) < law.melting

    def require_liner(self, worn: float) -> float:
        """Return the wear [m] if it leaves some of the liner.

        Raises
        ------
        FilmContactError
            If the shaft settles by the thickness of the liner.
        """
        load = self.stages[-1].load_ratio * self.bush.force_unit
        settled = worn + float(self.bush.settlement(self.bush.contact_angle(load)))
        thickness = self.bush.geometry.outer_radius - self.radius
        if settled >= thickness:
            raise FilmContactError(
                f"settlement must be below the thickness of the liner {thickness:.6g} m, got {settled:.6g} m"
            )
        return worn


def bush_run(scene: Scene, quantity: str) -> BushRun:
    """Return the run of a scene.

    Raises
    ------
    InputError
        If the scene has no bush, no load, does not turn, or its load does not keep its direction.
    """
    table = scene.required("bush", quantity)
    if scene.speed == 0.0:
        raise InputError(f"operation.speed must not be zero for {quantity}, got 0.0")
    load = math.hypot(*scene.static_load)
    if load == 0.0:
        raise InputError(f"operation.load must not be zero for {quantity}, got 0.0")
    bush = table.build()
    return BushRun(
        bush=bush,
        rule=table.melting,
        melting_heat=table.melting_heat,
        speed=scene.speed,
        stages=tuple(bushes.Stage(t, force / bush.force_unit) for t, force in _stages(scene, load, quantity)),
    )


def _stages(scene: Scene, load: float, quantity: str) -> list[tuple[float, float]]:
    """Return duration [s] and load [N] of the stages."""
    step, end = scene.excitation, scene.duration
    if step is None:
        return [(end, load)]
    if not isinstance(step, StepLoadTable):
        raise InputError(f'excitation.kind must be "step" for {quantity}, got {type(step).__name__}')
    (x, y), (fx, fy) = scene.static_load, step.load
    size = math.hypot(fx, fy)
    if abs(x * fy - y * fx) > PARALLEL * load * size:
        raise InputError(
            f"excitation.load must be along the static load {scene.static_load!r} for {quantity}, "
            f"got {step.load!r}"
        )
    stepped = load + (x * fx + y * fy) / load
    if stepped <= 0.0:
        raise InputError(f"excitation.load must leave a load on the bush for {quantity}, got {step.load!r}")
    times = [0.0, min(step.start, end), min(step.end, end), end]
    stages = zip(np.diff(times).tolist(), (load, stepped, load), strict=True)
    return [(duration, force) for duration, force in stages if duration > 0.0]


# How far a bush settles because its liner melts: its end, moments of the wear, ever more nodes.


STEPS_ERROR = 1e-6
"""Verified error of the steps in time: tests/bearings/bush/test_bush_moments.py."""

END_ERROR = 1e-5
"""Verified error of the end of the wear: tests/bearings/bush/test_bush_worn.py."""

AT_CRITICAL = 1e-6
"""Speed over the critical one, less one, within which it is not known whether an unworn bush melts."""

SAMPLES = 33
"""States on the way to the end of the wear."""

NODES = (12, 24, 48, 96)
"""Nodes to each side of the load line."""

ORDER = 2
"""Of the wear in the distance of nodes where each point melts by itself."""

SHARED_ORDER = 1.5
"""Of it where the contact melts as a whole, with 6 to 100 nodes: its front moves from node to node.

Fitted to falling loads, of orders 1.3 to 1.8: an error is 1.6 times its estimate at worst
(docs/bush_wear.md).
"""

CLOSED = ", closed-form flux"

DEFECTS = WorkUnit("defects of two moments")
ENDS, CRITICAL_SPEEDS = WorkUnit("ends of the wear"), WorkUnit("critical speeds")


def wear_rung(
    run: BushRun,
    name: str,
    answer: Callable[[RungResult | None], RungResult],
    judge: Callable[[RungResult, RungResult | None], ErrorEstimate],
    expected: Callable[[Work], Work],
    *,
    within: float = AT_CRITICAL,
    prior: float = 0.0,
) -> FunctionRung:
    """Return a rung of the wear [m]: by how much farther than unworn the shaft settles.

    Its error is that by `judge`, unless there is no wear or it begins at the critical speed itself. No wear
    has no error where the speed is lower by more than `within`, relative to the critical one; otherwise the
    error is infinite.
    """

    def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        margin = run.margin(run.exact)
        if found.value != 0.0 and margin > within:
            return judge(found, before)
        how = f"exact flux: the speed is {margin:+.2%} off that at which the liner melts"
        certain = found.value == 0.0 and margin < -within
        return ErrorEstimate(0.0 if certain else math.inf, how, bound=certain)

    return FunctionRung(name=name, answer=answer, estimate=estimate, expected=expected, prior=prior)


def moment_rung(run: BushRun, *, closed: bool, moments: int) -> FunctionRung:
    """Return wear by one or two moments of the profile, under a load that does not fall."""
    own = run.closed if closed else run.exact
    name = f"{'one moment' if moments == 1 else 'two moments'}{CLOSED if closed else ''}"
    unit = WorkUnit(f"rates of {name}", ("rates", moments, closed))

    def answer(before: RungResult | None) -> RungResult:
        path = (bushes.wear_by_one_moment if moments == 1 else bushes.wear_by_two_moments)(own, run.stages)
        worn = own.settlement(float(path.moment[-1]), float(path.load_ratio[-1]))
        return RungResult(run.require_liner(run.radius * worn), {unit: path.calls}, path)

    def judge(found: RungResult, before: RungResult | None) -> ErrorEstimate:
        path: bushes.Path = found.solution
        is_bound = moments == 2 and not closed
        defect, *slopes = flux_bound(own, path) if is_bound else moments_defect(own, run.exact, path)
        moved, other = (scalar_drift(path.time, defect, slope) for slope in slopes)
        error, doubt = relative(own, float(path.load_ratio[-1]), float(path.moment[-1]), moved, other)
        method = "verified bound of flux and steps" if is_bound else "defect of two moments"
        work = {} if is_bound else {DEFECTS: path.time.size}
        return ErrorEstimate(error + STEPS_ERROR, method, work, bound=is_bound, doubt=doubt)

    def expected(done: Work) -> Work:
        """Return as many rates as the rung below took, or a usual number."""
        known = [number for rates, number in done.items() if rates != CRITICAL_SPEEDS]
        return {unit: max(known, default=100)}

    return wear_rung(run, name, answer, judge, expected, within=EXACT_ERROR)


def moments_defect(
    own: bushes.Wearing, rich: bushes.Wearing, path: bushes.Path
) -> tuple[Array, Array, Array]:
    """Return what both moments with the exact flux change of the rates along a run, and slopes of both."""
    alpha = rich.angle(path.moment, path.load_ratio)
    first = rich.first_along(path.moment, path.load_ratio)
    total = rich.total(alpha, first)
    shaped = own.shaped_total(alpha, path.load_ratio)
    rate = path.load_ratio * np.maximum(rich.surplus(alpha, total), 0.0)
    defect = rate - path.load_ratio * np.maximum(own.surplus(alpha, shaped), 0.0)
    return defect, rich.slope(alpha, total, path.load_ratio), own.shaped_slope(alpha, path.load_ratio)


def flux_bound(own: bushes.Wearing, path: bushes.Path) -> tuple[Array, Array, Array]:
    """Return what the verified error of the flux may change of the rates along a run, and two slopes."""
    alpha = own.angle(path.moment, path.load_ratio)
    total = own.total(alpha, path.first)
    flux = EXACT_ERROR * own.law.balance.share(alpha) * own.law.shaft * own.law.melting
    slope = own.slope(alpha, total, path.load_ratio)
    return 2.0 * alpha * flux * path.load_ratio / (total * own.heat), slope, slope


def relative(
    bush: bushes.Wearing, load: float, moment: float, moved: float, other: float
) -> tuple[float, str]:
    """Return the error of the settlement, over the better one, for an error of W, and a doubt of it."""
    slope, value = bush.settlement_slope(moment, load), bush.settlement(moment, load)
    better = value + slope * moved
    error = abs(slope * moved) / better if better > 0.0 else math.inf
    apart = abs(moved - other) / max(abs(moved), abs(other), 1e-300)
    doubt = f"the rates of both models disagree on the error by {apart:.0%}: not linear"
    return error, doubt if apart > DISAGREEMENT else ""


def end_rung(run: BushRun) -> FunctionRung:
    """Return where the wear under a constant load ends: the critical speed has grown to the speed."""
    rich, own, stage = run.exact, run.closed, run.stages[-1]

    def answer(before: RungResult | None) -> RungResult:
        moment, calls = bushes.end_of_wear(own, stage.load_ratio)
        worn = own.settlement(require_end(moment), stage.load_ratio)
        return RungResult(run.require_liner(run.radius * worn), {CRITICAL_SPEEDS: calls}, moment)

    def judge(found: RungResult, before: RungResult | None) -> ErrorEstimate:
        """Return the wear still to come, at most, and what both moments with the exact flux would change.

        The rate of wear falls ever more slowly on the way to the end, so that what is to come lies below an
        exponential with the slope at the end.
        """
        end = float(found.solution)
        moment = end * np.linspace(0.0, 1.0, SAMPLES)
        load = np.full(SAMPLES, stage.load_ratio)
        alpha = rich.angle(moment, load)
        total = rich.total(alpha, rich.first_along(moment, load))
        rate = load * own.surplus(alpha, own.shaped_total(alpha, load))
        slopes = rich.slope(alpha, total, load)[-1], own.shaped_slope(alpha, load)[-1]
        moved, other = (float(-load[-1] * rich.surplus(alpha, total)[-1] / slope) for slope in slopes)
        error, doubt = relative(own, stage.load_ratio, end, moved, other)
        if np.any(rate < -slopes[1] * (end - moment) * (1.0 - 1e-6) - 1e-9 * rate[0]):
            doubt = "the rate of wear does not fall ever more slowly"
        to_come = math.exp(float(max(slopes)) * stage.duration)
        left, _ = relative(own, stage.load_ratio, end, -to_come * end, -to_come * end)
        # What is still to come is overestimated, the defect is not.
        bound = left > error
        method = f"{'overestimated: ' if bound else ''}defect of two moments; time to the end"
        work = {DEFECTS: SAMPLES}
        return ErrorEstimate(error + left + STEPS_ERROR, method, work, bound, doubt)

    name = f"end of the wear{CLOSED}"
    return wear_rung(run, name, answer, judge, lambda _: {CRITICAL_SPEEDS: 12}, within=EXACT_ERROR)


def require_end(size: float) -> float:
    """Return where the wear ends; raise RotorfilmError where it does not."""
    if math.isinf(size):
        raise RotorfilmError(f"the wear has no end below {bushes.WIDEST} rad of half the contact")
    return size


def local_end_rung(run: BushRun) -> FunctionRung:
    """Return where the wear under a constant load ends if each point melts by itself, in closed form."""
    stage = run.stages[0]

    def answer(before: RungResult | None) -> RungResult:
        end = bushes.end_of_local_wear(run.exact, stage.load_ratio)
        require_end(end.angle)
        return RungResult(run.require_liner(run.radius * end.settlement), {ENDS: 1}, end)

    def judge(found: RungResult, before: RungResult | None) -> ErrorEstimate:
        """Return the wear still to come, at most: it decays ever more slowly, at the end by a known rate."""
        end = found.solution
        doubt = "" if end.exact else "the losses rise so fast that not all that has melted goes on melting"
        to_come = math.exp(-end.rate * stage.duration)
        error = to_come / (1.0 - to_come) if to_come < 1.0 else math.inf
        return ErrorEstimate(error + END_ERROR, "overestimated: time to the end", bound=True, doubt=doubt)

    return wear_rung(run, "end of the wear", answer, judge, lambda _: {ENDS: 1})


def nodes_rung(run: BushRun, nodes: int, *, closed: bool) -> FunctionRung:
    """Return wear by nodes, so many a side, on an arc that the contact just fills at the end.

    It is for loads that fall, and where each point melts by itself.
    """
    own = run.closed if closed else run.exact

    def worn(count: int, reach: float, work: dict[WorkUnit, int], *, exact: bool = False) -> float:
        bush, why = (run.exact, ", exact flux") if exact else (own, "")
        found = bushes.wear_at_nodes(bush, run.rule, run.stages, count, reach)
        work[profiles(count, why)] = found.calls
        return run.radius * found.settlement

    def answer(before: RungResult | None) -> RungResult:
        if run.margin(own) < 0.0:
            return RungResult(0.0, {CRITICAL_SPEEDS: len(run.stages)}, math.nan)
        reach, work = before.solution if before is not None else None, dict[WorkUnit, int]()
        if not (isinstance(reach, float) and math.isfinite(reach)):
            reach, calls = bushes.arc_of_wear(own, run.rule, run.stages, NODES[0])
            work = {profiles(NODES[0], ", first"): calls}
        return RungResult(run.require_liner(worn(nodes, reach, work)), work, reach)

    def judge(found: RungResult, before: RungResult | None) -> ErrorEstimate:
        """Return the order increment from half the nodes, and what the exact flux would change by these."""
        reach, half, between = float(found.solution), nodes // 2, 3 * nodes // 4
        order, work = ORDER if run.local else SHARED_ORDER, dict[WorkUnit, int]()
        known = before is not None and profiles(half) in before.work
        coarse = float(before.value) if before is not None and known else worn(half, reach, work)
        error = abs(found.value - coarse) / (2.0**order - 1.0)
        # One difference of few nodes may vanish by chance, two hardly do.
        other = abs(found.value - worn(between, reach, work)) / ((4.0 / 3.0) ** order - 1.0)
        error = math.hypot(error, other) / math.sqrt(2.0)
        method = f"order increment, order {order}"
        if closed:
            error += abs(worn(half, reach, work, exact=True) - coarse)
            method += "; exact flux at half the nodes"
        return ErrorEstimate(error / abs(found.value), method, work)

    def expected(done: Work) -> Work:
        """Return twice the profiles of half the nodes."""
        return {profiles(nodes): 2 * max(done.values(), default=100)}

    name = f"{nodes} nodes a side{CLOSED if closed else ''}"
    return wear_rung(run, name, answer, judge, expected, prior=0.1 / nodes**ORDER)


def profiles(nodes: int, why: str = "") -> WorkUnit:
    """Return the unit of one profile for which the shaft is settled."""
    return WorkUnit(f"profiles of {2 * nodes + 1} nodes{why}", (nodes, why))


def wear_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the wear of a bush.

    Raises
    ------
    InputError
        If the scene has no bush, no load, does not turn, or its load does not keep its direction.
    """
    run = bush_run(scene, quantity)
    named, constant = isinstance(run.bush.shaft_heat, bushes.ApproximateShaft), len(run.stages) == 1
    if run.local or not run.grows:
        ends = [local_end_rung(run)] if run.local and constant and not named else []
        rungs = [*ends, *(nodes_rung(run, nodes, closed=named) for nodes in NODES)]
    else:
        exact = [] if named else [moment_rung(run, closed=False, moments=moments) for moments in (1, 2)]
        rungs = [*([end_rung(run)] if constant else []), moment_rung(run, closed=True, moments=1), *exact]
    return Ladder(rungs=tuple(rungs), unit="m", remarks=bush_remarks(run))


# What every model of a polymer bush leaves out, judged by dimensionless numbers.


def bush_numbers(run: BushRun) -> dict[str, float]:
    """Return the dimensionless numbers of a run, unworn; where its load changes those of the largest one.

    Returns
    -------
    dict of str to float
        margin : speed over the critical speed, less one; off : its size.
        slenderness : thickness of the liner over half the width of the contact: a thin liner yields where it
        is pressed.
        strain : compression of the liner on the load line over its thickness.
        lean : share of the load that friction carries, 1 - 1/sqrt(1 + f^2), left out of the balance of
        forces.
        melted : largest wear there can be over the thickness of the liner: rate at the begin times duration.
        speed [rad/s] : of the shaft, without its sign.
        cooled [K] : by how much friction keeps the worn contact below the melting point at the end, by one
        moment; widened [m] : by how much that widens the clearance.
        states : how many there may be of one contact.
    """
    geometry, liner, bush = run.bush.geometry, run.bush.liner, run.exact
    load = max(stage.load_ratio for stage in run.stages)
    duration = sum(stage.duration for stage in run.stages)
    alpha = bush.angle(0.0, load)
    peak = load * float(bushes.peak_weight(alpha))
    thickness = geometry.outer_radius - geometry.radius
    end, _ = bushes.end_of_wear(bush, load)
    rate = float(bush.surplus(alpha, bush.shaped_total(alpha, load)))
    fastest = max(bush.work * peak - float(bush.losses(alpha)), 0.0) / bush.heat if run.local else rate * peak
    shared = bush.settlement(end, load) if math.isfinite(end) else math.inf
    settled = bushes.end_of_local_wear(bush, load).settlement if run.local else shared
    friction = float(run.bush.friction.at(liner.melting_point))
    margin, cooled = run.margin(bush), 0.0 if run.grows else _cooled(run)
    return {
        "margin": margin,
        "off": abs(margin),
        "slenderness": thickness / (geometry.radius * float(alpha)),
        "strain": run.bush.compliance * peak * geometry.radius / thickness,
        "lean": 1.0 - 1.0 / math.hypot(1.0, friction),
        "melted": geometry.radius / thickness * max(min(fastest * duration, settled), 0.0),
        "speed": abs(run.speed),
        "cooled": cooled,
        "widened": cooled * run.bush.closing * run.radius,
        "states": 2.0 if run.stays_cold else 1.0,
    }


def _cooled(run: BushRun) -> float:
    law = run.exact.law
    try:
        moment = float(bushes.wear_by_one_moment(run.exact, run.stages).moment[-1])
        at = law.contact(moment, run.stages[-1].load_ratio, run.speed)
    except ConvergenceError:  # too wide a contact, or two states: said elsewhere
        return math.nan
    return law.melting - at.temperature if moment > 0.0 else 0.0


def bush_remarks(run: BushRun) -> tuple[str, ...]:
    """Return the neglected effects that matter, one line each, for the run of a bush."""
    return messages(remarks_of("bush"), bush_numbers(run))


LADDERS = {"critical_speed": bush_ladder, "wear": wear_ladder}
