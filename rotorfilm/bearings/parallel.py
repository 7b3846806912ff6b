"""Several reactions on one journal, as a bearing beside a seal, or beside a ring that is rubbed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, require_tuple, require_vector
from ..inputs.si_arguments import quantities
from ..model import Array, Reaction, largest_eccentricity_ratio, require_reaction
from ..reactions.added_mass import inertial
from ..reactions.carried_load import carries_load
from ..signals import Signal
from .contact_place import minimum_film
from .inertial_model import InertialModel
from .reaction import broadcast_state


@quantities
@dataclass(frozen=True)
class ParallelReaction(InertialModel):
    """Reactions without states on one journal: their forces and added masses add up.

    Parameters
    ----------
    reactions : tuple of Reaction
        Two at least, all about the same center.

    Raises
    ------
    InputError
        If there are fewer, or one is no Reaction or has states.
    """

    reactions: tuple[Reaction, ...]

    def __post_init__(self) -> None:
        require_tuple("reactions", self.reactions, object)
        if len(self.reactions) < 2:
            raise InputError(f"reactions must be two at least, got {len(self.reactions)}")
        for number, reaction in enumerate(self.reactions):
            require_reaction(f"reactions[{number}]", reaction, heavy=True)
            if reaction.states:
                raise InputError(f"reactions must have no states, got {reaction!r}")

    @property
    def clearance(self) -> float:
        """The smallest radial clearance [m]."""
        return min(reaction.clearance for reaction in self.reactions)

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio, of the smallest clearance, to which all are meant."""
        reaches = [largest_eccentricity_ratio(one) * one.clearance for one in self.reactions]
        return min(reaches) / self.clearance if np.isfinite(self.clearance) else 1.0

    @property
    def nominal_force(self) -> float:
        """The largest nominal force [N]."""
        return max(reaction.outputs[0].nominal for reaction in self.reactions)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed, as of the reaction with the smallest nominal displacement."""
        return min((reaction.inputs for reaction in self.reactions), key=lambda signals: signals[0].nominal)

    @property
    def carries_load(self) -> bool:
        """Whether one of them is a bearing, not a seal."""
        return any(map(carries_load, self.reactions))

    @property
    def has_inertia(self) -> bool:
        """Whether one of them adds a mass to the rotor."""
        return any(inertial(reaction) for reaction in self.reactions)

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film of all [m], shape (...), of journals at positions (2, ...) [m]."""
        q = require_vector("position", position)
        return np.min([minimum_film(reaction, q) for reaction in self.reactions], axis=0)

    def require_film(self, position: Array) -> None:
        """Do nothing: each reaction says itself where it is touched."""

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the added mass of all [kg], shape (2, 2, ...)."""
        q, v, omega = broadcast_state(position, velocity, speed)
        heavy = [one for reaction in self.reactions if (one := inertial(reaction))]
        return np.sum([np.zeros((2, *q.shape)), *(one.mass(q, v, omega) for one in heavy)], axis=0)

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d mass / d (x, y, vx, vy, speed), shape (2, 2, 5, ...)."""
        q, v, omega = broadcast_state(position, velocity, speed)
        heavy = [one for reaction in self.reactions if (one := inertial(reaction))]
        none = np.zeros((2, 2, 5, *q.shape[1:]))
        return np.sum([none, *(one.mass_slopes(q, v, omega) for one in heavy)], axis=0)

    def require_range(self, frequency: float) -> None:
        """Warn, or raise InputError, where the inertia of one ends, for whirl at [rad/s].

        Parameters
        ----------
        frequency : float [rad/s]
            Of the motion.
        """
        for reaction in self.reactions:
            if heavy := inertial(reaction):
                heavy.require_range(frequency)

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return np.sum([one.force(position, velocity, speed) for one in self.reactions], axis=0)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return np.sum([one.jacobian(position, velocity, speed) for one in self.reactions], axis=0)
