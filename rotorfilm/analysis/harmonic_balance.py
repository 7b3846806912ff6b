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

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, Generic, NamedTuple, Protocol, Self, TypeVar

import numpy as np

from ..core.errors import ConvergenceError, FilmContactError, InputError
from ..core.model import Array, Linearization
from ..core.results import Trajectory
from ..native import Status
from ..rotors import RigidRotor
from ..rotors.structure import NOMINAL_LENGTH
from .compiled_rotor import Complex, JournalFilms, ModalRotor
from .force_calls import raise_foreign

OVERSAMPLING = 4
"""Samples over an orbit per harmonic."""


Receptance = tuple[Complex, Complex | None]
"""What the rows of a rotor answer to the harmonics of forces on them, shape (H + 1, rows, rows), and its
derivative by the frequency; None of a rotor that is known at one frequency."""


class HarmonicRotor(Protocol):
    """A rotor in its films as the equations of an orbit see it.

    Its rows are the places of each bearing, x and y or more, and the states of the bearing behind them.
    """

    @property
    def blocks(self) -> Sequence[slice]:
        """The rows of each bearing."""

    @property
    def units(self) -> Array:
        """Size of each row, shape (rows,): the clearance of a displacement, nominal values of others."""

    def gaps(self, position: Array) -> Array:
        """Return the film left at samples (rows, samples), shape (n_bearings, samples) [m]; it may be inf."""

    @property
    def speed(self) -> float:
        """Angular speed of the shaft [rad/s]."""

    def receptance(self, harmonics: int, frequency: float) -> Receptance:
        """Return what the journals answer, on the springs that `forces` adds."""

    def external(self, harmonics: int, periods: int, frequency: float) -> Array:
        """Return the series of the answer to weight, and to the unbalance if `periods` is not 0."""

    def forces(self, position: Array, velocity: Array) -> Array:
        """Return the forces of films and springs, (rows, samples); of states what drives them.

        Raises FilmContactError if a journal leaves its bearing.
        """

    def tangents(self, position: Array, velocity: Array) -> tuple[Array, Array, Array]:
        """Return the forces and their slopes by the rows of their own bearing, (rows, widest, samples) each.

        Those of bearings with fewer rows than the widest are zero behind these.
        """

    def loaded(self, part: float) -> Self:
        """Return the same under a part of the unbalance."""


class PeriodicRotor(HarmonicRotor, Protocol):
    """A rotor whose orbits are found at any frequency, with their states and multipliers."""

    @property
    def names(self) -> tuple[str, ...]:
        """The stations of its bearings."""

    @property
    def lengths(self) -> Array:
        """Clearance of each bearing, shape (n_bearings,) [m]; a nominal length without one."""

    @property
    def row_names(self) -> Sequence[str]:
        """Names of the rows, as those of a run."""

    @property
    def is_driven(self) -> bool:
        """Whether it turns with an unbalance."""

    def guess(self) -> Array:
        """Return the rows at rest, shape (rows,), or near it."""

    def journal_series(self, series: Array) -> Array:
        """Return the series of x and y of each bearing, shape (n_bearings, 2, 2 H + 1) [m]."""

    def further(self, series: Array) -> dict[str, Array]:
        """Return the series of the other rows by their names."""

    def state(self, series: Array, frequency: float, periods: int) -> Array:
        """Return the state of rotor and bearings at phase 0 of an orbit."""

    def neglected(self, balance: Any, series: Array, frequency: float) -> float:
        """Return the imbalance of an orbit by the shapes that were left out, in units; 0 where none were."""
        ...

    def multipliers(self, series: Array, frequency: float) -> Complex:
        """Return the Floquet multipliers of an orbit, the largest first."""


class JournalPairs:
    """The rows of bearings that react to x and y without states; it needs `clearances`."""

    @property
    def blocks(self: Any) -> list[slice]:
        """Two rows for each bearing."""
        return [slice(2 * k, 2 * k + 2) for k in range(len(self.clearances))]

    @property
    def units(self: Any) -> Array:
        """Clearance of each row, shape (2 n_bearings,) [m]; a nominal length without one."""
        sizes = self.clearances
        return np.repeat(np.where(np.isfinite(sizes), sizes, NOMINAL_LENGTH), 2)

    def gaps(self: Any, position: Array) -> Array:
        """Return the clearance left to each journal, shape (n_bearings, samples) [m]."""
        pairs = position.reshape(-1, 2, position.shape[1])
        return self.clearances[:, None] - np.hypot(pairs[:, 0], pairs[:, 1])


