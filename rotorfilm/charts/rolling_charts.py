"""Charts of ball bearings: loads, contact angles and stiffness over speed, swing."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from ..analysis import VariableCompliance
from ..studies import BallCurves
from .canvas import new_axes, new_grid, with_grids

RPM = 30.0 / math.pi
SHOWN = 8
"""Harmonics of the ball-pass frequency that are drawn."""


def plot_ball_curves(result: BallCurves) -> list[Axes]:
    """Draw load distribution, contact angles over speed, stiffness over speed and preload, and the swing.

    Parameters
    ----------
    result : BallCurves
    """
    shown = new_grid(4, columns=2, size=(6.25, 4.3))
    loads, angles, stiffness, swing = shown
    around = np.degrees(np.mod(result.ball_angle, 2.0 * math.pi))
    order, last = np.argsort(around), len(result.speeds) - 1
    for k in sorted({0, last // 2, last}):
        label = f"inner, {RPM * result.speeds[k]:.5g} rpm"
        (line,) = loads.plot(around[order], result.inner_load[k][order], "o-", label=label)
        outer = {"color": line.get_color(), "mfc": "none", "label": "outer"}
        loads.plot(around[order], result.outer_load[k][order], "s--", **outer)
    loads.set(xlabel="place of the ball from +x [deg]", ylabel="contact load [N]")
    loads.set_title(f"Load distribution, {result.thrust:g} N along z, {result.load:g} N along -y")
    speeds = RPM * result.speeds
    angles.plot(speeds, np.degrees(result.inner_angle), label="inner")
    angles.plot(speeds, np.degrees(result.outer_angle), "--", label="outer")
    angles.set(xlabel="speed [rpm]", ylabel="contact angle [deg]")
    angles.set_title(f"Contact angles under {result.thrust:g} N of thrust")
    for k, preload in enumerate(result.preloads):
        (line,) = stiffness.plot(speeds, 1e-6 * result.radial_stiffness[k], label=f"radial, {preload:g} N")
        axial = {"color": line.get_color(), "label": "axial"}
        stiffness.plot(speeds, 1e-6 * result.axial_stiffness[k], "--", **axial)
    stiffness.set(xlabel="speed [rpm]", ylabel="stiffness [N/um]")
    stiffness.set_title("Pairs back to back by their preload as clamped")
    stiffness.set_ylim(bottom=0.0)
    with_grids(loads, angles, stiffness)
    plot_compliance(result.swing, axes=swing)
    return shown


def plot_compliance(result: VariableCompliance, *, axes: Axes | None = None) -> Axes:
    """Draw the spectrum of the swing of a shaft as balls pass: amplitudes at multiples of their frequency.

    Parameters
    ----------
    result : VariableCompliance
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Swing as balls pass")
    orders = np.arange(1, min(SHOWN, result.swing_amplitude.shape[1]) + 1)
    passing = result.ball_pass_frequency / (2.0 * math.pi)
    unit = passing or 1.0
    for k, (name, side, color) in enumerate((("x", -0.1, "#d62728"), ("y", 0.1, "#1f4fb4"))):
        tops = 1e9 * result.swing_amplitude[k, : orders.size]
        axes.vlines((orders + side) * unit, 1e-12, tops, label=name, lw=4.0, color=color)
    axes.set(
        yscale="log",
        xlabel="frequency [Hz]" if passing else "multiple of the ball-pass frequency",
        ylabel="amplitude of the place [nm]",
        title=f"Swing under {math.hypot(*result.load):.4g} N as balls pass, {passing:.4g} Hz",
    )
    axes.set_ylim(1e-3 * 1e9 * result.swing_amplitude.max(), 3e9 * result.swing_amplitude.max())
    with_grids(axes)
    return axes
