"""One coupled run: rotor and films over macro steps by a scheme, under watch."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..errors import (
    ContactError,
    ConvergenceError,
    CouplingError,
    FilmContactError,
    FmuError,
    FmuRunError,
    PartialResultError,
    require_positive,
)
from ..readable.result import Drawable, Readable
from ..results import Trajectory
from .bench import Sample
from .chatter import CouplingReport, inspect_coupling
from .partners import Partners
from .schemes.explicit import GaussSeidel
from .schemes.scheme import MEMORY, Scheme
from .slaves import Slave
from .watch import CouplingWatch, Watch

COARSE = 0.3
"""Local error, in root mean square forces, of a run that is no answer; it is below 0.08 in good ones."""


@dataclass(frozen=True, kw_only=True)
class Trial(Readable):
    """What a trial run of one scheme said.

    Attributes
    ----------
    scheme : Scheme
    orbit_error : float or None [1]
        Largest distance from the reference / largest displacement; None where there is no run.
    spectral_radius : float or None [1]
        Largest growth per macro step met; None where the scheme has no limit, or nothing tells.
    film_calls : float or None [1]
        Film evaluations and derivatives per macro step.
    reason : str
        Why it was taken or not.
    """

    scheme: Scheme
    orbit_error: float | None
    spectral_radius: float | None
    film_calls: float | None
    reason: str


@dataclass(frozen=True, kw_only=True)
class Choice(Readable):
    """The scheme chosen, and the trials that led to it.

    Attributes
    ----------
    scheme : Scheme
    trials : tuple of Trial
    """

    scheme: Scheme
    trials: tuple[Trial, ...]


@dataclass(frozen=True, kw_only=True)
class CoSimulation(Drawable):
    """The outcome of a co-simulation.

    Attributes
    ----------
    trajectory : Trajectory
        Every output of all partners at the communication points. Work: steps, film_evaluations,
        film_jacobians, rotor_steps, rollbacks.
    macro_step : float [s]
    scheme : Scheme
    coupling : CouplingReport
        Whether the coupling can be believed, by the forces exchanged.
    watch : CouplingWatch
        How far the coupling was from its limit, and its local error.
    choice : Choice or None
        Why this scheme was taken, if it was left to `Auto`.
    """

    trajectory: Trajectory
    macro_step: float
    scheme: Scheme
    coupling: CouplingReport
    watch: CouplingWatch
    choice: Choice | None = None

    @property
    def film_calls(self) -> int:
        """Calls of the films, those of derivatives included where the scheme asks for them."""
        work = self.trajectory.work
        return work["film_evaluations"] + (work["film_jacobians"] if self.scheme.needs.derivatives else 0)


def couple(
    rotor: Slave,
    film: Slave | Mapping[str, Slave],
    *,
    macro_step: float,
    duration: float,
    scheme: Scheme | None = None,
    progress: Callable[[float], None] | None = None,
) -> CoSimulation:
    """Couple partners that were not started yet; see `cosimulate`, which opens them and has the errors."""
    require_times(macro_step, duration)
    chosen = GaussSeidel() if scheme is None else scheme
    films = film if isinstance(film, Mapping) else {"": film}
    run = _Run(Partners(rotor, films, chosen.needs), chosen, macro_step)
    try:
        run.start()
        for t, dt in _steps(macro_step, duration):
            run.reach(t, t + dt)
            if progress is not None:
                progress(t + dt)
            run.judge()
    except (FilmContactError, FmuError, ConvergenceError) as failure:
        raise _failed(failure, run.result()) from failure
    result = run.result()
    if _is_coarse(result) or result.coupling.chatter:
        raise CouplingError(_coupling_message(result), result)
    return result


def _is_coarse(result: CoSimulation) -> bool:
    """Return whether the steps were too long for the motion, by bursts or throughout."""
    local = result.watch.local_error
    return result.coupling.coarse or (local is not None and local > COARSE)


def require_times(macro_step: float, duration: float) -> None:
    """Raise InputError unless both are finite and positive."""
    require_positive("macro_step", macro_step)
    require_positive("duration", duration)


class _Run:
    """A co-simulation on its way: the partners, and what they have exchanged so far."""

    def __init__(self, partners: Partners, scheme: Scheme, macro_step: float) -> None:
        self._partners, self._scheme, self._macro_step = partners, scheme, macro_step
        self._samples: list[Sample] = []
        self._watch = Watch(partners, scheme, macro_step)

    def start(self) -> None:
        """Start rotor and films."""
        self._keep(self._partners.start())

    def reach(self, t: float, end: float) -> None:
        """Advance to the end of a macro step, in one step of the scheme unless that takes shorter ones."""
        while t < end:
            found = self._scheme.step(self._partners, self._samples[-MEMORY:], t, end - t)
            self._keep(found)
            self._partners.work["steps"] += 1
            t = end if found.time >= end - 1e-9 * self._macro_step else found.time

    def judge(self) -> None:
        """Raise CouplingError where the run has begun to chatter."""
        if self._watch.chatters:
            result = self.result()
            if result.coupling.chatter or result.coupling.coarse:
                raise CouplingError(_coupling_message(result), result)

    def result(self) -> CoSimulation:
        """Return what has been exchanged so far."""
        time = np.array([sample.time for sample in self._samples])
        rows = [{**sample.motion.outputs, **sample.outputs} for sample in self._samples]
        signals = {name: np.array([row[name] for row in rows]) for name in self._partners.signals}
        forces = (
            np.array([sample.force for sample in self._samples]).reshape(len(rows), self._partners.size).T
        )
        return CoSimulation(
            trajectory=Trajectory(
                time=time, signals=signals, work=dict(self._partners.work), units=self._partners.units
            ),
            macro_step=self._macro_step,
            scheme=self._scheme,
            coupling=inspect_coupling(time, forces),
            watch=self._watch.result(),
        )

    def _keep(self, sample: Sample) -> None:
        self._samples.append(sample)
        self._watch.see(sample)


def _steps(macro_step: float, duration: float) -> list[tuple[float, float]]:
    """Return (t, dt) of each step; times are multiples, not sums, so that roundoff does not add up."""
    count = max(1, math.ceil(duration / macro_step * (1.0 - 1e-12)))
    points = [*(k * macro_step for k in range(count)), duration]
    return [(start, end - start) for start, end in pairwise(points)]


def _failed(failure: Exception, result: CoSimulation) -> PartialResultError:
    """Return the error for a run that broke off, by its likeliest cause."""
    if result.coupling.chatter:
        return CouplingError(f"{_coupling_message(result)}; it ended with: {failure}", result)
    if isinstance(failure, FilmContactError):
        time = result.trajectory.time
        reached = f"after t = {time[-1]:.9g} s" if time.size else "at t = 0"
        doubt = f"; {result.watch.warnings[0]}" if result.watch.warnings else ""
        return ContactError(
            f"journal reached the wall {reached}, unless a macro step of {result.macro_step:.6g} s is too "
            f"long for this coupling: {failure}{doubt}",
            result,
        )
    if isinstance(failure, FmuError):
        return FmuRunError(str(failure), result)
    return ConvergenceError(str(failure), result)


def _coupling_message(result: CoSimulation) -> str:
    report, local = result.coupling, result.watch.local_error
    if not report.chatter and not report.coarse and local is not None:
        return (
            f"macro_step must be short enough for the motion, got {result.macro_step:.6g} s: within single "
            f"steps the force changes by {100.0 * local:.2g} % of its root mean square more than "
            f"{result.scheme.label} foresees"
        )
    if not report.chatter:
        return (
            f"macro_step must be short enough for the motion, got {result.macro_step:.6g} s: around "
            f"t = {report.onset:.6g} s the force jumps by half its root mean square from step to step"
        )
    return (
        f"macro_step must be below the stability limit of the coupling, got {result.macro_step:.6g} s: the "
        f"force alternates from step to step since t = {report.onset:.6g} s, by up to "
        f"{100.0 * report.amplitude:.2g} % of its root mean square, without decaying"
    )
