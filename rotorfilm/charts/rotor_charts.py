"""Charts of flexible rotors: Campbell diagram, map of critical speeds, unbalance response."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import control
import numpy as np
from matplotlib.axes import Axes

from ..analysis import (
    BasinScan,
    Bifurcation,
    Campbell,
    CriticalSpeed,
    OrbitCurve,
    PeriodicOrbit,
    RotorModes,
    SeparationMargins,
    ShaftStatics,
    StabilityLevelOne,
)
from ..analysis.api617 import BORDER_DENSITY, BORDER_RATIO, LEAST_DECREMENT
from ..core.errors import InputError
from ..core.model import Array
from ..core.results import Trajectory
from ..rotors import ShaftRotor
from ..studies.journal_accuracy import FilmFamily
from .canvas import (
    BAD,
    DASHES,
    FAMILY_COLORS,
    FAMILY_WIDTHS,
    GOOD,
    WITHIN,
    draw_circle,
    labeled,
    legend_beside,
    new_axes,
    new_figure,
    with_grids,
)

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
    axes.set_ylim(bottom=0.0)
    return labeled(axes, "speed [rpm]", "damped frequency [Hz]", xlim=(speeds[0], speeds[-1]))


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
    return labeled(axes, "speed [rpm]", "logarithmic decrement")


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
    return labeled(axes, "bearing stiffness [N/m]", "critical speed [rpm]")


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
    n = len(rotor.assembly.coordinates)
    x, y = (_deflection(rotor, modes.shapes[k : k + n, number]) for k in (0, n))
    size = np.sqrt(np.abs(x) ** 2 + np.abs(y) ** 2).max()
    turn = _turn(x, y) / size
    axes = axes or new_axes("Mode shape")
    along = rotor.positions
    axes.plot(along, (x * turn).real, "o-", markersize=3, color=FORWARD, label="x")
    axes.plot(along, (y * turn).real, "s--", markersize=3, color=BACKWARD, label="y")
    axes.plot(along[[s.node for s in rotor.stations]], np.zeros(len(rotor.stations)), "k^", label="bearing")
    axes.axhline(0.0, color="k", linewidth=0.8)
    frequency, decrement = modes.frequency[number] / HERTZ, modes.log_decrement[number]
    title = f"{frequency:.4g} Hz at {modes.speed / RPM:.0f} rpm, decrement {decrement:.3g}, "
    title += f"direction {modes.direction[number]:+.2f}"
    return labeled(axes, "along the shaft [m]", "deflection / the largest", title=title)


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


# Charts that rotors are certified with, as API 617 wants them.


MEGANEWTON = 1e6


def plot_stability_level_one(
    result: StabilityLevelOne, *, axes: Sequence[Axes] | None = None
) -> tuple[Axes, Axes]:
    """Draw the log decrement over the applied cross-coupling [MN/m], and where the machine is screened.

    Parameters
    ----------
    result : StabilityLevelOne
    axes : two Axes, optional
        For curves and screening; a new figure by default.

    Returns
    -------
    (Axes, Axes)
    """
    if axes is None:
        axes = new_figure(size=(9.6, 4.4)).subplots(1, 2)
    beside, screening = axes
    for curve in result.curves:
        applied = curve.cross_coupling / MEGANEWTON
        beside.plot(applied, curve.log_decrement, "o-", markersize=3, label=curve.name)
    expected = result.anticipated_cross_coupling / MEGANEWTON
    beside.axvline(expected, color="k", linestyle=":", label="QA")
    beside.plot([expected], [result.anticipated_decrement], "ks", fillstyle="none", label="delta_A")
    if math.isfinite(result.zero_cross_coupling):
        beside.plot([result.zero_cross_coupling / MEGANEWTON], [0.0], "k^", fillstyle="none", label="Q0")
    beside.axhline(LEAST_DECREMENT, color="k", linestyle="--", linewidth=0.8, label=f"{LEAST_DECREMENT:g}")
    beside.axhline(0.0, color="k", linewidth=0.8)
    needed = "required" if result.level_two_required else "not required"
    beside.set(xlabel="applied cross-coupling [MN/m]", ylabel="log decrement", title=f"Level II is {needed}")
    _screening(result, screening)
    with_grids(beside, screening)
    return beside, screening


def _screening(result: StabilityLevelOne, axes: Axes) -> None:
    """Draw critical speed ratio over density, with the border between regions A and B."""
    density = 0.0 if result.average_density is None else result.average_density
    least, most = BORDER_DENSITY
    right = max(1.2 * most, 1.2 * density)
    border = np.array([0.0, least, most, most]), np.array([*BORDER_RATIO[:1], *BORDER_RATIO, 0.0])
    axes.plot(*border, "k-", linewidth=1.0, label="border of regions A and B")
    low = result.critical_speed_ratio < 1.0 and density < least
    axes.text(0.4 * least, 1.5 if low else 0.5, "A")
    axes.text(1.05 * most, 0.5, "B")
    if result.average_density is not None:
        axes.plot([density], [result.critical_speed_ratio], "ks", label="this machine")
    top = max(3.5, 1.2 * result.critical_speed_ratio)
    axes.set(
        xlabel="average gas density [kg/m3]",
        ylabel="critical speed ratio",
        xlim=(0.0, right),
        ylim=(0.0, top),
        title=f"Q0/QA = {result.margin:.3g}",
    )


def plot_separation_margins(result: SeparationMargins, *, axes: Axes | None = None) -> Axes:
    """Draw the amplitudes [um] over speed [rpm], peaks with their AF, red where it is too near.

    Parameters
    ----------
    result : SeparationMargins
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Separation margins")
    for name, amplitude in result.amplitudes.items():
        axes.semilogy(result.speeds / RPM, 1e6 * amplitude, label=name)
    axes.axvspan(
        result.minimum_speed / RPM, result.maximum_speed / RPM, color="0.85", label="operating range"
    )
    for peak in result.peaks:
        mark = "kv" if peak.acceptable else "rv"
        axes.plot([peak.speed / RPM], [1e6 * peak.peak_amplitude], mark, fillstyle="none")
        axes.annotate(f"AF {peak.amplification_factor:.3g}", (peak.speed / RPM, 1e6 * peak.peak_amplitude))
    title = "Separation margins are kept" if result.acceptable else "Separation margins are not kept"
    return labeled(axes, "speed [rpm]", "amplitude [um]", title=title)


