"""The structures of a film that warms, as ctypes reads them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import c_double, c_int32, c_void_p
from typing import Any, ClassVar

from .structs import JournalStruct


class OilStruct(ctypes.Structure):
    """rf_oil of heated_film.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("cells", c_int32),
        ("ln", c_void_p),
        ("coldest", c_double),
        ("hottest", c_double),
    ]


class HeatedStruct(ctypes.Structure):
    """rf_heated of heated_film.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("journal", JournalStruct),
        ("loss", c_void_p),
        ("loss_data", c_void_p),
        ("openings", c_void_p),
        ("oil", OilStruct),
        ("radius", c_double),
        ("length", c_double),
        ("clearance", c_double),
        ("supply", c_double),
        ("ambient", c_double),
        ("conductance", c_double),
        ("volumetric_heat", c_double),
        ("carry_over", c_double),
        ("full_gap", c_int32),
    ]


class OpeningMapStruct(ctypes.Structure):
    """rf_opening_map of groove_losses.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        *((name, c_int32) for name in ("cells_x", "cells_e", "cells_s", "openings", "lands")),
        *((name, c_double) for name in ("x_end", "squeeze", "axis")),
        *((name, c_void_p) for name in ("coefficients", "flows", "edges")),
    ]


class HeatStruct(ctypes.Structure):
    """rf_heat of heated_film.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("force", c_double * 2),
        *((name, c_double) for name in ("drag", "flow", "leak")),
    ]


class HeatSlopesStruct(ctypes.Structure):
    """rf_heat_slopes of heated_film.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("force", c_double * 10),
        *((name, c_double * 5) for name in ("drag", "flow", "leak")),
    ]
