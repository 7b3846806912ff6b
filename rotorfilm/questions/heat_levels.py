"""The effect of heat on a question about a bearing with a film: T0, T1, T2 and T3.

T0 has the viscosity of fresh oil, T1 one temperature in the balance of the heat, both on every film of the
question; T2 has a temperature over the film, T3 over and across it. The error of T1 and T2 by heat is what a
few steps towards T3 on their film change (`HeatSteps`); that of T0 what the balance at its place would, and
where that is little the steps from there. It is added to the error of the film.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from ..bearings.journal import JFOFilm, JournalBearing
from ..core.answers import HEATED, SAFETY, BaseRung, ErrorEstimate, Found, Ladder, Rung, Work, WorkUnit
from ..core.errors import InputError, RotorfilmError
from ..scenes.film_heat import (
    FIELD_LEVELS,
    REFERENCE,
    FieldLevel,
    HeatError,
    HeatSteps,
    JudgedRest,
    WarmRest,
    assumed_figures,
    ends_within,
    grid_error,
    uniform_rest,
)
from ..scenes.film_rungs import FilmCandidate, FilmRung

if TYPE_CHECKING:
    from ..scenes.scene import Scene

# Rungs of a journal on a film with a temperature field: T2 over it, T3 over and across it.
#
# Questions about a rest have their value there; those about a motion are answered on the film of T3, which
# keeps the temperature of the rest.


@dataclass(frozen=True, kw_only=True)
class RestQuestion(JudgedRest):
    """A question about a journal in the balance of its heat, asked where it rests at one speed.

    Attributes
    ----------
    load : (float, float) [N]
    speed : float [rad/s]
    make : callable
        Takes a film at one temperature and returns the rung that answers on it.
    value : callable
        The quantity of a rest, or of small motion about it.
    distance : callable
        Takes a value and a better one, and returns how far it is off in the unit of the tolerance.
    moves : bool
        Whether the quantity is one of a motion, which takes more than a rest.
    levels : tuple of FieldLevel
        Those with a temperature field.
    rests, field_rests : float
        Rests that an answer takes about, on films of one temperature and on those with a field.
    """

    load: tuple[float, float]
    speed: float
    make: Callable[[Any], Rung]
    value: Callable[[Any], Any]
    distance: Callable[[Any, Any], float]
    moves: bool = False

    levels: ClassVar[tuple[FieldLevel, ...]] = FIELD_LEVELS
    rests: ClassVar[int] = 1
    field_rests: ClassVar[float] = 1.0

    def uniform(self, level: HeatLevel, film: FilmCandidate, before: Found | None) -> UniformSolution:
        """Return the answer on a film at the temperature that it has with the journal at rest."""
        own = uniform_rest(film.reaction, self.load, self.speed, level.temperature(film.reaction))
        rung = self.make(film.at_temperature(own.temperature))
        return UniformSolution(level, rung.answer(level.lower(before)), rung, own)

    def lower(self, level: HeatLevel, before: Found | None) -> Found | None:
        """Return the answer of a lower rung of the same level."""
        return level.lower(before)

    def on_field(self, level: FieldLevel, bearing: Any, before: Found | None) -> FieldSolution:
        """Return the answer on a film with a temperature field."""
        own = level.rest(bearing, self.load, self.speed)
        return FieldSolution(level, self.value(own), own, self)

    def judged(self, solved: UniformSolution) -> RestQuestion:
        """Return the question, which judges rests at its speed."""
        return self

    def moving(self, bearing: Any) -> float:
        """Return the error by heat that moves with the journal, which is at rest."""
        return 0.0

    def moved(self, film: FilmCandidate) -> Callable[[Any], float]:
        """Return a call that takes another bearing and returns how far its answer by T1 is off."""
        own = uniform_rest(film.reaction, self.load, self.speed)
        return lambda other: self.apart(own, uniform_rest(other, self.load, self.speed))


class FieldSolution(NamedTuple):
    """An answer on a film with a temperature field, the rest there and what judges that."""

    level: FieldLevel
    value: Any
    own: WarmRest
    judge: Any


@dataclass(frozen=True, kw_only=True)
class FieldRung(BaseRung):
    """An answer on a film with its temperature over it, or over and across it.

    Attributes
    ----------
    level : FieldLevel
        T2 or T3.
    bearing : JournalBearing or JFOFilm
        On its oil.
    question : RestQuestion or WhirlQuestion
    """

    level: FieldLevel
    bearing: JournalBearing | JFOFilm
    question: Any

    @property
    def name(self) -> str:
        """Level, cells and layers."""
        return f"{self.level.name}, JFO" if isinstance(self.bearing, JFOFilm) else self.level.name

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        seconds = self.question.field_rests * self.level.seconds
        return WorkUnit(f"answers of {self.name}", ("answers", self.name), nominal=seconds)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity at the rest on this film."""
        solved = self.question.on_field(self.level, self.bearing, before)
        return Found(solved.value, {self.unit: 1}, solved)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return of T2 what steps towards T3 change, of T3 what coarser grids do; see `grid_error`."""
        own, judge = found.solution.own, found.solution.judge
        done = {WorkUnit(f"estimates of {self.name}"): 1}
        if self.level.layers:
            grid = grid_error(self.level, own, partial(self._rest, before, judge), judge.apart)
            heat, method, doubt = HeatError(grid, True), "cells twice as long, half the layers", ""
        else:
            steps = HeatSteps(self.bearing, own)
            heat, method, doubt = judge.error(own, steps), "steps towards T3", steps.doubt
        heat, method = with_moving(judge, self.bearing, heat, method)
        return ErrorEstimate(heat.error, method, done, bound=heat.bound, doubt=doubt)

    def _rest(self, before: Found | None, judge: Any, level: FieldLevel) -> WarmRest:
        """Return the rest by another level; that of a lower rung is known."""
        solved = None if before is None else before.solution
        if isinstance(solved, FieldSolution) and solved.level == level and solved.judge is judge:
            return solved.own
        return level.rest(self.bearing, judge.load, judge.speed)


def with_moving(judge: Any, bearing: Any, heat: HeatError, method: str) -> tuple[HeatError, str]:
    """Return an error by heat and how it is known, with that by heat which moves with the journal."""
    moving = judge.moving(bearing)
    if not moving:
        return heat, method
    bound = heat.bound or moving > heat.error
    return HeatError(heat.error + moving, bound), f"{method}, moving heat {moving:.2g} lower"


def field_rungs(bearing: JournalBearing | JFOFilm, question: Any) -> tuple[Rung, ...]:
    """Return T2 and T3, the latter on two grids."""
    return tuple(FieldRung(level=level, bearing=bearing, question=question) for level in question.levels)


@dataclass(frozen=True, eq=False)
class FieldFilms:
    """A film of T3 that keeps the temperature of its rest, and that of cells twice as long; found once.

    Attributes
    ----------
    film : FilmRung
        Whose name and bearing they have.
    load : (float, float) [N]
    speed : float [rad/s]
    """

    film: FilmRung
    load: tuple[float, float]
    speed: float

    @cached_property
    def own(self) -> WarmRest:
        """The rest."""
        return REFERENCE.rest(self.film.reaction, self.load, self.speed)

    @cached_property
    def half(self) -> WarmRest:
        """That on cells twice as long."""
        return REFERENCE.coarser.rest(self.film.reaction, self.load, self.speed)

    @cached_property
    def frozen(self) -> FilmRung:
        """The film at rest; there is no richer one."""
        film = self.film.frozen(self.own.reaction)
        return replace(film, rich=film.reaction, rich_name="itself")


class FrozenSolution(NamedTuple):
    """A motion on the film of T3, as the next rung starts from it."""

    found: Found
    rung: Rung


@dataclass(frozen=True, kw_only=True)
class FrozenRung(BaseRung):
    """A motion on the film of T3 that keeps the temperature of the rest.

    Attributes
    ----------
    films : FieldFilms
    question : RestQuestion or WhirlQuestion
    """

    films: FieldFilms
    question: Any

    @property
    def name(self) -> str:
        """T3, and the rung of the motion."""
        named = replace(self.films.film, name=REFERENCE.grid)
        return f"{REFERENCE.level}, {self.question.make(named).name}"

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        return WorkUnit(f"answers of {self.name}", ("answers", self.name), nominal=2.0 * REFERENCE.seconds)

    def answer(self, before: Found | None) -> Found:
        """Return the answer on the film."""
        rung = self.question.make(self.films.frozen)
        found = rung.answer(self._lower(before))
        return Found(found.value, {self.unit: 1}, FrozenSolution(found, rung))

    def _lower(self, before: Found | None) -> Found | None:
        solved = None if before is None else before.solution
        return solved.found if isinstance(solved, FrozenSolution) else None

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change since cells twice as long, and the error of the motion on one film."""
        solved: FrozenSolution = found.solution
        about = solved.rung.estimate(solved.found, self._lower(before), tolerance)
        grid = self.question.apart(self.films.half, self.films.own)
        method = f"{about.method}; cells twice as long, {grid:.2g}"
        work = {WorkUnit(f"estimates of {self.name}"): 1}
        bound = grid > about.error or about.bound
        return ErrorEstimate(about.error + grid, method, work, bound=bound, doubt=about.doubt)


