"""The static equilibrium of a journal under a constant load."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..errors import EquilibriumError, InputError, ValidityWarning, require_finite, require_number
from ..model import Array, Reaction
from ..results import Equilibrium

MAXIMUM_ECCENTRICITY = 0.9999
"""Eccentricity ratio beyond which a load counts as more than the film can carry."""

_TOLERANCE = 1e-12
_ROUNDOFF_STOP = 1e-13
_NEWTON_STEPS = 60
_LARGEST_S = math.log(MAXIMUM_ECCENTRICITY / (1.0 - MAXIMUM_ECCENTRICITY))
_LARGEST_STEP = np.array([6.0, 1.0])
_FIRST_ANGLE = math.pi / 3.0


class _Point(NamedTuple):
    """A trial solution z = (s, phi), its residual, and how many Newton steps led there."""

    z: Array
    residual: Array
    steps: int

    @property
    def norm(self) -> float:
        return float(np.hypot(*self.residual))


def equilibrium(reaction: Reaction, load: ArrayLike, speed: float) -> Equilibrium:
    """Return the position at which the film balances a static load.

    Parameters
    ----------
    reaction : Reaction
        The film; it need not be isotropic.
    load : array_like, shape (2,) [N]
        External static force on the journal, weight included; film force + load = 0.
    speed : float [rad/s]
        Angular speed about +z, of either sign.

    Returns
    -------
    Equilibrium
        With |film force + load| <= 1e-12 |load|, or what roundoff in the film thickness allows.

    Raises
    ------
    InputError
        If an argument is not finite or has the wrong shape, or the load is zero: an unloaded journal
        has no attitude angle.
    EquilibriumError
        If the load is beyond what the film carries at eccentricity ratio 0.9999, if the film carries
        nothing (no wedge at zero speed), or if the search does not converge.

    Notes
    -----
    Newton's method with the exact Jacobian in s = log(chi / (1 - chi)) and the angle phi of the position,
    chi = |position| / clearance. The residual is (log(|F| / |load|), angle from -load to F). A film force
    grows as a power of chi near the center and as a power of 1 - chi near the wall, so these equations
    are nearly linear all the way.
    """
    load = checked_load(load)
    speed = require_number("speed", speed)
    with warnings.catch_warnings():
        # A state that the search only passes through is nobody's answer; that of the result is warned of.
        warnings.simplefilter("ignore", ValidityWarning)
        best = _search(reaction, load, speed)
    if best.norm > _tolerance(best.z[0]):
        raise EquilibriumError(_why_not(reaction, load, speed, best))
    return _result(reaction, load, speed, best)


def checked_load(load: ArrayLike) -> Array:
    """Return a static load as an array, shape (2,) [N]; raise InputError where it breaks a rule."""
    array = require_finite("load", load)
    if array.shape != (2,):
        raise InputError(f"load must have shape (2,), got shape {array.shape}")
    if not array.any():
        raise InputError(
            "load must not be zero, got [0, 0]: an unloaded journal has no attitude angle "
            "(for the centered journal use coefficients at position (0, 0))"
        )
    return array


def _search(reaction: Reaction, load: Array, speed: float) -> _Point:
    """Return the first converged point, or the best of all starts."""
    points = []
    for start in _starts(load, speed):
        points.append(_newton(reaction, load, speed, start))
        if points[-1].norm <= _tolerance(points[-1].z[0]):
            return points[-1]
    return min(points, key=lambda point: point.norm)


def _starts(load: Array, speed: float) -> list[Array]:
    """Return starting points; an isotropic film needs the first only."""
    along_load = math.atan2(load[1], load[0])
    sense = math.copysign(1.0, speed)
    first = np.array([0.0, along_load + sense * _FIRST_ANGLE])
    turns = np.arange(6) * math.pi / 3.0
    return [first, *(np.array([s, along_load + turn]) for s in (-2.0, 2.0) for turn in turns)]


def _newton(reaction: Reaction, load: Array, speed: float, start: Array) -> _Point:
    point = _Point(start, _residual(reaction, load, speed, start), 0)
    while point.steps < _NEWTON_STEPS and _ROUNDOFF_STOP < point.norm < math.inf:
        matrix = _residual_jacobian(reaction, speed, point.z)
        if abs(np.linalg.det(matrix)) < 1e-14:
            break
        step = np.asarray(np.linalg.solve(matrix, -point.residual), dtype=np.float64)
        improved = _damped(lambda z: _residual(reaction, load, speed, z), point, step)
        if improved is None:
            break
        point = improved
    return point


def _damped(residual: Callable[[Array], Array], point: _Point, step: Array) -> _Point | None:
    """Return the first of ever shorter steps that lowers the residual, or None."""
    step = step * min(1.0, *(_LARGEST_STEP / np.maximum(np.abs(step), 1e-300)))
    for halvings in range(10):
        z = point.z + 0.5**halvings * step
        z[0] = min(z[0], _LARGEST_S)
        trial = _Point(z, residual(z), point.steps + 1)
        if trial.norm < point.norm:
            return trial
    return None


def _residual(reaction: Reaction, load: Array, speed: float, z: Array) -> Array:
    force = reaction.force(_position(reaction.clearance, z), np.zeros(2), speed)
    size = math.hypot(*force)
    if not 0.0 < size < math.inf:
        return np.array([math.inf, 0.0])
    unit, target = force / size, -load / math.hypot(*load)
    angle = math.atan2(target[0] * unit[1] - target[1] * unit[0], float(target @ unit))
    return np.array([math.log(size / math.hypot(*load)), angle])


def _residual_jacobian(reaction: Reaction, speed: float, z: Array) -> Array:
    """Return d(residual)/d(s, phi) by the chain rule from dF/d(position)."""
    position = _position(reaction.clearance, z)
    force = reaction.force(position, np.zeros(2), speed)
    by_position = reaction.jacobian(position, np.zeros(2), speed)[:, :2]
    # d(position)/ds = (1 - chi) position, d(position)/dphi = position turned by 90 degrees
    gap = 1.0 / (1.0 + math.exp(z[0]))
    moves = np.column_stack([gap * position, [-position[1], position[0]]])
    along_and_across = np.array([force, [-force[1], force[0]]]) / (force @ force)
    return np.asarray(along_and_across @ by_position @ moves)


def _position(clearance: float, z: Array) -> Array:
    chi = 1.0 / (1.0 + math.exp(-z[0]))
    return clearance * chi * np.array([math.cos(z[1]), math.sin(z[1])])


def _tolerance(s: float) -> float:
    """Return the tolerance: 1e-12, or more where 1 - chi loses digits in the subtraction."""
    return max(_TOLERANCE, 1e-15 * (1.0 + math.exp(s)))


def _result(reaction: Reaction, load: Array, speed: float, point: _Point) -> Equilibrium:
    position = _position(reaction.clearance, point.z)
    force = reaction.force(position, np.zeros(2), speed)
    angle = math.copysign(1.0, speed) * (point.z[1] - math.atan2(load[1], load[0]))
    return Equilibrium(
        position=position,
        speed=speed,
        load=load,
        eccentricity_ratio=1.0 / (1.0 + math.exp(-point.z[0])),
        attitude_angle=math.remainder(angle, 2.0 * math.pi),
        minimum_film=reaction.clearance / (1.0 + math.exp(point.z[0])),
        residual=math.hypot(*(force + load)) / math.hypot(*load),
        iterations=point.steps,
    )


def _why_not(reaction: Reaction, load: Array, speed: float, best: _Point) -> str:
    """Return the message that names the load, the rule it breaks, and the film force at the limit."""
    given = f"got load {load.tolist()} N with |load| = {math.hypot(*load):.6g} N"
    if not math.isfinite(best.norm):
        return f"speed must make the film carry load: at speed {speed!r} rad/s it carries none, {given}"
    if best.z[0] == _LARGEST_S and best.residual[0] < 0.0:
        limit = math.exp(best.residual[0]) * math.hypot(*load)
        return (
            f"load must be within the film's capacity at speed {speed!r} rad/s: the film force at "
            f"eccentricity ratio {MAXIMUM_ECCENTRICITY} is {limit:.6g} N, {given}"
        )
    return (
        f"load must have a static equilibrium at speed {speed!r} rad/s, and the search found none: "
        f"the best residual is {best.norm:.3g}, {given}"
    )
