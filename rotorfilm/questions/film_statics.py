"""Questions to the films of any bearing: their ladder and its effects; rest and whirl threshold."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ..analysis import coefficients, equilibrium, threshold_near, whirl_threshold
from ..bearings.journal import JFOFilm, JournalBearing
from ..core.answers import (
    ISOTHERMAL,
    SAFETY,
    CandidateRung,
    ErrorEstimate,
    Ladder,
    Rung,
    RungResult,
    Work,
    WorkUnit,
    relative_change,
)
from ..core.errors import InputError, RotorfilmError
from ..core.results import Equilibrium, WhirlThreshold
from ..scenes.film_heat import FIELD_LEVELS, FieldLevel, RestJudge, WarmRest, uniform_rest
from ..scenes.film_rungs import FilmCandidate, FilmRest, least_stable, whirl_growth, whirl_matrix
from ..scenes.oil_film_tables import ConservingTable, effect_of, is_left_laminar
from .conserved_oil import Change, change_at_rest, coarse_films, conserved_ladder, conserved_oil, rest_on
from .heat_levels import BALANCED, HeatLevel, WarmSolution, answer_below, heat
from .quantities import QUANTITIES, TEMPERATURES, FilmQuantity, relative
from .turbulent_oil import turbulent_oil
from .walk import NoAnswerError

if TYPE_CHECKING:
    from ..scenes.scene import Scene

Films = Callable[["Scene"], Sequence[FilmCandidate]]
"""Takes a scene and returns the candidates for its bearing, the cheapest first."""

Units = Mapping[WorkUnit, Callable[[], object]]
"""Calls that do one unit of work."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FilmQuestion:
    """A question to the films of a bearing: how a film answers it, and what it is at a rest.

    Attributes
    ----------
    load : (float, float) [N]
    speed : float [rad/s]
    unit : str
    make : callable
        Takes a film of one temperature and a count of samples or steps, and returns the rung that answers.
    value : callable
        The quantity of a rest, or of small motion about it.
    distance : callable
        Takes a value and a better one, and returns its error in the unit of the tolerance.
    units : callable
        Takes the films and returns calls that do one unit of work of each.
    counts : tuple of int
        Those of the rungs on each film, in the order of their cost.
    effort : callable or None
        Of a rung, by which those on films of one viscosity are ordered.
    moves : bool
        Whether the quantity is one of a motion, which takes more than a rest.
    scaled : bool
        Whether the share counts by which the conservation of oil changes the quantity, not the difference.
    is_fresh : bool
        Whether the film of fresh oil has an answer.
    follows_oil : bool
        Whether films that conserve their oil have an answer.
    has_levels : bool
        Whether an oil has levels of heat; else all films are at the temperature of their balance.
    levels : tuple of FieldLevel
        Those with a temperature field.
    rests, field_rests : float
        Rests that an answer takes about, on films of one temperature and on those with a field.
    is_at_rest : bool
        Whether the quantity is one of a single rest, as `value` has it.
    """

    load: tuple[float, float]
    speed: float
    unit: str
    make: Callable[[Any, int], Any]
    value: Callable[[Any], Any]
    distance: Callable[[Any, Any], float]
    units: Callable[[Sequence[FilmCandidate]], Units]
    counts: tuple[int, ...] = (0,)
    effort: Callable[[Any], float] | None = None
    moves: bool = False
    scaled: bool = True
    is_fresh: bool = True
    follows_oil: bool = False
    has_levels: bool = True

    levels: ClassVar[tuple[FieldLevel, ...]] = FIELD_LEVELS
    rests: ClassVar[int] = 1
    field_rests: ClassVar[float] = 1.0
    is_at_rest: ClassVar[bool] = True

    @cached_property
    def judge(self) -> RestJudge:
        """What judges rests at its speed."""
        return RestJudge(load=self.load, speed=self.speed, value=self.value, distance=self.distance)

    def uniform(
        self, level: HeatLevel, film: FilmCandidate, count: int, before: RungResult | None
    ) -> WarmSolution:
        """Return the answer on a film at the temperature that it has with the journal at rest."""
        own = uniform_rest(film.reaction, self.load, self.speed, level.temperature(film.reaction))
        rung = self.make(film.at_temperature(own.temperature), count)
        return WarmSolution(level, rung.answer(answer_below(level, before)), rung, own)

    def on_field(self, level: FieldLevel, film: FilmCandidate, before: RungResult | None) -> WarmSolution:
        """Return the answer on a film with a temperature field."""
        own = level.rest(film.reaction, self.load, self.speed)
        return WarmSolution(level, RungResult(self.value(own), {}), own=own, judge=self.judge)

    def judged(self, solved: WarmSolution) -> RestJudge:
        """Return what judges rests by an answer."""
        return self.judge

    def judge_on(self, film: FilmCandidate) -> RestJudge:
        """Return what judges rests by the answer of a film at one temperature."""
        return self.judge

    def moved(self, film: FilmCandidate) -> Callable[[Any], float]:
        """Return a call that takes another bearing and returns the error of its answer by T1."""
        own = uniform_rest(film.reaction, self.load, self.speed)
        return lambda other: self.judge.apart(own, uniform_rest(other, self.load, self.speed))

    def conserved(self, film: JFOFilm, before: RungResult | None) -> Any:
        """Return the answer on a film that conserves its oil, from that of a lower rung if there is one."""
        return self.value(rest_on(film, self.load, self.speed))

    def conservation(self, bearing: JournalBearing) -> Callable[[RungResult], Change]:
        """Return a call that takes an answer and returns what the conservation of oil changes in it."""
        known = cache(partial(change_at_rest, self, bearing))
        return lambda found: known()


