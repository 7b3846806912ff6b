"""Charts of whirl: curves of periodic orbits with their stability, and basins."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from ..motion import BasinScan, Bifurcation, OrbitCurve, PeriodicOrbit
from .canvas import new_axes
from .palette import BAD, GOOD

MARKS = {
    Bifurcation.FOLD: "o",
    Bifurcation.PERIOD_DOUBLING: "D",
    Bifurcation.NEIMARK_SACKER: "s",
    Bifurcation.BRANCH: "^",
}
"""Marker of each bifurcation."""


def plot_orbit_curves(
    curves: Mapping[str, OrbitCurve], *, scale: float = 1.0, axes: Axes | None = None
) -> Axes:
    """Draw the amplitude of periodic orbits over their parameter; unstable ones dashed, bifurcations marked.

    Parameters
    ----------
    curves : mapping of str to OrbitCurve
        By label.
    scale : float
        Unit of the parameter.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Periodic orbits")
    marked = set()
    for k, (label, curve) in enumerate(curves.items()):
        color, x, stable = f"C{k}", curve.parameters / scale, curve.stable
        amplitude = curve.amplitudes
        # A segment is drawn as its ends are; where they differ, as the unstable one.
        solid = np.append(stable[:-1] & stable[1:], False)
        for shown, style in ((solid, "-"), (~solid, "--")):
            pieces = np.where(shown[:-1, None], np.stack([amplitude[:-1], amplitude[1:]], 1), np.nan)
            places = np.stack([x[:-1], x[1:]], 1)
            ends = np.full((len(pieces), 1), np.nan)
            line = np.hstack([places, ends]).ravel(), np.hstack([pieces, ends]).ravel()
            axes.plot(*line, style, color=color, label=label if style == "-" else None)
        for event in curve.events:
            name = None if event.kind in marked else event.kind.value
            marked.add(event.kind)
            axes.plot(
                event.parameter / scale,
                event.orbit.amplitude,
                MARKS[event.kind],
                color="k",
                markersize=5,
                label=name,
            )
    axes.set(ylabel="largest distance of the journal from its mean / clearance")
    axes.legend(fontsize=8)
    return axes


def plot_periodic_orbit(orbit: PeriodicOrbit, *, axes: Axes | None = None) -> Axes:
    """Draw a periodic orbit of each journal inside its clearance circle.

    Parameters
    ----------
    orbit : PeriodicOrbit
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Periodic orbit", size=(5.6, 5.2))
    paths = orbit.position(np.linspace(0.0, orbit.period, 361)) / orbit.lengths[:, None, None]
    for station, (x, y) in zip(orbit.stations, paths, strict=True):
        axes.plot(x, y, label=station or "journal")
    turn = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(np.cos(turn), np.sin(turn), "k-", linewidth=1.0)
    axes.set(xlabel="x / clearance", ylabel="y / clearance", aspect="equal")
    axes.legend(fontsize=8)
    return axes


def plot_basin(scan: BasinScan, *, clearance: float, axes: Axes | None = None) -> Axes:
    """Draw where a rotor goes from initial positions: to rest, or into whirl.

    Parameters
    ----------
    scan : BasinScan
        Over a list or a grid of offsets of one bearing.
    clearance : float [m]
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Where the rotor goes from rest at a position", size=(6.0, 5.6))
    x, y = (scan.offsets.reshape(2, -1) + scan.rest[:2, None]) / clearance
    whirls = scan.whirls.ravel()
    inside = np.hypot(x, y) < 1.0
    for chosen, color, label in ((whirls, BAD, "into whirl"), (~whirls, GOOD, "to rest")):
        here = chosen & inside
        axes.plot(x[here], y[here], "s", color=color, markersize=4.5, label=label)
    turn = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(np.cos(turn), np.sin(turn), "k-", linewidth=1.0)
    axes.plot(*(scan.rest[:2] / clearance), "k+", label="rest")
    axes.set(xlabel="x / clearance (load)", ylabel="y / clearance", aspect="equal")
    axes.legend(fontsize=8, loc="upper right")
    return axes
