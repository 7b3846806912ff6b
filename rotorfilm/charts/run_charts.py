"""Pictures of runs over time: orbit, amplitude over speed, waterfall, spectrogram, full spectrum, windows."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from .. import analysis
from ..analysis.run_spectra import station_of
from ..core.readable import label_of
from ..core.results import Trajectory
from .canvas import WITHIN
from .picture import ColorScale, CurveMark, FieldMark, Mark, Picture, PicturePanel

RPM, HERTZ = math.pi / 30.0, 2.0 * math.pi

WINDOWS, SHOWN = 3, 2000
"""Time windows that are drawn, and samples in each."""


def plot_trajectory(run: Trajectory) -> Picture:
    """Describe the orbits of all journals [um], and their displacements over time.

    Where no journal moves in a plane, the second signal over the first, and the first over time, in SI.
    """
    stations = [name[:-1] for name in run.signals if name == "x" or name.endswith("_x")]
    stations = [name for name in stations if not name.endswith("force_") and f"{name}y" in run.signals]
    pairs, unit, factor = [(f"{name}x", f"{name}y") for name in stations], "um", 1e6
    if not pairs:
        pairs, unit, factor = [(*run.signals,)[:2]], "SI", 1.0  # type: ignore[list-item]
    beside, below = list[Mark](), list[Mark]()
    for k, pair in enumerate(pairs):
        first, second = (factor * run[name] for name in pair)
        label = label_of(pair[0].removesuffix("x")) or "journal"
        beside.append(CurveMark(first, second, label, f"C{k % 10}", width=1.3))
        for j, (name, values) in enumerate(zip(pair, (first, second), strict=True)):
            below.append(CurveMark(run.time, values, label_of(name), f"C{(2 * k + j) % 10}", width=1.2))
    x, y = ("x", "y") if stations else (label_of(name) for name in pairs[0])
    panels = (
        PicturePanel(beside, f"{x} [{unit}]", f"{y} [{unit}]", "Orbit", equal=bool(stations)),
        PicturePanel(below, "time [s]", f"displacement [{unit}]", "Over time"),
    )
    return Picture(panels, columns=2, size=(4.8, 4.4))


def plot_run_amplitudes(found: analysis.RunAmplitudes) -> Picture:
    """Describe overall and 1x amplitude [um] and the phase of 1x over speed [rpm]."""
    speeds = found.speed / RPM
    marks = [
        CurveMark(speeds, 1e6 * found.overall, "overall", "k"),
        CurveMark(speeds, 1e6 * np.abs(found.synchronous), "1x", "C0", "--"),
    ]
    phase = CurveMark(speeds, np.degrees(np.unwrap(np.angle(found.synchronous))), "1x", "C0", "--")
    text = "amplitude, zero-to-peak [um]", f"{label_of(found.signal)} over speed"
    panels = (
        PicturePanel(marks, "", *text),
        PicturePanel([phase], "speed [rpm]", "phase of 1x [deg]", legend="none"),
    )
    return Picture(panels, size=(7.4, 2.9))


def plot_waterfall(found: analysis.RunSpectra) -> Picture:
    """Describe spectra over speed, one behind the other, backward whirl at negative frequencies.

    Dotted lines are whirl at the speed, forward and backward, and at half of it.
    """
    along, label = _along(found)
    hertz, top = found.frequency / HERTZ, 1e6 * found.whirl_amplitude.max()
    marks: list[Mark] = [
        CurveMark(hertz, np.full(hertz.size, place), "", "C0", width=0.7, z=1e6 * row)
        for place, row in zip(along, found.whirl_amplitude, strict=True)
    ]
    if np.isfinite(found.speed).all():
        for order, color in ((1.0, "C3"), (0.5, "C1"), (-1.0, "C3")):
            line = order * found.speed / HERTZ, along
            marks.append(CurveMark(*line, f"{order:g}x", color, ":", z=np.zeros(along.size)))
    title = f"Waterfall, {found.station or 'journal'}, largest line {top:.4g} um"
    panel = PicturePanel(marks, "frequency [Hz], backward < 0 < forward", label, title, "zero-to-peak [um]")
    return Picture((panel,), size=(8.4, 6.4))


def plot_spectrogram(found: analysis.RunSpectra) -> Picture:
    """Describe the same as colors over speed [rpm] and frequency [Hz]; dotted lines are 1x and 1/2x."""
    along, label = _along(found)
    order = np.argsort(along)
    scale = ColorScale("amplitude, zero-to-peak [um]", "viridis")
    marks: list[Mark] = [
        FieldMark(along[order], found.frequency / HERTZ, 1e6 * found.whirl_amplitude[order].T, scale)
    ]
    if np.isfinite(found.speed).all():
        for turn, color in ((1.0, "#ff5555"), (0.5, "C1"), (-1.0, "#2ca02c")):
            line = turn * found.speed[order] / HERTZ
            marks.append(CurveMark(along[order], line, f"{turn:g}x", color, ":"))
    title = f"Spectrogram, {found.station or 'journal'}"
    text = label, "frequency [Hz], backward < 0 < forward", title
    return Picture((PicturePanel(marks, *text, legend="inside"),), size=(8.0, 5.0))


def _along(found: analysis.RunSpectra) -> tuple[np.ndarray, str]:
    """Return speeds [rpm] of spectra, or times where the speed is not known or does not change."""
    if np.isfinite(found.speed).all() and np.ptp(found.speed) > 1e-6 * np.abs(found.speed).max():
        return found.speed / RPM, "speed [rpm]"
    return found.time, "time [s]"


def plot_full_spectrum(found: analysis.RunSpectra, window: int = -1) -> Picture:
    """Describe the full spectrum of one window, the last by default: backward whirl left, forward right.

    Parameters
    ----------
    found : RunSpectra
    window : int
        Its place.
    """
    hertz, turn = found.frequency / HERTZ, float(found.speed[window])
    marks: list[Mark] = [CurveMark(hertz, 1e6 * found.whirl_amplitude[window])]
    speed = ""
    if math.isfinite(turn):
        speed = f" at {turn / RPM:.0f} rpm"
        tall = np.array([0.0, 1e6 * found.whirl_amplitude[window].max()])
        for order, dash in ((-1.0, "--"), (1.0, "--"), (0.5, ":")):
            marks.append(CurveMark(np.full(2, order * turn / HERTZ), tall, f"{order:g}x", "0.5", dash, 1.0))
    text = "frequency [Hz], backward < 0 < forward", "amplitude, zero-to-peak [um]"
    return Picture((PicturePanel(marks, *text, f"Full spectrum{speed}"),), size=(7.4, 4.4))


def plot_run_spectrum(found: analysis.RunSpectrum) -> Picture:
    """Describe the one-sided spectrum of a signal, with its peak and root mean square in the title."""
    unit = found.units.get("signal_amplitude", "m")
    factor, unit = (1e6, "um") if unit == "m" else (1.0, unit)
    marks = [CurveMark(found.frequency / HERTZ, factor * found.signal_amplitude)]
    title = f"{label_of(found.signal)}: peak {factor * found.peak:.4g}, rms {factor * found.rms:.4g} {unit}"
    text = "frequency [Hz]", f"amplitude, zero-to-peak [{unit}]", title
    return Picture((PicturePanel(marks, *text),), size=(7.4, 4.4))


def plot_run_orbits(found: analysis.RunOrbits) -> Picture:
    """Describe orbits at some speeds, a dot where the shaft passes the angle of t = 0 (keyphasor)."""
    panels = []
    for k, speed in enumerate(found.speed):
        x, y, dots = 1e6 * found.x[k], 1e6 * found.y[k], found.keyphasor[k]
        marks = [CurveMark(x, y, width=1.0), CurveMark(x[dots], y[dots], "keyphasor", "k", "", marker="o")]
        text = "x [um]", "y [um]", f"{speed / RPM:.0f} rpm"
        panels.append(PicturePanel(marks, *text, equal=True, legend="inside" if k == 0 else "none"))
    return Picture(
        tuple(panels), columns=3, size=(3.8, 3.6), title=f"Orbits of the journal {found.station}".rstrip()
    )


def plot_time_windows(run: Trajectory, starts: Sequence[float] = (), station: str = "") -> Picture:
    """Describe displacements [um] in some windows of a run, so that single turns can be seen.

    Parameters
    ----------
    run : Trajectory
    starts : sequence of float [s]
        Starts of the windows; at the beginning, in the middle and at the end by default.
    station : str
        The first by default.
    """
    prefix, count = f"{station}_" if station else station_of(run), min(SHOWN, run.time.size // 20 + 2)
    last = run.time.size - count
    places = np.searchsorted(run.time, starts) if len(starts) else np.linspace(0, last, WINDOWS)
    panels: list[PicturePanel] = []
    for first in np.clip(places, 0, last).astype(int):
        part = slice(first, first + count)
        marks = [
            CurveMark(run.time[part], 1e6 * run[f"{prefix}{axis}"][part], axis, f"C{k}", WITHIN[k])
            for k, axis in enumerate("xy")
        ]
        panels.append(
            PicturePanel(marks, "time [s]", "displacement [um]", legend="none" if panels else "inside")
        )
    return Picture(tuple(panels), size=(8.0, 2.3), title=label_of(prefix) or "journal")


def orbits_over_run(run: Trajectory) -> Picture:
    """Describe six orbits over the speeds of a run."""
    speeds = analysis.run_amplitudes(run).speed
    return plot_run_orbits(analysis.run_orbits(run, np.linspace(speeds.min(), speeds.max(), 6)))


RUNS: dict[str, Callable[[Any], Picture]] = {
    "orbit": plot_trajectory,
    "amplitude": lambda run: plot_run_amplitudes(analysis.run_amplitudes(run)),
    "waterfall": lambda run: plot_waterfall(analysis.run_spectra(run)),
    "spectrogram": lambda run: plot_spectrogram(analysis.run_spectra(run, windows=100)),
    "full_spectrum": lambda run: plot_full_spectrum(analysis.run_spectra(run, windows=5)),
    "spectrum": lambda run: plot_run_spectrum(analysis.run_spectrum(run)),
    "orbits": orbits_over_run,
    "windows": plot_time_windows,
}
"""Pictures of a run, by the `kind` of its `plot()`."""
