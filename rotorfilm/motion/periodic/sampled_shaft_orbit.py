"""The synchronous orbit of a flexible rotor: journals at samples over a turn, the shaft by harmonics.

With K0 and C0, the films' stiffness and damping at rest, and the displacements p of all journals,

    p = R * (F(p, p') + K0 p + C0 p') + e,

where R answers each harmonic by the dynamic stiffness of shaft, K0 and C0 together, and e answers weight
and unbalance. What stands in the brackets varies over a turn only as far as the films are not linear.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ...errors import ConvergenceError
from ...linear import RotorEquilibrium
from ...linear.rotor_system import second_order, with_hysteresis
from ...model import Array, Reaction
from ...rotors.structure import NOMINAL_LENGTH, Structure
from .sampled_orbit import rate_matrix

TOLERANCE = 1e-11
"""Residual at which Newton's method ends, in clearances."""

STEPS = 30


class ShaftAnswers(NamedTuple):
    """What a rotor on K0 and C0 answers over a turn.

    Attributes
    ----------
    stations : tuple of str
    speed : float [rad/s]
        Signed.
    samples : int
        Odd.
    journals : ndarray of complex, shape (H + 1, 2 m, 2 m)
        Displacement of the m journals per force on them.
    external : ndarray of complex, shape (2, 2 m)
        The same under weight, and under the unbalance in the first harmonic.
    probes : dict of str to (ndarray, ndarray), shapes (2, 2 m) and (2,)
        Displacement of each probe in the first harmonic per force on the journals, and under the unbalance.
    stiffness, damping : ndarray, shape (2 m, 2 m)
        K0 and C0.
    """

    stations: tuple[str, ...]
    speed: float
    samples: int
    journals: np.ndarray
    external: np.ndarray
    probes: dict[str, tuple[np.ndarray, np.ndarray]]
    stiffness: Array
    damping: Array


