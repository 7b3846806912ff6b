"""The closed form of a ball bearing as a reaction."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...core.errors import InputError, require_count, require_non_negative, require_number, require_positive
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.port import Tangent
from ..reaction import StaticReaction

REACH = 0.007
"""Approach of both races over the ball diameter at 4200 MPa, for grooves of usual conformity."""


@quantities
@dataclass(frozen=True, kw_only=True)
class PalmgrenBalls(StaticReaction):
    """A ball bearing without clearance in Palmgren's closed form, force = -c |q|^(1/2) q.

    q is the displacement of the shaft, and c follows from `palmgren_stiffness`, the stiffness along the load.
    The stiffness across the load is 2/3 of it, and the cage angle has no effect. Balls are of steel; thrust,
    preload and ball inertia are not included.

    Parameters
    ----------
    balls : int
        Number of balls.
    ball_diameter : float [m]
    contact_angle : float [rad]
    damping : float [N s/m]
        Viscous damping along x and y, as measured or assumed.

    Raises
    ------
    InputError
        If an argument breaks its rule.

    Examples
    --------
    >>> PalmgrenBalls(balls=8, ball_diameter=7.938e-3).force([0.0, -5e-6], [0.0, 0.0]).shape
    (2,)
    """

    balls: int
    ball_diameter: float
    contact_angle: float = 0.0
    damping: float = 0.0

    def __post_init__(self) -> None:
        require_count("balls", self.balls, 3)
        require_positive("ball_diameter", self.ball_diameter)
        require_non_negative("damping", self.damping)
        _ = self.constant

    @property
    def constant(self) -> float:
        """The constant c [N/m^1.5]: with W = c q^1.5 the stiffness is 1.5 c^(2/3) W^(1/3)."""
        at_one = palmgren_stiffness(
            load=1.0,
            balls=self.balls,
            ball_diameter=self.ball_diameter,
            contact_angle=self.contact_angle,
        )
        return float((at_one / 1.5) ** 1.5)

    @property
    def clearance(self) -> float:
        """Radial displacement [m] at a pressure of about 4200 MPa, 0.007 of the ball diameter."""
        return REACH * self.ball_diameter

    @property
    def nominal_force(self) -> float:
        """Typical force [N]: a tenth of that at the clearance."""
        return 0.1 * self.constant * self.clearance**1.5

    def require_film(self, position: Array) -> None:
        """Accept every position, because balls push back wherever the shaft goes."""

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as one function of five numbers; see `core.port.Reaction`."""
        constant, damping = self.constant, self.damping

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, tuple[float, ...]]:
            way = math.hypot(x, y)
            root = constant * math.sqrt(way)
            half = 0.5 * root / way**2 if way else 0.0
            across = -half * x * y
            along = -root - half * x * x, -root - half * y * y
            rows = (along[0], across, -damping, 0.0, 0.0, across, along[1], 0.0, -damping, 0.0)
            return -root * x - damping * vx, -root * y - damping * vy, rows

        return tangent

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        root = np.sqrt(np.hypot(*position))
        force: Array = -self.constant * root * position - self.damping * velocity
        return force

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        way = np.hypot(*position)
        along = position / np.where(way > 0.0, way, 1.0)
        slopes = np.zeros((2, 5, *speed.shape))
        for i in range(2):
            for j in range(2):
                slopes[i, j] = -self.constant * np.sqrt(way) * ((i == j) + 0.5 * along[i] * along[j])
            slopes[i, 2 + i] = -self.damping
        return slopes


# How the balls share a load: integrals over the loaded zone, closed forms of Stribeck and Palmgren.


HALF_ZONE = 0.5
"""Extent of the zone with half of the balls under load: no clearance and no thrust."""

STIFFNESS_CONSTANT = 13e6
"""Of the radial stiffness of ball bearings, N^(2/3) m^(-4/3) (Kraemer 1993, as in Friswell et al. 2010)."""

_NODES = 64


class LoadIntegrals(NamedTuple):
    """Radial and axial load over balls * largest ball load * the cosine and the sine of the contact angle.

    Attributes
    ----------
    radial, axial : float [1]
        J_r and J_a.
    """

    radial: float
    axial: float


@arguments
def load_integrals(extent: float) -> LoadIntegrals:
    """Return the integrals of the loaded zone of a ball bearing (Sjovall 1933; Harris & Kotzalas, ch. 7).

    J_r, J_a = 1/pi * integral from 0 to psi_l of (1 - (1 - cos psi)/(2 extent))^1.5 (cos psi, 1) d psi,
    cos psi_l = 1 - 2 extent.

    Parameters
    ----------
    extent : float [1]
        Load distribution factor epsilon: share of the diameter that is loaded; above 1 all balls are loaded.

    Raises
    ------
    InputError
        If it is not finite and positive.
    """
    require_positive("extent", extent)
    end = math.acos(max(1.0 - 2.0 * extent, -1.0))
    # psi = end * sin(s), so that the root at the end of the zone is smooth.
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    s, weight = 0.25 * math.pi * (nodes + 1.0), 0.25 * math.pi * weights
    psi = end * np.sin(s)
    depth = 1.0 - np.sin(0.5 * psi) ** 2 / extent
    load = np.maximum(depth, 0.0) ** 1.5 * end * np.cos(s) * weight / math.pi
    return LoadIntegrals(float(load @ np.cos(psi)), float(load.sum()))


@arguments
def stribeck_load(*, load: float, balls: int, contact_angle: float = 0.0) -> float:
    """Return the load of the most loaded ball [N] of a bearing without clearance, 4.37 W/(Z cos alpha).

    The formula is that of Stribeck (1907). The constant is 1/J_r(1/2), the limit for many balls.

    Parameters
    ----------
    load : float [N]
        Radial load.
    balls : int
        Number of balls.
    contact_angle : float [rad]

    Raises
    ------
    InputError
        If the load is not finite and positive, there is no ball, or the angle is not below 90 deg.
    """
    require_positive("load", load)
    require_count("balls", balls)
    return load / (load_integrals(HALF_ZONE).radial * balls * _cosine(contact_angle))


@arguments
def palmgren_stiffness(*, load: float, balls: int, ball_diameter: float, contact_angle: float = 0.0) -> float:
    """Return the stiffness along a radial load [N/m], 13e6 Z^(2/3) D^(1/3) W^(1/3) cos(alpha)^(5/3) in SI.

    This is Palmgren's formula, for steel and no clearance. Across the load the stiffness is 2/3 of this,
    averaged over the cage angle.

    Parameters
    ----------
    load : float [N]
        Radial load.
    balls : int
        Number of balls.
    ball_diameter : float [m]
    contact_angle : float [rad]

    Raises
    ------
    InputError
        If load or diameter are not finite and positive, there is no ball, or the angle is not below 90 deg.
    """
    require_positive("load", load)
    require_count("balls", balls)
    require_positive("ball_diameter", ball_diameter)
    scale = float((balls**2 * ball_diameter * load) ** (1.0 / 3.0))
    return float(STIFFNESS_CONSTANT * scale * _cosine(contact_angle) ** (5.0 / 3.0))


def _cosine(contact_angle: float) -> float:
    if not 0.0 <= require_number("contact_angle", contact_angle) < 0.5 * math.pi:
        raise InputError(f"contact_angle must be at least 0 and below 90 deg, got {contact_angle!r} rad")
    return math.cos(contact_angle)
