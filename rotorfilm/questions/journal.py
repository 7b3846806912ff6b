"""What journal bearings bring to scenes and questions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ..bearings.journal import JFOFilm, film_name, has_losses
from ..core.answers import ErrorEstimate, Found, Ladder, Rung
from ..core.errors import InputError, RotorfilmError
from ..core.model import Array
from ..scenes.export_scene import film_models
from ..scenes.families import Family
from ..scenes.film_heat import HeatSteps, uniform_rest
from ..scenes.film_rungs import FilmRung, point_films
from ..scenes.schema import JournalTable
from .coupling import coupling_ladder
from .journal_heat import HeatedQuestion, field_rungs, thermal_ladder
from .journal_orbits import ORBIT_UNITS as ORBITS, blade_loss_ladder, orbit_ladder
from .journal_rupture import (
    UNFED,
    Change,
    ConservedRung,
    RestedFilm,
    RuptureChange,
    conserved_films,
    rest_on,
    rest_slopes,
    with_rupture,
    within_of,
)
from .journal_statics import (
    ANGLE,
    LOSSES,
    MATRIX,
    STATIC_UNITS,
    STATIC_UNITS as STATICS,
    TEMPERATURES,
    StaticRung,
    attitude,
    cold_static_ladder,
    relative_distance,
    rest_value,
)
from .journal_whirl import journal_whirl_ladder

if TYPE_CHECKING:
    from ..scenes.scene import Scene

# Ladders of static questions about a journal bearing: one viscosity or an oil, conserved or not.


RELATIVE = ("eccentricity_ratio", "minimum_film", *LOSSES)
"""Those that grids change by about the same share, coarse ones or fine."""


def static_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity of a journal bearing; on an oil with the rungs of its heat.

    Raises
    ------
    InputError
        If the film has no losses, where they are asked for or heat the oil; if a temperature is asked for and
        there is no oil.
    """
    if quantity in TEMPERATURES and not scene.journal_bearing.is_warming:
        raise InputError(
            f"lubricant must give the oil of the journal for {quantity}, as a grade, got journal.viscosity "
            f"{scene.journal_bearing.film_viscosity:g} Pa s"
        )
    if required_journal(scene).conserves:
        return conserved_ladder(scene, quantity)
    ladder = ruptured_ladder(scene, quantity)
    plain = scene.journal_bearing.geometry.plain
    if plain and quantity == "side_flow":
        ladder = replace(ladder, remarks=(*ladder.remarks, UNFED))
    rupture = RuptureChange(scene.journal_bearing, scene.static_load, scene.speed)

    def change(found: Found) -> Change:
        return rupture.change(
            lambda rest: conserved_value(quantity, rest, scene), relative=quantity in RELATIVE
        )

    return with_rupture(
        scene, ladder, change, distance_of(scene, quantity), lambda: above_rupture(scene, quantity)
    )


def ruptured_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity by Reynolds rupture."""
    films = point_films(scene.journal_bearing, fixed=scene.film_is_given)
    if scene.journal_bearing.is_warming:
        return warm_static_ladder(scene, quantity, films)
    if quantity in LOSSES:
        films = tuple(film for film in films if has_losses(film.reaction))
        if not films:
            name = film_name(scene.journal_bearing.fitted_film)
            raise InputError(f"film must be a law with losses for {quantity}, as map or reynolds, got {name}")
    return cold_static_ladder(scene, quantity, films)


def conserved_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity of a bearing whose film conserves its oil."""
    return Ladder(
        rungs=above_rupture(scene, quantity),
        unit=STATIC_UNITS[quantity],
        remarks=scene.film_remarks,
        within=within_of(scene),
        distance=distance_of(scene, quantity),
    )


