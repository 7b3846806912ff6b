"""The answer to one rotor on one damper: groups, orbits, folds, contact, coefficients."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ... import analysis
from ...core.errors import ContactError, InputError
from ...core.model import Array
from ...core.port import Reaction, largest_eccentricity_ratio
from ...core.progress import Report, silent
from ...core.readable import Drawable, Readable
from ...core.results import CircularOrbit, Trajectory
from ...cosim import CoSimulation, cosimulate
from ...rotors import RigidRotor
from ...scenes.export_scene import export_scene
from ...scenes.shared_tables import UnbalanceTable
from ..assemblies import with_springs
from . import DamperGroups, JFODamper, damper_groups
from .table import DamperScene, damper_models

if TYPE_CHECKING:
    from ...scenes.scene import Scene


@dataclass(frozen=True, kw_only=True)
class DamperAnswer(Readable):
    """What a rigid rotor with unbalance does on a damper with retainer springs.

    Attributes
    ----------
    groups : DamperGroups
        w_r being the speed.
    orbits : tuple of CircularOrbit
        Orbits at the rotor's unbalance, the smallest first; none means contact.
    folds : tuple of Fold
    contact_unbalance : float or None [kg m]
    small_motion : OrbitCoefficients
        Small motion of film and springs on a circular orbit of a hundredth of the clearance.
    response : SynchronousOrbits
        Orbits over unbalances up to twice the rotor's.
    unbalance_scale : float [kg m]
        Mass times clearance.
    """

    groups: DamperGroups
    orbits: tuple[CircularOrbit, ...]
    folds: tuple[analysis.Fold, ...]
    contact_unbalance: float | None
    small_motion: analysis.OrbitCoefficients
    response: analysis.SynchronousOrbits
    unbalance_scale: float


def answer_damper(scene: Scene, report: Report = silent) -> DamperAnswer:
    """Return the orbits of the rotor of a scene on its damper, at the speed of its operation.

    Raises
    ------
    InputError
        If the scene has no damper or no rotor, a supply without a film law, which questions and runs take,
        or an offset, which runs take.
    """
    if scene.damper is None or scene.rigid_rotor is None:
        raise InputError("damper and rigid_rotor are required for orbits on a damper, got a scene without")
    if scene.damper.supply is not None and scene.damper.film is None:
        raise InputError("damper.film must be given beside supply, or a [question] asked, got no film")
    if any(scene.damper.offset):
        raise InputError(
            f"damper.offset must be 0 for orbits about the center, as only runs take one, got "
            f"{scene.damper.offset!r} m"
        )
    excitation, rotor = scene.excitation, scene.rigid_rotor
    added = excitation.unbalance if isinstance(excitation, UnbalanceTable) else 0.0
    damper, stiffness, speed = scene.damper.build(), scene.damper.stiffness, scene.speed
    unbalance = rotor.unbalance or added
    if not unbalance:
        raise InputError(
            "rigid_rotor.unbalance must be positive for orbits in a damper, got 0.0: nothing moves"
        )
    support: Reaction = with_springs(damper, stiffness) if stiffness else damper
    alone = RigidRotor(mass=rotor.mass, speed=speed, unbalance=unbalance, gravity=(0.0, 0.0))
    response = analysis.synchronous_orbits(alone, support, unbalance * np.linspace(0.005, 2.0, 400))
    return DamperAnswer(
        groups=damper_groups(damper, mass=rotor.mass, speed=speed, stiffness=stiffness, unbalance=unbalance),
        orbits=response.at(unbalance),
        folds=response.folds,
        contact_unbalance=response.contact_unbalance,
        small_motion=analysis.orbit_coefficients(support, 0.01, speed),
        response=response,
        unbalance_scale=rotor.mass * damper.clearance,
    )


# Runs of a scene with a damper, as a lost blade or a run-up: as one system, or as two FMUs.


RTOL = 1e-6

STEPS_A_TURN = 192
"""Steps in a turn of a film that conserves its oil: within 0.2 % of its force."""


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
        return analysis.simulate(
            models.rotor, models.support, duration=end, times=times, rtol=RTOL, max_step=steps
        )

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
    made = export_scene(scene, folder, version=version)
    return _followed(
        models,
        lambda: cosimulate(made["rotor"], made["film"], macro_step=models.step, duration=models.duration),
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
