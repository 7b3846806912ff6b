"""The answer to one rotor on one damper: groups, orbits, folds, contact, coefficients."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...bearings.damper import DamperGroups, PorousDamper, damper_groups
from ...bearings.sprung import Sprung
from ...linear import OrbitCoefficients, orbit_coefficients
from ...model import Array, Reaction
from ...motion import Fold, SynchronousOrbits, synchronous_orbits
from ...readable.result import Readable
from ...results import CircularOrbit
from ...rotors import RigidRotor


@dataclass(frozen=True, kw_only=True)
class DamperAnswer(Readable):
    """What a rigid rotor with unbalance does on a damper with retainer springs.

    Attributes
    ----------
    groups : DamperGroups
        w_r being the speed.
    orbits : tuple of CircularOrbit
        At the rotor's unbalance, the smallest first; none means contact.
    folds : tuple of Fold
    contact_unbalance : float or None [kg m]
    small_motion : OrbitCoefficients
        Of film and springs on a circular orbit of a hundredth of the clearance.
    response : SynchronousOrbits
        Orbits over unbalances up to twice the rotor's.
    """

    groups: DamperGroups
    orbits: tuple[CircularOrbit, ...]
    folds: tuple[Fold, ...]
    contact_unbalance: float | None
    small_motion: OrbitCoefficients
    response: SynchronousOrbits


def solve_damper(
    damper: PorousDamper, *, mass: float, speed: float, unbalance: float, stiffness: float = 0.0
) -> DamperAnswer:
    """Return the answer for a rotor [kg, rad/s, kg m] on a damper with springs of the stiffness [N/m].

    Raises
    ------
    InputError
        If a value breaks its rule.
    """
    groups = damper_groups(damper, mass=mass, speed=speed, stiffness=stiffness, unbalance=unbalance)
    rotor = RigidRotor(mass=mass, speed=speed, unbalance=unbalance, gravity=(0.0, 0.0))
    support: Reaction = Sprung(reaction=damper, stiffness=stiffness) if stiffness else damper
    response = synchronous_orbits(rotor, support, _around(unbalance))
    return DamperAnswer(
        groups=groups,
        orbits=response.at(unbalance),
        folds=response.folds,
        contact_unbalance=response.contact_unbalance,
        small_motion=orbit_coefficients(support, 0.01, speed),
        response=response,
    )


def _around(unbalance: float) -> Array:
    """Return unbalances from nearly 0 to twice the given one, itself among them."""
    return unbalance * np.linspace(0.005, 2.0, 400)
