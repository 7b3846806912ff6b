"""Questions to the films of any bearing: their ladder, its effects, and quantities of a journal at rest."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from typing import TYPE_CHECKING, Any, ClassVar

from ..analysis import coefficients, equilibrium
from ..bearings.journal import JFOFilm, JournalBearing
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
)
from ..core.errors import InputError
from ..scenes.film_heat import FIELD_LEVELS, FieldLevel, RestJudge, uniform_rest
from ..scenes.film_rungs import FilmCandidate, FilmRest
from .conserved_oil import Change, change_at_rest, conserved_ladder, conserved_oil, rest_on
from .heat_levels import HeatLevel, WarmSolution, answer_below, heat, with_losses
from .quantities import LOSSES, QUANTITIES, TEMPERATURES, FilmQuantity

if TYPE_CHECKING:
    from ..scenes.scene import Scene

Films = Callable[["Scene"], Sequence[FilmCandidate]]
"""Takes a scene and returns the candidates for its bearing, the cheapest first."""

Units = Mapping[WorkUnit, Callable[[], object]]
"""Calls that do one unit of work."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FilmQuestion:
    """A question to the films of a bearing: how a film answers it, and what it is at a rest.

    Attributes
    ----------
    load : (float, float) [N]
    speed : float [rad/s]
    unit : str
    make : callable
        Takes a film of one temperature and a count of samples or steps, and returns the rung that answers.
    value : callable
        The quantity of a rest, or of small motion about it.
    distance : callable
        Takes a value and a better one, and returns how far it is off in the unit of the tolerance.
    units : callable
        Takes the films and returns calls that do one unit of work of each.
    counts : tuple of int
        Those of the rungs on each film, in the order of their cost.
    effort : callable or None
        Of a rung, by which those on films of one viscosity are ordered.
    moves : bool
        Whether the quantity is one of a motion, which takes more than a rest.
    scaled : bool
        Whether the share counts by which the conservation of oil changes the quantity, not the difference.
    is_fresh : bool
        Whether the film of fresh oil has an answer.
    follows_oil : bool
        Whether films that conserve their oil have an answer.
    has_levels : bool
        Whether an oil has levels of heat; else all films are at the temperature of their balance.
    levels : tuple of FieldLevel
        Those with a temperature field.
    rests, field_rests : float
        Rests that an answer takes about, on films of one temperature and on those with a field.
    """

    load: tuple[float, float]
    speed: float
    unit: str
    make: Callable[[Any, int], Any]
    value: Callable[[Any], Any]
    distance: Callable[[Any, Any], float]
    units: Callable[[Sequence[FilmCandidate]], Units]
    counts: tuple[int, ...] = (0,)
    effort: Callable[[Any], float] | None = None
    moves: bool = False
    scaled: bool = True
    is_fresh: bool = True
    follows_oil: bool = False
    has_levels: bool = True

    levels: ClassVar[tuple[FieldLevel, ...]] = FIELD_LEVELS
    rests: ClassVar[int] = 1
    field_rests: ClassVar[float] = 1.0

    @cached_property
    def judge(self) -> RestJudge:
        """What judges rests at its speed."""
        return RestJudge(load=self.load, speed=self.speed, value=self.value, distance=self.distance)

    def uniform(
        self, level: HeatLevel, film: FilmCandidate, count: int, before: Found | None
    ) -> WarmSolution:
        """Return the answer on a film at the temperature that it has with the journal at rest."""
        own = uniform_rest(film.reaction, self.load, self.speed, level.temperature(film.reaction))
        rung = self.make(film.at_temperature(own.temperature), count)
        return WarmSolution(level, rung.answer(answer_below(level, before)), rung, own)

    def on_field(self, level: FieldLevel, film: FilmCandidate, before: Found | None) -> WarmSolution:
        """Return the answer on a film with a temperature field."""
        own = level.rest(film.reaction, self.load, self.speed)
        return WarmSolution(level, Found(self.value(own), {}), own=own, judge=self.judge)

    def judged(self, solved: WarmSolution) -> RestJudge:
        """Return what judges rests by an answer."""
        return self.judge

    def moved(self, film: FilmCandidate) -> Callable[[Any], float]:
        """Return a call that takes another bearing and returns how far its answer by T1 is off."""
        own = uniform_rest(film.reaction, self.load, self.speed)
        return lambda other: self.judge.apart(own, uniform_rest(other, self.load, self.speed))

    def conserved(self, film: JFOFilm, before: Found | None) -> Any:
        """Return the answer on a film that conserves its oil, from that of a lower rung if there is one."""
        return self.value(rest_on(film, self.load, self.speed))

    def conservation(self, bearing: JournalBearing) -> Callable[[Found], Change]:
        """Return a call that takes an answer and returns what the conservation of oil changes in it."""
        known = cache(partial(change_at_rest, self, bearing))
        return lambda found: known()


