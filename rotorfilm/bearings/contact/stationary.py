"""Stationary solution of a point contact: from the dry contact, from coarse to fine, from easy to hard."""

from __future__ import annotations

import math

import numpy as np
from scipy import linalg

from ...core.errors import ConvergenceError
from ...core.model import Array
from ..formulas import CIRCLE
from .film_equations import ContactEquations, Derivatives, TimeDerivative
from .film_newton import Closure, Contact, NewtonKrylov, prolonged

HERTZ_LOAD = CIRCLE.load
"""Integral of the pressure of a circular dry contact, sqrt(1 - r^2): the unit of its load f."""

COARSEST = 32
"""Fewest cells along a side down to which grids are halved."""

EASY = (0.1, 5.0)
"""V and Q0 from which harder contacts are reached: solvable from the dry contact on any grid."""

LIFTED, LIGHTEST = 0.3, 0.05
"""Approach at which a contact has hardly any load, and the load from which lifted contacts are sought."""

FARTHEST, CLOSE, SEARCHES = 1.0, 1e-4, 30
"""Of the search for an approach: largest change of ln(load), error of ln(load) to end it, and its steps."""

THINNEST_SPEED, FINENESS = 0.225, 1.7
"""Smallest V that cells of width 1 would hold at Q0 = 20, and its power of their width."""

MARGIN, PAIRS = 0.8, 16
"""Of advised cells: smallest V they hold per V, and what their numbers are multiples of."""

SMALLEST_MOVE = 1.0 / 64.0
"""Share of the way from easy to hard below which the search is given up."""


def dry_contact(equations: ContactEquations, load: float) -> tuple[Array, float]:
    """Return pressure, flat, and approach of the dry contact (Hertz) under `load` times the unit load."""
    x, y = equations.grid.x[:, None], equations.grid.y
    radius = load ** (1.0 / 3.0)
    pressure = np.sqrt(np.maximum(radius**2 - x**2 - y**2, 0.0)).ravel()
    return pressure, -equations.ellipse.depth * radius**2


def stationary(equations: ContactEquations, load: float, tolerance: float = 1e-7) -> Contact:
    """Return the stationary solution under `load` times the Hertzian unit load.

    Raises
    ------
    ConvergenceError
        If Newton's method fails, also along the way from an easier contact.
    """
    found, share = _reached(equations, load, tolerance)
    if share == 1.0:
        return found
    near, width = _at(equations, share), max(equations.grid.spacing)
    least = thinnest_speed(equations.Q0, width, load)
    finer = (least / (MARGIN * equations.V)) ** (1.0 / FINENESS)
    sides = tuple(PAIRS * math.ceil(finer * n / PAIRS) for n in equations.grid.cells)
    advice = f"take a larger V or {sides} cells" if finer > 1.0 else "take other cells"
    raise ConvergenceError(
        f"the cells must be fine enough for the film at V = {equations.V:.4g}, Q0 = {equations.Q0:.4g}, got "
        f"cells of {width:.3g}, which are known to suffice for V of at least {least:.2g}. Continuation from "
        "a thicker film "
        f"reached V = {near.V:.4g}, Q0 = {near.Q0:.4g} with films of at least {found.film.min():.2g}; "
        f"{advice}"
    )


def thinnest_speed(Q0: float, width: float, load: float = 1.0) -> float:
    """Return about the smallest V whose film cells of a width can hold, to some 10 % (Q0 from 5 to 20).

    Below it the film of the side lobes, the thinnest, vanishes on the cells: found by continuation on 32, 64
    and 128 cells (`docs/contact.md`). A contact under a load is one under the unit load in other units.
    """
    return float(THINNEST_SPEED * width**FINENESS * math.sqrt(20.0 / Q0) * load**0.6)


def follow(equations: ContactEquations, start: Contact, load: float, tolerance: float = 1e-7) -> Contact:
    """Return the stationary solution under a load from one under a load near by."""
    try:
        return _solved(equations, start.pressure, start.delta, load, tolerance)
    except ConvergenceError:
        return stationary(equations, load, tolerance)