EFFECTS = [
    heat,
    conserved_oil,
    turbulent_oil,
]
"""Effects on films of any bearing: each takes scene, question, films and ladder, and returns the ladder."""


def film_ladder(scene: Scene, films: Films, question: FilmQuestion) -> Ladder:
    """Return the ladder of a question on films of one viscosity, with the effects that the scene has."""
    table = scene.film_table
    if not question.moves and getattr(table, "conserves", False):
        ladder = conserved_ladder(scene, question)
        is_laminar = effect_of(table) is None and not is_left_laminar(table, scene)
        return ladder if is_laminar else turbulent_oil(scene, question, films(scene), ladder)
    known = films(scene)
    rungs: list[Rung] = [question.make(film, count) for film in known for count in question.counts]
    if question.effort is not None:
        rungs.sort(key=question.effort)
    ladder = Ladder(
        rungs=tuple(rungs),
        unit=question.unit,
        units=question.units(known),
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
        distance=question.distance,
    )
    for effect in EFFECTS:
        ladder = effect(scene, question, known, ladder)
    return ladder


def any_bearing(scene: Scene) -> Any:
    """Return the bearing with a film of a scene, on its oil; of a journal by Reynolds rupture."""
    table: Any = scene.film_table
    return table.bearing() if isinstance(table, ConservingTable) else table.build()


def film_units(films: Sequence[FilmCandidate], speed: float) -> Units:
    """Return one unit of work of each film, at half the clearance."""
    return {unit: call for film in films for unit, call in film.units(speed).items()}


# Quantities of a journal at rest.


