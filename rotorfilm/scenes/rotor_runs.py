"""Runs of a scene's rotor on its films over time: run-ups, motors in place of a speed, ground that shakes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from .. import rotors
from ..analysis import simulate
from ..core.errors import ContactError, InputError, RotorfilmError, warn_user
from ..core.model import Array
from ..core.port import Reaction
from ..core.progress import Report, silent
from ..core.readable import Readable
from ..core.results import Trajectory
from . import shared_tables
from .export_scene import at_rest, at_rest_on_film, from_shaft_rest

if TYPE_CHECKING:
    from .scene import Scene

RTOL = 1e-6

A_TURN = 24
"""Samples in a turn at the highest speed."""

FEWEST, MOST = 1001, 200_001
"""Samples of a run."""

BETWEEN = 8
"""Places between two samples at which the spline through them is looked at."""


@dataclass(frozen=True, kw_only=True)
class RotorRun(Readable):
    """A motion of a rotor on its films.

    Attributes
    ----------
    trajectory : Trajectory
        Up to contact, if there is one.
    peaks : mapping of str to float [m]
        Greatest distance, among the samples, of each journal from the center of its bearing, and of each
        probe from its place in a straight shaft.
    at_rest : mapping of str to float [m]
        The same at the beginning: how far the weight holds each down.
    vibrations : mapping of str to float [m]
        Greatest distance of each, among the samples, from its place at the beginning.
    vibration_speeds : mapping of str to float [rad/s]
        Speed of the shaft at that sample.
    end_speed : float [rad/s]
    contact_time : float or None [s]
        When a journal reached the wall; None if none did.
    """

    trajectory: Trajectory
    peaks: Mapping[str, float]
    at_rest: Mapping[str, float]
    vibrations: Mapping[str, float]
    vibration_speeds: Mapping[str, float]
    end_speed: float
    contact_time: float | None = None

    def _own_units(self) -> dict[str, str]:
        return dict.fromkeys(self.peaks, "m")


class PreparedRun(NamedTuple):
    """A run of a scene's rotor that is not made yet.

    Attributes
    ----------
    arguments : dict of str to object
        Arguments of `simulate`.
    start : float [s]
        When the run begins in the time of the scene.
    """

    arguments: dict[str, Any]
    start: float


class _Parts(NamedTuple):
    """A rotor at rest in its bearings, by station, and how long it runs [s]."""

    rotor: rotors.RigidRotor | rotors.ShaftRotor
    bearings: dict[str, Reaction]
    duration: float
    fastest: float


def run_rotor(scene: Scene, report: Report = silent) -> RotorRun:
    """Return the motion of a rotor on its films, from rest at `operation.speed` on.

    Parameters
    ----------
    scene : Scene
        Scene with a `[shaft]`, or with a `[rigid_rotor]` on a film that carries it. Its excitation is an
        unbalance, a `blade_loss`, whose run begins where the blade is lost, a `run_up`, a `motor` or
        `ground`.
    report : callable
        Is told the progress.

    Raises
    ------
    InputError
        If the scene has no such rotor, or another excitation.
    EquilibriumError
        If a film cannot carry its load.

    Warns
    -----
    ValidityWarning
        Where the run is so long that its samples are fewer in a turn, and of seals, whose added mass is
        left out.

    Notes
    -----
    A contact ends the run and is no error. Samples are 24 in a turn at the highest speed, 200 001 at most.
    A shaft on bearings with states of their own is integrated by scipy, all else in C. Of such bearings,
    plain journals whose oil warms are in C too.
    """
    report(0.0, "equilibrium")
    ready = prepared_run(scene)
    report(0.05, "motion")
    try:
        found: Trajectory | RotorfilmError = simulate(**ready.arguments)
    except ContactError as contact:
        found = contact
    report(1.0, "done")
    return finished_run(ready, found)


def prepared_run(scene: Scene) -> PreparedRun:
    """Return the run of a scene's rotor from its equilibrium on; see `run_rotor`, whose errors these are."""
    if scene.thrust is not None and scene.shaft is None:
        raise InputError(
            "thrust must stand in an entry of shaft.bearings for a run, as the mass of its collar is a disk "
            "of the shaft, got [thrust] alone, whose film has no motion of its own"
        )
    scene.required("operation", "a run over time, which begins at its speed")
    shared_tables.require_kind(scene.excitation, ("unbalance", "blade_loss", "run_up", "motor", "ground"))
    start = scene.excitation.start if isinstance(scene.excitation, shared_tables.BladeLossTable) else 0.0
    scene = after_loss(scene)
    parts = _parts(scene)
    rotor, reaction = _halves(scene, parts)
    known = {"duration": parts.duration, "times": run_times(parts.duration, parts.fastest), "rtol": RTOL}
    return PreparedRun({"rotor": rotor, "reaction": reaction, **known}, start)


def finished_run(ready: PreparedRun, found: Trajectory | RotorfilmError) -> RotorRun:
    """Return what a run shows, from what `simulate` returned; raise its error unless that is a contact."""
    partial = found.partial if isinstance(found, ContactError) else found
    if not isinstance(partial, Trajectory):
        assert isinstance(found, RotorfilmError)
        raise found
    start, trajectory = ready.start, partial
    contact = start + float(trajectory.time[-1]) if isinstance(found, ContactError) else None
    places = _places(trajectory)
    moved = {name: np.hypot(*(place - place[:, :1])) for name, place in places.items()}
    return RotorRun(
        trajectory=replace(trajectory, time=start + trajectory.time),
        peaks={name: float(np.hypot(*place).max()) for name, place in places.items()},
        at_rest={name: float(np.hypot(*place[:, 0])) for name, place in places.items()},
        vibrations={name: float(far.max()) for name, far in moved.items()},
        vibration_speeds={name: float(trajectory["speed"][far.argmax()]) for name, far in moved.items()},
        end_speed=float(trajectory["speed"][-1]),
        contact_time=contact,
    )


