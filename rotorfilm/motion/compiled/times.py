"""When a simulation is sampled, and how far it may step: checks of what the caller asks for."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_finite
from ...model import Array


def sample_times(duration: float, samples: int, times: ArrayLike | None) -> Array:
    """Return increasing times within [0, duration]; raise InputError where they are not."""
    if times is None:
        if not isinstance(samples, int) or samples < 2:
            raise InputError(f"samples must be an integer of at least 2, got {samples!r}")
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
