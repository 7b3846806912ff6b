"""The static equilibrium of a journal under a constant load."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Sequence
from contextlib import nullcontext, suppress
from ctypes import byref, c_double, memmove
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ..core import port
from ..core.dynamic_stiffness import quasi_static, states_rest
from ..core.errors import (
    ConvergenceError,
    EquilibriumError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    ValidityWarning,
    brief,
    require_finite,
    require_number,
    require_pair,
    warn_user,
)
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Readable
from ..core.results import Equilibrium
from ..core.signals import PLANAR
from ..native import Status
from ..native.film_call import FilmCall
from ..native.library import loops
from ..native.structs import structure
from .threads import one_blas_thread

UNLOADED = (
    "an unloaded journal has no attitude angle (for the centered journal use coefficients at position (0, 0))"
)
"""Why a load of zero has no equilibrium."""

UNSTABLE = (
    "the equilibrium at {} m and {!r} rad/s is statically unstable: the force of the film drives the journal "
    "away from it"
)

_KELVIN = 4e-12
_FIRST_ANGLE = math.pi / 3.0
_ALONG, _NEAR_WALL = 0.1, 0.02
"""Angle to the load, and part of the room that is left, of a force that is the most that a film carries."""


@arguments
def equilibrium(reaction: port.Reaction, load: ArrayLike, speed: float) -> Equilibrium:
    """Return the position at which the film balances a static load.

    Parameters
    ----------
    reaction : Reaction
        The film; it need not be isotropic. If the heat balance determines its temperature, the temperature is
        found too.
    load : array_like, shape (2,) [N]
        External static force on the journal, weight included; film force + load = 0. For a reaction with
        other freedoms the force or moment in each of them, shape (n,).
    speed : float [rad/s]
        Angular speed about +z, of either sign.

    Returns
    -------
    Equilibrium
        The equilibrium, with |film force + load| <= 1e-12 |load|. Where a light load is the small difference
        of large forces, as on preloaded pads or balls, roundoff leaves up to 1e-6 |load|, and where a tilting
        pad gains or loses its film up to 1e-8 |load|. For tilting pads it is a `PadEquilibrium`. A
        `ValidityWarning` is given for a film beyond its map, for a temperature beyond the viscosity law of
        the oil, and for a mean pressure |load|/(2 radius length) above half of
        the bulk modulus of a mineral oil. It is also given for a film that is not laminar (Reynolds number
        speed radius clearance/kinematic viscosity above 2000 or 41.2 sqrt(radius/clearance)). Another warning
        is given for an equilibrium that is statically unstable: the stiffness in slow motion has a negative
        real eigenvalue.

    Raises
    ------
    InputError
        If an argument is not finite or has the wrong shape, or the load is zero.
    EquilibriumError
        If the load is beyond what the film carries at eccentricity ratio 0.9999, or where pads touch, if the
        film carries nothing (no wedge at zero speed), or if the search does not converge.

    Notes
    -----
    Newton's method with the exact Jacobian in s = log(chi / (1 - chi)), chi = |position| / clearance, and the
    angle phi of the position. The residual is (log(|F| / |load|), angle from -load to F). A film force grows
    as a power of chi near the center and of 1 - chi near the wall: the equations are nearly linear. Ball
    bearings, whose force may be zero over a range of positions, find their equilibrium themselves
    (`core.port`).
    """
    port.require_reaction("reaction", reaction, heavy=True)
    freedoms = port.freedoms_of(reaction)
    load = checked_load(load) if freedoms == PLANAR else port.require_place(reaction, load, "load")
    speed = require_number("speed", speed)
    found = _found(reaction, load, speed)
    port.warn_of_load(reaction, load)
    port.warn_of_flow(reaction, speed, found.temperature)
    return found


@arguments
def equilibria(reaction: port.Reaction, load: ArrayLike, speeds: ArrayLike) -> tuple[Equilibrium, ...]:
    """Return the equilibria of many speeds and loads, searched in one call of the C library.

    Parameters
    ----------
    reaction : Reaction
        As in `equilibrium`. If it has no compiled force, or has states or heat, its equilibria are found one
        speed after the other.
    load : array_like, shape (n_freedoms,) or (n_freedoms, n) [N]
        One load for all speeds, or one for each.
    speeds : array_like, shape (n,) [rad/s]

    Returns
    -------
    tuple of Equilibrium
        The same as `equilibrium` returns for each, with its warnings.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        As in `equilibrium`, for the first speed without an equilibrium.
    """
    port.require_reaction("reaction", reaction, heavy=True)
    grid, loads = require_finite("speeds", speeds), require_finite("load", load)
    if grid.ndim != 1:
        raise InputError(f"speeds must be a list of numbers, got {brief(speeds)}")
    if loads.ndim == 2 and loads.shape[1] != grid.size:
        raise InputError(f"load must be one, or one for each of {grid.size} speeds, got shape {loads.shape}")
    columns = list(loads.T) if loads.ndim == 2 else [loads]
    planar = port.freedoms_of(reaction) == PLANAR
    sound = planar and loads.shape[:1] == (2,) and loads.ndim < 3 and all(one.any() for one in columns)
    for one in () if sound else columns:
        checked_load(one) if planar else port.require_place(reaction, one, "load")
    found = settled(reaction, columns, grid.tolist())
    result = []
    for k, speed in enumerate(grid.tolist()):
        result.append(found[k] or _found(reaction, columns[k % len(columns)], speed))
        port.warn_of_flow(reaction, speed, result[-1].temperature)
    for one in columns:
        port.warn_of_load(reaction, one)
    return tuple(result)


def settled(reaction: Any, loads: Sequence[Array], speeds: Sequence[float]) -> list[Equilibrium | None]:
    """Return the equilibria at some speeds where a compiled force settles the search, and None elsewhere.

    Where it is None, `equilibrium` finds it, warns, or tells why there is none. The loads are one for all
    speeds, or one for each.
    """
    searched = (
        not (port.is_warming(reaction) or states_rest(reaction)) and port.freedoms_of(reaction) == PLANAR
    )
    call = port.compiled_force(reaction) if searched and port.clearance_of(reaction) < math.inf else None
    if call is None or not speeds:
        return [None] * len(speeds)
    each = [loads[k % len(loads)] for k in range(len(speeds))]
    first = _target(reaction, each[0], speeds[0], told=True)
    told = np.array([(*(-load).tolist(), speed) for load, speed in zip(each, speeds, strict=True)])
    places = (type(first.struct) * len(speeds))()
    rows = np.frombuffer(places, dtype=_row())
    rows[:] = np.frombuffer(first.struct, dtype=rows.dtype)
    rows["force"], rows["speed"] = told[:, :2], told[:, 2]
    rows["lead"] = np.copysign(_FIRST_ANGLE, told[:, 2])
    if hasattr(reaction, "force_noise"):
        rows["noise"] = [port.force_noise(reaction, speed) for speed in speeds]
    if hasattr(reaction, "rest_place"):
        near = [
            port.rest_place(reaction, tuple(load), speed) for load, speed in zip(each, speeds, strict=True)
        ]
        rows["near"] = [(math.nan, math.nan) if one is None else one for one in near]
    points = (structure("rf_static_point") * len(speeds))()
    loops()["rf_static_places"](places, len(speeds), points)
    return [
        _result(reaction, load, first._replace(struct=place), point)
        if point.found and point.status == Status.OK and not point.unstable
        else None
        for load, place, point in zip(each, places, points, strict=True)
    ]


@cache
def _row() -> np.dtype[Any]:
    return np.dtype(structure("rf_static_target"))


def _found(reaction: Any, load: Array, speed: float) -> Equilibrium:
    """Return the equilibrium of checked arguments."""
    if port.is_warming(reaction):
        return _warm(reaction, load, speed)
    following = states_rest(reaction)
    film: Any = quasi_static(reaction)
    if port.freedoms_of(film) != PLANAR or not port.clearance_of(film) < math.inf:
        return _without_circle(film, load, speed)
    target = _target(film, load, speed, following=following, told=True)
    # A state that the search only passes through is nobody's answer; that of the result is warned of.
    quiet = nullcontext() if target.is_compiled else _quietly()
    with quiet:
        best = search_place(target)
        if following and not best.found:
            best = continued_place(target, best)
    if not (best.found or (following and best.imbalance <= _AT_A_KINK)):
        raise EquilibriumError(_why_not(load, target, best))
    found = _result(film, load, target, best)
    if not found.residual <= port.MOST_LEFT:
        raise EquilibriumError(_not_found(load, speed, found.residual))
    if best.unstable:
        warn_user(UNSTABLE.format(found.position.tolist(), speed))
    tell = getattr(film, "completed", None)
    return found if tell is None else tell(found)


def _quietly() -> warnings.catch_warnings[None]:
    return warnings.catch_warnings(action="ignore", category=ValidityWarning)


_AT_A_KINK = 1e-8
"""Imbalance, over the load, at which a search may end where the force has a kink, as where a pad begins to
carry: Newton's method does not get closer there, and the result tells what is left."""

