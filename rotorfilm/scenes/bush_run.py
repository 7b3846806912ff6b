"""The run that a bush wears in, as a scene describes it: what all rungs of its wear start from."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..bearings.bush import (
    ApproximateShaft,
    ExactShaft,
    LocalMelting,
    MeltingBush,
    MeltingRule,
    ShaftHeat,
    Stage,
    Wearing,
    end_of_local_wear,
    end_of_wear,
    mean_weight,
    peak_weight,
    wear_by_one_moment,
)
from ..core.answers import ErrorEstimate
from ..core.errors import ConvergenceError, FilmContactError, InputError
from .excitation_table import StepLoadTable
from .families import Remark, said

if TYPE_CHECKING:
    from .scene import Scene

PARALLEL = 1e-12
"""Largest sine of the angle between a step of load and the static load."""


@dataclass(frozen=True, kw_only=True)
class BushRun:
    """A bush, its speed, and the stages of its load.

    Attributes
    ----------
    bush : MeltingBush
    rule : MeltingRule
        How melting spreads over the contact.
    melting_heat : float [J/m3]
    speed : float [rad/s]
    stages : tuple of Stage
        Times of constant load.
    """

    bush: MeltingBush
    rule: MeltingRule
    melting_heat: float
    speed: float
    stages: tuple[Stage, ...]

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
        return isinstance(self.rule, LocalMelting)

    @cached_property
    def exact(self) -> Wearing:
        """With the exact heat into the shaft."""
        return self._wearing(ExactShaft())

    @cached_property
    def closed(self) -> Wearing:
        """With the closed form of the heat into the shaft."""
        return self._wearing(ApproximateShaft())

    def _wearing(self, shaft_heat: ShaftHeat) -> Wearing:
        bush = replace(self.bush, shaft_heat=shaft_heat)
        return Wearing(bush.law, self.speed, self.melting_heat * self.radius)

    def margin(self, bush: Wearing) -> float:
        """Return speed / critical speed - 1 of the unworn bush, the largest of all stages.

        Where each point melts by itself the largest pressure decides, otherwise the mean.
        """
        margins = []
        for stage in self.stages:
            alpha = bush.angle(0.0, stage.load_ratio)
            weight = peak_weight(alpha) if self.local else mean_weight(alpha)
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
    if scene.bush is None:
        raise InputError(f"bush is required for {quantity}, got no such table")
    if scene.speed == 0.0:
        raise InputError(f"operation.speed must not be zero for {quantity}, got 0.0")
    load = math.hypot(*scene.static_load)
    if load == 0.0:
        raise InputError(f"operation.load must not be zero for {quantity}, got 0.0")
    bush = scene.bush.build()
    return BushRun(
        bush=bush,
        rule=scene.bush.melting,
        melting_heat=scene.bush.melting_heat,
        speed=scene.speed,
        stages=tuple(Stage(t, force / bush.force_unit) for t, force in _stages(scene, load, quantity)),
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


def unworn(run: BushRun, value: float, within: float) -> ErrorEstimate:
    """Return the error of a wear that is none, or that begins at the critical speed itself.

    Parameters
    ----------
    run : BushRun
    value : float [m]
    within : float
        Speed over the critical one, less one, within which it is not known whether the liner melts.

    Returns
    -------
    ErrorEstimate
        Zero for no wear clearly below the critical speed, otherwise infinite.
    """
    margin = run.margin(run.exact)
    how = f"exact flux: the speed is {margin:+.2%} off that at which the liner melts"
    certain = value == 0.0 and margin < -within
    return ErrorEstimate(0.0 if certain else math.inf, how, bound=certain)


# What every model of a polymer bush leaves out, judged by dimensionless numbers.


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