EFFECTS = (heat, conserved_oil)
"""Effects on films of any bearing: each takes scene, question, films and ladder, and returns the ladder."""


def film_ladder(scene: Scene, films: Films, question: FilmQuestion) -> Ladder:
    """Return the ladder of a question on films of one viscosity, with the effects that the scene has."""
    if not question.moves and scene.journal is not None and scene.journal.conserves:
        return conserved_ladder(scene, question)
    known = films(scene)
    rungs: list[Rung] = [question.make(film, count) for film in known for count in question.counts]
    if question.effort is not None:
        rungs.sort(key=question.effort)
    ladder = Ladder(
        rungs=tuple(rungs),
        unit=question.unit,
        units=question.units(known),
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
        distance=question.distance,
    )
    for effect in EFFECTS:
        ladder = effect(scene, question, known, ladder)
    return ladder


def any_bearing(scene: Scene) -> Any:
    """Return the bearing with a film of a scene, on its oil; of a journal by Reynolds rupture."""
    return scene.film_table.build() if scene.journal is None else scene.journal_bearing


def film_units(films: Sequence[FilmCandidate], speed: float) -> Units:
    """Return one unit of work of each film, at half the clearance."""
    return {unit: call for film in films for unit, call in film.units(speed).items()}


# Quantities of a journal at rest.


@dataclass(frozen=True, kw_only=True)
class StaticRung(CandidateRung):
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
        film: FilmCandidate = self.film
        return film.position_prior if self.quantity.position else film.prior

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
        work: Work = self.film.expected(sum(done.values()))
        return work


UNFED = (
    "supply: the bearing has none, and its film starts with oil that is made there; with the grooves or "
    "holes that feed it this is another number"
)


def static_ladder(films: Films, scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity.

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
        If a temperature is asked for and there is no oil, or the film has no losses, where they are asked for
        or heat the oil.
    """
    asked, load, speed = QUANTITIES[quantity], scene.static_load, scene.speed
    bearing = any_bearing(scene)
    if quantity in TEMPERATURES and not bearing.is_warming:
        raise InputError(
            f"lubricant must give the oil of the bearing for {quantity}, as a grade, got a viscosity of "
            f"{bearing.film_viscosity:g} Pa s"
        )
    supply = bearing.cooled[1].supply_temperature if bearing.is_warming else 0.0

    def known(scene: Scene) -> Sequence[FilmCandidate]:
        found = films(scene)
        return with_losses(found, quantity) if quantity in LOSSES and not bearing.is_warming else found

    question = FilmQuestion(
        load=load,
        speed=speed,
        unit=asked.unit,
        make=lambda film, count: StaticRung(film=film, quantity=asked, load=load, speed=speed),
        value=asked.value,
        distance=lambda value, better: asked.distance(value, better, supply),
        units=partial(film_units, speed=speed),
        scaled=asked.scaled,
        is_fresh=quantity not in TEMPERATURES,
        follows_oil=True,
    )
    ladder = film_ladder(scene, known, question)
    table = scene.journal
    if quantity != "side_flow" or table is None or table.conserves or not bearing.geometry.plain:
        return ladder
    return replace(ladder, remarks=(*ladder.remarks, UNFED))
