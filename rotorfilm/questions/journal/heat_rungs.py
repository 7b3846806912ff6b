"""Thermal rungs of a question about a journal on an oil: T0, T1, T2 and T3.

T0 has the viscosity of fresh oil, T1 one temperature in the balance of the heat, both on every film of the
question; T2 has a temperature over the film, T3 over and across it. The error of T1 and T2 by heat is what a
few steps towards T3 on their film change (`HeatSteps`); that of T0 what the balance at its place would, and
where that is little the steps from there. It is added to the error of the film.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...answers import HEATED, SAFETY, ErrorEstimate, Found, Work, WorkUnit
from ...bearings.journal import JournalBearing, film_name, has_losses
from ...errors import InputError, RotorfilmError
from ...ladders import BaseRung, Ladder, Rung
from ...scenes.journal.assumed import assumed_figures
from ...scenes.journal.film_candidate import FilmCandidate
from ...scenes.journal.film_rung import FilmRung
from ...scenes.journal.heat_steps import HeatError, HeatSteps
from ...scenes.journal.warm_rest import WarmRest, ends_within, uniform_rest
from .field_rungs import HeatedQuestion, field_rungs, motion_rungs

if TYPE_CHECKING:
    from ...scenes.scene import Scene

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
