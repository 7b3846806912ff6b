"""How far one number drifts off its course by a defect of its rate."""

from __future__ import annotations

import math

from ...model import Array


def scalar_drift(time: Array, defect: Array, slope: Array) -> float:
    """Return the end of d' = slope d + defect from zero, by exponential steps with means of the slope."""
    moved = 0.0
    for k in range(1, time.size):
        step = float(time[k] - time[k - 1])
        z = 0.5 * float(slope[k] + slope[k - 1]) * step
        grown = math.exp(z)
        # Integrals of exp(z (1 - s)) and of exp(z (1 - s)) s over the step.
        one = math.expm1(z) / z if abs(z) > 1e-6 else 1.0 + 0.5 * z
        two = (one - 1.0) / z if abs(z) > 1e-3 else 0.5 + z / 6.0
        moved = grown * moved + step * float((one - two) * defect[k - 1] + two * defect[k])
    return moved
