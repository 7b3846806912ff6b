"""The atlas of limits: where each simplification fails, one panel for each."""

from __future__ import annotations

import math

from matplotlib.axes import Axes

from ...comparisons.limits.limit_panels import LimitAtlas, Panel
from ..canvas import new_figure

COLUMNS = 4
SIZE = (4.4, 4.1)
"""Width and height of a panel [inch]."""


def plot_limits(atlas: LimitAtlas) -> list[Axes]:
    """Draw one panel for each simplification, and the level from which it counts as failed.

    Parameters
    ----------
    atlas : LimitAtlas

    Returns
    -------
    list of Axes
        Of one figure, in the order of the panels of the atlas.
    """
    columns = min(COLUMNS, len(atlas.panels))
    rows = math.ceil(len(atlas.panels) / columns)
    figure = new_figure(size=(columns * SIZE[0], rows * SIZE[1]))
    drawn = [figure.add_subplot(rows, columns, k + 1) for k in range(len(atlas.panels))]
    for axes, (key, panel) in zip(drawn, atlas.panels.items(), strict=True):
        for limit in atlas.limits:
            if limit.panel == key:
                axes.plot(limit.abscissa, limit.ordinate, ".-", label=limit.name)
        _finish(axes, panel)
    return drawn


def _finish(axes: Axes, panel: Panel) -> None:
    axes.set(xlabel=panel.x_label, ylabel=panel.y_label, yscale="log")
    axes.set_title(f"{panel.physics}: {panel.title}", fontsize=10)
    if panel.logarithmic:
        axes.set_xscale("log")
    if panel.level is not None:
        axes.axhline(panel.level, color="k", linewidth=1.0, linestyle="--", label=f"failed: {panel.level:g}")
    axes.grid(visible=True, alpha=0.3)
    # below, where no curve is
    axes.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, frameon=False)
