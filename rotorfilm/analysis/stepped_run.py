"""Motion of a rotor on mass-conserving films, in steps of equal length, halved where they fail."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from ctypes import addressof, byref, c_int64
from dataclasses import replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import block_diag

from ..core.errors import (
    ContactError,
    ConvergenceError,
    FilmContactError,
    InputError,
    brief,
    require_finite,
    require_kind,
)
from ..core.model import Array, Dynamic
from ..core.port import StepTrial, takes_steps
from ..core.results import Trajectory
from ..core.signals import JOURNAL_INPUTS, indices, names, units
from ..core.time_steps import bdf2, cubic
from ..native.film_kernels import Status
from ..native.library import loops
from ..native.structs import structure
from ..rotors import FlexibleRotor, MountedRotor, RigidRotor
from ..rotors.structure import freedom_rows, prefixed, station_names
from .compiled_march import highest_speed
from .compiled_rotor import CONTACT_GAP, Parts, is_linear
from .condensed_runs import RunStart, starts, verified
from .force_calls import of_station

STEPS_A_TURN = 384
"""Steps in a turn of the shaft at its highest speed."""

AT_WALL = 1e-3
"""Gap, in clearances, in which a journal whose steps fail counts as at the wall."""

HALVINGS = 12
"""Times that a step is halved before a run is given up."""

MOST_GROWTH = 2.0
"""Of a step over the last one, up to which differences of second order take both (stable to 2.41)."""

AT_ONCE, FRAMES = 256, 8
"""Steps that the compiled loop makes in one call, at most, and frames that are kept."""

CONDENSATION = 1e-5
"""Largest displacement of a journal by the shapes of a long shaft that a run leaves out, in clearances."""

FAILURES: dict[int, type[Exception]] = {Status.AT_WALL: FilmContactError, Status.NO_MEMORY: MemoryError}
"""What answers of the compiled loop mean, if not that a search does not end."""


def simulate_steps(
    rotor: Dynamic,
    films: Mapping[str, Any],
    times: Array,
    duration: float,
    initial_state: ArrayLike | None,
    max_step: float,
) -> Trajectory:
    """Return the motion from t = 0, as `simulate`.

    Parameters
    ----------
    rotor : Dynamic
    films : film that takes steps, as a `JFOFilm`, or mapping of station to such films
    times : ndarray, shape (n,) [s]
        Times of the samples.
    duration : float [s]
    initial_state : array_like, shape (n_states,), optional
        Initial state of the rotor; by default its own.
    max_step : float [s]

    Raises
    ------
    ContactError, ConvergenceError
        As `simulate`, with the trajectory until then.
    """
    stations = stations_of(rotor, films)
    state = require_finite("initial_state", rotor.initial_state if initial_state is None else initial_state)
    if state.shape != (len(rotor.states),):
        raise InputError(f"initial_state must have shape ({len(rotor.states)},), got {state.shape}")
    longest = max_step if math.isfinite(max_step) else part_of_turn(rotor, duration)
    if not (isinstance(rotor, FlexibleRotor) and is_linear(rotor)):
        run, _, failure = _stepped(rotor, stations, times, duration, state, longest)
        if failure is not None:
            raise type(failure)(str(failure), run) from failure
        return run

    def joined(bare: FlexibleRotor) -> tuple[FlexibleRotor, Parts]:
        structure = bare.structure
        rows = np.concatenate([freedom_rows(structure, one.name) for one in stations])
        every = tuple(one.film for one in stations), tuple(one.name for one in stations)
        return bare, Parts(structure, bare.profile, *every, rows)

    def run_of(
        start: RunStart, at: Array, *, duration: float
    ) -> tuple[Trajectory, Array, Array, Exception | None]:
        found = stations_of(start.rotor, films)
        run, states, failure = _stepped(start.rotor, found, at, duration, start.state, longest)
        return run, states, start.parts.profile.turn(run.time), failure

    return verified(starts(rotor, joined, state, whole=False), run_of, times, duration, CONDENSATION)


def _stepped(
    rotor: Dynamic,
    stations: tuple[FilmStation, ...],
    times: Array,
    duration: float,
    state: Array,
    longest: float,
) -> tuple[Trajectory, Array, Exception | None]:
    """Return a run in steps of at most a length [s], the states at its times, and what ended it early."""
    loop = SteppedLoop(rotor, stations)
    count = max(1, math.ceil(duration / longest * (1.0 - 1e-12)))
    now, before = loop.begin(state), None
    record, error = _Record(loop, times), StepError(loop.clearances)
    record.add(Stretch.at(now, loop.motions(np.zeros(1), state[None])))
    progress = Progress(duration, count)
    while progress.done < progress.pieces:
        ahead = loop.alike(before, now, progress.ahead(now.time))
        stretch, films_now, failure = loop.march(before, now, [step.length for step in ahead])
        gaps = stretch.gaps(loop.clearances)
        wall = np.flatnonzero(gaps[1:].min(axis=1) <= CONTACT_GAP) + 1
        kept = stretch if not wall.size else stretch.until(int(wall[0]))
        error.add(kept.time, kept.motions)
        record.add(kept)
        if wall.size:
            where = loop.nearest(gaps[wall[0]])
            text = f"journal{where} reached the wall at t = {kept.time[-1]:.9g} s"
            return record.trajectory(), record.states, ContactError(text)
        if made := len(stretch.time) - 1:
            progress = ahead[made - 1].then
            before, now = stretch.moment(-2, now.films), stretch.moment(-1, films_now)
        if failure is not None:
            loop.work["restarts"] += 1
            progress = progress._replace(halvings=progress.halvings + 1)
            if progress.halvings > HALVINGS:
                told = _failed(failure, loop.nearest(gaps[-1]), float(gaps[-1].min()))
                return record.trajectory(), record.states, told
    return replace(record.trajectory(), step_error=error.largest), record.states, None


def _failed(failure: Exception, where: str, gap: float) -> ContactError | ConvergenceError:
    """Return what a step that cannot be made means, at a gap of so many clearances in a station."""
    if isinstance(failure, FilmContactError) or gap < AT_WALL:
        return ContactError(f"journal{where} reached the wall, {gap:.3g} of the clearance is left: {failure}")
    return ConvergenceError(str(failure))


def part_of_turn(rotor: Dynamic, duration: float) -> float:
    """Return the part of a turn at the highest speed of a run [s].

    Raises
    ------
    InputError
        If the shaft stands, or only a torque will turn it: then no turn tells how long a step may be.
    """
    highest = highest_speed(rotor, duration)
    if highest == 0.0:
        raise InputError(
            "max_step must be given for a shaft that does not rotate at first: it is the length of all steps"
        )
    return 2.0 * math.pi / STEPS_A_TURN / highest


class Progress(NamedTuple):
    """How much of a run is done: pieces of equal length, and how often they are halved now.

    Attributes
    ----------
    duration : float [s]
    pieces : int
        Of the whole run.
    done, halvings : int
    """

    duration: float
    pieces: int
    done: int = 0
    halvings: int = 0

    def ahead(self, t: float) -> Iterator[_Step]:
        """Yield the steps from the time t [s] on, as they are if none fails."""
        now = self
        while now.done < now.pieces:
            left = now.duration * (now.done + 1) / now.pieces - t
            piece = now.duration / now.pieces * 0.5**now.halvings
            whole = left < 1.5 * piece  # no step of what round-off leaves
            if whole:
                now = now._replace(done=now.done + 1, halvings=max(0, now.halvings - 1))
            yield (step := _Step(left if whole else piece, now))
            t += step.length


class _Step(NamedTuple):
    """A step that is to be made: its length [s], and what is done after it."""

    length: float
    then: Progress


class Moment(NamedTuple):
    """Rotor and films at one time.

    Attributes
    ----------
    time : float [s]
    state : ndarray, shape (n_states,)
        State of the rotor.
    rate : ndarray, shape (n_states,)
        Its derivative.
    films : tuple
        State of each film.
    outputs : ndarray, shape (n,)
        Outputs of all films.
    """

    time: float
    state: Array
    rate: Array
    films: tuple[Any, ...]
    outputs: Array


class Stretch(NamedTuple):
    """Several steps, a row for each moment, that before the first step included.

    Attributes
    ----------
    time : ndarray, shape (k,) [s]
    states, rates : ndarray, shape (k, n_states)
    outputs : ndarray, shape (k, n)
        Outputs of all films.
    motions : ndarray, shape (k, n_films, 5) [m, m, m/s, m/s, rad/s]
        Motion of each journal.
    """

    time: Array
    states: Array
    rates: Array
    outputs: Array
    motions: Array

    @classmethod
    def at(cls, now: Moment, motions: Array) -> Stretch:
        """Return a stretch of one moment."""
        return cls(np.array([now.time]), now.state[None], now.rate[None], now.outputs[None], motions)

    def until(self, row: int) -> Stretch:
        """Return the rows up to one."""
        return Stretch(*(rows[: row + 1] for rows in self))

    def moment(self, row: int, films: tuple[Any, ...]) -> Moment:
        """Return one of the moments."""
        return Moment(float(self.time[row]), self.states[row], self.rates[row], films, self.outputs[row])

    def gaps(self, clearances: Array) -> Array:
        """Return the clearance left at each journal, relative to its own, shape (k, n_films) [1]."""
        return np.asarray(1.0 - np.hypot(self.motions[..., 0], self.motions[..., 1]) / clearances)


class _Record:
    """Samples of a run: the rotor on the cubic between steps, the films on the line."""

    def __init__(self, loop: SteppedLoop, times: Array) -> None:
        self._loop, self._times = loop, times
        self._count = 0
        self._states: list[Array] = []
        self._outputs: list[Array] = []

    def add(self, steps: Stretch) -> None:
        """Keep the samples up to the end of the last step."""
        reached = steps.time * (1.0 + 1e-13)
        end = int(np.searchsorted(self._times, reached[-1], side="right"))
        t = self._times[self._count : end]
        last = np.maximum(np.searchsorted(reached, t), 1) - 1
        now = np.minimum(last + 1, len(reached) - 1)
        dt = steps.time[now] - steps.time[last]
        s = ((t - steps.time[last]) / np.where(dt > 0.0, dt, 1.0))[:, None]
        first, final = dt[:, None] * steps.rates[last], dt[:, None] * steps.rates[now]
        self._states.append(cubic(steps.states[last], steps.states[now], first, final, s)[0])
        self._outputs.append(steps.outputs[last] + s * (steps.outputs[now] - steps.outputs[last]))
        self._count = end

    @property
    def states(self) -> Array:
        """The states of the rotor at the times that there are, shape (n, n_states)."""
        return np.concatenate(self._states)

    def trajectory(self) -> Trajectory:
        """Return what there is."""
        rotor, time = self._loop.rotor, self._times[: self._count]
        rows = self._loop.sensed(time, self.states)
        known = (
            *rotor.outputs,
            *(prefixed(s.name, one) for s in self._loop.stations for one in s.film.outputs),
        )
        values = np.hstack([rows, np.concatenate(self._outputs)])
        signals = dict(zip(names(known), values.T, strict=True))
        return Trajectory(time=time, signals=signals, work=dict(self._loop.work), units=units(known))


# A rotor and mass-conserving films in one Newton step: both by differences of second order in time.


CONVERGED = 1e-9
"""Last Newton step, in nominal values of the states and clearances of the journals."""

MOST_ROUNDS = 12
"""Newton steps after which a step in time is halved."""

NEAREST = 0.1
"""Part of the gap that a Newton step leaves."""


class FilmStation(NamedTuple):
    """One film, and where the rotor has its journal.

    Attributes
    ----------
    name : str
        Name of the station; empty where there is one only.
    film : Stepped
    motion, force : list of int
        Indices among the outputs of the rotor, x, y, vx, vy, speed, and among its inputs.
    """

    name: str
    film: Any
    motion: list[int]
    force: list[int]


def stations_of(rotor: Dynamic, films: Mapping[str, Any]) -> tuple[FilmStation, ...]:
    """Return the films in their stations; raise InputError where they do not fit the rotor."""
    require_kind("rotor", rotor, Dynamic, "a rotor such as a RigidRotor")
    outputs, inputs, found = names(rotor.outputs), names(rotor.inputs), []
    for name, film in films.items():
        argument = f"reaction[{name!r}]" if name else "reaction"
        if not takes_steps(film):
            raise InputError(
                f"{argument} must be a film with a time step of its own, such as a JFOFilm, because another "
                f"film of this rotor is one, got {brief(film)}"
            )
        motion, force = station_names(name)
        places = indices("rotor must have the outputs", outputs, [*motion, JOURNAL_INPUTS[-1]])
        pushed = indices("rotor must have the inputs", inputs, force)
        found.append(FilmStation(name, film, places, pushed))
    if len(inputs) > 2 * len(found):
        raise InputError(
            f"reaction must be films in all stations of the rotor, got {list(films)} for {inputs}"
        )
    return tuple(found)


class Frame(NamedTuple):
    """What steps of one length have in common, of a rotor x' = A x + B F + w; see `oil_rotor.h`.

    Attributes
    ----------
    A : ndarray, shape (n, n)
    B : ndarray, shape (n, 2 n_films)
    solve : callable
        Solves with newest - dt A.
    inverse : ndarray, shape (n, n), or None
        Its inverse; None where that at a speed nearby solves, refined.
    gain : ndarray, shape (n, 2 n_films)
        Inverse dt B.
    sense : ndarray, shape (5 n_films, n)
        Motion of the journals.
    dt : float [s]
    last, older : float
        Of the differences newest x + last x_n + older x_n-1 = dt x'.
    growth : float
        The step over the one before; 0 where the differences are of first order.
    """

    A: Array
    B: Array
    solve: Callable[[Array], Array]
    inverse: Array | None
    gain: Array
    sense: Array
    dt: float
    last: float
    older: float
    growth: float


CONTRACTION, REFINED, ROUNDED = 0.1, 1e-13, 1e-9
"""Of refinements of a solution, the largest part of the last one that is left, the relative size of the last,
and that at which roundoff ends it."""


def refined(matrix: Array, near: Array, right: Array, scale: Array) -> Array | None:
    """Return the solution of matrix x = right by the inverse of a matrix nearby; None where that is too far.

    Each round takes the residual through that inverse, so that its error contracts.

    Parameters
    ----------
    matrix, near : ndarray, shape (n, n)
    right : ndarray, shape (n, ...)
    scale : ndarray, shape (n,)
        Typical sizes of the unknowns.
    """
    x, last = near @ right, math.inf
    while True:
        change = near @ (right - matrix @ x)
        x = x + change
        moved, whole = (np.abs(one.T / scale).max(axis=-1) for one in (change, x))
        share = float(np.max(moved / np.where(whole > 0.0, whole, 1.0)))
        if share <= REFINED:
            return np.asarray(x)
        if not share <= CONTRACTION * last:
            return np.asarray(x) if share <= ROUNDED else None
        last = min(share, 1.0)


class _Drive(NamedTuple):
    """What each step has for itself: its end, w (k, n), motion beside the state's; where to look first."""

    time: Array
    lengths: Array
    pushed: Array
    offset: Array
    start: Array


