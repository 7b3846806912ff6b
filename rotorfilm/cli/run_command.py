"""The commands `rotorfilm run` and `cosim`: the rotor or the rolling ball of a scene followed over time."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ..core.frames import write_csv
from ..core.progress import Report
from . import command, printing as console

if TYPE_CHECKING:
    from ..scenes.cosimulate_scene import CosimAnswer


def run(
    scene: command.SceneFile,
    report: Report,
    changes: command.Settings = None,
    full: Annotated[
        bool, command.Option("--full", help="A rolling ball on its full film, not its law.")
    ] = False,
    fmus: Annotated[
        bool, command.Option("--fmus", help="Rotor and damper as two FMUs, not one system.")
    ] = False,
    out: command.SignalFile = None,
    chart: Annotated[
        Path | None, command.Option(help="Draw the motion into this PNG.", metavar="FILE.png")
    ] = None,
) -> command.CommandOutput:
    """Follow a scene over time: a lost blade, a run-up, a motor in place of its speed, ground that shakes.

    A scene has a [shaft], a [rigid_rotor] on a film or a damper, or a [contact] whose load jumps or swings.
    Where a rotor reaches the wall, or the end of a film's range, the motion until then is shown and
    written, and the command exits with 1.

    Example: rotorfilm run examples/blade_loss.toml --out motion.csv
    """
    from ..reports.motions import followed

    loaded = command.load_scene(scene, changes)
    command.make_room(out)
    with command.inside(scene):
        found = followed(loaded, full, fmus, report)
    if out is not None:
        write_csv(out, found.signals)
    if chart is not None:
        from ..charts import picture_of

        picture_of(found.shown).save(chart)
    shown = partial(console.print_rows, loaded.title, found.rows + command.written_rows(out))
    return command.CommandOutput(found.data, shown, found.failure)


# Rotor and film of a scene coupled as separate FMUs.


def cosim(
    scene: Annotated[Path, command.Argument(metavar="SCENE.toml", help="Scene file with a rotor.")],
    report: Report,
    changes: command.Settings = None,
    scheme: Annotated[
        str,
        command.Option(
            help="auto, gauss-seidel-0 to -2, jacobi-0 to -2, si-exp, si-exp3, si-memory, newton, adaptive.",
            metavar="NAME",
        ),
    ] = "auto",
    tolerance: Annotated[float, command.Option(help="Relative, of auto and adaptive.", min=0.0)] = 1e-2,
    out: command.SignalFile = None,
) -> command.CommandOutput:
    """Couple the rotor and the film of a scene as FMUs, and say how well: limit, error, film calls.

    Example: rotorfilm cosim examples/friswell.toml --scheme si-exp3 --set "cosimulation.macro_angle=5 deg"
    """
    report(0.0, "packages")
    from ..core.errors import PartialResultError
    from ..reports.motions import signals_of
    from ..scenes.cosimulate_scene import run_scene, scheme_named

    loaded = command.load_scene(scene, changes)
    command.make_room(out)
    try:
        with command.inside(scene):
            answer, signals = run_scene(loaded, scheme_named(scheme, tolerance), report)
    except PartialResultError as error:
        if out is not None and error.partial is not None:
            write_csv(out, signals_of(error.partial.trajectory))
        raise
    if out is not None:
        write_csv(out, signals_of(signals))
    return command.CommandOutput(answer, partial(_print, loaded.title, answer, out))


def _print(title: str, answer: CosimAnswer, out: Path | None) -> None:
    for trial in answer.trials:
        console.print_rows("", [(trial.scheme, trial.reason)])
    console.print_rows(title, cosim_rows(answer) + command.written_rows(out))


def cosim_rows(answer: CosimAnswer) -> list[tuple[str, str]]:
    """Return the rows that describe a co-simulation."""
    from ..reports.motions import counted

    watch = answer.watch
    rows = [
        ("scheme", f"{answer.scheme}, order {answer.order}"),
        ("macro step", f"{math.degrees(answer.macro_angle):.4g} deg"),
        ("stable at rest up to", _limit(answer)),
        ("largest eccentricity ratio", f"{answer.eccentricity_ratio:.4g}"),
        ("orbit error / clearance", f"{answer.orbit_error:.2e} (beside the monolithic solution)"),
        ("work", counted(answer.work)),
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