R = TypeVar("R", bound=HarmonicRotor)


@dataclass(frozen=True, eq=False)
class Residual:
    """The equations at a series.

    Attributes
    ----------
    values : ndarray, shape (rows (2 H + 1),) [1]
        Values in the units of the rows.
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
        """Size of each row of the series; see `HarmonicRotor`."""
        return self.rotor.units

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
        answer, rates = self.rotor.receptance(self.harmonics, frequency)
        spectrum = force @ self.basis.back.T
        value = series - apply(answer, spectrum) - self._external(frequency)
        by_frequency = np.zeros(0)
        if not self.periods and rates is not None:
            turned = self._by_block(damping, series @ self.basis.slopes.T)
            change = apply(rates, spectrum) + apply(answer, turned @ self.basis.back.T)
            by_frequency = (-change / units[:, None]).ravel()

        def by_series() -> Array:
            return self._derivatives(answer, stiffness, frequency * damping)

        return Residual((value / units[:, None]).ravel(), by_frequency, by_series)

    def _derivatives(self, answer: Complex, stiffness: Array, damping: Array) -> Array:
        """Return the derivatives by the series, in clearances; the damping by the rate over the phase."""
        units, terms = self.units, 2 * self.harmonics + 1
        rows = len(units)
        by_series = np.empty((rows, terms, rows, terms))
        for block in self.rotor.blocks:
            for k, j in enumerate(range(block.start, block.stop)):
                columns = slope_columns(stiffness[block, k], damping[block, k], self.harmonics)
                moved = real_rows(answer[:, :, block] @ columns)
                by_series[:, :, j, :] = (-units[j] / units)[:, None, None] * moved
        flat = by_series.reshape(rows * terms, rows * terms)
        flat[np.arange(rows * terms), np.arange(rows * terms)] += 1.0
        return flat

    def values(self, series: Array, frequency: float) -> Array:
        """Return the equations alone, in clearances; FilmContactError as in `residual`."""
        spectrum = self.force_series(series, frequency)
        answered = apply(self.rotor.receptance(self.harmonics, frequency)[0], spectrum)
        missing = series - answered - self._external(frequency)
        return np.asarray((missing / self.units[:, None]).ravel())

    def force_series(self, series: Array, frequency: float) -> Array:
        """Return the series of the forces, (rows, 2 H + 1); FilmContactError as in `residual`."""
        return self.rotor.forces(*self._motion(series, frequency)) @ self.basis.back.T

    def in_length(self, change: Array) -> Array:
        """Return a change of the series, in clearances and one after the other, as a series [m]."""
        return change.reshape(len(self.units), -1) * self.units[:, None]

    def gaps(self, series: Array) -> Array:
        """Return the film left to each journal at the samples, shape (n_bearings, samples) [m]."""
        return self.rotor.gaps(series @ self.basis.values.T)

    def _motion(self, series: Array, frequency: float) -> tuple[Array, Array]:
        """Return positions and velocities at the samples, (2 n, samples) each."""
        return series @ self.basis.values.T, frequency * (series @ self.basis.slopes.T)

    def _external(self, frequency: float) -> Array:
        return self.rotor.external(self.harmonics, self.periods, frequency)

    def _by_block(self, slopes: Array, change: Array) -> Array:
        """Return what slopes (rows, widest, samples) make of a change of all rows (rows, samples)."""
        blocks = self.rotor.blocks
        parts = [np.einsum("ijn,jn->in", slopes[b, : b.stop - b.start], change[b]) for b in blocks]
        return np.concatenate(parts)


# Real Fourier series over one period: a_0, a_1 ... a_H of the cosines, b_1 ... b_H of the sines.
#
# A series has the shape (rows, 2 H + 1), its harmonics as amplitudes the shape (H + 1, rows):
# harmonic k is the real part of amplitude exp(i k phi).


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


def at_start(
    series: Array,
    frequency: float,
    forces: Callable[[Array, Array], Array],
    answer: Callable[[int, Complex], Any],
) -> Any:
    """Return the state of a rotor at phase 0 of an orbit: the sum of its answers to all harmonics.

    Parameters
    ----------
    series : ndarray, shape (rows, 2 H + 1)
        Orbit.
    frequency : float [rad/s]
    forces : callable
        Takes places and rates of the rows (rows, n), and returns forces (m, n).
    answer : callable
        Takes the number k of a harmonic and the amplitudes a (m,) of its force Re a exp(i k phase), and
        returns the state that it makes at phase 0.
    """
    harmonics = series.shape[1] // 2
    at = basis(harmonics, 4 * harmonics + 8)
    force = forces(series @ at.values.T, frequency * (series @ at.slopes.T)) @ at.back.T
    waves = [force[:, 0], *(force[:, 1 : harmonics + 1] - 1j * force[:, harmonics + 1 :]).T]
    return sum(answer(k, wave) for k, wave in enumerate(waves))


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
        Stiffness and damping over the orbit.

    Returns
    -------
    ndarray of complex, shape (H + 1, 2, 2 H + 1)
        Amplitude of harmonic k of both rows per term. A product with cos(l phi) moves harmonics by l up and
        down, so they are sums and differences of the coefficients of k - l and k + l. Harmonics that the
        samples cannot distinguish fall back on lower ones, as in the products themselves.
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


# A rotor in modes on compiled films: its answers to harmonics, at any frequency, and the films' forces.
#
# The modes are divided by i k nu - lambda:  R_k = sense (i k nu - Lambda)^-1 push.


@dataclass(frozen=True, eq=False)
class ModalFilms(JournalPairs):
    """A rotor in modes as the equations of an orbit see it.

    Attributes
    ----------
    modal : ModalRotor
        The rotor and its films.
    """

    modal: ModalRotor

    @cached_property
    def journals(self) -> JournalFilms:
        """The films, at motions from the centers of the bearings."""
        return JournalFilms.of_rotor(self.modal, absolute=True)

    @property
    def clearances(self) -> Array:
        """Of the bearings, shape (n_bearings,) [m]; infinite where there is none."""
        return np.array([bearing.clearance for bearing in self.modal.parts.bearings])

    @property
    def speed(self) -> float:
        """Angular speed of the shaft [rad/s]."""
        return self.modal.parts.speed

    def receptance(self, harmonics: int, frequency: float) -> Receptance:
        """Return what the journals answer on the springs of the modes, at any frequency."""
        return self._known(range(harmonics + 1), frequency, False)

    def external(self, harmonics: int, periods: int, frequency: float) -> Array:
        """Return the series of the answer to weight, and to the unbalance if `periods` is not 0."""
        rest = self.modal.journal_rest.reshape(-1, 4)[:, :2].ravel()
        if not periods:
            return constant(rest, harmonics)
        # (cos p, sin p) is the real part of (1, -i) exp(i p); a shaft that turns backward mirrors it.
        pair = self.speed**2 * np.array([1.0, -1.0j * np.sign(self.speed)])
        answer, _ = self._known(range(periods, periods + 1), frequency, True)
        return with_wave(rest, answer[0] @ pair, harmonics, periods)

    def forces(self, position: Array, velocity: Array) -> Array:
        """Return the forces of films and springs."""
        return self.tangents(position, velocity)[0]

    def tangents(self, position: Array, velocity: Array) -> tuple[Array, Array, Array]:
        """Return the forces of films and springs and their slopes."""
        return film_forces(self.modal, position, velocity, self.journals)

    def loaded(self, part: float) -> Self:
        """Return the same under a part of the unbalance."""
        push = self.modal.push.copy()
        push[:, -2:] *= part
        return replace(self, modal=self.modal._replace(push=push))

    @cached_property
    def _known(self) -> Callable[[range, float, bool], Receptance]:
        """The answers, kept: all steps towards one orbit ask for the same."""
        return lru_cache(maxsize=4)(self._answers)

    def _answers(self, harmonics: range, frequency: float, driven: bool) -> Receptance:
        """Return the answers to real forces cos, i.e. with both of each pair of modes, and their rates.

        The forces are those at the journals, or `driven` the unbalance's pair.

        The state is the real part of the modes kept, twice each: the answer to exp(i w t) has half of it from
        each of the pair.
        """
        values, order = self.modal.values, np.array(harmonics)
        push = self.modal.push[:, -2:] if driven else self.modal.push[:, :-2]
        rows = self.modal.sense.reshape(-1, 4, len(values))[:, :2].reshape(-1, len(values))
        pole = 1.0 / (1j * frequency * order[:, None] - values)
        mirrored = 1.0 / (1j * frequency * order[:, None] - values.conj())

        def summed(by: Complex, by_mirrored: Complex) -> Complex:
            mirror = (rows.conj() * by_mirrored[:, None]) @ push.conj()
            return 0.5 * ((rows * by[:, None]) @ push + mirror)

        return summed(pole, mirrored), -1j * order[:, None, None] * summed(pole**2, mirrored**2)


def film_forces(
    modal: ModalRotor, position: Array, velocity: Array, films: JournalFilms | None = None
) -> tuple[Array, Array, Array]:
    """Return the forces of films and springs (2 n, samples), their slopes by position and velocity.

    Raises
    ------
    FilmContactError
        If a journal leaves its bearing, or a force is not finite.
    """
    samples = position.shape[1]
    motion = np.concatenate([row.reshape(-1, 2, samples) for row in (position, velocity)], axis=1)
    journals = films or JournalFilms.of_rotor(modal, absolute=True)
    speed = float(modal.parts.profile.speeds[0])
    status, force, slope = journals.forces(motion.reshape(-1, samples), speed)
    raise_foreign(modal.calls)
    if status >= Status.AT_WALL:
        raise FilmContactError("a journal leaves its bearing along the orbit")
    return force, slope[:, :2], slope[:, 2:]


# Newton's method for a periodic orbit, from a start nearby or from the rest up.


MOST_HARMONICS = 128

CONVERGED = 1e-11
"""Residual or step at which Newton's method ends, in clearances."""

