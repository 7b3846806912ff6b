"""Checks of an FMU: what `rotorfilm fmu check` and `rotorfilm fmu info` answer."""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree.ElementTree import parse

import numpy as np
from fmpy.validation import validate_fmu

from ..errors import FmuError
from ..model import Array
from .instance import Instance, Instance3, extracted, instantiated
from .replay import replay_exchange, replay_steps

REFERENCE_TOLERANCE = 1e-8
"""Largest accepted deviation from the reference, relative to the largest value of each output."""

DERIVATIVE_TOLERANCE = 1e-7
"""Largest accepted deviation of a derivative from differences, relative to the largest of its row."""

DIFFERENCE_STEP = 1e-4
"""Step of the differences in nominal values, where their errors of fourth order and of roundoff balance."""


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

    Its description by fmpy; its directional derivatives against central differences of fourth order with
    steps scaled by the nominal values; FMU states saved, restored and serialized; and the reference
    trajectory that a native FMU of this package carries, in Co-Simulation and in Model Exchange.

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
        "directional derivatives": _check_derivatives,
        "adjoint derivatives": _check_adjoint,
        "FMU state": _check_state,
        "reference, Co-Simulation": _check_steps,
        "reference, Model Exchange": _check_exchange,
    }
    with extracted(path) as (description, folder):
        subject = _Subject(str(path), description, folder, _reference(description, folder))
        return [_guarded(name, check, subject) for name, check in checks.items()]


def describe_fmu(path: str | PathLike[str]) -> dict[str, Any]:
    """Return what an FMU says of itself: version, interfaces, platforms, capabilities, variables.

    Raises
    ------
    FmuError
        If the file cannot be read.
    """
    with extracted(path) as (description, folder):
        binaries = Path(folder, "binaries")
        interfaces = _interfaces(folder)
        return {
            "fmi_version": description.fmiVersion,
            "model_name": description.modelName,
            "token": description.guid,
            "description": description.description,
            "generation_tool": description.generationTool,
            "interfaces": sorted(interfaces),
            "capabilities": sorted(set.intersection(*map(_true, interfaces.values()))) if interfaces else [],
            "platforms": sorted(p.name for p in binaries.iterdir()) if binaries.is_dir() else [],
            "variables": [_row(variable) for variable in description.modelVariables],
        }


def _interfaces(folder: str) -> dict[str, dict[str, str]]:
    """Return the attributes of each interface; fmpy 0.3 does not read all of them."""
    root = parse(Path(folder, "modelDescription.xml")).getroot()
    names = ("ModelExchange", "CoSimulation", "ScheduledExecution")
    found = {name: root.find(name) for name in names}
    return {name: dict(element.attrib) for name, element in found.items() if element is not None}


def _true(attributes: dict[str, str]) -> set[str]:
    return {name for name, value in attributes.items() if value in ("true", "1")}


def _row(variable: Any) -> dict[str, Any]:
    keys = ("name", "causality", "variability", "unit", "start", "description")
    return {key: getattr(variable, key) for key in keys}


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


def _check_derivatives(subject: _Subject) -> CheckItem:
    if not _provides(subject, "providesDirectionalDerivative", "providesDirectionalDerivatives"):
        return _absent("no directional derivatives")
    worst = _visit(subject, _derivative_error)
    return CheckItem("", worst <= DERIVATIVE_TOLERANCE, worst, "largest deviation from central differences")


def _check_adjoint(subject: _Subject) -> CheckItem:
    if not _provides(subject, "providesAdjointDerivatives"):
        return _absent("no adjoint derivatives")
    worst = _visit(subject, _adjoint_error)
    return CheckItem("", worst <= 1e-12, worst, "largest deviation from the directional derivatives")


def _check_state(subject: _Subject) -> CheckItem:
    wanted = [
        ("canGetAndSetFMUstate", "canGetAndSetFMUState"),
        ("canSerializeFMUstate", "canSerializeFMUState"),
    ]
    if subject.description.coSimulation is None or not all(_provides(subject, *names) for names in wanted):
        return _absent("no FMU states in Co-Simulation")
    first = instantiated(subject.description, subject.folder, False)
    second = instantiated(subject.description, subject.folder, False)
    try:
        count = _state_differences(subject.description, first, second)
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
    outputs = len(_references(subject.description, "output"))
    expected = subject.reference[:, -outputs:]
    found = replay(subject.description, subject.folder, subject.reference)
    nominal = [_nominal(v) for v in _variables(subject.description, "output")]
    largest = np.abs(expected).max(axis=0)
    worst = float(np.max(np.abs(found - expected) / np.where(largest > 0.0, largest, nominal), initial=0.0))
    return CheckItem("", worst <= REFERENCE_TOLERANCE, worst, "largest deviation from the trajectory inside")


