"""Fit the universal table of the impedance map to its nodal potentials and write the package data.

    python tools/fit_map.py [--nodes tools/map_nodes.npz] [--out rotorfilm/films/data/journal_map.bin]

`tools/build_map.py` computes the nodes (minutes); this takes a second.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from rotorfilm.films.map_fit import fit_map_table
from rotorfilm.films.map_table import MapTable
from rotorfilm.films.potential_table import eccentricity_ratio

ROOT = Path(__file__).parents[1]


def fitted(nodes: Path) -> MapTable:
    """Return the table of a file of nodes."""
    with np.load(nodes) as data:
        log, slope, axes = data["log"], data["chi_slope"], (data["X"], data["log_slenderness"])
    low, high = np.exp(axes[1][[0, -1]])
    return fit_map_table(
        log,
        slenderness_range=(float(low), float(high)),
        largest_eccentricity_ratio=float(eccentricity_ratio(axes[0][-1:])[0]),
        slope=slope[:, 0, -1],
    )


def main() -> None:
    """Fit and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--nodes", type=Path, default=ROOT / "tools" / "map_nodes.npz")
    parser.add_argument("--out", type=Path, default=ROOT / "rotorfilm" / "films" / "data" / "journal_map.bin")
    arguments = parser.parse_args()
    table = fitted(arguments.nodes)
    table.save(arguments.out)
    print(f"{arguments.out}: {arguments.out.stat().st_size} bytes, coefficients {table.coefficients.shape}")


if __name__ == "__main__":
    main()
