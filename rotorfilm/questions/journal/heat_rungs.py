"""Thermal rungs of a question about a journal on an oil: T0, T1, T2 and T3.

T0 has the viscosity of fresh oil, T1 one temperature in the balance of the heat, both on every film of the
question; T2 has a temperature over the film, T3 over and across it. The error of T0 is what the balance at
its place would change; that of T1 and T2 what one solution of the heat of T3 on their film would (`step`); it
is added to the error of the film.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...answers import HEATED, ErrorEstimate, Found, Work, WorkUnit
from ...bearings.journal import (
    HeatedFilm,
    JournalBearing,
    LayeredTemperature,
    MeanTemperature,
    has_losses,
)
from ...errors import InputError, RotorfilmError
from ...ladders import BaseRung, Ladder, Rung
from ...scenes.journal.assumed import assumed_figures
from ...scenes.journal.echo import film_name
from ...scenes.journal.film_rung import FilmRung
from ...scenes.journal.warm_rest import WarmRest, bush_of, field_rest, step, uniform_rest

if TYPE_CHECKING:
    from ...scenes.scene import Scene

Apart = Callable[[WarmRest, WarmRest], float]
"""How far the quantity of one rest is from that of another, in the unit of the tolerance."""

BALANCES = 60
"""Forces with derivatives that an equilibrium in the balance of its heat takes about."""

STEP_SHARE, PEAK_SHARE = 1.3, 2.0
"""What one step from T2 shows of the way to T3, inverted: of most quantities, and of the peak temperature."""

FIELD_RUNGS = (("T2", 0, (80, 8), 0.5), ("T3", 12, (80, 8), 2.0), ("T3", 12, (160, 16), 15.0))
"""Level, layers across the film, cells, and about how long an answer takes [s]."""


@dataclass(frozen=True, eq=False)
class HeatLevel:
    """T0 or T1: rungs of one level share the error of its heat."""

    name: str


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
    """

    load: tuple[float, float]
    speed: float
    make: Callable[[FilmRung], Rung]
    apart: Apart
    value: Callable[[WarmRest], Any] | None = None
    peak: bool = False


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
    film : FilmRung
        Of the bearing on its oil.
    question : HeatedQuestion
    """

    level: HeatLevel
    film: FilmRung
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
        own = solved.own
        about = solved.rung.estimate(solved.found, self._lower(before), tolerance)
        bearing, question = self.film.reaction, self.question
        try:
            if self.level is FRESH:
                rest = own.rest.position, np.zeros(2), question.speed
                other = uniform_rest(
                    bearing, question.load, question.speed, bearing.balanced_temperature(*rest)
                )
                heat = question.apart(own, other)
            else:
                heat = question.apart(own, step(bearing, own))
        except RotorfilmError as error:
            return about._replace(error=math.inf, doubt=f"its error by heat is not known: {error}")
        how = "heat: its balance" if self.level is FRESH else "heat: one solution of T3"
        method = f"{about.method}; {how}, {heat:.2g}"
        work = {WorkUnit(f"estimates of {self.name}"): 1}
        return ErrorEstimate(about.error + heat, method, work, doubt=about.doubt, shared=heat)

    def expected(self, done: Work) -> Work:
        """Return one answer."""
        return {self.unit: 1}


FRESH, BALANCED = HeatLevel("T0"), HeatLevel("T1")


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
        heat = share * question.apart(own, step(self.bearing, own))
        return ErrorEstimate(grid + heat, f"{method}; heat: one solution of T3, {heat:.2g}", done)

    def _coarser(self, before: Found | None) -> WarmRest:
        half = replace(self, cells=(self.cells[0] // 2, self.cells[1] // 2), seconds=0.25 * self.seconds)
        if before is not None and isinstance(before.solution, FieldSolution) and before.solution.rung == half:
            return before.solution.own
        own: WarmRest = half.answer(None).solution.own
        return own


def warm_films(films: tuple[FilmRung, ...], bearing: JournalBearing) -> tuple[FilmRung, ...]:
    """Return the films whose heat is known; InputError where there is none."""
    known = tuple(film for film in films if has_losses(film.reaction))
    if not known:
        name = film_name(bearing.fitted_film)
        raise InputError(f"film must be a law with losses for a journal on an oil, as map or reynolds, got {name}")
    return known


def thermal_ladder(scene: Scene, question: HeatedQuestion, rungs: tuple[Rung, ...], unit: str) -> Ladder:
    """Return the ladder of a question about a journal on an oil, of these rungs and those with a field."""
    # with the cheapest film: its own might have to make a map first
    quick = next(rung.film.reaction for rung in rungs if isinstance(rung, UniformRung))
    fields = () if question.value is None else field_rungs(quick, question)

    def assumptions() -> tuple[str, ...]:
        own = uniform_rest(quick, question.load, question.speed)

        def moved(other: JournalBearing) -> float:
            return question.apart(own, uniform_rest(other, question.load, question.speed))

        return assumed_figures(quick, moved, fields=bool(fields))

    return Ladder(
        rungs=(*rungs, *fields),
        unit=unit,
        remarks=scene.film_remarks,
        within=HEATED,
        assumptions=assumptions,
    )


def field_rungs(bearing: JournalBearing, question: HeatedQuestion) -> tuple[Rung, ...]:
    """Return T2 and T3, the latter on two grids."""
    return tuple(
        FieldRung(level=level, bearing=bearing, question=question, cells=cells, layers=layers, seconds=about)
        for level, layers, cells, about in FIELD_RUNGS
    )


def uniform_rungs(
    films: tuple[FilmRung, ...], questions: tuple[HeatedQuestion, ...], *, fresh: bool = True
) -> tuple[Rung, ...]:
    """Return T0, unless nothing is known of it, and T1 of questions that differ in their rungs, film by film."""
    levels = (FRESH, BALANCED) if fresh else (BALANCED,)
    return tuple(
        UniformRung(level=level, film=film, question=question)
        for level in levels
        for film in films
        for question in questions
    )
