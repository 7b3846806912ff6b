"""Charts of the journal's motion: orbits and the locus of static equilibria."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..comparisons.journal.journal_rungs import FilmFamily
from ..results import Trajectory
from .canvas import legend_beside, new_axes
from .palette import DASHES, FAMILY_COLORS, FAMILY_WIDTHS, WITHIN


def plot_orbits(
    orbits: Mapping[str, Trajectory],
    *,
    clearance: float,
    center: Iterable[float] | None = None,
    axes: Axes | None = None,
) -> Axes:
    """Draw journal orbits.

    Parameters
    ----------
    orbits : mapping of str to Trajectory
        Label and motion; later ones are drawn dashed over earlier ones.
    clearance : float [m]
        Scale of both axes.
    center : iterable of 2 floats, optional [m]
        Static equilibrium, marked by a cross.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Orbit of the journal center", size=(5.6, 5.2))
    for number, (label, orbit) in enumerate(orbits.items()):
        x, y = orbit.position / clearance
        axes.plot(x, y, ("-", "--", ":")[min(number, 2)], label=label, linewidth=1.6)
    if center is not None:
        x0, y0 = center
        axes.plot(x0 / clearance, y0 / clearance, "k+", markersize=10, label="static equilibrium", zorder=3)
    axes.set(xlabel="x / clearance", ylabel="y / clearance", aspect="equal")
    legend_beside(axes)
    return axes


def plot_locus(
    curves: Mapping[str, tuple[np.ndarray, np.ndarray]],
    *,
    families: Mapping[str, FilmFamily] | None = None,
    axes: Axes | None = None,
) -> Axes:
    """Draw the loci of the journal center under a load along -y, rotation counter-clockwise.

    Parameters
    ----------
    curves : mapping of str to (ndarray, ndarray)
        Label, eccentricity ratio [1] and attitude angle [rad], each of shape (n,).
    families : mapping of str to FilmFamily, optional
        Family of films by label, for its color and line.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Locus of the journal center, load along -y", size=(7.6, 5.2))
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 181)
    axes.plot(np.cos(turn), np.sin(turn), "k-", linewidth=1.0, label="clearance circle")
    drawn: Counter[FilmFamily | None] = Counter()
    for label, (eccentricity_ratio, attitude_angle) in curves.items():
        x = eccentricity_ratio * np.sin(attitude_angle)
        y = -eccentricity_ratio * np.cos(attitude_angle)
        family = None if families is None else families.get(label)
        color, width, style = None, 1.4, WITHIN[drawn[family] % len(WITHIN)]
        if family is not None:
            color, width = FAMILY_COLORS[family], FAMILY_WIDTHS[family]
        drawn[family] += 1
        line: dict[str, Any] = {"color": color, "linewidth": width, "linestyle": DASHES.get(family, style)}
        axes.plot(x, y, label=label, zorder=2.0 + 0.5 / width, **line)
    axes.set(
        xlabel="x / clearance", ylabel="y / clearance", aspect="equal", xlim=(-0.05, 1.05), ylim=(-1.05, 0.1)
    )
    # Beside the picture: inside, it would lie on the clearance circle.
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.02, 0.5), handlelength=5.0)
    return axes
