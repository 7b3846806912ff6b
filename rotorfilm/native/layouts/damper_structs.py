"""The structure of a damper with seals and inertia in the C library, as ctypes reads it."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import c_double, c_int32, c_void_p
from typing import Any, ClassVar

from .structs import JournalStruct


class OilDamperStruct(ctypes.Structure):
    """rf_oil_damper of oil_damper.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("journal", JournalStruct),
        ("mapped", c_int32),
        ("terms", c_int32),
        ("table", c_void_p),
        ("least", c_double),
        ("viscous", c_double),
        ("inertial", c_double),
        ("seal", c_double),
        ("zone", c_double),
        ("closed", c_double),
        ("tabled", c_double),
        ("nodes", c_void_p),
        ("weights", c_void_p),
        ("count", c_int32),
        ("unused", c_int32),
    ]
