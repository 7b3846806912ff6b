"""The command `rotorfilm demo`: the whole way on a real bearing."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ..core.progress import Report
from ..core.units import CELSIUS
from . import printing as console
from .answer_printing import print_answer
from .command import CommandOutput, Option

if TYPE_CHECKING:
    from ..scenes.demo import DemoResult


def demo(
    report: Report,
    out: Annotated[Path, Option(help="Folder for results, FMUs and charts.")] = Path("rotorfilm-demo"),
) -> CommandOutput:
    """Run the whole way on a real bearing: equilibrium, stability, FMUs, coupled simulation, charts.

    Example: rotorfilm demo --out rotorfilm-demo
    """
    report(0.0, "packages")
    from ..scenes import bundled_scene
    from ..scenes.demo import plain_results, run_demo
    from .demo_pictures import draw_demo

    result = run_demo(out, bundled_scene(), report)
    report(0.95, "charts")
    charts = draw_demo(result, out)
    report(1.0, "done")
    data = {**plain_results(result), "charts": [chart.name for chart in charts]}
    return CommandOutput(data, partial(_print_all, result, out))


def _print_all(result: DemoResult, folder: Path) -> None:
    print_demo(result)
    notes = {folder / "demo.png": "overview: orbits, coupling error, whirl, force error"}
    files = [(path.name, notes.get(path, "")) for path in sorted(folder.iterdir())]
    console.print_rows(f"files in {folder}", files)


def _print_running(result: DemoResult) -> None:
    """Print the textbook bearing, its oil of one viscosity, beside the same bearing as it runs."""
    warm, at, losses = result.running, result.answer.equilibrium, result.answer.losses
    if warm is None or losses is None:
        return
    supply, running = (f"{T - CELSIUS:.1f} degC" for T in (warm.supply_temperature, warm.temperature))
    rows = [
        ("oil", f"{result.scene.journal_bearing.film_viscosity:.3g} Pa s", f"{warm.oil}, fed at {supply}"),
        ("eccentricity ratio", f"{at.eccentricity_ratio:.4g}", f"{warm.eccentricity_ratio:.4g}"),
        ("power loss", f"{losses.power_loss:.4g} W", f"{warm.power_loss:.4g} W"),
        ("temperature", supply, running),
    ]
    console.plain_console().print()
    console.print_columns(("the bearing", "with one viscosity", "with warm oil"), rows)
    rise = warm.temperature - warm.supply_temperature
    console.plain_console().print(
        "The rise under 'left out' is that of oil that stays as viscous as it is fed. Warm oil is thinner, "
        f"so its film makes less heat and lets more oil flow: it settles {rise:.0f} K above the supply."
    )


def print_demo(result: DemoResult) -> None:
    """Print the summary of the demonstration."""
    print_answer(result.scene.title, result.answer)
    _print_running(result)
    runs, limit, order = result.coupling.runs, result.critical_macro_angle, result.coupling.observed_order
    table = console.plain_table("two coupled FMUs, compared with rotor and film as one system")
    for heading in ("macro step", "spectral radius", "orbit error / clearance", "time"):
        table.add_column(heading, justify="right")
    table.add_column("")
    for run in runs:
        table.add_row(
            f"{math.degrees(run.macro_angle):.4g} deg",
            f"{run.spectral_radius:.5f}",
            f"{run.orbit_error:.3g}" + (" (refused)" if run.refused else ""),
            f"{run.wall_time:.2f} s",
            "too long on purpose" if run is result.refusal_run else "",
        )
    console.plain_console().print("", table)
    rows = [
        ("stability limit of the macro step", "none" if limit is None else f"{math.degrees(limit):.4g} deg")
    ]
    if result.refusal_run is not None and limit is not None:
        times = result.refusal_run.macro_angle / limit
        rows.append(("too long on purpose", f"{times:.3g} times this limit, which must be refused"))
    rows += [
        ("order of convergence", "not observed" if order is None else f"{order:.3f}"),
        ("refused", "; ".join(run.refused for run in runs if run.refused) or "no run"),
    ]
    console.print_rows("", rows)
