"""How far the journal goes after a blade is lost: linear, then nonlinear in ever shorter steps."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...answers import DISAGREEMENT, ISOTHERMAL, SAFETY, ErrorEstimate, Found, Work, beside_bound
from ...errors import InputError
from ...ladders import CandidateRung, Ladder
from ...linear import coefficients, equilibrium
from ...model import Array, Reaction
from ...motion.transient.equal_steps import ORDER, MarchMotion, linear_march, march, peak
from ...scenes.excitation_table import BladeLossTable
from ...scenes.journal.film_rungs import MAP_BOUNDS, FilmRung
from .unbalance_orbits import film_batch_units, orbit_films, require_one_unbalance

if TYPE_CHECKING:
    from ...scenes.scene import Scene

STEPS = (48, 96, 192, 384, 768)
"""Steps over a turn of the nonlinear rungs."""

SAMPLED = 48
"""States over a turn at which the defect is taken."""


@dataclass(frozen=True, kw_only=True)
class BladeLossRung(CandidateRung[FilmRung]):
    """The peak by one film, linear about the rest or nonlinear in so many steps over a turn.

    Attributes
    ----------
    load : (float, float) [N]
    speed : float [rad/s]
    mass : float [kg]
    excitation : BladeLossTable
    steps : int
        Over a turn; 0 for the linear motion.
    """

    load: tuple[float, float]
    speed: float
    mass: float
    excitation: BladeLossTable
    steps: int

    @property
    def name(self) -> str:
        """Linear, or the number of steps, and the film."""
        return f"{f'nonlinear, {self.steps} steps' if self.steps else 'linear'}, {self.film.name}"

    @property
    def prior(self) -> float:
        """Order of magnitude of the error of the steps, and of the film."""
        return max(0.3 * self.film.prior, 3.0 / self.steps**2 if self.steps else 0.0)

    @property
    def refines(self) -> tuple[object, ...]:
        """The film, where there are steps."""
        return (self.film,) if self.steps else ()

    @cached_property
    def rest(self) -> tuple[Array, Array, Array]:
        """Position, K and C of the film at rest."""
        at = equilibrium(self.film.reaction, self.load, self.speed)
        found = coefficients(self.film.reaction, at.position, self.speed)
        return at.position, found.stiffness, found.damping

    def answer(self, before: Found | None) -> Found:
        """Return the largest distance from the center of the bearing [m]."""
        made = self.film.prepare()
        if not self.steps:
            motion = self._linear()
            return Found(peak(motion.position), {self.film.tangents: 6, **made}, (motion, math.nan))
        motion, calls = self._march(self.steps)
        coarse = self._known(before)
        if math.isnan(coarse):
            other, more = self._march(self.steps // 2)
            coarse, calls = peak(other.position), calls + more
        return Found(peak(motion.position), {self.film.tangents: calls, **made}, (motion, coarse))

    def _known(self, before: Found | None) -> float:
        """Return the peak in steps twice as long, if the rung below has it."""
        if before is None or not isinstance(before.solution, tuple):
            return math.nan
        motion: MarchMotion = before.solution[0]
        twice = motion.time.size - 1 == self._count(self.steps // 2)
        return float(before.value) if twice and self.film.tangents in before.work else math.nan

    def _count(self, steps: int) -> int:
        return math.ceil(steps * self.excitation.revolutions)

    def _march(self, steps: int) -> tuple[MarchMotion, int]:
        step = 2.0 * math.pi / (abs(self.speed) * steps)
        rest, *_ = self.rest
        return march(self.film.reaction, self.mass, self.speed, self._pull, rest, step, self._count(steps))

    def _pull(self, t: float) -> tuple[float, float]:
        angle = self.speed * t + self.excitation.unbalance_angle
        force = self.excitation.unbalance * self.speed**2
        return self.load[0] + force * math.cos(angle), self.load[1] + force * math.sin(angle)

    def _linear(self) -> MarchMotion:
        rest, stiffness, damping = self.rest
        count = self._count(SAMPLED * 4) + 1
        step = 2.0 * math.pi / (abs(self.speed) * SAMPLED * 4)
        time = np.asarray(step * np.arange(count))
        pull = np.array([self._pull(t) for t in time]).T - np.array(self.load)[:, None]
        stiff, damp = _constant(stiffness, count), _constant(damping, count)
        moved = linear_march(self.mass, stiff, damp, pull, step)
        return MarchMotion(
            time=time, position=rest[:, None] + moved, velocity=np.gradient(moved, step, axis=1, edge_order=2)
        )

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the steps (order increment), and of the film by its defect along the motion."""
        motion, coarse = found.solution
        reach = float(np.hypot(*motion.position).max()) / self.film.reaction.clearance
        if reach >= 0.999:
            return ErrorEstimate(math.inf, "defect", doubt="the motion leaves the clearance: not linear")
        steps = 0.0 if not self.steps else abs(found.value - coarse) / (2.0**ORDER - 1.0) / found.value
        how = "" if not self.steps else "order increment; "
        bound = MAP_BOUNDS[0][2] if self.film.bounded and reach <= MAP_BOUNDS[0][0] else math.inf
        if self.steps and SAFETY * bound < tolerance:
            return beside_bound(steps, bound, how + "verified bound of the map", {})
        own = not self.steps and SAFETY * bound < tolerance
        rich = self.film.reaction if own else self.film.rich
        change, doubt, calls = self._by_defect(motion, found.value, rich)
        work = {self.film.tangents if own else self.film.defects(smooth=False): calls}
        method = f"{how}defect of {self.film.name if own else self.film.rich_name}"
        return beside_bound(change + steps, bound if own else 0.0, method, work, doubt)

    def _by_defect(self, motion: MarchMotion, value: float, rich: Reaction) -> tuple[float, str, int]:
        """Return the relative change of the peak that the richer film would make, and why not to trust it."""
        stride = max(1, (self.steps or SAMPLED * 4) // SAMPLED)
        q, v = motion.position[:, ::stride], motion.velocity[:, ::stride]
        step, count = float(motion.time[stride] - motion.time[0]), q.shape[1]
        speeds = np.full(count, self.speed)
        slopes = rich.jacobian(q, v, speeds)
        rest, stiffness, damping = self.rest
        if self.steps:
            own = self.film.reaction.jacobian(q, v, speeds)
            cheap, K, C = self.film.reaction.force(q, v, speeds), -own[:, :2], -own[:, 2:4]
        else:
            K, C = _constant(stiffness, count), _constant(damping, count)
            cheap = -stiffness @ (q - rest[:, None]) - damping @ v - np.array(self.load)[:, None]
        defect = rich.force(q, v, speeds) - cheap
        moved = linear_march(self.mass, -slopes[:, :2], -slopes[:, 2:4], defect, step)
        other = linear_march(self.mass, K, C, defect, step)
        size = float(np.linalg.norm(moved))
        apart = float(np.linalg.norm(moved - other)) / size if size else 0.0
        doubt = f"the slopes of both films disagree on the error by {apart:.0%}: not linear"
        change = abs(peak(q + moved) - peak(q)) / value
        return change, doubt if apart > DISAGREEMENT else "", count

    def expected(self, done: Work) -> Work:
        """Return three tangents for each step."""
        return self.film.expected(3 * self._count(self.steps) if self.steps else 6)


def _constant(matrix: Array, count: int) -> Array:
    return np.repeat(matrix[:, :, None], count, axis=2)


def blade_loss_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the peak after a blade is lost.

    Raises
    ------
    InputError
        If the scene loses no blade, has no rotor, or does not turn.
    """
    if not isinstance(scene.excitation, BladeLossTable):
        got = "none" if scene.excitation is None else f"{scene.excitation!r}"
        raise InputError(f'excitation of kind "blade_loss" is required for {quantity}, got {got}')
    if scene.speed == 0.0:
        raise InputError("operation.speed must not be zero for a lost blade, got 0.0")
    films, rotor = orbit_films(scene), scene.rotor
    require_one_unbalance(rotor)
    rungs = [
        BladeLossRung(
            film=film,
            load=scene.static_load,
            speed=scene.speed,
            mass=rotor.mass,
            excitation=scene.excitation,
            steps=steps,
        )
        for film in films
        for steps in (0, *STEPS)
    ]
    return Ladder(
        rungs=tuple(rungs),
        unit="m",
        units=film_batch_units(films, scene.speed),
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
    )
