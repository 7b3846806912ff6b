"""Newton's method for a lubricated point contact: complementarity by active sets, GMRES within.

The equations are min(p, -R) = 0 cell by cell and one scalar equation for the approach. Newton's method for
the semismooth minimum is an active-set method: cells with film solve R = 0, the others p = 0, and a cell
changes sides when its pressure turns negative or its residual positive (Hintermueller, Ito and Kunisch 2003).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....errors import ConvergenceError
from ....model import Array
from .film_equations import ContactEquations, Derivatives, TimeDerivative
from .krylov import gmres
from .preconditioner import Closure, Distribution, Factors, distribution, factorize

MAX_STEPS = 30
"""Newton steps tried."""

FORCING = (1e-4, 1e-2)
"""Range of the relative residual to which GMRES solves a step: no closer than the step can be of use."""

KRYLOV = 80
"""Most iterations of GMRES in a step."""

STALE = 0.06
"""Cells that may gain or lose film before the preconditioner is renewed, per cells along x.

Each costs an iteration more, and factors cost more iterations on finer grids. Old coefficients cost nothing.
"""

SHRINK = 0.2
"""A step may thin the film down to this share at most."""


THINNEST = 1e-7
"""Film thickness below which a search has gone astray."""


class Contact(NamedTuple):
    """A solution: pressures (n,), approach, film at the samples, and the Newton and GMRES steps taken."""

    pressure: Array
    delta: float
    film: Array
    steps: int
    iterations: int


class Place(NamedTuple):
    """Where equations are linearized: enough to make the factors of a preconditioner again.

    Attributes
    ----------
    pressure : ndarray, shape (n,)
    film : ndarray, shape (samples,)
    wet : ndarray of bool, shape (n,)
    closure : Closure
    rate : float
    """

    pressure: Array
    film: Array
    wet: np.ndarray
    closure: Closure
    rate: float


class _Linear(NamedTuple):
    """The linearized equations on the cells with film."""

    derivatives: Derivatives
    by_delta: Array
    wet: np.ndarray
    closure: Closure
    rate: float
    place: Place


class NewtonKrylov:
    """Solver of one set of equations that keeps its preconditioner from call to call.

    Parameters
    ----------
    equations : ContactEquations
    tolerance : float [1]
        Largest error of pressures and approach.
    place : Place, optional
        Where an earlier solver made its preconditioner: this one goes on to the last bit as that would.
    """

    def __init__(self, equations: ContactEquations, tolerance: float, place: Place | None = None) -> None:
        self.equations, self.tolerance = equations, tolerance
        self._change: Distribution | None = None
        self._factors: Factors | None = None
        self.place: Place | None = None
        if place is not None:
            self._factors = self._factorized(self._linear(place))

    def solve(self, pressure: Array, delta: float, closure: Closure, time: TimeDerivative) -> Contact:
        """Return the solution near a guess.

        Parameters
        ----------
        pressure : ndarray, shape (n,)
            Guess; cells with positive pressure begin with film.
        delta : float
            Guess of the approach.
        closure : Closure
        time : TimeDerivative

        Raises
        ------
        ConvergenceError
            If Newton's method does not converge.
        """
        wet, error, iterations = pressure > 0.0, np.inf, 0
        pressure = np.where(wet, pressure, 0.0)
        film = self.equations.film(pressure, delta)
        for step in range(MAX_STEPS):
            if not film.min() > THINNEST:
                break
            residual = self.equations.residual(pressure, film, time)
            settled = np.where(wet, pressure > 0.0, residual > 0.0)
            changed = bool(np.any(settled != wet))
            if error <= self.tolerance and not changed:
                return Contact(pressure, delta, film, step, iterations)
            wet = settled
            if np.any(pressure < 0.0):
                pressure = np.where(wet, pressure, 0.0)
                film = self.equations.film(pressure, delta)
                residual = self.equations.residual(pressure, film, time)
            linear = self._linear(Place(pressure, film, wet, closure, time.rate))
            miss = closure.value - closure.approach * delta - closure.load * self.equations.load(pressure)
            forcing = float(np.clip(0.3 * self.tolerance / error, *FORCING)) if error < np.inf else FORCING[1]
            dp, dd, count = self._step(linear, np.where(wet, -residual, 0.0), miss, forcing)
            iterations += count
            share, film = self._damped(film, dp, dd)
            pressure, delta = pressure + share * dp, delta + share * dd
            size = max(float(np.max(abs(dp))), abs(dd))
            error = size * (forcing + self.equations.Q0 * size) if share == 1.0 else np.inf
        raise ConvergenceError(
            f"Newton's method for the contact must converge within {MAX_STEPS} steps to "
            f"{self.tolerance:.0e}, got an error of {error:.1e} at delta = {delta:.6g}"
        )

    def _linear(self, place: Place) -> _Linear:
        pressure, film, wet, closure, rate = place
        derivatives = self.equations.derivatives(pressure, film, rate)
        by_delta = derivatives.by_film @ np.ones(derivatives.by_film.shape[1])
        return _Linear(derivatives, np.where(wet, by_delta, 0.0), wet, closure, rate, place)

    def _step(
        self, linear: _Linear, residual: Array, miss: float, forcing: float
    ) -> tuple[Array, float, int]:
        """Return the changes of pressure and approach, and the iterations."""
        if linear.closure.approach == 0.0 and not np.any(linear.wet):
            raise ConvergenceError("some cell must hold film for a load to rest on, got none")
        limit = STALE * self.equations.grid.shape[0]
        fresh = self._factors is None or int(np.sum(self._factors.wet != linear.wet)) > limit
        factors = self._factors = (
            self._factorized(linear) if fresh or self._factors is None else self._factors
        )
        answer, count = self._krylov(linear, factors, residual, miss, forcing)
        if count >= KRYLOV and not fresh:
            self._factors = self._factorized(linear)
            answer, more = self._krylov(linear, self._factors, residual, miss, forcing)
            count += more
        return np.where(linear.wet, answer[:-1], 0.0), float(answer[-1]), count

    def _factorized(self, linear: _Linear) -> Factors:
        if self._change is None:
            self._change = distribution(self.equations)
        self.place = linear.place
        return factorize(
            self.equations, self._change, linear.derivatives, linear.wet, linear.closure, linear.rate
        )

    def _krylov(
        self, linear: _Linear, factors: Factors, residual: Array, miss: float, forcing: float
    ) -> tuple[Array, int]:
        """Return the solution of the linear equations by GMRES, preconditioned from the right."""
        # The two residuals count alike: film equations per V, the closure per its coefficients.
        scales = np.full(len(residual) + 1, 1.0 / self.equations.V)
        scales[-1] = 1.0 / (abs(linear.closure.approach) + 2.0 * linear.closure.load)

        def product(y: Array) -> Array:
            return scales * self._product(linear, self._preconditioned(linear, factors, y / scales))

        y, count = gmres(product, scales * np.append(residual, miss), tolerance=forcing, most=KRYLOV)
        return self._preconditioned(linear, factors, y / scales), count

    def _product(self, linear: _Linear, x: Array) -> Array:
        pressure = np.where(linear.wet, x[:-1], 0.0)
        by_pressure, by_film = linear.derivatives
        bent = self.equations.sampling.deflection(pressure)
        film = by_pressure @ pressure + by_film @ bent + linear.by_delta * x[-1]
        closure = linear.closure.approach * x[-1] + linear.closure.load * self.equations.load(pressure)
        return np.append(np.where(linear.wet, film, x[:-1]), closure)

    def _preconditioned(self, linear: _Linear, factors: Factors, y: Array) -> Array:
        pressure = np.where(linear.wet, factors.pressures(y[:-1]), y[:-1])
        delta = (y[-1] - linear.closure.load * self.equations.load(pressure)) / factors.pivot
        return np.append(pressure - factors.shift * linear.wet * delta, delta)

    def _damped(self, film: Array, dp: Array, dd: float) -> tuple[float, Array]:
        """Return the share of a step that keeps a film everywhere, and the film after it."""
        change = self.equations.sampling.deflection(dp) + dd
        lost = float(np.max(-change / film))
        share = min(1.0, (1.0 - SHRINK) / lost) if lost > 0.0 else 1.0
        return share, film + share * change
