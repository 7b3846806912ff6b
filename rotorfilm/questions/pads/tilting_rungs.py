"""Questions about tilting pads: where a journal rests on them, K and C at the shaft's frequency, whirl."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ...answers import ISOTHERMAL, ErrorEstimate, Found, WorkUnit
from ...ladders import CandidateRung, Ladder
from ...linear import coefficients, equilibrium
from ...model import Array
from ...results import Equilibrium
from ...scenes.journal.film_defects import corrected
from ...scenes.pads.tilting_candidates import TiltingCandidate, tilting_candidates
from ...warming import settled
from ..journal.statics import HEAT, MATRIX, UNITS, attitude, film_prior, heat_value, relative_distance
from ..journal.whirl_rungs import STEP, required_rotor, threshold_around
from ..walk import NoAnswerError
from .fixed_ladders import refuse_temperature
from .warm_pads import ONE_TEMPERATURE, is_warm, warm_static_ladder

if TYPE_CHECKING:
    from ...scenes.scene import Scene

CALLS, SPEEDS = 8, 40
"""Forces with derivatives that an equilibrium takes about, and equilibria of a search for a threshold."""


@dataclass(frozen=True, kw_only=True)
class TiltingRung(CandidateRung[TiltingCandidate]):
    """An answer on tilting pads by one film.

    Attributes
    ----------
    quantity : str
    load : (float, float) [N]
    """

    quantity: str
    load: tuple[float, float]

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        return WorkUnit(f"answers of {self.name}", ("answers", self.film), nominal=self.film.time(CALLS))

    @property
    def estimates(self) -> WorkUnit:
        """One estimate."""
        return WorkUnit(f"estimates by {self.film.rich_name}", ("estimates", self.film))

    def corrected_rest(self, at: Equilibrium) -> tuple[Array, str]:
        """Return where the richer film has its equilibrium (2,) [m], and why not to trust that."""
        moved = corrected(self.film.resting, at, np.array(self.load), smooth=False)
        return moved.position, moved.doubt


@dataclass(frozen=True, kw_only=True)
class TiltingRestRung(TiltingRung):
    """A static quantity, or K and C at the frequency of the shaft.

    Attributes
    ----------
    speed : float [rad/s]
    """

    speed: float

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        return film_prior(self.film, self.quantity)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity at the equilibrium of this film."""
        at = equilibrium(self.film.reaction, self.load, self.speed)
        return Found(self._value(self.film, at.position), {self.unit: 1}, at)

    def _value(self, film: TiltingCandidate, position: Array, *, rich: bool = False) -> Array | float:
        bearing = film.rich if rich else film.reaction
        if self.quantity in MATRIX:
            own = film.coefficients if rich else partial(coefficients, bearing)
            return np.asarray(getattr(own(position, self.speed), self.quantity))
        if self.quantity in HEAT:
            return heat_value(bearing, self.quantity, position, self.speed)
        if self.quantity == "eccentricity_ratio":
            return float(np.hypot(*position)) / bearing.clearance
        if self.quantity == "minimum_film":
            return float(bearing.at_rest().pad_states(position, self.speed).film_thickness.min())
        return attitude(position, self.load, self.speed)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change that the richer film makes, at its own equilibrium as far as its defect tells."""
        position, doubt = self.corrected_rest(found.solution)
        better = self._value(self.film, position, rich=True)
        error = relative_distance(self.quantity, found.value, better, self.film.supply_temperature)
        method = f"defect of {self.film.rich_name}"
        return ErrorEstimate(error, method, {self.estimates: 1}, doubt=doubt)


@dataclass(frozen=True, kw_only=True)
class TiltingWhirlRung(TiltingRung):
    """The speed at which a rigid rotor begins to whirl, judged with the pads.

    Attributes
    ----------
    mass : float [kg]
    """

    mass: float

    def answer(self, before: Found | None) -> Found:
        """Return the speed [rad/s]; raises NoAnswerError where rotor and pads are stable at all speeds."""
        threshold = threshold_around(self.film.reaction, self, before, NoAnswerError)
        return Found(threshold.speed, {self.unit: SPEEDS}, threshold.equilibrium)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change of speed that undoes the growth by the richer film at its own equilibrium."""
        at: Equilibrium = found.solution
        film = self.film if at.temperature is None else self.film.at_temperature(at.temperature)
        position, doubt = replace(self, film=film).corrected_rest(at)
        growth = float(film.rich.at_rest().modes(position, at.speed, self.mass)[0].real)
        low, high = (self._growth(at.speed * (1.0 + sign * STEP)) for sign in (-1.0, 1.0))
        slope = (high - low) / (2.0 * STEP * at.speed)
        error = abs(growth / slope) / at.speed if slope else math.inf
        method = f"growth by {self.film.rich_name}"
        return ErrorEstimate(error, method, {self.estimates: 1}, doubt=doubt)

    def _growth(self, speed: float) -> float:
        at = equilibrium(self.film.reaction, self.load, speed)
        film = settled(self.film.reaction, at.position, speed)
        return float(film.at_rest().modes(at.position, speed, self.mass)[0].real)


def tilting_rest_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity, or of K or C, of tilting pads."""

    def make(film: TiltingCandidate) -> TiltingRestRung:
        return TiltingRestRung(film=film, quantity=quantity, load=scene.static_load, speed=scene.speed)

    films = _films(scene)
    if is_warm(scene):
        ladder = warm_static_ladder(scene, quantity, films, make)
    else:
        refuse_temperature(scene, quantity)
        rungs = tuple(make(film) for film in films)
        ladder = Ladder(
            rungs=rungs,
            unit=UNITS[quantity],
            remarks=scene.film_remarks,
            within=ISOTHERMAL,
            distance=lambda value, better: relative_distance(quantity, value, better, 0.0),
        )
    if quantity not in MATRIX:
        return ladder
    return replace(ladder, within=f"{ladder.within}, whirl of {abs(scene.speed):.6g} rad/s, once a turn")


def tilting_whirl_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the whirl threshold of a rigid rotor on tilting pads.

    Raises
    ------
    InputError
        If the scene has no rigid rotor.
    """
    mass = required_rotor(scene, quantity).mass
    rungs = tuple(
        TiltingWhirlRung(film=film, quantity=quantity, load=scene.static_load, mass=mass)
        for film in _films(scene)
    )
    within = ONE_TEMPERATURE if is_warm(scene) else ISOTHERMAL
    return Ladder(rungs=rungs, unit="rad/s", remarks=scene.film_remarks, within=within)


def _films(scene: Scene) -> tuple[TiltingCandidate, ...]:
    return tilting_candidates(scene.table("tilting_pad").build(), fixed=scene.film_is_given)
