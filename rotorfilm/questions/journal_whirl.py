"""At which speed a rigid rotor begins to whirl, by each film."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from ..analysis import coefficients, equilibrium, whirl_threshold
from ..analysis.speed_events import secant_speed
from ..bearings.journal import JFOFilm
from ..core.answers import (
    DISAGREEMENT,
    HEATED,
    ISOTHERMAL,
    SAFETY,
    BaseRung,
    CandidateRung,
    ErrorEstimate,
    Found,
    Ladder,
    Work,
    WorkUnit,
    relative_change,
)
from ..core.errors import InputError, RotorfilmError
from ..core.model import Array
from ..core.results import Coefficients, Equilibrium, WhirlThreshold
from ..scenes.film_heat import (
    FIELD_LEVELS,
    FieldLevel,
    HeatError,
    HeatSteps,
    JudgedRest,
    WarmRest,
    assumed_figures,
    ends_within,
    grid_error,
    uniform_rest,
)
from ..scenes.film_rungs import FilmCandidate, corrected, counted_calls, point_films
from ..scenes.solve_journal import conserved_threshold
from .journal_heat import BALANCE, BALANCED, BALANCES, FRESH, HeatLevel, balance_at, known_films, with_heat
from .journal_rupture import Change, ConservedRung, RuptureChange, conserved_films, with_rupture, within_of
from .journal_statics import film_units
from .walk import NoAnswerError

if TYPE_CHECKING:
    from ..scenes.scene import Scene
    from ..scenes.schema import RigidRotorTable

AROUND = 1.4
"""A higher rung looks for the threshold within this factor of a lower one's."""

STEP = 1e-4
"""Relative change of speed over which the growth rate is differentiated."""


@dataclass(frozen=True, kw_only=True)
class WhirlRung(CandidateRung[FilmCandidate]):
    """The whirl threshold by one film.

    Attributes
    ----------
    load : (float, float) [N]
    mass : float [kg]
    """

    load: tuple[float, float]
    mass: float

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        return 0.3 * self.film.prior

    def answer(self, before: Found | None) -> Found:
        """Return the speed at which the equilibrium loses stability [rad/s]."""
        made = self.film.prepare()
        counted = counted_calls(self.film.reaction)
        close = self.film.bounded or self.film.on_grid(self.film.reaction)
        threshold = threshold_around(counted, self, before, NoAnswerError if close else RotorfilmError)
        return Found(threshold.speed, {self.film.tangents: counted.tangents, **made}, threshold.equilibrium)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change of speed that undoes the growth which the richer film's K and C would bring.

        The whirl s = i nu of the cheap film becomes s' with the richer one's coefficients; the speed changes
        by -Re s' / (d Re s/d speed), the slope being that of the cheap film along its own equilibria.
        """
        at: Equilibrium = found.solution
        bound = self._bound(at)
        if SAFETY * bound < tolerance:
            return ErrorEstimate(bound, "verified bound of the map", {self.film.tangents: 15}, bound=True)
        moved = corrected(self.film_at(at), at, np.array(self.load), smooth=True)
        cheap = coefficients(self.film.reaction, at.position, at.speed)
        own = self._matrix(cheap.stiffness, cheap.damping)
        other = self._matrix(-moved.slopes[:, :2], -moved.slopes[:, 2:])
        first_order, exact = growths(own, other)
        slope = self.slope(at.speed)
        error = abs(exact / slope) / at.speed
        doubt = moved.doubt
        if abs(first_order - exact) > DISAGREEMENT * abs(exact):
            doubt = doubt or "the perturbed eigenvalue disagrees with the exact one: not linear"
        work = {self.film.defects(smooth=True): 1, self.film.tangents: 15}
        method = f"defect of {self.film.rich_name}, eigenvalue perturbation"
        return ErrorEstimate(error, method, work, bound=self.film.bounded, doubt=doubt)

    def film_at(self, at: Equilibrium) -> FilmCandidate:
        """Return the film at one equilibrium."""
        return self.film

    def growth(self, found: Coefficients) -> float:
        """Return the growth rate of the least stable whirl on these coefficients [1/s]."""
        return float(least_stable(self._matrix(found.stiffness, found.damping))[0].real)

    def _bound(self, at: Equilibrium) -> float:
        """Return the error [1] that the worst K and C within the verified bound would make."""
        bound = self.film_at(at).rest_bound(at, slopes=True)
        if not math.isfinite(bound):
            return math.inf
        found = coefficients(self.film.reaction, at.position, at.speed)
        own = self._matrix(found.stiffness, found.damping)
        worst = np.zeros((4, 4))
        worst[2:, :2] = bound * np.abs(found.stiffness).max() / self.mass
        worst[2:, 2:] = bound * np.abs(found.damping).max() / self.mass
        _, left, right = least_stable(own)
        return float(np.abs(left) @ worst @ np.abs(right)) / abs(self.slope(at.speed)) / at.speed

    def _matrix(self, stiffness: Array, damping: Array) -> Array:
        zero, one = np.zeros((2, 2)), np.eye(2)
        return np.block([[zero, one], [-stiffness / self.mass, -damping / self.mass]])

    def slope(self, speed: float) -> float:
        """Return d Re s/d speed of the whirl of this film, by central differences."""
        growth = []
        for near in (speed * (1.0 - STEP), speed * (1.0 + STEP)):
            at = equilibrium(self.film.reaction, self.load, near)
            found = coefficients(self.film.reaction, at.position, near)
            values = np.linalg.eigvals(self._matrix(found.stiffness, found.damping))
            growth.append(float(np.max(values.real)))
        return (growth[1] - growth[0]) / (2.0 * STEP * speed)

    def expected(self, done: Work) -> Work:
        """Return as many tangents as a lower rung took."""
        return self.film.expected(sum(done.values()))


class _Whirling(Protocol):
    @property
    def name(self) -> str: ...
    @property
    def load(self) -> tuple[float, float]: ...
    @property
    def mass(self) -> float: ...


def threshold_around(
    bearing: Any, rung: _Whirling, before: Found | None, absent: type[RotorfilmError] = RotorfilmError
) -> WhirlThreshold:
    """Return the threshold of a rung, looked for around that of a lower one first; an error without one."""
    around = None if before is None else (before.value / AROUND, before.value * AROUND)
    threshold = whirl_threshold(bearing, rung.load, rung.mass, around)
    if threshold.speed is None and around is not None:
        threshold = whirl_threshold(bearing, rung.load, rung.mass)
    if threshold.speed is None:
        raise absent(f"no threshold: {threshold.reason}, by {rung.name}")
    return threshold


def least_stable(matrix: Array) -> tuple[complex, Array, Array]:
    """Return the eigenvalue with the largest real part, its left and its right vector, left right = 1."""
    values, right = np.linalg.eig(matrix)
    k = int(np.argmax(values.real + 1e-12 * np.abs(values.imag)))
    return complex(values[k]), np.linalg.inv(right)[k], right[:, k]


def growths(own: Array, other: Array) -> tuple[float, float]:
    """Return the growth rate [1/s] that the least stable mode of `own` has in `other`: first order, exact.

    With the right and left eigenvectors r, l of a mode the first order of its change is l (other - own) r.
    """
    value, left, right = least_stable(own)
    shifted = value + left @ (other - own) @ right
    exact = np.linalg.eigvals(other)
    return float(shifted.real), float(exact[np.argmin(np.abs(exact - shifted))].real)


def required_rotor(scene: Scene, quantity: str) -> RigidRotorTable:
    """Return the table of the rigid rotor; raise InputError if the scene has none."""
    if scene.rigid_rotor is None:
        raise InputError(f"rigid_rotor is required for {quantity}, got no such table")
    return scene.rigid_rotor


def whirl_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of the whirl threshold.

    Raises
    ------
    InputError
        If the scene has no rigid rotor.
    """
    required_rotor(scene, quantity)
    return cold_whirl_ladder(scene, point_films(scene.journal_bearing, fixed=scene.film_is_given))


