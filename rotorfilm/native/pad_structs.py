"""The structures of the C library for bearings made of pads, as ctypes reads them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import c_double, c_size_t, c_void_p
from typing import Any, ClassVar

from .structs import JournalStruct


class LobeStruct(ctypes.Structure):
    """rf_lobe of lobes.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("film", JournalStruct),
        ("cos", c_double),
        ("sin", c_double),
        ("x", c_double),
        ("y", c_double),
    ]


class LobesStruct(ctypes.Structure):
    """rf_lobes of lobes.h."""

    _fields_: ClassVar[Sequence[Any]] = [("count", c_size_t), ("list", c_void_p)]
