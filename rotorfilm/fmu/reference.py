"""The reference trajectory that an FMU carries: inputs, and the outputs that Python computes for them."""

from __future__ import annotations

import csv
import io
import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.linalg import expm

from ..errors import FmuError
from ..model import Array, Dynamic, Model, Stepped
from .advance import advance
from .linear_system import LinearSystem

ROWS = 51
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
    time = np.linspace(0.0, duration, ROWS)
    nominal = np.array([signal.nominal for signal in model.inputs])
    cycles = np.arange(1, len(nominal) + 1)
    waves = np.sin(2.0 * np.pi * np.outer(time / duration, cycles) + cycles)
    best: list[Array] = []
    for swing in SWINGS:
        rows, why = _rows(model, time, start + swing * nominal * waves)
        best = max(best, rows, key=len)
        if len(best) == ROWS or not len(nominal):
            break
    if len(best) < 2:
        best, why = _rows(model, time, np.tile(start, (ROWS, 1)))
    if len(best) < 2:
        raise FmuError(
            "model must have outputs over a step from its start values, got none within "
            f"{float(time[1]):.6g} s: {why}"
        )
    return np.array(best)


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
                    _moved(model, time[last], state, inputs[last], t - time[last]) if k else _begun(model, u)
                )
                row = np.concatenate([[t], u, _answered(model, t, state, u)])
            except Exception as failure:
                # Whatever ends a model ends its table.
                why = str(failure)
                break
            if not np.isfinite(row).all():
                why = f"outputs must be finite, got {row[1 + len(u) :]} at t = {t:.6g} s"
                break
            rows.append(row)
    return rows, why


def _begun(model: Model | Stepped, u: Array) -> Any:
    if isinstance(model, Stepped):
        return model.start(u)
    return np.asarray(model.initial_state, dtype=float) if isinstance(model, Dynamic) else np.zeros(0)


def _answered(model: Model | Stepped, t: float, state: Any, u: Array) -> Array:
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
    moved: Array = (expm(step * whole) @ np.concatenate([x, u]))[:n]
    return moved


def to_csv(names: Sequence[str], table: Array) -> bytes:
    """Return the table as CSV with 17 digits, which read back exactly."""
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerow(names)
    np.savetxt(buffer, table, "%.17g", ",")
    return buffer.getvalue().encode()
