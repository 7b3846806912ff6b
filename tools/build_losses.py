"""Make the table of shear and flow beside that of the impedance map, in some minutes.

python tools/build_losses.py [--workers 2] [--out rotorfilm/bearings/journal/data/journal_losses.bin]
"""

from __future__ import annotations

import argparse
import itertools
import multiprocessing
import os
from pathlib import Path

import numpy as np
from map_nodes import (
    fit_loss_table,
    loss_node_eccentricities,
    loss_node_turns,
    node_losses,
)
from rich.progress import track

from rotorfilm.bearings.journal.map_film import LOSS_FILE as TABLE

OUT = Path(__file__).parents[1] / "rotorfilm" / "bearings" / "journal" / "data" / TABLE
QUANTUM = 1e-7
"""Unit of the stored coefficients, far below the error of the nodes."""

CELLS, REACH, RANGE = (14, 24, 12), 0.99, (0.1, 4.0)
"""Cells in X, s and ln(L/D); largest eccentricity ratio; smallest and largest length/diameter."""


def node(state: tuple[float, float, float]) -> np.ndarray:
    """Return the losses at (L/D, eccentricity ratio, T)."""
    slenderness, chi, turn = state
    return node_losses(chi, turn, slenderness)


def nodes(workers: int) -> np.ndarray:
    """Return the losses at all nodes, (3, n, cells_x + 2, cells_s + 1)."""
    axes = (
        np.geomspace(*RANGE, CELLS[2] + 1).tolist(),
        loss_node_eccentricities(REACH, CELLS[0]).tolist(),
        loss_node_turns(CELLS[1]).tolist(),
    )
    states = list(itertools.product(*axes))
    # One BLAS thread per worker: the matrices are small, and the workers fill the machine.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    with multiprocessing.get_context("spawn").Pool(workers) as pool:
        found = list(track(pool.imap(node, states, chunksize=16), "losses", total=len(states)))
    return np.moveaxis(np.reshape(found, (*map(len, axes), 3)), -1, 0)


def main() -> None:
    """Read the command line, compute and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--out", type=Path, default=OUT)
    arguments = parser.parse_args()
    table = fit_loss_table(
        nodes(arguments.workers), slenderness_range=RANGE, largest_eccentricity_ratio=REACH
    )
    table.save(arguments.out, QUANTUM)
    print(f"{arguments.out}: {arguments.out.stat().st_size} bytes")


if __name__ == "__main__":
    main()
