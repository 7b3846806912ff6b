"""The root of a function of one variable in a bracket, for paths that are light enough not to load scipy."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable

Point = tuple[float, float]
"""x and f(x)."""

STEPS_TO_ROOT = 100
CLOSEST = 4.0 * sys.float_info.epsilon


def bracketed_root(
    function: Callable[[float], float], low: float, high: float, *, xtol: float = 2e-12, rtol: float = CLOSEST
) -> float:
    """Return a root between two points at which a function has different signs, by Brent's method.

    The root is that of `scipy.optimize.brentq` to the last bit. The import of that package takes four times
    as long as that of numpy.

    Parameters
    ----------
    function : callable
    low, high : float
    xtol : float
        The bracket is as narrow in the end as xtol + rtol |x|.
    rtol : float [1]

    Raises
    ------
    ValueError
        If the signs at both ends are the same, or a value is NaN.
    RuntimeError
        If 100 steps do not lead to the root.

    Notes
    -----
    R. P. Brent (1973), Algorithms for Minimization without Derivatives, ch. 4, with inverse quadratic
    interpolation in divided differences.
    """
    last, best = _point(function, low), _point(function, high)
    if 0.0 in (last[1], best[1]):
        return best[0] if last[1] else last[0]
    if (last[1] < 0.0) is (best[1] < 0.0):
        raise ValueError("f(a) and f(b) must have different signs")
    far, before, step = last, 0.0, 0.0
    for _ in range(STEPS_TO_ROOT):
        if best[1] != 0.0 and (last[1] < 0.0) is not (best[1] < 0.0):
            far = last
            before = step = best[0] - last[0]
        if abs(far[1]) < abs(best[1]):
            last, best, far = best, far, best
        tolerance, half = (xtol + rtol * abs(best[0])) / 2.0, (far[0] - best[0]) / 2.0
        if best[1] == 0.0 or abs(half) < tolerance:
            return best[0]
        falls = abs(before) > tolerance and abs(best[1]) < abs(last[1])
        trial = _interpolated(best, last, far) if falls else math.inf
        short = 2.0 * abs(trial) < min(abs(before), 3.0 * abs(half) - tolerance)
        before, step = (step, trial) if short else (half, half)
        last = best
        moved = step if abs(step) > tolerance else math.copysign(tolerance, half)
        best = _point(function, best[0] + moved)
    raise RuntimeError(f"Failed to converge after {STEPS_TO_ROOT} iterations, value is {best[0]}")


def _point(function: Callable[[float], float], x: float) -> Point:
    value = float(function(float(x)))
    if math.isnan(value):
        raise ValueError(f"The function value at x={x} is NaN; solver cannot continue.")
    return float(x), value


def _interpolated(best: Point, last: Point, far: Point) -> float:
    """Return the step from the best point to the root of a line, or of a parabola in f; infinite without."""
    (x, f), (x_last, f_last), (x_far, f_far) = best, last, far
    try:
        if x_last == x_far:
            return -f * (x - x_last) / (f - f_last)
        slope, far_slope = (f_last - f) / (x_last - x), (f_far - f) / (x_far - x)
        return -f * (f_far * far_slope - f_last * slope) / (far_slope * slope * (f_far - f_last))
    except ZeroDivisionError:
        return math.inf
