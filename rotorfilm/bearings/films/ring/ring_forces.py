"""Force of a two-dimensional film and its derivatives, for batches of states.

With the free nodes I and N = integral of n over the cells, A_II P_I = (N w - A P_held)_I and F = -12 N^T P.
A is symmetric, so where the free set and the lines stay, two solutions V = A_II^-1 N_I make the whole
derivative:

    dF/dw = -12 V^T N,    dF/de = 12 V^T dA P.

The pressure and its slope vanish at the edge of a ruptured zone, so moving the edge adds nothing.
"""

from __future__ import annotations

import numpy as np

from ....model import Array
from ..compiled import compiled
from .ring_coefficients import CellCoefficients, ring_coefficients
from .ring_grids import Grid, Spans
from .ring_solver import Factor, film_equations_slope, solve_film, solve_free


@compiled
def film_source(normal: Array, grid: Grid, w: Array) -> Array:
    """Return w times the integral of n over the cells, shape (N, M)."""
    source = np.empty((len(normal), len(grid.width)))
    for i in range(len(normal)):
        around = normal[i, 0] * w[0] + normal[i, 1] * w[1]
        for j in range(len(grid.width)):
            source[i, j] = around * grid.width[j]
    return source


@compiled
def film_force(normal: Array, grid: Grid, pressure: Array, clipped: bool) -> Array:
    """Return -12 times the integral of P n, of positive P alone if clipped, shape (2,)."""
    if clipped:
        pressure = pressure.copy()
        for i in range(pressure.shape[0]):
            for j in range(pressure.shape[1]):
                pressure[i, j] = max(pressure[i, j], 0.0)
    mean, force = pressure @ grid.width, np.zeros(2)
    for i in range(len(mean)):
        for k in range(2):
            force[k] += normal[i, k] * mean[i]
    for k in range(2):
        force[k] *= -12.0
    return force


@compiled
def first_guess(source: Array, grid: Grid, searched: bool) -> np.ndarray:
    """Return the free nodes to begin with: where the source drives pressure, or the whole film."""
    free = np.zeros(source.shape, dtype=np.bool_)
    for i in range(len(grid.span)):
        for j in range(len(grid.width)):
            free[i, j] = not grid.held[i] and (not searched or source[i, 0] > 0.0)
    return free


@compiled
def refined(coarse: np.ndarray, grid: Grid, searched: bool) -> np.ndarray:
    """Return the free nodes of a grid from those of the next coarser one: all that see a free node."""
    lines, nodes = len(grid.span), len(grid.width)
    free = np.zeros((lines, nodes), dtype=np.bool_)
    for i in range(lines):
        left, right = i // 2, (i + 1) // 2 % len(coarse)
        for j in range(nodes):
            near, far = j // 2, min((j + 1) // 2, coarse.shape[1] - 1)
            seen = coarse[left, near] or coarse[right, near] or coarse[left, far] or coarse[right, far]
            free[i, j] = not grid.held[i] and (seen or not searched)
    return free


@compiled
def film_batch(
    e: Array,
    w: Array,
    slenderness: float,
    spans: Spans,
    grids: tuple[Grid, ...],
    searched: bool,
    clipped: bool,
    slopes: bool,
) -> tuple[Array, Array, Array, int]:
    """Return forces on the finest and the next coarser grid, derivatives, and the index of a failure or -1.

    Forces have shape (2, B), d force / d (e, w) on the finest grid (2, 4, B) with `slopes`, else (2, 4, 0).
    One kernel for both, because compiling the solver takes most of the time.
    """
    fine, coarse = np.zeros(e.shape), np.zeros(e.shape)
    jacobian = np.zeros((2, 4, e.shape[1] if slopes else 0))
    eb, wb = np.empty(2), np.empty(2)
    for b in range(e.shape[1]):
        for k in range(2):
            eb[k], wb[k] = e[k, b], w[k, b]
        free = np.zeros((0, 0), dtype=np.bool_)
        for level in range(len(grids) - 1, -1, -1):
            grid = grids[level]
            coefficients = ring_coefficients(eb, slenderness, spans, grid)
            source = film_source(coefficients.normal, grid, wb)
            free = refined(free, grid, searched) if free.size else first_guess(source, grid, searched)
            pressure, factor, found = solve_film(coefficients, grid, source, free, searched)
            if not found:
                return fine, coarse, jacobian, b
            if slopes and level == 0:
                derivative(coefficients, grid, pressure, factor, free, clipped, jacobian[:, :, b])
            force = film_force(coefficients.normal, grid, pressure, clipped)
            for k in range(2):
                coarse[k, b], fine[k, b] = fine[k, b], force[k]
    return fine, coarse, jacobian, -1


@compiled
def finest(
    e: Array, w: Array, slenderness: float, spans: Spans, grids: tuple[Grid, ...], searched: bool
) -> tuple[CellCoefficients, Array, bool]:
    """Return coefficients, pressure and success on the finest grid for one state (2,)."""
    free = np.zeros((0, 0), dtype=np.bool_)
    for level in range(len(grids) - 1, -1, -1):
        coefficients = ring_coefficients(e, slenderness, spans, grids[level])
        source = film_source(coefficients.normal, grids[level], w)
        free = (
            refined(free, grids[level], searched)
            if free.size
            else first_guess(source, grids[level], searched)
        )
        pressure, _, found = solve_film(coefficients, grids[level], source, free, searched)
    return coefficients, pressure, found


@compiled
def derivative(
    coefficients: CellCoefficients,
    grid: Grid,
    pressure: Array,
    factor: Factor,
    free: np.ndarray,
    clipped: bool,
    jacobian: Array,
) -> None:
    """Set jacobian to d force / d (e, w), (2, 4), at a solution, free nodes and lines held."""
    for k in range(2):
        weight = film_source(coefficients.normal, grid, _unit(k))
        if clipped:
            for i in range(pressure.shape[0]):
                for j in range(pressure.shape[1]):
                    weight[i, j] = weight[i, j] if pressure[i, j] > 0.0 else 0.0
        answer = solve_free(factor, free, weight)
        for m in range(2):
            bent = film_equations_slope(coefficients, grid, pressure, m)
            jacobian[k, m] = 12.0 * sum_of_products(answer, bent)
            driven = film_source(coefficients.normal, grid, _unit(m))
            jacobian[k, 2 + m] = -12.0 * sum_of_products(answer, driven)


@compiled
def sum_of_products(a: Array, b: Array) -> float:
    """Return the sum of products of the entries."""
    total = 0.0
    for i in range(a.shape[0]):
        for j in range(a.shape[1]):
            total += a[i, j] * b[i, j]
    return total


@compiled
def _unit(k: int) -> Array:
    return np.array([1.0 - k, 1.0 * k])
