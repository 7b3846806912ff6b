"""A rotor on a film that a force begins to shake, and what another film would change along its motion."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...bearings.inertial_model import InertialModel
from ...model import Array, Reaction
from ...reactions.added_mass import inertial
from .equal_steps import MarchMotion, Pull, linear_march, march

NONE = np.zeros((2, 2))


class RestTangent(NamedTuple):
    """A film of constant stiffness and damping.

    Attributes
    ----------
    force : ndarray, shape (2,) [N]
        On the journal at rest.
    stiffness, damping : ndarray, shape (2, 2) [N/m], [N s/m]
    mass : ndarray, shape (2, 2) [kg]
        That the film adds.
    """

    force: Array
    stiffness: Array
    damping: Array
    mass: Array = NONE


class StatesAlong(NamedTuple):
    """Some of the states of a motion.

    Attributes
    ----------
    position, velocity, acceleration : ndarray, shape (2, n) [m, m/s, m/s2]
    step : float [s]
        From one to the next.
    """

    position: Array
    velocity: Array
    acceleration: Array
    step: float


class TangentsAlong(NamedTuple):
    """A film along a motion.

    Attributes
    ----------
    force : ndarray, shape (2, n) [N]
        With that of an added mass.
    stiffness, damping, mass : ndarray, shape (2, 2, n) [N/m], [N s/m], [kg]
        The mass is the added one.
    """

    force: Array
    stiffness: Array
    damping: Array
    mass: Array


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
        mass, stiffness, damping = (
            np.repeat(part[:, :, None], count + 1, axis=2)
            for part in (self._whole(film.mass[:, :, None])[:, :, 0], film.stiffness, film.damping)
        )
        moved = linear_march(mass, stiffness, damping, pulls, step)
        position = self.rest[:, None] + moved.position
        return MarchMotion(time=moved.time, position=position, velocity=moved.velocity)

    def tangents(self, film: Reaction | RestTangent, states: StatesAlong) -> TangentsAlong:
        """Return force and derivatives of a film along a motion."""
        q, v, a, count = states.position, states.velocity, states.acceleration, states.position.shape[1]
        if isinstance(film, RestTangent):
            force = film.force[:, None] - film.stiffness @ (q - self.rest[:, None]) - film.damping @ v
            parts = (np.repeat(part[:, :, None], count, axis=2) for part in film[1:])
            return TangentsAlong(force - film.mass @ a, *parts)
        speeds = np.full(count, self.speed)
        slopes = film.jacobian(q, v, speeds)[:, :4]
        heavy = inertial(film)
        if heavy is None or not isinstance(film, InertialModel):
            return TangentsAlong(
                film.force(q, v, speeds), -slopes[:, :2], -slopes[:, 2:], np.zeros((2, 2, count))
            )
        by_motion = heavy.mass_slopes(q, v, speeds)[:, :, :4]
        slopes = slopes - np.einsum("ijk...,j...->ik...", by_motion, a)
        force = film.force_along(q, v, a, speeds)  # type: ignore[misc]  # heavy and film are one
        mass = heavy.mass(q, v, speeds)
        return TangentsAlong(force, -slopes[:, :2], -slopes[:, 2:], mass)

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
            linear_march(self._whole(each.mass), each.stiffness, each.damping, defect, states.step).position
            for each in (other, film)
        )
        size = float(np.linalg.norm(moved))
        return moved, float(np.linalg.norm(moved - owned)) / size if size else 0.0

    def _whole(self, added: Array) -> Array:
        """Return the mass of rotor and film, shape (2, 2, n)."""
        return self.mass * np.eye(2)[:, :, None] + added


def states_along(motion: MarchMotion, stride: int) -> StatesAlong:
    """Return every so many-th state of a motion."""
    step = float(motion.time[stride] - motion.time[0])
    acceleration = np.gradient(motion.velocity, motion.time, axis=1)
    q, v, a = (part[:, ::stride].copy() for part in (motion.position, motion.velocity, acceleration))
    return StatesAlong(q, v, a, step)
