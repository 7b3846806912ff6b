"""What a run says over speed: overall and 1x amplitude, spectra with forward and backward whirl, orbits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..core.errors import InputError, require_count, require_finite
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Drawable
from ..core.results import Trajectory
from ..rotors import SpeedProfile
from .unbalance_margins import fitted_phasors

PADDED = 4
"""Length of a transform / that of its window: a peak between two frequencies is then seen within 1.5 %."""

ORDERS = 2.0
"""Highest frequency that is kept / the highest speed."""

POINTS = 90
"""Points of an orbit in a turn, interpolated linearly between the samples."""

LEAST = 8
"""Samples that a turn or a window needs."""


@dataclass(frozen=True, kw_only=True)
class RunAmplitudes(Drawable):
    """Amplitudes of a signal in a run-up or coast-down, in windows of some turns.

    Attributes
    ----------
    speed : ndarray, shape (n,) [rad/s]
        Mean speed of a window.
    time : ndarray, shape (n,) [s]
        Middle of a window.
    overall : ndarray, shape (n,) [m]
        Zero-to-peak: half of the swing from the smallest to the largest.
    synchronous : ndarray of complex, shape (n,) [m]
        The 1x part, zero-to-peak: a phasor at exp(i angle of the shaft).
    signal : str
        Name of the signal, such as left_x.
    """

    speed: Array
    time: Array
    overall: Array
    synchronous: NDArray[np.complex128]
    signal: str


@dataclass(frozen=True, kw_only=True)
class RunSpectra(Drawable):
    """Full spectra of x + i y in windows of a run: positive frequencies are forward whirl, about +z.

    Attributes
    ----------
    time : ndarray, shape (n,) [s]
        Middle of a window.
    speed : ndarray, shape (n,) [rad/s]
        Mean speed of a window; nan where it is not known.
    frequency : ndarray, shape (m,) [rad/s]
        Rising, from negative values (backward whirl) to positive values (forward whirl).
    whirl_amplitude : ndarray, shape (n, m) [m]
        Radius of the circle of that frequency, zero-to-peak.
    station : str
        Name of the station; empty for the only one.
    """

    time: Array
    speed: Array
    frequency: Array
    whirl_amplitude: Array
    station: str


@dataclass(frozen=True, kw_only=True)
class RunOrbits(Drawable):
    """Orbits of a station in a run at chosen speeds, over some turns each.

    Attributes
    ----------
    speed : ndarray, shape (n,) [rad/s]
    time, x, y : ndarray, shape (n, samples) [s, m, m]
    keyphasor : ndarray of bool, shape (n, samples)
        Where the shaft has just passed the angle that it had at t = 0.
    station : str
    """

    speed: Array
    time: Array
    x: Array
    y: Array
    keyphasor: NDArray[np.bool_]
    station: str

    _along: ClassVar[str] = "n"


Speed = SpeedProfile | float | None


@arguments
def run_amplitudes(
    run: Trajectory, signal: str = "", speed: Speed = None, *, turns: int = 4
) -> RunAmplitudes:
    """Return overall and 1x amplitude of a signal over the speed of a run.

    Parameters
    ----------
    run : Trajectory
    signal : str
        A displacement; the first along x by default.
    speed : SpeedProfile or float [rad/s], optional
        Speed of the run; its signal `speed` by default.
    turns : int
        Turns of the shaft in a window.

    Raises
    ------
    InputError
        If a signal is not there, no window has 8 samples a turn, or the shaft does not turn.
    """
    require_count("turns", turns)
    name = signal or f"{station_of(run)}x"
    values, speeds, angle = _series(run, name), *_turning(run, speed)
    number = np.floor(np.abs(angle) / (2.0 * math.pi * turns)).astype(int)
    found = []
    for k in range(int(number.max(initial=0))):
        at = np.flatnonzero(number == k)
        if at.size >= LEAST * turns:
            phasor = fitted_phasors(np.abs(angle[at]), values[None, at])[0]
            means = (float(one[at].mean()) for one in (speeds, run.time))
            found.append((*means, 0.5 * float(np.ptp(values[at])), phasor))
    if not found:
        raise InputError(f"run must have some windows of {turns} turns with {LEAST} samples a turn, got none")
    turned, time, overall, phasors = zip(*found, strict=True)
    return RunAmplitudes(
        speed=np.array(turned),
        time=np.array(time),
        overall=np.array(overall),
        synchronous=np.array(phasors),
        signal=name,
    )


@arguments
def run_spectra(
    run: Trajectory, station: str = "", speed: Speed = None, *, windows: int = 40, start: float = -math.inf
) -> RunSpectra:
    """Return full spectra of the displacement of a station in windows that overlap by half.

    Parameters
    ----------
    run : Trajectory
        Run whose samples, if not evenly spaced, are interpolated linearly.
    station : str
        Station such as "left" for left_x and left_y; the first by default.
    speed : SpeedProfile or float [rad/s], optional
        Speed of the run; its signal `speed` by default, where it has one.
    windows : int
        Number of windows; 1 for a spectrum of the whole run.
    start : float [s]
        Start of the first window; the start of the run by default.

    Raises
    ------
    InputError
        If the station is not there, or the windows have less than 8 samples.

    Notes
    -----
    Windows of von Hann, without their mean, scaled so that a circle of radius a has a line of height a. An
    ellipse of half axes a and b has (a + b)/2 forward and (a - b)/2 backward, where it is forward.
    """
    require_count("windows", windows)
    prefix = f"{station}_" if station else station_of(run)
    kept = run.time >= start
    within = run.time[kept]
    time = np.linspace(within[0], within[-1], within.size) if within.size else within
    length = 2 * time.size // (windows + 1)
    if length < LEAST:
        raise InputError(f"windows must have {LEAST} samples at least, got {windows} of {length}")
    x, y = (np.interp(time, run.time, _series(run, f"{prefix}{axis}")) for axis in "xy")
    whirl = x + 1j * y
    known = speed is not None or "speed" in run.signals
    turning = np.interp(time, run.time, _turning(run, speed)[0]) if known else np.full(time.size, math.nan)
    places = np.arange(windows)[:, None] * (length // 2) + np.arange(length)
    window, step = np.hanning(length + 2)[1:-1], (time[-1] - time[0]) / (time.size - 1)
    pieces = whirl[places] - whirl[places].mean(axis=1, keepdims=True)
    lines = np.fft.fft(pieces * window, PADDED * length) / window.sum()
    frequency = np.fft.fftshift(2.0 * np.pi * np.fft.fftfreq(PADDED * length, step))
    highest = ORDERS * np.abs(turning).max() if known and np.any(turning) else math.inf
    shown = np.abs(frequency) <= highest
    return RunSpectra(
        time=time[places].mean(axis=1),
        speed=turning[places].mean(axis=1),
        frequency=frequency[shown],
        whirl_amplitude=np.abs(np.fft.fftshift(lines, axes=1))[:, shown],
        station=prefix.strip("_"),
    )


@arguments
def run_orbits(
    run: Trajectory, speeds: ArrayLike, station: str = "", speed: Speed = None, *, turns: int = 4
) -> RunOrbits:
    """Return the orbits of a station where a run comes closest to some speeds.

    Parameters
    ----------
    run : Trajectory
    speeds : array_like, shape (n,) [rad/s]
        Within those of the run.
    station, speed
        As in `run_spectra`.
    turns : int
        Number of turns of the shaft that each orbit shows.

    Raises
    ------
    InputError
        If a speed is not among those of the run, or has less than 8 samples a turn there.
    """
    require_count("turns", turns)
    prefix = f"{station}_" if station else station_of(run)
    series = [_series(run, f"{prefix}{axis}") for axis in "xy"]
    turning, angle = _turning(run, speed)
    wanted = np.atleast_1d(require_finite("speeds", speeds))
    low, high = turning.min(), turning.max()
    if np.any(wanted < low - 1e-9 * abs(low)) or np.any(wanted > high + 1e-9 * abs(high)) or not wanted.all():
        raise InputError(
            f"speeds must be in the run, {low:.6g} to {high:.6g} rad/s, and not 0, got {speeds!r}"
        )
    times = []
    for one in wanted:
        middle = angle[int(np.argmin(np.abs(turning - one)))]
        around = run.time[np.abs(angle - middle) <= math.pi * turns]
        if around.size < LEAST * turns:
            each = around.size / turns
            raise InputError(f"run must have {LEAST} samples a turn at {one:.6g} rad/s, got {each:.3g}")
        times.append(np.linspace(around[0], around[-1], POINTS * turns + 1))
    time = np.array(times)
    number = np.floor(np.interp(time, run.time, angle) / (2.0 * math.pi))
    passed = np.diff(number, prepend=number[:, :1]) != 0.0
    x, y = (np.interp(time, run.time, values) for values in series)
    return RunOrbits(
        speed=wanted,
        time=time,
        x=x,
        y=y,
        keyphasor=passed,
        station=prefix.strip("_"),
    )


def station_of(run: Trajectory) -> str:
    """Return the prefix of the first signals that are displacements along x and y; InputError without."""
    names: Sequence[str] = [name[:-1] for name in run.signals if name == "x" or name.endswith("_x")]
    found = [name for name in names if not name.endswith("force_") and f"{name}y" in run.signals]
    if not found:
        raise InputError(f"run must have displacements along x and y, got {', '.join(run.signals)}")
    return found[0]


def _series(run: Trajectory, name: str) -> Array:
    if name not in run.signals:
        raise InputError(f"signal must be one of {', '.join(run.signals)}, got {name!r}")
    return run.signals[name]


def _turning(run: Trajectory, speed: Speed) -> tuple[Array, Array]:
    """Return speed [rad/s] and angle [rad] of the shaft at the samples; the angle is 0 at t = 0."""
    if isinstance(speed, SpeedProfile):
        times = run.time.tolist()
        return np.array([speed.speed(t) for t in times]), np.array([speed.angle(t) for t in times])
    turning = _series(run, "speed") if speed is None else np.full(run.time.size, float(speed))
    steps = 0.5 * (turning[1:] + turning[:-1]) * np.diff(run.time)
    return turning, np.concatenate([[0.0], np.cumsum(steps)]) + turning[0] * run.time[0]
