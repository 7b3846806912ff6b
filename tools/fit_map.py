"""Fit the universal table of the impedance map to its nodal potentials and write the package data.

    python tools/fit_map.py [--nodes NODES.npz] [--out rotorfilm/bearings/journal/data/journal_map.bin]

`tools/build_map.py` computes the nodes (minutes); this takes a second.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from scipy.interpolate import make_interp_spline

from rotorfilm.bearings import MapTable, fit_map_table
from rotorfilm.bearings.films.map_table import unstretch

ROOT = Path(__file__).parents[1]

QUANTUM = 1e-8
"""Unit of the stored coefficients, below the error of the nodes, in half the bytes."""


def filled(log: np.ndarray, T: np.ndarray) -> np.ndarray:
    """Return nodes (s, x, t) with those left out, not-a-number, from a quintic spline through their row."""
    rows = log.reshape(-1, len(T))
    known = [~np.isnan(row) for row in rows]
    full = [make_interp_spline(T[k], row[k], k=5)(T) for row, k in zip(rows, known, strict=True)]
    answer = np.where(np.isnan(rows), full, rows).reshape(log.shape)
    answer[:, 0] = answer[:, 0, :1]
    return answer


def fitted(nodes: Path) -> MapTable:
    """Return the table of a file of nodes."""
    with np.load(nodes) as data:
        log, slope = filled(data["log"], data["T"]), data["chi_slope"]
        axes = data["X"], data["log_slenderness"]
    low, high = np.exp(axes[1][[0, -1]])
    return fit_map_table(
        log,
        slenderness_range=(float(low), float(high)),
        largest_eccentricity_ratio=float(unstretch(axes[0][-1])),
        slope=slope[:, 0, -1],
    )


def main() -> None:
    """Fit and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--nodes", type=Path, default=ROOT / "tools" / "map_nodes.npz")
    parser.add_argument(
        "--out", type=Path, default=ROOT / "rotorfilm" / "bearings" / "journal" / "data" / "journal_map.bin"
    )
    arguments = parser.parse_args()
    table = fitted(arguments.nodes)
    table.save(arguments.out, QUANTUM)
    print(f"{arguments.out}: {arguments.out.stat().st_size} bytes, coefficients {table.coefficients.shape}")


if __name__ == "__main__":
    main()
