"""Amplification factors and separation margins of critical speeds, from a response to unbalance."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, minimize_scalar

from ...errors import InputError, require_finite, require_positive, warn_user
from ...inputs.kinds import arguments
from ...model import Array
from ...readable.result import Drawable, Readable
from ..closed_loop import HOUSING

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
    """A peak of a response over speed, judged by API 617.

    Attributes
    ----------
    output : str
        What responds.
    speed : float [rad/s]
        Of the peak, the critical speed.
    peak_amplitude : float [m]
        There.
    amplification_factor : float [1]
        AF = speed / (speed2 - speed1) between the speeds at which the amplitude is .707 of the peak; of a
        peak with one such side twice the distance to it; nan with none.
    separation_margin : float [1]
        Distance from the operating range / its nearer end; 0 within it.
    required_margin : float [1]
        By the amplification factor; nan with that.
    acceptable : bool
        Whether the margin is what is required. False where it cannot be told.
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
        In plain words.
    acceptable : bool
        Whether all peaks are.
    minimum_speed, maximum_speed : float [rad/s]
        Operating range.
    peaks : tuple of ResonancePeak
        By output and rising speed.
    speeds : ndarray, shape (n_speeds,) [rad/s]
        Of the response.
    amplitudes : dict of str to ndarray, shape (n_speeds,) [m]
        By output.
    """

    verdict: str
    acceptable: bool
    minimum_speed: float
    maximum_speed: float
    peaks: tuple[ResonancePeak, ...]
    speeds: Array
    amplitudes: dict[str, Array]


@arguments
def amplification_factor(speeds: ArrayLike, phasors: ArrayLike, peak: float) -> float:
    """Return the amplification factor of a peak by its half-power speeds [1].

    Parameters
    ----------
    speeds : array_like, shape (n,) [rad/s]
        Rising, and so close that a spline follows the response.
    phasors : array_like of complex, shape (n,)
        The response.
    peak : float [rad/s]
        Its speed, within the range.

    Notes
    -----
    API 684 and 617, AF = N_c / (N_2 - N_1) with the speeds at which the amplitude is .707 of the peak. Of a
    peak beside another one, or at the end of the range, one of them may be missing; AF is then
    N_c / (2 |N - N_c|) with the other; with none it is nan.
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
        As `unbalance_response` returns it, at speeds that resolve the peaks (`resonant_speeds`) and go well
        beyond the operating range; API 617 wants 150 % of the maximum speed.
    minimum_speed, maximum_speed : float [rad/s]
        Operating range, up to the maximum continuous speed.
    outputs : sequence of str, optional
        Names of displacements; all of the response by default. API 617 judges the probes.

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
    return name.rpartition("_")[2] in ("x", "y") and not name.endswith((*HOUSING, "force_x", "force_y"))


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
