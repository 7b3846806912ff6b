"""Where a shaft comes to rest in a worn liner: the position whose pressure carries a load."""

from __future__ import annotations

import math

import numpy as np

from ...errors import ConvergenceError
from ...model import Array
from .worn_profile import Nodes, Pressed, press, times_stiffness

MAX_ITERATIONS = 100
"""Newton steps, shortened where need be; 5 to 15 are usual."""

SHORTEST = 1e-6
"""Part of a Newton step below which no shorter one is tried."""

TOLERANCE = 1e-12
"""Imbalance, relative to the load, at which the position counts as found."""

ACCEPTED = 1e-9
"""Imbalance, relative to the load, that is accepted where roundoff allows no better."""


def settle(nodes: Nodes, offset: Array, target: Array, start: Array) -> Array:
    """Return the position e, per radius, at which sum of load_i n_i = target.

    Loads are those of the depths n . e - offset. They are the gradient of a convex energy in e, so that
    Newton steps, halved until the imbalance falls, arrive from any start in contact.

    Parameters
    ----------
    nodes : Nodes
    offset : ndarray, shape (n,)
        Distance from the bearing center, along each normal, at which the shaft meets the liner.
    target : ndarray, shape (2,)
        Not zero.
    start : ndarray, shape (2,)

    Raises
    ------
    ConvergenceError
        If there is no such position, because the load points where the nodes have no normals.
    """
    size, at = math.hypot(*target), start
    pressed, miss = _miss(nodes, offset, target, at)
    for _ in range(MAX_ITERATIONS):
        if math.hypot(*miss) <= TOLERANCE * size:
            return at
        step = np.linalg.lstsq(stiffness(nodes, pressed), miss, rcond=None)[0]
        part = 1.0
        trial, missed = _miss(nodes, offset, target, at - step)
        while math.hypot(*missed) > (1.0 - 0.1 * part) * math.hypot(*miss) and part > SHORTEST:
            part *= 0.5
            trial, missed = _miss(nodes, offset, target, at - part * step)
        if part <= SHORTEST:
            break
        at, pressed, miss = at - part * step, trial, missed
    if not math.hypot(*miss) <= ACCEPTED * size:
        raise ConvergenceError(
            f"load must be one that the liner can carry, got a rest of {math.hypot(*miss) / size:.3g} of it",
            at,
        )
    return at


def stiffness(nodes: Nodes, pressed: Pressed) -> Array:
    """Return d(sum of load_i n_i)/de, symmetric, shape (2, 2, ...)."""
    batch = pressed.load.shape[1:]
    columns = [
        np.tensordot(nodes.normal, times_stiffness(nodes, pressed, _spread(normal, batch)), (1, 0))
        for normal in nodes.normal
    ]
    return np.stack(columns, axis=1)


def _spread(values: Array, batch: tuple[int, ...]) -> Array:
    return np.broadcast_to(values.reshape(-1, *(1 for _ in batch)), (len(values), *batch))


def _miss(nodes: Nodes, offset: Array, target: Array, position: Array) -> tuple[Pressed, Array]:
    pressed = press(nodes, position @ nodes.normal - offset)
    return pressed, nodes.normal @ pressed.load - target
