"""Thermal rungs of a question about a journal on an oil: T0, T1, T2 and T3.

T0 has the viscosity of fresh oil, T1 one temperature in the balance of the heat, both on every film of the
question; T2 has a temperature over the film, T3 over and across it. The error of T0 is what the balance at
its place would change; that of T1 and T2 what one solution of the heat of T3 on their film would (`step`); it
is added to the error of the film.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...answers import HEATED, ErrorEstimate, Found, Work, WorkUnit
from ...bearings.journal import JournalBearing, film_name, has_losses
from ...errors import InputError, RotorfilmError
from ...ladders import BaseRung, Ladder, Rung
from ...scenes.journal.assumed import assumed_figures
from ...scenes.journal.film_rung import FilmRung
from ...scenes.journal.warm_rest import WarmRest, step, uniform_rest
from .field_rungs import HeatedQuestion, field_rungs, motion_rungs

if TYPE_CHECKING:
    from ...scenes.scene import Scene

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


def warm_films(films: tuple[FilmRung, ...], bearing: JournalBearing) -> tuple[FilmRung, ...]:
    """Return the films whose heat is known; InputError where there is none."""
    known = tuple(film for film in films if has_losses(film.reaction))
    if not known:
        name = film_name(bearing.fitted_film)
        raise InputError(
            f"film must be a law with losses for a journal on an oil, as map or reynolds, got {name}"
        )
    return known


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
    fields = motion_rungs(known[0], questions[:2]) if question.value is None else field_rungs(quick, question)

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
    )
