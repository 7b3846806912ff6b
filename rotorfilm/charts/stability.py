"""Chart of the whirl threshold of a rigid rotor over the eccentricity ratio."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from .canvas import new_axes


def plot_stability(
    curves: Mapping[str, tuple[np.ndarray, Sequence[float | None]]],
    *,
    point: tuple[float, float] | None = None,
    axes: Axes | None = None,
) -> Axes:
    """Draw threshold speed * sqrt(clearance * mass / load) over the eccentricity ratio.

    Parameters
    ----------
    curves : mapping of str to (ndarray, sequence of float or None)
        Label, eccentricity ratio [1] and speed parameter [1]; None where there is no threshold. A curve
        that has none at all is listed in the legend as such.
    point : (float, float), optional
        Eccentricity ratio and speed parameter of the working point.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Whirl threshold of a rigid rotor (unstable above)")
    for label, (eccentricity_ratio, thresholds) in curves.items():
        values = np.array([np.nan if value is None else value for value in thresholds])
        none_at_all = np.all(np.isnan(values))
        axes.plot(eccentricity_ratio, values, label=f"{label}: no threshold exists" if none_at_all else label)
    if point is not None:
        axes.plot(*point, "k*", markersize=11, label="working point")
    axes.set(
        xlabel="eccentricity ratio", ylabel="speed * sqrt(clearance * mass / load)", xlim=(0, 1), ylim=(0, 6)
    )
    axes.legend(fontsize=8)
    return axes
