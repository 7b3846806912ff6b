"""Chart of the whirl threshold by every film of a ladder, and of what is wrong with each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from ..studies import StudyResult, StudyRow
from ..studies.journal_accuracy import TENSION
from ..studies.journal_stability import (
    ASYMMETRY,
    AT_REST,
    DEVIATION,
    HIGHEST,
    INVENTED,
    LENGTH,
    MISSING,
    MOVING,
    OWN_ERROR,
    PARAMETER,
    RANK_ONE,
    RATIO,
    REFERENCE,
    TOLERANCE,
    UNSYMMETRIC,
    WRONG,
    by_film,
    is_judged,
)
from .canvas import BAD, DASHES, DOUBTFUL, FAMILY_COLORS, FAMILY_WIDTHS, GOOD, new_axes, new_figure

SMALLEST = 0.03
"""Smallest deviation drawn [%]; smaller ones lie on the axis."""

COLUMNS = (0.0, 0.33, 0.515, 0.69, 0.865, 1.0)
"""Edges of the columns of the table, in its width."""

HEADINGS = ("film", "error at most", "wrong at eps", "tension in\nlarge motion", "|Cxy - Cyx|\n/ max |C|")


Cell = tuple[str, str]
"""Text of a cell and its background."""

REFERENCE_MARKS = 12
"""Dots on the curve of the reference, about; few, so that they do not hide the films."""


def plot_journal_stability(result: StudyResult, *, point: tuple[float, float] | None = None) -> list[Axes]:
    """Draw thresholds and deviations over the eccentricity ratio, and a table of verdicts.

    Parameters
    ----------
    result : StudyResult
        Result as `journal_stability` returns it.
    point : (float, float), optional
        Eccentricity ratio and speed parameter of a working point.
    """
    figure = new_figure(size=(14.0, 8.0))
    grid = figure.add_gridspec(2, 2, width_ratios=(1.0, 1.06), height_ratios=(1.35, 1.0))
    top, table = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[:, 1])
    bottom = figure.add_subplot(grid[1, 0], sharex=top)
    plot_thresholds(result, point=point, axes=top)
    _draw_deviations(bottom, result)
    _draw_table(table, result)
    figure.suptitle(_title(result), fontsize=11)
    return [top, bottom, table]


def plot_thresholds(
    result: StudyResult, *, point: tuple[float, float] | None = None, axes: Axes | None = None
) -> Axes:
    """Draw the threshold speed * sqrt(clearance * mass / load) over the eccentricity ratio.

    Thresholds within the tolerance of the reference are solid or dashed lines, wrong ones dotted; crosses
    mark eccentricity ratios where a film has no threshold though the reference has one. Films that may
    coincide are drawn ever narrower, so that each can be seen.

    Parameters
    ----------
    result : StudyResult
        Result as `journal_stability` returns it.
    point : (float, float), optional
        Eccentricity ratio and speed parameter of a working point.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Whirl threshold of a rigid rotor (unstable above)")
    _draw_curves(axes, result)
    _draw_missing(axes, result)
    if point is not None:
        axes.plot(*point, "k*", markersize=11, label="working point")
    axes.axhline(HIGHEST, color="0.5", linewidth=0.8, linestyle="--")
    axes.text(0.99, HIGHEST, "checked up to here", fontsize=8, color="0.35", va="bottom", ha="right")
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.3 * HIGHEST))
    axes.set_ylabel("speed * sqrt(clearance * mass / load)\nat the onset of whirl [1]")
    axes.grid(visible=True, alpha=0.3)
    handles = _legend(result) + [line for line in axes.get_lines() if line.get_marker() == "*"]
    axes.legend(handles=handles, fontsize=8, ncols=2, loc="upper left", framealpha=1.0)
    return axes


