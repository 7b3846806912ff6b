"""The implicit scheme: each macro step is repeated until rotor and films agree at its end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import ConvergenceError, require_count, require_positive
from ...inputs.si_arguments import quantities
from ...model import Array
from ...rotors.force_law import held_law
from ..bench import Bench, Needs, Sample

LEAST = 1e-30
"""Of several runs at once, the smallest force that counts, in the largest."""


@quantities
@dataclass(frozen=True, kw_only=True)
class Newton:
    """The force of a step is held at the mean of both ends, found by Newton's method with rollback.

    The films tell their derivatives; those of the rotor, by the force, are had from one trial step for each
    force, in the first step and wherever the length of the step changes, exact for a linear rotor. Needs no
    more of a rotor than held forces and the way back, so any Co-Simulation FMU with FMU states will do.
    It damps what is fast hardly at all, and a light journal on an elastic shaft gives it a limit after all.

    Parameters
    ----------
    tolerance : float [1]
        Imbalance of the force that is accepted, relative to it.
    most : int
        Iterations before a step counts as failed.

    Raises
    ------
    InputError
        If a value is not positive.
    """

    tolerance: float = 1e-6
    most: int = 12

    order = 2
    label = "Newton"
    needs = Needs(derivatives=True, rollback=True)

    def __post_init__(self) -> None:
        require_positive("tolerance", self.tolerance)
        require_count("most", self.most)

    def step(self, bench: Bench, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step; see `Scheme`.

        Raises
        ------
        ConvergenceError
            If the iteration does not converge.
        """
        now = history[-1]
        force, sensitivity = _guess(history, t + 0.5 * dt), bench.sensitivity(t, dt)
        for _ in range(self.most):
            state = bench.save()
            found = bench.evaluate(t, dt, bench.drive(t, dt, held_law(t, force)), True)
            residual = force - 0.5 * (now.force + found.force)
            size = np.max(np.abs(force) + np.abs(now.force), axis=0)
            size = np.maximum(size, LEAST * np.max(size))
            if np.all(np.max(np.abs(residual), axis=0) <= self.tolerance * size):
                bench.release(state)
                return found
            bench.restore(state)
            force = force - _correction(found, sensitivity, residual)
        raise ConvergenceError(
            f"the coupling must converge in {self.most} iterations, got stuck at t = {t:.9g} s with an "
            f"imbalance of {np.max(np.abs(residual)):.3g} N"
        )


def _guess(history: Sequence[Sample], middle: float) -> Array:
    """Return the force extrapolated to the middle of the step."""
    if len(history) < 2:
        return history[-1].force
    before, now = history[-2:]
    ahead = (middle - now.time) / (now.time - before.time)
    force: Array = now.force + ahead * (now.force - before.force)
    return force


def _correction(found: Sample, sensitivity: Array, residual: Array) -> Array:
    """Return Newton's step of the held force: the film's tangents through the rotor's sensitivity."""
    assert found.tangents is not None  # the scheme asks for them
    m = len(sensitivity) // 2
    feedback = found.tangents.stiffness @ sensitivity[:m] + found.tangents.damping @ sensitivity[m:]
    return np.asarray(np.linalg.solve(np.eye(m) + 0.5 * feedback, residual))