_ENOUGH, _BACK, _PLACES = 1e-12, 40, 60
"""Imbalance, over the load, that is sought; halvings of a step, and steps."""


def _without_circle(reaction: Any, load: Array, speed: float) -> Equilibrium:
    """Return the equilibrium of a reaction with other freedoms than x, y, or without a clearance.

    Newton's method from the middle, or from where the reaction says; forces and moments are compared as
    work along the nominal places of the freedoms.
    """
    n = len(load)
    way = np.array([signal.nominal for signal in reaction.inputs[:n]])
    told = port.rest_place(reaction, load.tolist(), speed)
    place, still = np.zeros(n) if told is None else np.asarray(told, dtype=float), np.zeros(n)

    def left(at: Array) -> Array:
        return port.static_force(reaction, at, still, speed) + load

    force = load if load.any() else np.array([signal.nominal for signal in reaction.outputs[:n]])
    size, steps = float(np.linalg.norm(force * way)), 0
    missing = left(place)
    while float(np.linalg.norm(missing * way)) > _ENOUGH * size and steps < _PLACES:
        slopes = port.static_slopes(reaction, place, still, speed)[:, :n]
        step = np.linalg.lstsq(slopes * np.outer(way, way), -missing * way, rcond=1e-14)[0] * way
        for halving in range(_BACK):
            trial = place + 0.5**halving * step
            with suppress(FilmContactError, ConvergenceError, EquilibriumError, InputError):
                other = left(trial)
                if np.linalg.norm(other * way) < np.linalg.norm(missing * way):
                    place, missing, steps = trial, other, steps + 1
                    break
        else:
            break
    imbalance = float(np.linalg.norm(missing * way)) / size
    if not imbalance <= max(
        _ENOUGH, min(port.force_noise(reaction, speed) * way.max() / max(size, 1e-300), port.MOST_LEFT)
    ):
        raise EquilibriumError(_not_found(load, speed, imbalance))
    clearance = port.clearance_of(reaction)
    if clearance < math.inf and not port.relative_film(reaction, place) > 0.0:
        raise EquilibriumError(
            f"load must be one that the reaction carries at speed {speed!r} rad/s inside its clearance "
            f"{clearance:.6g} m, got load {load.tolist()}, which would move the journal to {place.tolist()} m"
        )
    slopes = port.static_slopes(reaction, place, still, speed)[:, :n] * np.outer(way, way)
    if np.linalg.eigvals(slopes).real.max() > _NEUTRAL_SLOPE * np.abs(slopes).max():
        warn_user(UNSTABLE.format(place.tolist(), speed))
    found = _told(reaction, place, load, speed, imbalance, steps)
    tell = getattr(reaction, "completed", None)
    return found if tell is None else tell(found)


