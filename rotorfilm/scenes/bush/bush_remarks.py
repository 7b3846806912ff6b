"""What every model of a polymer bush leaves out, judged by dimensionless numbers."""

from __future__ import annotations

import math

from ...bearings.bush import end_of_local_wear, end_of_wear, peak_weight, wear_by_one_moment
from ...errors import ConvergenceError
from ..remarks import Remark, said
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


REMARKS = (
    Remark(
        "off",
        NEAR,
        "brink: the speed is {margin:+.1%} off that at which the liner melts, which is not known so well; "
        "friction carries {lean:.1%} of the load, which no model counts",
        below=True,
    ),
    Remark("lean", LEAN, "friction: it carries {lean:.1%} of the load, so that the pressure is less"),
    Remark("slenderness", 1.0, "thick liner: {slenderness:.2g} of half the width of the contact"),
    Remark("strain", STRAIN, "strain: the liner is compressed by {strain:.1%} of its thickness"),
    Remark(
        "melted",
        STRAIN,
        "thickness: up to {melted:.0%} of the liner melts, but it is taken to conduct and to yield as before",
    ),
    Remark(
        "speed",
        SPREAD_SPEED,
        f"slow: heat is spread evenly around a shaft above {SPREAD_SPEED:g} rad/s, this one turns at "
        "{speed:.3g} rad/s",
        below=True,
    ),
    Remark(
        "cooled",
        COLD,
        "cold: in the end the worn contact cools by some {cooled:.0f} K, which widens its clearance by "
        "{widened:.2g} m; wear is told at the melting point",
    ),
    Remark(
        "states",
        1.0,
        "two states: friction rises so steeply with temperature that a contact may also stay cold",
    ),
)
"""What every model of a polymer bush leaves out, by the numbers of `bush_numbers`."""


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
    peak = load * float(peak_weight(alpha))
    thickness = geometry.outer_radius - geometry.radius
    end, _ = end_of_wear(bush, load)
    rate = float(bush.surplus(alpha, bush.shaped_total(alpha, load)))
    fastest = max(bush.work * peak - float(bush.losses(alpha)), 0.0) / bush.heat if run.local else rate * peak
    shared = bush.settlement(end, load) if math.isfinite(end) else math.inf
    settled = end_of_local_wear(bush, load).settlement if run.local else shared
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
        moment = float(wear_by_one_moment(run.exact, run.stages).moment[-1])
        at = law.contact(moment, run.stages[-1].load_ratio, run.speed)
    except ConvergenceError:  # too wide a contact, or two states: said elsewhere
        return math.nan
    return law.melting - at.temperature if moment > 0.0 else 0.0


def bush_remarks(run: BushRun) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, for the run of a bush."""
    return said(REMARKS, bush_numbers(run))
