"""Derivatives of functions that bring none, by central differences of sixth order with an error estimate."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np

from ..model import Array

HALVINGS = 0.5 ** np.arange(3)
"""Steps / largest step: central differences of order 2, extrapolated twice (Richardson, 1911)."""

ORDER = 6
"""Of the derivatives."""

ROUNDOFF = 16.0 * np.finfo(float).eps
"""Error of values that are computed in some operations, relative to the largest."""


def extrapolated_value(coarse: Any, fine: Any, order: int = 2) -> Any:
    """Return what steps or cells without end would give, of an order; the first value is on half of them."""
    return fine + (fine - coarse) / (2.0**order - 1.0)


def differences(function: Callable[[Array], Array], state: Array, steps: Array) -> tuple[Array, Array]:
    """Return the derivatives of a function of m numbers, and an estimate of their error.

    Parameters
    ----------
    function : callable
        From states, shape (m, ...), to values, shape (k, ...). It is called once.
    state, steps : ndarray, shape (m, ...)
        Where, and the largest step along each number, in its unit.

    Returns
    -------
    slopes, error : ndarray, shape (k, m, ...)
        The estimate is the error of fourth order, far above that of the slopes where the function is smooth,
        and what errors of `ROUNDOFF` in the values make of the smallest step.
    """
    signed = np.stack([HALVINGS, -HALVINGS])
    moved = state[:, None, None, None] + np.einsum("cd,sl,d...->cdsl...", np.eye(len(steps)), signed, steps)
    values = function(moved)
    own = np.einsum("ddsl...->dsl...", moved)
    widths = own[:, 0] - own[:, 1]  # what the steps are once they are rounded
    slopes = np.moveaxis((values[:, :, 0] - values[:, :, 1]) / widths, 2, 0)
    coarser, order = slopes, 2
    while len(slopes) > 1:
        coarser = slopes
        slopes = np.array([fine + (fine - coarse) / (2.0**order - 1.0) for coarse, fine in pairwise(slopes)])
        order += 2
    roundoff = ROUNDOFF * np.abs(values).max(axis=(0, 1, 2, 3)) / widths[:, -1]
    return slopes[0], np.abs(slopes[0] - coarser[-1]) + roundoff
