"""What a run over time may have besides rotor and films, as the C library reads it: march.h, rub.h."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import c_double, c_int32, c_void_p
from typing import Any, ClassVar


class SpinStruct(ctypes.Structure):
    """rf_spin of march.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("speed", c_double),
        ("matrix", c_void_p),
        ("rest", c_void_p),
    ]


class GroundStruct(ctypes.Structure):
    """rf_ground of march.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("count", c_int32),
        ("times", c_void_p),
        ("x", c_void_p),
        ("y", c_void_p),
    ]


class BothStruct(ctypes.Structure):
    """rf_both of rub.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("first", c_void_p),
        ("of_first", c_void_p),
        ("second", c_void_p),
        ("of_second", c_void_p),
    ]
