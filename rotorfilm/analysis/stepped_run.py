"""Motion of a rotor on mass-conserving films, in steps of equal length, halved where they fail."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

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
from ..rotors.structure import prefixed, station_names
from .compiled_march import highest_speed
from .compiled_rotor import CONTACT_GAP

STEPS_A_TURN = 384
"""Steps in a turn of the shaft at its highest speed."""

AT_WALL = 1e-3
"""Gap, in clearances, in which a journal whose steps fail counts as at the wall."""

HALVINGS = 12
"""Times that a step is halved before a run is given up."""

MOST_GROWTH = 2.0
"""Of a step over the last one, up to which differences of second order take both (stable to 2.41)."""


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
    loop = SteppedLoop(rotor, stations_of(rotor, films))
    state = require_finite("initial_state", rotor.initial_state if initial_state is None else initial_state)
    if state.shape != (len(rotor.states),):
        raise InputError(f"initial_state must have shape ({len(rotor.states)},), got {state.shape}")
    longest = max_step if math.isfinite(max_step) else part_of_turn(rotor, duration)
    count = max(1, math.ceil(duration / longest * (1.0 - 1e-12)))
    record, error = _Record(loop, times), StepError(loop)
    now, before = loop.begin(state), None
    record.add(now, now)
    halvings, done = 0, 0
    while done < count:
        left = duration * (done + 1) / count - now.time
        piece = duration / count * 0.5**halvings
        length = left if left < 1.5 * piece else piece  # no step of what round-off leaves
        try:
            reached = loop.step(now, before, length)
        except (FilmContactError, ConvergenceError) as failure:
            halvings += 1
            loop.work["restarts"] += 1
            if halvings > HALVINGS:
                raise _failed(failure, loop.gap(now), record.trajectory()) from failure
            continue
        record.add(now, reached)
        error.add(before, now, reached)
        if loop.gap(reached) <= CONTACT_GAP:
            raise ContactError(f"journal reached the wall at t = {reached.time:.9g} s", record.trajectory())
        before, now = now, reached
        if length == left:
            done, halvings = done + 1, max(0, halvings - 1)
    return replace(record.trajectory(), step_error=error.largest)


def _failed(failure: Exception, gap: float, partial: Trajectory) -> ContactError | ConvergenceError:
    """Return what a step that cannot be made means, at a gap of so many clearances."""
    if isinstance(failure, FilmContactError) or gap < AT_WALL:
        return ContactError(
            f"journal reached the wall, {gap:.3g} of the clearance is left: {failure}", partial
        )
    return ConvergenceError(str(failure), partial)


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
            "max_step must be given, as the length of all steps, for a shaft that stands at first"
        )
    return 2.0 * math.pi / STEPS_A_TURN / highest


class _Record:
    """Samples of a run: the rotor on the cubic between steps, the films on the line."""

    def __init__(self, loop: SteppedLoop, times: Array) -> None:
        self._loop, self._times = loop, times
        self._states: list[Array] = []
        self._outputs: list[Array] = []

    def add(self, last: Moment, now: Moment) -> None:
        """Keep the samples up to a moment."""
        end = int(np.searchsorted(self._times, now.time * (1.0 + 1e-13), side="right"))
        for t in self._times[len(self._states) : end]:
            s = 1.0 if now.time == last.time else (t - last.time) / (now.time - last.time)
            self._states.append(_cubic(last, now, float(s)))
            self._outputs.append(last.outputs + s * (now.outputs - last.outputs))

    def trajectory(self) -> Trajectory:
        """Return what there is."""
        rotor, time = self._loop.rotor, self._times[: len(self._states)]
        none = np.zeros(len(rotor.inputs))
        rows = [rotor.output(t, x, none) for t, x in zip(time, self._states, strict=True)]
        known = (
            *rotor.outputs,
            *(prefixed(s.name, one) for s in self._loop.stations for one in s.film.outputs),
        )
        values = np.hstack([np.reshape(rows, (len(time), -1)), np.reshape(self._outputs, (len(time), -1))])
        signals = dict(zip(names(known), values.T, strict=True))
        return Trajectory(time=time, signals=signals, work=dict(self._loop.work), units=units(known))


def _cubic(last: Moment, now: Moment, s: float) -> Array:
    """Return the rotor's state at a share of the time between two moments."""
    dt = now.time - last.time
    return np.asarray(cubic(last.state, now.state, dt * last.rate, dt * now.rate, s)[0])


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


