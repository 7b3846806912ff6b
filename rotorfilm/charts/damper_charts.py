"""Charts of an unbalanced rotor on a damper: response to the unbalance, transient, bistable region."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..bearings.damper import DamperTurn
from ..motion import BistableMap, OrbitBranch, SynchronousOrbits
from .canvas import new_axes


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
    axes.set(xlabel="speed * time, rad", ylabel="force on housing / unbalance force")
    axes.legend(fontsize=7)
    return axes


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
    figure = axes.get_figure()
    assert isinstance(figure, Figure)
    figure.colorbar(shown, ax=axes, label="share of the gap that is oil")
    nearest = np.degrees(np.arctan2(turn.position[1], turn.position[0]) % (2.0 * np.pi))
    jump = np.abs(np.diff(nearest, append=nearest[0])) > 180.0
    axes.plot(np.where(jump, np.nan, nearest), turned, "C1", linewidth=1.3, label="least gap")
    axes.set(xlabel="angle from +x towards +y [deg]", ylabel="turns", xlim=(0.0, 360.0))
    axes.legend(fontsize=8)
    return axes


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
    axes.set(xlabel="squeeze number", ylabel="unbalance / (mass * clearance)")
    axes.legend(fontsize=8)
    return axes


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
    axes.set(xlabel="unbalance / (mass * clearance)", ylabel=ylabel)
    axes.legend(fontsize=7)
    return axes