def plot_shaft_statics(
    result: ShaftStatics, *, axes: Sequence[Axes] | None = None
) -> tuple[Axes, Axes, Axes]:
    """Draw sag [um], shear force [N] and bending moment [N m] along a shaft [m], in both planes.

    Parameters
    ----------
    result : ShaftStatics
    axes : three Axes, optional
        A new figure by default.

    Returns
    -------
    (Axes, Axes, Axes)
    """
    if axes is None:
        axes = new_figure(size=(7.4, 7.4)).subplots(3, 1, sharex=True)
    above, middle, below = axes
    for k, name in enumerate("xy"):
        above.plot(result.positions, 1e6 * result.sag[k], "o-", markersize=3, label=name)
        middle.plot(result.places, result.shear_force[k], label=name)
        below.plot(result.places, result.bending_moment[k], label=name)
    above.set(ylabel="sag [um]", title="Under its weight")
    middle.set(ylabel="shear force [N]")
    below.set(ylabel="bending moment [N m]", xlabel="along the shaft [m]")
    with_grids(above, middle, below)
    return above, middle, below


def plot_polar_response(
    response: control.FrequencyResponseData, outputs: Sequence[str], *, axes: Axes | None = None
) -> Axes:
    """Draw phasors [um] of a response over speed in the complex plane, with some speeds [rpm] beside them.

    Parameters
    ----------
    response : control.FrequencyResponseData
        As `unbalance_response` or `tracked_response` returns it.
    outputs : sequence of str
        Names of displacements.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Polar plot")
    speeds = np.asarray(response.frequency) / RPM
    for name in outputs:
        phasor = 1e6 * np.asarray(response.frdata)[list(response.output_labels).index(name), 0]
        axes.plot(phasor.real, phasor.imag, label=name)
        size = np.abs(phasor)
        for k in {0, int(np.argmax(size)), len(speeds) - 1}:
            axes.annotate(f"{speeds[k]:.0f} rpm", (phasor[k].real, phasor[k].imag), fontsize=8)
    return labeled(axes, "real [um]", "imaginary [um]", aspect="equal", adjustable="datalim")


# Charts of whirl: curves of periodic orbits with their stability, and basins.


MARKS = {
    Bifurcation.FOLD: "o",
    Bifurcation.PERIOD_DOUBLING: "D",
    Bifurcation.NEIMARK_SACKER: "s",
    Bifurcation.BRANCH: "^",
}
"""Marker of each bifurcation."""


def plot_orbit_curves(
    curves: Mapping[str, OrbitCurve], *, scale: float = 1.0, axes: Axes | None = None
) -> Axes:
    """Draw the amplitude of periodic orbits over their parameter; unstable ones dashed, bifurcations marked.

    Parameters
    ----------
    curves : mapping of str to OrbitCurve
        By label.
    scale : float
        Unit of the parameter.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Periodic orbits")
    marked = set()
    for k, (label, curve) in enumerate(curves.items()):
        color, x, stable = f"C{k}", curve.parameters / scale, curve.stable
        amplitude = curve.amplitudes
        # A segment is drawn as its ends are; where they differ, as the unstable one.
        solid = np.append(stable[:-1] & stable[1:], False)
        for shown, style in ((solid, "-"), (~solid, "--")):
            pieces = np.where(shown[:-1, None], np.stack([amplitude[:-1], amplitude[1:]], 1), np.nan)
            places = np.stack([x[:-1], x[1:]], 1)
            ends = np.full((len(pieces), 1), np.nan)
            line = np.hstack([places, ends]).ravel(), np.hstack([pieces, ends]).ravel()
            axes.plot(*line, style, color=color, label=label if style == "-" else None)
        for event in curve.events:
            name = None if event.kind in marked else event.kind.value
            marked.add(event.kind)
            place = event.parameter / scale, event.orbit.amplitude
            axes.plot(*place, MARKS[event.kind], color="k", markersize=5, label=name)
    axes.set(ylabel="largest distance of the journal from its mean / clearance")
    axes.legend(fontsize=8)
    return axes


