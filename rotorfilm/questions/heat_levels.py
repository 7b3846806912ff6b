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
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..bearings.journal import JFOFilm, JournalBearing
from ..bearings.pads import PadBearing
from ..core.answers import HEATED, SAFETY, ErrorEstimate, Ladder, RungResult, WorkUnit
from ..core.errors import RotorfilmError
from ..core.port import is_warming
from ..scenes import film_heat
from ..scenes.film_rungs import FilmCandidate, with_losses
from .variants import FunctionRung, counted_rung

if TYPE_CHECKING:
    from ..scenes.scene import Scene

ONE_TEMPERATURE = "laminar films, all at one temperature in the balance of their heat"
"""`within` of motions on films of pads on an oil, for which no temperature field is known."""

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


FRESH, BALANCED = HeatLevel("T0"), HeatLevel("T1")


class WarmSolution(NamedTuple):
    """An answer on a film that warms, as its estimate and the next rung of its level start from it.

    Attributes
    ----------
    level : HeatLevel or FieldLevel
    found : Found
        What the rung found on the film at its temperature.
    rung : Rung or None
        That one.
    own : WarmRest or None
        The rest there, None where that is not known yet.
    judge : RestJudge or None
        What judges that.
    """

    level: HeatLevel | film_heat.FieldLevel
    found: RungResult
    rung: Any = None
    own: film_heat.WarmRest | None = None
    judge: film_heat.RestJudge | None = None


def answer_below(level: HeatLevel | film_heat.FieldLevel, before: RungResult | None) -> RungResult | None:
    """Return the answer of a lower rung on its film, if it is of the same level."""
    solved = None if before is None else before.solution
    return solved.found if isinstance(solved, WarmSolution) and solved.level is level else None


# Rungs of T0 and T1 on each film of a question.


