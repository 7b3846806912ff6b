"""The criteria of API 617 by which an analysis of level II is required."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

LEAST_DECREMENT = 0.1
"""delta_A below which an analysis of level II is required."""

LEAST_MARGIN, SAFE_MARGIN = 2.0, 10.0
"""Q0 / QA below which it is required, and below which it is in region B."""

BORDER_DENSITY = (16.53, 60.0)
"""Average densities [kg/m3] between which the border of region B falls; beyond the second all is region B."""

BORDER_RATIO = (2.5, 2.0)
"""Critical speed ratios of the border there, and below the first density."""


class Screening(NamedTuple):
    """What the criteria judge.

    Attributes
    ----------
    margin : float [1]
        Q0 / QA.
    anticipated_decrement : float [1]
    critical_speed_ratio : float [1]
    average_density : float or None [kg/m3]
        None for an axial rotor.
    """

    margin: float
    anticipated_decrement: float
    critical_speed_ratio: float
    average_density: float | None


def border_ratio(density: float) -> float:
    """Return the critical speed ratio [1] above which a density [kg/m3] is in region B."""
    if density > BORDER_DENSITY[1]:
        return 0.0
    return float(np.interp(density, BORDER_DENSITY, BORDER_RATIO))


def in_region_b(ratio: float, density: float) -> bool:
    """Return whether a critical speed ratio [1] and an average density [kg/m3] are in region B."""
    return ratio > border_ratio(density)


def screened(found: Screening) -> Iterator[str]:
    """Yield why an analysis of level II is required; nothing where it is not."""
    if found.anticipated_decrement < LEAST_DECREMENT:
        yield f"delta_A = {found.anticipated_decrement:.3g}, below {LEAST_DECREMENT}"
    if found.average_density is None:
        return
    if found.margin < LEAST_MARGIN:
        yield f"Q0/QA = {found.margin:.3g}, below {LEAST_MARGIN:g}"
    elif found.margin < SAFE_MARGIN and in_region_b(found.critical_speed_ratio, found.average_density):
        yield (
            f"Q0/QA = {found.margin:.3g}, below {SAFE_MARGIN:g}, in region B (critical speed ratio "
            f"{found.critical_speed_ratio:.3g}, {found.average_density:.3g} kg/m3)"
        )