def motion_rungs(film: FilmRung, questions: tuple[Any, ...]) -> tuple[Rung, ...]:
    """Return the rungs of motions on the film of T3, for questions that differ in their rungs."""
    films = FieldFilms(film, questions[0].load, questions[0].speed)
    return tuple(FrozenRung(films=films, question=question) for question in questions)


# Thermal rungs of a question about a journal on an oil: T0, T1, T2 and T3.


ONE_TEMPERATURE = "laminar films, all at one temperature in the balance of their heat"
"""`within` of films of pads on an oil, over which no temperature field is known."""

BALANCE = "its balance"
"""How the error by heat of fresh oil is known."""

BALANCES = 60
"""Forces with derivatives that an equilibrium in the balance of its heat takes about."""


@dataclass(frozen=True, eq=False)
class HeatLevel:
    """T0 or T1: rungs of one level share the error of its heat.

    Attributes
    ----------
    name : str
    """

    name: str

    def temperature(self, bearing: Any) -> float | None:
        """Return the temperature [K] that fresh oil has, or None for that of the balance."""
        return bearing.cooled[1].supply_temperature if self is FRESH else None

    def lower(self, before: Found | None) -> Found | None:
        """Return the answer of a lower rung on its film, if it is of the same level."""
        solved = None if before is None else before.solution
        return solved.found if isinstance(solved, UniformSolution) and solved.level is self else None


