"""What is measured on an FMU: derivatives against differences, FMU states against each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...model import Array
from .calls import Instance, Instance3
from .described import known_nominals, knowns_of, reals_of, references_of, starts_of, unknowns_of

DIFFERENCE_STEP = 1e-4
"""Step of the differences in nominal values, where their errors of fourth order and of roundoff balance."""


def derivative_error(description: Any, instance: Instance, inputs: Array) -> float:
    """Return the largest deviation of directional derivatives from differences, relative to its row."""
    unknowns, knowns, nominal = unknowns_of(description), knowns_of(description), known_nominals(description)
    instance.set(references_of(description, "input"), inputs.tolist())
    if description.modelExchange is not None:
        instance.move(0.0, _states(description))
    exact, values = _columns(instance, unknowns, knowns), np.abs(instance.get(unknowns))
    moved = np.stack(
        [
            _difference(description, instance, k, DIFFERENCE_STEP * nominal[k], inputs)
            for k in range(len(knowns))
        ],
        axis=1,
    )
    instance.set(references_of(description, "input"), inputs.tolist())
    # What does not depend on anything has differences of roundoff, to be seen beside its value.
    return _deviation(exact * nominal, moved * nominal, DIFFERENCE_STEP * values)


def adjoint_error(description: Any, instance: Instance, inputs: Array) -> float:
    """Return the largest deviation of adjoint from directional derivatives, relative to its row."""
    assert isinstance(instance, Instance3)
    unknowns, knowns, nominal = unknowns_of(description), knowns_of(description), known_nominals(description)
    instance.set(references_of(description, "input"), inputs.tolist())
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


def _states(description: Any) -> Array:
    """Return the states for differences: beyond the start values, which may be the end of a range."""
    nominal = known_nominals(description)[len(references_of(description, "input")) :]
    return starts_of(description, "local") + 4.0 * DIFFERENCE_STEP * nominal


def _difference(description: Any, instance: Instance, known: int, step: float, inputs: Array) -> Array:
    """Return the derivative by one known from central differences of fourth order."""
    weights = {-2.0: 1.0, -1.0: -8.0, 1.0: 8.0, 2.0: -1.0}
    states = _states(description)
    total = np.zeros(len(unknowns_of(description)))
    for shift, weight in weights.items():
        shifted = np.concatenate([inputs, states])
        shifted[known] += shift * step
        instance.set(references_of(description, "input"), shifted[: len(inputs)].tolist())
        if description.modelExchange is not None:
            instance.move(0.0, shifted[len(inputs) :])
        total += weight * np.array(instance.get(unknowns_of(description)))
    if description.modelExchange is not None:
        instance.move(0.0, np.array(states))
    return total / (12.0 * step)


def state_differences(description: Any, first: Instance, second: Instance) -> int:
    """Return how many values differ between a run, the same run restored, and it in another instance."""
    everything = [v.valueReference for v in reals_of(description) if v.causality != "independent"]
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