class SteppedLoop:
    """Steps of a rotor on mass-conserving films.

    With x the state of the rotor and F the forces of the films at the end of a step of length dt, Newton's
    method solves

        (a x + b x_n + c x_n-1)/dt = f(t, x, F),    F = F_film(journal at x; oil of the last steps)

    by the exact slopes of the rotor and of the films' steps. Steps of second order (BDF2) of any lengths,
    Euler's at the start and after one that was less than half as long. Linear rotors on films of the compiled
    library make many steps in one call.

    Parameters
    ----------
    rotor : Dynamic
    stations : tuple of FilmStation

    Attributes
    ----------
    work : Counter
        Work so far: steps, newton_steps, film_solutions, restarts, inverses of matrices of the rotor.
    """

    def __init__(self, rotor: Dynamic, stations: tuple[FilmStation, ...]) -> None:
        self.rotor, self.stations = rotor, stations
        self.work: Counter[str] = Counter(steps=0, newton_steps=0, film_solutions=0, restarts=0, inverses=0)
        self.clearances = np.array([float(s.film.clearance) for s in stations])
        nominal = {rotor.outputs[k].name: s.film.clearance for s in stations for k in s.motion[:2]}
        self._scale = np.array([nominal.get(s.name, s.nominal) for s in rotor.states])
        self._none = np.zeros(len(rotor.inputs))
        self._answers = len(stations[0].film.outputs)
        self._linear = is_linear(rotor) and not isinstance(rotor, MountedRotor)
        self._motion = [k for s in stations for k in s.motion]
        self._force = [k for s in stations for k in s.force]
        self._frames: dict[tuple[float, ...], Frame] = {}
        self._inverses: dict[tuple[float, ...], Array] = {}
        found = [getattr(s.film, "compiled_steps", None) for s in stations]
        self._compiled = None if None in found else found

    def begin(self, state: Array) -> Moment:
        """Return the moment t = 0, with steady films."""
        motions = self.motions(np.zeros(1), state[None])[0]
        films = tuple(s.film.start(motion) for s, motion in zip(self.stations, motions, strict=True))
        answers = [s.film.answer(film) for s, film in zip(self.stations, films, strict=True)]
        forces = np.concatenate([answer[:2] for answer in answers])
        rate = self.rotor.derivative(0.0, state, self._input(forces))
        return Moment(0.0, state, rate, films, np.concatenate(answers))

    def alike(self, before: Moment | None, now: Moment, steps: Iterator[_Step]) -> list[_Step]:
        """Return the first steps that have a frame in common."""
        found: list[_Step] = []
        t, last, key = now.time, 0.0 if before is None else now.time - before.time, None
        for step in steps:
            own = self._key(t + step.length, step.length, last)
            if key not in (None, own) or len(found) == (AT_ONCE if self._linear else 1):
                break
            found.append(step)
            t, last, key = t + step.length, step.length, own
        return found

    def _key(self, t: float, dt: float, last: float) -> tuple[float, ...]:
        growth = dt / last if last > 0.0 else math.inf
        speed = float(self.rotor.output(t, self.rotor.initial_state, self._none)[self._motion[4]])
        return speed, float(f"{dt:.9e}"), round(growth, 9) if growth <= MOST_GROWTH else 0.0

    def march(
        self, before: Moment | None, now: Moment, lengths: list[float]
    ) -> tuple[Stretch, tuple[Any, ...], Exception | None]:
        """Return the steps that were made, the films at their end, and what the next one failed of."""
        times = np.cumsum([now.time, *lengths])[1:]
        key = self._key(times[0], lengths[0], 0.0 if before is None else now.time - before.time)
        states = np.array([now.state if before is None else before.state, now.state])
        start = now.state + (key[2] * (states[1] - states[0]) if key[2] else lengths[0] * now.rate)
        for _ in range(MOST_ROUNDS):
            frame = self._frame(key, times[0], start, once=len(lengths) == 1)
            drive = self._drive(frame, times, np.array(lengths), start)
            found, answers, films, failure = self._meet(frame, drive, states, now.films)
            if self._linear or failure is not None:
                break
            moved, start = np.abs(found[-1] - start), found[-1]
            if np.all(moved <= CONVERGED * self._scale):
                break
        else:
            found = found[:0]
            failure = ConvergenceError(f"Newton's method must end in the step to t = {times[0]:.9g} s")
        return self._stretch(frame, drive, now, found, answers[: len(found)]), films, failure

    def _stretch(self, frame: Frame, drive: _Drive, now: Moment, states: Array, answers: Array) -> Stretch:
        """Return steps and the moment before them."""
        made = len(states)
        self.work["steps"] += made
        times, forces = drive.time[:made], answers[:, :, :2].reshape(made, 2 * len(self.stations))
        if self._linear:
            rates = states @ frame.A.T + forces @ frame.B.T + drive.pushed[:made]
        else:
            ends = zip(times, states, forces, strict=True)
            rates = np.array([self.rotor.derivative(t, x, self._input(f)) for t, x, f in ends])
        whole, time = np.vstack([now.state, states]), np.append(now.time, times)
        rates = np.vstack([now.rate, rates.reshape(states.shape)])
        outputs = np.vstack([now.outputs, answers.reshape(made, len(now.outputs))])
        return Stretch(time, whole, rates, outputs, self.motions(time, whole))

    def nearest(self, gaps: Array) -> str:
        """Return how a message names the station with the least of the gaps (n_films,)."""
        return of_station(self.stations[int(np.argmin(gaps))].name)

    def motions(self, times: Array, states: Array) -> Array:
        """Return the motion of each journal at some times, shape (k, n_films, 5)."""
        return self.sensed(times, states)[:, self._motion].reshape(-1, len(self.stations), 5)

    def sensed(self, times: Array, states: Array) -> Array:
        """Return the outputs of the rotor at some times, shape (k, n_outputs)."""
        about = np.zeros_like(states) if self._linear else states
        rows = [self.rotor.output(t, x, self._none) for t, x in zip(times, about, strict=True)]
        found = np.reshape(rows, (len(times), len(self.rotor.outputs)))
        return found + states @ self._rows.T if self._linear else found

    @cached_property
    def _rows(self) -> Array:
        """The outputs of a linear rotor per state."""
        return np.asarray(self.rotor.linearization(0.0, self.rotor.initial_state, self._none).C)

    def _frame(self, key: tuple[float, ...], t: float, x: Array, *, once: bool) -> Frame:
        """Return what steps of this key, or `once` one of them, have in common, about a state."""
        frame = self._frames.get(key)
        if frame is None or not self._linear or not (once or frame.inverse is not None):
            newest, last, older = bdf2(key[2]) if key[2] else (1.0, -1.0, 0.0)
            A, B, C, _ = self.rotor.linearization(t, x, self._none)
            A, B = np.asarray(A), np.asarray(B)[:, self._force]
            matrix = -key[1] * A
            np.einsum("ii->i", matrix)[:] += newest
            solved = self._solved(matrix, key[1:], key[1] * B, once)
            sense = np.ascontiguousarray(C[self._motion])
            frame = Frame(A, B, *solved, sense, key[1], last, older, key[2])
            self._frames = {**dict(list(self._frames.items())[-FRAMES:]), key: frame}
        return frame

    def _solved(
        self, matrix: Array, kind: tuple[float, ...], right: Array, once: bool
    ) -> tuple[Callable[[Array], Array], Array | None, Array]:
        """Return what solves with a matrix of a step, its inverse if that was needed, and a solution.

        In a run-up each step has a matrix of its own, near that of another step of its kind.
        """
        near = self._inverses.get(kind) if once else None
        gain = None if near is None else refined(matrix, near, right, self._scale)
        if near is None or gain is None:
            inverse = np.linalg.inv(matrix * self._scale / self._scale[:, None])
            inverse = self._scale[:, None] * inverse / self._scale
            self._inverses = {**dict(list(self._inverses.items())[-FRAMES:]), kind: inverse}
            self.work["inverses"] += 1
            return inverse.__matmul__, inverse, inverse @ right

        def solve(load: Array) -> Array:
            found = refined(matrix, near, load, self._scale)
            return np.asarray(np.linalg.solve(matrix, load), dtype=float) if found is None else found

        return solve, None, gain

    def _drive(self, frame: Frame, times: Array, lengths: Array, x: Array) -> _Drive:
        """Return what steps have each for themselves; of a rotor that is not linear about a state."""
        about = 0.0 * x if self._linear else x
        if self._linear and isinstance(self.rotor, RigidRotor | FlexibleRotor):  # without products with zeros
            model = self.rotor.operators
            pushed = model.weight + np.array([self.rotor.rotating(t) for t in times]) @ model.unbalance.T
        else:
            rates = np.array([self.rotor.derivative(t, about, self._none) for t in times])
            pushed = rates - frame.A @ about
        offset = np.array([self.rotor.output(t, about, self._none)[self._motion] for t in times])
        return _Drive(times, lengths, pushed, offset - frame.sense @ about, x)

    def _meet(
        self, frame: Frame, drive: _Drive, states: Array, films: tuple[Any, ...]
    ) -> tuple[Array, Array, tuple[Any, ...], Exception | None]:
        """Return states (k, n), answers (k, n_films, n) and films of steps that were made, and a failure."""
        if self._compiled is not None:
            return self._met_in_c(self._compiled, frame, drive, states, films)
        try:
            x, trials = self._met(frame, drive, states, films)
        except (FilmContactError, ConvergenceError) as failure:
            return states[:0], np.zeros((0, len(films), self._answers)), films, failure
        answers = np.array([[trial.output for trial in trials]])
        return x[None], answers, tuple(trial.state for trial in trials), None

    def _met_in_c(
        self, compiled: list[Any], frame: Frame, drive: _Drive, states: Array, films: tuple[Any, ...]
    ) -> tuple[Array, Array, tuple[Any, ...], Exception | None]:
        count, size = len(drive.time), states.shape[1]
        blocks = np.concatenate([film.numbers for film in films])
        found = np.vstack([states, np.empty((count, size))])
        answers = np.empty((count, len(films), self._answers))
        done, why = (c_int64 * 3)(), structure("rf_message")()
        addresses = np.array([addressof(one.struct) for one in compiled], dtype=np.uintp)
        springs = np.array([one.springs for one in compiled])
        parts = addresses, springs, frame.inverse, frame.gain, frame.sense, self._scale
        numbers = frame.last, frame.older, frame.growth
        rotor = structure("rf_oil_rotor")(
            size, len(films), *(None if one is None else one.ctypes.data for one in parts), *numbers
        )
        pushed = frame.dt * drive.pushed
        if frame.inverse is None:
            pushed = frame.solve(pushed[0] - frame.last * states[1] - frame.older * states[0])
        rows = drive.lengths, drive.time, pushed, drive.offset, drive.start, found, blocks, answers
        places = (row.ctypes.data for row in rows)
        status = loops()["rf_oil_march"](byref(rotor), count, *places, done, byref(why))
        self.work["newton_steps"] += done[1]
        self.work["film_solutions"] += done[2]
        ends = np.split(blocks, np.cumsum([len(film.numbers) for film in films])[:-1])
        after = tuple(film._replace(numbers=end) for film, end in zip(films, ends, strict=True))
        failure = FAILURES.get(status, ConvergenceError)(why.text.decode()) if status else None
        if isinstance(failure, MemoryError):
            raise failure
        return found[2 : 2 + done[0]], answers[: done[0]], after, failure

    def _met(
        self, frame: Frame, drive: _Drive, states: Array, films: tuple[Any, ...]
    ) -> tuple[Array, list[StepTrial]]:
        """Return state and films at the end of the first step, as `oil_rotor.c` finds them."""
        t, dt, offset = float(drive.time[0]), float(drive.lengths[0]), drive.offset[0]
        pushed = frame.dt * drive.pushed[0]
        free = frame.solve(pushed - frame.last * states[1] - frame.older * states[0])
        places = frame.sense.reshape(len(films), 5, -1)[:, :2].reshape(2 * len(films), -1)
        x, near, compliance = self._within(frame, drive, states[1], drive.start), films, places @ frame.gain
        for _ in range(MOST_ROUNDS):
            motions = (offset + frame.sense @ x).reshape(-1, 5)
            given = zip(self.stations, films, motions, near, strict=True)
            trials = [s.film.attempt(film, motion, dt, guess) for s, film, motion, guess in given]
            near = tuple(trial.state for trial in trials)
            force = np.concatenate([trial.output[:2] for trial in trials])
            slopes = compliance @ (stiffness := block_diag(*(trial.stiffness for trial in trials)))
            way = np.linalg.solve(np.eye(len(force)) + slopes, places @ (free - x) + compliance @ force)
            moved = self._within(frame, drive, x, free + frame.gain @ (force - stiffness @ way))
            size = float(np.max(np.abs(moved - x) / self._scale))
            x = moved
            self.work["newton_steps"] += 1
            self.work["film_solutions"] += sum(trial.solutions for trial in trials)
            if size <= CONVERGED:
                return x, trials
            if not np.isfinite(size):
                break
        raise ConvergenceError(f"Newton's method must end in the step to t = {t:.9g} s")

    def _within(self, frame: Frame, drive: _Drive, x: Array, moved: Array) -> Array:
        """Return the state moved no further than to where all journals keep part of their gap."""
        here, there = ((drive.offset[0] + frame.sense @ one).reshape(-1, 5)[:, :2] for one in (x, moved))
        share = 1.0
        for c, begin, end in zip(self.clearances, here, there, strict=True):
            least = NEAREST * (c - math.hypot(*begin))
            if least <= 0.0:
                raise FilmContactError(
                    f"the journal must stay inside the clearance at t = {drive.time[0]:.9g} s"
                )
            while c - math.hypot(*(begin + share * (end - begin))) < least:
                share *= 0.5
        return x + share * (moved - x)

    def _input(self, forces: Array) -> Array:
        u = np.zeros(len(self.rotor.inputs))
        u[self._force] = forces
        return u


