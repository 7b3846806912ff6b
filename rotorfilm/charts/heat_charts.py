"""Pictures of a film that warms: temperature and pressure over it, and the temperature across it."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..bearings.journal import HeatedState
from ..errors import InputError
from ..model import Array
from ..units import CELSIUS
from .canvas import new_axes, new_figure

WARM, PRESSED = "inferno", "viridis"
"""Colors of temperature and pressure."""


def plot_temperature_field(state: HeatedState, *, axes: Axes | None = None) -> Axes:
    """Draw the temperature of a film, its mean across the gap, over angle and length.

    A white line is the edge of the film that fills the gap.

    Parameters
    ----------
    state : HeatedState
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    T = state.oil_temperature if state.oil_temperature.ndim == 2 else state.oil_temperature.mean(axis=-1)
    axes = axes or new_axes("Temperature of the film, mean across it", size=(8.0, 4.0))
    return _field(axes, state, T - CELSIUS, "temperature [degC]", WARM)


def plot_pressure_field(state: HeatedState, *, axes: Axes | None = None) -> Axes:
    """Draw the pressure of a film over angle and length.

    A white line is the edge of the film that fills the gap.

    Parameters
    ----------
    state : HeatedState
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Pressure of the film", size=(8.0, 4.0))
    return _field(axes, state, 1e-6 * state.pressure, "pressure [MPa]", PRESSED)


def plot_temperature_across(state: HeatedState, *, axes: Axes | None = None) -> Axes:
    """Draw the temperature across a film in the middle of the bearing, over angle and distance from the bush.

    Parameters
    ----------
    state : HeatedState
        Of a film with layers.
    axes : Axes, optional
        Where to draw; a new figure by default.

    Raises
    ------
    InputError
        If the state has one temperature across its film.
    """
    if state.oil_temperature.ndim != 3:
        raise InputError("state must be that of a film with layers, as of LayeredTemperature(), got a mean")
    axes = axes or new_axes("Temperature across the film, in the middle of the bearing", size=(8.0, 4.0))
    angle, order = _around(state)
    T = state.oil_temperature[order, 0] - CELSIUS
    # The film's frame: the gap is the clearance less the journal's displacement towards the angle.
    x, y = state.position
    gap = 1e6 * (state.film.clearance - x * np.cos(angle) - y * np.sin(angle))
    edges = np.linspace(0.0, 1.0, T.shape[1] + 1)
    bounds = _bounds(angle)
    at_bounds = np.interp(bounds, angle, gap, period=2.0 * np.pi)
    mesh = axes.pcolormesh(
        np.degrees(bounds)[:, None] + np.zeros(edges.size), at_bounds[:, None] * edges, T, cmap=WARM
    )
    _color_bar(axes, mesh, "temperature [degC]")
    axes.set(xlim=(0.0, 360.0), xlabel="angle [deg]", ylabel="distance from the bush [um]")
    axes.set_xticks(range(0, 361, 60))
    axes.grid(visible=False)
    return axes


def plot_heated_film(state: HeatedState, *, title: str = "") -> list[Axes]:
    """Draw a film that warms: temperature and pressure over it and, with layers, the temperature across it.

    Parameters
    ----------
    state : HeatedState
    title : str

    Returns
    -------
    list of Axes
        Of one figure.
    """
    across = state.oil_temperature.ndim == 3
    figure = new_figure(size=(9.0, 9.6 if across else 6.6))
    shown = [figure.add_subplot(2 + across, 1, k + 1) for k in range(2 + across)]
    plot_temperature_field(state, axes=shown[0]).set_title(
        "Temperature, mean across; white: edge of the full film"
    )
    plot_pressure_field(state, axes=shown[1]).set_title("Pressure")
    if across:
        plot_temperature_across(state, axes=shown[2]).set_title("Temperature in the middle of the bearing")
    figure.suptitle(title, fontsize=11)
    return shown


def _field(axes: Axes, state: HeatedState, values: Array, label: str, colors: str) -> Axes:
    """Draw a field on its nodes, both halves of the bearing, and in white the edges of the full film."""
    angle, order = _around(state)
    # A node in the middle of the bearing is no part of the mirror image.
    mirrored = slice(None, 0 if state.axial[0] == 0.0 else None, -1)
    z = 1e3 * np.concatenate([-state.axial[mirrored], state.axial])
    sides = np.concatenate([z[:1], 0.5 * (z[1:] + z[:-1]), z[-1:]])

    def whole(half: Array) -> Array:
        return np.concatenate([half[order, mirrored], half[order]], axis=1).T

    mesh = axes.pcolormesh(np.degrees(_bounds(angle)), sides, whole(values), cmap=colors)
    _color_bar(axes, mesh, label)
    axes.contour(np.degrees(angle), z, whole(state.filled), levels=[0.999], colors="white", linewidths=0.9)
    axes.set(xlim=(0.0, 360.0), ylim=(z[0], z[-1]), xlabel="angle [deg]", ylabel="axial position [mm]")
    axes.set_xticks(range(0, 361, 60))
    axes.grid(visible=False)
    return axes


def _color_bar(axes: Axes, mesh: Any, label: str) -> None:
    figure = axes.get_figure()
    assert isinstance(figure, Figure)
    figure.colorbar(mesh, ax=axes, label=label)


def _around(state: HeatedState) -> tuple[Array, NDArray[np.intp]]:
    """Return the angles of the lines [rad], rising, and their order."""
    order = np.argsort(state.angle)
    return state.angle[order], order


def _bounds(angle: Array) -> Array:
    """Return the angles between lines, and those of both ends of the turn."""
    return np.concatenate([[0.0], 0.5 * (angle[1:] + angle[:-1]), [2.0 * np.pi]])