def above_rupture(scene: Scene, quantity: str) -> tuple[Rung, ...]:
    """Return the rungs of a static quantity that conserve their oil, on an oil with those of its heat."""

    def value(film: JFOFilm, before: Found | None) -> Array | float:
        return conserved_value(quantity, rest_on(film, scene.static_load, scene.speed), scene)

    films, warm = conserved_films(scene), scene.journal_bearing.is_warming
    heat = heat_of_balance(scene, quantity) if warm else None
    distance = distance_of(scene, quantity)
    uniform = tuple(ConservedRung(film=film, value=value, distance=distance, heat=heat) for film in films)
    return (*uniform, *field_rungs(films[0], heated_question(scene, quantity))) if warm else uniform


def heat_of_balance(scene: Scene, quantity: str) -> Callable[[float], ErrorEstimate]:
    """Return a call for the error by heat of a film of one temperature that conserves its oil."""
    question, film = heated_question(scene, quantity), conserved_films(scene)[0]

    def heat(tolerance: float) -> ErrorEstimate:
        try:
            own = uniform_rest(film, scene.static_load, scene.speed)
            steps = HeatSteps(film, own)
            found = question.error(own, steps)
        except RotorfilmError as error:
            return ErrorEstimate(math.inf, "not known", doubt=f"its error by heat is not known: {error}")
        return ErrorEstimate(found.error, "steps towards T3", bound=found.bound, doubt=steps.doubt)

    return heat


def conserved_value(quantity: str, rest: RestedFilm, scene: Scene) -> Array | float:
    """Return a static quantity of a rest; K and C of a film that remembers at the frequency of the shaft."""
    at = rest.at
    if quantity in MATRIX:
        return rest_slopes(rest)[MATRIX[quantity] // 2]
    if quantity in LOSSES:
        return float(getattr(at.losses, quantity))
    if quantity in TEMPERATURES:
        assert at.temperature is not None  # of a bearing on an oil
        return at.temperature
    if quantity == ANGLE:
        return attitude(at.position, scene.static_load, scene.speed)
    return float(getattr(at, quantity))


def distance_of(scene: Scene, quantity: str) -> Callable[[Any, Any], float]:
    """Return how far a value is from a better one, in the unit of the tolerance."""
    bearing = scene.journal_bearing
    supply = bearing.cooled[1].supply_temperature if bearing.is_warming else 0.0
    return lambda value, better: relative_distance(quantity, value, better, supply)


def required_journal(scene: Scene) -> JournalTable:
    """Return the table of the journal bearing; raises InputError if the scene has none."""
    if scene.journal is None:
        raise InputError("journal is required, got no such table")
    return scene.journal


def warm_static_ladder(scene: Scene, quantity: str, films: tuple[FilmRung, ...]) -> Ladder:
    """Return the ladder of a static quantity of a journal bearing on an oil."""
    question = heated_question(scene, quantity)
    return thermal_ladder(
        scene, films, (question,), STATIC_UNITS[quantity], fresh=quantity not in TEMPERATURES
    )


def heated_question(scene: Scene, quantity: str) -> HeatedQuestion:
    """Return a static question as it is asked of a film in the balance of its heat."""

    def make(film: FilmRung) -> StaticRung:
        return StaticRung(film=film, quantity=quantity, load=scene.static_load, speed=scene.speed)

    return HeatedQuestion(
        load=scene.static_load,
        speed=scene.speed,
        make=make,
        value=lambda own: rest_value(quantity, own),
        distance=distance_of(scene, quantity),
    )


# What journal bearings bring to scenes and questions.


FAMILY = Family(
    table=JournalTable,
    ladders={
        **dict.fromkeys(STATICS, static_ladder),
        **dict.fromkeys(ORBITS, orbit_ladder),
        "whirl_threshold": journal_whirl_ladder,
        "blade_loss_peak": blade_loss_ladder,
        "cosimulation_error": coupling_ladder,
    },
    models=film_models,
    example={
        "journal": {
            "diameter": "100 mm",
            "length": "50 mm",
            "viscosity": "20 mPa s",
            "clearance": "80 um",
        },
        "operation": {"speed": "3000 rpm"},
        "rigid_rotor": {"mass": "200 kg"},
    },
)
