"""What a coupling scheme is, and extrapolation from the communication points behind it."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Protocol

import numpy as np

from ...errors import InputError
from ...model import Array
from ...rotors.force_law import ForceLaw, held_law
from ..bench import Bench, Needs, Sample

MEMORY = 4
"""Communication points that a scheme may look back on."""


Moment = float | Array
"""A time [s], or one for each of several runs."""

FIRST = 1.0 / 63.0
"""First step of a scheme of parabolas, in macro steps: doubled five times, the sum is one."""


class Scheme(Hashable, Protocol):
    """How rotor and films take turns over one macro step.

    Schemes are frozen dataclasses without memory: what they extrapolate from is handed to them.
    """

    @property
    def order(self) -> int:
        """Order of convergence in the macro step."""

    @property
    def label(self) -> str:
        """Its name in print."""

    @property
    def needs(self) -> Needs:
        """What it asks of its partners."""

    def step(self, bench: Bench, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance from t to t + dt [s], or less, and return what was exchanged there.

        Parameters
        ----------
        bench : Bench
            Rotor and films.
        history : sequence of Sample
            The latest communication points, the present one last; at least one.
        t, dt : float [s]
            Start and length of the step.
        """


def extrapolation(times: Sequence[Moment], values: Sequence[Array]) -> tuple[Array, Array, Array]:
    """Return the polynomial through the latest values, as value, slope and curvature about the last time.

    Parameters
    ----------
    times : sequence of float, or of ndarray that fits the values [s]
        One to three, rising.
    values : sequence of ndarray
        One for each.
    """
    value, slope, curvature = values[-1], np.zeros_like(values[-1]), np.zeros_like(values[-1])
    if len(times) > 1:
        last = times[-1] - times[-2]
        slope = (values[-1] - values[-2]) / last
        if len(times) > 2:
            before = (values[-2] - values[-3]) / (times[-2] - times[-3])
            curvature = (slope - before) / (times[-1] - times[-3])
            slope = slope + curvature * last
    return value, slope, curvature


def extrapolated_law(history: Sequence[Sample], degree: int) -> ForceLaw:
    """Return the law of forces extrapolated by a polynomial of this degree, or less at the start."""
    latest = history[-1 - degree :]
    if len(latest) == 1:
        return held_law(latest[-1].time, latest[-1].force)
    value, slope, curvature = extrapolation([s.time for s in latest], [s.force for s in latest])
    return held_law(latest[-1].time, value)._replace(slope=slope, curvature=curvature)


def started(history: Sequence[Sample], degree: int, dt: float) -> float:
    """Return the length of a step: parabolas need a past, so a run begins with short steps.

    A force held over the first step would spoil the order for good; over FIRST of it, it does not matter.
    """
    if degree < 2:
        return dt
    if len(history) < 2:
        return FIRST * dt
    return min(dt, 2.0 * (history[-1].time - history[-2].time))


def require_degree(degree: int) -> None:
    """Raise InputError unless forces can be extrapolated by this degree."""
    if isinstance(degree, bool) or degree not in (0, 1, 2):
        raise InputError(f"degree must be 0, 1 or 2, got {degree!r}")
