"""Charts of the types of bearings side by side: stiffness, damping, whirl thresholds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import cycle

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from ...comparisons import BearingCoefficients, BearingThresholds, WhirlOutcome
from ...model import Array
from ..canvas import new_axes, new_figure

ENTRIES = ("xx", "xy", "yx", "yy")

LINES = ("C0-", "C1-", "C2-", "C3-", "C4-", "C8-", "k--", "C5--")
"""Color and dash of the types in turn."""

RPM, GRAVITY = 30.0 / math.pi, 9.81

CROSSED = (1, 2, 5)
"""Panels of entries that change their sign."""

LINEAR = 1.0
"""Numbers of these entries below which their scale is linear."""


def plot_bearing_coefficients(result: BearingCoefficients) -> list[Axes]:
    """Draw K, C and the least film of all types of bearings over the Sommerfeld number, entry by entry."""
    figure = new_figure(size=(15.0, 8.4))
    shown = figure.subplots(2, 4, sharex=True).ravel().tolist()
    stiffness = {one.name: one.stiffness_number.reshape(-1, 4) for one in result.types}
    damping = {one.name: one.damping_number.reshape(-1, 4) for one in result.types}
    for k, entry in enumerate(ENTRIES):
        _draw(shown[k], result.sommerfeld, {name: K[:, k] for name, K in stiffness.items()})
        shown[k].set_title(f"K{entry} c / W", fontsize=10)
    for axes, k, entry in zip(shown[4:], (0, 1, 3), ("xx", "xy = Cyx", "yy"), strict=False):
        _draw(axes, result.sommerfeld, {name: C[:, k] for name, C in damping.items()})
        axes.set_title(f"C{entry} c omega / W", fontsize=10)
    for k, axes in enumerate(shown[:7]):
        if k in CROSSED:
            axes.set_yscale("symlog", linthresh=LINEAR)
        else:
            axes.set_yscale("log")
    _draw(shown[7], result.sommerfeld, {one.name: one.film_ratio for one in result.types})
    shown[7].set_title("least film / c", fontsize=10)
    for axes in shown[4:]:
        axes.set_xlabel("Sommerfeld number S [1]")
    handles, labels = shown[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize=9, frameon=False)
    figure.suptitle(
        f"Bearings of one bore, L/D = {result.slenderness:g}, load along -y\n{result.convention}\n"
        "tilting pads at the frequency of the shaft",
        fontsize=10,
    )
    return shown


def _draw(axes: Axes, x: Array, curves: Mapping[str, Array]) -> None:
    for (name, y), line in zip(curves.items(), cycle(LINES), strict=False):
        axes.plot(x, y, line, label=name, linewidth=1.4)
    axes.set_xscale("log")
    axes.grid(visible=True, alpha=0.3)


def plot_bearing_thresholds(result: BearingThresholds, *, axes: Axes | None = None) -> Axes:
    """Draw the speed from which a rigid rotor whirls over the load, a line for each type of bearing.

    Types that never whirl lie on the upper edge; a cross is a load that a bearing does not carry.

    Parameters
    ----------
    result : BearingThresholds
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("", size=(9.0, 6.6))
    low, top = (RPM * speed for speed in result.speed_range)
    lowest, width = top, 1.6
    for one, line in zip(result.types, cycle(LINES), strict=False):
        speed = RPM * np.array([np.nan if value is None else value for value in one.threshold_speed])
        lowest = min(lowest, float(np.min(speed, initial=lowest, where=np.isfinite(speed))))
        never, always, lost = (
            np.array([outcome is kind for outcome in one.outcomes])
            for kind in (WhirlOutcome.NEVER, WhirlOutcome.ALWAYS, WhirlOutcome.UNCARRIED)
        )
        label = f"{one.name}: no whirl" if never.all() else one.name
        drawn = np.where(never, top, np.where(always, low, speed))
        axes.plot(result.load, drawn, line, label=label, linewidth=width, clip_on=False)
        axes.plot(result.load[lost], np.full(int(lost.sum()), low), f"{line.strip('-')}x", clip_on=False)
        if never.all():  # the next one on the edge shows beside it
            width += 2.0
    ends = tuple(result.load[[0, -1]].tolist())
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=(max(low, 0.7 * lowest), top))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.set_minor_formatter(NullFormatter())
    axes.set(xlabel="load of the bearing along -y [N]", ylabel="speed from which the rotor whirls [rpm]")
    axes.set_title(
        f"Which bearing for a rigid rotor of {result.mass:g} kg a bearing? One journal, bore and oil, "
        f"L/D = {result.slenderness:g}\nstable below its line; on the upper edge, {top:.0f} rpm: "
        "no whirl at any speed searched",
        fontsize=10,
    )
    if ends[0] < GRAVITY * result.mass < ends[1]:
        axes.axvline(GRAVITY * result.mass, color="0.5", linewidth=0.8)
        place = (GRAVITY * result.mass, 0.01)
        axes.text(*place, " weight", transform=axes.get_xaxis_transform(), fontsize=8, color="0.4")
    axes.legend(fontsize=8, loc="lower right")
    return axes