def cold_whirl_ladder(scene: Scene, films: Sequence[FilmCandidate]) -> Ladder:
    """Return the ladder of the whirl threshold of a scene with a rigid rotor by films of one viscosity."""
    mass = required_rotor(scene, "whirl_threshold").mass
    return Ladder(
        rungs=tuple(WhirlRung(film=film, load=scene.static_load, mass=mass) for film in films),
        unit="rad/s",
        units=film_units(films, math.sqrt(math.hypot(*scene.static_load) / (mass * scene.bearing.clearance))),
        remarks=scene.film_remarks,
        within=ISOTHERMAL,
    )


# At which speed a rigid rotor begins to whirl on an oil: the film as warm as its rest at each speed.
#
# By one temperature (T0, T1) on every film, or by a temperature field (T2, T3), K and C at frozen
# temperature.


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


# Whirl thresholds and motions on a film that conserves its oil, by K and C at the frequency of the whirl.


def with_conserved_whirl(scene: Scene, quantity: str, ruptured: Callable[[], Ladder]) -> Ladder:
    """Return the ladder of the whirl threshold, with what conserves its oil.

    Parameters
    ----------
    scene : Scene
    quantity : str
    ruptured : callable
        Returns the ladder by Reynolds rupture.
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
            ConservedRung(film=film, value=value, distance=relative_change) for film in conserved_films(scene)
        )

    def change(found: Found) -> Change:
        reynolds, conserved = RuptureChange(bearing, load, found.value).films[-1]
        around = found.value / AROUND, found.value * AROUND
        own = whirl_threshold(reynolds, load, mass, around).speed or found.value
        return Change(own, conserved_threshold(conserved, load, mass, own), relative=True)

    if table.conserves:
        rungs = above()
        return Ladder(rungs=rungs, unit="rad/s", remarks=scene.film_remarks, within=within_of(scene))
    ladder = ruptured()
    # On an oil the error by heat of a threshold by conserved oil is not known yet.
    return with_rupture(scene, ladder, change, relative_change, None if bearing.is_warming else above)


def with_moved_rupture(
    scene: Scene,
    ladder: Ladder,
    linear: Callable[[Any], float],
    distance: Callable[[float, float], float],
    *,
    scaled: bool,
) -> Ladder:
    """Return the ladder of a motion with what the conservation of oil changes in the linear one.

    Parameters
    ----------
    scene : Scene
    ladder : Ladder
    linear : callable
        Takes a film as a candidate, and returns the quantity in linear motion about its rest.
    distance : callable
        As of `RupturedRung`.
    scaled : bool
        Whether the share counts, rather than the difference.
    """
    rupture = RuptureChange(scene.journal_bearing, scene.static_load, scene.speed)

    def change(found: Found) -> Change:
        return rupture.change(lambda rest: linear(rest.frozen), relative=scaled)

    return with_rupture(scene, ladder, change, distance)