def _told(
    reaction: Any, place: Array, load: Array, speed: float, imbalance: float, steps: int
) -> Equilibrium:
    """Return a place of any freedoms as an equilibrium."""
    freedoms, clearance = port.freedoms_of(reaction), port.clearance_of(reaction)
    planar = freedoms[:2] == PLANAR
    distance = math.hypot(
        *(part for name, part in zip(freedoms, place.tolist(), strict=True) if name in PLANAR)
    )
    angle = 0.0
    if planar and distance and np.any(load[:2]):
        turned = math.atan2(place[1], place[0]) - math.atan2(load[1], load[0])
        angle = math.remainder(math.copysign(1.0, speed) * turned, 2.0 * math.pi)
    return Equilibrium(
        position=place,
        speed=speed,
        load=load,
        eccentricity_ratio=distance / clearance,
        attitude_angle=angle,
        minimum_film=float(port.minimum_film(reaction, place)),
        residual=imbalance,
        iterations=steps,
        reaction=reaction,
    )


def _warm(bearing: Any, load: Array, speed: float) -> Equilibrium:
    """Return the equilibrium at the temperature at which the heat balances.

    A warmer film is thinner and leaks more: the temperature of the balance falls while that of the film
    rises, so that there is one root, between the coldest film and about what that one warms to.
    """
    if bearing.balanced() is not None:
        at = _found(bearing.balanced(), load, speed)
        temperature = bearing.balanced_temperature(at.position, np.zeros(2), speed)
        return replace(at, temperature=temperature, reaction=bearing.at_temperature(temperature))
    from scipy.optimize import brentq

    films, steps = cache(bearing.at_temperature), 0
    scales = getattr(bearing, "scales_with_viscosity", False)
    cold = scales and _target(quasi_static(bearing.fresh), load, speed, following=True, told=True)

    def rest(temperature: float) -> tuple[Array, int]:
        if cold:
            # The film of the coldest oil rests there too, under a load that is larger as it is thicker.
            thicker = bearing.fresh.film_viscosity / float(bearing.oil.law.viscosity(temperature))
            cold.struct.force[:] = (-thicker * load).tolist()
            point = search_place(cold)
            if point.found:
                cold.struct.near[:] = point.position
                return np.array(point.position), point.steps
        at = _found(films(temperature), load, speed)
        return at.position, at.iterations

    @cache
    def excess(temperature: float) -> float:
        nonlocal steps
        try:
            position, taken = rest(temperature)
        except EquilibriumError as error:
            if not steps:
                raise
            raise EquilibriumError(
                f"load must be carried by a film that its own heat warms, but at {temperature:.4g} K no film "
                f"carries it: {error}"
            ) from error
        steps += taken
        if cold:
            warmer = bearing.balanced_temperature(position, np.zeros(2), speed) - temperature
        else:  # not the balance of each place, which is a search of its own
            warmer = films(temperature).next_temperature(position, speed) - temperature
        return warmer if abs(warmer) > _KELVIN else 0.0

    low = bearing.coldest()
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        if (rise := excess(low)) > 0.0:
            # Openings make the temperature of the balance rise a little with that of the film: go on a tenth
            # beyond where the line through the last two temperatures balances.
            while (left := excess(low + rise)) > 0.0:
                share = left / max(excess(low) - left, left)
                low, rise = low + rise, 1.1 * share * rise
            low = brentq(excess, low, low + rise, xtol=_KELVIN, rtol=8.9e-16)
    port.optional(bearing, "require_liquid", low)
    at = _found(films(low), load, speed)  # once more, for what it has to warn of
    return replace(at, temperature=low, iterations=steps, reaction=films(low))


