"""How far the journal goes after a blade is lost: linear, then nonlinear in ever shorter steps."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ...answers import ISOTHERMAL, SAFETY, ErrorEstimate, Found, Work, WorkUnit, beside_bound
from ...bearings.contact_place import reach
from ...errors import InputError
from ...ladders import Ladder, relative_change
from ...linear import coefficients, equilibrium
from ...motion.transient.equal_steps import MarchMotion, peak
from ...motion.transient.shaken_rotor import RestTangent, ShakenRotor, states_along
from ...results import Coefficients
from ...scenes.excitation_table import BladeLossTable
from ...scenes.journal.film_candidate import FilmCandidate
from ...scenes.journal.film_rung import FilmRung
from ...scenes.journal.warm_rest import WarmRest
from ..peak_rung import LINEAR_STEPS, SAMPLED, STEPS, PeakMotion, PeakRung
from .conserved_whirl import with_moved_rupture
from .field_rungs import HeatedQuestion
from .heat_rungs import thermal_ladder
from .unbalance_orbits import film_batch_units, orbit_films, require_one_unbalance

if TYPE_CHECKING:
    from ...scenes.scene import Scene

COMMON_STEPS = 192
"""Steps over a turn that are enough for most motions; by their cost the films are ordered."""

LINEAR_CALLS = 6
"""Forces with derivatives that a linear motion takes."""


@dataclass(frozen=True, kw_only=True)
class BladeLossRung(PeakRung[FilmCandidate]):
    """The peak in a journal bearing.

    Attributes
    ----------
    load : (float, float) [N]
    speed : float [rad/s]
    mass : float [kg]
    excitation : BladeLossTable
    """

    load: tuple[float, float]
    speed: float
    mass: float
    excitation: BladeLossTable

    @property
    def tangents(self) -> WorkUnit:
        """One force of the film with derivatives."""
        return self.film.tangents

    @cached_property
    def rest(self) -> Coefficients:
        """Position, K and C of the film at rest."""
        at = equilibrium(self.film.reaction, self.load, self.speed)
        return coefficients(self.film.reaction, at.position, self.speed)

    @property
    def shaken(self) -> ShakenRotor:
        """The rotor on this film, and what shakes it."""
        return ShakenRotor(self.film.reaction, self.mass, self.speed, self.rest.position, self._pull)

    @property
    def at_rest(self) -> RestTangent:
        """The film at rest, by which the linear motion goes."""
        return RestTangent(-np.array(self.load), self.rest.stiffness, self.rest.damping)

    def grid(self, steps: int) -> tuple[float, int]:
        """Return the length [s] and the number of steps, so many over a turn."""
        return 2.0 * math.pi / (abs(self.speed) * steps), math.ceil(steps * self.excitation.revolutions)

    def answer(self, before: Found | None) -> Found:
        """Return the largest distance from the center of the bearing [m]."""
        if self.steps:
            return self.nonlinear(before)
        made, motion = self.film.prepare(), self.linear(LINEAR_STEPS)
        rates = np.gradient(motion.position, self.grid(LINEAR_STEPS)[0], axis=1, edge_order=2)
        solved = PeakMotion(replace(motion, velocity=rates), math.nan, 0)
        return Found(peak(motion.position), {self.tangents: LINEAR_CALLS, **made}, solved)

    def _pull(self, t: float) -> tuple[float, float]:
        angle = self.speed * t + self.excitation.unbalance_angle
        force = self.excitation.unbalance * self.speed**2
        return self.load[0] + force * math.cos(angle), self.load[1] + force * math.sin(angle)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the steps (order increment), and of the film by its defect along the motion."""
        motion: MarchMotion = found.solution.motion
        near = reach(self.film.reaction, motion.position)
        if near >= 0.999:
            return ErrorEstimate(math.inf, "defect", doubt="the motion leaves the clearance: not linear")
        steps, how = (abs(self.increment(found)), "order increment; ") if self.steps else (0.0, "")
        bound = self.film.motion_bound(near)
        if self.steps and SAFETY * bound < tolerance:
            return beside_bound(steps, bound, how + "verified bound of the map", {})
        own = not self.steps and SAFETY * bound < tolerance
        states = states_along(motion, self.stride(SAMPLED))
        moved, doubt = self.by_defect(states, self.film.reaction if own else self.film.rich)
        change = abs(peak(states.position + moved) - peak(states.position)) / found.value
        work = {self.tangents if own else self.film.defects(smooth=False): states.position.shape[1]}
        method = f"{how}defect of {self.film.name if own else self.film.rich_name}"
        return beside_bound(change + steps, bound if own else 0.0, method, work, doubt)

    def expected(self, done: Work) -> Work:
        """Return three tangents for each step."""
        return self.film.expected(3 * self.grid(self.steps)[1] if self.steps else LINEAR_CALLS)


