"""The static equilibrium of a journal under a constant load."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..bearings.contact_place import WalledReaction, relative_film
from ..bearings.oil.compression import warn_of_pressure
from ..bearings.oil.laminar import warn_of_flow
from ..errors import (
    EquilibriumError,
    InputError,
    ValidityWarning,
    require_finite,
    require_number,
    require_pair,
    warn_user,
)
from ..inputs.kinds import arguments
from ..model import Array, JournalForce, Reaction, prepared_tangent, require_reaction
from ..reactions.noise import MOST_LEFT, force_noise
from ..reactions.resting import rest_place
from ..results import Equilibrium
from ..warming import Settling, Warming
from .search.static_search import (
    LARGEST_S,
    MAXIMUM_ECCENTRICITY,
    StaticPoint,
    StaticTarget,
    continued_place,
    has_force_against,
    is_found,
    is_unstable,
    search_place,
    unavoidable,
)

UNLOADED = (
    "an unloaded journal has no attitude angle (for the centered journal use coefficients at position (0, 0))"
)
"""Why a load of zero has no equilibrium."""

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
        The film; it need not be isotropic. If its temperature is left to its heat, that is found too.
    load : array_like, shape (2,) [N]
        External static force on the journal, weight included; film force + load = 0.
    speed : float [rad/s]
        Angular speed about +z, of either sign.

    Returns
    -------
    Equilibrium
        With |film force + load| <= 1e-12 |load|, or what roundoff leaves, up to 1e-6 |load|: a light load on
        preloaded pads or balls is the small difference of large forces. Of tilting pads a `PadEquilibrium`.
        A `ValidityWarning` tells of a film beyond its map, of a mean pressure |load|/(2 radius length) above
        half of the bulk modulus of a mineral oil, of a film that is not laminar (Reynolds number speed radius
        clearance/kinematic viscosity above 2000 or 41.2 sqrt(radius/clearance)), and of a temperature beyond
        the viscosity law of the oil. Another tells of an equilibrium that is statically unstable: the
        stiffness in slow motion has a negative real eigenvalue.

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
    as a power of chi near the center and of 1 - chi near the wall: the equations are nearly linear. Balls,
    among which there may be no force at all, find their rest themselves (`reactions.resting`).
    """
    require_reaction("reaction", reaction, JournalForce, heavy=True)
    load = checked_load(load)
    speed = require_number("speed", speed)
    found = _found(reaction, load, speed)
    warn_of_pressure(reaction, load)
    warn_of_flow(reaction, speed, found.temperature)
    return found


def _found(reaction: Reaction, load: Array, speed: float) -> Equilibrium:
    """Return the equilibrium of checked arguments."""
    if isinstance(reaction, Warming) and reaction.is_warming:
        return _warm(reaction, load, speed)
    at_rest = reaction.at_rest() if isinstance(reaction, Settling) else None
    film: Any = at_rest or reaction
    room = min(relative_film(film, np.zeros(2)), 1.0)
    lead = 0.0 if at_rest else math.copysign(_FIRST_ANGLE, speed)  # pads that follow take no journal aside
    x, y = -float(load[0]), -float(load[1])
    near = rest_place(film, (-x, -y), speed)
    target = StaticTarget(
        prepared_tangent(film), film.clearance, speed, x, y, room, lead, force_noise(film, speed), near
    )
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        # A state that the search only passes through is nobody's answer; that of the result is warned of.
        best = search_place(target)
        if at_rest and not is_found(target, best):
            best = continued_place(target, best)
    if not is_found(target, best):
        raise EquilibriumError(_why_not(load, target, best))
    found = _result(film, load, target, best)
    if not found.residual <= MOST_LEFT:
        raise EquilibriumError(_not_found(load, speed, found.residual))
    if is_unstable(best):
        warn_user(
            f"the equilibrium at {list(best.position)} m and {speed!r} rad/s is statically unstable: the "
            "force of the film drives the journal away from it"
        )
    return found if at_rest is None else at_rest.settled(found)


def _warm(bearing: Warming, load: Array, speed: float) -> Equilibrium:
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


def _result(reaction: Reaction, load: Array, target: StaticTarget, point: StaticPoint) -> Equilibrium:
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


def _minimum_film(reaction: Reaction, target: StaticTarget, point: StaticPoint) -> float:
    """Return the least film [m]; in a circle from s, which has its digits near the wall."""
    if isinstance(reaction, WalledReaction):
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
        return f"speed must make the film carry load: at speed {speed!r} rad/s it carries none, {given}"
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
