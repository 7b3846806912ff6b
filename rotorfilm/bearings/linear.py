"""A bearing with constant stiffness and damping."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, require_finite, require_vector
from ..inputs.si_arguments import quantities
from ..model import Array
from ..signals import Signal, force_outputs, journal_inputs
from .reaction import Feedthrough, without_overflow

Pair = tuple[tuple[float, float], tuple[float, float]]

NOMINAL_LENGTH = 1e-4
"""Typical displacement [m]."""


@quantities
@dataclass(frozen=True, kw_only=True)
class LinearBearing(Feedthrough):
    """A spring and a damper, force = -stiffness position - damping velocity: a Reaction at any speed.

    Parameters
    ----------
    stiffness : float [N/m] or 2 x 2 numbers
        Rows: force x, y; columns: position x, y. One number is the same in both directions.
    damping : float [N s/m] or 2 x 2 numbers

    Raises
    ------
    InputError
        If one of them is neither a finite number nor 2 x 2.
    """

    stiffness: float | Pair
    damping: float | Pair = 0.0

    def __post_init__(self) -> None:
        for name in ("stiffness", "damping"):
            array = require_finite(name, getattr(self, name))
            if array.shape not in ((), (2, 2)):
                raise InputError(f"{name} must be a number or 2 x 2 numbers, got {getattr(self, name)!r}")
            matrix = array if array.ndim else float(array) * np.eye(2)
            object.__setattr__(self, name, tuple(tuple(row) for row in matrix.tolist()))

    @property
    def clearance(self) -> float:
        """Infinite: the journal may go anywhere."""
        return math.inf

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(NOMINAL_LENGTH, 100.0)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal."""
        return force_outputs(float(np.abs(self.stiffness).max()) * NOMINAL_LENGTH or 1.0)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal [N], shape (2, ...); the speed is not used."""
        q, v = require_vector("position", position), require_vector("velocity", velocity)
        return without_overflow(
            lambda q, v, _: -np.tensordot(self.stiffness, q, 1) - np.tensordot(self.damping, v, 1),
            q,
            v,
            np.asarray(speed),
        )

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d(force_x, force_y)/d(x, y, vx, vy, speed), shape (2, 5, ...): the same everywhere."""
        batch = np.broadcast_shapes(np.shape(position)[1:], np.shape(velocity)[1:], np.shape(speed))
        constant = np.hstack([-np.array(self.stiffness), -np.array(self.damping), np.zeros((2, 1))])
        return np.broadcast_to(constant.reshape(2, 5, *(1,) * len(batch)), (2, 5, *batch)).copy()
