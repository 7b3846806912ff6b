"""A journal at rest on a film that warms: by one temperature, or by a field.

T0 is the viscosity of fresh oil, T1 one temperature in balance, T2 a temperature over the film, T3 one over
and across it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike

from ..analysis import equilibrium, heated_equilibrium
from ..analysis.coefficients import film_coefficients
from ..bearings import journal
from ..bearings.oil import Cooling, Oil
from ..bearings.oil.oil import RING
from ..bearings.pads import PadBearing, TiltingPadBearing
from ..core.errors import RotorfilmError
from ..core.port import Reaction
from ..core.results import Coefficients, Equilibrium
from ..core.units import CELSIUS
from .film_rungs import JournalEquilibrium, maximum_pressure

STEEL_CONDUCTIVITY = 50.0
"""Of the bush that a scene leaves open [W/(m K)]."""


@dataclass(frozen=True, kw_only=True)
class WarmRest(JournalEquilibrium):
    """A journal at rest on a film that warms, by one of the rungs.

    Attributes
    ----------
    rest : Equilibrium
    reaction : Reaction
        The film, frozen at its temperature.
    power_loss : float [W]
    side_flow : float [m^3/s]
    temperature : float [K]
        Temperature of the oil that leaves at the ends, in the mean.
    maximum_temperature : float [K]
    supply_temperature : float [K]
    field : ndarray or None [K]
        Temperature of the oil, cell by cell; None of one temperature.
    pressure : callable or None
        Returns the largest pressure in a film with a field [Pa].
    """

    rest: Equilibrium
    reaction: Reaction
    power_loss: float
    side_flow: float
    temperature: float
    maximum_temperature: float
    supply_temperature: float
    field: ArrayLike | None = None
    pressure: Callable[[], float] | None = None

    @property
    def at(self) -> Equilibrium:  # type: ignore[override]
        """The rest."""
        return self.rest

    @property
    def maximum_pressure(self) -> float:
        """Largest pressure in the film [Pa]."""
        if self.pressure is not None:
            return self.pressure()
        return maximum_pressure(self.reaction, self.rest.position, self.rest.speed)

    @property
    def losses(self) -> WarmRest:
        """Power loss and flow of oil."""
        return self

    @property
    def coefficients(self) -> Coefficients:
        """K and C at frozen temperature."""
        return film_coefficients(self.reaction, self.rest.position, self.rest.speed)


def bush_of(bearing: Any) -> journal.Walls:
    """Return the bush that a temperature field is in: of steel, to `RING` times the radius.

    It carries as much heat to the ambient as the housing conductance of the bearing's cooling; where that is
    0 it conducts around the film only. One that would hold that heat up is thinner. The shaft is as warm as
    makes its net heat zero. Tilting pads take no heat.
    """
    if isinstance(bearing, TiltingPadBearing):
        return journal.AdiabaticWalls()
    _, cooling = bearing.cooled
    R, outer = bearing.radius, RING * bearing.radius
    wanted = cooling.housing_conductance / (2.0 * math.pi * R * bearing.length)
    if wanted > 0.0:
        outer = min(outer, R * math.exp(0.5 * STEEL_CONDUCTIVITY / (R * wanted)))
    resistance = R * math.log(outer / R) / STEEL_CONDUCTIVITY
    return journal.BushRing(
        outer_radius=outer,
        conductivity=STEEL_CONDUCTIVITY,
        transfer=wanted / (1.0 - resistance * wanted) * R / outer,
        ambient_temperature=cooling.ambient,
    )


def uniform_rest(
    bearing: journal.JournalBearing | journal.JFOFilm,
    load: ArrayLike,
    speed: float,
    temperature: float | None = None,
) -> WarmRest:
    """Return the rest on a film of one temperature [K], that of its balance if none is given (T1)."""
    _, cooling = bearing.cooled
    warm: Any = bearing if temperature is None else bearing.at_temperature(temperature)
    at = equilibrium(warm, load, speed)
    film = at.temperature if temperature is None else temperature
    assert film is not None  # of a film that warms
    losses, frozen = at.losses, bearing.at_temperature(film)
    if losses is None:  # a JFOFilm at a stated temperature
        losses = frozen.losses(at.position, np.zeros(2), speed)
    assert losses is not None  # a balance has them
    return WarmRest(
        rest=at,
        reaction=cast(Reaction, frozen),
        power_loss=float(losses.power_loss),
        side_flow=float(losses.side_flow),
        temperature=film,
        maximum_temperature=film,
        supply_temperature=cooling.supply_temperature,
    )


def warm_field(
    bearing: journal.JournalBearing | journal.JFOFilm, cells: tuple[int, int], profile: journal.FilmProfile
) -> journal.HeatedFilm | journal.HeatedJFOFilm:
    """Return a film with a temperature field; one that conserves its oil where openings end within it."""
    if ends_within(bearing):
        bearing = journal.JFOFilm(bearing=bearing)
    if isinstance(bearing, journal.JFOFilm):
        film = replace(bearing, cells=cells)
        return journal.HeatedJFOFilm(film=film, walls=bush_of(film.bearing), profile=profile)
    around, along = cells
    if isinstance(bearing, PadBearing):
        around *= (len(bearing.arcs) + 1) // 2  # as many on each pad as on one of two
    return journal.HeatedFilm(bearing=bearing, walls=bush_of(bearing), cells=(around, along), profile=profile)


def ends_within(bearing: journal.JournalBearing | journal.JFOFilm) -> bool:
    """Return whether a bearing has openings that end within it, beside which only conserved oil is known."""
    if isinstance(bearing, journal.JFOFilm):
        return False
    return bool(bearing.geometry.pockets) or bearing.geometry.circumferential


def field_rest(film: journal.HeatedFilm | journal.HeatedJFOFilm, load: ArrayLike, speed: float) -> WarmRest:
    """Return the rest on a film with a temperature field (T2, T3)."""
    whole: Any = film  # a force at rest, of a film that conserves its oil, is what these take
    found = heated_equilibrium(whole, load, speed)
    return rest_of_state(whole.bearing, found.rest, found.state.film, found.state)


def rest_of_state(
    bearing: journal.JournalBearing | journal.JFOFilm,
    at: Equilibrium,
    film: Reaction,
    state: journal.HeatedState,
) -> WarmRest:
    """Return a rest on a film whose temperature is that of a state."""
    (oil, cooling), flow = bearing.cooled, state.side_flow
    supply = cooling.supply_temperature
    carried = state.heat.leaked / (float(oil.volumetric_heat(supply)) * flow) if flow > 0.0 else math.nan
    return WarmRest(
        rest=at,
        reaction=film,
        power_loss=state.power_loss,
        side_flow=flow,
        temperature=supply + carried,
        maximum_temperature=state.maximum_temperature,
        supply_temperature=supply,
        field=state.oil_temperature,
        pressure=lambda: float(np.max(state.pressure)),
    )


# How far a rest on a warm film is off, by a few steps towards the temperature across its film (T3).
#
# A step is one solution of the heat of T3 on a film, less where its oil gets warmer (its thinning),
# and the rest that the viscosity which follows has. Three of them are as for the defect of a richer
# film (`film_defects`): the first sees the step, the others what is of second and third order in it.
# They are taken on the cells of a film of T3 and on cells twice as long: heat moves upwind there and
# pressure is of second order, so that cells without end would change about half as much again as
# these do.


PROFILE, CELLS = journal.LayeredTemperature(8), (80, 8)
"""Layers and cells of a step; the cells are those of the rungs with a temperature field."""


def richest_profile(bearing: Any) -> journal.FilmProfile:
    """Return the profile across the film towards which steps lead.

    The oil beside a wall that takes no heat gets too hot: for tilting pads it is the mean.
    """
    return journal.MeanTemperature() if isinstance(bearing, TiltingPadBearing) else PROFILE


HALF = (CELLS[0] // 2, CELLS[1] // 2)
"""Cells twice as long."""

STEPS = 3
"""Steps on the cells, and on those twice as long."""

ONWARD = 0.5
"""Change by cells without end over that since cells twice as long, of an order between 1 and 2."""

SETTLED, SMALL = 0.3, 0.05
"""Last move over the first beyond which steps lead nowhere, and the least first move that is taken."""


class HeatError(NamedTuple):
    """Error of a quantity by the heat that a rung leaves out.

    Attributes
    ----------
    error : float
        Error in the unit of the tolerance.
    bound : bool
        Whether it is at most about that: what the steps change is less than they are unsure of.
    """

    error: float
    bound: bool


@dataclass(frozen=True, eq=False)
class HeatSteps:
    """Where steps towards T3 lead from a rest; found once.

    Attributes
    ----------
    bearing : JournalBearing or JFOFilm
        Bearing on its oil.
    own : WarmRest
        By T1 or T2.
    """

    bearing: journal.JournalBearing | journal.JFOFilm
    own: WarmRest

    @property
    def name(self) -> str:
        """Where they lead."""
        return f"steps towards {'T3' if richest_profile(self.bearing).layers > 1 else 'T2'}"

    @cached_property
    def taken(self) -> tuple[WarmRest, ...]:
        """The rests after each step."""
        return self._steps(CELLS)

    @cached_property
    def coarse(self) -> WarmRest:
        """The last one on cells twice as long."""
        return self._steps(HALF)[-1]

    @property
    def sample(self) -> tuple[WarmRest, WarmRest, WarmRest, WarmRest, WarmRest]:
        """The last rest, that before it, the last one on cells twice as long, and the start on both cells."""
        fine, coarse = self._start_on(CELLS), self._start_on(HALF)
        return self.taken[-1], self.taken[-2], self.coarse, fine, coarse

    @property
    def doubt(self) -> str:
        """Why they must not be trusted; empty if they settle."""
        places = np.array([one.rest.position for one in (self.own, *self.taken)])
        moves = np.hypot(*np.diff(places, axis=0).T)
        first = max(float(moves[0]), SMALL * self.bearing.clearance)
        if moves[-1] <= SETTLED * first:
            return ""
        return f"step {STEPS} moves the journal by {moves[-1] / first:.0%} of the first"

    def _steps(self, cells: tuple[int, int]) -> tuple[WarmRest, ...]:
        own, bearing = self.own, self.bearing
        film: Any = self._film(cells)  # its own films have a force at rest, which is what is asked
        state = film.warmed_from(own.rest.position, own.rest.speed, self._start(cells))
        found: list[WarmRest] = []
        at = own.rest
        for _ in range(STEPS):
            if found:
                state = film.warmed(at.position, at.speed, state)
            here, after = at, film.following(state)
            at = equilibrium(after, own.rest.load, own.rest.speed)
            found.append(self._moved(rest_of_state(bearing, at, after, state), here))
        return tuple(found)

    def _film(self, cells: tuple[int, int]) -> journal.HeatedFilm | journal.HeatedJFOFilm:
        return warm_field(self.bearing, cells, richest_profile(self.bearing))

    def _start_on(self, cells: tuple[int, int]) -> WarmRest:
        """Return the start by one temperature on these cells, whose own error is none of the heat.

        A field is on the cells of the steps, whose error is its own; and films by Reynolds rupture that
        openings feed start only where there is oil, which is not the film of one temperature.
        """
        own, film = self.own, self._film(cells)
        fed = isinstance(film, journal.HeatedFilm) and film.bearing.geometry.openings()
        if own.field is not None or fed:
            return own
        state = film.warmed_from(own.rest.position, own.rest.speed, own.temperature, closing=True)
        at = equilibrium(state.film, own.rest.load, own.rest.speed)
        moved = self._moved(rest_of_state(self.bearing, at, state.film, state), own.rest)
        return replace(moved, temperature=own.temperature, maximum_temperature=own.maximum_temperature)

    def _start(self, cells: tuple[int, int]) -> Any:
        """Return the temperature of the rest, the mean of a field on other cells."""
        if self.own.field is None or cells != CELLS:
            return self.own.temperature
        return np.asarray(self.own.field)[..., None]

    def _moved(self, found: WarmRest, here: Equilibrium) -> WarmRest:
        """Return a step with what is known before its move, changed as T1's by the move."""
        own = self.bearing.at_temperature(self.own.temperature)
        before, after = (own.losses(q, np.zeros(2), here.speed) for q in (here.position, found.rest.position))
        assert before is not None  # a balance has them
        assert after is not None

        def pressure() -> float:
            before, after = (maximum_pressure(own, one.position, here.speed) for one in (here, found.rest))
            return found.maximum_pressure * after / before

        return replace(
            found,
            pressure=pressure,
            power_loss=found.power_loss * float(after.power_loss) / float(before.power_loss),
            side_flow=found.side_flow * float(after.side_flow) / float(before.side_flow),
        )


