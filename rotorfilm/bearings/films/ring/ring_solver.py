"""Direct solution of the film's equations on a ring: banded Cholesky, and the ruptured zone by active sets.

Unknowns are numbered line by line, so the matrix is banded with the number of axial nodes M as half-width;
the ring is cut at one line, whose M unknowns border the matrix. A ruptured film is cut where it is ruptured
and has no border. Nodes that are not free are rows of the identity.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....model import Array
from ..compiled import compiled, compiled_sums
from .ring_coefficients import CellCoefficients
from .ring_grids import Grid

MAX_SWEEPS = 200
"""Active sets tried; each step of a monotone search moves the edge of the film, so few are needed."""


class Factor(NamedTuple):
    """Cholesky factor of the bordered matrix.

    Attributes
    ----------
    band : ndarray, shape ((N - 1) M, M + 1)
        Rows of the lower factor; the last entry is the inverse of the diagonal.
    border : ndarray, shape (M, (N - 1) M)
        Rows of the lower factor that belong to the line of the cut.
    corner : ndarray, shape (M, M)
    cut : int
        The line at which the ring is cut.
    bordered : bool
        Whether that line has free nodes.
    """

    band: Array
    border: Array
    corner: Array
    cut: int
    bordered: bool


@compiled
def film_equations(coefficients: CellCoefficients, grid: Grid, pressure: Array) -> Array:
    """Return A P, the flow out of each cell, shape (N, M)."""
    return _flow(coefficients.around, coefficients.along, grid, pressure)


@compiled
def film_equations_slope(
    coefficients: CellCoefficients, grid: Grid, pressure: Array, component: int
) -> Array:
    """Return (dA/de_component) P, shape (N, M)."""
    around = coefficients.around_slope[:, component].copy()
    along = coefficients.along_slope[:, component].copy()
    return _flow(around, along, grid, pressure)


@compiled
def _flow(around: Array, along: Array, grid: Grid, pressure: Array) -> Array:
    lines, nodes = pressure.shape
    flow = np.zeros((lines, nodes))
    for i in range(lines):
        after = i + 1 if i + 1 < lines else 0
        for j in range(nodes):
            q = around[i] * grid.width[j] * (pressure[i, j] - pressure[after, j])
            flow[i, j] += q
            flow[after, j] -= q
            beyond = pressure[i, j + 1] if j + 1 < nodes else 0.0
            q = along[i] * grid.conductance[j] * (pressure[i, j] - beyond)
            flow[i, j] += q
            if j + 1 < nodes:
                flow[i, j + 1] -= q
    return flow


@compiled
def factorize(coefficients: CellCoefficients, grid: Grid, free: np.ndarray) -> Factor:
    """Return the factor of the equations of the free nodes."""
    lines, nodes = free.shape
    cut, count = _emptiest_line(free)
    band = np.zeros(((lines - 1) * nodes, nodes + 1))
    bordered = count > 0
    border = np.zeros((nodes if bordered else 0, (lines - 1) * nodes))
    corner = np.zeros((nodes, nodes))
    _assemble(coefficients, grid, free, cut, band, border, corner)
    _cholesky_band(band)
    if bordered:
        _eliminate_border(band, border, corner, free[cut])
    return Factor(band, border, corner, cut, bordered)


@compiled
def _emptiest_line(free: np.ndarray) -> tuple[int, int]:
    """Return the line with the fewest free nodes, and their number."""
    best, fewest = 0, free.shape[1] + 1
    for i in range(free.shape[0]):
        count = 0
        for j in range(free.shape[1]):
            count += free[i, j]
        if count < fewest:
            best, fewest = i, count
    return best, fewest


@compiled
def _assemble(
    coefficients: CellCoefficients,
    grid: Grid,
    free: np.ndarray,
    cut: int,
    band: Array,
    border: Array,
    corner: Array,
) -> None:
    lines, nodes = free.shape
    for k in range(lines - 1):
        i = (cut + 1 + k) % lines
        before = (i - 1) % lines
        for j in range(nodes):
            q = k * nodes + j
            if not free[i, j]:
                band[q, nodes] = 1.0
                continue
            band[q, nodes] = _diagonal(coefficients, grid, i, j)
            if j > 0 and free[i, j - 1]:
                band[q, nodes - 1] = -coefficients.along[i] * grid.conductance[j - 1]
            if k > 0 and free[before, j]:
                band[q, 0] = -coefficients.around[before] * grid.width[j]
    if len(border) == 0:
        return
    after, before = (cut + 1) % lines, (cut - 1) % lines
    for j in range(nodes):
        if not free[cut, j]:
            corner[j, j] = 1.0
            continue
        corner[j, j] = _diagonal(coefficients, grid, cut, j)
        if j > 0 and free[cut, j - 1]:
            corner[j, j - 1] = -coefficients.along[cut] * grid.conductance[j - 1]
        if free[after, j]:
            border[j, j] = -coefficients.around[cut] * grid.width[j]
        if free[before, j]:
            border[j, (lines - 2) * nodes + j] = -coefficients.around[before] * grid.width[j]


@compiled
def _diagonal(coefficients: CellCoefficients, grid: Grid, i: int, j: int) -> float:
    around = coefficients.around[i] + coefficients.around[i - 1]
    inward = grid.conductance[j - 1] if j > 0 else 0.0
    return around * grid.width[j] + coefficients.along[i] * (grid.conductance[j] + inward)


@compiled_sums
def _cholesky_band(band: Array) -> None:
    """Replace the rows of a banded matrix by those of its lower factor, the diagonal inverted."""
    size, half = band.shape[0], band.shape[1] - 1
    for q in range(size):
        row = band[q]
        first = max(0, half - q)
        while first < half and row[first] == 0.0:
            first += 1
        for m in range(first, half):
            other = band[q - half + m]
            shift = half - m
            total = row[m]
            for t in range(first, m):
                total -= row[t] * other[t + shift]
            row[m] = total * other[half]
        total = row[half]
        for t in range(first, half):
            total -= row[t] * row[t]
        row[half] = 1.0 / np.sqrt(total)


@compiled
def _eliminate_border(band: Array, border: Array, corner: Array, free: np.ndarray) -> None:
    nodes = len(corner)
    for j in range(nodes):
        if free[j]:
            _forward(band, border[j])
    for j in range(nodes):
        for k in range(j + 1):
            corner[j, k] -= np.dot(border[j], border[k])
    for j in range(nodes):
        for k in range(j):
            corner[j, k] = (corner[j, k] - np.dot(corner[j, :k], corner[k, :k])) * corner[k, k]
        corner[j, j] = 1.0 / np.sqrt(corner[j, j] - np.dot(corner[j, :j], corner[j, :j]))


@compiled_sums
def _forward(band: Array, x: Array) -> None:
    half = band.shape[1] - 1
    for q in range(len(x)):
        total = x[q]
        for m in range(max(0, half - q), half):
            total -= band[q, m] * x[q - half + m]
        x[q] = total * band[q, half]


@compiled
def _backward(band: Array, x: Array) -> None:
    half = band.shape[1] - 1
    for q in range(len(x) - 1, -1, -1):
        x[q] *= band[q, half]
        for m in range(max(0, half - q), half):
            x[q - half + m] -= band[q, m] * x[q]


@compiled
def solve_free(factor: Factor, free: np.ndarray, flow: Array) -> Array:
    """Return the solution for a right-hand side (N, M), 0 at nodes that are not free."""
    lines, nodes = free.shape
    x = np.empty((lines, nodes))
    for k in range(lines):
        i = (factor.cut + 1 + k) % lines
        for j in range(nodes):
            x[k, j] = flow[i, j] if free[i, j] else 0.0
    chain, last = x[: lines - 1].reshape(-1), x[lines - 1]
    _forward(factor.band, chain)
    if factor.bordered:
        for j in range(nodes):
            last[j] = (last[j] - np.dot(factor.border[j], chain) - np.dot(factor.corner[j, :j], last[:j])) * (
                factor.corner[j, j]
            )
        for j in range(nodes - 1, -1, -1):
            last[j] *= factor.corner[j, j]
            for k in range(j):
                last[k] -= factor.corner[j, k] * last[j]
        for j in range(nodes):
            for q in range(len(chain)):
                chain[q] -= factor.border[j, q] * last[j]
    _backward(factor.band, chain)
    solution = np.empty((lines, nodes))
    for k in range(lines):
        for j in range(nodes):
            solution[(factor.cut + 1 + k) % lines, j] = x[k, j]
    return solution


@compiled
def excess_source(coefficients: CellCoefficients, grid: Grid, pressure: Array, source: Array) -> Array:
    """Return source - A P, shape (N, M)."""
    excess = film_equations(coefficients, grid, pressure)
    for i in range(source.shape[0]):
        for j in range(source.shape[1]):
            excess[i, j] = source[i, j] - excess[i, j]
    return excess


@compiled
def _largest(values: Array) -> float:
    largest = 0.0
    for i in range(values.shape[0]):
        for j in range(values.shape[1]):
            largest = max(largest, abs(values[i, j]))
    return largest


@compiled
def held_pressure(grid: Grid) -> Array:
    """Return the pressure of the openings, 0 elsewhere, shape (N, M)."""
    pressure = np.zeros((len(grid.span), len(grid.width)))
    for i in range(len(grid.span)):
        for j in range(len(grid.width)):
            pressure[i, j] = grid.value[i]
    return pressure


@compiled
def solve_film(
    coefficients: CellCoefficients, grid: Grid, source: Array, free: np.ndarray, searched: bool
) -> tuple[Array, Factor, bool]:
    """Return pressure (N, M) for a source (N, M), factor, and whether the search for the film ended.

    The film is where `free` says, or, if searched, where p > 0, with p >= 0 elsewhere: `free` is updated.
    The search is a primal-dual active set method: for this M-matrix it is Newton's method for
    min(A P - b, P) = 0 and climbs monotonically to the solution after its first step (Hintermueller, Ito &
    Kunisch 2003, theorem 3.3).
    """
    threshold = 1e-13 * _largest(source)
    held = held_pressure(grid)
    flow = excess_source(coefficients, grid, held, source)
    for _ in range(MAX_SWEEPS):
        factor = factorize(coefficients, grid, free)
        pressure = solve_free(factor, free, flow)
        for i in range(free.shape[0]):
            for j in range(free.shape[1]):
                pressure[i, j] += held[i, j]
        if not searched:
            return pressure, factor, True
        excess = excess_source(coefficients, grid, pressure, source)
        changed = False
        for i in range(free.shape[0]):
            if grid.held[i]:
                continue
            for j in range(free.shape[1]):
                keep = pressure[i, j] > 0.0 if free[i, j] else excess[i, j] > threshold
                changed = changed or keep != free[i, j]
                free[i, j] = keep
        if not changed:
            return pressure, factor, True
    return pressure, factor, False