STEPS = 40

LEFT = 0.3
"""Part of a gap that a step leaves at least."""

_RAMPS = 6


class Solution(NamedTuple, Generic[R]):
    """A solved series, its frequency, and how it was found.

    Attributes
    ----------
    series : ndarray, shape (2 n_bearings, 2 H + 1) [m]
    frequency : float [rad/s]
    balance : Balance
        What it solves.
    residual : float [1]
        Largest imbalance left / clearance; before the last step where that was too short to look again.
    iterations : int
        Newton steps.
    """

    series: Array
    frequency: float
    balance: Balance[R]
    residual: float
    iterations: int


def solve(balance: Balance[R], series: Array, frequency: float, converged: float = CONVERGED) -> Solution[R]:
    """Return the orbit near a series by Newton's method, whose steps keep the journals inside.

    It ends at a residual or a step of `converged` clearances.

    Raises
    ------
    ConvergenceError
        If it does not converge.
    """
    reference = phase_row(series, balance)
    try:
        at, residual = _system(balance, series, frequency)
        for iteration in range(STEPS):
            size = float(np.abs(residual).max())
            if size < converged:
                return Solution(series, frequency, balance, size, iteration)
            step = np.asarray(
                np.linalg.solve(_matrix(balance, at, frequency, reference), -residual), dtype=float
            )
            if float(np.abs(step).max()) < converged:
                return Solution(*_moved(balance, series, frequency, step), balance, size, iteration)
            series, frequency, at, residual = _damped(
                balance, series, frequency, step, float(np.linalg.norm(residual))
            )
    except (FilmContactError, np.linalg.LinAlgError) as failure:
        raise ConvergenceError(f"no periodic orbit found: {failure}") from failure
    raise ConvergenceError(f"no periodic orbit found: {size:.3g} of the clearance left")


