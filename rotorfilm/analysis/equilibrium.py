"""The static equilibrium of a journal under a constant load."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import (
    ConvergenceError,
    EquilibriumError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    ValidityWarning,
    require_finite,
    require_number,
    require_pair,
    warn_user,
)
from ..core.inputs import arguments
from ..core.model import Array
from ..core.port import (
    MOST_LEFT,
    Reaction,
    Tangent,
    clearance_of,
    force_noise,
    freedoms_of,
    has_wall,
    is_warming,
    minimum_film,
    prepared_tangent,
    quasi_static,
    relative_film,
    require_place,
    require_reaction,
    rest_place,
    states_rest,
    static_force,
    static_slopes,
    warn_of_flow,
    warn_of_load,
)
from ..core.readable import Readable
from ..core.results import Equilibrium
from ..core.signals import PLANAR
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
def equilibrium(reaction: Reaction, load: ArrayLike, speed: float) -> Equilibrium:
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
        of large forces, as on preloaded pads or balls, roundoff leaves up to 1e-6 |load|. For tilting pads it
        is a `PadEquilibrium`. A `ValidityWarning` is given for a film beyond its map, for a temperature
        beyond the viscosity law of the oil, and for a mean pressure |load|/(2 radius length) above half of
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
    require_reaction("reaction", reaction, heavy=True)
    freedoms = freedoms_of(reaction)
    load = checked_load(load) if freedoms == PLANAR else require_place(reaction, load, "load")
    speed = require_number("speed", speed)
    found = _found(reaction, load, speed)
    warn_of_load(reaction, load)
    warn_of_flow(reaction, speed, found.temperature)
    return found


def _found(reaction: Any, load: Array, speed: float) -> Equilibrium:
    """Return the equilibrium of checked arguments."""
    if is_warming(reaction):
        return _warm(reaction, load, speed)
    following = states_rest(reaction)
    film: Any = quasi_static(reaction)
    if freedoms_of(film) != PLANAR or not clearance_of(film) < math.inf:
        return _without_circle(film, load, speed)
    relative_clearance = min(relative_film(film, np.zeros(2)), 1.0)
    lead = 0.0 if following else math.copysign(_FIRST_ANGLE, speed)  # pads that follow take no journal aside
    x, y = -float(load[0]), -float(load[1])
    near = rest_place(film, (-x, -y), speed)
    target = StaticTarget(
        prepared_tangent(film),
        film.clearance,
        speed,
        x,
        y,
        relative_clearance,
        lead,
        force_noise(film, speed),
        near,
    )
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        # A state that the search only passes through is nobody's answer; that of the result is warned of.
        best = search_place(target)
        if following and not is_found(target, best):
            best = continued_place(target, best)
    if not is_found(target, best):
        raise EquilibriumError(_why_not(load, target, best))
    found = _result(film, load, target, best)
    if not found.residual <= MOST_LEFT:
        raise EquilibriumError(_not_found(load, speed, found.residual))
    if is_unstable(best):
        warn_user(UNSTABLE.format(list(best.position), speed))
    tell = getattr(film, "completed", None)
    return found if tell is None else tell(found)


_ENOUGH, _BACK, _PLACES = 1e-12, 40, 60
"""Imbalance, over the load, that is sought; halvings of a step, and steps."""


def _without_circle(reaction: Any, load: Array, speed: float) -> Equilibrium:
    """Return the equilibrium of a reaction with other freedoms than x, y, or without a clearance.

    Newton's method from the middle, or from where the reaction says; forces and moments are compared as
    work along the nominal places of the freedoms.
    """
    n = len(load)
    way = np.array([signal.nominal for signal in reaction.inputs[:n]])
    told = rest_place(reaction, load.tolist(), speed)
    place, still = np.zeros(n) if told is None else np.asarray(told, dtype=float), np.zeros(n)

    def left(at: Array) -> Array:
        return static_force(reaction, at, still, speed) + load

    force = load if load.any() else np.array([signal.nominal for signal in reaction.outputs[:n]])
    size, steps = float(np.linalg.norm(force * way)), 0
    missing = left(place)
    while float(np.linalg.norm(missing * way)) > _ENOUGH * size and steps < _PLACES:
        slopes = static_slopes(reaction, place, still, speed)[:, :n]
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
        _ENOUGH, min(force_noise(reaction, speed) * way.max() / max(size, 1e-300), MOST_LEFT)
    ):
        raise EquilibriumError(_not_found(load, speed, imbalance))
    if clearance_of(reaction) < math.inf and not relative_film(reaction, place) > 0.0:
        raise EquilibriumError(
            f"load must be within what the reaction carries at speed {speed!r} rad/s inside its clearance "
            f"{clearance_of(reaction):.6g} m, got load {load.tolist()}, which takes it to {place.tolist()}"
        )
    slopes = static_slopes(reaction, place, still, speed)[:, :n] * np.outer(way, way)
    if np.linalg.eigvals(slopes).real.max() > _NEUTRAL_SLOPE * np.abs(slopes).max():
        warn_user(UNSTABLE.format(place.tolist(), speed))
    found = _told(reaction, place, load, speed, imbalance, steps)
    tell = getattr(reaction, "completed", None)
    return found if tell is None else tell(found)


def _told(
    reaction: Any, place: Array, load: Array, speed: float, imbalance: float, steps: int
) -> Equilibrium:
    """Return a place of any freedoms as an equilibrium."""
    freedoms, clearance = freedoms_of(reaction), clearance_of(reaction)
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
        minimum_film=float(minimum_film(reaction, place)),
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

    warmed: dict[float, Equilibrium] = {}

    def excess(temperature: float) -> float:
        warmed[temperature] = at = _found(bearing.at_temperature(temperature), load, speed)
        warmer = bearing.balanced_temperature(at.position, np.zeros(2), speed) - temperature
        return warmer if abs(warmer) > _KELVIN else 0.0

    low = bearing.coldest()
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        rise = excess(low)
        if rise > 0.0:
            # Openings make the temperature of the balance rise a little with that of the film.
            while excess(low + rise) > 0.0:
                rise *= 2.0
            low = brentq(excess, low, low + rise, xtol=_KELVIN, rtol=8.9e-16)
    steps = sum(one.iterations for one in warmed.values())
    at = _found(bearing.at_temperature(low), load, speed)  # once more, for what it has to warn of
    return replace(at, temperature=low, iterations=steps, reaction=bearing.at_temperature(low))


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


def _result(reaction: Any, load: Array, target: StaticTarget, point: StaticPoint) -> Equilibrium:
    position = np.array(point.position)
    force = reaction.force(position, np.zeros(2), target.speed)
    angle = math.copysign(1.0, target.speed) * (point.phi - math.atan2(-target.y, -target.x))
    return Equilibrium(
        position=position,
        speed=target.speed,
        load=load,
        eccentricity_ratio=1.0 / (1.0 + math.exp(-point.s)),
        attitude_angle=math.remainder(angle, 2.0 * math.pi),
        minimum_film=_minimum_film(reaction, target, point),
        residual=math.hypot(*(force + load)) / target.size,
        iterations=point.steps,
        reaction=reaction,
    )


def _minimum_film(reaction: Any, target: StaticTarget, point: StaticPoint) -> float:
    """Return the least film [m]; in a circle from s, which has its digits near the wall."""
    if has_wall(reaction):
        return float(reaction.minimum_film(point.position))
    return target.clearance / (1.0 + math.exp(point.s))


def _why_not(load: Array, target: StaticTarget, best: StaticPoint) -> str:
    """Return the message that names the load, the rule it breaks, and the film force at the limit."""
    speed = target.speed
    if math.isfinite(best.norm) and not has_force_against(target):
        return (
            f"load must be one that the film can push against: at speed {speed!r} rad/s it has no force in "
            f"the opposite direction, got load {load.tolist()} N"
        )
    given = f"got load {load.tolist()} N with |load| = {math.hypot(*load):.6g} N"
    if not math.isfinite(best.norm):
        return f"speed must let the film carry the load: at speed {speed!r} rad/s it carries none, {given}"
    if best.s == LARGEST_S and best.ratio < 0.0:
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
    left = unavoidable(target, best)
    if best.imbalance <= left:
        return (
            f"load must stand out from the roundoff of the film's forces at speed {speed!r} rad/s, which "
            f"leaves {left * target.size:.3g} N, {given}"
        )
    return _not_found(load, speed, best.imbalance)


def _not_found(load: Array, speed: float, imbalance: float) -> str:
    return (
        f"load must have a static equilibrium at speed {speed!r} rad/s, and the search found none: the least "
        f"imbalance found is {imbalance:.3g} of the load, got load {load.tolist()} N with |load| = "
        f"{math.hypot(*load):.6g} N"
    )


# Newton's method for the place at which a film has a given force, and the loads that it has no slope for.


MAXIMUM_ECCENTRICITY = 0.9999
"""Eccentricity ratio beyond which a load counts as more than the film can carry."""

LARGEST_S = math.log(MAXIMUM_ECCENTRICITY / (1.0 - MAXIMUM_ECCENTRICITY))

_TOLERANCE = 1e-12
_ROUNDOFF_STOP = 1e-13
_ROUNDOFF = 1e-15  # of a place, in clearances
_LARGEST_LOG = 300.0
_DIRECTIONS, _FAR = 24, (0.3, 0.7, 0.95, 0.999)
_ALIKE, _OPPOSITE = 1e-9, math.pi - 1e-6
_NEUTRAL_SLOPE = 1e-6
_NEWTON_STEPS = 60
_NEUTRAL = 1e-11
_LARGEST_MOVE = (6.0, 1.0)
_HALVINGS = (
    26  # the load of a tilting pad begins as the root of the way: steps beyond its edge are far too long
)
_ACROSS = (0.1, 0.2, 0.4, 0.8)
_LESS = 1.4


class StaticTarget(NamedTuple):
    """What the search looks for: the film in plain numbers, and the force that it must have."""

    tangent: Tangent
    clearance: float
    speed: float
    x: float
    y: float
    relative_clearance: float
    lead: float  # of the first trial, from the load on
    noise: float = 0.0  # force that roundoff leaves [N]
    near: tuple[float, float] | None = None  # where the film says that it is [m]

    @property
    def size(self) -> float:
        """Size of that force [N]."""
        return math.hypot(self.x, self.y)


class StaticPoint(NamedTuple):
    """A trial solution (s, phi): position, residual (ratio, angle) and its derivatives, row by row."""

    s: float
    phi: float
    steps: int
    position: tuple[float, float] = (math.nan, math.nan)
    ratio: float = math.inf
    angle: float = 0.0
    matrix: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    slopes: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)  # of the force by the position [N/m]

    @property
    def norm(self) -> float:
        """Size of the residual [1]."""
        return math.hypot(self.ratio, self.angle)

    @property
    def imbalance(self) -> float:
        """|film force + load| / |load| [1]; of the logarithm, so that small ones keep their digits."""
        if not self.norm < math.inf:
            return math.inf
        ratio = min(self.ratio, _LARGEST_LOG)
        return math.hypot(math.expm1(ratio), 2.0 * math.exp(0.5 * ratio) * math.sin(0.5 * self.angle))


def search_place(target: StaticTarget) -> StaticPoint:
    """Return the first converged point, or the best of all starts."""
    points = []
    for s, phi in _starts(target):
        points.append(_newton(target, s, phi))
        if is_found(target, points[-1]):
            return points[-1]
    return min(points, key=lambda point: point.norm)


def continued_place(target: StaticTarget, best: StaticPoint) -> StaticPoint:
    """Return the point of a load that one pad carries nearly alone, by loads that pull less and less across.

    There the film holds the journal in one direction only, and nothing tells Newton's method how far across
    the next pad begins, whose load grows as the root of the way.
    """
    if not math.isfinite(best.norm):
        return best
    fx, fy, _ = target.tangent(*best.position, 0.0, 0.0, target.speed)
    left = math.hypot(target.x - fx, target.y - fy)

    def pulled(size: float) -> StaticTarget:
        more = size / left - 1.0
        return target._replace(x=target.x + more * (target.x - fx), y=target.y + more * (target.y - fy))

    for share in _ACROSS:
        across = max(share * target.size, left)
        point = search_place(pulled(across))
        while across > left and is_found(target, point):
            across = max(across / _LESS, left)
            point = _newton(pulled(across), point.s, point.phi)
        if across == left and is_found(target, point):
            return point
    return best


def _starts(target: StaticTarget) -> list[tuple[float, float]]:
    """Return starting points (s, phi); half of the way to the wall is enough for most films."""
    along_load, half = (
        math.atan2(-target.y, -target.x),
        math.log(target.relative_clearance / (2.0 - target.relative_clearance)),
    )
    turns = [k * math.pi / 3.0 for k in range(6)]
    told = [] if target.near is None else [_start_at(target, *target.near)]
    first = (half, along_load + target.lead)
    return [*told, first, *((s, along_load + turn) for s in (half - 2.0, half + 2.0) for turn in turns)]


def _start_at(target: StaticTarget, x: float, y: float) -> tuple[float, float]:
    chi = math.hypot(x, y) / target.clearance or 1e-300
    return math.log(chi / (1.0 - chi)) if chi < MAXIMUM_ECCENTRICITY else LARGEST_S, math.atan2(y, x)


def _newton(target: StaticTarget, s: float, phi: float, most: int = _NEWTON_STEPS) -> StaticPoint:
    point = _point(target, s, phi, 0)
    while point.steps < most and _ROUNDOFF_STOP < point.norm < math.inf:
        a, b, c, d = point.matrix
        det, size = a * d - b * c, a * a + b * b + c * c + d * d or 1.0
        step_s, step_phi = b * point.angle - d * point.ratio, c * point.ratio - a * point.angle
        if abs(det) < _NEUTRAL * size:  # nothing holds the journal in one direction: the shortest step
            det, step_s = -size, a * point.ratio + c * point.angle
            step_phi = b * point.ratio + d * point.angle
        improved = _damped(target, point, step_s / det, step_phi / det)
        if improved is None:
            break
        point = improved
    return point


def _damped(target: StaticTarget, point: StaticPoint, step_s: float, step_phi: float) -> StaticPoint | None:
    """Return the first of ever shorter steps that lowers the residual, or None."""
    share = min(
        1.0, _LARGEST_MOVE[0] / max(abs(step_s), 1e-300), _LARGEST_MOVE[1] / max(abs(step_phi), 1e-300)
    )
    for halvings in range(_HALVINGS):
        part = 0.5**halvings * share
        s = min(point.s + part * step_s, LARGEST_S)
        trial = _point(target, s, point.phi + part * step_phi, point.steps + 1)
        if trial.norm < point.norm:
            return trial
    return None


def _point(target: StaticTarget, s: float, phi: float, steps: int) -> StaticPoint:
    """Return the residual at (s, phi), and d(residual)/d(s, phi) by the chain rule from dF/d(position)."""
    distance = target.clearance / (1.0 + math.exp(-s))
    x, y = distance * math.cos(phi), distance * math.sin(phi)
    try:
        fx, fy, D = target.tangent(x, y, 0.0, 0.0, target.speed)
    except (UndefinedDerivativeError, FilmContactError, ConvergenceError, EquilibriumError):
        return StaticPoint(s, phi, steps)
    size = math.hypot(fx, fy)
    if not 0.0 < size < math.inf:
        return StaticPoint(s, phi, steps)
    # d(position)/ds = (1 - chi) position, d(position)/dphi = position turned by 90 degrees
    gap = 1.0 / (1.0 + math.exp(s))
    x_s, y_s = gap * (D[0] * x + D[1] * y), gap * (D[5] * x + D[6] * y)
    x_phi, y_phi = D[1] * x - D[0] * y, D[6] * x - D[5] * y
    ux, uy = fx / size, fy / size
    return StaticPoint(
        s,
        phi,
        steps,
        (x, y),
        math.log(size / target.size),
        math.atan2(target.x * uy - target.y * ux, target.x * ux + target.y * uy),
        (
            (ux * x_s + uy * y_s) / size,
            (ux * x_phi + uy * y_phi) / size,
            (ux * y_s - uy * x_s) / size,
            (ux * y_phi - uy * x_phi) / size,
        ),
        (D[0], D[1], D[5], D[6]),
    )


def is_found(target: StaticTarget, point: StaticPoint) -> bool:
    """Return whether the film balances the load to 1e-12, or to what `unavoidable` leaves, within reason."""
    allowed = max(_TOLERANCE, unavoidable(target, point))
    return point.imbalance <= min(allowed, MOST_LEFT)


def unavoidable(target: StaticTarget, point: StaticPoint) -> float:
    """Return the imbalance that roundoff leaves of gap, place and force, over the load.

    Preloaded pads and balls press each other with forces of which a light load is the small difference.
    """
    gap = math.exp(min(point.ratio, _LARGEST_LOG)) * (1.0 + math.exp(point.s))
    place = target.clearance * max(abs(slope) for slope in point.slopes) / target.size
    return _ROUNDOFF * max(gap, place) + target.noise / target.size


def has_force_against(target: StaticTarget) -> bool:
    """Return whether forces of the film, wherever the journal is, span the direction that the load needs.

    They are looked at in many places. A force in that direction needs one on either side of it, less than
    half a turn apart: the pads of a gap push the journal out of it together, a pad alone pushes it away.
    """
    sides = [-math.inf, math.inf]
    for share in _FAR:
        chi = share * min(target.relative_clearance, MAXIMUM_ECCENTRICITY)
        for k in range(_DIRECTIONS):
            at = _point(target, math.log(chi / (1.0 - chi)), math.tau * k / _DIRECTIONS, 0)
            if at.norm < math.inf:
                sides[0] = max(sides[0], at.angle if at.angle <= _ALIKE else -math.inf)
                sides[1] = min(sides[1], at.angle if at.angle >= -_ALIKE else math.inf)
    return sides[1] - sides[0] < _OPPOSITE


def is_unstable(point: StaticPoint) -> bool:
    """Return whether the journal moves away from its place: d(force)/d(position) has a positive value."""
    a, b, c, d = point.slopes
    half, turn = 0.5 * (a + d), 0.25 * (a - d) ** 2 + b * c
    return turn >= 0.0 and half + math.sqrt(turn) > _NEUTRAL_SLOPE * max(map(abs, point.slopes))


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
            warn_of_flow(film, speed, mean, found.state.maximum_temperature)
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

    def cold(self) -> Any:
        """Return the film of fresh oil."""

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
    clearance = float(film.bearing.clearance) * min(relative_film(film.bearing, np.zeros(2)), 1.0)
    for chi in SCANNED:
        for angle in np.linspace(0.0, 2.0 * math.pi, ANGLES, endpoint=False):
            place = chi * clearance * np.array([math.cos(angle), math.sin(angle)])
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


def _target(film: Any, load: Array, speed: float) -> StaticTarget:
    x, y = -float(load[0]), -float(load[1])
    still = quasi_static(film)
    return StaticTarget(prepared_tangent(still), still.clearance, speed, x, y, 1.0, 0.0)
