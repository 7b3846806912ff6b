"""The commands `rotorfilm run` and `cosim`: the rotor or the rolling ball of a scene followed over time."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from ..core.errors import InputError
from ..core.frames import write_csv
from ..core.progress import Report
from . import printing as console
from .command import (
    Argument,
    CommandOutput,
    Option,
    SceneFile,
    Settings,
    SignalFile,
    inside,
    load_scene,
    make_room,
    written_rows,
)

if TYPE_CHECKING:
    from ..core.results import Trajectory
    from ..scenes import Scene
    from ..scenes.contact import ContactResponse
    from ..scenes.cosimulate_scene import CosimAnswer
    from ..scenes.rotor_runs import RotorRun
    from ..scenes.solve_damper import DamperRun

RPM = 30.0 / math.pi
"""Turns per minute in one rad/s."""


FollowedMotion = tuple[Any, list[tuple[str, str]], dict[str, Any], Callable[[], Any], str | None]
"""Data as JSON, rows, signals over time, what draws the run and returns the axes, and why it ended early."""


def run(
    scene: SceneFile,
    report: Report,
    changes: Settings = None,
    full: Annotated[bool, Option("--full", help="A rolling ball on its full film, not its law.")] = False,
    fmus: Annotated[bool, Option("--fmus", help="Rotor and damper as two FMUs, not one system.")] = False,
    out: SignalFile = None,
    chart: Annotated[Path | None, Option(help="Draw the motion into this PNG.", metavar="FILE.png")] = None,
) -> CommandOutput:
    """Follow a scene over time: a lost blade, a run-up, a motor in place of its speed, ground that shakes.

    A scene has a [shaft], a [rigid_rotor] on a film or a damper, or a [contact] whose load jumps or swings.
    Where a rotor reaches the wall, or the end of a film's range, the motion until then is shown and
    written, and the command exits with 1.

    Example: rotorfilm run examples/blade_loss.toml --out motion.csv
    """
    loaded = load_scene(scene, changes)
    make_room(out)
    with inside(scene):
        data, rows, signals, draw, failure = _followed(loaded, full, fmus, report)
    if out is not None:
        write_csv(out, signals)
    if chart is not None:
        from ..charts import save

        axes = draw()
        save(axes[0] if isinstance(axes, tuple) else axes, chart)
    return CommandOutput(data, partial(console.print_rows, loaded.title, rows + written_rows(out)), failure)


def _followed(scene: Scene, full: bool, fmus: bool, report: Report) -> FollowedMotion:
    """Return the motion of what moves in a scene."""
    from ..scenes.contact import run_contact
    from ..scenes.rotor_runs import run_rotor
    from ..scenes.shared_tables import kind_of
    from ..scenes.solve_damper import couple_damper, run_damper

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
    from ..core.results import Trajectory

    names = ("approach", "force", "central_film")
    signals = {name: getattr(found, name) for name in names if getattr(found, name) is not None}
    run = Trajectory(time=found.time, signals=signals, work=found.work)
    failure = None if found.complete else "interrupted; what is shown ends there"
    return found, found.to_rows(), _signals(run), run.plot, failure


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
    return data, rows, _signals(run.trajectory), run.plot, failure


def rotor_motion(run: RotorRun) -> FollowedMotion:
    """Return what a run of a rotor on its films says."""
    failure = None
    if run.contact_time is not None:
        failure = f"a journal reached the wall at {run.contact_time:.6g} s; what is shown ends there"
    data = {
        "peaks": dict(run.peaks),
        "at_rest": dict(run.at_rest),
        "vibrations": dict(run.vibrations),
        "vibration_speeds": dict(run.vibration_speeds),
        "end_speed": run.end_speed,
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
        *_ending(run.contact_time, run.trajectory),
    ]
    return data, rows, _signals(run.trajectory), run.trajectory.plot, failure


def _signals(run: Trajectory) -> dict[str, Any]:
    return {"time": run.time, **run.signals}


def _ending(contact_time: float | None, run: Trajectory) -> list[tuple[str, str]]:
    """Return the rows of when a journal touched, and of what the run took."""
    touched = "none" if contact_time is None else f"at {contact_time:.6g} s"
    return [("contact", touched), ("work", _counted(run.work))]


def _counted(work: Mapping[str, int]) -> str:
    return ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in work.items())


# Rotor and film of a scene coupled as separate FMUs.


def cosim(
    scene: Annotated[Path, Argument(metavar="SCENE.toml", help="Scene file with a rotor.")],
    report: Report,
    changes: Settings = None,
    scheme: Annotated[
        str,
        Option(
            help="auto, gauss-seidel-0 to -2, jacobi-0 to -2, si-exp, si-exp3, si-memory, newton, adaptive.",
            metavar="NAME",
        ),
    ] = "auto",
    tolerance: Annotated[float, Option(help="Relative, of auto and adaptive.", min=0.0)] = 1e-2,
    out: SignalFile = None,
) -> CommandOutput:
    """Couple the rotor and the film of a scene as FMUs, and say how well: limit, error, film calls.

    Example: rotorfilm cosim examples/friswell.toml --scheme si-exp3 --set "cosimulation.macro_angle=5 deg"
    """
    report(0.0, "packages")
    from ..core.errors import PartialResultError
    from ..scenes.cosimulate_scene import run_scene, scheme_named

    loaded = load_scene(scene, changes)
    make_room(out)
    try:
        with inside(scene):
            answer, signals = run_scene(loaded, scheme_named(scheme, tolerance), report)
    except PartialResultError as error:
        if out is not None and error.partial is not None:
            write_csv(out, _signals(error.partial.trajectory))
        raise
    if out is not None:
        write_csv(out, _signals(signals))
    return CommandOutput(answer, partial(_print, loaded.title, answer, out))


def _print(title: str, answer: CosimAnswer, out: Path | None) -> None:
    for trial in answer.trials:
        console.print_rows("", [(trial.scheme, trial.reason)])
    console.print_rows(title, cosim_rows(answer) + written_rows(out))


def cosim_rows(answer: CosimAnswer) -> list[tuple[str, str]]:
    """Return the rows that describe a co-simulation."""
    watch = answer.watch
    rows = [
        ("scheme", f"{answer.scheme}, order {answer.order}"),
        ("macro step", f"{math.degrees(answer.macro_angle):.4g} deg"),
        ("stable at rest up to", _limit(answer)),
        ("largest eccentricity ratio", f"{answer.eccentricity_ratio:.4g}"),
        ("orbit error / clearance", f"{answer.orbit_error:.2e} (beside the monolithic solution)"),
        ("work", _counted(answer.work)),
    ]
    if watch.local_error is not None:
        rows.append(("local error / rms force", f"{watch.local_error:.2e}"))
    if watch.explicit_ratio is not None:
        rows.append(("macro step * damping / mass", f"{watch.explicit_ratio:.3g} (explicit limit 0.1 to 2)"))
    return [*rows, *(("warning", text) for text in watch.warnings)]


def _limit(answer: CosimAnswer) -> str:
    """Return up to which macro step the coupling is stable, in words."""
    if not answer.is_stability_known:
        return "not computed"
    limit = answer.critical_macro_angle
    return "any" if limit is None else f"{math.degrees(limit):.4g} deg"
