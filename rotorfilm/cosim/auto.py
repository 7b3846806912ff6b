"""The cheapest scheme that is stable and accurate enough, found by trial runs, and why it is that one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..errors import (
    ContactError,
    ConvergenceError,
    CouplingError,
    InputError,
    PartialResultError,
    require_positive,
)
from ..inputs.si_arguments import quantities
from ..results import Trajectory, orbit_distance
from .cosim_run import Choice, CoSimulation, Trial
from .schemes.explicit import GaussSeidel
from .schemes.implicit import SIExp3
from .schemes.newton import Newton
from .schemes.scheme import Scheme
from .watch import quietly

TRIAL_STEPS = 180
"""Longest trial run, in macro steps: half a turn of the shaft at one degree."""

CANDIDATES: tuple[Scheme, ...] = (
    GaussSeidel(),
    GaussSeidel(degree=1),
    GaussSeidel(degree=2),
    SIExp3(),
    Newton(),
)
"""From the cheapest step to the dearest: Jacobi is Gauss-Seidel with a shorter limit, SI-exp no cheaper than
SI-exp3."""

REFERENCES: tuple[tuple[Scheme, int], ...] = (
    (SIExp3(), 2),
    (Newton(), 4),
    (GaussSeidel(degree=2), 16),
    (GaussSeidel(), 64),
)
"""What trials are compared with, and how much shorter its macro step is: the first that is possible."""


@quantities
@dataclass(frozen=True, kw_only=True)
class Auto:
    """Asks for the cheapest scheme that is stable and accurate enough.

    Parameters
    ----------
    tolerance : float [1]
        Largest distance of a trial run from a finer one, relative to the largest displacement met.

    Raises
    ------
    InputError
        If the tolerance is not positive.
    """

    tolerance: float = 1e-2

    def __post_init__(self) -> None:
        require_positive("tolerance", self.tolerance)


class Attempt(Protocol):
    """Makes a new run from the start."""

    def __call__(self, scheme: Scheme, macro_step: float, duration: float) -> CoSimulation:
        """Return the run, or raise what `couple` raises."""


def choose_scheme(attempt: Attempt, auto: Auto, *, macro_step: float, duration: float) -> Choice:
    """Return the cheapest scheme whose trial run is stable and within the tolerance.

    Parameters
    ----------
    attempt : Attempt
    auto : Auto
    macro_step, duration : float [s]
        Of the run to come; trials are as long, `TRIAL_STEPS` steps at most.

    Raises
    ------
    InputError
        If no scheme is stable and accurate enough; the message has all trials.
    ContactError
        If the journal reaches the wall.
    """
    length = min(duration, TRIAL_STEPS * macro_step)
    with quietly():
        reference = _reference(attempt, macro_step, length)
        trials: list[Trial] = []
        for scheme in CANDIDATES:
            trial, taken = _tried(attempt, scheme, reference, auto.tolerance, macro_step, length)
            trials.append(trial)
            if taken:
                return Choice(scheme=scheme, trials=tuple(trials))
    told = "; ".join(f"{trial.scheme.label}: {trial.reason}" for trial in trials)
    raise InputError(f"macro_step must be short enough for some scheme, got {macro_step:.6g} s: {told}")


def _reference(attempt: Attempt, macro_step: float, length: float) -> Trajectory:
    """Return a run with shorter macro steps."""
    for scheme, times in REFERENCES[:-1]:
        try:
            return attempt(scheme, macro_step / times, length).trajectory
        except (ContactError, InputError, ConvergenceError, CouplingError):
            continue
    scheme, times = REFERENCES[-1]
    return attempt(scheme, macro_step / times, length).trajectory


def _tried(
    attempt: Attempt,
    scheme: Scheme,
    reference: Trajectory,
    tolerance: float,
    macro_step: float,
    length: float,
) -> tuple[Trial, bool]:
    """Return what a trial says, and whether the scheme will do."""

    def trial(reason: str, error: float | None = None, run: CoSimulation | None = None) -> Trial:
        radius = None if run is None else run.watch.spectral_radius
        calls = None if run is None else _calls(run)
        return Trial(
            scheme=scheme, orbit_error=error, spectral_radius=radius, film_calls=calls, reason=reason
        )

    try:
        run = attempt(scheme, macro_step, length)
    except InputError as failure:
        return trial(str(failure)), False
    except PartialResultError as failure:
        return trial(_failure(failure)), False
    error = _distance(run.trajectory, reference)
    radius = run.watch.spectral_radius
    if radius is not None and radius > 1.0 and run.watch.warnings:
        return trial(f"unstable: grows by a factor of {radius:.4g} per macro step", error, run), False
    if error > tolerance:
        return trial(f"not accurate enough: off by {error:.2g}", error, run), False
    reason = f"stable, off by {error:.2g}, {_calls(run):.3g} film calls per step: the cheapest that will do"
    return trial(reason, error, run), True


def _failure(failure: PartialResultError) -> str:
    """Return why a trial broke off: where the coupling was unstable by theory, that."""
    partial = failure.partial
    warned = partial.watch.warnings if isinstance(partial, CoSimulation) else ()
    return f"unstable: {warned[0]}" if warned else str(failure)


def _calls(run: CoSimulation) -> float:
    """Return the film calls per macro step."""
    return run.film_calls / (run.trajectory.work["steps"] + 1)


def _distance(own: Trajectory, reference: Trajectory) -> float:
    """Return the largest distance of the journals / largest displacement."""
    names = [name for name in own.signals if name == "x" or name.endswith("_x")]
    journals = [(name, f"{name[:-1]}y") for name in names if "force" not in name]
    reach = max(float(np.hypot(reference[x], reference[y]).max()) for x, y in journals)
    return orbit_distance(own, reference, journals) / reach
