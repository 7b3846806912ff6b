"""Time integration inside an FMU: one macro step of a dynamic model under held inputs."""

from __future__ import annotations

import numpy as np
from scipy.integrate import DOP853, OdeSolver, Radau

from ..errors import ConvergenceError, FilmContactError
from ..model import Array, Dynamic, stops

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
    with the whole step and stopped at the kinks of a `Kinked` model; Radau's implicit method of order 5
    where that one fails, as on a rotor in a stiff film.

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
