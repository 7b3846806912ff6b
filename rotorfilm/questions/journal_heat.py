"""Thermal rungs of a question about a journal on an oil: T0, T1, T2 and T3.

T0 has the viscosity of fresh oil, T1 one temperature in the balance of the heat, both on every film of the
question; T2 has a temperature over the film, T3 over and across it. The error of T1 and T2 by heat is what a
few steps towards T3 on their film change (`HeatSteps`); that of T0 what the balance at its place would, and
where that is little the steps from there. It is added to the error of the film.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..bearings.journal import JFOFilm, JournalBearing, film_name, has_losses
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
class HeatedQuestion(JudgedRest):
    """A question about a journal in the balance of its heat.

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
    """

    load: tuple[float, float]
    speed: float
    make: Callable[[Any], Rung]
    value: Callable[[WarmRest], Any]
    distance: Callable[[Any, Any], float]
    moves: bool = False


class FieldSolution(NamedTuple):
    """A rest on a film with a temperature field, and the rung that found it."""

    rung: FieldRung
    own: WarmRest


@dataclass(frozen=True, kw_only=True)
class FieldRung(BaseRung):
    """An answer on a film with its temperature over it, or over and across it.

    Attributes
    ----------
    level : FieldLevel
        T2 or T3.
    bearing : JournalBearing or JFOFilm
        On its oil.
    question : HeatedQuestion
    """

    level: FieldLevel
    bearing: JournalBearing | JFOFilm
    question: HeatedQuestion

    @property
    def name(self) -> str:
        """Level, cells and layers."""
        return f"{self.level.name}, JFO" if isinstance(self.bearing, JFOFilm) else self.level.name

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        return WorkUnit(f"answers of {self.name}", ("answers", self.name), nominal=self.level.seconds)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity at the rest on this film."""
        own = self.level.rest(self.bearing, self.question.load, self.question.speed)
        return Found(self.question.value(own), {self.unit: 1}, FieldSolution(self, own))

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return of T2 what steps towards T3 change, of T3 what coarser grids do; see `grid_error`."""
        own, question = found.solution.own, self.question
        done = {WorkUnit(f"estimates of {self.name}"): 1}
        if not self.level.layers:
            steps = HeatSteps(self.bearing, own)
            heat = question.error(own, steps)
            return ErrorEstimate(heat.error, "steps towards T3", done, bound=heat.bound, doubt=steps.doubt)
        error = grid_error(self.level, own, partial(self._rest, before), question.apart)
        return ErrorEstimate(error, "cells twice as long, half the layers", done, bound=True)

    def _rest(self, before: Found | None, level: FieldLevel) -> WarmRest:
        """Return the rest by another level; that of a lower rung is known."""
        rung = replace(self, level=level)
        if before is not None and isinstance(before.solution, FieldSolution) and before.solution.rung == rung:
            return before.solution.own
        own: WarmRest = rung.answer(None).solution.own
        return own


def field_rungs(bearing: JournalBearing | JFOFilm, question: HeatedQuestion) -> tuple[Rung, ...]:
    """Return T2 and T3, the latter on two grids."""
    return tuple(FieldRung(level=level, bearing=bearing, question=question) for level in FIELD_LEVELS)


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
    question : HeatedQuestion
    """

    films: FieldFilms
    question: HeatedQuestion

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


def motion_rungs(film: FilmRung, questions: tuple[HeatedQuestion, ...]) -> tuple[Rung, ...]:
    """Return the rungs of motions on the film of T3, for questions that differ in their rungs."""
    films = FieldFilms(film, questions[0].load, questions[0].speed)
    return tuple(FrozenRung(films=films, question=question) for question in questions)


# Thermal rungs of a question about a journal on an oil: T0, T1, T2 and T3.


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


class UniformSolution(NamedTuple):
    """An answer at one temperature, as its estimate and the next rung of the level start from it."""

    level: HeatLevel
    found: Found
    own: WarmRest
    rung: Rung


