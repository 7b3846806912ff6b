"""What flexible rotors in their bearings bring to scenes and questions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..analysis import RotorEquilibrium, rotor_equilibrium, rotor_modes
from ..analysis.rotor_matrices import (
    SecondOrder,
    dynamics,
    inverse_steps,
    journal_rows,
    motion_near,
    second_order,
    whirl_near,
)
from ..analysis.speed_events import (
    Critical,
    SpeedEvent,
    Start,
    Threshold,
    Whirl,
    on_films,
    value_rate,
    whirl_of,
)
from ..core.answers import (
    DISAGREEMENT,
    SAFETY,
    BaseRung,
    ErrorEstimate,
    Found,
    Ladder,
    Work,
    WorkUnit,
    beside_bound,
)
from ..core.errors import AbsentError, InputError
from ..core.model import Array
from ..core.results import Coefficients
from ..rotors.shaft_rotor import ShaftModel, shaft_models
from ..scenes.excitation_table import oil_remarks
from ..scenes.families import Family
from ..scenes.shaft_table import ShaftTable
from ..scenes.solve_shaft import shaft_remarks, solve_rotor
from .film_motions import ORBIT_UNITS as ORBITS
from .film_statics import moving_heat
from .shaft_films import (
    ShaftFilms,
    at_supply,
    coefficient_bounds,
    field_speeds,
    film_levels,
    rich_coefficients,
    shaft_assumptions,
    warm_physics,
    warm_rungs,
)
from .shaft_orbits import PEAK, shaft_orbit_ladder, shaft_peak_ladder

if TYPE_CHECKING:
    from ..scenes.scene import Scene

# First critical speed and whirl threshold of a flexible rotor: few shapes, plain elements, meshes.


LARGEST = 0.1
"""Change of speed [1] beyond which a linear step tells nothing."""

EVENTS: dict[str, SpeedEvent] = {"critical_speed": Critical(), "whirl_threshold": Threshold()}
"""What happens at the speeds that may be asked for."""

SHAFT_ROUNDOFF = float(np.finfo(float).eps)


@dataclass(frozen=True, kw_only=True)
class ShaftSpeed:
    """The lowest critical speeds by one model, as a higher rung starts from them.

    Attributes
    ----------
    whirls : tuple of Whirl
        By rising speed; those near the first, which another model may have in another order.
    model : ShaftModel
    """

    whirls: tuple[Whirl, ...]
    model: ShaftModel

    def starts(self, model: ShaftModel) -> list[Start]:
        """Return where another model may look for the same whirls."""
        return [
            Start(whirl.at.speed, whirl.value, model.seen(self.model.nodal(whirl.right)))
            for whirl in self.whirls
        ]


class CorrectedSpeed(NamedTuple):
    """A critical speed [rad/s] after a step, its roundoff [1], and why to doubt it."""

    speed: float
    noise: float
    doubt: str


@dataclass(frozen=True, kw_only=True)
class ShaftRung(BaseRung):
    """The first critical speed, or the threshold, by one model of the shaft and one film for each journal.

    Attributes
    ----------
    event : SpeedEvent
        What happens at the speed that is asked for.
    model : ShaftModel
    films : ShaftFilms
    speeds : ndarray, shape (n,) [rad/s]
        Where it is looked for.
    """

    event: SpeedEvent
    model: ShaftModel
    films: ShaftFilms
    speeds: Array

    @property
    def name(self) -> str:
        """Name of the model of the shaft, and of the film."""
        return f"{self.model.name}, {self.films.name}" if self.films.name else self.model.name

    @property
    def unit(self) -> WorkUnit:
        """One linear problem."""
        return WorkUnit(f"problems of {self.name}", ("problems", id(self.model), id(self.films)))

    def answer(self, before: Found | None) -> Found:
        """Return the speed [rad/s]: looked for, or followed from that of a lower rung."""
        made = self.films.prepare()
        known: ShaftSpeed | None = None if before is None else before.solution
        # Static shapes may be so far off that another whirl is nearer to theirs.
        follow = known is not None and known.model.modes != 0
        starts = known.starts(self.model) if known is not None and follow else self._looked_for()
        found = [whirl_of(self.event, self.model.rotor, self.films, start) for start in starts]
        whirls = sorted((whirl for whirl, _ in found), key=lambda whirl: whirl.at.speed)
        first = whirls[0].at.speed
        if not self.speeds[0] <= first <= self.speeds[-1]:
            raise AbsentError(f"the speed {first:.6g} rad/s is not in shaft.speeds")
        work = sum(count for _, count in found) + (0 if follow else len(self.speeds))
        return Found(first, {self.unit: work, **made}, ShaftSpeed(whirls=tuple(whirls), model=self.model))

    def _looked_for(self) -> list[Start]:
        """Return the first such speed by a reduced model, and those near it."""
        model = self.model.quick
        rotor, reactions = model.rotor, self.films.reaction
        starts = []
        for speed, value in self.event.sightings(rotor, reactions, self.speeds):
            at, structure = rotor_equilibrium(rotor, reactions, speed), rotor.structure
            shape = np.random.default_rng(0).normal(size=len(structure.weight)) + 0j
            frequency = self.event.frequency(value, speed)
            value, shape, _ = whirl_near(structure, at, frequency, value, shape)
            seen = shape if model is self.model else self.model.seen(model.nodal(shape))
            starts.append(Start(speed, value, seen))
        return starts

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change of the first critical speed in elements half as long, on richer films.

        Instead of asking richer films the verified bound of the map is added where that is enough, or closer.
        """
        solution: ShaftSpeed = found.solution
        structure, steps = self.model.rotor.structure, {WorkUnit(f"steps for {self.name}"): 3}
        rates = [self.event.rate(value_rate(structure, one, self.films)) for one in solution.whirls]
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

    def _change(self, found: Found, rates: list[float], *, trusted: bool) -> tuple[float, str]:
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

    def _missed(self, speed: float) -> str:
        """Return why a model of fewer modes than others may have missed one just above a speed [rad/s]."""
        widest = self.model.widest
        if self.model.modes is None or widest.modes in (None, self.model.modes):
            return ""
        films = self.films.reaction
        own, other = (rotor_modes(model.rotor, films, speed) for model in (self.model, widest))
        return self.event.missed(own, other)

    def _corrected(self, whirl: Whirl, rate: float, *, trusted: bool) -> CorrectedSpeed:
        """Return a critical speed after steps of inverse iteration with the shift that this rung gives."""
        found = (whirl.at.coefficients, "") if trusted else rich_coefficients(self.films, whirl.at)
        return self._stepped(whirl, rate, *found)

    def rest(self, found: Found) -> RotorEquilibrium:
        """Return the rotor at rest at the first of the speeds."""
        at: RotorEquilibrium = found.solution.whirls[0].at
        return at

    def solution(self, whirl: Whirl) -> ShaftSpeed:
        """Return one whirl as what an answer starts from."""
        return ShaftSpeed(whirls=(whirl,), model=self.model)

    def on(self, found: Found, coefficients: dict[str, Coefficients]) -> float:
        """Return the speed [rad/s] on these K and C, for small changes."""
        whirl: Whirl = found.solution.whirls[0]
        rate = self.event.rate(value_rate(self.model.rotor.structure, whirl, self.films))
        return self._stepped(whirl, rate, coefficients, "").speed

    def distance(self, value: float, better: float) -> float:
        """Return by which share of it a speed is off."""
        return abs(better - value) / better

    def moving(self, found: Found) -> float:
        """Return how much heat that moves with the whirl lowers a threshold [1]."""
        if not isinstance(self.event, Threshold):
            return 0.0
        bearings = (self.films.journals[name].reaction for name in self.films.on_oil)
        return max(moving_heat(bearing, found.value) for bearing in bearings)

    def mesh_error(self, found: Found) -> ErrorEstimate:
        """Return the change in elements half as long, on the same K and C."""
        structure = self.model.rotor.structure
        rates = [self.event.rate(value_rate(structure, one, self.films)) for one in found.solution.whirls]
        error, doubt = self._change(found, rates, trusted=True)
        method = f"inverse iteration, {len(self.model.finer.elements)} elements"
        return ErrorEstimate(error, method, doubt=doubt)

    def _stepped(
        self, whirl: Whirl, rate: float, coefficients: dict[str, Coefficients], doubt: str
    ) -> CorrectedSpeed:
        frequency = self.event.frequency(whirl.value, whirl.at.speed)
        at, structure = on_films(whirl.at, coefficients), self.model.finer.structure
        system = motion_near(structure, at, frequency)(whirl.value)
        right, left = self.model.lifted(whirl.right), self.model.lifted(whirl.left)
        _, first, last = inverse_steps(system, whirl.value, right, left, 3)
        one, other = (-self.event.lead(step[0], whirl.at.speed) / rate for step in (first, last))
        noise = _roundoff(system, *last) / abs(rate)
        if abs(one - other) > DISAGREEMENT * abs(other) + noise:
            doubt = doubt or "two steps of inverse iteration disagree on the error"
        return CorrectedSpeed(whirl.at.speed + other, noise / whirl.at.speed, doubt)

    def _bound(self, whirl: Whirl, rate: float) -> float:
        """Return the error [1] that the worst K and C within the verified bounds of the films would make."""
        structure = self.model.rotor.structure
        _, slope = dynamics(second_order(structure, whirl.at), whirl.value)
        scale = whirl.left.conj() @ slope @ whirl.right
        total = 0.0
        for name, bound in coefficient_bounds(self.films, whirl.at).items():
            rows, film = journal_rows(structure, name), whirl.at.coefficients[name]
            # what an entry of K, and of C, of this size does to the eigenvalue
            by_stiffness = np.outer((rows @ whirl.left).conj(), rows @ whirl.right) / scale
            for change, entries in ((1.0, film.stiffness), (whirl.value, film.damping)):
                moved = [abs(self.event.lead(complex(one), 0.0)) for one in (change * by_stiffness).flat]
                total += bound * float(np.abs(entries).max()) * sum(moved)
        return total / abs(rate) / whirl.at.speed

    def expected(self, done: Work) -> Work:
        """Return the linear problems of four speeds."""
        return {self.unit: 4}


