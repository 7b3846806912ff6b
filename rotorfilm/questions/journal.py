"""What journal bearings bring to scenes and questions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from ..analysis import whirl_threshold
from ..bearings.journal import JFOFilm
from ..core.answers import ErrorEstimate, Found, Ladder, Rung
from ..core.errors import RotorfilmError
from ..scenes.film_heat import HeatSteps, uniform_rest
from ..scenes.film_rungs import FilmRung, point_films, turn_films
from ..scenes.solve_journal import conserved_threshold
from .conserved_oil import (
    UNFED,
    Change,
    ConservedRung,
    RuptureChange,
    conserved_films,
    conserved_ladder,
    rest_on,
    with_rupture,
)
from .coupling import coupling_ladder
from .film_motions import ORBIT_UNITS as ORBITS, blade_loss_ladder, orbit_ladder
from .film_statics import Films, static_ladder, static_question
from .film_thresholds import AROUND, required_rotor, whirl_ladder
from .heat_levels import RestQuestion, field_rungs
from .quantities import QUANTITIES, relative

if TYPE_CHECKING:
    from ..scenes.scene import Scene


def journal_points(scene: Scene) -> tuple[FilmRung, ...]:
    """Return the films of a journal bearing for some equilibria."""
    return point_films(scene.journal_bearing, fixed=scene.film_is_given)


def journal_turns(quantity: str, scene: Scene) -> tuple[FilmRung, ...]:
    """Return those for states all round a turn: the map where there is one, else short film, grids, map."""
    assert scene.journal is not None  # whose question it is
    scene.journal.require_law(quantity)
    return turn_films(scene.journal_bearing, fixed=scene.film_is_given, grids=((48, 8), (96, 8)), maps=True)


def on_turns(ladder: Callable[[Films, Scene, str], Ladder]) -> Callable[[Scene, str], Ladder]:
    """Return a ladder of a motion in a journal bearing."""
    return lambda scene, quantity: ladder(partial(journal_turns, quantity), scene, quantity)


def conserving_static_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity of a journal bearing, with what conserves its oil."""
    question, asked, table = static_question(scene, quantity), QUANTITIES[quantity], scene.journal
    assert table is not None  # whose question it is
    if table.conserves:
        return conserved_ladder(scene, _conserved_rungs(scene, question), asked.unit, question.distance)
    ladder = static_ladder(journal_points, scene, quantity)
    if quantity == "side_flow" and scene.journal_bearing.geometry.plain:
        ladder = replace(ladder, remarks=(*ladder.remarks, UNFED))
    rupture = RuptureChange(scene.journal_bearing, scene.static_load, scene.speed)

    def change(found: Found) -> Change:
        return rupture.change(asked.value, relative=asked.scaled)

    return with_rupture(scene, ladder, change, question.distance, partial(_conserved_rungs, scene, question))


def _conserved_rungs(scene: Scene, question: RestQuestion) -> tuple[Rung, ...]:
    """Return the rungs of a static quantity that conserve their oil, on an oil with those of its heat."""
    films, warm = conserved_films(scene), scene.journal_bearing.is_warming

    def value(film: JFOFilm, before: Found | None) -> Any:
        return question.value(rest_on(film, question.load, question.speed))

    heat = _heat_of_balance(question, films[0]) if warm else None
    uniform = tuple(
        ConservedRung(film=film, value=value, distance=question.distance, heat=heat) for film in films
    )
    return (*uniform, *field_rungs(films[0], question)) if warm else uniform


def _heat_of_balance(question: RestQuestion, film: JFOFilm) -> Callable[[float], ErrorEstimate]:
    """Return a call for the error by heat of a film of one temperature that conserves its oil."""

    def heat(tolerance: float) -> ErrorEstimate:
        try:
            own = uniform_rest(film, question.load, question.speed)
            steps = HeatSteps(film, own)
            found = question.error(own, steps)
        except RotorfilmError as error:
            return ErrorEstimate(math.inf, "not known", doubt=f"its error by heat is not known: {error}")
        return ErrorEstimate(found.error, "steps towards T3", bound=found.bound, doubt=steps.doubt)

    return heat


def conserving_whirl_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the whirl threshold, with what conserves its oil at the frequency of the whirl.

    Raises
    ------
    InputError
        If the scene has no rigid rotor.
    """
    mass, load = required_rotor(scene, quantity).mass, scene.static_load
    bearing, table = scene.journal_bearing, scene.journal
    assert table is not None  # whose question it is

    def start(before: Found | None) -> float:
        if before is not None:
            return float(before.value)
        found = whirl_threshold(RuptureChange(bearing, load, scene.speed).films[-1][0], load, mass).speed
        return scene.speed if found is None else found

    def above() -> tuple[ConservedRung, ...]:
        def value(film: JFOFilm, before: Found | None) -> float:
            return conserved_threshold(film, load, mass, start(before))

        return tuple(
            ConservedRung(film=film, value=value, distance=relative) for film in conserved_films(scene)
        )

    def change(found: Found) -> Change:
        reynolds, conserved = RuptureChange(bearing, load, found.value).films[-1]
        around = found.value / AROUND, found.value * AROUND
        own = whirl_threshold(reynolds, load, mass, around).speed or found.value
        return Change(own, conserved_threshold(conserved, load, mass, own), relative=True)

    if table.conserves:
        return conserved_ladder(scene, above(), "rad/s")
    ladder = whirl_ladder(journal_points, scene, quantity)
    # On an oil the error by heat of a threshold by conserved oil is not known yet.
    return with_rupture(scene, ladder, change, relative, None if bearing.is_warming else above)


LADDERS = {
    **dict.fromkeys(QUANTITIES, conserving_static_ladder),
    **dict.fromkeys(ORBITS, on_turns(orbit_ladder)),
    "whirl_threshold": conserving_whirl_ladder,
    "blade_loss_peak": on_turns(blade_loss_ladder),
    "cosimulation_error": coupling_ladder,
}
