"""The answer to one rotor on one damper: groups, orbits, folds, contact, coefficients."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..analysis import (
    Fold,
    OrbitCoefficients,
    SynchronousOrbits,
    orbit_coefficients,
    simulate,
    synchronous_orbits,
)
from ..bearings.assemblies import Sprung
from ..bearings.damper import DamperGroups, JFODamper, MapSqueeze, PorousDamper, damper_groups
from ..core.errors import ContactError, InputError
from ..core.model import Array, Reaction, largest_eccentricity_ratio
from ..core.progress import Report, silent
from ..core.readable import Drawable, Readable
from ..core.results import CircularOrbit, Trajectory
from ..cosim import CoSimulation, cosimulate
from ..rotors import RigidRotor, mount
from .damper_films import DamperScene, damper_fmus, damper_models
from .excitation_table import UnbalanceTable
from .export_scene import write_models

if TYPE_CHECKING:
    from .scene import Scene


@dataclass(frozen=True, kw_only=True)
class DamperAnswer(Readable):
    """What a rigid rotor with unbalance does on a damper with retainer springs.

    Attributes
    ----------
    groups : DamperGroups
        w_r being the speed.
    orbits : tuple of CircularOrbit
        At the rotor's unbalance, the smallest first; none means contact.
    folds : tuple of Fold
    contact_unbalance : float or None [kg m]
    small_motion : OrbitCoefficients
        Of film and springs on a circular orbit of a hundredth of the clearance.
    response : SynchronousOrbits
        Orbits over unbalances up to twice the rotor's.
    unbalance_scale : float [kg m]
        Mass times clearance.
    """

    groups: DamperGroups
    orbits: tuple[CircularOrbit, ...]
    folds: tuple[Fold, ...]
    contact_unbalance: float | None
    small_motion: OrbitCoefficients
    response: SynchronousOrbits
    unbalance_scale: float


def solve_damper(
    damper: PorousDamper, *, mass: float, speed: float, unbalance: float, stiffness: float = 0.0
) -> DamperAnswer:
    """Return the answer for a rotor [kg, rad/s, kg m] on a damper with springs of the stiffness [N/m].

    Raises
    ------
    InputError
        If a value breaks its rule.
    """
    groups = damper_groups(damper, mass=mass, speed=speed, stiffness=stiffness, unbalance=unbalance)
    rotor = RigidRotor(mass=mass, speed=speed, unbalance=unbalance, gravity=(0.0, 0.0))
    support: Reaction = Sprung(reaction=damper, stiffness=stiffness) if stiffness else damper
    response = synchronous_orbits(rotor, support, _around(unbalance))
    return DamperAnswer(
        groups=groups,
        orbits=response.at(unbalance),
        folds=response.folds,
        contact_unbalance=response.contact_unbalance,
        small_motion=orbit_coefficients(support, 0.01, speed),
        response=response,
        unbalance_scale=mass * damper.clearance,
    )


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
    return solve_damper(
        scene.damper.build(),
        mass=rotor.mass,
        speed=scene.speed,
        unbalance=rotor.unbalance or added,
        stiffness=scene.damper.stiffness,
    )


def _around(unbalance: float) -> Array:
    """Return unbalances from nearly 0 to twice the given one, itself among them."""
    return unbalance * np.linspace(0.005, 2.0, 400)


# Runs of a scene with a damper, as a lost blade or a run-up: as one system, or as two FMUs.


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


# A rotor and a damper whose oil has mass as one FMU.


class ExportedRotor(NamedTuple):
    """Where the FMU of a rotor on its damper is.

    Attributes
    ----------
    system : Path
    """

    system: Path


def export_damped_rotor(
    scene: Scene, folder: Path, *, version: str = "2.0", backend: str | None = None, platforms: str = "host"
) -> ExportedRotor:
    """Write `system.fmu`: the rotor of a scene on its damper, springs included, at rest.

    A film that the scene does not name is the map of the short film, which runs in C, or between tight seals
    that of finite length.

    Parameters
    ----------
    scene : Scene
        With a damper and a rotor.
    folder : Path
        Made if absent.
    version, backend, platforms : str
        See `export_fmu`.

    Raises
    ------
    InputError
        If the scene lacks a damper or a rotor.
    FmuError
        If the rotor cannot be exported.
    """
    from ..fmu import export_fmu  # slow to load, and not needed to read a scene

    table = scene.damper
    if table is None:
        raise InputError("damper is required for the FMU of a rotor on one, got no such table")
    if table.film is None and not table.needs_length:
        scene = scene.with_tables(damper=replace(table, film=MapSqueeze()))
    models = damper_models(scene)
    assert not isinstance(models.support, JFODamper)  # which no scene has that names a film, or seals
    path = folder / "system.fmu"
    export_fmu(
        mount(models.rotor, {"": models.support}),
        path,
        version,
        backend,
        platforms=platforms,
        component="system",
        step_size=models.step,
        stop_time=2.0 * np.pi / (abs(scene.speed) or 1.0),  # a turn: Python takes seconds for it
    )
    return ExportedRotor(system=path)
