"""Pictures of the atlas of limits, of whirl on types of bearings, and of coupling schemes."""

from __future__ import annotations

import math
from itertools import cycle, groupby

import numpy as np

from ..studies import Panel, StudyResult, failures, limit_curves
from ..studies.bearing_types import ALWAYS, NEVER, UNCARRIED
from .ladder_charts import SCHEME_LINES, TYPE_LINES, columns_of
from .picture import BarsMark, CurveMark, LevelMark, Mark, NoteMark, Picture, PicturePanel

# Which bearing to buy.


RPM, GRAVITY = 30.0 / math.pi, 9.81


def plot_bearing_thresholds(result: StudyResult) -> Picture:
    """Describe the speed from which a rigid rotor whirls over the load, a line for each type of bearing.

    Types that never whirl lie on the upper edge; a cross is a load that a bearing does not carry.

    Parameters
    ----------
    result : StudyResult
        Result as `bearing_thresholds` returns it.
    """
    told = result.conditions
    mass, ends = told["mass [kg]"], (told["searched from [rad/s]"], told["searched to [rad/s]"])
    low, top = (RPM * speed for speed in ends)
    marks: list[Mark] = []
    lowest, width = top, 1.6
    types = groupby(result.rungs, key=lambda rung: rung.family)
    for (name, rungs), (color, dash, _) in zip(types, cycle(TYPE_LINES), strict=False):
        points = [(rung["load [N]"], rung["threshold [rad/s]"], rung["whirl [-]"]) for rung in rungs]
        drawn = {NEVER: top, ALWAYS: low, UNCARRIED: math.nan}
        speeds = [drawn[met] if speed is None else RPM * speed for _, speed, met in points]
        lowest = min([lowest, *(RPM * speed for _, speed, _ in points if speed is not None)])
        never = all(met == NEVER for *_, met in points)
        loads = [load for load, *_ in points]
        label = f"{name}: no whirl" if never else name
        marks.append(CurveMark(loads, speeds, label, color, dash, width))
        lost = [load for load, _, met in points if met == UNCARRIED]
        marks.append(CurveMark(lost, [low] * len(lost), "", color, "", marker="x"))
        width += 2.0 * never  # the next one on the edge shows beside it
    if loads[0] < GRAVITY * mass < loads[-1]:
        marks.append(LevelMark(GRAVITY * mass, "weight", "0.5", upright=True))
    title = (
        f"Which bearing for a rigid rotor of {mass:g} kg a bearing? One journal, bore and oil, "
        f"L/D = {told['length/diameter [1]']:g}\nstable below its line; on the upper edge, {top:.0f} rpm: "
        "no whirl at any speed searched"
    )
    panel = PicturePanel(
        marks, "load of the bearing along -y [N]", "speed from which the rotor whirls [rpm]", title, log="xy",
        x_limits=(loads[0], loads[-1]), y_limits=(max(low, 0.7 * lowest), top),
    )  # fmt: skip
    return Picture((panel,), size=(9.0, 6.6))


# The atlas of limits: where each simplification fails, a figure for each physics and a summary of all.


HOLDS, DEPENDS, FAILS = "#8fc3e8", "#f5e08a", "#e39a6b"
"""Colors of the summary, blue, yellow and orange: where all variants hold, some, and none."""


def plot_limits(atlas: StudyResult) -> dict[str, Picture]:
    """Describe one panel for each simplification, and the level from which it counts as failed.

    Parameters
    ----------
    atlas : StudyResult
        Atlas as `limits_atlas` returns it.

    Returns
    -------
    dict of str to Picture
        Pictures by physics, panels in the order of the atlas.
    """
    return {
        physics: Picture(tuple(_limits(*one) for one in own), columns=2, size=(6.0, 3.6), title=physics)
        for physics, own in groupby(limit_curves(atlas).items(), key=lambda one: one[0].physics)
    }


def _limits(panel: Panel, curves: dict[str, tuple[np.ndarray, np.ndarray]]) -> PicturePanel:
    marks: list[Mark] = [
        CurveMark(*curve, name, f"C{k % 10}", dash, marker="o", size=3.0)
        for k, ((name, curve), dash) in enumerate(zip(curves.items(), cycle(("-", "--", ":", "-."))))
    ]
    if panel.level is not None:
        marks.append(LevelMark(panel.level, f"failed: {panel.level:g}", dash="--"))
    log = "xy" if panel.logarithmic else "y"
    return PicturePanel(marks, panel.x_label, panel.y_label, panel.title, log=log, legend="beside")


