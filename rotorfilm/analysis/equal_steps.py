"""Motion of a rigid rotor on one journal film in equal steps: the rungs of a question about time."""

from __future__ import annotations

import math
from collections.abc import Callable
from ctypes import byref
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import ConvergenceError, FilmContactError, RotorfilmError, UndefinedDerivativeError
from ..core.model import Array
from ..core.port import force_along, has_wall, inertial
from ..native import Status
from ..native.library import loops
from ..native.structs import structure
from .force_calls import call_with_added_mass, raise_foreign, warn_beyond

ORDER = 2
"""Of the average acceleration in the step."""


@dataclass(frozen=True, kw_only=True)
class MarchMotion:
    """Motion at equal steps.

    Attributes
    ----------
    time : ndarray, shape (n,) [s]
    position, velocity : ndarray, shape (2, n) [m, m/s]
    """

    time: Array
    position: Array
    velocity: Array


Pull = Callable[[float], tuple[float, float]]
"""External force (x, y) [N] at a time [s]."""

FAR = 10.0
"""Beyond any place where pads are touched, which say so themselves, in clearances."""


def march(
    reaction: Any, mass: float, speed: float, pull: Pull, rest: Array, step: float, count: int
) -> tuple[MarchMotion, int]:
    """Return the motion from rest by average acceleration (native/loops/shake.h), and the number of tangents.

    Raises
    ------
    FilmContactError
        If the journal reaches the wall.
    UndefinedDerivativeError
        If the film has no derivative on the way.
    ConvergenceError
        If Newton's method does not end, or the film force is not finite.
    """
    call = call_with_added_mass(reaction)
    pulls = np.array([pull(n * step) for n in range(count + 1)])
    pulls[0] += np.asarray(reaction.force(rest, np.zeros(2), speed))
    motion = np.zeros((count + 1, 4))
    motion[0, :2] = rest
    wall = (FAR if has_wall(reaction) else 1.0) * reaction.clearance
    rotor = structure("rf_shaken")(call.address, call.data, mass, speed, wall, step)
    rotor.heavy, rotor.loaded = call.mass
    status = loops()["rf_follow_shaken"](byref(rotor), count, pulls.ctypes.data, motion.ctypes.data)
    raise_foreign([call])
    if rotor.left_map:
        warn_beyond([call])
    if status != Status.OK:
        raise _failure(status, rotor.done + 1, step)
    time = np.asarray(step * np.arange(count + 1))
    return MarchMotion(time=time, position=motion[:, :2].T, velocity=motion[:, 2:].T), 1 + rotor.calls


def _failure(status: int, number: int, step: float) -> RotorfilmError:
    """Return why a step was not made."""
    at = f"at {number * step:.6g} s"
    if status == Status.AT_WALL:
        return FilmContactError(f"the journal must stay inside the clearance, got to the wall {at}")
    if status == Status.UNDEFINED:
        return UndefinedDerivativeError(f"the film must have a derivative along the motion, it has none {at}")
    if status == Status.NOT_FINITE:
        return ConvergenceError(f"film force must be finite {at}")
    return ConvergenceError(f"Newton's method must end at step {number}, {at}")


def linear_march(mass: Array, stiffness: Array, damping: Array, pull: Array, step: float) -> MarchMotion:
    """Return the answer to M q'' + C q' + K q = pull (2, n) by the same steps from rest; all (2, 2, n)."""
    count = pull.shape[1]
    path, rates = np.zeros((2, count)), np.zeros((2, count))
    k2, k1 = 4.0 / step**2, 2.0 / step
    whole = k2 * mass + k1 * damping + stiffness
    inverse = np.moveaxis(np.linalg.inv(np.moveaxis(whole, -1, 0)), 0, -1).reshape(4, -1).T.tolist()
    dampers, masses, pulls = (
        damping.reshape(4, -1).T.tolist(),
        mass.reshape(4, -1).T.tolist(),
        pull.T.tolist(),
    )
    x, y, vx, vy = 0.0, 0.0, 0.0, 0.0
    ax, ay = np.linalg.solve(mass[:, :, 0], pull[:, 0]).tolist()
    for n in range(1, count):
        (a, b, c, d), (dxx, dxy, dyx, dyy), (px, py) = inverse[n], dampers[n], pulls[n]
        mxx, mxy, myx, myy = masses[n]
        wx, wy = k1 * x + vx, k1 * y + vy
        ux, uy = k2 * (x + step * vx) + ax, k2 * (y + step * vy) + ay
        kx = px + mxx * ux + mxy * uy + dxx * wx + dxy * wy
        ky = py + myx * ux + myy * uy + dyx * wx + dyy * wy
        qx, qy = a * kx + b * ky, c * kx + d * ky
        ax, ay = k2 * (qx - x - step * vx) - ax, k2 * (qy - y - step * vy) - ay
        vx, vy = k1 * (qx - x) - vx, k1 * (qy - y) - vy
        x, y = qx, qy
        path[:, n], rates[:, n] = (x, y), (vx, vy)
    return MarchMotion(time=np.asarray(step * np.arange(count)), position=path, velocity=rates)


