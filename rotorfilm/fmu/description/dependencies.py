"""Which inputs, states and parameters each output and derivative depends on, for the FMI ModelStructure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model import Array, Dynamic, Model, Stepped
from ...signals import Variable
from .variables import derivative_references, references

SAMPLES = 8
"""Generic points at which a derivative must vanish exactly before an output counts as independent."""

Flags = NDArray[np.bool_]


class Dependencies(NamedTuple):
    """What the unknowns of a model, first its outputs, then the derivatives of its states, depend on.

    Attributes
    ----------
    on_inputs : ndarray of bool, shape (n_unknowns, n_inputs)
    on_states : ndarray of bool, shape (n_unknowns, n_states)
    on_time : ndarray of bool, shape (n_unknowns,)
    bent : ndarray of bool, shape (n_unknowns, n_inputs + n_states)
        Where the dependence is not linear.
    delayed : bool
        Whether inputs act in the next step only: outputs follow from them during initialization alone.
    """

    on_inputs: Flags
    on_states: Flags
    on_time: Flags
    bent: Flags
    delayed: bool = False


class Unknown(NamedTuple):
    """One entry of a ModelStructure.

    Attributes
    ----------
    reference : int
        Value reference of the unknown.
    knowns : tuple of int
        Value references of what it depends on.
    kinds : tuple of str
        How, as FMI spells it.
    """

    reference: int
    knowns: tuple[int, ...]
    kinds: tuple[str, ...]


def dependencies(model: Model, start: Array, times: Sequence[float] = (0.0,)) -> Dependencies:
    """Return the dependencies of `model` from its exact derivatives.

    An unknown counts as independent of an input or state only if that derivative is exactly zero at the
    start values and at `SAMPLES` generic points about them, as linear only if it is the same at all of them;
    wherever derivatives are undefined, as where a film at rest has none, the other points decide, and if no
    point has derivatives, all may depend.

    Parameters
    ----------
    model : Model
    start : ndarray, shape (n_inputs,)
        Start values of the inputs.
    times : sequence of float [s]
        An unknown with the same value at all of them counts as independent of time.
    """
    points = _points(model, start)
    found = [matrix for x, u in points if (matrix := _matrix(model, x, u)) is not None]
    shape = (len(model.outputs) + len(model.states), len(model.inputs) + len(model.states))
    nonzero, bent = np.ones(shape, dtype=bool), np.ones(shape, dtype=bool)
    if found:
        stack = np.array(found)
        # NaN is not zero: it counts as a dependency.
        nonzero = np.any(stack != 0.0, axis=0)
        bent = nonzero & (np.any(stack != stack[0], axis=0) | (len(found) < SAMPLES))
    count = len(model.inputs)
    return Dependencies(nonzero[:, :count], nonzero[:, count:], _on_time(model, points[-1], times), bent)


def delayed_dependencies(model: Stepped) -> Dependencies:
    """Return the dependencies of a model with its own integrator: all outputs follow from all inputs."""
    shape = len(model.outputs), len(model.inputs)
    every = np.ones(shape, dtype=bool)
    return Dependencies(
        every, np.zeros((shape[0], 0), dtype=bool), np.zeros(shape[0], dtype=bool), every, True
    )


def running_unknowns(variables: Sequence[Variable], found: Dependencies, tunable: bool) -> list[Unknown]:
    """Return outputs and derivatives with what they depend on while the simulation runs.

    States are among it only where the description shows their derivatives too.

    Parameters
    ----------
    variables : sequence of Variable
    found : Dependencies
    tunable : bool
        Whether the model has tunable parameters, which then may be in every linear factor.
    """
    if found.delayed:
        found = found._replace(on_inputs=np.zeros_like(found.on_inputs))
    linear = "tunable" if tunable else "constant"
    hidden = set() if derivative_references(variables) else set(references(variables, "local"))
    unknowns = [
        (reference, _time(variables, timed) + _marked(variables, row, bent, linear))
        for reference, row, timed, bent in _rows(variables, found)
    ]
    return [Unknown(k, *_split([p for p in pairs if p[0] not in hidden])) for k, pairs in unknowns]


def initial_unknowns(variables: Sequence[Variable], found: Dependencies) -> list[Unknown]:
    """Return outputs and derivatives with what they depend on during initialization, parameters included."""
    parameters = [(k, "dependent") for k in references(variables, "parameter")]
    linear = "dependent" if parameters else "constant"
    return [
        Unknown(
            reference,
            *_split(_time(variables, timed) + parameters + _marked(variables, row, bent, linear)),
        )
        for reference, row, timed, bent in _rows(variables, found)
    ]


def _rows(variables: Sequence[Variable], found: Dependencies) -> list[tuple[int, Flags, bool, Flags]]:
    unknowns = [*references(variables, "output"), *derivative_references(variables)]
    # A description without derivatives, for co-simulation only, has no use for their rows.
    depends = np.concatenate([found.on_inputs, found.on_states], axis=1)[: len(unknowns)]
    return [
        (unknown, row, bool(found.on_time[k]), found.bent[k])
        for k, (unknown, row) in enumerate(zip(unknowns, depends, strict=True))
    ]


def _marked(variables: Sequence[Variable], row: Flags, bent: Flags, linear: str) -> list[tuple[int, str]]:
    knowns = [*references(variables, "input"), *references(variables, "local")]
    kinds = ["dependent" if flag else linear for flag in bent]
    return [(known, kind) for known, kind, flag in zip(knowns, kinds, row, strict=True) if flag]


def _time(variables: Sequence[Variable], timed: bool) -> list[tuple[int, str]]:
    return [(known, "dependent") for known in references(variables, "independent") if timed]


def _split(pairs: list[tuple[int, str]]) -> tuple[tuple[int, ...], tuple[str, ...]]:
    return tuple(known for known, _ in pairs), tuple(kind for _, kind in pairs)


def _points(model: Model, start: Array) -> list[tuple[Array, Array]]:
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
    return points


def _matrix(model: Model, x: Array, u: Array) -> Array | None:
    """Return d(output, derivative)/d(input, state), or None where there is no such thing."""
    try:
        at = model.linearization(0.0, x, u)
    except Exception:
        # Whatever a model raises where it has no derivatives, the point says nothing.
        return None
    return np.block([[at.D, at.C], [at.B, at.A]])


def _on_time(model: Model, point: tuple[Array, Array], times: Sequence[float]) -> Flags:
    try:
        values = np.array([_unknowns(model, t, *point) for t in times])
    except Exception:
        return np.ones(len(model.outputs) + len(model.states), dtype=bool)
    return np.any(values != values[0], axis=0)


def _unknowns(model: Model, t: float, x: Array, u: Array) -> Array:
    slopes = model.derivative(t, x, u) if isinstance(model, Dynamic) else np.zeros(0)
    return np.concatenate([model.output(t, x, u), slopes])


def _nominal(signals: tuple) -> Array:
    return np.array([signal.nominal for signal in signals])
