"""Time integration of a rotor of any size on films, compiled: as long as its bearings, not its shaft."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...errors import (
    ContactError,
    ConvergenceError,
    InputError,
    require_finite,
    require_non_negative,
    require_positive,
)
from ...inputs.kinds import arguments
from ...model import Array
from ...results import Trajectory
from ...rotors import MountedRotor
from ...signals import names, units
from .condensed_rotor import ShapedStart, largest_difference, starts
from .march import rate_of
from .modal import Parts, modal_rotor, take_apart
from .run_up import RunUp, Settings
from .times import require_duration, require_longest_step, sample_times

LONGEST_TURN = 1.0
"""Longest step in turns of the shaft."""

COMPARED = 201
"""Times at which runs in fewer and more shapes are compared, at least."""


@arguments
def simulate_rotor(
    mounted: MountedRotor,
    *,
    duration: float,
    samples: int = 1001,
    times: ArrayLike | None = None,
    initial_state: ArrayLike | None = None,
    rtol: float = 1e-8,
    max_step: float = math.inf,
    condensation: float = 1e-5,
) -> Trajectory:
    """Return the motion of a rotor on films from t = 0.

    The shaft is integrated exactly in its modes, and the film forces by collocation of order 7 with their
    exact derivatives (`native/loops/march.h`), all of it compiled. A step costs some ten microseconds.

    A `SpeedProfile` may change the gyroscopic effect and the rotating damping too. A shaft of many elements
    (more than 60 coordinates) moves in few shapes: in ever more, until the journals of two runs agree, the
    second with shapes to four times the frequency of the first. If they never do it is run whole.

    Parameters
    ----------
    mounted : MountedRotor
        From `mount`, with a bearing without states in at least one station and no forces left free that
        anybody would drive. Its speed may be a profile.
    duration : float [s]
    samples : int
        Number of samples at equal distance, from 0 to `duration` inclusive.
    times : array_like, shape (n,) [s], optional
        Increasing sample times within [0, duration], instead of `samples`.
    initial_state : array_like, shape (n_states,), optional
        State at t = 0, instead of the rotor's own.
    rtol : float [1]
        Local error of the journals at every moment: displacement / clearance and velocity /
        (clearance speed).
    max_step : float [s]
    condensation : float [1]
        Largest difference of the two runs of a large shaft, in clearances; 0 runs all of it.

    Returns
    -------
    Trajectory
        Signals: every output of `mounted`, its bearings' forces included. Work: film_evaluations, jacobians,
        steps, rejected, and of these restarts: steps cut short at the wall.

    Raises
    ------
    InputError
        If an argument is out of range, or the rotor is none that this function takes.
    ContactError
        If a journal reaches the wall; carries the trajectory until then.
    ConvergenceError
        If a film force is not finite or steps become too small; carries the trajectory until then.

    Warns
    -----
    ValidityWarning
        If a journal goes beyond the map of its film.
    """
    require_duration(mounted.bare, duration)
    require_positive("rtol", rtol)
    require_longest_step(max_step)
    require_non_negative("condensation", condensation)
    size = len(mounted.states)
    state = np.asarray(mounted.initial_state if initial_state is None else initial_state, dtype=float)
    if require_finite("initial_state", state).shape != (size,):
        raise InputError(f"initial_state must have shape ({size},), got {state.shape}")
    grid = sample_times(duration, samples, times)
    wanted = Wanted(grid=grid, duration=duration, rtol=rtol, max_step=max_step, condensation=condensation)
    return _agreed(starts(mounted, state, whole=condensation == 0.0), wanted)


class Wanted(NamedTuple):
    """What is asked of a run."""

    grid: Array
    duration: float
    rtol: float
    max_step: float
    condensation: float


def _agreed(starts: Iterator[ShapedStart], wanted: Wanted) -> Trajectory:
    """Return the first run that one in fewer shapes agrees with, or that of the whole rotor."""
    # Runs are compared at more times than those that are asked for.
    dense = wanted._replace(grid=np.union1d(wanted.grid, np.linspace(0.0, wanted.duration, COMPARED)))
    work: Counter[str] = Counter()
    before: Trajectory | None = None
    for start in starts:
        failure = None
        parts = take_apart(start.mounted)
        try:
            run = _run(start, parts, dense if start.condensed else wanted)
        except (ContactError, ConvergenceError) as raised:
            failure, run = raised, raised.partial
        work.update(run.work)
        near = before is not None and largest_difference(parts, before, run) <= wanted.condensation
        if near or not start.condensed:
            break
        before = run
    picked = replace(_at(run, wanted.grid), work=dict(work))
    if failure is not None:
        raise type(failure)(str(failure), picked) from failure
    return picked


def _at(run: Trajectory, grid: Array) -> Trajectory:
    """Return a run at those of its times that are on a grid."""
    kept = np.isin(run.time, grid)
    return replace(run, time=run.time[kept], signals={name: row[kept] for name, row in run.signals.items()})


def _run(start: ShapedStart, parts: Parts, wanted: Wanted) -> Trajectory:
    mounted, state, grid = start.mounted, start.state, wanted.grid
    rate = parts.nominal_speed or rate_of(modal_rotor(parts, 0.0))
    longest = min(wanted.max_step, wanted.duration, LONGEST_TURN * 2.0 * np.pi / rate)
    run = RunUp(parts, state, Settings(rtol=wanted.rtol, longest=longest, duration=wanted.duration))
    kept: list[Array] = [state[None]] if grid.size and grid[0] == 0.0 else []
    try:
        kept.extend(run.states(grid))
    except (ContactError, ConvergenceError) as failure:
        kept.append(failure.partial)
        raise type(failure)(str(failure), _trajectory(mounted, grid, kept, run)) from failure
    run.warn()
    return _trajectory(mounted, grid, kept, run)


def _trajectory(mounted: MountedRotor, grid: Array, kept: list[Array], run: RunUp) -> Trajectory:
    states = np.concatenate(kept) if kept else np.zeros((0, len(mounted.states)))
    time = grid[: len(states)]
    rotor = mounted.bare
    # Displacements and rates are linear in the state, the last output is the speed.
    rows = rotor.linearization(0.0, rotor.initial_state, np.zeros(len(rotor.inputs))).C
    outputs = rows @ states.T
    outputs[-1] = [run.parts.profile.speed(t) for t in time]
    signals = dict(zip(names(rotor.outputs), outputs, strict=True))
    parts = run.parts
    for name, bearing in zip(parts.names, parts.bearings, strict=True):
        prefix = f"{name}_" if name else ""
        x, y, vx, vy = (signals[prefix + key] for key in ("x", "y", "vx", "vy"))
        force = bearing.force(np.stack([x, y]), np.stack([vx, vy]), signals["speed"])
        signals[prefix + "force_x"], signals[prefix + "force_y"] = force
    known = {**dict.fromkeys(signals, "N"), **units(rotor.outputs)}
    return Trajectory(time=time, signals=signals, work=run.work, units=known)