@dataclass(frozen=True, kw_only=True)
class UniformRung(BaseRung):
    """An answer on a film of one temperature.

    Attributes
    ----------
    level : HeatLevel
    film : FilmCandidate
        Of the bearing on its oil.
    question : HeatedQuestion
    """

    level: HeatLevel
    film: FilmCandidate
    question: HeatedQuestion

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
        return WorkUnit(f"answers of {self.name}", (self.level, self.name), nominal=self.film.time(BALANCES))

    def answer(self, before: Found | None) -> Found:
        """Return the answer on the film at the temperature that it has with the journal at rest."""
        question, bearing = self.question, self.film.reaction
        fresh = bearing.cooled[1].supply_temperature if self.level is FRESH else None
        own = uniform_rest(bearing, question.load, question.speed, fresh)
        rung = question.make(self.film.at_temperature(own.temperature))
        found = rung.answer(self._lower(before))
        return Found(found.value, {self.unit: 1}, UniformSolution(self.level, found, own, rung))

    def _lower(self, before: Found | None) -> Found | None:
        solved = None if before is None else before.solution
        same = isinstance(solved, UniformSolution) and solved.level is self.level
        return solved.found if same else None  # type: ignore[union-attr]

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the film, and what the heat of the richer level would change."""
        solved: UniformSolution = found.solution
        about = solved.rung.estimate(solved.found, self._lower(before), tolerance)
        return with_heat(about, lambda: self.heat(solved.own, tolerance), f"estimates of {self.name}")

    def balanced(self, own: WarmRest) -> WarmRest:
        """Return the rest on the film in the balance of its heat, of T1 its own."""
        if self.level is BALANCED:
            return own
        bearing, question = self.film.reaction, self.question
        return uniform_rest(bearing, question.load, question.speed, balance_at(bearing, own))

    def heat(self, own: WarmRest, tolerance: float) -> tuple[HeatError, str, str]:
        """Return the error by heat, how that is known, and why to doubt it."""
        bearing, question = self.film.reaction, self.question
        start = self.balanced(own)
        error = question.apart(own, start)
        if error * SAFETY >= tolerance:
            return HeatError(error, False), BALANCE, ""
        steps = HeatSteps(bearing, start)
        return question.error(own, steps), "steps towards T3", steps.doubt

    def expected(self, done: Work) -> Work:
        """Return one answer."""
        return {self.unit: 1}


FRESH, BALANCED = HeatLevel("T0"), HeatLevel("T1")


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


def known_films(films: tuple[FilmRung, ...]) -> tuple[FilmRung, ...]:
    """Return the films whose losses, which heat the oil, are known; InputError where there is none."""
    known = tuple(film for film in films if has_losses(film.reaction))
    if known:
        return known
    name = film_name(films[0].reaction.fitted_film)
    raise InputError(f"film must be a law with losses for an oil that warms, as map or reynolds, got {name}")


def thermal_ladder(
    scene: Scene,
    films: tuple[FilmRung, ...],
    questions: tuple[HeatedQuestion, ...],
    unit: str,
    *,
    fresh: bool = True,
) -> Ladder:
    """Return the ladder of a question about a journal on an oil.

    Parameters
    ----------
    scene : Scene
    films : tuple of FilmRung
        Those of the question, the cheapest first.
    questions : tuple of HeatedQuestion
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
    if not ends_within(quick):
        fields = motion_rungs(known[0], questions[:2]) if question.moves else field_rungs(quick, question)

    def assumptions() -> tuple[str, ...]:
        own = uniform_rest(quick, question.load, question.speed)

        def moved(other: JournalBearing) -> float:
            return question.apart(own, uniform_rest(other, question.load, question.speed))

        return assumed_figures(quick, moved, fields=True)

    return Ladder(
        rungs=(*uniform, *fields),
        unit=unit,
        remarks=scene.film_remarks,
        within=HEATED,
        assumptions=assumptions,
        distance=question.distance,
    )
