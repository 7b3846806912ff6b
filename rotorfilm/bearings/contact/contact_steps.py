"""Time integration of a moving contact: second-order differences on steps that follow the error, or fixed.

Every step solves the film equations and the equation of motion together. Implicit Euler with a fixed step is
what was published; it damps the ball's oscillation by itself (`docs/contact.md`).
"""

from __future__ import annotations

import io
import json
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path
from time import monotonic
from typing import Any, ClassVar, NamedTuple

import numpy as np
from scipy.io import netcdf_file

from ...core.errors import (
    ConvergenceError,
    InputError,
    require_non_negative,
    require_number,
    require_positive,
    shortened,
)
from ...core.files import read_sealed, write_sealed
from ...core.inputs import quantities
from ...core.model import Array, breakpoints
from ...core.readable import Drawable, Readable
from ..formulas import CIRCLE
from .contact_grid import checkerboard
from .film_equations import ContactEquations, TimeDerivative
from .film_newton import Closure, NewtonKrylov, Place

LEVELS = 3
"""Levels that the extrapolation takes."""

SAFETY, SLOWEST, FASTEST = 0.9, 0.3, 2.0
"""Of the step control: margin, and range of the ratio of two steps (BDF2 is stable below 2.41)."""

NEWTON_SHARE = 1e-2
"""Error of the equations of a step, per error allowed in it."""

CONTACT_RADIUS = 1.2
"""Radius within which errors of the film thickness count."""

HOPELESS = 1e-5
"""Step below which equations that cannot be solved end an integration."""

SHORTEST = 1e-9
"""Step below which an integration is given up."""


@quantities
@dataclass(frozen=True, kw_only=True)
class AdaptiveSteps:
    """Second-order backward differences (BDF2), each step as long as its error allows.

    The error of approach, velocity times sqrt(W) and film thickness (rms over the contact) in one step is
    estimated from its distance to the extrapolation of earlier levels. At `breakpoints` of the drive the
    history starts anew.

    Parameters
    ----------
    tolerance : float [1]
        Error allowed in one step, in units of the film thickness.
    largest : float [1]
        Longest step.
    first : float [1]
        First step, also after a breakpoint, where no earlier steps allow an error estimate.
    """

    tolerance: float = 1e-4
    largest: float = 0.5
    first: float = 1e-3

    def __post_init__(self) -> None:
        require_positive("tolerance", self.tolerance)
        require_positive("largest", self.largest)
        require_positive("first", self.first)


@quantities
@dataclass(frozen=True, kw_only=True)
class FixedSteps:
    """Backward differences of a given order with a fixed step; (0.2, order 1) is the published scheme.

    Parameters
    ----------
    step : float [1]
        Length of a step.
    order : int
        1 for implicit Euler, 2 for BDF2, whose first step is an Euler step.
    tolerance : float [1]
        To which the equations of each step are solved.
    """

    step: float
    order: int = 2
    tolerance: float = 1e-7

    def __post_init__(self) -> None:
        require_positive("step", self.step)
        require_positive("tolerance", self.tolerance)
        if self.order not in (1, 2):
            raise InputError(f"order must be 1 or 2, got {self.order!r}")


class Memory(NamedTuple):
    """What an integration knows after a step beside its levels: with it another goes on to the last bit.

    Attributes
    ----------
    step : float [1]
        Length proposed for the next step.
    place : Place or None
        Place where the preconditioner was made.
    work : dict of str to int
        Steps, rejected steps, Newton and GMRES iterations.
    """

    step: float
    place: Place | None
    work: dict[str, int]


