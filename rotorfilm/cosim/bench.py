"""What a coupling scheme works on: a rotor and its films, exchanged as arrays."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

import numpy as np

from ..model import Array
from ..rotors.force_law import ForceLaw


class StationMotion(NamedTuple):
    """What a rotor gives to its films.

    Attributes
    ----------
    position, velocity : ndarray, shape (m, ...) [m], [m/s]
        x and y of each journal in turn.
    speed : float [rad/s]
    outputs : dict of str to float
        All outputs of the rotor.
    """

    position: Array
    velocity: Array
    speed: float
    outputs: dict[str, float]


class Tangents(NamedTuple):
    """Exact derivatives of all films.

    Attributes
    ----------
    stiffness, damping : ndarray, shape (m, m) [N/m], [N s/m]
        K = -dF/dq and C = -dF/dv, no station on another.
    by_speed : ndarray, shape (m,) [N s]
        dF/d speed.
    """

    stiffness: Array
    damping: Array
    by_speed: Array

    def by_speed_change(self, change: float, like: Array) -> Array:
        """Return the change of the forces with that of the speed [rad/s], of the shape of `like`."""
        return np.zeros_like(like) + (change * self.by_speed).reshape(-1, *(1,) * (like.ndim - 1))


def no_tangents(size: int) -> Tangents:
    """Return the derivatives of films whose forces, `size` of them, do not change."""
    return Tangents(np.zeros((size, size)), np.zeros((size, size)), np.zeros(size))


class Sample(NamedTuple):
    """What was exchanged at one communication point.

    Attributes
    ----------
    time : float [s]
    motion : StationMotion
    force : ndarray, shape (m, ...) [N]
        Forces of the films.
    tangents : Tangents or None
        Where the scheme asks for them.
    outputs : dict of str to float
        All outputs of the films.
    """

    time: float
    motion: StationMotion
    force: Array
    tangents: Tangents | None
    outputs: dict[str, float]


class Bench(Protocol):
    """What a scheme may do with rotor and films."""

    def drive(self, t: float, dt: float, law: ForceLaw) -> StationMotion:
        """Advance the rotor from t to t + dt [s] under a force law."""

    def evaluate(self, t: float, dt: float, motion: StationMotion, derive: bool) -> Sample:
        """Step the films from t to t + dt [s] with this motion at the end; derivatives if asked."""

    def sensitivity(self, t: float, dt: float) -> Array:
        """Return d(position, velocity at t + dt)/d(held force) of the rotor, shape (2 m, m)."""

    def save(self) -> Any:
        """Return the state of rotor and films."""

    def restore(self, state: Any) -> None:
        """Return to a state; it is forgotten."""

    def release(self, state: Any) -> None:
        """Forget a state."""


class Needs(NamedTuple):
    """What a scheme asks of its partners.

    Attributes
    ----------
    derivatives : bool
        Films tell their exact derivatives.
    laws : bool
        The rotor takes force laws, not held forces alone.
    rollback : bool
        Rotor and films can go back.
    """

    derivatives: bool = False
    laws: bool = False
    rollback: bool = False
