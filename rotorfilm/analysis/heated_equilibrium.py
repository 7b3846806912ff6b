"""The static equilibrium of a journal on a film whose temperature is a field."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ..bearings.oil.oil import warn_of_flow
from ..core.errors import EquilibriumError, FilmContactError, ValidityWarning, require_number, warn_user
from ..core.inputs import arguments
from ..core.model import Array, Reaction, prepared_tangent
from ..core.readable import Readable
from ..core.results import Equilibrium
from .equilibrium import StaticPoint, StaticTarget, _newton, _point, _start_at, checked_load, equilibrium

MOST_ROUNDS = 60

LOST, COARSE = 0.1, 0.02
"""Distances over the clearance that the rest may move while film and heat are solved in turn, and that the
place of an answer which does not settle may be unsure by."""


@dataclass(frozen=True, kw_only=True)
class HeatedEquilibrium(Readable):
    """The place of a journal at which a film that warms balances the load.

    Attributes
    ----------
    rest : Equilibrium
        Of the film at its frozen temperature.
    state : HeatedState
        Temperature, pressure, power and flow there; `coefficients(state.film, ...)` are those at frozen
        temperature.
    rounds : int
        Solutions of film and heat in turn.
    """

    rest: Equilibrium
    state: Any
    rounds: int


@arguments
def heated_equilibrium(film: FieldFilm, load: ArrayLike, speed: float) -> HeatedEquilibrium:
    """Return the position at which a film with a temperature field balances a static load.

    The journal starts where the film of fresh oil holds it, or where a look all round finds the force near to
    the load. Place and temperature are relaxed together, and then solved in turn until both rest.
    A `ValidityWarning` tells of oil beyond its viscosity law, and of a film that is not laminar.

    Parameters
    ----------
    film : FieldFilm
        Such as `HeatedFilm`.
    load : array_like, shape (2,) [N]
        External static force on the journal, weight included.
    speed : float [rad/s]
        Angular speed about +z, of either sign, not 0.

    Raises
    ------
    InputError
        As `equilibrium`.
    EquilibriumError
        If the load is beyond what the film carries with fresh oil, or no place is found at which the film
        balances it.
    """
    load, speed = checked_load(load), require_number("speed", speed)
    first = _quiet_equilibrium(film.cold(), load, speed).position
    for near in near_states(film, load, speed, first):
        found = _settled(film, load, speed, near) or _unsettled(film, load, speed, near)
        if found is not None:
            mean = float(np.mean(found.state.oil_temperature))
            warn_of_flow(film, speed, mean, found.state.maximum_temperature)
            return found
    raise EquilibriumError(
        f"load must be one that the warm film carries: film and temperature do not come to rest together; "
        f"fresh oil carries the load at {first.tolist()} m, but no place was found where the warm film "
        f"that openings can feed carries it, got load {load.tolist()} N at {speed:g} rad/s"
    )


def _quiet_equilibrium(film: Any, load: Array, speed: float) -> Equilibrium:
    """Return the equilibrium on a film on the way to the answer, of which nobody needs to be warned."""
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        return equilibrium(film, load, speed)


def _settled(film: FieldFilm, load: Array, speed: float, state: Any) -> HeatedEquilibrium | None:
    """Return the equilibrium near a state, by film and heat in turn; None if they do not rest near it."""
    place = state.position
    try:
        rest = _quiet_equilibrium(state.film, load, speed)
        for _ in range(MOST_ROUNDS):
            before, state = state, film.warmed(rest.position, speed, state)
            rest = _quiet_equilibrium(state.film, load, speed)
            if _moved(film, rest, place) > LOST:
                return None
            if film.is_settled(before, state):
                return _closed(film, load, speed, rest, state)
    except (EquilibriumError, FilmContactError):
        return None
    return None


def _unsettled(film: FieldFilm, load: Array, speed: float, state: Any) -> HeatedEquilibrium | None:
    """Return the equilibrium at the temperature of a state, and warn, where it is nearly at that place."""
    try:
        rest = _quiet_equilibrium(state.film, load, speed)
        found = _closed(film, load, speed, rest, state)
    except (EquilibriumError, FilmContactError):
        return None
    off = max(_moved(film, one, state.position) for one in (rest, found.rest))
    if off > COARSE:
        return None
    warn_user(
        "film and temperature come to rest together only to the size of a cell, where oil gets to more or "
        f"fewer of them: the position is known to {off:.2g} of the clearance, and more cells tell it better"
    )
    return found


def _closed(film: FieldFilm, load: Array, speed: float, rest: Equilibrium, state: Any) -> HeatedEquilibrium:
    closed = film.warmed(rest.position, speed, state, closing=True)
    return HeatedEquilibrium(rest=equilibrium(closed.film, load, speed), state=closed, rounds=closed.rounds)


def _moved(film: FieldFilm, rest: Equilibrium, place: Array) -> float:
    """Return the distance of a rest from a place over the clearance."""
    return float(np.hypot(*(rest.position - place))) / float(film.bearing.clearance)


# Where a journal about rests on a film whose temperature is a field: place and temperature relaxed
# together.
#
# Viscosity and empty cells hold at one place only. A search for the rest with both frozen may leave
# that place far behind, and find none. So the journal moves by one step of Newton's method at a time.
# Between two steps the film is solved again where the journal is, and its temperature follows.


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
