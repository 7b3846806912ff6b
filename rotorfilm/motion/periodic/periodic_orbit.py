"""Periodic orbits of a rotor on films: driven by its unbalance, or whirl at a frequency of its own."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...errors import ConvergenceError, FilmContactError, InputError, require_count, require_positive
from ...model import Array
from ...results import Trajectory
from ...rotors import MountedRotor
from ..compiled.modal import Complex, ModalRotor, modal_rotor, take_apart
from .balance import Balance, series_rows
from .floquet import multipliers, state_at_start
from .rest import first_guess

HARMONICS = 8
"""Harmonics at first."""

MOST_HARMONICS = 128

TRUNCATION = 1e-7
"""Largest of the last harmonics / clearance at which a series is long enough."""

CONVERGED = 1e-11
_NEWTON_STEPS = 40
_RAMPS = 6


@dataclass(frozen=True, kw_only=True, eq=False)
class PeriodicOrbit:
    """A periodic orbit of a rotor on films.

    Attributes
    ----------
    frequency : float [rad/s]
        Angular frequency; speed / periods for an orbit that the unbalance drives.
    speed : float [rad/s]
    periods : int
        Turns of the shaft per orbit; 0 for whirl at a frequency of its own.
    stations : tuple of str
    lengths : ndarray, shape (n_bearings,) [m]
        Clearance of each bearing.
    series : ndarray, shape (n_bearings, 2, 2 H + 1) [m]
        Journal displacement x, y: mean, cosines, sines of the phase frequency * t.
    state : ndarray, shape (n_states,)
        State of the whole rotor at t = 0.
    multipliers : ndarray of complex, shape (n_states,)
        Floquet multipliers, the largest first; one of whirl is 1. Empty without `stability`.
    residual : float [1]
        Imbalance left / clearance.
    truncation : float [1]
        Largest of the last quarter of the harmonics / clearance.
    work : dict of str to int
        film_evaluations, iterations.
    """

    frequency: float
    speed: float
    periods: int
    stations: tuple[str, ...]
    lengths: Array
    series: Array
    state: Array
    multipliers: Complex
    residual: float
    truncation: float
    work: dict[str, int]

    @property
    def period(self) -> float:
        """Duration of one orbit [s]."""
        return 2.0 * math.pi / self.frequency

    @property
    def harmonics(self) -> int:
        """Harmonics of the series."""
        return self.series.shape[-1] // 2

    def position(self, time: ArrayLike) -> Array:
        """Return x, y of each journal at times (n,) [s], shape (n_bearings, 2, n) [m]."""
        values, _ = series_rows(self.harmonics, self.frequency * np.atleast_1d(np.asarray(time, dtype=float)))
        return np.asarray(self.series @ values.T)

    @cached_property
    def eccentricity_ratios(self) -> Array:
        """Eccentricity ratio of each journal over the orbit, shape (n_bearings, 256)."""
        position = self.position(self.period * np.arange(256) / 256)
        return np.hypot(position[:, 0], position[:, 1]) / self.lengths[:, None]

    @property
    def amplitude(self) -> float:
        """Largest distance of a journal from its mean position / clearance [1]."""
        position = self.position(self.period * np.arange(256) / 256) - self.series[:, :, :1]
        return float((np.hypot(position[:, 0], position[:, 1]) / self.lengths[:, None]).max())

    @property
    def free_multipliers(self) -> Complex:
        """The multipliers without the one that is 1 because whirl has no phase of its own."""
        if self.periods:
            return self.multipliers
        return np.delete(self.multipliers, int(np.argmin(np.abs(self.multipliers - 1.0))))

    @property
    def stable(self) -> bool:
        """Whether a small disturbance dies out; InputError where the multipliers were not computed."""
        if not self.multipliers.size:
            raise InputError("stability must be True for an orbit that knows whether it is stable")
        return bool(np.all(np.abs(self.free_multipliers) < 1.0))


class Solution(NamedTuple):
    """A solved series, its frequency, and how it was found."""

    series: Array
    frequency: float
    balance: Balance
    residual: float
    iterations: int


def periodic_orbit(
    mounted: MountedRotor,
    *,
    start: PeriodicOrbit | Trajectory | None = None,
    periods: int = 1,
    tolerance: float = TRUNCATION,
    stability: bool = True,
) -> PeriodicOrbit:
    """Return a periodic orbit of a rotor on films, stable or not, and its Floquet multipliers.

    With unbalance the orbit repeats after `periods` turns of the shaft. Without it the orbit is whirl, whose
    frequency is found with it; it needs a start.

    Parameters
    ----------
    mounted : MountedRotor
        From `mount`, at constant speed.
    start : PeriodicOrbit or Trajectory, optional
        An orbit nearby, or a run of `simulate_rotor` that ends in one; by default small motion about the
        rest, which leads to the orbit of one turn.
    periods : int
        Turns of the shaft per orbit: 2 after a period doubling. The orbit of one turn solves these equations
        too, so that another one needs a start.
    tolerance : float [1]
        Harmonics are added until the last quarter of them is smaller, in clearances.
    stability : bool
        Whether to compute the Floquet multipliers; without them the orbit does not know whether it is stable.

    Raises
    ------
    InputError
        If an argument breaks its rule, or whirl has no start.
    ConvergenceError
        If no orbit is found.
    """
    require_count("periods", periods)
    require_positive("tolerance", tolerance)
    modal = modal_rotor(parts := take_apart(mounted), parts.speed)
    driven = bool(np.any(parts.structure.unbalance)) and parts.speed != 0.0
    if driven:
        found = _driven(mounted, modal, start, periods)
    elif start is None:
        raise InputError("start must be an orbit or a run that ends in whirl for a rotor without unbalance")
    else:
        series, frequency = _start_series(modal, start, None)
        found = solve(
            Balance(modal=modal, harmonics=HARMONICS, periods=0), resized(series, HARMONICS), frequency
        )
    return finished(lengthened(found, tolerance), stability=stability)


def _driven(
    mounted: MountedRotor, modal: ModalRotor, start: PeriodicOrbit | Trajectory | None, periods: int
) -> Solution:
    frequency = abs(modal.parts.speed) / periods
    harmonics = HARMONICS * periods
    balance = Balance(modal=modal, harmonics=harmonics, periods=periods)
    if start is not None:
        series, _ = _start_series(modal, start, frequency)
        return solve(balance, resized(series, harmonics), frequency)
    rest = np.zeros((len(balance.units), 2 * harmonics + 1))
    rest[:, 0] = first_guess(mounted, modal)
    try:
        return solve(balance, rest, frequency)
    except ConvergenceError:
        return _ramped(balance, rest, frequency)


def _ramped(balance: Balance, series: Array, frequency: float) -> Solution:
    """Return the orbit reached by raising the unbalance from nothing."""
    part, step = 0.0, 0.25
    modal = balance.modal
    while part < 1.0:
        after = min(1.0, part + step)
        push = modal.push.copy()
        push[:, -2:] *= after
        try:
            found = solve(balance._replace(modal=modal._replace(push=push)), series, frequency)
        except ConvergenceError:
            step *= 0.5
            if step < 2.0**-_RAMPS:
                raise
            continue
        series, part = found.series, after
    return solve(balance, series, frequency)


def solve(balance: Balance, series: Array, frequency: float) -> Solution:
    """Return the orbit near a series by Newton's method, whose steps keep the journals inside.

    Raises
    ------
    ConvergenceError
        If it does not converge.
    """
    whirl = balance.periods == 0
    reference = phase_row(series, balance)
    try:
        at, residual = _system(balance, series, frequency, reference)
        for iteration in range(_NEWTON_STEPS):
            size = float(np.abs(residual).max())
            if size < CONVERGED:
                return Solution(series, frequency, balance, size, iteration)
            step = np.asarray(np.linalg.solve(at, -residual), dtype=float)
            series, frequency, at, residual = _damped(
                balance, series, frequency, step, reference, float(np.linalg.norm(residual)), whirl
            )
    except (FilmContactError, np.linalg.LinAlgError) as failure:
        raise ConvergenceError(f"no periodic orbit found: {failure}") from failure
    raise ConvergenceError(f"no periodic orbit found: {size:.3g} of the clearance left")


def _system(balance: Balance, series: Array, frequency: float, reference: Array) -> tuple[Array, Array]:
    """Return matrix and values of the equations; of whirl with the phase condition and the frequency."""
    at = balance.residual(series, frequency)
    if balance.periods:
        return at.by_series, at.values
    matrix = np.block(
        [[at.by_series, frequency * at.by_frequency[:, None]], [reference[None], np.zeros((1, 1))]]
    )
    return matrix, np.append(at.values, 0.0)


def _damped(
    balance: Balance,
    series: Array,
    frequency: float,
    step: Array,
    reference: Array,
    before: float,
    whirl: bool,
) -> tuple[Array, float, Array, Array]:
    size = series.size
    change = step[:size].reshape(series.shape) * balance.units[:, None]
    part, last = 1.0, None
    for _ in range(8):
        moved = series + part * change
        rate = frequency * (1.0 + part * float(step[-1])) if whirl else frequency
        try:
            at, residual = _system(balance, moved, rate, reference)
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


def phase_row(series: Array, balance: Balance) -> Array:
    """Return the phase condition: a step must not move along the orbit, shape (2 n (2 H + 1),)."""
    harmonics = series.shape[1] // 2
    order = np.arange(1, harmonics + 1)
    turned = np.zeros_like(series)
    turned[:, 1 : harmonics + 1] = order * series[:, harmonics + 1 :]
    turned[:, harmonics + 1 :] = -order * series[:, 1 : harmonics + 1]
    row = (turned / balance.units[:, None]).ravel()
    norm = float(np.linalg.norm(row))
    return row / norm if norm else row


def resized(series: Array, harmonics: int) -> Array:
    """Return a series with another number of harmonics."""
    old = series.shape[1] // 2
    kept = min(old, harmonics)
    out = np.zeros((len(series), 2 * harmonics + 1))
    out[:, : kept + 1] = series[:, : kept + 1]
    out[:, harmonics + 1 : harmonics + 1 + kept] = series[:, old + 1 : old + 1 + kept]
    return out


def truncation_of(solution: Solution) -> float:
    """Return the largest of the last quarter of the harmonics / clearance."""
    harmonics = solution.balance.harmonics
    last = max(1, harmonics // 4)
    scaled = np.abs(solution.series / solution.balance.units[:, None])
    tail = np.maximum(scaled[:, harmonics + 1 - last : harmonics + 1], scaled[:, -last:])
    return float(tail.max())


def lengthened(solution: Solution, tolerance: float) -> Solution:
    """Return the solution with harmonics added until the last ones are small enough."""
    while truncation_of(solution) > tolerance:
        harmonics = min(2 * solution.balance.harmonics, MOST_HARMONICS * max(1, solution.balance.periods))
        if harmonics == solution.balance.harmonics:
            break
        balance = solution.balance._replace(harmonics=harmonics)
        found = solve(balance, resized(solution.series, harmonics), solution.frequency)
        solution = found._replace(iterations=found.iterations + solution.iterations)
    return solution


def finished(solution: Solution, *, stability: bool = True) -> PeriodicOrbit:
    """Return the orbit of a solution, with its multipliers if asked for."""
    balance, series = solution.balance, solution.series
    modal = balance.modal
    parts = modal.parts
    return PeriodicOrbit(
        frequency=solution.frequency,
        speed=parts.speed,
        periods=balance.periods,
        stations=parts.names,
        lengths=parts.lengths,
        series=series.reshape(len(parts.names), 2, -1),
        state=state_at_start(modal, series, solution.frequency, balance.periods),
        multipliers=multipliers(modal, series, solution.frequency)
        if stability
        else np.zeros(0, dtype=complex),
        residual=solution.residual,
        truncation=truncation_of(solution),
        work={
            "film_evaluations": (solution.iterations + 1) * balance.samples * len(parts.names),
            "iterations": solution.iterations,
        },
    )


def _start_series(
    modal: ModalRotor, start: PeriodicOrbit | Trajectory, frequency: float | None
) -> tuple[Array, float]:
    """Return the series of a start and its frequency; of a run, that of its end."""
    if isinstance(start, PeriodicOrbit):
        series = start.series.reshape(-1, start.series.shape[-1])
        if len(series) != 2 * len(modal.parts.names):
            raise InputError(
                f"start must be an orbit of {len(modal.parts.names)} journals, got {len(series) // 2}"
            )
        if frequency is None or start.periods * frequency == 0.0:
            return series, start.frequency
        ratio = start.frequency / frequency
        return _subharmonic(series, round(ratio)), frequency
    return _end_of(modal, start, frequency)


def _subharmonic(series: Array, ratio: int) -> Array:
    """Return a series whose harmonic k becomes k * ratio."""
    if ratio <= 1:
        return series
    old = series.shape[1] // 2
    out = np.zeros((len(series), 2 * old * ratio + 1))
    out[:, 0 : old * ratio + 1 : ratio] = series[:, : old + 1]
    out[:, old * ratio + ratio :: ratio] = series[:, old + 1 :]
    return out


def _end_of(modal: ModalRotor, run: Trajectory, frequency: float | None) -> tuple[Array, float]:
    """Return the series of the last orbit of a run; without a frequency, that at which it comes back."""
    keys = [f"{name}_" if name else "" for name in modal.parts.names]
    motion = np.concatenate([np.stack([run[key + "x"], run[key + "y"]]) for key in keys])
    if frequency is None:
        frequency = _recurrence(run.time, motion / np.repeat(modal.parts.lengths, 2)[:, None])
    begin = run.time[-1] - 2.0 * math.pi / frequency
    if begin < run.time[0]:
        raise InputError(f"start must last one orbit of {2.0 * math.pi / frequency:.6g} s at least")
    late = run.time >= begin
    # The phase counts from t = 0, where the unbalance of a driven orbit has its own.
    values, _ = series_rows(HARMONICS, frequency * run.time[late])
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
