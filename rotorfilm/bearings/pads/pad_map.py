"""The film on one pad from its map: made in seconds, kept on disk, the same for all pads of one shape.

Forces, frame and units are those of `pad_grid`: preload, offset, pivot and orientation of a pad are a place
and a turn of its frame, so that pads of one extent and length/diameter share a map.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from ...errors import InputError, require_number
from ...native.pad_kernels import PadMapKernel
from ...progress import Report, silent
from ...sources import source_digest
from ..films.table_cache import cached_table, table_path, told
from . import pad_build
from .pad_build import FINE, PadResolution, build_pad_table, expected_time
from .pad_table import VERSION, PadMapTable

EXTENTS = (0.1, 3.1)
"""Angles that a pad with a map may cover [rad]."""

SLENDERNESSES = (0.05, 20.0)
"""Length/diameter for which a map can be made; a shorter film turns faster than the nodes can follow."""

DIGITS = 9
"""Of extent and length/diameter, so that pads of one shape share a map."""


class _Shape(NamedTuple):
    """What decides the content of a map."""

    extent: float
    slenderness: float
    resolution: PadResolution

    @property
    def path(self) -> Path:
        """Where the map lies; the name is a digest of all that decides its content."""
        return table_path("pad", (VERSION, source_digest(pad_build.__name__), *self))


def is_pad_mappable(extent: float, slenderness: float) -> bool:
    """Return whether there can be a map of pads of an extent [rad] and length/diameter."""
    return EXTENTS[0] <= extent <= EXTENTS[1] and SLENDERNESSES[0] <= slenderness <= SLENDERNESSES[1]


def require_mappable(extent: float, slenderness: float) -> None:
    """Raise InputError unless there can be a map of pads of an extent [rad] and length/diameter."""
    for name, value, (low, high) in (
        ("extent", extent, EXTENTS),
        ("length/diameter", slenderness, SLENDERNESSES),
    ):
        if not low <= require_number(name, value) <= high:
            raise InputError(f"{name} must be {low} to {high} for a map of a pad, got {value!r}")


def _shape(extent: float, slenderness: float, resolution: PadResolution) -> _Shape:
    require_mappable(extent, slenderness)
    return _Shape(_rounded(extent), _rounded(slenderness), resolution.checked())


def _rounded(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")


@lru_cache(maxsize=64)
def pad_map_kernel(extent: float, slenderness: float, resolution: PadResolution = FINE) -> PadMapKernel:
    """Return the compiled film on one pad in its own frame from its map; the arguments are of `pad_table`."""
    return pad_table(extent, slenderness, resolution).kernel()


def pad_table(
    extent: float,
    slenderness: float,
    resolution: PadResolution = FINE,
    report: Report = silent,
) -> PadMapTable:
    """Return the map of a pad: the one on disk, or a new one, which is then kept.

    Parameters
    ----------
    extent : float [rad]
        Angle that the pad covers, .1 to 3.1; rounded to nine digits.
    slenderness : float [1]
        Length / diameter, .05 to 20; rounded to nine digits.
    resolution : PadResolution, optional
        A coarser one is made sooner.
    report : callable, optional
        Called with the fraction done, 0 to 1, and a text while a map is being made. Without it the log
        says that one is being made.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """
    shape = _shape(extent, slenderness, resolution)
    of = f"{shape.extent:.6g} rad, length/diameter {shape.slenderness:.6g}"
    telling = told(report, of, shape.path.parent)
    return cached_table(PadMapTable, shape.path, lambda: build_pad_table(*shape, telling))


def making_time(extent: float, slenderness: float, resolution: PadResolution = FINE) -> float:
    """Return about how long making the map takes on this machine [s]; 0 where it is on disk."""
    return 0.0 if _shape(extent, slenderness, resolution).path.is_file() else expected_time(resolution)
