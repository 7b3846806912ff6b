"""Film laws against what a competent user would write instead: cost at equal error, all in one run.

Baseline: the Reynolds equation on the arc [0, pi], second-order finite volumes on half the length, sparse
direct solver, Richardson-extrapolated from two grids. The grid is refined until its error is no larger than
that of the film law it is compared with. Reference for both: the converged spectral film.

    python benchmarks/films.py
"""

from __future__ import annotations

from time import perf_counter

import numpy as np
from scipy.sparse import diags_array
from scipy.sparse.linalg import spsolve

from rotorfilm.films import FixedArc, ShortFilm, SpectralArcFilm, SplittingFilm

SLENDERNESS = 0.5
CHI = 0.6
ECCENTRICITY, SOURCE = np.array([CHI, 0.0]), np.array([0.2, -0.3])


def finite_volume_force(cells: int) -> np.ndarray:
    """Return the force by finite volumes with `cells` around and cells/4 over half the length."""
    axial = max(cells // 4, 2)
    d, dz = np.pi / cells, 0.5 / axial
    gamma = (np.arange(cells) + 0.5) * d
    face = (1.0 + CHI * np.cos(np.arange(cells + 1) * d)) ** 3
    film = (1.0 + CHI * np.cos(gamma)) ** 3
    east, west = face[1:] / d**2, face[:-1] / d**2
    east_edge, west_edge = np.zeros(cells), np.zeros(cells)
    west_edge[0], east_edge[-1] = 2.0 * west[0], 2.0 * east[-1]
    west[0] = east[-1] = 0.0
    around = -(east + west + east_edge + west_edge)
    along = film / (2.0 * SLENDERNESS) ** 2 / dz**2
    low, high = np.full(axial, 1.0), np.full(axial, 1.0)
    low[0], high[-1] = 2.0, 0.0
    diagonal = around[:, None] - along[:, None] * (low + high)
    size = cells * axial
    upper = np.repeat(along[:, None], axial, 1)
    upper[:, -1] = 0.0
    matrix = diags_array(
        [
            diagonal.ravel(),
            upper.ravel()[:-1],
            upper.ravel()[:-1],
            np.repeat(east, axial)[: size - axial],
            np.repeat(west, axial)[axial:],
        ],
        offsets=[0, 1, -1, axial, -axial],
        format="csc",
    )
    g = SOURCE[1] * np.sin(gamma) + SOURCE[0] * np.cos(gamma)
    pressure = 12.0 * spsolve(matrix, np.repeat(g, axial)).reshape(cells, axial)
    load = 2.0 * dz * d * pressure.sum(axis=1)
    return np.array([load @ np.cos(gamma), load @ np.sin(gamma)])


def extrapolated_force(cells: int) -> np.ndarray:
    """Return the Richardson extrapolation from `cells` and 2 `cells`."""
    return (4.0 * finite_volume_force(2 * cells) - finite_volume_force(cells)) / 3.0


def timed(call, repeats: int = 20) -> float:
    """Return the shortest of several runs [s]."""
    times = []
    for _ in range(repeats):
        begin = perf_counter()
        call()
        times.append(perf_counter() - begin)
    return min(times)


def main() -> None:
    """Print the table."""
    exact = SpectralArcFilm(degree=96, rupture=FixedArc()).force(ECCENTRICITY, SOURCE, SLENDERNESS)

    def error(force: np.ndarray) -> float:
        return float(np.linalg.norm(force - exact) / np.linalg.norm(exact))

    batch_e, batch_w = (np.repeat(v[:, None], 4000, axis=1) for v in (ECCENTRICITY, SOURCE))
    baselines = []
    for cells in (8, 16, 32, 64, 128):
        baselines.append(
            (error(extrapolated_force(cells)), timed(lambda n=cells: extrapolated_force(n), 5), cells)
        )
    short = timed(lambda: ShortFilm().force(batch_e, batch_w, SLENDERNESS), 5) / 4000
    print(f"L/D {SLENDERNESS}, eccentricity ratio {CHI}; batched times; ShortFilm {1e6 * short:.2f} us = 1")
    print(f"{'film':28s}{'error':>10s}{'cost/short':>12s}{'scalar us':>11s}   finite volumes at equal error")
    rungs = [
        (f"splitting {n}, {m or 'all'}", SplittingFilm(order=(n, m))) for n, m in ((1, 1), (2, 1), (2, None))
    ]
    rungs += [
        (f"splitting {n}, {m or 'all'}", SplittingFilm(order=(n, m))) for n, m in ((4, 2), (6, 3), (6, None))
    ]
    rungs.append(("converged (Ritz, 48)", SpectralArcFilm()))
    for name, film in rungs:
        own = error(film.force(ECCENTRICITY, SOURCE, SLENDERNESS))
        cost = timed(lambda f=film: f.force(batch_e[:, :400], batch_w[:, :400], SLENDERNESS), 3) / 400
        scalar = timed(lambda f=film: f.force(ECCENTRICITY, SOURCE, SLENDERNESS))
        rival = next(((e, t, n) for e, t, n in baselines if e <= own), None)
        text = "none of the grids reaches it"
        if rival is not None:
            gain = f"{rival[1] / cost:.0f} x batched, {rival[1] / scalar:.1f} x scalar"
            text = f"error {rival[0]:.1e} ({rival[2]} cells): {gain}"
        print(f"{name:28s}{own:10.1e}{cost / short:12.1f}{1e6 * scalar:11.0f}   {text}")


if __name__ == "__main__":
    main()
