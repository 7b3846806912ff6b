"""A linearly implicit scheme for films that remember: their drift is told from two points behind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..bench import Bench, Needs, Sample
from .implicit import defect, tangent_law
from .scheme import started


@dataclass(frozen=True)
class SIMemory:
    """SI-exp, and the parabola in time through what the last two steps left over: for films with states.

    A film with states changes where nothing moves, so that what its tangents at t_n leave of the force
    begins with a slope, left(s) = a s + b s^2, s = t - t_n. Both follow from left(t_(n-1) - t_n) and
    left(t_(n-2) - t_n). Of third order at the price of SI-exp, with a film that is told, as `JFOFilm`,
    where the journal is at the end of a step and goes there smoothly; a film whose inputs are held over the
    step stays of first order. A run begins with short steps, as with forces extrapolated by parabolas.
    """

    order = 3
    label = "SI-memory"
    needs = Needs(derivatives=True, laws=True)

    def step(self, bench: Bench, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step, at the start by a part of it; see `Scheme`."""
        dt = started(history, 2, dt)
        law = tangent_law(history, np.zeros_like(history[-1].force))
        if len(history) > 2:
            now = history[-1]
            lags = np.array([point.time - now.time for point in history[-3:-1]])
            left = np.array([defect(point, now) for point in history[-3:-1]])
            columns = np.stack([lags, lags**2], axis=1)
            slope, curvature = np.linalg.solve(columns, left.reshape(2, -1)).reshape(left.shape)
            law = law._replace(slope=law.slope + slope, curvature=curvature)
        return bench.evaluate(t, dt, bench.drive(t, dt, law), True)
