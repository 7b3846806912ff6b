"""Figures without global state: every chart draws on Axes that the caller owns."""

from __future__ import annotations

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure


def new_axes(title: str, *, size: tuple[float, float] = (6.4, 4.8)) -> Axes:
    """Return the Axes of a new figure of the given size [inch]."""
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.set_title(title)
    axes.grid(visible=True, alpha=0.3)
    return axes


def save(axes: Axes, path: Path) -> Path:
    """Write the figure of `axes` as PNG and return the path."""
    figure = axes.get_figure()
    assert isinstance(figure, Figure)
    figure.savefig(path, dpi=130, metadata={"Software": "rotorfilm"})
    return path
