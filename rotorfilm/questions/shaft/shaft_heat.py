"""Flexible rotors on films of an oil: the films as fresh oil (T0) or as warm as the rotor's rest (T1)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import NamedTuple, Protocol

from ...answers import HEATED, SAFETY, ErrorEstimate, Found, Work
from ...bearings.journal import JournalBearing
from ...ladders import BaseRung, Rung
from ...linear import RotorEquilibrium
from ...model import Reaction
from ...results import Coefficients
from ...scenes.journal.assumed import assumed_figures
from ...scenes.journal.heat_steps import HeatError, HeatSteps, heat_error
from ...scenes.journal.warm_rest import WarmRest, uniform_rest
from ...scenes.shaft.shaft_remarks import shaft_physics
from ..journal.heat_rungs import BALANCED, FRESH, HeatLevel, balance_at, with_heat
from .shaft_films import ShaftFilms

NEAR = 0.02
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
            if asked == tolerance and abs(at - speed) <= NEAR * speed:
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
