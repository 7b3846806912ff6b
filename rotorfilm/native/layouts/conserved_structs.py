"""The structures of a film that conserves its oil, as ctypes reads them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import c_double, c_int32, c_int64, c_size_t, c_void_p
from typing import Any, ClassVar


class OilCellsStruct(ctypes.Structure):
    """rf_oil_cells of oil_cells.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("lines", c_size_t),
        ("nodes", c_size_t),
        *(
            (name, c_void_p)
            for name in ("wedge", "around", "along", "store", "width", "conductance", "center")
        ),
        *((name, c_double) for name in ("center_pressure", "end_pressure")),
        *((name, c_void_p) for name in ("old", "opening", "fed", "flow")),
        ("openings", c_size_t),
        ("backward", c_int32),
    ]


class OilWorkStruct(ctypes.Structure):
    """rf_oil_work of oil_search.h."""

    _fields_: ClassVar[Sequence[Any]] = [("solutions", c_int64), ("newton", c_int64)]


class OilShapeStruct(ctypes.Structure):
    """rf_oil_shape of oil_shape.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        *((name, c_size_t) for name in ("lines", "nodes", "openings")),
        *((name, c_void_p) for name in ("spacing", "direction", "width", "conductance")),
        *((name, c_void_p) for name in ("opening", "fed", "flow", "pressure")),
        *((name, c_double) for name in ("center", "center_pressure", "end_pressure", "slenderness")),
    ]


class OilGapStruct(ctypes.Structure):
    """rf_oil_gap of oil_shape.h."""

    _fields_: ClassVar[Sequence[Any]] = [(name, c_void_p) for name in ("line", "face", "cube")]


class OilPastStruct(ctypes.Structure):
    """rf_oil_past of oil_steps.h."""

    _fields_: ClassVar[Sequence[Any]] = [("content", c_void_p), ("before", c_void_p), ("length", c_double)]


class OilFoundStruct(ctypes.Structure):
    """rf_oil_found of oil_steps.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        *((name, c_void_p) for name in ("pressure", "theta", "full", "old")),
        ("rate", c_double),
        ("lag", c_double),
        ("work", OilWorkStruct),
    ]


class OilFilmStruct(ctypes.Structure):
    """rf_oil_film_si of oil_travel.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("shape", OilShapeStruct),
        *((name, c_double) for name in ("clearance", "carrying", "force", "oil")),
        *((name, c_double) for name in ("largest_angle", "largest_way")),
    ]
