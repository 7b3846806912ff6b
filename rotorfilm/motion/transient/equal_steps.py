"""Motion of a rigid rotor on one journal film in equal steps: the rungs of a question about time."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...errors import ConvergenceError, FilmContactError
from ...model import Array, Reaction, prepared_tangent

ORDER = 2
"""Of the average acceleration in the step."""

NEWTON_STEPS = 20
TOLERANCE = 1e-10
"""Last Newton step, in clearances."""

CONTACT = "the journal must stay inside the clearance"
NEAR = 0.9999
"""Eccentricity ratio from which Newton's method, where it does not end, counts as led to the wall."""


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


def march(
    reaction: Reaction, mass: float, speed: float, pull: Pull, rest: Array, step: float, count: int
) -> tuple[MarchMotion, int]:
    """Return the motion from rest by average acceleration, and the number of tangents.

    With v' = (a + a')/2 and q' = q + dt v + dt^2 (a + a')/4, m a' = F(q', v') + pull(t') is solved for q' by
    Newton's method (trapezoidal rule; order 2).

    Raises
    ------
    FilmContactError
        If the journal reaches the wall.
    ConvergenceError
        If Newton's method does not end.
    """
    tangent, clearance = prepared_tangent(reaction), reaction.clearance
    path, rates = np.empty((2, count + 1)), np.zeros((2, count + 1))
    path[:, 0] = rest
    (x, y), (vx, vy), (ax, ay) = rest.tolist(), (0.0, 0.0), _acceleration(reaction, mass, speed, pull, rest)
    calls, k2, k1 = 1, 4.0 / step**2, 2.0 / step
    for n in range(1, count + 1):
        px, py = pull(n * step)
        # With its acceleration, since a cavitated film has no derivative at rest.
        qx, qy = x + step * (vx + 0.5 * step * ax), y + step * (vy + 0.5 * step * ay)
        if math.hypot(qx, qy) > 0.5 * (clearance + math.hypot(x, y)):
            qx, qy = x, y
        for _ in range(NEWTON_STEPS):
            wx, wy = k1 * (qx - x) - vx, k1 * (qy - y) - vy
            bx, by = k2 * (qx - x - step * vx) - ax, k2 * (qy - y - step * vy) - ay
            fx, fy, D = tangent(qx, qy, wx, wy, speed)
            calls += 1
            rx, ry = fx + px - mass * bx, fy + py - mass * by
            a, b = mass * k2 - D[0] - k1 * D[2], -D[1] - k1 * D[3]
            c, d = -D[5] - k1 * D[7], mass * k2 - D[6] - k1 * D[8]
            det = a * d - b * c
            dx, dy = (d * rx - b * ry) / det, (a * ry - c * rx) / det
            share = _share(qx, qy, dx, dy, clearance, n * step)
            qx, qy = qx + share * dx, qy + share * dy
            if abs(dx) + abs(dy) < TOLERANCE * clearance:
                break
        else:
            _require_inside(qx, qy, clearance, n * step)
            raise ConvergenceError(f"Newton's method must end within {NEWTON_STEPS} steps at step {n}")
        wx, wy = k1 * (qx - x) - vx, k1 * (qy - y) - vy
        ax, ay = k2 * (qx - x - step * vx) - ax, k2 * (qy - y - step * vy) - ay
        x, y, vx, vy = qx, qy, wx, wy
        path[:, n], rates[:, n] = (x, y), (vx, vy)
    return MarchMotion(time=np.asarray(step * np.arange(count + 1)), position=path, velocity=rates), calls


def _share(x: float, y: float, dx: float, dy: float, clearance: float, time: float) -> float:
    """Return the part of a Newton step that leaves a tenth of the gap."""
    limit, share = clearance - 0.1 * (clearance - math.hypot(x, y)), 1.0
    while math.hypot(x + share * dx, y + share * dy) > limit:
        share *= 0.5
        if share < 1e-6:
            raise FilmContactError(f"{CONTACT}, got to the wall at {time:.6g} s")
    return share


def _require_inside(x: float, y: float, clearance: float, time: float) -> None:
    """Raise FilmContactError where Newton's method has been led to the wall."""
    if math.hypot(x, y) > NEAR * clearance:
        raise FilmContactError(f"{CONTACT}, got to the wall at {time:.6g} s")


def _acceleration(
    reaction: Reaction, mass: float, speed: float, pull: Pull, rest: Array
) -> tuple[float, float]:
    fx, fy = np.asarray(reaction.force(rest, np.zeros(2), speed)).tolist()
    px, py = pull(0.0)
    return (fx + px) / mass, (fy + py) / mass


def linear_march(mass: float, stiffness: Array, damping: Array, pull: Array, step: float) -> MarchMotion:
    """Return the answer to m q'' + C q' + K q = pull (2, n) by the same steps from rest; K, C (2, 2, n)."""
    count = pull.shape[1]
    path, rates = np.zeros((2, count)), np.zeros((2, count))
    k2, k1, one = 4.0 / step**2, 2.0 / step, np.eye(2)[:, :, None]
    whole = mass * k2 * one + k1 * damping + stiffness
    inverse = np.moveaxis(np.linalg.inv(np.moveaxis(whole, -1, 0)), 0, -1).reshape(4, -1).T.tolist()
    dampers, pulls = damping.reshape(4, -1).T.tolist(), pull.T.tolist()
    x, y, vx, vy = 0.0, 0.0, 0.0, 0.0
    ax, ay = (force / mass for force in pulls[0])
    for n in range(1, count):
        (a, b, c, d), (dxx, dxy, dyx, dyy), (px, py) = inverse[n], dampers[n], pulls[n]
        wx, wy = k1 * x + vx, k1 * y + vy
        kx = px + mass * (k2 * (x + step * vx) + ax) + dxx * wx + dxy * wy
        ky = py + mass * (k2 * (y + step * vy) + ay) + dyx * wx + dyy * wy
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