class Stepper:
    """One step after another, with the solver whose preconditioner they share.

    Parameters
    ----------
    equations : ContactEquations
    motion : ContactMotion
    control : AdaptiveSteps or FixedSteps
    memory : Memory, optional
        Of an integration to go on with.
    """

    def __init__(
        self,
        equations: ContactEquations,
        motion: ContactMotion,
        control: AdaptiveSteps | FixedSteps,
        memory: Memory | None = None,
    ) -> None:
        self.equations, self.motion, self.control = equations, motion, control
        share = NEWTON_SHARE if isinstance(control, AdaptiveSteps) else 1.0
        place = None if memory is None else memory.place
        self.solver = NewtonKrylov(equations, share * control.tolerance, place)
        none = {"steps": 0, "rejected": 0, "newton": 0, "gmres": 0}
        self.work = none if memory is None else dict(memory.work)
        self._step_on = None if memory is None else memory.step
        distance = np.hypot(*np.meshgrid(equations.grid.x, equations.grid.y, indexing="ij"))
        self._near = (distance < CONTACT_RADIUS).ravel()

    def advance(self, levels: tuple[Level, ...], ends: Sequence[float]) -> Iterator[tuple[Level, ...]]:
        """Yield the levels after each step, newest first, until the last of `ends`, hitting each of them.

        Raises
        ------
        ConvergenceError
            If the equations of a step cannot be solved, for the shortest step where steps adapt.
        """
        breaks = set(self.motion.breakpoints)
        step = self._resumed(levels) if self._step_on is None else self._step_on
        for end in ends:
            if levels[0].t in breaks:
                levels, step = levels[:1], self._first()
            while end - levels[0].t > SHORTEST:
                levels, step = self._accepted(levels, step, end)
                self._step_on = step
                yield levels

    def memory(self, levels: tuple[Level, ...]) -> Memory:
        """Return what is to be kept at the levels that were yielded last, or at the start."""
        step = self._resumed(levels) if self._step_on is None else self._step_on
        return Memory(step, self.solver.place, dict(self.work))

    def _first(self) -> float:
        return self.control.first if isinstance(self.control, AdaptiveSteps) else self.control.step

    def _resumed(self, levels: tuple[Level, ...]) -> float:
        if isinstance(self.control, FixedSteps) or len(levels) == 1:
            return self._first()
        return levels[0].t - levels[1].t

    def _accepted(
        self, levels: tuple[Level, ...], step: float, end: float
    ) -> tuple[tuple[Level, ...], float]:
        """Return the levels after one step that passed its test, and the length proposed for the next."""
        while True:
            left = end - levels[0].t
            # The last two steps to an end share what is left, so that none is tiny.
            now = left if step >= left * (1.0 - 1e-9) else min(step, max(0.5 * left, 0.5 * step))
            try:
                level, error = self._step(levels, end if now == left else levels[0].t + now)
            except ConvergenceError:
                if isinstance(self.control, FixedSteps) or now * SLOWEST < HOPELESS:
                    raise
                error = np.inf
            if isinstance(self.control, FixedSteps):
                return self._kept(level, levels), self.control.step
            factor = SAFETY * max(error, 1e-6) ** (-1.0 / 3.0)
            if error <= 1.0:
                longest = max(self.control.largest, now)
                return self._kept(level, levels), min(now * min(FASTEST, max(SLOWEST, factor)), longest)
            self.work["rejected"] += 1
            step = now * max(SLOWEST, factor)
            if step < SHORTEST:
                raise ConvergenceError(
                    f"steps must be at least {SHORTEST:.0e} long, got {step:.1e} at t = {levels[0].t:.6g}: "
                    "list the jumps of the drive in its attribute `breakpoints`"
                )

    def _kept(self, level: Level, levels: tuple[Level, ...]) -> tuple[Level, ...]:
        self.work["steps"] += 1
        return (level, *levels[: LEVELS - 1])

    def _step(self, levels: tuple[Level, ...], t: float) -> tuple[Level, float]:
        """Return the level at time t, and its error in tolerances (0 where there is no estimate)."""
        order = 2 if isinstance(self.control, AdaptiveSteps) else self.control.order
        times = [level.t for level in levels]
        weights = derivative_weights(t, times[:order])
        history = TimeDerivative(weights.new, weights.history([level.stored for level in levels]))
        ahead = extrapolation_weights(t, times)
        guess = sum(w * level.pressure for w, level in zip(ahead, levels, strict=True))
        delta = float(sum(w * level.delta for w, level in zip(ahead, levels, strict=True)))
        closure = self.motion.closure(t, weights, levels)
        found = self.solver.solve(self._wet(guess, levels[0]), delta, closure, history)
        self.work["newton"] += found.steps
        self.work["gmres"] += found.iterations
        velocity = weights.new * found.delta + weights.history([level.delta for level in levels])
        stored = self.equations.stored(found.pressure, found.film)
        level = Level(t, found.delta, float(velocity), found.pressure, stored)
        return level, self._error(levels, level, ahead)

    def _wet(self, guess: Array, newest: Level) -> Array:
        """Return the extrapolated pressure on the cells that held film, and a little above zero there."""
        return np.where(newest.pressure > 0.0, np.maximum(guess, 1e-12), 0.0)

    def _error(self, levels: tuple[Level, ...], level: Level, ahead: Array) -> float:
        if isinstance(self.control, FixedSteps) or len(levels) == 1:
            return 0.0
        share = error_share(level.t, [earlier.t for earlier in levels])
        parts = ([getattr(earlier, name) for earlier in levels] for name in ("delta", "velocity", "stored"))
        new = (level.delta, level.velocity, level.stored)
        delta, velocity, stored = (
            now - sum(w * old for w, old in zip(ahead, past, strict=True))
            for now, past in zip(new, parts, strict=True)
        )
        film = np.sqrt(np.mean(stored[self._near] ** 2))
        largest = max(abs(delta), np.sqrt(self.motion.inertia) * abs(velocity), film)
        return share * float(largest) / self.control.tolerance


