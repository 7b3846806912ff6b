"""Maps of bearings with openings on disk: found again by what they depend on."""

from __future__ import annotations

import hashlib
from pathlib import Path

from ...films.geometry import TURN
from ...films.solver_digest import solver_digest
from ...films.table_cache import cache_folder
from .groove_build import Resolution
from .groove_table import VERSION
from .openings import STEPS, AlignedOpenings

SOURCES = (
    "geometry.py",
    "groove_axis.py",
    "groove_build.py",
    "groove_table.py",
    "map_fit.py",
    "map_table.py",
    "quintic.py",
)
"""Besides the solver, what decides the content of a map."""


def cache_path(openings: AlignedOpenings, slenderness: float, resolution: Resolution) -> Path:
    """Return where the map of a bearing lies; the name is a digest of all that decides its content."""
    angles = [angle for groove in openings.grooves for angle in (groove.center, groove.width)]
    steps = [round(angle / TURN * STEPS) for angle in angles]
    key = repr((VERSION, solver_digest(*SOURCES), steps, f"{slenderness:.9g}", resolution))
    return cache_folder() / f"groove-{hashlib.sha256(key.encode()).hexdigest()[:24]}.bin"
