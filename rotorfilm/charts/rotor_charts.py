"""Charts of flexible rotors: Campbell diagram, map of critical speeds, unbalance response."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import control
import numpy as np
from matplotlib.axes import Axes

from ..errors import InputError
from ..linear import Campbell, CriticalSpeed, RotorModes
from ..model import Array
from ..rotors import ShaftRotor
from .canvas import legend_beside, new_axes, new_figure

RPM = math.pi / 30.0
HERTZ = 2.0 * math.pi

FORWARD, BACKWARD, MIXED, UNSTABLE = "#1f4fb4", "#d62728", "#7f7f7f", "#ffb000"
"""Colors of whirl with the rotation, against it, neither, and of whirl that grows (behind the others)."""

_CIRCLE = 1e-6
"""Share of an orbit that is no circle, below which it has no longest direction."""

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
    grows = np.where(chart.grows, chart.frequency, np.nan) / HERTZ
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
    response: control.FrequencyResponseData,
    outputs: Sequence[str] | None = None,
    *,
    axes: Sequence[Axes] | None = None,
) -> tuple[Axes, Axes]:
    """Draw amplitude [um] and phase [deg] of displacements over speed [rpm].

    Parameters
    ----------
    response : control.FrequencyResponseData
        As `unbalance_response` returns it.
    outputs : sequence of str, optional
        Names of displacements; all of the response by default.
    axes : two Axes, optional
        For amplitude and phase; a new figure by default.

    Returns
    -------
    (Axes, Axes)
    """
    if axes is None:
        axes = new_figure(size=(7.4, 6.0)).subplots(2, 1, sharex=True)
    above, below = axes
    speeds = np.asarray(response.frequency) / RPM
    for name in displacements(response.output_labels) if outputs is None else outputs:
        phasor = np.asarray(response.frdata)[response.output_labels.index(name), 0]
        above.semilogy(speeds, np.abs(phasor) * 1e6, label=name)
        below.plot(speeds, np.degrees(np.unwrap(np.angle(phasor))), label=name)
    above.set(ylabel="amplitude [um]", title="Unbalance response")
    below.set(xlabel="speed [rpm]", ylabel="phase [deg]")
    legend_beside(above)
    for part in (above, below):
        part.grid(visible=True, alpha=0.3)
    return above, below


def displacements(names: Iterable[str]) -> list[str]:
    """Return the names of displacements among those of the outputs of a rotor."""
    along = [name for name in names if name.rpartition("_")[2] in ("x", "y")]
    return [name for name in along if not name.endswith(("force_x", "force_y"))]


def plot_mode_shape(rotor: ShaftRotor, modes: RotorModes, number: int, *, axes: Axes | None = None) -> Axes:
    """Draw one whirl mode along a shaft at the moment of its largest deflection, in both planes.

    Parameters
    ----------
    rotor : ShaftRotor
    modes : RotorModes
        Of this rotor.
    number : int
        Place of the mode in `modes`, from 0.
    axes : Axes, optional
        Where to draw; a new figure by default.

    Raises
    ------
    InputError
        If there is no such mode.
    """
    if not 0 <= number < len(modes.eigenvalues):
        raise InputError(f"number must be from 0 to {len(modes.eigenvalues) - 1}, got {number!r}")
    x, y = (_deflection(rotor, plane) for plane in np.split(modes.shapes[:, number], 2))
    size = np.sqrt(np.abs(x) ** 2 + np.abs(y) ** 2).max()
    turn = _turn(x, y) / size
    axes = axes or new_axes("Mode shape")
    along = rotor.positions
    axes.plot(along, (x * turn).real, "o-", markersize=3, color=FORWARD, label="x")
    axes.plot(along, (y * turn).real, "s--", markersize=3, color=BACKWARD, label="y")
    axes.plot(along[[s.node for s in rotor.stations]], np.zeros(len(rotor.stations)), "k^", label="bearing")
    axes.axhline(0.0, color="k", linewidth=0.8)
    frequency, decrement = modes.frequency[number] / HERTZ, modes.log_decrement[number]
    axes.set(
        xlabel="along the shaft [m]",
        ylabel="deflection / the largest",
        title=f"{frequency:.4g} Hz at {modes.speed / RPM:.0f} rpm, decrement {decrement:.3g}, "
        f"direction {modes.direction[number]:+.2f}",
    )
    axes.legend(fontsize=8)
    return axes


def _deflection(rotor: ShaftRotor, plane: np.ndarray) -> np.ndarray:
    return plane[0 : 2 * (len(rotor.elements) + 1) : 2]


def _turn(x: np.ndarray, y: np.ndarray) -> complex:
    """Return the phase, exp(i p), at which the node that moves most is farthest out; on a circle along x."""
    k = int(np.argmax(np.abs(x) ** 2 + np.abs(y) ** 2))
    # |Re(x e)|^2 + |Re(y e)|^2 is largest where x^2 + y^2 is turned to the real axis
    squares = x[k] ** 2 + y[k] ** 2
    circle = abs(squares) < _CIRCLE * (abs(x[k]) ** 2 + abs(y[k]) ** 2)
    return complex(np.exp(-1j * (np.angle(x[k]) if circle else 0.5 * np.angle(squares))))


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