# Time levels of a moving contact: difference formulas on uneven steps, and the motion that is asked for.


class Level(NamedTuple):
    """The contact at one time.

    Attributes
    ----------
    t, delta, velocity : float [1]
        Time, approach and its rate.
    pressure : ndarray, shape (n,)
    stored : ndarray, shape (n,)
        rho H of the cells.
    """

    t: float
    delta: float
    velocity: float
    pressure: Array
    stored: Array


class Weights(NamedTuple):
    """d/dt at a new time as `new` * y + sum of `old` * earlier y, newest first."""

    new: float
    old: Array

    def history(self, values: Sequence[Any]) -> Any:
        """Return the part of the derivative that earlier levels make."""
        return sum(w * y for w, y in zip(self.old, values, strict=False))


@dataclass(frozen=True, kw_only=True)
class BallMotion:
    """The ball's own motion W delta'' = integral of p - unit f(t).

    Parameters
    ----------
    W : float [1]
        Inertia, >= 0.
    load : callable
        f(t); its attribute `breakpoints`, if it has one, lists the times of its jumps.
    unit : float [1]
        Integral of the pressure of the dry contact.
    """

    W: float
    load: Callable[[float], float]
    unit: float = CIRCLE.load

    def __post_init__(self) -> None:
        require_non_negative("W", self.W)
        _require_callable("load", self.load)

    @property
    def inertia(self) -> float:
        """W."""
        return float(self.W)

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which the load jumps."""
        return breakpoints(self.load)

    def drive(self, t: float) -> float:
        """Return the load f."""
        return _finite("load", self.load, t)

    def closure(self, t: float, weights: Weights, levels: Sequence[Level]) -> Closure:
        """Return the equation of motion; the velocity is eliminated by its own difference formula."""
        rate = weights.history([level.delta for level in levels])
        push = weights.new * rate + weights.history([level.velocity for level in levels])
        return Closure(-self.W * weights.new**2, 1.0, self.unit * self.drive(t) + self.W * float(push))


@dataclass(frozen=True, kw_only=True)
class GivenMotion:
    """A given approach delta(t), whatever force that takes.

    Parameters
    ----------
    approach : callable
        delta(t); its attribute `breakpoints`, if it has one, lists the times of its kinks.
    """

    approach: Callable[[float], float]

    def __post_init__(self) -> None:
        _require_callable("approach", self.approach)

    inertia: ClassVar[float] = 0.0
    """None: the velocity is given."""

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which the motion kinks."""
        return breakpoints(self.approach)

    def drive(self, t: float) -> float:
        """Return the approach."""
        return _finite("approach", self.approach, t)

    def closure(self, t: float, weights: Weights, levels: Sequence[Level]) -> Closure:
        """Return delta = delta(t)."""
        return Closure(1.0, 0.0, self.drive(t))


ContactMotion = BallMotion | GivenMotion
"""What moves the contact: a ball with a mass, or a given approach."""


def derivative_weights(t: float, times: Sequence[float]) -> Weights:
    """Return the backward difference of first or second order from one or two earlier times, newest first."""
    h = t - times[0]
    if len(times) == 1:
        return Weights(1.0 / h, np.array([-1.0 / h]))
    g = t - times[1]
    return Weights(1.0 / h + 1.0 / g, np.array([-g / (h * (g - h)), h / (g * (g - h))]))


def extrapolation_weights(t: float, times: Sequence[float]) -> Array:
    """Return the weights of the polynomial through all earlier times, at t."""
    return np.array([np.prod([(t - b) / (a - b) for b in times if b != a]) for a in times])


def error_share(t: float, times: Sequence[float]) -> float:
    """Return the error of a second-order step / its distance from the extrapolation through `times`.

    From three times this is the ratio of the leading terms: y'''/6 times h g (t - times[2]) for the
    extrapolation and times (h g)^2/(h + g) for the step, of opposite signs. From two times, as after a jump,
    the extrapolation is one order short and the share is on the safe side.
    """
    h, g = t - times[0], t - times[1]
    if len(times) == 2:
        return h / (h + g)
    step = (h * g) ** 2 / (h + g)
    return step / (step + h * g * (t - times[2]))


