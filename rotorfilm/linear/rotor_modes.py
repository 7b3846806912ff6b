"""Whirl modes of a flexible rotor: frequency, damping, direction, and how they go with speed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eigh
from scipy.optimize import brentq, linear_sum_assignment

from ..errors import InputError, require_finite
from ..model import Array, Reaction
from ..rotors import FlexibleRotor
from ..rotors.structure import Structure
from .rotor_rest import rotor_equilibrium
from .rotor_system import SecondOrder, second_order, with_hysteresis

_OSCILLATES = 1e-6

NEUTRAL = 1e-9
"""Growth rate / frequency that is roundoff."""

_HELD = 1e-12
"""Stiffness force / the forces that cancel in it, below which nothing holds a shape."""


@dataclass(frozen=True, kw_only=True)
class RotorModes:
    """The oscillating modes of a rotor at a speed, by rising frequency.

    Attributes
    ----------
    speed : float [rad/s]
    eigenvalues : ndarray, shape (n,) [1/s]
        Those with a positive imaginary part, which is the damped frequency.
    shapes : ndarray, shape (N, n)
        Complex coordinates of the rotor.
    direction : ndarray, shape (n,) [1]
        From 1, whirl in circles with the rotation, to -1, in circles against it.
    """

    speed: float
    eigenvalues: NDArray[np.complex128]
    shapes: NDArray[np.complex128]
    direction: Array

    @property
    def frequency(self) -> Array:
        """Damped frequency [rad/s]."""
        return self.eigenvalues.imag

    @property
    def log_decrement(self) -> Array:
        """Logarithm of the ratio of two successive amplitudes [1]: negative where the whirl grows."""
        return log_decrement(self.eigenvalues)


@dataclass(frozen=True, kw_only=True)
class Campbell:
    """Whirl modes over speed.

    Attributes
    ----------
    speeds : ndarray, shape (n_speeds,) [rad/s]
    eigenvalues : ndarray, shape (n_modes, n_speeds) [1/s]
        By mode; nan where a mode does not oscillate.
    direction : ndarray, shape (n_modes, n_speeds) [1]
        As in `RotorModes`; nan likewise.
    """

    speeds: Array
    eigenvalues: NDArray[np.complex128]
    direction: Array

    @property
    def frequency(self) -> Array:
        """Damped frequency [rad/s], shape (n_modes, n_speeds)."""
        return self.eigenvalues.imag

    @property
    def log_decrement(self) -> Array:
        """Logarithmic decrement [1], shape (n_modes, n_speeds)."""
        return log_decrement(self.eigenvalues)


@dataclass(frozen=True, kw_only=True)
class CriticalSpeed:
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


@dataclass(frozen=True, kw_only=True)
class RotorThreshold:
    """The speed at which small motion of a rotor begins to grow, or the reason why there is none.

    Attributes
    ----------
    speed : float or None [rad/s]
    whirl_frequency : float or None [rad/s]
        0 where the rotor departs to one side instead of whirling (divergence).
    whirl_ratio : float or None [1]
        whirl_frequency / |speed|.
    direction : float or None [1]
        As in `RotorModes`.
    reason : str
        Empty, or why there is no threshold.
    """

    speed: float | None = None
    whirl_frequency: float | None = None
    whirl_ratio: float | None = None
    direction: float | None = None
    reason: str = ""


def log_decrement(eigenvalues: ArrayLike) -> Array:
    """Return -2 pi Re / |Im| of eigenvalues [1]."""
    values = np.asarray(eigenvalues)
    return np.asarray(-2.0 * np.pi * values.real / np.abs(values.imag))


def rotor_modes(rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speed: float) -> RotorModes:
    """Return the whirl modes of a rotor on its films at a speed.

    Motion that nothing holds, as that of a weightless rotor without bearings as a whole, is no whirl.

    Parameters
    ----------
    rotor : FlexibleRotor
        Its own speed is not used.
    bearings : mapping of str to Reaction
        By the name of the station; linearized at the equilibrium of this speed.
    speed : float [rad/s]
        Of either sign; a rotor at rest counts as turning about +z.

    Raises
    ------
    EquilibriumError
        If there is no equilibrium.
    """
    motions = _motions(rotor, bearings, speed)
    whirls = _oscillates(motions.eigenvalues)
    return RotorModes(
        speed=motions.speed,
        eigenvalues=motions.eigenvalues[whirls],
        shapes=motions.shapes[:, whirls],
        direction=motions.direction[whirls],
    )


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
        Modes that stay above it are left out.

    Raises
    ------
    InputError
        If the speeds break their rule.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    grid = _speeds_in_turn(speeds)
    points = [rotor_modes(rotor, bearings, float(speed)) for speed in grid]
    tracks = _tracks(points, rotor.structure.mass)
    values = np.full((len(tracks), len(grid)), complex(math.nan, math.nan))
    direction = np.full((len(tracks), len(grid)), math.nan)
    for row, track in enumerate(tracks):
        for column, k in track.items():
            values[row, column] = points[column].eigenvalues[k]
            direction[row, column] = points[column].direction[k]
    lowest = np.nanmin(np.abs(values.imag), axis=1) if len(tracks) else np.zeros(0)
    order = [k for k in np.argsort(lowest) if lowest[k] <= highest_frequency]
    return Campbell(speeds=grid, eigenvalues=values[order], direction=direction[order])


def critical_speeds(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: ArrayLike
) -> tuple[CriticalSpeed, ...]:
    """Return the damped critical speeds, rising: where a whirl has the frequency of the rotation.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling, of either sign: the range searched, and the steps in which the modes are followed.
    """
    chart = campbell(rotor, bearings, speeds)
    found = []
    for values in chart.eigenvalues:
        lead = values.imag - np.abs(chart.speeds)
        for k in np.flatnonzero(lead[:-1] * lead[1:] <= 0.0):
            found.append(_crossing(rotor, bearings, chart.speeds[k : k + 2], values[k : k + 2]))
    return tuple(sorted(found, key=lambda one: one.speed))


def rotor_threshold(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: ArrayLike
) -> RotorThreshold:
    """Return the first of a range of speeds at which a rotor on its films loses stability.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling, of either sign, searched in this order; stability lost and regained within one step
        goes unseen.

    Notes
    -----
    Whirl that grows and divergence, a real eigenvalue above zero, both end stability.
    """
    grid = _speeds_in_turn(speeds)
    before = float(grid[0])
    growth = _growth(_motions(rotor, bearings, before)).max(initial=-1.0)
    if growth > NEUTRAL:
        return RotorThreshold(reason="unstable at the first speed given")
    for speed in grid[1:].tolist():
        # whirl that nothing damps or drives has roundoff of either sign
        level = 0.0 if growth < 0.0 else NEUTRAL
        growth = _growth(_motions(rotor, bearings, speed)).max(initial=-1.0)
        if growth > NEUTRAL:
            return _onset(rotor, bearings, (before, speed), level)
        before = speed
    return RotorThreshold(reason="stable at every speed given")


def _speeds_in_turn(speeds: ArrayLike) -> Array:
    """Return angular speeds [rad/s]; raise InputError unless they rise or fall throughout."""
    grid = require_finite("speeds", speeds)
    steps = np.diff(grid) if grid.ndim == 1 else np.zeros(1)
    if not grid.size or not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        raise InputError(f"speeds must be a list of rising or of falling numbers, got {speeds!r}")
    return grid


def _growth(motions: RotorModes) -> Array:
    """Return Re s / |s| of whirls; without whirl Re s / (|s| + |speed|), which divergence takes through 0."""
    values = motions.eigenvalues
    size = np.abs(values) + np.where(_oscillates(values), 0.0, abs(motions.speed))
    return np.asarray(values.real / size)


def _onset(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], ends: tuple[float, float], level: float
) -> RotorThreshold:
    """Return the threshold between two speeds, where the growth is at a level."""
    speed = float(
        brentq(lambda w: _growth(_motions(rotor, bearings, w)).max(initial=-1.0) - level, *ends, rtol=1e-13)
    )
    motions = _motions(rotor, bearings, speed)
    k = int(np.argmax(_growth(motions)))
    frequency = float(motions.frequency[k]) if _oscillates(motions.eigenvalues)[k] else 0.0
    return RotorThreshold(
        speed=speed,
        whirl_frequency=frequency,
        whirl_ratio=frequency / abs(speed),
        direction=float(motions.direction[k]),
    )


def critical_speed_map(rotor: FlexibleRotor, stiffness: ArrayLike, count: int = 4) -> Array:
    """Return undamped critical speeds over the stiffness of equal isotropic bearings.

    Parameters
    ----------
    rotor : FlexibleRotor
        Every station gets the same bearing; damping of rotor and supports is left out.
    stiffness : array_like, shape (n,) [N/m]
        Positive.
    count : int
        Number of critical speeds of forward whirl, from the lowest.

    Returns
    -------
    ndarray, shape (count, n) [rad/s]
        nan where the rotor has fewer.

    Notes
    -----
    Synchronous motion has K q = w^2 (M - i G) q with Hermitian matrices, whatever the speed; forward whirl
    of an isotropic rotor is q = (u, -i u), where -i G of both planes is the polar inertia.
    """
    grid = require_finite("stiffness", stiffness)
    if grid.ndim != 1 or np.any(grid <= 0.0):
        raise InputError(f"stiffness must be a list of positive numbers, got {stiffness!r}")
    s = rotor.structure
    n = len(s.coordinates)
    forward = np.vstack([np.eye(n), -1j * np.eye(n)]) * math.sqrt(0.5)
    inertia = (forward.conj().T @ (s.mass - 1j * s.gyroscopic) @ forward).real
    result = np.full((count, len(grid)), math.nan)
    for column, spring in enumerate(grid):
        whole = s.stiffness + spring * s.journals.T @ s.journals
        held = forward.conj().T @ (0.5 * (whole + whole.T)) @ forward
        # K is positive, M - i G need not be: a thin disk has no forward critical speed of tilt
        inverse = eigh(inertia, held, eigvals_only=True)[::-1]
        speeds = 1.0 / np.sqrt(inverse[inverse > 1e-12 * np.abs(inverse).max()][:count])
        result[: len(speeds), column] = speeds
    return result


def _motions(rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speed: float) -> RotorModes:
    """Return the whirl modes at a speed, and before them the motions that do not oscillate."""
    at = rotor_equilibrium(rotor, bearings, speed)
    structure = rotor.structure
    values, shapes = _whirls(structure, second_order(structure, at), at.speed)
    n = len(structure.coordinates)
    mass = structure.mass[:n, :n]
    turned = [shapes[:n] + sign * 1j * shapes[n:] for sign in (1.0, -1.0)]
    forward, backward = (np.einsum("ik,ij,jk->k", u.conj(), mass, u).real for u in turned)
    sense = -1.0 if at.speed < 0.0 else 1.0
    return RotorModes(
        speed=at.speed,
        eigenvalues=values,
        shapes=shapes,
        direction=sense * (forward - backward) / (forward + backward),
    )


def _oscillates(values: NDArray[np.complex128]) -> NDArray[np.bool_]:
    return np.asarray(values.imag > _OSCILLATES * np.abs(values))


def _whirls(
    structure: Structure, system: SecondOrder, speed: float
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Return the eigenvalues that do not oscillate, those that do, rising, and the shapes of all."""
    if structure.hysteresis is None:
        return _eigen(system, 0.0, math.inf)
    turn = abs(speed)
    slow = _eigen(with_hysteresis(structure, system, 0.5 * turn, speed), 0.0, turn)
    fast = _eigen(with_hysteresis(structure, system, 2.0 * turn + 1.0, speed), turn, math.inf)
    return np.concatenate([slow[0], fast[0]]), np.hstack([slow[1], fast[1]])


