"""The Gauss-Seidel master: rotor first, then the film at the rotor's new state, its force held meanwhile."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
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
    PartialResultError,
    require_positive,
)
from ..model import FORCE_OUTPUTS, indices
from ..results import Trajectory
from .chatter import CouplingReport, inspect_coupling
from .fmu_slave import open_fmu
from .slaves import Slave

ORDER = 1
"""Order of convergence in the macro step."""


@dataclass(frozen=True, kw_only=True)
class CoSimulation:
    """The outcome of a co-simulation.

    Attributes
    ----------
    trajectory : Trajectory
        Every output of both partners at the communication points. Work: steps, film_evaluations.
    macro_step : float [s]
    coupling : CouplingReport
        Whether the coupling can be believed.
    """

    trajectory: Trajectory
    macro_step: float
    coupling: CouplingReport


def cosimulate(
    rotor_fmu: str | PathLike[str],
    film_fmu: str | PathLike[str],
    *,
    macro_step: float,
    duration: float,
    progress: Callable[[float], None] | None = None,
) -> CoSimulation:
    """Couple a rotor FMU and a film FMU, both Co-Simulation of FMI 2.0 or 3.0, from t = 0.

    Signals are connected by their local names (`rotor.x` to `film.x`). The film is evaluated at the
    rotor's initial state first, then at each new one, and its force is held over the next step: a
    Gauss-Seidel scheme of order 1 in the macro step.

    Parameters
    ----------
    rotor_fmu, film_fmu : path
        The rotor takes forces and gives motion, the film takes motion and gives forces.
    macro_step : float [s]
        Distance of the communication points; the last step is shorter where it must be.
    duration : float [s]
    progress : callable, optional
        Called after each step with the time reached [s].

    Raises
    ------
    InputError
        If an argument is out of range or the signals do not fit.
    CouplingError
        If the forces alternate from step to step without decaying: the macro step is past the stability
        limit. Carries the CoSimulation.
    ContactError
        If the journal reached the wall; carries the CoSimulation until then.
    FmuError
        If a file is no such FMU; as FmuRunError, with the CoSimulation until then, if an FMU fails.
    """
    _require_times(macro_step, duration)
    with open_fmu(rotor_fmu) as rotor, open_fmu(film_fmu) as film:
        return couple(rotor, film, macro_step=macro_step, duration=duration, progress=progress)


def couple(
    rotor: Slave,
    film: Slave,
    *,
    macro_step: float,
    duration: float,
    progress: Callable[[float], None] | None = None,
) -> CoSimulation:
    """Couple two partners that were not started yet; see `cosimulate`, which does this with FMUs."""
    _require_times(macro_step, duration)
    run = _Run(rotor, film, macro_step)
    try:
        run.start()
        for t, dt in _steps(macro_step, duration):
            run.step(t, dt)
            if progress is not None:
                progress(t + dt)
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

    def __init__(self, rotor: Slave, film: Slave, macro_step: float) -> None:
        self._rotor, self._film, self._macro_step = rotor, film, macro_step
        self._force_names = _force_names(rotor, film)
        self._motion_names = _motion_names(rotor, film)
        self._times: list[float] = []
        self._motions: list[dict[str, float]] = []
        self._forces: list[dict[str, float]] = []

    def start(self) -> None:
        """Start the rotor, then the film at the rotor's initial state."""
        self._rotor.start({})
        motion = _finite("rotor", 0.0, self._rotor.get())
        self._film.start(_picked(motion, self._motion_names))
        self._keep(0.0, motion, _finite("film", 0.0, self._film.get()))

    def step(self, t: float, dt: float) -> None:
        """Advance the rotor under the last force, then evaluate the film at its new state."""
        self._rotor.set(_picked(self._forces[-1], self._force_names))
        self._rotor.step(t, dt)
        motion = _finite("rotor", t + dt, self._rotor.get())
        self._film.set(_picked(motion, self._motion_names))
        self._film.step(t, dt)
        self._keep(t + dt, motion, _finite("film", t + dt, self._film.get()))

    def result(self) -> CoSimulation:
        """Return what has been exchanged so far."""
        time = np.array(self._times)
        signals = {
            name: np.array([values[name] for values in series])
            for series, outputs in ((self._motions, self._rotor.outputs), (self._forces, self._film.outputs))
            for name in outputs
        }
        forces = np.array([signals[name] for name in self._force_names])
        work = {"steps": max(time.size - 1, 0), "film_evaluations": time.size}
        return CoSimulation(
            trajectory=Trajectory(time=time, signals=signals, work=work),
            macro_step=self._macro_step,
            coupling=inspect_coupling(time, forces),
        )

    def _keep(self, t: float, motion: dict[str, float], force: dict[str, float]) -> None:
        self._times.append(t)
        self._motions.append(motion)
        self._forces.append(force)


def _motion_names(rotor: Slave, film: Slave) -> list[str]:
    """Return the signals from rotor to film: every input of the film must be among them."""
    indices("rotor must have the outputs", rotor.outputs, film.inputs)
    return list(film.inputs)


def _force_names(rotor: Slave, film: Slave) -> list[str]:
    """Return the signals from film to rotor; further inputs of the rotor keep their start values."""
    indices("rotor must have the inputs", rotor.inputs, FORCE_OUTPUTS)
    indices("film must have the outputs", film.outputs, FORCE_OUTPUTS)
    return [name for name in rotor.inputs if name in film.outputs]


def _steps(macro_step: float, duration: float) -> list[tuple[float, float]]:
    """Return (t, dt) of each step; times are multiples, not sums, so that roundoff does not add up."""
    count = max(1, math.ceil(duration / macro_step * (1.0 - 1e-12)))
    points = [*(k * macro_step for k in range(count)), duration]
    return [(start, end - start) for start, end in pairwise(points)]


def _picked(values: Mapping[str, float], wanted: list[str]) -> dict[str, float]:
    return {name: values[name] for name in wanted}


def _finite(who: str, t: float, values: dict[str, float]) -> dict[str, float]:
    bad = {name: value for name, value in values.items() if not math.isfinite(value)}
    if bad:
        raise FmuError(f"outputs of the {who} must be finite, got {bad} at t = {t:.9g} s")
    return values


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
