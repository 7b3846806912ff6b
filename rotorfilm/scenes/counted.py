"""A reaction that counts its evaluations: the work of a rung."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..bearings.contact_place import WalledReaction, minimum_film
from ..bearings.inertial_model import InertialModel
from ..errors import require_vector
from ..model import Array, Reaction, Tangent, largest_eccentricity_ratio, prepared_tangent
from ..reactions.added_mass import inertial


class Counted(InertialModel):
    """A static reaction, and how many forces and tangents it was asked for.

    Parameters
    ----------
    reaction : Reaction
        Without states.
    """

    def __init__(self, reaction: Reaction) -> None:
        self._reaction = reaction
        self.forces = 0
        self.tangents = 0

    @property
    def clearance(self) -> float:
        """Radial clearance [m]."""
        return self._reaction.clearance

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio to which the reaction is meant."""
        return largest_eccentricity_ratio(self._reaction)

    @property
    def nominal_force(self) -> float:
        """Nominal force [N]."""
        return self._reaction.outputs[0].nominal

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the force (2, ...) [N], one count for each state."""
        result = self._reaction.force(position, velocity, speed)
        self.forces += int(np.prod(result.shape[1:], dtype=int))
        return result

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d force/d(x, y, vx, vy, speed) (2, 5, ...), one count for each state."""
        result = self._reaction.jacobian(position, velocity, speed)
        self.tangents += int(np.prod(result.shape[2:], dtype=int))
        return result

    prepared_force, prepared_jacobian = force, jacobian

    @property
    def has_inertia(self) -> bool:
        """Whether the reaction has an added mass, which comes with its forces."""
        return inertial(self._reaction) is not None

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the added mass [kg], shape (2, 2, ...)."""
        return self._reaction.mass(position, velocity, speed)  # type: ignore[attr-defined]

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d mass / d (x, y, vx, vy, speed), shape (2, 2, 5, ...)."""
        return self._reaction.mass_slopes(position, velocity, speed)  # type: ignore[attr-defined]

    def require_range(self, frequency: float) -> None:
        """Warn, or raise InputError, where the inertia of the reaction ends, at a frequency [rad/s]."""
        heavy = inertial(self._reaction)
        if heavy is not None:
            heavy.require_range(frequency)

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers."""
        call = prepared_tangent(self._reaction)

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, Sequence[float]]:
            self.tangents += 1
            return call(x, y, vx, vy, speed)

        return tangent


class CountedWall(Counted):
    """The same of a reaction that says itself where its journal touches."""

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film [m], shape (...), of journals at positions (2, ...) [m]."""
        return minimum_film(self._reaction, require_vector("position", position))


def counted_calls(reaction: Reaction) -> Counted:
    """Return a reaction that counts its evaluations."""
    return (CountedWall if isinstance(reaction, WalledReaction) else Counted)(reaction)
