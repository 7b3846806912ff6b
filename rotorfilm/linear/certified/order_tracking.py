"""What turns with the shaft in a run over time: a coast-down as a response over speed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...errors import InputError, require_count
from ...inputs.kinds import arguments
from ...model import Array
from ...results import Trajectory
from ...rotors import SpeedProfile

if TYPE_CHECKING:
    import control

LEAST_SAMPLES = 12
"""Samples a turn that are needed."""


@arguments
def tracked_response(
    run: Trajectory, speed: SpeedProfile, outputs: Sequence[str] | None = None, *, turns: int = 2
) -> control.FrequencyResponseData:
    """Return the 1x part of signals over speed, from a run-up or a coast-down.

    Bode and polar plots and separation margins take it as they take an `unbalance_response`.

    Parameters
    ----------
    run : Trajectory
        With at least 12 samples a turn.
    speed : SpeedProfile
        Of the run: positive, and rising or falling throughout it; samples while it stays the same are left
        out.
    outputs : sequence of str, optional
        Names of signals; all displacements along x and y by default.
    turns : int
        Turns of the shaft from which each phasor is taken.

    Returns
    -------
    control.FrequencyResponseData
        Input `unbalance` [1]: that of the run. Phasors at exp(i angle of the shaft), over the speed in the
        middle of each window.

    Raises
    ------
    InputError
        If a signal is not there, samples are too few, or the speed does not rise or fall.

    Notes
    -----
    A least-squares fit of a constant, a slope, and cos and sin of the shaft's angle with amplitudes that
    change linearly over the window: what is not at one or zero times the speed is averaged out.
    """
    require_count("turns", turns)
    names = [n for n in run.signals if n.rpartition("_")[2] in ("x", "y")] if outputs is None else [*outputs]
    if missing := [name for name in names if name not in run.signals]:
        raise InputError(f"outputs must be among {list(run.signals)}, got {missing}")
    speeds, windows = _windows(run.time, speed, turns)
    table = np.array([run.signals[name] for name in names])
    phasors = np.array([_fitted(angle, table[:, chosen]) for chosen, angle in windows])
    order = np.argsort(speeds)
    import control

    return control.FrequencyResponseData(
        phasors[order].T[:, None],
        speeds[order],
        inputs=["unbalance"],
        outputs=names,
        name="tracked_response",
    )


def _windows(time: Array, speed: SpeedProfile, turns: int) -> tuple[Array, list[tuple[Array, Array]]]:
    """Return mean speeds, and places and angles of the samples of each window."""
    moving = [t for t in time.tolist() if speed.acceleration(t) != 0.0]
    if not moving or min(speed.speed(t) for t in moving) <= 0.0:
        raise InputError("speed must be positive, and rise or fall in the run, got one that does not")
    places = np.flatnonzero((time >= moving[0]) & (time <= moving[-1]))
    angle = np.array([speed.angle(t) for t in time[places].tolist()])
    number = ((angle - angle[0]) / (2.0 * math.pi * turns)).astype(int)
    found, speeds = [], []
    for k in range(number[-1]):
        inside = number == k
        if inside.sum() < LEAST_SAMPLES * turns:
            raise InputError(
                f"run must have at least {LEAST_SAMPLES} samples a turn, got {inside.sum() / turns:.3g}"
            )
        found.append((places[inside], angle[inside]))
        middle = np.interp(0.5 * (angle[inside][0] + angle[inside][-1]), angle, time[places])
        speeds.append(speed.speed(float(middle)))
    steps = np.diff(speeds)
    if len(speeds) < 2 or not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        raise InputError(f"speed must rise or fall throughout some windows of {turns} turns, got none")
    return np.array(speeds), found


def _fitted(angle: Array, signals: Array) -> np.ndarray:
    """Return the phasors of signals, shape (n_signals, n_samples), in the middle of a window."""
    middle = 0.5 * (angle[0] + angle[-1])
    along = (angle - middle) / (angle[-1] - angle[0])
    cos, sin = np.cos(angle), np.sin(angle)
    columns = np.stack([cos, sin, np.ones_like(angle), along, along * cos, along * sin], axis=1)
    fit = np.linalg.lstsq(columns, signals.T, rcond=None)[0]
    return np.asarray(fit[0] - 1j * fit[1])
