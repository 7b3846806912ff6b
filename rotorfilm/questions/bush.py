"""What polymer bushes bring to scenes and questions."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..analysis.equal_steps import scalar_drift
from ..bearings.bush import (
    WIDEST,
    ApproximateShaft,
    ExactShaft,
    LocalEnd,
    MeltingBush,
    Path,
    Wearing,
    Worn,
    arc_of_wear,
    end_of_local_wear,
    end_of_wear,
    wear_at_nodes,
    wear_by_one_moment,
    wear_by_two_moments,
)
from ..core.answers import DISAGREEMENT, BaseRung, ErrorEstimate, Found, Ladder, Work, WorkUnit
from ..core.errors import InputError, RotorfilmError
from ..scenes.bush_run import BushRun, bush_remarks, bush_run, unworn

if TYPE_CHECKING:
    from ..scenes.scene import Scene

# At which speed a polymer bush melts: the heat into the shaft in closed form, then exact.


EXACT_ERROR = 2e-7
"""Verified error of the exact flux: docs/accuracy.md."""


@dataclass(frozen=True, kw_only=True)
class BushRung(BaseRung):
    """The critical speed by one formula of the heat into the shaft.

    Attributes
    ----------
    bush : MeltingBush
    load : float [N]
    """

    bush: MeltingBush
    load: float

    @property
    def is_exact(self) -> bool:
        """Whether the heat into the shaft is exact."""
        return isinstance(self.bush.shaft_heat, ExactShaft)

    @property
    def name(self) -> str:
        """The formula."""
        return "exact" if self.is_exact else "closed form of the flux"

    @property
    def prior(self) -> float:
        """Order of magnitude of the error of the closed form."""
        return 0.0 if self.is_exact else 1e-3

    @property
    def unit(self) -> WorkUnit:
        """One flux."""
        return WorkUnit(f"fluxes into the shaft, {self.name}", ("fluxes", self.is_exact))

    def answer(self, before: Found | None) -> Found:
        """Return the critical speed of the unworn bush [rad/s]."""
        at = self.bush.contact(self.load)
        return Found(at.critical_speed, {self.unit: 1}, at)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return what the exact flux would change: the speed goes with the heat into shaft and liner."""
        if self.is_exact:
            return ErrorEstimate(EXACT_ERROR, "verified bound of the flux", bound=True)
        at = found.solution
        exact = replace(self, bush=replace(self.bush, shaft_heat=ExactShaft()))
        change = float(exact.bush.shaft_flux(at.contact_angle)) - at.shaft_flux
        error = abs(change) / (at.shaft_flux + change + at.liner_flux)
        return ErrorEstimate(error, "defect of the exact flux", {exact.unit: 1})


