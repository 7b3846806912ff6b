"""The commands `rotorfilm rotor` and `rotorfilm rotor-run`: a rotor in its bearings, from a scene file."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from ..core.progress import Report
from ..core.results import to_plain, write_csv
from . import printing as console
from .command import Argument, Option, Said, SignalFile, inside, make_room, written_rows
from .solve_command import remark_rows

if TYPE_CHECKING:
    from ..analysis import StabilityCurve, StabilityLevelOne
    from ..scenes.rotor_runs import RotorRun
    from ..scenes.solve_shaft import RotorAnswer

RPM = 30.0 / math.pi
"""Turns per minute in one rad/s."""


def rotor(
    scene: Annotated[Path, Argument(help="Scene file with a table shaft.", metavar="SCENE.toml")],
    report: Report,
    out: Annotated[
        Path | None, Option(help="Folder for pictures (PNG), tables (CSV) and the answer (JSON).")
    ] = None,
) -> Said:
    """Find critical speeds, whirl modes, the threshold of stability and the unbalance response of a rotor."""
    from ..scenes import Scene
    from ..scenes.solve_shaft import solve_rotor

    loaded = Scene.load(scene)
    with inside(scene):
        answer = solve_rotor(loaded, report)
    if out is not None:
        write_rotor(answer, out)
    return Said(plain_rotor(answer), partial(console.print_rows, answer.title, rotor_rows(answer)))


def stability_level_one(
    scene: Annotated[Path, Argument(help="Scene file with a table shaft.compressor.", metavar="SCENE.toml")],
    out: Annotated[
        Path | None, Option(help="Folder for the chart (PNG), the curves (CSV) and the result (JSON).")
    ] = None,
) -> Said:
    """Screen the stability of a compressor by API 617, level I: log decrement over applied cross-coupling."""
    from ..scenes import Scene
    from ..scenes.solve_shaft import level_one_remarks, solve_level_one

    given = Scene.load(scene)
    with inside(scene):
        found, remarks = solve_level_one(given), level_one_remarks(given)
    plain = {**to_plain(found), "remarks": list(remarks)}
    if out is not None:
        write_level_one(found, plain, out)
    rows = level_one_rows(found) + remark_rows(remarks)
    return Said(plain, partial(console.print_rows, given.title, rows))


def level_one_rows(found: StabilityLevelOne) -> list[tuple[str, str]]:
    """Return the rows that describe an analysis."""
    each, density = found.stage_cross_coupling, found.average_density
    least = min(found.curves, key=lambda curve: curve.anticipated_decrement)
    zero = min(found.curves, key=lambda curve: curve.zero_cross_coupling)
    rows = [
        ("verdict", found.verdict),
        ("speed", f"{found.speed * RPM:.6g} rpm"),
        (
            "anticipated QA",
            f"{found.anticipated_cross_coupling:.4g} N/m of {len(each)} stage{'s' * (len(each) > 1)}",
        ),
        ("acts at", ", ".join(f"node {node} ({100.0 * part:.3g} %)" for node, part in found.nodes.items())),
        ("decrement of zero at Q0", _neutral(zero)),
        ("margin Q0/QA", f"{found.margin:.4g}"),
        ("least log decrement with QA", f"{found.anticipated_decrement:.4g} ({least.name})"),
        ("critical speed ratio", f"{found.critical_speed_ratio:.4g}"),
    ]
    if density is not None:
        rows.append(("average density", f"{density:.4g} kg/m3"))
    return rows + [(f"log decrement, {curve.name}", _course(curve)) for curve in found.curves]


def _neutral(curve: StabilityCurve) -> str:
    if math.isinf(curve.zero_cross_coupling):
        return "none found"
    return f"{curve.zero_cross_coupling:.4g} N/m ({curve.name})"


def _course(curve: StabilityCurve) -> str:
    """Return how a log decrement goes, from the first to the last cross-coupling."""
    first, last = curve.log_decrement[0], curve.log_decrement[-1]
    way = "rising" if last > first else "falling"
    return f"from {first:.4g} without to {last:.4g} at {curve.cross_coupling[-1]:.4g} N/m ({way})"


def write_level_one(found: StabilityLevelOne, plain: dict[str, Any], folder: Path) -> None:
    """Write chart, curves and JSON of an analysis into a folder, which is made if need be."""
    from ..charts import plot_stability_level_one, save
    from ..core.files import written_together

    columns: dict[str, Any] = {}
    for curve in found.curves:
        columns[f"{curve.name} cross-coupling [N/m]"] = curve.cross_coupling.tolist()
        columns[f"{curve.name} log decrement [1]"] = curve.log_decrement.tolist()
        columns[f"{curve.name} frequency [rad/s]"] = curve.frequency.tolist()
    with written_together(folder) as part:
        save(plot_stability_level_one(found)[0], part / "stability_level_one.png")
        write_csv(part / "stability_level_one.csv", columns)
        console.write_json(part / "stability_level_one.json", plain)


def rotor_rows(answer: RotorAnswer) -> list[tuple[str, str]]:
    """Return the rows that describe an answer."""
    found = answer.threshold
    rows = [("rotor", f"{answer.mass:.6g} kg, {answer.states} states")]
    rows += [(f"load on {name}", f"{np.hypot(*load):.6g} N") for name, load in answer.loads.items()]
    rows += [
        (
            "critical speed",
            f"{one.speed * RPM:.6g} rpm, {_sense(one.direction)}, log decrement {one.log_decrement:.4g}",
        )
        for one in answer.critical_speeds
    ]
    if found.speed is None:
        rows.append(("threshold of stability", found.reason))
    else:
        ratio = found.whirl_ratio
        how = f"whirl at {ratio:.4g} of the speed" if ratio else "divergence, without whirl"
        rows.append(("threshold of stability", f"{found.speed * RPM:.6g} rpm, {how}"))
    for name, amplitude in answer.amplitudes.items():
        assert answer.response is not None  # or there are no amplitudes
        k = int(np.argmax(amplitude))
        size = f"{amplitude[k]:.4g} N" if "_force_" in name else f"{amplitude[k] * 1e6:.4g} um"
        turned = float(np.asarray(answer.response.frequency)[k])
        beyond = found.speed is not None and turned > found.speed
        remark = ", beyond the threshold" if beyond else ""
        rows.append((f"largest {name}", f"{size} at {turned * RPM:.6g} rpm{remark}"))
    return rows + remark_rows(answer.remarks)


def plain_rotor(answer: RotorAnswer) -> dict[str, Any]:
    """Return an answer as plain lists and numbers; nothing where a mode is overdamped."""
    chart = answer.campbell
    return {
        "title": answer.title,
        "mass": answer.mass,
        "states": answer.states,
        "loads": to_plain(dict(answer.loads)),
        "residual": answer.residual,
        "critical_speeds": to_plain(list(answer.critical_speeds)),
        "threshold": to_plain(answer.threshold),
        "campbell": {
            "speeds": chart.speeds.tolist(),
            "frequency": _without_nan(chart.frequency),
            "log_decrement": _without_nan(chart.log_decrement),
            "direction": _without_nan(chart.direction),
        },
        "response_speeds": [] if answer.response is None else np.asarray(answer.response.frequency).tolist(),
        "amplitudes": to_plain(dict(answer.amplitudes)),
        "remarks": list(answer.remarks),
    }


def write_rotor(answer: RotorAnswer, folder: Path) -> None:
    """Write the pictures, tables and the JSON of an answer into a folder, which is made if need be."""
    from ..charts import plot_campbell, plot_log_decrement, plot_unbalance_response, save
    from ..core.files import written_together
    from ..scenes.solve_shaft import campbell_columns, response_columns

    with written_together(folder) as part:
        save(plot_campbell(answer.campbell, critical=answer.critical_speeds), part / "campbell.png")
        save(plot_log_decrement(answer.campbell), part / "log_decrement.png")
        write_csv(part / "campbell.csv", campbell_columns(answer))
        if answer.response is not None:
            above, _ = plot_unbalance_response(answer.response)
            save(above, part / "unbalance_response.png")
            write_csv(part / "unbalance_response.csv", response_columns(answer))
        console.write_json(part / "rotor.json", plain_rotor(answer))


def _sense(direction: float) -> str:
    if abs(direction) <= 0.1:
        return "to and fro"
    return "forward" if direction > 0.0 else "backward"


def _without_nan(table: np.ndarray) -> list[list[float | None]]:
    return [[None if math.isnan(entry) else entry for entry in row] for row in table.tolist()]


def rotor_run(
    scene: Annotated[
        Path, Argument(help="Scene file with a shaft, or a rigid rotor on a film.", metavar="SCENE.toml")
    ],
    report: Report,
    out: SignalFile = None,
) -> Said:
    """Follow a rotor on its films over time: a run-up, a motor in place of its speed, ground that shakes.

    Where a journal reaches the wall the motion until then is shown and written, and the command exits with 1.
    """
    from ..scenes import Scene
    from ..scenes.rotor_runs import run_rotor

    loaded = Scene.load(scene)
    make_room(out)
    with inside(scene):
        run = run_rotor(loaded, report)
    if out is not None:
        write_csv(out, {"time": run.trajectory.time, **run.trajectory.signals})
    failure = None
    if run.contact_time is not None:
        failure = f"a journal reached the wall at {run.contact_time:.6g} s; what is shown ends there"
    rows = rotor_run_rows(run) + written_rows(out)
    return Said(plain_rotor_run(run), partial(console.print_rows, loaded.title, rows), failure)


def plain_rotor_run(run: RotorRun) -> dict[str, Any]:
    """Return a run as plain numbers."""
    return {
        "peaks": dict(run.peaks),
        "at_rest": dict(run.at_rest),
        "vibrations": dict(run.vibrations),
        "vibration_speeds": dict(run.vibration_speeds),
        "end_speed": run.end_speed,
        "contact_time": run.contact_time,
        "end": float(run.trajectory.time[-1]),
        "work": dict(run.trajectory.work),
    }


def rotor_run_rows(run: RotorRun) -> list[tuple[str, str]]:
    """Return the rows that describe a run."""
    calls = ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in run.trajectory.work.items())
    return [
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
        ("contact", "none" if run.contact_time is None else f"at {run.contact_time:.6g} s"),
        ("work", calls),
    ]
