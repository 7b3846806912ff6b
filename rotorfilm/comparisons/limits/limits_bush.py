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
from .limit_panels import Limit, Panel, PanelCurves

STEPS = (20, 200, 2000)
NODES = (129, 65, 33, 17, 9)
EXTENT = 1.5
"""Angle that the worn profile covers [rad]."""


def _fluxes() -> Iterator[Limit]:
    errors = shaft_flux_errors()
    for stubbiness in STUBBINESSES:
        yield Limit(
            panel="bush_flux",
            name=f"shaft radius / half length {stubbiness:g}",
            abscissa=np.array(COOLINGS),
            ordinate=np.array([abs(row.error) for row in errors if row.stubbiness == stubbiness]),
        )


def _published() -> Iterator[Limit]:
    times, exact = _exact()
    grown = 1.0 + (LOADS[1] / LOADS[0] - 1.0) * times / DURATION
    for steps in STEPS:
        error = np.abs(published_run(f4k20_bush(), times, steps) / exact - 1.0)
        yield Limit(panel="bush_published", name=f"{steps} steps", abscissa=grown[1:], ordinate=error[1:])


def _nodes() -> Iterator[Limit]:
    times, exact = _exact()
    errors = []
    for nodes in NODES:
        worn = BushReaction(bush=f4k20_bush(), melting_heat=HEAT, extent=EXTENT, nodes=nodes)
        errors.append(np.abs(worn_run(times, worn) / exact - 1.0))
    between = np.degrees(EXTENT) / (np.array(NODES) - 1.0)
    for name, values in (
        ("largest", [error.max() for error in errors]),
        ("at the end", [error[-1] for error in errors]),
    ):
        yield Limit(panel="bush_nodes", name=name, abscissa=between, ordinate=np.array(values))


def _exact() -> tuple[Array, Array]:
    times = np.linspace(0.0, DURATION, SAMPLES)
    return times, two_moments(f4k20_bush(), times, **TIGHT)


PANELS: dict[str, PanelCurves] = {
    "bush_flux": PanelCurves(
        Panel(
            physics="bush",
            title="closed form of the heat into the shaft",
            x_label="Biot number of the shaft",
            y_label="error of the flux",
        ),
        _fluxes,
    ),
    "bush_published": PanelCurves(
        Panel(
            physics="bush",
            title="melting in stages, as published",
            x_label="load / first load",
            y_label="error of the contact angle",
        ),
        _published,
    ),
    "bush_nodes": PanelCurves(
        Panel(
            physics="bush",
            title="nodes of the worn profile",
            x_label="angle between nodes [deg]",
            y_label="error of the contact angle",
            logarithmic=True,
        ),
        _nodes,
    ),
}
"""Panels of the polymer bush, in the order in which they are drawn."""
