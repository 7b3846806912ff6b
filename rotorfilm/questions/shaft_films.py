"""The bearings of a flexible rotor: which films may stand in its journals, and what is richer."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from ..analysis import RotorEquilibrium, equilibrium, rotor_equilibrium
from ..analysis.rotor_matrices import whirl_near
from ..analysis.speed_events import SpeedEvent, Whirl, on_films, secant_speed, value_rate
from ..bearings.journal import JournalBearing
from ..core.answers import HEATED, SAFETY, BaseRung, ErrorEstimate, Found, Rung, Work, WorkUnit
from ..core.model import Reaction
from ..core.results import Coefficients
from ..rotors.shaft_rotor import ShaftModel
from ..scenes.film_heat import (
    FIELD_LEVELS,
    FieldLevel,
    HeatError,
    HeatSteps,
    WarmRest,
    assumed_figures,
    grid_error,
    heat_error,
    uniform_rest,
)
from ..scenes.film_rungs import FilmRung, corrected, turn_films
from ..scenes.journal_tables import has_map
from ..scenes.solve_shaft import shaft_physics
from .heat_levels import BALANCED, FRESH, HeatLevel, balance_at, known_films, with_heat

if TYPE_CHECKING:
    from ..scenes.schema import JournalTable
    from ..scenes.shaft_table import ShaftTable

REST_BOUNDS = ((0.5, 2e-5), (0.95, 5e-5))
"""Eccentricity ratio up to which, and largest error of K, C of the packaged map at rest."""

GRIDS = ((96, 8),)
"""Cells of films beside the short one, of journals that no map of the package holds."""


@dataclass(frozen=True, kw_only=True)
class ShaftFilms:
    """A film for each journal of a shaft, beside its springs and dampers.

    Attributes
    ----------
    journals : dict of str to FilmRung
        By station.
    springs : dict of str to Reaction
        Bearings without a film, by station.
    """

    journals: Mapping[str, FilmRung]
    springs: Mapping[str, Reaction]

    @property
    def name(self) -> str:
        """Names of the films, each once; empty without journals."""
        return " and ".join(dict.fromkeys(film.name for film in self.journals.values()))

    @property
    def rich_name(self) -> str:
        """Names of the richer films, each once; empty without journals."""
        return " and ".join(dict.fromkeys(film.rich_name for film in self.journals.values()))

    @property
    def bounded(self) -> bool:
        """Whether every film has a verified bound."""
        return all(film.bounded for film in self.journals.values())

    @property
    def reaction(self) -> dict[str, Reaction]:
        """All bearings by station, with these films."""
        return {**self.springs, **self.turning}

    @property
    def turning(self) -> dict[str, Reaction]:
        """The films by station, whose K and C change with the speed."""
        return {name: film.reaction for name, film in self.journals.items()}

    @property
    def rich(self) -> dict[str, Reaction]:
        """All bearings by station, with the richer films."""
        return {**self.springs, **{name: film.rich for name, film in self.journals.items()}}

    @property
    def on_oil(self) -> tuple[str, ...]:
        """Stations whose films are of an oil, with a temperature."""
        return tuple(name for name, film in self.journals.items() if film.reaction.oil is not None)

    def prepare(self) -> dict[WorkUnit, int]:
        """Make the maps that are not there yet, and return the work of that."""
        made: dict[WorkUnit, int] = {}
        for film in self.journals.values():
            for unit, count in film.prepare().items():
                made[unit] = made.get(unit, 0) + count
        return made


def film_levels(shaft: ShaftTable) -> tuple[ShaftFilms, ...]:
    """Return what may stand in the journals of a shaft, the cheapest first; one level if all is settled."""
    springs = {one.name: one.build() for one in shaft.bearings if one.journal is None}
    choices = {one.name: _choices(one.journal) for one in shaft.bearings if one.journal is not None}
    count = max((len(each) for each in choices.values()), default=1)
    return tuple(
        ShaftFilms(
            journals={name: each[min(level, len(each) - 1)] for name, each in choices.items()},
            springs=springs,
        )
        for level in range(count)
    )


def _choices(journal: JournalTable) -> tuple[FilmRung, ...]:
    bearing = journal.bearing()
    films = turn_films(bearing, fixed=journal.film is not None, grids=GRIDS, maps=False)
    return known_films(films) if bearing.is_warming else films


def rich_coefficients(films: ShaftFilms, at: RotorEquilibrium) -> tuple[dict[str, Coefficients], str]:
    """Return K and C of all bearings by the richer films at their own equilibria, and why to doubt them."""
    found, doubt = dict(at.coefficients), ""
    for name, film in films.journals.items():
        load = at.loads[name]
        if name in at.temperatures:
            film = film.at_temperature(at.temperatures[name])
        moved = corrected(film, equilibrium(film.reaction, load, at.speed), load, smooth=True)
        found[name] = Coefficients(
            stiffness=-moved.slopes[:, :2],
            damping=-moved.slopes[:, 2:],
            position=moved.position,
            speed=at.speed,
        )
        doubt = doubt or moved.doubt
    return found, doubt


def coefficient_bounds(films: ShaftFilms, at: RotorEquilibrium) -> dict[str, float]:
    """Return the verified relative error of K and C of each film at rest; infinite where there is none."""
    return {
        name: _rest_bound(film, float(np.hypot(*at.coefficients[name].position)) / film.reaction.clearance)
        for name, film in films.journals.items()
    }


def _rest_bound(film: FilmRung, eccentricity_ratio: float) -> float:
    if not (film.bounded and has_map(film.reaction)):
        return film.bound(eccentricity_ratio, slopes=True)
    return min((bound for reach, bound in REST_BOUNDS if eccentricity_ratio <= reach), default=math.inf)


# Flexible rotors on films of an oil: the films as fresh oil (T0) or as warm as the rotor's rest (T1).


NEAR_HEAT = 0.02
"""Relative change of speed within which rungs of a level have the same error by heat."""


class HeatedShaft(Rung, Protocol):
    """A rung of a rotor that can say what other K and C of its bearings make of its answer."""

    @property
    def films(self) -> ShaftFilms:
        """Its films."""

    def rest(self, found: Found) -> RotorEquilibrium:
        """Return the rotor at rest, of an answer."""

    def on(self, found: Found, coefficients: dict[str, Coefficients]) -> float:
        """Return the answer on these K and C, for small changes."""

    def distance(self, value: float, better: float) -> float:
        """Return how far a value is from a better one, in the unit of the tolerance."""

    def moving(self, found: Found) -> float:
        """Return the error by heat that moves with the motion."""


class HeatFound(NamedTuple):
    """What the heat of the films leaves open.

    Attributes
    ----------
    error : HeatError
    how : str
        By which it is known.
    doubt : str
        Why it must not be trusted; empty if it may.
    """

    error: HeatError
    how: str
    doubt: str


def rests_of(rung: HeatedShaft, at: RotorEquilibrium) -> dict[str, WarmRest]:
    """Return the rest in each film of an oil, at its temperature."""
    found = {}
    for name in rung.films.on_oil:
        bearing: JournalBearing = rung.films.journals[name].reaction
        temperature = at.temperatures.get(name, bearing.temperature)
        found[name] = uniform_rest(bearing, at.loads[name], at.speed, temperature)
    return found


def value_on(rung: HeatedShaft, found: Found, rests: Mapping[str, WarmRest]) -> float:
    """Return the answer on the films of other rests."""
    own = rung.rest(found).coefficients
    return rung.on(found, {**own, **{name: one.coefficients for name, one in rests.items()}})


def steps_error(rung: HeatedShaft, found: Found, own: float, rests: Mapping[str, WarmRest]) -> HeatFound:
    """Return how far a value is off by heat, by steps of each film towards T3."""
    steps = {name: HeatSteps(rung.films.journals[name].reaction, one) for name, one in rests.items()}
    samples = {name: one.sample for name, one in steps.items()}
    start = value_on(rung, found, rests)
    last, before, coarse, fine, long = (
        value_on(rung, found, {name: one[k] for name, one in samples.items()}) for k in range(5)
    )
    doubt = next((one.doubt for one in steps.values() if one.doubt), "")
    return with_moving(
        rung, found, heat_error(own, start, (last, before, coarse, fine, long), rung.distance), doubt
    )


def with_moving(rung: HeatedShaft, found: Found, heat: HeatError, doubt: str) -> HeatFound:
    """Return an error with that of heat that moves with the motion."""
    moving = rung.moving(found)
    how = f"steps towards T3, moving heat {moving:.2g} lower" if moving else "steps towards T3"
    return HeatFound(HeatError(heat.error + moving, heat.bound or moving > heat.error), how, doubt)


@dataclass(frozen=True, eq=False)
class RotorHeat:
    """What the heat of the films leaves open in all rungs of a level.

    Attributes
    ----------
    level : HeatLevel
        T0 or T1.
    known : list of (float, float, HeatFound)
        Tolerance and speed [rad/s] at which it was found, and what.
    """

    level: HeatLevel
    known: list[tuple[float, float, HeatFound]] = field(default_factory=list)

    def error(self, rung: HeatedShaft, found: Found, tolerance: float) -> HeatFound:
        """Return the error of an answer by heat; that of another rung next to it."""
        speed = rung.rest(found).speed
        for asked, at, heat in self.known:
            if asked == tolerance and abs(at - speed) <= NEAR_HEAT * speed:
                return heat
        heat = self._found(rung, found, tolerance)
        self.known.append((tolerance, speed, heat))
        return heat

    def _found(self, rung: HeatedShaft, found: Found, tolerance: float) -> HeatFound:
        rests = rests_of(rung, rung.rest(found))
        own = value_on(rung, found, rests)
        if self.level is FRESH:
            for name, one in rests.items():
                bearing = rung.films.journals[name].reaction
                rests[name] = uniform_rest(bearing, one.rest.load, one.rest.speed, balance_at(bearing, one))
            error = rung.distance(own, value_on(rung, found, rests))
            if SAFETY * error >= tolerance:
                return HeatFound(HeatError(error, False), "its balance", "")
        return steps_error(rung, found, own, rests)


@dataclass(frozen=True, kw_only=True)
class WarmShaftRung(BaseRung):
    """A rung of a rotor on films of fresh oil (T0), or as warm as its rest makes them (T1).

    Attributes
    ----------
    rung : HeatedShaft
        Of the rotor.
    heat : RotorHeat
    """

    rung: HeatedShaft
    heat: RotorHeat

    @property
    def name(self) -> str:
        """The level, and that of the rung."""
        return f"{self.heat.level.name}, {self.rung.name}"

    @property
    def prior(self) -> float:
        """That of the rung."""
        return self.rung.prior

    @property
    def refines(self) -> tuple[object, ...]:
        """What the rung does."""
        return self.rung.refines

    @property
    def shares(self) -> object:
        """The error by heat."""
        return self.heat

    def answer(self, before: Found | None) -> Found:
        """Return the answer of the rung."""
        return self.rung.answer(before)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the rung, and that by heat."""
        about = self.rung.estimate(found, before, tolerance)
        work = f"estimates of {self.name}"
        return with_heat(about, lambda: self.heat.error(self.rung, found, tolerance), work)

    def expected(self, done: Work) -> Work:
        """Return that of the rung."""
        return self.rung.expected(done)


