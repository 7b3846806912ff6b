"""The bearings of a flexible rotor: which films may stand in its journals, and what is richer."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis import RotorEquilibrium, equilibrium, rotor_equilibrium
from ..bearings.journal import JournalBearing, TiltLevel
from ..bearings.journal.questions import TiltLevelFilm, tilted_films
from ..core.answers import (
    HEATED,
    SAFETY,
    BaseRung,
    ErrorEstimate,
    Ladder,
    Rung,
    RungResult,
    WorkUnit,
    relative_change,
)
from ..core.port import Reaction
from ..core.results import Coefficients, coefficients_of_slopes
from ..rotors import FlexibleRotor, ShaftRotor
from ..rotors.shaft_rotor import ShaftModel
from ..scenes import film_heat
from ..scenes.film_rungs import FilmCandidate, FilmRung, corrected, turn_films
from ..scenes.oil_film_tables import has_map
from ..scenes.shared_tables import oil_remarks
from ..scenes.solve_shaft import shaft_physics, shaft_remarks
from .heat_levels import BALANCE, BALANCED, FRESH, HeatLevel, balance_at, known_films, with_heat, with_moving
from .turbulent_oil import turbulent_shaft
from .variants import FunctionRung, counted_rung, with_estimate

if TYPE_CHECKING:
    from ..scenes.scene import Scene
    from ..scenes.shaft_table import BearingTable, ShaftTable

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
        Journals by station; those that feel their tilt are a `TiltLevelFilm` each.
    springs : dict of str to Reaction
        Bearings without a film, by station.
    """

    journals: Mapping[str, Any]
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
        return tuple(name for name, film in self.journals.items() if getattr(film.reaction, "oil", None))

    @property
    def tilted(self) -> bool:
        """Whether a film feels the tilt of its journal."""
        return any(isinstance(film, TiltLevelFilm) for film in self.journals.values())

    def changed(self, films: Mapping[str, FilmRung]) -> ShaftFilms:
        """Return films of which some, by station, are others."""
        return replace(self, journals={**self.journals, **films})

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
    choices = {one.name: _choices(one) for one in shaft.bearings if one.journal is not None}
    count = max((len(each) for each in choices.values()), default=1)
    return tuple(
        ShaftFilms(
            journals={name: each[min(level, len(each) - 1)] for name, each in choices.items()},
            springs=springs,
        )
        for level in range(count)
    )


def _choices(table: BearingTable) -> tuple[FilmCandidate, ...]:
    journal = table.journal
    assert journal is not None  # or there are no films to choose
    bearing = journal.bearing()
    if table.tilt is not None:
        levels = {table.tilt} if isinstance(table.tilt, TiltLevel) else {*TiltLevel}
        return tilted_films(bearing, fixed=journal.film_is_given, levels=levels, made=table.misaligned)
    films = turn_films(bearing, fixed=journal.film is not None, grids=GRIDS, maps=False)
    return known_films(films) if bearing.is_warming else films


def rich_coefficients(
    films: ShaftFilms, at: RotorEquilibrium, rotor: FlexibleRotor
) -> tuple[dict[str, Coefficients], str]:
    """Return K and C of all bearings by the richer films at their own equilibria, and why to doubt them.

    With tilts that is the equilibrium of the rotor, which sags otherwise under their moments.
    """
    if films.tilted:
        return rotor_equilibrium(rotor, films.rich, at.speed).coefficients, ""
    found, doubt = dict(at.coefficients), ""
    for name, film in films.journals.items():
        load = at.loads[name]
        if name in at.temperatures:
            film = film.at_temperature(at.temperatures[name])
        moved = corrected(film, equilibrium(film.reaction, load, at.speed), load, smooth=True)
        found[name] = coefficients_of_slopes(moved.slopes, moved.position, at.speed)
        doubt = doubt or moved.doubt
    return found, doubt


def coefficient_bounds(films: ShaftFilms, at: RotorEquilibrium) -> dict[str, float]:
    """Return the verified relative error of K and C of each film at rest; infinite where there is none."""
    return {
        name: _rest_bound(
            film, float(np.hypot(*at.coefficients[name].position[:2])) / film.reaction.clearance
        )
        for name, film in films.journals.items()
    }


