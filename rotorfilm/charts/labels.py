"""Labels beside points that do not cover each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.transforms import Bbox

_BESIDE = ((1, 1), (-1, 1), (1, 0), (-1, 0), (1, -1), (-1, -1), (0, 1), (0, -1))

DIRECTIONS = (*_BESIDE, (1, 2), (-1, 2), (1, -2), (-1, -2))
"""Places tried around the point, in order of preference: (1, 1) is up to the right, corner to corner."""

DISTANCES = (0.0, 1.5, 6.0, 14.0, 24.0, 36.0, 50.0)
"""Gaps between label and that square tried [points], nearest first."""

MARKER = 3.5
"""Half the size of the square around a point that no label may cover, smaller than its dot [points]."""


class Label(NamedTuple):
    """Text in a color beside a point in data coordinates."""

    x: float
    y: float
    text: str
    color: str


def place_labels(
    axes: Axes, labels: Sequence[Label], *, obstacles: Sequence[tuple[float, float]] = (), size: float = 7.5
) -> None:
    """Write each label near its point, clear of all points, of the other labels and of the frame.

    Call last, when limits, scales and size of the figure are final. A label that finds no free place goes
    where it covers least; one that is moved away gets a thin line to its point.

    Parameters
    ----------
    axes : Axes
    labels : sequence of Label
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
    renderer = FigureCanvasAgg(figure).get_renderer()
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
