"""Checks of an FMU: what `rotorfilm fmu check` answers."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from contextlib import closing
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from scipy.integrate import DOP853

from ..core.errors import FmuError, brief
from ..core.files import read_text
from ..core.model import Array
from . import instance as fmus
from .layered import FOLDER, missing_references
from .native.platforms import libraries, require_complete_file
from .reference import TOLERANCE

REFERENCE_TOLERANCE = 1e-8
"""Largest accepted deviation from the reference, relative to the largest value of each output."""

HARDLY_MOVED = 1e-3
"""Part of its nominal value below which the largest value of an output is no scale of its deviation.

`REFERENCE_TOLERANCE` of it is ten times `STEP_TOLERANCE`, to which a trajectory is integrated.
"""

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


Outcome = tuple[bool | None, float | None, str]
"""Whether a check passed, what was measured, and a remark; see `CheckItem`."""


def check_fmu(path: str | PathLike[str]) -> list[CheckItem]:
    """Check an FMU of FMI 2.0 or 3.0.

    The checks are its description by fmpy, and whether its libraries for all platforms are whole. Its
    directional derivatives are compared with central differences of fourth order, with steps scaled by the
    nominal values. FMU states are saved, restored and serialized. The files that a manifest of FMI-LS-REF
    names must be there. A native FMU of this package also repeats its reference trajectory, in
    Co-Simulation and in Model Exchange, within 1e-8 of the largest value of each output, or of a thousandth
    of its nominal value where it hardly moves.

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
    with fmus.extracted(path) as (description, folder):
        of = description, folder, _reference(description, folder)
        checks: dict[str, Callable[[], Outcome]] = {
            "description": lambda: _check_description(str(path)),
            "libraries": lambda: _check_libraries(folder),
            "related files": lambda: _check_references(description, folder),
            "directional derivatives": lambda: _check_derivatives(*of),
            "adjoint derivatives": lambda: _check_adjoint(*of),
            "FMU state": lambda: _check_state(description, folder),
            "reference, Co-Simulation": lambda: _replayed(*of, replay_steps, description.coSimulation),
            "reference, Model Exchange": lambda: _replayed(*of, replay_exchange, description.modelExchange),
        }
        return [CheckItem(name, *_guarded(check)) for name, check in checks.items()]


def _guarded(check: Callable[[], Outcome]) -> Outcome:
    try:
        return check()
    except Exception as error:
        # An FMU may fail in any way; that is the outcome.
        return False, None, " ".join(f"{type(error).__name__}: {error}".split())


def _check_description(path: str) -> Outcome:
    problems = validate_fmu(path)
    remark = "; ".join(problems) if problems else "problems found by fmpy"
    return not problems, float(len(problems)), remark


def _check_libraries(folder: str) -> Outcome:
    found = libraries(folder)
    for path in found:
        require_complete_file(path)
    if not found:
        return None, None, "no compiled library"
    return True, float(len(found)), "as long as their headers say"


def _check_references(description: Any, folder: str) -> Outcome:
    """Return whether the files of FMI-LS-REF are there, and its saved state is one of this FMU."""
    missing = missing_references(folder)
    if missing is None:
        return None, None, "no files of FMI-LS-REF"
    state = Path(folder, FOLDER, "warm_state.bin")
    if state.is_file() and not missing:
        with closing(fmus.instantiated(description, folder, False)) as instance:
            instance.initialize([], [])
            saved = instance.deserialize(state.read_bytes())
            instance.restore(saved)
            instance.release(saved)
    return not missing, float(len(missing)), "files of the manifest that are missing"


def _check_derivatives(description: Any, folder: str, reference: Array | None) -> Outcome:
    if not fmus.provides(folder, fmus.DERIVATIVES):
        return None, None, "no directional derivatives"
    worst = _visit(description, folder, reference, derivative_error)
    return worst <= DERIVATIVE_TOLERANCE, worst, "largest deviation from central differences"


def _check_adjoint(description: Any, folder: str, reference: Array | None) -> Outcome:
    if not fmus.provides(folder, fmus.ADJOINT_DERIVATIVES):
        return None, None, "no adjoint derivatives"
    worst = _visit(description, folder, reference, adjoint_error)
    return worst <= 1e-12, worst, "largest deviation from the directional derivatives"


def _check_state(description: Any, folder: str) -> Outcome:
    if description.coSimulation is None or not fmus.provides(folder, fmus.STATES, fmus.SERIAL_STATES):
        return None, None, "no FMU states in Co-Simulation"
    with (
        closing(fmus.instantiated(description, folder, False)) as first,
        closing(fmus.instantiated(description, folder, False)) as second,
    ):
        count = state_differences(description, first, second)
    return count == 0, float(count), "values that differ after restoring and after serializing"


