"""How the map of a pad is made: potentials of the two-dimensional film, and their fit."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from ...model import Array
from ...progress import Report, silent
from ..films.quintic import quintic_coefficients
from ..films.ring.ring_kernel import RingKernel
from ..films.ring.ring_samples import log_potential
from ..films.table_pieces import cores, made_pieces
from .pad_grid import CELLS, pad_grid
from .pad_table import PadMapTable, wall

REACH = 3.0
"""A film at the edge of a pad lies on so many times the angle over which its source drives."""

class PadResolution(NamedTuple):
    """Grid of the solver and nodes of the map.

    Attributes
    ----------
    cells : (int, int)
        Cells along the pad and along half its length.
    nodes : (int, int, int)
        Nodes over u, over Y (odd) and over the angle of the source (even).
    xi_range : (float, float) [1]
        First and last node in the direction of the middle of the pad.
    reach : float [1]
        |tanh Y| of the last nodes.
    """

    cells: tuple[int, int] = CELLS
    nodes: tuple[int, int, int] = (16, 13, 64)
    xi_range: tuple[float, float] = (-0.5, 0.95)
    reach: float = 0.95


class _Solver:
    """The potential of one pad by Richardson extrapolation, for half of the angles of the nodes.

    Near the edge |phi| = pi/2 + b a film lies at the end of the pad only, and there the grid is that of a shorter
    pad: the turned frame of its own middle.
    """

    def __init__(self, extent: float, slenderness: float, resolution: PadResolution) -> None:
        count = resolution.nodes[2]
        phi = node_angles(extent, count)[count // 2 :]
        part = np.minimum(REACH * (0.5 * np.pi + 0.5 * extent - phi), extent)
        whole = part >= extent
        self._extent, self._phi = extent, phi
        self._films: list[tuple[RingKernel, float, Array]] = [
            (pad_grid(extent, slenderness, resolution.cells), 0.0, phi[whole])
        ]
        for angle, size in zip(phi[~whole], part[~whole].tolist(), strict=True):
            turn = 0.5 * (extent - size)
            film = pad_grid.__wrapped__(size, slenderness, resolution.cells)
            self._films.append((film, turn, np.array([angle])))

    def exponents(self, xi: float, eta: float) -> Array:
        """Return M, (count/2,), at a place for the angles of the source above 0."""
        levels = [
            log_potential(film, _turned(np.array([xi, eta]), -turn), phi - turn)[0]
            for film, turn, phi in self._films
        ]
        return np.concatenate(levels) - 5.0 * np.log(np.cos(self._phi) + np.sin(0.5 * self._extent))


def _turned(e: Array, angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * e[0] - s * e[1], s * e[0] + c * e[1]])


def node_angles(extent: float, count: int) -> Array:
    """Return the angles of the source of the nodes, (count,) [rad]: the middles of equal parts."""
    return (np.arange(count) + 0.5 - 0.5 * count) * (np.pi + extent) / count


def build_pad_table(
    extent: float, slenderness: float, resolution: PadResolution, report: Report = silent
) -> PadMapTable:
    count_u, count_y, count_phi = resolution.nodes
    u = -np.log1p(-np.linspace(*(1.0 - np.exp(-np.zeros(2))), 2)) if False else np.linspace(*-np.log1p(-np.array(resolution.xi_range)), count_u)
    y_end = math.atanh(resolution.reach)
    xi = -np.expm1(-u)
    eta = np.tanh(np.linspace(-y_end, y_end, count_y)) * wall(xi, extent)[:, None]
    solver = _Solver(extent, slenderness, resolution)
    pieces = [partial(solver.exponents, float(xi[i]), float(eta[i, j])) for i in range(count_u) for j in range(count_y)]
    found = np.reshape(made_pieces(pieces, report, "map of the pad"), (count_u, count_y, count_phi // 2))
    M = np.concatenate([found[:, ::-1, ::-1], found], axis=2)
    for axis in range(3):
        M = quintic_coefficients(M, axis)
    return PadMapTable(extent=extent, slenderness=slenderness, u_range=(float(u[0]), float(u[-1])), y_end=y_end, coefficients=M)
