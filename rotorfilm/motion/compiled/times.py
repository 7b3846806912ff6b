"""When a simulation is sampled, and how far it may step: checks of what the caller asks for."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_finite, require_positive
from ...limits import STEPS, TURNS, require_at_most
from ...model import Array, Dynamic, breakpoints
from ...signals import indices, names

FASTEST = 1e6
"""Speed that no shaft exceeds [rad/s]; a run that is short at it needs no look at the rotor."""

SLOWEST = 1.0
"""Speed [rad/s] as which a shaft counts that stands or turns more slowly: it may swing all the same."""


def require_duration(rotor: Dynamic, duration: float) -> None:
    """Raise InputError unless a run has a length, and no more turns than can be run."""
    require_positive("duration", duration)
    longest = 2.0 * math.pi * TURNS
    if duration * FASTEST <= longest:
        return
    speed = max(highest_speed(rotor, duration), SLOWEST)
    if duration * speed > longest:
        raise InputError(
            f"duration must be at most {TURNS:g} turns, {longest / speed:.3g} s at {speed:g} rad/s, "
            f"got {duration!r} s"
        )


def highest_speed(rotor: Dynamic, duration: float) -> float:
    """Return the highest speed of a rotor at its start and where its speed bends within a run [rad/s]."""
    speed = indices("rotor must have the outputs", names(rotor.outputs), ["speed"])
    moments = [0.0, *(t for t in breakpoints(rotor) if 0.0 < t < duration), duration]
    none = np.zeros(len(rotor.inputs))
    return float(max(np.abs(rotor.output(t, rotor.initial_state, none)[speed]).max() for t in moments))


def sample_times(duration: float, samples: int, times: ArrayLike | None) -> Array:
    """Return increasing times within [0, duration]; raise InputError where they are not."""
    if times is None:
        if not isinstance(samples, int) or samples < 2:
            raise InputError(f"samples must be an integer of at least 2, got {samples!r}")
        require_at_most("samples", samples, STEPS)
        return np.linspace(0.0, duration, samples)
    grid = np.atleast_1d(require_finite("times", times))
    if grid.ndim != 1 or np.any(np.diff(grid) <= 0.0):
        raise InputError(f"times must increase strictly, got {times!r}")
    if grid.size and (grid[0] < 0.0 or grid[-1] > duration):
        raise InputError(f"times must lie within [0, {duration!r}] s, got {grid[0]!r} to {grid[-1]!r}")
    return grid


def require_longest_step(max_step: float) -> None:
    """Raise InputError unless the longest step is positive; it may be infinite."""
    if not max_step > 0.0:
        raise InputError(f"max_step must be positive, got {max_step!r}")
