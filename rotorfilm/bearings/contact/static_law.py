"""The load of a stationary contact over its approach, as a power law."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from ...model import Array


class StaticLaw(NamedTuple):
    """f = ((offset - delta)/span)^exponent in Hertzian loads; the dry contact has 0, 2 and 3/2.

    Attributes
    ----------
    offset, span, exponent : float [1]
    error : float [1]
        Largest relative deviation of the load.
    """

    offset: float
    span: float
    exponent: float
    error: float

    def load(self, delta: float) -> float:
        """Return f, 0 where the ball has left."""
        return float(max(self.offset - delta, 0.0) / self.span) ** self.exponent

    def slope(self, delta: float) -> float:
        """Return df/ddelta."""
        depth = max(self.offset - delta, 0.0) / self.span
        return float(-self.exponent / self.span * depth ** (self.exponent - 1.0))


def fit_static_law(delta: Array, load: Array) -> StaticLaw:
    """Return the law through stationary contacts: approaches (n,) and loads f (n,), n >= 4."""
    highest = float(np.max(delta))

    def fitted(lead: float) -> tuple[Array, Array]:
        rows = np.stack([np.log(highest + lead - delta), np.ones(len(delta))], axis=1)
        solution = np.linalg.lstsq(rows, np.log(load), rcond=None)[0]
        return solution, rows @ solution - np.log(load)

    lead = np.exp(minimize_scalar(lambda x: float(np.sum(fitted(np.exp(x))[1] ** 2)), bounds=(-7.0, 2.0)).x)
    (exponent, shift), missed = fitted(float(lead))
    return StaticLaw(
        highest + float(lead),
        float(np.exp(-shift / exponent)),
        float(exponent),
        float(np.max(abs(np.expm1(missed)))),
    )
