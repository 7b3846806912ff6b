"""Pictures without a backend: what is drawn, as records that matplotlib and plotly draw alike."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core.files import write_atomically
from ..core.inputs import require_choice

BACKENDS = {"matplotlib": "on_matplotlib", "plotly": "on_plotly"}
"""Modules that draw, by the name of the backend."""

_CHOSEN = ["matplotlib"]


def use(backend: str) -> None:
    """Choose the backend of `plot()` of results: "matplotlib" or "plotly"."""
    _CHOSEN[0] = _known(backend)


def _known(backend: str) -> str:
    require_choice("backend", backend, BACKENDS)
    return backend


class ColorScale(NamedTuple):
    """What colors mean.

    Attributes
    ----------
    label : str
        Label with the unit.
    colors : str
        Name of a color map that both backends know.
    low, high : float, optional
        Values at its ends; those of the data by default.
    """

    label: str
    colors: str = "viridis"
    low: float | None = None
    high: float | None = None


class CurveMark(NamedTuple):
    """A line, marks, or both, in two or three dimensions.

    Attributes
    ----------
    x, y : array_like, shape (n,)
        A line breaks at nan.
    label : str
        Label in the legend; empty for none.
    color : str
        Color as matplotlib names it.
    dash : str
        "-", "--", ":", "-." or empty for no line.
    width : float
        Width of the line [points].
    marker : str
        "o", "s", "^", "v", "x", "D", "+", "*" or empty.
    filled : bool
        Whether the marks are.
    size : float
        Size of the marks [points].
    z : array_like, optional
        Third coordinate, of a panel with three axes.
    values : array_like, optional
        What the colors of the marks show, on a `scale`.
    scale : ColorScale, optional
    fill : float
        Opacity with which the polygon of the curve is filled.
    right : bool
        Whether it belongs to the second axis, on the right.
    """

    x: ArrayLike
    y: ArrayLike
    label: str = ""
    color: str = "C0"
    dash: str = "-"
    width: float = 1.5
    marker: str = ""
    filled: bool = True
    size: float = 5.0
    z: ArrayLike | None = None
    values: ArrayLike | None = None
    scale: ColorScale | None = None
    fill: float = 0.0
    right: bool = False


class FieldMark(NamedTuple):
    """Values on a grid, as colors, and a line on which others have one value.

    Attributes
    ----------
    x, y : array_like, shape (n,), (m,)
    values : array_like, shape (m, n)
    scale : ColorScale
    contour : array_like, shape (m, n), optional
        Contour whose line is drawn.
    level : float
        On that line.
    line : str
        Its color.
    """

    x: ArrayLike
    y: ArrayLike
    values: ArrayLike
    scale: ColorScale
    contour: ArrayLike | None = None
    level: float = 0.0
    line: str = "white"


class BarsMark(NamedTuple):
    """Bars.

    Attributes
    ----------
    places : array_like, shape (n,)
        Numbers, or words that name them.
    tops : array_like, shape (n,)
        Ends of the bars.
    label, color : str
        Label and color as in `CurveMark`.
    width : float
        Width in the unit of the places.
    base : float
        Where all bars begin.
    across : bool
        Whether they lie.
    """

    places: ArrayLike
    tops: ArrayLike
    label: str = ""
    color: str = "C0"
    width: float = 0.8
    base: float = 0.0
    across: bool = False


class LevelMark(NamedTuple):
    """A straight line across the panel, or a band.

    Attributes
    ----------
    at : float
        Value of y, or of x where it is upright.
    label, color, dash : str
        Label, color and dash as in `CurveMark`.
    upright : bool
        Whether the line is at a value of x.
    to : float, optional
        Other side of a band.
    """

    at: float
    label: str = ""
    color: str = "k"
    dash: str = "-"
    upright: bool = False
    to: float | None = None


class NoteMark(NamedTuple):
    """A text beside a point.

    Attributes
    ----------
    x, y : float
    text, color : str
        The text, and its color.
    clear : bool
        Whether matplotlib moves it clear of other such texts and of all points.
    """

    x: float
    y: float
    text: str
    color: str = "k"
    clear: bool = False


Mark = CurveMark | FieldMark | BarsMark | LevelMark | NoteMark


class PicturePanel(NamedTuple):
    """One pair of axes, or three axes where `z` has a label, and what is drawn between them.

    Attributes
    ----------
    marks : sequence of Mark
        Marks from the back to the front.
    x, y, z, right : str
        Labels with units; `right` that of a second vertical axis.
    title : str
    log : str
        Axes that are logarithmic, such as "y" or "xy".
    x_limits, y_limits, right_limits : (float or None, float or None), optional
        Ends of the axes; those of the data by default.
    equal : bool
        Whether both axes have one scale.
    legend : str
        "inside", "beside" or "none".
    """

    marks: Sequence[Mark]
    x: str
    y: str
    title: str = ""
    z: str = ""
    right: str = ""
    log: str = ""
    x_limits: tuple[float | None, float | None] | None = None
    y_limits: tuple[float | None, float | None] | None = None
    right_limits: tuple[float | None, float | None] | None = None
    equal: bool = False
    legend: str = "inside"

    @property
    def curves(self) -> dict[str, CurveMark]:
        """The curves that have a label, by it."""
        return {one.label: one for one in self.marks if isinstance(one, CurveMark) and one.label}


class Picture(NamedTuple):
    """Panels of one picture, which knows no backend.

    Attributes
    ----------
    panels : tuple of PicturePanel
    columns : int
        Panels in a row.
    size : (float, float) [inch]
        Size of a panel.
    title : str
    """

    panels: tuple[PicturePanel, ...]
    columns: int = 1
    size: tuple[float, float] = (6.4, 4.8)
    title: str = ""

    def draw(self, axes: Any = None) -> list[Any]:
        """Draw with matplotlib, on these Axes, one or several, or in a new figure; return them."""
        return list(_matplotlib().draw(self, axes))

    def to_plotly(self) -> Any:
        """Return a plotly.graph_objects.Figure; AbsentError where plotly is not installed."""
        return import_module(f"{__package__}.on_plotly").draw(self)

    def shown(self, axes: Any = None, backend: str = "") -> Any:
        """Return what `plot()` of a result does: Axes, several of them as a tuple, or a plotly figure."""
        if _known(backend or _CHOSEN[0]) == "plotly" and axes is None:
            return self.to_plotly()
        drawn = list(_matplotlib().draw(self, axes, for_pyplot=True))
        return drawn[0] if len(drawn) == 1 else tuple(drawn)

    def save(self, path: Path | str, *, dpi: int = 130) -> Path:
        """Write it: .html as an interactive page that needs no network, all else with matplotlib."""
        place = Path(path)
        if place.suffix == ".html":
            page = self.to_plotly().to_html(include_plotlyjs=True, full_html=True)
            return write_atomically(place, page.encode())
        drawn = _matplotlib().png(self.draw()[0], dpi=dpi, kind=place.suffix[1:] or "png")
        return write_atomically(place, drawn)

    def _repr_png_(self) -> bytes:
        return bytes(_matplotlib().png(self.draw()[0]))


def _matplotlib() -> Any:
    return import_module(f"{__package__}.on_matplotlib")


def closed(x: ArrayLike, low: ArrayLike, high: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Return the polygon between two curves over the same places."""
    places = np.asarray(x)
    return np.concatenate([places, places[::-1]]), np.concatenate([np.asarray(low), np.asarray(high)[::-1]])


def circle(radius: float = 1.0, label: str = "") -> CurveMark:
    """Return a circle about the origin, as that of the clearance."""
    turn = np.linspace(0.0, 2.0 * np.pi, 361)
    return CurveMark(radius * np.cos(turn), radius * np.sin(turn), label, "k", width=1.0)
