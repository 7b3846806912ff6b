"""Static questions about any bearing with a film: where its journal rests, K and C there, losses and heat."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from ..analysis import coefficients, equilibrium
from ..core.answers import (
    ISOTHERMAL,
    SAFETY,
    CandidateRung,
    ErrorEstimate,
    Found,
    Ladder,
    Rung,
    Work,
    WorkUnit,
    relative_change,
)
from ..core.errors import InputError
from ..scenes.film_rungs import FilmCandidate, FilmRest
from .heat_levels import RestQuestion, any_bearing, thermal_ladder, with_losses
from .quantities import LOSSES, QUANTITIES, TEMPERATURES, FilmQuantity

if TYPE_CHECKING:
    from ..scenes.scene import Scene

Films = Callable[["Scene"], Sequence[FilmCandidate]]
"""Takes a scene and returns the candidates for its bearing, the cheapest first."""

Units = dict[WorkUnit, Callable[[], object]]
"""Calls that do one unit of work."""


@dataclass(frozen=True, kw_only=True)
class StaticRung(CandidateRung[FilmCandidate]):
    """The equilibrium by one film of any bearing.

    Attributes
    ----------
    quantity : FilmQuantity
    load : (float, float) [N]
    speed : float [rad/s]
    """

    quantity: FilmQuantity
    load: tuple[float, float]
    speed: float

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        return self.film.position_prior if self.quantity.position else self.film.prior

    def answer(self, before: Found | None) -> Found:
        """Return the quantity at the equilibrium of this film."""
        bearing, work = self.film.asked()
        at = equilibrium(bearing, self.load, self.speed)
        matrices = partial(coefficients, bearing, at.position, self.speed)
        own = FilmRest(
            at=at, film=self.film, bearing=self.film.reaction, position=at.position, matrices=matrices
        )
        return Found(self.quantity.value(own), work(), at)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the verified bound if that is enough, else the change that the richer film would make."""
        film, quantity, at = self.film, self.quantity, found.solution
        bound = quantity.bound(film, at)
        if SAFETY * bound < tolerance:
            return ErrorEstimate(bound, "verified bound of the map", bound=True)
        moved = film.corrected(at, smooth=quantity.slopes)
        better = quantity.value(
            FilmRest(at=at, film=film, bearing=film.rich, position=moved.position, matrices=lambda: moved)
        )
        return ErrorEstimate(
            quantity.distance(found.value, better, film.supply_temperature),
            f"defect of {film.rich_name}",
            film.judged(smooth=quantity.slopes, defects=1 if quantity.slopes or quantity.position else 2),
            bound=film.bounded,
            doubt=moved.doubt,
            better=None if moved.doubt else better,
        )

    def expected(self, done: Work) -> Work:
        """Return as much work as a lower rung did."""
        return self.film.expected(sum(done.values()))


def static_question(scene: Scene, quantity: str) -> RestQuestion:
    """Return a static question as it is asked of any film, in the balance of its heat or of one viscosity.

    Raises
    ------
    InputError
        If a temperature is asked for and there is no oil.
    """
    asked, bearing = QUANTITIES[quantity], any_bearing(scene)
    if quantity in TEMPERATURES and not bearing.is_warming:
        raise InputError(
            f"lubricant must give the oil of the bearing for {quantity}, as a grade, got a viscosity of "
            f"{bearing.film_viscosity:g} Pa s"
        )
    supply = bearing.cooled[1].supply_temperature if bearing.is_warming else 0.0

    def make(film: FilmCandidate) -> StaticRung:
        return StaticRung(film=film, quantity=asked, load=scene.static_load, speed=scene.speed)

    return RestQuestion(
        load=scene.static_load,
        speed=scene.speed,
        make=make,
        value=asked.value,
        distance=lambda value, better: asked.distance(value, better, supply),
    )


def static_ladder(films: Films, scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity: by one viscosity, or of an oil with the rungs of its heat.

    Parameters
    ----------
    films : callable
        Takes the scene and returns the candidates for some equilibria.
    scene : Scene
    quantity : str
        A key of `QUANTITIES`.

    Raises
    ------
    InputError
        If the film has no losses, where they are asked for or heat the oil; as `static_question`.
    """
    question, unit, known = static_question(scene, quantity), QUANTITIES[quantity].unit, films(scene)
    if any_bearing(scene).is_warming:
        return thermal_ladder(scene, known, (question,), unit, fresh=quantity not in TEMPERATURES)
    if quantity in LOSSES:
        known = with_losses(known, quantity)
    units = film_units(known, scene.speed)
    return isothermal_ladder(scene, map(question.make, known), unit, units, question.distance)


def isothermal_ladder(
    scene: Scene,
    rungs: Iterable[Rung],
    unit: str,
    units: Units,
    distance: Callable[[Any, Any], float] = relative_change,
) -> Ladder:
    """Return the ladder of rungs on films of one viscosity."""
    return Ladder(
        rungs=tuple(rungs),
        unit=unit,
        units=units,
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
        distance=distance,
    )


def film_units(films: Sequence[FilmCandidate], speed: float) -> Units:
    """Return one unit of work of each film, at half the clearance."""
    return {unit: call for film in films for unit, call in film.units(speed).items()}
