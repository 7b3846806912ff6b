"""Harmonic balance of the journals: the equations of a periodic orbit, with exact derivatives.

Each journal's displacement is a Fourier series in the phase of the orbit, phi = nu t. The rotor answers the
harmonics of the film forces exactly, so the unknowns are the journals' series alone, however many coordinates
the rotor has:

    p_k - R_k(nu) F_k(p) - e_k = 0,

with the films' forces F sampled over the orbit, to which the springs and dampers that R_k rests on are added;
e_k is the answer to the unbalance, in harmonic `periods`, and the rest under weight in harmonic 0. At as many
samples as the series has terms this is collocation: the equations of motion hold at every sample.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, NamedTuple, Protocol, Self, TypeVar

import numpy as np

from ...model import Array
from ...rotors.structure import NOMINAL_LENGTH
from .harmonics import Complex, HarmonicBasis, apply, basis, real_rows, slope_columns

OVERSAMPLING = 4
"""Samples over an orbit per harmonic."""


class Receptance(NamedTuple):
    """What the journals of a rotor answer to the harmonics of forces on them.

    Attributes
    ----------
    values : ndarray of complex, shape (H + 1, 2 n_bearings, 2 n_bearings)
    rates : ndarray of complex, of the same shape, or None
        Derivative by the frequency; None of a rotor that is known at one frequency.
    """

    values: Complex
    rates: Complex | None


class HarmonicRotor(Protocol):
    """A rotor in its films as the equations of an orbit see it."""

    @property
    def clearances(self) -> Array:
        """Of the bearings, shape (n_bearings,) [m]; infinite where there is none."""

    @property
    def speed(self) -> float:
        """Angular speed of the shaft [rad/s]."""

    def receptance(self, harmonics: int, frequency: float) -> Receptance:
        """Return what the journals answer, on the springs that `forces` adds."""

    def external(self, harmonics: int, periods: int, frequency: float) -> Array:
        """Return the series of the answer to weight, and to the unbalance if `periods` is not 0."""

    def forces(self, position: Array, velocity: Array) -> Array:
        """Return the forces of films and springs, (2 n, samples).

        Raises FilmContactError if a journal leaves its bearing.
        """

    def tangents(self, position: Array, velocity: Array) -> tuple[Array, Array, Array]:
        """Return the forces and their slopes by each bearing's own motion, (2 n, 2, samples) each."""

    def loaded(self, part: float) -> Self:
        """Return the same under a part of the unbalance."""


R = TypeVar("R", bound=HarmonicRotor)


@dataclass(frozen=True, eq=False)
class Residual:
    """The equations at a series.

    Attributes
    ----------
    values : ndarray, shape (2 n_bearings (2 H + 1),) [1]
        In clearances.
    by_frequency : ndarray [s/rad]
        Derivatives by the frequency of free whirl; empty where the unbalance drives.
    derive : callable
        Makes the derivatives by the series.
    """

    values: Array
    by_frequency: Array
    derive: Callable[[], Array]

    @cached_property
    def by_series(self) -> Array:
        """The derivatives by the series: made when they are asked for, not of a series that needs no step."""
        return self.derive()