# How far steps of a run on mass-conserving films may be off: nothing controls them, so the run says it.


class StepError:
    """Sums up the local errors of steps of second order at the journals, in clearances.

    A parabola through the last position and rate and the position before says where a journal would be. The
    difference gives the third derivative, and with it the local error of BDF2 (Hairer, Norsett & Wanner 1993,
    III.5), in a step h after a step k: (h + k)^2 h^2/(6 (2 h + k)) x'''. Between places of an exact motion it
    is that; between places of BDF2 itself, whose rates do not quite fit them, three times that. So on a round
    orbit that nothing damps, x' = i x in n steps a turn, the sum is 4 pi/3 (2 pi/n)^2 of the radius, twice
    what the orbit is off after the turn.

    Parameters
    ----------
    clearances : ndarray, shape (n_films,) [m]
    """

    def __init__(self, clearances: Array) -> None:
        self._clearances = clearances
        self._error = np.zeros(len(clearances))
        self._before: Array = np.zeros((0, 1 + 5 * len(clearances)))

    def add(self, time: Array, motions: Array) -> None:
        """Add the steps between moments that begin where the last ones ended, without the first of a run.

        Parameters
        ----------
        time : ndarray, shape (k,) [s]
        motions : ndarray, shape (k, n_films, 5)
            Motion of each journal: x, y, vx, vy, speed.
        """
        rows = np.vstack([self._before, np.column_stack([time, motions.reshape(len(time), -1)])])
        length, motions = np.diff(rows[:, 0])[:, None, None], rows[:, 1:].reshape(len(rows), -1, 5)
        if len(rows) > 2:
            place, rate, k, h = motions[..., :2], motions[1:-1, :, 2:4], length[:-1], length[1:]
            bend = 2.0 * (place[:-2] - place[1:-1] + k * rate) / k**2
            missed = place[2:] - (place[1:-1] + h * rate + 0.5 * h**2 * bend)
            share = ((h + k) / (2.0 * h + k))[..., 0]
            self._error += (share * np.hypot(missed[..., 0], missed[..., 1]) / self._clearances).sum(axis=0)
        self._before = rows[-2:-1]

    @property
    def largest(self) -> float:
        """That of the journal where it is largest."""
        return float(self._error.max())
