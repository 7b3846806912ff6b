"""Charts of flexible rotors: Campbell diagram, map of critical speeds, unbalance response."""

from __future__ import annotations

import math
from collections.abc import Sequence

import control
import numpy as np
from matplotlib.axes import Axes

from ..linear import Campbell, CriticalSpeed
from ..model import Array
from .canvas import new_axes, new_figure

RPM = math.pi / 30.0
HERTZ = 2.0 * math.pi

FORWARD, BACKWARD, MIXED, UNSTABLE = "#1f4fb4", "#d62728", "#7f7f7f", "#ffb000"
"""Colors of whirl with the rotation, against it, neither, and of whirl that grows (behind the others)."""

CIRCULAR = 0.1
"""Direction beyond which a whirl counts as forward or, negative, backward."""


def plot_campbell(
    chart: Campbell, *, critical: Sequence[CriticalSpeed] = (), axes: Axes | None = None
) -> Axes:
    """Draw whirl frequency [Hz] over speed [rpm], with the line on which both are equal.

    Parameters
    ----------
    chart : Campbell
    critical : sequence of CriticalSpeed
        Marked by circles.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Campbell diagram")
    speeds = chart.speeds / RPM
    kinds = {"forward": (FORWARD, "-"), "backward": (BACKWARD, "--"), "mixed": (MIXED, ":")}
    masks = {
        "forward": chart.direction > CIRCULAR,
        "backward": chart.direction < -CIRCULAR,
        "mixed": np.abs(chart.direction) <= CIRCULAR,
    }
    grows = np.where(chart.log_decrement < 0.0, chart.frequency, np.nan) / HERTZ
    _curves(axes, speeds, grows, "grows", color=UNSTABLE, style="-", width=5.0)
    for kind, (color, style) in kinds.items():
        _curves(axes, speeds, _where(masks[kind], chart.frequency) / HERTZ, kind, color=color, style=style)
    axes.plot(speeds, chart.speeds / HERTZ, "k-", linewidth=0.8, label="1x speed")
    if critical:
        places = np.array([one.speed for one in critical])
        axes.plot(places / RPM, places / HERTZ, "ko", fillstyle="none", label="critical speed")
    axes.set(xlabel="speed [rpm]", ylabel="damped frequency [Hz]", xlim=(speeds[0], speeds[-1]))
    axes.set_ylim(bottom=0.0)
    axes.legend(fontsize=8)
    return axes


def plot_log_decrement(chart: Campbell, *, axes: Axes | None = None) -> Axes:
    """Draw the logarithmic decrement of each mode over speed [rpm]; below zero the whirl grows.

    The axis is linear from -0.1 to 0.1, where shafts live, and logarithmic beyond, where films do.
    """
    axes = axes or new_axes("Stability")
    for decrement, frequency in zip(chart.log_decrement, chart.frequency, strict=True):
        first = frequency[np.isfinite(frequency)][0] / HERTZ
        axes.plot(chart.speeds / RPM, decrement, label=f"from {first:.3g} Hz")
    axes.axhline(0.0, color="k", linewidth=0.8)
    axes.set_yscale("symlog", linthresh=0.1)
    axes.set(xlabel="speed [rpm]", ylabel="logarithmic decrement")
    axes.legend(fontsize=8)
    return axes


def plot_critical_speed_map(
    stiffness: Array, speeds: Array, *, bearing: Array | None = None, axes: Axes | None = None
) -> Axes:
    """Draw undamped critical speeds [rpm] over bearing stiffness [N/m], both logarithmic.

    Parameters
    ----------
    stiffness : ndarray, shape (n,) [N/m]
    speeds : ndarray, shape (count, n) [rad/s]
        As `critical_speed_map` returns them.
    bearing : ndarray, shape (2, m), optional
        Speed [rad/s] and stiffness [N/m] of the bearing that the rotor will have.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Undamped critical speeds")
    for number, curve in enumerate(speeds, start=1):
        axes.loglog(stiffness, curve / RPM, label=f"critical speed {number}")
    if bearing is not None:
        axes.loglog(bearing[1], bearing[0] / RPM, "k--", label="bearing")
    axes.set(xlabel="bearing stiffness [N/m]", ylabel="critical speed [rpm]")
    axes.legend(fontsize=8)
    return axes


def plot_unbalance_response(
    response: control.FrequencyResponseData, outputs: Sequence[str], *, axes: Sequence[Axes] | None = None
) -> tuple[Axes, Axes]:
    """Draw amplitude [um] and phase [deg] of displacements over speed [rpm].

    Parameters
    ----------
    response : control.FrequencyResponseData
        As `unbalance_response` returns it.
    outputs : sequence of str
        Names of displacements.
    axes : two Axes, optional
        For amplitude and phase; a new figure by default.

    Returns
    -------
    (Axes, Axes)
    """
    if axes is None:
        axes = new_figure(size=(6.4, 6.0)).subplots(2, 1, sharex=True)
    above, below = axes
    speeds = np.asarray(response.frequency) / RPM
    for name in outputs:
        phasor = np.asarray(response.complex)[response.output_labels.index(name), 0]
        above.semilogy(speeds, np.abs(phasor) * 1e6, label=name)
        below.plot(speeds, np.degrees(np.unwrap(np.angle(phasor))), label=name)
    above.set(ylabel="amplitude [um]", title="Unbalance response")
    below.set(xlabel="speed [rpm]", ylabel="phase [deg]")
    above.legend(fontsize=8)
    for part in (above, below):
        part.grid(visible=True, alpha=0.3)
    return above, below


def _where(mask: np.ndarray, values: Array) -> Array:
    """Return the values of a mask and of the points beside it, so that its pieces join; nan elsewhere."""
    wide = mask.copy()
    wide[:, 1:] |= mask[:, :-1]
    return np.where(wide, values, np.nan)


def _curves(
    axes: Axes, x: Array, curves: Array, label: str, *, color: str, style: str, width: float = 1.5
) -> None:
    """Draw curves under one label, unless there is nothing to see."""
    for curve in curves:
        if np.isfinite(curve).any():
            axes.plot(x, curve, color=color, linestyle=style, linewidth=width, label=label)
            label = "_nolegend_"