def checked_load(load: ArrayLike) -> Array:
    """Return a static load as an array, shape (2,) [N]; raise InputError where it breaks a rule."""
    array = require_finite("load", load)
    if array.ndim == 0:
        raise InputError(
            "load must be the components (x, y) of the force on the journal, as load="
            f"(0, {-abs(float(array)):g}) for a magnitude downward, got {float(array):g}"
        )
    if not require_pair("load", array).any():
        raise InputError(f"load must not be zero, got [0, 0]: {UNLOADED}")
    return array


def _result(reaction: Any, load: Array, target: StaticTarget, point: Any) -> Equilibrium:
    position, speed, residual = np.array(point.position[:]), target.struct.speed, point.imbalance
    if not target.is_compiled or point.status != Status.OK or hasattr(reaction, "completed"):
        # A force in Python, or one beyond its map, is asked once more for what it has to warn of.
        force = reaction.force(position, np.zeros(2), speed)
        residual = math.hypot(*(force + load)) / target.size
    angle = math.copysign(1.0, speed) * (point.phi - math.atan2(load[1], load[0]))
    return Equilibrium(
        position=position,
        speed=speed,
        load=load,
        eccentricity_ratio=1.0 / (1.0 + math.exp(-point.s)),
        attitude_angle=math.remainder(angle, 2.0 * math.pi),
        # In a circle from s, which has its digits near the wall.
        minimum_film=float(reaction.minimum_film(position))
        if port.has_wall(reaction)
        else target.struct.clearance / (1.0 + math.exp(point.s)),
        residual=residual,
        iterations=point.steps,
        reaction=reaction,
    )


