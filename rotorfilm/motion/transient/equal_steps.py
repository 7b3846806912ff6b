"""Motion of a rigid rotor on one journal film in equal steps: the rungs of a question about time."""

from __future__ import annotations

from collections.abc import Callable
from ctypes import byref
from dataclasses import dataclass

import numpy as np

from ...bearings.contact_place import WalledReaction
from ...errors import ConvergenceError, FilmContactError, RotorfilmError, UndefinedDerivativeError
from ...model import Array, Reaction
from ...native import Status
from ...native.layouts.structs import ShakenStruct
from ...native.library import loops
from ..compiled.film_calls import heavy_call, raise_foreign, warn_beyond

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
    reaction: Reaction, mass: float, speed: float, pull: Pull, rest: Array, step: float, count: int
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
    call, heavy = heavy_call(reaction)
    pulls = np.array([pull(n * step) for n in range(count + 1)])
    pulls[0] += np.asarray(reaction.force(rest, np.zeros(2), speed))
    motion = np.zeros((count + 1, 4))
    motion[0, :2] = rest
    wall = (FAR if isinstance(reaction, WalledReaction) else 1.0) * reaction.clearance
    rotor = ShakenStruct(call.address, call.data, mass, speed, wall, step)
    rotor.heavy, rotor.loaded = heavy
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
