"""Pictures drawn with matplotlib."""

from __future__ import annotations

import io
import sys
import warnings
from functools import singledispatch
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

from ..core.files import write_atomically
from .canvas import new_figure, place_labels
from .picture import BarsMark, CurveMark, FieldMark, LevelMark, NoteMark, Picture, PicturePanel

FOR_FILES = {"agg", "cairo", "pdf", "pgf", "ps", "svg", "template"}
"""Backends of matplotlib that show nothing."""

NARROW = 50.0
"""Ratio of the ends of a logarithmic axis, below which it is labelled more densely than by decades."""


def draw(picture: Picture, given: Any = None, *, for_pyplot: bool = False) -> list[Axes]:
    """Draw the panels, on Axes that are given or in a new figure; return its Axes.

    A figure for pyplot is one that `matplotlib.pyplot.show` shows, where a backend with windows or that of a
    notebook is in use.
    """
    shown = _new(picture, for_pyplot=for_pyplot) if given is None else list(np.atleast_1d(given))
    for axes, panel in zip(shown, picture.panels, strict=True):
        _draw_panel(axes, panel)
    for axes, panel in zip(shown, picture.panels, strict=True):
        if notes := [one for one in panel.marks if isinstance(one, NoteMark) and one.clear]:
            dots = [one for one in panel.marks if isinstance(one, CurveMark) and one.marker]
            places = [np.column_stack([one.x, one.y]) for one in dots]
            place_labels(axes, notes, obstacles=[tuple(point) for one in places for point in one.tolist()])
    return shown


