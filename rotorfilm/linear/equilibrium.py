"""The static equilibrium of a journal under a constant load."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..bearings.contact_place import WalledReaction, relative_film
from ..errors import (
    EquilibriumError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    ValidityWarning,
    require_finite,
    require_number,
)
from ..inputs.kinds import arguments
from ..model import Array, JournalForce, Reaction, Tangent, prepared_tangent, require_reaction
from ..results import Equilibrium
from ..warming import Settling, Warming

MAXIMUM_ECCENTRICITY = 0.9999
"""Eccentricity ratio beyond which a load counts as more than the film can carry."""

UNLOADED = (
    "an unloaded journal has no attitude angle (for the centered journal use coefficients at position (0, 0))"
)
"""Why a load of zero has no equilibrium."""

_TOLERANCE = 1e-12
_KELVIN = 4e-12
_ROUNDOFF_STOP = 1e-13
_NEWTON_STEPS = 60
_NEUTRAL = 1e-11
_LARGEST_S = math.log(MAXIMUM_ECCENTRICITY / (1.0 - MAXIMUM_ECCENTRICITY))
_LARGEST_MOVE = (6.0, 1.0)
_FIRST_ANGLE = math.pi / 3.0


class _Target(NamedTuple):
    """What the search looks for: the film in plain numbers, and the force that it must have."""

    tangent: Tangent
    clearance: float
    speed: float
    x: float
    y: float
    room: float
    lead: float  # of the first trial, from the load on

    @property
    def size(self) -> float:
        return math.hypot(self.x, self.y)


class _Point(NamedTuple):
    """A trial solution (s, phi): position, residual (ratio, angle) and its derivatives, row by row."""

    s: float
    phi: float
    steps: int
    position: tuple[float, float] = (math.nan, math.nan)
    ratio: float = math.inf
    angle: float = 0.0
    matrix: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)

    @property
    def norm(self) -> float:
        return math.hypot(self.ratio, self.angle)


@arguments
def equilibrium(reaction: Reaction, load: ArrayLike, speed: float) -> Equilibrium:
    """Return the position at which the film balances a static load.

    Parameters
    ----------
    reaction : Reaction
        The film; it need not be isotropic. If its temperature is left to its heat, that is found too.
    load : array_like, shape (2,) [N]
        External static force on the journal, weight included; film force + load = 0.
    speed : float [rad/s]
        Angular speed about +z, of either sign.

    Returns
    -------
    Equilibrium
        With |film force + load| <= 1e-12 |load|, or what roundoff allows; of tilting pads a `PadEquilibrium`.

    Raises
    ------
    InputError
        If an argument is not finite or has the wrong shape, or the load is zero.
    EquilibriumError
        If the load is beyond what the film carries at eccentricity ratio 0.9999, if the film carries
        nothing (no wedge at zero speed), or if the search does not converge.

    Notes
    -----
    Newton's method with the exact Jacobian in s = log(chi / (1 - chi)), chi = |position| / clearance, and the
    angle phi of the position. The residual is (log(|F| / |load|), angle from -load to F). A film force grows
    as a power of chi near the center and of 1 - chi near the wall: the equations are nearly linear.
    """
    require_reaction("reaction", reaction, JournalForce, heavy=True)
    load = checked_load(load)
    speed = require_number("speed", speed)
    if isinstance(reaction, Warming) and reaction.is_warming:
        return _warm(reaction, load, speed)
    at_rest = reaction.at_rest() if isinstance(reaction, Settling) else None
    film: Any = at_rest or reaction
    room = min(relative_film(film, np.zeros(2)), 1.0)
    lead = 0.0 if at_rest else math.copysign(_FIRST_ANGLE, speed)  # pads that follow take no journal aside
    x, y = -float(load[0]), -float(load[1])
    target = _Target(prepared_tangent(film), film.clearance, speed, x, y, room, lead)
    with warnings.catch_warnings():
        # A state that the search only passes through is nobody's answer; that of the result is warned of.
        warnings.simplefilter("ignore", ValidityWarning)
        best = _search(target)
    if best.norm > _tolerance(best.s):
        raise EquilibriumError(_why_not(load, speed, best))
    found = _result(film, load, target, best)
    return found if at_rest is None else at_rest.settled(found)


def _warm(bearing: Warming, load: Array, speed: float) -> Equilibrium:
    """Return the equilibrium at the temperature at which the heat balances.

    A warmer film is thinner and leaks more: the temperature of the balance falls while that of the film
    rises, so that there is one root, between the coldest film and about what that one warms to.
    """
    if bearing.balanced() is not None:
        at = equilibrium(bearing.balanced(), load, speed)
        temperature = bearing.balanced_temperature(at.position, np.zeros(2), speed)
        return replace(at, temperature=temperature, reaction=bearing.at_temperature(temperature))
    from scipy.optimize import brentq

    warmed: dict[float, Equilibrium] = {}

    def excess(temperature: float) -> float:
        warmed[temperature] = at = equilibrium(bearing.at_temperature(temperature), load, speed)
        warmer = bearing.balanced_temperature(at.position, np.zeros(2), speed) - temperature
        return warmer if abs(warmer) > _KELVIN else 0.0

    low = bearing.coldest()
    rise = excess(low)
    if rise > 0.0:
        # Openings make the temperature of the balance rise a little with that of the film.
        while excess(low + rise) > 0.0:
            rise *= 2.0
        low = brentq(excess, low, low + rise, xtol=_KELVIN, rtol=8.9e-16)
    steps = sum(one.iterations for one in warmed.values())
    return replace(warmed[low], temperature=low, iterations=steps, reaction=bearing.at_temperature(low))


def checked_load(load: ArrayLike) -> Array:
    """Return a static load as an array, shape (2,) [N]; raise InputError where it breaks a rule."""
    array = require_finite("load", load)
    if array.shape != (2,):
        if array.ndim == 0:
            raise InputError(
                "load must be the components (x, y) of the force on the journal, as load="
                f"(0, {-abs(float(array)):g}) for a magnitude downward, got {float(array):g}"
            )
        raise InputError(f"load must have shape (2,), got shape {array.shape}")
    if not array.any():
        raise InputError(f"load must not be zero, got [0, 0]: {UNLOADED}")
    return array


def _search(target: _Target) -> _Point:
    """Return the first converged point, or the best of all starts."""
    points = []
    for s, phi in _starts(target):
        points.append(_newton(target, s, phi))
        if points[-1].norm <= _tolerance(points[-1].s):
            return points[-1]
    return min(points, key=lambda point: point.norm)


def _starts(target: _Target) -> list[tuple[float, float]]:
    """Return starting points (s, phi); the first, half of the way to the wall, is enough for most films."""
    along_load, half = math.atan2(-target.y, -target.x), math.log(target.room / (2.0 - target.room))
    turns = [k * math.pi / 3.0 for k in range(6)]
    first = (half, along_load + target.lead)
    return [first, *((s, along_load + turn) for s in (half - 2.0, half + 2.0) for turn in turns)]


def _newton(target: _Target, s: float, phi: float) -> _Point:
    point = _point(target, s, phi, 0)
    while point.steps < _NEWTON_STEPS and _ROUNDOFF_STOP < point.norm < math.inf:
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


def _damped(target: _Target, point: _Point, step_s: float, step_phi: float) -> _Point | None:
    """Return the first of ever shorter steps that lowers the residual, or None."""
    share = min(
        1.0, _LARGEST_MOVE[0] / max(abs(step_s), 1e-300), _LARGEST_MOVE[1] / max(abs(step_phi), 1e-300)
    )
    for halvings in range(10):
        part = 0.5**halvings * share
        s = min(point.s + part * step_s, _LARGEST_S)
        trial = _point(target, s, point.phi + part * step_phi, point.steps + 1)
        if trial.norm < point.norm:
            return trial
    return None


def _point(target: _Target, s: float, phi: float, steps: int) -> _Point:
    """Return the residual at (s, phi), and d(residual)/d(s, phi) by the chain rule from dF/d(position)."""
    distance = target.clearance / (1.0 + math.exp(-s))
    x, y = distance * math.cos(phi), distance * math.sin(phi)
    try:
        fx, fy, D = target.tangent(x, y, 0.0, 0.0, target.speed)
    except (UndefinedDerivativeError, FilmContactError):
        return _Point(s, phi, steps)
    size = math.hypot(fx, fy)
    if not 0.0 < size < math.inf:
        return _Point(s, phi, steps)
    # d(position)/ds = (1 - chi) position, d(position)/dphi = position turned by 90 degrees
    gap = 1.0 / (1.0 + math.exp(s))
    x_s, y_s = gap * (D[0] * x + D[1] * y), gap * (D[5] * x + D[6] * y)
    x_phi, y_phi = D[1] * x - D[0] * y, D[6] * x - D[5] * y
    ux, uy = fx / size, fy / size
    return _Point(
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
    )


def _tolerance(s: float) -> float:
    """Return the tolerance: 1e-12, or more where 1 - chi loses digits in the subtraction."""
    return max(_TOLERANCE, 1e-15 * (1.0 + math.exp(s)))


def _result(reaction: Reaction, load: Array, target: _Target, point: _Point) -> Equilibrium:
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


def _minimum_film(reaction: Reaction, target: _Target, point: _Point) -> float:
    """Return the least film [m]; in a circle from s, which has its digits near the wall."""
    if isinstance(reaction, WalledReaction):
        return float(reaction.minimum_film(point.position))
    return target.clearance / (1.0 + math.exp(point.s))


def _why_not(load: Array, speed: float, best: _Point) -> str:
    """Return the message that names the load, the rule it breaks, and the film force at the limit."""
    given = f"got load {load.tolist()} N with |load| = {math.hypot(*load):.6g} N"
    if not math.isfinite(best.norm):
        return f"speed must make the film carry load: at speed {speed!r} rad/s it carries none, {given}"
    if best.s == _LARGEST_S and best.ratio < 0.0:
        limit = math.exp(best.ratio) * math.hypot(*load)
        return (
            f"load must be within the film's capacity at speed {speed!r} rad/s: the film force at "
            f"eccentricity ratio {MAXIMUM_ECCENTRICITY} is {limit:.6g} N, {given}"
        )
    return (
        f"load must have a static equilibrium at speed {speed!r} rad/s, and the search found none: "
        f"the best residual is {best.norm:.3g}, {given}"
    )
