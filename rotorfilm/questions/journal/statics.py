"""Static questions about a journal bearing: where it rests, and its stiffness and damping there."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ...answers import HEATED, ISOTHERMAL, SAFETY, ErrorEstimate, Found, Work, WorkUnit
from ...bearings.contact_place import minimum_film
from ...bearings.journal import JFOFilm, film_name, has_losses
from ...errors import InputError, RotorfilmError
from ...ladders import CandidateRung, Ladder
from ...linear import coefficients, equilibrium
from ...model import Array, Reaction, prepared_tangent
from ...results import Equilibrium
from ...scenes.counted import counted_calls
from ...scenes.journal.film_candidate import FilmCandidate, room
from ...scenes.journal.film_defects import corrected, one_defect
from ...scenes.journal.film_rung import FilmRung
from ...scenes.journal.film_rungs import point_films
from ...scenes.journal.warm_rest import WarmRest, uniform_rest
from .conserved_rungs import (
    UNFED,
    Change,
    ConservedRung,
    Rest,
    Rupture,
    conserved_films,
    rest_on,
    rest_slopes,
    with_rupture,
)
from .field_rungs import HeatedQuestion
from .heat_rungs import BALANCED, UniformRung, known_films, thermal_ladder

if TYPE_CHECKING:
    from ...scenes.scene import Scene
    from ...scenes.schema import JournalTable

ANGLE, MATRIX = "attitude_angle", {"stiffness": 0, "damping": 2}
LOSSES = {"power_loss": "W", "side_flow": "m^3/s"}
TEMPERATURES = {"temperature": "K", "maximum_temperature": "K"}
UNITS = {
    "eccentricity_ratio": "1",
    "minimum_film": "m",
    ANGLE: "rad",
    "stiffness": "N/m",
    "damping": "N s/m",
    **LOSSES,
    **TEMPERATURES,
}
"""Static quantities and their units."""

RELATIVE = ("eccentricity_ratio", "minimum_film", *LOSSES)
"""Those that grids change by about the same share, coarse ones or fine."""


@dataclass(frozen=True, kw_only=True)
class StaticRung(CandidateRung[FilmCandidate]):
    """The equilibrium by one film.

    Attributes
    ----------
    quantity : str
        A key of `UNITS`.
    load : (float, float) [N]
    speed : float [rad/s]
    """

    quantity: str
    load: tuple[float, float]
    speed: float

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        positions = self.quantity not in {**MATRIX, **LOSSES, **TEMPERATURES}
        return self.film.position_prior if positions else self.film.prior

    def answer(self, before: Found | None) -> Found:
        """Return the quantity at the equilibrium of this film."""
        made = self.film.prepare()
        counted = counted_calls(self.film.reaction)
        at = equilibrium(counted, self.load, self.speed)
        if self.quantity in MATRIX:
            found = coefficients(counted, at.position, self.speed)
            value: Array | float = found.stiffness if self.quantity == "stiffness" else found.damping
        else:
            value = self.scalar(at.position, self.film.reaction)
        return Found(value, {self.film.tangents: counted.tangents, **made}, at)

    def scalar(self, position: Array, bearing: Any) -> float:
        """Return a quantity that follows from the position (2,) [m] in this or the richer bearing."""
        if self.quantity in LOSSES:
            return float(getattr(bearing.losses(position, np.zeros(2), self.speed), self.quantity))
        if self.quantity in TEMPERATURES:
            return bearing.balanced_temperature(position, np.zeros(2), self.speed)
        distance = float(np.hypot(*position))
        if self.quantity == "eccentricity_ratio":
            return distance / self.film.reaction.clearance
        if self.quantity == "minimum_film":
            return float(minimum_film(self.film.reaction, position))
        return attitude(position, self.load, self.speed)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the verified bound if that is enough, else the change that the richer film would make."""
        bound = self._bound(found)
        if SAFETY * bound < tolerance:
            return ErrorEstimate(bound, "verified bound of the map", bound=True)
        return self._by_defect(found)

    def _bound(self, found: Found) -> float:
        at: Equilibrium = found.solution
        slopes = self.quantity in MATRIX
        if self.quantity in LOSSES:
            return self.film.loss_bound(at.eccentricity_ratio)
        if self.quantity in TEMPERATURES:
            return 2.0 * self.film.loss_bound(at.eccentricity_ratio)  # that of power/flow
        bound = self.film.rest_bound(at, slopes=slopes)
        if slopes or not math.isfinite(bound):
            return bound
        stiffness = coefficients(self.film.reaction, at.position, self.speed).stiffness
        moved = bound * math.hypot(*self.load) * float(np.linalg.norm(np.linalg.inv(stiffness), 2))
        return moved / self._length(at)

    def _length(self, at: Equilibrium) -> float:
        """Return the change of position [m] that is an error of 1 at most."""
        return at.minimum_film if self.quantity == "minimum_film" else float(np.hypot(*at.position))

    def _by_defect(self, found: Found) -> ErrorEstimate:
        at: Equilibrium = found.solution
        slopes = self.quantity in MATRIX
        moved = corrected(self.film, at, np.array(self.load), smooth=slopes)
        if self.quantity in MATRIX:
            first = MATRIX[self.quantity]
            better: Array | float = -moved.slopes[:, first : first + 2]
        else:
            better = self.scalar(moved.position, self.film.rich)
        error = relative_distance(self.quantity, found.value, better, self.film.supply_temperature)
        twice = self.quantity in LOSSES or self.quantity in TEMPERATURES
        return ErrorEstimate(
            error,
            f"defect of {self.film.rich_name}",
            {self.film.defects(smooth=slopes): 2 if twice else 1, self.film.tangents: 2},
            bound=self.film.bounded,
            doubt=moved.doubt,
            better=None if moved.doubt else better,
        )

    def expected(self, done: Work) -> Work:
        """Return as many tangents as a lower rung took."""
        return self.film.expected(sum(done.values()))