def plot_limit_summary(atlas: StudyResult) -> Picture:
    """Describe where each simplification holds, over its range: with all variants, with some, with none.

    A panel whose ordinate is the limit itself has no bar.

    Parameters
    ----------
    atlas : StudyResult
        Atlas as `limits_atlas` returns it.
    """
    judged, every = failures(atlas), limit_curves(atlas)
    names, shares, texts = [], [], []
    for panel, found in list(judged.items())[::-1]:
        places = np.concatenate([x for x, _ in every[panel].values()])
        low, high = float(places.min()), float(places.max())
        ends = [high if at is None else at for at in found.values()]
        first, last = min(ends), max(ends)
        scale = np.log if panel.logarithmic else np.asarray
        names.append(f"{panel.physics}: {panel.title}")
        shares.append((scale([first, last]) - scale(low)) / (scale(high) - scale(low)))
        until = f"all to {first:.3g}" + (f", some to {last:.3g}" if first != last else "")
        texts.append(f"{panel.x_label}: {until}; examined from {low:.3g} to {high:.3g}")
    rows = (FAILS, "no variant", np.ones(len(names))), (DEPENDS, "some", np.array(shares)[:, 1])
    marks: list[Mark] = [
        BarsMark(np.array(names), tops, label, color, across=True)
        for color, label, tops in (*rows, (HOLDS, "all variants", np.array(shares)[:, 0]))
    ]
    marks += [NoteMark(0.0, k - 0.3, text) for k, text in enumerate(texts)]
    label = "share of the examined range (of its logarithm if it is tenfold or more)"
    whole = PicturePanel(marks, label, "", "Where the error is below 10 %", legend="beside")
    whole = whole._replace(x_limits=(0.0, 1.0), y_limits=(-0.7, len(names) - 0.3))
    return Picture((whole,), size=(12.0, 1.5 + 0.34 * len(names)))


# Coupling schemes: how long a macro step each stands.


def plot_coupling_limits(result: StudyResult) -> Picture:
    """Describe the longest stable macro step over the eccentricity ratio, and over the mass of the journal.

    Lines are theory, marks are runs of the scheme; schemes without a limit are named above.

    Parameters
    ----------
    result : StudyResult
        Result as `coupling_limits` returns it.
    """
    limit, mass = "critical_macro_angle [deg]", "mass_ratio [1]"
    limited = [rung for rung in result.rungs if rung[limit] is not None]
    free = sorted({rung.family for rung in result.rungs} - {rung.family for rung in limited})
    parts = (
        ("eccentricity_ratio [1]", "eccentricity ratio", "rigid rotor, speed parameter 1", "y"),
        (mass, "mass of the journal / mass of the rotor", "light journal, eccentricity ratio 0.7", "xy"),
    )
    panels: list[PicturePanel] = []
    for place, label, title, log in parts:
        own = [rung for rung in limited if (rung[mass] == 1.0) is (place != mass)]
        marks: list[Mark] = []
        for scheme, (color, dash, marker) in SCHEME_LINES.items():
            rungs = sorted((rung for rung in own if rung.family == scheme), key=lambda rung: rung[place])
            runs = [rung for rung in rungs if rung["simulated [deg]"] is not None]
            if rungs:
                marks.append(CurveMark(*columns_of(rungs, place, limit), scheme, color, dash))
            if runs:
                found = columns_of(runs, place, "simulated [deg]")
                marks.append(CurveMark(*found, "", color, "", marker=marker, filled=False))
        beside = "beside" if panels else "none"
        panels.append(
            PicturePanel(marks, label, "longest stable macro step [deg]", title, log=log, legend=beside)
        )
    title = f"no limit: {', '.join(free)}"
    return Picture(tuple(panels), columns=2, size=(5.5, 4.8), title=title)


def plot_coupling_error(
    macro_angles: np.ndarray, errors: np.ndarray, refused: np.ndarray, *, limit: float | None = None
) -> Picture:
    """Describe the error of the coupled run against the monolithic one over the macro step.

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
    """
    degrees, good = np.degrees(macro_angles), ~np.asarray(refused)
    marks: list[Mark] = [
        CurveMark(degrees[good], errors[good], "Gauss-Seidel, force held", marker="o"),
        CurveMark(degrees[~good], errors[~good], "refused", "C3", "", marker="x"),
    ]
    if np.any(good):
        line = errors[good][0] * degrees / degrees[good][0]
        marks.append(CurveMark(degrees, line, "first order", "k", ":"))
    if limit is not None:
        marks.append(LevelMark(float(np.degrees(limit)), "explicit stability limit", "C3", upright=True))
    text = "macro step [deg of shaft rotation]", "largest orbit error / clearance"
    return Picture((PicturePanel(marks, *text, "Co-simulation error against macro step", log="xy"),))
