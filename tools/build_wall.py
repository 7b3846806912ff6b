"""Build the table of the film at the wall, `rotorfilm/native/films/wall_table.c`; a few minutes.

Near the wall the film is that between a plane and a parabola, h = 1 + tau^2, of the length l, all in
units of the film's width there. Its potential for the source u_c + u_s tau,

    Phi = mean over the length of int P (u_c + u_s tau) dtau,
    div(h^3 grad P) = -(u_c + u_s tau) where P > 0,

is |u|^2 exp(Lambda(q, lambda)), q = -ln((1 + u_c/|u|)/2), lambda = ln(l/(1 + l/LONG)). Finite volumes with
complementarity on phi = arctan tau and a length graded towards the end, extrapolated from two grids.

    python tools/build_wall.py [--workers 2]
"""

from __future__ import annotations

import argparse
import multiprocessing
from pathlib import Path

import numpy as np
from map_nodes import GridEnergy, complementary_pressure

from rotorfilm.bearings.films.map_fit import quintic_coefficients

OUT = Path(__file__).parents[1] / "rotorfilm" / "native" / "films" / "wall_table.c"
CELLS_Q, CELLS_L, END_Q = 24, 16, 9.6
SHORT, LONG = 0.1, 200.0
GRID = (192, 16)


def local_potential(u_c: float, u_s: float, length: float, cells: tuple[int, int]) -> float:
    """Return Phi of the parabola; an infinite length is the film without flow to its ends."""
    # Where the source draws the film away from the minimum it is as wide as it is far.
    scale = float(np.hypot(1.0, min(u_c / u_s, 0.0))) if u_s else 1.0
    step = np.pi / cells[0]
    phi = -0.5 * np.pi + step * np.arange(cells[0])
    middle = phi + 0.5 * step
    # The far end, where the film is infinitely thick, is kept dry.
    phi[0] = phi[1]
    (tau, h, rate), (_, face, face_rate) = (_parabola(scale, at) for at in (phi, middle))
    if np.isinf(length):
        height, links = np.ones(1), np.zeros(1)
    else:
        half = 0.5 * length / scale
        places = half - np.sinh(np.arcsinh(half) * (1.0 - np.arange(2 * cells[1] + 1) / (2.0 * cells[1])))
        height = np.diff(np.concatenate([[0.0], places[1::2]])) / half
        links = 1.0 / (np.diff(places[::2]) * half * scale**2)
    drive = -np.outer((u_c + u_s * tau) * rate * step, height)
    drive[0] = 1e250
    around, along = np.outer(face**3 / face_rate / step, height), np.outer(h**3 * rate * step, links)
    u = complementary_pressure(GridEnergy(around, along, drive, drive))
    return -float(np.sum(drive[1:] * u[1:]))


def _parabola(scale: float, phi: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return tau = scale tan(phi), h and dtau/dphi."""
    tau = scale * np.tan(phi)
    return tau, 1.0 + tau**2, scale / np.cos(phi) ** 2


def node(place: tuple[float, float]) -> float:
    """Return Lambda at (q, lambda), extrapolated."""
    q, log_length = place
    short = np.exp(log_length)
    length = short / (1.0 - short / LONG) if short < LONG * (1.0 - 1e-9) else np.inf
    turn = np.exp(-q)
    u = 2.0 * turn - 1.0, 2.0 * np.sqrt(turn * (1.0 - turn))
    coarse, fine = (local_potential(*u, length, (k * GRID[0], k * GRID[1])) for k in (1, 2))
    return float(np.log(fine + (fine - coarse) / 3.0))


def main() -> None:
    """Build and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workers", type=int, default=2)
    q = np.linspace(0.0, END_Q, CELLS_Q + 1)
    log_length = np.log(np.geomspace(SHORT, LONG, CELLS_L + 1))
    places = [(float(a), float(b)) for a in q for b in log_length]
    with multiprocessing.get_context("spawn").Pool(parser.parse_args().workers) as pool:
        nodes = np.array(pool.map(node, places, chunksize=5)).reshape(CELLS_Q + 1, CELLS_L + 1)
    table = quintic_coefficients(quintic_coefficients(nodes), axis=1)
    OUT.write_text(_source(table))


def _source(table: np.ndarray) -> str:
    """Return the C file."""
    numbers = [f"{number:.6f}F" for number in table.ravel()]
    lines = [", ".join(numbers[k : k + 9]) for k in range(0, len(numbers), 9)]
    body = ",\n    ".join(lines)
    return (
        "/* Written by tools/build_wall.py: coefficients of Lambda over q and, fastest, the length. */\n"
        '#include "wall.h"\n\n'
        "const float rf_wall_table[(RF_WALL_CELLS_Q + RF_ORDER - 1) * RF_WALL_LAYER] = {\n"
        f"    {body},\n}};\n"
    )


if __name__ == "__main__":
    main()