def attitude(position: Array, load: tuple[float, float], speed: float) -> float:
    """Return the angle [rad] from a load [N] to a position (2,) [m], in the sense of rotation."""
    (x, y), (load_x, load_y) = position, load
    turned = math.atan2(load_x * y - load_y * x, load_x * x + load_y * y)
    return math.copysign(1.0, speed) * turned


def relative_distance(quantity: str, value: Array | float, better: Array | float, supply: float) -> float:
    """Return how far a value is from a better one, in the unit of the tolerance.

    Relative to the largest entry of the better one, of an angle in radians, of a temperature to its rise
    above that of the supply [K].
    """
    gap = float(np.max(np.abs(np.asarray(better) - value)))
    if quantity in TEMPERATURES:
        return gap / (float(better) - supply)
    return gap / (1.0 if quantity == ANGLE else float(np.max(np.abs(better))))


def film_units(films: Sequence[FilmCandidate], speed: float) -> dict[WorkUnit, Callable[[], object]]:
    """Return one unit of work of each film, at half the clearance."""
    units: dict[WorkUnit, Callable[[], object]] = {}
    for film in films:
        units[film.tangents] = _one_tangent(film.reaction, speed)
        for smooth in (False, True):
            units[film.defects(smooth=smooth)] = one_defect(film, speed, smooth=smooth)
    return units


def _one_tangent(bearing: Reaction, speed: float) -> Callable[[], object]:
    return lambda: prepared_tangent(bearing)(0.3 * room(bearing), 0.4 * room(bearing), 0.0, 0.0, speed)


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
    rupture = Rupture(scene.journal_bearing, scene.static_load, scene.speed)

    def change(found: Found) -> Change:
        own, better = (conserved_value(quantity, rest, scene) for rest in rupture.rests)
        return Change(own, better, relative=quantity in RELATIVE)

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
    warm = scene.journal_bearing.is_warming
    return Ladder(
        rungs=above_rupture(scene, quantity),
        unit=UNITS[quantity],
        remarks=scene.film_remarks,
        within=HEATED if warm else ISOTHERMAL,
    )


def above_rupture(scene: Scene, quantity: str) -> tuple[ConservedRung, ...]:
    """Return the rungs of a static quantity that conserve their oil."""

    def value(film: JFOFilm, before: Found | None) -> Array | float:
        return conserved_value(quantity, rest_on(film, scene.static_load, scene.speed), scene)

    heat = heat_of_balance(scene, quantity) if scene.journal_bearing.is_warming else None
    distance = distance_of(scene, quantity)
    return tuple(
        ConservedRung(film=film, value=value, distance=distance, heat=heat) for film in conserved_films(scene)
    )


def heat_of_balance(scene: Scene, quantity: str) -> Callable[[float], ErrorEstimate]:
    """Return a call for the error by heat of a film of one temperature, that of Reynolds rupture."""
    question = heated_question(scene, quantity)
    film = known_films(point_films(scene.journal_bearing, fixed=False))[0]
    rung = UniformRung(level=BALANCED, film=film, question=question)

    def heat(tolerance: float) -> ErrorEstimate:
        try:
            own = uniform_rest(film.reaction, scene.static_load, scene.speed)
            found, how, doubt = rung.heat(own, tolerance)
        except RotorfilmError as error:
            return ErrorEstimate(math.inf, "not known", doubt=f"its error by heat is not known: {error}")
        return ErrorEstimate(found.error, how, bound=found.bound, doubt=doubt)

    return heat


def conserved_value(quantity: str, rest: Rest, scene: Scene) -> Array | float:
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


def cold_static_ladder(scene: Scene, quantity: str, films: Sequence[FilmCandidate]) -> Ladder:
    """Return the ladder of a static quantity by films of one viscosity."""
    rungs = tuple(
        StaticRung(film=film, quantity=quantity, load=scene.static_load, speed=scene.speed) for film in films
    )
    return Ladder(
        rungs=rungs,
        unit=UNITS[quantity],
        units=film_units(films, scene.speed),
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
    )


def warm_static_ladder(scene: Scene, quantity: str, films: tuple[FilmRung, ...]) -> Ladder:
    """Return the ladder of a static quantity of a journal bearing on an oil."""
    question = heated_question(scene, quantity)
    return thermal_ladder(scene, films, (question,), UNITS[quantity], fresh=quantity not in TEMPERATURES)


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


def rest_value(quantity: str, own: WarmRest) -> Array | float:
    """Return a static quantity of a rest on a film that warms."""
    if quantity in MATRIX:
        return np.asarray(getattr(own.coefficients, quantity))
    return float(getattr(own if hasattr(own, quantity) else own.rest, quantity))
