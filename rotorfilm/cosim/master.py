"""The master: opens rotor and films, FMUs or models, and couples them by a scheme, or by the best one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass, replace
from functools import partial
from os import PathLike
from typing import cast

import numpy as np

from ..core.errors import (
    ContactError,
    ConvergenceError,
    CouplingError,
    InputError,
    PartialResultError,
    require_positive,
)
from ..core.inputs import arguments, quantities
from ..core.model import Dynamic, Model, Stepped
from ..core.port import takes_steps
from ..core.results import Trajectory, orbit_distance
from ..fmu.instance import extracted
from ..rotors.force_law import BASE_TIME
from .cosim_run import Choice, CoSimulation, Trial, couple, first_possible, require_times
from .fmu_slave import ExchangeRotor, FmuSlave, local_name
from .schemes import GaussSeidel, Newton, Scheme, SIExp3
from .slaves import InProcessSlave, Slave, SteppedPartner
from .watch import quietly

Path = str | PathLike[str]
Film = Path | Model | Stepped


@arguments
def cosimulate(
    rotor_fmu: Path | Dynamic,
    film_fmu: Film | Mapping[str, Film],
    *,
    macro_step: float,
    duration: float,
    scheme: Scheme | Auto | str | None = None,
    progress: Callable[[float], None] | None = None,
) -> CoSimulation:
    """Couple a rotor with one or several films, FMUs of FMI 2.0 or 3.0 or models in this process, from t = 0.

    Signals are connected by their local names (`rotor.x` to `film.x`; in a rotor with several journals
    `rotor.left_x` to `x` of the film in the station `left`). The loop over the macro steps runs in C,
    in chunks between which it is watched and can be interrupted, where scheme and partners allow it:
    Gauss-Seidel, Jacobi, SI-exp and SI-exp3 over FMUs and over models with a kernel.

    Parameters
    ----------
    rotor_fmu : path or Dynamic
        It takes forces and gives motion. Co-Simulation will do for held forces; other schemes take an FMU for
        Model Exchange with directional derivatives, which the master integrates, or one with the inputs of a
        force law (`LawRotor`).
    film_fmu : path, Model or JFOFilm, or mapping of station to such
        It takes motion and gives forces, for Co-Simulation.
    macro_step : float [s]
        Distance of the communication points; the last step is shorter where it must be.
    duration : float [s]
    scheme : Scheme or Auto, optional
        `GaussSeidel()` by default: the film is evaluated at the rotor's new state, and its force is held over
        the next step. `Auto()`, or "auto" for short, finds the cheapest that is stable and accurate enough.
    progress : callable, optional
        Called for each step with the time reached [s], once a chunk of them is done.

    Raises
    ------
    InputError
        If an argument is out of range, the signals do not fit, an FMU lacks what the scheme needs, or no
        scheme is good enough for `Auto`.
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
    require_times(macro_step, duration)
    films = film_fmu if isinstance(film_fmu, Mapping) else {"": film_fmu}
    attempt, wanted = partial(_run, rotor_fmu, films), _required(scheme)
    if not isinstance(wanted, Auto):
        return attempt(wanted, macro_step, duration, progress)
    choice = choose_scheme(attempt, wanted, macro_step=macro_step, duration=duration)
    return replace(attempt(choice.scheme, macro_step, duration, progress), choice=choice)


def _required(scheme: Scheme | Auto | str | None) -> Scheme | Auto:
    if scheme is None:
        return GaussSeidel()
    if isinstance(scheme, str):
        if scheme != "auto":
            raise InputError(f"scheme must be a scheme such as SIExp3(), or 'auto', got {scheme!r}")
        return Auto()
    return scheme


def _run(
    rotor: Path | Dynamic,
    films: Mapping[str, Film],
    scheme: Scheme,
    macro_step: float,
    duration: float,
    progress: Callable[[float], None] | None = None,
) -> CoSimulation:
    """Open all partners and couple them."""
    with ExitStack() as stack:

        def opened(film: Film) -> Slave:
            if isinstance(film, str | PathLike):
                return stack.enter_context(open_fmu(film))
            return SteppedPartner(film) if takes_steps(film) else InProcessSlave(cast(Model, film))

        if isinstance(rotor, str | PathLike):
            first: Slave = stack.enter_context(open_rotor(rotor, held=not scheme.needs.laws))
        else:
            first = InProcessSlave(rotor)
        others = {station: opened(film) for station, film in films.items()}
        return couple(
            first, others, macro_step=macro_step, duration=duration, scheme=scheme, progress=progress
        )


def open_fmu(path: Path) -> AbstractContextManager[FmuSlave]:
    """Extract and instantiate an FMU; free it and delete the files at the end, in any case.

    Parameters
    ----------
    path : path of the .fmu file

    Raises
    ------
    FmuError
        If the file cannot be read, is no Co-Simulation FMU of FMI 2.0 or 3.0, or cannot be instantiated.
    """
    return _opened(path, exchanges=False)


def open_rotor(path: Path, *, held: bool) -> AbstractContextManager[FmuSlave]:
    """Extract and instantiate a rotor FMU; see `open_fmu`.

    It is opened for Co-Simulation where that will do, otherwise for Model Exchange.

    Parameters
    ----------
    path : path of the .fmu file
    held : bool
        Whether it need not take more than held forces.
    """
    return _opened(path, exchanges=True, held=held)


@contextmanager
def _opened(path: Path, *, exchanges: bool, held: bool = True) -> Iterator[FmuSlave]:
    """Open an FMU; one that may be for Model Exchange is, where Co-Simulation will not do."""
    with extracted(path) as (description, folder):
        enough = held or any(local_name(v.name) == BASE_TIME for v in description.modelVariables)
        enough = enough and description.coSimulation is not None
        exchange = exchanges and description.modelExchange is not None and not enough
        slave = (ExchangeRotor if exchange else FmuSlave)(description, folder)
        try:
            yield slave
        finally:
            slave.close()


# The cheapest scheme that is stable and accurate enough, found by trial runs, and why it is that one.


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


Attempt = Callable[[Scheme, float, float], CoSimulation]
"""Makes a new run from the start by a scheme, at a macro step and over a duration [s]; raises as `couple`."""


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

    def run(scheme: Scheme, times: int) -> Trajectory:
        return attempt(scheme, macro_step / times, length).trajectory

    return first_possible(run, REFERENCES, ContactError, InputError, ConvergenceError, CouplingError)


def _tried(
    attempt: Attempt,
    scheme: Scheme,
    reference: Trajectory,
    tolerance: float,
    macro_step: float,
    length: float,
) -> tuple[Trial, bool]:
    """Return what a trial says, and whether the scheme will do."""
    run, radius, error, taken = None, None, None, False
    try:
        run = attempt(scheme, macro_step, length)
    except InputError as failure:
        reason = str(failure)
    except PartialResultError as failure:
        reason = _failure(failure)
    else:
        error, radius = _distance(run.trajectory, reference), run.watch.spectral_radius
        if radius is not None and radius > 1.0 and run.watch.warnings:
            reason = f"unstable: grows by a factor of {radius:.4g} per macro step"
        elif error > tolerance:
            reason = f"not accurate enough: an error of {error:.2g}"
        else:
            taken, cost = True, f"{_calls(run):.3g} film calls per step"
            reason = f"stable, an error of {error:.2g}, {cost}: the cheapest that is good enough"
    calls = None if run is None else _calls(run)
    outcome = Trial(scheme=scheme, orbit_error=error, spectral_radius=radius, film_calls=calls, reason=reason)
    return outcome, taken


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
