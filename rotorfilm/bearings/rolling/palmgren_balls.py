"""The closed form of a ball bearing as a reaction."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...errors import require_count, require_non_negative, require_positive
from ...inputs.si_arguments import quantities
from ...model import Array, Tangent
from ..reaction import StaticReaction
from .load_zone import palmgren_stiffness

REACH = 0.007
"""Approach of both races over the ball diameter at 4200 MPa, for grooves of usual conformity."""


@quantities
@dataclass(frozen=True, kw_only=True)
class PalmgrenBalls(StaticReaction):
    """A ball bearing without clearance in Palmgren's closed form, force = -c |q|^(1/2) q.

    q is the way of the shaft; c is such that the stiffness along a load is `palmgren_stiffness`. Across it
    is 2/3 of that, and the angle of the cage does not count. Steel; no thrust, preload or inertia of balls.

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
        """Radial way [m] to about 4200 MPa, .007 of the ball diameter."""
        return REACH * self.ball_diameter

    @property
    def nominal_force(self) -> float:
        """Typical force [N]: a tenth of that at the clearance."""
        return 0.1 * self.constant * self.clearance**1.5

    def require_film(self, position: Array) -> None:
        """Accept every position: balls push back wherever the shaft goes."""

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as one function of five numbers; see `model.TangentReaction`."""
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
