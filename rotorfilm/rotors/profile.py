"""The speed of a shaft over time, piecewise linear, with its exact angle and acceleration."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from ..core.errors import InputError, require_finite, require_positive
from ..core.inputs import in_si, quantities
from ..core.model import Array

PROBES = (0.25, 0.5, 0.75)
"""Where `SpeedProfile.from_function` compares the function with a chord, in fractions of the chord."""

PROBE_MARGIN = 0.9
"""Part of the tolerance allowed at a probe: an odd deviation peaks beside the probes, 3 % higher."""

FIRST_INTERVALS = 8
"""Chords that `SpeedProfile.from_function` starts from, so that it does not miss a hump between two ends."""

MAXIMUM_HALVINGS = 20
"""Halvings of a chord after which the function counts as discontinuous."""


@quantities
@dataclass(frozen=True)
class SpeedProfile:
    """Angular speed over time, linear between points and constant outside them.

    Parameters
    ----------
    times : tuple of float [s]
        Strictly increasing.
    speeds : tuple of float [rad/s]
        Angular speed about +z at these times, of either sign.

    Raises
    ------
    InputError
        If there is no point, the lengths differ, a value is not finite or the times do not increase.

    Examples
    --------
    >>> spin_up = SpeedProfile(times=(0.0, 2.0), speeds=(0.0, 100.0))
    >>> spin_up.speed(1.0), spin_up.angle(2.0), spin_up.acceleration(1.0), spin_up.acceleration(3.0)
    (50.0, 100.0, 50.0, 0.0)
    """

    times: tuple[float, ...]
    speeds: tuple[float, ...]

    def __post_init__(self) -> None:
        times = require_finite("times", self.times)
        speeds = require_finite("speeds", self.speeds)
        if times.ndim != 1 or times.size == 0:
            raise InputError(f"times must be a sequence of at least one number, got {self.times!r}")
        if speeds.shape != times.shape:
            raise InputError(f"speeds must be as many as times, got {speeds.shape} and {times.shape}")
        if np.any(np.diff(times) <= 0.0):
            raise InputError(f"times must increase strictly, got {self.times!r}")
        object.__setattr__(self, "times", tuple(times.tolist()))
        object.__setattr__(self, "speeds", tuple(speeds.tolist()))

    @classmethod
    @in_si
    def constant(cls, speed: float) -> SpeedProfile:
        """Return the profile that stays at one speed.

        Parameters
        ----------
        speed : float [rad/s]
        """
        return cls((0.0,), (speed,))

    @classmethod
    @in_si
    def from_function(
        cls, function: Callable[[float], float], duration: float, tolerance: float
    ) -> SpeedProfile:
        """Return a profile that follows a function of time.

        Parameters
        ----------
        function : callable
            Time [s] to angular speed [rad/s], continuous on [0, duration].
        duration : float [s]
            The profile covers [0, duration] and holds the last speed afterwards.
        tolerance : float [rad/s]
            Largest deviation, verified at the quarter points of every chord; the angle at t then
            deviates by at most tolerance * t.

        Raises
        ------
        InputError
            If the function returns something that is not finite, or still deviates after
            `MAXIMUM_HALVINGS` halvings, as a discontinuous function does.
        """
        require_positive("duration", duration)
        require_positive("tolerance", tolerance)

        def sample(t: float) -> float:
            return float(require_finite(f"function({t!r})", function(t)))

        grid = [duration * k / FIRST_INTERVALS for k in range(FIRST_INTERVALS + 1)]
        points = [(t, sample(t)) for t in grid]
        bound = PROBE_MARGIN * tolerance
        chords = [_refined(sample, left, right, bound, MAXIMUM_HALVINGS) for left, right in pairwise(points)]
        followed = [points[0], *(point for chord in chords for point in chord)]
        return cls(tuple(t for t, _ in followed), tuple(speed for _, speed in followed))

    def speed(self, t: float) -> float:
        """Return the angular speed at the time t [s], in rad/s."""
        k = bisect_right(self.times, t)
        if k == 0:
            return self.speeds[0]
        if k == len(self.times):
            return self.speeds[-1]
        return self.speeds[k - 1] + self._slopes[k - 1] * (t - self.times[k - 1])

    def acceleration(self, t: float) -> float:
        """Return the angular acceleration just after the time t [s], in rad/s2."""
        k = bisect_right(self.times, t)
        return 0.0 if k in (0, len(self.times)) else self._slopes[k - 1]

    def angle(self, t: float) -> float:
        """Return the angle turned since t = 0, in rad: the exact integral of the speed."""
        return self._turned(t) - self._angle_at_zero

    def turn(self, times: Array) -> Array:
        """Return angle, speed and angular acceleration at many times [s], shape (3, n)."""
        place = np.searchsorted(self.times, times, side="right")
        at = np.maximum(place - 1, 0)
        slope = np.where(place > 0, np.append(self._slopes, 0.0)[at], 0.0)
        passed, begin = times - np.array(self.times)[at], np.array(self.speeds)[at]
        angle = np.array(self._angles)[at] + passed * (begin + 0.5 * slope * passed)
        return np.array([angle - self._angle_at_zero, begin + slope * passed, slope])

    @cached_property
    def _slopes(self) -> tuple[float, ...]:
        return tuple((np.diff(self.speeds) / np.diff(self.times)).tolist())

    @cached_property
    def _angles(self) -> tuple[float, ...]:
        """The angle turned since the first point, at each point."""
        means = 0.5 * (np.array(self.speeds[1:]) + np.array(self.speeds[:-1]))
        return (0.0, *np.cumsum(means * np.diff(self.times)).tolist())

    @cached_property
    def _angle_at_zero(self) -> float:
        return self._turned(0.0)

    def _turned(self, t: float) -> float:
        """Return the angle turned since the first point."""
        k = max(bisect_right(self.times, t) - 1, 0)
        elapsed = t - self.times[k]
        return self._angles[k] + elapsed * (self.speeds[k] + 0.5 * self.acceleration(t) * elapsed)


def require_constant_speed(rotor: Any, rule: str, hint: str = "") -> None:
    """Raise InputError unless the speed of a rotor is a number and it has equations over time."""
    if isinstance(rotor.speed, SpeedProfile):
        raise InputError(f"{rule}, got {rotor.speed!r}{hint}")
    _ = rotor.operators


class Turning:
    """What turns with a speed that is a number or a profile.

    Attributes
    ----------
    speed : float or SpeedProfile [rad/s]
        Angular speed about +z.
    """

    speed: float | SpeedProfile

    # Cached because they are the inner loop of every integrator; a frozen dataclass cannot go stale.
    @cached_property
    def profile(self) -> SpeedProfile:
        """The speed as a profile, also where it was given as a number."""
        return self.speed if isinstance(self.speed, SpeedProfile) else SpeedProfile.constant(self.speed)

    @cached_property
    def nominal_speed(self) -> float:
        """Largest speed [rad/s], 1 at rest."""
        return max(abs(speed) for speed in self.profile.speeds) or 1.0

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times [s] at which the angular acceleration jumps, where an integrator should stop."""
        return self.profile.times if len(self.profile.times) > 1 else ()

    def rotating(self, t: float, angle: float = 0.0) -> Array:
        """Return (w^2 cos p + a sin p, w^2 sin p - a cos p) of p, the angle turned since t = 0 and `angle`.

        With the angular speed w and acceleration a; times an unbalance [kg m] at `angle` it is its force [N].
        """
        p, w, a = self.profile.angle(t) + angle, self.profile.speed(t), self.profile.acceleration(t)
        cos, sin = math.cos(p), math.sin(p)
        return np.array([w * w * cos + a * sin, w * w * sin - a * cos])


def _refined(
    sample: Callable[[float], float],
    left: tuple[float, float],
    right: tuple[float, float],
    bound: float,
    halvings: int,
) -> list[tuple[float, float]]:
    """Return the points after `left`, up to `right`, whose chords stay within `bound` at the probes."""
    span = right[0] - left[0]
    probes = [(left[0] + part * span, sample(left[0] + part * span)) for part in PROBES]
    deviations = [
        abs(speed - left[1] - part * (right[1] - left[1]))
        for part, (_, speed) in zip(PROBES, probes, strict=True)
    ]
    if max(deviations) <= bound:
        return [right]
    if halvings == 0:
        raise InputError(
            f"function must be continuous, got {left[1]:.6g} and {right[1]:.6g} rad/s "
            f"within {span:.3g} s at t = {left[0]:.9g} s"
        )
    middle = probes[len(PROBES) // 2]
    return [
        *_refined(sample, left, middle, bound, halvings - 1),
        *_refined(sample, middle, right, bound, halvings - 1),
    ]
