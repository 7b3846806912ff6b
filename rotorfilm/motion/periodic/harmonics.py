"""Real Fourier series over one period: a_0, a_1 ... a_H of the cosines, b_1 ... b_H of the sines.

A series has the shape (rows, 2 H + 1), its harmonics as amplitudes the shape (H + 1, rows): harmonic k is the
real part of amplitude exp(i k phi).
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ...model import Array

Complex = np.ndarray


class HarmonicBasis(NamedTuple):
    """Series to samples and back.

    Attributes
    ----------
    values, slopes : ndarray, shape (n_samples, 2 H + 1)
        Cosines and sines, and their derivatives by the phase.
    back : ndarray, shape (2 H + 1, n_samples)
    """

    values: Array
    slopes: Array
    back: Array


@lru_cache(maxsize=32)
def basis(harmonics: int, samples: int) -> HarmonicBasis:
    """Return the series at equal distance in the phase."""
    values, slopes = series_rows(harmonics, 2.0 * np.pi * np.arange(samples) / samples)
    back = values.T * (2.0 / samples)
    back[0] *= 0.5
    return HarmonicBasis(values, slopes, back)


def series_rows(harmonics: int, phase: Array) -> tuple[Array, Array]:
    """Return cosines and sines, and their derivatives, at phases (n,): each (n, 2 H + 1)."""
    order = np.arange(1, harmonics + 1)
    angle = phase[:, None] * order
    cos, sin = np.cos(angle), np.sin(angle)
    values = np.hstack([np.ones((len(phase), 1)), cos, sin])
    slopes = np.hstack([np.zeros((len(phase), 1)), -order * sin, order * cos])
    return values, slopes


def resized(series: Array, harmonics: int) -> Array:
    """Return a series with another number of harmonics."""
    old = series.shape[1] // 2
    kept = min(old, harmonics)
    out = np.zeros((len(series), 2 * harmonics + 1))
    out[:, : kept + 1] = series[:, : kept + 1]
    out[:, harmonics + 1 : harmonics + 1 + kept] = series[:, old + 1 : old + 1 + kept]
    return out


def rms(series: Array) -> float:
    """Return the root of the mean over a period of the squares of all rows together."""
    return math.sqrt(float(np.sum(series[:, 0] ** 2) + 0.5 * np.sum(series[:, 1:] ** 2)))


def first_wave(series: Array) -> Complex:
    """Return the first harmonic (rows,): the series is Re(wave exp(i phi)) and others."""
    harmonics = series.shape[1] // 2
    return series[:, 1] - 1j * series[:, harmonics + 1]


def circles(wave: Complex) -> tuple[complex, complex]:
    """Return the parts of a first harmonic (x, y) that turn with the phase and against it."""
    with_it = 0.5 * (wave[0] + 1j * wave[1])
    against = 0.5 * (np.conj(wave[0]) + 1j * np.conj(wave[1]))
    return complex(with_it), complex(against)


def constant(rest: Array, harmonics: int) -> Array:
    """Return the series of constants (rows,)."""
    series = np.zeros((len(rest), 2 * harmonics + 1))
    series[:, 0] = rest
    return series


def with_wave(rest: Array, wave: Complex, harmonics: int, order: int = 1) -> Array:
    """Return the series of constants (rows,) and the amplitude (rows,) of one harmonic."""
    series = constant(rest, harmonics)
    series[:, order], series[:, harmonics + order] = wave.real, -wave.imag
    return series


def apply(answer: Complex, spectrum: Array) -> Array:
    """Return the series of R_k F_k for a real series F (rows, 2 H + 1)."""
    harmonics = len(answer) - 1
    amplitude = spectrum[:, : harmonics + 1].astype(complex).T
    amplitude[1:] -= 1j * spectrum[:, harmonics + 1 :].T
    return real_rows(answer @ amplitude[:, :, None])[:, :, 0]


def slope_columns(stiffness: Array, damping: Array, harmonics: int) -> Complex:
    """Return the amplitudes of stiffness * s + damping * s', s being each term of a series in turn.

    Parameters
    ----------
    stiffness, damping : ndarray, shape (2, samples)
        Over the orbit.

    Returns
    -------
    ndarray of complex, shape (H + 1, 2, 2 H + 1)
        Amplitude of harmonic k of both rows per term. A product with cos(l phi) moves harmonics by l up and
        down, so they are sums and differences of the coefficients of k - l and k + l; beyond what the samples
        tell apart these fall back on lower ones, as the products themselves do.
    """
    samples = stiffness.shape[1]
    order = np.arange(harmonics + 1)
    down, up = (order[:, None] - order) % samples, order[:, None] + order
    cosines, sines = [], []
    for coefficients in (np.fft.fft(stiffness) / samples, np.fft.fft(damping) / samples):
        lower, upper = coefficients[:, down], coefficients[:, up % samples]
        cosines.append(lower + upper)
        sines.append(-1j * (lower - upper))
    by_cos = cosines[0] - order * sines[1]
    by_sin = sines[0] + order * cosines[1]
    columns = np.concatenate([by_cos, by_sin[:, :, 1:]], axis=2)
    columns[:, 0] *= 0.5
    return columns.swapaxes(0, 1)


def real_rows(amplitudes: Complex) -> Array:
    """Return the series (rows, 2 H + 1, columns) of amplitudes (H + 1, rows, columns)."""
    rows = np.concatenate([amplitudes.real, -amplitudes.imag[1:]])
    return np.asarray(rows.swapaxes(0, 1))
