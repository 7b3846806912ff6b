"""Coupled runs of two FMUs at several macro steps, compared with the monolithic solution."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from ..cosim import CoSimulation, cosimulate, coupling_stability
from ..cosim.watch import quietly
from ..errors import PartialResultError
from ..model import Array
from ..progress import Report
from ..readable.result import Readable
from ..results import Trajectory, orbit_distance
from .export_scene import ExportedScene, resting_rotor
from .monolithic import monolithic_solution
from .scene import Scene


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
        From the shortest macro step to the longest.
    observed_order : float or None [1]
        Order of convergence in the macro step, from the two shortest; None if one was refused.
    """

    monolithic: Trajectory
    runs: tuple[CoupledRun, ...]
    observed_order: float | None


def study_coupling(
    scene: Scene, fmus: ExportedScene, macro_angles: Sequence[float], report: Report
) -> CouplingStudy:
    """Couple the FMUs of a scene at several macro steps and compare with the monolithic solution.

    Parameters
    ----------
    scene : Scene
        Gives the models of the monolithic solution, and the length of the runs.
    fmus : ExportedScene
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
    scene: Scene, fmus: ExportedScene, angle: float, progress: Callable[[float], None]
) -> tuple[CoSimulation, float, str]:
    """Return a coupled run, its wall time, and why it is no answer if it is none."""
    begin = perf_counter()
    try:
        with quietly():
            result = cosimulate(
                fmus.rotor,
                fmus.film,
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
    rotor = resting_rotor(scene)
    theory = coupling_stability(
        rotor, scene.bearing, state=rotor.initial_state, macro_step=simulation.macro_step
    )
    own = simulation.trajectory
    return CoupledRun(
        macro_angle=angle,
        macro_step=simulation.macro_step,
        spectral_radius=theory.spectral_radius,
        orbit_error=orbit_distance(own, monolithic) / scene.bearing.clearance,
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
