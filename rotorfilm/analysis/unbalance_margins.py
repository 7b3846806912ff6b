"""Amplification factors and separation margins of critical speeds, from a response to unbalance."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike
from scipy import sparse
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, minimize_scalar
from scipy.sparse.linalg import splu

from ..core.errors import InputError, require_count, require_finite, require_positive, warn_user
from ..core.inputs import arguments
from ..core.model import Array
from ..core.port import Bearings, freedoms_of
from ..core.readable import Drawable, Readable
from ..core.results import Trajectory
from ..core.signals import PLANAR
from ..core.units import STANDARD_GRAVITY
from ..rotors import ShaftRotor, SpeedProfile, Unbalance
from ..rotors.shaft_rotor import split
from ..rotors.structure import freedom_rows, in_planes, mean_plane
from .closed_loop import frequency_response, synchronous_response
from .rotor_equilibrium import RotorEquilibrium
from .rotor_modes import rotor_modes
from .shaft_statics import lowest_modes
from .threads import one_blas_thread

if TYPE_CHECKING:
    import control

HALF_POWER = math.sqrt(0.5)
"""Amplitude / that of the peak, at which the power is half."""

DAMPED = 2.5
"""Amplification factor below which a response is critically damped, and needs no margin."""

MOST_BELOW, MOST_ABOVE = 0.16, 0.26
"""Largest separation margins that are required."""


@dataclass(frozen=True, kw_only=True)
class ResonancePeak(Readable):
    """A resonance peak of a response over speed, with its separation margin by API 617.

    Attributes
    ----------
    output : str
        What responds.
    speed : float [rad/s]
        Speed of the peak, the critical speed.
    peak_amplitude : float [m]
        Amplitude at the peak.
    amplification_factor : float [1]
        AF = speed / (speed2 - speed1) between the speeds at which the amplitude is 0.707 of the peak; if only
        one of them exists, twice the distance to it counts; nan if none exists.
    separation_margin : float [1]
        Distance from the operating range / its nearer end; 0 within it.
    required_margin : float [1]
        Margin that the amplification factor requires; nan if that factor is nan.
    acceptable : bool
        Whether the margin is large enough. False if it is unknown.
    """

    output: str
    speed: float
    peak_amplitude: float
    amplification_factor: float
    separation_margin: float
    required_margin: float
    acceptable: bool


@dataclass(frozen=True, kw_only=True)
class SeparationMargins(Drawable):
    """The critical speeds seen in a response to unbalance, and their distance from the operating range.

    Attributes
    ----------
    verdict : str
        Verdict in plain words.
    acceptable : bool
        Whether all peaks are acceptable.
    minimum_speed, maximum_speed : float [rad/s]
        Operating range.
    peaks : tuple of ResonancePeak
        Peaks by output and rising speed.
    speeds : ndarray, shape (n_speeds,) [rad/s]
        Speeds of the response.
    amplitudes : dict of str to ndarray, shape (n_speeds,) [m]
        Amplitudes by output.
    """

    verdict: str
    acceptable: bool
    minimum_speed: float
    maximum_speed: float
    peaks: tuple[ResonancePeak, ...]
    speeds: Array
    amplitudes: dict[str, Array]


@one_blas_thread
@arguments
def amplification_factor(speeds: ArrayLike, phasors: ArrayLike, peak: float) -> float:
    """Return the amplification factor of a peak by its half-power speeds [1].

    Parameters
    ----------
    speeds : array_like, shape (n,) [rad/s]
        Rising speeds, close enough that a spline follows the response.
    phasors : array_like of complex, shape (n,)
        The response.
    peak : float [rad/s]
        Speed of the peak, within the range.

    Notes
    -----
    API 684 and 617, AF = N_c / (N_2 - N_1) with the speeds at which the amplitude is 0.707 of the peak. One
    of these speeds may be missing, for a peak near another one or at the end of the range; AF is then N_c /
    (2 |N - N_c|) with the other. If both are missing, AF is nan.
    """
    grid = require_finite("speeds", speeds)
    size = _amplitude(grid, np.asarray(phasors))
    level = HALF_POWER * size(peak)
    low = _crossing(size, level, [peak, *grid[grid < peak][::-1]])
    high = _crossing(size, level, [peak, *grid[grid > peak]])
    if low is None and high is None:
        return math.nan
    if low is None or high is None:
        return peak / (2.0 * abs(peak - (high if low is None else low)))  # type: ignore[operator]
    return peak / (high - low)


def _amplitude(grid: Array, phasors: np.ndarray) -> Callable[[float], float]:
    spline = CubicSpline(grid, phasors)
    return lambda speed: float(abs(spline(speed)))


def _crossing(size: Callable[[float], float], level: float, places: Sequence[float]) -> float | None:
    """Return where the amplitude falls to a level, along speeds from the peak on; None before it rises."""
    for near, far in pairwise(places):
        if size(far) <= level:
            return float(brentq(lambda w: size(w) - level, min(near, far), max(near, far)))
        if size(far) > size(near):
            return None
    return None


@one_blas_thread
@arguments
def required_margin(amplification_factor: float, *, above: bool) -> float:
    """Return the separation margin that API 617 requires of a critical speed [1].

    Parameters
    ----------
    amplification_factor : float [1]
        AF.
    above : bool
        Whether the critical speed is above the operating range, and not below it.

    Returns
    -------
    float [1]
        0 where AF < 2.5. Below the range the smaller of 17 (1 - 1 / (AF - 1.5)) and 16 %, above it the
        smaller of 10 + 17 (1 - 1 / (AF - 1.5)) and 26 %.

    Notes
    -----
    API 617, 7th ed. (2002), part 1, 2.6.2.10; API 684.
    """
    if amplification_factor < DAMPED:
        return 0.0
    share = 0.17 * (1.0 - 1.0 / (amplification_factor - 1.5))
    return min(0.10 + share, MOST_ABOVE) if above else min(share, MOST_BELOW)


@one_blas_thread
@arguments
def separation_margins(
    response: control.FrequencyResponseData,
    minimum_speed: float,
    maximum_speed: float,
    outputs: Sequence[str] | None = None,
) -> SeparationMargins:
    """Return the peaks of a response to unbalance, and whether they keep the margins of API 617.

    Parameters
    ----------
    response : control.FrequencyResponseData
        Response as `unbalance_response` returns it, at speeds that resolve the peaks (`resonant_speeds`) and
        go well beyond the operating range; API 617 wants 150 % of the maximum speed.
    minimum_speed, maximum_speed : float [rad/s]
        Operating range, up to the maximum continuous speed.
    outputs : sequence of str, optional
        Names of displacements; all of the response by default. API 617 uses those at the probes.

    Raises
    ------
    InputError
        If an argument breaks its rule, or the response does not cover the operating range.

    Warns
    -----
    ValidityWarning
        If an amplitude still rises at the last speed, where a peak may follow.
    """
    known, speeds = list(response.output_labels), np.asarray(response.frequency)
    _require_covered(speeds, minimum_speed, maximum_speed)
    chosen = [name for name in known if _is_displacement(name)] if outputs is None else list(outputs)
    if missing := [name for name in chosen if name not in known]:
        raise InputError(f"outputs must be among {known}, got {missing}")
    table = np.asarray(response.frdata)
    curves = {name: table[known.index(name), 0] for name in chosen}
    for name, curve in curves.items():
        if abs(curve[-1]) > abs(curve[-2]):
            warn_user(
                f"{name} still rises at the last speed, {speeds[-1]:.6g} rad/s; a peak beyond is not seen"
            )
    operating = minimum_speed, maximum_speed
    peaks = tuple(p for name, curve in curves.items() for p in _peaks(name, speeds, curve, operating))
    bad = [peak for peak in peaks if not peak.acceptable]
    return SeparationMargins(
        verdict=_verdict(bad),
        acceptable=not bad,
        minimum_speed=minimum_speed,
        maximum_speed=maximum_speed,
        peaks=peaks,
        speeds=speeds,
        amplitudes={name: np.abs(curve) for name, curve in curves.items()},
    )


def _require_covered(speeds: Array, minimum_speed: float, maximum_speed: float) -> None:
    """Raise InputError unless an operating range is one, and within the speeds of a response."""
    require_positive("minimum_speed", minimum_speed)
    if not maximum_speed >= minimum_speed:
        raise InputError(f"maximum_speed must be at least {minimum_speed!r}, got {maximum_speed!r}")
    if speeds[0] > minimum_speed or speeds[-1] < maximum_speed:
        raise InputError(
            f"response must cover the operating range, {minimum_speed:.6g} to {maximum_speed:.6g} rad/s, "
            f"got speeds from {speeds[0]:.6g} to {speeds[-1]:.6g} rad/s"
        )


def _is_displacement(name: str) -> bool:
    other = [f"{kind}_{axis}" for kind in ("force", "moment", "tilt", "tilt_rate") for axis in "xy"]
    return name.rpartition("_")[2] in ("x", "y") and not name.endswith(tuple(other))


def _peaks(
    name: str, speeds: Array, phasors: np.ndarray, operating: tuple[float, float]
) -> list[ResonancePeak]:
    """Return the peaks of one output."""
    sizes, size = np.abs(phasors), _amplitude(speeds, phasors)
    tops = np.flatnonzero((sizes[1:-1] > sizes[:-2]) & (sizes[1:-1] >= sizes[2:])) + 1
    found = []
    for k in tops:
        within = float(speeds[k - 1]), float(speeds[k + 1])
        top = minimize_scalar(lambda w: -size(w), bounds=within, method="bounded", options={"xatol": 1e-9})
        speed = float(top.x)
        factor = amplification_factor(speeds, phasors, speed)
        below, above = (operating[0] - speed) / operating[0], (speed - operating[1]) / operating[1]
        wanted = math.nan if math.isnan(factor) else required_margin(factor, above=above > 0.0)
        margin = max(below, above, 0.0)
        found.append(
            ResonancePeak(
                output=name,
                speed=speed,
                peak_amplitude=size(speed),
                amplification_factor=factor,
                separation_margin=margin,
                required_margin=wanted,
                acceptable=margin >= wanted,
            )
        )
    return found


def _verdict(bad: Sequence[ResonancePeak]) -> str:
    if not bad:
        return "acceptable: all critical speeds seen keep their separation margins"
    worst = min(bad, key=lambda peak: peak.separation_margin)
    rpm = worst.speed * 30.0 / math.pi
    return (
        f"not acceptable: {len(bad)} of the peaks keep too little distance; {worst.output} at {rpm:.5g} rpm "
        f"has {100.0 * worst.separation_margin:.3g} % and needs {100.0 * worst.required_margin:.3g} %"
    )


# A shaft that is bent when nothing loads it, and turns.


@one_blas_thread
@arguments
def bow_response(
    rotor: ShaftRotor, bearings: Bearings, speeds: ArrayLike, bow: ArrayLike
) -> control.FrequencyResponseData:
    """Return the synchronous response of a rotor to a bow of its shaft.

    Unbalances are not included: the whole response is the sum with that of `unbalance_response`.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : mapping of str to Reaction
        Bearings by the name of the station; each is linearized at the equilibrium of every speed.
    speeds : array_like, shape (n,) [rad/s]
        Angular speeds, positive and rising.
    bow : array_like of complex, shape (n_nodes,) [m]
        Deflection of the nodes of the unloaded shaft: a real number along +x at t = 0, i along +y. Between
        them it is bent as little as it can be.

    Returns
    -------
    control.FrequencyResponseData
        Input `bow` [1]: a factor of the given bow. Outputs as in `unbalance_response`. Displacements include
        the bow: on rigid bearings a slow shaft moves by its bow.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        If there is no equilibrium at one of the speeds.

    Notes
    -----
    The shaft resists what deflects it from its bow, K (q - q_bow), whatever the speed; of a Jeffcott rotor
    that is Nicholas, Gunter & Allaire (1976), J. Eng. Power 98, 171-181. Internal damping does not depend on
    the bow.
    """
    shape = np.asarray(bow, dtype=complex)
    count = len(rotor.elements) + 1
    if shape.shape != (count,) or not np.isfinite(shape).all():
        raise InputError(f"bow must be {count} finite numbers, one for each node, got shape {shape.shape}")
    force = _straightening(rotor, shape)
    turning = np.concatenate([force, -1j * force, np.zeros(len(rotor.assembly.others))])
    loads = np.column_stack([turning.real, turning.imag])
    parts = np.array([[1.0], [1.0j]])
    return synchronous_response(rotor, bearings, speeds, loads, lambda speed: parts, "bow")


def _straightening(rotor: ShaftRotor, shape: np.ndarray) -> np.ndarray:
    """Return the forces of one plane that would bend a straight shaft to a shape of its nodes, (N / 2,)."""
    stiffness = rotor.bending.tocsc()
    nodes = 2 * np.arange(len(shape))
    still = {*nodes.tolist(), *rotor.assembly.supports}
    others = np.array([k for k in range(stiffness.shape[0]) if k not in still])
    free = splu(stiffness[others][:, others])
    coupled = stiffness[others][:, nodes] @ shape
    moved = -(free.solve(coupled.real.copy()) + 1j * free.solve(coupled.imag.copy()))
    forces = np.zeros(stiffness.shape[0], dtype=complex)
    forces[nodes] = stiffness[nodes][:, nodes] @ shape + stiffness[nodes][:, others] @ moved
    return forces


# What turns with the shaft in a run over time: a coast-down as a response over speed.


LEAST_SAMPLES = 12
"""Samples a turn that are needed."""


@one_blas_thread
@arguments
def tracked_response(
    run: Trajectory, speed: SpeedProfile, outputs: Sequence[str] | None = None, *, turns: int = 2
) -> control.FrequencyResponseData:
    """Return the synchronous (1x) part of signals over speed, from a run-up or a coast-down.

    Bode plots, polar plots and separation margins accept the result like that of `unbalance_response`.

    Parameters
    ----------
    run : Trajectory
        Run with at least 12 samples a turn.
    speed : SpeedProfile
        Speed of the run: positive, and rising or falling throughout it; samples while it stays the same are
        left out.
    outputs : sequence of str, optional
        Names of signals; all displacements along x and y by default.
    turns : int
        Turns of the shaft from which each phasor is taken.

    Returns
    -------
    control.FrequencyResponseData
        Input `unbalance` [1]: that of the run. Phasors at exp(i angle of the shaft), over the speed in the
        middle of each window.

    Raises
    ------
    InputError
        If a signal is not there, samples are too few, or the speed does not rise or fall.

    Notes
    -----
    A least-squares fit of a constant, a slope, and cos and sin of the shaft's angle with amplitudes that
    change linearly over the window: motion that is neither synchronous nor constant is averaged out.
    """
    require_count("turns", turns)
    names = [n for n in run.signals if n.rpartition("_")[2] in ("x", "y")] if outputs is None else [*outputs]
    if missing := [name for name in names if name not in run.signals]:
        raise InputError(f"outputs must be among {list(run.signals)}, got {missing}")
    speeds, windows = _windows(run.time, speed, turns)
    table = np.array([run.signals[name] for name in names])
    phasors = np.array([fitted_phasors(angle, table[:, chosen]) for chosen, angle in windows])
    order = np.argsort(speeds)
    columns = [row[:, None] for row in phasors[order]]
    return frequency_response(columns, speeds[order], ["unbalance"], names, "tracked_response")


def _windows(time: Array, speed: SpeedProfile, turns: int) -> tuple[Array, list[tuple[Array, Array]]]:
    """Return mean speeds, and places and angles of the samples of each window."""
    moving = [t for t in time.tolist() if speed.acceleration(t) != 0.0]
    if not moving or min(speed.speed(t) for t in moving) <= 0.0:
        raise InputError("speed must be positive, and rise or fall in the run, got one that does not")
    places = np.flatnonzero((time >= moving[0]) & (time <= moving[-1]))
    angle = np.array([speed.angle(t) for t in time[places].tolist()])
    number = ((angle - angle[0]) / (2.0 * math.pi * turns)).astype(int)
    found, speeds = [], []
    for k in range(number[-1]):
        inside = number == k
        if inside.sum() < LEAST_SAMPLES * turns:
            raise InputError(
                f"run must have at least {LEAST_SAMPLES} samples a turn, got {inside.sum() / turns:.3g}"
            )
        found.append((places[inside], angle[inside]))
        middle = np.interp(0.5 * (angle[inside][0] + angle[inside][-1]), angle, time[places])
        speeds.append(speed.speed(float(middle)))
    steps = np.diff(speeds)
    if len(speeds) < 2 or not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        raise InputError(f"speed must rise or fall throughout some windows of {turns} turns, got none")
    return np.array(speeds), found


def fitted_phasors(angle: Array, signals: Array) -> np.ndarray:
    """Return the phasors of signals, shape (n_signals, n_samples), in the middle of a window."""
    middle = 0.5 * (angle[0] + angle[-1])
    along = (angle - middle) / (angle[-1] - angle[0])
    cos, sin = np.cos(angle), np.sin(angle)
    columns = np.stack([cos, sin, np.ones_like(angle), along, along * cos, along * sin], axis=1)
    fit = np.linalg.lstsq(columns, signals.T, rcond=None)[0]
    return np.asarray(fit[0] - 1j * fit[1])


# Unbalance that excites one mode, of the size and at the places that API 617 wants.


RESIDUAL = 6.35e-3 * math.pi / 30.0
"""Eccentricity times speed [m/s]: 6350 g mm rpm / kg."""

LEAST_ECCENTRICITY = 10e-6 * 0.0254
"""The smallest eccentricity that is asked for [m], 10 micro-inches, from 25000 rpm on."""

LOBE = 0.25
"""Deflection / the largest one, below which a part of a mode needs no unbalance of its own."""


@one_blas_thread
@arguments
def residual_unbalance(mass: float, speed: float) -> float:
    """Return the largest residual unbalance of API 617 [kg m]: 6350 W / N [g mm], W in kg and N in rpm.

    Parameters
    ----------
    mass : float [kg]
        Static load on the journal / gravity.
    speed : float [rad/s]
        Maximum continuous speed.

    Notes
    -----
    API 617, 7th ed. (2002), part 1. From 25 000 rpm on the limit is W / 3.937 g mm. In US units the formula
    below that speed is 4 W / N oz in, with W in pounds.
    """
    require_positive("mass", mass)
    require_positive("|speed|", abs(speed))
    return mass * max(RESIDUAL / abs(speed), LEAST_ECCENTRICITY)


@one_blas_thread
@arguments
def mode_unbalances(
    rotor: ShaftRotor, at: RotorEquilibrium, mode: int, *, multiple: float = 2.0
) -> tuple[Unbalance, ...]:
    """Return the unbalances that excite a mode of a rotor most, as API 617 places them.

    Parameters
    ----------
    rotor : ShaftRotor
        Rotor with weight. Its own unbalances are not used.
    at : RotorEquilibrium
        Equilibrium as `rotor_equilibrium` returns it, at the maximum continuous speed.
    mode : int
        Number of the undamped mode in a plane, from 1: on the mean stiffness of each bearing along x and y.
    multiple : float [1]
        Multiple of the residual unbalance 6350 W / N: 2 in API 617 (7th and 8th ed.), 4 in API 684 (1st ed.).

    Returns
    -------
    tuple of Unbalance
        One unbalance in each part of the shaft that moves to one side, at the place of the largest
        displacement, with an angle of 0 or pi. A single part between the bearings is sized by the load of all
        journals, several parts each by that of the nearest journal. A part that moves most beyond the
        bearings is sized by the overhung mass.

    Raises
    ------
    InputError
        If the rotor has no weight, or no such mode.
    """
    require_count("mode", mode)
    require_positive("multiple", multiple)
    if not any(np.linalg.norm(load[:2]) > 0.0 for load in at.loads.values()):
        raise InputError("rotor must have weight, got no load on any bearing")
    shape = _shape(rotor, at, mode)
    peaks = list(_lobes(shape))
    return tuple(
        Unbalance(
            node=node,
            unbalance=multiple * residual_unbalance(_mass(rotor, at, node, peaks), at.speed),
            unbalance_angle=0.0 if shape[node] * shape[peaks[0]] > 0.0 else math.pi,
        )
        for node in peaks
    )


def _shape(rotor: ShaftRotor, at: RotorEquilibrium, mode: int) -> Array:
    """Return the deflection of the nodes in an undamped mode of one plane, shape (n_nodes,)."""
    full = in_planes(rotor.assembly)
    n, nodes = len(full.coordinates), len(rotor.elements) + 1
    stiffness, mass = mean_plane(full.stiffness), mean_plane(full.mass)
    for name, film in at.coefficients.items():
        if freedoms_of(film)[:2] != PLANAR:
            continue
        row = freedom_rows(full, name)[:1, :n]
        stiffness = stiffness + 0.5 * float(np.trace(film.stiffness[:2, :2])) * sparse.csr_array(row.T @ row)
    _, modes = lowest_modes(stiffness, mass, mode)
    if modes.shape[1] < mode:
        raise InputError(f"mode must be at most {modes.shape[1]}, got {mode}")
    return modes[: 2 * nodes : 2, mode - 1]


def _lobes(shape: Array) -> Iterator[int]:
    """Yield the node that moves most in each part of a shape that moves to one side."""
    moving = np.flatnonzero(shape)
    changes = np.flatnonzero(np.diff(np.sign(shape[moving]))) + 1
    largest = np.abs(shape).max()
    for part in np.split(moving, changes):
        node = int(part[np.argmax(np.abs(shape[part]))])
        if abs(shape[node]) >= LOBE * largest:
            yield node


def _mass(rotor: ShaftRotor, at: RotorEquilibrium, node: int, peaks: list[int]) -> float:
    """Return the mass that an unbalance at a node is for [kg]."""
    held = [name for name, film in at.coefficients.items() if freedoms_of(film)[:2] == PLANAR]
    stations = {s.node: at.loads[s.name] for s in rotor.stations if s.name in held}
    first, last = min(stations), max(stations)
    if not first <= node <= last:
        return _overhung(rotor, first if node < first else last, left=node < first)
    journals = {place: float(np.linalg.norm(load[:2])) / STANDARD_GRAVITY for place, load in stations.items()}
    if sum(first <= peak <= last for peak in peaks) == 1:
        return sum(journals.values())
    where = rotor.positions
    return journals[min(journals, key=lambda place: abs(where[place] - where[node]))]


def _overhung(rotor: ShaftRotor, station: int, *, left: bool) -> float:
    """Return the mass of shaft and disks beyond a node [kg]."""
    pieces = rotor.elements[:station] if left else rotor.elements[station:]
    shift = np.array([1.0, 0.0, 1.0, 0.0])
    shaft = sum(float(shift @ piece.matrices(rotor.beam).mass[:4, :4] @ shift) for piece in pieces)
    disks = [d.mass for d in rotor.disks if (d.node < station if left else d.node > station)]
    return shaft + sum(disks)


# How fine the elements of a shaft are for one of its modes.


_ROUNDOFF = 1e-11


@dataclass(frozen=True, kw_only=True)
class MeshConvergence(Readable):
    """The frequency of a mode on finer and finer elements.

    Attributes
    ----------
    elements : ndarray of int, shape (n_meshes,) [1]
        Number of elements.
    frequency : ndarray, shape (n_meshes,) [rad/s]
        Damped frequency of the mode.
    order : float [1]
        Order of convergence, measured on the last three meshes; nan where they differ by roundoff only, or
        the changes alternate or do not shrink, so that nothing converges yet.
    estimate : float [rad/s]
        Estimate by Richardson's extrapolation from the last two with that order; the last frequency where it
        is nan.
    relative_error : float [1]
        Relative error of the first mesh, that of the rotor as it is, against the estimate; signed.
    """

    elements: Array
    frequency: Array
    order: float
    estimate: float
    relative_error: float


@one_blas_thread
@arguments
def mesh_convergence(
    rotor: ShaftRotor, bearings: Bearings, speed: float, mode: int, *, meshes: int = 3
) -> MeshConvergence:
    """Return how the frequency of a mode converges as each element is split in 2, 4 and so on.

    Parameters
    ----------
    rotor : ShaftRotor
        Rotor; the first mesh is that of its own elements.
    bearings : mapping of str to Reaction
        Bearings as in `rotor_modes`.
    speed : float [rad/s]
    mode : int
        Number of the whirl among the `rotor_modes` of the rotor, from 1; on the finer elements it is the one
        nearest to it.
    meshes : int
        At least 3.

    Raises
    ------
    InputError
        If there is no such mode, or too few meshes.
    EquilibriumError
        If there is no equilibrium.
    """
    require_count("mode", mode)
    require_count("meshes", meshes, 3)
    rotors = [split(rotor, 2**k) for k in range(meshes)]
    values: list[complex] = []
    floor = _ROUNDOFF
    for one in rotors:
        found = rotor_modes(one, bearings, speed)
        if not values and mode > len(found.eigenvalues):
            raise InputError(f"mode must be at most {len(found.eigenvalues)}, got {mode}")
        near = mode - 1 if not values else int(np.argmin(np.abs(found.eigenvalues - values[-1])))
        values.append(complex(found.eigenvalues[near]))
        floor = max(floor, found.error)
    frequency = np.array(values).imag
    order, estimate = _extrapolated(frequency[-3:], floor)
    return MeshConvergence(
        elements=np.array([len(one.elements) for one in rotors]),
        frequency=frequency,
        order=order,
        estimate=estimate,
        relative_error=float(frequency[0] / estimate - 1.0),
    )


def _extrapolated(last: Sequence[float] | Array, floor: float) -> tuple[float, float]:
    """Return order and limit of three numbers on halved meshes; nan and the last unless they converge."""
    before, after = last[0] - last[1], last[1] - last[2]
    small = min(abs(before), abs(after)) <= floor * abs(last[2])
    if small or before * after <= 0.0 or abs(after) >= abs(before):
        return math.nan, float(last[2])
    order = math.log2(before / after)
    return order, float(last[2] - after / (2.0**order - 1.0))
