"""How many exponents grow, by the phase of a determinant: what no search for them can miss."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np

from ...errors import ConvergenceError
from ...model import Array

STEP = 0.6
"""Largest turn of the phase from one frequency to the next [rad]."""

NEAR_ONE = 0.5
"""Distance of D/E from 1 at the last frequency."""

_HALVINGS, _DOUBLINGS = 40, 40


def growing_count(ratio: Callable[[float], complex], frequencies: Array, reference: int = 0) -> int:
    """Return how many roots s of a determinant D(s) of real motions have a positive real part.

    With E(s) of the same degree whose number of such roots is known, D/E turns by pi for each root that E has
    more, while s goes from 0 to i infinity (the principle of the argument; roots off the real line come in
    pairs).

    Parameters
    ----------
    ratio : callable
        From a frequency nu [rad/s] to D(i nu)/E(i nu), real at 0, and 1 at infinity.
    frequencies : ndarray, shape (n,) [rad/s]
        Rising from 0, close enough that no whole turn falls between two of them; steps in which the phase
        turns far are halved. From the last they are doubled until D/E is near 1, so that the phase stays
        within a quarter of a turn beyond them.
    reference : int
        The number of such roots of E.

    Raises
    ------
    ConvergenceError
        If the phase jumps: a root on the imaginary axis itself.
    """
    points = [(float(nu), ratio(float(nu))) for nu in frequencies]
    while abs(points[-1][1] - 1.0) > NEAR_ONE and len(points) < len(frequencies) + _DOUBLINGS:
        points.append((2.0 * points[-1][0], ratio(2.0 * points[-1][0])))
    turn = sum(_turn(ratio, low, high) for low, high in pairwise(points))
    last = points[-1][1]
    turn -= math.atan2(last.imag, last.real)
    return reference - round(turn / math.pi)


def _turn(
    ratio: Callable[[float], complex], low: tuple[float, complex], high: tuple[float, complex]
) -> float:
    """Return the turn of the phase between two frequencies with their values [rad]."""
    total, parts = 0.0, [(low, high, 0)]
    while parts:
        low, high, depth = parts.pop()
        step = float(np.angle(high[1] / low[1])) if low[1] else math.inf
        if abs(step) <= STEP:
            total += step
            continue
        if depth == _HALVINGS:
            raise ConvergenceError(
                f"the phase must be smooth to count what grows, and jumps at {high[0]:.8g} rad/s: there is a "
                "motion that neither grows nor decays"
            )
        nu = 0.5 * (low[0] + high[0])
        middle = (nu, ratio(nu))
        parts += [(low, middle, depth + 1), (middle, high, depth + 1)]
    return total
