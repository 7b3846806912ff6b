"""At which speed a rigid rotor begins to whirl on an oil: the film as warm as its rest at each speed.

By one temperature (T0, T1) on every film, or by a temperature field (T2, T3), K and C at frozen temperature.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from ...answers import HEATED, SAFETY, ErrorEstimate, Found, Work, WorkUnit
from ...ladders import BaseRung, Ladder
from ...linear.speed_events import secant_speed
from ...results import Equilibrium
from ...scenes.journal.assumed import assumed_figures
from ...scenes.journal.field_levels import FIELD_LEVELS, FieldLevel, grid_error
from ...scenes.journal.film_candidate import FilmCandidate
from ...scenes.journal.film_rungs import point_films
from ...scenes.journal.heat_steps import HeatError, HeatSteps, JudgedRest
from ...scenes.journal.warm_rest import WarmRest, ends_within, uniform_rest
from .conserved_whirl import with_conserved_whirl
from .heat_rungs import BALANCE, BALANCED, BALANCES, FRESH, HeatLevel, balance_at, known_films, with_heat
from .whirl_rungs import WhirlRung, threshold_around, whirl_ladder

if TYPE_CHECKING:
    from ...scenes.scene import Scene

MOVING, PECLET, POWER = 0.03, 20.0, 0.8
"""Share of the speed by which heat that moves with the whirl lowers a threshold at a Peclet number, and the
power with which it grows with that: 3 % at 20, 10 % at 90, by unsteady solutions of T2."""

SPEEDS = 40
"""Equilibria that a search takes about."""

RESTS, NEAR, FARTHEST = 12, 3e-5, 0.2
"""Most rests on a temperature field that a search takes, the relative change of speed at which it ends, and
the largest one of a step."""


@dataclass(frozen=True, kw_only=True)
class WarmWhirlRung(WhirlRung):
    """The whirl threshold by one film, frozen at the temperature of the equilibrium at each speed.

    Attributes
    ----------
    level : HeatLevel
        T1, or T0 with the film of fresh oil at all speeds.
    bearing : JournalBearing, or one of pads
        On its oil, with the film of the rung.
    film : FilmCandidate
    """

    level: HeatLevel
    bearing: Any
    film: FilmCandidate

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
        threshold = threshold_around(self.film.reaction, self, before)
        return Found(threshold.speed, {self.unit: 1}, threshold.equilibrium)

    def film_at(self, at: Equilibrium) -> FilmCandidate:
        """Return the film at the temperature of one equilibrium."""
        return self.film if at.temperature is None else self.film.at_temperature(at.temperature)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the film, of the temperature at the threshold, and of its standing still.

        The last is of one sign: heat that moves with the whirl lowers the threshold.
        """
        at: Equilibrium = found.solution
        about = super().estimate(found, before, tolerance)
        moving = moving_heat(self.bearing, at.speed)

        def whole() -> tuple[HeatError, str, str]:
            (error, bound), how, doubt = self.heat(at, tolerance)
            heat = HeatError(error + moving, bound or moving > error)
            return heat, f"{how}, moving heat {moving:.2g} lower", doubt

        return with_heat(about, whole, f"estimates of {self.name}")

    def heat(self, at: Equilibrium, tolerance: float) -> tuple[HeatError, str, str]:
        """Return the error by heat at the threshold, how that is known, and why to doubt it."""
        growth, own, start = self.rests(at)
        error = growth.apart(own, start)
        if error * SAFETY >= tolerance:
            return HeatError(error, False), BALANCE, ""
        steps = HeatSteps(self.bearing, start)
        return growth.error(own, steps), "steps towards T3", steps.doubt

    def rests(self, at: Equilibrium) -> tuple[Growth, WarmRest, WarmRest]:
        """Return growth and rest at a threshold, and the rest in the balance of its heat, of T1 the same."""
        fresh = self.bearing.cooled[1].supply_temperature if self.level is FRESH else None
        own = start = uniform_rest(self.bearing, self.load, at.speed, fresh)
        if self.level is FRESH:
            start = uniform_rest(self.bearing, self.load, at.speed, balance_at(self.bearing, own))
        return Growth(self, at.speed, self.slope(at.speed)), own, start

    def expected(self, done: Work) -> Work:
        """Return one answer."""
        return {self.unit: 1}

    def moved(self, found: Found, other: Any) -> float:
        """Return the relative change of the threshold with another bearing, by this film."""
        speed = threshold_around(other, self, found).speed
        assert speed is not None  # or there is an error
        return abs(speed - found.value) / found.value


@dataclass(frozen=True)
class Growth(JudgedRest):
    """What K and C of a rest at a threshold do to its speed.

    Attributes
    ----------
    rung : WhirlRung
        Of the rotor.
    speed : float [rad/s]
    per_speed : float [1]
        d(growth)/d speed.
    """

    rung: WhirlRung
    speed: float
    per_speed: float

    def value(self, own: WarmRest) -> float:
        """Return the growth rate of the whirl of a rest [1/s]."""
        return self.rung.growth(own.coefficients)

    def distance(self, value: float, better: float) -> float:
        """Return by which share of itself the threshold is off."""
        return abs((better - value) / self.per_speed) / self.speed


