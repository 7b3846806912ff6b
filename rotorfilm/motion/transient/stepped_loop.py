"""A rotor and films that remember in one Newton step: both by differences of second order in time."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ...bearings.films.conserved.conserved_film import bdf2
from ...bearings.films.conserved.oil_steps import MOST_GROWTH
from ...bearings.stepped_reaction import SteppedReaction, StepTrial
from ...errors import ConvergenceError, FilmContactError, InputError, require_kind
from ...model import Array, Dynamic, Reaction
from ...signals import FORCE_OUTPUTS, JOURNAL_INPUTS, indices, names

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
        Of the station; empty where there is one only.
    film : SteppedReaction
    motion, force : list of int
        Indices among the outputs of the rotor, x, y, vx, vy, speed, and among its inputs.
    """

    name: str
    film: SteppedReaction
    motion: list[int]
    force: list[int]


class Moment(NamedTuple):
    """Rotor and films at one time.

    Attributes
    ----------
    time : float [s]
    state : ndarray, shape (n_states,)
        Of the rotor.
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


def stations_of(
    rotor: Dynamic, films: SteppedReaction | Mapping[str, Reaction | SteppedReaction]
) -> tuple[FilmStation, ...]:
    """Return the films in their stations; raise InputError where they do not fit the rotor."""
    require_kind("rotor", rotor, Dynamic, "a rotor such as a RigidRotor")
    named: Mapping[str, Any] = films if isinstance(films, Mapping) else {"": films}
    outputs, inputs, found = names(rotor.outputs), names(rotor.inputs), []
    for name, film in named.items():
        said = f"reaction[{name!r}]" if name else "reaction"
        require_kind(said, film, SteppedReaction, "a film that steps, as a JFOFilm, as all others of it are")
        front = f"{name}_" if name else ""
        motion = [*(front + key for key in JOURNAL_INPUTS[:-1]), JOURNAL_INPUTS[-1]]
        force = [front + key for key in FORCE_OUTPUTS]
        found.append(
            FilmStation(
                name,
                film,
                indices("rotor must have the outputs", outputs, motion),
                indices("rotor must have the inputs", inputs, force),
            )
        )
    if len(inputs) > 2 * len(found):
        raise InputError(
            f"reaction must be films in all stations of the rotor, got {list(named)} for {inputs}"
        )
    return tuple(found)


class SteppedLoop:
    """Steps of a rotor on films that remember.

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
        u = self._input(trials)
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

    def _input(self, trials: list[StepTrial]) -> Array:
        u = np.zeros(len(self.rotor.inputs))
        for station, trial in zip(self.stations, trials, strict=True):
            u[station.force] = trial.output[:2]
        return u

    def _moment(self, t: float, x: Array, films: tuple[Any, ...], outputs: list[Array]) -> Moment:
        u = np.zeros(len(self.rotor.inputs))
        for station, output in zip(self.stations, outputs, strict=True):
            u[station.force] = output[:2]
        return Moment(t, x, self.rotor.derivative(t, x, u), films, np.concatenate(outputs))
