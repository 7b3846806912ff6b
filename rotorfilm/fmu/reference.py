"""The reference trajectory that an FMU carries: inputs, and the outputs that Python computes for them."""

from __future__ import annotations

import csv
import io
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import DOP853, OdeSolver, Radau
from scipy.linalg import expm

from ..core.errors import (
    ContactError,
    ConvergenceError,
    FilmContactError,
    FmuError,
    InputError,
    RotorfilmError,
)
from ..core.model import Array, Dynamic, Linearization, Model, Stepped, stops
from ..core.signals import Scalar, names
from ..core.sources import offered
from ..native.spec import NativeSpec
from ..rotors import MountedRotor

if TYPE_CHECKING:
    import control

ROWS, FEW_ROWS = 51, 11
"""Rows of a table, and those of a rotor whose stiff shaft rings: one with inputs, which jump, or large."""

LARGE = 200
"""States of a rotor in bearings beyond which its table has `FEW_ROWS`."""

TOLERANCE = 1e-13
"""Local error of the integration, near the smallest that has a meaning."""

SWINGS = 0.25 * 0.5 ** np.arange(12)
"""Amplitudes of the inputs about their start values, in nominal values, from which the first is taken that
keeps the model where it has outputs."""


def reference_table(model: Model | Stepped, start: Array, duration: float) -> Array:
    """Return the table: columns time, inputs, outputs; the inputs of a row are held until the next row.

    Every input swings about its start value at a frequency of its own. The table ends early where the model
    does, as an unstable system overflows.

    Parameters
    ----------
    model : Model or Stepped
    start : ndarray, shape (n_inputs,)
        Start values of the inputs.
    duration : float [s]

    Returns
    -------
    ndarray, shape (n_rows, 1 + n_inputs + n_outputs)

    Raises
    ------
    FmuError
        If the model has no outputs over the first step even with its inputs at rest.
    """
    time: Array = np.linspace(0.0, duration, ROWS)
    if isinstance(model, MountedRotor):
        time = _within_a_turn(model, start, time)
        if model.inputs or len(model.states) > LARGE:
            time = time[:FEW_ROWS]
        if not model.inputs and (table := _compiled(model, time)) is not None:
            return table
    nominal = np.array([signal.nominal for signal in model.inputs])
    cycles = np.arange(1, len(nominal) + 1)
    waves = np.sin(2.0 * np.pi * np.outer(time / time[-1], cycles) + cycles)
    best: list[Array] = []
    for swing in SWINGS:
        rows, why = _rows(model, time, start + swing * nominal * waves)
        best = max(best, rows, key=len)
        if len(best) == len(time) or not len(nominal):
            break
    if len(best) < 2:
        best, why = _rows(model, time, np.tile(start, (len(time), 1)))
    if len(best) < 2:
        raise FmuError(
            "model must have outputs over a step from its start values, got none within "
            f"{float(time[1]):.6g} s: {why}"
        )
    return np.array(best)


def _within_a_turn(model: MountedRotor, start: Array, time: Array) -> Array:
    """Return times up to a turn at the first speed, which takes a shaft of many elements 10 000 steps."""
    try:
        first = dict(zip(names(model.outputs), model.output(0.0, model.initial_state, start), strict=True))
    except RotorfilmError:  # told where the table begins
        return time
    speed = abs(float(first.get("speed", 0.0)))
    return time * min(1.0, 2.0 * np.pi / (speed * time[-1])) if speed else time


def _compiled(model: MountedRotor, time: Array) -> Array | None:
    """Return the table of a rotor on films by its compiled integration; None where that does not take it."""
    settings = {"duration": time[-1], "times": time, "rtol": TOLERANCE, "condensation": 0.0}
    with warnings.catch_warnings(action="ignore"):
        try:
            run = offered("simulate_rotor")(model, **settings)
        except InputError:
            return None
        except (ContactError, ConvergenceError) as ended:
            run = ended.partial
    if len(run.time) < 2 or not run.signals.keys() >= set(names(model.outputs)):
        return None
    return np.stack([run.time, *(run[name] for name in names(model.outputs))], axis=1)


