"""A ball on its reduced contact law, over time."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from ..errors import ConvergenceError, require_number, require_positive
from ..model import Array
from ..results import Trajectory
from .contact_law import ContactLaw


def ride(
    law: ContactLaw,
    *,
    mass: float,
    load: Callable[[float], float],
    start: float,
    duration: float,
    velocity: float = 0.0,
    samples: int = 2001,
    rtol: float = 1e-6,
) -> Trajectory:
    """Return the motion mass z'' = force - load(t) of a ball on a contact law.

    Parameters
    ----------
    law : ContactLaw
        In SI, or dimensionless; then mass is W/(2 pi/3) and load is f.
    mass : float [kg]
    load : callable
        Force towards the plane over time [N]; integration stops at its `breakpoints`, if it has that
        attribute, and it is to return the value before a jump there.
    start, velocity : float [m, m/s]
        Approach and its rate at t = 0; the contact has rested at the start until then.
    duration : float [s]
    samples : int
        Instants of the answer.
    rtol : float
        Relative tolerance.

    Returns
    -------
    Trajectory
        Signals `z`, `vz` and `force_z`.

    Raises
    ------
    ConvergenceError
        If the integrator gives up; `partial` is the motion until then.
    """
    require_positive("mass", mass)
    require_positive("duration", duration)
    require_number("start", start)
    jumps = sorted(t for t in getattr(load, "breakpoints", ()) if 0.0 < t < duration)
    grid = np.linspace(0.0, duration, samples)
    y = np.array([start, velocity, *law.resting(start / law.film_scale)])
    scale = np.array([law.film_scale, law.film_scale / law.time_scale, *np.ones(law.order)])
    pieces, calls = [y[:, None]], 0

    for begin, end in zip([0.0, *jumps], [*jumps, duration], strict=True):
        after = np.nextafter(begin, end)

        def rate(t: float, y: Array, after: float = after) -> Array:
            force = law.output(t, y[2:], y[:1])[0]
            push = (force - load(max(t, after))) / mass
            return np.array([y[1], push, *law.derivative(t, y[2:], y[:1])])

        inside = grid[(grid > begin) & (grid <= end)]
        done = solve_ivp(
            rate, (begin, end), y, method="LSODA", t_eval=[*inside[inside < end], end], rtol=rtol,
            atol=rtol * scale,
        )  # fmt: skip
        calls += done.nfev
        pieces.append(done.y[:, : len(inside)])
        if not done.success:
            raise ConvergenceError(
                f"the motion must be integrable, got {done.message}", _motion(law, grid, pieces, calls)
            )
        y = done.y[:, -1]
    return _motion(law, grid, pieces, calls)


def _motion(law: ContactLaw, grid: Array, pieces: list[Array], calls: int) -> Trajectory:
    y = np.concatenate(pieces, axis=1)
    force = np.array([law.output(0.0, column[2:], column[:1])[0] for column in y.T])
    signals = {"z": y[0], "vz": y[1], "force_z": force}
    return Trajectory(time=grid[: y.shape[1]], signals=signals, work={"film_calls": calls})
