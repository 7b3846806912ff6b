"""Steps in time of models that an integrator does not take: differences of second order, and the cubic."""

from __future__ import annotations

from typing import Any


def bdf2(ratio: float) -> tuple[float, float, float]:
    """Return a, b, c of y' = (a y_n+1 + b y_n + c y_n-1)/dt, `ratio` the step over the one before."""
    return (1.0 + 2.0 * ratio) / (1.0 + ratio), -(1.0 + ratio), ratio**2 / (1.0 + ratio)


def cubic(begin: Any, end: Any, first: Any, last: Any, share: Any) -> tuple[Any, Any]:
    """Return value and derivative of the cubic between two states (Hermite), at a share of the way, 0 to 1.

    Parameters
    ----------
    begin, end : float or ndarray
        Begin and end at both ends.
    first, last : float or ndarray
        Derivatives by the share there: rates times the length of the step.
    share : float or ndarray
    """
    way = end - begin
    bent, turned = first + last - 2.0 * way, 3.0 * way - 2.0 * first - last
    value = begin + share * (first + share * (turned + share * bent))
    return value, first + share * (2.0 * turned + 3.0 * share * bent)
