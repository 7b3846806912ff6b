"""The structures of the C library, as ctypes reads them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import c_double, c_int, c_int32, c_int64, c_size_t, c_void_p
from typing import Any, ClassVar

from .run_structs import GroundStruct, SpinStruct


class MapStruct(ctypes.Structure):
    """rf_map of map_kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("cells_x", c_int32),
        ("cells_t", c_int32),
        ("x_end", c_double),
        ("center", c_double),
        ("coefficients", c_void_p),
        ("slenderness", c_double),
        ("share", c_double),
    ]


class ShortStruct(ctypes.Structure):
    """rf_short of short_kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [("factor", c_double)]


class JournalStruct(ctypes.Structure):
    """rf_journal of journal_kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("film", c_void_p),
        ("data", c_void_p),
        ("clearance", c_double),
        ("force_scale", c_double),
        ("error", c_double),
        ("openings", c_int),
    ]


class GrooveMapStruct(ctypes.Structure):
    """rf_groove_map of groove_kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("cells_x", c_int32),
        ("cells_e", c_int32),
        ("cells_s", c_int32),
        ("cells_w", c_int32),
        ("x_end", c_double),
        ("squeeze", c_double),
        ("axis", c_double),
        ("center", c_void_p),
        ("coefficients", c_void_p),
        ("slenderness", c_double),
    ]


class MapTableStruct(ctypes.Structure):
    """rf_map_table of map_table.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("cells_s", c_int32),
        ("cells_x", c_int32),
        ("cells_t", c_int32),
        ("low", c_double),
        ("high", c_double),
        ("center", c_void_p),
        ("coefficients", c_void_p),
    ]


class LossMapStruct(ctypes.Structure):
    """rf_loss_map of loss_kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("cells_x", c_int32),
        ("cells_s", c_int32),
        ("x_end", c_double),
        ("squeeze", c_double),
        ("center", c_double * 3),
        ("coefficients", c_void_p),
    ]


class GridStruct(ctypes.Structure):
    """rf_grid of ring.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("lines", c_size_t),
        ("nodes", c_size_t),
        ("span", c_void_p),
        ("line", c_void_p),
        ("face", c_void_p),
        ("value", c_void_p),
        ("held", c_void_p),
        ("width", c_void_p),
        ("conductance", c_void_p),
    ]


class RingStruct(ctypes.Structure):
    """rf_ring of ring.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("grids", GridStruct * 3),
        ("start", c_void_p),
        ("extent", c_void_p),
        ("slenderness", c_double),
        ("spans", c_int32),
        ("pinned", c_int32),
        ("turning", c_int32),
        ("ruptured", c_int32),
        ("clipped", c_int32),
        ("extrapolated", c_int32),
        ("pad", c_int32),
    ]


class GridWorkStruct(ctypes.Structure):
    """rf_grid_work of ring.h."""

    _fields_: ClassVar[Sequence[Any]] = [("solutions", c_int64), ("lines", c_int64)]


class StencilStruct(ctypes.Structure):
    """rf_stencil of stencil.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("lines", c_size_t),
        ("nodes", c_size_t),
        ("around", c_void_p),
        ("along", c_void_p),
        ("source", c_void_p),
        ("held", c_void_p),
    ]


class RideStruct(ctypes.Structure):
    """rf_ride_law of ride.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("order", c_int32),
        ("A", c_void_p),
        ("B", c_void_p),
        ("C", c_void_p),
        ("D", c_double),
        ("offset", c_double),
        ("span", c_double),
        ("exponent", c_double),
        ("operating", c_double),
        ("W", c_double),
    ]


class ModesStruct(ctypes.Structure):
    """rf_modes of collocation.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("modes", c_int32),
        ("channels", c_int32),
        ("rows", c_int32),
        ("values", c_void_p),
        ("push", c_void_p),
        ("sense", c_void_p),
    ]


class SchemeStruct(ctypes.Structure):
    """rf_scheme of collocation.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("stages", c_int32),
        ("nodes", c_void_p),
        ("lagrange", c_void_p),
        ("remainder", c_void_p),
    ]


class StepTableStruct(ctypes.Structure):
    """rf_step_table of collocation.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("move", c_void_p),
        ("gain", c_void_p),
        ("defect", c_void_p),
        ("keep", c_void_p),
        ("forced", c_void_p),
        ("turn", c_void_p),
        ("weights", c_void_p),
    ]


class JournalsStruct(ctypes.Structure):
    """rf_journals of march.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("count", c_int32),
        ("films", c_void_p),
        ("of", c_void_p),
        ("rest", c_void_p),
        ("spring", c_void_p),
        ("damper", c_void_p),
        ("lengths", c_void_p),
        ("walls", c_void_p),
    ]


class SpeedsStruct(ctypes.Structure):
    """rf_speeds of march.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("count", c_int32),
        ("times", c_void_p),
        ("speeds", c_void_p),
        ("slopes", c_void_p),
        ("angles", c_void_p),
    ]


class SprungStruct(ctypes.Structure):
    """rf_sprung of springs.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("film", c_void_p),
        ("of", c_void_p),
        ("stiffness", c_double),
        ("still", c_int),
    ]


class ShakenStruct(ctypes.Structure):
    """rf_shaken of shake.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("film", c_void_p),
        ("of", c_void_p),
        ("mass", c_double),
        ("speed", c_double),
        ("clearance", c_double),
        ("step", c_double),
        ("calls", c_int64),
        ("done", c_int64),
        ("left_map", c_int),
        ("heavy", c_void_p),
        ("loaded", c_void_p),
    ]


SLOTS, STEPS = 24, 400
"""Of march.h: lengths of steps whose tables are kept, and lengths that there are."""


class MarchStruct(ctypes.Structure):
    """rf_march of march.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("rotor", ModesStruct),
        ("scheme", SchemeStruct),
        ("journals", JournalsStruct),
        ("profile", SpeedsStruct),
        ("spin", SpinStruct),
        ("ground", GroundStruct),
        ("scales", c_void_p),
        ("longest", c_double),
        ("shortest", c_double),
        ("rtol", c_double),
        ("newton", c_double),
        ("tables", ctypes.POINTER(StepTableStruct)),
        ("slot_of", c_int32 * STEPS),
        ("step_of", c_int32 * SLOTS),
        ("next_slot", c_int32),
        ("step", c_int32),
        ("left_map", c_int32),
        ("time", c_double),
        ("films", c_int64),
        ("jacobians", c_int64),
        ("steps", c_int64),
        ("rejected", c_int64),
        ("walls", c_int64),
        ("z", c_void_p),
    ]