class Balance(NamedTuple, Generic[R]):
    """The equations of the periodic orbits of a rotor at one speed.

    Attributes
    ----------
    rotor : HarmonicRotor
    harmonics : int
    periods : int
        Turns of the shaft per orbit; 0 for an orbit that the unbalance does not drive.
    collocated : bool
        Whether forces are sampled as often as the series has terms, rather than so often that their
        harmonics are those of the exact forces.
    """

    rotor: R
    harmonics: int
    periods: int
    collocated: bool = False

    @property
    def samples(self) -> int:
        """Samples over an orbit: of exact harmonics a power of two, for the sake of symmetry."""
        terms = 2 * self.harmonics + 1
        return terms if self.collocated else int(2 ** np.ceil(np.log2(OVERSAMPLING * terms / 2.0 + 8)))

    @property
    def basis(self) -> HarmonicBasis:
        """The series at the samples."""
        return basis(self.harmonics, self.samples)

    @property
    def units(self) -> Array:
        """Clearance of each row of the series, shape (2 n_bearings,) [m]; a nominal length without one."""
        sizes = self.rotor.clearances
        return np.repeat(np.where(np.isfinite(sizes), sizes, NOMINAL_LENGTH), 2)

    @property
    def frequency(self) -> float:
        """Of an orbit that the unbalance drives [rad/s]."""
        return abs(self.rotor.speed) / self.periods

    def residual(self, series: Array, frequency: float) -> Residual:
        """Return the equations, in clearances, and their derivatives by the series in clearances.

        Raises
        ------
        FilmContactError
            If a journal leaves its bearing.
        """
        units = self.units
        force, stiffness, damping = self.rotor.tangents(*self._motion(series, frequency))
        answer = self.rotor.receptance(self.harmonics, frequency)
        spectrum = force @ self.basis.back.T
        value = series - apply(answer.values, spectrum) - self._external(frequency)
        by_frequency = np.zeros(0)
        if not self.periods and answer.rates is not None:
            turned = np.einsum("ijn,ijn->in", damping, _pairs(series @ self.basis.slopes.T))
            change = apply(answer.rates, spectrum) + apply(answer.values, turned @ self.basis.back.T)
            by_frequency = (-change / units[:, None]).ravel()

        def by_series() -> Array:
            return self._derivatives(answer.values, stiffness, frequency * damping)

        return Residual((value / units[:, None]).ravel(), by_frequency, by_series)

    def _derivatives(self, answer: Complex, stiffness: Array, damping: Array) -> Array:
        """Return the derivatives by the series, in clearances; the damping by the rate over the phase."""
        units, terms = self.units, 2 * self.harmonics + 1
        rows = len(units)
        by_series = np.empty((rows, terms, rows, terms))
        for j in range(rows):
            pair = slice(j - j % 2, j - j % 2 + 2)
            columns = slope_columns(stiffness[pair, j % 2], damping[pair, j % 2], self.harmonics)
            moved = real_rows(answer[:, :, pair] @ columns)
            by_series[:, :, j, :] = (-units[j] / units)[:, None, None] * moved
        flat = by_series.reshape(rows * terms, rows * terms)
        flat[np.arange(rows * terms), np.arange(rows * terms)] += 1.0
        return flat

    def values(self, series: Array, frequency: float) -> Array:
        """Return the equations alone, in clearances; FilmContactError as in `residual`."""
        spectrum = self.rotor.forces(*self._motion(series, frequency)) @ self.basis.back.T
        answered = apply(self.rotor.receptance(self.harmonics, frequency).values, spectrum)
        missing = series - answered - self._external(frequency)
        return np.asarray((missing / self.units[:, None]).ravel())

    def in_length(self, change: Array) -> Array:
        """Return a change of the series, in clearances and one after the other, as a series [m]."""
        return change.reshape(len(self.units), -1) * self.units[:, None]

    def gaps(self, series: Array) -> Array:
        """Return the clearance left to each journal at the samples, shape (n_bearings, samples) [m]."""
        position = (series @ self.basis.values.T).reshape(-1, 2, self.samples)
        return self.rotor.clearances[:, None] - np.hypot(position[:, 0], position[:, 1])

    def _motion(self, series: Array, frequency: float) -> tuple[Array, Array]:
        """Return positions and velocities at the samples, (2 n, samples) each."""
        return series @ self.basis.values.T, frequency * (series @ self.basis.slopes.T)

    def _external(self, frequency: float) -> Array:
        return self.rotor.external(self.harmonics, self.periods, frequency)


def _pairs(rows: Array) -> Array:
    """Return, for each row, both rows of its bearing: (2 n, samples) to (2 n, 2, samples)."""
    return np.repeat(rows.reshape(-1, 2, rows.shape[1]), 2, axis=0)
