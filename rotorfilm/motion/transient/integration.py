"""Stiff integration that survives trial states beyond the bearing wall."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import DenseOutput, OdeSolver, Radau

from ...errors import ContactError, ConvergenceError, FilmContactError
from ...model import Array
from .coupled import Coupled

RETREAT = 0.25
"""Part of a step that is tried next, after a trial state beyond the wall."""


class Integration(NamedTuple):
    """How to integrate: the method and its accuracy.

    Attributes
    ----------
    method : a class derived from scipy.integrate.OdeSolver
    rtol : float [1]
        Relative local error; the absolute one is rtol times the magnitude of each state.
    max_step : float [s]
    """

    method: Callable[..., OdeSolver] = Radau
    rtol: float = 1e-8
    max_step: float = np.inf


class Step(NamedTuple):
    """One accepted step: the state at its end, and the solution along it."""

    start: float
    end: float
    state: Array
    path: DenseOutput


def integrate(system: Coupled, state: Array, stops: Sequence[float], settings: Integration) -> Iterator[Step]:
    """Yield the accepted steps from t = 0 through every stop to the last one.

    A trial state beyond the wall makes the film raise; the integrator is then started again from the
    last accepted state with a smaller step. Feeding it NaN instead, as is customary, is not safe: scipy's
    Radau accepts a step whose error estimate is NaN.

    Raises
    ------
    ContactError
        When the journal is at the wall, without a partial result.
    ConvergenceError
        When the integrator gives up, without a partial result.
    """
    t, first_step = 0.0, None
    for stop in stops:
        while t < stop:
            try:
                solver = _solver(system, t, state, stop, first_step, settings)
                for step in _accepted(system, solver):
                    t, state, first_step = step.end, step.state, step.end - step.start
                    yield step
            except FilmContactError as wall:
                first_step = _retreat(system, t, wall)
                system.work["restarts"] += 1


def _accepted(system: Coupled, solver: OdeSolver) -> Iterator[Step]:
    """Yield the steps of one solver until it is done."""
    while solver.status == "running":
        system.furthest = solver.t
        message = solver.step()
        if solver.status == "failed":
            raise ConvergenceError(f"integration failed at t = {solver.t:.9g} s: {message}")
        system.work["steps"] += 1
        yield Step(solver.t_old, solver.t, solver.y.copy(), solver.dense_output())


def _solver(
    system: Coupled, t: float, state: Array, stop: float, first_step: float | None, settings: Integration
) -> OdeSolver:
    options: dict[str, Any] = {
        "max_step": settings.max_step,
        "rtol": settings.rtol,
        "atol": settings.rtol * system.scale(),
    }
    if first_step is not None:
        options["first_step"] = min(first_step, stop - t, settings.max_step)
    # Explicit methods would warn about a Jacobian that they do not use.
    if "jac" in inspect.signature(settings.method).parameters:
        options["jac"] = system.jacobian
    system.furthest = t
    return settings.method(system.derivative, t, state, stop, **options)


def _retreat(system: Coupled, t: float, wall: FilmContactError) -> float:
    """Return the next step to try after a trial state beyond the wall, unless time can go no further."""
    step = RETREAT * (system.furthest - t)
    if step <= 10.0 * np.spacing(t):
        raise ContactError(f"journal reached the wall at t = {t:.9g} s: {wall}") from wall
    return step
