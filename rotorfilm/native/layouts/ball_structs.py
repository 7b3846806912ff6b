"""The structures of the C library for ball bearings, as ctypes reads them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import c_double, c_int32, c_size_t, c_void_p
from typing import Any, ClassVar

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


class BallRowStruct(ctypes.Structure):
    """rf_ball_row of ball.h."""

    _fields_: ClassVar[Sequence[Any]] = [(name, c_double) for name in ROW]


class BallStruct(ctypes.Structure):
    """rf_ball of ball.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("force", c_double * 2),
        ("by_place", c_double * 4),
        ("by_speed", c_double * 2),
        ("load", c_double * 2),
        ("angle", c_double * 2),
        *((name, c_double) for name in ("centrifugal", "gyroscopic", "orbit", "gap", "traction", "slip")),
    ]


class BallLawStruct(ctypes.Structure):
    """rf_ball_law of ball.h."""

    _fields_: ClassVar[Sequence[Any]] = [("inertia", c_int32), ("traction", c_double), ("slide", c_double)]


class BallsStruct(ctypes.Structure):
    """rf_balls of balls.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("rows", c_void_p),
        ("count", c_size_t),
        ("growth", c_double),
        ("law", BallLawStruct),
        ("cage", c_double),
        ("shaft", c_double),
        ("waves", c_void_p),
        ("wave_count", c_size_t),
    ]


class BallJournalStruct(ctypes.Structure):
    """rf_ball_journal of balls.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("balls", BallsStruct),
        ("place", c_double * 3),
        ("thrust", c_double),
        ("damping", c_double),
        ("is_free", c_int32),
    ]
