"""Which journals the map that comes with the package holds."""

from __future__ import annotations

from ...bearings.journal import JournalBearing

TABLE_RANGE = (0.1, 4.0)
"""Length / diameter of the map that is there from the start; other bearings have to make theirs."""


def has_map(bearing: JournalBearing) -> bool:
    """Return whether the map that comes with the package holds a bearing."""
    low, high = TABLE_RANGE
    return bearing.geometry.plain and low <= bearing.slenderness <= high