def blade_loss_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the peak after a blade is lost.

    Raises
    ------
    InputError
        If the scene loses no blade, has no rotor, or does not turn.
    """
    calls = calls_of(lost_blade(scene))
    assert scene.journal is not None  # whose question it is
    scene.journal.require_law(quantity)
    films = tuple(sorted(orbit_films(scene), key=lambda film: film.time(calls)))
    make = partial(BladeLossRung, **blade_numbers(scene))
    warm = scene.journal_bearing.is_warming
    ladder = warm_blade_ladder(scene, films, make) if warm else cold_blade_ladder(scene, films)

    def linear(film: FilmCandidate) -> float:
        return float(make(film=film, steps=0).answer(None).value)

    return with_moved_rupture(scene, ladder, linear, relative_change, scaled=True)


def calls_of(excitation: BladeLossTable) -> int:
    """Return how many forces most motions take."""
    return math.ceil(3 * COMMON_STEPS * excitation.revolutions)


def blade_numbers(scene: Scene) -> dict[str, Any]:
    """Return what all rungs of a lost blade share.

    Raises
    ------
    InputError
        If the scene loses no blade, has no rotor or one with an unbalance, or does not turn.
    """
    rotor = scene.rotor
    require_one_unbalance(rotor)
    excitation = lost_blade(scene)
    return {"load": scene.static_load, "speed": scene.speed, "mass": rotor.mass, "excitation": excitation}


def lost_blade(scene: Scene) -> BladeLossTable:
    """Return the blade that a scene loses; raise InputError if there is none, or nothing turns."""
    if not isinstance(scene.excitation, BladeLossTable):
        got = "none" if scene.excitation is None else f"{scene.excitation!r}"
        raise InputError(f'excitation of kind "blade_loss" is required for blade_loss_peak, got {got}')
    if scene.speed == 0.0:
        raise InputError("operation.speed must not be zero for a lost blade, got 0.0")
    return scene.excitation


def cold_blade_ladder(scene: Scene, films: Sequence[FilmCandidate]) -> Ladder:
    """Return the ladder of the peak by films of one viscosity: linear, then nonlinear, on each."""
    make = partial(BladeLossRung, **blade_numbers(scene))
    calls = calls_of(lost_blade(scene))
    films = sorted(films, key=lambda film: film.time(calls))
    rungs = [make(film=film, steps=steps) for film in films for steps in (0, *STEPS)]
    if any(film.makes_map for film in films[:-1]):
        # A linear motion takes so few forces that no map is worth it.
        rungs.sort(key=lambda rung: rung.film.time(calls if rung.steps else LINEAR_CALLS))
    return Ladder(
        rungs=tuple(rungs),
        unit="m",
        units=film_batch_units(films, scene.speed),
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
    )


def warm_blade_ladder(
    scene: Scene, films: tuple[FilmRung, ...], make: Callable[..., BladeLossRung]
) -> Ladder:
    """Return the ladder of the peak on an oil, which keeps the temperature that it has at rest.

    What a richer level of heat would change is taken of the linear motion.
    """

    def value(own: WarmRest) -> float:
        found: float = make(film=films[0].frozen(own.reaction), steps=0).answer(None).value
        return found

    def stepped(steps: int, film: FilmRung) -> BladeLossRung:
        return make(film=film, steps=steps)

    questions = tuple(
        HeatedQuestion(
            load=scene.static_load,
            speed=scene.speed,
            make=partial(stepped, steps),
            value=value,
            distance=relative_change,
            moves=True,
        )
        for steps in (0, *STEPS)
    )
    return thermal_ladder(scene, films, questions, "m")
