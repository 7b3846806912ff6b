"""Reactions at one place of a journal: a bearing beside a seal or a rubbed ring, a damper with springs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import InputError, require_kind, require_positive, require_tuple, require_vector
from ..core.inputs import quantities
from ..core.model import Array
from ..core.port import (
    Force,
    PlanarReaction,
    Tangent,
    carries_load,
    has_wall,
    inertial,
    largest_eccentricity_ratio,
    minimum_film,
    prepared_force,
    prepared_tangent,
    require_reaction,
)
from ..core.signals import Signal
from ..native.spec import HasKernel, NativeSpec
from .reaction import InertialModel, broadcast_state


class SharedReaction(InertialModel):
    """What a reaction made of `reactions` at one place takes from them: wall, size and added mass."""

    @property
    def clearance(self: Any) -> float:
        """The smallest radial clearance [m]."""
        return min(reaction.clearance for reaction in self.reactions)

    @property
    def largest_eccentricity_ratio(self: Any) -> float:
        """Eccentricity ratio, of the smallest clearance, to which all are meant."""
        if not np.isfinite(self.clearance):
            return 1.0
        return min(
            largest_eccentricity_ratio(one) * (one.clearance / self.clearance) for one in self.reactions
        )

    @property
    def nominal_force(self: Any) -> float:
        """The largest nominal force [N]."""
        return max(reaction.outputs[0].nominal for reaction in self.reactions)

    @property
    def has_inertia(self) -> bool:
        """Whether one of them adds a mass to the rotor."""
        return bool(self._heavy)

    @property
    def _heavy(self: Any) -> list[Any]:
        return [heavy for reaction in self.reactions if (heavy := inertial(reaction))]

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the added mass of all [kg], shape (2, 2, ...)."""
        q, v, omega = broadcast_state(position, velocity, speed)
        return np.sum([np.zeros((2, *q.shape)), *(one.mass(q, v, omega) for one in self._heavy)], axis=0)

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d mass / d (x, y, vx, vy, speed), shape (2, 2, 5, ...)."""
        q, v, omega = broadcast_state(position, velocity, speed)
        none = np.zeros((2, 2, 5, *q.shape[1:]))
        return np.sum([none, *(one.mass_slopes(q, v, omega) for one in self._heavy)], axis=0)

    def require_range(self, frequency: float) -> None:
        """Warn, or raise InputError, where the inertia of one ends, for whirl at [rad/s].

        Parameters
        ----------
        frequency : float [rad/s]
            Of the motion.
        """
        for heavy in self._heavy:
            heavy.require_range(frequency)


@quantities
@dataclass(frozen=True)
class ParallelReaction(SharedReaction):
    """Reactions without states on one journal: their forces and added masses add up.

    Parameters
    ----------
    reactions : tuple of PlanarReaction
        Two at least, all about the same center.

    Raises
    ------
    InputError
        If there are fewer, or one is no PlanarReaction or has states.
    """

    reactions: tuple[PlanarReaction, ...]

    def __post_init__(self) -> None:
        require_tuple("reactions", self.reactions, object)
        if len(self.reactions) < 2:
            raise InputError(f"reactions must be two at least, got {len(self.reactions)}")
        for number, reaction in enumerate(self.reactions):
            require_reaction(f"reactions[{number}]", reaction, heavy=True)
            if reaction.states:
                raise InputError(f"reactions must have no states, got {reaction!r}")

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed, as of the reaction with the smallest nominal displacement."""
        return min((reaction.inputs for reaction in self.reactions), key=lambda signals: signals[0].nominal)

    @property
    def carries_load(self) -> bool:
        """Whether one of them is a bearing, not a seal."""
        return any(map(carries_load, self.reactions))

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film of all [m], shape (...), of journals at positions (2, ...) [m]."""
        q = require_vector("position", position)
        return np.min([minimum_film(reaction, q) for reaction in self.reactions], axis=0)

    def require_film(self, position: Array) -> None:
        """Do nothing: each reaction says itself where it is touched."""

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return np.sum([one.force(position, velocity, speed) for one in self.reactions], axis=0)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return np.sum([one.jacobian(position, velocity, speed) for one in self.reactions], axis=0)


# A reaction beside springs to the housing, as the retainer springs of a squeeze-film damper.


@quantities
@dataclass(frozen=True, kw_only=True)
class Sprung(SharedReaction):
    """A reaction in parallel with equal springs along x and y: F = reaction - stiffness * position.

    The springs are preloaded so that they carry the static load where the rotor is centered: give the rotor
    no gravity. Their force is part of what reaches the housing.

    Parameters
    ----------
    reaction : PlanarReaction
        Such as a `PorousDamper`.
    stiffness : float [N/m]
        Of the springs together, along either axis.

    Raises
    ------
    InputError
        If the reaction is none or the stiffness is not positive.
    """

    reaction: PlanarReaction
    stiffness: float

    def __post_init__(self) -> None:
        require_kind("reaction", self.reaction, PlanarReaction, "a PlanarReaction such as a PorousDamper")
        require_positive("stiffness", self.stiffness)

    @property
    def reactions(self) -> tuple[PlanarReaction]:
        """The reaction alone: its springs add no mass, and have no wall."""
        return (self.reaction,)

    carries_load: ClassVar[bool] = True
    """Whether it is a bearing: its springs carry the rotor, whatever is beside them."""

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film of the reaction [m], shape (...), of journals at positions (2, ...) [m]."""
        return minimum_film(self.reaction, require_vector("position", position))

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError where the journal touches; a reaction with a wall of its own does itself."""
        if not has_wall(self.reaction):
            super().require_film(position)

    def force_along(
        self, position: Array, velocity: Array, acceleration: Array, speed: ArrayLike = 0.0
    ) -> Array:
        """Return the force in a motion with that of the added mass, shape (2, n) [N]; see `InertialModel`."""
        along: Any = getattr(self.reaction, "force_along", None)
        if along is None:
            return super().force_along(position, velocity, acceleration, speed)
        return np.asarray(along(position, velocity, acceleration, speed)) - self.stiffness * position

    def native(self) -> NativeSpec | None:
        """Return the kernel of the reaction with these springs; None where it takes none."""
        if type(self) is not Sprung or not isinstance(self.reaction, HasKernel):
            return None
        spec = self.reaction.native()
        return None if spec is None else spec.stiffened(self.stiffness)

    def prepare(self) -> Force:
        """Return the force as a function of five numbers; see `StaticReaction.prepare`."""
        call, stiffness = prepared_force(self.reaction), self.stiffness

        def force(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
            force_x, force_y = call(x, y, vx, vy, speed)
            return force_x - stiffness * x, force_y - stiffness * y

        return force

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers; see `prepared_tangent`."""
        call, stiffness = prepared_tangent(self.reaction), self.stiffness

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, Sequence[float]]:
            force_x, force_y, slopes = call(x, y, vx, vy, speed)
            total = [*slopes]
            total[0] -= stiffness
            total[6] -= stiffness
            return force_x - stiffness * x, force_y - stiffness * y, total

        return tangent

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return self.reaction.force(position, velocity, speed) - self.stiffness * position

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, inside the clearance."""
        jacobian = np.array(self.reaction.jacobian(position, velocity, speed))
        jacobian[0, 0] -= self.stiffness
        jacobian[1, 1] -= self.stiffness
        return jacobian
