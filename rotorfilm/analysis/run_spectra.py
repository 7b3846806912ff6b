"""What a run says: amplitudes over speed, spectra, orbits, and whether whirl grows at constant speed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..core.errors import InputError, require_count, require_finite
from ..core.inputs import arguments, require_choice
from ..core.model import Array
from ..core.readable import Drawable, Readable
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


@dataclass(frozen=True, kw_only=True)
class RunSpectrum(Drawable):
    """One-sided spectrum of a signal of a run (discrete Fourier transform).

    Attributes
    ----------
    frequency : ndarray, shape (n,) [rad/s]
    signal_amplitude : ndarray, shape (n,) [m]
        Zero-to-peak: a sine of amplitude a has a line of height a.
    peak : float [m]
        Largest distance from the mean, zero-to-peak.
    rms : float [m]
        Root of the mean square about the mean.
    signal : str
        Name of the signal.
    units : dict of str to str
        Of signal_amplitude, peak and rms, those of the signal.
    """

    frequency: Array
    signal_amplitude: Array
    peak: float
    rms: float
    signal: str
    units: dict[str, str] = field(default_factory=dict)

    def _own_units(self) -> dict[str, str]:
        return self.units


@dataclass(frozen=True, kw_only=True)
class RunWhirl(Readable):
    """Whirl in the second half of a run at constant speed: the motion that does not repeat with each turn.

    Attributes
    ----------
    whirl_radius : float [m]
        Radius of the whirl in the last window, of equal mean square.
    growth_rate : float [1/s]
        Slope of the logarithm of the radius over time; negative if the whirl dies out, 0 without motion.
    whirl_ratio : float or None [1]
        Frequency / speed of the strongest line, negative for backward whirl; None without whirl.
    station : str
    verdict : str
    """

    whirl_radius: float
    growth_rate: float
    whirl_ratio: float | None
    station: str
    verdict: str


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
    time, (x, y) = _even(run, [f"{prefix}{axis}" for axis in "xy"], start)
    length = 2 * time.size // (windows + 1)
    if length < LEAST:
        raise InputError(f"windows must have {LEAST} samples at least, got {windows} of {length}")
    whirl = x + 1j * y
    known = speed is not None or "speed" in run.signals
    turning = np.interp(time, run.time, _turning(run, speed)[0]) if known else np.full(time.size, math.nan)
    places = np.arange(windows)[:, None] * (length // 2) + np.arange(length)
    frequency, lines = _lines(time, whirl[places])
    highest = ORDERS * np.abs(turning).max() if known and np.any(turning) else math.inf
    shown = np.abs(frequency) <= highest
    return RunSpectra(
        time=time[places].mean(axis=1),
        speed=turning[places].mean(axis=1),
        frequency=frequency[shown],
        whirl_amplitude=lines[:, shown],
        station=prefix.strip("_"),
    )


def _even(run: Trajectory, signals: Sequence[str], start: float) -> tuple[Array, list[Array]]:
    """Return even times from a start on, and signals there, interpolated linearly."""
    within = run.time[run.time >= start]
    time = np.linspace(within[0], within[-1], within.size) if within.size else within
    return time, [np.interp(time, run.time, _series(run, name)) for name in signals]


def _lines(time: Array, pieces: ArrayLike) -> tuple[Array, Array]:
    """Return rising frequencies [rad/s] and the height of the lines of pieces (..., n) without their mean."""
    rows = np.asarray(pieces)
    length, step = rows.shape[-1], (time[-1] - time[0]) / (time.size - 1)
    window = np.hanning(length + 2)[1:-1]
    lines = np.fft.fft((rows - rows.mean(axis=-1, keepdims=True)) * window, PADDED * length) / window.sum()
    frequency = np.fft.fftshift(2.0 * np.pi * np.fft.fftfreq(PADDED * length, step))
    return frequency, np.abs(np.fft.fftshift(lines, axes=-1))


@arguments
def run_spectrum(run: Trajectory, signal: str = "", start: float = -math.inf) -> RunSpectrum:
    """Return the one-sided spectrum of one signal of a run, with its peak and root mean square.

    Parameters
    ----------
    run : Trajectory
        Run whose samples, if not evenly spaced, are interpolated linearly.
    signal : str
        Any signal of the run; the first displacement along x by default.
    start : float [s]
        Time from which the signal is used, for example the end of a transient; by default the start of the
        run.

    Raises
    ------
    InputError
        If the run has no such signal, or fewer than 8 samples of it.

    Notes
    -----
    The window is that of von Hann, so that a line is three steps of frequency wide.
    """
    name = signal or f"{station_of(run)}x"
    time, (values,) = _even(run, [name], start)
    if time.size < LEAST:
        raise InputError(f"start must leave {LEAST} samples at least, got {start!r} s and {time.size}")
    frequency, lines = _lines(time, values)
    moved, upper = values - values.mean(), frequency >= 0.0
    return RunSpectrum(
        frequency=frequency[upper],
        signal_amplitude=2.0 * lines[upper],
        peak=float(np.abs(moved).max()),
        rms=float(np.sqrt(np.mean(moved**2))),
        signal=name,
        units=dict.fromkeys(("signal_amplitude", "peak", "rms"), run.units.get(name, "m")),
    )


HARMONICS, WINDOWS, TURNS = 3, 8, 2
"""Multiples of the speed that belong to a turn, windows of the second half of a run, their least turns."""

FAINT, NOISE, LASTING, STRAIGHT = 1e-3, 1e-6, 0.05, 0.9
"""Share of the motion below which no whirl is told, and no growth; change over the half that counts as
none; least correlation of growing whirl with an exponential."""


@arguments
def run_whirl(run: Trajectory, station: str = "", speed: Speed = None) -> RunWhirl:
    """Return whether the whirl in a run at constant speed grows, lasts or decays.

    In each of eight windows the mean and three harmonics of the speed are fitted to x + i y; the remaining
    motion is whirl. A run that starts exactly in its equilibrium without an excitation shows no whirl.
    `rotor_modes` or `whirl_threshold` then give the stability.

    Parameters
    ----------
    run : Trajectory
    station : str
        As in `run_spectra`.
    speed : float [rad/s], optional
        Speed of the run; its signal `speed` by default.

    Raises
    ------
    InputError
        If the speed changes or is 0, or the second half has less than 16 turns of 8 samples.
    """
    prefix = f"{station}_" if station else station_of(run)
    whirl = _series(run, f"{prefix}x") + 1j * _series(run, f"{prefix}y")
    turning, angle = _turning(run, speed)
    if not turning.size or np.ptp(turning) > NOISE * np.abs(turning).max() or not turning[0]:
        raise InputError("run must be at a constant speed that is not 0")
    half = run.time >= 0.5 * (run.time[0] + run.time[-1])
    turns = abs(angle[-1] - angle[half][0]) / (2.0 * math.pi)
    if turns < WINDOWS * TURNS or half.sum() < LEAST * turns:
        raise InputError(
            f"run must have {WINDOWS * TURNS} turns of {LEAST} samples in its second half, "
            f"got {turns:.3g} of {half.sum() / turns:.3g}"
        )
    pieces = [_not_synchronous(angle[at], whirl[at]) for at in np.array_split(np.flatnonzero(half), WINDOWS)]
    sizes = np.array([float(np.sqrt(np.mean(np.abs(one) ** 2))) for one in pieces])
    size, span = float(np.abs(whirl - whirl.mean()).max()), float(np.ptp(run.time[half]))
    time = np.arange(WINDOWS) * span / WINDOWS
    logs = np.log(np.maximum(sizes, np.finfo(float).tiny))
    rate = float(np.polyfit(time, logs, 1)[0])
    frequency, lines = _lines(run.time[half], _not_synchronous(angle[half], whirl[half]))
    ratio: float | None = float(frequency[lines.argmax()] / turning[0])
    grows = rate * span > LASTING and np.corrcoef(time, logs)[0, 1] > STRAIGHT
    seen = f"{sizes[-1] * 1e6:.3g} um at {ratio:.3g} of the speed"
    if size <= NOISE**2 + 1e-9 * float(np.abs(whirl).max()):
        verdict = "nothing moves the rotor from its rest, so that this run does not show whether whirl grows"
        rate, ratio = 0.0, None
    elif grows and sizes[-1] > NOISE * size:
        verdict = f"grows at {rate:.3g} 1/s, {seen} at the end"
    elif sizes[-1] < FAINT * size:
        verdict, ratio = "none: the motion repeats with each turn", None
    else:
        verdict = f"dies out at {-rate:.3g} 1/s" if rate * span < -LASTING else f"lasts, {seen}"
    return RunWhirl(
        whirl_radius=float(sizes[-1]),
        growth_rate=rate,
        whirl_ratio=ratio,
        station=prefix.strip("_"),
        verdict=verdict,
    )


def whirl_verdict(run: Trajectory) -> str:
    """Return the verdict of `run_whirl`; empty where a run has none."""
    try:
        return run_whirl(run).verdict
    except InputError:
        return ""


def _not_synchronous(angle: Array, whirl: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return what mean and harmonics of the speed leave of a motion x + i y."""
    columns = np.exp(1j * np.outer(angle, np.arange(-HARMONICS, HARMONICS + 1)))
    return np.asarray(whirl - columns @ np.linalg.lstsq(columns, whirl, rcond=None)[0])


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
    require_choice("signal", name, run.signals)
    return run.signals[name]


def _turning(run: Trajectory, speed: Speed) -> tuple[Array, Array]:
    """Return speed [rad/s] and angle [rad] of the shaft at the samples; the angle is 0 at t = 0."""
    if isinstance(speed, SpeedProfile):
        times = run.time.tolist()
        return np.array([speed.speed(t) for t in times]), np.array([speed.angle(t) for t in times])
    turning = _series(run, "speed") if speed is None else np.full(run.time.size, float(speed))
    steps = 0.5 * (turning[1:] + turning[:-1]) * np.diff(run.time)
    return turning, np.concatenate([[0.0], np.cumsum(steps)]) + turning[0] * run.time[0]