def uniform_rung(question: Any, level: HeatLevel, film: FilmCandidate, count: int) -> FunctionRung:
    """Return the rung of an answer on a film of one temperature."""
    inner = question.make(film, count)
    name = f"{level.name}, {inner.name}"

    def solve(before: RungResult | None) -> tuple[Any, WarmSolution]:
        solved = question.uniform(level, film, count, before)
        return solved.found.value, solved

    def judge(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        solved: WarmSolution = found.solution
        about = solved.rung.estimate(solved.found, None, tolerance)
        work = f"estimates of {name}"
        return with_heat(about, lambda: _uniform_heat(question, film.reaction, solved, tolerance), work)

    return counted_rung(
        name,
        (level, name),
        film.time(question.rests * BALANCES),
        solve,
        judge,
        prior=inner.prior,
        refines=(level, *inner.refines) if inner.refines else (),
        shares=level,
        film=film,
    )


def _uniform_heat(
    question: Any, bearing: Any, solved: WarmSolution, tolerance: float
) -> tuple[film_heat.HeatError, str, str]:
    """Return the error by heat, how that is known, and why to doubt it."""
    judge, level = question.judged(solved), solved.level
    assert isinstance(level, HeatLevel)
    load, speed = judge.load, judge.speed
    own = start = solved.own or film_heat.uniform_rest(bearing, load, speed, level.temperature(bearing))
    if level is FRESH:
        start = film_heat.uniform_rest(bearing, load, speed, balance_at(bearing, own))
    heat, how, doubt = film_heat.HeatError(judge.apart(own, start), False), BALANCE, ""
    if heat.error * SAFETY < tolerance and has_field(question, bearing):
        steps = film_heat.HeatSteps(bearing, start)
        heat, how, doubt = judge.error(own, steps), steps.name, steps.doubt
    return *with_moving(judge.moving(bearing), heat, how), doubt


def balance_at(bearing: JournalBearing, own: film_heat.WarmRest) -> float:
    """Return the temperature at which the heat of a bearing balances at the place of a rest [K]."""
    return bearing.balanced_temperature(own.rest.position, np.zeros(2), own.rest.speed)


def with_heat(
    about: ErrorEstimate, find: Callable[[], tuple[film_heat.HeatError, str, str]], work: str
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


def with_moving(moving: float, heat: film_heat.HeatError, method: str) -> tuple[film_heat.HeatError, str]:
    """Return an error by heat and how it is known, with that by heat which moves with the journal."""
    if not moving:
        return heat, method
    bound = heat.bound or moving > heat.error
    return film_heat.HeatError(heat.error + moving, bound), f"{method}, moving heat {moving:.2g} lower"


# Rungs of a journal on a film with a temperature field: T2 over it, T3 over and across it.
#
# Questions about a rest have their value there; those about a motion are answered on the film of T3, which
# keeps the temperature of the rest.


def field_rung(question: Any, level: film_heat.FieldLevel, film: FilmCandidate) -> FunctionRung:
    """Return the rung of T2 or T3, the error of which is what steps towards T3 or coarser grids change."""
    bearing = film.reaction
    name = f"{level.name}, JFO" if isinstance(bearing, JFOFilm) else level.name

    def solve(before: RungResult | None) -> tuple[Any, WarmSolution]:
        solved = question.on_field(level, film, before)
        return solved.found.value, solved

    def judge(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        own, judge = found.solution.own, found.solution.judge
        lower = None if before is None else before.solution

        def rest(other: film_heat.FieldLevel) -> film_heat.WarmRest:
            """Return the rest by another level; that of a lower rung is known."""
            if isinstance(lower, WarmSolution) and lower.level == other and lower.judge is judge:
                assert lower.own is not None  # of a level with a field
                return lower.own
            return other.rest(bearing, judge.load, judge.speed)

        if level.layers:
            grid = film_heat.grid_error(level, own, rest, judge.apart)
            heat, method, doubt = film_heat.HeatError(grid, True), "cells twice as long, half the layers", ""
        elif film_heat.richest_profile(bearing).layers == 1:
            heat, method = (
                film_heat.HeatError(judge.apart(rest(level.coarser), own), True),
                "cells twice as long",
            )
            doubt = ""
        else:
            steps = film_heat.HeatSteps(bearing, own)
            heat, method, doubt = judge.error(own, steps), steps.name, steps.doubt
        heat, method = with_moving(judge.moving(bearing), heat, method)
        return ErrorEstimate(heat.error, method, bound=heat.bound, doubt=doubt)

    return counted_rung(name, ("answers", name), question.field_rests * level.seconds, solve, judge)


def frozen_rungs(question: Any, film: FilmCandidate) -> tuple[FunctionRung, ...]:
    """Return the first rungs of a motion on the film of T3 that keeps the temperature of the rest."""

    @cache
    def rest(level: film_heat.FieldLevel) -> film_heat.WarmRest:
        return level.rest(film.reaction, question.load, question.speed)

    @cache
    def frozen() -> FilmCandidate:
        """Return the film at rest; there is no richer one."""
        own = film.frozen(rest(film_heat.REFERENCE).reaction)
        return replace(own, rich=own.reaction, rich_name="itself")

    def rung(count: int) -> FunctionRung:
        def solve(before: RungResult | None) -> tuple[Any, WarmSolution]:
            own = question.make(frozen(), count)
            found = own.answer(answer_below(film_heat.REFERENCE, before))
            return found.value, WarmSolution(film_heat.REFERENCE, found, own)

        def judge(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
            solved: WarmSolution = found.solution
            about: ErrorEstimate = solved.rung.estimate(solved.found, None, tolerance)
            grid = question.judge.apart(rest(film_heat.REFERENCE.coarser), rest(film_heat.REFERENCE))
            method = f"{about.method}; cells twice as long, {grid:.2g}"
            bound = grid > about.error or about.bound
            return ErrorEstimate(about.error + grid, method, bound=bound, doubt=about.doubt)

        level = film_heat.REFERENCE
        name = f"{level.level}, {question.make(replace(film, name=level.grid), count).name}"
        return counted_rung(name, ("answers", name), 2.0 * level.seconds, solve, judge)

    return tuple(rung(count) for count in question.counts[:2])


# The ladder of a question about a bearing on an oil.


def known_films(films: Sequence[FilmCandidate]) -> tuple[Any, ...]:
    """Return the films whose losses, which heat the oil, are known; InputError where there is none."""
    return with_losses(films, "an oil that warms")


def has_field(question: Any, bearing: Any) -> bool:
    """Return whether a temperature over the film answers a question: not in motions on pads."""
    if isinstance(bearing, PadBearing):
        return question.has_levels and not question.moves
    return isinstance(bearing, JournalBearing | JFOFilm)


def heat(scene: Scene, question: Any, films: Sequence[FilmCandidate], ladder: Ladder) -> Ladder:
    """Return the ladder of a question on an oil that warms: T0 and T1 on each film, T2 and T3.

    Raises
    ------
    InputError
        If no film has losses, which heat the oil.
    """
    bearing = films[0].reaction
    if not is_warming(bearing):
        return ladder
    within = HEATED if has_field(question, bearing) else ONE_TEMPERATURE
    if not question.has_levels:
        return replace(ladder, within=within)
    known = known_films(films)
    # with the cheapest film: that of the scene might have to make a map first
    quick = known[0].reaction
    rungs = [
        uniform_rung(question, level, film, count)
        for level in ((FRESH, BALANCED) if question.is_fresh else (BALANCED,))
        for film in known
        for count in question.counts
    ]
    if has_field(question, quick) and not film_heat.ends_within(
        quick
    ):  # beside openings within it only conserved oil is known
        if question.moves:
            rungs += frozen_rungs(question, known[0])
        else:
            layered = film_heat.richest_profile(quick).layers > 1
            levels = [level for level in question.levels if layered or not level.layers]
            rungs += [field_rung(question, level, known[0]) for level in levels]

    def assumptions() -> tuple[str, ...]:
        return film_heat.assumed_figures(quick, question.moved(known[0]), fields=has_field(question, quick))

    return replace(ladder, rungs=tuple(rungs), units={}, within=within, assumptions=assumptions)
