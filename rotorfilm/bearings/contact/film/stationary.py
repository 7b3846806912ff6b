"""Stationary solution of a point contact: from the dry contact, from coarse to fine, from easy to hard."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ....errors import ConvergenceError
from ....model import Array
from .coarse_correction import prolonged
from .contact_newton import Contact, NewtonKrylov
from .film_equations import ContactEquations, TimeDerivative
from .linear_contact import Closure

HERTZ_LOAD = 2.0 * math.pi / 3.0
"""Integral of the pressure of the dry contact, sqrt(1 - r^2): the unit of the load f."""

COARSEST = 32
"""Fewest cells along a side down to which grids are halved."""

EASY = (0.1, 5.0)
"""V and Q0 from which harder contacts are reached: solvable from the dry contact on any grid."""

LIFTED, LIGHTEST = 0.3, 0.05
"""Approach at which a contact has hardly any load, and the load from which lifted contacts are sought."""

FARTHEST, CLOSE, SEARCHES = 1.0, 1e-4, 30
"""Of the search for an approach: largest change of ln(load), error of ln(load) to end it, and its steps."""

SMALLEST_MOVE = 1.0 / 64.0
"""Share of the way from easy to hard below which the search is given up."""


def dry_contact(equations: ContactEquations, load: float) -> tuple[Array, float]:
    """Return pressure, flat, and approach of the dry contact (Hertz) under `load` times the unit load."""
    x, y = equations.grid.x[:, None], equations.grid.y
    radius = load ** (1.0 / 3.0)
    return np.sqrt(np.maximum(radius**2 - x**2 - y**2, 0.0)).ravel(), -2.0 * radius**2


def stationary(equations: ContactEquations, load: float, tolerance: float = 1e-7) -> Contact:
    """Return the stationary solution under `load` times the Hertzian unit load.

    Raises
    ------
    ConvergenceError
        If Newton's method fails, also along the way from an easier contact.
    """
    coarse = equations.halved
    if coarse is None or min(coarse.grid.cells) < COARSEST:
        return _from_dry(equations, load, tolerance)
    try:
        below = stationary(coarse, load, max(tolerance, 1e-4))
        guess = prolonged(below.pressure.reshape(coarse.grid.shape)).ravel()
        return _solved(equations, guess, below.delta, load, tolerance)
    except ConvergenceError:
        return _from_dry(equations, load, tolerance)


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
    level = math.log(max((0.5 * (LIFTED - delta)) ** 1.5, LIGHTEST) if delta < LIFTED else LIGHTEST)
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
        f"delta must be reached by some load, got {found.delta:.6g} instead of {delta:.6g}"
    )


def _solved(
    equations: ContactEquations, pressure: Array, delta: float, load: float, tolerance: float
) -> Contact:
    solver = NewtonKrylov(equations, tolerance)
    return solver.solve(pressure, delta, Closure(0.0, 1.0, HERTZ_LOAD * load), TimeDerivative())


def _from_dry(equations: ContactEquations, load: float, tolerance: float) -> Contact:
    """Return the solution by continuation in ln V and Q0 from a contact that is solvable at once."""
    easy = (max(equations.V, EASY[0]), min(equations.Q0, EASY[1]))
    pressure, delta = dry_contact(equations, load)
    # Thick enough to be positive, thin enough to be near: films are some V^(2/3).
    found = _solved(_at(equations, easy, 0.0), pressure, delta + easy[0] ** (2.0 / 3.0), load, tolerance)
    done, move = 0.0, 1.0
    while done < 1.0 and easy != (equations.V, equations.Q0):
        share = min(1.0, done + move)
        try:
            near = _at(equations, easy, share)
            found = _solved(near, found.pressure, found.delta, load, tolerance)
        except ConvergenceError:
            move *= 0.5
            if move < SMALLEST_MOVE:
                raise
        else:
            done, move = share, 1.5 * move
    return found


def _at(equations: ContactEquations, easy: tuple[float, float], share: float) -> ContactEquations:
    """Return the equations at a share of the way from the easy contact to the one asked for."""
    speed = easy[0] ** (1.0 - share) * equations.V**share
    return replace(equations, V=speed, Q0=(1.0 - share) * easy[1] + share * equations.Q0)
