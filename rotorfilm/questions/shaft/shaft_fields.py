"""Flexible rotors on films with a temperature field (T2, T3), frozen as at the rotor's rest."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, NamedTuple, Protocol

import numpy as np

from ...answers import ErrorEstimate, Found, WorkUnit
from ...ladders import BaseRung, Rung
from ...linear import RotorEquilibrium, rotor_equilibrium
from ...linear.large.inverse_iteration import whirl_near
from ...linear.rotor_whirl import Whirl, on_films, value_rate
from ...linear.speed_events import SpeedEvent, secant_speed
from ...rotors.shaft.shaft_models import ShaftModel
from ...scenes.journal.field_levels import FIELD_LEVELS, FieldLevel, grid_error
from ...scenes.journal.heat_steps import HeatError
from ...scenes.journal.warm_rest import WarmRest
from .shaft_films import ShaftFilms
from .shaft_heat import HeatedShaft, HeatFound, frozen_at, steps_error, value_on, with_moving

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

        rate = event.rate(value_rate(structure, whirl, rung.films))
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
