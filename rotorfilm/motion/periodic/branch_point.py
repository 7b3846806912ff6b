"""One point of a curve of periodic orbits: the equations with a parameter, their tangent, a step along it."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ...errors import ConvergenceError, FilmContactError
from ...model import Array
from ...rotors import MountedRotor
from ..compiled.modal import modal_rotor, take_apart
from .balance import Balance, Residual
from .harmonics import resized
from .modal_films import ModalFilms
from .orbit_newton import CONVERGED, Solution, phase_row, solve

Family = Callable[[float], MountedRotor]

RELATIVE_STEP = 1e-5
"""Step of the parameter, in its range, over which the equations are differenced. The solution does not depend
on it: it only turns the tangent."""

CORRECTIONS = 10
_BISECTIONS = 5


class Point(NamedTuple):
    """A solution, its parameter, and the unit tangent in (series / clearance, ln frequency, parameter)."""

    solution: Solution[ModalFilms]
    parameter: float
    tangent: Array


class Curve(NamedTuple):
    """A family of rotors over a parameter.

    Attributes
    ----------
    family : callable
        From the parameter to the rotor in its bearings.
    scale : float
        Range of the parameter, which makes it comparable with clearances.
    """

    family: Family
    scale: float

    def balance(self, parameter: float, harmonics: int, periods: int) -> Balance[ModalFilms]:
        """Return the equations at a parameter."""
        parts = take_apart(self.family(parameter))
        return Balance(
            rotor=ModalFilms(modal_rotor(parts, parts.speed)), harmonics=harmonics, periods=periods
        )

    def point(self, solution: Solution[ModalFilms], parameter: float, before: Array | None) -> Point:
        """Return a solution as a point; its tangent goes on as the one before, else with the parameter."""
        matrix = self._equations(solution, parameter)
        if before is None:
            before = np.zeros(matrix.shape[1])
            before[-1] = 1.0
        # The null vector, by the row that makes it go on as before.
        along = np.linalg.solve(np.vstack([matrix, before]), np.append(np.zeros(len(matrix)), 1.0))
        return Point(solution, parameter, along / np.linalg.norm(along))

    def stepped(self, point: Point, length: float) -> Point:
        """Return the point at a distance along the tangent.

        Raises
        ------
        ConvergenceError
            If Newton's method does not converge there, or the tangent turns by more than 30 deg.
        """
        try:
            return self._stepped(point, length)
        except (FilmContactError, np.linalg.LinAlgError) as failure:
            raise ConvergenceError(f"no orbit at the next step: {failure}") from failure

    def at(self, point: Point, parameter: float) -> Point:
        """Return the point of a given parameter, near another one."""
        solution = point.solution
        balance = self.balance(parameter, solution.balance.harmonics, solution.balance.periods)
        found = solve(balance, solution.series, _frequency(balance, solution.frequency))
        return self.point(found, parameter, point.tangent)

    def stopped(self, point: Point, length: float, parameter: float) -> Point:
        """Return the point of a given parameter that is met within a step.

        Raises
        ------
        ConvergenceError
            If Newton's method does not converge.
        """
        low, high = 0.0, length
        for _ in range(_BISECTIONS):
            middle = 0.5 * (low + high)
            past = (self.stepped(point, middle).parameter - parameter) * point.tangent[-1] > 0.0
            low, high = (low, middle) if past else (middle, high)
        return self.at(self.stepped(point, low) if low else point, parameter)

    def resize(self, point: Point, harmonics: int) -> Point:
        """Return a point with another number of harmonics."""
        solution = point.solution
        balance = solution.balance._replace(harmonics=harmonics)
        found = solve(balance, resized(solution.series, harmonics), solution.frequency)
        rows = len(solution.series)
        size = solution.series.size
        series = resized(point.tangent[:size].reshape(rows, -1), harmonics)
        return self.point(found, point.parameter, np.concatenate([series.ravel(), point.tangent[size:]]))

    def _stepped(self, point: Point, length: float) -> Point:
        solution, tangent = point.solution, point.tangent
        units, size = solution.balance.units[:, None], solution.series.size
        harmonics, periods = solution.balance.harmonics, solution.balance.periods
        series = solution.series + length * tangent[:size].reshape(solution.series.shape) * units
        parameter = point.parameter + length * tangent[-1] * self.scale
        rate = solution.frequency * (1.0 if periods else float(np.exp(length * tangent[-2])))
        by_parameter, last = np.zeros(0), 0.0
        reference = phase_row(solution.series, solution.balance)
        for iteration in range(CORRECTIONS):
            balance = self.balance(parameter, harmonics, periods)
            rate = _frequency(balance, rate)
            at = balance.residual(series, rate)
            error = float(np.abs(at.values).max())
            if error < CONVERGED:
                found = Solution(series, rate, balance, error, iteration)
                after = self.point(found, parameter, tangent)
                if after.tangent @ tangent < 0.87:
                    raise ConvergenceError("the curve turns by more than 30 deg")
                return after
            # Kept while it serves: near the onset of whirl it is proportional to the amplitude.
            if error > 0.05 * last:
                now = Solution(series, rate, balance, error, iteration)
                by_parameter = self._by_parameter(now, parameter)
            last = error
            matrix = _bordered(at, by_parameter, reference, rate, bool(periods))
            right = np.zeros(len(matrix) + 1)
            right[: len(at.values)] = -at.values
            step = np.linalg.solve(np.vstack([matrix, tangent]), right)
            if not np.abs(step).max() < 1.0:
                break
            series = series + step[:size].reshape(series.shape) * units
            rate *= 1.0 if periods else float(np.exp(step[-2]))
            parameter += step[-1] * self.scale
        raise ConvergenceError("no orbit at the next step: Newton's method does not converge")

    def _equations(self, solution: Solution[ModalFilms], parameter: float) -> Array:
        at = solution.balance.residual(solution.series, solution.frequency)
        reference = phase_row(solution.series, solution.balance)
        slope = self._by_parameter(solution, parameter)
        return _bordered(at, slope, reference, solution.frequency, bool(solution.balance.periods))

    def _by_parameter(self, solution: Solution[ModalFilms], parameter: float) -> Array:
        harmonics, periods = solution.balance.harmonics, solution.balance.periods
        ends = []
        for side in (-1.0, 1.0):
            balance = self.balance(parameter + side * RELATIVE_STEP * self.scale, harmonics, periods)
            values = balance.values(solution.series, _frequency(balance, solution.frequency))
            # The bearing's clearance may be the parameter: one unit for both sides.
            ends.append(values * np.repeat(balance.units, 2 * harmonics + 1))
        units = np.repeat(solution.balance.units, 2 * harmonics + 1)
        return np.asarray((ends[1] - ends[0]) / (2.0 * RELATIVE_STEP) / units)


def _frequency(balance: Balance[ModalFilms], frequency: float) -> float:
    return balance.frequency if balance.periods else frequency


def _bordered(at: Residual, by_parameter: Array, reference: Array, rate: float, driven: bool) -> Array:
    """Return the matrix of the equations by (series, ln frequency of whirl, parameter)."""
    if driven:
        return np.hstack([at.by_series, by_parameter[:, None]])
    top = np.hstack([at.by_series, rate * at.by_frequency[:, None], by_parameter[:, None]])
    return np.vstack([top, np.append(reference, [0.0, 0.0])])
