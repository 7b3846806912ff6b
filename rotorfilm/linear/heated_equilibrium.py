"""The static equilibrium of a journal on a film whose temperature is a field."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..bearings.oil.laminar import warn_of_flow
from ..errors import EquilibriumError, FilmContactError, require_number, warn_user
from ..inputs.kinds import arguments
from ..model import Array
from ..readable.result import Readable
from ..results import Equilibrium
from .equilibrium import checked_load, equilibrium
from .search.heated_place import TRIED, FieldFilm, near_states

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
    first = equilibrium(film.cold(), load, speed).position
    for near in near_states(film, load, speed, first):
        found = _settled(film, load, speed, near) or _unsettled(film, load, speed, near)
        if found is not None:
            mean = float(np.mean(found.state.oil_temperature))
            warn_of_flow(film, speed, mean, found.state.maximum_temperature)
            return found
    raise EquilibriumError(
        f"film and temperature must come to rest together, and did not from any of {TRIED + 1} places: "
        f"fresh oil carries the load at {first.tolist()} m, but no place was found where the warm film "
        f"that openings can feed carries it, got load {load.tolist()} N at {speed:g} rad/s"
    )


def _settled(film: FieldFilm, load: Array, speed: float, state: Any) -> HeatedEquilibrium | None:
    """Return the equilibrium near a state, by film and heat in turn; None if they do not rest near it."""
    place = state.position
    try:
        rest = equilibrium(state.film, load, speed)
        for _ in range(MOST_ROUNDS):
            before, state = state, film.warmed(rest.position, speed, state)
            rest = equilibrium(state.film, load, speed)
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
        rest = equilibrium(state.film, load, speed)
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
