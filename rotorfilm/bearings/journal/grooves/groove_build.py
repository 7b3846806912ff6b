"""How the map of a bearing with openings is made: potentials of the two-dimensional film, and their fit."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....errors import ConvergenceError
from ....model import Array
from ....progress import Report, silent
from ...films.cavitation import Complementarity
from ...films.geometry import TURN, FilmGeometry, Groove
from ...films.map_fit import node_eccentricities
from ...films.map_table import stretch
from ...films.quintic import periodic_quintic, periodic_quintic_coefficients, quintic_coefficients
from ...films.ring.ring_grids import LONG, ring_grids, ring_spans
from ...films.ring.ring_kernel import RingKernel
from .groove_table import DIRECTIONS, GrooveMapTable
from .openings import AlignedOpenings

CROWDING = 0.6
"""Crowds the directions across the eccentricity, where the film turns; measured to be the best."""

ORDER = 4
"""Order of convergence, in the size of the cells, of the potential extrapolated from two grids."""

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
    """Return the map of one bearing.

    Parameters
    ----------
    openings : AlignedOpenings
    slenderness : float [1]
        Length / diameter.
    resolution : Resolution
    report : callable, optional
        Called with the fraction done and a text, some tens of times.

    Raises
    ------
    ConvergenceError
        If the search for a ruptured zone does not end.
    """
    potential = _Solver(openings.grooves, slenderness, resolution.cells)
    center = _center(potential)
    M = _exponents(potential, center, openings, resolution, report)
    cells_x, count_e, count_s = resolution.nodes
    # A step across the center turns e around, and with it the angle from e to w.
    ghosts = -np.roll(M[:0:-1], (count_e // 2, count_s // 2), axis=(1, 2))
    coefficients = quintic_coefficients(np.concatenate([ghosts, M]))[cells_x:]
    for axis in (1, 2):
        coefficients = periodic_quintic_coefficients(coefficients, axis)
    return GrooveMapTable(
        slenderness=slenderness,
        grooves=openings.grooves,
        reach=float(stretch(resolution.largest_eccentricity_ratio)),
        crowding=CROWDING,
        log_center=center.level,
        coefficients=coefficients,
    )


class _Solver:
    """J and dJ/de of one bearing by Richardson extrapolation."""

    def __init__(self, grooves: tuple[Groove, ...], slenderness: float, cells: tuple[int, int]) -> None:
        geometry = FilmGeometry(grooves=grooves)
        spans, grids = ring_spans(geometry), ring_grids(geometry, *cells, max(slenderness, LONG))
        self._kernel = RingKernel(slenderness, spans, grids, Complementarity())

    def __call__(self, e: Array, phi: Array) -> tuple[Array, Array]:
        """Return J, (D,), and dJ/de, (2, D), at the eccentricity e for unit sources at the angles phi."""
        levels, slopes, *_ = self._kernel.potential(e, np.stack([np.cos(phi), np.sin(phi)]))
        J = extrapolated(levels)
        if not np.all(J < 0.0):
            raise ConvergenceError(f"the film must carry, and does not at eccentricity {e.tolist()}")
        return J, extrapolated(slopes)


def extrapolated(levels: Array) -> Array:
    """Return the extrapolation of values on grids, the finest first, from the first two."""
    return levels[0] + (levels[0] - levels[1]) / 3.0


def node_angles(count_e: int, count_s: int) -> tuple[Array, Array]:
    """Return the angles of e, (count_e,), and those from e to w, (count_s,), of the nodes [rad]."""
    s = TURN * np.arange(count_s) / count_s
    return TURN * np.arange(count_e) / count_e, np.arctan2(np.sin(s), CROWDING * np.cos(s))


def _center(potential: _Solver) -> _Center:
    J, slope = potential(np.zeros(2), TURN * np.arange(DIRECTIONS) / DIRECTIONS)
    level, slope = _smooth(np.log(-J)), _smooth((slope / J).T)
    return _Center(periodic_quintic_coefficients(level), periodic_quintic_coefficients(slope))


def _smooth(values: Array) -> Array:
    """Return periodic values (n, ...) without their high harmonics.

    The edge of the ruptured zone jumps from node to node as the source turns, which the second derivatives
    would show: a quarter of the error of the damping matrix is left.
    """
    spectrum = np.fft.rfft(values, axis=0)
    spectrum[HARMONICS + 1 :] = 0.0
    return np.fft.irfft(spectrum, len(values), axis=0)


def _exponents(
    potential: _Solver,
    center: _Center,
    openings: AlignedOpenings,
    resolution: Resolution,
    report: Report,
) -> Array:
    """Return M at the nodes, (cells_x + 1, count_e, count_s); symmetric ones are solved once."""
    cells_x, count_e, count_s = resolution.nodes
    theta, beta = node_angles(count_e, count_s)
    chi = node_eccentricities(resolution.largest_eccentricity_ratio, cells_x)
    source, mirrored = symmetric_nodes(openings, count_e)
    M = np.empty((cells_x + 1, count_e, count_s))
    solved = np.flatnonzero(source == np.arange(count_e))
    for done, j in enumerate(solved.tolist()):
        report(done / len(solved), "map of the grooved bearing")
        M[:, j] = _column(potential, center, chi, theta[j], theta[j] + beta)
    opposite = -np.arange(count_s) % count_s
    for j in range(count_e):
        M[:, j] = M[:, source[j]][:, opposite] if mirrored[j] else M[:, source[j]]
    report(1.0, "map of the grooved bearing")
    return M


def _column(potential: _Solver, center: _Center, chi: Array, theta: float, phi: Array) -> Array:
    """Return M for one direction of e, (cells_x + 1, count_s)."""
    level = periodic_quintic(center.level, phi / TURN)
    along = np.array([np.cos(theta), np.sin(theta)])
    M = np.empty((len(chi), len(phi)))
    M[0] = periodic_quintic(center.slope, phi / TURN) @ along
    for i in range(1, len(chi)):
        M[i] = (np.log(-potential(chi[i] * along, phi)[0]) - level) / chi[i]
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