def _eigen(
    system: SecondOrder, low: float, high: float
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Return eigenvalues of low <= Im s < high, rising, and shapes; not of motion that nothing holds."""
    values, vectors = np.linalg.eig(system.state_matrix())
    shapes = vectors[: len(system.mass)]
    size = np.abs(values)
    inertia, damping = (np.linalg.norm(m @ shapes, axis=0) for m in (system.mass, system.damping))
    held = np.linalg.norm(np.abs(system.stiffness) @ np.abs(shapes), axis=0)
    moves = size * (size * inertia + damping) > _HELD * held
    chosen = moves & (values.imag >= low) & (values.imag < high)
    order = np.flatnonzero(chosen)[np.argsort(values.imag[chosen])]
    return values[order].astype(complex), shapes[:, order].astype(complex)


def _tracks(points: list[RotorModes], mass: Array) -> list[dict[int, int]]:
    """Return, for each mode, its index among the modes of each speed at which it was found."""
    tracks: list[dict[int, int]] = [{0: k} for k in range(len(points[0].eigenvalues))]
    current = list(range(len(tracks)))
    for column in range(1, len(points)):
        before, after = points[column - 1], points[column]
        partner = _matches(before, after, mass)
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


def _matches(before: RotorModes, after: RotorModes, mass: Array) -> dict[int, int]:
    """Return the mode of `before` that each mode of `after` continues, by eigenvalue and shape."""
    if not (before.eigenvalues.size and after.eigenvalues.size):
        return {}
    product = np.abs(before.shapes.conj().T @ mass @ after.shapes) ** 2
    sizes = [np.einsum("ik,ij,jk->k", m.shapes.conj(), mass, m.shapes).real for m in (before, after)]
    likeness = product / np.outer(*sizes)
    scale = np.abs(before.eigenvalues)[:, None] + np.abs(after.eigenvalues)
    apart = np.abs(before.eigenvalues[:, None] - after.eigenvalues) / scale
    cost = apart + 0.2 * (1.0 - likeness)
    rows, columns = linear_sum_assignment(cost)
    return {int(c): int(r) for r, c in zip(rows, columns, strict=True) if apart[r, c] < 0.5}


def _crossing(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], ends: Array, values: NDArray[np.complex128]
) -> CriticalSpeed:
    """Return the critical speed between two speeds at which a mode has these eigenvalues."""

    def nearest(speed: float) -> tuple[RotorModes, int]:
        share = (speed - ends[0]) / (ends[1] - ends[0])
        modes = rotor_modes(rotor, bearings, speed)
        expected = (1.0 - share) * values[0] + share * values[1]
        return modes, int(np.argmin(np.abs(modes.eigenvalues - expected)))

    def lead(speed: float) -> float:
        modes, k = nearest(speed)
        return float(modes.frequency[k]) - abs(speed)

    speed = float(brentq(lead, float(ends[0]), float(ends[1]), rtol=1e-12))
    modes, k = nearest(speed)
    return CriticalSpeed(
        speed=speed,
        log_decrement=float(modes.log_decrement[k]),
        direction=float(modes.direction[k]),
    )