def _rest_bound(film: FilmRung, eccentricity_ratio: float) -> float:
    if not (film.bounded and has_map(film.reaction)):
        return film.bound(eccentricity_ratio, slopes=True)
    return min((bound for reach, bound in REST_BOUNDS if eccentricity_ratio <= reach), default=math.inf)


# What rungs of a flexible rotor have in common, and the ladder of them.


@dataclass(frozen=True, kw_only=True)
class ShaftRung(BaseRung):
    """An answer by one model of the shaft and one film for each journal; a question adds how it is found.

    Attributes
    ----------
    model : ShaftModel
    films : ShaftFilms
    """

    model: ShaftModel
    films: ShaftFilms

    @property
    def how(self) -> str:
        """How the model is solved, where that is not the same for all rungs."""
        return ""

    @property
    def name(self) -> str:
        """How it is solved, the model of the shaft, the film."""
        return ", ".join(part for part in (self.how, self.model.name, self.films.name) if part)

    @property
    def unit(self) -> WorkUnit:
        """One problem of its own."""
        return WorkUnit(f"problems of {self.name}", (self.how, id(self.model), id(self.films)))

    def answer(self, before: RungResult | None) -> RungResult:
        """Return its answer, from that of a lower rung or alone."""
        raise NotImplementedError

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the error of its answer without running a richer model."""
        raise NotImplementedError

    def rest(self, found: RungResult) -> RotorEquilibrium:
        """Return the rotor at rest, of an answer."""
        raise NotImplementedError

    def on(self, found: RungResult, coefficients: dict[str, Coefficients]) -> float:
        """Return the answer on these K and C of its bearings, for small changes."""
        raise NotImplementedError

    def distance(self, value: float, better: float) -> float:
        """Return how far a value is from a better one, in the unit of the tolerance."""
        return relative_change(value, better)

    def moving(self, found: RungResult) -> float:
        """Return the error by heat that moves with the motion."""
        return 0.0


def shaft_ladder_on(
    scene: Scene,
    rotor: ShaftRotor,
    speed: float,
    unit: str,
    rungs: Sequence[ShaftRung],
    heated: Callable[[], tuple[Sequence[ShaftRung], Iterator[Rung]]],
) -> Ladder:
    """Return the ladder of a question about the shaft of a scene.

    Parameters
    ----------
    scene : Scene
    rotor : ShaftRotor
        Rotor of the remarks.
    speed : float [rad/s]
        Speed of the remarks.
    unit : str
    rungs : sequence of ShaftRung
        On films as warm as the rest makes them, where they are of an oil (T1).
    heated : callable
        Returns the rungs on fresh oil (T0), and those on temperature fields (T2, T3).
    """
    bearings, on_oil, first = scene.shaft.build_bearings(), rungs[0].films.on_oil, rungs[0]
    ladder: tuple[Rung, ...] = tuple(rungs)
    if on_oil:
        fresh, fields = heated()
        levels = ((RotorHeat(FRESH), fresh), (RotorHeat(BALANCED), rungs))
        ladder = (*(warm_rung(rung, heat) for heat, each in levels for rung in each), *fields)
    oil = scene.lubricant.properties
    made = Ladder(
        rungs=ladder,
        unit=unit,
        remarks=oil_remarks(scene.tables, scene.lubricant) + shaft_remarks(rotor, bearings, oil, speed),
        within=HEATED if on_oil else shaft_physics(bearings),
        assumptions=lambda: shaft_assumptions(first),
        distance=first.distance,
    )
    # what turbulence changes in a tilted film is said by the remarks alone
    return made if first.films.tilted else turbulent_shaft(scene, first, made)


# Flexible rotors on films of an oil: the films as fresh oil (T0) or as warm as the rotor's rest (T1).


NEAR_HEAT = 0.02
"""Relative change of speed within which rungs of a level have the same error by heat."""

HeatEffect = tuple[film_heat.HeatError, str, str]
"""An error by heat, how it is known, and why it must not be trusted; empty if it may."""


def rests_of(rung: ShaftRung, at: RotorEquilibrium) -> dict[str, film_heat.WarmRest]:
    """Return the rest in each film of an oil, at its temperature."""
    found = {}
    for name in rung.films.on_oil:
        bearing: JournalBearing = rung.films.journals[name].reaction
        temperature = at.temperatures.get(name, bearing.temperature)
        found[name] = film_heat.uniform_rest(bearing, at.loads[name], at.speed, temperature)
    return found


def value_on(rung: ShaftRung, found: RungResult, rests: Mapping[str, film_heat.WarmRest]) -> float:
    """Return the answer on the films of other rests."""
    own = rung.rest(found).coefficients
    return rung.on(found, {**own, **{name: one.coefficients for name, one in rests.items()}})


def steps_error(
    rung: ShaftRung, found: RungResult, own: float, rests: Mapping[str, film_heat.WarmRest]
) -> HeatEffect:
    """Return the error of a value by heat, by steps of each film towards T3."""
    steps = {
        name: film_heat.HeatSteps(rung.films.journals[name].reaction, one) for name, one in rests.items()
    }
    samples = {name: one.sample for name, one in steps.items()}
    start = value_on(rung, found, rests)
    last, before, coarse, fine, long = (
        value_on(rung, found, {name: one[k] for name, one in samples.items()}) for k in range(5)
    )
    doubt = next((one.doubt for one in steps.values() if one.doubt), "")
    heat = film_heat.heat_error(own, start, (last, before, coarse, fine, long), rung.distance)
    return *with_moving(rung.moving(found), heat, "steps towards T3"), doubt


@dataclass(frozen=True, eq=False)
class RotorHeat:
    """What the heat of the films leaves open in all rungs of a level.

    Attributes
    ----------
    level : HeatLevel
        T0 or T1.
    known : list of (float, float, HeatEffect)
        Tolerance and speed [rad/s] at which it was found, and what.
    """

    level: HeatLevel
    known: list[tuple[float, float, HeatEffect]] = field(default_factory=list)

    def error(self, rung: ShaftRung, found: RungResult, tolerance: float) -> HeatEffect:
        """Return the error of an answer by heat; that of another rung next to it."""
        speed = rung.rest(found).speed
        for asked, at, heat in self.known:
            if asked == tolerance and abs(at - speed) <= NEAR_HEAT * speed:
                return heat
        heat = self._found(rung, found, tolerance)
        self.known.append((tolerance, speed, heat))
        return heat

    def _found(self, rung: ShaftRung, found: RungResult, tolerance: float) -> HeatEffect:
        rests = rests_of(rung, rung.rest(found))
        own = value_on(rung, found, rests)
        if self.level is FRESH:
            for name, one in rests.items():
                bearing = rung.films.journals[name].reaction
                rests[name] = film_heat.uniform_rest(
                    bearing, one.rest.load, one.rest.speed, balance_at(bearing, one)
                )
            error = rung.distance(own, value_on(rung, found, rests))
            if SAFETY * error >= tolerance:
                return film_heat.HeatError(error, False), BALANCE, ""
        return steps_error(rung, found, own, rests)


def warm_rung(rung: ShaftRung, heat: RotorHeat) -> FunctionRung:
    """Return a rung on films of one temperature, whose error is also that by heat, which a level shares."""
    name = f"{heat.level.name}, {rung.name}"

    def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        about = rung.estimate(found, before, tolerance)
        return with_heat(about, lambda: heat.error(rung, found, tolerance), f"estimates of {name}")

    return replace(with_estimate(rung, estimate, heat), name=name)


def at_temperatures(films: ShaftFilms, temperatures: Mapping[str, float]) -> ShaftFilms:
    """Return films that keep these temperatures [K], by station."""
    return films.changed({name: films.journals[name].at_temperature(T) for name, T in temperatures.items()})


def at_supply(films: ShaftFilms) -> ShaftFilms:
    """Return films of fresh oil."""
    supply = {name: films.journals[name].reaction.cooled[1].supply_temperature for name in films.on_oil}
    return at_temperatures(films, supply)


def shaft_assumptions(rung: ShaftRung) -> tuple[str, ...]:
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
            rests[name] = film_heat.uniform_rest(one, at.loads[name], at.speed)
        return rung.distance(own, value_on(rung, found, rests))

    lines: dict[str, None] = {}
    for name in on_oil:
        bearing: JournalBearing = rung.films.journals[name].reaction
        lines |= dict.fromkeys(film_heat.assumed_figures(bearing, partial(moved, like=bearing), fields=True))
    return tuple(lines)


# Flexible rotors on films with a temperature field (T2, T3), frozen as at the rotor's rest.


NONLINEAR = 3
"""Nonlinear rungs of an orbit."""

ROUNDOFF = 1e-9
"""Of loads, relative to them."""


def field_rests(
    films: ShaftFilms, at: RotorEquilibrium, level: film_heat.FieldLevel
) -> dict[str, film_heat.WarmRest]:
    """Return the rest in each film of an oil with a temperature field, under the loads of a rest by T1.

    In two bearings those follow from statics. Equal bearings under loads that are equal to roundoff, as of a
    symmetric rotor, have one rest.
    """
    rests: dict[str, film_heat.WarmRest] = {}
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


def field_error(
    rung: ShaftRung, found: RungResult, rests: dict[str, film_heat.WarmRest], level: film_heat.FieldLevel
) -> HeatEffect:
    """Return the error by heat of an answer on temperature fields.

    Of T2 by steps towards T3, of T3 by coarser grids.
    """
    own = value_on(rung, found, rests)
    if not level.layers:
        return steps_error(rung, found, own, rests)
    at = rung.rest(found)

    def value(one: film_heat.FieldLevel) -> float:
        return value_on(rung, found, field_rests(rung.films, at, one))

    grid = film_heat.grid_error(level, own, value, rung.distance)
    method = "cells twice as long, half the layers"
    return *with_moving(rung.moving(found), film_heat.HeatError(grid, True), method), ""


def with_fields(about: ErrorEstimate, heat: HeatEffect) -> ErrorEstimate:
    """Return the error of a rotor's model with that of the heat in its films, which no other rung shares."""
    return with_heat(about, lambda: heat, "")._replace(shared=0.0)


