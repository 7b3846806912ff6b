"""The command `rotorfilm chart rolling`: ball bearings over speed and preload, and their models, drawn."""

from __future__ import annotations

import math
from functools import partial
from typing import Annotated

from ...limits import CHART_STATES
from ...progress import Report, part_of
from ..command import Option, Said
from .chart_files import OUT, Folder, number, print_chart, write_chart

POINTS = 25
"""Speeds of a curve."""


def rolling(
    report: Report,
    speed: Annotated[str, Option(help="Highest speed of a usual hybrid bearing of a spindle.")] = "30000 rpm",
    states: Annotated[int, Option(help="Random states of each bearing.", min=1, max=CHART_STATES)] = 40,
    seed: Annotated[int, Option(help="Seed of the random states.", min=0)] = 1907,
    out: Folder = OUT,
) -> Said:
    """Ball bearings: loads, contact angles, stiffness over speed and preload, swing; error against cost."""
    import numpy as np

    from ... import charts, comparisons
    from ...units import parse_quantity

    top = parse_quantity(speed, "rad/s")
    curves = comparisons.ball_curves(
        comparisons.usual_bearing(), np.linspace(0.0, top, POINTS), report=part_of(report, 0.0, 0.5)
    )
    ladder = comparisons.ball_accuracy(states, seed=seed, report=part_of(report, 0.5, 1.0))
    files = write_chart(out, "chart_rolling", curves.columns(), charts.plot_ball_curves(curves))
    files += write_chart(out, "chart_rolling_ladder", ladder.columns(), charts.plot_ball_accuracy(ladder))
    headings = (
        "preload [N]",
        f"running at {30.0 / math.pi * top:.5g} rpm [N]",
        "radial [N/um]",
        "axial [N/um]",
    )
    rows = [
        tuple(map(number, (preload, running[-1].item(), 1e-6 * radial[-1].item(), 1e-6 * axial[-1].item())))
        for preload, running, radial, axial in zip(
            curves.preloads,
            curves.running_preload,
            curves.radial_stiffness,
            curves.axial_stiffness,
            strict=True,
        )
    ]
    told = [(rung.name, f"K off by {rung.median_error:.2g}, {rung.usual_error:.2g}") for rung in ladder.rungs]
    return Said({"curves": curves, "ladder": ladder}, partial(print_chart, headings, rows, [*told, *files]))
