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
from .coarse_correction import COARSEST, Cycle, HalvedGrid, cycle, halved_grids
from .film_edge import settled_edge
from .film_equations import ContactEquations, TimeDerivative
from .krylov import gmres
from .linear_contact import Closure, LinearContact, Place, linearized

MAX_STEPS = 30
"""Newton steps tried."""

FORCING = (1e-4, 1e-2)
"""Range of the relative residual to which GMRES solves a step: no closer than the step can be of use."""

KRYLOV = 80
"""Most iterations of GMRES in a step."""

FEW = 0.02
"""Cells that may gain or lose film in a step without a search for the film's end, per cells along x."""

STALE = 0.06
"""Cells that may gain or lose film before the preconditioner is renewed, per cells along x, up to `COARSEST`.

Each costs an iteration more, and the factors cost as many iterations on every finer grid. Old coefficients
cost nothing.
"""

SHRINK = 0.2
"""A step may thin the film down to this share at most."""

THINNEST, HIGHEST = 1e-7, 30.0
"""Film thickness below which, and pressure above which, a search has gone astray."""


class Contact(NamedTuple):
    """A solution: pressures (n,), approach, film at the samples, and the Newton and GMRES steps taken."""

    pressure: Array
    delta: float
    film: Array
    steps: int
    iterations: int


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
        self._few = FEW * equations.grid.shape[0]
        self._grids: tuple[HalvedGrid, ...] = ()
        self._cycle: Cycle | None = None
        if place is not None and not equations.is_dense:
            self._cycle = self._renewed(linearized(equations, place))

    @property
    def place(self) -> Place | None:
        """Where the preconditioner was made."""
        return None if self._cycle is None else self._cycle.linear.place

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
            if not (film.min() > THINNEST and pressure.max() < HIGHEST):
                break
            residual = self.equations.residual(pressure, film, time)
            settled = np.where(wet, pressure > 0.0, residual > 0.0)
            moved = int(np.sum(settled != wet))
            if error <= self.tolerance and not moved:
                return Contact(pressure, delta, film, step, iterations)
            here = Place(pressure, film, settled, closure, time.rate)
            here, residual = self._feasible(here, residual, delta, time, far=moved > self._few)
            wet, pressure, film = here.wet, here.pressure, here.film
            linear = linearized(self.equations, here)
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

    def _feasible(
        self, place: Place, residual: Array, delta: float, time: TimeDerivative, *, far: bool
    ) -> tuple[Place, Array]:
        """Return a place with pressures >= 0 and its residual; `far` if the film ends elsewhere."""
        if np.any(place.pressure < 0.0):
            pressure = np.where(place.wet, place.pressure, 0.0)
            place = place._replace(pressure=pressure, film=self.equations.film(pressure, delta))
            residual = self.equations.residual(place.pressure, place.film, time)
        if far:
            pressure = settled_edge(linearized(self.equations, place), residual)
            film = self.equations.film(pressure, delta)
            moved = self.equations.residual(pressure, film, time)
            if film.min() > SHRINK * place.film.min():
                wet = (pressure > 0.0) | (moved > 0.0)
                return place._replace(pressure=pressure, film=film, wet=wet), moved
        return place, residual

    def _step(
        self, linear: LinearContact, residual: Array, miss: float, forcing: float
    ) -> tuple[Array, float, int]:
        """Return the changes of pressure and approach, and the iterations."""
        wet = linear.place.wet
        if linear.place.closure.approach == 0.0 and not np.any(wet):
            raise ConvergenceError("some cell must hold film for a load to rest on, got none")
        right = np.append(residual, miss)
        if self.equations.is_dense:
            answer = linear.solved(right)
            return np.where(wet, answer[:-1], 0.0), float(answer[-1]), 1
        known = self._cycle
        limit = STALE * min(COARSEST, self.equations.grid.shape[0])
        fresh = known is None or int(np.sum(known.linear.place.wet != wet)) > limit
        self._cycle = used = self._renewed(linear) if fresh or known is None else known
        answer, count = self._krylov(linear, used, right, forcing)
        if count >= KRYLOV and not fresh:
            self._cycle = used = self._renewed(linear)
            answer, more = self._krylov(linear, used, right, forcing)
            count += more
        return np.where(wet, answer[:-1], 0.0), float(answer[-1]), count

    def _renewed(self, linear: LinearContact) -> Cycle:
        self._grids = self._grids or halved_grids(self.equations)
        return cycle(self._grids, linear)

    def _krylov(self, linear: LinearContact, used: Cycle, right: Array, forcing: float) -> tuple[Array, int]:
        """Return the solution of the linear equations by GMRES, preconditioned from the right."""
        # The two residuals count alike: film equations per V, the closure per its coefficients.
        scales = np.full(len(right), 1.0 / self.equations.V)
        scales[-1] = 1.0 / (abs(linear.place.closure.approach) + 2.0 * linear.place.closure.load)

        def product(y: Array) -> Array:
            return scales * linear.product(used.answer(y / scales, linear))

        y, count = gmres(product, scales * right, tolerance=forcing, most=KRYLOV)
        return used.answer(y / scales, linear), count

    def _damped(self, film: Array, dp: Array, dd: float) -> tuple[float, Array]:
        """Return the share of a step that keeps a film everywhere, and the film after it."""
        change = self.equations.sampling.deflection(dp) + dd
        lost = float(np.max(-change / film))
        share = min(1.0, (1.0 - SHRINK) / lost) if lost > 0.0 else 1.0
        return share, film + share * change
