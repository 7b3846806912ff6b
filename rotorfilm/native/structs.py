"""The structures of the C library, as ctypes reads them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import c_double, c_int, c_int32, c_int64, c_size_t, c_void_p
from typing import Any, ClassVar

# What a run over time may have besides rotor and films, as the C library reads it: march.h, rub.h.


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


# The structures of the C library, as ctypes reads them.


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


# The structures of the C library for bearings made of pads, as ctypes reads them.


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


class RecessPadStruct(ctypes.Structure):
    """rf_recess_pad of recess.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        *(
            (name, c_double)
            for name in ("start", "extent", "preload", "anchor", "from", "to", "depth", "share")
        ),
        ("around", c_int32 * 3),
        ("along", c_int32 * 2),
    ]


class RecessStruct(ctypes.Structure):
    """rf_recess of recess.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("pads", c_void_p),
        ("count", c_size_t),
        *((name, c_double) for name in ("radius", "length", "clearance", "viscosity")),
        ("extrapolated", c_int32),
    ]


# The structures of a film that warms, as ctypes reads them.


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


# The structure of a damper with seals and inertia in the C library, as ctypes reads it.


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


# The structures of a film that conserves its oil, as ctypes reads them.


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


# The structures of the C library for ball bearings, as ctypes reads them.


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