def shaft_answers(
    structure: Structure, at: RotorEquilibrium, probes: Sequence[str], samples: int
) -> ShaftAnswers:
    """Return what a rotor answers about an equilibrium, at the harmonics of so many samples."""
    speed, rows = at.speed, structure.journals
    system, turn = second_order(structure, at), abs(at.speed)
    # (cos, sin) of the angle are the real parts of (1, -i) exp(i w t); turning backward mirrors it.
    turning = speed**2 * structure.unbalance @ np.array([1.0, -1.0j * np.sign(speed)])
    answers, external, seen = [], np.zeros((2, len(rows)), dtype=complex), {}
    own = {readout.signal.name: readout.row[: len(structure.weight)] for readout in structure.readouts}
    for k in range(samples // 2 + 1):
        whole = with_hysteresis(structure, system, k * turn, speed).dynamic_stiffness(k * turn)
        load = structure.weight if k == 0 else turning
        moved = np.linalg.solve(whole, np.column_stack([rows.T, load]) if k < 2 else rows.T)
        answers.append(rows @ moved[:, : len(rows)])
        if k < 2:
            # Weight is in balance with the films at rest, to which K0 adds its own.
            external[k] = rows @ moved[:, -1]
        if k == 1:
            for name in probes:
                pair = np.array([own[f"{name}_x"], own[f"{name}_y"]]) @ moved
                seen[name] = pair[:, :-1], pair[:, -1]
    stiffness, damping = (_films(structure, at, kind) for kind in ("stiffness", "damping"))
    return ShaftAnswers(
        structure.stations, speed, samples, np.array(answers), external, seen, stiffness, damping
    )


def _films(structure: Structure, at: RotorEquilibrium, kind: str) -> Array:
    whole = np.zeros((len(structure.journals),) * 2)
    for k, name in enumerate(structure.stations):
        whole[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] = getattr(at.coefficients[name], kind)
    return whole


@dataclass(frozen=True, kw_only=True)
class ShaftOrbit:
    """The journals of a rotor over one turn.

    Attributes
    ----------
    position, velocity : ndarray, shape (2 m, n) [m, m/s]
    excess : ndarray of complex, shape (2 m,) [N]
        First harmonic of F + K0 p + C0 p'.
    """

    position: Array
    velocity: Array
    excess: np.ndarray

    @property
    def size(self) -> float:
        """Norm of all positions [m]."""
        return float(np.linalg.norm(self.position))

    def resampled(self, n: int) -> ShaftOrbit:
        """Return it at n samples, by its Fourier series."""
        return replace(self, position=_resampled(self.position, n), velocity=_resampled(self.velocity, n))


def _resampled(series: Array, n: int) -> Array:
    old = series.shape[1]
    waves = np.fft.rfft(series, axis=1)
    kept = np.zeros((len(series), n // 2 + 1), dtype=complex)
    low = (min(old, n) + 1) // 2
    kept[:, :low] = waves[:, :low]
    return np.asarray(np.fft.irfft(kept, n, axis=1) * (n / old))


def wave_of(series: Array) -> np.ndarray:
    """Return the first harmonic (2 m,): the series is Re(wave exp(i angle)) and others."""
    return np.asarray(np.fft.fft(series, axis=1)[:, 1] * (2.0 / series.shape[1]))


def linear_shaft_orbit(answers: ShaftAnswers, at: RotorEquilibrium) -> ShaftOrbit:
    """Return the orbit about an equilibrium by K0 and C0 alone."""
    n, turn = answers.samples, abs(answers.speed)
    rest = np.concatenate([at.coefficients[name].position for name in answers.stations])
    turned = answers.external[1][:, None] * np.exp(2j * np.pi * np.arange(n) / n)
    return ShaftOrbit(
        position=rest[:, None] + turned.real,
        velocity=(1j * turn * turned).real,
        excess=np.zeros(len(rest), dtype=complex),
    )


class ShaftDefect(NamedTuple):
    """What the equations of an orbit lack.

    Attributes
    ----------
    missing : ndarray, shape (2 m, n) [m]
        R * (F + K0 p + C0 p') + e - p.
    slope : ndarray, shape (2 m n, 2 m n)
        d(F + K0 p + C0 p')/dp over all samples [N/m].
    excess : ndarray, shape (2 m, n) [N]
        F + K0 p + C0 p'.
    forces : ndarray, shape (2 m, n) [N]
        F.
    """

    missing: Array
    slope: Array
    excess: Array
    forces: Array


def shaft_forces(answers: ShaftAnswers, bearings: Mapping[str, Reaction], orbit: ShaftOrbit) -> Array:
    """Return the forces of bearings on their journals along an orbit, shape (2 m, n) [N]."""
    p, v, speeds = orbit.position, orbit.velocity, np.full(answers.samples, answers.speed)
    pairs = [slice(2 * k, 2 * k + 2) for k in range(len(answers.stations))]
    return np.concatenate(
        [bearings[name].force(p[at], v[at], speeds) for name, at in zip(answers.stations, pairs, strict=True)]
    )


def shaft_defect(
    answers: ShaftAnswers, bearings: Mapping[str, Reaction], orbit: ShaftOrbit, part: float = 1.0
) -> ShaftDefect:
    """Return what an orbit lacks with these bearings, under a part of the unbalance."""
    p, v, n = orbit.position, orbit.velocity, answers.samples
    forces = shaft_forces(answers, bearings, orbit)
    excess = forces + answers.stiffness @ p + answers.damping @ v
    rate = abs(answers.speed) * rate_matrix(n)
    slope = np.zeros((len(p), n, len(p), n))
    speeds = np.full(n, answers.speed)
    spots = np.arange(n)
    for k, name in enumerate(answers.stations):
        pair = slice(2 * k, 2 * k + 2)
        tangent = bearings[name].jacobian(p[pair], v[pair], speeds)
        for i in range(2):
            for j in range(2):
                row, column = 2 * k + i, 2 * k + j
                damped = tangent[i, 2 + j] + answers.damping[row, column]
                slope[row, :, column, :] = damped[:, None] * rate
                slope[row, spots, column, spots] += tangent[i, j] + answers.stiffness[row, column]
    waves = np.fft.rfft(excess, axis=1).T
    moved = (answers.journals @ waves[:, :, None])[:, :, 0]
    moved[0] += n * answers.external[0].real
    moved[1] += part * 0.5 * n * answers.external[1]
    missing = np.fft.irfft(moved.T, n, axis=1) - p
    return ShaftDefect(missing, slope.reshape(p.size, p.size), excess, forces)


def moved_by(answers: ShaftAnswers, missing: Array, slope: Array) -> Array:
    """Return the change of position (2 m, n) [m] that makes up for what is missing, to first order."""
    size, n = len(missing), answers.samples
    columns = np.fft.irfft(np.moveaxis(answers.journals, 0, -1), n, axis=-1)
    turned = columns[:, :, (np.arange(n)[:, None] - np.arange(n)) % n]
    operator = np.moveaxis(turned, 1, 2).reshape(size * n, size * n)
    matrix = np.eye(size * n) - operator @ slope
    return np.asarray(np.linalg.solve(matrix, missing.ravel()).reshape(size, n))


def nonlinear_shaft_orbit(
    answers: ShaftAnswers, bearings: Mapping[str, Reaction], start: ShaftOrbit, part: float = 1.0
) -> tuple[ShaftOrbit, int]:
    """Return the orbit that meets the equations at all samples, and how many Newton steps that took.

    Raises
    ------
    ConvergenceError
        If Newton's method does not end.
    """
    orbit = start.resampled(answers.samples)
    rate = abs(answers.speed) * rate_matrix(answers.samples)
    lengths = journal_lengths(answers, bearings)
    for step in range(1, STEPS + 1):
        lack = shaft_defect(answers, bearings, orbit, part)
        change = moved_by(answers, lack.missing, lack.slope)
        size = float(np.max(np.abs(change) / lengths[:, None]))
        share = _inside(orbit.position, change, answers, bearings)
        position = orbit.position + share * change
        excess = lack.excess + share * (lack.slope @ change.ravel()).reshape(change.shape)
        orbit = ShaftOrbit(position=position, velocity=position @ rate.T, excess=wave_of(excess))
        if size < TOLERANCE:
            return orbit, step
    raise ConvergenceError(
        f"orbit at {answers.samples} samples must settle to {TOLERANCE:g} clearances, got {size:.3g}"
    )


def journal_lengths(answers: ShaftAnswers, bearings: Mapping[str, Reaction]) -> Array:
    """Return the clearance of each journal, shape (2 m,) [m]; a nominal length where there is none."""
    sizes = np.array([bearings[name].clearance for name in answers.stations])
    return np.repeat(np.where(np.isfinite(sizes), sizes, NOMINAL_LENGTH), 2)


def reach_of(orbit: ShaftOrbit, stations: Sequence[str], bearings: Mapping[str, Reaction]) -> float:
    """Return the largest distance of a journal from the center of its bearing / clearance."""
    return max(
        float(np.hypot(*orbit.position[2 * k : 2 * k + 2]).max()) / bearings[name].clearance
        for k, name in enumerate(stations)
    )


def _inside(position: Array, change: Array, answers: ShaftAnswers, bearings: Mapping[str, Reaction]) -> float:
    """Return the part of a change that takes no journal further than most of the way to its wall."""
    share = 1.0
    for k, name in enumerate(answers.stations):
        pair, clearance = slice(2 * k, 2 * k + 2), bearings[name].clearance
        gap = clearance - np.hypot(*position[pair])
        while share > 1e-6 and np.any(
            clearance - np.hypot(*(position[pair] + share * change[pair])) < 0.3 * gap
        ):
            share *= 0.5
    return share