def at_supply(films: ShaftFilms) -> ShaftFilms:
    """Return films of fresh oil."""
    journals = dict(films.journals)
    for name in films.on_oil:
        supply = films.journals[name].reaction.cooled[1].supply_temperature
        journals[name] = films.journals[name].at_temperature(supply)
    return replace(films, journals=journals)


def warm_rungs(fresh: tuple[HeatedShaft, ...], balanced: tuple[HeatedShaft, ...]) -> tuple[Rung, ...]:
    """Return the rungs of T0 and T1."""
    levels = RotorHeat(FRESH), RotorHeat(BALANCED)
    pairs = zip(levels, (fresh, balanced), strict=True)
    return tuple(WarmShaftRung(rung=rung, heat=heat) for heat, rungs in pairs for rung in rungs)


def warm_physics(films: ShaftFilms, bearings: Mapping[str, Reaction]) -> str:
    """Return the physics in which the answers of a shaft are meant."""
    return HEATED if films.on_oil else shaft_physics(bearings)


def shaft_assumptions(rung: HeatedShaft) -> tuple[str, ...]:
    """Return which figures of the oil and its cooling are assumed, and how much they move the answer.

    Each is changed in all films that assume it alike, at the loads and the speed of the answer on T1.
    """
    on_oil = rung.films.on_oil
    if not on_oil:
        return ()
    found = rung.answer(None)
    at = rung.rest(found)
    own = value_on(rung, found, rests_of(rung, at))

    def moved(other: JournalBearing, like: JournalBearing) -> float:
        rests = {}
        for name in on_oil:
            bearing: JournalBearing = rung.films.journals[name].reaction
            same = bearing.oil == like.oil and bearing.cooling == like.cooling
            changed = replace(bearing, oil=other.oil, cooling=other.cooling, temperature=None)
            one = changed if same else replace(bearing, temperature=None)
            rests[name] = uniform_rest(one, at.loads[name], at.speed)
        return rung.distance(own, value_on(rung, found, rests))

    lines: dict[str, None] = {}
    for name in on_oil:
        bearing: JournalBearing = rung.films.journals[name].reaction
        lines |= dict.fromkeys(assumed_figures(bearing, partial(moved, like=bearing), fields=True))
    return tuple(lines)


