"""The atlas of limits: where each simplification fails, a figure for each physics and a summary of all."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from ...comparisons.limits.limit_panels import Limit, LimitAtlas, Panel, failure
from ..canvas import new_figure

COLUMNS = 2
SIZE = (4.7, 4.6)
"""Width and height of a panel [inch]."""

LONG = 24
"""Characters of a label that has a line of its own."""

HOLDS, DEPENDS, FAILS = "#9fd3a8", "#f5d97a", "#e79a8f"
"""Colors of the summary: where all variants hold, some, and none."""


def plot_limits(atlas: LimitAtlas) -> dict[str, list[Axes]]:
    """Draw one panel for each simplification, and the level from which it counts as failed.

    Parameters
    ----------
    atlas : LimitAtlas

    Returns
    -------
    dict of str to list of Axes
        Those of one figure by its physics, in the order of the panels of the atlas.
    """
    physics = list(dict.fromkeys(panel.physics for panel in atlas.panels.values()))
    return {name: _figure(atlas, name) for name in physics}


def _figure(atlas: LimitAtlas, physics: str) -> list[Axes]:
    own = {key: panel for key, panel in atlas.panels.items() if panel.physics == physics}
    columns = min(COLUMNS, len(own))
    rows = math.ceil(len(own) / columns)
    figure = new_figure(size=(columns * SIZE[0], rows * SIZE[1]))
    figure.suptitle(physics)
    drawn = [figure.add_subplot(rows, columns, k + 1) for k in range(len(own))]
    for axes, (key, panel) in zip(drawn, own.items(), strict=True):
        for limit in _of(atlas, key):
            axes.plot(limit.abscissa, limit.ordinate, ".-", label=limit.name)
        _finish(axes, panel)
    return drawn


def _of(atlas: LimitAtlas, key: str) -> list[Limit]:
    return [limit for limit in atlas.limits if limit.panel == key]


def _finish(axes: Axes, panel: Panel) -> None:
    axes.set(xlabel=panel.x_label, ylabel=panel.y_label, yscale="log", title=panel.title)
    if panel.logarithmic:
        axes.set_xscale("log")
    else:
        axes.locator_params(axis="x", nbins=6)  # numbers that do not touch
    if panel.level is not None:
        axes.axhline(panel.level, color="k", linewidth=1.0, linestyle="--", label=f"failed: {panel.level:g}")
    axes.grid(visible=True, alpha=0.3)
    longest = max(len(label) for label in axes.get_legend_handles_labels()[1])
    columns = 1 if longest > LONG else 2
    # below, where no curve is
    axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=columns, frameon=False)


def plot_limit_summary(atlas: LimitAtlas) -> list[Axes]:
    """Draw a strip for each simplification: where all of its variants hold, where some do, and where none.

    A panel whose ordinate is the limit itself has no strip.

    Parameters
    ----------
    atlas : LimitAtlas

    Returns
    -------
    list of Axes
        Of one figure, in the order of the panels of the atlas.
    """
    judged = {key: panel for key, panel in atlas.panels.items() if panel.level is not None}
    figure = new_figure(size=(9.4, 1.0 + 0.72 * len(judged)))
    figure.suptitle("Errors below 10 %: green all variants, yellow some, red none")
    drawn = list(figure.subplots(len(judged), 1, squeeze=False)[:, 0])
    for axes, (key, panel) in zip(drawn, judged.items(), strict=True):
        _strip(axes, panel, _of(atlas, key))
    return drawn


def _strip(axes: Axes, panel: Panel, limits: list[Limit]) -> None:
    assert panel.level is not None
    every = np.concatenate([limit.abscissa for limit in limits])
    low, high = float(every.min()), float(every.max())
    found = [failure(limit, panel.level) for limit in limits]
    ends = [high if at is None else at for at in found]
    first, last = min(ends), max(ends)
    for start, end, color in ((low, first, HOLDS), (first, last, DEPENDS), (last, high, FAILS)):
        axes.axvspan(start, end, color=color, linewidth=0.0)
    if panel.logarithmic:
        axes.set_xscale("log")
    axes.set(xlim=(low, high), yticks=())
    axes.tick_params(axis="x", which="both", labelsize=7, pad=1)
    axes.set_ylabel(f"{panel.physics}: {panel.title}", rotation=0, ha="right", va="center", fontsize=8)
    axes.set_xlabel(panel.x_label, fontsize=7, labelpad=1)
