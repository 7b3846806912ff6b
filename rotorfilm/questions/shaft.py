"""What flexible rotors in their bearings bring to scenes and questions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..analysis import RotorEquilibrium, rotor_equilibrium, rotor_matrices, rotor_modes, speed_events
from ..core.answers import (
    DISAGREEMENT,
    SAFETY,
    ErrorEstimate,
    Ladder,
    RungResult,
    Work,
    WorkUnit,
    beside_bound,
)
from ..core.errors import AbsentError
from ..core.model import Array
from ..core.port import Reaction
from ..core.results import Coefficients
from ..rotors.shaft_rotor import ShaftModel, shaft_models
from ..rotors.structure import freedom_rows
from ..scenes.film_heat import FIELD_LEVELS, FieldLevel, WarmRest
from . import shaft_films
from .film_statics import moving_heat
from .quantities import ORBIT_UNITS as ORBITS
from .shaft_orbits import PEAK, shaft_orbit_ladder, shaft_peak_ladder
from .variants import FunctionRung, counted_rung

if TYPE_CHECKING:
    from ..scenes.scene import Scene

# First critical speed and whirl threshold of a flexible rotor: few shapes, plain elements, meshes.


LARGEST = 0.1
"""Change of speed [1] beyond which a linear step tells nothing."""

EVENTS: dict[str, speed_events.SpeedEvent] = {
    "critical_speed": speed_events.CRITICAL,
    "whirl_threshold": speed_events.THRESHOLD,
}
"""What happens at the speeds that may be asked for."""

SHAFT_ROUNDOFF = float(np.finfo(float).eps)


@dataclass(frozen=True, kw_only=True)
class ShaftSpeed:
    """The lowest critical speeds by one model, as a higher rung starts from them.

    Attributes
    ----------
    whirls : tuple of Whirl
        Whirls by rising speed; those near the first, which another model may have in another order.
    model : ShaftModel
    """

    whirls: tuple[speed_events.Whirl, ...]
    model: ShaftModel

    def starts(self, model: ShaftModel) -> list[speed_events.Start]:
        """Return where another model may look for the same whirls."""
        return [
            speed_events.Start(whirl.at.speed, whirl.value, model.seen(self.model.nodal(whirl.right)))
            for whirl in self.whirls
        ]


class CorrectedSpeed(NamedTuple):
    """A critical speed [rad/s] after a step, its roundoff [1], and why to doubt it."""

    speed: float
    noise: float
    doubt: str


@dataclass(frozen=True, kw_only=True)
class ShaftSpeedRung(shaft_films.ShaftRung):
    """The first critical speed, or the threshold, by one model of the shaft and one film for each journal.

    Attributes
    ----------
    event : SpeedEvent
        What happens at the speed that is asked for.
    speeds : ndarray, shape (n,) [rad/s]
        Speeds where it is looked for.
    """

    event: speed_events.SpeedEvent
    speeds: Array

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the speed [rad/s]: looked for, or followed from that of a lower rung."""
        made = self.films.prepare()
        known: ShaftSpeed | None = None if before is None else before.solution
        # Static shapes may be so far off that another whirl is nearer to theirs.
        follow = known is not None and known.model.modes != 0
        starts = known.starts(self.model) if known is not None and follow else self._looked_for()
        bearings = self.films.reaction, self.films.turning
        found = [speed_events.whirl_of(self.event, self.model.rotor, *bearings, start) for start in starts]
        whirls = sorted((whirl for whirl, _ in found), key=lambda whirl: whirl.at.speed)
        first = whirls[0].at.speed
        if not self.speeds[0] <= first <= self.speeds[-1]:
            raise AbsentError(f"the speed {first:.6g} rad/s is not in shaft.speeds")
        work = sum(count for _, count in found) + (0 if follow else len(self.speeds))
        return RungResult(
            first, {self.unit: work, **made}, ShaftSpeed(whirls=tuple(whirls), model=self.model)
        )

    def _looked_for(self) -> list[speed_events.Start]:
        """Return the first such speed by a reduced model, and those near it."""
        model = self.model.quick
        rotor, reactions = model.rotor, self.films.reaction
        starts = []
        for speed, value in self.event.sightings(rotor, reactions, self.speeds):
            at, structure = rotor_equilibrium(rotor, reactions, speed), rotor.structure
            shape = np.random.default_rng(0).normal(size=len(structure.weight)) + 0j
            frequency = self.event.frequency(value, speed)
            value, shape, _ = rotor_matrices.whirl_near(structure, at, frequency, value, shape)
            seen = shape if model is self.model else self.model.seen(model.nodal(shape))
            starts.append(speed_events.Start(speed, value, seen))
        return starts

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the change of the first critical speed in elements half as long, on richer films.

        Instead of asking richer films the verified bound of the map is added where that is enough, or closer.
        """
        if self.films.tilted:
            return self._by_tilt(found)
        solution: ShaftSpeed = found.solution
        steps, rates = {WorkUnit(f"steps for {self.name}"): 3}, [self.rate(one) for one in solution.whirls]
        bound = self._bound(solution.whirls[0], rates[0])
        method = f"inverse iteration, {len(self.model.finer.elements)} elements"
        own, doubt = self._change(found, rates, trusted=True) if math.isfinite(bound) else (0.0, "")
        by_bound = beside_bound(own, bound, method, steps, doubt)
        if SAFETY * by_bound.error < tolerance or not self.films.name:
            return by_bound
        error, doubt = self._change(found, rates, trusted=False)
        if by_bound.error < error:
            return by_bound
        # grids are less close than maps: most may be their own error
        is_bound = self.films.bounded and math.isfinite(bound) and own < 0.5 * error
        return ErrorEstimate(error, f"{method}, {self.films.rich_name}", steps, bound=is_bound, doubt=doubt)

    def _change(self, found: RungResult, rates: list[float], *, trusted: bool) -> tuple[float, str]:
        """Return the change of the first critical speed [1], with its roundoff, and why to doubt it.

        Critical speeds that are as near as the error are corrected too, and the lowest is the first.
        """
        solution: ShaftSpeed = found.solution
        moved: list[CorrectedSpeed] = []
        reach = math.inf
        for whirl, rate in zip(solution.whirls, rates, strict=True):
            if whirl.at.speed > reach:
                break
            moved.append(self._corrected(whirl, rate, trusted=trusted))
            error = abs(moved[-1].speed - whirl.at.speed)
            reach = min(reach, moved[0].speed + 2.0 * max(error, abs(moved[0].speed - found.value)))
        best = min(moved, key=lambda one: one.speed)
        error = float(abs(best.speed - found.value) / found.value + best.noise)
        doubt = next((one.doubt for one in moved if one.doubt), "")
        doubt = doubt or self._missed(best.speed * (1.0 - 2.0 * error))
        if error > LARGEST:
            doubt = doubt or f"a change by {error:.0%} is too large to be linear"
        if found.value * (1.0 - SAFETY * error) < self.speeds[0]:
            doubt = doubt or "so near to the first of shaft.speeds that it may be below"
        return error, doubt

    def _by_tilt(self, found: RungResult) -> ErrorEstimate:
        """Return the change in elements half as long, on the next level of the tilts.

        A tilt changes the slope of a growth over the speed too, so the speed is found there, by secants.
        """
        whirl: speed_events.Whirl = found.solution.whirls[0]
        mesh = self._corrected(whirl, self.rate(whirl), trusted=True)
        near = self.again(found, self.films.rich, mesh.speed, NEAR_TILT)
        error, shared = (abs(near - one) / whirl.at.speed for one in (whirl.at.speed, mesh.speed))
        doubt = mesh.doubt or self._missed(near * (1.0 - 2.0 * error))
        method = f"secants, {len(self.model.finer.elements)} elements, {self.films.rich_name}"
        work = {WorkUnit(f"speeds for {self.name}"): 1}
        return ErrorEstimate(error + mesh.noise, method, work, doubt=doubt, shared=shared)

    def again(self, found: RungResult, bearings: Mapping[str, Reaction], speed: float, near: float) -> float:
        """Return the speed [rad/s] in other bearings and elements half as long, by secants from a speed.

        They end with a step below the part `near` of the speed.
        """
        whirl: speed_events.Whirl = found.solution.whirls[0]
        rotor, value, shape = self.model.finer, whirl.value, self.model.lifted(whirl.right)

        def lead_at(speed: float) -> tuple[float, None]:
            nonlocal value, shape
            at = rotor_equilibrium(rotor, bearings, speed)
            frequency = self.event.frequency(value, speed)
            value, shape, _ = rotor_matrices.whirl_near(rotor.structure, at, frequency, value, shape)
            return self.event.lead(value, speed), None

        rate = self.rate(whirl)
        secants = partial(speed_events.secant_speed, farthest=FARTHEST, most=RESTS)
        return secants(lead_at, speed, rate, near=near).speed

    @property
    def shares(self) -> object:
        """What a level of tilts leaves out, which all models of the shaft have."""
        return self.films if self.films.tilted else None

    def _missed(self, speed: float) -> str:
        """Return why a model of fewer modes than others may have missed one just above a speed [rad/s]."""
        widest = self.model.widest
        if self.model.modes is None or widest.modes in (None, self.model.modes):
            return ""
        films = self.films.reaction
        own, other = (rotor_modes(model.rotor, films, speed) for model in (self.model, widest))
        return self.event.missed(own, other)

    def _corrected(self, whirl: speed_events.Whirl, rate: float, *, trusted: bool) -> CorrectedSpeed:
        """Return a critical speed after steps of inverse iteration with the shift that this rung gives."""
        found = (
            (whirl.at.coefficients, "")
            if trusted
            else shaft_films.rich_coefficients(self.films, whirl.at, self.model.rotor)
        )
        return self._stepped(whirl, rate, *found)

    def rest(self, found: RungResult) -> RotorEquilibrium:
        """Return the rotor at rest at the first of the speeds."""
        return found.solution.whirls[0].at

    def on(self, found: RungResult, coefficients: dict[str, Coefficients]) -> float:
        """Return the speed [rad/s] on these K and C, for small changes."""
        whirl: speed_events.Whirl = found.solution.whirls[0]
        return self._stepped(whirl, self.rate(whirl), coefficients, "").speed

    def rate(self, whirl: speed_events.Whirl) -> float:
        """Return by how much what must vanish changes with the speed [1]."""
        return self.event.rate(speed_events.value_rate(self.model.rotor.structure, whirl, self.films.turning))

    def moving(self, found: RungResult) -> float:
        """Return how much heat that moves with the whirl lowers a threshold [1]."""
        if self.event is not speed_events.THRESHOLD:
            return 0.0
        bearings = (self.films.journals[name].reaction for name in self.films.on_oil)
        return max(moving_heat(bearing, found.value) for bearing in bearings)

    def mesh_error(self, found: RungResult) -> ErrorEstimate:
        """Return the change in elements half as long, on the same K and C."""
        rates = [self.rate(one) for one in found.solution.whirls]
        error, doubt = self._change(found, rates, trusted=True)
        method = f"inverse iteration, {len(self.model.finer.elements)} elements"
        return ErrorEstimate(error, method, doubt=doubt)

    def _stepped(
        self, whirl: speed_events.Whirl, rate: float, coefficients: dict[str, Coefficients], doubt: str
    ) -> CorrectedSpeed:
        frequency = self.event.frequency(whirl.value, whirl.at.speed)
        at, structure = replace(whirl.at, coefficients=coefficients), self.model.finer.structure
        system = rotor_matrices.motion_near(structure, at, frequency)(whirl.value)
        right, left = self.model.lifted(whirl.right), self.model.lifted(whirl.left)
        _, first, last = rotor_matrices.inverse_steps(system, whirl.value, right, left, 3)
        one, other = (-self.event.lead(step[0], whirl.at.speed) / rate for step in (first, last))
        noise = _roundoff(system, *last) / abs(rate)
        if abs(one - other) > DISAGREEMENT * abs(other) + noise:
            doubt = doubt or "two steps of inverse iteration disagree on the error"
        return CorrectedSpeed(whirl.at.speed + other, noise / whirl.at.speed, doubt)

    def _bound(self, whirl: speed_events.Whirl, rate: float) -> float:
        """Return the error [1] that the worst K and C within the verified bounds of the films would make."""
        structure = self.model.rotor.structure
        _, slope = rotor_matrices.dynamics(rotor_matrices.second_order(structure, whirl.at), whirl.value)
        scale = whirl.left.conj() @ slope @ whirl.right
        total = 0.0
        for name, bound in shaft_films.coefficient_bounds(self.films, whirl.at).items():
            if not math.isfinite(bound):
                return bound
            rows, film = freedom_rows(structure, name), whirl.at.coefficients[name]
            # what an entry of K, and of C, of this size does to the eigenvalue
            by_stiffness = np.outer((rows @ whirl.left).conj(), rows @ whirl.right) / scale
            for change, entries in ((1.0, film.stiffness), (whirl.value, film.damping)):
                moved = [abs(self.event.lead(complex(one), 0.0)) for one in (change * by_stiffness).flat]
                total += bound * float(np.abs(entries).max()) * sum(moved)
        return total / abs(rate) / whirl.at.speed

    def expected(self, done: Work) -> Work:
        """Return the linear problems of four speeds."""
        return {self.unit: 4}


def _roundoff(
    system: rotor_matrices.SecondOrder, value: complex, right: np.ndarray, left: np.ndarray
) -> float:
    """Return what roundoff in the stiffness may make of an eigenvalue [1/s]."""
    _, slope = rotor_matrices.dynamics(system, value)
    size = float(np.linalg.norm(np.abs(left) * (np.abs(system.stiffness) @ np.abs(right))))
    return SHAFT_ROUNDOFF * size / float(abs(left.conj() @ slope @ right))


def shaft_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the first critical speed, or of the whirl threshold, of a flexible rotor.

    Raises
    ------
    InputError
        If the scene has no shaft.
    """
    shaft = scene.required("shaft", quantity)
    rotor, speeds = shaft.build(), shaft.speeds.build()
    models, levels, event = shaft_models(rotor), shaft_films.film_levels(shaft), EVENTS[quantity]

    def rungs_on(levels: tuple[shaft_films.ShaftFilms, ...]) -> list[ShaftSpeedRung]:
        return [
            ShaftSpeedRung(event=event, model=model, films=films, speeds=speeds)
            for films in levels
            for model in (models if films is levels[-1] else models[:3])
        ]

    rungs = rungs_on(levels)
    mesh = next((rung for rung in rungs if rung.model.modes is None), rungs[0])
    return shaft_films.shaft_ladder_on(
        scene,
        rotor,
        float(speeds[-1]),
        "rad/s",
        rungs,
        lambda: (
            rungs_on(tuple(map(shaft_films.at_supply, levels))),
            (field_speed(level, mesh) for level in FIELD_LEVELS[:2]),
        ),
    )


