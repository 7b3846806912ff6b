"""Figures without global state: every chart draws on Axes that the caller owns."""

from __future__ import annotations

import io
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..files import write_whole


def new_axes(title: str, *, size: tuple[float, float] = (6.4, 4.8)) -> Axes:
    """Return the Axes of a new figure of the given size [inch]."""
    axes = new_figure(size=size).add_subplot()
    axes.set_title(title)
    axes.grid(visible=True, alpha=0.3)
    return axes


def new_figure(*, size: tuple[float, float]) -> Figure:
    """Return a new figure of the given size [inch], for several Axes."""
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def legend_beside(axes: Axes) -> None:
    """Put the legend to the right of the picture: inside, it would lie on curves that are everywhere."""
    axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.02, 1.0))


def save(axes: Axes, path: Path, *, dpi: int = 130) -> Path:
    """Write the figure of `axes`, all of its Axes, as PNG and return the path."""
    figure = axes.get_figure()
    assert isinstance(figure, Figure)
    picture = io.BytesIO()
    figure.savefig(picture, dpi=dpi, metadata={"Software": "rotorfilm"}, format=path.suffix[1:] or "png")
    return write_whole(path, picture.getvalue())
