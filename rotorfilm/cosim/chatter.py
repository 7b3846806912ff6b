"""Finds, from the exchanged forces alone, whether a co-simulation chatters past its stability limit.

Past the limit of an explicit coupling the force overshoots from step to step. The run seldom blows up: the
film saturates the alternation, the sampled position may even stand still and the mean force stays
plausible, so only the alternation itself tells. It is told from physics by three marks together: the
second difference of the force reverses from step to step (a motion resolved by the macro step reverses
it twice a period), it does so on, and it does not decay, as every alternation below the limit does.

A journal thrown about passes the limit only here and there, in bursts that no such mark sees. What remains of
them is a force that changes by a good part of itself within single steps: a run that holds it is coarse,
whatever the cause.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError, require_finite
from ..model import Array
from ..readable.result import Readable

WINDOW = 12
"""Consecutive steps that are judged together."""

REVERSALS = 10
"""Reversals within the window that make an alternation: past 1.4 times the limit it is not quite regular."""

REVERSED = -0.5
"""Cosine between consecutive second differences below which they count as reversed."""

SIGNIFICANT = 0.01
"""Amplitude of an alternation that matters, in root mean square forces of the run."""


JUMP = 0.25
"""Half a force increment, in root mean square forces of the run, that makes a step too long."""

JUMPS = 5
"""Such steps within a window that make a run coarse; a load that comes on at once makes one or two."""


@dataclass(frozen=True, kw_only=True)
class CouplingReport(Readable):
    """What the exchanged forces say about a coupling.

    Attributes
    ----------
    chatter : bool
        Whether the force alternates from step to step without decaying: the macro step is past the
        stability limit, or too coarse for the motion, and the run is no answer.
    coarse : bool
        Whether, within some window, the force jumps by half its root mean square in many steps: the run is
        no answer either.
    onset : float or None [s]
        When the alternation, or else the coarse window, begins.
    amplitude : float [1]
        Largest amplitude of such an alternation, in root mean square forces of the run; 0 without one.
    hold_defect : float [1]
        Root mean square of half the force increments, in root mean square forces: the mean error of
        holding the force over a step. The order of magnitude of the coupling error in the force.
    """

    chatter: bool
    coarse: bool
    onset: float | None
    amplitude: float
    hold_defect: float


def inspect_coupling(time: ArrayLike, force: ArrayLike) -> CouplingReport:
    """Return what the exchanged forces say about the coupling.

    Parameters
    ----------
    time : array_like, shape (n,) [s]
        Communication points.
    force : array_like, shape (k, n) [N]
        The forces exchanged there.

    Raises
    ------
    InputError
        If a value is not finite or the shapes do not fit.
    """
    times, forces = require_finite("time", time), require_finite("force", force)
    if times.ndim != 1 or forces.ndim != 2 or forces.shape[1] != times.size:
        raise InputError(f"force must have shape (k, {times.size}), got {forces.shape}")
    level = _rms(forces)
    # Second differences of an alternation of amplitude a have the size 4 a.
    swing = np.diff(forces, n=2, axis=1) / 4.0
    sustained, amplitudes = _sustained(swing)
    hit = np.flatnonzero(sustained & (amplitudes > SIGNIFICANT * level))
    jumps = np.flatnonzero(_jumps(forces, level) >= JUMPS)
    first = [*hit[:1], *jumps[:1]][:1]
    return CouplingReport(
        chatter=hit.size > 0,
        coarse=jumps.size > 0,
        onset=float(times[first[0]]) if first else None,
        amplitude=float(amplitudes[hit].max() / level) if hit.size else 0.0,
        hold_defect=0.5 * _rms(np.diff(forces, axis=1)) / level if level > 0.0 else 0.0,
    )


def is_calm(force: Array) -> bool:
    """Return whether forces (k, n) change too little from step to step for any mark of chatter."""
    return bool(calm_windows(force, force.shape[1])[0])


def calm_windows(force: Array, length: int) -> NDArray[np.bool_]:
    """Return the same for each window of so many forces (k, n), at least 3, shape (n - length + 1,)."""
    change = np.diff(force, axis=1)
    swing = np.abs(np.diff(change, axis=1)).max(axis=0)
    level = np.sqrt(np.mean(sliding_window_view(np.sum(force**2, axis=0), length), axis=1))
    # Of vectors, which are no longer than the square root of k times their largest component.
    longest = len(force) ** 0.5
    alternates = 0.25 * longest * _peaks(swing, length - 2) > SIGNIFICANT * level
    jumps = 0.5 * longest * _peaks(np.abs(change).max(axis=0), length - 1) > JUMP * level
    return np.asarray(~(alternates | jumps | ~np.isfinite(level)))


def _peaks(values: Array, length: int) -> Array:
    """Return the largest value of each window."""
    return np.asarray(sliding_window_view(values, length).max(axis=1))


def _sustained(swing: Array) -> tuple[NDArray[np.bool_], Array]:
    """Return, for each window of second differences, whether they alternate undamped, and how strongly."""
    if swing.shape[1] < WINDOW + 1:
        return np.zeros(0, dtype=bool), np.zeros(0)
    size = np.hypot.reduce(swing, axis=0)
    reversed_ = np.sum(swing[:, 1:] * swing[:, :-1], axis=0) < REVERSED * size[1:] * size[:-1]
    alternating = sliding_window_view(reversed_, WINDOW).sum(axis=1) >= REVERSALS
    sizes = sliding_window_view(size, WINDOW + 1)
    half = (WINDOW + 1) // 2
    early, late = np.mean(sizes[:, :half] ** 2, axis=1), np.mean(sizes[:, -half:] ** 2, axis=1)
    return alternating & (late >= early), np.sqrt(np.mean(sizes**2, axis=1))


def _jumps(forces: Array, level: float) -> NDArray[np.int_]:
    """Return how many steps of each window change the force by too much."""
    jump = 0.5 * np.hypot.reduce(np.diff(forces, axis=1), axis=0) > JUMP * level
    if not jump.size:
        return np.zeros(0, dtype=int)
    return sliding_window_view(jump, min(WINDOW, jump.size)).sum(axis=1)


def _rms(vectors: Array) -> float:
    """Return the root mean square length of vectors (k, n)."""
    return float(np.sqrt(np.mean(np.sum(vectors**2, axis=0)))) if vectors.shape[1] else 0.0
