"""The master: rotor and films coupled over macro steps by a scheme, under watch."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from itertools import pairwise
from os import PathLike

import numpy as np

from ..errors import (
    ContactError,
    ConvergenceError,
    CouplingError,
    FilmContactError,
    FmuError,
    FmuRunError,
    InputError,
    PartialResultError,
    require_positive,
)
from ..results import Trajectory
from .bench import Partners, Sample
from .chatter import CouplingReport, inspect_coupling
from .explicit import GaussSeidel
from .fmu_slave import open_fmu, open_rotor
from .scheme import MEMORY, Scheme
from .slaves import Slave
from .watch import CouplingWatch, Watch

Paths = str | PathLike[str] | Mapping[str, str | PathLike[str]]


@dataclass(frozen=True, kw_only=True)
class CoSimulation:
    """The outcome of a co-simulation.

    Attributes
    ----------
    trajectory : Trajectory
        Every output of all partners at the communication points. Work: steps, film_evaluations, film_jacobians,
        rotor_steps, rollbacks.
    macro_step : float [s]
    scheme : Scheme
    coupling : CouplingReport
        Whether the coupling can be believed, by the forces exchanged.
    watch : CouplingWatch
        How far the coupling was from its limit, and its local error.
    """

    trajectory: Trajectory
    macro_step: float
    scheme: Scheme
    coupling: CouplingReport
    watch: CouplingWatch


def cosimulate(
    rotor_fmu: str | PathLike[str],
    film_fmu: Paths,
    *,
    macro_step: float,
    duration: float,
    scheme: Scheme | None = None,
    progress: Callable[[float], None] | None = None,
) -> CoSimulation:
    """Couple a rotor FMU with one or several film FMUs of FMI 2.0 or 3.0, from t = 0.

    Signals are connected by their local names (`rotor.x` to `film.x`; in a rotor with several journals
    `rotor.left_x` to `x` of the film in the station `left`).

    Parameters
    ----------
    rotor_fmu : path
        It takes forces and gives motion. Co-Simulation will do for held forces; other schemes take an FMU for
        Model Exchange with directional derivatives, which the master integrates, or one with the inputs of a
        force law (`rotorfilm.rotors.LawRotor`).
    film_fmu : path, or mapping of station to path
        It takes motion and gives forces, for Co-Simulation.
    macro_step : float [s]
        Distance of the communication points; the last step is shorter where it must be.
    duration : float [s]
    scheme : Scheme, optional
        `GaussSeidel()` by default: the film is evaluated at the rotor's new state, and its force is held over
        the next step.
    progress : callable, optional
        Called after each step with the time reached [s].

    Raises
    ------
    InputError
        If an argument is out of range, the signals do not fit or an FMU lacks what the scheme needs.
    CouplingError
        If the forces alternate from step to step without decaying: the macro step is past the stability
        limit. The run stops there; carries the CoSimulation until then.
    ContactError
        If the journal reached the wall; carries the CoSimulation until then.
    FmuError
        If a file is no such FMU; as FmuRunError, with the CoSimulation until then, if an FMU fails.
    ConvergenceError
        If the scheme or the rotor's integration does not converge; carries the CoSimulation until then.
    """
    _require_times(macro_step, duration)
    chosen = GaussSeidel() if scheme is None else scheme
    paths = dict(film_fmu) if isinstance(film_fmu, Mapping) else {"": film_fmu}
    with ExitStack() as stack:
        rotor = stack.enter_context(open_rotor(rotor_fmu, held=not chosen.needs.laws))
        films = {name: stack.enter_context(open_fmu(path)) for name, path in paths.items()}
        return couple(
            rotor, films, macro_step=macro_step, duration=duration, scheme=chosen, progress=progress
        )


def couple(
    rotor: Slave,
    film: Slave | Mapping[str, Slave],
    *,
    macro_step: float,
    duration: float,
    scheme: Scheme | None = None,
    progress: Callable[[float], None] | None = None,
) -> CoSimulation:
    """Couple partners that were not started yet; see `cosimulate`, which does this with FMUs."""
    _require_times(macro_step, duration)
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
    if result.coupling.chatter or result.coupling.coarse:
        raise CouplingError(_coupling_message(result), result)
    return result


def _require_times(macro_step: float, duration: float) -> None:
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
        forces = np.array([sample.force for sample in self._samples]).reshape(len(rows), self._partners.size).T
        return CoSimulation(
            trajectory=Trajectory(time=time, signals=signals, work=dict(self._partners.work)),
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
        return ContactError(
            f"journal reached the wall {reached}, unless a macro step of {result.macro_step:.6g} s is too "
            f"long for this coupling: {failure}",
            result,
        )
    if isinstance(failure, FmuError):
        return FmuRunError(str(failure), result)
    return ConvergenceError(str(failure), result)


def _coupling_message(result: CoSimulation) -> str:
    report = result.coupling
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
