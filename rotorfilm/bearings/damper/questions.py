"""What squeeze-film dampers bring to scenes and questions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ...analysis import circular_orbits, equal_steps, simulate
from ...core import errors
from ...core.answers import (
    DISAGREEMENT,
    ISOTHERMAL,
    CandidateRung,
    ErrorEstimate,
    Ladder,
    Rung,
    RungResult,
    Work,
    WorkUnit,
)
from ...core.model import Array
from ...core.port import PlanarReaction, Tangent, inertial, largest_eccentricity_ratio, prepared_tangent
from ...core.results import Trajectory
from ...questions.coupling import coupling_ladder
from ...questions.film_motions import LINEAR_STEPS, SAMPLED, STEPS, PeakMotion, PeakRung
from ...questions.variants import counted_rung
from ...rotors import RigidRotor
from ...scenes.film_rungs import MAP_MADE, Counted
from ...scenes.shared_tables import BladeLossTable, RunUpTable
from . import FiniteSqueeze, JFODamper, candidates
from .table import DamperTable, damper_models

if TYPE_CHECKING:
    from ...scenes.scene import Scene

# Questions about a rotor on a squeeze-film damper: jumps, width of the orbit, what it transmits.


UP, DOWN = "jump_up", "jump_down"
UNITS = {UP: "kg m", DOWN: "kg m", "transmissibility": "1", "unbalance_amplitude": "m"}
"""Quantities of a damper and their units."""


@dataclass(frozen=True, kw_only=True)
class DamperCurveRung(CandidateRung):
    """One film and one model of its cage.

    Attributes
    ----------
    rotor : RigidRotor
        Centered by its springs.
    stiffness : float [N/m]
        Stiffness of the springs.
    quantity : str
    """

    rotor: RigidRotor
    stiffness: float
    quantity: str

    @property
    def is_fold(self) -> bool:
        """Whether a jump is asked for: an end of a branch of orbits."""
        return self.quantity in (UP, DOWN)

    @cached_property
    def support(self) -> PlanarReaction:
        """Film and springs."""
        return candidates.on_springs(self.film.reaction, self.stiffness)

    @cached_property
    def search(self) -> PlanarReaction:
        """Film and springs that are quick enough for hundreds of orbits."""
        slow = self.film.law is None or isinstance(self.film.law, FiniteSqueeze)
        return candidates.on_springs(self.film.moving, self.stiffness) if slow else self.support

    @property
    def unit(self) -> WorkUnit:
        """One force of this film."""
        return WorkUnit(f"forces of {self.name}", ("forces", self.film))

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the quantity; raises RotorfilmError where there is no such jump, or contact."""
        made = self.film.prepare()
        counted = Counted(self.support)
        near = None if before is None else self._from(counted, float(before.solution))
        if near is None:
            value, radius = self._searched(Counted(self.search) if self.search != self.support else counted)
            near = (value, radius) if self.search == self.support else self._from(counted, radius)
        if near is None:
            raise errors.RotorfilmError(f"{self.name} finds no orbit near the orbit of its map")
        return RungResult(near[0], {self.unit: counted.forces + counted.tangents, **made}, near[1])

    def _searched(self, reaction: Counted) -> tuple[float, float]:
        """Return quantity and radius among all orbits: the smallest stable one, or the first jump."""
        orbits = circular_orbits.synchronous_orbits(self.rotor, reaction)
        if self.is_fold:
            folds = [fold for fold in orbits.folds if fold.upward == (self.quantity == UP)]
            if not folds:
                amplitude_ratio = reaction.largest_eccentricity_ratio
                why = "no orbit ends so" if orbits.folds else "one orbit at every unbalance"
                why += "" if amplitude_ratio >= 1.0 else f", up to {amplitude_ratio:.4g} of the clearance"
                raise errors.AbsentError(
                    f"no {self.quantity.replace('_', ' ')} of the rotor in the damper: {why}"
                )
            return folds[0].unbalance, folds[0].eccentricity_ratio
        found = orbits.at(self.rotor.unbalance)
        if not found:
            end = "the wall" if orbits.contact_unbalance is not None else "the end of the film's range"
            raise errors.FilmContactError(f"no orbit at this unbalance: the rotor reaches {end}")
        chosen = next((orbit for orbit in found if orbit.stable), found[0])
        amplitude = chosen.eccentricity_ratio * reaction.clearance
        value = chosen.transmissibility if self.quantity == "transmissibility" else amplitude
        return value, chosen.eccentricity_ratio

    def _from(self, counted: Counted, radius: float) -> tuple[float, float] | None:
        """Return quantity and radius of the orbit next to that of a lower rung, if there is one."""
        system = circular_orbits.damped_orbit(self.rotor, counted)
        found = circular_orbits.orbit_near(system, radius, None if self.is_fold else self.rotor.unbalance)
        if found is None:
            return None
        if self.quantity == "transmissibility":
            return circular_orbits.transmitted(system, found), found
        if self.is_fold:
            return circular_orbits.unbalance_at(system, found), found
        return found * system.clearance, found

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the change that one orbit of the richest film, of the same radius, would make.

        At a fold u(e) is level, so that the fold's unbalance changes by what u does at the same radius, and
        to second order by the shift of the fold; at a given unbalance the radius shifts by the defect of u
        over u'.
        """
        rich = self.film.rich
        if rich is None and not math.isfinite(self.film.bound):
            return ErrorEstimate(math.inf, "none", doubt=candidates.NO_RICHER)
        radius = float(found.solution)
        if rich is None:
            return self._by_bound(found.value, radius)
        limit = rich.largest_eccentricity_ratio
        if radius >= limit:
            doubt = f"the orbit goes to {radius:.4g} of the clearance, the richest film to {limit:.4g}"
            return ErrorEstimate(math.inf, "none", doubt=doubt)
        change = self._fold if self.is_fold else self._orbit
        richer = circular_orbits.damped_orbit(self.rotor, candidates.on_springs(rich, self.stiffness))
        value, doubt = change(circular_orbits.orbit_rotor(self.rotor, self.support), richer, radius)
        error = abs(value - found.value) / abs(value)
        return ErrorEstimate(
            error,
            "orbits of the richest film",
            {RICH: 4 if self.is_fold else 3, **self.film.rich_work},
            doubt=doubt,
        )

    def _by_bound(self, value: float, radius: float) -> ErrorEstimate:
        """Return what the verified error of the film's force may make of the quantity.

        It changes the unbalance of an orbit of the same radius, and so that of a fold. At a given unbalance
        it shifts the radius by that over the smallest u' on the way: near a fold that is much, and past it
        there may be no such orbit.
        """
        system, work = circular_orbits.damped_orbit(self.rotor, self.support), {self.unit: 7}
        force = circular_orbits.force_at(system, radius)
        film = abs(force + self.stiffness * system.clearance * radius)
        change = self.film.bound * film / system.speed**2
        method = "verified bound of the film, propagated"
        if self.is_fold:
            return ErrorEstimate(change / value, method, work, bound=True)
        slope = circular_orbits.slope_at(system, radius)
        ends = radius + np.array([-1.0, 1.0]) * abs(change / slope)
        inside = ends[0] > 0.0 and ends[1] < 1.0
        least = min(circular_orbits.slope_at(system, end) / slope for end in ends) if inside else 0.0
        if least < 1.0 - DISAGREEMENT:
            doubt = "so near to a jump, or to the wall, that the error of the film may take the orbit there"
            return ErrorEstimate(abs(change / slope) / radius, method, work, doubt=doubt)
        if self.quantity == "unbalance_amplitude":
            return ErrorEstimate(abs(change / slope) / least / radius, method, work, bound=True)
        # At a given unbalance the ratio changes as the force does: along the shift, and by the film itself.
        shifted = max(abs(abs(circular_orbits.force_at(system, end)) - abs(force)) for end in ends) / least
        return ErrorEstimate((shifted + self.film.bound * film) / abs(force), method, work, bound=True)

    def _fold(
        self, own: circular_orbits.OrbitRotor, rich: circular_orbits.OrbitRotor, radius: float
    ) -> tuple[float, str]:
        """Return the unbalance of the rich film's fold by a parabola through three orbits about the other."""
        near = radius + np.array([-1.0, 0.0, 1.0]) * 0.02 * min(radius, 1.0 - radius)
        low, middle, high = circular_orbits.unbalances(rich, near)
        bend, slope = low - 2.0 * middle + high, 0.5 * (high - low)
        cheap = circular_orbits.unbalances(own, near)
        own_bend = float(cheap[0] - 2.0 * cheap[1] + cheap[2])
        moved = float(np.clip(-slope / own_bend, -10.0, 10.0)) if own_bend else 0.0
        value = float(middle + slope * moved + 0.5 * bend * moved**2)
        doubt = "the curvatures of both films disagree on the error: not linear"
        matters = abs(value - middle) > DISAGREEMENT * abs(value - cheap[1])
        return value, doubt if matters and abs(bend - own_bend) > DISAGREEMENT * abs(own_bend) else ""

    def _orbit(
        self, own: circular_orbits.OrbitRotor, rich: circular_orbits.OrbitRotor, radius: float
    ) -> tuple[float, str]:
        """Return the quantity at the rotor's unbalance by two secant steps with the richest film."""
        target = self.rotor.unbalance
        slopes = [circular_orbits.slope_at(system, radius) for system in (rich, own)]
        steps = [(target - circular_orbits.unbalance_at(rich, radius)) / slope for slope in slopes]
        apart = abs(steps[0] - steps[1]) / max(abs(step) for step in steps)
        new = float(np.clip(radius + steps[0], 1e-9, 1.0 - 1e-9))
        again = (target - circular_orbits.unbalance_at(rich, new)) / slopes[0]
        doubt = f"the slopes of both films disagree on the error by {apart:.0%}: not linear"
        final = new + again
        value = (
            circular_orbits.transmitted(rich, new)
            if self.quantity == "transmissibility"
            else final * own.clearance
        )
        return value, doubt if apart > DISAGREEMENT else ""

    def expected(self, done: Work) -> Work:
        """Return as many forces as a lower rung took."""
        return {self.unit: sum(number for unit, number in done.items() if unit != MAP_MADE)}


