"""Derivatives of functions that bring none, by central differences of sixth order with an error estimate."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import InputError, require_positive
from ..core.model import Array

HALVINGS = 0.5 ** np.arange(3)
"""Steps / largest step: central differences of order 2, extrapolated twice (Richardson, 1911)."""

ORDER = 6
"""Of the derivatives."""

ROUNDOFF = 16.0 * np.finfo(float).eps
"""Error of values that are computed in some operations, relative to the largest."""


def extrapolated_value(coarse: Any, fine: Any, order: int = 2) -> Any:
    """Return what steps or cells without end would give, of an order; the first value is on half of them."""
    return fine + (fine - coarse) / (2.0**order - 1.0)


def differences(function: Callable[[Array], Array], state: Array, steps: Array) -> tuple[Array, Array]:
    """Return the derivatives of a function of m numbers, and an estimate of their error.

    Parameters
    ----------
    function : callable
        Function from states, shape (m, ...), to values, shape (k, ...). It is called once.
    state, steps : ndarray, shape (m, ...)
        Where, and the largest step along each number, in its unit.

    Returns
    -------
    slopes, error : ndarray, shape (k, m, ...)
        The estimate is the error of fourth order, far above that of the slopes where the function is smooth,
        and what errors of `ROUNDOFF` in the values make of the smallest step.
    """
    signed = np.stack([HALVINGS, -HALVINGS])
    moved = state[:, None, None, None] + np.einsum("cd,sl,d...->cdsl...", np.eye(len(steps)), signed, steps)
    values = function(moved)
    own = np.einsum("ddsl...->dsl...", moved)
    widths = own[:, 0] - own[:, 1]  # what the steps are once they are rounded
    slopes = np.moveaxis((values[:, :, 0] - values[:, :, 1]) / widths, 2, 0)
    coarser, order = slopes, 2
    while len(slopes) > 1:
        coarser = slopes
        slopes = np.array([fine + (fine - coarse) / (2.0**order - 1.0) for coarse, fine in pairwise(slopes)])
        order += 2
    roundoff = ROUNDOFF * np.abs(values).max(axis=(0, 1, 2, 3)) / widths[:, -1]
    return slopes[0], np.abs(slopes[0] - coarser[-1]) + roundoff


# The dry elliptic contact of two elastic bodies (Hertz 1881) in its own units; elliptic integrals.


class EllipticIntegrals(NamedTuple):
    """Complete elliptic integrals of the parameter 1 - 1/ellipticity^2.

    Attributes
    ----------
    first, second : float [1]
        K and E.
    share : float [1]
        (K - E)/K, with its digits where the ellipse is nearly a circle.
    """

    first: float
    second: float
    share: float


def elliptic_integrals(ellipticity: float) -> EllipticIntegrals:
    """Return the complete elliptic integrals of an ellipse, by the arithmetic-geometric mean.

    Parameters
    ----------
    ellipticity : float [1]
        Longer over shorter axis, at least 1.

    Raises
    ------
    InputError
        If it is below 1.
    """
    require_ellipticity(ellipticity)
    larger, smaller = 1.0, 1.0 / ellipticity
    square, weight, share = (1.0 - smaller) * (1.0 + smaller), 0.5, 0.0
    while square > 1e-24:
        share += weight * square
        half = 0.5 * (larger - smaller)
        larger, smaller = 0.5 * (larger + smaller), math.sqrt(larger * smaller)
        square, weight = half**2, 2.0 * weight
    first = 0.5 * math.pi / larger
    return EllipticIntegrals(first, first * (1.0 - share), share)


def curvature_ratio(ellipticity: float) -> float:
    """Return rho_x/rho_y = (kappa^2 E - K)/(K - E) of an ellipse; 1 of a circle."""
    kappa = ellipticity
    m, share = (1.0 - 1.0 / kappa) * (1.0 + 1.0 / kappa), elliptic_integrals(kappa).share
    return kappa**2 * (m - share) / share if share > 0.0 else 1.0


def require_ellipticity(value: float) -> None:
    """Raise InputError if an ellipticity is not finite and at least 1."""
    require_positive("ellipticity", value)
    if value < 1.0:
        raise InputError(f"ellipticity must be at least 1, got {value!r}")


@dataclass(frozen=True)
class Ellipse:
    """The dry contact of an ellipticity kappa = a/b, the axis b along the way that the bodies roll.

    In units of its load: lengths in b, pressures in the largest, approach and gap in b^2 rho_x/2. There the
    pressure is sqrt(1 - x^2 - y^2/kappa^2), and the gap is approach + x^2 + (rho_y/rho_x) y^2 + C times the
    integral of p/|r - r'|.

    Parameters
    ----------
    ellipticity : float [1]
        At least 1.
    """

    ellipticity: float

    @cached_property
    def integrals(self) -> EllipticIntegrals:
        """K and E."""
        return elliptic_integrals(self.ellipticity)

    @cached_property
    def across(self) -> float:
        """rho_y/rho_x."""
        return 1.0 / curvature_ratio(self.ellipticity)

    @cached_property
    def strength(self) -> float:
        """C = (1 + rho_y/rho_x)/(pi E); 4/pi^2 of a circle."""
        return (1.0 + self.across) / (math.pi * self.integrals.second)

    @property
    def load(self) -> float:
        """The integral of the pressure, 2 pi kappa/3."""
        return 2.0 * math.pi * self.ellipticity / 3.0

    @property
    def depth(self) -> float:
        """Minus the approach, pi C K; 2 of a circle."""
        return math.pi * self.strength * self.integrals.first

    @property
    def slope(self) -> float:
        """Stiffness: minus the derivative of the load by the approach, kappa/(C K)."""
        return self.ellipticity / (self.strength * self.integrals.first)


CIRCLE = Ellipse(1.0)
"""The contact of a ball and a plane."""


# Film thickness of elliptic elastohydrodynamic contacts by Hamrock and Dowson.


class HamrockDowson(NamedTuple):
    """The parameters of Hamrock and Dowson (1977) [1].

    Attributes
    ----------
    U : float
        Speed: mu0 (u1 + u2)/(2 E' R).
    G : float
        Material: pressure-viscosity coefficient times E'.
    W : float
        Load: P/(E' R^2).
    ellipticity : float
        Axis of the contact across the way that it rolls over that along it; 1 of a circle.
    """

    U: float
    G: float
    W: float
    ellipticity: float = 1.0

    @property
    def central_film(self) -> float:
        """Central film thickness / R."""
        shape = 1.0 - 0.61 * math.exp(-0.73 * self.ellipticity)
        return 2.69 * self.U**0.67 * self.G**0.53 * self.W**-0.067 * shape

    @property
    def minimum_film(self) -> float:
        """Smallest film thickness / R."""
        shape = 1.0 - math.exp(-0.68 * self.ellipticity)
        return 3.63 * self.U**0.68 * self.G**0.49 * self.W**-0.073 * shape
