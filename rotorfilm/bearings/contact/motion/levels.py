"""Time levels of a moving contact: difference formulas on uneven steps, and the motion that is asked for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np

from ....errors import InputError, require_non_negative
from ....model import Array, breakpoints
from ...ellipse import CIRCLE
from ..film.linear_contact import Closure


class Level(NamedTuple):
    """The contact at one time.

    Attributes
    ----------
    t, delta, velocity : float [1]
        Time, approach and its rate.
    pressure : ndarray, shape (n,)
    stored : ndarray, shape (n,)
        rho H of the cells.
    """

    t: float
    delta: float
    velocity: float
    pressure: Array
    stored: Array


class Weights(NamedTuple):
    """d/dt at a new time as `new` * y + sum of `old` * earlier y, newest first."""

    new: float
    old: Array

    def history(self, values: Sequence[Any]) -> Any:
        """Return the part of the derivative that earlier levels make."""
        return sum(w * y for w, y in zip(self.old, values, strict=False))


@runtime_checkable
class ContactMotion(Protocol):
    """What moves the contact: a ball with a mass, or a given approach."""

    @property
    def inertia(self) -> float:
        """W, by which errors of the velocity count."""

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which the drive jumps or kinks."""

    def drive(self, t: float) -> float:
        """Return the drive, for the record: load f or given approach."""

    def closure(self, t: float, weights: Weights, levels: Sequence[Level]) -> Closure:
        """Return the scalar equation at the new time."""


@dataclass(frozen=True, kw_only=True)
class BallMotion:
    """The ball's own motion W delta'' = integral of p - unit f(t).

    Parameters
    ----------
    W : float [1]
        Inertia, >= 0.
    load : callable
        f(t); its attribute `breakpoints`, if it has one, lists the times of its jumps.
    unit : float [1]
        Integral of the pressure of the dry contact.
    """

    W: float
    load: Callable[[float], float]
    unit: float = CIRCLE.load

    def __post_init__(self) -> None:
        require_non_negative("W", self.W)
        _require_callable("load", self.load)

    @property
    def inertia(self) -> float:
        """W."""
        return float(self.W)

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which the load jumps."""
        return breakpoints(self.load)

    def drive(self, t: float) -> float:
        """Return the load f."""
        return _finite("load", self.load, t)

    def closure(self, t: float, weights: Weights, levels: Sequence[Level]) -> Closure:
        """Return the equation of motion; the velocity is eliminated by its own difference formula."""
        rate = weights.history([level.delta for level in levels])
        push = weights.new * rate + weights.history([level.velocity for level in levels])
        return Closure(-self.W * weights.new**2, 1.0, self.unit * self.drive(t) + self.W * float(push))


@dataclass(frozen=True, kw_only=True)
class GivenMotion:
    """A given approach delta(t), whatever force that takes.

    Parameters
    ----------
    approach : callable
        delta(t); its attribute `breakpoints`, if it has one, lists the times of its kinks.
    """

    approach: Callable[[float], float]

    def __post_init__(self) -> None:
        _require_callable("approach", self.approach)

    @property
    def inertia(self) -> float:
        """None: the velocity is given."""
        return 0.0

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which the motion kinks."""
        return breakpoints(self.approach)

    def drive(self, t: float) -> float:
        """Return the approach."""
        return _finite("approach", self.approach, t)

    def closure(self, t: float, weights: Weights, levels: Sequence[Level]) -> Closure:
        """Return delta = delta(t)."""
        return Closure(1.0, 0.0, self.drive(t))


def derivative_weights(t: float, times: Sequence[float]) -> Weights:
    """Return the backward difference of first or second order from one or two earlier times, newest first."""
    h = t - times[0]
    if len(times) == 1:
        return Weights(1.0 / h, np.array([-1.0 / h]))
    g = t - times[1]
    return Weights(1.0 / h + 1.0 / g, np.array([-g / (h * (g - h)), h / (g * (g - h))]))


def extrapolation_weights(t: float, times: Sequence[float]) -> Array:
    """Return the weights of the polynomial through all earlier times, at t."""
    return np.array([np.prod([(t - b) / (a - b) for b in times if b != a]) for a in times])


def error_share(t: float, times: Sequence[float]) -> float:
    """Return the error of a second-order step / its distance from the extrapolation through `times`.

    From three times this is the ratio of the leading terms: y'''/6 times h g (t - times[2]) for the
    extrapolation and times (h g)^2/(h + g) for the step, of opposite signs. From two times, as after a jump,
    the extrapolation is one order short and the share is on the safe side.
    """
    h, g = t - times[0], t - times[1]
    if len(times) == 2:
        return h / (h + g)
    step = (h * g) ** 2 / (h + g)
    return step / (step + h * g * (t - times[2]))


def _require_callable(name: str, value: object) -> None:
    if not callable(value):
        raise InputError(f"{name} must be a function of time, got {value!r}")


def _finite(name: str, function: Callable[[float], float], t: float) -> float:
    value = float(function(t))
    if not np.isfinite(value):
        raise InputError(f"{name} must be finite at every time, got {value!r} at t = {t:.6g}")
    return value
