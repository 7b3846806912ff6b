"""Checks of an FMU: what `rotorfilm fmu check` answers."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from fmpy.validation import validate_fmu

from ...errors import FmuError, brief
from ...files import read_text
from ...model import Array
from ..binaries import libraries, require_whole
from .calls import Instance
from .described import (
    ADJOINT_DERIVATIVES,
    DERIVATIVES,
    SERIAL_STATES,
    STATES,
    nominal_of,
    provides,
    references_of,
    starts_of,
    variables_of,
)
from .instance import extracted, instantiated
from .measure import adjoint_error, derivative_error, state_differences
from .replay import replay_exchange, replay_steps

REFERENCE_TOLERANCE = 1e-8
"""Largest accepted deviation from the reference, relative to the largest value of each output."""

DERIVATIVE_TOLERANCE = 1e-7
"""Largest accepted deviation of a derivative from differences, relative to the largest of its row."""


class CheckItem(NamedTuple):
    """The outcome of one check.

    Attributes
    ----------
    check : str
        What was checked.
    passed : bool or None
        None where the FMU does not have what would be checked.
    figure : float or None
        What was measured.
    remark : str
        What the figure is, or why there is none.
    """

    check: str
    passed: bool | None
    figure: float | None
    remark: str


class _Subject(NamedTuple):
    """An FMU on its way through the checks: fmpy's description, its files, its reference trajectory."""

    path: str
    description: Any
    folder: str
    reference: Array | None


def check_fmu(path: str | PathLike[str]) -> list[CheckItem]:
    """Check an FMU of FMI 2.0 or 3.0.

    Its description by fmpy; whether its libraries, for all platforms, are whole; its directional derivatives
    against central differences of fourth order with steps scaled by the nominal values; FMU states saved,
    restored and serialized; and the reference trajectory that a native FMU of this package carries, in
    Co-Simulation and in Model Exchange.

    Parameters
    ----------
    path : path of the .fmu file

    Returns
    -------
    list of CheckItem

    Raises
    ------
    FmuError
        If the file cannot be read.
    """
    checks: dict[str, Callable[[_Subject], CheckItem]] = {
        "description": _check_description,
        "libraries": _check_libraries,
        "directional derivatives": _check_derivatives,
        "adjoint derivatives": _check_adjoint,
        "FMU state": _check_state,
        "reference, Co-Simulation": _check_steps,
        "reference, Model Exchange": _check_exchange,
    }
    with extracted(path) as (description, folder):
        subject = _Subject(str(path), description, folder, _reference(description, folder))
        return [_guarded(name, check, subject) for name, check in checks.items()]


def _guarded(name: str, check: Callable[[_Subject], CheckItem], subject: _Subject) -> CheckItem:
    try:
        return check(subject)._replace(check=name)
    except Exception as error:
        # An FMU may fail in any way; that is the outcome.
        return CheckItem(name, False, None, " ".join(f"{type(error).__name__}: {error}".split()))


def _check_description(subject: _Subject) -> CheckItem:
    problems = validate_fmu(subject.path)
    remark = "; ".join(problems) if problems else "problems found by fmpy"
    return CheckItem("", not problems, float(len(problems)), remark)


def _check_libraries(subject: _Subject) -> CheckItem:
    found = libraries(subject.folder)
    for path in found:
        require_whole(path)
    if not found:
        return _absent("no compiled library")
    return CheckItem("", True, float(len(found)), "as long as their headers say")


def _check_derivatives(subject: _Subject) -> CheckItem:
    if not provides(subject.folder, DERIVATIVES):
        return _absent("no directional derivatives")
    worst = _visit(subject, derivative_error)
    return CheckItem("", worst <= DERIVATIVE_TOLERANCE, worst, "largest deviation from central differences")


def _check_adjoint(subject: _Subject) -> CheckItem:
    if not provides(subject.folder, ADJOINT_DERIVATIVES):
        return _absent("no adjoint derivatives")
    worst = _visit(subject, adjoint_error)
    return CheckItem("", worst <= 1e-12, worst, "largest deviation from the directional derivatives")


def _check_state(subject: _Subject) -> CheckItem:
    if subject.description.coSimulation is None or not provides(subject.folder, STATES, SERIAL_STATES):
        return _absent("no FMU states in Co-Simulation")
    first = instantiated(subject.description, subject.folder, False)
    second = instantiated(subject.description, subject.folder, False)
    try:
        count = state_differences(subject.description, first, second)
    finally:
        first.close()
        second.close()
    return CheckItem("", count == 0, float(count), "values that differ after restoring and after serializing")


def _check_steps(subject: _Subject) -> CheckItem:
    return _replayed(subject, replay_steps, subject.description.coSimulation)


def _check_exchange(subject: _Subject) -> CheckItem:
    return _replayed(subject, replay_exchange, subject.description.modelExchange)


def _replayed(subject: _Subject, replay: Callable[..., Array], interface: Any) -> CheckItem:
    if interface is None or subject.reference is None:
        return _absent("no such interface" if interface is None else "no reference trajectory in the FMU")
    outputs = len(references_of(subject.description, "output"))
    expected = subject.reference[:, -outputs:]
    found = replay(subject.description, subject.folder, subject.reference)
    nominal = [nominal_of(v) for v in variables_of(subject.description, "output")]
    largest = np.abs(expected).max(axis=0)
    worst = float(np.max(np.abs(found - expected) / np.where(largest > 0.0, largest, nominal), initial=0.0))
    return CheckItem("", worst <= REFERENCE_TOLERANCE, worst, "largest deviation from the trajectory inside")


def _visit(subject: _Subject, measure: Callable[[Any, Instance, Array], float]) -> float:
    """Return the largest of a measure over some states of the FMU, in Model Exchange if it has it."""
    exchange = subject.description.modelExchange is not None
    inputs = len(references_of(subject.description, "input"))
    rows = np.array([starts_of(subject.description, "input")])
    if subject.reference is not None:
        rows = subject.reference[:: max(1, len(subject.reference) // 8), 1 : 1 + inputs]
    instance = instantiated(subject.description, subject.folder, exchange)
    try:
        instance.initialize(references_of(subject.description, "input"), rows[0].tolist())
        return max(measure(subject.description, instance, row) for row in rows)
    finally:
        instance.close()


def _absent(remark: str) -> CheckItem:
    return CheckItem("", None, None, remark)


def _reference(description: Any, folder: str) -> Array | None:
    """Return the reference trajectory in the FMU, if it has one whose columns are its signals."""
    path = Path(folder, "documentation", "reference.csv")
    if not path.is_file():
        return None
    try:
        header, *rows = csv.reader(io.StringIO(read_text(path), newline=""))
        table = np.array([[float(cell) for cell in row] for row in rows])
    except (ValueError, csv.Error) as error:
        raise FmuError(f"reference.csv must be names and rows of numbers below them, got {error}") from None
    signals = [*variables_of(description, "input"), *variables_of(description, "output")]
    if header != ["time", *(variable.name for variable in signals)]:
        raise FmuError(f"reference.csv must have the columns time, inputs, outputs, got {brief(header)}")
    if table.shape != (len(rows), len(header)) or not rows or not np.isfinite(table).all():
        raise FmuError(
            f"reference.csv must have rows of {len(header)} finite numbers, got shape {table.shape}"
        )
    return table
