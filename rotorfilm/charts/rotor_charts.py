"""Pictures of flexible rotors: modes over speed, responses, certification, orbits and basins."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import control
import numpy as np

from .. import analysis
from ..analysis.api617 import BORDER_DENSITY, BORDER_RATIO, LEAST_DECREMENT
from ..analysis.clearance_check import SHARE
from ..analysis.rotor_modes import senses
from ..core.model import Array
from ..core.results import Trajectory
from ..studies.journal_accuracy import FilmFamily
from .canvas import BAD, DASHES, FAMILY_COLORS, FAMILY_WIDTHS, GOOD, WITHIN
from .picture import BarsMark, ColorScale, CurveMark, LevelMark, Mark, NoteMark, Picture, PicturePanel, circle

RPM = math.pi / 30.0
HERTZ = 2.0 * math.pi

UNSTABLE = "#ffb000"
"""Color of whirl that grows, behind its marks."""

SENSES = {"forward": "^", "backward": "v", "mixed": "o"}
"""Marks of whirl with the rotation, against it, and neither."""

DAMPING = ColorScale("log decrement", "RdYlGn", -0.2, 0.2)
"""Of a Campbell diagram: red is unstable, green well damped."""

FAR = 10.0
"""Highest frequency over that of the highest speed, beyond which a Campbell diagram shows only a part."""

DECREMENTS = (-1.0, 3.0)
"""Log decrements that decide: beyond, a mode is unstable or overdamped in any case."""

DECISIVE = 0.3
"""Log decrement below which a mode is one to look at."""


def _points(x: Any, y: Any, label: str, marker: str, color: str = "k", size: float = 5.0) -> CurveMark:
    """Return open marks at one or more places."""
    places = np.atleast_1d(x), np.atleast_1d(y)
    return CurveMark(*places, label, color, "", marker=marker, filled=False, size=size)


def plot_campbell(
    chart: analysis.Campbell, *, critical: Sequence[analysis.CriticalSpeed] | None = None
) -> Picture:
    """Describe whirl frequency [Hz] over speed [rpm], with damping as color and the line of the speed.

    A wide ring is whirl that grows by more than round-off. Where modes reach beyond ten times the speed, only
    those up to twice the speed are shown.

    Parameters
    ----------
    chart : Campbell
    critical : sequence of CriticalSpeed, optional
        Marked, with their speeds and whirls; those interpolated in the chart by default.
    """
    speeds, hertz, sense = chart.speeds / RPM, chart.frequency / HERTZ, senses(chart.direction)
    places = np.broadcast_to(speeds, hertz.shape)
    marks: list[Mark] = [CurveMark(speeds, one, color="0.6", width=0.8) for one in hertz]
    if chart.grows.any():
        at = chart.grows
        marks.append(
            CurveMark(places[at], hertz[at], "grows", UNSTABLE, "", marker="o", filled=False, size=9.0)
        )
    for name, marker in SENSES.items():
        at = sense == name
        if at.any():
            values = chart.log_decrement[at]
            one = CurveMark(places[at], hertz[at], name, "k", "", marker=marker, values=values, scale=DAMPING)
            marks.append(one)
    marks.append(CurveMark(speeds, np.abs(chart.speeds) / HERTZ, "1x speed", "k", width=0.8))
    found = chart.crossings if critical is None else critical
    if found:
        at = np.array([one.speed for one in found])
        marks.append(_points(at / RPM, np.abs(at) / HERTZ, "critical speed", "s", size=8.0))
        for w, whirl in zip(at, (one.whirl for one in found), strict=True):
            whirl = "" if whirl == "forward" else f", {whirl}"
            marks.append(NoteMark(w / RPM, abs(w) / HERTZ, f"{w / RPM:.0f} rpm{whirl}", clear=True))
    limits, top = (float(speeds.min()), float(speeds.max())), float(np.abs(chart.speeds).max()) / HERTZ
    panel = PicturePanel(
        marks,
        "speed [rpm]",
        "damped frequency [Hz]",
        "Campbell diagram",
        x_limits=limits,
        y_limits=(0.0, 2.0 * top if np.nanmax(hertz) > FAR * top > 0.0 else None),
        legend="inside",
    )
    return Picture((panel,), size=(7.4, 5.2))


def plot_log_decrement(chart: analysis.Campbell) -> Picture:
    """Describe the log decrement of each mode over speed [rpm]; below zero the whirl grows.

    The axis is that of the modes whose log decrement gets below 0.3, and reaches at most from -1 to 3. Modes
    that are beyond at all speeds are named in the title. A dashed line is at 0.1, which API 617 asks for.
    """
    low, high = _decisive(chart.log_decrement)
    least = LevelMark(LEAST_DECREMENT, f"{LEAST_DECREMENT:g}, the least by API 617", dash="--")
    marks: list[Mark] = [LevelMark(0.0), least]
    beyond = []
    for k, (decrement, frequency) in enumerate(zip(chart.log_decrement, chart.frequency, strict=True)):
        if np.nanmin(decrement) > high:
            beyond.append(str(k + 1))
            continue
        first = frequency[np.isfinite(frequency)][0] / HERTZ
        label, dash = f"mode {k + 1}, from {first:.3g} Hz", WITHIN[k // 10 % len(WITHIN)]
        marks.append(CurveMark(chart.speeds / RPM, decrement, label, f"C{k % 10}", dash))
    modes = f"; above {high:.2g} at all speeds: mode {', '.join(beyond)}" if beyond else ""
    text = "speed [rpm]", "log decrement", f"Stability{modes}"
    return Picture((PicturePanel(marks, *text, y_limits=(low, high), legend="beside"),), size=(7.4, 4.8))


def _decisive(decrements: Array) -> tuple[float, float]:
    """Return the ends of an axis for the log decrements (modes, speeds) of modes that may become unstable."""
    least, most = DECREMENTS
    few = [own for own in decrements if np.nanmin(own) < DECISIVE]
    if not few:
        return least, most
    high = min(max(1.2 * max(float(np.nanmedian(own)) for own in few), DECISIVE), most)
    return max(min(1.2 * min(float(np.nanmin(own)) for own in few), -0.2 * high), least), high


def plot_critical_speed_map(stiffness: Array, speeds: Array, *, bearing: Array | None = None) -> Picture:
    """Describe undamped critical speeds [rpm] over bearing stiffness [N/m], both logarithmic.

    Parameters
    ----------
    stiffness : ndarray, shape (n,) [N/m]
    speeds : ndarray, shape (count, n) [rad/s]
        Speeds as `critical_speed_map` returns them.
    bearing : ndarray, shape (2, m), optional
        Speed [rad/s] and stiffness [N/m] of the bearing that the rotor will have.
    """
    marks = [
        CurveMark(stiffness, curve / RPM, f"critical speed {k + 1}", f"C{k}")
        for k, curve in enumerate(speeds)
    ]
    if bearing is not None:
        marks.append(CurveMark(bearing[1], bearing[0] / RPM, "bearing", "k", "--"))
    text = "bearing stiffness [N/m]", "critical speed [rpm]", "Undamped critical speeds"
    return Picture((PicturePanel(marks, *text, log="xy"),))


def plot_unbalance_response(
    response: control.FrequencyResponseData,
    outputs: Sequence[str] | None = None,
    *,
    peak_to_peak: bool = False,
    critical: Sequence[analysis.CriticalSpeed] = (),
    threshold: float | None = None,
) -> Picture:
    """Describe amplitude [um] and phase [deg] of displacements over speed [rpm], a Bode plot.

    Each place has a color of its own, with a full line along x and a dashed one along y.

    Parameters
    ----------
    response : control.FrequencyResponseData
        Response as `unbalance_response` or `tracked_response` returns it.
    outputs : sequence of str, optional
        Names of displacements; all of the response by default.
    peak_to_peak : bool
        Twice the amplitude, as API 617 has it, in place of zero-to-peak; the label says which.
    critical : sequence of CriticalSpeed
        Critical speeds to be marked by lines; those outside the speeds of the response are left out.
    threshold : float, optional
        Threshold of stability [rad/s], to be marked likewise: above it whirl that grows hides the response.
    """
    speeds = np.asarray(response.frequency) / RPM
    sizes: list[Mark] = []
    phases: list[Mark] = []
    for style, phasor in _phasors(response, outputs):
        sizes.append(CurveMark(speeds, (2.0 if peak_to_peak else 1.0) * np.abs(phasor), *style))
        phases.append(CurveMark(speeds, np.degrees(np.unwrap(np.angle(phasor))), *style))
    lines = [(one.speed, "critical speed", "0.4", ":") for one in critical]
    if threshold is not None:
        lines.append((threshold, "threshold of stability", "C3", "--"))
    told = set[str]()
    for speed, label, color, dash in lines:
        place = speed / RPM
        if speeds.min() <= place <= speeds.max():
            for marks in (sizes, phases):
                marks.append(LevelMark(place, "" if label in told else label, color, dash, upright=True))
            told.add(label)
    way = "peak-to-peak" if peak_to_peak else "zero-to-peak"
    above = PicturePanel(sizes, "", f"amplitude, {way} [um]", "Unbalance response", log="y", legend="beside")
    below = PicturePanel(phases, "speed [rpm]", "phase [deg]", legend="none")
    return Picture((above, below), size=(7.4, 3.0))


def _phasors(
    response: control.FrequencyResponseData, outputs: Sequence[str] | None
) -> Iterator[tuple[tuple[str, str, str], np.ndarray]]:
    """Yield label, color and dash of displacements, a color for each place, and their phasors [um]."""
    labels, places = list(response.output_labels), list[str]()
    for name in displacements(labels) if outputs is None else outputs:
        place, _, axis = name.rpartition("_")
        if place not in places:
            places.append(place)
        label, color = f"{place}, {axis}" if place else name, f"C{places.index(place) % 10}"
        yield (
            (label, color, "--" if axis == "y" else "-"),
            1e6 * np.asarray(response.frdata)[labels.index(name), 0],
        )


def displacements(names: Iterable[str]) -> list[str]:
    """Return the names of displacements among those of the outputs of a rotor."""
    along = [name for name in names if name.rpartition("_")[2] in ("x", "y")]
    return [name for name in along if not name.endswith(("force_x", "force_y"))]


def plot_polar_response(
    response: control.FrequencyResponseData, outputs: Sequence[str] | None = None
) -> Picture:
    """Describe phasors [um] of a response over speed in the complex plane, some speeds [rpm] beside them.

    Parameters
    ----------
    response : control.FrequencyResponseData
        Response as `unbalance_response` or `tracked_response` returns it.
    outputs : sequence of str, optional
        Names of displacements; all of the response by default.
    """
    speeds, marks = np.asarray(response.frequency) / RPM, list[Mark]()
    for style, phasor in _phasors(response, outputs):
        marks.append(CurveMark(phasor.real, phasor.imag, *style))
        marks += [
            NoteMark(float(phasor[k].real), float(phasor[k].imag), f"{speeds[k]:.0f} rpm")
            for k in sorted({0, int(np.argmax(np.abs(phasor))), len(speeds) - 1})
        ]
    text = "real, zero-to-peak [um]", "imaginary, zero-to-peak [um]", "Polar plot"
    return Picture((PicturePanel(marks, *text, equal=True),), size=(6.0, 5.4))


# Pictures that rotors are certified with, as API 617 wants them.


MEGANEWTON = 1e6


def plot_stability_level_one(result: analysis.StabilityLevelOne) -> Picture:
    """Describe log decrement over the applied cross-coupling [MN/m], and where the machine is screened."""
    marks: list[Mark] = []
    for k, curve in enumerate(result.curves):
        applied = curve.cross_coupling / MEGANEWTON
        marks.append(CurveMark(applied, curve.log_decrement, curve.name, f"C{k}", marker="o", size=3.0))
    expected = result.anticipated_cross_coupling / MEGANEWTON
    marks.append(LevelMark(expected, "QA", dash=":", upright=True))
    marks.append(_points(expected, result.anticipated_decrement, "delta_A", "s"))
    if math.isfinite(result.zero_cross_coupling):
        marks.append(_points(result.zero_cross_coupling / MEGANEWTON, 0.0, "Q0", "^"))
    marks += [LevelMark(LEAST_DECREMENT, f"{LEAST_DECREMENT:g}", dash="--"), LevelMark(0.0)]
    needed = "required" if result.level_two_required else "not required"
    text = "applied cross-coupling [MN/m]", "log decrement", f"Level II is {needed}"
    return Picture((PicturePanel(marks, *text), _screening(result)), columns=2, size=(4.8, 4.4))


def _screening(result: analysis.StabilityLevelOne) -> PicturePanel:
    """Describe critical speed ratio over density, with the border between regions A and B."""
    density = 0.0 if result.average_density is None else result.average_density
    least, most = BORDER_DENSITY
    border = np.array([0.0, least, most, most]), np.array([*BORDER_RATIO[:1], *BORDER_RATIO, 0.0])
    low = result.critical_speed_ratio < 1.0 and density < least
    marks: list[Mark] = [
        CurveMark(*border, "border of regions A and B", "k", width=1.0),
        NoteMark(0.4 * least, 1.5 if low else 0.5, "A"),
        NoteMark(1.05 * most, 0.5, "B"),
    ]
    if result.average_density is not None:
        marks.append(_points(density, result.critical_speed_ratio, "this machine", "s"))
    return PicturePanel(
        marks,
        "average gas density [kg/m3]",
        "critical speed ratio",
        f"Q0/QA = {result.margin:.3g}",
        x_limits=(0.0, max(1.2 * most, 1.2 * density)),
        y_limits=(0.0, max(3.5, 1.2 * result.critical_speed_ratio)),
    )


def plot_separation_margins(result: analysis.SeparationMargins) -> Picture:
    """Describe amplitudes [um] over speed [rpm], peaks with AF and margin, red where they are too near."""
    marks: list[Mark] = [
        CurveMark(result.speeds / RPM, 1e6 * amplitude, name, f"C{k % 10}", WITHIN[k % len(WITHIN)])
        for k, (name, amplitude) in enumerate(result.amplitudes.items())
    ]
    ends = result.minimum_speed / RPM, result.maximum_speed / RPM
    marks.append(LevelMark(ends[0], "operating range", "0.6", upright=True, to=ends[1]))
    for peak in result.peaks:
        place, color = (peak.speed / RPM, 1e6 * peak.peak_amplitude), "k" if peak.acceptable else "r"
        marks.append(_points(*place, "", "v", color))
        margin = f", SM {peak.separation_margin:.0%} of {peak.required_margin:.0%}"
        near = peak.required_margin > 0.0
        marks.append(NoteMark(*place, f"AF {peak.amplification_factor:.3g}{margin if near else ''}", color))
    title = f"Separation margins are {'' if result.acceptable else 'not '}kept"
    panel = PicturePanel(
        marks, "speed [rpm]", "amplitude, zero-to-peak [um]", title, log="y", legend="beside"
    )
    return Picture((panel,), size=(7.8, 4.8))


def plot_clearance_check(result: analysis.ClearanceCheck) -> Picture:
    """Describe the scaled vibration of each place and 75 % of its diametral clearance [um]."""
    names = np.array(result.names, dtype=object)
    marks: list[Mark] = [
        BarsMark(names, 1e6 * result.clearance, "diametral clearance", "0.85"),
        BarsMark(names, 1e6 * SHARE * result.clearance, f"{SHARE:.0%} of it", "0.7", 0.6),
        BarsMark(names, 1e6 * result.vibration, "vibration", "C0" if result.acceptable else "C3", 0.4),
    ]
    title = f"Clearances, response x {result.scale_factor:.3g}"
    return Picture((PicturePanel(marks, "", "peak-to-peak [um]", title),), size=(6.4, 4.2))


def plot_shaft_statics(result: analysis.ShaftStatics) -> Picture:
    """Describe sag [um], shear force [N] and bending moment [N m] along a shaft [m], in both planes."""
    sag, shear, moment = [], [], []
    for k, name in enumerate("xy"):
        style = name, f"C{k}", WITHIN[k]
        sag.append(CurveMark(result.positions, 1e6 * result.sag[k], *style, marker="o", size=3.0))
        shear.append(CurveMark(result.places, result.shear_force[k], *style))
        moment.append(CurveMark(result.places, result.bending_moment[k], *style))
    panels = (
        PicturePanel(sag, "", "sag [um]", "Under its weight"),
        PicturePanel(shear, "", "shear force [N]"),
        PicturePanel(moment, "along the shaft [m]", "bending moment [N m]"),
    )
    return Picture(panels, size=(7.4, 2.5))


# Pictures of whirl: curves of periodic orbits with their stability, and basins.


MARKS = {
    analysis.Bifurcation.FOLD: "o",
    analysis.Bifurcation.PERIOD_DOUBLING: "D",
    analysis.Bifurcation.NEIMARK_SACKER: "s",
    analysis.Bifurcation.BRANCH: "^",
}
"""Marker of each bifurcation."""


def plot_orbit_curves(
    curves: Mapping[str, analysis.OrbitCurve], *, scale: float = 1.0, parameter: str = "parameter"
) -> Picture:
    """Describe the amplitude of periodic orbits over their parameter; unstable dashed, bifurcations marked.

    Parameters
    ----------
    curves : mapping of str to OrbitCurve
        Curves by label.
    scale : float
        Unit of the parameter.
    parameter : str
        Its label.
    """
    marks: list[Mark] = []
    marked = set()
    for k, (label, curve) in enumerate(curves.items()):
        x, stable, amplitude = curve.parameters / scale, curve.stable, curve.amplitudes
        # A segment is drawn as its ends are; where they differ, as the unstable one.
        solid = np.append(stable[:-1] & stable[1:], False)
        for shown, dash in ((solid, "-"), (~solid, "--")):
            pieces = np.where(shown[:-1, None], np.stack([amplitude[:-1], amplitude[1:]], 1), np.nan)
            ends = np.full((len(pieces), 1), np.nan)
            line = np.hstack([np.stack([x[:-1], x[1:]], 1), ends]).ravel(), np.hstack([pieces, ends]).ravel()
            marks.append(CurveMark(*line, label if dash == "-" else "", f"C{k}", dash))
        for event in curve.events:
            name = "" if event.kind in marked else event.kind.value
            marked.add(event.kind)
            marks.append(_points(event.parameter / scale, event.orbit.amplitude, name, MARKS[event.kind]))
    amplitude_label = "largest distance of the journal from its mean / clearance"
    text = parameter, amplitude_label, "Periodic orbits (dashed: unstable)"
    return Picture((PicturePanel(marks, *text),))


def plot_periodic_orbit(orbit: analysis.PeriodicOrbit) -> Picture:
    """Describe a periodic orbit of each journal inside its clearance circle."""
    paths = orbit.position(np.linspace(0.0, orbit.period, 361)) / orbit.lengths[:, None, None]
    marks = [
        CurveMark(x, y, station or "journal", f"C{k}")
        for k, (station, (x, y)) in enumerate(zip(orbit.stations, paths, strict=True))
    ]
    text = "x / clearance", "y / clearance", "Periodic orbit"
    return Picture((PicturePanel([*marks, circle()], *text, equal=True),), size=(5.6, 5.2))


def plot_basin(scan: analysis.BasinScan, *, clearance: float) -> Picture:
    """Describe where a rotor goes from initial positions: to rest, or into whirl.

    Parameters
    ----------
    scan : BasinScan
        Over a list or a grid of offsets of one bearing.
    clearance : float [m]
    """
    x, y = (scan.offsets.reshape(2, -1) + scan.rest[:2, None]) / clearance
    whirls, marks = scan.whirls.ravel(), list[Mark]()
    inside = np.hypot(x, y) < 1.0
    for chosen, color, label in ((whirls, BAD, "in whirl"), (~whirls, GOOD, "in equilibrium")):
        here = chosen & inside
        marks.append(CurveMark(x[here], y[here], label, color, "", marker="s", size=4.5))
    marks += [circle(), _points(scan.rest[0] / clearance, scan.rest[1] / clearance, "equilibrium", "+")]
    text = "x / clearance", "y / clearance", "Where a rotor ends that is released at a position"
    return Picture((PicturePanel(marks, *text, equal=True),), size=(6.0, 5.6))


# Pictures of the journal's motion: orbits and the locus of static equilibria.


def plot_orbits(
    orbits: Mapping[str, Trajectory], *, clearance: float, center: Iterable[float] | None = None
) -> Picture:
    """Describe journal orbits.

    Parameters
    ----------
    orbits : mapping of str to Trajectory
        Label and motion; later ones are drawn dashed over earlier ones.
    clearance : float [m]
        Scale of both axes.
    center : iterable of 2 floats, optional [m]
        Static equilibrium, marked by a cross.
    """
    marks = [
        CurveMark(orbit["x"] / clearance, orbit["y"] / clearance, label, f"C{k}", WITHIN[min(k, 2)], 1.6)
        for k, (label, orbit) in enumerate(orbits.items())
    ]
    if center is not None:
        x, y = center
        marks.append(_points(x / clearance, y / clearance, "static equilibrium", "+", size=10.0))
    text = "x / clearance", "y / clearance", "Orbit of the journal center"
    return Picture((PicturePanel(marks, *text, equal=True, legend="beside"),), size=(5.6, 5.2))


def plot_locus(
    curves: Mapping[str, tuple[np.ndarray, np.ndarray]],
    *,
    families: Mapping[str, FilmFamily] | None = None,
) -> Picture:
    """Describe the loci of the journal center under a load along -y, rotation counter-clockwise.

    Parameters
    ----------
    curves : mapping of str to (ndarray, ndarray)
        Label, eccentricity ratio [1] and attitude angle [rad], each of shape (n,).
    families : mapping of str to FilmFamily, optional
        Family of films by label, for its color and line.
    """
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 181)
    marks: list[CurveMark] = [CurveMark(np.cos(turn), np.sin(turn), "clearance circle", "k", width=1.0)]
    drawn: Counter[FilmFamily | None] = Counter()
    for k, (label, (eccentricity_ratio, attitude_angle)) in enumerate(curves.items()):
        x = eccentricity_ratio * np.sin(attitude_angle)
        y = -eccentricity_ratio * np.cos(attitude_angle)
        family = None if families is None else families.get(label)
        color, width, dash = f"C{k % 10}", 1.4, WITHIN[drawn[family] % len(WITHIN)]
        if family is not None:
            color, width = FAMILY_COLORS[family], FAMILY_WIDTHS[family]
        drawn[family] += 1
        marks.append(CurveMark(x, y, label, color, "--" if family in DASHES else dash, width))
    panel = PicturePanel(
        [marks[0], *sorted(marks[1:], key=lambda one: -one.width)],
        "x / clearance",
        "y / clearance",
        "Locus of the journal center, load along -y",
        x_limits=(-0.05, 1.05),
        y_limits=(-1.05, 0.1),
        equal=True,
        legend="beside",
    )
    return Picture((panel,), size=(7.6, 5.2))
