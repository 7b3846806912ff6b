"""What couplings are compared on: the schemes by kind, and a rigid rotor at rest in its bearing."""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from ...bearings.journal import JournalBearing
from ...cosim import GaussSeidel, Jacobi, Newton, Scheme, SIExp, SIExp3
from ...rotors.rigid import RigidRotor

SPEED = 157.0
"""Angular speed [rad/s]; in dimensionless form nothing depends on it."""


class SchemeName(StrEnum):
    """Labels of the schemes that are compared."""

    HELD = "Gauss-Seidel 0"
    LINEAR = "Gauss-Seidel 1"
    QUADRATIC = "Gauss-Seidel 2"
    JACOBI_HELD = "Jacobi 0"
    JACOBI_LINEAR = "Jacobi 1"
    JACOBI_QUADRATIC = "Jacobi 2"
    SI_EXP = "SI-exp"
    SI_EXP3 = "SI-exp3"
    NEWTON = "Newton"


EXPLICIT: tuple[Scheme, ...] = (
    *(GaussSeidel(degree=degree) for degree in range(3)),
    *(Jacobi(degree=degree) for degree in range(3)),
)
"""Schemes with a longest stable macro step."""

SCHEMES: tuple[Scheme, ...] = (*EXPLICIT, SIExp(), SIExp3(), Newton())
"""All schemes; those that are not explicit are stable where explicit ones are not."""


def resting_rotor(
    bearing: JournalBearing,
    eccentricity_ratio: float,
    *,
    speed: float = SPEED,
    mass_ratio: float = 1.0,
    direction: float = 0.0,
    unbalance_ratio: float = 0.0,
) -> RigidRotor:
    """Return a rigid rotor whose load holds it at rest at a place in its bearing.

    Parameters
    ----------
    bearing : JournalBearing
    eccentricity_ratio : float [1]
    speed : float [rad/s]
    mass_ratio : float [1]
        speed^2 clearance mass / load, the square of the speed parameter.
    direction : float [rad]
        Of the eccentricity.
    unbalance_ratio : float [1]
        Unbalance / (mass clearance).
    """
    c = bearing.clearance
    rest = eccentricity_ratio * c * np.array([np.cos(direction), np.sin(direction)])
    load = -bearing.force(rest, (0.0, 0.0), speed)
    mass = mass_ratio * float(np.hypot(*load)) / (speed**2 * c)
    return RigidRotor(
        mass=mass,
        speed=speed,
        unbalance=unbalance_ratio * c * mass,
        gravity=(0.0, 0.0),
        static_force=(float(load[0]), float(load[1])),
        position=(float(rest[0]), float(rest[1])),
    )
