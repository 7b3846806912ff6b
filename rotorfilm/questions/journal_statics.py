"""Static questions about a journal bearing: where it rests, and its stiffness and damping there."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis import coefficients, equilibrium
from ..bearings.reaction import minimum_film
from ..core.answers import (
    ISOTHERMAL,
    SAFETY,
    CandidateRung,
    ErrorEstimate,
    Found,
    Ladder,
    Work,
    WorkUnit,
    relative_change,
)
from ..core.model import Array, Reaction, prepared_tangent
from ..core.results import Equilibrium
from ..scenes.film_heat import WarmRest
from ..scenes.film_rungs import FilmCandidate, corrected, counted_calls, one_defect, room

if TYPE_CHECKING:
    from ..scenes.scene import Scene

ANGLE, MATRIX = "attitude_angle", {"stiffness": 0, "damping": 2}
LOSSES = {"power_loss": "W", "side_flow": "m^3/s"}
TEMPERATURES = {"temperature": "K", "maximum_temperature": "K"}
HEAT = {**LOSSES, **TEMPERATURES}
STATIC_UNITS = {
    "eccentricity_ratio": "1",
    "minimum_film": "m",
    ANGLE: "rad",
    "stiffness": "N/m",
    "damping": "N s/m",
    **HEAT,
}
"""Static quantities and their units."""


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
        return film_prior(self.film, self.quantity)

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
        if self.quantity in HEAT:
            return heat_value(bearing, self.quantity, position, self.speed)
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
        twice = self.quantity in HEAT
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


def film_prior(film: FilmCandidate, quantity: str) -> float:
    """Return the order of magnitude of the error of a film in a static quantity."""
    return film.prior if quantity in MATRIX or quantity in HEAT else film.position_prior


def heat_value(bearing: Any, quantity: str, position: Array, speed: float) -> float:
    """Return one of `HEAT` where a journal rests (2,) [m] at a speed [rad/s]."""
    still = np.zeros(2)
    if quantity in LOSSES:
        return float(getattr(bearing.losses(position, still, speed), quantity))
    return float(bearing.balanced_temperature(position, still, speed))


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
    if quantity in TEMPERATURES:
        return abs(float(better) - float(value)) / (float(better) - supply)
    return abs(float(better) - float(value)) if quantity == ANGLE else relative_change(value, better)


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


def cold_static_ladder(scene: Scene, quantity: str, films: Sequence[FilmCandidate]) -> Ladder:
    """Return the ladder of a static quantity by films of one viscosity."""
    rungs = tuple(
        StaticRung(film=film, quantity=quantity, load=scene.static_load, speed=scene.speed) for film in films
    )
    return Ladder(
        rungs=rungs,
        unit=STATIC_UNITS[quantity],
        units=film_units(films, scene.speed),
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
        distance=lambda value, better: relative_distance(quantity, value, better, 0.0),
    )


def rest_value(quantity: str, own: WarmRest) -> Array | float:
    """Return a static quantity of a rest on a film that warms."""
    if quantity in MATRIX:
        return np.asarray(getattr(own.coefficients, quantity))
    return float(getattr(own if hasattr(own, quantity) else own.rest, quantity))
