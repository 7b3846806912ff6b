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
    _draw_loads(result, shown[0])
    _draw_angles(result, shown[1])
    _draw_stiffness(result, shown[2])
    plot_compliance(result.swing, axes=shown[3])
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
    for name, row, side in zip("xy", result.swing_amplitude, (-0.1, 0.1), strict=True):
        axes.vlines(
            (orders + side) * unit, 1e-12, 1e9 * row[: orders.size], label=name, lw=4.0, color=_color(side)
        )
    axes.set(
        yscale="log",
        xlabel="frequency [Hz]" if passing else "multiple of the ball-pass frequency",
        ylabel="amplitude of the place [nm]",
        title=f"Swing under {math.hypot(*result.load):.4g} N as balls pass, {passing:.4g} Hz",
    )
    axes.set_ylim(1e-3 * 1e9 * result.swing_amplitude.max(), 3e9 * result.swing_amplitude.max())
    with_grids(axes)
    return axes


def _draw_loads(result: BallCurves, axes: Axes) -> None:
    order = np.argsort(np.mod(result.ball_angle, 2.0 * math.pi))
    angle = np.degrees(np.mod(result.ball_angle, 2.0 * math.pi))[order]
    last = len(result.speeds) - 1
    for k in sorted({0, last // 2, last}):
        (line,) = axes.plot(
            angle, result.inner_load[k][order], "o-", label=f"inner, {_rpm(result.speeds[k])}"
        )
        axes.plot(
            angle, result.outer_load[k][order], "s--", color=line.get_color(), mfc="none", label="outer"
        )
    axes.set(
        xlabel="place of the ball from +x [deg]",
        ylabel="contact load [N]",
        title=f"Load distribution, {result.thrust:g} N along z, {result.load:g} N along -y",
    )
    with_grids(axes)


def _draw_angles(result: BallCurves, axes: Axes) -> None:
    axes.plot(RPM * result.speeds, np.degrees(result.inner_angle), label="inner")
    axes.plot(RPM * result.speeds, np.degrees(result.outer_angle), "--", label="outer")
    axes.set(
        xlabel="speed [rpm]",
        ylabel="contact angle [deg]",
        title=f"Contact angles under {result.thrust:g} N of thrust",
    )
    with_grids(axes)


def _draw_stiffness(result: BallCurves, axes: Axes) -> None:
    for preload, radial, axial in zip(
        result.preloads, result.radial_stiffness, result.axial_stiffness, strict=True
    ):
        (line,) = axes.plot(RPM * result.speeds, 1e-6 * radial, label=f"radial, {preload:g} N")
        axes.plot(RPM * result.speeds, 1e-6 * axial, "--", color=line.get_color(), label="axial")
    axes.set(
        xlabel="speed [rpm]",
        ylabel="stiffness [N/um]",
        title="Pairs back to back by their preload as clamped",
    )
    axes.set_ylim(bottom=0.0)
    with_grids(axes)


def _rpm(speed: float) -> str:
    return f"{RPM * speed:.5g} rpm"


def _color(side: float) -> str:
    return "#1f4fb4" if side > 0.0 else "#d62728"
