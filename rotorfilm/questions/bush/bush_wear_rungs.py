"""How far a bush settles because its liner melts: its end, moments of the wear, ever more nodes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...answers import DISAGREEMENT, ErrorEstimate, Found, Work, WorkUnit
from ...bearings.bush import (
    WIDEST,
    ApproximateShaft,
    Path,
    Wearing,
    end_of_wear,
    wear_by_one_moment,
    wear_by_two_moments,
)
from ...errors import RotorfilmError
from ...ladders import BaseRung, Ladder
from ...motion.transient.scalar_drift import scalar_drift
from ...scenes.bush.bush_remarks import bush_remarks
from ...scenes.bush.bush_run import BushRun, bush_run, unworn
from .bush_nodes import CRITICAL_SPEEDS, NODES, LocalEndRung, NodesRung
from .bushes import EXACT_ERROR

if TYPE_CHECKING:
    from ...scenes.scene import Scene

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
