"""What every model of a polymer bush leaves out, judged by dimensionless numbers."""

from __future__ import annotations

import math
from typing import NamedTuple

from ...bearings.bush import end_of_local_wear, end_of_wear, peak_weight, wear_by_one_moment
from ...errors import ConvergenceError
from .bush_run import BushRun

SPREAD_SPEED = 5.0
"""Speed [rad/s] from which the heat into the shaft is spread evenly around it: docs/bush.md."""

STRAIN = 0.1
"""Compression of the liner, and share of it that melts, up to which it is thin and linear."""

LEAN = 0.02
"""Share of the load that friction may carry without a word."""

NEAR = 0.05
"""Speed over the critical one, less one, within which small causes decide whether a bush melts."""


COLD = 5.0
"""Kelvin by which a worn contact may be off the melting point without a word."""


class BushNumbers(NamedTuple):
    """Dimensionless numbers of a bush at work, unworn.

    Attributes
    ----------
    margin : float
        Speed over the critical speed, less one.
    slenderness : float
        Thickness of the liner over half the width of the contact: a thin liner yields where it is pressed.
    strain : float
        Compression of the liner on the load line over its thickness.
    lean : float
        Share of the load that friction carries, 1 - 1/sqrt(1 + f^2): left out of the balance of forces.
    melted : float
        Largest wear there can be over the thickness of the liner: rate at the begin times duration.
    cooled : float [K]
        By how much friction keeps the worn contact below the melting point at the end, by one moment.
    """

    margin: float
    slenderness: float
    strain: float
    lean: float
    melted: float
    cooled: float


def bush_numbers(run: BushRun) -> BushNumbers:
    """Return the numbers of a run; where its load changes those of the largest one."""
    geometry, liner, bush = run.bush.geometry, run.bush.liner, run.exact
    load = max(stage.load_ratio for stage in run.stages)
    duration = sum(stage.duration for stage in run.stages)
    alpha = bush.angle(0.0, load)
    peak = load * float(peak_weight(alpha))
    thickness = geometry.outer_radius - geometry.radius
    end, _ = end_of_wear(bush, load)
    rate = float(bush.surplus(alpha, bush.shaped_total(alpha, load)))
    fastest = max(bush.work * peak - float(bush.losses(alpha)), 0.0) / bush.heat if run.local else rate * peak
    shared = bush.settlement(end, load) if math.isfinite(end) else math.inf
    settled = end_of_local_wear(bush, load).settlement if run.local else shared
    friction = float(run.bush.friction.at(liner.melting_point))
    return BushNumbers(
        margin=run.margin(bush),
        slenderness=thickness / (geometry.radius * float(alpha)),
        strain=run.bush.compliance * peak * geometry.radius / thickness,
        lean=1.0 - 1.0 / math.hypot(1.0, friction),
        melted=geometry.radius / thickness * max(min(fastest * duration, settled), 0.0),
        cooled=0.0 if run.grows else _cooled(run),
    )


def _cooled(run: BushRun) -> float:
    law = run.exact.law
    try:
        moment = float(wear_by_one_moment(run.exact, run.stages).moment[-1])
        at = law.contact(moment, run.stages[-1].load_ratio, run.speed)
    except ConvergenceError:  # too wide a contact, or two states: said elsewhere
        return math.nan
    return law.melting - at.temperature if moment > 0.0 else 0.0


def bush_remarks(run: BushRun) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, for the run of a bush."""
    n = bush_numbers(run)
    lines = {
        f"brink: the speed is {n.margin:+.1%} off that at which the liner melts, which is not known so "
        f"well; friction carries {n.lean:.1%} of the load, which no model counts": abs(n.margin) < NEAR,
        f"friction: it carries {n.lean:.1%} of the load, so that the pressure is less": n.lean > LEAN,
        f"thick liner: {n.slenderness:.2g} of half the width of the contact": n.slenderness > 1.0,
        f"strain: the liner is compressed by {n.strain:.1%} of its thickness": n.strain > STRAIN,
        f"thickness: up to {n.melted:.0%} of the liner melts, but it is taken to conduct and to yield as "
        "before": n.melted > STRAIN,
        f"slow: heat is spread evenly around a shaft above {SPREAD_SPEED:g} rad/s, this one turns at "
        f"{abs(run.speed):.3g} rad/s": abs(run.speed) < SPREAD_SPEED,
        f"cold: in the end the worn contact cools by some {n.cooled:.0f} K, which widens its clearance by "
        f"{n.cooled * run.bush.closing * run.radius:.2g} m; wear is told at the melting point": (
            n.cooled > COLD
        ),
        "two states: friction rises so steeply with temperature that a contact may also stay cold": (
            run.stays_cold
        ),
    }
    return tuple(line for line, applies in lines.items() if applies)
