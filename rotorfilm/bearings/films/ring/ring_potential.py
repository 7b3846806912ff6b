"""Potential of a ruptured two-dimensional film, J = F.w/2, for one place of the journal and many directions.

The discrete film minimizes 12 (P.A P/2 - P.N w) over P >= 0, J(e, w) is the minimum, so F = dJ/dw to the
last digit of the discrete equations. With the lines of the grid held dJ/de = 6 P.(dA P): the pressure, a
minimizer, need not be differentiated.
"""

from __future__ import annotations

import numpy as np

from ....model import Array
from ..compiled import compiled
from .ring_coefficients import ring_coefficients
from .ring_forces import film_source, first_guess, refined, sum_of_products
from .ring_grids import Grid, Spans
from .ring_solver import film_equations_slope, solve_film


@compiled
def potential_fan(
    e: Array, w: Array, slenderness: float, spans: Spans, grids: tuple[Grid, ...]
) -> tuple[Array, Array, int]:
    """Return J on every grid, (levels, D), dJ/de, (levels, 2, D), and the index of a failure or -1.

    Parameters
    ----------
    e : ndarray, shape (2,) [1]
    w : ndarray, shape (2, D) [1/s]
        Sources; openings are at pressure 0.
    slenderness : float [1]
    spans : Spans
    grids : tuple of Grid
        Finest first, as the answers.
    """
    levels, count = len(grids), w.shape[1]
    potential, slope = np.zeros((levels, count)), np.zeros((levels, 2, count))
    known = np.zeros((count, 0, 0), dtype=np.bool_)
    for level in range(levels - 1, -1, -1):
        grid = grids[level]
        coefficients = ring_coefficients(e, slenderness, spans, grid)
        found_sets = np.zeros((count, len(grid.span), len(grid.width)), dtype=np.bool_)
        wd = np.empty(2)
        for d in range(count):
            for k in range(2):
                wd[k] = w[k, d]
            source = film_source(coefficients.normal, grid, wd)
            free = first_guess(source, grid, True) if level == levels - 1 else refined(known[d], grid, True)
            pressure, _, found = solve_film(coefficients, grid, source, free, True)
            if not found:
                return potential, slope, d
            for i in range(free.shape[0]):
                for j in range(free.shape[1]):
                    found_sets[d, i, j] = free[i, j]
            potential[level, d] = -6.0 * sum_of_products(pressure, source)
            for m in range(2):
                bent = film_equations_slope(coefficients, grid, pressure, m)
                slope[level, m, d] = 6.0 * sum_of_products(pressure, bent)
        known = found_sets
    return potential, slope, -1
