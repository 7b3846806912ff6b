"""Numbers that describe a run of a point contact: decay time, amplitude, travelling film."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import find_peaks

from ...bearings.contact import ContactRun, ContactState
from ...model import Array

SMALLEST_PEAK = 1e-4
"""Peaks of delta below which a decay is lost in the errors of the steps."""

SAMPLES = 4001
"""Instants at which a span of time is searched for its extremes."""

PROMINENT = 0.02
"""Prominence of a crest / range of the film's change: less is noise."""

CORE = 0.6
"""Half the length along y = 0 on which the travelling film is followed."""


def decay_time(run: ContactRun, rest: float, begin: float = 1.0, end: float = np.inf) -> float:
    """Return the time in which delta's oscillation about `rest` falls by e, from its peaks; 0 if none."""
    spline = CubicSpline(run.time, run.delta - rest)
    peaks = spline.derivative().roots(extrapolate=False)
    peaks = peaks[(peaks > begin) & (peaks < end)]
    height = np.abs(spline(peaks))
    peaks, height = peaks[height > SMALLEST_PEAK], height[height > SMALLEST_PEAK]
    return float(-1.0 / np.polyfit(peaks, np.log(height), 1)[0]) if len(peaks) > 1 else 0.0


def amplitude(run: ContactRun, begin: float, end: float = np.inf, name: str = "delta") -> float:
    """Return half the range of a series over a span of time, between samples too."""
    return 0.5 * float(np.ptp(_between(run, begin, end, name)))


def overshoot(run: ContactRun, rest: float, begin: float = 0.0, end: float = np.inf) -> float:
    """Return how far delta goes beyond `rest`, per its distance from there at first."""
    past = _between(run, begin, end, "delta") - rest
    return max(0.0, float(np.max(-past / past[0])))


def unrest(run: ContactRun, period: float, end: float, name: str = "delta") -> float:
    """Return the change from the last period before `end` to the one before, / half the range."""
    span, end = np.linspace(0.0, period, SAMPLES), min(end, float(run.time[-1]))
    spline = CubicSpline(run.time, getattr(run, name))
    last, before = spline(end - period + span), spline(end - 2.0 * period + span)
    return float(np.max(np.abs(last - before)) / (0.5 * np.ptp(last)))


def wave_speed(states: Sequence[ContactState], rest: ContactState, x: Array) -> float:
    """Return the speed of the first crest of the film's change from rest along y = 0, in (u1 + u2)/2."""
    points = np.linspace(-CORE, CORE, SAMPLES)
    times, crests = [], []
    for state in states:
        change = CubicSpline(x, (state.thickness - rest.thickness)[:, 0])(points)
        found, _ = find_peaks(change, prominence=PROMINENT * float(np.ptp(change)))
        if len(found):
            times.append(state.t)
            crests.append(points[found[0]])
    return float(np.polyfit(times, crests, 1)[0]) if len(times) > 1 else 0.0


def wave_height(state: ContactState, rest: ContactState, x: Array) -> float:
    """Return the range of the change of the film along y = 0 from rest, within the core."""
    core = np.abs(x) < CORE
    return float(np.ptp((state.thickness - rest.thickness)[core, 0]))


def _between(run: ContactRun, begin: float, end: float, name: str) -> Array:
    begin, end = max(begin, float(run.time[0])), min(end, float(run.time[-1]))
    return np.asarray(CubicSpline(run.time, getattr(run, name))(np.linspace(begin, end, SAMPLES)))