def _replayed(
    description: Any, folder: str, reference: Array | None, replay: Callable[..., Array], interface: Any
) -> Outcome:
    if interface is None or reference is None:
        return None, None, "no such interface" if interface is None else "no reference trajectory in the FMU"
    nominal = fmus.nominals_of(fmus.variables_of(description, "output"))
    expected = reference[:, -len(nominal) :]
    found, largest = replay(description, folder, reference), np.abs(expected).max(axis=0)
    scale = np.where(largest > 0.0, np.maximum(largest, HARDLY_MOVED * nominal), nominal)
    worst = float(np.max(np.abs(found - expected) / scale, initial=0.0))
    return worst <= REFERENCE_TOLERANCE, worst, "largest deviation from the trajectory inside"


def _visit(
    description: Any,
    folder: str,
    reference: Array | None,
    measure: Callable[[Any, fmus.Instance, Array], float],
) -> float:
    """Return the largest of a measure over some states of the FMU, in Model Exchange if it has it."""
    inputs = fmus.references_of(description, "input")
    rows = np.array([fmus.starts_of(description, "input")])
    if reference is not None:
        rows = reference[:: max(1, len(reference) // 8), 1 : 1 + rows.shape[1]]
    with closing(fmus.instantiated(description, folder, description.modelExchange is not None)) as instance:
        instance.initialize(inputs, rows[0].tolist())
        return max(measure(description, instance, row) for row in rows)


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
    signals = [*fmus.variables_of(description, "input"), *fmus.variables_of(description, "output")]
    if header != ["time", *(name for variable in signals for name in fmus.elements_of(variable))]:
        raise FmuError(f"reference.csv must have the columns time, inputs, outputs, got {brief(header)}")
    if table.shape != (len(rows), len(header)) or not rows or not np.isfinite(table).all():
        raise FmuError(
            f"reference.csv must have rows of {len(header)} finite numbers, got shape {table.shape}"
        )
    return table


# What is measured on an FMU: derivatives against differences, FMU states against each other.


DIFFERENCE_STEP = 1e-4
"""Step of the differences in nominal values, where their errors of fourth order and of roundoff balance."""


def derivative_error(description: Any, instance: fmus.Instance, inputs: Array) -> float:
    """Return the largest deviation of directional derivatives from differences, relative to its row."""
    unknowns, knowns, nominal = (
        fmus.unknowns_of(description),
        fmus.knowns_of(description),
        fmus.known_nominals(description),
    )
    instance.set(fmus.references_of(description, "input"), inputs.tolist())
    if description.modelExchange is not None:
        instance.move(0.0, _states(description))
    exact = _columns(instance, unknowns, knowns, len(nominal))
    values = np.abs(instance.get(unknowns))
    moved = np.stack(
        [
            _difference(description, instance, k, DIFFERENCE_STEP * nominal[k], inputs)
            for k in range(len(nominal))
        ],
        axis=1,
    )
    instance.set(fmus.references_of(description, "input"), inputs.tolist())
    # What does not depend on anything has differences of roundoff, to be seen beside its value.
    return _deviation(exact * nominal, moved * nominal, DIFFERENCE_STEP * values)


def adjoint_error(description: Any, instance: fmus.Instance, inputs: Array) -> float:
    """Return the largest deviation of adjoint from directional derivatives, relative to its row."""
    unknowns, knowns, nominal = (
        fmus.unknowns_of(description),
        fmus.knowns_of(description),
        fmus.known_nominals(description),
    )
    instance.set(fmus.references_of(description, "input"), inputs.tolist())
    exact = _columns(instance, unknowns, knowns, len(nominal))
    rows = np.array([instance.adjoint(unknowns, knowns, seed) for seed in np.eye(len(exact)).tolist()])
    return _deviation(exact * nominal, rows * nominal, np.zeros(len(exact)))


def _deviation(exact: Array, other: Array, floor: Array) -> float:
    """Return the largest deviation relative to the largest entry of its row, or its floor."""
    scale = np.maximum(np.abs(exact).max(axis=1, initial=0.0), floor)
    largest = np.abs(other - exact).max(axis=1, initial=0.0)
    return float(np.max(largest / np.where(scale > 0.0, scale, 1.0), initial=0.0))


def _columns(instance: fmus.Instance, unknowns: Sequence[int], knowns: Sequence[int], count: int) -> Array:
    seeds = np.eye(count).tolist()
    return np.stack([instance.directional(unknowns, knowns, seed) for seed in seeds], axis=1)


def _states(description: Any) -> Array:
    """Return the states for differences: beyond the start values, which may be the end of a range."""
    nominal = fmus.nominals_of(fmus.variables_of(description, "local"))
    return fmus.starts_of(description, "local") + 4.0 * DIFFERENCE_STEP * nominal


def _difference(description: Any, instance: fmus.Instance, known: int, step: float, inputs: Array) -> Array:
    """Return the derivative by one known from central differences of fourth order."""
    weights = {-2.0: 1.0, -1.0: -8.0, 1.0: 8.0, 2.0: -1.0}
    states = _states(description)
    total = np.zeros(1)
    for shift, weight in weights.items():
        shifted = np.concatenate([inputs, states])
        shifted[known] += shift * step
        instance.set(fmus.references_of(description, "input"), shifted[: len(inputs)].tolist())
        if description.modelExchange is not None:
            instance.move(0.0, shifted[len(inputs) :])
        total = total + weight * np.array(instance.get(fmus.unknowns_of(description)))
    if description.modelExchange is not None:
        instance.move(0.0, np.array(states))
    return total / (12.0 * step)


def state_differences(description: Any, first: fmus.Instance, second: fmus.Instance) -> int:
    """Return how many values differ between a run, the same run restored, and it in another instance."""
    everything = [v.valueReference for v in fmus.reals_of(description) if v.causality != "independent"]
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


def _advanced(instance: fmus.Instance, references: Sequence[int], step: float) -> list[float]:
    for k in range(3, 6):
        instance.step(k * step, step)
    return instance.get(references)


# Running an FMU along a table of inputs, in Co-Simulation and in Model Exchange.


STEP_TOLERANCE = 1e-12
"""Of the time integration inside an FMU in Co-Simulation."""

SHORTER = 1e-3
"""Of a first step that leads where the model has no derivative, the part that is tried next."""


def replay_steps(description: Any, folder: str, table: Array) -> Array:
    """Return the outputs (n_rows, n_outputs) of an FMU in Co-Simulation.

    Parameters
    ----------
    description : fmpy.model_description.ModelDescription
    folder : str
        Folder where the FMU was extracted.
    table : ndarray, shape (n_rows, 1 + n_inputs + ...)
        Columns time and inputs; the inputs of a row are held until the next row.
    """
    inputs, outputs = fmus.references_of(description, "input"), fmus.references_of(description, "output")
    time, values = table[:, 0], table[:, 1 : 1 + len(fmus.starts_of(description, "input"))]
    with closing(fmus.instantiated(description, folder, False)) as instance:
        instance.initialize(inputs, values[0].tolist(), float(time[0]), STEP_TOLERANCE)
        rows = [instance.get(outputs)]
        for k in range(1, len(time)):
            instance.step(float(time[k - 1]), float(time[k] - time[k - 1]))
            instance.set(inputs, values[k].tolist())
            rows.append(instance.get(outputs))
    return np.array(rows)


def replay_exchange(description: Any, folder: str, table: Array) -> Array:
    """Return the outputs (n_rows, n_outputs) of an FMU in Model Exchange; see `replay_steps`."""
    inputs, outputs = fmus.references_of(description, "input"), fmus.references_of(description, "output")
    time, values = table[:, 0], table[:, 1 : 1 + len(fmus.starts_of(description, "input"))]
    nominal = fmus.nominals_of(fmus.variables_of(description, "local"))
    with closing(fmus.instantiated(description, folder, True)) as instance:
        next_event = instance.initialize(inputs, values[0].tolist(), float(time[0]))
        x = instance.states(len(nominal))
        rows = [instance.get(outputs)]
        for k in range(1, len(time)):
            x, next_event = _between(instance, time[k - 1], x, time[k], nominal, next_event)
            instance.set(inputs, values[k].tolist())
            rows.append(instance.get(outputs))
    return np.array(rows)


def _between(
    instance: fmus.Instance, t: float, x: Array, end: float, nominal: Array, next_event: float | None
) -> tuple[Array, float | None]:
    """Return the state at `end`, and the time of the next event."""
    while next_event is not None and next_event <= end:
        x = _integrated(instance, t, x, next_event, nominal)
        t = next_event
        next_event = instance.event()
        if next_event is not None and next_event <= t:
            raise FmuError(f"the next event must be after t = {t!r} s, got {next_event!r}")
    return _integrated(instance, t, x, end, nominal), next_event


def _integrated(instance: fmus.Instance, t: float, x: Array, end: float, nominal: Array) -> Array:
    if not len(x) or end <= t:
        instance.move(end, x)
        return x

    def slope(time: float, state: Array) -> Array:
        instance.move(time, state)
        return instance.derivatives(len(state))

    solver = _solver(slope, t, x, end, nominal)
    while solver.status == "running":
        solver.step()
    if solver.status != "finished":
        raise FmuError(f"the integration must reach t = {end!r} s, got stuck at {solver.t!r} s")
    instance.move(end, solver.y)
    return solver.y


def _solver(slope: Callable[[float, Array], Array], t: float, x: Array, end: float, nominal: Array) -> Any:
    """Return the solver after the first step, which is short where a long one leaves the model's states."""
    for first in (end - t, SHORTER * (end - t), SHORTER**2 * (end - t)):
        solver = DOP853(slope, t, x, end, rtol=TOLERANCE, atol=TOLERANCE * nominal, first_step=first)  # type: ignore[arg-type]
        try:
            solver.step()
        except FMICallException:
            continue
        return solver
    slope(t, x)
    raise FmuError(f"the integration must leave t = {t!r} s, got no derivative beside it")