def _why_not(load: Array, target: StaticTarget, best: Any) -> str:
    """Return the message that names the load, the rule it breaks, and the film force at the limit."""
    speed = target.struct.speed
    if math.isfinite(best.norm) and not has_force_against(target):
        return (
            f"load must be one that the film can push against: at speed {speed!r} rad/s it has no force in "
            f"the opposite direction, got load {load.tolist()} N"
        )
    given = f"got load {load.tolist()} N with |load| = {math.hypot(*load):.6g} N"
    if not math.isfinite(best.norm):
        why = _no_force(target)
        return (
            f"speed must let the film carry the load: at speed {speed!r} rad/s it carries none, {given}{why}"
        )
    if best.s > LARGEST_S - 1e-12 and best.ratio < 0.0:
        limit = math.exp(best.ratio) * math.hypot(*load)
        return (
            f"load must be within the film's capacity at speed {speed!r} rad/s: the film force at "
            f"eccentricity ratio {MAXIMUM_ECCENTRICITY} is {limit:.6g} N, {given}"
        )
    if best.ratio < 0.0 and abs(best.angle) < _ALONG and math.exp(-best.s) < _NEAR_WALL:
        # As on pads, which touch before the journal has used all of its room.
        return (
            f"load must be within the film's capacity at speed {speed!r} rad/s: the largest film force found "
            f"is {math.exp(best.ratio) * math.hypot(*load):.6g} N, at {list(best.position)} m, {given}"
        )
    left = best.unavoidable
    if best.imbalance <= left:
        return (
            f"load must stand out from the roundoff of the film's forces at speed {speed!r} rad/s, which "
            f"leaves {left * target.size:.3g} N, {given}"
        )
    return _not_found(load, speed, best.imbalance)


def _no_force(target: StaticTarget) -> str:
    """Return why a centered film has no force with its derivatives, for a message; empty where it has one."""
    try:
        with _quietly():
            port.prepared_tangent(target.film)(0.0, 0.0, 0.0, 0.0, target.struct.speed)
    except UndefinedDerivativeError as error:
        return f": {error}"
    except _NO_FORCE:
        pass
    return ""


def _not_found(load: Array, speed: float, imbalance: float) -> str:
    return (
        f"load must have a static equilibrium at speed {speed!r} rad/s, and the search found none: the least "
        f"imbalance found is {imbalance:.3g} of the load, got load {load.tolist()} N with |load| = "
        f"{math.hypot(*load):.6g} N"
    )


# The search for the place at which a film has a given force, in the C library (native/loops/static_place.h).


MAXIMUM_ECCENTRICITY = 0.9999
"""Eccentricity ratio beyond which a load counts as more than the film can carry."""

LARGEST_S = math.log(MAXIMUM_ECCENTRICITY / (1.0 - MAXIMUM_ECCENTRICITY))

_DIRECTIONS, _FAR = 24, (0.3, 0.7, 0.95, 0.999)
_ALIKE, _OPPOSITE = 1e-9, math.pi - 1e-6
_NEUTRAL_SLOPE = 1e-6
_NEWTON_STEPS = 60
_ACROSS = (0.1, 0.2, 0.4, 0.8)
_LESS = 1.4

_NO_FORCE = (UndefinedDerivativeError, FilmContactError, ConvergenceError, EquilibriumError)
"""What a film raises at a state that the search passes over."""