RESTS, NEAR, FARTHEST = 12, 3e-5, 0.1
"""Most speeds that a search takes, the relative change at which it ends, and the largest one of a step."""

NEAR_TILT = 3e-4
"""The change at which it ends on films over the whole length, whose slopes jump from cell to cell."""


def field_speed(level: FieldLevel, rung: ShaftSpeedRung) -> FunctionRung:
    """Return a critical speed, or the threshold, on films with a temperature field.

    It is found by secants from that by T1, of the rung, and its error is that of the model of the shaft, and
    that of the films.
    """
    name = f"{level.level}, {rung.model.name}, {level.grid}"
    seconds = 4.0 * len(rung.films.on_oil) * level.seconds

    def solve(before: RungResult | None) -> tuple[float, tuple[RungResult, dict[str, WarmRest]]]:
        uniform = before is not None and isinstance(before.solution, ShaftSpeed)
        whirl = rung.answer(before if uniform else None).solution.whirls[0]
        structure, event = rung.model.rotor.structure, rung.event

        def lead_at(speed: float) -> tuple[float, tuple[RungResult, dict[str, WarmRest]]]:
            nonlocal whirl
            at = rotor_equilibrium(rung.model.rotor, rung.films.reaction, speed)
            rests = shaft_films.field_rests(rung.films, at, level)
            warm = replace(
                at, coefficients={**at.coefficients, **{n: one.coefficients for n, one in rests.items()}}
            )
            frequency = event.frequency(whirl.value, speed)
            whirl = speed_events.Whirl(
                warm, *rotor_matrices.whirl_near(structure, warm, frequency, whirl.value, whirl.right)
            )
            found = RungResult(speed, {}, ShaftSpeed(whirls=(whirl,), model=rung.model))
            return event.lead(whirl.value, speed), (found, rests)

        near = speed_events.secant_speed(
            lead_at, whirl.at.speed, rung.rate(whirl), near=NEAR, farthest=FARTHEST, most=RESTS
        )
        return near.speed, near.solution

    def judge(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        inner, rests = found.solution
        return shaft_films.with_fields(
            rung.mesh_error(inner), shaft_films.field_error(rung, inner, rests, level)
        )

    return counted_rung(name, ("answers", name), seconds, solve, judge)


LADDERS = {
    **dict.fromkeys(EVENTS, shaft_ladder),
    **dict.fromkeys(ORBITS, shaft_orbit_ladder),
    PEAK: shaft_peak_ladder,
}
