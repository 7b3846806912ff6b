"""Maps of bearings with openings on disk: found again by what they depend on."""

from __future__ import annotations

from pathlib import Path

from ....sources import source_digest
from ...films.geometry import TURN
from ...films.table_cache import table_path
from . import groove_build
from .groove_build import Resolution
from .groove_table import VERSION
from .openings import STEPS, AlignedOpenings


def cache_path(openings: AlignedOpenings, slenderness: float, resolution: Resolution) -> Path:
    """Return where the map of a bearing lies; the name is a digest of all that decides its content."""
    angles = [angle for groove in openings.grooves for angle in (groove.center, groove.width)]
    steps = [round(angle / TURN * STEPS) for angle in angles]
    key = VERSION, source_digest(groove_build.__name__), steps, f"{slenderness:.9g}", resolution
    return table_path("groove", key)