def stations_of(rotor: Dynamic, films: Mapping[str, Any]) -> tuple[FilmStation, ...]:
    """Return the films in their stations; raise InputError where they do not fit the rotor."""
    require_kind("rotor", rotor, Dynamic, "a rotor such as a RigidRotor")
    outputs, inputs, found = names(rotor.outputs), names(rotor.inputs), []
    for name, film in films.items():
        argument = f"reaction[{name!r}]" if name else "reaction"
        if not takes_steps(film):
            raise InputError(
                f"{argument} must be a film that steps, as a JFOFilm, since others do, got {brief(film)}"
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


class SteppedLoop:
    """Steps of a rotor on mass-conserving films.

    With x the state of the rotor and F the forces of the films at the end of a step of length dt, Newton's
    method solves

        (a x + b x_n + c x_n-1)/dt = f(t, x, F),    F = F_film(journal at x; oil of the last steps)

    by the exact slopes of the rotor and of the films' steps. Steps of second order (BDF2) of any lengths,
    Euler's at the start and after one that was less than half as long.

    Parameters
    ----------
    rotor : Dynamic
    stations : tuple of FilmStation

    Attributes
    ----------
    work : Counter
        Work so far: steps, newton_steps, film_solutions, restarts.
    """

    def __init__(self, rotor: Dynamic, stations: tuple[FilmStation, ...]) -> None:
        self.rotor, self.stations = rotor, stations
        self.work: Counter[str] = Counter(steps=0, newton_steps=0, film_solutions=0, restarts=0)
        nominal = {rotor.outputs[k].name: s.film.clearance for s in stations for k in s.motion[:2]}
        self._scale = np.array([nominal.get(s.name, s.nominal) for s in rotor.states])

    def begin(self, state: Array) -> Moment:
        """Return the moment t = 0, with steady films."""
        motion = self.motion(0.0, state)
        films = tuple(s.film.start(motion[s.motion]) for s in self.stations)
        outputs = [s.film.answer(film) for s, film in zip(self.stations, films, strict=True)]
        return self._moment(0.0, state, films, outputs)

    def step(self, now: Moment, before: Moment | None, dt: float) -> Moment:
        """Return the moment dt [s] later.

        Raises
        ------
        FilmContactError
            If a journal gets to the wall.
        ConvergenceError
            If Newton's method does not end, or a film is not found.
        """
        ratio = math.inf if before is None else dt / (now.time - before.time)
        t, history, start, newest = now.time + dt, -now.state, now.state + dt * now.rate, 1.0
        if before is not None and ratio <= MOST_GROWTH:
            newest, last, older = bdf2(ratio)
            history = last * now.state + older * before.state
            start = now.state + ratio * (now.state - before.state)
        x, trials = self._within(t, now.state, start), None
        for _ in range(MOST_ROUNDS):
            trials = self._tried(now, t, x, dt, trials)
            change = self._change(t, x, newest, history, dt, trials)
            moved = self._within(t, x, x + change)
            size = float(np.max(np.abs(moved - x) / self._scale))
            x = moved
            self.work["newton_steps"] += 1
            if not np.isfinite(size):
                break
            if size <= CONVERGED:
                self.work["steps"] += 1
                return self._moment(t, x, tuple(each.state for each in trials), [e.output for e in trials])
        raise ConvergenceError(f"Newton's method must end in the step to t = {t:.9g} s")

    def gap(self, moment: Moment) -> float:
        """Return the least clearance left at any journal, relative to its own [1]."""
        motion = self.motion(moment.time, moment.state)
        return min(1.0 - math.hypot(*motion[s.motion[:2]]) / s.film.clearance for s in self.stations)

    def _tried(
        self, now: Moment, t: float, x: Array, dt: float, last: list[StepTrial] | None
    ) -> list[StepTrial]:
        motion, trials = self.motion(t, x), []
        for k, station in enumerate(self.stations):
            near = None if last is None else last[k].state
            trials.append(station.film.attempt(now.films[k], motion[station.motion], dt, near))
            self.work["film_solutions"] += trials[-1].solutions
        return trials

    def _change(
        self, t: float, x: Array, newest: float, history: Array, dt: float, trials: list[StepTrial]
    ) -> Array:
        """Return Newton's step of the rotor's state."""
        u = self._input([trial.output for trial in trials])
        residual = newest * x + history - dt * self.rotor.derivative(t, x, u)
        A, B, C, _ = self.rotor.linearization(t, x, u)
        matrix = newest * np.eye(len(x)) - dt * A
        for station, trial in zip(self.stations, trials, strict=True):
            matrix += dt * B[:, station.force] @ trial.stiffness @ C[station.motion[:2]]
        return np.linalg.solve(matrix * self._scale, -residual) * self._scale

    def _within(self, t: float, x: Array, moved: Array) -> Array:
        """Return the state moved no further than to where all journals keep part of their gap."""
        here, there, share = self.motion(t, x), self.motion(t, moved), 1.0
        for station in self.stations:
            c = station.film.clearance
            begin, end = here[station.motion[:2]], there[station.motion[:2]]
            least = NEAREST * (c - math.hypot(*begin))
            if least <= 0.0:
                raise FilmContactError(f"the journal must stay inside the clearance at t = {t:.9g} s")
            while c - math.hypot(*(begin + share * (end - begin))) < least:
                share *= 0.5
        return x + share * (moved - x)

    def motion(self, t: float, x: Array) -> Array:
        """Return the outputs of the rotor in a state."""
        return self.rotor.output(t, x, np.zeros(len(self.rotor.inputs)))

    def _input(self, outputs: list[Array]) -> Array:
        u = np.zeros(len(self.rotor.inputs))
        for station, output in zip(self.stations, outputs, strict=True):
            u[station.force] = output[:2]
        return u

    def _moment(self, t: float, x: Array, films: tuple[Any, ...], outputs: list[Array]) -> Moment:
        rate = self.rotor.derivative(t, x, self._input(outputs))
        return Moment(t, x, rate, films, np.concatenate(outputs))


# How far steps of a run on mass-conserving films may be off: nothing controls them, so the run says it.


class StepError:
    """Sums up the local errors of steps of second order at the journals, in clearances.

    A parabola through the last position and rate and the position before says where a journal would be. The
    difference gives the third derivative, and with it the local error of BDF2 (Hairer, Norsett & Wanner 1993,
    III.5), in a step h after a step k: (h + k)^2 h^2/(6 (2 h + k)) x'''. Between places of an exact motion it
    is that; between places of BDF2 itself, whose rates do not quite fit them, three times that. So on a round
    orbit that nothing damps, x' = i x in n steps a turn, the sum is 4 pi/3 (2 pi/n)^2 of the radius, twice
    what the orbit is off after the turn.
    """

    def __init__(self, loop: SteppedLoop) -> None:
        self._loop = loop
        self._error = np.zeros(len(loop.stations))

    def add(self, before: Moment | None, now: Moment, reached: Moment) -> None:
        """Add a step from `now` that ended in `reached`; the first of a run counts as none."""
        if before is None:
            return
        h, k = reached.time - now.time, now.time - before.time
        bend = 2.0 * (before.state - now.state + k * now.rate) / k**2
        expected = now.state + h * now.rate + 0.5 * h**2 * bend
        missed = self._places(reached.time, reached.state) - self._places(reached.time, expected)
        self._error += (h + k) / (2.0 * h + k) * np.hypot(*missed)

    @property
    def largest(self) -> float:
        """That of the journal where it is largest."""
        return float(self._error.max())

    def _places(self, t: float, state: Array) -> Array:
        """Return x, y of all journals over their clearances, shape (2, n_stations)."""
        motion = self._loop.motion(t, state)
        return np.array([motion[s.motion[:2]] / s.film.clearance for s in self._loop.stations]).T