def _new(picture: Picture, *, for_pyplot: bool) -> list[Any]:
    columns = min(picture.columns, len(picture.panels))
    rows = -(-len(picture.panels) // columns)
    size = columns * picture.size[0], rows * picture.size[1]
    pyplot: Any = sys.modules.get("matplotlib.pyplot") if for_pyplot else None
    shows = pyplot is not None and pyplot.get_backend().lower() not in FOR_FILES
    figure = pyplot.figure(figsize=size, layout="constrained") if shows else new_figure(size=size)
    figure.suptitle(picture.title, fontsize=11)
    return [
        figure.add_subplot(rows, columns, k, projection="3d" if panel.z else None)
        for k, panel in enumerate(picture.panels, start=1)
    ]


def _draw_panel(axes: Any, panel: PicturePanel) -> None:
    right = axes.twinx() if panel.right else axes
    fields = [one for one in panel.marks if isinstance(one, FieldMark)]
    for one in panel.marks:
        draw_mark(one, right if isinstance(one, CurveMark) and one.right else axes)
    axes.set(xlabel=panel.x, ylabel=panel.y)
    if panel.title:
        axes.set_title(panel.title, fontsize=10)
    if panel.z:
        axes.set_zlabel(panel.z)
    for name in panel.log:
        axes.set(**{f"{name}scale": "log"})
    if panel.x_limits:
        axes.set_xlim(*panel.x_limits)
    if panel.y_limits:
        axes.set_ylim(*panel.y_limits)
    for name in panel.log:
        _label_narrow_log(getattr(axes, f"{name}axis"))
    if panel.right:
        right.set(ylabel=panel.right, ylim=panel.right_limits)
    if panel.equal:
        # Limits that are given stay; else the axes get wider.
        axes.set(aspect="equal", adjustable="box" if panel.x_limits or panel.y_limits else "datalim")
    if fields:
        axes.grid(visible=False)
    else:
        axes.grid(visible=True, alpha=0.3)
    _add_legend(axes, right, panel.legend)


def _label_narrow_log(axis: Any) -> None:
    """Label 1, 2, 5, 10, ... on a logarithmic axis of few decades, where every tick would get a label."""
    low, high = axis.get_view_interval()
    if high < NARROW * low:
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(FormatStrFormatter("%g"))
        axis.set_minor_formatter(NullFormatter())


def _add_legend(axes: Any, right: Any, place: str) -> None:
    handles, labels = axes.get_legend_handles_labels()
    if right is not axes:
        others = right.get_legend_handles_labels()
        handles, labels = handles + others[0], labels + others[1]
    if not labels or place == "none":
        return
    beside: dict[str, Any] = {"loc": "upper left", "bbox_to_anchor": (1.02, 1.0)} if place == "beside" else {}
    axes.legend(handles, labels, fontsize=8, **beside)


def save(shown: Axes | Picture, path: Path, *, dpi: int = 130) -> Path:
    """Write a picture, or the figure of these Axes, all of its Axes, and return the path."""
    if isinstance(shown, Picture):
        return shown.save(path, dpi=dpi)
    return write_atomically(path, png(shown, dpi=dpi, kind=path.suffix[1:] or "png"))


def png(axes: Axes, *, dpi: int = 130, kind: str = "png") -> bytes:
    """Return the figure of these Axes as the content of a file of a kind, PNG by default."""
    figure = axes.get_figure()
    assert isinstance(figure, Figure)
    picture = io.BytesIO()
    metadata = {"Software": "rotorfilm"} if kind == "png" else None
    with warnings.catch_warnings():
        # A busy machine makes it warn of the time that a legend takes.
        warnings.filterwarnings("ignore", message="Creating legend with loc")
        figure.savefig(picture, dpi=dpi, metadata=metadata, format=kind)
    return picture.getvalue()


@singledispatch
def draw_mark(mark: Any, axes: Any) -> None:
    """Draw one mark."""
    raise NotImplementedError(type(mark).__name__)


@draw_mark.register
def _(one: CurveMark, axes: Any) -> None:
    places = (one.x, one.y) if one.z is None else (one.x, one.y, one.z)
    label = one.label or "_nolegend_"
    if one.fill:
        axes.fill(one.x, one.y, color=one.color, alpha=one.fill, linewidth=0.0, label=label)
        label = "_nolegend_"
    if one.values is not None and one.scale is not None:
        scale = one.scale
        mesh = axes.scatter(
            *places, c=one.values, cmap=scale.colors, vmin=scale.low, vmax=scale.high, marker=one.marker,
            s=one.size**2, edgecolors="k", linewidths=0.3, zorder=3, label=label,
        )  # fmt: skip
        _add_scale(axes, mesh, scale.label)
        return
    if one.fill and not one.dash:
        return
    face = one.color if one.filled else "none"
    axes.plot(
        *places, linestyle=one.dash or "none", color=one.color, linewidth=one.width, marker=one.marker,
        markersize=one.size, markerfacecolor=face, label=label,
    )  # fmt: skip


def _add_scale(axes: Any, mesh: Any, label: str) -> None:
    """Draw the scale of colors beside the axes, once for each label."""
    known = vars(axes).setdefault("_color_scales", set())
    if label not in known:
        known.add(label)
        axes.get_figure().colorbar(mesh, ax=axes, label=label)


@draw_mark.register
def _(one: FieldMark, axes: Any) -> None:
    scale = one.scale
    mesh = axes.pcolormesh(
        one.x, one.y, one.values, shading="nearest", cmap=scale.colors, vmin=scale.low, vmax=scale.high
    )
    _add_scale(axes, mesh, scale.label)
    if one.contour is not None and np.ptp(np.nan_to_num(one.contour)) > 0.0:
        axes.contour(one.x, one.y, one.contour, levels=[one.level], colors=one.line, linewidths=1.0)


@draw_mark.register
def _(one: BarsMark, axes: Any) -> None:
    lengths = np.asarray(one.tops) - one.base
    options: dict[str, Any] = {"color": one.color, "label": one.label or "_nolegend_"}
    if one.across:
        axes.barh(one.places, lengths, height=one.width, left=one.base, **options)
    else:
        axes.bar(one.places, lengths, width=one.width, bottom=one.base, **options)


@draw_mark.register
def _(one: LevelMark, axes: Any) -> None:
    label = one.label or "_nolegend_"
    if one.to is not None:
        span = axes.axvspan if one.upright else axes.axhspan
        span(one.at, one.to, color=one.color, alpha=0.25, linewidth=0.0, label=label)
        return
    line = axes.axvline if one.upright else axes.axhline
    line(one.at, color=one.color, linestyle=one.dash, linewidth=1.0, label=label)


@draw_mark.register
def _(one: NoteMark, axes: Any) -> None:
    if one.clear:
        return  # when sizes and limits are final
    axes.annotate(
        one.text, (one.x, one.y), (3, 3), textcoords="offset points", fontsize=8, color=one.color, zorder=5
    )