def stationary_at(equations: ContactEquations, delta: float, tolerance: float = 1e-7) -> Contact:
    """Return the stationary solution at an approach, from contacts under loads that come close to it.

    Raises
    ------
    ConvergenceError
        If Newton's method fails.
    """
    share = (LIFTED - delta) / equations.ellipse.depth
    level = math.log(max(share**1.5, LIGHTEST) if delta < LIFTED else LIGHTEST)
    found = stationary(equations, math.exp(level), tolerance)
    slope = -(max(LIFTED - found.delta, 0.1)) / 1.5
    for _ in range(SEARCHES):
        miss = delta - found.delta
        if abs(miss) < CLOSE * abs(slope):
            closure = Closure(1.0, 0.0, delta)
            solver = NewtonKrylov(equations, tolerance)
            return solver.solve(found.pressure, delta, closure, TimeDerivative())
        move = min(max(miss / slope, -FARTHEST), FARTHEST)
        before, level = found.delta, level + move
        found = follow(equations, found, math.exp(level), tolerance)
        slope = min((found.delta - before) / move, 0.1 * slope)
    raise ConvergenceError(
        f"a load with the approach delta = {delta:.6g} must exist, and the search ended at {found.delta:.6g}"
    )


def _solved(
    equations: ContactEquations, pressure: Array, delta: float, load: float, tolerance: float
) -> Contact:
    solver = NewtonKrylov(equations, tolerance)
    closure = Closure(0.0, 1.0, equations.ellipse.load * load)
    return solver.solve(pressure, delta, closure, TimeDerivative())


def _reached(equations: ContactEquations, load: float, tolerance: float) -> tuple[Contact, float]:
    """Return a solution on the way from an easy contact, and the share of the way: 1 for the one asked for.

    The way goes by ln V and Q0, on a coarse grid as far as that holds the film, and from there on finer ones.
    """
    coarse, found, done = equations.halved, None, 0.0
    if coarse is not None and min(coarse.grid.cells) >= COARSEST:
        try:
            below, done = _reached(coarse, load, max(tolerance, 1e-4))
            guess = prolonged(below.pressure.reshape(coarse.grid.shape)).ravel()
            found = _solved(_at(equations, done), guess, below.delta, load, tolerance)
        except ConvergenceError:
            done = 0.0
    if found is None:
        pressure, delta = dry_contact(equations, load)
        # Thick enough to be positive, thin enough to be near: films are some V^(2/3).
        easy = _at(equations, done)
        found = _solved(easy, pressure, delta + easy.V ** (2.0 / 3.0), load, tolerance)
        done = 1.0 if easy == equations else 0.0
    move = 1.0
    while done < 1.0 and move >= SMALLEST_MOVE:
        share = min(1.0, done + move)
        try:
            found = _solved(_at(equations, share), found.pressure, found.delta, load, tolerance)
        except ConvergenceError:
            move = 0.5 * (share - done)
        else:
            done, move = share, 1.5 * move
    return found, done


def _at(equations: ContactEquations, share: float) -> ContactEquations:
    """Return the equations at a share of the way from an easy contact to the one asked for."""
    easy_V, easy_Q0 = max(equations.V, EASY[0]), min(equations.Q0, EASY[1])
    if share == 1.0 or (easy_V, easy_Q0) == (equations.V, equations.Q0):
        return equations
    speed = easy_V ** (1.0 - share) * equations.V**share
    return equations.of(V=speed, Q0=(1.0 - share) * easy_Q0 + share * equations.Q0)


# Small motions about a stationary contact: dynamic stiffness and the ball's natural motion.
#
# The cells that hold film stay the same in a small motion, so the linearized equations are those of
# the film cells alone, with rate = s for motions as exp(s t). They are dense; a grid of 64 x 64 cells
# takes a second or two per frequency.


CLOSE_MOTION = 1e-10
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
            if abs(move) < CLOSE_MOTION * abs(now):
                return now
            missed = W * now**2 + self.stiffness(now)
        raise ConvergenceError(
            f"the natural motion near {guess:.4g} was not found: the secant method ended at {now:.4g}"
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
