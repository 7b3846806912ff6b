"""Harmonic balance of the journals: the equations of a periodic orbit, with exact derivatives.

Each journal's displacement is a Fourier series in the phase of the orbit, phi = nu t. The rotor answers the
harmonics of the film forces exactly (its modes are divided by i k nu - lambda), so the unknowns are the
journals' series alone, however many coordinates the rotor has:

    p_k - R_k(nu) F_k(p) - e_k = 0,    R_k = sense (i k nu - Lambda)^-1 push,

with the films' forces F (and the springs that `modal.py` adds and takes) sampled over the orbit; e_k is the
answer to the unbalance, in harmonic `periods`, and the rest under weight in harmonic 0. Series are real:
a_0, a_1 ... a_H of the cosines, b_1 ... b_H of the sines, shape (2 n_bearings, 2 H + 1).
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ...errors import FilmContactError
from ...model import Array
from ...native import Status
from ..compiled.journal_films import JournalFilms
from ..compiled.modal import Complex, ModalRotor

OVERSAMPLING = 4
"""Samples over an orbit per harmonic."""


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


class Residual(NamedTuple):
    """The equations at a series: their values, derivatives by the series and by the frequency."""

    values: Array
    by_series: Array
    by_frequency: Array


class Balance(NamedTuple):
    """The equations of the periodic orbits of a rotor at one speed.

    Attributes
    ----------
    modal : ModalRotor
    harmonics : int
    periods : int
        Turns of the shaft per orbit; 0 for an orbit that the unbalance does not drive.
    """

    modal: ModalRotor
    harmonics: int
    periods: int

    @property
    def samples(self) -> int:
        """Samples over an orbit: a power of two, for the sake of symmetry."""
        return int(2 ** np.ceil(np.log2(OVERSAMPLING * (2 * self.harmonics + 1) / 2.0 + 8)))

    @property
    def basis(self) -> HarmonicBasis:
        """The series at the samples."""
        return basis(self.harmonics, self.samples)

    @property
    def units(self) -> Array:
        """Clearance of each row of the series, shape (2 n_bearings,) [m]."""
        return np.repeat(self.modal.parts.lengths, 2)

    def residual(self, series: Array, frequency: float) -> Residual:
        """Return the equations, in clearances, and their derivatives by the series in clearances.

        Raises
        ------
        FilmContactError
            If a journal leaves its bearing.
        """
        rows, terms = series.shape
        force, stiffness, damping = self.forces(series, frequency)
        answer, answer_slope = self._receptance(frequency)
        external, external_slope = self._external(frequency)
        spectrum = force @ self.basis.back.T
        turned = np.einsum("ijn,ijn->in", damping, _pairs(series @ self.basis.slopes.T)) @ self.basis.back.T
        value = series - apply(answer, spectrum) - external
        by_frequency = -apply(answer_slope, spectrum) - apply(answer, turned) - external_slope
        relative = self.units[None, :] / self.units[:, None]
        by_series = np.empty((rows, terms, rows, terms))
        for j in range(rows):
            pair = slice(j - j % 2, j - j % 2 + 2)
            change = slope_columns(stiffness[pair, j % 2], frequency * damping[pair, j % 2], self.harmonics)
            by_series[:, :, j, :] = -relative[:, j, None, None] * _real_rows(answer[:, :, pair] @ change)
        size = rows * terms
        flat = by_series.reshape(size, size)
        flat[np.arange(size), np.arange(size)] += 1.0
        unit = 1.0 / self.units[:, None]
        return Residual((value * unit).ravel(), flat, (by_frequency * unit).ravel())

    def values(self, series: Array, frequency: float) -> Array:
        """Return the equations alone, in clearances; FilmContactError as in `residual`."""
        spectrum = self.forces(series, frequency)[0] @ self.basis.back.T
        answered = apply(self._receptance(frequency)[0], spectrum) + self._external(frequency)[0]
        return np.asarray(((series - answered) / self.units[:, None]).ravel())

    def forces(self, series: Array, frequency: float) -> tuple[Array, Array, Array]:
        """Return forces (2 n, samples) and slopes by each bearing's own motion, (2 n, 2, samples) each."""
        modal = self.modal
        position = series @ self.basis.values.T
        velocity = frequency * (series @ self.basis.slopes.T)
        return film_forces(modal, position, velocity)

    def _receptance(self, frequency: float) -> tuple[Complex, Complex]:
        """Return R_k and its derivative by the frequency, (H + 1, 2 n, 2 n) each."""
        modal, order = self.modal, np.arange(self.harmonics + 1)
        rows = modal.sense.reshape(-1, 4, len(modal.values))[:, :2].reshape(-1, len(modal.values))
        push = modal.push[:, :-2]
        return _answers(modal.values, rows, push, order, frequency)

    def _external(self, frequency: float) -> tuple[Array, Array]:
        """Return the answer to weight and unbalance, (2 n, 2 H + 1), and its derivative by the frequency."""
        modal = self.modal
        value = np.zeros((len(self.units), 2 * self.harmonics + 1))
        slope = np.zeros_like(value)
        value[:, 0] = modal.journal_rest.reshape(-1, 4)[:, :2].ravel()
        if self.periods:
            speed, k = modal.parts.speed, self.periods
            rows = modal.sense.reshape(-1, 4, len(modal.values))[:, :2].reshape(-1, len(modal.values))
            answer, change = _answers(modal.values, rows, modal.push[:, -2:], np.array([k]), frequency)
            # (cos p, sin p) is the real part of (1, -i) exp(i p); a shaft that turns backward mirrors it.
            pair = speed**2 * np.array([1.0, -1.0j * np.sign(speed)])
            for out, of in ((value, answer), (slope, change)):
                amplitude = of[0] @ pair
                out[:, k], out[:, self.harmonics + k] = amplitude.real, -amplitude.imag
        return value, slope


