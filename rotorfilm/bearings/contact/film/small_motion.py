"""Small motions about a stationary contact: dynamic stiffness and the ball's natural motion.

The cells that hold film stay the same in a small motion, so the linearized equations are those of the film
cells alone, with rate = s for motions as exp(s t). They are dense; a grid of 64 x 64 cells takes a second or
two per frequency.
"""

from __future__ import annotations

import numpy as np
from scipy import linalg

from ....errors import ConvergenceError
from ....model import Array
from .film_equations import ContactEquations, Derivatives

CLOSE = 1e-10
"""Relative change of an eigenvalue that ends the search for it."""

MAX_STEPS = 40
"""Steps of that search."""


class SmallMotion:
    """The linearized contact about stationary pressures and approach.

    Parameters
    ----------
    equations : ContactEquations
    pressure : ndarray, shape (n,)
        Stationary.
    delta : float
    """

    def __init__(self, equations: ContactEquations, pressure: Array, delta: float) -> None:
        wet = np.flatnonzero(pressure > 0.0)
        film = equations.film(pressure, delta)
        columns = _deflections(equations, wet)
        self._equations, self._wet = equations, wet
        still, rated = (equations.derivatives(pressure, film, rate) for rate in (0.0, 1.0))
        self._matrix, self._by_delta = _reduced(still, wet, columns)
        moving, by_delta = _reduced(rated, wet, columns)
        self._rate_matrix, self._rate_by_delta = moving - self._matrix, by_delta - self._by_delta

    def stiffness(self, s: complex) -> complex:
        """Return Z(s) = -d(integral of p)/d(delta) for motions as exp(s t)."""
        pressures, area = self._pressures(s), self._equations.area
        return complex(area[self._wet] @ pressures if self._equations.is_dense else area * pressures.sum())

    def film(self, s: complex) -> tuple[complex, np.ndarray]:
        """Return d(film thickness)/d(delta) for motions as exp(s t), at the center and at the samples."""
        pressures = np.zeros(self._equations.grid.shape[0] * self._equations.grid.shape[1], dtype=complex)
        pressures[self._wet] = -self._pressures(s)
        sampling = self._equations.sampling
        bent = sampling.deflection(pressures.real) + 1j * sampling.deflection(pressures.imag)
        return 1.0 + complex(sampling.center @ pressures), 1.0 + bent

    def _pressures(self, s: complex) -> np.ndarray:
        """Return -dp/d(delta) of the film cells."""
        return np.asarray(
            linalg.solve(
                self._matrix + s * self._rate_matrix,
                self._by_delta + s * self._rate_by_delta,
                check_finite=False,
            )
        )

    def natural_motion(self, W: float, guess: complex) -> complex:
        """Return the eigenvalue s near a guess of a ball on the contact: W s^2 + Z(s) = 0.

        Raises
        ------
        ConvergenceError
            If the secant method does not converge.
        """
        before, now = guess, guess * (1.0 + 1e-3j)
        missed_before, missed = (W * s**2 + self.stiffness(s) for s in (before, now))
        for _ in range(MAX_STEPS):
            move = -missed * (now - before) / (missed - missed_before)
            before, missed_before, now = now, missed, now + move
            if abs(move) < CLOSE * abs(now):
                return now
            missed = W * now**2 + self.stiffness(now)
        raise ConvergenceError(
            f"the secant method must find the natural motion near {guess:.4g}, got {now:.4g}"
        )


def _reduced(derivatives: Derivatives, wet: np.ndarray, columns: Array) -> tuple[Array, Array]:
    """Return the dense derivatives of the film cells' equations by their pressures and by delta."""
    by_pressure, by_film = derivatives
    rows = by_film[wet]
    return by_pressure[wet][:, wet].toarray() + rows @ columns, rows @ np.ones(rows.shape[1])


def _deflections(equations: ContactEquations, wet: np.ndarray) -> Array:
    """Return the film thickness at the samples per pressure of each film cell, shape (samples, n_wet)."""
    unit = np.zeros(equations.grid.shape[0] * equations.grid.shape[1])
    columns = np.empty((len(equations.sampling.gap), len(wet)))
    for k, cell in enumerate(wet):
        unit[cell] = 1.0
        columns[:, k] = equations.sampling.deflection(unit)
        unit[cell] = 0.0
    return columns
