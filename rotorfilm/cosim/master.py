"""Couple a rotor with films: one run of a scheme, and the choice of one by trials."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager, suppress
from dataclasses import dataclass, replace
from functools import partial
from os import PathLike
from typing import Any, TypeVar, cast

import numpy as np

from ..core.errors import (
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
from ..core.inputs import arguments, quantities
from ..core.limits import STEPS
from ..core.model import Dynamic, Model, Stepped
from ..core.port import takes_steps
from ..core.readable import Drawable, Readable
from ..core.results import Trajectory, orbit_distance
from ..fmu.instance import extracted
from ..rotors.force_law import BASE_TIME
from .compiled_loop import CompiledRun, compiled_run
from .fmu_slave import ExchangeRotor, FmuSlave, local_name
from .partners import Partners, Record
from .schemes import MEMORY, GaussSeidel, Newton, Sample, Scheme, SIExp3, started
from .slaves import InProcessSlave, Slave, SteppedPartner
from .watch import CouplingReport, CouplingWatch, Watch, inspect_coupling, quietly

T = TypeVar("T")

COARSE = 0.3
"""Local error, in root mean square forces, of a run that is no answer; it is below 0.08 in good ones."""

BLOCK = 32
"""Steps between two looks at a run, which is cut where it began to chatter."""


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
        Whether the result is reliable, judged from the exchanged forces.
    watch : CouplingWatch
        Distance of the coupling from its stability limit, and its local error.
    choice : Choice or None
        Why `Auto` chose this scheme, if it did.
    """

    trajectory: Trajectory
    macro_step: float
    scheme: Scheme
    coupling: CouplingReport
    watch: CouplingWatch
    choice: Choice | None = None

    @property
    def film_calls(self) -> int:
        """Calls of the films, including those for derivatives where the scheme needs them."""
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
    return coupled(Partners(rotor, films, chosen.needs), chosen, macro_step, duration, progress)


def coupled(
    partners: Partners,
    scheme: Scheme,
    macro_step: float,
    duration: float,
    progress: Callable[[float], None] | None = None,
    *,
    gentle: bool = False,
) -> CoSimulation:
    """Couple partners; see `couple`. A gentle start has short steps, as parabolas have, for any scheme."""
    run = _Run(partners, scheme, macro_step, duration, gentle)
    try:
        run.start()
        for times in run.reached():
            if progress is not None:
                for time in times:
                    progress(time)
        run.judge()
    except (FilmContactError, FmuError, ConvergenceError) as failure:
        run.judge()
        raise _failed(failure, run.result()) from failure
    result = run.result()
    if _is_coarse(result) or result.coupling.chatter:
        raise CouplingError(_coupling_message(result), result)
    return result


def _is_coarse(result: CoSimulation) -> bool:
    """Return whether the steps were too long for the motion, by bursts or throughout."""
    local = result.watch.local_error
    return result.coupling.coarse or (local is not None and local > COARSE)


def first_possible(make: Callable[..., T], options: Sequence[tuple[Any, ...]], *errors: type[Exception]) -> T:
    """Return what the first option makes that does not raise one of these errors; the last one may."""
    for option in options[:-1]:
        with suppress(*errors):
            return make(*option)
    return make(*options[-1])


def require_times(macro_step: float, duration: float) -> None:
    """Raise InputError unless both are finite and positive, and the steps no more than can be kept."""
    require_positive("macro_step", macro_step)
    require_positive("duration", duration)
    if duration > STEPS * macro_step:
        raise InputError(
            f"duration must be at most {STEPS:g} macro steps of {macro_step!r} s, got {duration!r} s"
        )


