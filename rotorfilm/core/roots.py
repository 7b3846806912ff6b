"""A root in a bracket by Brent's method of scipy, which loads at the first root that is asked for."""

from __future__ import annotations

from collections.abc import Callable

FOUR_ULPS = 2.0**-50
"""The least relative tolerance that scipy takes."""


def bracketed_root(
    function: Callable[[float], float],
    low: float,
    high: float,
    *,
    xtol: float = 2e-12,
    rtol: float = FOUR_ULPS,
) -> float:
    """Return a root between two places at which a function has opposite signs: `scipy.optimize.brentq`."""
    # scipy.optimize takes longer to load than a journal bearing to be answered.
    from scipy.optimize import brentq

    return float(brentq(function, low, high, xtol=xtol, rtol=rtol))
