"""Runs of a scene with a damper, as a lost blade or a run-up: as one system, or as two FMUs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...bearings.damper import JFODamper
from ...cosim import CoSimulation, cosimulate
from ...errors import ContactError
from ...model import Array, largest_eccentricity_ratio
from ...motion import simulate
from ...readable.result import Drawable
from ...results import Trajectory
from ..export_scene import write_models
from .damper_models import DamperScene, damper_fmus, damper_models

if TYPE_CHECKING:
    from ..scene import Scene

RTOL = 1e-6

STEPS_A_TURN = 192
"""Steps in a turn of a film that conserves its oil: within .2 % of its force."""


@dataclass(frozen=True, kw_only=True)
class DamperRun(Drawable):
    """A motion on a damper.

    Attributes
    ----------
    trajectory : Trajectory
        Up to contact, if there is one.
    eccentricity_ratio : ndarray, shape (n,) [1]
    peak_eccentricity_ratio : float [1]
        Largest one of the run.
    peak_force : float [N]
        Greatest force on the housing, of film and springs.
    contact_time : float or None [s]
        When the rotor left the film's range, up to the wall for a short film; None if it never did.
    """

    trajectory: Trajectory
    eccentricity_ratio: Array
    peak_eccentricity_ratio: float
    peak_force: float
    contact_time: float | None

    @property
    def force(self) -> Array:
        """Force on the housing, of film and springs, shape (n,) [N]."""
        signals = self.trajectory.signals
        return np.asarray(np.hypot(signals["force_x"], signals["force_y"]))


def run_damper(scene: Scene) -> DamperRun:
    """Return the motion by integrating rotor and damper as one system; contact ends it and is no error."""
    models = damper_models(scene)
    end = models.duration
    times = np.append(np.arange(0.0, end, models.step), end)
    fastest = max(abs(speed) for speed in models.rotor.profile.speeds)
    steps = 2.0 * np.pi / fastest / STEPS_A_TURN if isinstance(models.support, JFODamper) else np.inf

    def run() -> Trajectory:
        return simulate(models.rotor, models.support, duration=end, times=times, rtol=RTOL, max_step=steps)

    return _followed(models, run)


def couple_damper(scene: Scene, folder: Path, version: str = "2.0") -> DamperRun:
    """Return the motion by coupling `rotor.fmu` and `damper.fmu`, written into a folder, through fmpy.

    Parameters
    ----------
    scene : Scene
    folder : Path
    version : str
        FMI version; a damper whose film is no map has 2.0 only.
    """
    models = damper_models(scene)
    damper, rotor = write_models(damper_fmus(scene), folder, version)
    return _followed(
        models, lambda: cosimulate(rotor, damper, macro_step=models.step, duration=models.duration)
    )


def _followed(models: DamperScene, follow: Callable[[], Trajectory | CoSimulation]) -> DamperRun:
    """Return what a motion shows, up to contact if there is one, in the time of the scene."""
    touched = False
    try:
        found = follow()
    except ContactError as contact:
        found, touched = contact.partial, True
    run = found.trajectory if isinstance(found, CoSimulation) else found
    eps = np.hypot(*run.position) / models.support.clearance
    support = models.support
    reach = 1.0 if isinstance(support, JFODamper) else largest_eccentricity_ratio(support)
    beyond = np.nonzero(eps >= reach)[0]
    first = int(beyond[0]) if beyond.size else len(eps) - 1
    shown = slice(0, first + 1)
    signals = {name: values[shown] for name, values in run.signals.items()}
    time = models.start + run.time[shown]
    return DamperRun(
        trajectory=replace(run, time=time, signals=signals),
        eccentricity_ratio=eps[shown],
        peak_eccentricity_ratio=float(eps[shown].max()),
        peak_force=float(np.hypot(signals["force_x"], signals["force_y"]).max()),
        contact_time=float(time[-1]) if touched or beyond.size else None,
    )
