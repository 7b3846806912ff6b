"""One coupled run: rotor and films over macro steps by a scheme, under watch."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, TypeVar

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
from ..core.limits import STEPS
from ..core.readable import Drawable, Readable
from ..core.results import Trajectory
from .compiled_loop import CompiledRun, compiled_run
from .partners import Partners, Record
from .schemes import MEMORY, GaussSeidel, Sample, Scheme, started
from .slaves import Slave
from .watch import CouplingReport, CouplingWatch, Watch, inspect_coupling

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
