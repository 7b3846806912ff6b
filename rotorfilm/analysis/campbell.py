"""Whirl modes of a flexible rotor over speed, and its critical speeds."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import linear_sum_assignment

from ..core.errors import ConvergenceError
from ..core.inputs import arguments
from ..core.model import Array, Reaction
from ..core.readable import Drawable, Readable
from ..rotors import FlexibleRotor, require_flexible
from .critical import Crossing, crossings
from .modal_reduction import COUNTS, CountedTuple, counted
from .rotor_modes import (
    RotorModes,
    Whirls,
    directions,
    log_decrement,
    require_range,
    rotor_modes,
    speeds_in_turn,
)

PEAK_SPEEDS = 21
"""Speeds across a resonance, two half-widths to each side."""

LEAST_DECREMENT = 1e-6
"""Logarithmic decrement below which a resonance counts as undamped."""


@dataclass(frozen=True, kw_only=True)
class Campbell(Whirls, Drawable):
    """Whirl modes over speed.

    Attributes
    ----------
    speeds : ndarray, shape (n_speeds,) [rad/s]
    eigenvalues : ndarray, shape (n_modes, n_speeds) [1/s]
        By mode; nan where a mode does not oscillate, or is much faster than the modes that were asked for.
    direction : ndarray, shape (n_modes, n_speeds) [1]
        As in `RotorModes`; nan likewise.
    frequency : ndarray, shape (n_modes, n_speeds) [rad/s]
        Damped frequency, the imaginary part of the eigenvalues.
    log_decrement : ndarray, shape (n_modes, n_speeds) [1]
        Negative where the whirl grows.
    error : float [1]
        Largest of those of `RotorModes`.
    roundoff : ndarray, shape (n_modes, n_speeds) [1/s]
        As in `RotorModes`; nan likewise.
    highest_frequency : float [rad/s]
        Modes that stay above it are left out; inf where none is.
    work : dict of str to int
        As `RotorModes.work`, of all speeds.
    """

    speeds: Array
    eigenvalues: NDArray[np.complex128]
    direction: Array
    error: float = 0.0
    roundoff: Array | float = 0.0
    highest_frequency: float = math.inf
    work: dict[str, int] = field(default_factory=dict, compare=False)


_BEYOND = 1.5
"""How far modes of a rotor of many elements are followed / the highest frequency."""


@dataclass(frozen=True, kw_only=True)
class CriticalSpeed(Readable):
    """A speed at which a whirl has the frequency of the rotation.

    Attributes
    ----------
    speed : float [rad/s]
        Of the sign of the speeds searched.
    log_decrement : float [1]
        Of that whirl.
    direction : float [1]
        As in `RotorModes`; an unbalance excites forward whirl.
    """

    speed: float
    log_decrement: float
    direction: float


@arguments
def campbell(
    rotor: FlexibleRotor,
    bearings: Mapping[str, Reaction],
    speeds: ArrayLike,
    highest_frequency: float = math.inf,
) -> Campbell:
    """Return the whirl modes of a rotor on its films over a range of speeds.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling, of either sign; so close that modes do not change beyond recognition from one to
        the next.
    highest_frequency : float [rad/s]
        Modes that stay above it are left out. If infinite, as in `rotor_modes`, so that a shaft of more than
        19 elements has only its lower modes; `Campbell.highest_frequency` tells it.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    grid = speeds_in_turn(speeds)
    require_range(highest_frequency)
    with counted(*COUNTS) as work:
        points = [rotor_modes(rotor, bearings, float(speed), _BEYOND * highest_frequency) for speed in grid]
    tracks = tracked(points, rotor.assembly.mass)
    values = np.full((len(tracks), len(grid)), complex(math.nan, math.nan))
    direction, rounded = np.full((2, len(tracks), len(grid)), math.nan)
    for row, track in enumerate(tracks):
        for column, k in track.items():
            values[row, column] = points[column].eigenvalues[k]
            direction[row, column] = points[column].direction[k]
            rounded[row, column] = np.asarray(points[column].roundoff)[k]
    lowest = np.nanmin(np.abs(values.imag), axis=1) if len(tracks) else np.zeros(0)
    order = [k for k in np.argsort(lowest) if lowest[k] <= highest_frequency]
    return Campbell(
        speeds=grid,
        eigenvalues=values[order],
        direction=direction[order],
        error=max(point.error for point in points),
        roundoff=rounded[order],
        highest_frequency=min(highest_frequency, *(point.highest_frequency for point in points)),
        work=dict(work),
    )


