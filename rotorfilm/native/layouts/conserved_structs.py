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
