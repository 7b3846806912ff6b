"""Chart of the models that could answer a scene's question: estimated error against cost."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes

from ..canvas import new_axes


@dataclass(frozen=True, kw_only=True)
class RungPoint:
    """One model on the chart.

    Attributes
    ----------
    name : str
    error_estimate : float [1]
    cost : float [s]
        Of its answer.
    chosen : bool
    """

    name: str
    error_estimate: float
    cost: float
    chosen: bool


def plot_scene_ladder(
    points: Sequence[RungPoint], *, title: str, tolerance: float, axes: Axes | None = None
) -> Axes:
    """Draw the estimated error of each model over its cost, the tolerance, and the model that answers.

    Parameters
    ----------
    points : sequence of RungPoint
    title : str
    tolerance : float [1]
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes(title, size=(7.5, 5.0))
    for number, point in enumerate(points):
        style = {"marker": "*", "markersize": 16} if point.chosen else {"marker": "o"}
        name = f"{point.name}, chosen" if point.chosen else point.name
        axes.plot(1e3 * point.cost, point.error_estimate, color=f"C{number % 10}", ls="", label=name, **style)
    axes.axhline(tolerance, color="k", linewidth=1.0, linestyle="--", label="tolerance")
    axes.set(xscale="log", yscale="log", xlabel="cost of the answer [ms]", ylabel="estimated error")
    axes.legend(fontsize=8)
    return axes