def _require_callable(name: str, value: object) -> None:
    if not callable(value):
        raise InputError(f"{name} must be a function of time, got {value!r}")


def _finite(name: str, function: Callable[[float], float], t: float) -> float:
    value = float(function(t))
    if not np.isfinite(value):
        raise InputError(f"{name} must be finite at every time, got {value!r} at t = {t:.6g}")
    return value


# What a point contact answers: its state at one time, and a run over time.


@dataclass(frozen=True, kw_only=True)
class ContactState(Readable):
    """A point contact at one time, in units of the Hertzian contact; a run starts from one.

    Attributes
    ----------
    t : float [1]
        Time.
    delta, velocity : float [1]
        Rigid approach, negative in contact, and its rate.
    central_film, minimum_film : float [1]
        Film thickness H at the center, and the smallest.
    carried_load : float [1]
        Integral of the pressure over that of the dry contact, 2 pi ellipticity/3.
    pressure, thickness : ndarray, shape (nx, m) [1]
        p and H over `grid.x` and `grid.y`, y > 0.
    checkerboard : float [1]
        Share of the pressure that alternates from cell to cell (`checkerboard`).
    levels : tuple of Level
        This and earlier times, newest first: what second-order steps need to go on.
    """

    t: float
    delta: float
    velocity: float
    central_film: float
    minimum_film: float
    carried_load: float
    pressure: Array
    thickness: Array
    checkerboard: float
    levels: tuple[Level, ...]


@dataclass(frozen=True, kw_only=True)
class ContactRun(Drawable):
    """A contact over time; all series have the shape (steps + 1,) and begin with the start.

    Attributes
    ----------
    time : ndarray [1]
        Times of the results.
    delta, velocity, central_film, minimum_film, carried_load : ndarray [1]
        Delta, velocity, central film, minimum film and carried load as in `ContactState`.
    driven : ndarray [1]
        Load f, or approach of a driven contact, at those times.
    snapshots : tuple of ContactState
        States at the requested times. A run that was read from a file has only those after its interruption.
    final : ContactState
        Where the run ended; another run may start from it.
    complete : bool
        Whether it reached its end.
    work : dict of str to int
        Steps, rejected steps, Newton and GMRES iterations.
    asked : str
        Motion, control and end of the run. An incomplete run can be continued with the same ones only.
    memory : Memory
        Further data that the integration needs to continue, besides `final.levels`.
    """

    time: Array
    delta: Array
    velocity: Array
    central_film: Array
    minimum_film: Array
    carried_load: Array
    driven: Array
    snapshots: tuple[ContactState, ...]
    final: ContactState
    complete: bool
    work: dict[str, int]
    asked: str
    memory: Memory


def state_of(equations: ContactEquations, levels: tuple[Level, ...]) -> ContactState:
    """Return the state that the newest of some levels is."""
    newest, shape = levels[0], equations.grid.shape
    film = equations.film(newest.pressure, newest.delta)
    load = equations.carried_load(newest.pressure)
    return ContactState(
        t=newest.t,
        delta=newest.delta,
        velocity=newest.velocity,
        central_film=equations.central_film(newest.pressure, newest.delta),
        minimum_film=float(film.min()),
        carried_load=load,
        pressure=newest.pressure.reshape(shape),
        thickness=(equations.sampling.stored @ film).reshape(shape),
        checkerboard=checkerboard(newest.pressure.reshape(shape), equations.grid, load),
        levels=levels,
    )


def level_of(equations: ContactEquations, pressure: Array, delta: float, velocity: float = 0.0) -> Level:
    """Return the level at t = 0 of given pressures (n,), approach and velocity."""
    stored = equations.stored(pressure, equations.film(pressure, delta))
    return Level(0.0, float(delta), float(velocity), pressure, stored)


# A run of a moving contact, kept up to where it got.


SERIES = ("time", "delta", "velocity", "central_film", "minimum_film", "carried_load")


EVERY = 20.0
"""Seconds after which a run that is kept is kept again, at the end of a step."""

_ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")


