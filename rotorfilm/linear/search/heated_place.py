"""Where a journal about rests on a film whose temperature is a field: place and temperature relaxed together.

Viscosity and empty cells hold at one place only. A search for the rest with both frozen may leave that place
far behind, and find none. So the journal moves by one step of Newton's method at a time. Between two steps
the film is solved again where the journal is, and its temperature follows.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ...errors import FilmContactError
from ...model import Array, Reaction, prepared_tangent
from .static_search import StaticPoint, StaticTarget, _newton, _point, _start_at

ROUNDS, FREE_ROUNDS, HOPELESS_ROUNDS = 40, 8, 16
"""Rounds of one approach at most, those before a state counts as near rest, and those after which a journal
as far from it as `HOPELESS` is given up."""

MOVED, CHANGED, NEAR, FAR, HOPELESS = 2e-3, 5e-3, 0.05, 0.3, 1.5
"""An approach ends where a step moves the journal by less of its clearance, the power changes by less, and
the force is as near to the load; beyond `FAR` it has not come near."""

LESS, MORE = 0.6, 1.2
"""Factors of the next step where the force is farther from the load than before, and where it is nearer."""

SCANNED = (0.2, 0.5, 0.8)
"""Eccentricity ratios at which a place is sought all round."""

ANGLES, TRIED = 12, 4
"""Places at each of them, and how many of the best are tried."""

_STEP = 0.7
"""Longest step, in ln(chi/(1 - chi)) and in the angle [rad]."""


@runtime_checkable
class FieldFilm(Protocol):
    """A film that warms with its temperature a field, as `HeatedFilm`."""

    @property
    def bearing(self) -> Any:
        """The bearing, with oil and cooling."""

    @property
    def supply_temperature(self) -> float:
        """Temperature of the fresh oil [K]."""

    def cold(self) -> Reaction:
        """Return the film of fresh oil."""

    def frozen(self, position: ArrayLike, speed: float, temperature: ArrayLike) -> Reaction:
        """Return the film of the viscosity at a temperature, as it is fed at a place."""

    def warmed(self, position: ArrayLike, speed: float, before: Any = None, *, closing: bool = False) -> Any:
        """Return a state: `film`, of the viscosity of the state before, and what it warms to.

        The `closing` one accounts for the heat to the last digit.
        """

    def warmed_from(self, position: ArrayLike, speed: float, temperature: ArrayLike) -> Any:
        """Return a state that starts from a temperature of the film."""

    def is_settled(self, before: Any, state: Any) -> bool:
        """Return whether the last round has changed hardly anything."""


def near_states(film: FieldFilm, load: Array, speed: float, first: Array) -> Iterator[Any]:
    """Yield states of a film that nearly balances a load [N]: from a place [m], then from all round."""
    fresh = film.supply_temperature
    warm = float(np.mean(film.warmed_from(first, speed, fresh).oil_temperature))
    for place in _starts(film, load, speed, first, warm):
        found = _approach(film, load, speed, place, fresh if place is first else warm)
        if found is not None:
            yield found


def _starts(film: FieldFilm, load: Array, speed: float, first: Array, temperature: float) -> Iterator[Array]:
    yield first
    points = []
    for chi in SCANNED:
        for angle in np.linspace(0.0, 2.0 * math.pi, ANGLES, endpoint=False):
            place = chi * film.bearing.clearance * np.array([math.cos(angle), math.sin(angle)])
            target = _target(film.frozen(place, speed, temperature), load, speed)
            points.append(_point(target, *_start_at(target, *place), 0))
    for point in sorted(points, key=lambda point: point.norm)[:TRIED]:
        yield np.array(point.position)


def _approach(film: FieldFilm, load: Array, speed: float, place: Array, temperature: ArrayLike) -> Any:
    """Return the state nearest to rest on the way from a place; None where that is none."""
    share, power, norm, best = 1.0, math.inf, math.inf, (FAR, None)
    for k in range(1, ROUNDS + 1):
        try:
            state = film.warmed_from(place, speed, temperature)
        except FilmContactError:
            break
        point, moved = _stepped(_target(state.film, load, speed), place, share * _STEP)
        if not math.isfinite(point.norm) or (k > HOPELESS_ROUNDS and point.norm > HOPELESS):
            break
        # The empty cells follow the journal, more than the slope of a film knows that is frozen.
        share = LESS * share if point.norm > norm else min(1.0, MORE * share)
        change = np.hypot(*(moved - place)) / film.bearing.clearance
        rested = change < MOVED and abs(state.power_loss / power - 1.0) < CHANGED and point.norm < NEAR
        if rested or (k > FREE_ROUNDS and point.norm < best[0]):
            best = point.norm, replace(state, rounds=max(k, FREE_ROUNDS))
        if rested:
            break
        temperature = temperature + share * (state.oil_temperature - temperature)
        place, power, norm = place + share * (moved - place), state.power_loss, point.norm
    return best[1]


def _stepped(target: StaticTarget, place: Array, longest: float) -> tuple[StaticPoint, Array]:
    """Return the residual at a place, and where one step of limited length leads from there."""
    s, phi = _start_at(target, *place)
    here = _point(target, s, phi, 0)
    there = _newton(target, s, phi, most=1)
    way = max(abs(there.s - s), abs(there.phi - phi))
    if way > longest:
        part = longest / way
        there = _point(target, s + part * (there.s - s), phi + part * (there.phi - phi), 1)
    return here, np.array(there.position) if math.isfinite(there.norm) else place


def _target(film: Reaction, load: Array, speed: float) -> StaticTarget:
    x, y = -float(load[0]), -float(load[1])
    return StaticTarget(prepared_tangent(film), film.clearance, speed, x, y, 1.0, 0.0)
