"""Forces of bearings behind addresses, for loops in C (`native.film_call`).

A reaction without a compiled force is called back in Python, slower, with the same result.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

from ..core import port
from ..core.errors import (
    FilmContactError,
    InputError,
    RotorfilmError,
    UndefinedDerivativeError,
    warn_user,
)
from ..core.model import Array
from ..core.port import optional
from ..core.results import Trajectory
from ..core.signals import Signal
from ..native import Status
from ..native.film_call import MASSLESS, FilmCall
from ..native.library import loops
from ..native.structs import constant
from ..rotors import CrackedRotor, LinearMotor
from ..rotors.structure import station_name


def raise_foreign(calls: Iterable[FilmCall]) -> None:
    """Raise what a force in Python raised that the loop around it could not: an error of its own, Ctrl-C."""
    for call in calls:
        if call.raised:
            raise call.raised[0]


def warn_beyond(calls: Iterable[FilmCall]) -> None:
    """Warn that a journal went beyond the map of its film."""
    how = " or ".join(dict.fromkeys(call.beyond for call in calls if call.beyond))
    warn_user(f"a journal went beyond the map of its film; its force is {how}")


THINNEST = 1e-7
"""Least film [m] that separates the finest bearing surfaces, of a roughness of about 0.05 um each."""


def of_station(station: str) -> str:
    """Return how a message names a station, which a rotor with one journal does not need."""
    return f" of {station!r}" if station else ""


def warn_of_thin_films(films: Mapping[str, Any], run: Trajectory) -> None:
    """Warn where a run has a film, by its station, that is thinner than surfaces are rough."""
    for station, film in films.items():
        place = [run.signals.get(station_name(station, name)) for name in port.freedoms_of(film)]
        if any(row is None or not row.size for row in place) or not port.clearance_of(film) < math.inf:
            continue
        least = port.minimum_film(film, np.array(place))
        if least[at := int(np.argmin(least))] < THINNEST:
            warn_user(
                f"the least film{of_station(station)} should be at least {THINNEST:g} m, the roughness of "
                "the finest surfaces, got "
                f"{least[at]:.3g} m at t = {run.time[at]:.6g} s: "
                "real surfaces touch there, and the force of this smooth film does not predict theirs"
            )


def film_call(reaction: Any, *, tilts: bool = False) -> FilmCall:
    """Return the compiled force of a reaction without states, one that calls back where it has none.

    With `tilts` it may be that of a journal that feels its tilt.
    """
    port.require_massless("reaction", reaction)
    if tilts and feels_tilt(reaction):
        return reaction.tilted_call() or _called_back(reaction)
    return port.compiled_force(reaction) or _called_back(reaction)


def call_over_time(reaction: Any) -> FilmCall:
    """Return the same with the mass that a reaction adds, that too called back where it is not in C."""
    if port.inertial(reaction) is None:
        return film_call(reaction, tilts=True)
    call: FilmCall | None = port.compiled_force(reaction)
    return _called_back(reaction) if call is None or call.mass == MASSLESS else call


def call_with_added_mass(reaction: Any) -> FilmCall:
    """Return the compiled force of a reaction without states, with the mass that it adds.

    Raises
    ------
    InputError
        If it adds a mass that is not compiled.
    """
    if port.inertial(reaction) is None:
        return film_call(reaction)
    call: FilmCall | None = port.compiled_force(reaction)
    if call is None or call.mass == MASSLESS:
        raise InputError(
            f"reaction must have its added mass in C here, as a damper on a map, got {reaction!r}"
        )
    return call


def _called_back(reaction: Any) -> FilmCall:
    n = len(port.freedoms_of(reaction))

    def moved(state: Any) -> tuple[Array, Array, float]:
        return np.array(state[:n]), np.array(state[n : 2 * n]), state[2 * n]

    def forced(state: Any) -> tuple[Array, Array]:
        at = moved(state)
        return port.static_force(reaction, *at), port.static_slopes(reaction, *at)[:, : 2 * n + 1]

    def weighed(state: Any) -> tuple[Array, Array]:
        at = moved(state)
        rows = (0, 0, 1), (0, 1, 1)
        return reaction.mass(*at)[rows], reaction.mass_slopes(*at)[rows][:, :4]

    raised: list[BaseException] = []
    call = _call_of(forced, raised)
    if port.inertial(reaction) is None:
        return call
    mass = _call_of(weighed, raised)
    return call._replace(mass=mass[:2], owner=(call.owner, mass.owner))


def _call_of(law: Callable[[Any], tuple[Array, Array]], raised: list[BaseException]) -> FilmCall:
    """Return an address that answers what a function has for a state: values, and their slopes.

    Parameters
    ----------
    law : callable
    raised : list of BaseException
        Where errors that are none of this package go.
    """

    def answer(_: Any, state: Any, value: Any, slopes: Any) -> int:
        if raised:  # an interrupt, say: the loop is to end
            return Status.NOT_FINITE
        try:
            for into, found in zip((value, slopes), law(state), strict=True):
                for i, number in enumerate(found.ravel().tolist()):
                    into[i] = number
        except FilmContactError:
            return Status.AT_WALL
        except UndefinedDerivativeError:
            return Status.UNDEFINED
        except RotorfilmError:
            return Status.NOT_FINITE
        except BaseException as error:
            raised[:] = [error]
            return Status.NOT_FINITE
        return Status.OK

    return FilmCall.of_python(answer, raised)


class CrackForce(NamedTuple):
    """What the crack of a shaft does to its two parts, as a bearing that no output shows."""

    rotor: CrackedRotor
    clearance: float = math.inf
    outputs: tuple[Signal, ...] = ()

    def call(self) -> FilmCall:
        """Return the force over the deformation at the crack; behind it the state has the angle turned."""

        def released(state: Any) -> tuple[Array, Array]:
            lost = self.rotor.lost_at(state[5])
            return lost @ np.array(state[:2]), np.hstack([lost, np.zeros((2, 3))])

        return _call_of(released, [])


def torque_call(torque: Any) -> FilmCall:
    """Return the torque of a motor over (time, speed): that of a `LinearMotor` in C, others in Python."""
    if type(torque) is LinearMotor:
        return FilmCall.of_numbers("rf_line_torque_at", torque.line)

    def driven(state: Any) -> tuple[Array, Array]:
        at = state[0], state[1]
        return np.array([torque.torque(*at)], dtype=float), np.array([torque.slope(*at)], dtype=float)

    return _call_of(driven, [])


def film_samples(bearing: Any, rows: Array, speed: float) -> tuple[Array, Array] | None:
    """Return what a film in C with states answers at many motions; None without one, or beyond its map.

    Parameters
    ----------
    bearing : Reaction
    rows : ndarray, shape (4 + n_states, samples)
        x, y, vx, vy and its states.
    speed : float [rad/s]

    Returns
    -------
    answers : ndarray, shape (2 + n_states, samples)
        Forces and rates of the states.
    slopes : ndarray, shape (2 + n_states, 5 + n_states, samples)
        Their derivatives by x, y, vx, vy, speed and the states.
    """
    if not has_states_in_c(bearing):
        return None
    call, given = bearing.call_with_states(), np.ascontiguousarray(rows)
    n, samples = call.states, rows.shape[1]
    answers, slopes = np.empty((2 + n, samples)), np.empty((2 + n, 5 + n, samples))
    places = given.ctypes.data, speed, answers.ctypes.data, slopes.ctypes.data
    status = loops()["rf_film_samples"](call.address, call.data, n, samples, *places)
    return (answers, slopes) if status == Status.OK else None


def has_states_in_c(bearing: Any) -> bool:
    """Return whether a bearing is a film in C with states of its own, as a temperature or tilts of pads."""
    call = optional(bearing, "call_with_states")
    return call is not None and call.states <= constant("RF_FILM_STATES")


def feels_tilt(bearing: Any) -> bool:
    """Return whether a bearing is a journal in C that feels its tilt."""
    return hasattr(bearing, "tilted_call")