class _Recorder:
    """Series of a run as it grows."""

    def __init__(self, stepper: Stepper, asked: str, wanted: Sequence[float]) -> None:
        self.stepper, self.asked, self.wanted = stepper, asked, list(wanted)
        self.rows: list[tuple[float, ...]] = []
        self.snapshots: list[ContactState] = []

    def go_on(self, run: ContactRun) -> None:
        """Begin with what a run has recorded."""
        self.rows = list(zip(*(getattr(run, name).tolist() for name in (*SERIES, "driven")), strict=True))
        self.snapshots = list(run.snapshots)
        self.last = len(self.rows), run.final.levels, run.memory

    def take(self, levels: tuple[Level, ...]) -> None:
        """Record the newest of the levels."""
        equations, newest = self.stepper.equations, levels[0]
        film = equations.film(newest.pressure, newest.delta)
        central = equations.central_film(newest.pressure, newest.delta)
        load = equations.carried_load(newest.pressure)
        drive = self.stepper.motion.drive(newest.t)
        row = (newest.t, newest.delta, newest.velocity, central, film.min(), load, drive)
        if any(abs(newest.t - t) < 1e-9 for t in self.wanted):
            self.snapshots.append(state_of(equations, levels))
        self.rows.append(row)
        # At once, so that an interruption finds things that belong together.
        self.last = len(self.rows), levels, self.stepper.memory(levels)

    def run(self, *, complete: bool) -> ContactRun:
        """Return what has been recorded."""
        count, levels, memory = self.last
        columns = np.array(self.rows[:count], dtype=float).T
        return ContactRun(
            **dict(zip(SERIES, columns, strict=False)),
            driven=columns[-1],
            snapshots=tuple(self.snapshots),
            final=state_of(self.stepper.equations, levels),
            complete=complete,
            work=memory.work,
            asked=self.asked,
            memory=memory,
        )


def run_contact(
    equations: ContactEquations,
    motion: ContactMotion,
    control: AdaptiveSteps | FixedSteps,
    start: ContactState | ContactRun,
    duration: float,
    snapshots: Sequence[float],
    keep: Callable[[ContactRun], None] | None = None,
) -> ContactRun:
    """Return the run from a state; an interruption from the keyboard returns what there is.

    A run in place of the state is gone on with to its end; `keep` is called with what there is, every now and
    then and at the end, however the run ends.

    Raises
    ------
    InputError
        If a run to go on with was asked for otherwise, or was driven otherwise until now.
    ConvergenceError
        If a step fails; its `partial` is the run up to there.
    """
    begun = start if isinstance(start, ContactRun) else None
    now = start.final if isinstance(start, ContactRun) else start
    end = duration + float(now.t if begun is None else begun.time[0])
    asked = _ADDRESS.sub("", f"{motion!r}, {control!r}, end={end!r}, snapshots={tuple(snapshots)!r}")
    if begun is not None:
        _require_same(begun, asked, motion)
    stepper = Stepper(equations, motion, control, None if begun is None else begun.memory)
    recorder = _Recorder(stepper, asked, snapshots)
    if begun is None:
        recorder.take(now.levels)
    else:
        recorder.go_on(begun)
    ends = [t for t in sorted({*motion.breakpoints, *snapshots, end}) if now.t < t <= end]
    return _finished(recorder, stepper.advance(now.levels, ends), keep or (lambda _: None))


def _require_same(begun: ContactRun, asked: str, motion: ContactMotion) -> None:
    if begun.asked != asked:
        same = sum(
            1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(begun.asked, asked, strict=False))
        )
        at = asked.rfind(" ", 0, same) + 1  # where they part, for the whole may be long
        raise InputError(
            f"start must be continued with the arguments that it began with, {shortened(begun.asked[at:])}, "
            f"got {shortened(asked[at:])}"
        )
    # Functions do not say what they are: they are compared where the run has been.
    for t, driven in zip(begun.time.tolist(), begun.driven.tolist(), strict=True):
        if (drive := motion.drive(t)) != driven:
            raise InputError(
                f"start must be continued with the drive that it began with, {driven!r} at t = {t:.6g}, got "
                f"{drive!r}"
            )


def _finished(
    recorder: _Recorder, steps: Iterator[tuple[Level, ...]], keep: Callable[[ContactRun], None]
) -> ContactRun:
    complete, kept = False, monotonic()
    try:
        for levels in steps:
            recorder.take(levels)
            if monotonic() - kept > EVERY:
                keep(recorder.run(complete=False))
                kept = monotonic()
        complete = True
    except KeyboardInterrupt:
        pass
    except ConvergenceError as error:
        partial = recorder.run(complete=False)
        keep(partial)
        raise ConvergenceError(f"{error} (at t = {partial.final.t:.6g})", partial) from error
    run = recorder.run(complete=complete)
    keep(run)
    return run