def driven(balance: Balance[R], start: Array, rest: Array, converged: float = CONVERGED) -> Solution[R]:
    """Return the orbit near a series; where that is too far out, from the rest (2 n_bearings,) [m] up.

    Raises
    ------
    ConvergenceError
        If the unbalance cannot be raised to its own either.
    """
    try:
        return solve(balance, start, balance.frequency, converged)
    except ConvergenceError:
        return _ramped(balance, rest)


def _ramped(balance: Balance[R], rest: Array) -> Solution[R]:
    """Return the orbit reached by raising the unbalance from nothing."""
    part, step, iterations = 0.0, 0.25, 0
    series = constant(rest, balance.harmonics)
    while True:
        after = min(1.0, part + step)
        try:
            found = solve(balance._replace(rotor=balance.rotor.loaded(after)), series, balance.frequency)
        except ConvergenceError:
            step *= 0.5
            if step < 2.0**-_RAMPS:
                raise
            continue
        series, part, iterations = found.series, after, iterations + found.iterations
        if part == 1.0:
            return found._replace(balance=balance, iterations=iterations)


def _system(balance: Balance[R], series: Array, frequency: float) -> tuple[Residual, Array]:
    """Return the equations and their values; of whirl with the phase condition."""
    at = balance.residual(series, frequency)
    return at, at.values if balance.periods else np.append(at.values, 0.0)


