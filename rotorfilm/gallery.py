"""The pictures of the demonstration: its results handed to the charts."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from .charts import plot_accuracy, plot_coupling_error, plot_locus, plot_orbits, plot_stability, save
from .scenes.demo import DemoResult
from .scenes.ladder import REFERENCE_CELLS


def draw_demo(result: DemoResult, folder: Path) -> list[Path]:
    """Write the charts of a demonstration as PNG into an existing folder; return their paths."""
    shaft = {label: (c.eccentricity_ratio, c.attitude_angle) for label, c in result.curves.items()}
    whirl = {label: (c.eccentricity_ratio, c.speed_parameter) for label, c in result.curves.items()}
    point = (result.answer.equilibrium.eccentricity_ratio, result.speed_parameter)
    return [
        _draw_orbits(result, folder / "orbit.png"),
        save(plot_locus(shaft), folder / "locus.png"),
        save(plot_stability(whirl, point=point), folder / "stability.png"),
        _draw_accuracy(result, folder / "accuracy.png"),
        _draw_coupling(result, folder / "coupling.png"),
    ]


def _draw_orbits(result: DemoResult, path: Path) -> Path:
    """Draw the monolithic orbit, that of the scene's macro step, and one past the stability limit."""
    orbits = {"monolithic": result.coupling.monolithic}
    for run in [result.scene_run, *(run for run in result.coupling.runs if run.refused)]:
        verdict = " (refused)" if run.refused else ""
        orbits[f"coupled, {math.degrees(run.macro_angle):.3g} deg{verdict}"] = run.trajectory
    clearance = result.scene.journal.clearance
    return save(plot_orbits(orbits, clearance=clearance, center=result.answer.equilibrium.position), path)


def _draw_accuracy(result: DemoResult, path: Path) -> Path:
    rungs = {
        label: (law.force_time, law.median_error, law.high_error) for label, law in result.accuracy.items()
    }
    slenderness = result.scene.bearing.slenderness
    cells = "{} x {}".format(*REFERENCE_CELLS)
    reference = f"Reynolds rupture, {cells} cells, extrapolated; L/D = {slenderness:.3g}"
    return save(plot_accuracy(rungs, reference=reference), path)


def _draw_coupling(result: DemoResult, path: Path) -> Path:
    runs = result.coupling.runs
    angles = np.array([run.macro_angle for run in runs])
    errors = np.array([run.orbit_error for run in runs])
    refused = np.array([bool(run.refused) for run in runs])
    return save(plot_coupling_error(angles, errors, refused, limit=result.critical_macro_angle), path)