def _draw_curves(axes: Axes, result: StudyResult) -> None:
    films = by_film(result)
    ratios, exact = (_column(next(iter(films.values())), heading) for heading in (RATIO, REFERENCE))
    low, high = (1.0 - TOLERANCE) * exact, (1.0 + TOLERANCE) * exact
    axes.fill_between(ratios, low, high, color="0.8", linewidth=0.0, zorder=0)
    for rows in sorted(films.values(), key=lambda rows: FAMILY_WIDTHS[rows[0].family], reverse=True):
        family, values = rows[0].family, _column(rows, PARAMETER)
        color, width, style = FAMILY_COLORS[family], FAMILY_WIDTHS[family], DASHES.get(family, "-")
        axes.plot(ratios, values, ":", color=color, linewidth=max(1.2, 0.5 * width))
        right = np.where([row[WRONG] or row[INVENTED] for row in rows], np.nan, values)
        axes.plot(ratios, right, linestyle=style, color=color, linewidth=width, solid_capstyle="butt")
    marked = slice(None, None, max(1, len(ratios) // REFERENCE_MARKS))
    axes.plot(ratios[marked], exact[marked], "ko", markerfacecolor="w", markersize=4.0, markeredgewidth=0.8)


def _draw_missing(axes: Axes, result: StudyResult) -> None:
    level = 0.2
    for name, rows in by_film(result).items():
        color = FAMILY_COLORS[rows[0].family]
        where = [row[RATIO] for row in rows if row[MISSING]]
        if where:
            axes.plot(where, np.full(len(where), level), "x", color=color)
            end: dict[str, Any] = {"ha": "right", "va": "bottom", "fontsize": 8, "color": color}
            axes.text(where[-1], level + 0.13, f"{name}: no threshold exists", **end)
            level += 0.45


def _draw_deviations(axes: Axes, result: StudyResult) -> None:
    axes.axhspan(SMALLEST, 100.0 * TOLERANCE, color="0.9", zorder=0)
    for rows in by_film(result).values():
        judged = [is_judged(row[REFERENCE]) for row in rows]
        gap = np.where(judged, 100.0 * np.abs(_column(rows, DEVIATION)), np.nan)
        color = FAMILY_COLORS[rows[0].family]
        axes.plot(_column(rows, RATIO), np.maximum(gap, SMALLEST), color=color, linewidth=1.0)
    level = 100.0 * result.conditions[OWN_ERROR]
    axes.axhline(level, color="k", linewidth=0.8, linestyle="--")
    axes.text(0.99, level, "error of the reference", fontsize=8, ha="right", va="bottom")
    axes.set(yscale="log", xlim=(0.0, 1.0), ylim=(SMALLEST, 100.0))
    axes.set(xlabel="eccentricity ratio eps [1]", ylabel="|deviation from the reference| [%]")
    axes.grid(visible=True, alpha=0.3)


def _draw_table(axes: Axes, result: StudyResult) -> None:
    """Write one row of verdicts for each rung; the heading takes two rows."""
    films = by_film(result)
    axes.set(xlim=(0.0, 1.0), ylim=(len(films) + 0.2, -2.0))
    axes.axis("off")
    for text, left in zip(HEADINGS, COLUMNS[:-1], strict=True):
        axes.text(left + 0.01, -0.25, text, va="bottom", fontsize=9, weight="bold")
    for row, (name, points) in enumerate(films.items()):
        axes.text(0.01, row + 0.5, name, va="center", fontsize=8.5, color=FAMILY_COLORS[points[0].family])
        for (text, color), left, right in zip(verdicts(points), COLUMNS[1:-1], COLUMNS[2:], strict=True):
            corner, size = (left + 0.003, row + 0.05), (right - left - 0.006, 0.9)
            axes.add_patch(Rectangle(corner, *size, color=color, linewidth=0.0))
            axes.text(left + 0.012, row + 0.5, text, va="center", fontsize=8.5)


def verdicts(rows: Sequence[StudyRow]) -> tuple[Cell, Cell, Cell, Cell]:
    """Return what the table says of a film: deviation, where it is wrong, tension, symmetry of damping."""
    gaps = [abs(row[DEVIATION]) for row in rows if is_judged(row[REFERENCE]) and row[DEVIATION] is not None]
    wrong = [row[RATIO] for row in rows if row[WRONG] or row[MISSING] or row[INVENTED]]
    asymmetry, share = max(row[UNSYMMETRIC] for row in rows), rows[0][MOVING]
    if gaps:
        deviation = f"{100.0 * max(gaps):.2g} %", BAD if max(gaps) > TOLERANCE else GOOD
    else:
        deviation = "rank-1 damping" if all(row[RANK_ONE] for row in rows) else "no threshold", BAD
    where = " to ".join(f"{ratio:.2g}" for ratio in wrong[:: max(1, len(wrong) - 1)])
    in_tension = share > 0.0 or max(row[AT_REST] for row in rows) > TENSION
    return (
        deviation,
        (where, BAD) if wrong else ("nowhere", GOOD),
        (f"{100.0 * share:.0f} % of states", BAD) if in_tension else ("none", GOOD),
        (
            "0" if asymmetry < 1e-9 else f"{100.0 * asymmetry:.2g} %",
            DOUBTFUL if asymmetry > ASYMMETRY else GOOD,
        ),
    )


def _column(rows: Sequence[StudyRow], heading: str) -> np.ndarray:
    return np.array([np.nan if row[heading] is None else row[heading] for row in rows])


def _title(result: StudyResult) -> str:
    return (
        f"Whirl threshold of a rigid rotor on journal films, L/D = {result.conditions[LENGTH]:g} "
        f"(unstable above)\nreference: {result.reference}; "
        f"its error {100.0 * result.conditions[OWN_ERROR]:.2g} %; "
        f"wrong: error above {100.0 * TOLERANCE:g} %, checked up to {HIGHEST:g}"
    )


def _legend(result: StudyResult) -> list[Line2D]:
    families = list(dict.fromkeys(rung.family for rung in result.rungs))
    return [
        *(
            Line2D(
                [],
                [],
                color=FAMILY_COLORS[family],
                label=family,
                linewidth=FAMILY_WIDTHS[family],
                linestyle=DASHES.get(family, "-"),
            )
            for family in families
        ),
        Line2D([], [], marker="o", color="k", markerfacecolor="w", linestyle="", label="reference"),
        Line2D([], [], color="0.8", linewidth=7, label=f"reference +-{100.0 * TOLERANCE:g} %"),
        Line2D([], [], color="0.3", linestyle=":", label="wrong"),
    ]
