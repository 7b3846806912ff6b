"""Pictures drawn with plotly, for notebooks and for pages that a reader turns, enlarges and asks."""

from __future__ import annotations

from functools import singledispatch
from typing import Any, NamedTuple

import numpy as np
from matplotlib.colors import to_hex, to_rgba

from ..core.frames import optional
from .picture import BarsMark, ColorScale, CurveMark, FieldMark, LevelMark, NoteMark, Picture, PicturePanel

PIXELS = 96.0
"""Pixels in an inch."""

DASHES = {"-": "solid", "--": "dash", ":": "dot", "-.": "dashdot"}
SYMBOLS = {
    "o": "circle",
    "s": "square",
    "^": "triangle-up",
    "v": "triangle-down",
    "x": "x-thin",
    "D": "diamond",
    "+": "cross-thin",
    "*": "star",
    ".": "circle",
}


class _Place(NamedTuple):
    """Where in a plotly figure a panel is."""

    figure: Any
    row: int
    col: int
    legend: str

    def add(self, trace: Any, **more: Any) -> None:
        """Add a trace."""
        self.figure.add_trace(trace, row=self.row, col=self.col, **more)

    @property
    def domain(self) -> tuple[float, float, float]:
        """Right end, middle and height of the panel, in the figure."""
        found = self.figure.get_subplot(self.row, self.col)
        own = found.domain if hasattr(found, "domain") else None  # of a scene
        x, y = (own.x, own.y) if own else (found.xaxis.domain, found.yaxis.domain)
        return x[1], 0.5 * (y[0] + y[1]), y[1] - y[0]


