"""Limits of the polymer bush that melts, under a load that grows by half.

References: the mixed problem of the shaft for the closed form of its heat; for the contact angle the two
moments of the wear, `bush_tiers.two_moments`, which are exact whatever the shape of the pressure.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...bearings.bush import BushReaction, f4k20_bush
from ...model import Array
from ..bush_tiers import (
    COOLINGS,
    DURATION,
    HEAT,
    LOADS,
    SAMPLES,
    STUBBINESSES,
    TIGHT,
    published_run,
    shaft_flux_errors,
    two_moments,
    worn_run,
)
from .limit_panels import Curve, panel

STEPS = (20, 200, 2000)
NODES = (129, 65, 33, 17, 9)
EXTENT = 1.5
"""Angle that the worn profile covers [rad]."""


@panel("bush", "closed form of the heat into the shaft", "Biot number of the shaft", "error of the flux")
def bush_flux() -> Iterator[Curve]:
    """Yield what the closed form errs by."""
    for stubbiness in STUBBINESSES:
        errors = [abs(row.error) for row in shaft_flux_errors(stubbinesses=(stubbiness,))]
        yield f"shaft radius / half length {stubbiness:g}", COOLINGS, errors


@panel("bush", "melting in stages, as published", "load / first load", "error of the contact angle")
def bush_published() -> Iterator[Curve]:
    """Yield what the published stage errs by under a growing load."""
    times, exact = _exact()
    grown = 1.0 + (LOADS[1] / LOADS[0] - 1.0) * times / DURATION
    for steps in STEPS:
        error = np.abs(published_run(f4k20_bush(), times, steps) / exact - 1.0)
        yield f"{steps} steps", grown[1:], error[1:]


@panel(
    "bush",
    "nodes of the worn profile",
    "angle between nodes [deg]",
    "error of the contact angle",
    logarithmic=True,
)
def bush_nodes() -> Iterator[Curve]:
    """Yield what few nodes err by."""
    times, exact = _exact()
    errors = []
    for nodes in NODES:
        worn = BushReaction(bush=f4k20_bush(), melting_heat=HEAT, extent=EXTENT, nodes=nodes)
        errors.append(np.abs(worn_run(times, worn) / exact - 1.0))
    between = np.degrees(EXTENT) / (np.array(NODES) - 1.0)
    yield "largest", between, [error.max() for error in errors]
    yield "at the end", between, [error[-1] for error in errors]


def _exact() -> tuple[Array, Array]:
    times = np.linspace(0.0, DURATION, SAMPLES)
    return times, two_moments(f4k20_bush(), times, **TIGHT)


PANELS = (bush_flux, bush_published, bush_nodes)
"""Panels of the polymer bush, in the order in which they are drawn."""
