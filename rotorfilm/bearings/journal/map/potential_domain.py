"""The ruptured film's region: two curved ends in the elliptic variable, mapped to a rectangle."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.special import ellipj, ellipkinc

from ....model import Array
from .potential_basis import end_shapes


class RitzResolution(NamedTuple):
    """Numbers of circumferential functions, axial functions, and even polynomials that shape an end."""

    around: int
    along: int
    shapes: int


class Source(NamedTuple):
    """What drives the film: eccentricity ratio, g = sine sin gamma + cosine cos gamma, slenderness."""

    chi: float
    sine: float
    cosine: float
    slenderness: float

    def at(self, gamma: Array) -> Array:
        """Return g(gamma)."""
        return self.sine * np.sin(gamma) + self.cosine * np.cos(gamma)

    @property
    def turn(self) -> float:
        """Direction t of the source, g = |g| cos(gamma - t) [rad]."""
        return float(np.arctan2(self.sine, self.cosine))

    @property
    def parameter(self) -> float:
        """Parameter m of the elliptic variable y, gamma = 2 am(y | m)."""
        return 2.0 * self.chi / (1.0 + self.chi)

    def elliptic(self, gamma: Array) -> Array:
        """Return y(gamma)."""
        return np.asarray(ellipkinc(0.5 * gamma, self.parameter))


class Film(NamedTuple):
    """Local film at points y: angle, d gamma/dy, thickness H, d ln H^1.5/dy, conductances around and along.

    The energy of a pressure u is the mean over zeta of int (around u_y^2 + along u_zeta^2)/2 + g rate u dy.
    """

    gamma: Array
    rate: Array
    thickness: Array
    growth: Array
    around: Array
    along: Array


def local_film(source: Source, y: Array) -> Film:
    """Return the film at points of the elliptic variable."""
    sn, cn, _, amplitude = ellipj(y, source.parameter)
    ratio = (1.0 - source.chi) / (1.0 + source.chi)
    dn2 = ratio + (1.0 - ratio) * cn**2
    rate, thickness = 2.0 * np.sqrt(dn2), (1.0 + source.chi) * dn2
    growth = -6.0 * source.parameter * sn * cn / rate
    cube = thickness**3
    along = cube * rate / source.slenderness**2
    return Film(*map(np.asarray, (2.0 * amplitude, rate, thickness, growth, cube / rate, along)))


class Region(NamedTuple):
    """Ends y_1(zeta), y_2(zeta) at the axial nodes, each (2, Q): position and slope dy/dzeta."""

    end: Array
    slope: Array

    @property
    def half_width(self) -> Array:
        """Half the film's extent in y, shape (Q,)."""
        return 0.5 * (self.end[1] - self.end[0])

    def points(self, xi: Array) -> tuple[Array, Array]:
        """Return y and dy/dzeta at fixed xi, each (P, Q)."""
        left, right = 0.5 * (1.0 - xi)[:, None], 0.5 * (1.0 + xi)[:, None]
        return left * self.end[0] + right * self.end[1], left * self.slope[0] + right * self.slope[1]


def region(coefficients: Array, resolution: RitzResolution) -> Region:
    """Return the region whose ends are the even Legendre series `coefficients`, shape (2, S)."""
    value, slope = end_shapes(resolution.along, resolution.shapes)
    return Region(coefficients @ value.T, coefficients @ slope.T)
