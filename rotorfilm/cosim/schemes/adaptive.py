"""Macro steps of the length that the error asks for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ...errors import ConvergenceError, require_positive
from ...inputs.si_arguments import quantities
from ..bench import Bench, Needs, Sample
from .implicit import SIExp3, defect
from .scheme import Scheme

SAFETY = 0.8
LEAST, MOST = 0.3, 2.0
"""Factors between one step and the next."""

GIVE_UP = 1e-6
"""Shortest step, in the macro step, before a run counts as failed."""


@quantities
@dataclass(frozen=True, kw_only=True)
class Adaptive:
    """Another scheme with macro steps of its own choice; that of the run is the longest, and the first.

    What the tangents leave of the force between two points, D, is a free estimate of the local error: a
    step is accepted where the change of D from the step before, or D itself, is within the tolerance, and
    is repeated at a shorter length otherwise.

    Parameters
    ----------
    tolerance : float [1]
        Accepted error of the force within a step, relative to the force.
    scheme : SIExp or SIExp3

    Raises
    ------
    InputError
        If the tolerance is not positive.
    """

    tolerance: float = 1e-3
    scheme: Scheme = field(default_factory=SIExp3)

    def __post_init__(self) -> None:
        require_positive("tolerance", self.tolerance)

    @property
    def order(self) -> int:
        """Order of convergence in the tolerance's step."""
        return self.scheme.order

    @property
    def label(self) -> str:
        """Its name in print."""
        return f"adaptive {self.scheme.label}"

    @property
    def needs(self) -> Needs:
        """What the scheme needs, and a way back."""
        return self.scheme.needs._replace(derivatives=True, rollback=True)

    def step(self, bench: Bench, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance from t by dt or less; the sample says how far it got."""
        shortest = GIVE_UP * dt
        dt = min(dt, self._proposed(history, dt))
        while True:
            state = bench.save()
            found = self.scheme.step(bench, history, t, dt)
            error = self._error(history, found)
            if error <= 1.0:
                bench.release(state)
                return found
            bench.restore(state)
            dt *= max(LEAST, SAFETY * error ** (-1.0 / self.order))
            if dt < shortest:
                raise ConvergenceError(f"the macro step fell below {shortest:.3g} s at t = {t:.9g} s")

    def _proposed(self, history: Sequence[Sample], dt: float) -> float:
        """Return the length that the last step's error asks for."""
        if len(history) < 2:
            return dt
        last = history[-1].time - history[-2].time
        error = self._error(history[:-1], history[-1])
        return last * float(np.clip(SAFETY * max(error, 1e-12) ** (-1.0 / self.order), LEAST, MOST))

    def _error(self, history: Sequence[Sample], found: Sample) -> float:
        """Return the error of the force in tolerances."""
        now = history[-1]
        left = defect(now, found)
        if self.order > 2 and len(history) > 1:
            ratio = (found.time - now.time) / (now.time - history[-2].time)
            left = left - ratio**2 * defect(history[-2], now)
        size = float(np.linalg.norm(found.force) + np.linalg.norm(now.force)) / 2.0
        return float(np.linalg.norm(left)) / (self.tolerance * size) if size > 0.0 else 0.0