def run_times(duration: float, fastest: float) -> Array:
    """Return the times [s] of the samples of a run up to a speed [rad/s]; warn of few in a turn."""
    turns = fastest * duration / (2.0 * np.pi)
    count = max(int(A_TURN * turns) + 1, FEWEST)
    if count > MOST:
        warn_user(
            f"{MOST} samples of a run are {(MOST - 1) / turns:.3g} in a turn at the highest speed, fewer "
            f"than {A_TURN}: peaks may lie between them; a shorter operation.duration has more"
        )
    return np.linspace(0.0, duration, min(count, MOST))


def largest_distance(time: Array, x: Array, y: Array) -> float:
    """Return the largest distance from the origin of the splines through samples (n,) [m]."""
    share = np.arange(BETWEEN) / BETWEEN
    fine = np.append((time[:-1, None] + np.diff(time)[:, None] * share).ravel(), time[-1])
    return float(np.hypot(CubicSpline(time, x)(fine), CubicSpline(time, y)(fine)).max())


def after_loss(scene: Scene) -> Scene:
    """Return a scene that loses a blade as one whose rotor rests, and has its unbalance from then on."""
    lost = scene.excitation
    if not isinstance(lost, shared_tables.BladeLossTable):
        return scene
    if scene.speed == 0.0:
        raise InputError("operation.speed must not be zero for a lost blade, got 0.0")
    if scene.shaft is not None and any(one.unbalance > 0.0 for one in scene.shaft.unbalances):
        raise InputError("shaft.unbalances must be none where a blade is lost at rest, got some")
    assert scene.operation is not None  # or there is no speed
    sudden = shared_tables.UnbalanceTable(
        unbalance=lost.unbalance,
        unbalance_angle=lost.unbalance_angle + scene.speed * lost.start,
        node=lost.node,
    )
    duration = 2.0 * math.pi * lost.revolutions / abs(scene.speed)
    return replace(scene, excitation=sudden, operation=replace(scene.operation, duration=duration))


def run_span(scene: Scene) -> tuple[float, float]:
    """Return how long the run of a scene is [s], and its highest speed without its sign [rad/s]."""
    excitation, duration = scene.excitation, None
    if isinstance(excitation, shared_tables.RunUpTable):
        duration = excitation.profile(scene.speed).times[-1]
    given = None if scene.operation is None else scene.operation.duration
    if isinstance(excitation, shared_tables.GroundTable) and given is None:
        duration = excitation.end
    return duration or scene.duration, shared_tables.fastest_speed(scene)


def _parts(scene: Scene) -> _Parts:
    """Return the rotor of a scene at rest in its bearings."""
    excitation = scene.excitation
    duration, fastest = run_span(scene)
    rotor, bearings = _on_shaft(scene) if scene.shaft is not None else _rigid(scene)
    if isinstance(excitation, shared_tables.RunUpTable):
        rotor = replace(rotor, speed=excitation.profile(scene.speed))
    return _Parts(rotor, bearings, duration, fastest)


def _on_shaft(scene: Scene) -> tuple[rotors.ShaftRotor, dict[str, Reaction]]:
    """Return the shaft of a scene, and its bearings."""
    extra = (scene.excitation,) if isinstance(scene.excitation, shared_tables.UnbalanceTable) else ()
    rotor, bearings = scene.shaft.build(scene.speed, extra), scene.shaft.build_bearings()
    resting, at = at_rest(rotor, bearings, scene.speed)
    return resting, from_shaft_rest(bearings, at)


def _rigid(scene: Scene) -> tuple[rotors.RigidRotor, dict[str, Reaction]]:
    """Return the rigid rotor of a scene at rest on its film or in its damper, and its bearing."""
    if scene.damper is not None and scene.rigid_rotor is not None:
        rotor, bearing = scene.rigid_rotor.build(scene.speed, (0.0, 0.0)), scene.damper.support()
    else:
        rotor, bearing = at_rest_on_film(scene)
    if isinstance(scene.excitation, shared_tables.UnbalanceTable):
        rotor = scene.excitation.given_to(rotor)
    return rotor, {"": bearing}


def _halves(scene: Scene, parts: _Parts) -> tuple[Any, Any]:
    """Return the rotor and what it runs on, as `simulate` takes them."""
    rotor: Any = parts.rotor
    if isinstance(scene.excitation, shared_tables.MotorTable):
        table = scene.excitation
        rotor = rotors.MotorDrivenRotor(rotor=rotor, inertia=table.inertia, torque=table.motor())
    if isinstance(scene.excitation, shared_tables.GroundTable):
        rotor = rotors.BaseExcitedRotor(rotor=rotor, base=scene.excitation.motion(parts.duration))
    return rotor, parts.bearings[""] if isinstance(parts.rotor, rotors.RigidRotor) else parts.bearings


def _places(run: Trajectory) -> dict[str, Array]:
    """Return each displacement (x, y) over time, shape (2, n)."""
    pairs = [name for name in run.signals if name == "x" or name.endswith("_x")]
    others = "force_x", "moment_x", "tilt_x", "tilt_rate_x"
    moved = [name for name in pairs if not name.endswith(others)]
    return {
        name[:-2] or "journal": np.stack([run.signals[name], run.signals[f"{name[:-1]}y"]]) for name in moved
    }
