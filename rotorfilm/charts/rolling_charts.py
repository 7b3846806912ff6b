"""Pictures of ball bearings: loads, contact angles and stiffness over speed, swing."""

from __future__ import annotations

import math

import numpy as np

from ..analysis import VariableCompliance
from ..studies import BallCurves
from .picture import BarsMark, CurveMark, Picture, PicturePanel

RPM = 30.0 / math.pi
SHOWN = 8
"""Harmonics of the ball-pass frequency that are drawn."""


def plot_ball_curves(result: BallCurves) -> Picture:
    """Describe load distribution, contact angles over speed, stiffness over speed and preload, and swing."""
    around = np.degrees(np.mod(result.ball_angle, 2.0 * math.pi))
    order, last, speeds = np.argsort(around), len(result.speeds) - 1, RPM * result.speeds
    loads, stiffness = [], []
    for c, k in enumerate(sorted({0, last // 2, last})):
        label = f"inner, {speeds[k]:.5g} rpm"
        loads.append(CurveMark(around[order], result.inner_load[k][order], label, f"C{c}", marker="o"))
        outer = around[order], result.outer_load[k][order], "outer", f"C{c}", "--"
        loads.append(CurveMark(*outer, marker="s", filled=False))
    for k, preload in enumerate(result.preloads):
        radial, axial = 1e-6 * result.radial_stiffness[k], 1e-6 * result.axial_stiffness[k]
        stiffness.append(CurveMark(speeds, radial, f"radial, {preload:g} N", f"C{k}"))
        stiffness.append(CurveMark(speeds, axial, f"axial, {preload:g} N", f"C{k}", "--"))
    angles = [
        CurveMark(speeds, np.degrees(result.inner_angle), "inner", "C0"),
        CurveMark(speeds, np.degrees(result.outer_angle), "outer", "C1", "--"),
    ]
    loaded = f"Load distribution, {result.thrust:g} N along z, {result.load:g} N along -y"
    thrust = f"Contact angles under {result.thrust:g} N of thrust"
    pairs = "Back-to-back pairs, by the preload at which they are clamped"
    panels = (
        PicturePanel(loads, "place of the ball from +x [deg]", "contact load [N]", loaded),
        PicturePanel(angles, "speed [rpm]", "contact angle [deg]", thrust),
        PicturePanel(stiffness, "speed [rpm]", "stiffness [N/um]", pairs, y_limits=(0.0, None)),
        plot_compliance(result.swing).panels[0],
    )
    return Picture(panels, columns=2, size=(6.25, 4.3))


def plot_compliance(result: VariableCompliance) -> Picture:
    """Describe the spectrum of the swing of a shaft as balls pass, at multiples of their frequency."""
    orders = np.arange(1, min(SHOWN, result.swing_amplitude.shape[1]) + 1)
    passing = result.ball_pass_frequency / (2.0 * math.pi)
    unit, tops = passing or 1.0, 1e9 * result.swing_amplitude
    marks = [
        BarsMark((orders + side) * unit, tops[k, : orders.size], name, color, 0.18 * unit)
        for k, (name, side, color) in enumerate((("x", -0.1, "#d62728"), ("y", 0.1, "#1f4fb4")))
    ]
    panel = PicturePanel(
        marks,
        "frequency [Hz]" if passing else "multiple of the ball-pass frequency",
        "amplitude of the shaft, zero-to-peak [nm]",
        f"Motion under {math.hypot(*result.load):.4g} N, ball-pass frequency {passing:.4g} Hz",
        log="y",
        y_limits=(1e-3 * tops.max(), 3.0 * tops.max()),
    )
    return Picture((panel,))
