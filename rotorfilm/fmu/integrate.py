"""Time integration inside an FMU: one macro step of a dynamic model under held inputs."""

from __future__ import annotations

import numpy as np
from scipy.integrate import DOP853

from ..errors import ConvergenceError
from ..model import Array, Dynamic, stops

RELATIVE_TOLERANCE = 1e-10
"""Local error tolerance relative to each state, and to its nominal value: far below any coupling error."""

MAX_STEPS = 10_000
"""Substeps within one macro step beyond which the model counts as not integrable."""


def advance(
    model: Dynamic, t: float, x: Array, u: Array, step: float, tolerance: float = RELATIVE_TOLERANCE
) -> Array:
    """Return the state at t + step under the constant input u.

    Dormand and Prince's method of order 8 with error control (Hairer, Norsett & Wanner 1993, II.10), started
    with the whole step and stopped at the kinks of a `Kinked` model.

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
    for _ in range(MAX_STEPS):
        solver.step()
        if solver.status == "finished":
            return solver.y
        if solver.status == "failed":
            break
    raise ConvergenceError(f"the integration must reach t = {end!r} s, got stuck at {solver.t!r} s", solver.y)
