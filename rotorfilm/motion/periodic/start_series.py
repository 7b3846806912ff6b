"""The series that Newton's method for an orbit starts from: of an orbit of other periods, or a run's end."""

from __future__ import annotations

import math

import numpy as np

from ...errors import InputError
from ...model import Array
from ...results import Trajectory
from ..compiled.modal import ModalRotor
from .harmonics import series_rows


def subharmonic(series: Array, ratio: int) -> Array:
    """Return a series whose harmonic k becomes k * ratio."""
    if ratio <= 1:
        return series
    old = series.shape[1] // 2
    out = np.zeros((len(series), 2 * old * ratio + 1))
    out[:, 0 : old * ratio + 1 : ratio] = series[:, : old + 1]
    out[:, old * ratio + ratio :: ratio] = series[:, old + 1 :]
    return out


def end_of(
    modal: ModalRotor, run: Trajectory, frequency: float | None, harmonics: int
) -> tuple[Array, float]:
    """Return the series of the last orbit of a run; without a frequency, that at which it comes back."""
    keys = [f"{name}_" if name else "" for name in modal.parts.names]
    motion = np.concatenate([np.stack([run[key + "x"], run[key + "y"]]) for key in keys])
    if frequency is None:
        frequency = _recurrence(run.time, motion / np.repeat(modal.parts.lengths, 2)[:, None])
    begin = run.time[-1] - 2.0 * math.pi / frequency
    if begin < run.time[0]:
        raise InputError(f"start must last one orbit of {2.0 * math.pi / frequency:.6g} s at least")
    late = run.time >= begin
    # The phase counts from t = 0, where the unbalance of a driven orbit has its own.
    values, _ = series_rows(harmonics, frequency * run.time[late])
    fit, *_ = np.linalg.lstsq(values, motion[:, late].T, rcond=None)
    return np.ascontiguousarray(fit.T), frequency


def _recurrence(time: Array, motion: Array) -> float:
    """Return the frequency of the end of a run [rad/s]: from crossings of its mean in the same sense."""
    late = time >= 0.5 * (time[0] + time[-1])
    t = time[late]
    widest = int(np.argmax(np.ptp(motion[:, late], axis=1)))
    signal = motion[widest, late] - motion[widest, late].mean()
    up = np.nonzero((signal[:-1] < 0.0) & (signal[1:] >= 0.0))[0]
    if len(up) < 3:
        raise InputError("start must hold four orbits at least in its last half")
    crossings = t[up] - signal[up] * (t[up + 1] - t[up]) / (signal[up + 1] - signal[up])
    return 2.0 * math.pi * (len(up) - 1) / float(crossings[-1] - crossings[0])