def plot_periodic_orbit(orbit: PeriodicOrbit, *, axes: Axes | None = None) -> Axes:
    """Draw a periodic orbit of each journal inside its clearance circle.

    Parameters
    ----------
    orbit : PeriodicOrbit
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Periodic orbit", size=(5.6, 5.2))
    paths = orbit.position(np.linspace(0.0, orbit.period, 361)) / orbit.lengths[:, None, None]
    for station, (x, y) in zip(orbit.stations, paths, strict=True):
        axes.plot(x, y, label=station or "journal")
    draw_circle(axes)
    return labeled(axes, "x / clearance", "y / clearance", aspect="equal")


def plot_basin(scan: BasinScan, *, clearance: float, axes: Axes | None = None) -> Axes:
    """Draw where a rotor goes from initial positions: to rest, or into whirl.

    Parameters
    ----------
    scan : BasinScan
        Over a list or a grid of offsets of one bearing.
    clearance : float [m]
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Where the rotor goes from rest at a position", size=(6.0, 5.6))
    x, y = (scan.offsets.reshape(2, -1) + scan.rest[:2, None]) / clearance
    whirls = scan.whirls.ravel()
    inside = np.hypot(x, y) < 1.0
    for chosen, color, label in ((whirls, BAD, "into whirl"), (~whirls, GOOD, "to rest")):
        here = chosen & inside
        axes.plot(x[here], y[here], "s", color=color, markersize=4.5, label=label)
    draw_circle(axes)
    axes.plot(*(scan.rest[:2] / clearance), "k+", label="rest")
    axes.set(xlabel="x / clearance (load)", ylabel="y / clearance", aspect="equal")
    axes.legend(fontsize=8, loc="upper right")
    return axes


# Charts of the journal's motion: orbits and the locus of static equilibria.


def plot_orbits(
    orbits: Mapping[str, Trajectory],
    *,
    clearance: float,
    center: Iterable[float] | None = None,
    axes: Axes | None = None,
) -> Axes:
    """Draw journal orbits.

    Parameters
    ----------
    orbits : mapping of str to Trajectory
        Label and motion; later ones are drawn dashed over earlier ones.
    clearance : float [m]
        Scale of both axes.
    center : iterable of 2 floats, optional [m]
        Static equilibrium, marked by a cross.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Orbit of the journal center", size=(5.6, 5.2))
    for number, (label, orbit) in enumerate(orbits.items()):
        x, y = orbit.position / clearance
        axes.plot(x, y, ("-", "--", ":")[min(number, 2)], label=label, linewidth=1.6)
    if center is not None:
        x0, y0 = center
        axes.plot(x0 / clearance, y0 / clearance, "k+", markersize=10, label="static equilibrium", zorder=3)
    axes.set(xlabel="x / clearance", ylabel="y / clearance", aspect="equal")
    legend_beside(axes)
    return axes


def plot_locus(
    curves: Mapping[str, tuple[np.ndarray, np.ndarray]],
    *,
    families: Mapping[str, FilmFamily] | None = None,
    axes: Axes | None = None,
) -> Axes:
    """Draw the loci of the journal center under a load along -y, rotation counter-clockwise.

    Parameters
    ----------
    curves : mapping of str to (ndarray, ndarray)
        Label, eccentricity ratio [1] and attitude angle [rad], each of shape (n,).
    families : mapping of str to FilmFamily, optional
        Family of films by label, for its color and line.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Locus of the journal center, load along -y", size=(7.6, 5.2))
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 181)
    axes.plot(np.cos(turn), np.sin(turn), "k-", linewidth=1.0, label="clearance circle")
    drawn: Counter[FilmFamily | None] = Counter()
    for label, (eccentricity_ratio, attitude_angle) in curves.items():
        x = eccentricity_ratio * np.sin(attitude_angle)
        y = -eccentricity_ratio * np.cos(attitude_angle)
        family = None if families is None else families.get(label)
        color, width, style = None, 1.4, WITHIN[drawn[family] % len(WITHIN)]
        if family is not None:
            color, width = FAMILY_COLORS[family], FAMILY_WIDTHS[family]
        drawn[family] += 1
        line: dict[str, Any] = {"color": color, "linewidth": width, "linestyle": DASHES.get(family, style)}
        axes.plot(x, y, label=label, zorder=2.0 + 0.5 / width, **line)
    axes.set(
        xlabel="x / clearance", ylabel="y / clearance", aspect="equal", xlim=(-0.05, 1.05), ylim=(-1.05, 0.1)
    )
    # Beside the picture: inside, it would lie on the clearance circle.
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.02, 0.5), handlelength=5.0)
    return axes
