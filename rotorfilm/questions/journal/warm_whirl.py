"""At which speed a rigid rotor begins to whirl on an oil: the film as warm as its rest at each speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...answers import HEATED, ErrorEstimate, Found, Work, WorkUnit
from ...bearings.journal import JournalBearing
from ...errors import RotorfilmError
from ...ladders import Ladder
from ...linear import whirl_threshold
from ...results import Equilibrium, WhirlThreshold
from ...scenes.journal.assumed import assumed_figures
from ...scenes.journal.film_rung import FilmRung
from ...scenes.journal.film_rungs import point_films
from ...scenes.journal.warm_rest import step, uniform_rest
from .heat_rungs import BALANCED, BALANCES, FRESH, HeatLevel, known_films
from .whirl_rungs import AROUND, WhirlRung, whirl_ladder

if TYPE_CHECKING:
    from ...scenes.scene import Scene

MOVING, PECLET, POWER = 0.03, 20.0, 0.8
"""Share of the speed by which heat that moves with the whirl lowers a threshold at a Peclet number, and the
power with which it grows with that: 3 % at 20, 10 % at 90, by unsteady solutions of T2."""

SPEEDS = 40
"""Equilibria that a search takes about."""


@dataclass(frozen=True, kw_only=True)
class WarmWhirlRung(WhirlRung):
    """The whirl threshold by one film, frozen at the temperature of the equilibrium at each speed.

    Attributes
    ----------
    level : HeatLevel
        T1, or T0 with the film of fresh oil at all speeds.
    bearing : JournalBearing
        On its oil, with the film of the rung.
    """

    level: HeatLevel
    bearing: JournalBearing

    @property
    def name(self) -> str:
        """Level and film."""
        return f"{self.level.name}, {self.film.name}"

    @property
    def shares(self) -> object:
        """The error of the heat."""
        return self.level

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        nominal = self.film.time(SPEEDS * BALANCES)
        return WorkUnit(f"answers of {self.name}", (self.level, self.name), nominal=nominal)

    def answer(self, before: Found | None) -> Found:
        """Return the speed at which the equilibrium loses stability [rad/s]."""
        around = None if before is None else (before.value / AROUND, before.value * AROUND)
        threshold = self._threshold(self.film.reaction, around)
        return Found(threshold.speed, {self.unit: 1}, threshold.equilibrium)

    def _threshold(self, bearing: JournalBearing, around: tuple[float, float] | None) -> WhirlThreshold:
        threshold = whirl_threshold(bearing, self.load, self.mass, around)
        if threshold.speed is None and around is not None:
            threshold = whirl_threshold(bearing, self.load, self.mass)
        if threshold.speed is None:
            raise RotorfilmError(f"no threshold: {threshold.reason}, by {self.name}")
        return threshold

    def film_at(self, at: Equilibrium) -> FilmRung:
        """Return the film at the temperature of one equilibrium."""
        return self.film if at.temperature is None else self.film.at_temperature(at.temperature)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the film, of the temperature at the threshold, and of its standing still.

        The last is of one sign: heat that moves with the whirl lowers the threshold.
        """
        at: Equilibrium = found.solution
        about = super().estimate(found, before, tolerance)
        fresh = self.level is FRESH
        try:
            own = uniform_rest(
                self.bearing,
                self.load,
                at.speed,
                self.bearing.cooled[1].supply_temperature if fresh else None,
            )
            if fresh:
                place = own.rest.position, np.zeros(2), at.speed
                warm = self.bearing.balanced_temperature(*place)
                other = uniform_rest(self.bearing, self.load, at.speed, warm)
            else:
                other = step(self.bearing, own)
            heat = self.change(own.coefficients, other.coefficients)
        except RotorfilmError as error:
            return about._replace(error=np.inf, doubt=f"its error by heat is not known: {error}")
        moving = moving_heat(self.bearing, at.speed)
        how = "its balance" if fresh else "one solution of T3"
        method = f"{about.method}; heat: {how}, {heat:.2g}; moving heat, {moving:.2g} lower"
        work = {WorkUnit(f"estimates of {self.name}"): 1}
        total = about.error + heat + moving
        return ErrorEstimate(total, method, work, doubt=about.doubt, shared=heat + moving)

    def expected(self, done: Work) -> Work:
        """Return one answer."""
        return {self.unit: 1}

    def moved(self, found: Found, other: JournalBearing) -> float:
        """Return the relative change of the threshold with another bearing, by this film."""
        around = found.value / AROUND, found.value * AROUND
        speed = self._threshold(other, around).speed
        assert speed is not None  # or there is an error
        return abs(speed - found.value) / found.value


def moving_heat(bearing: JournalBearing, speed: float) -> float:
    """Return the share by which heat that moves with the whirl lowers a threshold [1] at a speed [rad/s].

    Oil runs at half the speed, and in forward half-speed whirl with the pattern of the film; conduction to
    the walls, as fast as the Peclet number speed clearance^2/diffusivity is small, keeps it near frozen.
    """
    oil, cooling = bearing.cooled
    per_volume = float(oil.volumetric_heat(cooling.supply_temperature))
    peclet = abs(speed) * bearing.clearance**2 * per_volume / oil.conductivity
    return MOVING * (peclet / PECLET) ** POWER


def journal_whirl_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the whirl threshold: of an oil T0 and T1, else by one viscosity.

    Raises
    ------
    InputError
        If the scene has no rigid rotor.
    """
    if scene.rigid_rotor is None or not scene.bearing.is_warming:
        return whirl_ladder(scene, quantity)
    mass, films = scene.rigid_rotor.mass, point_films(scene.bearing, fixed=scene.film_is_given)
    known = known_films(films)
    rungs = []
    for level in (FRESH, BALANCED):
        for warm in known:
            fresh = warm.at_temperature(warm.reaction.cooled[1].supply_temperature)
            film = fresh if level is FRESH else warm
            rungs.append(
                WarmWhirlRung(
                    film=film, load=scene.static_load, mass=mass, level=level, bearing=warm.reaction
                )
            )
    quick = next(rung for rung in rungs if rung.level is BALANCED)

    def assumptions() -> tuple[str, ...]:
        found = quick.answer(None)
        return assumed_figures(quick.bearing, lambda other: quick.moved(found, other), fields=False)

    return Ladder(
        rungs=tuple(rungs),
        unit="rad/s",
        remarks=scene.film_remarks,
        within=HEATED,
        assumptions=assumptions,
    )
