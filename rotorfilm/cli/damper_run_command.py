"""The command `rotorfilm damper-run`: a lost blade, a run-up or an unbalance on the damper of a scene."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import printing as console

if TYPE_CHECKING:
    from ..scenes import Scene
    from ..scenes.damper.damper_runs import DamperRun

DAMPER_RUN_EXAMPLE = "Example: rotorfilm damper-run examples/blade_loss.toml --out motion.csv"


def damper_run(
    scene: Annotated[
        Path, typer.Argument(metavar="SCENE.toml", help="Scene file with a damper and a rigid rotor.")
    ],
    fmus: Annotated[bool, typer.Option("--fmus", help="As two FMUs, instead of one system.")] = False,
    out: Annotated[Path | None, typer.Option(help="CSV file for the signals.", metavar="FILE.csv")] = None,
    chart: Annotated[
        Path | None, typer.Option(help="Draw eccentricity and force over time into this PNG.")
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="Print JSON on stdout instead of tables.")] = False,
) -> None:
    """Follow a rotor on a damper after a blade is lost, over a run-up or with its unbalance.

    Where the rotor reaches the wall, or the end of a film's range, the motion until then is shown and
    written, and the command exits with 1.
    """
    from ..results import write_csv
    from ..scenes import Scene

    loaded = Scene.load(scene)
    run = _run(loaded, fmus)
    if out is not None:
        write_csv(out, {"time": run.trajectory.time, **run.trajectory.signals})
    if chart is not None:
        from ..charts import plot_damper_run, save

        save(plot_damper_run(run.trajectory.time, run.eccentricity_ratio, run.force), chart)
    if json:
        console.print_json(plain_run(run))
    else:
        console.print_rows(loaded.title, damper_run_rows(run))
    if run.contact_time is not None:
        console.complain("error", contact_message(run))
        raise typer.Exit(1)


def _run(scene: Scene, fmus: bool) -> DamperRun:
    from ..scenes.damper.damper_runs import couple_damper, run_damper

    if not fmus:
        return run_damper(scene)
    with tempfile.TemporaryDirectory() as folder:
        return couple_damper(scene, Path(folder))


def contact_message(run: DamperRun) -> str:
    """Return what a run that did not end says."""
    return (
        f"the rotor must stay inside the clearance and the film's range, got an eccentricity ratio of "
        f"{run.eccentricity_ratio[-1]:.4g} at {run.contact_time:.6g} s; what is shown ends there"
    )


def plain_run(run: DamperRun) -> dict[str, object]:
    """Return a run as plain numbers."""
    return {
        "peak_eccentricity_ratio": run.peak_eccentricity_ratio,
        "peak_force": run.peak_force,
        "final_eccentricity_ratio": float(run.eccentricity_ratio[-1]),
        "contact_time": run.contact_time,
        "start": float(run.trajectory.time[0]),
        "end": float(run.trajectory.time[-1]),
        "work": dict(run.trajectory.work),
    }


def damper_run_rows(run: DamperRun) -> list[tuple[str, str]]:
    """Return the rows that describe a run."""
    time = run.trajectory.time
    calls = ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in run.trajectory.work.items())
    return [
        ("from", f"{time[0]:.6g} s"),
        ("to", f"{time[-1]:.6g} s"),
        ("largest eccentricity ratio", f"{run.peak_eccentricity_ratio:.5f}"),
        ("eccentricity ratio at the end", f"{run.eccentricity_ratio[-1]:.5f}"),
        ("largest force on the housing", f"{run.peak_force:.5g} N"),
        ("contact", "none" if run.contact_time is None else f"at {run.contact_time:.6g} s"),
        ("work", calls),
    ]
