"""Charts of a melting bush: critical speed over the contact angle, pressure and wear over the contact."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from .canvas import new_axes

Curves = Mapping[str, tuple[np.ndarray, np.ndarray]]


def plot_critical_speed(curves: Curves, *, axes: Axes | None = None) -> Axes:
    """Draw critical speeds, relative to that of the unworn bush, over half the contact angle.

    Parameters
    ----------
    curves : mapping of str to (ndarray, ndarray)
        Label, angle [rad] and speed ratio [1], each of shape (n,).
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Critical speed of the bush as it wears")
    for label, (angle, ratio) in curves.items():
        axes.plot(angle, ratio, label=label, linewidth=1.5)
    axes.set(xlabel="half contact angle [rad]", ylabel="critical speed / that of the unworn bush")
    axes.legend(fontsize=8)
    return axes


def plot_contact_pressure(
    curves: Curves, *, assumed: Curves | None = None, modulus: float, axes: Axes | None = None
) -> Axes:
    """Draw contact pressures over the angle from the load line.

    Parameters
    ----------
    curves : mapping of str to (ndarray, ndarray)
        Label, angle [rad] and pressure [Pa], each of shape (n,).
    assumed : mapping of str to (ndarray, ndarray), optional
        Pressures of an assumed shape, by the labels of `curves`; dashed in the same color.
    modulus : float [Pa]
        Unit of the vertical axis.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Contact pressure of the bush as it wears")
    for label, (angle, pressure) in curves.items():
        (line,) = axes.plot(angle, pressure / modulus, label=label, linewidth=1.5)
        if assumed is not None and label in assumed:
            x, y = assumed[label]
            axes.plot(x, y / modulus, "--", color=line.get_color(), linewidth=1.0)
    axes.set(xlabel="angle from the load line [rad]", ylabel="pressure / shear modulus")
    axes.legend(fontsize=8)
    return axes
