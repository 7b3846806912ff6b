"""Running an FMU along a table of inputs, in Co-Simulation and in Model Exchange."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException
from scipy.integrate import DOP853

from ...errors import FmuError
from ...model import Array
from .calls import Instance
from .described import nominal_of, references_of, variables_of
from .instance import instantiated

STEP_TOLERANCE = 1e-12
"""Of the time integration inside an FMU in Co-Simulation."""

SHORTER = 1e-3
"""Of a first step that leads where the model has no derivative, the part that is tried next."""

TOLERANCE = 1e-11
"""Local error of the integration in Model Exchange, relative to each state and its nominal value."""


def replay_steps(description: Any, folder: str, table: Array) -> Array:
    """Return the outputs (n_rows, n_outputs) of an FMU in Co-Simulation.

    Parameters
    ----------
    description : fmpy.model_description.ModelDescription
    folder : str
        Where the FMU was extracted.
    table : ndarray, shape (n_rows, 1 + n_inputs + ...)
        Columns time and inputs; the inputs of a row are held until the next row.
    """
    inputs, outputs = references_of(description, "input"), references_of(description, "output")
    time, values = table[:, 0], table[:, 1 : 1 + len(inputs)]
    instance = instantiated(description, folder, False)
    try:
        instance.initialize(inputs, values[0].tolist(), float(time[0]), STEP_TOLERANCE)
        rows = [instance.get(outputs)]
        for k in range(1, len(time)):
            instance.step(float(time[k - 1]), float(time[k] - time[k - 1]))
            instance.set(inputs, values[k].tolist())
            rows.append(instance.get(outputs))
    finally:
        instance.close()
    return np.array(rows)


def replay_exchange(description: Any, folder: str, table: Array) -> Array:
    """Return the outputs (n_rows, n_outputs) of an FMU in Model Exchange; see `replay_steps`."""
    inputs, outputs = references_of(description, "input"), references_of(description, "output")
    time, values = table[:, 0], table[:, 1 : 1 + len(inputs)]
    nominal = np.array([nominal_of(state) for state in variables_of(description, "local")])
    instance = instantiated(description, folder, True)
    try:
        next_event = instance.initialize(inputs, values[0].tolist(), float(time[0])).next_time
        x = instance.states(len(nominal))
        rows = [instance.get(outputs)]
        for k in range(1, len(time)):
            x, next_event = _between(instance, time[k - 1], x, time[k], nominal, next_event)
            instance.set(inputs, values[k].tolist())
            rows.append(instance.get(outputs))
    finally:
        instance.close()
    return np.array(rows)


def _between(
    instance: Instance, t: float, x: Array, end: float, nominal: Array, next_event: float | None
) -> tuple[Array, float | None]:
    """Return the state at `end`, and the time of the next event."""
    while next_event is not None and next_event <= end:
        x = _integrated(instance, t, x, next_event, nominal)
        t = next_event
        next_event = instance.event().next_time
        if next_event is not None and next_event <= t:
            raise FmuError(f"the next event must be after t = {t!r} s, got {next_event!r}")
    return _integrated(instance, t, x, end, nominal), next_event


def _integrated(instance: Instance, t: float, x: Array, end: float, nominal: Array) -> Array:
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
