"""Charts of the atlas of limits, of whirl on types of bearings, and of coupling schemes."""

from __future__ import annotations

import math
from itertools import cycle, groupby
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from ..studies import Panel, StudyResult, StudyRow, failures, limit_curves
from ..studies.bearing_types import ALWAYS, NEVER, UNCARRIED
from .canvas import labeled, new_axes, new_grid
from .ladder_charts import SCHEME_LINES, TYPE_LINES

# Which bearing to buy.


RPM, GRAVITY = 30.0 / math.pi, 9.81


def plot_bearing_thresholds(result: StudyResult, *, axes: Axes | None = None) -> Axes:
    """Draw the speed from which a rigid rotor whirls over the load, a line for each type of bearing.

    Types that never whirl lie on the upper edge; a cross is a load that a bearing does not carry.

    Parameters
    ----------
    result : StudyResult
        Result as `bearing_thresholds` returns it.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("", size=(9.0, 6.6))
    told = result.conditions
    mass, ends = told["mass [kg]"], (told["searched from [rad/s]"], told["searched to [rad/s]"])
    low, top = (RPM * speed for speed in ends)
    lowest, width = top, 1.6
    types = groupby(result.rungs, key=lambda rung: rung.family)
    for (name, rungs), (color, style, _) in zip(types, cycle(TYPE_LINES), strict=False):
        points = [(rung["load [N]"], rung["threshold [rad/s]"], rung["whirl [-]"]) for rung in rungs]
        drawn = {NEVER: top, ALWAYS: low, UNCARRIED: math.nan}
        speeds = [drawn[met] if speed is None else RPM * speed for _, speed, met in points]
        lowest = min([lowest, *(RPM * speed for _, speed, _ in points if speed is not None)])
        never = all(met == NEVER for *_, met in points)
        loads = [load for load, *_ in points]
        line: dict[str, Any] = {"color": color, "clip_on": False}
        label = f"{name}: no whirl" if never else name
        axes.plot(loads, speeds, style, label=label, linewidth=width, **line)
        lost = [load for load, _, met in points if met == UNCARRIED]
        axes.plot(lost, [low] * len(lost), "x", **line)
        if never:  # the next one on the edge shows beside it
            width += 2.0
    _finish_thresholds(axes, (loads[0], loads[-1]), (max(low, 0.7 * lowest), top))
    axes.set_title(
        f"Which bearing for a rigid rotor of {mass:g} kg a bearing? One journal, bore and oil, "
        f"L/D = {told['length/diameter [1]']:g}\nstable below its line; on the upper edge, {top:.0f} rpm: "
        "no whirl at any speed searched",
        fontsize=10,
    )
    if loads[0] < GRAVITY * mass < loads[-1]:
        axes.axvline(GRAVITY * mass, color="0.5", linewidth=0.8)
        place = (GRAVITY * mass, 0.01)
        axes.text(*place, " weight", transform=axes.get_xaxis_transform(), fontsize=8, color="0.4")
    axes.legend(fontsize=8, loc="lower right")
    return axes


def _finish_thresholds(axes: Axes, loads: tuple[float, float], speeds: tuple[float, float]) -> None:
    axes.set(xscale="log", yscale="log", xlim=loads, ylim=speeds)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.set_minor_formatter(NullFormatter())
    axes.set(xlabel="load of the bearing along -y [N]", ylabel="speed from which the rotor whirls [rpm]")


# The atlas of limits: where each simplification fails, a figure for each physics and a summary of all.


LONG = 24
"""Characters of a label that has a line of its own."""

HOLDS, DEPENDS, FAILS = "#9fd3a8", "#f5d97a", "#e79a8f"
"""Colors of the summary: where all variants hold, some, and none."""


def plot_limits(atlas: StudyResult) -> dict[str, list[Axes]]:
    """Draw one panel for each simplification, and the level from which it counts as failed.

    Parameters
    ----------
    atlas : StudyResult
        Atlas as `limits_atlas` returns it.

    Returns
    -------
    dict of str to list of Axes
        Those of one figure by its physics, in the order of the panels of the atlas.
    """
    drawn = {}
    for physics, own in groupby(limit_curves(atlas).items(), key=lambda one: one[0].physics):
        panels = dict(own)
        drawn[physics] = new_grid(len(panels), columns=2, size=(4.7, 4.6), title=physics)
        for axes, (panel, curves) in zip(drawn[physics], panels.items(), strict=True):
            for name, curve in curves.items():
                axes.plot(*curve, ".-", label=name)
            _finish_limits(axes, panel)
    return drawn


def _finish_limits(axes: Axes, panel: Panel) -> None:
    axes.set(xlabel=panel.x_label, ylabel=panel.y_label, yscale="log", title=panel.title)
    if panel.logarithmic:
        axes.set_xscale("log")
    else:
        axes.locator_params(axis="x", nbins=6)  # numbers that do not touch
    if panel.level is not None:
        axes.axhline(panel.level, color="k", linewidth=1.0, linestyle="--", label=f"failed: {panel.level:g}")
    axes.grid(visible=True, alpha=0.3)
    longest = max(len(label) for label in axes.get_legend_handles_labels()[1])
    columns = 1 if longest > LONG else 2
    # below, where no curve is
    axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=columns, frameon=False)


def plot_limit_summary(atlas: StudyResult) -> list[Axes]:
    """Draw a strip for each simplification: where all of its variants hold, where some do, and where none.

    A panel whose ordinate is the limit itself has no strip.

    Parameters
    ----------
    atlas : StudyResult
        Atlas as `limits_atlas` returns it.

    Returns
    -------
    list of Axes
        Of one figure, in the order of the panels of the atlas.
    """
    judged, every = failures(atlas), limit_curves(atlas)
    title = "Errors below 10 %: green all variants, yellow some, red none"
    drawn = new_grid(len(judged), columns=1, size=(9.4, 0.72), title=title, more=1.0)
    for axes, (panel, found) in zip(drawn, judged.items(), strict=True):
        places = np.concatenate([x for x, _ in every[panel].values()])
        low, high = float(places.min()), float(places.max())
        ends = [high if at is None else at for at in found.values()]
        first, last = min(ends), max(ends)
        for start, end, color in ((low, first, HOLDS), (first, last, DEPENDS), (last, high, FAILS)):
            axes.axvspan(start, end, color=color, linewidth=0.0)
        axes.set(xscale="log" if panel.logarithmic else "linear", xlim=(low, high), yticks=())
        axes.tick_params(axis="x", which="both", labelsize=7, pad=1)
        axes.set_ylabel(f"{panel.physics}: {panel.title}", rotation=0, ha="right", va="center", fontsize=8)
        axes.set_xlabel(panel.x_label, fontsize=7, labelpad=1)
    return drawn


# Charts of coupling schemes: how long a macro step each stands.


def plot_coupling_limits(result: StudyResult) -> list[Axes]:
    """Draw the longest stable macro step over the eccentricity ratio, and over the mass of the journal.

    Lines are theory, marks are runs of the scheme; schemes without a limit are named above.

    Parameters
    ----------
    result : StudyResult
        Result as `coupling_limits` returns it.
    """
    shown = new_grid(2, columns=2, size=(5.5, 4.8))
    limit = "critical_macro_angle [deg]"
    limited = [rung for rung in result.rungs if rung[limit] is not None]
    parts = (
        ("eccentricity_ratio [1]", "eccentricity ratio", "rigid rotor, speed parameter 1"),
        (
            "mass_ratio [1]",
            "mass of the journal / mass of the rotor",
            "light journal, eccentricity ratio 0.7",
        ),
    )
    for axes, (place, label, title) in zip(shown, parts, strict=True):
        rigid = axes is shown[0]
        own = [rung for rung in limited if (rung["mass_ratio [1]"] == 1.0) is rigid]
        for scheme, (color, line, mark) in SCHEME_LINES.items():
            rungs = sorted((rung for rung in own if rung.family == scheme), key=lambda rung: rung[place])
            if rungs:
                axes.plot(*_points(rungs, place, limit), line, color=color, label=scheme)
                runs = [rung for rung in rungs if rung["simulated [deg]"] is not None]
                found = _points(runs, place, "simulated [deg]")
                axes.plot(*found, mark, color=color, markersize=5, fillstyle="none")
        axes.set(xlabel=label, title=title, ylabel="longest stable macro step [deg]", yscale="log")
        axes.grid(visible=True, which="both", alpha=0.25)
    shown[1].set_xscale("log")
    free = sorted({rung.family for rung in result.rungs} - {rung.family for rung in limited})
    title = f"no limit: {', '.join(free)}"
    shown[1].legend(fontsize=8, title=title, title_fontsize=8, ncols=2)
    return shown


def _points(rungs: list[StudyRow], *headings: str) -> list[list[float]]:
    return [[rung[heading] for rung in rungs] for heading in headings]


# Chart of the error of a coupled run over its macro step.


def plot_coupling_error(
    macro_angles: np.ndarray,
    errors: np.ndarray,
    refused: np.ndarray,
    *,
    limit: float | None = None,
    axes: Axes | None = None,
) -> Axes:
    """Draw the error of the coupled run against the monolithic one over the macro step.

    Parameters
    ----------
    macro_angles : ndarray, shape (n,) [rad]
        Shaft rotation between two exchanges.
    errors : ndarray, shape (n,) [1]
        Largest distance of the orbits / clearance.
    refused : ndarray of bool, shape (n,)
        Runs that are no answer; drawn as crosses.
    limit : float, optional [rad]
        Explicit stability limit of the coupling.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Co-simulation error against macro step")
    degrees, good = np.degrees(macro_angles), ~np.asarray(refused)
    axes.loglog(degrees[good], errors[good], "o-", label="Gauss-Seidel, force held")
    axes.loglog(degrees[~good], errors[~good], "x", color="C3", label="refused")
    if np.any(good):
        axes.loglog(degrees, errors[good][0] * degrees / degrees[good][0], "k:", label="first order")
    if limit is not None:
        axes.axvline(np.degrees(limit), color="C3", linewidth=1.0, label="explicit stability limit")
    axes.set_xticks(degrees, [f"{angle:.3g}" for angle in degrees])
    axes.minorticks_off()
    return labeled(axes, "macro step [deg of shaft rotation]", "largest orbit error / clearance")
