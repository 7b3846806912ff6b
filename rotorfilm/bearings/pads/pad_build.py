"""How the map of a pad is made: potentials of the two-dimensional film, and their fit."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple

import numpy as np

from ...errors import InputError
from ...model import Array
from ...progress import Report, silent
from ..films.map_bounds import BATCH
from ..films.quintic import quintic_coefficients
from ..films.ring.ring_grids import are_counts, require_cells
from ..films.ring.ring_kernel import RingKernel, richardson
from ..films.ring.ring_samples import log_potential, reference
from ..films.table_pieces import cores, made_pieces
from .pad_bounds import LOSS_STATES, STATES, PadStates, loss_states, pad_bounds, pad_states
from .pad_grid import CELLS, pad_grid
from .pad_losses import CELLS as LOSS_CELLS, fitted_losses, grid_losses, loss_places
from .pad_nodes import along_nodes, between_nodes, node_angles, node_places
from .pad_table import PadMapTable

REACH = 3.0
"""A film at the edge of a pad lies on so many times the angle over which its source drives."""

ORDER = 4
"""Order of convergence, in the size of the cells, of the potential extrapolated from two grids."""

NODE_TIME = 1.4e-7
"""Time of a node for each cell of the finest grid [s], on a core of 2023."""

CHECK_NODES = 9
"""Nodes that take as long as one state of the bounds, four times the cells and derivatives."""

LOSS_NODES = 6
"""Nodes that take as long as one of shear and flow, whose film begins anew."""

LOSS_CHECKS = 40
"""The same of a state of their bounds, with four times the cells."""

TITLE = "map of the pad"


@dataclass(frozen=True)
class PadResolution:
    """Grid of the solver and nodes of the map.

    Attributes
    ----------
    cells : (int, int)
        Cells along the pad and along half its length: multiples of 4, at least 16 and 4.
    nodes : (int, int, int)
        Places over u and over Y at which the film is solved (at least 6), between which the map has one node
        more each, and nodes over the angle of the source (even, at least 12).
    xi_range : (float, float) [1]
        First and last node towards the middle of the pad, (r - r_p)/c_p there; below 1.
    reach : float [1]
        |tanh Y| of the last nodes: eta there as a fraction of that at which the journal touches the pad.
    """

    cells: tuple[int, int] = CELLS
    nodes: tuple[int, int, int] = (14, 13, 128)
    xi_range: tuple[float, float] = (-1.0, 0.97)
    reach: float = 0.95

    def checked(self) -> PadResolution:
        """Return this resolution; InputError where it breaks a rule."""
        require_cells(self.cells)
        if not are_counts(self.nodes, (6, 6, 12), (1, 1, 2)):
            raise InputError(f"nodes must be at least (6, 6, 12), the last one even, got {self.nodes!r}")
        if not -math.inf < self.xi_range[0] < self.xi_range[1] < 1.0:
            raise InputError(f"xi_range must rise to below 1, got {self.xi_range!r}")
        if not 0.0 < self.reach < 1.0:
            raise InputError(f"reach must be in (0, 1), got {self.reach!r}")
        return self

    @property
    def u_range(self) -> tuple[float, float]:
        """First and last node of u."""
        return -math.log1p(-self.xi_range[0]), -math.log1p(-self.xi_range[1])

    @property
    def places(self) -> tuple[Array, Array]:
        """The places that are solved: xi, and tanh Y."""
        u = np.linspace(*self.u_range, self.nodes[0])
        return -np.expm1(-u), np.tanh(np.linspace(-self.y_end, self.y_end, self.nodes[1]))

    @property
    def y_end(self) -> float:
        """Last node of Y."""
        return math.atanh(self.reach)


FINE = PadResolution()
"""With it the force is within 1e-3 of that of the film in 90 % of all states and within 5e-3 in 99 %."""

NEAR = PadResolution(nodes=(19, 13, 128), xi_range=(-1.0, 0.995))
"""For pads of much preload: their least film is a small part of their clearance under ordinary loads."""


class _Seen(NamedTuple):
    """The film on a pad or on an end of it, seen from its own middle: `turn` [rad] from that of the pad."""

    film: RingKernel
    turn: float

    def levels(self, e: Array, phi: Array) -> Array:
        """Return ln(-J) and its derivatives by e, (3, D), at e for unit sources at the angles phi."""
        back = _rotation(self.turn)
        found, of = log_potential(self.film, back.T @ e, phi - self.turn, slopes=True)
        return np.stack([found, *(-back @ richardson(*of.slope[:2]) * np.exp(-found))])

    def reference(self, e: Array, w: Array) -> Array:
        """Return force and derivatives, (10, n), at states (2, n)."""
        back = _rotation(self.turn)
        found = reference(self.film, back.T @ e, back.T @ w)
        slopes = np.einsum("ij,jakn,bk->iabn", back, found[2:].reshape(2, 2, 2, -1), back)
        return np.concatenate([back @ found[:2], slopes.reshape(8, -1)])


def seen_film(extent: float, slenderness: float, cells: tuple[int, int], phi: float) -> _Seen:
    """Return the film on as much of a pad as holds all of it for a source at phi [rad].

    Near the edge |phi| = pi/2 + b that is the end of the pad on the side of phi.
    """
    covered = min(extent, REACH * (0.5 * (np.pi + extent) - abs(phi)))
    if covered == extent:
        return _Seen(pad_grid(extent, slenderness, cells), 0.0)
    # Not kept among the films of whole pads: it is used while one map is made.
    return _Seen(
        pad_grid.__wrapped__(covered, slenderness, cells), math.copysign(0.5 * (extent - covered), phi)
    )


def _rotation(angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s], [s, c]])


class _PadSolver:
    """M of one pad for angles of the source above 0, phi [rad], ascending."""

    def __init__(self, extent: float, slenderness: float, cells: tuple[int, int], phi: Array) -> None:
        films = [seen_film(extent, slenderness, cells, angle) for angle in phi.tolist()]
        whole = sum(film.turn == 0.0 for film in films)
        self._parts = [(films[0], phi[:whole])] if whole else []
        self._parts += [(films[k], phi[k : k + 1]) for k in range(whole, len(films))]
        self._vanishing = 5.0 * np.log(np.cos(phi) + np.sin(0.5 * extent))

    def exponents(self, e: Array) -> Array:
        """Return M and its derivatives by e at a place, (3, D)."""
        found = np.concatenate([film.levels(e, phi) for film, phi in self._parts], axis=1)
        found[0] -= self._vanishing
        return found


def build_pad_table(
    extent: float, slenderness: float, resolution: PadResolution, report: Report = silent
) -> PadMapTable:
    """Return the map of one pad, made on all cores, with the bounds of its error.

    Half of the angles of the source are solved: M(u, -Y, -phi) = M(u, Y, phi).

    Parameters
    ----------
    extent : float [rad]
        Angle that the pad covers, below pi.
    slenderness : float [1]
        Length / diameter.
    resolution : PadResolution
    report : callable, optional
        Called with the fraction done and a text that says how long all of it takes, some hundred times.

    Raises
    ------
    ConvergenceError
        If the search for a ruptured zone does not end.
    """
    *counts, count_phi = resolution.nodes
    solver = _PadSolver(
        extent, slenderness, resolution.cells, node_angles(extent, count_phi)[count_phi // 2 :]
    )
    states = pad_states(extent, resolution.u_range, resolution.y_end)
    nodes = [partial(solver.exponents, e) for e in node_places(extent, *resolution.places).reshape(2, -1).T]
    checks = _checks(extent, slenderness, resolution.cells, states)
    columns, loss_checks = _loss_pieces(extent, slenderness, resolution.cells)
    pieces: list[Sequence[Callable[[], Array]]] = [nodes, checks, columns, loss_checks]
    answers = iter(made_pieces([one for group in pieces for one in group], report, TITLE))
    levels, exact, losses, exact_losses = ([next(answers) for _ in group] for group in pieces)
    half = _denser(np.moveaxis(np.reshape(levels, (*counts, 3, -1)), 2, 0), extent, resolution)
    coefficients = np.concatenate([half[:, ::-1, ::-1], half], axis=2)
    for axis in range(3):
        coefficients = quintic_coefficients(coefficients, axis)
    table = PadMapTable(
        extent=extent,
        slenderness=slenderness,
        u_range=resolution.u_range,
        y_end=resolution.y_end,
        coefficients=coefficients,
        losses=fitted_losses(np.array(losses)),
    )
    known = np.concatenate(exact, axis=1), np.concatenate(exact_losses, axis=1)
    return replace(table, bounds=pad_bounds(table, states, *known))


def _denser(found: Array, extent: float, resolution: PadResolution) -> Array:
    """Return M at the places and between them, (2 n - 1, 2 m - 1, D), of M and its slopes, (3, n, m, D)."""
    (n, m, _), (first, last) = resolution.nodes, resolution.u_range
    M, (by_u, by_y) = found[0], along_nodes(found[1:], extent, *resolution.places)
    over_y = 2.0 * resolution.y_end / (m - 1)
    # Between places over u the slopes by Y are those of the spline through them.
    from scipy.interpolate import make_interp_spline

    cells = np.linspace(0.0, n - 1.0, 2 * n - 1)
    spline = make_interp_spline(np.arange(n), by_y, k=5)
    M = between_nodes(M, by_u, (last - first) / (n - 1))
    return between_nodes(M.swapaxes(0, 1), spline(cells).swapaxes(0, 1), over_y).swapaxes(0, 1)


def expected_time(resolution: PadResolution) -> float:
    """Return about how long a map takes on all cores of this machine [s]."""
    losses = LOSS_NODES * (LOSS_CELLS[0] + 1) * LOSS_CELLS[1] + LOSS_CHECKS * LOSS_STATES
    work = math.prod(resolution.nodes) / 2 + CHECK_NODES * STATES + losses
    return NODE_TIME * math.prod(resolution.cells) * work / cores()


def _loss_pieces(
    extent: float, slenderness: float, cells: tuple[int, int]
) -> tuple[Sequence[Callable[[], Array]], Sequence[Callable[[], Array]]]:
    """Return the pieces of work of shear and flow: at the nodes, a direction each, and for their bounds."""
    film = pad_grid(extent, slenderness, cells)
    finer = pad_grid.__wrapped__(extent, slenderness, (2 * cells[0], 2 * cells[1]))
    places = [loss_places(extent, column) for column in range(LOSS_CELLS[1])]
    columns = [partial(grid_losses, film, e, np.ones(e.shape[1])) for e in places]
    e, rate = loss_states(extent)
    parts = [slice(k, k + BATCH) for k in range(0, len(rate), BATCH)]
    return columns, [partial(grid_losses, finer, e[:, part], rate[part]) for part in parts]


def _checks(
    extent: float, slenderness: float, cells: tuple[int, int], states: PadStates
) -> list[Callable[[], Array]]:
    """Return the pieces of work, in the order of the states, that solve them on twice the cells."""
    finer = 2 * cells[0], 2 * cells[1]
    return [
        partial(_solved, extent, slenderness, finer, states.e[:, k : k + BATCH], states.phi[k : k + BATCH])
        for k in range(0, len(states.phi), BATCH)
    ]


def _solved(extent: float, slenderness: float, cells: tuple[int, int], e: Array, phi: Array) -> Array:
    w = np.stack([np.cos(phi), np.sin(phi)])
    films = [seen_film(extent, slenderness, cells, angle) for angle in phi.tolist()]
    return np.concatenate(
        [films[k].reference(e[:, k : k + 1], w[:, k : k + 1]) for k in range(len(films))], axis=1
    )