def _matrix(balance: Balance[R], at: Residual, frequency: float, reference: Array) -> Array:
    """Return the matrix of the equations; of whirl with the phase condition and the frequency."""
    if balance.periods:
        return at.by_series
    return np.block(
        [[at.by_series, frequency * at.by_frequency[:, None]], [reference[None], np.zeros((1, 1))]]
    )


def newton_step(balance: Balance[R], series: Array) -> Array:
    """Return the change of a driven orbit (2 n_bearings, 2 H + 1) [m] that one step makes: what it lacks."""
    at = balance.residual(series, balance.frequency)
    return balance.in_length(np.asarray(np.linalg.solve(at.by_series, -at.values)))


def _moved(balance: Balance[R], series: Array, frequency: float, step: Array) -> tuple[Array, float]:
    """Return series and frequency after a step."""
    moved = series + balance.in_length(step[: series.size])
    return moved, frequency if balance.periods else frequency * (1.0 + float(step[-1]))


def _damped(
    balance: Balance[R], series: Array, frequency: float, step: Array, before: float
) -> tuple[Array, float, Residual, Array]:
    part, last = _share(balance, series, step), None
    for _ in range(8):
        moved, rate = _moved(balance, series, frequency, part * step)
        try:
            at, residual = _system(balance, moved, rate)
        except FilmContactError:
            part *= 0.5
            continue
        last = moved, rate, at, residual
        if float(np.linalg.norm(residual)) <= (1.0 - 0.1 * part) * before or before < 1e3 * CONVERGED:
            return last
        part *= 0.5
    if last is None:
        raise FilmContactError("the journals leave their bearings at every part of a Newton step")
    return last


def _share(balance: Balance[R], series: Array, step: Array) -> float:
    """Return the part of a step that leaves every journal a good part of its gap at all samples."""
    share, gaps, change = 1.0, balance.gaps(series), balance.in_length(step[: series.size])
    while share > 1e-6 and np.any(balance.gaps(series + share * change) < LEFT * gaps):
        share *= 0.5
    return share


def phase_row(series: Array, balance: Balance[R]) -> Array:
    """Return the phase condition: a step must not move along the orbit, shape (2 n (2 H + 1),)."""
    harmonics = series.shape[1] // 2
    order = np.arange(1, harmonics + 1)
    turned = np.zeros_like(series)
    turned[:, 1 : harmonics + 1] = order * series[:, harmonics + 1 :]
    turned[:, harmonics + 1 :] = -order * series[:, 1 : harmonics + 1]
    row = (turned / balance.units[:, None]).ravel()
    norm = float(np.linalg.norm(row))
    return row / norm if norm else row


