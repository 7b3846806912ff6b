"""The pictures of the demonstration: its results handed to the charts."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from .. import charts
from ..core.port import clearance_of
from ..core.results import Trajectory
from ..scenes.demo import ECCENTRICITY_RATIOS, DemoResult, demo_rungs
from ..studies import FilmFamily


def draw_demo(result: DemoResult, folder: Path) -> list[Path]:
    """Write the charts of a demonstration as PNG into an existing folder; return their paths."""
    orbits, coupling, accuracy = _orbits(result), _coupling(result), charts.plot_study(result.accuracy)
    point = result.answer.equilibrium.eccentricity_ratio, result.speed_parameter
    thresholds = charts.plot_thresholds(result.stability, point=point)
    panels = [one.panels[0] for one in (orbits, coupling, thresholds, accuracy)]
    panels[0] = panels[0]._replace(title="Orbit of the journal center")
    panels[3] = panels[3]._replace(
        title="Error of the force against its cost",
        x="time of one force in a batch [s]",
        y="relative error of the force\n99 % of states filled, median open",
        legend="beside",
    )
    compared = result.accuracy
    reference = (
        f"films at L/D = {compared.conditions['length/diameter [1]']:g}, reference: {compared.reference}"
    )
    title = f"{result.scene.title}\n{reference}"
    pictures = {
        "demo": charts.Picture(tuple(panels), columns=2, size=(8.0, 5.4), title=title),
        "orbit": orbits,
        "locus": _locus(result),
        "stability": charts.plot_journal_stability(result.stability, point=point),
        "accuracy": accuracy,
        "coupling": coupling,
    }
    return [one.save(folder / f"{name}.png", dpi=100) for name, one in pictures.items()]


def _orbits(result: DemoResult) -> charts.Picture:
    """Describe the monolithic orbit, that of the scene's macro step, and one past the stability limit."""
    orbits: dict[str, Trajectory] = {"monolithic": result.coupling.monolithic}
    for run in [result.scene_run, *(run for run in result.coupling.runs if run.refused)]:
        verdict = " (refused)" if run.refused else ""
        orbits[f"coupled, {math.degrees(run.macro_angle):.3g} deg{verdict}"] = run.trajectory
    center = result.answer.equilibrium.position
    return charts.plot_orbits(orbits, clearance=clearance_of(result.scene.bearing), center=center)


def _locus(result: DemoResult) -> charts.Picture:
    ratios = np.array(ECCENTRICITY_RATIOS)
    families = {rung.name: FilmFamily(rung.family) for rung in demo_rungs()}
    curves = {name: (ratios, angles) for name, angles in result.attitude_angle.items()}
    return charts.plot_locus(curves, families=families)


def _coupling(result: DemoResult) -> charts.Picture:
    runs = result.coupling.runs
    angles = np.array([run.macro_angle for run in runs])
    errors = np.array([run.orbit_error for run in runs])
    refused = np.array([bool(run.refused) for run in runs])
    return charts.plot_coupling_error(angles, errors, refused, limit=result.critical_macro_angle)
