"""Draw the picture of docs/pads.md: clearances, offset and orientation of bearings made of pads.

    python docs/draw_pads.py pads.png

The clearances are a hundred times those of a bearing.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from rotorfilm import Lobe, even_pivots, lobe_set
from rotorfilm.charts import new_figure, save

JOURNAL, CLEARANCE = 1.0, 0.36
"""Radius of the journal, and clearance of a pad, far larger than in any bearing."""


def arc(lobe: Lobe) -> np.ndarray:
    """Return points of the face of a pad, shape (2, n)."""
    angle = np.linspace(lobe.start, lobe.start + lobe.extent, 181)
    center = CLEARANCE * np.array(lobe.center)[:, None]
    return center + (JOURNAL + CLEARANCE) * np.stack([np.cos(angle), np.sin(angle)])


def circle(axes: Axes, radius: float, **style: object) -> None:
    """Draw a circle about the center of the bearing."""
    turn = np.linspace(0.0, 2.0 * math.pi, 361)
    axes.plot(radius * np.cos(turn), radius * np.sin(turn), **style)


def set_of_pads(axes: Axes, lobes: tuple[Lobe, ...], title: str) -> None:
    """Draw pads around a centered journal, where each is closest, and the assembled clearance."""
    circle(axes, JOURNAL, color="0.4", linewidth=1.2)
    circle(axes, JOURNAL + CLEARANCE * (1.0 - lobes[0].preload), color="C3", linewidth=0.8, linestyle="--")
    for lobe in lobes:
        axes.plot(*arc(lobe), color="k", linewidth=4.0, solid_capstyle="butt")
        direction = np.array([math.cos(lobe.closest), math.sin(lobe.closest)])
        place = (JOURNAL + CLEARANCE * (1.0 - lobe.preload)) * direction
        axes.plot(*np.stack([JOURNAL * direction, place], axis=1), "C3-", linewidth=2.0)
    axes.annotate("", (0.0, -0.72), (0.0, -0.25), arrowprops={"arrowstyle": "-|>", "color": "C0"})
    axes.text(0.05, -0.5, "load", color="C0", fontsize=9)
    axes.annotate(
        "", (-0.3, 0.45), (0.3, 0.45), arrowprops={"arrowstyle": "-|>", "connectionstyle": "arc3,rad=.4"}
    )
    axes.text(0.0, 0.62, "speed", fontsize=9, ha="center")
    axes.set_title(title, fontsize=10)
    axes.set(aspect="equal", xlim=(-1.65, 1.65), ylim=(-1.65, 1.65))
    axes.axis("off")


def clearances(axes: Axes, lobe: Lobe) -> None:
    """Name the clearances at one pad."""
    center = CLEARANCE * np.array(lobe.center)
    end = arc(lobe)[:, 150]
    axes.plot(*np.stack([center, end], axis=1), "C2-", linewidth=1.0)
    axes.plot(*center, "C2o", markersize=4)
    axes.plot(0.0, 0.0, "k+", markersize=8)
    axes.text(*(0.5 * (center + end) + [0.04, 0.02]), "R + c_p", color="C2", fontsize=9)
    text = "center of the pad,\nm c_p away"
    axes.text(center[0] - 0.08, center[1] - 0.2, text, color="C2", fontsize=8, ha="right")
    axes.text(0.08, -1.36, "c_b", color="C3", fontsize=10)


def tilting(between: bool) -> tuple[Lobe, ...]:
    """Return tilting pads as lobes with their pivots where they are closest."""
    extent = math.radians(60.0)
    pivots = even_pivots(5, between_pads=between)
    return tuple(Lobe(start=at - 0.5 * extent, extent=extent, preload=0.4) for at in pivots)


def draw(path: Path) -> Path:
    """Draw the picture."""
    figure = new_figure(size=(14.0, 3.9))
    shown = figure.subplots(1, 4)
    elliptical = lobe_set("elliptical", preload=0.55)
    set_of_pads(shown[0], elliptical, "preload m = 1 - c_b/c_p (elliptical, offset 0.5)")
    clearances(shown[0], elliptical[0])
    set_of_pads(shown[1], lobe_set("offset_halves", preload=0.55), "offset 1: closest at the trailing end")
    set_of_pads(shown[2], tilting(False), "tilting pads, load on a pad")
    set_of_pads(shown[3], tilting(True), "load between pads")
    return save(shown[0], path, dpi=110)


if __name__ == "__main__":
    draw(Path(sys.argv[1]))
