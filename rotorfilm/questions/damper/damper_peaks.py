"""How far a rotor on a squeeze-film damper goes after a blade is lost, or over a run-up."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...answers import ISOTHERMAL, ErrorEstimate, Found, Work, WorkUnit
from ...errors import FilmContactError, InputError
from ...ladders import Ladder
from ...model import Array, Reaction, Tangent, largest_eccentricity_ratio, prepared_tangent
from ...motion.transient.equal_steps import MarchMotion, linear_march, peak
from ...motion.transient.shaken_rotor import NONE, RestTangent, ShakenRotor, StatesAlong, states_along
from ...reactions.added_mass import inertial
from ...rotors import RigidRotor
from ...scenes.damper.built_films import built_films
from ...scenes.damper.damper_films import NO_RICHER, DamperFilm, mapped_short, plain_films, quiet, sprung
from ...scenes.damper.damper_models import damper_models
from ...scenes.damper.damper_remarks import rotor_remarks
from ...scenes.damper.damper_table import DamperTable
from ...scenes.excitation_table import BladeLossTable, RunUpTable
from ..peak_rung import LINEAR_STEPS, SAMPLED, STEPS, PeakMotion, PeakRung
from .conserved_peaks import conserved_peak_ladder

if TYPE_CHECKING:
    from ...scenes.scene import Scene

CHEAP_STEPS = (48, 192)
"""Those of films that leave out the layer or the flow around the circumference."""

FED_STEPS = (24, 48, 96)
"""Those of films with feed, which have no map: a force takes some tenths to thousandths of a second."""

LINEAR_STEP, DEFECT = WorkUnit("linear steps"), WorkUnit("defects of a richer film")


@dataclass(frozen=True, kw_only=True)
class DamperPeakRung(PeakRung[DamperFilm]):
    """The peak in a squeeze-film damper.

    Attributes
    ----------
    rotor : RigidRotor
        At rest in the center.
    stiffness : float [N/m]
        Of the retainer springs.
    duration : float [s]
    """

    rotor: RigidRotor
    stiffness: float
    duration: float

    @property
    def tangents(self) -> WorkUnit:
        """One force of this film with derivatives."""
        return WorkUnit(f"tangents of {self.film.name}", ("tangents", self.film))

    @cached_property
    def support(self) -> Reaction:
        """Film and springs, the film on its map where it has one."""
        return sprung(self.film.moving, self.stiffness)

    @cached_property
    def tangent(self) -> Tangent:
        """Force and derivatives of film and springs for plain numbers."""
        return prepared_tangent(self.support)

    @cached_property
    def rich(self) -> Reaction | None:
        """The richer film and the springs; None if there is none."""
        found = self.film.rich_moving
        return None if found is None else sprung(found, self.stiffness)

    @property
    def shaken(self) -> ShakenRotor:
        """The rotor on film and springs, and what shakes it."""
        return ShakenRotor(self.support, self.rotor.mass, 0.0, self.rest, self._pull)

    @property
    def rest(self) -> Array:
        """Where the rotor is at rest (2,) [m]: in the center, or at its offset."""
        return np.array(self.rotor.position)

    @cached_property
    def at_rest(self) -> RestTangent:
        """Film and springs in the center: there also a cavitated film is linear in the velocity."""
        rest, still = self.rest, np.zeros(2)
        rate = self.support.clearance * abs(self.rotor.profile.speeds[-1] or 1.0)
        heavy = inertial(self.support)
        added = NONE if heavy is None else heavy.mass(rest, np.array([rate, 0.0]))
        force = -self.rotor.static_load
        if rest.any():
            slopes = self.support.jacobian(rest, still, 0.0)
            return RestTangent(force, -slopes[:, :2], -slopes[:, 2:4], added)
        damping = -float(self.support.force(still, np.array([rate, 0.0]), 0.0)[0]) / rate
        fed = self.film.is_fed
        own = -float(self.film.reaction.jacobian(still, still, 0.0)[0, 0]) if fed else 0.0
        return RestTangent(force, (self.stiffness + own) * np.eye(2), damping * np.eye(2), added)

    def grid(self, steps: int) -> tuple[float, int]:
        """Return the length [s] and an even number of steps, so that one ends where a run-up turns back."""
        fastest = max(abs(speed) for speed in self.rotor.profile.speeds)
        count = 2 * math.ceil(self.duration * fastest * steps / (4.0 * math.pi))
        return self.duration / count, count

    def _pull(self, t: float) -> tuple[float, float]:
        x, y = (self.rotor.unbalance_force(t) + self.rotor.static_load).tolist()
        return x, y

    def answer(self, before: Found | None) -> Found:
        """Return the largest distance from the center [m]; raises FilmContactError at the wall."""
        if self.steps:
            return self.nonlinear(before)
        motion = self.linear(LINEAR_STEPS)
        if np.hypot(*motion.position).max() >= self.support.clearance:
            raise FilmContactError("the linear motion leaves the clearance")
        half = self.linear(LINEAR_STEPS // 2)
        solved = PeakMotion(motion, peak(half.position), 0)
        return Found(peak(motion.position), {LINEAR_STEP: motion.time.size}, solved)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the steps (order increment), and of the film by its defect along the motion."""
        motion, steps = found.solution.motion, self.increment(found)
        if self.film.rich_law is None and not math.isfinite(self.film.bound()):
            return ErrorEstimate(math.inf, "order increment", doubt=NO_RICHER)
        reach = float(np.hypot(*motion.position).max()) / self.support.clearance
        limit = _reach(self.rich or self.support)
        if reach >= limit:
            return ErrorEstimate(math.inf, "defect", doubt=_beyond(reach, limit))
        if self.film.rich_law is None and self.steps:
            return self._by_bound(motion, found.value, steps)
        change, doubt, calls = self._by_defect(motion, found.value, self.rich or self.support)
        # Errors of opposite signs cancel only as far as each is known: to a tenth, or to second order.
        largest = max(abs(change), abs(steps))
        error = max(abs(change + steps), largest * max(0.1, min(1.0, largest)))
        name = "its own film" if self.rich is None else "the film of finite length"
        work = {DEFECT: calls, **self.film.rich_work}
        return ErrorEstimate(error, f"order increment; defect of {name}", work, doubt=doubt)

    def _by_bound(self, motion: MarchMotion, value: float, steps: float) -> ErrorEstimate:
        """Return the error of the steps, and what the verified error of the film could do all along."""
        states = self._sampled(motion)
        film = self.shaken.tangents(self.support, states)
        off = self.film.bound() * (film.force + self.stiffness * states.position)
        mass = self.rotor.mass * np.eye(2)[:, :, None] + film.mass
        moved = linear_march(mass, film.stiffness, film.damping, off, states.step).position
        bound = float(np.hypot(*moved).max()) / value
        method = "order increment; verified bound of the film, propagated"
        work = {self.tangents: states.position.shape[1]}
        return ErrorEstimate(abs(steps) + bound, method, work, abs(steps) < bound)

    def _sampled(self, motion: MarchMotion) -> StatesAlong:
        """Return samples of a motion; the first is off the rest."""
        # With feed the richer film takes milliseconds for a force.
        states = states_along(motion, self.stride(SAMPLED // 2 if self.film.is_fed else SAMPLED))
        # A cavitated film has no derivative at rest: the direction in which the rotor starts.
        states.velocity[:, 0] = 1e-3 * states.velocity[:, 1]
        return states

    def _by_defect(self, motion: MarchMotion, value: float, rich: Reaction) -> tuple[float, str, int]:
        """Return the relative change of the peak that the richer film would make, and why not to trust it."""
        states = self._sampled(motion)
        q, calls = states.position, states.position.shape[1]
        moved, doubt = self.by_defect(states, rich)
        reach, limit = float(np.hypot(*(q + moved)).max()) / self.support.clearance, _reach(rich)
        if reach >= 1.0:
            doubt = "with its error the rotor would leave the clearance: a jump, or contact, and not linear"
            return math.inf, doubt, calls
        return (peak(q + moved) - peak(q)) / value, _beyond(reach, limit) if reach >= limit else doubt, calls

    def expected(self, done: Work) -> Work:
        """Return three tangents for each step."""
        return {self.tangents: 3 * self.grid(self.steps)[1]} if self.steps else {}


def _reach(reaction: Reaction) -> float:
    return min(0.999, largest_eccentricity_ratio(reaction))


def _beyond(reach: float, limit: float) -> str:
    return (
        f"the rotor goes to {reach:.4g} of the clearance and the film is known to {limit:.4g}: it may touch "
        "the wall"
    )


@quiet()
def damper_peak_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the largest distance after a blade is lost, or over a run-up, in a damper.

    Raises
    ------
    InputError
        If the scene loses no blade and does not run up, has no rotor, or does not turn.
    """
    if not isinstance(scene.excitation, BladeLossTable | RunUpTable):
        got = "none" if scene.excitation is None else f"{scene.excitation!r}"
        raise InputError(f'excitation of kind "blade_loss" or "run_up" is required for {quantity}, got {got}')
    assert scene.damper is not None  # or the ladder is another one
    if scene.damper.supply is not None:
        if scene.damper.film is not None:
            raise InputError(
                f"damper.film must be left out beside supply for {quantity}, as only the film that conserves "
                f"its oil knows the supply in time, got {scene.damper.film!r}"
            )
        return conserved_peak_ladder(scene)
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
    units = {rung.tangents: _one(rung, scene.speed) for rung in rungs if rung.steps}
    small, spring = mapped_short(scene.damper), scene.damper.stiffness
    free = replace(models.rotor, static_force=(0.0, 0.0))
    remarks = rotor_remarks(scene.damper, small, spring, free, scene.lubricant.properties, steady=False)
    return Ladder(
        rungs=rungs,
        unit="m",
        units=units,
        remarks=remarks,
        within=ISOTHERMAL,
    )


def _choices(table: DamperTable, fastest: float) -> list[tuple[DamperFilm, int]]:
    """Return films and steps of the rungs, 0 for the linear motion, the cheapest first."""
    films = built_films(table, fastest) if table.is_built else plain_films(table)
    # `own` is the richest film beside that of finite length: it has the whole cage, gives the small motion,
    # and is the last one where there is feed, for which a motion in the finite film takes minutes.
    *cheap, own = films if len(films) < 2 or films[-1].rich_law is not None else films[:-1]
    top = films[-1]
    fed = own.is_fed
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


def _one(rung: DamperPeakRung, speed: float) -> Callable[[], object]:
    def one() -> object:
        x, v = 0.5 * rung.support.clearance, abs(speed) * rung.support.clearance
        return rung.tangent(x, 0.0, 0.1 * v, 0.5 * v, 0.0)

    return one
