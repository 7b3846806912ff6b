"""Where a journal touches: at a circle of the radial clearance, or where its bearing says."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ..model import Array, JournalForce


@runtime_checkable
class WalledReaction(Protocol):
    """What a Reaction may add whose journal touches elsewhere than at a circle of the radial clearance."""

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film [m], shape (...), of journals at positions (2, ...) [m]."""


def minimum_film(reaction: JournalForce, position: Array) -> Array:
    """Return the least film [m], shape (...), that any reaction has at positions (2, ...) [m]."""
    if isinstance(reaction, WalledReaction):
        return reaction.minimum_film(position)
    return np.asarray(reaction.clearance - np.hypot(position[0], position[1]))


def reach(reaction: JournalForce, positions: Array) -> float:
    """Return how far the way of journals (2, ...) [m] goes towards contact: 1 - least film / clearance."""
    if isinstance(reaction, WalledReaction):
        return 1.0 - float(np.min(reaction.minimum_film(positions))) / reaction.clearance
    return float(np.hypot(positions[0], positions[1]).max()) / reaction.clearance


def relative_film(reaction: JournalForce, position: Array) -> float:
    """Return the least film of a journal at a position (2,) [m], in clearances."""
    if isinstance(reaction, WalledReaction):
        return float(reaction.minimum_film(position)) / reaction.clearance
    return 1.0 - float(np.hypot(position[0], position[1])) / reaction.clearance
