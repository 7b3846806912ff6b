"""Which inputs and states each output depends on, for the FMI ModelStructure."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..model import Array, Dynamic, Model

SAMPLES = 8
"""Generic points at which a derivative must vanish exactly before an output counts as independent."""


class Dependencies(NamedTuple):
    """Whether each output may depend on each input, and on each state.

    Attributes
    ----------
    on_inputs : ndarray of bool, shape (n_outputs, n_inputs)
    on_states : ndarray of bool, shape (n_outputs, n_states)
    """

    on_inputs: NDArray[np.bool_]
    on_states: NDArray[np.bool_]


def dependencies(model: Model, start: Array) -> Dependencies:
    """Return the dependencies of `model` from its exact derivatives.

    An output counts as independent of an input or state only if that derivative is exactly zero at the
    start values and at `SAMPLES` generic points about them; wherever derivatives are undefined, as where
    a film at rest has none, the other points decide, and if no point has derivatives, all may depend.

    Parameters
    ----------
    model : Model
    start : ndarray, shape (n_inputs,)
        Start values of the inputs.
    """
    patterns = [pattern for pattern in _sampled(model, start) if pattern is not None]
    if not patterns:
        n_outputs = len(model.outputs)
        return Dependencies(
            np.ones((n_outputs, len(model.inputs)), dtype=bool),
            np.ones((n_outputs, len(model.states)), dtype=bool),
        )
    return Dependencies(
        np.any([pattern.on_inputs for pattern in patterns], axis=0),
        np.any([pattern.on_states for pattern in patterns], axis=0),
    )


def _sampled(model: Model, start: Array) -> list[Dependencies | None]:
    state = model.initial_state if isinstance(model, Dynamic) else np.zeros(0)
    generator = np.random.default_rng(0)
    points = [(np.asarray(state, dtype=float), start)]
    for _ in range(SAMPLES):
        points.append(
            (
                state + generator.uniform(-0.5, 0.5, len(model.states)) * _nominal(model.states),
                start + generator.uniform(-0.5, 0.5, len(model.inputs)) * _nominal(model.inputs),
            )
        )
    return [_pattern(model, x, u) for x, u in points]


def _pattern(model: Model, x: Array, u: Array) -> Dependencies | None:
    try:
        derivatives = model.linearization(0.0, x, u)
    except Exception:
        # Whatever a model raises where it has no derivatives, the point says nothing.
        return None
    # NaN is not zero: it counts as a dependency.
    return Dependencies(np.asarray(derivatives.D) != 0.0, np.asarray(derivatives.C) != 0.0)


def _nominal(signals: tuple) -> Array:
    return np.array([signal.nominal for signal in signals])