class StaticTarget(NamedTuple):
    """What the search looks for: an rf_static_target, the film, and its force behind an address."""

    struct: Any
    film: Any
    call: FilmCall
    is_compiled: bool

    @property
    def size(self) -> float:
        """Size of the force that the film must have [N]."""
        return math.hypot(*self.struct.force)

    def at(self, s: float, phi: float) -> Any:
        """Return the rf_static_point of one trial."""
        return self._asked("rf_static_trial", s, phi, 0)

    def newton(self, s: float, phi: float, most: int = _NEWTON_STEPS) -> Any:
        """Return the point to which so many steps of Newton's method lead."""
        return self._asked("rf_static_newton", s, phi, most)

    def _asked(self, function: str, s: float, phi: float, count: int) -> Any:
        point = structure("rf_static_point")()
        if loops()[function](byref(self.struct), s, phi, count, byref(point)):
            self.fail(point)
        return point

    def fail(self, point: Any) -> None:
        """Raise what the film fails with at a point of the search."""
        if self.call.raised:
            raise self.call.raised[0]
        x, y = point.position
        port.prepared_tangent(self.film)(x, y, 0.0, 0.0, self.struct.speed)


def _target(
    film: Any, load: Array, speed: float, *, following: bool = False, told: bool = False
) -> StaticTarget:
    """Return what the search looks for; pads that are `following` take no journal aside.

    A film that has `told` is asked what room there is, what roundoff leaves of its force, and where the
    journal rests.
    """
    call, x, y = port.compiled_force(film), float(load[0]), float(load[1])
    near = port.rest_place(film, (x, y), speed) if told else None
    used = call or _called_back(film)
    kind: Any = structure("rf_static_target")
    struct = kind(
        used.address,
        used.data,
        film.clearance,
        min(port.relative_film(film, np.zeros(2)), 1.0) if told else 1.0,
        math.copysign(_FIRST_ANGLE, speed) if told and not following else 0.0,
        port.force_noise(film, speed) if told else 0.0,
        speed,
        (-x, -y),
        (math.nan, math.nan) if near is None else tuple(near),
    )
    return StaticTarget(struct, film, used, call is not None)


def _called_back(film: Any) -> FilmCall:
    """Return the force of a film in Python for the search, which ends at an error that says more."""
    raised: list[BaseException] = []
    tangent = port.prepared_tangent(film)

    def answer(_: Any, state: Any, force: Any, slopes: Any) -> int:
        try:
            force[0], force[1], ten = tangent(*state[:5])
            memmove(slopes, (c_double * 10)(*ten), 80)
        except _NO_FORCE:
            return Status.UNDEFINED
        except BaseException as error:
            raised[:] = [error]
            return Status.NOT_FINITE
        return Status.OK

    return FilmCall.of_python(answer, raised)


def search_place(target: StaticTarget) -> Any:
    """Return the first converged rf_static_point, or the best of all starts."""
    point = structure("rf_static_point")()
    if loops()["rf_static_places"](byref(target.struct), 1, byref(point)):
        target.fail(point)
    return point


def continued_place(target: StaticTarget, best: Any) -> Any:
    """Return the point of a load that one pad carries nearly alone, by loads that pull less and less across.

    There the film holds the journal in one direction only, and nothing tells Newton's method how far across
    the next pad begins, whose load grows as the root of the way.
    """
    if not math.isfinite(best.norm) or (best.s > LARGEST_S - 1e-12 and best.ratio < 0.0):
        return best
    x, y = target.struct.force
    fx, fy = best.force
    left = math.hypot(x - fx, y - fy)

    def pulled(size: float) -> StaticTarget:
        more = size / left - 1.0
        struct = type(target.struct).from_buffer_copy(target.struct)
        struct.force[:] = x + more * (x - fx), y + more * (y - fy)
        return target._replace(struct=struct)

    for share in _ACROSS:
        across = share * target.size
        if across <= left:  # the load itself, whose search has failed
            continue
        point = search_place(pulled(across))
        while across > left and point.found:
            across = max(across / _LESS, left)
            point = pulled(across).newton(point.s, point.phi)
        if across == left and point.found:
            return point
    return best


def _start_at(target: StaticTarget, x: float, y: float) -> tuple[float, float]:
    chi = math.hypot(x, y) / target.struct.clearance or 1e-300
    return math.log(chi / (1.0 - chi)) if chi < MAXIMUM_ECCENTRICITY else LARGEST_S, math.atan2(y, x)