def bush_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the speed at which a bush melts.

    Raises
    ------
    InputError
        If the scene has no bush.
    """
    if scene.bush is None:
        raise InputError(f"bush is required for {quantity}, got no such table")
    bush, load = scene.bush.build(), math.hypot(*scene.static_load)
    shafts = (ApproximateShaft(), ExactShaft())
    rungs = tuple(BushRung(bush=replace(bush, shaft_heat=shaft), load=load) for shaft in shafts)
    return Ladder(rungs=rungs, unit="rad/s")


# How far a bush settles because its liner melts: its end, moments of the wear, ever more nodes.


STEPS_ERROR = 1e-6
"""Verified error of the steps in time: tests/bearings/bush/test_bush_moments.py."""

SAMPLES = 33
"""States on the way to the end of the wear."""

CLOSED = ", closed-form flux"

DEFECTS = WorkUnit("defects of two moments")


class RateKey(NamedTuple):
    """By which moments, and whether with the closed form of the flux, a rate of wear is found."""

    moments: int
    closed: bool


@dataclass(frozen=True, kw_only=True)
class MomentRung(BaseRung):
    """Wear by one or two moments of the profile, under a load that does not fall.

    Attributes
    ----------
    run : BushRun
        How the bush is run.
    closed : bool
        Whether the heat into the shaft is that of the closed form.
    moments : int
        1 or 2.
    """

    run: BushRun
    closed: bool
    moments: int

    @property
    def name(self) -> str:
        """Number of moments, and how the flux is found."""
        return f"{'one moment' if self.moments == 1 else 'two moments'}{CLOSED if self.closed else ''}"

    @property
    def unit(self) -> WorkUnit:
        """One rate of wear."""
        return WorkUnit(f"rates of {self.name}", RateKey(self.moments, self.closed))

    @property
    def own(self) -> Wearing:
        """The bush with this rung's heat into the shaft."""
        return self.run.closed if self.closed else self.run.exact

    def answer(self, before: Found | None) -> Found:
        """Return by how much farther than unworn the shaft settles [m]."""
        march = wear_by_one_moment if self.moments == 1 else wear_by_two_moments
        path = march(self.own, self.run.stages)
        value = self.run.radius * self.own.settlement(float(path.moment[-1]), float(path.load_ratio[-1]))
        return Found(self.run.require_liner(value), {self.unit: path.calls}, path)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return what both moments with the exact flux would change, from their rates along this run."""
        path: Path = found.solution
        if path.moment[-1] == 0.0 or self.run.margin(self.run.exact) <= EXACT_ERROR:
            return unworn(self.run, found.value, EXACT_ERROR)
        if self.moments == 2 and not self.closed:
            return self._bound(path)
        rich, own = self.run.exact, self.own
        alpha = rich.angle(path.moment, path.load_ratio)
        first = rich.first_along(path.moment, path.load_ratio)
        total = rich.total(alpha, first)
        shaped = own.shaped_total(alpha, path.load_ratio)
        rate = path.load_ratio * np.maximum(rich.surplus(alpha, total), 0.0)
        defect = rate - path.load_ratio * np.maximum(own.surplus(alpha, shaped), 0.0)
        slopes = rich.slope(alpha, total, path.load_ratio), own.shaped_slope(alpha, path.load_ratio)
        moved, other = (scalar_drift(path.time, defect, slope) for slope in slopes)
        error, doubt = self._relative(path, moved, other)
        return ErrorEstimate(error + STEPS_ERROR, "defect of two moments", {DEFECTS: alpha.size}, doubt=doubt)

    def expected(self, done: Work) -> Work:
        """Return as many rates as the rung below took, or a usual number."""
        known = [number for unit, number in done.items() if isinstance(unit.key, RateKey)]
        return {self.unit: max(known, default=100)}

    def _bound(self, path: Path) -> ErrorEstimate:
        """Return the verified errors of the flux, propagated, and of the steps."""
        own = self.own
        alpha = own.angle(path.moment, path.load_ratio)
        total = own.total(alpha, path.first)
        flux = EXACT_ERROR * own.law.balance.share(alpha) * own.law.shaft * own.law.melting
        defect = 2.0 * alpha * flux * path.load_ratio / (total * own.heat)
        moved = scalar_drift(path.time, defect, own.slope(alpha, total, path.load_ratio))
        error, _ = self._relative(path, moved, moved)
        return ErrorEstimate(error + STEPS_ERROR, "verified bound of flux and steps", bound=True)

    def _relative(self, path: Path, moved: float, other: float) -> tuple[float, str]:
        """Return the error of the settlement for one of the moment W, and why not to trust it."""
        load, moment = float(path.load_ratio[-1]), float(path.moment[-1])
        return relative(self.own, load, moment, moved, other)


def relative(bush: Wearing, load: float, moment: float, moved: float, other: float) -> tuple[float, str]:
    """Return the error of the settlement, over the better one, for an error of W, and a doubt of it."""
    slope, value = bush.settlement_slope(moment, load), bush.settlement(moment, load)
    better = value + slope * moved
    error = abs(slope * moved) / better if better > 0.0 else math.inf
    apart = abs(moved - other) / max(abs(moved), abs(other), 1e-300)
    doubt = f"the rates of both models disagree on the error by {apart:.0%}: not linear"
    return error, doubt if apart > DISAGREEMENT else ""


@dataclass(frozen=True, kw_only=True)
class EndRung(BaseRung):
    """Where the wear under a constant load ends: the critical speed has grown to the speed.

    Attributes
    ----------
    run : BushRun
    """

    run: BushRun

    name = "end of the wear" + CLOSED

    def answer(self, before: Found | None) -> Found:
        """Return the wear after a long time [m]; raises RotorfilmError where it has no end."""
        bush, load = self.run.closed, self.run.stages[-1].load_ratio
        moment, calls = end_of_wear(bush, load)
        if math.isinf(moment):
            raise RotorfilmError(f"the wear has no end below {WIDEST} rad of half the contact")
        value = self.run.radius * bush.settlement(moment, load)
        return Found(self.run.require_liner(value), {CRITICAL_SPEEDS: calls}, moment)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the wear still to come, at most, and what both moments with the exact flux would change.

        The rate of wear falls ever more slowly on the way to the end, so that what is to come lies below an
        exponential with the slope at the end.
        """
        rich, own, stage = self.run.exact, self.run.closed, self.run.stages[-1]
        if found.value == 0.0 or self.run.margin(rich) <= EXACT_ERROR:
            return unworn(self.run, found.value, EXACT_ERROR)
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

    def expected(self, done: Work) -> Work:
        """Return the critical speeds that a root takes."""
        return {CRITICAL_SPEEDS: 12}


