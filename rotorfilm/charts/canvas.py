"""Figures without global state: every chart draws on Axes that the caller owns."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.transforms import Bbox

from ..studies.journal_accuracy import FilmFamily
from .picture import NoteMark


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


# Labels beside points that do not cover each other.


_BESIDE = ((1, 1), (-1, 1), (1, 0), (-1, 0), (1, -1), (-1, -1), (0, 1), (0, -1))

DIRECTIONS = (*_BESIDE, (1, 2), (-1, 2), (1, -2), (-1, -2))
"""Places tried around the point, in order of preference: (1, 1) is up to the right, corner to corner."""

DISTANCES = (0.0, 1.5, 6.0, 14.0, 24.0, 36.0, 50.0)
"""Gaps between label and that square tried [points], nearest first."""

MARKER = 3.5
"""Half the size of the square around a point that no label may cover, smaller than its dot [points]."""


def place_labels(
    axes: Axes,
    labels: Sequence[NoteMark],
    *,
    obstacles: Sequence[tuple[float, float]] = (),
    size: float = 7.5,
) -> None:
    """Write each label near its point, clear of all points, of the other labels and of the frame.

    Call last, when limits, scales and size of the figure are final. A label that finds no free place goes
    where it covers least; one that is moved away gets a thin line to its point.

    Parameters
    ----------
    axes : Axes
    labels : sequence of NoteMark
    obstacles : sequence of (float, float), optional
        Further points to keep clear, in data coordinates.
    size : float, optional
        Size of the type [points].
    """
    figure = axes.get_figure()
    assert isinstance(figure, Figure)
    figure.draw_without_rendering()
    pixels = figure.dpi / 72.0
    points = axes.transData.transform([(label.x, label.y) for label in labels] + list(obstacles))
    taken = [_around(point, MARKER * pixels, MARKER * pixels) for point in points]
    frame = axes.get_window_extent()
    renderer = FigureCanvasAgg(figure).get_renderer()  # type: ignore[no-untyped-call]
    for label, point in zip(labels, points[: len(labels)], strict=True):
        text = axes.annotate(
            label.text,
            (label.x, label.y),
            (0, 0),
            textcoords="offset points",
            fontsize=size,
            color=label.color,
            ha="center",
            va="center",
            zorder=6,
            path_effects=[withStroke(linewidth=2.0, foreground="white")],
        )
        box = text.get_window_extent(renderer)
        half = 0.5 * box.width + 1.5 * pixels, 0.5 * box.height + 0.5 * pixels
        offset = _best_offset(point, half, taken, frame, pixels)
        text.set_position(tuple(offset / pixels))
        taken.append(_around(point + offset, *half))
        if np.any(np.abs(offset) > np.array(half) + DISTANCES[3] * pixels):
            _lead(axes, point, offset, half, label.color)


def _best_offset(
    point: np.ndarray, half: tuple[float, float], taken: Sequence[Bbox], frame: Bbox, pixels: float
) -> np.ndarray:
    """Return the first free offset [pixel], or that which covers least."""
    best, least = np.zeros(2), math.inf
    for distance in DISTANCES:
        for direction in DIRECTIONS:
            offset = np.array(direction) * (np.array(half) + (MARKER + distance) * pixels)
            box = _around(point + offset, *half)
            covered = sum(_overlap(box, other) for other in taken) + 4.0 * _outside(box, frame)
            if covered == 0.0:
                return offset
            if covered < least:
                best, least = offset, covered
    return best


def _lead(axes: Axes, point: np.ndarray, offset: np.ndarray, half: tuple[float, float], color: str) -> None:
    end = point + offset * (1.0 - min(h / max(abs(o), 1e-9) for h, o in zip(half, offset, strict=True)))
    xy = axes.transData.inverted().transform([point, end])
    axes.plot(*xy.T, "-", color=color, linewidth=0.5, alpha=0.6, zorder=1, scalex=False, scaley=False)


def _around(point: np.ndarray, half_width: float, half_height: float) -> Bbox:
    x, y = point
    return Bbox([[x - half_width, y - half_height], [x + half_width, y + half_height]])


def _overlap(first: Bbox, second: Bbox) -> float:
    """Return the common area [pixel^2]."""
    both = Bbox.intersection(first, second)
    return 0.0 if both is None else float(both.width * both.height)


def _outside(box: Bbox, frame: Bbox) -> float:
    """Return the area of a box outside a frame [pixel^2]."""
    return float(box.width * box.height) - _overlap(box, frame)


# Colors of the charts: one for each family of films, the same in every chart.


FAMILIES: dict[str, tuple[str, float]] = {
    FilmFamily.SHORT: ("#8c564b", 7.0),
    FilmFamily.PUBLISHED: ("#e377c2", 3.8),
    FilmFamily.FIXED: ("#d62728", 2.4),
    FilmFamily.ROTATING: ("#ff7f0e", 1.3),
    FilmFamily.REYNOLDS: ("#a08000", 3.4),
    FilmFamily.FREE: ("#2ca02c", 2.8),
    FilmFamily.GRID: ("#17a0b8", 5.2),
    FilmFamily.EXTRAPOLATED: ("#1f4fb4", 4.2),
    FilmFamily.MAP: ("#000000", 1.1),
}
"""Colors and widths of lines [points] by family: of curves that coincide the wider shows beside the other."""

FAMILY_COLORS = {family: color for family, (color, _) in FAMILIES.items()}
FAMILY_WIDTHS = {family: width for family, (_, width) in FAMILIES.items()}

DASHES: dict[str | None, tuple[float, tuple[float, float]]] = {FilmFamily.MAP: (0.0, (4.0, 3.0))}
"""Dashes of lines by family, in widths; of all others the first is solid."""

WITHIN = ("-", "--", ":", "-.")
"""Lines that tell the films of a family apart."""

FRONT = "#7030a0"
"""Color of a Pareto front."""

BAD, DOUBTFUL, GOOD = "#f4b6b0", "#fbe3a8", "#cfe8cf"
"""Backgrounds of verdicts."""
