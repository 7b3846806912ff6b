"""The impedance map against the two-dimensional film, which shares nothing with the solver behind the map.

Forces at random states (eccentricity ratio and direction of the source uniform), 99 % of the vector error;
stiffness and damping of static journals, the largest error of an entry relative to the largest entry. The
reference is `ReynoldsFilm`, extrapolated from two grids and averaged over positions of the journal within a
cell: the edge of the ruptured zone jumps from node to node, and its error changes sign with the position.
"Own error" is the same quantity between the references on the two finest pairs of grids.

    python benchmarks/map_accuracy.py [--states 40]  (40 states: five minutes)
"""

from __future__ import annotations

import argparse
import sys

import numpy as np

from rotorfilm.bearings.films.finite_volumes import richardson
from rotorfilm.bearings.journal import MapFilm, ReynoldsFilm
from rotorfilm.studies.journal_stability import cell_turns

RATIOS = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)
BANDS = ((0.0, 0.95), (0.95, 0.99))
STATIC = (0.1, 0.3, 0.5, 0.7, 0.9, 0.95)
GRIDS = ((192, 24), (384, 48))
PLACES = 4
"""Positions within a cell of the coarse grid of a pair."""

QUARTER_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])


def turns(cells: tuple[int, int]) -> list[np.ndarray]:
    """Return rotations that move the journal across a cell of the coarse grid."""
    return cell_turns(cells[0] // 2, PLACES)


def grid_force(e: np.ndarray, w: np.ndarray, slenderness: float, cells: tuple[int, int]) -> np.ndarray:
    """Return the force, shape (2, n), of the reference."""
    film = ReynoldsFilm(cells=cells)
    forces = [R.T @ film.extrapolated(R @ e, R @ w, slenderness)[0] for R in turns(cells)]
    return np.mean(forces, axis=0)


def grid_jacobian(e: np.ndarray, w: np.ndarray, slenderness: float, cells: tuple[int, int]) -> np.ndarray:
    """Return the Jacobian, shape (2, 4), of the reference at one state."""
    pair = [ReynoldsFilm(cells=cells), ReynoldsFilm(cells=(cells[0] // 2, cells[1] // 2))]
    fine, coarse = (
        np.mean(
            [R.T @ film.jacobian(R @ e, R @ w, slenderness) @ np.kron(np.eye(2), R) for R in turns(cells)],
            axis=0,
        )
        for film in pair
    )
    return richardson(fine, coarse)


def force_errors(slenderness: float, band: tuple[float, float], states: int) -> tuple[float, float]:
    """Return the 99 % error of the map's force, and the reference's own."""
    rng = np.random.default_rng(7)
    chi, angle = rng.uniform(*band, states), rng.uniform(-np.pi, np.pi, states)
    e, w = np.stack([chi, np.zeros(states)]), np.stack([np.cos(angle), np.sin(angle)])
    coarse, fine = (grid_force(e, w, slenderness, cells) for cells in GRIDS)
    size = np.linalg.norm(fine, axis=0)
    gaps = [
        np.linalg.norm(force - fine, axis=0) / size for force in (MapFilm().force(e, w, slenderness), coarse)
    ]
    return float(np.quantile(gaps[0], 0.99)), float(np.quantile(gaps[1], 0.99))


def static_coefficients(jacobian: np.ndarray) -> np.ndarray:
    """Return (K, C), shape (2, 2, 2), from d force/d(e, w) at unit speed, where w = -(z^ x e)/2."""
    return -np.array([jacobian[:, :2] - 0.5 * jacobian[:, 2:] @ QUARTER_TURN, jacobian[:, 2:]])


def coefficient_errors(slenderness: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest errors (K, C) of the map over `STATIC`, and the reference's own."""
    gaps = []
    for chi in STATIC:
        e = np.array([chi, 0.0])
        w = -0.5 * QUARTER_TURN @ e
        coarse, fine = (static_coefficients(grid_jacobian(e, w, slenderness, cells)) for cells in GRIDS)
        mapped = static_coefficients(MapFilm().jacobian(e, w, slenderness))
        largest = np.abs(fine).max(axis=(1, 2))
        gaps.append([np.abs(other - fine).max(axis=(1, 2)) / largest for other in (mapped, coarse)])
    worst = np.max(gaps, axis=0)
    return worst[0], worst[1]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--states", type=int, default=12)
    parser.add_argument("--slenderness", type=float, nargs="+", default=RATIOS, help="L/D, from .001 to 20")
    options = parser.parse_args()
    sys.stdout.write("| L/D | force to .95 | own error | force to .99 | own error | K | own | C | own |\n")
    sys.stdout.write(9 * "|---" + "|\n")
    for slenderness in options.slenderness:
        forces = [value for band in BANDS for value in force_errors(slenderness, band, options.states)]
        mapped, own = coefficient_errors(slenderness)
        numbers = [*forces, mapped[0], own[0], mapped[1], own[1]]
        sys.stdout.write(f"| {slenderness} | " + " | ".join(f"{x:.1e}" for x in numbers) + " |\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