def wear_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the wear of a bush.

    Raises
    ------
    InputError
        If the scene has no bush, no load, does not turn, or its load does not keep its direction.
    """
    run = bush_run(scene, quantity)
    named = isinstance(run.bush.shaft_heat, ApproximateShaft)
    if run.local or not run.grows:
        nodes = tuple(NodesRung(run=run, nodes=nodes, closed=named) for nodes in NODES)
        ends = (LocalEndRung(run=run),) if run.local and len(run.stages) == 1 and not named else ()
        return Ladder(rungs=(*ends, *nodes), unit="m", remarks=bush_remarks(run))
    end = (EndRung(run=run),) if len(run.stages) == 1 else ()
    closed = MomentRung(run=run, closed=True, moments=1)
    exact = tuple(MomentRung(run=run, closed=False, moments=moments) for moments in (1, 2))
    return Ladder(rungs=(*end, closed, *(() if named else exact)), unit="m", remarks=bush_remarks(run))


# What polymer bushes bring to scenes and questions.


LADDERS = {
    "critical_speed": bush_ladder,
    "wear": wear_ladder,
}


# Wear of a bush at nodes of its profile: for loads that fall, and where each point melts by itself.


NODES = (12, 24, 48, 96)
"""Nodes to each side of the load line."""

ORDER = 2
"""Of the wear in the distance of nodes where each point melts by itself."""

SHARED_ORDER = 1.5
"""Of it where the contact melts as a whole, with 6 to 100 nodes: its front moves from node to node.

