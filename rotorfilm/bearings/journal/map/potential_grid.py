"""Potential by finite volumes with complementarity: slow, second order, independent of `potential`.

Nodes are uniform in zeta and in a Moebius angle psi that crowds them at the minimum film,
cos gamma = (cos psi - eta)/(1 - eta cos psi), eta = 1 - (1 - chi)^0.7. p >= 0 is imposed node by node with an
active set (Hintermueller, Ito and Kunisch 2002), so the ends of the film follow the grid instead of a curve;
the turn is cut, for banded elimination, at whatever circle of nodes is dry.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded

from ....errors import ConvergenceError
from ....model import Array
from .potential_domain import Source

SWEEPS = 200
"""Active sets tried before giving up; the ends move several cells per sweep."""


class GridEnergy(NamedTuple):
    """Energy of nodal pressures (N, Z), periodic in N: links to the next node around, and along; source."""

    around: Array
    along: Array
    drive: Array
    trig: Array


def grid_potential(source: Source, cells: tuple[int, int]) -> tuple[float, Array]:
    """Return J and (dJ/dg_s, dJ/dg_c) on cells[0] x cells[1] cells around and along half the length.

    Raises
    ------
    ConvergenceError
        If the active set does not settle, or no circle of nodes is dry.
    """
    grid = _grid(source, cells)
    u = complementary_pressure(grid)
    force = 12.0 * np.einsum("kij,ij->k", grid.trig, u)
    return 6.0 * float(np.sum(grid.drive * u)), force


def richardson_potential(source: Source, cells: tuple[int, int]) -> tuple[float, Array, float]:
    """Return J, its gradient and an error estimate of J from `cells` and twice as many, order two."""
    coarse, coarse_force = grid_potential(source, cells)
    fine, fine_force = grid_potential(source, (2 * cells[0], 2 * cells[1]))
    gain = (fine - coarse) / 3.0
    return fine + gain, fine_force + (fine_force - coarse_force) / 3.0, abs(gain)


def _grid(source: Source, cells: tuple[int, int]) -> GridEnergy:
    eta = float(np.sign(source.chi) * (1.0 - (1.0 - abs(source.chi)) ** 0.7))
    stretch = np.sqrt((1.0 - eta) / (1.0 + eta))
    half = 0.5 * source.turn
    start = 2.0 * np.arctan2(stretch * np.sin(half), np.cos(half))
    step, rise = 2.0 * np.pi / cells[0], 1.0 / cells[1]
    node = start + step * np.arange(cells[0])
    gamma, rate, cube = _moebius(source, eta, node)
    _, face_rate, face_cube = _moebius(source, eta, node + 0.5 * step)
    height = np.full(cells[1], rise)
    height[0] *= 0.5
    around = np.outer(face_cube / face_rate / step, height)
    along = np.outer(cube * rate * step, np.full(cells[1], 1.0 / (rise * source.slenderness**2)))
    area = np.outer(rate * step, height)
    trig = np.stack([np.sin(gamma)[:, None] * area, np.cos(gamma)[:, None] * area])
    return GridEnergy(around, along, source.sine * trig[0] + source.cosine * trig[1], trig)


def _moebius(source: Source, eta: float, psi: Array) -> tuple[Array, Array, Array]:
    """Return gamma, d gamma/d psi and H^3."""
    width = 1.0 - eta * np.cos(psi)
    root = np.sqrt((1.0 - eta) * (1.0 + eta))
    cosine, sine = (np.cos(psi) - eta) / width, root * np.sin(psi) / width
    return np.arctan2(sine, cosine), root / width, (1.0 + source.chi * cosine) ** 3


def complementary_pressure(grid: GridEnergy) -> Array:
    """Return the nodal pressures u >= 0 that minimize the energy."""
    diagonal = grid.around + np.roll(grid.around, 1, axis=0) + grid.along
    diagonal[:, 1:] += grid.along[:, :-1]
    active = grid.drive < 0.0
    for _ in range(SWEEPS):
        u = _solve_active(grid, diagonal, active)
        updated = np.where(active, u > 0.0, _excess(grid, diagonal, u) < 0.0)
        if np.array_equal(updated, active):
            return u
        active = updated
    raise ConvergenceError(f"the film's active set must settle within {SWEEPS} sweeps, got none")


def _solve_active(grid: GridEnergy, diagonal: Array, active: NDArray[np.bool_]) -> Array:
    """Return the pressure that balances the source on active nodes and vanishes elsewhere."""
    dry = np.flatnonzero(~active.any(axis=1))
    if dry.size == 0:
        raise ConvergenceError("the film must leave a dry gap on every circle, got none: bearing too long")
    film = np.roll(active, -dry[0], axis=0)
    diagonal, around, along, drive = (
        np.roll(field, -dry[0], axis=0) for field in (diagonal, grid.around, grid.along, grid.drive)
    )
    lines = film.shape[1]
    bands = np.zeros((lines + 1, film.size))
    bands[0] = np.where(film, diagonal, 1.0).ravel()
    axial = np.zeros(film.shape)
    axial[:, :-1] = -along[:, :-1] * (film[:, :-1] & film[:, 1:])
    bands[1] = axial.ravel()
    bands[lines, :-lines] = (-around[:-1] * (film[:-1] & film[1:])).ravel()
    u = solveh_banded(bands, np.where(film, -drive, 0.0).ravel(), lower=True, check_finite=False)
    return np.roll(u.reshape(film.shape), dry[0], axis=0)


def _excess(grid: GridEnergy, diagonal: Array, u: Array) -> Array:
    """Return A u + drive: positive where no film is needed."""
    excess = diagonal * u + grid.drive - grid.around * np.roll(u, -1, axis=0)
    excess -= np.roll(grid.around * u, 1, axis=0)
    excess[:, 1:] -= grid.along[:, :-1] * u[:, :-1]
    excess[:, :-1] -= grid.along[:, :-1] * u[:, 1:]
    return np.asarray(excess)