def _roundoff(system: SecondOrder, value: complex, right: np.ndarray, left: np.ndarray) -> float:
    """Return what roundoff in the stiffness may make of an eigenvalue [1/s]."""
    _, slope = dynamics(system, value)
    size = float(np.linalg.norm(np.abs(left) * (np.abs(system.stiffness) @ np.abs(right))))
    return SHAFT_ROUNDOFF * size / float(abs(left.conj() @ slope @ right))


def shaft_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the first critical speed, or of the whirl threshold, of a flexible rotor.

    Raises
    ------
    InputError
        If the scene has no shaft.
    """
    if scene.shaft is None:
        raise InputError(f"shaft is required for {quantity}, got no such table")
    rotor, bearings = scene.shaft.build(), scene.shaft.build_bearings()
    speeds, models = scene.shaft.speeds.build(), shaft_models(rotor)
    levels, event = film_levels(scene.shaft), EVENTS[quantity]

    def rungs_on(levels: tuple[ShaftFilms, ...]) -> tuple[ShaftRung, ...]:
        return tuple(
            ShaftRung(event=event, model=model, films=films, speeds=speeds)
            for films in levels
            for model in (models if films is levels[-1] else models[:3])
        )

    films, rungs, fresh = levels[0], rungs_on(levels), rungs_on(tuple(map(at_supply, levels)))
    return Ladder(
        rungs=(*warm_rungs(fresh, rungs), *field_speeds(rungs)) if films.on_oil else rungs,
        unit="rad/s",
        remarks=oil_remarks(scene.tables, scene.lubricant)
        + shaft_remarks(rotor, bearings, scene.lubricant.properties, float(speeds[-1])),
        within=warm_physics(films, bearings),
        assumptions=lambda: shaft_assumptions(rungs[0]),
    )


# What flexible rotors in their bearings bring to scenes and questions.


JOURNAL = {"diameter": "100 mm", "length": "30 mm", "clearance": "0.1 mm", "viscosity": "0.1 Pa s"}
"""The bearings of the example."""

FAMILY = Family(
    table=ShaftTable,
    ladders={
        **dict.fromkeys(EVENTS, shaft_ladder),
        **dict.fromkeys(ORBITS, shaft_orbit_ladder),
        PEAK: shaft_peak_ladder,
    },
    answer=solve_rotor,
    example={
        "shaft": {
            "material": {"young_modulus": "211 GPa", "shear_modulus": "81.2 GPa", "density": "7810 kg/m3"},
            "elements": [{"length": "1.5 m", "outer_diameter": "50 mm", "pieces": 4}],
            "bearings": [
                {"name": "left", "node": 0, "journal": JOURNAL},
                {"name": "right", "node": 4, "journal": JOURNAL},
            ],
            "disks": [{"node": 2, "width": "70 mm", "outer_diameter": "350 mm", "inner_diameter": "50 mm"}],
            "unbalances": [{"node": 2, "unbalance": "500 g mm"}],
            "speeds": {"first": "500 rpm", "last": "2500 rpm", "count": 6},
            "highest_frequency": "100 Hz",
        },
    },
)