class _Run:
    """A co-simulation on its way: the partners, and what they have exchanged so far."""

    def __init__(
        self, partners: Partners, scheme: Scheme, macro_step: float, duration: float, gentle: bool
    ) -> None:
        self._partners, self._scheme, self._macro_step = partners, scheme, macro_step
        self._gentle = gentle
        self._history: list[Sample] = []
        self._record = Record(*partners.signals, partners.places, scheme.needs.derivatives)
        self._watch = Watch(partners, scheme, macro_step, self._record)

        self._points = _points(macro_step, duration)
        self._compiled: CompiledRun | None = None

    def start(self) -> None:
        """Start rotor and films."""
        self._keep(self._partners.start())
        self._record.work[0] = list(self._partners.work.values())
        kept = self._record, self._watch, self._macro_step, self._points
        self._compiled = compiled_run(self._partners, self._scheme, *kept, self._gentle)

    def reached(self) -> Iterator[Iterator[float]]:
        """Take all macro steps, in C where that is possible; yield the ends of those that were taken."""
        number, t, last = 0, self._points[0], len(self._points) - 1
        while number < last:
            before = number
            if self._compiled is None or self._compiled.rests():
                self._reach(t, number)
                number, t = number + 1, self._points[number + 1]
            else:
                number, t = self._compiled.advance(number, t, last)
                self._history = self._record.latest(MEMORY)
            if self._compiled is not None or number % BLOCK == 0:
                self.judge()
            yield map(self._end, range(before, number))

    def _end(self, number: int) -> float:
        """Return the end of a macro step [s], as its films have it."""
        begin = self._points[number]
        return begin + (self._points[number + 1] - begin)

    def _reach(self, t: float, number: int) -> None:
        """Advance to the end of a macro step, in one step of the scheme unless that takes shorter ones."""
        end = self._end(number)
        while t < end:
            dt = started(self._history, 2, end - t) if self._gentle else end - t
            found = self._scheme.step(self._partners, self._history, t, dt)
            self._keep(found)
            self._partners.work["steps"] += 1
            self._record.work[self._record.count - 1] = list(self._partners.work.values())
            t = end if found.time >= end - 1e-9 * self._macro_step else found.time

    def judge(self) -> None:
        """Raise CouplingError where the run has begun to chatter, without what was computed after that."""
        record = self._record
        while (count := self._watch.alarm()) is not None:
            coupling = inspect_coupling(record.time[:count], record.force[:count].T)
            if coupling.chatter or coupling.coarse:
                self._partners.work = Counter(record.work_at(count - 1))
                record.count = count
                result = self.result()
                raise CouplingError(_coupling_message(result), result)

    def result(self) -> CoSimulation:
        """Return what has been exchanged so far."""
        record = self._record
        time = record.time[: record.count].copy()
        return CoSimulation(
            trajectory=Trajectory(
                time=time,
                signals=record.signals(),
                work=dict(self._partners.work),
                units=self._partners.units,
            ),
            macro_step=self._macro_step,
            scheme=self._scheme,
            coupling=inspect_coupling(time, record.force[: record.count].T),
            watch=self._watch.result(),
        )

    def _keep(self, sample: Sample) -> None:
        self._history = [*self._history[1 - MEMORY :], sample]
        self._record.keep(sample)
        self._watch.check(sample.tangents)


def _points(macro_step: float, duration: float) -> list[float]:
    """Return the ends of all steps [s]; they are multiples, not sums, so that roundoff does not add up."""
    count = max(1, math.ceil(duration / macro_step * (1.0 - 1e-12)))
    return [*(k * macro_step for k in range(count)), duration]


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


# The master: opens rotor and films, FMUs or models, and couples them by a scheme, or by the best one.


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
    `rotor.left_x` to `x` of the film in the station `left`). Where possible the loop over the macro steps
    runs in C, in chunks between which it is monitored and can be interrupted. This holds for Gauss-Seidel,
    Jacobi, SI-exp and SI-exp3 with FMUs and with models that have a kernel.

    Parameters
    ----------
    rotor_fmu : path or Dynamic
        It takes forces and returns motion. An FMU for Co-Simulation is enough for held forces. Other schemes
        need an FMU for Model Exchange with directional derivatives, which the master integrates, or one with
        the inputs of a force law (`LawRotor`).
    film_fmu : path, Model or JFOFilm, or mapping of station to such
        It takes motion and returns forces; an FMU must be for Co-Simulation.
    macro_step : float [s]
        Distance of the communication points; the last step is shorter where it must be.
    duration : float [s]
    scheme : Scheme or Auto, optional
        `GaussSeidel()` by default: the film is evaluated at the rotor's new state, and its force is held over
        the next step. `Auto()`, or "auto" for short, finds the cheapest that is stable and accurate enough.
    progress : callable, optional
        Called with the time reached [s] after each chunk of steps.

    Raises
    ------
    InputError
        If an argument is out of range, the signals do not fit, an FMU lacks what the scheme needs, or no
        scheme is good enough for `Auto`.
    CouplingError
        If the forces alternate from step to step without decaying: the macro step is past the stability
        limit. The run stops there; the error carries the CoSimulation until then.
    ContactError
        If the journal reached the wall; the error carries the CoSimulation until then.
    FmuError
        If a file is no such FMU; as FmuRunError, with the CoSimulation until then, if an FMU fails.
    ConvergenceError
        If the scheme or the rotor's integration does not converge; the error carries the CoSimulation
        until then.
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
    """Selects the cheapest coupling scheme that is stable and accurate enough.

    Parameters
    ----------
    tolerance : float [1]
        Largest distance of a trial run from a finer one, relative to the largest displacement.

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
        Macro step and duration of the run to come; trials are as long, `TRIAL_STEPS` steps at most.

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
