"""Runge-Kutta steps of a ball on its reduced contact law, in compiled code (`native/loops/ride.h`)."""

from __future__ import annotations

from ctypes import byref
from typing import NamedTuple

import numpy as np

from ...model import Array
from ...native.layouts.structs import RideStruct
from ...native.library import loops


class RideLaw(NamedTuple):
    """The law of a contact and the inertia of its ball, dimensionless.

    Attributes
    ----------
    A, B, C : ndarray, shapes (n, n), (n,), (n,)
    D : float
    offset, span, exponent, operating : float
        The static force is ((offset - delta)/span)^exponent, the drive of the states delta - operating.
    W : float
    """

    A: Array
    B: Array
    C: Array
    D: float
    offset: float
    span: float
    exponent: float
    operating: float
    W: float

    def force(self, y: Array) -> Array:
        """Return the force of the film, which does not pull, for rows of (delta, velocity, states)."""
        delta = y[:, 0]
        static = (np.maximum(self.offset - delta, 0.0) / self.span) ** self.exponent
        drive = np.minimum(delta, self.offset) - self.operating
        return np.maximum(static + self.D * drive + y[:, 2:] @ self.C, 0.0)

    def steps(self, start: Array, step: float, pushes: Array) -> Array:
        """Return delta, velocity and states, (n + 1, 2 + order), after each of n equal steps of order four.

        `pushes`, (2 n + 1,), are the loads at the ends and middles of the steps.
        """
        matrices = [np.ascontiguousarray(matrix, dtype=float) for matrix in (self.A, self.B, self.C)]
        places = [matrix.ctypes.data for matrix in matrices]
        law = RideStruct(len(self.B), *places, *self[3:])
        begin, loads = np.ascontiguousarray(start, dtype=float), np.ascontiguousarray(pushes, dtype=float)
        n = len(loads) // 2
        answer = np.empty((n + 1, len(begin)))
        arguments = begin.ctypes.data, step, n, loads.ctypes.data, answer.ctypes.data
        if loops()["rf_ride"](byref(law), *arguments):
            raise MemoryError("no memory for the steps of a ball")
        return answer
