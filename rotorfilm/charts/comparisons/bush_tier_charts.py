"""Charts of the tiers of the melting bush: error against cost, the runs, the closed form of the shaft."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from ...comparisons import BushTiers, ShaftFluxError
from ..canvas import new_axes, new_figure

MARKS = "osD^v<>"


def plot_bush_tiers(result: BushTiers) -> list[Axes]:
    """Draw error against cost of each tier, the contact angles of some, and the closed form of the shaft."""
    figure = new_figure(size=(15.0, 5.2))
    cost, angle, shaft = figure.subplots(1, 3)
    families = list(dict.fromkeys(tier.family for tier in result.tiers))
    for family, mark in zip(families, MARKS, strict=False):
        tiers = [tier for tier in result.tiers if tier.family == family]
        line = cost.plot([1e3 * t.cost for t in tiers], [t.error for t in tiers], f"{mark}-", label=family)[0]
        angle.plot(result.times, tiers[-1].contact_angle, color=line.get_color(), label=tiers[-1].name)
    angle.plot(result.times, result.exact, "k:", label="reference")
    cost.set(
        xscale="log", yscale="log", xlabel="time of the run [ms]", ylabel="largest error of the angle [1]"
    )
    angle.set(xlabel="time [s]", ylabel="half contact angle [rad]")
    for axes, title in ((cost, "Error against cost"), (angle, "Growing load")):
        axes.set_title(title)
        axes.grid(visible=True, alpha=0.3)
        axes.legend(fontsize=7.5)
    plot_shaft_flux_error(result.shaft, axes=shaft)
    return [cost, angle, shaft]


def plot_shaft_flux_error(rows: Sequence[ShaftFluxError], *, axes: Axes | None = None) -> Axes:
    """Draw the error of the closed form (2.13) over the Biot number, by shaft radius / half length.

    Parameters
    ----------
    rows : sequence of ShaftFluxError
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Closed form of the heat into the shaft")
    for stubbiness in dict.fromkeys(row.stubbiness for row in rows):
        line = np.array([(row.cooling, 100.0 * row.error) for row in rows if row.stubbiness == stubbiness]).T
        axes.plot(*line, label=f"R_1/l = {stubbiness:g}")
    axes.set(
        title="Closed form of the shaft heat (2.13)",
        xlabel="Biot number of the shaft",
        ylabel="error against the mixed problem [%]",
        ylim=(0.0, None),
    )
    axes.grid(visible=True, alpha=0.3)
    axes.legend(fontsize=7.5)
    return axes
