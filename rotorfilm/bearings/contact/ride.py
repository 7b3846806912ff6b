"""A ball on its reduced contact law, over time."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ...errors import ConvergenceError, require_number, require_positive, warn_user
from ...inputs.kinds import arguments
from ...model import Array, breakpoints
from ...results import Trajectory
from ..cubic import cubic
from .contact_law import ContactLaw
from .ride_steps import RideLaw

FINEST = 12
"""Halvings of the steps after which an integration is given up."""


class _Part(NamedTuple):
    """Motion between two jumps of the load, in the units of the contact."""

    time: Array
    y: Array


class _Rider(NamedTuple):
    """The law and the ball in the units of the contact."""

    law: RideLaw
    fastest: float
    load: Callable[[float], float]
    time_scale: float
    force_scale: float

    def part(self, begin: float, end: float, start: Array, tolerance: float) -> _Part:
        """Return the motion by halving the steps until the answer settles."""
        n = max(4, math.ceil((end - begin) * self.fastest))
        pushes = self._pushes(begin, end, 2 * n)
        rough = self._steps(begin, end, start, pushes)
        for _ in range(FINEST):
            between = self._pushes(begin, end, 2 * len(pushes) - 2, odd=True)
            pushes = np.insert(pushes, np.arange(1, len(pushes)), between)
            fine = self._steps(begin, end, start, pushes)
            # Of order four, so the finer answer is some fifteen times better than this.
            miss = float(np.max(np.abs(fine.y[::2, 0] - rough.y[:, 0])))
            if miss <= 15.0 * tolerance:
                return fine
            rough = fine
        raise ConvergenceError(
            f"halving the steps must settle the motion to {tolerance:.1e}, got changes of {miss:.1e} "
            f"with {len(pushes) // 2} steps"
        )

    def _pushes(self, begin: float, end: float, intervals: int, *, odd: bool = False) -> Array:
        """Return the loads at the ends of equal intervals, or at every second of them."""
        times = np.linspace(begin, end, intervals + 1)
        times[0] = np.nextafter(begin, end)  # the load after a jump
        scale, load = self.time_scale, self.load
        chosen = times[1::2] if odd else times
        values = [load(t) for t in (scale * chosen).tolist()]
        return np.array(values, dtype=float) / self.force_scale

    def _steps(self, begin: float, end: float, start: Array, pushes: Array) -> _Part:
        n = len(pushes) // 2
        return _Part(np.linspace(begin, end, n + 1), self.law.steps(start, (end - begin) / n, pushes))


@arguments
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

    Compiled Runge-Kutta steps of order four, halved until the motion settles.

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
        Tolerance of the approach, in units of the film thickness.

    Returns
    -------
    Trajectory
        Signals `z`, `vz` and `force_z`.

    Raises
    ------
    ConvergenceError
        If the motion does not settle; `partial` is the motion until the jump before.

    Warns
    -----
    ValidityWarning
        If the force leaves the `load_range` of the law.
    """
    require_positive("mass", mass)
    require_positive("duration", duration)
    require_number("start", start)
    rider = _rider(law, mass, load)
    span = duration / law.time_scale
    jumps = sorted(t / law.time_scale for t in breakpoints(load) if 0.0 < t < duration)
    delta = start / law.film_scale
    y = np.array([delta, velocity * law.time_scale / law.film_scale, *law.resting(delta)])
    parts: list[_Part] = []
    for begin, end in zip([0.0, *jumps], [*jumps, span], strict=True):
        try:
            parts.append(rider.part(begin, end, y, rtol))
        except ConvergenceError as error:
            raise ConvergenceError(str(error), _motion(law, rider, parts, samples)) from error
        y = parts[-1].y[-1]
    _require_range(law, np.concatenate([rider.law.force(part.y) for part in parts]) * law.force_scale)
    return _motion(law, rider, parts, samples)


def _require_range(law: ContactLaw, force: Array) -> None:
    lowest, highest = law.load_range
    if force.min() < lowest or force.max() > highest:
        warn_user(
            f"force must stay within {lowest:.6g} and {highest:.6g}, the loads to which the law was fitted, "
            f"got {force.min():.3g} to {force.max():.3g}: take the law about a load of its middle "
            "(reduce_contact and reduce_ball: load), or the full film"
        )


def _rider(law: ContactLaw, mass: float, load: Callable[[float], float]) -> _Rider:
    W = mass * law.film_scale / (law.time_scale**2 * law.force_scale)
    static = law.offset, law.span, law.exponent, law.operating
    poles = np.abs(np.linalg.eigvals(law.A)) if law.order else np.zeros(1)
    natural = math.sqrt(law.exponent / law.span / W)
    return _Rider(
        RideLaw(law.A, law.B[:, 0], law.C[0], float(law.D[0, 0]), *static, W),
        max(natural, float(poles.max())),
        load,
        law.time_scale,
        law.force_scale,
    )


def _motion(law: ContactLaw, rider: _Rider, parts: list[_Part], samples: int) -> Trajectory:
    """Return equally spaced samples of the parts, by interpolation of order four."""
    if not parts:
        return Trajectory(time=np.zeros(0), signals={}, work={"steps": 0})
    time = np.linspace(0.0, parts[-1].time[-1], samples)
    rows = np.concatenate([_sampled(part, time, k == 0) for k, part in enumerate(parts)])
    signals = {
        "z": rows[:, 0] * law.film_scale,
        "vz": rows[:, 1] * law.film_scale / law.time_scale,
        "force_z": rider.law.force(rows) * law.force_scale,
    }
    steps = sum(len(part.time) - 1 for part in parts)
    units = {"z": "m", "vz": "m/s", "force_z": "N"} if law.film_scale != 1.0 else {}
    return Trajectory(time=time * law.time_scale, signals=signals, work={"steps": steps}, units=units)


def _sampled(part: _Part, time: Array, first: bool) -> Array:
    """Return y at the times within a part."""
    begin, end = part.time[0], part.time[-1]
    inside = time[((time > begin) | (first & (time == begin))) & (time <= end)]
    k = np.minimum(np.searchsorted(part.time, inside, side="right"), len(part.time) - 1) - 1
    step = part.time[1] - part.time[0]
    share = ((inside - part.time[k]) / step)[:, None]
    before, after = part.y[k], part.y[k + 1]
    rows = np.asarray(before + share * (after - before), dtype=float)
    # Hermite, where rates are known: of the approach, the velocity.
    rows[:, 0], _ = cubic(before[:, 0], after[:, 0], step * before[:, 1], step * after[:, 1], share[:, 0])
    return rows