def heat_error(
    own: Any, start: Any, sample: tuple[Any, Any, Any, Any, Any], distance: Callable[[Any, Any], float]
) -> HeatError:
    """Return the error of a value, by those of steps.

    Parameters
    ----------
    own, start : float or ndarray
        The value, and that where the steps start, which is another one only of T0.
    sample : tuple of five
        Sample of `HeatSteps.sample`.
    distance : callable
        Takes a value and a better one, and returns its error.
    """
    last, before, coarse, fine, long = (np.asarray(one) for one in sample)
    last, before, coarse = last - fine + start, before - fine + start, coarse - long + start
    error = distance(own, last + ONWARD * (last - coarse))
    unsure = ONWARD * distance(coarse, last) + distance(before, last)
    return HeatError(error, False) if error >= unsure else HeatError(error + unsure, True)


@dataclass(frozen=True, kw_only=True, eq=False)
class RestJudge:
    """What judges rests under one load at one speed: by the distance of the values that they have.

    Attributes
    ----------
    load : (float, float) [N]
    speed : float [rad/s]
    value : callable
        Takes a rest and returns the quantity.
    distance : callable
        Takes a value and a better one, and returns its error in the unit of the tolerance.
    moving : callable
        Takes the bearing and returns the error by heat that moves with the journal; 0 of one at rest.
    """

    load: tuple[float, float]
    speed: float
    value: Callable[[Any], Any]
    distance: Callable[[Any, Any], float]
    moving: Callable[[Any], float] = lambda bearing: 0.0

    def apart(self, own: Any, other: Any) -> float:
        """Return how far the quantity of one rest is from that of a better one."""
        return self.distance(self.value(own), self.value(other))

    def error(self, own: Any, steps: HeatSteps) -> HeatError:
        """Return the error by heat of a quantity of an equilibrium."""
        start, last, before, *bases = (self.value(one) for one in (steps.own, *steps.sample))
        coarse, fine, long = bases
        return heat_error(self.value(own), start, (last, before, coarse, fine, long), self.distance)