RICH = WorkUnit("forces of the richest film")


@candidates.quiet()
def damper_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a quantity of a rotor on a damper.

    Raises
    ------
    InputError
        If the scene has no rotor, no unbalance, no speed or no operation.
    """
    for table in ("damper", "rigid_rotor"):
        scene.required(table, quantity)
    rotor = damper_models(scene).rotor
    if quantity in (UP, DOWN):
        rotor = replace(rotor, unbalance=1e-9 * rotor.mass * scene.damper.clearance)
    elif rotor.unbalance <= 0.0:
        raise errors.InputError(f"rigid_rotor.unbalance must be positive for {quantity}, got 0.0")
    stiffness, supply = scene.damper.stiffness, scene.damper.supply
    if supply is not None and not supply.turns_alike and quantity not in (UP, DOWN):
        return _run_ladder(scene, partial(_repeated, rotor, quantity), UNITS[quantity], steady=True)
    rungs = tuple(
        DamperCurveRung(film=film, rotor=rotor, stiffness=stiffness, quantity=quantity)
        for film in candidates.orbit_films(scene.damper, rotor)
        if not _endless(film, quantity, is_named=scene.damper.film is not None)
    )
    asked = replace(rotor, unbalance=0.0) if quantity in (UP, DOWN) else rotor
    return _ladder(
        scene,
        rungs,
        UNITS[quantity],
        asked,
        units={rung.unit: _one(rung, scene.speed) for rung in rungs},
        steady=quantity not in (UP, DOWN),
    )


def _ladder(
    scene: Scene, rungs: tuple[Rung, ...], unit: str, rotor: RigidRotor, *, units: Any, steady: bool
) -> Ladder:
    """Return a ladder with the remarks on the rotor, on each of the films that lie side by side."""
    table = scene.damper
    count = candidates.lands(table)
    shared = replace(rotor, mass=rotor.mass / count, unbalance=rotor.unbalance / count)
    remarks = candidates.rotor_remarks(
        table,
        candidates.mapped_short(table),
        table.stiffness / count,
        shared,
        scene.lubricant.properties,
        steady=steady,
    )
    return Ladder(rungs=rungs, unit=unit, units=units, remarks=remarks, within=ISOTHERMAL)


def _endless(film: candidates.DamperFilm, quantity: str, *, is_named: bool) -> bool:
    """Return whether hundreds of orbits would take minutes: a fed film of finite length has no map.

    One that the scene names is the only rung there is.
    """
    slow = isinstance(film.law, FiniteSqueeze) and film.shape.is_fed
    return slow and not is_named and quantity in (UP, DOWN)


def _one(rung: DamperCurveRung, speed: float) -> Callable[[], object]:
    def force() -> object:
        radius = 0.5 * rung.support.clearance
        return rung.support.force([radius, 0.0], [0.0, speed * radius], speed)

    return force


# How far a rotor on a squeeze-film damper goes after a blade is lost, or over a run-up.


CHEAP_STEPS = (48, 192)
"""Those of films that leave out the layer or the flow around the circumference."""

FED_STEPS = (24, 48, 96)
"""Those of films with feed, which have no map: a force takes some tenths to thousandths of a second."""

LINEAR_STEP, DEFECT = WorkUnit("linear steps"), WorkUnit("defects of a richer film")


@dataclass(frozen=True, kw_only=True)
class DamperPeakRung(PeakRung):
    """The peak in a squeeze-film damper.

    Attributes
    ----------
    rotor : RigidRotor
        Rotor at rest in the center.
    stiffness : float [N/m]
        Stiffness of the retainer springs.
    duration : float [s]
    """

    rotor: RigidRotor
    stiffness: float
    duration: float

    @cached_property
    def support(self) -> PlanarReaction:
        """Film and springs, the film on its map where it has one."""
        return candidates.on_springs(self.film.moving, self.stiffness)

    @cached_property
    def tangent(self) -> Tangent:
        """Force and derivatives of film and springs for plain numbers."""
        return prepared_tangent(self.support)

    @cached_property
    def rich(self) -> PlanarReaction | None:
        """The richer film and the springs; None if there is none."""
        found = self.film.rich_moving
        return None if found is None else candidates.on_springs(found, self.stiffness)

    @property
    def shaken(self) -> equal_steps.ExcitedRotor:
        """The rotor on film and springs, and what shakes it."""
        return equal_steps.ExcitedRotor(self.support, self.rotor.mass, 0.0, self.rest, self._pull)

    @property
    def rest(self) -> Array:
        """Where the rotor is at rest (2,) [m]: in the center, or at its offset."""
        return np.array(self.rotor.position)

    @cached_property
    def at_rest(self) -> equal_steps.RestTangent:
        """Film and springs in the center: there also a cavitated film is linear in the velocity."""
        rest, still = self.rest, np.zeros(2)
        rate = self.support.clearance * abs(self.rotor.profile.speeds[-1] or 1.0)
        heavy = inertial(self.support)
        added = equal_steps.NONE if heavy is None else heavy.mass(rest, np.array([rate, 0.0]))
        force = -self.rotor.static_load
        if rest.any():
            slopes = self.support.jacobian(rest, still, 0.0)
            return equal_steps.RestTangent(force, -slopes[:, :2], -slopes[:, 2:4], added)
        damping = -float(self.support.force(still, np.array([rate, 0.0]), 0.0)[0]) / rate
        fed = self.film.shape.is_fed
        own = -float(self.film.reaction.jacobian(still, still, 0.0)[0, 0]) if fed else 0.0
        return equal_steps.RestTangent(force, (self.stiffness + own) * np.eye(2), damping * np.eye(2), added)

    def grid(self, steps: int) -> tuple[float, int]:
        """Return the length [s] and an even number of steps, so that one ends where a run-up turns back."""
        fastest = max(abs(speed) for speed in self.rotor.profile.speeds)
        count = 2 * math.ceil(self.duration * fastest * steps / (4.0 * math.pi))
        return self.duration / count, count

    def _pull(self, t: float) -> tuple[float, float]:
        x, y = (self.rotor.unbalance_force(t) + self.rotor.static_load).tolist()
        return x, y

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the largest distance from the center [m]; raises FilmContactError at the wall."""
        if self.steps:
            return self.nonlinear(before)
        motion = self.linear(LINEAR_STEPS)
        if np.hypot(*motion.position).max() >= self.support.clearance:
            raise errors.FilmContactError("the linear motion leaves the clearance")
        half = self.linear(LINEAR_STEPS // 2)
        solved = PeakMotion(motion, equal_steps.peak(half.position), 0)
        return RungResult(equal_steps.peak(motion.position), {LINEAR_STEP: motion.time.size}, solved)

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the steps (order increment), and of the film by its defect along the motion."""
        motion, steps = found.solution.motion, self.increment(found)
        if self.film.rich_law is None and not math.isfinite(self.film.bound):
            return ErrorEstimate(math.inf, "order increment", doubt=candidates.NO_RICHER)
        amplitude_ratio = float(np.hypot(*motion.position).max()) / self.support.clearance
        limit = _reach(self.rich or self.support)
        if amplitude_ratio >= limit:
            return ErrorEstimate(math.inf, "defect", doubt=_beyond(amplitude_ratio, limit))
        if self.film.rich_law is None and self.steps:
            return self._by_bound(motion, found.value, steps)
        change, doubt, calls = self._by_defect(motion, found.value, self.rich or self.support)
        # Errors of opposite signs cancel only as far as each is known: to a tenth, or to second order.
        largest = max(abs(change), abs(steps))
        error = max(abs(change + steps), largest * max(0.1, min(1.0, largest)))
        name = "its own film" if self.rich is None else "the film of finite length"
        work = {DEFECT: calls, **self.film.rich_work}
        return ErrorEstimate(error, f"order increment; defect of {name}", work, doubt=doubt)

    def _by_bound(self, motion: equal_steps.MarchMotion, value: float, steps: float) -> ErrorEstimate:
        """Return the error of the steps, and what the verified error of the film could do all along."""
        states = self._sampled(motion)
        film = self.shaken.tangents(self.support, states)
        off = self.film.bound * (film.force + self.stiffness * states.position)
        mass = self.rotor.mass * np.eye(2)[:, :, None] + film.mass
        moved = equal_steps.linear_march(mass, film.stiffness, film.damping, off, states.step).position
        bound = float(np.hypot(*moved).max()) / value
        method = "order increment; verified bound of the film, propagated"
        work = {self.tangents: states.position.shape[1]}
        return ErrorEstimate(abs(steps) + bound, method, work, abs(steps) < bound)

    def _sampled(self, motion: equal_steps.MarchMotion) -> equal_steps.StatesAlong:
        """Return samples of a motion; the first is off the rest."""
        # With feed the richer film takes milliseconds for a force.
        states = equal_steps.states_along(
            motion, self.stride(SAMPLED // 2 if self.film.shape.is_fed else SAMPLED)
        )
        # A cavitated film has no derivative at rest: the direction in which the rotor starts.
        states.velocity[:, 0] = 1e-3 * states.velocity[:, 1]
        return states

    def _by_defect(
        self, motion: equal_steps.MarchMotion, value: float, rich: PlanarReaction
    ) -> tuple[float, str, int]:
        """Return the relative change of the peak that the richer film would make, and why not to trust it."""
        states = self._sampled(motion)
        q, calls = states.position, states.position.shape[1]
        moved, doubt = self.by_defect(states, rich)
        amplitude_ratio, limit = float(np.hypot(*(q + moved)).max()) / self.support.clearance, _reach(rich)
        if amplitude_ratio >= 1.0:
            doubt = "with its error the rotor would leave the clearance: a jump, or contact, and not linear"
            return math.inf, doubt, calls
        return (
            (equal_steps.peak(q + moved) - equal_steps.peak(q)) / value,
            _beyond(amplitude_ratio, limit) if amplitude_ratio >= limit else doubt,
            calls,
        )

    def expected(self, done: Work) -> Work:
        """Return three tangents for each step."""
        return {self.tangents: 3 * self.grid(self.steps)[1]} if self.steps else {}


def _reach(reaction: PlanarReaction) -> float:
    return min(0.999, largest_eccentricity_ratio(reaction))


def _beyond(amplitude_ratio: float, limit: float) -> str:
    return (
        f"the rotor goes to {amplitude_ratio:.4g} of the clearance, the film is known to {limit:.4g}: it may "
        "touch the wall"
    )


@candidates.quiet()
def damper_peak_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the largest distance after a blade is lost, or over a run-up, in a damper.

    Raises
    ------
    InputError
        If the scene loses no blade and does not run up, has no rotor, or does not turn.
    """
    scene.excited_by(quantity, BladeLossTable, RunUpTable)
    if scene.damper.supply is not None:
        if scene.damper.film is not None:
            raise errors.InputError(
                f"damper.film must not be given with supply for {quantity}, because only the mass-conserving "
                f"film has a supply that varies in time, got {scene.damper.film!r}"
            )
        duration = damper_models(scene).duration
        return _run_ladder(
            scene, lambda follow, steps: equal_steps.peak(follow(duration).position), "m", steady=False
        )
    models = damper_models(scene)
    rungs = tuple(
        DamperPeakRung(
            film=film,
            rotor=models.rotor,
            stiffness=scene.damper.stiffness,
            duration=models.duration,
            steps=steps,
        )
        for film, steps in _choices(scene.damper, max(abs(speed) for speed in models.rotor.profile.speeds))
    )
    units = {rung.tangents: _one_peak(rung, scene.speed) for rung in rungs if rung.steps}
    free = replace(models.rotor, static_force=(0.0, 0.0))
    return _ladder(scene, rungs, "m", free, units=units, steady=False)


def _choices(table: DamperTable, fastest: float) -> list[tuple[candidates.DamperFilm, int]]:
    """Return films and steps of the rungs, 0 for the linear motion, the cheapest first."""
    films = candidates.built_films(table, fastest) if table.is_built else candidates.plain_films(table)
    # `own` is the richest film beside that of finite length: it has the whole cage, gives the small motion,
    # and is the last one where there is feed, for which a motion in the finite film takes minutes.
    *cheap, own = films if len(films) < 2 or films[-1].rich_law is not None else films[:-1]
    top = films[-1]
    fed = own.shape.is_fed
    choices = [(film, steps) for film in cheap for steps in CHEAP_STEPS]
    if fed:
        # Where nothing is known of the film's error, a third run would tell no more.
        choices += [(own, steps) for steps in (FED_STEPS if own.rich_law is not None else FED_STEPS[:2])]
    else:
        choices += [(own, steps) for steps in CHEAP_STEPS if own is not top]
        choices += [(top, steps) for steps in STEPS]
    if fed and own.rich_law is None:
        return choices
    # Without a film named, with the damping of the richer film, which the estimate needs anyway.
    small = own
    if own.rich_law is not None and table.film is None:
        small = replace(own, law=own.rich_law)
    return [(replace(small, name="small motion"), 0), *choices]


def _one_peak(rung: DamperPeakRung, speed: float) -> Callable[[], object]:
    def one() -> object:
        x, v = 0.5 * rung.support.clearance, abs(speed) * rung.support.clearance
        return rung.tangent(x, 0.0, 0.1 * v, 0.5 * v, 0.0)

    return one


# What squeeze-film dampers bring to scenes and questions.


LADDERS = {
    **dict.fromkeys(UNITS, damper_ladder),
    "peak_displacement": damper_peak_ladder,
    "cosimulation_error": coupling_ladder,
}


# A rotor on a damper that conserves its oil, in time: a lost blade, a run-up, an orbit past holes.


LEVELS = ((32, 8), 48), ((48, 12), 96), ((72, 16), 192)
"""Cells, and steps of a turn, of the rungs."""

STEP_TIME = 3e-6
"""About what a step takes for each cell [s]."""

TURNS, REPEATED = (12, 24, 48, 96), 1e-3
"""Turns after which an orbit is looked at, and its change from turn to turn when steady."""


Follow = Callable[[float], Trajectory]
"""Takes a time [s] and returns the motion from rest that long."""


def follow(damper: JFODamper, rotor: RigidRotor, steps: int, duration: float) -> Trajectory:
    """Return a motion from rest in so many steps of a turn; raises FilmContactError at the wall."""
    fastest = max(abs(speed) for speed in rotor.profile.speeds)
    count = math.ceil(duration * fastest * steps / (2.0 * math.pi) - 1e-9)
    times = duration / count * np.arange(count + 1)
    try:
        return simulate(rotor, damper, duration=duration, times=times, max_step=duration / count)
    except errors.ContactError as error:
        raise errors.FilmContactError(f"the rotor touches the wall: {error}") from error


def _run_ladder(scene: Scene, value: Callable[[Follow, int], float], unit: str, *, steady: bool) -> Ladder:
    """Return the ladder of a motion on the film that conserves its oil.

    `value` takes what follows the motion and the steps of a turn, and returns the quantity. Its error is the
    changes since steps twice as long and since half the cells: some thrice the error.
    """
    table, rotor = scene.damper, damper_models(scene).rotor
    damper = table.conserved(table.supply)

    @cache
    def run(cells: tuple[int, int], steps: int) -> float:
        return value(partial(follow, replace(damper, cells=cells), rotor, steps), steps)

    def rung(cells: tuple[int, int], steps: int) -> Rung:
        around, along = cells
        fewer = 2 * round(0.25 * around), 2 * round(0.25 * along)

        def judge(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
            others = run(cells, steps // 2), run(fewer, steps)
            error = sum(abs(other / found.value - 1.0) for other in others)
            return ErrorEstimate(error, "steps twice as long, half the cells", bound=True)

        name = f"conserved oil {around} x {along}, {steps} steps"
        seconds = STEP_TIME * math.prod(cells) * steps * TURNS[0]
        return counted_rung(name, ("answers", name), seconds, lambda _: (run(cells, steps), None), judge)

    rungs = tuple(rung(cells, steps) for cells, steps in LEVELS)
    return _ladder(scene, rungs, unit, rotor, units={}, steady=steady)


def _repeated(rotor: RigidRotor, quantity: str, follow: Follow, steps: int) -> float:
    """Return a quantity of the last turn past feed holes, once it does so from turn to turn.

    The amplitude is the largest distance from the mean place, and the transmissibility that of the force at
    the rotor's frequency, the longer half axis of its ellipse.
    """
    period = 2.0 * math.pi / abs(rotor.profile.speeds[-1])
    for turns in TURNS:
        run = follow(turns * period)
        last, before = (of_turn(run, steps, rotor, quantity, back) for back in (1, 2))
        if abs(last - before) <= REPEATED * abs(last):
            return last
    raise errors.ConvergenceError(
        f"the orbit must repeat itself to {REPEATED:g} within {TURNS[-1]} turns, and changes by "
        f"{abs(last / before - 1.0):.2g} from the last but one to the last"
    )


def of_turn(run: Trajectory, steps: int, rotor: RigidRotor, quantity: str, back: int) -> float:
    """Return a quantity of one turn of so many steps, 1 the last."""
    end = len(run.time) - (back - 1) * steps
    turn = slice(end - steps, end)
    if quantity == "unbalance_amplitude":
        q = run.position[:, turn]
        return float(np.hypot(*(q - q.mean(axis=1, keepdims=True))).max())
    speed, signals = rotor.profile.speeds[-1], run.signals
    force: Array = signals["force_x"][turn] + 1j * signals["force_y"][turn]
    wave = np.exp(2j * math.pi * np.arange(steps) / steps)
    size = sum(abs(np.mean(force * one)) for one in (wave, wave.conj()))
    return float(size / (rotor.unbalance * speed**2))