def draw(picture: Picture) -> Any:
    """Return a plotly.graph_objects.Figure of the panels."""
    plots = optional("plotly.subplots", "'rotorfilm[report]'")
    columns = min(picture.columns, len(picture.panels))
    rows = -(-len(picture.panels) // columns)
    kinds = [{"type": "scene"} if one.z else {"secondary_y": bool(one.right)} for one in picture.panels]
    kinds += [{}] * (rows * columns - len(kinds))
    figure = plots.make_subplots(
        rows=rows,
        cols=columns,
        specs=[kinds[k * columns : (k + 1) * columns] for k in range(rows)],
        subplot_titles=[one.title.replace("\n", "<br>") for one in picture.panels],
        horizontal_spacing=0.16 / columns,
        vertical_spacing=0.2 / rows,
    )
    width, height = (PIXELS * size for size in picture.size)
    figure.update_layout(
        width=columns * width + 120.0,
        height=rows * height,
        title=picture.title.replace("\n", "<br>") or None,
        template="plotly_white",
        margin={"t": 60},
    )
    for k, panel in enumerate(picture.panels):
        place = _Place(figure, k // columns + 1, k % columns + 1, f"legend{k + 1}" if k else "legend")
        _draw_panel(place, panel)
    return figure


def _draw_panel(place: _Place, panel: PicturePanel) -> None:
    for one in panel.marks:
        draw_mark(one, place)
    figure, (x, y, height) = place.figure, place.domain
    scaled = any(getattr(one, "scale", None) for one in panel.marks)
    beside = x + 0.01 + 0.16 * scaled + 0.08 * bool(panel.right)
    shown = panel.legend != "none"
    figure.update_layout({place.legend: {"x": beside, "y": y + 0.5 * height, "visible": shown}})
    if panel.z:
        names = {
            f"{name}axis": {"title": {"text": text}}
            for name, text in zip("xyz", (panel.x, panel.y, panel.z), strict=True)
        }
        figure.update_scenes(names, row=place.row, col=place.col)
        return
    across = {"title": panel.x, **_range(panel.x_limits, "x" in panel.log)}
    upright = {"title": panel.y, **_range(panel.y_limits, "y" in panel.log)}
    where = {"row": place.row, "col": place.col}
    figure.update_xaxes(**across, **where)
    if panel.equal:
        own = figure.get_subplot(place.row, place.col)
        upright |= {"scaleanchor": own.yaxis.anchor, "scaleratio": 1.0}
    figure.update_yaxes(**upright, **where, **({"secondary_y": False} if panel.right else {}))
    if panel.right:
        figure.update_yaxes(title=panel.right, **_range(panel.right_limits, False), **where, secondary_y=True)


def _range(limits: Any, logarithmic: bool) -> dict[str, Any]:
    found: dict[str, Any] = {"type": "log"} if logarithmic else {}
    if limits is not None:
        ends = [None if end is None else float(np.log10(end)) if logarithmic else end for end in limits]
        found["range"] = ends
    return found


def _rgba(color: str, opacity: float) -> str:
    red, green, blue, _ = (round(255.0 * part) for part in to_rgba(color))
    return f"rgba({red},{green},{blue},{opacity:g})"


def _named(label: str, place: _Place) -> dict[str, Any]:
    """Return what a legend knows of a trace: traces of one label are one entry."""
    known = any(one.name == label and one.legend == place.legend for one in place.figure.data)
    return {"name": label, "showlegend": bool(label) and not known, "legendgroup": f"{place.legend}{label}"}


def _colored(scale: ColorScale, values: Any, place: _Place) -> dict[str, Any]:
    x, y, height = place.domain
    bar = {"title": {"text": scale.label, "side": "right"}, "x": x + 0.01, "y": y, "len": height}
    known = [one for one in place.figure.data if getattr(one, "meta", None) == [place.legend, scale.label]]
    return {
        "colorscale": scale.colors,
        "cmin" if values is not None else "zmin": scale.low,
        "cmax" if values is not None else "zmax": scale.high,
        "colorbar": bar,
        "showscale": not known,
    }


@singledispatch
def draw_mark(mark: Any, place: _Place) -> None:
    """Draw one mark."""
    raise NotImplementedError(type(mark).__name__)


@draw_mark.register
def _(one: CurveMark, place: _Place) -> None:
    objects = optional("plotly.graph_objects", "'rotorfilm[report]'")
    color = to_hex(one.color)
    mode = "+".join(name for name, on in (("lines", one.dash), ("markers", one.marker)) if on)
    options: dict[str, Any] = {"mode": mode or "none", "line": {"color": color, "width": one.width}}
    if one.dash:
        options["line"]["dash"] = DASHES[one.dash]
    if one.marker:
        symbol = SYMBOLS[one.marker] + ("" if one.filled or one.marker in "x+" else "-open")
        options["marker"] = {"color": color, "size": 1.4 * one.size, "symbol": symbol}
        if one.marker in "x+":
            options["marker"]["line"] = {"color": color, "width": 2}
    if one.values is not None and one.scale is not None:
        options["marker"] |= {"color": np.asarray(one.values), **_colored(one.scale, one.values, place)}
        options["meta"] = [place.legend, one.scale.label]
    options |= _named(one.label, place)
    if one.z is not None:
        if one.marker not in ("", "o", "s"):  # in space there are fewer symbols
            options["marker"]["symbol"] = "diamond"
        options["scene"] = place.figure.get_subplot(place.row, place.col).plotly_name
        place.add(objects.Scatter3d(x=one.x, y=one.y, z=one.z, **options))
        return
    if one.fill:
        options |= {"fill": "toself", "fillcolor": _rgba(one.color, one.fill)}
    right = {"secondary_y": True} if one.right else {}
    place.add(objects.Scatter(x=one.x, y=one.y, legend=place.legend, **options), **right)


@draw_mark.register
def _(one: FieldMark, place: _Place) -> None:
    objects = optional("plotly.graph_objects", "'rotorfilm[report]'")
    colors = _colored(one.scale, None, place)
    place.add(objects.Heatmap(x=one.x, y=one.y, z=one.values, meta=[place.legend, one.scale.label], **colors))
    if one.contour is not None:
        lines = {"start": one.level, "end": one.level, "size": 1.0, "coloring": "none"}
        line = {"color": to_hex(one.line), "width": 1.0}
        place.add(
            objects.Contour(x=one.x, y=one.y, z=one.contour, contours=lines, line=line, showscale=False)
        )


@draw_mark.register
def _(one: BarsMark, place: _Place) -> None:
    objects = optional("plotly.graph_objects", "'rotorfilm[report]'")
    lengths, options = np.asarray(one.tops) - one.base, {"marker": {"color": to_hex(one.color)}}
    named = {"base": one.base, "width": one.width, "legend": place.legend, **_named(one.label, place)}
    pair = {"x": lengths, "y": one.places} if one.across else {"x": one.places, "y": lengths}
    place.add(objects.Bar(**pair, orientation="h" if one.across else "v", **named, **options))
    place.figure.update_layout(barmode="overlay")


@draw_mark.register
def _(one: LevelMark, place: _Place) -> None:
    where = {"row": place.row, "col": place.col, "exclude_empty_subplots": False}
    if one.to is not None:
        ends = ("x0", "x1") if one.upright else ("y0", "y1")
        add = place.figure.add_vrect if one.upright else place.figure.add_hrect
        add(
            **dict(zip(ends, (one.at, one.to), strict=True)),
            fillcolor=to_hex(one.color),
            opacity=0.25,
            line_width=0,
            **where,
        )
    else:
        line = {"color": to_hex(one.color), "width": 1.0, "dash": DASHES[one.dash]}
        if one.upright:
            place.figure.add_vline(x=one.at, line=line, **where)
        else:
            place.figure.add_hline(y=one.at, line=line, **where)
    if one.label:  # a shape has no place in a legend of a panel
        color = {"line": {"color": to_hex(one.color), "dash": DASHES[one.dash]}, "mode": "lines"}
        if one.to is not None:
            color = {
                "marker": {"color": _rgba(one.color, 0.25), "symbol": "square", "size": 12},
                "mode": "markers",
            }
        objects = optional("plotly.graph_objects", "'rotorfilm[report]'")
        place.add(
            objects.Scatter(x=[None], y=[None], legend=place.legend, **color, **_named(one.label, place))
        )


@draw_mark.register
def _(one: NoteMark, place: _Place) -> None:
    objects = optional("plotly.graph_objects", "'rotorfilm[report]'")
    text = {
        "text": [one.text],
        "textposition": "top right",
        "textfont": {"color": to_hex(one.color), "size": 11},
    }
    place.add(objects.Scatter(x=[one.x], y=[one.y], mode="text", showlegend=False, hoverinfo="skip", **text))