def field_orbits(
    films: ShaftFilms,
    rest: RotorEquilibrium,
    rung_on: Callable[..., ShaftRung],
    choices: Sequence[tuple[ShaftModel, int]],
) -> Iterator[Rung]:
    """Yield the rungs of an orbit on T2 and T3: the last linear one, and the first others.

    Parameters
    ----------
    films : ShaftFilms
        Films on their oils.
    rest : RotorEquilibrium
        On these.
    rung_on : callable
        Takes films, model of the shaft and samples over a turn, and returns the rung.
    choices : sequence of (ShaftModel, int)
        Models and samples, 0 of the linear orbit.
    """
    linear = [choice for choice in choices if not choice[1]][-1]
    uniform = rung_on(at_temperatures(films, rest.temperatures), *linear)
    for level in film_heat.FIELD_LEVELS[:2]:
        rests = cache(partial(field_rests, films, rest, level))  # found once for the rungs of a level
        for model, samples in (linear, *[choice for choice in choices if choice[1]][:NONLINEAR]):
            yield field_orbit(level, uniform, rests, partial(rung_on, model=model, samples=samples), films)


def field_orbit(
    level: film_heat.FieldLevel,
    uniform: ShaftRung,
    rests: Callable[[], dict[str, film_heat.WarmRest]],
    make: Callable[[ShaftFilms], ShaftRung],
    films: ShaftFilms,
) -> FunctionRung:
    """Return an orbit on films that keep a temperature field.

    Its error is that on these films, and what theirs changes of the linear orbit by T1, `uniform`.
    """
    name = f"{level.level}, {make(replace(films, journals={})).name}, {level.grid}"
    seconds = 2.0 * len(films.on_oil) * level.seconds

    def solve(before: RungResult | None) -> tuple[float, tuple[RungResult, ShaftRung]]:
        frozen = {}
        for station, own in rests().items():
            film = films.journals[station].frozen(own.reaction)
            frozen[station] = replace(film, rich=film.reaction, rich_name="itself")  # there is no richer one
        rung = make(films.changed(frozen))
        found = rung.answer(None)
        return found.value, (found, rung)

    def judge(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        inner, rung = found.solution
        about = rung.estimate(inner, None, tolerance)
        return with_fields(about, field_error(uniform, uniform.answer(None), rests(), level))

    return counted_rung(name, ("answers", name), seconds, solve, judge)
