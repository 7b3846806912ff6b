"""Newton's method for a periodic orbit, from a start nearby or from the rest up."""

from __future__ import annotations

from typing import Generic, NamedTuple

import numpy as np

from ...errors import ConvergenceError, FilmContactError
from ...model import Array
from .balance import Balance, R, Residual
from .harmonics import constant, resized

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