FRESH, BALANCED = HeatLevel("T0"), HeatLevel("T1")


class UniformSolution(NamedTuple):
    """An answer at one temperature, as its estimate and the next rung of the level start from it.

    `own` is the rest there, None where that is not known yet.
    """

    level: HeatLevel
    found: Found
    rung: Any
    own: WarmRest | None = None


@dataclass(frozen=True, kw_only=True)
class UniformRung(BaseRung):
    """An answer on a film of one temperature.

    Attributes
    ----------
    level : HeatLevel
    film : FilmCandidate
        Of the bearing on its oil.
    question : RestQuestion or WhirlQuestion
    """

    level: HeatLevel
    film: FilmCandidate
    question: Any

    @property
    def name(self) -> str:
        """Level and rung of the film."""
        return f"{self.level.name}, {self.question.make(self.film).name}"

    @property
    def prior(self) -> float:
        """That of the film."""
        return self.question.make(self.film).prior

    @property
    def refines(self) -> tuple[object, ...]:
        """Level, and what the rung of the film refines."""
        inner = self.question.make(self.film).refines
        return (self.level, *inner) if inner else ()

    @property
    def shares(self) -> object:
        """The error of the heat."""
        return self.level

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        nominal = self.film.time(self.question.rests * BALANCES)
        return WorkUnit(f"answers of {self.name}", (self.level, self.name), nominal=nominal)

    def answer(self, before: Found | None) -> Found:
        """Return the answer on the film."""
        solved = self.question.uniform(self.level, self.film, before)
        return Found(solved.found.value, {self.unit: 1}, solved)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the film, and what the heat of the richer level would change."""
        solved: UniformSolution = found.solution
        about = solved.rung.estimate(solved.found, self.question.lower(self.level, before), tolerance)
        return with_heat(about, lambda: self.heat(solved, tolerance), f"estimates of {self.name}")

    def heat(self, solved: UniformSolution, tolerance: float) -> tuple[HeatError, str, str]:
        """Return the error by heat, how that is known, and why to doubt it."""
        bearing, judge = self.film.reaction, self.question.judged(solved)
        load, speed, level = judge.load, judge.speed, self.level
        own = start = solved.own or uniform_rest(bearing, load, speed, level.temperature(bearing))
        if level is FRESH:
            start = uniform_rest(bearing, load, speed, balance_at(bearing, own))
        heat, how, doubt = HeatError(judge.apart(own, start), False), BALANCE, ""
        if heat.error * SAFETY < tolerance and has_field(bearing):
            steps = HeatSteps(bearing, start)
            heat, how, doubt = judge.error(own, steps), "steps towards T3", steps.doubt
        return *with_moving(judge, bearing, heat, how), doubt

    def expected(self, done: Work) -> Work:
        """Return one answer."""
        return {self.unit: 1}


def balance_at(bearing: JournalBearing, own: WarmRest) -> float:
    """Return the temperature at which the heat of a bearing balances at the place of a rest [K]."""
    temperature: float = bearing.balanced_temperature(own.rest.position, np.zeros(2), own.rest.speed)
    return temperature


def with_heat(
    about: ErrorEstimate, find: Callable[[], tuple[HeatError, str, str]], work: str
) -> ErrorEstimate:
    """Return an error on a film of one temperature with that by heat, which rungs of a level share.

    `find` returns the latter, how it is known, and why to doubt it; where it fails, the error is infinite.
    """
    try:
        heat, how, doubt = find()
    except RotorfilmError as error:
        return about._replace(error=math.inf, doubt=f"its error by heat is not known: {error}")
    bound = heat.bound if heat.error > about.error else about.bound
    method = f"{about.method}; heat: {how}, {heat.error:.2g}"
    total = about.error + heat.error
    doubt = about.doubt or doubt
    return ErrorEstimate(total, method, {WorkUnit(work): 1}, bound=bound, doubt=doubt, shared=heat.error)


def with_losses(films: Sequence[FilmCandidate], wanted: str) -> tuple[FilmCandidate, ...]:
    """Return the films whose losses are known; InputError where there is none, as they are wanted."""
    known = tuple(film for film in films if film.has_losses)
    if known:
        return known
    raise InputError(f"film must be a law with losses for {wanted}, as map or reynolds, got {films[0].name}")


def known_films(films: Sequence[FilmCandidate]) -> tuple[Any, ...]:
    """Return the films whose losses, which heat the oil, are known; InputError where there is none."""
    return with_losses(films, "an oil that warms")


def has_field(bearing: Any) -> bool:
    """Return whether a temperature over the film of a bearing is known: not of films of pads."""
    return isinstance(bearing, JournalBearing | JFOFilm)


def within_heat(bearing: Any) -> str:
    """Return the physics in which the tolerance of an answer on an oil is meant."""
    return HEATED if has_field(bearing) else ONE_TEMPERATURE


def any_bearing(scene: Scene) -> Any:
    """Return the bearing with a film of a scene, on its oil; of a journal by Reynolds rupture."""
    return scene.film_table.build() if scene.journal is None else scene.journal_bearing


def thermal_ladder(
    scene: Scene,
    films: Sequence[FilmCandidate],
    questions: tuple[Any, ...],
    unit: str,
    *,
    fresh: bool = True,
) -> Ladder:
    """Return the ladder of a question about a bearing on an oil.

    Parameters
    ----------
    scene : Scene
    films : sequence of FilmCandidate
        Those of the question, the cheapest first.
    questions : tuple of RestQuestion or WhirlQuestion
        The question, and as it is asked of the further rungs of each film.
    unit : str
    fresh : bool
        Whether the film of fresh oil has an answer.

    Raises
    ------
    InputError
        If no film has losses, which heat the oil.
    """
    known = known_films(films)
    # with the cheapest film: that of the scene might have to make a map first
    quick, question = known[0].reaction, questions[0]
    uniform = tuple(
        UniformRung(level=level, film=film, question=one)
        for level in ((FRESH, BALANCED) if fresh else (BALANCED,))
        for film in known
        for one in questions
    )
    fields: tuple[Rung, ...] = ()  # beside openings within the length only conserved oil is known
    if has_field(quick) and not ends_within(quick):
        fields = motion_rungs(known[0], questions[:2]) if question.moves else field_rungs(quick, question)

    def assumptions() -> tuple[str, ...]:
        return assumed_figures(quick, question.moved(known[0]), fields=has_field(quick))

    return Ladder(
        rungs=(*uniform, *fields),
        unit=unit,
        remarks=scene.film_remarks,
        within=within_heat(quick),
        assumptions=assumptions,
        distance=question.distance,
    )
