"""Motion of a rotor on films that remember, in steps of equal length, halved where they fail."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ...bearings.cubic import cubic
from ...bearings.stepped_reaction import SteppedReaction
from ...errors import ContactError, ConvergenceError, FilmContactError, InputError, require_finite
from ...model import Array, Dynamic, Reaction
from ...results import Trajectory
from ...signals import Signal, names, units
from ..compiled.journal_films import CONTACT_GAP
from ..compiled.times import highest_speed
from .step_error import StepError
from .stepped_loop import Moment, SteppedLoop, stations_of

STEPS_A_TURN = 384
"""Steps in a turn of the shaft at its highest speed."""

AT_WALL = 1e-3
"""Gap, in clearances, in which a journal whose steps fail counts as at the wall."""

HALVINGS = 12
"""Times that a step is halved before a run is given up."""


def simulate_steps(
    rotor: Dynamic,
    films: SteppedReaction | Mapping[str, Reaction | SteppedReaction],
    times: Array,
    duration: float,
    initial_state: ArrayLike | None,
    max_step: float,
) -> Trajectory:
    """Return the motion from t = 0, as `simulate`.

    Parameters
    ----------
    rotor : Dynamic
    films : SteppedReaction, or mapping of station to SteppedReaction
    times : ndarray, shape (n,) [s]
        Of the samples.
    duration : float [s]
    initial_state : array_like, shape (n_states,), optional
        Of the rotor; by default its own.
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
        known = (*rotor.outputs, *self._film_signals())
        values = np.hstack([np.reshape(rows, (len(time), -1)), np.reshape(self._outputs, (len(time), -1))])
        signals = dict(zip(names(known), values.T, strict=True))
        return Trajectory(time=time, signals=signals, work=dict(self._loop.work), units=units(known))

    def _film_signals(self) -> list[Signal]:
        return [
            replace(signal, name=f"{station.name}_{signal.name}" if station.name else signal.name)
            for station in self._loop.stations
            for signal in station.film.outputs
        ]


def _cubic(last: Moment, now: Moment, s: float) -> Array:
    """Return the rotor's state at a share of the time between two moments."""
    dt = now.time - last.time
    return np.asarray(cubic(last.state, now.state, dt * last.rate, dt * now.rate, s)[0])
