"""Compare the potential solver with extrapolated finite volumes on random states, as a Markdown table.

Usage: python tools/check_potential.py --states 40
"""

from __future__ import annotations

import argparse
import itertools
import math
import multiprocessing
import os
import sys

import numpy as np
from map_nodes import grid_potential
from map_potential import (
    Source,
    default_resolution,
    directed_potential,
    free_arc,
    region,
    solve_region,
)

LEVELS = ((96, 12), (192, 24), (384, 48))
"""Grids; the errors of J and of its gradient are of order two, what is left of order four."""

BANDS = ((0.0, 0.95), (0.95, 0.99), (0.99, 0.999))


def reference(source: Source) -> tuple[np.ndarray, float]:
    """Return (J, dJ/dg_s, dJ/dg_c) extrapolated twice, and the last gain relative to the force."""
    rows = [np.hstack(grid_potential(source, cells)) for cells in LEVELS]
    once = [(4.0 * fine - coarse) / 3.0 for coarse, fine in itertools.pairwise(rows)]
    twice = (16.0 * once[1] - once[0]) / 15.0
    return twice, float(np.linalg.norm((twice - once[1])[1:]) / np.linalg.norm(twice[1:]))


def errors(source: Source) -> tuple[float, float, float, float]:
    """Return relative errors: J, force, force of the straight first-mode arc, gain of the reference."""
    (J, *force), gain = reference(source)
    resolution = default_resolution(source.chi, source.slenderness)
    film = directed_potential(source, resolution)
    straight = resolution._replace(shapes=1)
    arc = solve_region(source, region(np.array(free_arc(source))[:, None], straight), straight)
    scale = np.linalg.norm(force)
    return (
        abs(-math.exp(film.log) / J - 1.0),
        float(np.linalg.norm(-math.exp(film.log) * film.force - force) / scale),
        float(np.linalg.norm(arc.force - force) / scale),
        gain,
    )


def random_sources(slenderness: float, band: tuple[float, float], states: int) -> list[Source]:
    """Return states uniform in eccentricity ratio within the band and in the direction of the source."""
    rng = np.random.default_rng(7)
    chi, angle = rng.uniform(*band, states), rng.uniform(0.0, 2.0 * np.pi, states)
    return [Source(float(c), math.cos(a), math.sin(a), slenderness) for c, a in zip(chi, angle, strict=True)]


def main() -> None:
    """Write the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--states", type=int, default=40)
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    head = "| L/D | eps | J | force | force, straight arc | gain of the reference |"
    sys.stdout.write(f"{head}\n{6 * '|---'}|\n")
    with multiprocessing.get_context("spawn").Pool(options.workers) as pool:
        for slenderness in (0.1, 0.25, 0.5, 1.0, 2.0, 4.0):
            for band in BANDS:
                rows = pool.map(errors, random_sources(slenderness, band, options.states))
                worst = np.quantile(np.array(rows), 0.99, axis=0)
                cells = " | ".join(f"{value:.1e}" for value in worst)
                sys.stdout.write(f"| {slenderness} | {band[0]}-{band[1]} | {cells} |\n")
                sys.stdout.flush()


if __name__ == "__main__":
    main()