def _answers(
    values: Complex, rows: Complex, push: Complex, order: np.ndarray, frequency: float
) -> tuple[Complex, Complex]:
    """Return the journals' answers to real forces cos, i.e. with both of each pair of modes, and its slope.

    The state is the real part of the modes kept, twice each: the answer to exp(i w t) has half of it from
    each of the pair.
    """
    pole = 1.0 / (1j * frequency * order[:, None] - values)
    mirrored = 1.0 / (1j * frequency * order[:, None] - values.conj())
    answer = 0.5 * ((rows * pole[:, None]) @ push + (rows.conj() * mirrored[:, None]) @ push.conj())
    rate = -1j * order[:, None, None]
    slope = (
        0.5
        * rate
        * ((rows * (pole**2)[:, None]) @ push + (rows.conj() * (mirrored**2)[:, None]) @ push.conj())
    )
    return answer, slope


def film_forces(modal: ModalRotor, position: Array, velocity: Array) -> tuple[Array, Array, Array]:
    """Return the forces of films and springs (2 n, samples), their slopes by position and velocity.

    Raises
    ------
    FilmContactError
        If a journal leaves its bearing, or a force is not finite.
    """
    motion = np.concatenate(
        [position.reshape(-1, 2, position.shape[1]), velocity.reshape(-1, 2, position.shape[1])], axis=1
    )
    journals = JournalFilms.of_rotor(modal, absolute=True)
    status, force, slope = journals.forces(
        motion.reshape(-1, position.shape[1]), float(modal.parts.profile.speeds[0])
    )
    if status >= Status.CONTACT:
        raise FilmContactError("a journal leaves its bearing along the orbit")
    return force, slope[:, :2], slope[:, 2:]


def _pairs(rows: Array) -> Array:
    """Return, for each row, both rows of its bearing: (2 n, samples) to (2 n, 2, samples)."""
    return np.repeat(rows.reshape(-1, 2, rows.shape[1]), 2, axis=0)


def apply(answer: Complex, spectrum: Array) -> Array:
    """Return the series of R_k F_k for a real series F (2 n, 2 H + 1)."""
    harmonics = len(answer) - 1
    amplitude = spectrum[:, : harmonics + 1].astype(complex).T
    amplitude[1:] -= 1j * spectrum[:, harmonics + 1 :].T
    return _real_rows(answer @ amplitude[:, :, None])[:, :, 0]


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
        down, so they are sums and differences of the coefficients of k - l and k + l.
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


def _real_rows(amplitudes: Complex) -> Array:
    """Return the series (2 n, 2 H + 1, columns) of amplitudes (H + 1, 2 n, columns)."""
    rows = np.concatenate([amplitudes.real, -amplitudes.imag[1:]])
    return np.asarray(rows.swapaxes(0, 1))