def truncation_of(solution: Solution[R]) -> float:
    """Return the largest of the last quarter of the harmonics / clearance."""
    harmonics = solution.balance.harmonics
    last = max(1, harmonics // 4)
    scaled = np.abs(solution.series / solution.balance.units[:, None])
    tail = np.maximum(scaled[:, harmonics + 1 - last : harmonics + 1], scaled[:, -last:])
    return float(tail.max())


def lengthened(solution: Solution[R], tolerance: float, converged: float = CONVERGED) -> Solution[R]:
    """Return the solution with harmonics added until the last ones are small enough."""
    while truncation_of(solution) > tolerance:
        harmonics = min(2 * solution.balance.harmonics, MOST_HARMONICS * max(1, solution.balance.periods))
        if harmonics == solution.balance.harmonics:
            break
        balance = solution.balance._replace(harmonics=harmonics)
        found = solve(balance, resized(solution.series, harmonics), solution.frequency, converged)
        solution = found._replace(iterations=found.iterations + solution.iterations)
    return solution


# The series that Newton's method for an orbit starts from: of an orbit of other periods, or a run's end.


def subharmonic(series: Array, ratio: int) -> Array:
    """Return a series whose harmonic k becomes k * ratio."""
    if ratio <= 1:
        return series
    old = series.shape[1] // 2
    out = np.zeros((len(series), 2 * old * ratio + 1))
    out[:, 0 : old * ratio + 1 : ratio] = series[:, : old + 1]
    out[:, old * ratio + ratio :: ratio] = series[:, old + 1 :]
    return out


def end_of(
    rotor: PeriodicRotor, run: Trajectory, frequency: float | None, harmonics: int
) -> tuple[Array, float]:
    """Return the series of the last orbit of a run; without a frequency, that at which it comes back."""
    motion = np.stack([run[name] for name in rotor.row_names])
    if frequency is None:
        frequency = _recurrence(run.time, motion / rotor.units[:, None])
    begin = run.time[-1] - 2.0 * math.pi / frequency
    if begin < run.time[0]:
        raise InputError(f"start must last one orbit of {2.0 * math.pi / frequency:.6g} s at least")
    late = run.time >= begin
    # The phase counts from t = 0, where the unbalance of a driven orbit has its own.
    values, _ = series_rows(harmonics, frequency * run.time[late])
    fit, *_ = np.linalg.lstsq(values, motion[:, late].T, rcond=None)
    return np.ascontiguousarray(fit.T), frequency


def _recurrence(time: Array, motion: Array) -> float:
    """Return the frequency of the end of a run [rad/s]: from crossings of its mean in the same sense."""
    late = time >= 0.5 * (time[0] + time[-1])
    t = time[late]
    widest = int(np.argmax(np.ptp(motion[:, late], axis=1)))
    signal = motion[widest, late] - motion[widest, late].mean()
    up = np.nonzero((signal[:-1] < 0.0) & (signal[1:] >= 0.0))[0]
    if len(up) < 3:
        raise InputError("start must hold four orbits at least in its last half")
    crossings = t[up] - signal[up] * (t[up + 1] - t[up]) / (signal[up + 1] - signal[up])
    return 2.0 * math.pi * (len(up) - 1) / float(crossings[-1] - crossings[0])


# The synchronous orbit of a rigid rotor on a bearing with states of its own, as the tilts of pads.
#
# At n samples of a turn the series of n - 1 harmonics and less stands for position q and states x, and obeys
#
#     m q'' = F(x, q, q') + load + unbalance,   x' = f(x, q, q'),
#
# by Newton's method with the exact derivatives of the bearing. Its first step from the rest is the linear
# orbit.


TURN_STEPS, TURN_HALVINGS, TURN_NEAR = 30, 8, 1e-9
"""Most Newton steps, most halvings of one, and the step / clearance at which they end."""


Bearing = Callable[..., Any]
"""Takes a state (N,), an input (5,) and `slopes`."""


class StatefulTurn(NamedTuple):
    """Position and states over a turn.

    Attributes
    ----------
    places : ndarray, shape (2 + N, n) [m]
        Samples of x, y and the states.
    force : ndarray, shape (2, n) [N]
        Force of the film on the journal.
    """

    places: Array
    force: Array


class TurnEquations:
    """The equations of an orbit at so many samples.

    Parameters
    ----------
    rotor : RigidRotor
    bearing : callable
        See `Bearing`.
    clearance : float [m]
        Clearance by which steps are measured.
    samples : int
        Samples over a turn, odd.
    """

    def __init__(self, rotor: RigidRotor, bearing: Bearing, clearance: float, samples: int) -> None:
        self.bearing, self.clearance, self.samples = bearing, clearance, samples
        series = basis(samples // 2, samples)
        self._speed, self._mass = rotor.profile.speeds[0], rotor.mass
        self._rate = self._speed * (series.slopes @ series.back)
        phase = 2.0 * np.pi * np.arange(samples) / samples + rotor.unbalance_angle
        turning = rotor.unbalance * self._speed**2 * np.stack([np.cos(phase), np.sin(phase)])
        self._given = np.array(rotor.static_force)[:, None] + turning

    def residual(self, places: Array, *, slopes: bool = False) -> tuple[Array, list[Any]]:
        """Return what the equations lack, (2 + N, n), and the bearing at each sample."""
        q, x = places[:2], places[2:]
        moving = q @ self._rate.T
        inputs = np.vstack([q, moving, np.full(self.samples, self._speed)])
        found = [self.bearing(x[:, k], inputs[:, k], slopes=slopes) for k in range(self.samples)]
        force = np.stack([one.outputs[:2] for one in found], axis=1)
        rates = np.stack([one.rates for one in found], axis=1)
        return np.vstack(
            [self._mass * moving @ self._rate.T - force - self._given, x @ self._rate.T - rates]
        ), found

    def matrix(self, found: list[Any]) -> Array:
        """Return the derivatives of the equations, rows and columns in the order of their samples."""
        parts = [one.slopes for one in found if one.slopes is not None]
        A, B, C, D = (
            np.stack([getattr(one, name) for one in parts], axis=-1) for name in Linearization._fields
        )
        n, N = self.samples, len(A)
        whole = np.zeros((2 + N, n, 2 + N, n))
        by_place, by_rate = (np.vstack([D[:2, k : k + 2], B[:, k : k + 2]]) for k in (0, 2))
        each = np.arange(n)
        for row in range(2 + N):
            for column in range(2):
                block = whole[row, :, column]
                block -= by_rate[row, column][:, None] * self._rate
                block[each, each] -= by_place[row, column]
            for state in range(N):
                whole[row, each, 2 + state, each] -= C[row, state] if row < 2 else A[row - 2, state]
            whole[row, :, row] += self._mass * self._rate @ self._rate if row < 2 else self._rate
        return whole.reshape((2 + N) * n, -1)

    def step(self, matrix: Array, residual: Array) -> Array:
        """Return the change of the places that takes a residual out; of pads without film the least."""
        size = np.linalg.norm(matrix, axis=1)
        found = np.linalg.lstsq(matrix / size[:, None], -residual.ravel() / size, rcond=1e-11)[0]
        return np.asarray(found.reshape(residual.shape))

    def linear(self, rest: Array) -> StatefulTurn:
        """Return the orbit about a rest (2 + N,) [m] by the slopes there."""
        places = np.repeat(rest[:, None], self.samples, axis=1)
        lacking, found = self.residual(places, slopes=True)
        moved = self.step(self.matrix(found), lacking)
        return self.turn(places + moved)

    def orbit(self, start: Array) -> StatefulTurn:
        """Return the orbit from a start (2 + N, any samples) [m].

        Raises
        ------
        ConvergenceError
            If Newton's method does not end.
        """
        places = resampled(start, self.samples)
        for _ in range(TURN_STEPS):
            lacking, found = self.residual(places, slopes=True)
            moved = self.step(self.matrix(found), lacking)
            places = self._inside(places, moved)
            if float(np.abs(moved).max()) < TURN_NEAR * self.clearance:
                return self.turn(places)
        raise ConvergenceError(f"the orbit was not found within {TURN_STEPS} steps", None)

    def _inside(self, places: Array, moved: Array) -> Array:
        """Return the places after the longest part of a step that leaves a film everywhere."""
        for halvings in range(TURN_HALVINGS):
            further = places + 0.5**halvings * moved
            try:
                self.residual(further)
            except FilmContactError:
                continue
            return further
        raise FilmContactError("journal and pads must have a film over the orbit, and touch")

    def turn(self, places: Array) -> StatefulTurn:
        """Return places with the force of the film by the balance of the rotor."""
        return StatefulTurn(places, self._mass * places[:2] @ self._rate.T @ self._rate.T - self._given)


def resampled(places: Array, samples: int) -> Array:
    """Return series at other samples of a turn, (rows, samples)."""
    old = places.shape[1]
    series = resized(places @ basis(old // 2, old).back.T, samples // 2)
    return np.asarray(series @ basis(samples // 2, samples).values.T)