def _rows(model: Model | Stepped, time: Array, inputs: Array) -> tuple[list[Array], str]:
    """Return the rows until the model ends them, and why it does."""
    rows: list[Array] = []
    why = ""
    state: Any = None
    with warnings.catch_warnings(action="ignore"):
        for k, (t, u) in enumerate(zip(time, inputs, strict=True)):
            try:
                last = k - 1
                state = (
                    _moved(model, time[last], state, inputs[last], t - time[last]) if k else begun(model, u)
                )
                row = np.concatenate([[t], u, answered(model, t, state, u)])
            except Exception as failure:
                # Whatever ends a model ends its table.
                why = str(failure)
                break
            if not np.isfinite(row).all():
                why = f"outputs must be finite, got {row[1 + len(u) :]} at t = {t:.6g} s"
                break
            rows.append(row)
    return rows, why


def begun(model: Model | Stepped, u: Array) -> Any:
    """Return the state of a model at t = 0."""
    if isinstance(model, Stepped):
        return model.start(u)
    return np.asarray(model.initial_state, dtype=float) if isinstance(model, Dynamic) else np.zeros(0)


def answered(model: Model | Stepped, t: float, state: Any, u: Array) -> Array:
    """Return the outputs of a model."""
    return model.answer(state) if isinstance(model, Stepped) else model.output(t, state, u)


def _moved(model: Model | Stepped, t: float, x: Any, u: Array, step: float) -> Any:
    if isinstance(model, Stepped):
        return model.step(x, t, u, step)[0]
    if isinstance(model, LinearSystem):
        return _moved_exactly(model, x, u, step)
    return advance(model, t, x, u, step, TOLERANCE) if isinstance(model, Dynamic) else x


def _moved_exactly(model: LinearSystem, x: Array, u: Array, step: float) -> Array:
    """Return the state after a step under held inputs, by the exponential of the whole system."""
    n, m = model.B.shape
    whole = np.zeros((n + m, n + m))
    whole[:n, :n], whole[:n, n:] = model.A, model.B
    return (expm(step * whole) @ np.concatenate([x, u]))[:n]


def to_csv(names: Sequence[str], table: Array) -> bytes:
    """Return the table as CSV with 17 digits, which read back exactly."""
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerow(names)
    np.savetxt(buffer, table, "%.17g", ",")
    return buffer.getvalue().encode()


# A python-control system as a model, with its labels as signals.


