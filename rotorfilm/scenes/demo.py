"""The demonstration: from a bearing on paper to a coupled simulation, with every number kept."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from .. import studies
from ..analysis import equilibrium, speed_parameter
from ..bearings.journal import JournalBearing, fitted_bearing
from ..bearings.oil import GRADES, Cooling, Oil
from ..core.errors import PartialResultError
from ..core.files import write_atomically
from ..core.frames import write_csv
from ..core.model import Array
from ..core.port import clearance_of
from ..core.progress import Report, part_of, silent
from ..core.readable import Readable
from ..core.results import Trajectory, orbit_distance, to_plain
from ..core.units import CELSIUS
from ..cosim import CoSimulation, cosimulate, coupling_stability
from ..cosim.watch import quietly
from ..studies.journal_accuracy import SPEED
from .cosimulate_scene import critical_macro_angle, monolithic_solution
from .export_scene import at_rest_on_film, export_scene
from .film_answer import Answer
from .scene import Scene

# A bearing as it runs: its oil warms until its heat balances, whatever viscosity a textbook gives it.


COLDEST, HOTTEST = CELSIUS, 120.0 + CELSIUS
"""Where fresh oil may be [K]."""


@dataclass(frozen=True, kw_only=True)
class RunningBearing:
    """Where a journal runs once its oil is warm.

    Attributes
    ----------
    oil : str
        What was taken for the oil.
    supply_temperature : float [K]
        Supply temperature of the fresh oil, which is as viscous as the bearing was said to be.
    temperature : float [K]
        Temperature of the film, at which its heat balances.
    eccentricity_ratio : float [1]
    power_loss : float [W]
    """

    oil: str
    supply_temperature: float
    temperature: float
    eccentricity_ratio: float
    power_loss: float


def running_bearing(
    bearing: JournalBearing, load: tuple[float, float], speed: float
) -> RunningBearing | None:
    """Return a bearing of one viscosity as it runs; None if there is no such oil, or it is warm already.

    Its viscosity is taken for that of fresh oil, of the ISO grade that has it next to 40 degrees Celsius; all
    heat leaves with the oil that leaks.

    Parameters
    ----------
    bearing : JournalBearing
    load : (float, float) [N]
        Load on the journal.
    speed : float [rad/s]
    """
    if bearing.viscosity is None:
        return None
    wanted = math.log(bearing.viscosity)
    oils = {grade: Oil.iso_vg(grade) for grade in GRADES}
    at_40 = {grade: float(np.log(oil.viscosity(CELSIUS + 40.0))) for grade, oil in oils.items()}
    grade = min(GRADES, key=lambda one: abs(at_40[one] - wanted))
    grid = np.linspace(COLDEST, HOTTEST, 200)
    thinner = -np.log(oils[grade].law.viscosity(grid))
    if not thinner[0] < -wanted < thinner[-1]:
        return None
    supply = float(np.interp(-wanted, thinner, grid))
    cooling = Cooling(supply_temperature=supply)
    running = replace(bearing, viscosity=None, oil=oils[grade], cooling=cooling)
    at = equilibrium(running, load, speed)
    if at.temperature is None or at.losses is None:
        return None
    return RunningBearing(
        oil=f"ISO VG {grade}",
        supply_temperature=supply,
        temperature=at.temperature,
        eccentricity_ratio=at.eccentricity_ratio,
        power_loss=float(at.losses.power_loss),
    )


# Locus of the journal center by every film of a ladder.


def attitude_angle(bearing: JournalBearing, eccentricity_ratio: Array) -> Array:
    """Return the angle from the load line to the journal center, in the sense of rotation, (n,) [rad].

    Parameters
    ----------
    bearing : JournalBearing
    eccentricity_ratio : ndarray, shape (n,) [1]
    """
    position = bearing.clearance * np.stack([eccentricity_ratio, np.zeros_like(eccentricity_ratio)])
    force = bearing.force(position, np.zeros_like(position), np.full(len(eccentricity_ratio), SPEED))
    return np.asarray(-np.arctan2(-force[1], -force[0]))


def attitude_angles(
    bearing: JournalBearing, rungs: Sequence[studies.StudyModel], eccentricity_ratio: Array
) -> dict[str, Array]:
    """Return the attitude angles (n,) [rad] of the bearing with the film of each rung, by its name."""
    return {
        rung.name: attitude_angle(fitted_bearing(bearing, rung.law), eccentricity_ratio) for rung in rungs
    }


# Coupled runs of two FMUs at several macro steps, compared with the monolithic solution.


@dataclass(frozen=True, kw_only=True)
class CoupledRun(Readable):
    """A co-simulation at one macro step, and how far it is from the monolithic solution.

    Attributes
    ----------
    macro_angle : float [rad]
        Shaft rotation between two exchanges.
    macro_step : float [s]
    spectral_radius : float [1]
        Largest growth per macro step by linear theory at the static equilibrium; stable below 1.
    orbit_error : float [1]
        Largest distance of the orbits / clearance; no error estimate where `refused` says why.
    wall_time : float [s]
        Time that the run took.
    refused : str
        Empty, or why the run is no answer.
    trajectory : Trajectory
        The signals at the exchanges.
    """

    macro_angle: float
    macro_step: float
    spectral_radius: float
    orbit_error: float
    wall_time: float
    refused: str
    trajectory: Trajectory


@dataclass(frozen=True, kw_only=True)
class CouplingStudy(Readable):
    """Coupled runs beside the monolithic solution.

    Attributes
    ----------
    monolithic : Trajectory
        Rotor and film integrated as one system.
    runs : tuple of CoupledRun
        Runs from the shortest macro step to the longest.
    observed_order : float or None [1]
        Order of convergence in the macro step, from the two shortest; None if one was refused.
    """

    monolithic: Trajectory
    runs: tuple[CoupledRun, ...]
    observed_order: float | None


def study_coupling(
    scene: Scene, fmus: Mapping[str, Path], macro_angles: Sequence[float], report: Report
) -> CouplingStudy:
    """Couple the FMUs of a scene at several macro steps and compare with the monolithic solution.

    Parameters
    ----------
    scene : Scene
        Gives the models of the monolithic solution, and the length of the runs.
    fmus : mapping of str to Path
    macro_angles : sequence of float [rad]
        At least one.
    report : callable
        Told how far the study is, after each macro step of each run.
    """
    angles = sorted(macro_angles)
    raw = [_run(scene, fmus, angle, _part(scene, angles, angle, report)) for angle in angles]
    report(1.0 / 1.1, "monolithic solution")
    monolithic = _monolithic(scene, [simulation.trajectory.time for simulation, _, _ in raw])
    runs = tuple(
        _compared(scene, angle, monolithic, *outcome) for angle, outcome in zip(angles, raw, strict=True)
    )
    return CouplingStudy(monolithic=monolithic, runs=runs, observed_order=_observed_order(runs))


def _part(scene: Scene, angles: list[float], angle: float, report: Report) -> Callable[[float], None]:
    """Return a function of the time reached in one run that reports the fraction of all runs done."""
    steps = {each: 1.0 / each for each in angles}  # the work is in proportion to the number of steps
    before, total = sum(steps[each] for each in angles if each < angle), 1.1 * sum(steps.values())
    text = f"coupled FMUs, macro step {math.degrees(angle):.3g} deg"
    return lambda t: report((before + steps[angle] * t / scene.duration) / total, text)


def _run(
    scene: Scene, fmus: Mapping[str, Path], angle: float, progress: Callable[[float], None]
) -> tuple[CoSimulation, float, str]:
    """Return a coupled run, its wall time, and why it is no answer if it is none."""
    begin = perf_counter()
    try:
        with quietly():
            result = cosimulate(
                fmus["rotor"],
                fmus["film"],
                macro_step=scene.time_of(angle),
                duration=scene.duration,
                progress=progress,
            )
    except PartialResultError as error:
        if not isinstance(error.partial, CoSimulation) or error.partial.trajectory.time.size == 0:
            raise
        return error.partial, perf_counter() - begin, str(error)
    return result, perf_counter() - begin, ""


def _monolithic(scene: Scene, times: list[Array]) -> Trajectory:
    """Return the monolithic solution at the times of all runs."""
    every = np.unique(np.minimum(np.concatenate(times), scene.duration))
    return monolithic_solution(scene, every)


def _compared(
    scene: Scene, angle: float, monolithic: Trajectory, simulation: CoSimulation, wall: float, refused: str
) -> CoupledRun:
    rotor, _ = at_rest_on_film(scene)
    theory = coupling_stability(
        rotor, scene.bearing, state=rotor.initial_state, macro_step=simulation.macro_step
    )
    own = simulation.trajectory
    return CoupledRun(
        macro_angle=angle,
        macro_step=simulation.macro_step,
        spectral_radius=theory.spectral_radius,
        orbit_error=orbit_distance(own, monolithic) / clearance_of(scene.bearing),
        wall_time=wall,
        refused=refused,
        trajectory=own,
    )


def _observed_order(runs: tuple[CoupledRun, ...]) -> float | None:
    """Return the slope of log(error) over log(macro step) between the two shortest steps."""
    if len(runs) < 2 or runs[0].refused or runs[1].refused:
        return None
    fine, coarse = runs[:2]
    return math.log(coarse.orbit_error / fine.orbit_error) / math.log(coarse.macro_step / fine.macro_step)


# The demonstration: from a bearing on paper to a coupled simulation, with every number kept.


REFINEMENTS = (0.25, 0.5, 1.0, 2.0)
"""Macro steps of the study, in those of the scene."""

BEYOND = 1.3
"""A run this far past the stability limit must be refused."""

RUNGS = (
    "short film",
    "published (1, 1)",
    "published (2, 1)",
    "fixed arc (2, all)",
    "rotating arc (2, all)",
    "rotating arc (6, all)",
    "free arc (4+c, 8)",
    "2-D 48 x 4",
    "2-D 96 x 8",
    "2-D 192 x 16",
    "map",
)
"""Films compared: the whole ladder, thinned where neighbors tell the same."""

STATES, ROUNDS = 100, 3
"""Random states of the comparison and rounds of timing."""

REFERENCE_CELLS = (384, 16)
"""Cells of the finest grid of its reference."""

ECCENTRICITY_RATIOS = tuple(np.linspace(0.02, 0.98, 49).tolist())
"""Where locus and stability are compared."""


@dataclass(frozen=True, kw_only=True)
class DemoResult(Readable):
    """All that the demonstration found.

    Attributes
    ----------
    scene : Scene
        The scene of the demonstration.
    answer : Answer
        Equilibrium, coefficients, whirl threshold.
    running : RunningBearing or None
        The bearing as it runs, its oil warm, beside the answer; None where no oil of the grades is as viscous
        at any temperature.
    speed_parameter : float [1]
        speed * sqrt(clearance * mass / load) of the scene.
    fmus : mapping of str to Path
        The files that were exported.
    critical_macro_angle : float or None [rad]
        Longest macro step of a stable coupling by linear theory; None where there is no limit.
    coupling : CouplingStudy
        Coupled runs beside the monolithic one.
    attitude_angle : dict of str to ndarray [rad]
        Attitude angle by film, at the eccentricity ratios of `stability`.
    stability : StudyResult
        Whirl threshold by film.
    accuracy : StudyResult
        Error and cost of the force by film.
    """

    scene: Scene
    answer: Answer
    running: RunningBearing | None
    speed_parameter: float
    fmus: Mapping[str, Path]
    critical_macro_angle: float | None
    coupling: CouplingStudy
    attitude_angle: dict[str, Array]
    stability: studies.StudyResult
    accuracy: studies.StudyResult

    @property
    def scene_run(self) -> CoupledRun:
        """The coupled run at the macro step of the scene."""
        wanted = self.scene.cosimulation.macro_angle
        return min(self.coupling.runs, key=lambda run: abs(run.macro_angle - wanted))

    @property
    def refusal_run(self) -> CoupledRun | None:
        """The run whose macro step is past the stability limit on purpose, to show that it is refused."""
        if self.critical_macro_angle is None:
            return None
        wanted = BEYOND * self.critical_macro_angle
        return min(self.coupling.runs, key=lambda run: abs(run.macro_angle - wanted))


def run_demo(folder: Path, scene: Scene, report: Report = silent) -> DemoResult:
    """Solve a scene, export its FMUs, couple them, and compare with the monolithic solution.

    Writes `film.fmu`, `rotor.fmu`, `results.json`, `monolithic.csv`, `coupled.csv`, and the films compared as
    `stability.csv` and `accuracy.csv`.

    Parameters
    ----------
    folder : Path
        Made if absent.
    scene : Scene
        Scene with a rotor, and a bearing of length/diameter 0.1 to 4, where all films of the ladder exist.
    report : callable, optional
        Told how far the job is.

    Raises
    ------
    InputError
        If the scene has no rotor or its length/diameter is out of range.
    RotorfilmError
        What the steps raise; see `Scene.solve`, `export_scene` and `study_coupling`.
    """
    scene.required("rigid_rotor", "the demonstration")
    slenderness, rungs = scene.journal_bearing.slenderness, demo_rungs()
    plain = studies.comparison_bearing(slenderness)
    folder.mkdir(parents=True, exist_ok=True)
    report(0.0, "equilibrium, stiffness and damping, whirl threshold")
    answer = scene.describe()
    report(0.02, "locus by every film")
    angles = attitude_angles(plain, rungs, np.array(ECCENTRICITY_RATIOS))
    stability = studies.journal_stability(
        slenderness,
        eccentricity_ratio=ECCENTRICITY_RATIOS,
        rungs=rungs,
        cells=REFERENCE_CELLS,
        report=part_of(report, 0.03, 0.12),
    )
    accuracy = studies.journal_accuracy(
        slenderness,
        states=STATES,
        rungs=rungs,
        cells=REFERENCE_CELLS,
        rounds=ROUNDS,
        report=part_of(report, 0.12, 0.3),
    )
    report(0.3, "FMUs")
    fmus = export_scene(scene, folder)
    limit = critical_macro_angle(scene)
    coupling = study_coupling(scene, fmus, _macro_angles(scene, limit), part_of(report, 0.3, 0.95))
    result = DemoResult(
        scene=scene,
        answer=answer,
        running=running_bearing(scene.journal_bearing, scene.static_load, scene.speed),
        speed_parameter=speed_parameter(
            speed=scene.speed,
            clearance=clearance_of(scene.bearing),
            mass=scene.rotor.mass,
            load=scene.static_load,
        ),
        fmus=fmus,
        critical_macro_angle=limit,
        coupling=coupling,
        attitude_angle=angles,
        stability=stability,
        accuracy=accuracy,
    )
    write_results(result, folder)
    report(0.95, "results written")
    return result


def demo_rungs() -> tuple[studies.StudyModel, ...]:
    """Return the films that the demonstration compares."""
    return tuple(rung for rung in studies.journal_rungs() if rung.name in RUNGS)


def write_results(result: DemoResult, folder: Path) -> None:
    """Write `results.json`, and trajectories and comparisons as CSV in SI units."""
    text = json.dumps(plain_results(result), indent=2, allow_nan=False)
    write_atomically(folder / "results.json", f"{text}\n".encode())
    _write_csv(folder / "monolithic.csv", result.coupling.monolithic)
    _write_csv(folder / "coupled.csv", result.scene_run.trajectory)
    write_csv(folder / "stability.csv", result.stability.columns())
    write_csv(folder / "accuracy.csv", result.accuracy.columns())


def plain_results(result: DemoResult) -> dict[str, Any]:
    """Return the results as plain data, without the trajectories; files by their names."""
    runs = [_without_trajectory(run) for run in result.coupling.runs]
    kept = {f.name: getattr(result, f.name) for f in fields(result) if f.name not in ("fmus", "coupling")}
    kept["fmus"] = {name: path.name for name, path in result.fmus.items()}
    kept["coupling"] = {"observed_order": result.coupling.observed_order, "runs": runs}
    return to_plain(kept)


def _without_trajectory(run: CoupledRun) -> dict[str, Any]:
    return {f.name: getattr(run, f.name) for f in fields(run) if f.name != "trajectory"}


def _write_csv(path: Path, trajectory: Trajectory) -> None:
    write_csv(path, {"time": trajectory.time, **trajectory.signals})


def _macro_angles(scene: Scene, limit: float | None) -> list[float]:
    angles = [part * scene.cosimulation.macro_angle for part in REFINEMENTS]
    return angles if limit is None else [*angles, BEYOND * limit]
