"""Pictures and table of the whirl threshold by every film of a ladder, and of what is wrong with each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..core.frames import Column, ResultTable
from ..studies import StudyResult, StudyRow
from ..studies.journal_accuracy import TENSION
from ..studies.journal_stability import (
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
from .canvas import DASHES, FAMILY_COLORS, FAMILY_WIDTHS
from .picture import CurveMark, LevelMark, Mark, NoteMark, Picture, PicturePanel, closed

SMALLEST = 0.03
"""Smallest deviation drawn [%]; smaller ones lie on the axis."""

HEADINGS = ("film", "error at most", "wrong at eps", "tension, large motion", "|Cxy - Cyx| / max |C|")

REFERENCE_MARKS = 12
"""Dots on the curve of the reference, about; few, so that they do not hide the films."""


def plot_journal_stability(result: StudyResult, *, point: tuple[float, float] | None = None) -> Picture:
    """Describe thresholds and deviations over the eccentricity ratio; `verdict_table` says them in words.

    Parameters
    ----------
    result : StudyResult
        Result as `journal_stability` returns it.
    point : (float, float), optional
        Eccentricity ratio and speed parameter of a working point.
    """
    title = (
        f"Whirl threshold of a rigid rotor on journal films, L/D = {result.conditions[LENGTH]:g} "
        f"(unstable above)\nreference: {result.reference}\n"
        f"its error {100.0 * result.conditions[OWN_ERROR]:.2g} %; "
        f"wrong: error above {100.0 * TOLERANCE:g} %, checked up to {HIGHEST:g}"
    )
    (top,) = plot_thresholds(result, point=point).panels
    return Picture((top._replace(title=""), _deviations(result)), size=(9.6, 4.4), title=title)


def plot_thresholds(result: StudyResult, *, point: tuple[float, float] | None = None) -> Picture:
    """Describe the threshold speed * sqrt(clearance * mass / load) over the eccentricity ratio.

    Thresholds within the tolerance of the reference are solid or dashed lines, wrong ones dotted; crosses
    mark eccentricity ratios where a film has no threshold though the reference has one. Films that may
    coincide are drawn ever narrower, so that each can be seen.

    Parameters
    ----------
    result, point
        As in `plot_journal_stability`.
    """
    marks = [*_curves(result), *_missing(result)]
    if point is not None:
        x, y = point
        marks.append(CurveMark([x], [y], "working point", "k", "", marker="*", size=11.0))
    marks.append(LevelMark(HIGHEST, "checked up to here", "0.5", "--"))
    text = "eccentricity ratio eps [1]", "speed * sqrt(clearance * mass / load)\nat the onset of whirl [1]"
    title = f"Whirl threshold of a rigid rotor (unstable above; dotted: off by over {100.0 * TOLERANCE:g} %)"
    panel = PicturePanel(marks, *text, title, legend="beside")
    panel = panel._replace(x_limits=(0.0, 1.0), y_limits=(0.0, 1.3 * HIGHEST))
    return Picture((panel,), size=(9.6, 4.8))


def _curves(result: StudyResult) -> Iterator[Mark]:
    films = by_film(result)
    ratios, exact = (_column(next(iter(films.values())), heading) for heading in (RATIO, REFERENCE))
    known = np.isfinite(exact)
    band = closed(ratios[known], (1.0 - TOLERANCE) * exact[known], (1.0 + TOLERANCE) * exact[known])
    yield CurveMark(*band, f"reference +-{100.0 * TOLERANCE:g} %", "0.6", "", fill=0.5)
    told = set()
    for rows in sorted(films.values(), key=lambda rows: FAMILY_WIDTHS[rows[0].family], reverse=True):
        family, values = rows[0].family, _column(rows, PARAMETER)
        color, width = FAMILY_COLORS[family], FAMILY_WIDTHS[family]
        yield CurveMark(ratios, values, "", color, ":", max(1.2, 0.5 * width))
        right = np.where([row[WRONG] or row[INVENTED] for row in rows], np.nan, values)
        label, dash = "" if family in told else family, "--" if family in DASHES else "-"
        yield CurveMark(ratios, right, label, color, dash, width)
        told.add(family)
    some = slice(None, None, max(1, len(ratios) // REFERENCE_MARKS))
    yield CurveMark(ratios[some], exact[some], "reference", "k", "", marker="o", filled=False, size=4.0)


def _missing(result: StudyResult) -> Iterator[Mark]:
    level = 0.2
    for name, rows in by_film(result).items():
        where, color = [row[RATIO] for row in rows if row[MISSING]], FAMILY_COLORS[rows[0].family]
        if where:
            yield CurveMark(where, np.full(len(where), level), "", color, "", marker="x")
            yield NoteMark(where[0], level, f"{name}: no threshold exists", color)
            level += 0.45


def _deviations(result: StudyResult) -> PicturePanel:
    marks: list[Mark] = [LevelMark(SMALLEST, "not wrong", "0.6", to=100.0 * TOLERANCE)]
    for rows in by_film(result).values():
        judged = [is_judged(row[REFERENCE]) for row in rows]
        gap = np.where(judged, 100.0 * np.abs(_column(rows, DEVIATION)), np.nan)
        color = FAMILY_COLORS[rows[0].family]
        marks.append(CurveMark(_column(rows, RATIO), np.maximum(gap, SMALLEST), "", color, width=1.0))
    marks.append(LevelMark(100.0 * result.conditions[OWN_ERROR], "error of the reference", dash="--"))
    text = "eccentricity ratio eps [1]", "|deviation from the reference| [%]"
    panel = PicturePanel(marks, *text, log="y", legend="beside")
    return panel._replace(x_limits=(0.0, 1.0), y_limits=(SMALLEST, 100.0))


def verdict_table(result: StudyResult) -> ResultTable:
    """Return the verdicts of `verdicts`, a row for each film of a study of stability."""
    rows = [(name, *verdicts(own)) for name, own in by_film(result).items()]
    columns = (Column(name, "", [row[k] for row in rows], name) for k, name in enumerate(HEADINGS))
    return ResultTable(tuple(columns), "What is wrong with the film")


def verdicts(rows: Sequence[StudyRow]) -> tuple[str, str, str, str]:
    """Return what is said of a film: deviation, where it is wrong, tension, symmetry of damping."""
    gaps = [abs(row[DEVIATION]) for row in rows if is_judged(row[REFERENCE]) and row[DEVIATION] is not None]
    wrong = [row[RATIO] for row in rows if row[WRONG] or row[MISSING] or row[INVENTED]]
    asymmetry, share = max(row[UNSYMMETRIC] for row in rows), rows[0][MOVING]
    without = "rank-1 damping" if all(row[RANK_ONE] for row in rows) else "no threshold"
    where = " to ".join(f"{ratio:.2g}" for ratio in wrong[:: max(1, len(wrong) - 1)])
    in_tension = share > 0.0 or max(row[AT_REST] for row in rows) > TENSION
    return (
        f"{100.0 * max(gaps):.2g} %" if gaps else without,
        where or "nowhere",
        f"{100.0 * share:.0f} % of states" if in_tension else "none",
        "0" if asymmetry < 1e-9 else f"{100.0 * asymmetry:.2g} %",
    )


def _column(rows: Sequence[StudyRow], heading: str) -> np.ndarray:
    return np.array([np.nan if row[heading] is None else row[heading] for row in rows])
