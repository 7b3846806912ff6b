"""The speeds that are asked for of a flexible rotor: what must vanish there, and how it is looked for."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import AbsentError, ConvergenceError
from ..core.model import Array
from ..core.port import Bearings, freedoms_of
from ..rotors import FlexibleRotor
from ..rotors.structure import Structure, freedom_rows
from . import rotor_matrices
from .coefficients import GROWTH_ROUNDOFF, film_coefficients
from .equilibrium import equilibrium
from .rotor_equilibrium import RotorEquilibrium, rotor_equilibrium
from .rotor_modes import RotorModes, critical_speeds, rotor_modes
from .rotor_thresholds import rotor_threshold

NEAR = 1.1
"""Critical speeds up to so many times the first are followed with it."""


SHORTEST = 1e-3
"""Change of speed [1] below which a secant is mostly roundoff."""


Sighting = tuple[float, complex]
"""A speed [rad/s] and the eigenvalue [1/s] of its whirl."""


class SpeedEvent(NamedTuple):
    """What happens to a whirl s at the speed that is asked for.

    Attributes
    ----------
    lead : callable
        Of s and the speed [rad/s]: what vanishes there [1/s].
    rate : callable
        The derivative of that by the speed [1], from that of the eigenvalue.
    frequency : callable
        Frequency of s and the speed: the frequency at which hysteresis is taken [rad/s].
    sightings : callable
        Of rotor, bearings and speeds: the lowest such speed, and those near it, each with the eigenvalue of
        its whirl; AbsentError if there is none.
    missed : callable
        Of whirls just below the first such speed by two models: why it may be another one; empty if not.
    """

    lead: Callable[[complex, float], float]
    rate: Callable[[complex], float]
    frequency: Callable[[complex, float], float]
    sightings: Callable[[FlexibleRotor, Bearings, Array], list[Sighting]]
    missed: Callable[[RotorModes, RotorModes], str]


def _critical_speeds(rotor: FlexibleRotor, bearings: Bearings, speeds: Array) -> list[Sighting]:
    """Return the first critical speed, and those near it."""
    found = critical_speeds(rotor, bearings, speeds)
    if not found:
        raise AbsentError(
            f"no critical speed in shaft.speeds, {speeds[0]:.6g} to {speeds[-1]:.6g} rad/s: "
            "no whirl has the frequency of the rotation there"
        )
    return [
        (one.speed, one.speed * complex(-one.log_decrement / (2.0 * math.pi), 1.0))
        for one in found
        if one.speed <= NEAR * found[0].speed
    ]


def _missed_critical(own: RotorModes, other: RotorModes) -> str:
    """Return that more or fewer whirls are slower than the rotation by the other model."""
    slow, others = (int(np.sum(modes.frequency < modes.speed)) for modes in (own, other))
    return "" if slow == others else f"{slow} whirls are slower than the speed, with more modes {others}"


CRITICAL = SpeedEvent(
    # The hysteresis of synchronous whirl is the mean of both sides.
    lead=lambda value, speed: value.imag - speed,
    rate=lambda value_rate: value_rate.imag - 1.0,
    frequency=lambda _, speed: speed,
    sightings=_critical_speeds,
    missed=_missed_critical,
)
"""A whirl has the frequency of the rotation."""


def _threshold(rotor: FlexibleRotor, bearings: Bearings, speeds: Array) -> list[Sighting]:
    """Return the threshold of stability."""
    span = f"{speeds[0]:.6g} to {speeds[-1]:.6g} rad/s"
    found = rotor_threshold(rotor, bearings, speeds)
    if found.speed is None or found.whirl_frequency is None:
        values = rotor_modes(rotor, bearings, float(speeds[0])).eigenvalues
        neutral = values.size and np.all(np.abs(values.real) < GROWTH_ROUNDOFF * np.abs(values))
        reason = "nothing damps or drives a whirl" if neutral else found.reason
        raise AbsentError(f"no whirl threshold in shaft.speeds, {span}: {reason}")
    if not found.whirl_frequency:
        raise AbsentError(
            f"no whirl threshold in shaft.speeds, {span}: the rotor departs without whirl (divergence) "
            f"from {found.speed:.6g} rad/s on"
        )
    return [(found.speed, 1j * found.whirl_frequency)]


def _missed_threshold(own: RotorModes, other: RotorModes) -> str:
    """Return that a whirl grows already by the other model."""
    growing = bool(np.any(other.eigenvalues.real > 0.0))
    return "with more modes another whirl grows first" if growing else ""


THRESHOLD = SpeedEvent(
    lead=lambda value, _: value.real,
    rate=lambda value_rate: value_rate.real,
    frequency=lambda value, _: value.imag,
    sightings=_threshold,
    missed=_missed_threshold,
)
"""A whirl begins to grow; a rotor that departs without whirl before that has no such speed."""


class FoundSpeed(NamedTuple):
    """A speed that was looked for.

    Attributes
    ----------
    speed : float [rad/s]
    slope : float
        Slope of the lead over the speed there.
    solution : object
        What was found with the lead there.
    """

    speed: float
    slope: float
    solution: Any


def secant_speed(
    lead_at: Callable[[float], tuple[float, Any]],
    speed: float,
    slope: float,
    *,
    near: float,
    farthest: float,
    most: int,
) -> FoundSpeed:
    """Return the speed at which a lead vanishes, by secants.

    Parameters
    ----------
    lead_at : callable
        Lead at from a speed [rad/s] to the lead, and what else was found with it.
    speed : float [rad/s]
        Speed where the search starts.
    slope : float
        Slope of the lead over the speed there; secants take its place.
    near : float [1]
        Change of speed at which the search ends.
    farthest : float [1]
        Longest step, as a part of the speed.
    most : int
        Steps.

    Raises
    ------
    ConvergenceError
        If the search does not end.
    """
    last: tuple[float, float] | None = None
    for _ in range(most):
        lead, solution = lead_at(speed)
        if last is not None and abs(speed - last[0]) > SHORTEST * speed:
            slope = (lead - last[1]) / (speed - last[0])
        step = max(-farthest * speed, min(-lead / slope, farthest * speed))
        if abs(step) <= near * speed:
            return FoundSpeed(speed, slope, solution)
        last, speed = (speed, lead), speed + step
    raise ConvergenceError(
        f"the speed near {speed:.6g} rad/s was not found within {most} steps of the secant method"
    )


# One whirl of a flexible rotor, and the speed at which something happens to it, by inverse iteration.


STEP = 1e-3
"""Relative change of speed over which K and C of films are differentiated."""

_STEPS, _HALVED = 60, 16
"""Most steps, and those after which Newton's method goes round a jump of a film on a grid and halves it."""


