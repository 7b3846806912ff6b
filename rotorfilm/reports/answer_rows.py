"""What the answers of scenes say, as rows of names and texts."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.answers import QuestionAnswer, RungReport
from ..core.readable import Readable, without_round_off
from ..core.results import CircularOrbit
from ..core.units import CELSIUS

if TYPE_CHECKING:
    from ..analysis import StabilityCurve, StabilityLevelOne
    from ..bearings.damper.answer import DamperAnswer
    from ..scenes.solve_shaft import JournalAtRest, RotorAnswer

RPM = 30.0 / math.pi
"""Turns per minute in one rad/s."""


def answer_rows(answer: Readable) -> list[tuple[str, str]]:
    """Return the rows that describe an answer."""
    match type(answer).__name__:
        case "RotorAnswer":
            return rotor_rows(answer)  # type: ignore[arg-type]
        case "DamperAnswer":
            return damper_rows(answer)  # type: ignore[arg-type]
        case "QuestionAnswer":
            return question_rows(answer)  # type: ignore[arg-type]
    return answer.to_rows()


# A flexible rotor in its bearings.


def rotor_rows(answer: RotorAnswer) -> list[tuple[str, str]]:
    """Return the rows that describe a rotor: with level I of API 617 where it is a compressor."""
    from ..scenes.solve_shaft import amplitude_unit

    found, first = answer.threshold, f"at {answer.campbell.speeds[0] * RPM:.6g} rpm"
    rows = [("rotor", f"{answer.mass:.6g} kg, {answer.states} states")]
    for kind, unit, held in (
        ("load", "N", answer.loads),
        ("moment", "N m", answer.moments),
        ("axial load", "N", answer.axial_loads),
    ):
        rows += [
            (f"{kind} on {name}", f"{np.linalg.norm(one):.6g} {unit} {first}") for name, one in held.items()
        ]
    rows += [(f"rest of {name}", _rest_text(one)) for name, one in answer.journals.items()]
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
        unit = amplitude_unit(name)
        small = unit in ("m", "rad")
        size = f"{amplitude[k] * (1e6 if small else 1.0):.4g} {'u' if small else ''}{unit}"
        turned = float(np.asarray(answer.response.frequency)[k])
        if found.speed is None:
            remark = ", where the rotor is unstable" if found.reason.startswith("unstable") else ""
        else:
            remark = ", beyond the threshold" if turned > found.speed else ""
        rows.append((f"largest {name}", f"{size} at {turned * RPM:.6g} rpm{remark}"))
    rows += [] if answer.level_one is None else level_one_rows(answer.level_one)
    return rows + [("left out", remark) for remark in answer.remarks]


def _rest_text(one: JournalAtRest) -> str:
    """Return where a journal rests."""
    warm = "" if one.temperature is None else f", {one.temperature - CELSIUS:.4g} degC"
    film = (
        f"eccentricity ratio {one.eccentricity_ratio:.4g}, least film {1e6 * one.minimum_film:.4g} um{warm}"
    )
    return f"{film} at {one.speed * RPM:.6g} rpm"


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


# The answer to a question.


def question_rows(answer: QuestionAnswer) -> list[tuple[str, str]]:
    """Return the rows that describe the answer to a question."""
    verdict = "met" if answer.met else "NOT met by any model"
    verdict += f" within {answer.within}" if answer.within else ""
    share = "at most about" if chosen_report(answer).bound else "about"
    price = "cost not known" if answer.next_cost is None else seconds_text(answer.next_cost)
    above = "none" if answer.next_model is None else f"{answer.next_model}: {price}"
    return [
        (answer.quantity.replace("_", " "), f"{value_text(answer.value)} {answer.unit.removeprefix('1')}"),
        ("error", f"{share} {number_text(answer.error_estimate)}"),
        ("tolerance", f"{answer.tolerance:.3g}: {verdict}"),
        ("model", answer.model),
        ("cost", f"{seconds_text(answer.cost)}, its error {seconds_text(answer.estimate_cost)}"),
        ("all that was tried", seconds_text(answer.total_cost)),
        ("next model", above),
    ]


def chosen_report(answer: QuestionAnswer) -> RungReport:
    """Return the report of the rung that answered."""
    return next(report for report in answer.rungs if report.name == answer.model)


def value_text(value: Any, *, short: bool = False) -> str:
    """Return a number or a matrix as text; `short` the largest entry of a matrix."""
    if np.ndim(value) == 0:
        return f"{float(value):.6g}"
    if short:
        return f"max {float(np.max(np.abs(value))):.5g}"
    return "; ".join(
        "  ".join(f"{entry:.6g}" for entry in row) for row in without_round_off(np.atleast_2d(value))
    )


def number_text(value: float) -> str:
    """Return an error in two digits."""
    return f"{value:.2g}"


def seconds_text(value: float | None) -> str:
    """Return a time with its unit, in three digits at most."""
    if value is None:
        return ""
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if value >= size:
            return f"{value / size:.3g} {unit}"
    return f"{value / 1e-6:.3g} us"
