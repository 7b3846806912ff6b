"""The run that a bush wears in, as a scene describes it: what all rungs of its wear start from."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...answers import ErrorEstimate
from ...bearings.bush import (
    ApproximateShaft,
    ExactShaft,
    LocalMelting,
    MeltingBush,
    MeltingRule,
    ShaftHeat,
    Stage,
    Wearing,
    mean_weight,
    peak_weight,
)
from ...errors import FilmContactError, InputError
from ..excitation_table import StepLoadTable

if TYPE_CHECKING:
    from ..scene import Scene

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