class Start(NamedTuple):
    """Where a whirl is looked for: speed [rad/s], eigenvalue [1/s], shape of the rotor."""

    speed: float
    value: complex
    shape: np.ndarray


class Whirl(NamedTuple):
    """A whirl in L(s) = s^2 M + s C + K, all at one speed; K and C are K(s) and its slope of films with it.

    Attributes
    ----------
    at : RotorEquilibrium
    value : complex [1/s]
        s.
    right, left : ndarray of complex, shape (N,)
        L right = 0, left* L = 0.
    """

    at: RotorEquilibrium
    value: complex
    right: np.ndarray
    left: np.ndarray


def value_rate(structure: Structure, whirl: Whirl, turning: Bearings) -> complex:
    """Return ds/d speed of a whirl [1]: gyroscopic effect, rotating damping, and the films at K(s).

    `turning` are the bearings whose K and C change with the speed.
    """
    s, right, left = whirl.value, whirl.right, whirl.left.conj()
    changed = s * (structure.gyroscopic @ right) + structure.circulation @ right
    for name, (stiffness, damping) in coefficient_rates(turning, whirl.at, s, STEP).items():
        rows = freedom_rows(structure, name, freedoms_of(whirl.at.coefficients[name]))
        changed = changed + rows.T @ ((stiffness + s * damping) @ (rows @ right))
    _, slope = rotor_matrices.dynamics(
        rotor_matrices.second_order(structure, rotor_matrices.rest_near(whirl.at, s)), s
    )
    return complex(-(left @ changed) / (left @ slope @ right))


def coefficient_rates(
    turning: Bearings, at: RotorEquilibrium, s: complex, step: float
) -> dict[str, tuple[Array, Array]]:
    """Return d K/d speed and d C/d speed of each film under its load, from speeds a relative step apart.

    Of a film with K(s) they are those of its matrices near the exponent s.
    """
    rates = {}
    for name, film in turning.items():
        low, high = (
            rotor_matrices.coefficients_near(
                film_coefficients(film, equilibrium(film, at.loads[name], speed).position, speed), s
            )
            for speed in (at.speed * (1.0 - step), at.speed * (1.0 + step))
        )
        width = 2.0 * step * at.speed
        rates[name] = ((high.stiffness - low.stiffness) / width, (high.damping - low.damping) / width)
    return rates


def whirl_of(
    event: SpeedEvent, rotor: FlexibleRotor, bearings: Bearings, turning: Bearings, start: Start
) -> tuple[Whirl, int]:
    """Return the whirl to which something happens, near another one, and how many speeds that took.

    K and C of a film on a grid jump a little where its rupture passes a node: the event may be in a jump.

    Raises
    ------
    ConvergenceError
        If Newton's method in the speed does not end.
    """
    speed, value, load = start
    ends: dict[bool, float] = {}
    for count in range(1, _STEPS + 1):
        at = rotor_equilibrium(rotor, bearings, speed)
        whirl = Whirl(
            at, *rotor_matrices.whirl_near(rotor.structure, at, event.frequency(value, speed), value, load)
        )
        lead = event.lead(whirl.value, speed)
        if abs(lead) < rotor_matrices.CONVERGED * speed:
            return whirl, count
        value, load = whirl.value, whirl.right
        step = -lead / event.rate(value_rate(rotor.structure, whirl, turning))
        ends[lead > 0.0] = speed
        if count > _HALVED and len(ends) == 2:
            step = 0.5 * sum(ends.values()) - speed
        if count > rotor_matrices.PATIENCE and abs(step) < rotor_matrices.ROUNDED * speed:
            return whirl, count
        speed += float(np.clip(step, -0.1 * speed, 0.1 * speed))
    raise ConvergenceError(f"the speed near {speed:.6g} rad/s was not found by Newton's method")
