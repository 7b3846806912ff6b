"""Build the nodal potentials of the impedance map; an interrupted build resumes from its file.

Usage: python tools/build_map.py nodes.npz --workers 2
"""

from __future__ import annotations

import argparse
import itertools
import multiprocessing
import os
import sys
from collections.abc import Iterable
from functools import partial
from pathlib import Path

import numpy as np
from map_nodes import (
    FIELDS,
    TableAxes,
    load_table,
    save_table,
    table_row,
    universal_axes,
)
from rich.progress import track

ROWS_PER_SAVE = 10
"""Rows computed between two saves, half a minute of work."""


def build(path: Path, axes: TableAxes, workers: int, fine_from: float) -> dict[str, np.ndarray]:
    """Fill the table's missing rows, saving as it goes; return its fields.

    Rows with X below `fine_from` get every second node in T: a film turns sharply with T near the wall only.
    """
    fields = _start(path, axes)
    steps = 2 - (fine_from <= axes.X)
    rows = itertools.product(range(axes.shape[0]), range(axes.shape[1]))
    missing = [(k, i, steps[i]) for k, i in rows if np.isnan(fields["log"][k, i, :: steps[i]]).any()]
    # One BLAS thread per worker: the matrices are small, and the workers fill the machine.
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    with multiprocessing.get_context("spawn").Pool(workers) as pool:
        done: Iterable = pool.imap(partial(_row, axes), missing)
        for count, ((k, i, step), row) in enumerate(track(done, "potentials", total=len(missing)), start=1):
            for name, values in zip(FIELDS, row, strict=True):
                fields[name][k, i, ::step] = values
            if count % ROWS_PER_SAVE == 0:
                save_table(path, axes, fields)
    save_table(path, axes, fields)
    return fields


def _row(axes: TableAxes, index: tuple[int, int, int]) -> tuple[tuple[int, int, int], np.ndarray]:
    k, i, step = index
    return index, table_row(float(axes.chi[i]), float(np.exp(axes.log_slenderness[k])), axes.T[::step])


def _start(path: Path, axes: TableAxes) -> dict[str, np.ndarray]:
    """Return the fields of an earlier build on the same axes, or empty ones."""
    if not path.exists():
        return {name: np.full(axes.shape, np.nan) for name in FIELDS}
    earlier, fields = load_table(path)
    same = earlier.shape == axes.shape and all(
        np.allclose(getattr(earlier, name), getattr(axes, name)) for name in ("X", "T", "log_slenderness")
    )
    if not same:
        raise SystemExit(f"{path} holds a table on other axes: remove it or choose another name")
    return fields


def main() -> None:
    """Read the command line and build."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("path", type=Path)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--cells", type=int, nargs=3, default=(24, 96, 16), metavar=("X", "T", "LD"))
    parser.add_argument("--top", type=float, default=4.8, help="largest X; 4.8 is chi = 0.99906")
    parser.add_argument("--slenderness", type=float, nargs=2, default=(0.1, 4.0), help="range of L/D")
    parser.add_argument("--fine-from", type=float, default=2.4, help="X from which all T nodes are filled")
    options = parser.parse_args()
    axes = universal_axes(tuple(options.cells), options.top, tuple(options.slenderness))
    fields = build(options.path, axes, options.workers, options.fine_from)
    worst = np.nanmax(fields["error"])
    done = f"{np.isfinite(fields['log']).sum()} potentials, largest estimated error of ln(-J) {worst:.1e}"
    sys.stdout.write(done + "\n")


if __name__ == "__main__":
    main()
