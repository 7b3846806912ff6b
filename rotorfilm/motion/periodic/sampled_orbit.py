"""The synchronous orbit of a rigid rotor on one journal film, by collocation over a turn."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ...errors import ConvergenceError
from ...model import Array, Reaction
from ...rotors import RigidRotor

TOLERANCE = 1e-11
"""Residual at which Newton's method ends, in clearances."""

STEPS = 30


@dataclass(frozen=True, kw_only=True)
class SampledOrbit:
    """A periodic orbit at equal distance over one turn.

    Attributes
    ----------
    position, velocity : ndarray, shape (2, n) [m, m/s]
    """

    position: Array
    velocity: Array


@lru_cache(maxsize=16)
def rate_matrix(n: int) -> Array:
    """Return the derivative by the angle of the series through n samples, n odd.

    Of an even number the highest cosine has no derivative, hence no inertia, and answers like a spring.
    """
    order = np.fft.fftfreq(n, 1.0 / n)
    waves = np.fft.fft(np.eye(n), axis=0)
    return np.real(np.fft.ifft(1j * order[:, None] * waves, axis=0))


def pull(rotor: RigidRotor, n: int) -> Array:
    """Return static load and unbalance force at n samples over a turn, shape (2, n) [N]."""
    speed = rotor.profile.speeds[0]
    angle = math.copysign(1.0, speed) * 2.0 * np.pi * np.arange(n) / n + rotor.unbalance_angle
    turning = rotor.unbalance * speed**2 * np.array([np.cos(angle), np.sin(angle)])
    return np.asarray(rotor.static_load[:, None] + turning)


def linear_orbit(rotor: RigidRotor, rest: Array, stiffness: Array, damping: Array, n: int) -> SampledOrbit:
    """Return the orbit about a rest position (2,) [m] of a rotor on constant K and C, at n samples."""
    speed = abs(rotor.profile.speeds[0])
    force = np.fft.fft(pull(rotor, n), axis=1)[:, 1] * (2.0 / n)
    dynamic = stiffness + 1j * speed * damping - rotor.mass * speed**2 * np.eye(2)
    wave = np.linalg.solve(dynamic, force)
    turned = wave[:, None] * np.exp(2j * np.pi * np.arange(n) / n)
    return SampledOrbit(position=rest[:, None] + turned.real, velocity=(1j * speed * turned).real)


def resampled(orbit: SampledOrbit, n: int) -> SampledOrbit:
    """Return an orbit at n samples, by its Fourier series."""
    return SampledOrbit(position=_resampled(orbit.position, n), velocity=_resampled(orbit.velocity, n))


def _resampled(series: Array, n: int) -> Array:
    old = series.shape[1]
    waves = np.fft.rfft(series, axis=1)
    kept = np.zeros((2, n // 2 + 1), dtype=complex)
    low = (min(old, n) + 1) // 2
    kept[:, :low] = waves[:, :low]
    return np.asarray(np.fft.irfft(kept, n, axis=1) * (n / old))


def defect(
    rotor: RigidRotor, orbit: SampledOrbit, reaction: Reaction, sloped: Reaction
) -> tuple[Array, Array, Array]:
    """Return what m a = F + load lacks at the samples (2, n) [N], and K and C (2, 2, n) of `sloped`."""
    n, signed = orbit.position.shape[1], rotor.profile.speeds[0]
    speeds = np.full(n, signed)
    force = reaction.force(orbit.position, orbit.velocity, speeds)
    slopes = sloped.jacobian(orbit.position, orbit.velocity, speeds)
    acceleration = abs(signed) * orbit.velocity @ rate_matrix(n).T
    return force + pull(rotor, n) - rotor.mass * acceleration, -slopes[:, :2], -slopes[:, 2:4]


def shift(rotor: RigidRotor, missing: Array, stiffness: Array, damping: Array) -> Array:
    """Return the change of position (2, n) [m] that a missing force (2, n) makes, K and C (2, 2, n) given."""
    n, speed = missing.shape[1], abs(rotor.profile.speeds[0])
    rate = speed * rate_matrix(n)
    one, acceleration = np.eye(n), rotor.mass * rate @ rate
    blocks = [
        [
            np.diag(stiffness[i, j]) + damping[i, j][:, None] * rate + (acceleration if i == j else 0.0 * one)
            for j in range(2)
        ]
        for i in range(2)
    ]
    return np.asarray(np.linalg.solve(np.block(blocks), missing.ravel()).reshape(2, n))


def nonlinear_orbit(rotor: RigidRotor, reaction: Reaction, start: SampledOrbit) -> tuple[SampledOrbit, int]:
    """Return the orbit that meets m a = F + load at all samples, and how often the film was sampled.

    Raises
    ------
    ConvergenceError
        If Newton's method does not end.
    """
    orbit, n = start, start.position.shape[1]
    rate = abs(rotor.profile.speeds[0]) * rate_matrix(n)
    for step in range(1, STEPS + 1):
        change = shift(rotor, *defect(rotor, orbit, reaction, reaction))
        size = float(np.max(np.hypot(*change))) / reaction.clearance
        share = _inside(orbit.position, change, reaction.clearance)
        position = orbit.position + share * change
        orbit = SampledOrbit(position=position, velocity=position @ rate.T)
        if size < TOLERANCE:
            return orbit, step * n
    raise ConvergenceError(f"orbit at {n} samples must settle to {TOLERANCE:g} clearances, got {size:.3g}")


def _inside(position: Array, change: Array, clearance: float) -> float:
    """Return the part of a change that takes no sample further than half of the way to the wall."""
    share = 1.0
    gap = clearance - np.hypot(*position)
    while share > 1e-6 and np.any(clearance - np.hypot(*(position + share * change)) < 0.3 * gap):
        share *= 0.5
    return share


def first_wave(position: Array) -> Array:
    """Return the first harmonic (2,) complex [m]: position = Re(wave exp(i angle))."""
    return np.asarray(np.fft.fft(position, axis=1)[:, 1] * (2.0 / position.shape[1]))


def circles(wave: Array) -> tuple[complex, complex]:
    """Return the parts of a first harmonic that turn with the angle and against it."""
    with_it = 0.5 * (wave[0] + 1j * wave[1])
    against = 0.5 * (np.conj(wave[0]) + 1j * np.conj(wave[1]))
    return complex(with_it), complex(against)
