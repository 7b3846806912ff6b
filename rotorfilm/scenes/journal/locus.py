"""Locus of the journal center by every film of a ladder."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...bearings.journal import JournalBearing, fitted_bearing
from ...comparisons import ComparedFilm
from ...comparisons.journal.journal_states import SPEED
from ...model import Array


def attitude_angle(bearing: JournalBearing, eccentricity_ratio: Array) -> Array:
    """Return the angle from the load line to the journal center, in the sense of rotation, (n,) [rad].

    Parameters
    ----------
    bearing : JournalBearing
    eccentricity_ratio : ndarray, shape (n,) [1]
    """
    position = bearing.clearance * np.stack([eccentricity_ratio, np.zeros_like(eccentricity_ratio)])
    force = bearing.force(position, np.zeros_like(position), np.full(len(eccentricity_ratio), SPEED))
    return np.asarray(-np.arctan2(-force[1], -force[0]))


def attitude_angles(
    bearing: JournalBearing, rungs: Sequence[ComparedFilm], eccentricity_ratio: Array
) -> dict[str, Array]:
    """Return the attitude angles (n,) [rad] of the bearing with the film of each rung, by its name."""
    return {
        rung.name: attitude_angle(fitted_bearing(bearing, rung.film), eccentricity_ratio) for rung in rungs
    }
