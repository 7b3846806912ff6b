"""Charts of a melting bush: critical speed over the contact angle, pressure and wear over the contact."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from ..analysis import BistableMap, OrbitBranch, SynchronousOrbits
from ..bearings.damper import DamperTurn
from ..bearings.journal import HeatedState
from ..core.errors import InputError
from ..core.model import Array
from ..core.units import CELSIUS
from .canvas import add_color_bar, labeled, new_axes, new_grid

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
    return labeled(axes, "half contact angle [rad]", "critical speed / that of the unworn bush")


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
    return labeled(axes, "angle from the load line [rad]", "pressure / shear modulus")


# Charts of an unbalanced rotor on a damper: response to the unbalance, transient, bistable region.


def plot_transmissibility(
    orbits: Mapping[str, SynchronousOrbits], *, unit: float, axes: Axes | None = None
) -> Axes:
    """Draw the transmissibility of all orbits over the unbalance; unstable ones are dotted.

    Parameters
    ----------
    orbits : mapping of str to SynchronousOrbits
        Label and orbits over many unbalances.
    unit : float [kg m]
        Mass times clearance, the scale of the unbalance.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Transmissibility")
    axes.axhline(1.0, color="0.6", linewidth=0.8)
    return _response(
        axes, orbits, unit, lambda branch: branch.transmissibility, "force on housing / unbalance force"
    )


def plot_eccentricity(
    orbits: Mapping[str, SynchronousOrbits], *, unit: float, axes: Axes | None = None
) -> Axes:
    """Draw the eccentricity ratio of all orbits over the unbalance, a cross where they touch the wall.

    Parameters are those of `plot_transmissibility`.
    """
    axes = axes or new_axes("Orbit radius")
    _response(axes, orbits, unit, lambda branch: branch.eccentricity_ratio, "eccentricity ratio")
    last = axes.get_xlim()[1]
    for number, found in enumerate(orbits.values()):
        if found.contact_unbalance is not None and found.contact_unbalance / unit <= last:
            axes.plot(found.contact_unbalance / unit, 1.0, "x", color=f"C{number}", clip_on=False)
    axes.set_ylim(0.0, 1.0)
    return axes


def plot_phase(orbits: Mapping[str, SynchronousOrbits], *, unit: float, axes: Axes | None = None) -> Axes:
    """Draw the lag of all orbits over the unbalance; parameters as in `plot_transmissibility`."""
    axes = axes or new_axes("Lag of the displacement behind the unbalance")
    return _response(axes, orbits, unit, lambda branch: -np.degrees(branch.phase), "phase lag, deg")


def plot_transmitted(runs: Mapping[str, tuple[np.ndarray, np.ndarray]], *, axes: Axes | None = None) -> Axes:
    """Draw the transmitted force over time.

    Parameters
    ----------
    runs : mapping of str to (ndarray, ndarray)
        Label, angle turned by the shaft [rad] and force on the housing / unbalance force [1], each (n,).
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Transmitted force over time")
    for label, (angle, ratio) in runs.items():
        axes.plot(angle, ratio, label=label, linewidth=1.3)
    return labeled(axes, "speed * time, rad", "force on housing / unbalance force", legend=7)


def plot_damper_run(
    time: np.ndarray, eccentricity_ratio: np.ndarray, force: np.ndarray, *, axes: Axes | None = None
) -> Axes:
    """Draw the motion of a rotor on a damper over time: eccentricity ratio, and force on a second axis.

    Parameters
    ----------
    time : ndarray, shape (n,) [s]
    eccentricity_ratio : ndarray, shape (n,) [1]
    force : ndarray, shape (n,) [N]
        On the housing.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Rotor on a damper")
    axes.plot(time, eccentricity_ratio, "C0", linewidth=1.3, label="eccentricity ratio")
    axes.axhline(1.0, color="0.6", linewidth=0.8)
    axes.set(xlabel="time, s", ylabel="eccentricity ratio", ylim=(0.0, 1.05))
    beside = axes.twinx()
    beside.plot(time, force, "C1", linewidth=0.9, label="force on housing")
    beside.set(ylabel="force on housing, N")
    lines = [*axes.lines[:1], *beside.lines]
    axes.legend(lines, [str(line.get_label()) for line in lines], fontsize=8)
    return axes