# The levels of heat with a temperature field, on their cells: T2 over the film, T3 over and across it.


Rest = TypeVar("Rest")


@dataclass(frozen=True, kw_only=True)
class FieldLevel:
    """A film with a temperature field, of any bearing.

    Attributes
    ----------
    level : str
        T2 or T3.
    cells : (int, int)
        Around and along half of the film.
    layers : int
        Across the film; 0 for one mean.
    seconds : float [s]
        About what a rest takes.
    """

    level: str
    cells: tuple[int, int]
    layers: int = 0
    seconds: float = field(compare=False)

    @property
    def grid(self) -> str:
        """Cells and layers."""
        return " x ".join(str(count) for count in (*self.cells, self.layers) if count)

    @property
    def name(self) -> str:
        """Level and grid."""
        return f"{self.level}, {self.grid}"

    @property
    def coarser(self) -> FieldLevel:
        """That of cells twice as long."""
        around, along = self.cells
        return replace(self, cells=(around // 2, along // 2), seconds=0.25 * self.seconds)

    @property
    def thicker(self) -> FieldLevel:
        """That of half the layers."""
        return replace(self, layers=self.layers // 2, seconds=0.5 * self.seconds)

    @property
    def mean(self) -> FieldLevel:
        """That of one mean across the film, on these cells."""
        return replace(self, level="T2", layers=0, seconds=0.25 * self.seconds)

    def rest(
        self, bearing: journal.JournalBearing | journal.JFOFilm, load: ArrayLike, speed: float
    ) -> WarmRest:
        """Return where a journal rests on this film of a bearing on an oil."""
        profile = journal.LayeredTemperature(self.layers) if self.layers else journal.MeanTemperature()
        return field_rest(warm_field(bearing, self.cells, profile), load, speed)


MEAN = FieldLevel(level="T2", cells=(80, 8), seconds=0.5)
REFERENCE = FieldLevel(level="T3", cells=(80, 8), layers=12, seconds=2.0)
FIELD_LEVELS = MEAN, REFERENCE, FieldLevel(level="T3", cells=(160, 16), layers=12, seconds=15.0)
"""Those that answer questions, the cheapest first."""


def grid_error(
    level: FieldLevel, own: Rest, rest: Callable[[FieldLevel], Rest], apart: Callable[[Rest, Rest], float]
) -> float:
    """Return about the largest error of a quantity by T3, from its cells and layers.

    That is the change since cells twice as long and since half the layers. Heat moves upwind, of first order
    in the cells, but the edge of the ruptured zone moves by whole ones, so that a change may be small by
    chance: that of T2 on the same cells is added.

    Parameters
    ----------
    level : FieldLevel
        T3.
    own : object
        What `rest` returns of the level.
    rest : callable
        Takes a level and returns what it answers.
    apart : callable
        Takes an answer and a better one, and returns its error.
    """
    coarse = rest(level.coarser)
    pairs = (
        (coarse, own),
        (rest(level.coarser.mean), rest(level.mean)),
        (rest(level.coarser.thicker), coarse),
    )
    return sum(apart(*pair) for pair in pairs)


# Figures of an oil and its cooling that a scene leaves to assumptions, and how much they move an answer.


SPREAD = 0.05
"""Relative uncertainty of an assumed viscosity at 100 degrees Celsius."""

CARRIED = (0.7, 0.9)
"""Shares of the oil arriving at an opening that go on, as they are found in use."""

WARM, HOT = 40.0 + CELSIUS, 100.0 + CELSIUS

HOUSING = "a steel one of twice the radius, cooled by 80 W/(m2 K)"


def assumed_figures(bearing: Any, moved: Callable[[Any], float], *, fields: bool) -> tuple[str, ...]:
    """Return which figures of a bearing on an oil are assumed, and how much each moves the answer.

    Parameters
    ----------
    bearing : JournalBearing, or one made of pads
    moved : callable
        How far the answer of another bearing is off, by T1, in the unit of the tolerance.
    fields : bool
        Whether a temperature field may answer, which assumes a bush.
    """
    lines = []
    for text, others in _varied(bearing):
        try:
            change = f"{max(moved(other) for other in others):.1%}"
        except RotorfilmError:
            change = "a change that is not known"
        lines.append(f"{text}: moves the answer by {change}")
    if fields and isinstance(bearing, TiltingPadBearing):
        lines.append("pads of T2: take no heat, which makes the oil too hot by some kelvins")
    elif fields:
        lines.append(
            f"bush of T2 and T3: steel to {RING:g} times the radius, that gives off what housing_conductance "
            "says; the shaft takes no heat in the mean"
        )
    return tuple(lines)


def _varied(bearing: Any) -> Iterator[tuple[str, list[Any]]]:
    """Yield each assumption, and the bearings that it might be as well."""
    oil, cooling = bearing.cooled
    default = Cooling(supply_temperature=cooling.supply_temperature)

    for text in oil.assumed:
        yield text, [replace(bearing, oil=thinner_when_hot(oil))]
    open_around = not isinstance(bearing, journal.JournalBearing) or bearing.geometry.openings()
    if open_around and cooling.carry_over == default.carry_over:
        low, high = CARRIED
        text = f"carry_over of the grooves: {cooling.carry_over:g}, in use are {low:g} to {high:g}"
        yield text, [replace(bearing, cooling=replace(cooling, carry_over=one)) for one in CARRIED]
    if cooling.housing_conductance == 0.0:
        given = ring_conductance(bearing.radius, bearing.length)
        text = f"housing: takes no heat, {HOUSING}, would take {given:.3g} W/K"
        yield text, [replace(bearing, cooling=replace(cooling, housing_conductance=given))]
    if not cooling.full_gap:
        text = "oil where the film is ruptured: in streamers, not in the full gap"
        yield text, [replace(bearing, cooling=replace(cooling, full_gap=True))]


def thinner_when_hot(oil: Oil) -> Oil:
    """Return an oil as viscous at 40 degrees Celsius, and by `SPREAD` less at 100."""
    warm, hot = (float(oil.viscosity(T) / oil.density(T)) for T in (WARM, HOT))
    other = Oil.two_points((WARM, warm), (HOT, (1.0 - SPREAD) * hot), reference_density=oil.reference_density)
    return replace(oil, law=other.law)


def ring_conductance(radius: float, length: float) -> float:
    """Return the heat flow through `HOUSING` [W/K] of a bearing of these dimensions [m]."""
    ring = journal.BushRing(outer_radius=2.0 * radius, conductivity=50.0, transfer=80.0)
    return 2.0 * math.pi * radius * length * ring.mean_transfer(radius)
