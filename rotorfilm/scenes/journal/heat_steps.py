"""How far a rest on a warm film is off, by a few steps towards the temperature across its film (T3).

A step is one solution of the heat of T3 on a film, less where its oil gets warmer (its thinning), and the
rest that the viscosity which follows has. Three of them are as for the defect of a richer film
(`film_defects`): the first sees the step, the others what is of second and third order in it. They are taken
on the cells of a film of T3 and on cells twice as long: heat moves upwind there and pressure is of second
order, so that cells without end would change about half as much again as these do.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np

from ...bearings.journal import HeatedFilm, HeatedJFOFilm, JFOFilm, JournalBearing, LayeredTemperature
from ...linear import equilibrium
from ...results import Equilibrium
from .warm_rest import WarmRest, rest_of_state, warm_field

PROFILE, CELLS = LayeredTemperature(8), (80, 8)
"""Layers and cells of a step; the cells are those of the rungs with a temperature field."""

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
        In the unit of the tolerance.
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
        On its oil.
    own : WarmRest
        By T1 or T2.
    """

    bearing: JournalBearing | JFOFilm
    own: WarmRest

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
        return f"step {STEPS} towards T3 moves the journal by {moves[-1] / first:.0%} of the first"

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

    def _film(self, cells: tuple[int, int]) -> HeatedFilm | HeatedJFOFilm:
        return warm_field(self.bearing, cells, PROFILE)

    def _start_on(self, cells: tuple[int, int]) -> WarmRest:
        """Return the start by one temperature on these cells, whose own error is none of the heat.

        A field is on the cells of the steps, whose error is its own; and films by Reynolds rupture that
        openings feed start only where there is oil, which is not the film of one temperature.
        """
        own, film = self.own, self._film(cells)
        fed = isinstance(film, HeatedFilm) and film.bearing.geometry.openings()
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
        """Return a step with power and flow, which are those before its move, changed as T1's by the move."""
        own = self.bearing.at_temperature(self.own.temperature)
        before, after = (own.losses(q, np.zeros(2), here.speed) for q in (here.position, found.rest.position))
        assert before is not None  # a balance has them
        assert after is not None
        return replace(
            found,
            power_loss=found.power_loss * float(after.power_loss) / float(before.power_loss),
            side_flow=found.side_flow * float(after.side_flow) / float(before.side_flow),
        )


def heat_error(
    own: Any, start: Any, sample: tuple[Any, Any, Any, Any, Any], distance: Callable[[Any, Any], float]
) -> HeatError:
    """Return how far a value is off, by those of steps.

    Parameters
    ----------
    own, start : float or ndarray
        The value, and that where the steps start, which is another one only of T0.
    sample : tuple of five
        Of `HeatSteps.sample`.
    distance : callable
        Takes a value and a better one, and returns how far it is off.
    """
    last, before, coarse, fine, long = (np.asarray(one) for one in sample)
    last, before, coarse = last - fine + start, before - fine + start, coarse - long + start
    error = distance(own, last + ONWARD * (last - coarse))
    unsure = ONWARD * distance(coarse, last) + distance(before, last)
    return HeatError(error, False) if error >= unsure else HeatError(error + unsure, True)


class _Judge(Protocol):
    @property
    def value(self) -> Callable[[WarmRest], Any]: ...

    @property
    def distance(self) -> Callable[[Any, Any], float]: ...


class JudgedRest:
    """What judges rests by the `value` of each, and by the `distance` of one value from a better one."""

    def apart(self: _Judge, own: WarmRest, other: WarmRest) -> float:
        """Return how far the quantity of one rest is from that of a better one."""
        return self.distance(self.value(own), self.value(other))

    def error(self: _Judge, own: WarmRest, steps: HeatSteps) -> HeatError:
        """Return how far the quantity of a rest is off by heat."""
        start, last, before, *bases = (self.value(one) for one in (steps.own, *steps.sample))
        coarse, fine, long = bases
        return heat_error(self.value(own), start, (last, before, coarse, fine, long), self.distance)