def peak(position: Array) -> float:
    """Return the largest distance from the center (2, n) [m], by a parabola through the largest sample."""
    distance = np.hypot(*position)
    k = int(np.argmax(distance))
    if not 0 < k < distance.size - 1:
        return float(distance[k])
    low, top, high = distance[k - 1 : k + 2]
    bend = low - 2.0 * top + high
    return float(top - (high - low) ** 2 / (8.0 * bend)) if bend < 0.0 else float(top)


# A rotor on a film that a force begins to shake, and what another film would change along its motion.


NONE = np.zeros((2, 2))


class RestTangent(NamedTuple):
    """A film of constant stiffness and damping, or along a motion of n places, which then is the last axis.

    Attributes
    ----------
    force : ndarray, shape (2, ...) [N]
        Force on the journal at rest; along a motion with that of an added mass.
    stiffness, damping : ndarray, shape (2, 2, ...) [N/m], [N s/m]
    mass : ndarray, shape (2, 2, ...) [kg]
        Mass that the film adds.
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
        Step from one to the next.
    """

    position: Array
    velocity: Array
    acceleration: Array
    step: float


class ExcitedRotor(NamedTuple):
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

    reaction: Any
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

    def tangents(self, film: Any | RestTangent, states: StatesAlong) -> RestTangent:
        """Return force and derivatives of a film along a motion."""
        q, v, a, count = states.position, states.velocity, states.acceleration, states.position.shape[1]
        if isinstance(film, RestTangent):
            force = film.force[:, None] - film.stiffness @ (q - self.rest[:, None]) - film.damping @ v
            parts = (np.repeat(part[:, :, None], count, axis=2) for part in film[1:])
            return RestTangent(force - film.mass @ a, *parts)
        speeds = np.full(count, self.speed)
        slopes, mass, heavy = film.jacobian(q, v, speeds)[:, :4], np.zeros((2, 2, count)), inertial(film)
        if heavy is not None:
            by_motion, mass = heavy.mass_slopes(q, v, speeds)[:, :, :4], heavy.mass(q, v, speeds)
            slopes = slopes - np.einsum("ijk...,j...->ik...", by_motion, a)
        return RestTangent(force_along(film, q, v, a, speeds), -slopes[:, :2], -slopes[:, 2:], mass)

    def propagated(self, states: StatesAlong, own: Any | RestTangent, rich: Any) -> tuple[Array, float]:
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


# How far one number drifts off its course by a defect of its rate.


def scalar_drift(time: Array, defect: Array, slope: Array) -> float:
    """Return the end of d' = slope d + defect from zero, by exponential steps with means of the slope."""
    moved = 0.0
    for k in range(1, time.size):
        step = float(time[k] - time[k - 1])
        z = 0.5 * float(slope[k] + slope[k - 1]) * step
        grown = math.exp(z)
        # Integrals of exp(z (1 - s)) and of exp(z (1 - s)) s over the step.
        one = math.expm1(z) / z if abs(z) > 1e-6 else 1.0 + 0.5 * z
        two = (one - 1.0) / z if abs(z) > 1e-3 else 0.5 + z / 6.0
        moved = grown * moved + step * float((one - two) * defect[k - 1] + two * defect[k])
    return moved