class FieldThreshold(NamedTuple):
    """A rest on a temperature field at the threshold [rad/s], and what speeds do to its growth."""

    own: WarmRest
    growth: Growth


@dataclass(frozen=True, kw_only=True)
class FieldWhirlRung(BaseRung):
    """The whirl threshold on a film with a temperature field, frozen as at the rest at each speed.

    Attributes
    ----------
    level : FieldLevel
        T2 or T3.
    uniform : WarmWhirlRung
        By T1, where the search starts.
    """

    level: FieldLevel
    uniform: WarmWhirlRung

    @property
    def name(self) -> str:
        """Level, cells and layers."""
        return self.level.name

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        seconds = 4.0 * self.level.seconds
        return WorkUnit(f"thresholds of {self.name}", ("thresholds", self.name), nominal=seconds)

    def answer(self, before: Found | None) -> Found:
        """Return the speed at which the growth of the whirl vanishes [rad/s], by secants."""
        rung = self.uniform
        speed = float((rung.answer(None) if before is None else before).value)

        def growth_at(speed: float) -> tuple[float, WarmRest]:
            own = self.level.rest(rung.bearing, rung.load, speed)
            return rung.growth(own.coefficients), own

        at = secant_speed(growth_at, speed, rung.slope(speed), near=NEAR, farthest=FARTHEST, most=RESTS)
        return Found(at.speed, {self.unit: 1}, FieldThreshold(at.solution, Growth(rung, at.speed, at.slope)))

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return of T2 what steps towards T3 change, of T3 coarser grids; moving heat."""
        own, growth = found.solution
        bearing, load = self.uniform.bearing, self.uniform.load
        moving = moving_heat(bearing, growth.speed)
        work = {WorkUnit(f"estimates of {self.name}"): 1}
        if not self.level.layers:
            steps = HeatSteps(bearing, own)
            heat = growth.error(own, steps)
            bound = heat.bound or moving > heat.error
            method = f"steps towards T3, {heat.error:.2g}; moving heat, {moving:.2g} lower"
            return ErrorEstimate(heat.error + moving, method, work, bound=bound, doubt=steps.doubt)
        grid = grid_error(
            self.level, own, lambda level: level.rest(bearing, load, growth.speed), growth.apart
        )
        method = f"cells twice as long, half the layers, {grid:.2g}; moving heat, {moving:.2g} lower"
        return ErrorEstimate(grid + moving, method, work, bound=True)


def moving_heat(bearing: Any, speed: float) -> float:
    """Return the share by which heat that moves with the whirl lowers a threshold [1] at a speed [rad/s].

    Oil runs at half the speed, and in forward half-speed whirl with the pattern of the film; conduction to
    the walls, as fast as the Peclet number speed clearance^2/diffusivity is small, keeps it near frozen.
    """
    oil, cooling = bearing.cooled
    per_volume = float(oil.volumetric_heat(cooling.supply_temperature))
    peclet = abs(speed) * bearing.clearance**2 * per_volume / oil.conductivity
    return MOVING * (peclet / PECLET) ** POWER


def journal_whirl_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the whirl threshold: of an oil T0 to T3, else by one viscosity.

    Raises
    ------
    InputError
        If the scene has no rigid rotor.
    """
    return with_conserved_whirl(scene, quantity, lambda: _ruptured_ladder(scene, quantity))


def _ruptured_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the same by Reynolds rupture."""
    if scene.rigid_rotor is None or not scene.journal_bearing.is_warming:
        return whirl_ladder(scene, quantity)
    mass, films = scene.rigid_rotor.mass, point_films(scene.journal_bearing, fixed=scene.film_is_given)
    known = known_films(films)
    uniform = {}
    for level in (FRESH, BALANCED):
        for warm in known:
            fresh = warm.at_temperature(warm.reaction.cooled[1].supply_temperature)
            film = fresh if level is FRESH else warm
            uniform[level, warm.name] = WarmWhirlRung(
                film=film, load=scene.static_load, mass=mass, level=level, bearing=warm.reaction
            )
    quick = uniform[BALANCED, known[0].name]
    levels = () if ends_within(quick.bearing) else FIELD_LEVELS[:2]  # without the oil's memory they are none
    fields = (FieldWhirlRung(level=level, uniform=quick) for level in levels)

    def assumptions() -> tuple[str, ...]:
        found = quick.answer(None)
        return assumed_figures(quick.bearing, lambda other: quick.moved(found, other), fields=True)

    return Ladder(
        rungs=(*uniform.values(), *fields),
        unit="rad/s",
        remarks=scene.film_remarks,
        within=HEATED,
        assumptions=assumptions,
    )