Fitted to falling loads, of orders 1.3 to 1.8: an error is 1.6 times its estimate at worst (docs/bush.md).
"""

AT_CRITICAL = 1e-6
"""Speed over the critical one, less one, within which it is not known whether an unworn bush melts."""


@dataclass(frozen=True, kw_only=True)
class NodesRung(BaseRung):
    """Wear by nodes on an arc that the contact just fills at the end.

    Attributes
    ----------
    run : BushRun
    nodes : int
        To each side of the load line.
    closed : bool
        Whether the heat into the shaft is that of the closed form.
    """

    run: BushRun
    nodes: int
    closed: bool

    @property
    def name(self) -> str:
        """Number of nodes."""
        return f"{self.nodes} nodes a side{', closed-form flux' if self.closed else ''}"

    @property
    def prior(self) -> float:
        """Order of magnitude of the error of so many nodes."""
        return 0.1 / self.nodes**ORDER

    @property
    def own(self) -> Wearing:
        """The bush with this rung's heat into the shaft."""
        return self.run.closed if self.closed else self.run.exact

    def answer(self, before: Found | None) -> Found:
        """Return by how much farther than unworn the shaft settles [m]."""
        if self.run.margin(self.own) < 0.0:
            return Found(0.0, {CRITICAL_SPEEDS: len(self.run.stages)}, math.nan)
        reach, work = math.nan, dict[WorkUnit, int]()
        if before is not None and isinstance(before.solution, float) and math.isfinite(before.solution):
            reach = before.solution
        else:
            reach, calls = arc_of_wear(self.own, self.run.rule, self.run.stages, NODES[0])
            work = {profiles(NODES[0], ", first"): calls}
        worn = self._worn(self.nodes, reach)
        value = self.run.require_liner(self.run.radius * worn.settlement)
        return Found(value, {profiles(self.nodes): worn.calls, **work}, reach)

    def _worn(self, nodes: int, reach: float) -> Worn:
        return wear_at_nodes(self.own, self.run.rule, self.run.stages, nodes, reach)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the order increment from half the nodes, and what the exact flux would change by these."""
        margin = self.run.margin(self.run.exact)
        if found.value == 0.0 or margin < AT_CRITICAL:
            return unworn(self.run, found.value, AT_CRITICAL)
        reach = float(found.solution)
        coarse, work = self._half(found, before)
        order = ORDER if self.run.local else SHARED_ORDER
        error = abs(found.value - coarse) / (2.0**order - 1.0)
        # One difference of few nodes may vanish by chance, two hardly do.
        between = self._worn(3 * self.nodes // 4, reach)
        other = abs(found.value - self.run.radius * between.settlement) / ((4.0 / 3.0) ** order - 1.0)
        error = math.hypot(error, other) / math.sqrt(2.0)
        work = {**work, profiles(3 * self.nodes // 4): between.calls}
        method = f"order increment, order {order}"
        if self.closed:
            exact = wear_at_nodes(self.run.exact, self.run.rule, self.run.stages, self.nodes // 2, reach)
            error += abs(self.run.radius * exact.settlement - coarse)
            method += "; exact flux at half the nodes"
            work = {**work, profiles(self.nodes // 2, ", exact flux"): exact.calls}
        return ErrorEstimate(error / abs(found.value), method, work)

    def _half(self, found: Found, before: Found | None) -> tuple[float, dict[WorkUnit, int]]:
        """Return the wear by half the nodes, that of the rung below if there is one."""
        if before is not None and profiles(self.nodes // 2) in before.work:
            return float(before.value), {}
        worn = self._worn(self.nodes // 2, float(found.solution))
        return self.run.radius * worn.settlement, {profiles(self.nodes // 2): worn.calls}

    def expected(self, done: Work) -> Work:
        """Return twice the profiles of half the nodes."""
        return {profiles(self.nodes): 2 * max(done.values(), default=100)}


@dataclass(frozen=True, kw_only=True)
class LocalEndRung(BaseRung):
    """Where the wear under a constant load ends if each point melts by itself, in closed form.

    Attributes
    ----------
    run : BushRun
    """

    run: BushRun

    name = "end of the wear"

    @property
    def unit(self) -> WorkUnit:
        """One end."""
        return ENDS

    def answer(self, before: Found | None) -> Found:
        """Return the wear after a long time [m]; raises RotorfilmError where it has no end."""
        end = end_of_local_wear(self.run.exact, self.run.stages[0].load_ratio)
        if math.isinf(end.angle):
            raise RotorfilmError(f"the wear has no end below {WIDEST} rad of half the contact")
        value = self.run.require_liner(self.run.radius * end.settlement)
        return Found(value, {ENDS: 1}, end)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the wear still to come, at most: it decays ever more slowly, at the end by a known rate."""
        margin = self.run.margin(self.run.exact)
        if found.value == 0.0 or margin < AT_CRITICAL:
            return unworn(self.run, found.value, AT_CRITICAL)
        end: LocalEnd = found.solution
        doubt = "" if end.exact else "the losses rise so fast that not all that has melted goes on melting"
        to_come = math.exp(-end.rate * self.run.stages[0].duration)
        error = to_come / (1.0 - to_come) if to_come < 1.0 else math.inf
        return ErrorEstimate(error + END_ERROR, "overestimated: time to the end", bound=True, doubt=doubt)


ENDS, CRITICAL_SPEEDS = WorkUnit("ends of the wear"), WorkUnit("critical speeds")
END_ERROR = 1e-5
"""Verified error of the end of the wear: tests/bearings/bush/test_bush_worn.py."""


def profiles(nodes: int, why: str = "") -> WorkUnit:
    """Return the unit of one profile for which the shaft is settled."""
    return WorkUnit(f"profiles of {2 * nodes + 1} nodes{why}", (nodes, why))
