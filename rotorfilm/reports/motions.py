"""What the motion of a scene over time says: numbers, rows, signals and pictures."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ..analysis import whirl_verdict
from ..core.errors import InputError
from ..core.progress import Report
from ..core.readable import Plottable, Row
from ..core.results import Trajectory
from .answer_rows import RPM

if TYPE_CHECKING:
    from ..bearings.contact.table import ContactResponse
    from ..bearings.damper.answer import DamperRun
    from ..scenes import Scene
    from ..scenes.rotor_runs import RotorRun


class FollowedMotion(NamedTuple):
    """What a run says.

    Attributes
    ----------
    data : object
        As JSON.
    rows : list of (str, str)
    trajectory : Trajectory
    shown : Plottable
        What draws the run.
    failure : str or None
        Why it ended early.
    """

    data: Any
    rows: list[Row]
    trajectory: Trajectory
    shown: Plottable
    failure: str | None

    @property
    def signals(self) -> dict[str, Any]:
        """The signals over time, time first."""
        return signals_of(self.trajectory)


def followed(scene: Scene, full: bool, fmus: bool, report: Report) -> FollowedMotion:
    """Return the motion of what moves in a scene."""
    from ..bearings.contact.table import run_contact
    from ..bearings.damper.answer import couple_damper, run_damper
    from ..scenes.rotor_runs import run_rotor
    from ..scenes.shared_tables import kind_of

    on_contact = scene.contact is not None
    on_damper = scene.damper is not None and kind_of(scene.excitation) not in ("motor", "ground")
    if full and not on_contact:
        raise InputError("--full must be given with a [contact], got a scene without")
    if fmus and not on_damper:
        raise InputError("--fmus must be given with a [damper] that is not on a motor or shaken, got another")
    if on_contact:
        return contact_motion(run_contact(scene, full=full, report=report))
    if fmus:
        with tempfile.TemporaryDirectory() as folder:
            return damper_motion(couple_damper(scene, Path(folder)))
    return damper_motion(run_damper(scene)) if on_damper else rotor_motion(run_rotor(scene, report))


def contact_motion(found: ContactResponse) -> FollowedMotion:
    """Return what the motion of a rolling ball says."""
    names = ("approach", "force", "central_film")
    signals = {name: getattr(found, name) for name in names if getattr(found, name) is not None}
    run = Trajectory(time=found.time, signals=signals, work=found.work)
    failure = None if found.complete else "interrupted; what is shown ends there"
    return FollowedMotion(found, found.to_rows(), run, run, failure)


def damper_motion(run: DamperRun) -> FollowedMotion:
    """Return what a run on a damper says."""
    time, eps = run.trajectory.time, run.eccentricity_ratio
    failure = None
    if run.contact_time is not None:
        failure = (
            f"the rotor must stay inside the clearance and the film's range, got an eccentricity ratio of "
            f"{eps[-1]:.4g} at {run.contact_time:.6g} s; what is shown ends there"
        )
    data = {
        "peak_eccentricity_ratio": run.peak_eccentricity_ratio,
        "peak_force": run.peak_force,
        "final_eccentricity_ratio": float(eps[-1]),
        "contact_time": run.contact_time,
        "start": float(time[0]),
        "end": float(time[-1]),
        "work": dict(run.trajectory.work),
    }
    rows = [
        ("from", f"{time[0]:.6g} s"),
        ("to", f"{time[-1]:.6g} s"),
        ("largest eccentricity ratio", f"{run.peak_eccentricity_ratio:.5f}"),
        ("eccentricity ratio at the end", f"{eps[-1]:.5f}"),
        ("largest force on the housing", f"{run.peak_force:.5g} N"),
        *_ending(run.contact_time, run.trajectory),
    ]
    return FollowedMotion(data, rows, run.trajectory, run, failure)


def rotor_motion(run: RotorRun) -> FollowedMotion:
    """Return what a run of a rotor on its films says."""
    failure, whirl = None, whirl_verdict(run.trajectory)
    if run.contact_time is not None:
        failure = f"a journal reached the wall at {run.contact_time:.6g} s; what is shown ends there"
    data = {
        "peaks": dict(run.peaks),
        "at_rest": dict(run.at_rest),
        "vibrations": dict(run.vibrations),
        "vibration_speeds": dict(run.vibration_speeds),
        "end_speed": run.end_speed,
        "whirl": whirl or None,
        "contact_time": run.contact_time,
        "end": float(run.trajectory.time[-1]),
        "work": dict(run.trajectory.work),
    }
    rows = [
        ("to", f"{run.trajectory.time[-1]:.6g} s"),
        ("speed at the end", f"{run.end_speed * RPM:.6g} rpm"),
        *(
            (
                f"largest displacement of {name}",
                f"{size * 1e6:.4g} um, at rest {run.at_rest[name] * 1e6:.4g} um",
            )
            for name, size in run.peaks.items()
        ),
        *(
            (
                f"largest vibration of {name}",
                f"{size * 1e6:.4g} um about its rest, at {run.vibration_speeds[name] * RPM:.5g} rpm",
            )
            for name, size in run.vibrations.items()
        ),
        *[("whirl", whirl)] * bool(whirl),
        *_ending(run.contact_time, run.trajectory),
    ]
    return FollowedMotion(data, rows, run.trajectory, run.trajectory, failure)


def signals_of(run: Trajectory) -> dict[str, Any]:
    """Return time and signals by their names."""
    return {"time": run.time, **run.signals}


def _ending(contact_time: float | None, run: Trajectory) -> list[tuple[str, str]]:
    """Return the rows of when a journal touched, and of what the run took."""
    touched = "none" if contact_time is None else f"at {contact_time:.6g} s"
    return [("contact", touched), ("work", counted(run.work))]


def counted(work: Mapping[str, int]) -> str:
    """Return counters of work in one line."""
    return ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in work.items())