# Runs and states of a point contact in NetCDF files.


COLUMNS = (*SERIES, "driven")

FACTS = ("complete", "work", "asked")

PLACE = {"pressure": "cell", "film": "sample", "wet": "cell"}
"""Arrays of a `Place`, and their dimensions."""


def save_run(run: ContactRun, path: str | Path, contact: str) -> None:
    """Write a run and what it takes to go on with it as NetCDF 3 with a seal; snapshots are not written.

    Parameters
    ----------
    run : ContactRun
    path : str or Path
    contact : str
        What was computed, to be compared on loading.
    """
    file: Any
    buffer = io.BytesIO()
    place = run.memory.place
    facts: dict[str, Any] = {name: getattr(run, name) for name in FACTS}
    facts |= {"step": run.memory.step}
    tables: dict[str, Any] = {name: (("step",), getattr(run, name)) for name in COLUMNS}
    for name in Level._fields:
        values = np.array([getattr(level, name) for level in run.final.levels])
        tables[f"level_{name}"] = ("level", "cell")[: values.ndim], values
    if place is not None:
        facts |= {"closure": list(place.closure), "rate": place.rate}
        for name, dimension in PLACE.items():
            tables[f"place_{name}"] = (dimension,), getattr(place, name)
    with netcdf_file(buffer, "w") as file:
        file.contact, file.facts = contact.encode(), json.dumps(facts).encode()
        for name, (dimensions, values) in tables.items():
            for dimension, size in zip(dimensions, values.shape, strict=True):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, size)
            file.createVariable(name, "f8", dimensions)[:] = values
        file.flush()
        write_sealed(path, buffer.getvalue(), contact)


def load_run(path: str | Path, contact: str, equations: ContactEquations) -> ContactRun:
    """Return a run that `save_run` wrote.

    Raises
    ------
    InputError
        If the file is damaged, or of another contact.
    """
    content = read_sealed(path, contact, f"path must be a run of {contact}")
    file: Any
    with netcdf_file(io.BytesIO(content), "r", mmap=False) as file:
        arrays: dict[str, Any] = {
            name: np.array(variable[:], dtype=float) for name, variable in file.variables.items()
        }
        facts = json.loads(file.facts.decode())
    rows = zip(*(arrays[f"level_{name}"] for name in Level._fields), strict=True)
    levels = tuple(Level(float(t), float(d), float(v), p, s) for t, d, v, p, s in rows)
    place = None
    if "closure" in facts:
        pressure, film, wet = (arrays[f"place_{name}"] for name in PLACE)
        place = Place(pressure, film, wet > 0.0, Closure(*facts["closure"]), facts["rate"])
    return ContactRun(
        **{name: arrays[name] for name in COLUMNS},
        **{name: facts[name] for name in FACTS},
        snapshots=(),
        final=state_of(equations, levels),
        memory=Memory(facts["step"], place, facts["work"]),
    )


# Loads over time that know where they jump.


@quantities
@dataclass(frozen=True, kw_only=True)
class StepLoad:
    """f = 1 + amplitude between two times, 1 outside (Panovko 2011, section 4.2).

    Parameters
    ----------
    amplitude : float [1]
    start, end : float [1]
        Times of the jumps; the end may be infinite.
    """

    amplitude: float
    start: float = 0.0
    end: float = math.inf

    def __post_init__(self) -> None:
        require_number("amplitude", self.amplitude)
        require_number("start", self.start)
        if not self.end > self.start:
            raise InputError(f"end must be after start, got {self.end!r} and {self.start!r}")

    def __call__(self, t: float) -> float:
        """Return f; at a jump, that before it, as a step that ends there expects."""
        return 1.0 + self.amplitude * (self.start < t <= self.end)

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times of the jumps."""
        return (self.start, self.end) if math.isfinite(self.end) else (self.start,)


@quantities
@dataclass(frozen=True, kw_only=True)
class SineLoad:
    """f = 1 + amplitude sin(frequency t) (Panovko 2011, section 4.3).

    Parameters
    ----------
    amplitude : float [1]
    frequency : float [1]
        Angular.
    """

    amplitude: float
    frequency: float

    def __post_init__(self) -> None:
        require_number("amplitude", self.amplitude)
        require_number("frequency", self.frequency)

    def __call__(self, t: float) -> float:
        """Return f."""
        return 1.0 + self.amplitude * math.sin(self.frequency * t)
