"""The atlas of limits: where each simplification of a journal bearing fails."""

from __future__ import annotations

from matplotlib.axes import Axes

from ..ladders.limits import PANELS, LimitAtlas, Panel
from .canvas import new_figure

SHAPE = (2, 3)


def plot_limits(atlas: LimitAtlas) -> list[Axes]:
    """Draw one panel for each simplification, and the level from which it counts as failed.

    Parameters
    ----------
    atlas : LimitAtlas

    Returns
    -------
    list of Axes
        Of one figure, in the order of `ladders.limits.PANELS`.
    """
    figure = new_figure(size=(13.0, 7.6))
    drawn = [figure.add_subplot(*SHAPE, k + 1) for k in range(len(PANELS))]
    for axes, (key, panel) in zip(drawn, PANELS.items(), strict=True):
        for limit in atlas.limits:
            if limit.panel == key:
                axes.plot(limit.abscissa, limit.ordinate, ".-", label=limit.name)
        _finish(axes, panel)
    return drawn


def _finish(axes: Axes, panel: Panel) -> None:
    axes.set(title=panel.title, xlabel=panel.x_label, ylabel=panel.y_label, yscale="log")
    if panel.logarithmic:
        axes.set_xscale("log")
    if panel.level is not None:
        axes.axhline(panel.level, color="k", linewidth=1.0, linestyle="--", label=f"failed: {panel.level:g}")
    axes.grid(visible=True, alpha=0.3)
    axes.legend(fontsize=7)