def frozen_at(films: ShaftFilms, at: RotorEquilibrium) -> ShaftFilms:
    """Return films that keep the temperatures of a rest."""
    journals = {
        name: film.at_temperature(at.temperatures[name]) if name in at.temperatures else film
        for name, film in films.journals.items()
    }
    return replace(films, journals=journals)


# Flexible rotors on films with a temperature field (T2, T3), frozen as at the rotor's rest.


NONLINEAR = 3
"""Nonlinear rungs of an orbit."""

ROUNDOFF = 1e-9
"""Of loads, relative to them."""

RESTS, NEAR, FARTHEST = 12, 3e-5, 0.1
"""Most speeds that a search takes, the relative change at which it ends, and the largest one of a step."""


def field_rests(films: ShaftFilms, at: RotorEquilibrium, level: FieldLevel) -> dict[str, WarmRest]:
    """Return the rest in each film of an oil with a temperature field, under the loads of a rest by T1.

    In two bearings those follow from statics. Equal bearings under loads that are equal to roundoff, as of a
    symmetric rotor, have one rest.
    """
    rests: dict[str, WarmRest] = {}
    for name in films.on_oil:
        bearing, load = films.journals[name].reaction, at.loads[name]
        equal = (
            rest
            for other, rest in rests.items()
            if films.journals[other].reaction == bearing
            and np.allclose(at.loads[other], load, rtol=0.0, atol=ROUNDOFF * np.hypot(*load))
        )
        rests[name] = next(equal, None) or level.rest(bearing, load, at.speed)
    return rests


