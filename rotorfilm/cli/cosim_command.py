"""The command `rotorfilm cosim`: rotor and film of a scene coupled as separate FMUs."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ..core.progress import Report
from ..core.results import write_csv
from . import printing as console
from .command import (
    Argument,
    Option,
    Said,
    Settings,
    SignalFile,
    inside,
    load_scene,
    make_room,
    written_rows,
)

if TYPE_CHECKING:
    from ..scenes.cosimulate_scene import CosimAnswer


def cosim(
    scene: Annotated[Path, Argument(metavar="SCENE.toml", help="Scene file with a rotor.")],
    report: Report,
    changes: Settings = None,
    scheme: Annotated[
        str,
        Option(
            help="auto, gauss-seidel-0 to -2, jacobi-0 to -2, si-exp, si-exp3, newton or adaptive.",
            metavar="NAME",
        ),
    ] = "auto",
    tolerance: Annotated[float, Option(help="Relative, of auto and adaptive.", min=0.0)] = 1e-2,
    out: SignalFile = None,
) -> Said:
    """Couple the rotor and the film of a scene as FMUs, and say how well: limit, error, film calls."""
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
            kept = error.partial.trajectory
            write_csv(out, {"time": kept.time, **kept.signals})
        raise
    if out is not None:
        write_csv(out, {"time": signals.time, **signals.signals})
    return Said(answer, partial(_print, loaded.title, answer, out))


def _print(title: str, answer: CosimAnswer, out: Path | None) -> None:
    for trial in answer.trials:
        console.print_rows("", [(trial.scheme, trial.reason)])
    console.print_rows(title, cosim_rows(answer) + written_rows(out))


def cosim_rows(answer: CosimAnswer) -> list[tuple[str, str]]:
    """Return the rows that describe a co-simulation."""
    limit, watch, work = answer.critical_macro_angle, answer.watch, answer.work
    calls = ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in work.items())
    rows = [
        ("scheme", f"{answer.scheme}, order {answer.order}"),
        ("macro step", f"{math.degrees(answer.macro_angle):.4g} deg"),
        ("stable at rest up to", "any" if limit is None else f"{math.degrees(limit):.4g} deg"),
        ("largest eccentricity ratio", f"{answer.eccentricity_ratio:.4g}"),
        ("orbit error / clearance", f"{answer.orbit_error:.2e} (beside the monolithic solution)"),
        ("work", calls),
    ]
    if watch.local_error is not None:
        rows.append(("local error / rms force", f"{watch.local_error:.2e}"))
    if watch.explicit_ratio is not None:
        rows.append(("macro step * damping / mass", f"{watch.explicit_ratio:.3g} (explicit limit .1 to 2)"))
    return [*rows, *(("warning", text) for text in watch.warnings)]