def plot_damper_turn(turn: DamperTurn, *, axes: Axes | None = None) -> Axes:
    """Draw where a damper that conserves its oil is empty, around it and over a turn, half-way along it.

    A line is where the rotor is nearest to the wall.

    Parameters
    ----------
    turn : DamperTurn
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Oil over a turn")
    order = np.argsort(turn.angle)
    place, turned = np.degrees(turn.angle[order]), turn.time / turn.time[-1]
    middle = turn.oil_content[:, order, turn.axial.size // 2]
    shown = axes.pcolormesh(place, turned, middle, shading="nearest", vmin=0.0, vmax=1.0, cmap="YlGnBu")
    add_color_bar(axes, shown, "share of the gap that is oil")
    nearest = np.degrees(np.arctan2(turn.position[1], turn.position[0]) % (2.0 * np.pi))
    jump = np.abs(np.diff(nearest, append=nearest[0])) > 180.0
    axes.plot(np.where(jump, np.nan, nearest), turned, "C1", linewidth=1.3, label="least gap")
    return labeled(axes, "angle from +x towards +y [deg]", "turns", xlim=(0.0, 360.0))


def plot_bistable(found: BistableMap, *, axes: Axes | None = None) -> Axes:
    """Draw the bistable region, between the unbalances of the jump up and of the fall back.

    Parameters
    ----------
    found : BistableMap
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Two stable orbits")
    for column, spring in enumerate(found.spring_ratio):
        jump_up, jump_down = found.jump_up[:, column], found.jump_down[:, column]
        (line,) = axes.plot(found.squeeze_number, jump_up, label=f"spring ratio {spring:g}")
        axes.plot(found.squeeze_number, jump_down, "--", color=line.get_color())
        axes.fill_between(found.squeeze_number, jump_down, jump_up, color=line.get_color(), alpha=0.15)
    return labeled(axes, "squeeze number", "unbalance / (mass * clearance)")


def _response(
    axes: Axes,
    orbits: Mapping[str, SynchronousOrbits],
    unit: float,
    value: Callable[[OrbitBranch], np.ndarray],
    ylabel: str,
) -> Axes:
    """Draw stable branches as lines and unstable ones dotted."""
    for number, (label, found) in enumerate(orbits.items()):
        color, shown = f"C{number}", label
        for branch in found.branches:
            for kept, style in ((branch.stable, "-"), (~branch.stable, ":")):
                if np.any(kept):
                    y = np.where(kept, value(branch), np.nan)
                    axes.plot(branch.unbalance / unit, y, style, color=color, label=shown, linewidth=1.3)
                    shown = "_" + label
    return labeled(axes, "unbalance / (mass * clearance)", ylabel, legend=7)


# Pictures of a film that warms: temperature and pressure over it, and the temperature across it.


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
    add_color_bar(axes, mesh, "temperature [degC]")
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
    shown = new_grid(2 + across, columns=1, size=(9.0, 3.2), title=title)
    plot_temperature_field(state, axes=shown[0]).set_title(
        "Temperature, mean across; white: edge of the full film"
    )
    plot_pressure_field(state, axes=shown[1]).set_title("Pressure")
    if across:
        plot_temperature_across(state, axes=shown[2]).set_title("Temperature in the middle of the bearing")
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
    add_color_bar(axes, mesh, label)
    axes.contour(np.degrees(angle), z, whole(state.filled), levels=[0.999], colors="white", linewidths=0.9)
    axes.set(xlim=(0.0, 360.0), ylim=(z[0], z[-1]), xlabel="angle [deg]", ylabel="axial position [mm]")
    axes.set_xticks(range(0, 361, 60))
    axes.grid(visible=False)
    return axes


def _around(state: HeatedState) -> tuple[Array, NDArray[np.intp]]:
    """Return the angles of the lines [rad], rising, and their order."""
    order = np.argsort(state.angle)
    return state.angle[order], order


def _bounds(angle: Array) -> Array:
    """Return the angles between lines, and those of both ends of the turn."""
    return np.concatenate([[0.0], 0.5 * (angle[1:] + angle[:-1]), [2.0 * np.pi]])
