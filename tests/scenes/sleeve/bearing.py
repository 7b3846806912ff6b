"""The law of a viscous sleeve, and the bearing that has it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core.errors import require_positive
from ...core.model import Array
from ..reaction import StaticReaction


def squeeze_damping(
    radius: float, length: float, clearance: float, viscosity: float, *, short: bool
) -> float:
    """Return the damping of a full film about the center [N s/m].

    Reynolds' equation p'' - p/R^2 = 12 viscosity v cos(theta)/c^3 along the length, p = 0 at both ends; a
    short film leaves out p/R^2.

    Parameters
    ----------
    radius, length, clearance : float [m]
    viscosity : float [Pa s]
    short : bool
    """
    half = 0.5 * length / radius
    ends = half**2 / 3.0 if short else 1.0 - math.tanh(half) / half
    return 12.0 * math.pi * viscosity * radius**3 * length / clearance**3 * ends


@dataclass(frozen=True, kw_only=True)
class ViscousSleeve(StaticReaction):
    """A sleeve full of oil: force = -damping velocity.

    Parameters
    ----------
    radius, length, clearance : float [m]
    viscosity : float [Pa s]
    short : bool
        Whether the flow around the circumference is left out.
    """

    radius: float
    length: float
    clearance: float
    viscosity: float
    short: bool = False

    def __post_init__(self) -> None:
        for name in ("radius", "length", "clearance", "viscosity"):
            require_positive(name, getattr(self, name))

    @property
    def damping(self) -> float:
        """Force over velocity [N s/m]."""
        return squeeze_damping(self.radius, self.length, self.clearance, self.viscosity, short=self.short)

    @property
    def nominal_force(self) -> float:
        """Force [N] at a tenth of the clearance 100 times a second."""
        return 10.0 * self.damping * self.clearance

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the force (2, ...) [N]."""
        return -self.damping * velocity

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return d force/d(x, y, vx, vy, speed) (2, 5, ...)."""
        constant = np.zeros((2, 5, *speed.shape))
        constant[0, 2] = constant[1, 3] = -self.damping
        return constant
