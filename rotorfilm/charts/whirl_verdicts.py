"""Chart of the whirl threshold by every film of a ladder, and of what is wrong with each."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from ..studies import JournalStability, RungStability
from .canvas import BAD, DASHES, DOUBTFUL, FAMILY_COLORS, FAMILY_WIDTHS, GOOD, new_axes, new_figure

SMALLEST = 0.03
"""Smallest deviation drawn [%]; smaller ones lie on the axis."""

COLUMNS = (0.0, 0.33, 0.515, 0.69, 0.865, 1.0)
"""Edges of the columns of the table, in its width."""

HEADINGS = ("film", "off by at most", "wrong at eps", "tension in\nlarge motion", "|Cxy - Cyx|\n/ max |C|")


Cell = tuple[str, str]
"""Text of a cell and its background."""

REFERENCE_MARKS = 12
"""Dots on the curve of the reference, about; few, so that they do not hide the films."""


def plot_journal_stability(
    result: JournalStability, *, point: tuple[float, float] | None = None
) -> list[Axes]:
    """Draw thresholds and deviations over the eccentricity ratio, and a table of verdicts.

    Parameters
    ----------
    result : JournalStability
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
    result: JournalStability, *, point: tuple[float, float] | None = None, axes: Axes | None = None
) -> Axes:
    """Draw the threshold speed * sqrt(clearance * mass / load) over the eccentricity ratio.

    Thresholds within the tolerance of the reference are solid or dashed lines, wrong ones dotted; crosses
    mark eccentricity ratios where a film has no threshold though the reference has one. Films that may
    coincide are drawn ever narrower, so that each can be seen.

    Parameters
    ----------
    result : JournalStability
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
    axes.axhline(result.highest, color="0.5", linewidth=0.8, linestyle="--")
    axes.text(0.99, result.highest, "judged up to here", fontsize=8, color="0.35", va="bottom", ha="right")
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.3 * result.highest))
    axes.set_ylabel("speed * sqrt(clearance * mass / load)\nat the onset of whirl [1]")
    axes.grid(visible=True, alpha=0.3)
    handles = _legend(result) + [line for line in axes.get_lines() if line.get_marker() == "*"]
    axes.legend(handles=handles, fontsize=8, ncols=2, loc="upper left", framealpha=1.0)
    return axes


def _draw_curves(axes: Axes, result: JournalStability) -> None:
    ratios, exact = np.array(result.eccentricity_ratio), _numbers(result.speed_parameter)
    low, high = (1.0 - result.tolerance) * exact, (1.0 + result.tolerance) * exact
    axes.fill_between(ratios, low, high, color="0.8", linewidth=0.0, zorder=0)
    for rung in sorted(result.rungs, key=lambda rung: FAMILY_WIDTHS[rung.family], reverse=True):
        values, color, width = _numbers(rung.speed_parameter), color_of(rung), FAMILY_WIDTHS[rung.family]
        good = ~(np.array(result.wrong(rung)) | np.array(result.invented(rung)))
        axes.plot(ratios, values, ":", color=color, linewidth=max(1.2, 0.5 * width))
        right = np.where(good, values, np.nan)
        style = DASHES.get(rung.family, "-")
        axes.plot(ratios, right, linestyle=style, color=color, linewidth=width, solid_capstyle="butt")
    marked = slice(None, None, max(1, len(ratios) // REFERENCE_MARKS))
    axes.plot(ratios[marked], exact[marked], "ko", markerfacecolor="w", markersize=4.0, markeredgewidth=0.8)


def _draw_missing(axes: Axes, result: JournalStability) -> None:
    ratios = np.array(result.eccentricity_ratio)
    without = [rung for rung in result.rungs if any(result.missing(rung))]
    for row, rung in enumerate(without):
        where, level = np.array(result.missing(rung)), 0.2 + 0.45 * row
        axes.plot(ratios[where], np.full(where.sum(), level), "x", color=color_of(rung))
        text = f"{rung.name}: no threshold exists"
        end = ratios[where][-1]
        axes.text(end, level + 0.13, text, ha="right", va="bottom", fontsize=8, color=color_of(rung))


def _draw_deviations(axes: Axes, result: JournalStability) -> None:
    ratios, judged = np.array(result.eccentricity_ratio), np.array(result.judged)
    axes.axhspan(SMALLEST, 100.0 * result.tolerance, color="0.9", zorder=0)
    for rung in result.rungs:
        gap = np.where(judged, 100.0 * np.abs(_numbers(rung.deviation)), np.nan)
        axes.plot(ratios, np.maximum(gap, SMALLEST), color=color_of(rung), linewidth=1.0)
    axes.axhline(100.0 * result.reference_error, color="k", linewidth=0.8, linestyle="--")
    level = 100.0 * result.reference_error
    axes.text(0.99, level, "error of the reference", fontsize=8, ha="right", va="bottom")
    axes.set(yscale="log", xlim=(0.0, 1.0), ylim=(SMALLEST, 100.0))
    axes.set(xlabel="eccentricity ratio eps [1]", ylabel="|deviation from the reference| [%]")
    axes.grid(visible=True, alpha=0.3)


def _draw_table(axes: Axes, result: JournalStability) -> None:
    """Write one row of verdicts for each rung; the heading takes two rows."""
    rows = len(result.rungs)
    axes.set(xlim=(0.0, 1.0), ylim=(rows + 0.2, -2.0))
    axes.axis("off")
    for text, left in zip(HEADINGS, COLUMNS[:-1], strict=True):
        axes.text(left + 0.01, -0.25, text, va="bottom", fontsize=9, weight="bold")
    for row, rung in enumerate(result.rungs):
        axes.text(0.01, row + 0.5, rung.name, va="center", fontsize=8.5, color=color_of(rung))
        for (text, color), left, right in zip(
            verdicts(result, rung), COLUMNS[1:-1], COLUMNS[2:], strict=True
        ):
            corner, size = (left + 0.003, row + 0.05), (right - left - 0.006, 0.9)
            axes.add_patch(Rectangle(corner, *size, color=color, linewidth=0.0))
            axes.text(left + 0.012, row + 0.5, text, va="center", fontsize=8.5)


def verdicts(result: JournalStability, rung: RungStability) -> tuple[Cell, Cell, Cell, Cell]:
    """Return what the table says of a rung: deviation, where it is wrong, tension, symmetry of damping."""
    largest, asymmetry = result.largest_deviation(rung), max(rung.asymmetry)
    masks = zip(result.wrong(rung), result.missing(rung), result.invented(rung), strict=True)
    wrong = [ratio for ratio, bad in zip(result.eccentricity_ratio, map(any, masks), strict=True) if bad]
    if largest is None:
        deviation = "rank-1 damping" if all(rung.rank_one) else "no threshold", BAD
    else:
        deviation = f"{100.0 * largest:.2g} %", BAD if largest > result.tolerance else GOOD
    where = " to ".join(f"{ratio:.2g}" for ratio in wrong[:: max(1, len(wrong) - 1)])
    return (
        deviation,
        (where, BAD) if wrong else ("nowhere", GOOD),
        (f"{100.0 * rung.tension_share:.0f} % of states", BAD) if rung.in_tension else ("none", GOOD),
        (
            "0" if asymmetry < 1e-9 else f"{100.0 * asymmetry:.2g} %",
            DOUBTFUL if asymmetry > result.asymmetry_tolerance else GOOD,
        ),
    )


def color_of(rung: RungStability) -> str:
    """Return the color of the rung's family."""
    return FAMILY_COLORS[rung.family]


def _numbers(values: tuple[float | None, ...]) -> np.ndarray:
    return np.array([np.nan if value is None else value for value in values])


def _title(result: JournalStability) -> str:
    return (
        f"Whirl threshold of a rigid rotor on journal films, L/D = {result.slenderness:g} (unstable above)\n"
        f"reference: {result.reference}; its error {100.0 * result.reference_error:.2g} %; "
        f"wrong: more than {100.0 * result.tolerance:g} % off, judged up to {result.highest:g}"
    )


def _legend(result: JournalStability) -> list[Line2D]:
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
        Line2D([], [], color="0.8", linewidth=7, label=f"reference +-{100.0 * result.tolerance:g} %"),
        Line2D([], [], color="0.3", linestyle=":", label="wrong"),
    ]