@arguments
def critical_speeds(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: ArrayLike
) -> CountedTuple[CriticalSpeed]:
    """Return all damped critical speeds, rising: where a whirl has the frequency of the rotation.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling, of either sign: the range searched, and the steps in which that begins.

    Returns
    -------
    CountedTuple
        A tuple of `CriticalSpeed` with the counters `work`.

    Raises
    ------
    InputError
        If the speeds break their rule.
    EquilibriumError
        If there is no equilibrium at one of the speeds, or between them.
    ConvergenceError
        Of intervals in which the list cannot be proven complete, as where coefficients of a bearing jump and
        a whirl is slower than the rotation on one side only, or of a search that takes too many equilibria;
        the message names the likely cause. `partial` has those found in all of the range.

    Notes
    -----
    Over a step of speeds the state matrix, in the eigenvectors of its middle, is diag(s) and small numbers.
    They bound what may become of each eigenvector (Brouwer; one only: Earle and Hamilton 1970), and all other
    eigenvalues by Gershgorin's circles. A step counts as proven where no other eigenvalue comes to the line
    Im s = |speed|, and those that may, have a frequency that grows more slowly than the speed all along, or
    faster all along: each then crosses once at most, and Newton's method tells whether it does. Other steps
    are halved, up to 14 times.

    The proof is of the shapes kept, whose eigenvalues are off by 1e-6 at most, as estimated; what is found is
    solved in all coordinates. Of films it holds if their K and C bend within a step at most twice as much
    as the parabola through both ends and the middle, and on films that remember, `JFOFilm`, for whirls with
    |Re s| up to three times the speed. Where K and C jump, as where a tilting pad is loaded first, the same
    is proven of a straight way from one side to the other, on which no whirl may have the frequency of the
    rotation. Without damping, and with a stiffness that is symmetric and the same at all speeds, the number
    is checked in all coordinates besides, by Sylvester's law of inertia.
    """
    grid = speeds_in_turn(speeds)
    require_flexible(rotor)
    with counted(*COUNTS) as work:
        try:
            found = crossings(rotor, bearings, grid)
        except ConvergenceError as failure:
            failure.partial = CountedTuple(_listed(rotor, failure.partial or ()), work)
            raise
    return CountedTuple(_listed(rotor, found), work)


def _listed(rotor: FlexibleRotor, found: Iterable[Crossing]) -> list[CriticalSpeed]:
    return [
        CriticalSpeed(
            speed=one.speed,
            log_decrement=float(log_decrement(one.value)),
            direction=float(directions(rotor.assembly.mass, one.shape[:, None], one.speed)[0]),
        )
        for one in found
    ]


@arguments
def resonant_speeds(speeds: ArrayLike, critical: Sequence[CriticalSpeed]) -> Array:
    """Return the speeds with more of them across the resonances between them, so that no peak is cut off.

    Parameters
    ----------
    speeds : array_like, shape (n,) [rad/s]
        Rising.
    critical : sequence of CriticalSpeed
        As `critical_speeds` returns them. Those without damping are left out: their peak has no height.

    Returns
    -------
    ndarray, shape (m,) [rad/s]
        Rising, within the range of `speeds`: these, and 21 across each resonance, two half-widths to each
        side. The half-width of a peak is speed log_decrement / (2 pi).
    """
    grid, width = np.asarray(speeds, dtype=float), np.linspace(-2.0, 2.0, PEAK_SPEEDS)
    damped = [one for one in critical if abs(one.log_decrement) > LEAST_DECREMENT]
    near = [one.speed * (1.0 + width * abs(one.log_decrement) / (2.0 * np.pi)) for one in damped]
    every = np.unique(np.concatenate([grid, *near]))
    within: Array = every[(every >= grid[0]) & (every <= grid[-1])]
    return within


# Which whirl at one speed is which at another.


def matches(before: RotorModes, after: RotorModes, mass: Any) -> dict[int, int]:
    """Return the mode of `before` that each mode of `after` continues, by eigenvalue and shape."""
    if not (before.eigenvalues.size and after.eigenvalues.size):
        return {}
    product = np.abs(before.shapes.conj().T @ (mass @ after.shapes)) ** 2
    sizes = [np.sum(m.shapes.conj() * (mass @ m.shapes), axis=0).real for m in (before, after)]
    likeness = product / np.outer(*sizes)
    scale = np.abs(before.eigenvalues)[:, None] + np.abs(after.eigenvalues)
    apart = np.abs(before.eigenvalues[:, None] - after.eigenvalues) / scale
    cost = apart + 0.2 * (1.0 - likeness)
    rows, columns = linear_sum_assignment(cost)
    return {int(c): int(r) for r, c in zip(rows, columns, strict=True) if apart[r, c] < 0.5}


def tracked(points: list[RotorModes], mass: Any) -> list[dict[int, int]]:
    """Return, for each mode, its index among the modes of each speed at which it was found."""
    tracks: list[dict[int, int]] = [{0: k} for k in range(len(points[0].eigenvalues))]
    current = list(range(len(tracks)))
    for column in range(1, len(points)):
        before, after = points[column - 1], points[column]
        partner = matches(before, after, mass)
        following = []
        for k in range(len(after.eigenvalues)):
            if k in partner:
                following.append(current[partner[k]])
            else:
                tracks.append({})
                following.append(len(tracks) - 1)
            tracks[following[-1]][column] = k
        current = following
    return tracks