def _visit(subject: _Subject, measure: Callable[[Any, Instance, Array], float]) -> float:
    """Return the largest of a measure over some states of the FMU, in Model Exchange if it has it."""
    exchange = subject.description.modelExchange is not None
    inputs = len(_references(subject.description, "input"))
    rows = np.array([_starts(subject.description, "input")])
    if subject.reference is not None:
        rows = subject.reference[:: max(1, len(subject.reference) // 8), 1 : 1 + inputs]
    instance = instantiated(subject.description, subject.folder, exchange)
    try:
        instance.initialize(_references(subject.description, "input"), rows[0].tolist())
        return max(measure(subject.description, instance, row) for row in rows)
    finally:
        instance.close()


def _derivative_error(description: Any, instance: Instance, inputs: Array) -> float:
    unknowns, knowns, nominal = _unknowns(description), _knowns(description), _known_nominals(description)
    instance.set(_references(description, "input"), inputs.tolist())
    exact, values = _columns(instance, unknowns, knowns), np.abs(instance.get(unknowns))
    moved = np.stack(
        [
            _difference(description, instance, k, DIFFERENCE_STEP * nominal[k], inputs)
            for k in range(len(knowns))
        ],
        axis=1,
    )
    instance.set(_references(description, "input"), inputs.tolist())
    # What does not depend on anything has differences of roundoff, to be seen beside its value.
    return _deviation(exact * nominal, moved * nominal, DIFFERENCE_STEP * values)


def _adjoint_error(description: Any, instance: Instance, inputs: Array) -> float:
    assert isinstance(instance, Instance3)
    unknowns, knowns, nominal = _unknowns(description), _knowns(description), _known_nominals(description)
    instance.set(_references(description, "input"), inputs.tolist())
    exact = _columns(instance, unknowns, knowns)
    rows = np.array([instance.adjoint([unknown], knowns, [1.0]) for unknown in unknowns])
    return _deviation(exact * nominal, rows * nominal, np.zeros(len(unknowns)))


def _deviation(exact: Array, other: Array, floor: Array) -> float:
    """Return the largest deviation relative to the largest entry of its row, or its floor."""
    scale = np.maximum(np.abs(exact).max(axis=1, initial=0.0), floor)
    largest = np.abs(other - exact).max(axis=1, initial=0.0)
    return float(np.max(largest / np.where(scale > 0.0, scale, 1.0), initial=0.0))


def _columns(instance: Instance, unknowns: Sequence[int], knowns: Sequence[int]) -> Array:
    return np.stack([instance.directional(unknowns, [known], [1.0]) for known in knowns], axis=1)


def _difference(description: Any, instance: Instance, known: int, step: float, inputs: Array) -> Array:
    """Return the derivative by one known from central differences of fourth order."""
    weights = {-2.0: 1.0, -1.0: -8.0, 1.0: 8.0, 2.0: -1.0}
    states = _starts(description, "local")
    total = np.zeros(len(_unknowns(description)))
    for shift, weight in weights.items():
        shifted = np.concatenate([inputs, states])
        shifted[known] += shift * step
        instance.set(_references(description, "input"), shifted[: len(inputs)].tolist())
        if description.modelExchange is not None:
            instance.move(0.0, shifted[len(inputs) :])
        total += weight * np.array(instance.get(_unknowns(description)))
    if description.modelExchange is not None:
        instance.move(0.0, np.array(states))
    return total / (12.0 * step)


def _state_differences(description: Any, first: Instance, second: Instance) -> int:
    """Return how many values differ between a run, the same run restored, and it in another instance."""
    everything = [v.valueReference for v in _reals(description) if v.causality != "independent"]
    experiment = description.defaultExperiment
    step = float(getattr(experiment, "stepSize", None) or 1e-3)
    first.initialize([], [])
    second.initialize([], [])
    for k in range(3):
        first.step(k * step, step)
    saved = first.save()
    content = first.serialize(saved)
    runs = [_advanced(first, everything, step)]
    first.restore(saved)
    runs.append(_advanced(first, everything, step))
    first.release(saved)
    copied = second.deserialize(content)
    second.restore(copied)
    second.release(copied)
    runs.append(_advanced(second, everything, step))
    return sum(a != b for run in runs[1:] for a, b in zip(runs[0], run, strict=True))


def _advanced(instance: Instance, references: Sequence[int], step: float) -> list[float]:
    for k in range(3, 6):
        instance.step(k * step, step)
    return instance.get(references)


def _absent(remark: str) -> CheckItem:
    return CheckItem("", None, None, remark)


def _provides(subject: _Subject, *names: str) -> bool:
    """Return whether every interface has a capability, spelled one way or the other."""
    interfaces = _interfaces(subject.folder)
    return bool(interfaces) and all(_true(attributes) & set(names) for attributes in interfaces.values())


def _variables(description: Any, causality: str) -> list[Any]:
    """Return the real variables of a causality; of "local" the continuous states in Model Exchange."""
    if causality == "local":
        slopes = [unknown.variable for unknown in description.derivatives]
        return [slope.derivative for slope in slopes] if description.modelExchange is not None else []
    return [v for v in _reals(description) if v.causality == causality]


def _reals(description: Any) -> list[Any]:
    return [v for v in description.modelVariables if v.type in ("Real", "Float64")]


def _references(description: Any, causality: str) -> list[int]:
    return [variable.valueReference for variable in _variables(description, causality)]


def _starts(description: Any, causality: str) -> Array:
    return np.array([float(variable.start or 0.0) for variable in _variables(description, causality)])


def _nominal(variable: Any) -> float:
    return abs(float(variable.nominal or 1.0)) or 1.0


def _knowns(description: Any) -> list[int]:
    return [*_references(description, "input"), *_references(description, "local")]


def _known_nominals(description: Any) -> Array:
    known = [*_variables(description, "input"), *_variables(description, "local")]
    return np.array([_nominal(variable) for variable in known])


def _unknowns(description: Any) -> list[int]:
    slopes = description.derivatives if description.modelExchange is not None else []
    return [*_references(description, "output"), *(u.variable.valueReference for u in slopes)]


def _reference(description: Any, folder: str) -> Array | None:
    """Return the reference trajectory in the FMU, if it has one whose columns are its signals."""
    path = Path(folder, "documentation", "reference.csv")
    if not path.is_file():
        return None
    with path.open(newline="", encoding="utf-8") as file:
        header = next(csv.reader(file))
        table = np.loadtxt(file, delimiter=",", ndmin=2)
    signals = [*_variables(description, "input"), *_variables(description, "output")]
    if header != ["time", *(variable.name for variable in signals)]:
        raise FmuError(f"reference.csv must have the columns time, inputs, outputs, got {header}")
    return table
