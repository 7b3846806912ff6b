"""How the map of a bearing with openings is made: potentials of the two-dimensional film, and their fit."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from ....model import Array
from ....progress import Report, silent
from ...films.geometry import TURN, Groove
from ...films.map_bounds import batches
from ...films.map_fit import node_eccentricities
from ...films.map_table import stretch
from ...films.quintic import periodic_quintic, periodic_quintic_coefficients, quintic_coefficients
from ...films.ring.ring_kernel import richardson
from ...films.ring.ring_samples import log_potential, reference
from ...films.table_pieces import cores, made_pieces
from .groove_bounds import BoundStates
from .groove_losses import (
    CELLS,
    CROWDING,
    bound_losses,
    fitted_losses,
    images,
    loss_cells,
    loss_eccentricities,
    node_losses_between,
    opened_film,
    opening_runs,
)
from .groove_table import DIRECTIONS, GrooveMapTable
from .openings import AlignedOpenings

ORDER = 4
"""Order of convergence, in the size of the cells, of the potential extrapolated from two grids."""

NODE_TIME = 1.4e-7
"""Time of a node for each cell of the finest grid [s], on a core of 2023."""

CHECK_NODES = 18
"""Nodes that take as long as one state of the bounds, four times the cells and derivatives."""

LOSS_NODES = 6
"""Nodes of the potential on a grid that take as long as one of the losses on it, whose film begins anew."""

LOSS_CHECKS = 16
"""The same of the losses at the states of the bounds."""

TITLE = "map of the grooved bearing"

HARMONICS = 20
"""Of L0 and of dL/de at the center, over the direction of the source: beyond is the noise of the grid."""


class Resolution(NamedTuple):
    """Grid of the solver and nodes of the map.

    Attributes
    ----------
    cells : (int, int)
        Cells around the film and along half the length.
    nodes : (int, int, int)
        Nodes over the eccentricity ratio without the center, over its direction, and over that of the
        source.
    largest_eccentricity_ratio : float [1]
        Of the last node.
    """

    cells: tuple[int, int]
    nodes: tuple[int, int, int]
    largest_eccentricity_ratio: float


class _Center(NamedTuple):
    """Spline coefficients of L0, (DIRECTIONS,), and of dL/de at the center, (DIRECTIONS, 2)."""

    level: Array
    slope: Array


def build_groove_table(
    openings: AlignedOpenings, slenderness: float, resolution: Resolution, report: Report = silent
) -> GrooveMapTable:
    """Return the map of one bearing, made on all cores, with the bounds of its error.

    Parameters
    ----------
    openings : AlignedOpenings
    slenderness : float [1]
        Length / diameter.
    resolution : Resolution
    report : callable, optional
        Called with the fraction done and a text that says how long all of it takes, some hundred times.

    Raises
    ------
    ConvergenceError
        If the search for a ruptured zone does not end.
    """
    potential = _Solver(openings.grooves, slenderness, resolution.cells)
    checks = BoundStates(openings.grooves, resolution.largest_eccentricity_ratio)
    around, along = resolution.cells
    finer = opened_film(openings.grooves, slenderness, (2 * around, 2 * along))
    solved = np.unique(symmetric_nodes(openings, resolution.nodes[1])[0])
    columns = [
        partial(potential.level, *place) for j in solved.tolist() for place in _column_places(resolution, j)
    ]
    losses = _Losses(openings, slenderness, resolution)
    references = [
        partial(made, film, e, w)
        for made, film in ((reference, finer), (bound_losses, losses.finer))
        for e, w in batches(checks.e, checks.w)
    ]
    center = _center(potential)
    pieces: list[Sequence[Callable[[], Array]]] = [columns, losses.columns(solved), references]
    found = iter(made_pieces([piece for group in pieces for piece in group], report, TITLE))
    levels, nodes, exact = ([next(found) for _ in group] for group in pieces)
    M = _exponents(center, np.reshape(levels, (len(solved), resolution.nodes[0], -1)), openings, resolution)
    splines = _splines(M, resolution)
    shear, flows = losses.fitted(np.array(nodes), solved)
    table = GrooveMapTable(
        slenderness=slenderness,
        grooves=openings.grooves,
        reach=float(stretch(resolution.largest_eccentricity_ratio)),
        crowding=CROWDING,
        log_center=center.level,
        coefficients=splines,
        shear=shear,
        flows=flows,
    )
    half = len(exact) // 2
    both = np.concatenate([np.concatenate(part, axis=1) for part in (exact[:half], exact[half:])])
    return replace(table, bounds=checks.bounds(table, both))


def expected_time(openings: AlignedOpenings, resolution: Resolution) -> float:
    """Return about how long a map takes on all cores of this machine [s], to weigh it against other films."""
    cells_x, count_e, count_s = resolution.nodes
    solved = np.unique(symmetric_nodes(openings, count_e)[0]).size
    states = BoundStates(openings.grooves, resolution.largest_eccentricity_ratio).e.shape[1]
    work = DIRECTIONS + solved * cells_x * count_s + (CHECK_NODES + LOSS_CHECKS) * states
    losses = LOSS_NODES * solved * (cells_x + 1) * 2 * (CELLS + 1)
    cells = math.prod(resolution.cells) * work + math.prod(loss_cells(resolution.cells)) * losses
    return NODE_TIME * cells / cores()


def _splines(M: Array, resolution: Resolution) -> Array:
    """Return the coefficients of the spline that has M, (cells_x + 1, count_e, count_s), at its nodes."""
    cells_x, count_e, count_s = resolution.nodes
    # A step across the center turns e around, and with it the angle from e to w.
    ghosts = -np.roll(M[:0:-1], (count_e // 2, count_s // 2), axis=(1, 2))
    coefficients = quintic_coefficients(np.concatenate([ghosts, M]))[cells_x:]
    for axis in (1, 2):
        coefficients = periodic_quintic_coefficients(coefficients, axis)
    return coefficients


class _Losses:
    """Shear and flow of one bearing at the nodes of their maps."""

    def __init__(self, openings: AlignedOpenings, slenderness: float, resolution: Resolution) -> None:
        self._openings, self._count = openings, resolution.nodes[1]
        self._film = opened_film(openings.grooves, slenderness, loss_cells(resolution.cells))
        self.finer = opened_film(openings.grooves, slenderness, resolution.cells)
        self._chi = loss_eccentricities(resolution.largest_eccentricity_ratio, resolution.nodes[0])

    def columns(self, solved: np.ndarray) -> list[Callable[[], Array]]:
        """Return the pieces of work for the directions of e that are solved, one for each eccentricity."""
        turns = (TURN / self._count * solved).tolist()
        return [partial(node_losses_between, self._film, chi, turn) for turn in turns for chi in self._chi]

    def fitted(self, nodes: Array, solved: np.ndarray) -> tuple[Array, Array]:
        """Return the splines of `fitted_losses` from losses at the solved nodes, ordered as `columns`."""
        grooves, chi = self._openings.grooves, self._chi
        rows, senses, places = nodes.shape[1:]
        found = nodes.reshape(len(solved), len(chi), rows, senses, places)
        whole = np.zeros((3 + 2 * len(grooves), senses, len(chi), self._count, places))
        source, mirrored = symmetric_nodes(self._openings, self._count)
        runs = np.array(opening_runs(grooves))
        for j in range(self._count):
            of = found[np.searchsorted(solved, source[j])].transpose(1, 2, 0, 3)
            of = of[:, ::-1] if mirrored[j] else of
            back = -source[j] if mirrored[j] else source[j]
            at = np.array(images(grooves, TURN / self._count * (j - back), mirrored=bool(mirrored[j])))[runs]
            whole[:3, :, :, j] = of[:3]
            whole[3 + at, :, :, j] = of[3 : 3 + len(runs)]
            whole[3 + len(grooves) + at, :, :, j] = of[3 + len(runs) :]
        return fitted_losses(whole, chi)


class _Solver:
    """The potential of one bearing by Richardson extrapolation."""

    def __init__(self, grooves: tuple[Groove, ...], slenderness: float, cells: tuple[int, int]) -> None:
        self._kernel = opened_film(grooves, slenderness, cells)

    def level(self, e: Array, phi: Array) -> Array:
        """Return ln(-J), (D,), at the eccentricity e for unit sources at the angles phi."""
        return log_potential(self._kernel, e, phi)[0]

    def center(self, phi: Array) -> tuple[Array, Array]:
        """Return ln(-J), (D,), and d ln(-J)/de, (D, 2), of the centered journal."""
        level, found = log_potential(self._kernel, np.zeros(2), phi, slopes=True)
        return level, -(richardson(*found.slope[:2]) / np.exp(level)).T


def node_angles(count_e: int, count_s: int) -> tuple[Array, Array]:
    """Return the angles of e, (count_e,), and those from e to w, (count_s,), of the nodes [rad]."""
    s = TURN * np.arange(count_s) / count_s
    return TURN * np.arange(count_e) / count_e, np.arctan2(np.sin(s), CROWDING * np.cos(s))


def _center(potential: _Solver) -> _Center:
    level, slope = (_smooth(each) for each in potential.center(TURN * np.arange(DIRECTIONS) / DIRECTIONS))
    return _Center(periodic_quintic_coefficients(level), periodic_quintic_coefficients(slope))


def _smooth(values: Array) -> Array:
    """Return periodic values (n, ...) without their high harmonics.

    The edge of the ruptured zone jumps from node to node as the source turns, which the second derivatives
    would show: a quarter of the error of the damping matrix is left.
    """
    spectrum = np.fft.rfft(values, axis=0)
    spectrum[HARMONICS + 1 :] = 0.0
    return np.fft.irfft(spectrum, len(values), axis=0)


def _column_places(resolution: Resolution, j: int) -> list[tuple[Array, Array]]:
    """Return e, (2,), and directions of the source, (count_s,), of the nodes in one direction of e."""
    cells_x, count_e, count_s = resolution.nodes
    theta, beta = node_angles(count_e, count_s)
    along = np.array([np.cos(theta[j]), np.sin(theta[j])])
    chi = node_eccentricities(resolution.largest_eccentricity_ratio, cells_x)
    return [(eccentricity * along, theta[j] + beta) for eccentricity in chi[1:]]


def _exponents(center: _Center, levels: Array, openings: AlignedOpenings, resolution: Resolution) -> Array:
    """Return M at the nodes, (cells_x + 1, count_e, count_s), from ln(-J) at those that were solved.

    Parameters
    ----------
    levels : ndarray, shape (solved, cells_x, count_s)
    """
    cells_x, count_e, count_s = resolution.nodes
    theta, beta = node_angles(count_e, count_s)
    chi = node_eccentricities(resolution.largest_eccentricity_ratio, cells_x)
    source, mirrored = symmetric_nodes(openings, count_e)
    M = np.empty((cells_x + 1, count_e, count_s))
    for j, level in zip(np.unique(source).tolist(), levels, strict=True):
        turns = (theta[j] + beta) / TURN
        M[0, j] = periodic_quintic(center.slope, turns) @ [np.cos(theta[j]), np.sin(theta[j])]
        M[1:, j] = (level - periodic_quintic(center.level, turns)) / chi[1:, None]
    opposite = -np.arange(count_s) % count_s
    for j in range(count_e):
        M[:, j] = M[:, source[j]][:, opposite] if mirrored[j] else M[:, source[j]]
    return M


def symmetric_nodes(openings: AlignedOpenings, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return for each direction of e the first one that is its image, (count,), and whether mirrored."""
    step = count // openings.fold if count % openings.fold == 0 else count
    nodes = np.arange(count)
    source, mirrored = nodes % step, np.zeros(count, dtype=bool)
    if openings.mirrored:
        image = -nodes % step
        mirrored = image < source
        source = np.minimum(source, image)
    return source, mirrored
