"""How the answer of a scene is printed, and written with what pictures and tables it has."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.answers import QuestionAnswer, RungReport
from ..core.frames import write_csv
from ..core.readable import Readable, without_round_off
from ..core.results import CircularOrbit, to_plain
from . import printing as console

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from ..analysis import StabilityCurve, StabilityLevelOne
    from ..scenes.solve_damper import DamperAnswer
    from ..scenes.solve_shaft import RotorAnswer

RPM = 30.0 / math.pi
"""Turns per minute in one rad/s."""


def print_answer(title: str, answer: Any) -> None:
    """Print what a scene answers."""
    console.print_rows(title, answer_rows(answer))


def answer_rows(answer: Readable) -> list[tuple[str, str]]:
    """Return the rows that describe an answer."""
    match type(answer).__name__:
        case "RotorAnswer":
            return rotor_rows(answer)  # type: ignore[arg-type]
        case "DamperAnswer":
            return damper_rows(answer)  # type: ignore[arg-type]
    return answer.to_rows()


def plain_answer(answer: Any) -> Any:
    """Return an answer as JSON has it."""
    return plain_rotor(answer) if type(answer).__name__ == "RotorAnswer" else to_plain(answer)


def write_answer(answer: Any, folder: Path) -> None:
    """Write an answer as JSON, its pictures and its tables into a folder, which is made if need be."""
    from ..core.files import written_together

    with written_together(folder) as part:
        console.write_json(part / "answer.json", plain_answer(answer))
        match type(answer).__name__:
            case "RotorAnswer":
                write_rotor(answer, part)
            case "DamperAnswer":
                write_damper(answer, part)


# A flexible rotor in its bearings.


def rotor_rows(answer: RotorAnswer) -> list[tuple[str, str]]:
    """Return the rows that describe a rotor: with level I of API 617 where it is a compressor."""
    found = answer.threshold
    rows = [("rotor", f"{answer.mass:.6g} kg, {answer.states} states")]
    rows += [(f"load on {name}", f"{np.hypot(*load):.6g} N") for name, load in answer.loads.items()]
    rows += [
        (
            "critical speed",
            f"{one.speed * RPM:.6g} rpm, {one.whirl}, log decrement {one.log_decrement:.4g}",
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
    rows += [] if answer.level_one is None else level_one_rows(answer.level_one)
    return rows + [("left out", remark) for remark in answer.remarks]


def level_one_rows(found: StabilityLevelOne) -> list[tuple[str, str]]:
    """Return the rows that describe an analysis of level I of API 617."""
    each, density = found.stage_cross_coupling, found.average_density
    least = min(found.curves, key=lambda curve: curve.anticipated_decrement)
    zero = min(found.curves, key=lambda curve: curve.zero_cross_coupling)
    rows = [
        ("API 617, level I", found.verdict),
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
        "level_one": to_plain(answer.level_one),
        "remarks": list(answer.remarks),
    }


def _without_nan(table: np.ndarray) -> list[list[float | None]]:
    return [[None if math.isnan(entry) else entry for entry in row] for row in table.tolist()]


def write_rotor(answer: RotorAnswer, folder: Path) -> None:
    """Write the pictures and tables of a rotor."""
    from ..charts import plot_campbell, plot_log_decrement, plot_unbalance_response, save
    from ..scenes.solve_shaft import campbell_columns, response_columns

    save(plot_campbell(answer.campbell, critical=answer.critical_speeds), folder / "campbell.png")
    save(plot_log_decrement(answer.campbell), folder / "log_decrement.png")
    write_csv(folder / "campbell.csv", campbell_columns(answer))
    if answer.response is not None:
        save(plot_unbalance_response(answer.response), folder / "unbalance_response.png")
        write_csv(folder / "unbalance_response.csv", response_columns(answer))
    if answer.level_one is not None:
        write_level_one(answer.level_one, folder)


def write_level_one(found: StabilityLevelOne, folder: Path) -> None:
    """Write chart and curves of an analysis of level I."""
    from ..charts import plot_stability_level_one, save

    columns: dict[str, Any] = {}
    for curve in found.curves:
        columns[f"{curve.name} cross-coupling [N/m]"] = curve.cross_coupling.tolist()
        columns[f"{curve.name} log decrement [1]"] = curve.log_decrement.tolist()
        columns[f"{curve.name} frequency [rad/s]"] = curve.frequency.tolist()
    save(plot_stability_level_one(found), folder / "stability_level_one.png")
    write_csv(folder / "stability_level_one.csv", columns)


# A rotor on a squeeze-film damper.


def damper_rows(answer: DamperAnswer) -> list[tuple[str, str]]:
    """Return the rows that describe a rotor on a damper."""
    groups, small = answer.groups, answer.small_motion
    folds = ", ".join(
        f"{'up' if fold.upward else 'down'} at {_mass(fold.unbalance)}" for fold in answer.folds
    )
    contact = "none" if answer.contact_unbalance is None else f"from {_mass(answer.contact_unbalance)} on"
    return [
        (
            "squeeze number Bs, permeability number",
            f"{groups.squeeze_number:.5g}, {groups.permeability_number:.5g}",
        ),
        ("spring ratio, unbalance ratio", f"{groups.spring_ratio:.5g}, {groups.unbalance_ratio:.5g}"),
        ("K, C of an orbit of clearance/100", f"{small.stiffness:.6g} N/m, {small.damping:.6g} N s/m"),
        *[("orbit", _orbit(orbit)) for orbit in answer.orbits],
        *([] if answer.orbits else [("orbit", "none: the rotor hits the wall")]),
        ("jumps", folds or "none"),
        ("contact", contact),
    ]


def _orbit(orbit: CircularOrbit) -> str:
    return (
        f"eccentricity ratio {orbit.eccentricity_ratio:.5f}, lag {-math.degrees(orbit.phase):.4g} deg, "
        f"transmissibility {orbit.transmissibility:.5g}, {'stable' if orbit.stable else 'unstable'}"
    )


def _mass(unbalance: float) -> str:
    return f"{unbalance * 1e6:.5g} g mm"


def write_damper(answer: DamperAnswer, folder: Path) -> None:
    """Write the picture of transmissibility over unbalance."""
    from ..charts import plot_transmissibility, save

    picture = plot_transmissibility({"damper": answer.response}, unit=answer.unbalance_scale)
    save(picture, folder / "transmissibility.png")


# The answer to a question: the value, and the ladder that led to it.


STYLES = {"chosen": "bold green", "refused": "yellow"}
"""How verdicts are shown; others are dim."""


WIDE = 160
"""Columns of a print-out that is not on a screen."""


def print_question(title: str, answer: QuestionAnswer, *, explain: bool) -> None:
    """Print the answer to a question, and with `explain` the whole ladder."""
    table = console.filled(console.plain_table(title, show_header=False), _summary(answer))
    # A file or a pipe has no width that tables must fit.
    screen = console.plain_console() if sys.stdout.isatty() else console.plain_console(width=WIDE)
    screen.print(table)
    if explain:
        screen.print("", _ladder(answer))
        _print_reasons(screen, answer)
    if answer.assumptions:
        rows = [("", line) for line in answer.assumptions]
        screen.print(
            "", console.filled(console.plain_table("assumed, as nobody gave it", show_header=False), rows)
        )


def _summary(answer: QuestionAnswer) -> list[tuple[str, str]]:
    verdict = "met" if answer.met else "NOT met by any model"
    verdict += f" within {answer.within}" if answer.within else ""
    share = "at most about" if chosen_report(answer).bound else "about"
    price = "cost not known" if answer.next_cost is None else _seconds(answer.next_cost)
    above = "none" if answer.next_model is None else f"{answer.next_model}: {price}"
    return [
        (answer.quantity.replace("_", " "), f"{_value(answer.value)} {answer.unit.removeprefix('1')}"),
        ("error", f"{share} {_number(answer.error_estimate)}"),
        ("tolerance", f"{answer.tolerance:.3g}: {verdict}"),
        ("model", answer.model),
        ("cost", f"{_seconds(answer.cost)}, its error {_seconds(answer.estimate_cost)}"),
        ("all that was tried", _seconds(answer.total_cost)),
        ("next model", above),
    ]


def chosen_report(answer: QuestionAnswer) -> RungReport:
    """Return the report of the rung that answered."""
    return next(report for report in answer.rungs if report.name == answer.model)


def _ladder(answer: QuestionAnswer) -> Table:
    from rich.text import Text

    table = console.plain_table("the ladder, the cheapest model first")
    table.add_column("rung", overflow="fold")
    table.add_column("", no_wrap=True)
    for heading in ("value", "error", "cost", "of error"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("error known by", overflow="fold")
    for report in answer.rungs:
        error = "" if report.error_estimate is None else _number(report.error_estimate)
        table.add_row(
            report.name,
            Text(report.verdict, style=STYLES.get(report.verdict, "dim")),
            "" if report.value is None else _value(report.value, short=True),
            ("<~ " if report.bound else "") + error,
            _seconds(report.cost),
            _seconds(report.estimate_cost),
            report.method,
            style="" if report.verdict in ("chosen", "refused") else "dim",
        )
    return table


def _print_reasons(screen: Console, answer: QuestionAnswer) -> None:
    reasons = [(report.name, report.reason) for report in answer.rungs if report.reason]
    if not reasons:
        return
    table = console.plain_table("why not", show_header=False)
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    screen.print("", console.filled(table, reasons))


def _value(value: Any, *, short: bool = False) -> str:
    if np.ndim(value) == 0:
        return f"{float(value):.6g}"
    if short:
        return f"max {float(np.max(np.abs(value))):.5g}"
    return "; ".join(
        "  ".join(f"{entry:.6g}" for entry in row) for row in without_round_off(np.atleast_2d(value))
    )


def _number(value: float) -> str:
    return f"{value:.2g}"


def _seconds(value: float | None) -> str:
    """Return a time with its unit, in three digits at most."""
    if value is None:
        return ""
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if value >= size:
            return f"{value / size:.3g} {unit}"
    return f"{value / 1e-6:.3g} us"
