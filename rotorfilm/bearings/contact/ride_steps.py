"""Compiled Runge-Kutta steps of a ball on its reduced contact law."""

from __future__ import annotations

import numpy as np

from ...model import Array
from ..films.compiled import compiled


@compiled
def force_of(delta: float, x: Array, C: Array, D: float, law: Array) -> float:
    """Return the force of the film, which does not pull; law = (offset, span, exponent, operating)."""
    depth = max(law[0] - delta, 0.0) / law[1]
    answer = depth ** law[2] + D * (min(delta, law[0]) - law[3])
    for k in range(x.size):
        answer += C[k] * x[k]
    return max(answer, 0.0)


@compiled
def fill_rates(
    y: Array, push: float, W: float, A: Array, B: Array, C: Array, D: float, law: Array, out: Array
) -> None:
    """Write the rates of y = (delta, velocity, states) under a load `push`."""
    states = y[2:]
    out[0] = y[1]
    out[1] = (force_of(y[0], states, C, D, law) - push) / W
    drive = min(y[0], law[0]) - law[3]  # a ball that has left no longer drives the film
    for i in range(states.size):
        total = B[i] * drive
        for j in range(states.size):
            total += A[i, j] * states[j]
        out[2 + i] = total


@compiled
def ride_steps(
    start: Array, step: float, pushes: Array, W: float, A: Array, B: Array, C: Array, D: float, law: Array
) -> Array:
    """Return delta, velocity and states, (n + 1, 2 + order), after each of n equal steps of order four.

    `pushes`, (2 n + 1,), are the loads at the ends and middles of the steps. All is dimensionless.
    """
    n, size = pushes.size // 2, start.size
    answer = np.empty((n + 1, size))
    for i in range(size):
        answer[0, i] = start[i]
    k = np.empty((4, size))
    now = np.empty(size)
    for m in range(n):
        y = answer[m]
        fill_rates(y, pushes[2 * m], W, A, B, C, D, law, k[0])
        for i in range(size):
            now[i] = y[i] + 0.5 * step * k[0, i]
        fill_rates(now, pushes[2 * m + 1], W, A, B, C, D, law, k[1])
        for i in range(size):
            now[i] = y[i] + 0.5 * step * k[1, i]
        fill_rates(now, pushes[2 * m + 1], W, A, B, C, D, law, k[2])
        for i in range(size):
            now[i] = y[i] + step * k[2, i]
        fill_rates(now, pushes[2 * m + 2], W, A, B, C, D, law, k[3])
        for i in range(size):
            answer[m + 1, i] = y[i] + step / 6.0 * (k[0, i] + 2.0 * k[1, i] + 2.0 * k[2, i] + k[3, i])
    return answer


@compiled
def forces_of(rows: Array, C: Array, D: float, law: Array) -> Array:
    """Return the forces at rows of (delta, velocity, states)."""
    answer = np.empty(rows.shape[0])
    for m in range(rows.shape[0]):
        answer[m] = force_of(rows[m, 0], rows[m, 2:], C, D, law)
    return answer
