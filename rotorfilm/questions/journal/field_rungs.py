"""Rungs of a journal on a film with a temperature field: T2 over it, T3 over and across it.

Questions about a rest have their value there; those about a motion are answered on the film of T3, which
keeps the temperature of the rest.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

from ...answers import ErrorEstimate, Found, WorkUnit
from ...bearings.journal import HeatedFilm, JournalBearing, LayeredTemperature, MeanTemperature
from ...ladders import BaseRung, Rung
from ...scenes.journal.film_rung import FilmRung
from ...scenes.journal.warm_rest import WarmRest, bush_of, field_rest, step

Apart = Callable[[WarmRest, WarmRest], float]
"""How far the quantity of one rest is from that of another, in the unit of the tolerance."""

STEP_SHARE, PEAK_SHARE = 1.3, 2.0
"""What one step from T2 shows of the way to T3, inverted: of most quantities, and of the peak temperature."""

FIELD_RUNGS = (("T2", 0, (80, 8), 0.5), ("T3", 12, (80, 8), 2.0), ("T3", 12, (160, 16), 15.0))
"""Level, layers across the film, cells, and about how long an answer takes [s]."""


@dataclass(frozen=True, kw_only=True)
class HeatedQuestion:
    """A question about a journal in the balance of its heat.

    Attributes
    ----------
    load : (float, float) [N]
    speed : float [rad/s]
    make : callable
        Takes a film at one temperature and returns the rung that answers on it.
    apart : callable
        What a difference of two rests means for the quantity.
    value : callable or None
        The quantity of a rest; None where it takes more than a rest, which has no rungs with a field.
    peak : bool
        Whether it is the peak temperature.
    least : float [1]
        Error of T2 that a step may not see.
    """

    load: tuple[float, float]
    speed: float
    make: Callable[[FilmRung], Rung]
    apart: Apart
    value: Callable[[WarmRest], Any] | None = None
    peak: bool = False
    least: float = 0.0


class FieldSolution(NamedTuple):
    """A rest on a film with a temperature field, and the rung that found it."""

    rung: FieldRung
    own: WarmRest


@dataclass(frozen=True, kw_only=True)
class FieldRung(BaseRung):
    """An answer on a film with its temperature over it, or over and across it.

    Attributes
    ----------
    level : str
        T2 or T3.
    bearing : JournalBearing
        On its oil.
    question : HeatedQuestion
    cells : (int, int)
        Around and along half of the film.
    layers : int
        Across the film; 0 for one mean.
    seconds : float [s]
        About what an answer takes.
    """

    level: str
    bearing: JournalBearing
    question: HeatedQuestion
    cells: tuple[int, int]
    layers: int
    seconds: float = field(compare=False)

    @property
    def name(self) -> str:
        """Level, layers and cells."""
        across = f" x {self.layers}" if self.layers else ""
        return f"{self.level}, {self.cells[0]} x {self.cells[1]}{across}"

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        return WorkUnit(f"answers of {self.name}", ("answers", self.name), nominal=self.seconds)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity at the rest on this film."""
        question = self.question
        profile = LayeredTemperature(self.layers) if self.layers else MeanTemperature()
        film = HeatedFilm(
            bearing=self.bearing, walls=bush_of(self.bearing), cells=self.cells, profile=profile
        )
        own = field_rest(film, question.load, question.speed)
        assert question.value is not None  # or it has no such rung
        return Found(question.value(own), {self.unit: 1}, FieldSolution(self, own))

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change since cells twice as long, and of T2 what one step towards T3 shows of the way.

        Heat moves upwind, of first order: the cells still lack about what they gained.
        """
        own, question = found.solution.own, self.question
        coarse = self._coarser(before)
        done = {WorkUnit(f"estimates of {self.name}"): 1}
        grid = question.apart(coarse, own)
        method = "cells twice as long"
        if self.layers:
            return ErrorEstimate(grid, method, done)
        share = PEAK_SHARE if question.peak else STEP_SHARE
        heat = max(share * question.apart(own, step(self.bearing, own)), question.least)
        return ErrorEstimate(grid + heat, f"{method}; heat: one solution of T3, {heat:.2g}", done)

    def _coarser(self, before: Found | None) -> WarmRest:
        half = replace(self, cells=(self.cells[0] // 2, self.cells[1] // 2), seconds=0.25 * self.seconds)
        if before is not None and isinstance(before.solution, FieldSolution) and before.solution.rung == half:
            return before.solution.own
        own: WarmRest = half.answer(None).solution.own
        return own


def field_rungs(bearing: JournalBearing, question: HeatedQuestion) -> tuple[Rung, ...]:
    """Return T2 and T3, the latter on two grids."""
    return tuple(
        FieldRung(level=level, bearing=bearing, question=question, cells=cells, layers=layers, seconds=about)
        for level, layers, cells, about in FIELD_RUNGS
    )


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
        return self._rest(1)

    @cached_property
    def half(self) -> WarmRest:
        """That on cells twice as long."""
        return self._rest(2)

    @cached_property
    def frozen(self) -> FilmRung:
        """The film at rest; there is no richer one."""
        film = self.film.frozen(self.own.reaction)
        return replace(film, rich=film.reaction, rich_name="itself")

    def _rest(self, coarser: int) -> WarmRest:
        _, layers, (around, along), _ = FIELD_RUNGS[1]
        film = HeatedFilm(
            bearing=self.film.reaction,
            walls=bush_of(self.film.reaction),
            cells=(around // coarser, along // coarser),
            profile=LayeredTemperature(layers),
        )
        return field_rest(film, self.load, self.speed)


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
        _, layers, cells, _ = FIELD_RUNGS[1]
        named = replace(self.films.film, name=f"{cells[0]} x {cells[1]} x {layers}")
        return f"T3, {self.question.make(named).name}"

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        return WorkUnit(f"answers of {self.name}", ("answers", self.name), nominal=2.0 * FIELD_RUNGS[1][3])

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
        return ErrorEstimate(about.error + grid, method, work, doubt=about.doubt)


def motion_rungs(film: FilmRung, questions: tuple[HeatedQuestion, ...]) -> tuple[Rung, ...]:
    """Return the rungs of motions on the film of T3, for questions that differ in their rungs."""
    films = FieldFilms(film, questions[0].load, questions[0].speed)
    return tuple(FrozenRung(films=films, question=question) for question in questions)
