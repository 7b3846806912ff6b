"""The demonstration: from a bearing on paper to a coupled simulation, with every number kept."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..cosim import critical_macro_step
from ..errors import InputError
from ..films import FilmLaw
from ..linear import speed_parameter
from ..progress import Report, silent
from ..results import Trajectory, to_plain, write_csv
from .coupling import CoupledRun, CouplingStudy, study_coupling
from .export import ExportedScene, export_scene, resting_rotor
from .ladder import FilmAccuracy, FilmCurve, compared_laws, film_accuracy, film_curve, ladder_laws
from .scene import Scene
from .solve import Answer

REFINEMENTS = (0.25, 0.5, 1.0, 2.0)
"""Macro steps of the study, in those of the scene."""

BEYOND = 1.3
"""A run this far past the stability limit must be refused."""

ECCENTRICITY_RATIOS = tuple(np.linspace(0.02, 0.98, 49).tolist())
"""Where the film laws are compared."""


@dataclass(frozen=True, kw_only=True)
class DemoResult:
    """All that the demonstration found.

    Attributes
    ----------
    scene : Scene
    answer : Answer
        Equilibrium, coefficients, whirl threshold.
    speed_parameter : float [1]
        speed * sqrt(clearance * mass / load) of the scene.
    fmus : ExportedScene
    critical_macro_angle : float or None [rad]
        Longest macro step of a stable coupling by linear theory; None where there is no limit.
    coupling : CouplingStudy
        Coupled runs beside the monolithic one.
    curves : dict of str to FilmCurve
        Locus and stability by film law.
    accuracy : dict of str to FilmAccuracy
        Error and cost by film law.
    """

    scene: Scene
    answer: Answer
    speed_parameter: float
    fmus: ExportedScene
    critical_macro_angle: float | None
    coupling: CouplingStudy
    curves: dict[str, FilmCurve]
    accuracy: dict[str, FilmAccuracy]

    @property
    def scene_run(self) -> CoupledRun:
        """The coupled run at the macro step of the scene."""
        wanted = self.scene.cosimulation.macro_angle
        return min(self.coupling.runs, key=lambda run: abs(run.macro_angle - wanted))


def run_demo(folder: Path, scene: Scene, report: Report = silent) -> DemoResult:
    """Solve a scene, export its FMUs, couple them, and compare with the monolithic solution.

    Writes `film.fmu`, `rotor.fmu`, `results.json`, `monolithic.csv` and `coupled.csv`.

    Parameters
    ----------
    folder : Path
        Made if absent.
    scene : Scene
        With a rotor.
    report : callable, optional
        Told how far the job is.

    Raises
    ------
    InputError
        If the scene has no rotor.
    RotorfilmError
        What the steps raise; see `Scene.solve`, `export_scene` and `study_coupling`.
    """
    if scene.rigid_rotor is None:
        raise InputError("rigid_rotor is required for the demonstration, got no such table")
    folder.mkdir(parents=True, exist_ok=True)
    report(0.0, "equilibrium, stiffness and damping, whirl threshold")
    answer = scene.solve()
    report(0.05, "film laws: locus and stability")
    curves = _curves(scene)
    report(0.15, "film laws: accuracy and cost")
    accuracy = film_accuracy(
        scene.bearing, ladder_laws(), lambda label: report(0.15, f"film laws: accuracy and cost of {label}")
    )
    report(0.25, "FMUs")
    fmus = export_scene(scene, folder)
    limit = _critical_macro_angle(scene)
    coupling = study_coupling(
        scene, fmus, _macro_angles(scene, limit), lambda part, text: report(0.3 + 0.65 * part, text)
    )
    result = DemoResult(
        scene=scene,
        answer=answer,
        speed_parameter=speed_parameter(
            speed=scene.operation.speed,
            clearance=scene.journal.clearance,
            mass=scene.rotor.mass,
            load=scene.static_load,
        ),
        fmus=fmus,
        critical_macro_angle=limit,
        coupling=coupling,
        curves=curves,
        accuracy=accuracy,
    )
    write_results(result, folder)
    report(0.95, "results written")
    return result


def write_results(result: DemoResult, folder: Path) -> None:
    """Write `results.json`, and the trajectories as CSV in SI units."""
    text = json.dumps(plain_results(result), indent=2, allow_nan=False)
    (folder / "results.json").write_text(text + "\n", encoding="utf-8")
    _write_csv(folder / "monolithic.csv", result.coupling.monolithic)
    _write_csv(folder / "coupled.csv", result.scene_run.trajectory)


def plain_results(result: DemoResult) -> dict[str, Any]:
    """Return the results as plain data, without the trajectories; files by their names."""
    runs = [_without_trajectory(run) for run in result.coupling.runs]
    kept = {f.name: getattr(result, f.name) for f in fields(result) if f.name not in ("fmus", "coupling")}
    kept["fmus"] = {name: path.name for name, path in result.fmus._asdict().items()}
    kept["coupling"] = {"observed_order": result.coupling.observed_order, "runs": runs}
    plain: dict[str, Any] = to_plain(kept)
    return plain


def _without_trajectory(run: CoupledRun) -> dict[str, Any]:
    return {f.name: getattr(run, f.name) for f in fields(run) if f.name != "trajectory"}


def _write_csv(path: Path, trajectory: Trajectory) -> None:
    write_csv(path, {"time": trajectory.time, **trajectory.signals})


def _curves(scene: Scene) -> dict[str, FilmCurve]:
    laws: dict[str, FilmLaw] = compared_laws()
    if scene.bearing.film not in laws.values():
        laws = {"film of the scene": scene.bearing.film, **laws}
    ratios = np.array(ECCENTRICITY_RATIOS)
    return {label: film_curve(replace(scene.bearing, film=law), ratios) for label, law in laws.items()}


def _critical_macro_angle(scene: Scene) -> float | None:
    rotor = resting_rotor(scene)
    limit = critical_macro_step(rotor, scene.bearing, state=rotor.initial_state).macro_step
    return None if limit is None else limit * abs(scene.operation.speed)


def _macro_angles(scene: Scene, limit: float | None) -> list[float]:
    angles = [part * scene.cosimulation.macro_angle for part in REFINEMENTS]
    return angles if limit is None else [*angles, BEYOND * limit]
