"""Ball bearings in compiled code (`native/rolling/balls.h`), on NumPy arrays."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import byref, c_double, c_int32
from typing import Any, NamedTuple

import numpy as np

from ..core.model import Array
from .library import loops
from .structs import structure

DEGREES, SLOPES = 5, 8

ROW = (
    "place",
    "direction",
    "axial",
    "radial",
    "arm",
    "count",
    "turn",
    "inner",
    "outer",
    "inner_stiffness",
    "outer_stiffness",
    "ratio",
    "diameter",
    "mass",
    "largest",
    "inner_reach",
    "outer_reach",
)
"""The numbers of rf_ball_row, the columns of the table `rows`."""


WAVE = ("turns", "lobes", "radial", "axial", "phase")
"""The numbers of rf_ball_wave, the columns of the table `waves`."""

_Two, _Three, _Five, _Ten = c_double * 2, c_double * 3, c_double * 5, c_double * 10
_Held = c_int32 * DEGREES


class BallsAt(NamedTuple):
    """Answers at a motion in five degrees.

    Attributes
    ----------
    wrench : ndarray, shape (5,)
        Force and moment on the shaft.
    slopes : ndarray, shape (5, 8)
        Their derivatives by the motion, the speed, and the angles of cage and shaft.
    each : ndarray, shape (balls,)
        The numbers of rf_ball, as a structured array.
    status : int
    """

    wrench: Array
    slopes: Array
    each: Any
    status: int


class BallsRest(NamedTuple):
    """An equilibrium.

    Attributes
    ----------
    motion : ndarray, shape (5,)
    evaluations : int
        Wrenches that were computed.
    status : int
    """

    motion: Array
    evaluations: int
    status: int


class BallKernel:
    """Rows of balls on one shaft.

    Parameters
    ----------
    rows : ndarray, shape (rows, columns)
        The numbers of rf_ball_row.
    law : (int, float, float)
        The numbers of rf_ball_law.
    growth : float [m]
    place : (float, float, float)
        z [m] and tilts [rad] of the planar motion.
    thrust : float or None [N]
        What z follows from; None where it is given.
    damping : float [N s/m]
    waves : ndarray, shape (waves, columns)
        The numbers of rf_ball_wave.
    """

    def __init__(
        self,
        rows: Array,
        law: tuple[int, float, float],
        growth: float,
        place: tuple[float, float, float],
        thrust: float | None,
        damping: float,
        waves: Array,
    ) -> None:
        self._arguments = (rows, law, growth, place, thrust, damping, waves)
        self.rows = np.ascontiguousarray(rows, dtype=float)
        self.count = int(self.rows[:, 5].sum())
        self._waves = np.ascontiguousarray(waves, dtype=float)
        self._fixed = self.rows.ctypes.data, len(self.rows), growth, structure("rf_ball_law")(*law)
        self._balls = self._turned(0.0, 0.0)
        self._held = _Three(*place), thrust or 0.0, damping, thrust is not None
        self._journal = structure("rf_ball_journal")(self._balls, *self._held)
        self._reference = byref(self._journal)
        self._at = loops()["rf_ball_journal_at"]

    def with_law(self, law: tuple[int, float, float]) -> BallKernel:
        """Return the same rows with another law of their balls."""
        return BallKernel(self._arguments[0], law, *self._arguments[2:])

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    def call(self, *state: float) -> tuple[float, float, int]:
        """Return (force_x, force_y, status) at x, y, vx, vy, speed."""
        pair = _Two()
        status = self._at(self._reference, _Five(*state), pair, None, None)
        return pair[0], pair[1], status

    def tangent(self, *state: float) -> tuple[float, float, list[float], int]:
        """Return force_x, force_y, the ten entries of the Jacobian row by row, and a status."""
        pair, ten = _Two(), _Ten()
        status = self._at(self._reference, _Five(*state), pair, ten, None)
        return pair[0], pair[1], ten[:], status

    def axial_place(
        self,
        *state: float,
        tilt: tuple[float, float] | None = None,
        cage: float = 0.0,
        shaft: float = 0.0,
    ) -> tuple[float, int]:
        """Return z [m] at x, y, vx, vy, speed, with cage and shaft turned further [rad], and a status.

        The tilts [rad] are those of the planar motion where no others are given.
        """
        pair, z = _Two(), c_double()
        place, *rest = self._held
        held = place if tilt is None else _Three(place[0], *tilt)
        journal = structure("rf_ball_journal")(self._turned(cage, shaft), held, *rest)
        status = self._at(byref(journal), _Five(*state), pair, None, byref(z))
        return z.value, status

    def _turned(self, cage: float, shaft: float) -> Any:
        return structure("rf_balls")(*self._fixed, cage, shaft, self._waves.ctypes.data, len(self._waves))

    def at(self, motion: Array, speed: float, cage: float = 0.0, shaft: float = 0.0) -> BallsAt:
        """Return wrench, slopes and balls at a motion (5,), with cage and shaft turned further [rad]."""
        motion = np.ascontiguousarray(motion, dtype=float)
        wrench, slopes, each = (
            np.empty(DEGREES),
            np.empty((DEGREES, SLOPES)),
            (structure("rf_ball") * self.count)(),
        )
        places = [one.ctypes.data for one in (wrench, slopes)]
        balls = self._turned(cage, shaft) if cage or shaft else self._balls
        status = loops()["rf_balls_at"](byref(balls), motion.ctypes.data, speed, *places, each)
        return BallsAt(wrench, slopes, np.ctypeslib.as_array(each), status)

    def rest(
        self, load: Array, speed: float, start: Array, held: Sequence[bool] = (False,) * DEGREES
    ) -> BallsRest:
        """Return the equilibrium under a load (5,) on the shaft, whose held degrees stay where they start."""
        load, motion = np.ascontiguousarray(load, dtype=float), np.array(start, dtype=float)
        slopes, steps = np.empty((DEGREES, SLOPES)), c_int32()
        places = [one.ctypes.data for one in (motion, slopes)]
        arguments = byref(self._balls), load.ctypes.data, speed, _Held(*held), *places, byref(steps)
        status = loops()["rf_balls_rest"](*arguments)
        return BallsRest(motion, steps.value, status)
