"""Film laws against what a competent user would write instead: cost at equal error, all in one run.

Baseline: the Reynolds equation on the arc [0, pi] by second-order finite volumes on half the length, with and
without Richardson extrapolation. Of all grids, from two cells on, each film law meets the cheapest one whose
error is no larger than its own; "n/a" where no grid comes within a factor of three. One state at a time the
baseline uses a banded Cholesky solver, in a batch also a dense one, whichever is faster. Errors are medians
over random states, relative to the converged spectral film.

    python benchmarks/films.py
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded

from rotorfilm.bearings import FilmLaw
from rotorfilm.bearings.journal import ShortFilm, SpectralArcFilm, SplittingFilm
from rotorfilm.studies import shortest_time

SLENDERNESS = (0.25, 1.0)
STATES, COPIES = 12, 8
EQUAL = 3.0
"""Errors within this factor count as equal."""

AROUND = (2, 3, 4, 6, 8, 12, 16, 20, 24, 32, 40, 48, 64)
ALONG = (1, 2, 3, 4, 6, 8, 12)
DENSE = 96
"""Most cells of a batch of dense matrices."""

ORDERS = ((1, 1), (2, 1), (2, None), (4, 2), (4, None), (6, 3), (6, None))


class Grid(NamedTuple):
    """Cells around the arc and over half the length; whether extrapolated with a grid twice as fine."""

    around: int
    along: int
    extrapolated: bool


class Cost(NamedTuple):
    """Median error, and time of one force alone and in a batch [s]."""

    error: float
    alone: float
    batched: float


def bands(chi: NDArray, slenderness: float, around: int, along: int) -> tuple[NDArray, NDArray, NDArray]:
    """Return diagonal, coupling along and coupling around of the matrices, each (states, around, along)."""
    d, dz = math.pi / around, 0.5 / along
    gamma = (np.arange(around) + 0.5) * d
    face = (1.0 + chi[:, None] * np.cos(np.arange(around + 1) * d)) ** 3 / d**2
    film = (1.0 + chi[:, None] * np.cos(gamma)) ** 3 / (2.0 * slenderness * dz) ** 2
    # A boundary lies half a cell away, the plane of symmetry lets nothing through.
    face[:, [0, -1]] *= 2.0
    neighbors = np.full(along, 2.0)
    neighbors[0] += 1.0
    neighbors[-1] -= 1.0
    diagonal = (face[:, :-1] + face[:, 1:])[:, :, None] + film[:, :, None] * neighbors
    beside = np.repeat(-film[:, :, None], along, axis=2)
    beside[:, :, -1] = 0.0
    ahead = np.repeat(-face[:, 1:, None], along, axis=2)
    ahead[:, -1] = 0.0
    return diagonal, beside, ahead


def solve_banded(parts: tuple[NDArray, NDArray, NDArray], right: NDArray) -> NDArray:
    """Return the pressures, state by state."""
    states, around, along = right.shape
    flat = [part.reshape(states, -1) for part in parts]
    lower = np.zeros((states, along + 1, around * along))
    lower[:, 0], lower[:, along] = flat[0], flat[2]
    lower[:, 1] += flat[1]
    solutions = [
        solveh_banded(matrix, b.ravel(), lower=True, check_finite=False)
        for matrix, b in zip(lower, right, strict=True)
    ]
    return np.array(solutions).reshape(right.shape)


def solve_dense(parts: tuple[NDArray, NDArray, NDArray], right: NDArray) -> NDArray:
    """Return the pressures of all states at once."""
    states, around, along = right.shape
    cells = np.arange(around * along)
    diagonal, beside, ahead = (part.reshape(states, -1) for part in parts)
    matrix = np.zeros((states, cells.size, cells.size))
    matrix[:, cells, cells] = diagonal
    for offset, band in ((1, beside), (along, ahead)):
        matrix[:, cells[:-offset], cells[offset:]] += band[:, :-offset]
        matrix[:, cells[offset:], cells[:-offset]] += band[:, :-offset]
    return np.linalg.solve(matrix, right.reshape(states, -1, 1)).reshape(right.shape)


def finite_volumes(e: NDArray, w: NDArray, slenderness: float, grid: Grid, solve: Callable) -> NDArray:
    """Return the forces by finite volumes, shape (2, states), for eccentricities along +x."""
    if grid.extrapolated:
        coarse = finite_volumes(e, w, slenderness, grid._replace(extrapolated=False), solve)
        fine = finite_volumes(e, w, slenderness, Grid(2 * grid.around, 2 * grid.along, False), solve)
        return (4.0 * fine - coarse) / 3.0
    gamma = (np.arange(grid.around) + 0.5) * math.pi / grid.around
    directions = np.stack([np.cos(gamma), np.sin(gamma)])
    source = np.repeat((w.T @ directions)[:, :, None], grid.along, axis=2)
    pressure = solve(bands(e[0], slenderness, grid.around, grid.along), source)
    load = -12.0 * math.pi / (grid.around * grid.along) * pressure.sum(axis=2)
    return directions @ load.T


def measured(force: Callable[[NDArray, NDArray], NDArray], e: NDArray, w: NDArray, exact: NDArray) -> Cost:
    """Return error and cost of a force law."""
    error = np.linalg.norm(force(e, w) - exact, axis=0) / np.linalg.norm(exact, axis=0)
    many_e, many_w = np.tile(e, COPIES), np.tile(w, COPIES)
    alone = shortest_time(lambda: force(e[:, :1], w[:, :1]), 10)
    batched = shortest_time(lambda: force(many_e, many_w), 5) / many_e.shape[1]
    return Cost(float(np.median(error)), alone, min(alone, batched))


def baselines(e: NDArray, w: NDArray, slenderness: float, exact: NDArray) -> dict[Grid, Cost]:
    """Return error and cost of all grids."""
    costs = {}
    for grid in [Grid(n, m, x) for n in AROUND for m in ALONG if m <= n for x in (False, True)]:
        cells = grid.around * grid.along * (4 if grid.extrapolated else 1)
        solvers = [solve_banded, solve_dense] if cells <= DENSE else [solve_banded]
        tried = [
            measured(lambda a, b, g=grid, s=s: finite_volumes(a, b, slenderness, g, s), e, w, exact)
            for s in solvers
        ]
        costs[grid] = Cost(tried[0].error, min(t.alone for t in tried), min(t.batched for t in tried))
    return costs


def comparison(own: Cost, rivals: dict[Grid, Cost]) -> str:
    """Return the cheapest grid that is no worse than the film law, and how much more it costs."""
    able = {grid: cost for grid, cost in rivals.items() if cost.error <= own.error}
    texts = []
    for kind in ("batched", "alone"):
        grid = min(able, key=lambda grid, kind=kind: getattr(able[grid], kind), default=None)
        if grid is None or own.error > EQUAL * able[grid].error:
            texts.append(f"{'n/a':>28s}")
            continue
        name = f"{grid.around}x{grid.along}{'R' if grid.extrapolated else ''}"
        ratio = getattr(able[grid], kind) / getattr(own, kind)
        texts.append(f"{name:>9s} {able[grid].error:9.1e} {ratio:6.1f} x")
    return " ".join(texts)


def films() -> dict[str, FilmLaw]:
    """Return the film laws by name."""
    laws = {f"splitting {n}, {m or 'all'}": SplittingFilm(order=(n, m)) for n, m in ORDERS}
    return {**laws, "converged (Ritz, 48)": SpectralArcFilm()}


def table(slenderness: float) -> None:
    """Print the table of one length."""
    generator = np.random.default_rng(1)
    e = np.stack([generator.uniform(0.1, 0.9, STATES), np.zeros(STATES)])
    w = generator.normal(size=(2, STATES))
    exact = SpectralArcFilm(degree=96).force(e, w, slenderness)
    short = measured(lambda a, b: ShortFilm().force(a, b, slenderness), e, w, exact).batched
    rivals = baselines(e, w, slenderness, exact)
    print(f"\nL/D {slenderness}; ShortFilm in a batch {1e6 * short:.2f} us = 1")
    heads = " ".join(f"{f'finite volumes, {kind}':>28s}" for kind in ("batched", "alone"))
    print(f"{'film law':22s}{'error':>9s}{'cost':>7s}{'alone us':>10s} {heads}")
    for name, law in films().items():
        own = measured(lambda a, b, law=law: law.force(a, b, slenderness), e, w, exact)
        costs = f"{own.error:9.1e}{own.batched / short:7.1f}{1e6 * own.alone:10.0f}"
        print(f"{name:22s}{costs} {comparison(own, rivals)}")


def main() -> None:
    """Print one table for each length."""
    print(f"{STATES} random states, eccentricity ratio 0.1 to 0.9, arc [0, pi]; median errors;")
    print("finite volumes: cells around x over half the length (R: extrapolated), error, time / film law's")
    for slenderness in SLENDERNESS:
        table(slenderness)


if __name__ == "__main__":
    main()