@dataclass(frozen=True, kw_only=True, eq=False)
class LinearSystem:
    """Linear time-invariant system dx/dt = A x + B u, y = C x + D u.

    Parameters
    ----------
    A, B, C, D : ndarray
        Matrices (n, n), (n, m), (p, n), (p, m).
    input_labels, output_labels, state_labels : tuple of str
        Names of the signals, as python-control has them.
    """

    A: Array
    B: Array
    C: Array
    D: Array
    input_labels: tuple[str, ...]
    output_labels: tuple[str, ...]
    state_labels: tuple[str, ...]

    @property
    def inputs(self) -> tuple[Scalar, ...]:
        """The input labels as signals."""
        return tuple(_scalar(name, "input") for name in self.input_labels)

    @property
    def outputs(self) -> tuple[Scalar, ...]:
        """The output labels as signals."""
        return tuple(_scalar(name, "output") for name in self.output_labels)

    @property
    def states(self) -> tuple[Scalar, ...]:
        """The state labels as signals."""
        return tuple(_scalar(name, "state") for name in self.state_labels)

    @property
    def initial_state(self) -> Array:
        """Zero, shape (n,)."""
        return np.zeros(len(self.A))

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return A x + B u, shape (n,)."""
        return self.A @ np.asarray(x, dtype=float) + self.B @ np.asarray(u, dtype=float)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return C x + D u, shape (p,)."""
        return self.C @ np.asarray(x, dtype=float) + self.D @ np.asarray(u, dtype=float)

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the matrices."""
        return Linearization(self.A, self.B, self.C, self.D)

    def native(self) -> NativeSpec:
        """Return the kernel `linear` with the matrices."""
        return NativeSpec(kernel="linear", tables={"A": self.A, "B": self.B, "C": self.C, "D": self.D})


def from_state_space(system: control.StateSpace) -> LinearSystem:
    """Return a python-control system as a model that starts at zero.

    Raises
    ------
    FmuError
        If it is discrete in time, or a matrix is not finite.
    """
    if not system.isctime():
        raise FmuError(
            f"system must be continuous in time to go into an FMU, got dt = {system.dt!r}; "
            "export the system that it was sampled from"
        )
    matrices = {name: np.array(getattr(system, name), dtype=float) for name in "ABCD"}
    for name, matrix in matrices.items():
        if not np.isfinite(matrix).all():
            raise FmuError(f"{name} must be finite, got {matrix!r}")
    return LinearSystem(
        **matrices,
        input_labels=tuple(system.input_labels),
        output_labels=tuple(system.output_labels),
        state_labels=tuple(system.state_labels),
    )


def _scalar(name: str, kind: str) -> Scalar:
    """Return a signal of which python-control knows the name only; its magnitude counts as 1."""
    return Scalar(name=name, unit=None, nominal=1.0, description=f"{kind} of the system")


# Time integration inside an FMU: one macro step of a dynamic model under held inputs.


RELATIVE_TOLERANCE = 1e-10
"""Local error tolerance relative to each state, and to its nominal value: far below any coupling error."""

MAX_STEPS = 10_000
"""Substeps within one macro step beyond which the model counts as not integrable."""

MOST_EXPLICIT = 200
"""Substeps of the explicit method after which the model counts as stiff."""

FINEST_IMPLICIT = 1e-9
"""Tolerance of the implicit method, whose order is lower."""

RETREAT = 0.25
"""Part of a step that is tried next, after one that went to the wall."""


def advance(
    model: Dynamic, t: float, x: Array, u: Array, step: float, tolerance: float = RELATIVE_TOLERANCE
) -> Array:
    """Return the state at t + step under the constant input u.

    Dormand and Prince's method of order 8 with error control (Hairer, Norsett & Wanner 1993, II.10), started
    with the whole step and stopped at the `breakpoints` of the model. If it fails, as on a rotor in a stiff
    film, Radau's implicit method of order 5 is used.

    Parameters
    ----------
    model : Dynamic
    t : float [s]
    x : ndarray, shape (n_states,)
    u : ndarray, shape (n_inputs,)
    step : float [s]
        Not negative.
    tolerance : float
        Local error relative to each state, and to its nominal value.

    Raises
    ------
    ConvergenceError
        If the tolerance cannot be met; `partial` is the state reached.
    """
    for end in stops(model, t, t + step):
        # The end may also round to t itself.
        x = _integrate(model, t, x, u, end, tolerance) if end > t else x
        t = end
    return x


def _integrate(model: Dynamic, t: float, x: Array, u: Array, end: float, tolerance: float) -> Array:
    try:
        return _explicit(model, t, x, u, end, tolerance)
    except (FilmContactError, ConvergenceError):
        # A stiff film throws a step of the explicit method at the wall, or holds it up.
        return _implicit(model, t, x, u, end, max(tolerance, FINEST_IMPLICIT))


def _implicit(model: Dynamic, t: float, x: Array, u: Array, end: float, tolerance: float) -> Array:
    """Return the state at `end` by Radau's method of order 5, with a smaller step after one to the wall."""
    nominal, first_step = np.array([signal.nominal for signal in model.states]), end - t
    while True:
        solver = Radau(
            lambda time, state: model.derivative(time, state, u),
            t,
            x,
            end,
            rtol=tolerance,
            atol=tolerance * nominal,  # type: ignore[arg-type]  # as above
            first_step=min(first_step, end - t),
            jac=lambda time, state: model.linearization(time, state, u).A,
        )
        try:
            return _run(solver, MAX_STEPS)
        except FilmContactError:
            first_step = RETREAT * (first_step if solver.t == t else solver.h_abs)
            t, x = solver.t, solver.y
            if first_step <= 10.0 * np.spacing(end):
                raise


def _explicit(model: Dynamic, t: float, x: Array, u: Array, end: float, tolerance: float) -> Array:
    nominal = np.array([signal.nominal for signal in model.states])
    solver = DOP853(
        lambda time, state: model.derivative(time, state, u),
        t,
        x,
        end,
        rtol=tolerance,
        atol=tolerance * nominal,  # type: ignore[arg-type]  # an array is fine, says scipy's manual
        first_step=end - t,
    )
    return _run(solver, MOST_EXPLICIT)


def _run(solver: OdeSolver, most: int) -> Array:
    """Return the state at the end; ConvergenceError with the state reached after `most` steps."""
    for _ in range(most):
        solver.step()
        if solver.status == "finished":
            return solver.y
        if solver.status == "failed":
            break
    raise ConvergenceError(
        f"the integration must reach t = {solver.t_bound!r} s, got stuck at {solver.t!r} s", solver.y
    )
