"""At which speed a rigid rotor begins to whirl, by each film of any bearing."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ..analysis import coefficients, equilibrium, whirl_threshold
from ..analysis.speed_events import secant_speed
from ..core.answers import SAFETY, CandidateRung, ErrorEstimate, Found, Ladder, Work, relative_change
from ..core.errors import InputError, RotorfilmError
from ..core.results import Equilibrium, WhirlThreshold
from ..scenes.film_heat import FIELD_LEVELS, FieldLevel, JudgedRest, WarmRest
from ..scenes.film_rungs import FilmCandidate, least_stable, whirl_growth, whirl_matrix
from .film_statics import Films, film_units, isothermal_ladder
from .heat_levels import (
    BALANCED,
    FieldSolution,
    HeatLevel,
    UniformSolution,
    any_bearing,
    known_films,
    thermal_ladder,
    within_heat,
)
from .quantities import relative
from .walk import NoAnswerError

if TYPE_CHECKING:
    from ..scenes.scene import Scene
    from ..scenes.schema import RigidRotorTable

AROUND = 1.4
"""A higher rung looks for the threshold within this factor of a lower one's."""

STEP = 1e-4
"""Relative change of speed over which the growth rate is differentiated."""

SPEEDS = 40
"""Equilibria that a search takes about."""