@dataclass(frozen=True, kw_only=True)
class StaticRung(CandidateRung):
    """The equilibrium by one film of any bearing.

    Attributes
    ----------
    quantity : FilmQuantity
    load : (float, float) [N]
    speed : float [rad/s]
    """

    quantity: FilmQuantity
    load: tuple[float, float]
    speed: float

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        film: FilmCandidate = self.film
        return film.position_prior if self.quantity.position else film.prior

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the quantity at the equilibrium of this film."""
        bearing, work = self.film.asked()
        at = equilibrium(bearing, self.load, self.speed)
        matrices = partial(coefficients, bearing, at.position, self.speed)
        own = FilmRest(
            at=at, film=self.film, bearing=self.film.reaction, position=at.position, matrices=matrices
        )
        return RungResult(self.quantity.value(own), work(), at)

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the verified bound if that is enough, else the change that the richer film would make."""
        film, quantity, at = self.film, self.quantity, found.solution
        bound = quantity.bound(film, at)
        if SAFETY * bound < tolerance:
            return ErrorEstimate(bound, film.bound_name, bound=True)
        moved = film.corrected(at, smooth=quantity.slopes)
        better = quantity.value(
            FilmRest(at=at, film=film, bearing=film.rich, position=moved.position, matrices=lambda: moved)
        )
        apart = quantity.distance(found.value, better, film.supply_temperature)
        own = quantity.judge_error(film.rich)
        return ErrorEstimate(
            apart + own,
            f"defect of {film.rich_name}",
            film.judged(smooth=quantity.slopes, defects=1 if quantity.slopes or quantity.position else 2),
            bound=film.bounded or own > apart,
            doubt=moved.doubt,
            better=None if moved.doubt else better,
        )

    def expected(self, done: Work) -> Work:
        """Return as much work as a lower rung did."""
        return self.film.expected(sum(done.values()))


UNFED = (
    "supply: the bearing has none, and its film starts with oil that is made there; with the grooves or "
    "holes that feed it this is another number"
)


