"""The commands `rotorfilm chart bearings` and `rotorfilm chart pads`: bearings made of pads, drawn."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Annotated

from ...limits import CHART_STATES
from ...progress import Report, part_of
from ..command import Option, Said
from .chart_files import OUT, Folder, Slenderness, costs, print_chart, write_chart

if TYPE_CHECKING:
    from ...comparisons import BearingThresholds, TypeThresholds


def bearings(
    report: Report,
    ld: Slenderness = 0.5,
    mass: Annotated[str, Option(help="Mass of the rigid rotor that a bearing carries.")] = "250 kg",
    out: Folder = OUT,
) -> Said:
    """Types of bearings side by side: K and C over the Sommerfeld number, whirl threshold over the load."""
    from ... import charts, comparisons
    from ...units import parse_quantity

    film = comparisons.bearing_coefficients(ld, report=part_of(report, 0.0, 0.3))
    carried = parse_quantity(mass, "kg")
    whirl = comparisons.bearing_thresholds(ld, mass=carried, report=part_of(report, 0.3, 1.0))
    files = write_chart(out, "chart_bearings", film.columns(), charts.plot_bearing_coefficients(film))
    files += write_chart(out, "chart_whirl", whirl.columns(), [charts.plot_bearing_thresholds(whirl)])
    shown = [0, len(whirl.load) // 2, len(whirl.load) - 1]
    headings = ("threshold [rpm] on", *(f"at {whirl.load[k]:.4g} N" for k in shown))
    rows = [(one.name, *(_speed(one, k) for k in shown)) for one in whirl.types]
    show = partial(print_chart, headings, rows, [("convention", film.convention), *_said(whirl), *files])
    return Said({"coefficients": film, "thresholds": whirl}, show)


def pads(
    report: Report,
    ld: Slenderness = 0.5,
    states: Annotated[int, Option(help="Random states of each bearing.", min=1, max=CHART_STATES)] = 100,
    seed: Annotated[int, Option(help="Seed of the random states.", min=0)] = 1978,
    out: Folder = OUT,
) -> Said:
    """Error of the force against its cost, for maps and grids of pads: chart_pads.png and .csv."""
    from ... import charts, comparisons

    result = comparisons.pad_accuracy(ld, states=states, seed=seed, report=report)
    files = write_chart(out, "chart_pads", result.columns(), charts.plot_pad_accuracy(result))
    headings = ("film", "median error", "90 % error", "99 % error", "batch", "alone")
    rows = [
        (
            rung.name,
            *(f"{error:.2e}" for error in (rung.median_error, rung.usual_error, rung.high_error)),
            *costs(rung.cost),
        )
        for rung in result.rungs
    ]
    return Said(result, partial(print_chart, headings, rows, [("reference", result.reference), *files]))


def _said(whirl: BearingThresholds) -> list[tuple[str, str]]:
    """Return what the words mean that stand for a threshold."""
    met = dict.fromkeys(outcome for one in whirl.types for outcome in one.outcomes)
    return [(outcome, outcome.meaning) for outcome in met if outcome is not outcome.ONSET]


def _speed(one: TypeThresholds, k: int) -> str:
    speed = one.threshold_speed[k]
    return one.outcomes[k] if speed is None else f"{30.0 / math.pi * speed:.4g}"