def field_error(rung: HeatedShaft, found: Found, rests: dict[str, WarmRest], level: FieldLevel) -> HeatFound:
    """Return the error by heat of an answer on temperature fields.

    Of T2 by steps towards T3, of T3 by coarser grids.
    """
    own = value_on(rung, found, rests)
    if not level.layers:
        return steps_error(rung, found, own, rests)
    at = rung.rest(found)

    def value(one: FieldLevel) -> float:
        return value_on(rung, found, field_rests(rung.films, at, one))

    grid = grid_error(level, own, value, rung.distance)
    heat = with_moving(rung, found, HeatError(grid, True), "")
    return heat._replace(how=heat.how.replace("steps towards T3", "cells twice as long, half the layers"))


def with_fields(about: ErrorEstimate, heat: HeatFound, name: str) -> ErrorEstimate:
    """Return the error of a rotor's model with that of the heat in its films."""
    bound = heat.error.bound if heat.error.error > about.error else about.bound
    method = f"{about.method}; heat: {heat.how}, {heat.error.error:.2g}"
    work = {WorkUnit(f"estimates of {name}"): 1}
    total = about.error + heat.error.error
    return ErrorEstimate(total, method, work, bound=bound, doubt=about.doubt or heat.doubt)


class SpeedRung(HeatedShaft, Protocol):
    """A rung of a critical speed, or of the threshold, on films of one temperature."""

    @property
    def model(self) -> ShaftModel:
        """Its model of the shaft."""

    @property
    def event(self) -> SpeedEvent:
        """What happens at the speed."""

    def solution(self, whirl: Whirl) -> Any:
        """Return one whirl as what an answer starts from."""

    def mesh_error(self, found: Found) -> ErrorEstimate:
        """Return the error of the model of the shaft on the same K and C."""


