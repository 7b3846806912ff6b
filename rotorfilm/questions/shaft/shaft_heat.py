"""Flexible rotors on films of an oil: the films as warm as the rotor's rest, and how far that is off."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ...answers import HEATED, ErrorEstimate, Found, Work, WorkUnit
from ...bearings.journal import JournalBearing
from ...ladders import BaseRung, Rung
from ...linear import RotorEquilibrium
from ...model import Reaction
from ...results import Coefficients
from ...scenes.journal.assumed import assumed_names
from ...scenes.journal.warm_rest import step, uniform_rest
from ...scenes.shaft.shaft_remarks import shaft_physics
from .shaft_films import ShaftFilms


@dataclass(frozen=True, eq=False)
class RotorHeat:
    """What the heat of the films leaves open in all rungs of a ladder.

    Attributes
    ----------
    error : callable
        Takes an answer and returns its error by heat [1].
    """

    error: Callable[[Any, Found], float]


@dataclass(frozen=True, kw_only=True)
class WarmShaftRung(BaseRung):
    """A rung of a rotor whose films are as warm as its rest makes them (T1).

    Attributes
    ----------
    rung : Rung
        Of the rotor.
    heat : RotorHeat
    """

    rung: Rung
    heat: RotorHeat

    @property
    def name(self) -> str:
        """T1, and that of the rung."""
        return f"T1, {self.rung.name}"

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
        """Return the error of the rung, and what one solution of T3 on each film changes."""
        about = self.rung.estimate(found, before, tolerance)
        heat = self.heat.error(self.rung, found)
        method = f"{about.method}; heat: one solution of T3, {heat:.2g}"
        work = {WorkUnit(f"estimates of {self.name}"): 1}
        return ErrorEstimate(about.error + heat, method, work, doubt=about.doubt, shared=heat)

    def expected(self, done: Work) -> Work:
        """Return that of the rung."""
        return self.rung.expected(done)


def warm_rungs(
    rungs: tuple[Rung, ...], films: ShaftFilms, error: Callable[[Any, Found], float]
) -> tuple[Rung, ...]:
    """Return the rungs of a rotor, with the error by heat where one of its films is of an oil."""
    if not films.on_oil:
        return rungs
    heat = RotorHeat(error)
    return tuple(WarmShaftRung(rung=rung, heat=heat) for rung in rungs)


def warm_physics(films: ShaftFilms, bearings: Mapping[str, Reaction]) -> str:
    """Return the physics in which the answers of a shaft are meant."""
    return HEATED if films.on_oil else shaft_physics(bearings)


def shaft_assumptions(films: ShaftFilms) -> tuple[str, ...]:
    """Return which figures of the oil and its cooling are assumed; how much they do is not known."""
    lines = {
        f"{text}: how much that moves the answer is not known for a shaft"
        for name in films.on_oil
        for text in assumed_names(films.journals[name].reaction)
    }
    return tuple(sorted(lines))


def heated_coefficients(films: ShaftFilms, at: RotorEquilibrium) -> dict[str, Coefficients]:
    """Return K and C of all bearings at a rest, those of films of an oil after one step towards T3."""
    found = dict(at.coefficients)
    for name in films.on_oil:
        bearing: JournalBearing = films.journals[name].reaction
        temperature = at.temperatures.get(name, bearing.temperature)
        own = uniform_rest(bearing, at.loads[name], at.speed, temperature)
        found[name] = step(bearing, own).coefficients
    return found


def frozen_at(films: ShaftFilms, at: RotorEquilibrium) -> ShaftFilms:
    """Return films that keep the temperatures of a rest."""
    journals = {
        name: film.at_temperature(at.temperatures[name]) if name in at.temperatures else film
        for name, film in films.journals.items()
    }
    return replace(films, journals=journals)