def has_force_against(target: StaticTarget) -> bool:
    """Return whether forces of the film, wherever the journal is, span the direction that the load needs.

    They are looked at in many places. A force in that direction needs one on either side of it, less than
    half a turn apart: the pads of a gap push the journal out of it together, a pad alone pushes it away.
    """
    sides = [-math.inf, math.inf]
    for share in _FAR:
        chi = share * min(target.struct.relative_clearance, MAXIMUM_ECCENTRICITY)
        for k in range(_DIRECTIONS):
            at = target.at(math.log(chi / (1.0 - chi)), math.tau * k / _DIRECTIONS)
            if at.norm < math.inf:
                sides[0] = max(sides[0], at.angle if at.angle <= _ALIKE else -math.inf)
                sides[1] = min(sides[1], at.angle if at.angle >= -_ALIKE else math.inf)
                if sides[1] - sides[0] < _OPPOSITE:
                    return True
    return False


# The static equilibrium of a journal on a film whose temperature is a field.


MOST_ROUNDS = 60

LOST, COARSE = 0.1, 0.02
"""Distances over the clearance that the rest may move while film and heat are solved in turn, and that the
place of an answer which does not settle may be unsure by."""


@dataclass(frozen=True, kw_only=True)
class HeatedEquilibrium(Readable):
    """The static equilibrium of a journal on a film with a temperature field.

    Attributes
    ----------
    rest : Equilibrium
        Rest of the film at its frozen temperature.
    state : HeatedState
        Temperature, pressure, power and flow there; `coefficients(state.film, ...)` are those at frozen
        temperature.
    rounds : int
        Number of alternating solutions of film and heat.
    """

    rest: Equilibrium
    state: Any
    rounds: int


@one_blas_thread
@arguments
def heated_equilibrium(film: FieldFilm, load: ArrayLike, speed: float) -> HeatedEquilibrium:
    """Return the position at which a film with a temperature field balances a static load.

    The journal starts at the equilibrium of a film of fresh oil, or at the best position of a search in all
    directions. Position and temperature are relaxed together, and then solved in turn until both converge. A
    `ValidityWarning` is given for oil beyond its viscosity law, and for a film that is not laminar.

    Parameters
    ----------
    film : FieldFilm
        Film such as `HeatedFilm`.
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
            port.warn_of_flow(film, speed, mean, found.state.maximum_temperature)
            return found
    raise EquilibriumError(
        f"load must be one that the warm film carries, got {load.tolist()} N at {speed:g} rad/s: film and "
        f"temperature have no common equilibrium. Fresh oil carries the load at {first.tolist()} m, but no "
        "position was found where the warm film that openings can feed carries it"
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
        "film and temperature have a common equilibrium only within the size of a cell: the position is "
        f"known to {off:.2g} of the clearance, and more cells make this smaller"
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

    def cold(self) -> Any:
        """Return the film at the viscosity of fresh oil."""

    def frozen(self, position: ArrayLike, speed: float, temperature: ArrayLike) -> Any:
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
    for place in _places(film, load, speed, first, warm):
        found = _approach(film, load, speed, place, fresh if place is first else warm)
        if found is not None:
            yield found


def _places(film: FieldFilm, load: Array, speed: float, first: Array, temperature: float) -> Iterator[Array]:
    yield first
    points = []
    clearance = float(film.bearing.clearance) * min(port.relative_film(film.bearing, np.zeros(2)), 1.0)
    for chi in SCANNED:
        for angle in np.linspace(0.0, 2.0 * math.pi, ANGLES, endpoint=False):
            place = chi * clearance * np.array([math.cos(angle), math.sin(angle)])
            target = _target(quasi_static(film.frozen(place, speed, temperature)), load, speed)
            points.append(target.at(*_start_at(target, *place)))
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
        target = _target(quasi_static(state.film), load, speed)
        point, moved = _stepped(target, place, share * _STEP)
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


def _stepped(target: StaticTarget, place: Array, longest: float) -> tuple[Any, Array]:
    """Return the residual at a place, and where one step of limited length leads from there."""
    s, phi = _start_at(target, *place)
    here = target.at(s, phi)
    there = target.newton(s, phi, most=1)
    way = max(abs(there.s - s), abs(there.phi - phi))
    if way > longest:
        part = longest / way
        there = target.at(s + part * (there.s - s), phi + part * (there.phi - phi))
    return here, np.array(there.position) if math.isfinite(there.norm) else place
