"""The pictures of the demonstration: its results handed to the charts."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from .. import charts
from ..core.port import clearance_of
from ..core.results import Trajectory
from ..scenes.demo import ECCENTRICITY_RATIOS, DemoResult, demo_rungs
from ..studies import FilmFamily

OVERVIEW_SIZE, OVERVIEW_DPI = (14.0, 11.2), 100
"""Size [inch] and resolution of the picture with everything."""


def draw_demo(result: DemoResult, folder: Path) -> list[Path]:
    """Write the charts of a demonstration as PNG into an existing folder; return their paths."""
    return [
        charts.save(_draw_overview(result), folder / "demo.png", dpi=OVERVIEW_DPI),
        charts.save(_draw_orbits(result), folder / "orbit.png"),
        charts.save(_draw_locus(result), folder / "locus.png"),
        charts.save(
            charts.plot_journal_stability(result.stability, point=_working_point(result))[0],
            folder / "stability.png",
        ),
        charts.save(charts.plot_study(result.accuracy)[0], folder / "accuracy.png"),
        charts.save(_draw_coupling(result), folder / "coupling.png"),
    ]


def _draw_overview(result: DemoResult) -> Axes:
    """Draw orbits and their error beside the whirl threshold and the force error of every film."""
    figure = charts.new_figure(size=OVERVIEW_SIZE)
    (orbits, coupling), (stability, accuracy) = figure.subplots(2, 2, height_ratios=(1.0, 1.25))
    compared = result.accuracy
    slenderness = compared.conditions["length/diameter [1]"]
    reference = f"films at L/D = {slenderness:g}, reference: {compared.reference}"
    figure.suptitle(f"{result.scene.title}\n{reference}")
    _draw_orbits(result, orbits)
    orbits.set_title("Orbit of the journal center")
    _draw_coupling(result, coupling)
    coupling.set_title("Co-simulation error against macro step")
    charts.plot_thresholds(result.stability, point=_working_point(result), axes=stability)
    stability.set(title="Whirl threshold of a rigid rotor (unstable above)", xlabel="eccentricity ratio [1]")
    accuracy.set_title("Error of the force against its cost")
    charts.plot_study(result.accuracy, axes=accuracy)
    return orbits


def _working_point(result: DemoResult) -> tuple[float, float]:
    """Return eccentricity ratio and speed parameter."""
    return result.answer.equilibrium.eccentricity_ratio, result.speed_parameter


def _draw_orbits(result: DemoResult, axes: Axes | None = None) -> Axes:
    """Draw the monolithic orbit, that of the scene's macro step, and one past the stability limit."""
    orbits: dict[str, Trajectory] = {"monolithic": result.coupling.monolithic}
    for run in [result.scene_run, *(run for run in result.coupling.runs if run.refused)]:
        verdict = " (refused)" if run.refused else ""
        orbits[f"coupled, {math.degrees(run.macro_angle):.3g} deg{verdict}"] = run.trajectory
    center = result.answer.equilibrium.position
    return charts.plot_orbits(orbits, clearance=clearance_of(result.scene.bearing), center=center).draw(axes)[
        0
    ]


def _draw_locus(result: DemoResult) -> Axes:
    ratios = np.array(ECCENTRICITY_RATIOS)
    families = {rung.name: FilmFamily(rung.family) for rung in demo_rungs()}
    curves = {name: (ratios, angles) for name, angles in result.attitude_angle.items()}
    return charts.plot_locus(curves, families=families).draw()[0]


def _draw_coupling(result: DemoResult, axes: Axes | None = None) -> Axes:
    runs = result.coupling.runs
    angles = np.array([run.macro_angle for run in runs])
    errors = np.array([run.orbit_error for run in runs])
    refused = np.array([bool(run.refused) for run in runs])
    return charts.plot_coupling_error(angles, errors, refused, limit=result.critical_macro_angle, axes=axes)