class FieldSpeed(NamedTuple):
    """A speed on temperature fields: as an answer of the rung of T1, and the rests in the films."""

    found: Found
    rests: dict[str, WarmRest]


@dataclass(frozen=True, kw_only=True)
class FieldSpeedRung(BaseRung):
    """A critical speed, or the threshold, on films with a temperature field.

    Attributes
    ----------
    level : FieldLevel
        T2 or T3.
    uniform : SpeedRung
        By T1, where the search starts.
    """

    level: FieldLevel
    uniform: SpeedRung

    @property
    def name(self) -> str:
        """Level, model of the shaft, cells and layers."""
        return f"{self.level.level}, {self.uniform.model.name}, {self.level.grid}"

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        seconds = 4.0 * len(self.uniform.films.on_oil) * self.level.seconds
        return WorkUnit(f"speeds of {self.name}", ("speeds", self.name), nominal=seconds)

    def answer(self, before: Found | None) -> Found:
        """Return the speed [rad/s], by secants from that of T1."""
        rung = self.uniform
        start = before.solution if before is not None else None
        lower = before if before is not None and not isinstance(start, FieldSpeed) else None
        whirl = rung.answer(lower).solution.whirls[0]
        structure, event = rung.model.rotor.structure, rung.event

        def lead_at(speed: float) -> tuple[float, FieldSpeed]:
            nonlocal whirl
            at = rotor_equilibrium(rung.model.rotor, rung.films.reaction, speed)
            rests = field_rests(rung.films, at, self.level)
            warm = on_films(at, {**at.coefficients, **{n: one.coefficients for n, one in rests.items()}})
            frequency = event.frequency(whirl.value, speed)
            whirl = Whirl(warm, *whirl_near(structure, warm, frequency, whirl.value, whirl.right))
            found = Found(speed, {}, rung.solution(whirl))
            return event.lead(whirl.value, speed), FieldSpeed(found, rests)

        rate = event.rate(value_rate(structure, whirl, rung.films.turning))
        near = secant_speed(lead_at, whirl.at.speed, rate, near=NEAR, farthest=FARTHEST, most=RESTS)
        return Found(near.speed, {self.unit: 1}, near.solution)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the model of the shaft, and that of the films."""
        solved: FieldSpeed = found.solution
        heat = field_error(self.uniform, solved.found, solved.rests, self.level)
        return with_fields(self.uniform.mesh_error(solved.found), heat, self.name)


@dataclass(frozen=True, eq=False)
class FrozenShaftFilms:
    """Films with a temperature field that they keep in motion; found once.

    Attributes
    ----------
    level : FieldLevel
    films : ShaftFilms
        Those of T1.
    at : RotorEquilibrium
        By them.
    """

    level: FieldLevel
    films: ShaftFilms
    at: RotorEquilibrium

    @cached_property
    def rests(self) -> dict[str, WarmRest]:
        """The rest in each film of an oil."""
        return field_rests(self.films, self.at, self.level)

    @cached_property
    def frozen(self) -> ShaftFilms:
        """The films at rest; there are no richer ones."""
        journals = dict(self.films.journals)
        for name, own in self.rests.items():
            film = journals[name].frozen(own.reaction)
            journals[name] = replace(film, rich=film.reaction, rich_name="itself")
        return replace(self.films, journals=journals)


class FieldOrbit(NamedTuple):
    """An orbit on temperature fields: the answer of the rung on its frozen films, and that rung."""

    found: Found
    rung: HeatedShaft


@dataclass(frozen=True, kw_only=True)
class FieldOrbitRung(BaseRung):
    """An orbit on films with a temperature field.

    Attributes
    ----------
    films : FrozenShaftFilms
    uniform : HeatedShaft
        The linear one by T1, which tells what the films change.
    make : callable
        Takes films and returns the rung of the orbit on them.
    """

    films: FrozenShaftFilms
    uniform: HeatedShaft
    make: Callable[..., HeatedShaft]

    @property
    def name(self) -> str:
        """Level, rung of the orbit on the films, cells and layers."""
        rung = self.make(replace(self.films.films, journals={}))
        return f"{self.films.level.level}, {rung.name}, {self.films.level.grid}"

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        seconds = 2.0 * len(self.films.films.on_oil) * self.films.level.seconds
        return WorkUnit(f"orbits of {self.name}", ("orbits", self.name), nominal=seconds)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity of the orbit."""
        rung = self.make(self.films.frozen)
        found = rung.answer(None)
        return Found(found.value, {self.unit: 1}, FieldOrbit(found, rung))

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of the orbit on its films, and what theirs changes of the linear one."""
        solved: FieldOrbit = found.solution
        about = solved.rung.estimate(solved.found, None, tolerance)
        linear = self.uniform.answer(None)
        return with_fields(
            about, field_error(self.uniform, linear, self.films.rests, self.films.level), self.name
        )


def field_speeds(balanced: Sequence[SpeedRung]) -> tuple[Rung, ...]:
    """Return the rungs of a speed on T2 and T3, from those of T1, on the mesh of the file."""
    mesh = next((rung for rung in balanced if rung.model.modes is None), balanced[0])
    return tuple(FieldSpeedRung(level=level, uniform=mesh) for level in FIELD_LEVELS[:2])


def field_orbits(
    films: ShaftFilms,
    rest: RotorEquilibrium,
    rung_on: Callable[..., HeatedShaft],
    choices: Sequence[tuple[ShaftModel, int]],
) -> tuple[Rung, ...]:
    """Return the rungs of an orbit on T2 and T3: the last linear one, and the first others.

    Parameters
    ----------
    films : ShaftFilms
        On their oils.
    rest : RotorEquilibrium
        On these.
    rung_on : callable
        Takes films, `model` of the shaft and `samples` over a turn, and returns the rung.
    choices : sequence of (ShaftModel, int)
        Models and samples, 0 of the linear orbit.
    """
    linear = [choice for choice in choices if not choice[1]]
    taken = [linear[-1], *[choice for choice in choices if choice[1]][:NONLINEAR]]
    model, samples = linear[-1]
    uniform = rung_on(frozen_at(films, rest), model=model, samples=samples)
    return tuple(
        FieldOrbitRung(films=warm, uniform=uniform, make=partial(rung_on, model=model, samples=samples))
        for warm in (FrozenShaftFilms(level, films, rest) for level in FIELD_LEVELS[:2])
        for model, samples in taken
    )
