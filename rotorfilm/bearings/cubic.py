"""The cubic between two states whose rates are known (Hermite)."""

from __future__ import annotations

from typing import Any


def cubic(begin: Any, end: Any, first: Any, last: Any, share: Any) -> tuple[Any, Any]:
    """Return value and derivative by the share, at a share of the way, 0 to 1.

    Parameters
    ----------
    begin, end : float or ndarray
        At both ends.
    first, last : float or ndarray
        Derivatives by the share there: rates times the length of the step.
    share : float or ndarray
    """
    way = end - begin
    bent, turned = first + last - 2.0 * way, 3.0 * way - 2.0 * first - last
    value = begin + share * (first + share * (turned + share * bent))
    return value, first + share * (2.0 * turned + 3.0 * share * bent)
