"""Runs of a shaft of many elements in as few of its shapes as they need."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Generator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from ..core.model import Array
from ..core.results import Trajectory
from ..rotors import FlexibleRotor, MotorDrivenRotor
from ..rotors.structure import MatrixRotor, mean_plane, solved_equations
from .compiled_rotor import Parts, place_rows, point_forces, state_matrices, turning_pairs
from .modal_reduction import Condensed, models
from .rotor_matrices import FASTER, unbalanced

CHECKED = 401
"""Times at which the neglected shapes of a run are looked at, at least."""

TRIAL_SHARE = 0.125
"""Share of a run in which shapes are tried before the whole of it runs."""


FREQUENCY = 4.0
"""Frequency of the fewest shapes / largest speed."""

SUDDEN = 2.0
"""Ratio of the response of a shape to a force that begins at once to that to a slow one."""


CONVERGENCE_POWER = 2.0
"""Power of their frequency with which the motion of neglected shapes is expected to fall."""


class RunStart(NamedTuple):
    """A rotor in some of its shapes, or whole.

    Attributes
    ----------
    rotor : Any
        As it is to be run.
    parts : Parts
    state : ndarray
        Its state at t = 0.
    neglected : NeglectedMotion or None
        What the shapes do not show; None if it is whole.
    """

    rotor: Any
    parts: Parts
    state: Array
    neglected: NeglectedMotion | None


def starts(
    bare: Any, joined: Callable[[Any], tuple[Any, Parts]], state: Array, *, whole: bool
) -> Generator[RunStart, float, None]:
    """Yield a rotor in ever more of its shapes, and whole in the end or at once.

    It is to be sent how many times too large the motion of the neglected shapes was.

    Parameters
    ----------
    bare : Dynamic
        The rotor without its bearings.
    joined : callable
        Returns such a rotor with its bearings, as it is to be run, and its parts.
    state : ndarray
        State of the whole at t = 0.
    whole : bool
    """
    rotor = bare.rotor if type(bare) is MotorDrivenRotor else bare
    if not whole and isinstance(rotor, FlexibleRotor) and rotor.assembly.hysteresis is None:
        frequency = FREQUENCY * bare.nominal_speed
        while (model := next(models(rotor, frequency))).space is not None:
            small: Any = MatrixRotor(rotor, model.structure)
            run, parts = joined(small if rotor is bare else replace(bare, rotor=small))
            begun = _within(model, state)
            excess = yield RunStart(run, parts, begun, neglected_motion(model, parts, state, begun))
            doublings = max(1, round(math.log2(excess) / CONVERGENCE_POWER)) if math.isfinite(excess) else 1
            frequency = max(frequency, 1.0) * 2.0**doublings
    yield RunStart(*joined(bare), state, None)


def _within(model: Condensed, state: Array) -> Array:
    """Return what of a state (2 N,) the shapes have, which are of unit mass."""
    assert model.space is not None
    mass, shapes = mean_plane(model.whole.mass), model.space.shapes
    count = 2 * len(model.whole.weight)
    parts = np.split(state[:count], 4)
    return np.concatenate([*(shapes.T @ (mass @ part) for part in parts), state[count:]])


class NeglectedMotion(NamedTuple):
    """How the shapes that a run neglects answer what its shapes do not balance, at the journals.

    The forces of the bearings in the run, the unbalance and the weight act on the whole rotor too. What the
    motion in the shapes leaves of them bends the neglected shapes, as slow forces do.

    Attributes
    ----------
    parts : Parts
        The rotor in its shapes.
    by_motion : ndarray, shape (2 n_points, 5 n)
        Displacement of the points of the journals per acceleration, velocity, velocity times speed, place,
        place times speed in the n shapes.
    by_force : ndarray, shape (2 n_points, 2 n_points + 3)
        Displacement per force on the points, per unit of the unbalance's acceleration and by the weight.
    begun : ndarray, shape (n_points,) [m]
        Displacement of the points at t = 0, at most, by what of the initial state the shapes do not have.
    """

    parts: Parts
    by_motion: Array
    by_force: Array
    begun: Array

    def largest(self, run: Trajectory, states: Array, turn: Array) -> float:
        """Return the largest displacement of a journal at the times of a run, in clearances.

        Parameters
        ----------
        run : Trajectory
            Run of the rotor in its shapes.
        states : ndarray, shape (n_times, 2 n)
        turn : ndarray, shape (3, n_times)
            Angle, speed and angular acceleration.
        """
        parts, time, speed = self.parts, run.time, turn[1][:, None]
        forces = np.column_stack([*point_forces(parts, run), turning_pairs(turn), np.ones(len(time))])
        steady, push, weight = state_matrices(parts.alone, 0.0)
        states = states[:, : len(steady)]
        place, velocity = np.hsplit(states, 2)
        pushed = forces @ np.column_stack([push, weight]).T
        by_speed = solved_equations(parts.structure).by_speed
        rates = states @ steady.T + speed * (states @ by_speed.T) + pushed
        motion = np.hstack([rates[:, place.shape[1] :], velocity, speed * velocity, place, speed * place])
        away = (forces @ self.by_force.T - motion @ self.by_motion.T).reshape(len(time), -1, 2)
        away = np.hypot(away[..., 0], away[..., 1]).max(axis=0, initial=0.0)
        return float(((SUDDEN * FASTER * away + self.begun) / parts.lengths).max())


def neglected_motion(model: Condensed, parts: Parts, state: Array, begun: Array) -> NeglectedMotion:
    """Return how neglected shapes move the journals of a rotor in a model of it.

    Parameters
    ----------
    model : Condensed
    parts : Parts
        The rotor in this model.
    state, begun : ndarray, shape (2 N,), (2 n,)
        Initial state of the whole rotor and of the model.
    """
    assert model.space is not None
    whole, shapes = model.whole, model.lifted(np.eye(len(model.structure.weight)))
    journals = place_rows(whole, parts.names, parts.bearings, tilted=parts.points > 1)
    matrices = whole.mass, whole.damping, whole.gyroscopic, whole.stiffness, whole.circulation
    columns = [*(matrix @ shapes for matrix in matrices), journals.T, whole.unbalance, whole.weight[:, None]]
    heavy = whole.mass @ shapes
    left = [unbalanced(part, shapes, heavy) for part in (journals.T, np.hstack(columns))]
    found = left[0].T @ model.answer(left[1])
    split = len(matrices) * shapes.shape[1]
    ends = 2 * len(whole.weight), 2 * shapes.shape[1]
    missing = zip(np.split(state[: ends[0]], 2), np.split(begun[: ends[1]], 2), strict=True)
    place, velocity = (journals @ (full - model.lifted(some)) for full, some in missing)
    size = np.hypot(*place.reshape(-1, 2).T) + np.hypot(*velocity.reshape(-1, 2).T) / model.space.cut
    return NeglectedMotion(parts, found[:, :split], found[:, split:], size)


def verified(
    starts: Generator[RunStart, float, None],
    run_of: Callable[..., tuple[Trajectory, Array, Array, Exception | None]],
    grid: Array,
    duration: float,
    condensation: float,
) -> Trajectory:
    """Return the first run whose neglected shapes move the journals little enough, or that of the whole.

    `run_of` takes a start, times and duration, and returns the run, the states at its times, angle, speed and
    acceleration there, and what ended it early, which is raised with what there is.
    """
    # The journals are looked at more often than at the times that are asked for.
    dense = np.union1d(grid, np.linspace(0.0, duration, CHECKED))
    tried = TRIAL_SHARE * duration
    work: Counter[str] = Counter()
    start = next(starts)
    while True:
        excess = 0.0
        first, whole = (dense[dense <= tried], tried), (dense, duration)
        trials = [first, whole] if start.neglected is not None else [(grid, duration)]
        for times, until in trials:
            run, states, turn, failure = run_of(start, times, duration=until)
            work.update(run.work)
            if start.neglected is not None:
                excess = start.neglected.largest(run, states, turn) / condensation
            if not excess <= 1.0:
                break
        if excess <= 1.0:
            break
        start = starts.send(excess)
    picked = replace(_at(run, grid), work=dict(work))
    if failure is not None:
        raise type(failure)(str(failure), picked) from failure
    return picked


def _at(run: Trajectory, grid: Array) -> Trajectory:
    """Return a run at those of its times that are on a grid."""
    kept = np.isin(run.time, grid)
    return replace(run, time=run.time[kept], signals={name: row[kept] for name, row in run.signals.items()})
