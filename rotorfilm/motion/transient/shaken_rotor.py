"""A rotor on a film that a force begins to shake, and what another film would change along its motion."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...model import Array, Reaction
from .equal_steps import MarchMotion, Pull, linear_march, march


class RestTangent(NamedTuple):
    """A film of constant stiffness and damping.

    Attributes
    ----------
    force : ndarray, shape (2,) [N]
        On the journal at rest.
    stiffness, damping : ndarray, shape (2, 2) [N/m], [N s/m]
    """

    force: Array
    stiffness: Array
    damping: Array


class StatesAlong(NamedTuple):
    """Some of the states of a motion.

    Attributes
    ----------
    position, velocity : ndarray, shape (2, n) [m, m/s]
    step : float [s]
        From one to the next.
    """

    position: Array
    velocity: Array
    step: float


class TangentsAlong(NamedTuple):
    """A film along a motion.

    Attributes
    ----------
    force : ndarray, shape (2, n) [N]
    stiffness, damping : ndarray, shape (2, 2, n) [N/m], [N s/m]
    """

    force: Array
    stiffness: Array
    damping: Array


class ShakenRotor(NamedTuple):
    """A rotor at rest, and a force that acts on it from t = 0.

    Attributes
    ----------
    reaction : Reaction
        What holds it.
    mass : float [kg]
    speed : float [rad/s]
        That the film feels.
    rest : ndarray, shape (2,) [m]
    pull : callable
        External force (x, y) [N] at a time [s].
    """

    reaction: Reaction
    mass: float
    speed: float
    rest: Array
    pull: Pull

    def nonlinear(self, step: float, count: int) -> tuple[MarchMotion, int]:
        """Return the motion in equal steps and the number of tangents, as `march`."""
        return march(self.reaction, self.mass, self.speed, self.pull, self.rest, step, count)

    def linear(self, film: RestTangent, step: float, count: int) -> MarchMotion:
        """Return the motion about the rest on a film of constant stiffness and damping, in the same steps."""
        pulls = np.array([self.pull(n * step) for n in range(count + 1)]).T + film.force[:, None]
        stiffness, damping = (_constant(part, count + 1) for part in (film.stiffness, film.damping))
        moved = linear_march(self.mass, stiffness, damping, pulls, step)
        position = self.rest[:, None] + moved.position
        return MarchMotion(time=moved.time, position=position, velocity=moved.velocity)

    def tangents(self, film: Reaction | RestTangent, states: StatesAlong) -> TangentsAlong:
        """Return force and derivatives of a film along a motion."""
        q, v, count = states.position, states.velocity, states.position.shape[1]
        if isinstance(film, RestTangent):
            force = film.force[:, None] - film.stiffness @ (q - self.rest[:, None]) - film.damping @ v
            return TangentsAlong(force, _constant(film.stiffness, count), _constant(film.damping, count))
        speeds = np.full(count, self.speed)
        slopes = film.jacobian(q, v, speeds)
        return TangentsAlong(film.force(q, v, speeds), -slopes[:, :2], -slopes[:, 2:4])

    def propagated(
        self, states: StatesAlong, own: Reaction | RestTangent, rich: Reaction
    ) -> tuple[Array, float]:
        """Return how much a richer film moves the journal (2, n) [m], to first order.

        With it comes the relative distance to what the slopes of the rotor's own film make of the same
        forces.
        """
        film, other = self.tangents(own, states), self.tangents(rich, states)
        defect = other.force - film.force
        moved, owned = (
            linear_march(self.mass, each.stiffness, each.damping, defect, states.step).position
            for each in (other, film)
        )
        size = float(np.linalg.norm(moved))
        return moved, float(np.linalg.norm(moved - owned)) / size if size else 0.0


def states_along(motion: MarchMotion, stride: int) -> StatesAlong:
    """Return every so many-th state of a motion."""
    step = float(motion.time[stride] - motion.time[0])
    return StatesAlong(motion.position[:, ::stride].copy(), motion.velocity[:, ::stride].copy(), step)


def _constant(matrix: Array, count: int) -> Array:
    return np.repeat(matrix[:, :, None], count, axis=2)
