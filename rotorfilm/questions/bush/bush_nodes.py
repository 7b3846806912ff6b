"""Wear of a bush at nodes of its profile: for loads that fall, and where each point melts by itself."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...answers import ErrorEstimate, Found, Work, WorkUnit
from ...bearings.bush import (
    WIDEST,
    LocalEnd,
    Wearing,
    Worn,
    arc_of_wear,
    end_of_local_wear,
    wear_at_nodes,
)
from ...errors import RotorfilmError
from ...ladders import BaseRung
from ...scenes.bush.bush_run import BushRun, unworn

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