def static_ladder(films: Films, scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity.

    Parameters
    ----------
    films : callable
        Takes the scene and returns the candidates for some equilibria.
    scene : Scene
    quantity : str
        A key of `QUANTITIES`.

    Raises
    ------
    InputError
        If a temperature is asked for and there is no oil, or the film has no losses, where they are asked for
        or heat the oil.
    """
    asked, load, speed = QUANTITIES[quantity], scene.static_load, scene.speed
    bearing = any_bearing(scene)
    if quantity in TEMPERATURES and not bearing.is_warming:
        raise InputError(
            f"lubricant must give the oil of the bearing for {quantity}, as a grade, got a viscosity of "
            f"{bearing.film_viscosity:g} Pa s"
        )
    supply = bearing.cooled[1].supply_temperature if bearing.is_warming else 0.0

    def known(scene: Scene) -> Sequence[FilmCandidate]:
        found = films(scene)
        return found if asked.films is None else asked.films(found, quantity)

    question = FilmQuestion(
        load=load,
        speed=speed,
        unit=asked.unit,
        make=lambda film, count: StaticRung(film=film, quantity=asked, load=load, speed=speed),
        value=asked.value,
        distance=lambda value, better: asked.distance(value, better, supply),
        units=partial(film_units, speed=speed),
        scaled=asked.scaled,
        is_fresh=quantity not in TEMPERATURES,
        follows_oil=True,
    )
    ladder = film_ladder(scene, known, question)
    table = scene.journal
    if quantity != "side_flow" or table is None or table.conserves or not bearing.geometry.plain:
        return ladder
    return replace(ladder, remarks=(*ladder.remarks, UNFED))


# At which speed a rigid rotor begins to whirl, by each film of any bearing.


AROUND = 1.4
"""A higher rung looks for the threshold within this factor of a lower one's."""

STEP = 1e-4
"""Relative change of speed over which the growth rate is differentiated."""

SPEEDS = 40
"""Equilibria that a search takes about."""


@dataclass(frozen=True, kw_only=True)
class WhirlRung(CandidateRung):
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

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the speed at which the equilibrium loses stability [rad/s]."""
        bearing, work = self.film.asked(SPEEDS)
        absent = NoAnswerError if self.film.is_close else RotorfilmError
        threshold = self.around(bearing, before, absent)
        return RungResult(threshold.speed, work(), threshold.equilibrium)

    def around(
        self, bearing: Any, before: RungResult | None, absent: type[RotorfilmError] = RotorfilmError
    ) -> WhirlThreshold:
        """Return the threshold in a bearing, around that of a lower rung first; an error without one."""
        around = None if before is None else (before.value / AROUND, before.value * AROUND)
        threshold = whirl_threshold(bearing, self.load, self.mass, around)
        if threshold.speed is None and around is not None:
            threshold = whirl_threshold(bearing, self.load, self.mass)
        if threshold.speed is None:
            raise absent(f"no threshold: {threshold.reason}, by {self.name}")
        return threshold

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the change of speed that undoes the growth which the richer film would bring.

        The whirl s = i nu of the cheap film becomes s' with the richer one; the speed changes by
        -Re s' / (d Re s/d speed), the slope being that of the cheap film along its own equilibria.
        """
        at: Equilibrium = found.solution
        film = self.film if at.temperature is None else self.film.at_temperature(at.temperature)
        bound = self._bound(film, at)
        if SAFETY * bound < tolerance:
            return ErrorEstimate(bound, film.bound_name, {self.film.tangents: 15}, bound=True)
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


# On an oil the film is at each speed as warm as its rest there: by one temperature (T0, T1) on every film, or
# by a temperature field (T2, T3), K and C at frozen temperature.


MOVING, PECLET, POWER = 0.03, 20.0, 0.8
"""Share of the speed by which heat that moves with the whirl lowers a threshold at a Peclet number, and the
power with which it grows with that: 3 % at 20, 10 % at 90, by unsteady solutions of T2."""

RESTS, NEAR, FARTHEST = 12, 3e-5, 0.2
"""Most rests on a temperature field that a search takes, the relative change of speed at which it ends, and
the largest one of a step."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WhirlQuestion(FilmQuestion):
    """The whirl threshold, asked of a film in the balance of its heat at each speed.

    Attributes
    ----------
    mass : float [kg]
        Mass of the rotor.
    secants : callable
        `rotorfilm.analysis.speed_events.secant_speed`.
    levels : tuple of FieldLevel
    rests, field_rests, is_at_rest : float, float, bool
        As of any question.
    """

    mass: float
    secants: Callable[..., Any]

    levels: ClassVar[tuple[FieldLevel, ...]] = FIELD_LEVELS[:2]
    rests: ClassVar[int] = SPEEDS
    field_rests: ClassVar[float] = 4.0
    is_at_rest: ClassVar[bool] = False

    def uniform(
        self, level: HeatLevel, film: FilmCandidate, count: int, before: RungResult | None
    ) -> WarmSolution:
        """Return the threshold by one film, of T0 that of fresh oil at all speeds."""
        fresh = level.temperature(film.reaction)
        rung = self.make(film if fresh is None else film.at_temperature(fresh), count)
        threshold = rung.around(rung.film.reaction, before)
        return WarmSolution(level, RungResult(threshold.speed, {}, threshold.equilibrium), rung)

    def on_field(self, level: FieldLevel, film: FilmCandidate, before: RungResult | None) -> WarmSolution:
        """Return the speed at which the growth of the whirl vanishes [rad/s], by secants."""
        rung = self.make(film, 0)
        speed = float((self.uniform(BALANCED, film, 0, None).found if before is None else before).value)

        def growth_at(speed: float) -> tuple[float, WarmRest]:
            own = level.rest(film.reaction, self.load, speed)
            return float(self.value(own)), own

        at = self.secants(growth_at, speed, rung.slope(speed), near=NEAR, farthest=FARTHEST, most=RESTS)
        judge = self.growth(at.speed, at.slope)
        return WarmSolution(level, RungResult(at.speed, {}), own=at.solution, judge=judge)

    def growth(self, speed: float, per_speed: float) -> RestJudge:
        """Return what K and C of a rest at a threshold [rad/s] do to it, by d(growth)/d speed."""
        return RestJudge(
            load=self.load,
            speed=speed,
            value=self.value,
            distance=lambda value, better: abs((better - value) / per_speed) / speed,
            moving=partial(moving_heat, speed=speed),
        )

    def judged(self, solved: WarmSolution) -> RestJudge:
        """Return what judges rests at the threshold."""
        speed = float(solved.found.value)
        return self.growth(speed, solved.rung.slope(speed))

    def judge_on(self, film: FilmCandidate) -> RestJudge:
        """Return what judges rests at the threshold of a film at one temperature."""
        rung = self.make(film, 0)
        return self.judged(WarmSolution(BALANCED, rung.answer(None), rung))

    def moved(self, film: FilmCandidate) -> Callable[[Any], float]:
        """Return a call that takes another bearing and returns the error of its threshold by T1."""
        found, rung = self.uniform(BALANCED, film, 0, None).found, self.make(film, 0)
        return lambda other: relative(rung.around(other, found).speed, found.value)

    def conserved(self, film: JFOFilm, before: RungResult | None) -> float:
        """Return the threshold on a film that conserves its oil, at the frequency of the whirl."""
        if before is not None:
            start = float(before.value)
        else:
            found = whirl_threshold(coarse_films(film.bearing)[-1][0], self.load, self.mass).speed
            start = self.speed if found is None else found
        return conserved_threshold(film, self.load, self.mass, start)

    def conservation(self, bearing: JournalBearing) -> Callable[[RungResult], Change]:
        """Return a call that takes a threshold and returns what the conservation of oil changes in it."""

        def change(found: RungResult) -> Change:
            reynolds, conserved = coarse_films(bearing)[-1]
            around = found.value / AROUND, found.value * AROUND
            own = whirl_threshold(reynolds, self.load, self.mass, around).speed or found.value
            return Change(own, conserved_threshold(conserved, self.load, self.mass, own), relative=True)

        return change


def moving_heat(bearing: Any, speed: float) -> float:
    """Return the share by which heat that moves with the whirl lowers a threshold [1] at a speed [rad/s].

    Oil runs at half the speed, and in forward half-speed whirl with the pattern of the film; conduction to
    the walls, as fast as the Peclet number speed clearance^2/diffusivity is small, keeps it near frozen.
    """
    oil, cooling = bearing.cooled
    per_volume = float(oil.volumetric_heat(cooling.supply_temperature))
    peclet = abs(speed) * bearing.clearance**2 * per_volume / oil.conductivity
    return MOVING * (peclet / PECLET) ** POWER


def whirl_ladder(films: Films, scene: Scene, quantity: str, *, levels: bool = True) -> Ladder:
    """Return the ladder of the whirl threshold by the films of any bearing.

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
    # With it come the modes of flexible rotors: here, before the cost of a rung is measured.
    from ..analysis.speed_events import secant_speed

    mass, load, bearing = scene.required("rigid_rotor", quantity).mass, scene.static_load, any_bearing(scene)
    near = math.sqrt(math.hypot(*load) / (mass * bearing.clearance))
    question = WhirlQuestion(
        load=load,
        speed=scene.speed,
        unit="rad/s",
        make=lambda film, count: WhirlRung(film=film, load=load, mass=mass),
        value=lambda own: whirl_growth(own.coefficients, mass),
        distance=relative_change,
        units=partial(film_units, speed=near),
        # On an oil the error by heat of a threshold by conserved oil is not known yet.
        follows_oil=not bearing.is_warming,
        has_levels=levels,
        mass=mass,
        secants=secant_speed,
    )
    return film_ladder(scene, films, question)


def conserved_threshold(film: JFOFilm, load: tuple[float, float], mass: float, start: float) -> float:
    """Return the speed at which the whirl of a rigid rotor begins [rad/s], the nearest to `start`.

    Raises
    ------
    AbsentError, ConvergenceError
        As `threshold_near`.
    """
    found = threshold_near(film, load, mass, start).speed
    assert found is not None  # or there is an error
    return found
