"""Rungs of a journal on a film with a temperature field: T2 over it, T3 over and across it.

Questions about a rest have their value there; those about a motion are answered on the film of T3, which
keeps the temperature of the rest.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, NamedTuple

from ...answers import ErrorEstimate, Found, WorkUnit
from ...bearings.journal import JFOFilm, JournalBearing
from ...ladders import BaseRung, Rung
from ...scenes.journal.field_levels import FIELD_LEVELS, REFERENCE, FieldLevel, grid_error
from ...scenes.journal.film_rung import FilmRung
from ...scenes.journal.heat_steps import HeatSteps, JudgedRest
from ...scenes.journal.warm_rest import WarmRest


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