@dataclass(frozen=True, kw_only=True)
class WhirlRung(CandidateRung[FilmCandidate]):
    """The whirl threshold by one film of any bearing; one that warms is at each speed as warm as at rest.

    Attributes
    ----------
    load : (float, float) [N]
    mass : float [kg]
    """

    load: tuple[float, float]
    mass: float

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        return self.film.speed_prior

    def answer(self, before: Found | None) -> Found:
        """Return the speed at which the equilibrium loses stability [rad/s]."""
        bearing, work = self.film.asked(SPEEDS)
        absent = NoAnswerError if self.film.is_close else RotorfilmError
        threshold = self.around(bearing, before, absent)
        return Found(threshold.speed, work(), threshold.equilibrium)

    def around(
        self, bearing: Any, before: Found | None, absent: type[RotorfilmError] = RotorfilmError
    ) -> WhirlThreshold:
        """Return the threshold in a bearing, around that of a lower rung first; an error without one."""
        around = None if before is None else (before.value / AROUND, before.value * AROUND)
        threshold = whirl_threshold(bearing, self.load, self.mass, around)
        if threshold.speed is None and around is not None:
            threshold = whirl_threshold(bearing, self.load, self.mass)
        if threshold.speed is None:
            raise absent(f"no threshold: {threshold.reason}, by {self.name}")
        return threshold

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change of speed that undoes the growth which the richer film would bring.

        The whirl s = i nu of the cheap film becomes s' with the richer one; the speed changes by
        -Re s' / (d Re s/d speed), the slope being that of the cheap film along its own equilibria.
        """
        at: Equilibrium = found.solution
        film = self.film if at.temperature is None else self.film.at_temperature(at.temperature)
        bound = self._bound(film, at)
        if SAFETY * bound < tolerance:
            return ErrorEstimate(bound, "verified bound of the map", {self.film.tangents: 15}, bound=True)
        growth, doubt = film.rich_growth(at, self.mass)
        slope = self.slope(at.speed)
        error = abs(growth / slope) / at.speed if slope else math.inf
        work = self.film.judged(smooth=True, defects=1, tangents=15)
        return ErrorEstimate(error, f"growth by {film.rich_name}", work, bound=film.bounded, doubt=doubt)

    def _bound(self, film: FilmCandidate, at: Equilibrium) -> float:
        """Return the error [1] that the worst K and C within the verified bound would make."""
        bound = film.rest_bound(at, slopes=True)
        if not math.isfinite(bound):
            return math.inf
        found = coefficients(self.film.reaction, at.position, at.speed)
        worst = np.zeros((4, 4))
        worst[2:, :2] = bound * np.abs(found.stiffness).max() / self.mass
        worst[2:, 2:] = bound * np.abs(found.damping).max() / self.mass
        _, left, right = least_stable(whirl_matrix(found, self.mass))
        return float(np.abs(left) @ worst @ np.abs(right)) / abs(self.slope(at.speed)) / at.speed

    def slope(self, speed: float) -> float:
        """Return d Re s/d speed of the whirl of this film, by central differences."""
        low, high = (
            self.film.growth(equilibrium(self.film.reaction, self.load, near), self.mass)
            for near in (speed * (1.0 - STEP), speed * (1.0 + STEP))
        )
        return (high - low) / (2.0 * STEP * speed)

    def expected(self, done: Work) -> Work:
        """Return as much work as a lower rung did."""
        return self.film.expected(sum(done.values()))


def required_rotor(scene: Scene, quantity: str) -> RigidRotorTable:
    """Return the table of the rigid rotor; raise InputError if the scene has none."""
    if scene.rigid_rotor is None:
        raise InputError(f"rigid_rotor is required for {quantity}, got no such table")
    return scene.rigid_rotor


def whirl_ladder(films: Films, scene: Scene, quantity: str, *, levels: bool = True) -> Ladder:
    """Return the ladder of the whirl threshold by the films of any bearing, on an oil with those of its heat.

    Parameters
    ----------
    films : callable
        Takes the scene and returns the candidates for some equilibria.
    scene : Scene
    quantity : str
    levels : bool
        Whether an oil has levels of heat; else all films are at the temperature of their balance.

    Raises
    ------
    InputError
        If the scene has no rigid rotor.
    """
    mass, known = required_rotor(scene, quantity).mass, films(scene)

    def make(film: FilmCandidate) -> WhirlRung:
        return WhirlRung(film=film, load=scene.static_load, mass=mass)

    bearing = any_bearing(scene)
    if bearing.is_warming and levels:
        question = WhirlQuestion(load=scene.static_load, make=make, quick=known_films(known)[0])
        return thermal_ladder(scene, known, (question,), "rad/s")
    near = math.sqrt(math.hypot(*scene.static_load) / (mass * bearing.clearance))
    ladder = isothermal_ladder(scene, map(make, known), "rad/s", film_units(known, near))
    return replace(ladder, within=within_heat(bearing)) if bearing.is_warming else ladder


# At which speed a rigid rotor begins to whirl on an oil: the film as warm as its rest at each speed.
#
# By one temperature (T0, T1) on every film, or by a temperature field (T2, T3), K and C at frozen
# temperature.


MOVING, PECLET, POWER = 0.03, 20.0, 0.8
"""Share of the speed by which heat that moves with the whirl lowers a threshold at a Peclet number, and the
power with which it grows with that: 3 % at 20, 10 % at 90, by unsteady solutions of T2."""

RESTS, NEAR, FARTHEST = 12, 3e-5, 0.2
"""Most rests on a temperature field that a search takes, the relative change of speed at which it ends, and
the largest one of a step."""


@dataclass(frozen=True, kw_only=True)
class WhirlQuestion:
    """The whirl threshold, asked of a film in the balance of its heat at each speed.

    Attributes
    ----------
    load : (float, float) [N]
    make : callable
        Takes a film and returns the rung that answers on it.
    quick : FilmCandidate
        From whose threshold those on temperature fields start.
    moves : bool
        Whether it takes more than rests.
    distance : callable
        Takes a speed and a better one, and returns how far it is off, relative to that.
    levels : tuple of FieldLevel
        Those with a temperature field.
    rests, field_rests : float
        Rests that an answer takes about, on films of one temperature and on those with a field.
    """

    load: tuple[float, float]
    make: Callable[[Any], WhirlRung]
    quick: FilmCandidate
    moves: bool = False

    distance: ClassVar[Callable[[Any, Any], float]] = staticmethod(relative_change)
    levels: ClassVar[tuple[FieldLevel, ...]] = FIELD_LEVELS[:2]
    rests: ClassVar[int] = SPEEDS
    field_rests: ClassVar[float] = 4.0

    def uniform(self, level: HeatLevel, film: FilmCandidate, before: Found | None) -> UniformSolution:
        """Return the threshold by one film, of T0 that of fresh oil at all speeds."""
        fresh = level.temperature(film.reaction)
        rung = self.make(film if fresh is None else film.at_temperature(fresh))
        threshold = rung.around(rung.film.reaction, before)
        found = Found(threshold.speed, {}, threshold.equilibrium)
        return UniformSolution(level, found, rung)

    def lower(self, level: HeatLevel, before: Found | None) -> Found | None:
        """Return the answer of any lower rung."""
        return before

    def on_field(self, level: FieldLevel, bearing: Any, before: Found | None) -> FieldSolution:
        """Return the speed at which the growth of the whirl vanishes [rad/s], by secants."""
        rung = self.make(self.quick)
        speed = float((self.uniform(BALANCED, self.quick, None).found if before is None else before).value)

        def growth_at(speed: float) -> tuple[float, WarmRest]:
            own = level.rest(rung.film.reaction, self.load, speed)
            return whirl_growth(own.coefficients, rung.mass), own

        at = secant_speed(growth_at, speed, rung.slope(speed), near=NEAR, farthest=FARTHEST, most=RESTS)
        return FieldSolution(level, at.speed, at.solution, Growth(rung, at.speed, at.slope))

    def judged(self, solved: UniformSolution) -> Growth:
        """Return what judges rests at the threshold."""
        speed = float(solved.found.value)
        return Growth(solved.rung, speed, solved.rung.slope(speed))

    def moved(self, film: FilmCandidate) -> Callable[[Any], float]:
        """Return a call that takes another bearing and returns how far its threshold by T1 is off."""
        found, rung = self.uniform(BALANCED, film, None).found, self.make(film)
        return lambda other: relative(rung.around(other, found).speed, found.value)


@dataclass(frozen=True)
class Growth(JudgedRest):
    """What K and C of a rest at a threshold do to its speed.

    Attributes
    ----------
    rung : WhirlRung
        Of the rotor.
    speed : float [rad/s]
    per_speed : float [1]
        d(growth)/d speed.
    """

    rung: WhirlRung
    speed: float
    per_speed: float

    @property
    def load(self) -> tuple[float, float]:
        """On the journal [N]."""
        return self.rung.load

    def value(self, own: WarmRest) -> float:
        """Return the growth rate of the whirl of a rest [1/s]."""
        return whirl_growth(own.coefficients, self.rung.mass)

    def distance(self, value: float, better: float) -> float:
        """Return by which share of itself the threshold is off."""
        return abs((better - value) / self.per_speed) / self.speed

    def moving(self, bearing: Any) -> float:
        """Return the share by which heat that moves with the whirl lowers the threshold."""
        return moving_heat(bearing, self.speed)


def moving_heat(bearing: Any, speed: float) -> float:
    """Return the share by which heat that moves with the whirl lowers a threshold [1] at a speed [rad/s].

    Oil runs at half the speed, and in forward half-speed whirl with the pattern of the film; conduction to
    the walls, as fast as the Peclet number speed clearance^2/diffusivity is small, keeps it near frozen.
    """
    oil, cooling = bearing.cooled
    per_volume = float(oil.volumetric_heat(cooling.supply_temperature))
    peclet = abs(speed) * bearing.clearance**2 * per_volume / oil.conductivity
    return MOVING * (peclet / PECLET) ** POWER
